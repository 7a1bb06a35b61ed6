//! Summaries against counts by hand and published tables.

use super::{block, sweep};
use serde_json::json;
use voussoir::{
    report::sweep::{Kind, chart, csv},
    sweep::{Row, RowAnswer, RowStatus, Shard, Sweep, influence, summarize, wilson},
};

fn row(number: usize, parameters: &[f64], status: RowStatus, value: Option<f64>) -> Row {
    Row {
        row: number,
        parameters: parameters.iter().map(|p| (*p).into()).collect(),
        answer: RowAnswer { value, ..RowAnswer::of(status) },
        error: None,
        seconds: 0.5,
    }
}

fn found(number: usize, parameters: &[f64], value: f64) -> Row {
    row(number, parameters, RowStatus::Found, Some(value))
}

fn two_numbers(question: serde_json::Value) -> Sweep {
    with(question, json!({ "random": { "samples": 9 } }))
}

fn with(question: serde_json::Value, sampling: serde_json::Value) -> Sweep {
    let vary = json!([
        { "pointer": "/joints/default/friction", "name": "a", "values": [0.1, 0.2, 0.3] },
        { "pointer": "/materials/stone/density", "name": "b <&\"", "values": [1, 2, 3] }
    ]);
    sweep(block(), question, vary, sampling)
}

fn grid(value: impl Fn(f64, f64) -> f64) -> Vec<Row> {
    let all = (0..9).map(|i| (i, [0.1, 0.2, 0.3][i / 3], [1.0, 2.0, 3.0][i % 3]));
    all.map(|(i, a, b)| found(i, &[a, b], value(a, b))).collect()
}

#[test]
fn wilson_intervals_are_those_of_the_tables() {
    // Newcombe, Statistics in Medicine 17 (1998) 857, table I, method 3.
    for (failed, of, lower, upper) in [
        (81, 263, 0.2553, 0.3662),
        (15, 148, 0.0624, 0.1605),
        (0, 20, 0.0, 0.1611),
        (1, 29, 0.0061, 0.1718),
    ] {
        let p = wilson(failed, of);
        assert!((p.lower - lower).abs() < 6e-5 && (p.upper - upper).abs() < 6e-5, "{p:?}");
    }
    assert_eq!((wilson(5, 5).upper, wilson(0, 0).upper), (1.0, 1.0));
}

#[test]
fn the_share_of_a_number_is_that_of_the_analysis_of_variance() {
    let sweep = two_numbers(json!({ "limit": {} }));
    let alone = summarize(&sweep.header(Shard::ALL), &grid(|a, _| a));
    assert_eq!((alone.influence[0].parameter.as_str(), alone.influence[0].share), ("a", 1.0));
    assert_eq!(alone.influence[1].share, 0.0);
    // f = 3 a' + b' with a', b' in {-1, 0, 1}: sums of squares 54 and 6, so η² = 0.9, corrected 1 −
    // 0.1 × 8 / 6.
    let both = summarize(&sweep.header(Shard::ALL), &grid(|a, b| 30.0 * a + b));
    assert!(
        (both.influence[0].share - (1.0 - 0.1 * 8.0 / 6.0)).abs() < 1e-12,
        "{:?}",
        both.influence
    );
    // A dependence that no correlation coefficient sees.
    let values: Vec<f64> = (0..1000).map(|i| f64::from(i) / 1000.0).collect();
    let wave: Vec<f64> = values.iter().map(|v| (v - 0.5).powi(2)).collect();
    assert!(influence(&values, &wave).unwrap() > 0.9);
    assert_eq!(influence(&values, &vec![3.0; 1000]), None);
}

#[test]
fn counts_quantiles_and_the_fragility_against_a_demand() {
    let sweep = two_numbers(json!({ "limit": {} }));
    let mut rows: Vec<Row> = (0..5).map(|i| found(i, &[0.1, 1.0], 1.0 + i as f64)).collect();
    rows.push(row(5, &[0.2, 1.0], RowStatus::Impossible, None));
    rows.push(row(6, &[0.2, 2.0], RowStatus::Unbounded, None));
    rows.push(row(7, &[0.2, 3.0], RowStatus::Undecided, None));
    let s = summarize(&sweep.header(Shard::ALL), &rows);
    assert_eq!(
        s.counts.into_iter().collect::<Vec<_>>(),
        [("found", 5), ("impossible", 1), ("unbounded", 1), ("undecided", 1)]
    );
    let q = s.quantiles.unwrap();
    assert_eq!((q.least, q.median, q.p25, q.greatest), ((1.0, 0), 3.0, 2.0, (5.0, 4)));
    assert!((q.p05 - 1.2).abs() < 1e-12);
    let points = s.fragility.unwrap().points;
    let failed = |at: f64| {
        points.iter().find(|p| (p.0 - at).abs() < 1e-9).map(|p| (p.1.failed, p.1.of)).unwrap()
    };
    // The undecided row does not count; what is impossible fails at every demand.
    assert_eq!((failed(1.0), failed(3.0), failed(5.0)), ((1, 7), (3, 7), (5, 7)));
    assert!(s.failed.is_none() && s.seconds == 4.0);
}

#[test]
fn verdicts_and_requirements_fail_along_the_number_that_matters() {
    let sweep = two_numbers(json!({ "assess": {} }));
    let stands = |b: f64| if b > 1.5 { RowStatus::Stable } else { RowStatus::Unstable };
    let rows: Vec<Row> = grid(|_, b| b)
        .into_iter()
        .map(|r| {
            let numbers: Vec<f64> = r.parameters.iter().filter_map(|p| p.number()).collect();
            row(r.row, &numbers, stands(numbers[1]), None)
        })
        .collect();
    let s = summarize(&sweep.header(Shard::ALL), &rows);
    assert_eq!((s.failed.unwrap().failed, s.failed.unwrap().of), (3, 9));
    let f = s.fragility.unwrap();
    assert_eq!(f.along, "b <&\"");
    assert_eq!(
        f.points.iter().map(|p| (p.0, p.1.failed)).collect::<Vec<_>>(),
        [(1.0, 3), (2.0, 0), (3.0, 0)]
    );

    let sweep = two_numbers(json!({ "limit": { "require": 0.25 } }));
    let s = summarize(&sweep.header(Shard::ALL), &grid(|a, _| a));
    assert_eq!(s.failed.unwrap().failed, 6);
    assert_eq!(
        s.fragility.unwrap().points.iter().map(|p| p.1.failed).collect::<Vec<_>>(),
        [3, 3, 0]
    );
}

#[test]
fn charts_are_good_xml_with_what_they_show() {
    let sweep = two_numbers(json!({ "limit": {} }));
    let (header, rows) = (sweep.header(Shard::ALL), grid(|a, b| a + b));
    let summary = summarize(&header, &rows);
    let draw = |kind| chart(&header, &rows, &summary, kind).unwrap();
    for svg in [draw(Kind::Line), draw(Kind::Heat), draw(Kind::Fragility)] {
        assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"), "{svg}");
        assert!(!svg.contains("b <&") && !svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        assert_eq!(svg.matches("<text").count(), svg.matches("</text>").count());
    }
    // Nine cells, 40 steps of the colour bar, the ground.
    assert_eq!(draw(Kind::Heat).matches("<rect").count(), 50);
    assert_eq!(Kind::suited(&header, &summary), Kind::Fragility);
    // A grid is no sample: its values are drawn, its shares are no probabilities.
    let grid_header = with(json!({ "limit": {} }), json!({ "grid": {} })).header(Shard::ALL);
    let summary = summarize(&grid_header, &rows);
    assert_eq!((Kind::suited(&grid_header, &summary), summary.fragility), (Kind::Heat, None));
    let nothing = [row(0, &[0.1, 1.0], RowStatus::Undecided, None)];
    let summary = summarize(&header, &nothing);
    // Rows without a value are drawn as well; a share needs rows that tell.
    for kind in [Kind::Line, Kind::Heat] {
        assert!(chart(&header, &nothing, &summary, kind).unwrap().contains("undecided: 1 row"));
    }
    assert!(chart(&header, &nothing, &summary, Kind::Fragility).is_err());
}

#[test]
fn tables_quote_what_needs_it() {
    let sweep = two_numbers(json!({ "limit": {} }));
    let mut rows = grid(|a, _| a);
    rows[1].error = Some("a, \"b\"".into());
    let text = csv(&sweep.header(Shard::ALL), &rows).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(
        lines[0],
        "row,a,\"b <&\"\"\",status,value,lower,upper,dry,toward_x,toward_y,toward_z,error,seconds"
    );
    assert_eq!(lines[2], "1,0.1,2,\"found\",0.1,,,,,,,\"a, \"\"b\"\"\",0.5");
    assert_eq!(lines.len(), 10);
}

/// A grid whose first two columns fall whatever the load, with a row that failed: every row is seen,
/// and no mean hides one.
#[test]
fn rows_without_a_value_are_drawn_and_said() {
    let sweep = with(json!({ "limit": {} }), json!({ "grid": {} }));
    let header = sweep.header(Shard::ALL);
    let mut rows = grid(|a, b| a + b);
    for falls in [0, 1, 2, 4] {
        rows[falls] = Row { answer: RowAnswer::of(RowStatus::Impossible), ..rows[falls].clone() };
    }
    rows[5] = Row {
        answer: RowAnswer::of(RowStatus::Error),
        error: Some("no such block".into()),
        ..rows[5].clone()
    };
    let summary = summarize(&header, &rows);
    let heat = chart(&header, &rows, &summary, Kind::Heat).unwrap();
    // Nine cells, 40 steps of the colour bar, two keys, the ground: nothing is left white.
    assert_eq!(heat.matches("<rect").count(), 52);
    let squares = |colour: &str| {
        let rects = heat.split("<rect").skip(1).filter_map(|r| r.split('>').next());
        rects.filter(|r| r.contains(&format!("fill=\"{colour}\""))).count()
    };
    assert_eq!((squares("#c81e2d"), squares("#000000")), (5, 2));
    assert!(heat.contains("falls: 4 rows") && heat.contains("error: 1 row"), "{heat}");
    // Against one number: two groups have a row without a value, so no mean; the third has one.
    let line = chart(&header, &rows, &summary, Kind::Line).unwrap();
    assert!(line.contains("falls: 4 rows") && line.contains("error: 1 row"), "{line}");
    let words = summary_text(&header, &rows);
    assert!(words.contains("of the 4 rows with a value"), "{words}");
    assert!(words.contains("the first in row 5: no such block"), "{words}");
}

fn summary_text(header: &voussoir::sweep::Header, rows: &[Row]) -> String {
    let layout = voussoir::report::text::Layout { unnamed: "", width: 200 };
    voussoir::report::sweep::summary(header, &summarize(header, rows), false, layout).to_string()
}

/// Words are places along an axis in the order of the plan.
#[test]
fn words_are_drawn_by_their_names() {
    let vary =
        json!([{ "pointer": "/blocks/1/material", "name": "stone", "values": ["other", "stone"] }]);
    let sweep = sweep(block(), json!({ "limit": {} }), vary, json!({ "grid": {} }));
    let header = sweep.header(Shard::ALL);
    let rows: Vec<Row> = (0..2)
        .map(|k| Row { parameters: sweep.parameters(k), ..found(k, &[], 0.2 + 0.1 * k as f64) })
        .collect();
    assert_eq!(rows[0].parameters, ["other".into()]);
    let svg = chart(&header, &rows, &summarize(&header, &rows), Kind::Line).unwrap();
    assert!(svg.contains("other") && svg.contains("stone"), "{svg}");
    let table = csv(&header, &rows).unwrap();
    assert!(table.contains("\n0,\"other\",\"found\",0.2,"), "{table}");
}
