//! Records of earthquakes and pulses: the synthetic records of `structures/records`, what is wrong
//! with a record, and the same blocks in the engine.

use proptest::prelude::*;
use std::{f64::consts::PI, fmt::Write, path::Path};
use voussoir::{
    error::FindingCode,
    ground::{Format, Motion, Pulse, Record, STANDARD_GRAVITY, Unit},
};

/// The records of `structures/records` by the formulas of its README.
fn records() -> [(&'static str, String); 3] {
    let mut ricker = String::from("t (s),ax (m/s2),ay (m/s2),az (m/s2)\n");
    for k in 0..=400 {
        let t = 0.01 * f64::from(k);
        let x = (PI * (t - 2.0) / 1.2).powi(2);
        let a = 3.0 * (1.0 - 2.0 * x) * (-x).exp();
        writeln!(ricker, "{t:.2},{a:.6},{:.6},{:.6}", 0.3 * a, 0.1 * a).expect("text");
    }
    let mut chords = String::from(
        "PEER STRONG MOTION DATABASE RECORD. SYNTHETIC, BY A FORMULA\nTWELVE SINES UNDER AN ENVELOPE\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS=  1001, DT=   .0200 SEC\n",
    );
    for k in 0..=1000 {
        let t = 0.02 * f64::from(k);
        let envelope = t / 4.0 * (1.0 - t / 4.0).exp();
        let sum: f64 = (1..=12)
            .map(|j| {
                let j = f64::from(j);
                (2.0 * PI * (0.4 * j * t + 0.618_033_988_75 * j * j)).sin() / j.sqrt()
            })
            .sum();
        let end = if k % 5 == 4 || k == 1000 { "\n" } else { "" };
        write!(chords, "{:>15.6E}{end}", 0.16 * envelope * sum).expect("text");
    }
    let samples: Vec<f64> = (0..800)
        .map(|k| {
            let t = 0.005 * f64::from(k);
            let burst =
                |at: f64| (-((t - at) / 0.25).powi(2)).exp() * (2.0 * PI * 4.0 * (t - at)).sin();
            350.0 * (burst(1.0) - 0.8 * burst(2.5))
        })
        .collect();
    let peak = samples.iter().fold(0.0, |a: f64, s| if s.abs() > a.abs() { *s } else { a });
    let mut bursts = format!(
        "EVENT_NAME: SYNTHETIC\nSTATION_CODE: NONE\nSAMPLING_INTERVAL_S: 0.005000\nNDATA: 800\nDURATION_S: 3.995000\nSTREAM: HNE\nUNITS: cm/s^2\nDATA_TYPE: ACCELERATION\nPGA_CM/S^2: {peak:.6}\nHEADER_FORMAT: DYNA 1.2\n"
    );
    samples.iter().for_each(|s| writeln!(bursts, "{s:.6}").expect("text"));
    [("ricker.csv", ricker), ("chords.at2", chords), ("bursts.asc", bursts)]
}

/// The twelve records of `structures/records/suite`.
fn suite() -> Vec<(String, String)> {
    let one = |n: u32| {
        let mut text = format!(
            "PEER STRONG MOTION DATABASE RECORD. SYNTHETIC, BY A FORMULA\nEIGHT SINES UNDER AN ENVELOPE, NUMBER {n}\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS=   401, DT=   .0250 SEC\n"
        );
        for k in 0..=400 {
            let t = 0.025 * f64::from(k);
            let envelope = t / 3.0 * (1.0 - t / 3.0).exp();
            let sum: f64 = (1..=8)
                .map(|j| {
                    let phase = 0.618_033_988_75 * f64::from((j + 8 * n).pow(2));
                    let j = f64::from(j);
                    (2.0 * PI * (0.3 * j * t + phase)).sin() / j.sqrt()
                })
                .sum();
            let end = if k % 5 == 4 || k == 400 { "\n" } else { "" };
            write!(text, "{:>15.6E}{end}", 0.2 * envelope * sum).expect("text");
        }
        (format!("suite/chords-{n:02}.at2"), text)
    };
    (1..=12).map(one).collect()
}

fn all_records() -> Vec<(String, String)> {
    let first = records().into_iter().map(|(name, text)| (name.to_string(), text));
    first.chain(suite()).collect()
}

fn folder() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("structures/records")
}

#[test]
#[ignore = "writes the records"]
fn write_records() {
    for (name, text) in all_records() {
        std::fs::write(folder().join(name), text).expect("written");
    }
}

#[test]
fn records_are_those_of_their_formulas() {
    for (name, text) in all_records() {
        let there = std::fs::read_to_string(folder().join(&name)).expect("a record");
        assert!(there == text, "{name} differs from its formula");
    }
}

fn parse(name: &str, text: &str) -> Result<Record, String> {
    Record::parse(name, text.as_bytes(), None).map_err(|e| e.to_string())
}

#[test]
fn every_format_is_read_with_its_units() {
    let record = |name: &str| Record::read(&[&folder().join(name)], None).expect("a record");
    let ricker = record("ricker.csv");
    assert_eq!((ricker.format, ricker.components, ricker.samples.len()), (Format::Csv, 3, 401));
    assert!((ricker.step - 0.01).abs() < 1e-15 && (ricker.peaks().x - 3.0).abs() < 1e-12);
    let chords = record("chords.at2");
    assert_eq!((chords.format, chords.components, chords.samples.len()), (Format::Peer, 1, 1001));
    let peak = chords.peaks().x / STANDARD_GRAVITY;
    assert!((0.2..0.8).contains(&peak), "{peak}");
    let bursts = record("bursts.asc");
    assert_eq!((bursts.format, bursts.samples.len(), bursts.step), (Format::Esm, 800, 0.005));
    assert!((2.0..3.6).contains(&bursts.peaks().x));
    for r in [ricker, chords, bursts] {
        assert!(r.findings.is_empty(), "{:?}", r.findings);
    }
    // Components from files of their own.
    let path = folder().join("bursts.asc");
    let two = Record::read(&[&path, &path], None).expect("two components");
    assert_eq!((two.components, two.samples[300].x), (2, two.samples[300].y));
    let other = folder().join("chords.at2");
    let error = Record::read(&[&path, &other], None).expect_err("two steps").to_string();
    assert!(error.contains("chords.at2") && error.contains("s between samples"), "{error}");
}

/// Every mistake is told with its line, and what to do about it.
#[test]
fn bad_records_are_refused_with_their_place() {
    let peer = |rest: &str| format!("PEER\nname\nACCELERATION TIME SERIES IN UNITS OF G\n{rest}");
    let esm = |more: &str| {
        format!(
            "EVENT_NAME: X\nSAMPLING_INTERVAL_S: 0.01\nNDATA: 3\nUNITS: cm/s^2\n{more}100\n200\n-150\n"
        )
    };
    let list: [(&str, String, &str, &str); 19] = [
        ("r.csv", "t,a\n0,1\n0.1,2\n".into(), "r.csv:1:", "--units"),
        ("r.csv", "0 1\n0.1 2\n".into(), "r.csv:1:", "--units"),
        ("r.csv", "t (s),a (m/s2)\n0,1\n0.1,NaN\n0.2,1\n".into(), "r.csv:3:", "not finite"),
        ("r.csv", "t (s),a (m/s2)\n0,1\n0.1,inf\n".into(), "r.csv:3:", "not finite"),
        ("r.csv", "t (s),a (m/s2)\n0,1\n0.1,x\n0.2,1\n".into(), "r.csv:3:", "expected a number"),
        ("r.csv", "t (s),a (m/s2)\n0,1\n0.1,1\n0.3,1\n0.4,2\n".into(), "r.csv:4:", "not evenly"),
        ("r.csv", "t (s),a (m/s2)\n0,1\n0.1,1\n0.1,1\n".into(), "r.csv:4:", "must increase"),
        ("r.csv", "t (s),a (m/s2)\n0,1\n0.1\n".into(), "r.csv:3:", "incomplete"),
        ("r.csv", "t (s),a (furlong)\n0,1\n0.1,1\n".into(), "r.csv:1:", "not a unit"),
        ("r.csv", "t (s),a (m/s2)\n".into(), "r.csv:", "no samples"),
        ("r.csv", String::new(), "r.csv:1:", "empty"),
        ("r.csv", "t (s);a (g)\n0,0;0,1\n0,1;0,2\n".into(), "r.csv:2:", "decimal point"),
        (
            "r.at2",
            "PEER\nname\nACCELERATION TIME SERIES IN UNITS OF G\n0.1 0.2\n".into(),
            "r.at2:1:",
            "NPTS",
        ),
        ("r.at2", peer("NPTS= 4, DT= .01 SEC\n.1 .2 .3\n"), "r.at2:5:", "announces 4"),
        ("r.at2", peer("NPTS= 3, DT= .01 SEC\n.1 .2 nan\n"), "r.at2:5:", "not finite"),
        (
            "r.at2",
            "PEER\nname\nVELOCITY TIME SERIES IN UNITS OF CM/S\nNPTS= 2, DT= .01 SEC\n1 2\n".into(),
            "r.at2:3:",
            "velocity",
        ),
        ("r.asc", esm("").replace("NDATA: 3\n", ""), "r.asc:", "NDATA"),
        ("r.asc", esm("").replace("NDATA: 3", "NDATA: 5"), "r.asc:7:", "announces 5"),
        ("r.asc", esm("").replace("UNITS: cm/s^2\n", ""), "r.asc:", "--units"),
    ];
    for (name, text, place, what) in list {
        let error = parse(name, &text).expect_err(&text);
        assert!(error.starts_with(place) && error.contains(what), "{text}\n{error}");
    }
    // Units that are given where the file says others.
    let text = "t (s),a (g)\n0,0.1\n0.1,0.2\n";
    let error = Record::parse("r.csv", text.as_bytes(), Some(Unit::Gal)).expect_err("two units");
    assert!(error.to_string().contains("the file says g"), "{error}");
    assert!(Record::parse("r.csv", b"t,a\n0,0.1\n0.1,0.2\n", Some(Unit::Gravity)).is_ok());
}

#[test]
fn implausible_records_are_found() {
    let found = |text: &str| -> Vec<FindingCode> {
        parse("r.csv", text).expect("a record").findings.iter().map(|f| f.code).collect()
    };
    // 3 m/s² taken for g, 0.3 g taken for m/s², milliseconds taken for seconds.
    assert_eq!(found("t (s),a (g)\n0,0\n0.01,3\n0.02,-2\n"), [FindingCode::Units]);
    assert_eq!(found("t (s),a (m/s2)\n0,0\n0.01,0.3\n0.02,-0.2\n"), [FindingCode::Units]);
    assert_eq!(found("t (s),a (m/s2)\n0,0\n5,3\n10,-2\n"), [FindingCode::Units]);
    assert_eq!(found("t (s),a (m/s2)\n0,0\n0.01,3\n0.02,-2\n"), []);
    assert_eq!(found("t,a (m/s2)\n0,0\n0.01,3\n0.02,-2\n"), [FindingCode::Assumed]);
    let text = "EVENT_NAME: X\nSAMPLING_INTERVAL_S: 0.01\nNDATA: 2\nUNITS: cm/s^2\nPGA_CM/S^2: 981\n100\n-200\n";
    let record = parse("r.asc", text).expect("a record");
    assert_eq!(record.findings[0].code, FindingCode::Units);
    assert!(record.findings[0].text.contains("r.asc:7"), "{:?}", record.findings);
}

proptest! {
    /// Whatever the bytes: a record or an error, never a panic.
    #[test]
    fn anything_is_a_record_or_an_error(bytes in prop::collection::vec(any::<u8>(), 0..400), name in "r\\.(csv|at2|asc)") {
        let _ = Record::parse(&name, &bytes, Some(Unit::Gal));
    }

    /// A record cut anywhere is refused, or is shorter.
    #[test]
    fn a_record_that_is_cut_is_no_other_record(which in 0..3_usize, part in 0.0..1.0) {
        let (name, text) = &records()[which];
        let cut = &text[..(part * text.len() as f64) as usize];
        let whole = parse(name, text).expect("a record");
        if let Ok(record) = parse(name, cut) {
            // A table announces nothing; elsewhere only digits of the last number may be lost.
            let (own, all) = (record.samples.len(), whole.samples.len());
            prop_assert!(own <= all && (*name == "ricker.csv" || own == all));
            prop_assert!(record.samples[..own - 1] == whole.samples[..own - 1]);
        }
    }

    /// One record in three units.
    #[test]
    fn units_do_not_matter(values in prop::collection::vec(-5.0..5.0_f64, 2..40)) {
        let text = |unit: &str, by: f64| {
            let mut text = format!("t (s),a ({unit})\n");
            for (k, v) in values.iter().enumerate() {
                writeln!(text, "{:.2},{}", 0.01 * k as f64, v * by).expect("text");
            }
            parse("r.csv", &text).expect("a record").samples
        };
        let si = text("m/s2", 1.0);
        for (unit, by) in [("Gal", 100.0), ("g", 1.0 / STANDARD_GRAVITY), ("mm/s^2", 1000.0)] {
            for (a, b) in si.iter().zip(text(unit, by)) {
                prop_assert!((a - b).norm() <= 1e-14 * a.norm());
            }
        }
    }

    /// Velocities add up, whatever the stretches.
    #[test]
    fn velocities_add_up(cuts in prop::collection::vec(0.0..5.0_f64, 1..20)) {
        let motion = Record::read(&[&folder().join("ricker.csv")], None).expect("a record").motion();
        let pulse = Pulse::Sine { acceleration: 2.0, duration: 1.7 }.motion();
        let mut cuts = cuts;
        cuts.extend([0.0, 5.0]);
        cuts.sort_by(f64::total_cmp);
        for motion in [motion, pulse] {
            let sum: nalgebra::Vector3<f64> =
                cuts.windows(2).map(|p| motion.velocity(p[0], p[1])).sum();
            prop_assert!((sum - motion.velocity(0.0, 5.0)).norm() < 1e-12);
        }
    }
}

#[test]
fn pulses_are_read_or_refused() {
    let read = |text: &str| text.parse::<Pulse>();
    assert_eq!(read("half-sine:3,0.5"), Ok(Pulse::HalfSine { acceleration: 3.0, duration: 0.5 }));
    assert_eq!(read("jump:0.7"), Ok(Pulse::Jump { velocity: 0.7 }));
    for text in [
        "",
        "sine",
        "sine:1",
        "sine:1,0",
        "sine:1,-2",
        "sine:a,1",
        "square:1,1",
        "jump:inf",
        "sine:1,2,3",
    ] {
        assert!(read(text).expect_err(text).contains("hint: "));
    }
    assert_eq!(Motion::default().end(), 0.0);
}

mod command {
    //! `kinematic` and `simulate` on ground that moves.

    use serde_json::Value;
    use std::process::Command;

    fn voussoir(arguments: &str) -> (i32, String, String) {
        let output = Command::new(env!("CARGO_BIN_EXE_voussoir"))
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .args(arguments.split(' '))
            .output()
            .expect("it runs");
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("text");
        (output.status.code().expect("a code"), text(output.stdout), text(output.stderr))
    }

    fn json(arguments: &str) -> (i32, Value) {
        let (code, out, error) = voussoir(arguments);
        (code, serde_json::from_str(&out).unwrap_or_else(|e| panic!("{arguments}: {e}\n{error}")))
    }

    const BLOCK: &str = "structures/slender-block.json";

    #[test]
    fn a_mechanism_in_time() {
        let (code, answer) =
            json(&format!("kinematic {BLOCK} --pulse jump:1 --scale 0.74 --scan 0.1,2 --json"));
        let answer = &answer["answer"]["rocking"];
        assert_eq!((code, &answer["fate"]), (1, &"overturns".into()));
        let flip = answer["flips"][0]["overturns_at"].as_f64().expect("a scale");
        assert!((flip - 0.734_025_135_1).abs() < 1e-8);
        assert_eq!(answer["idealised"], Value::Null);
        // The other way the same.
        let toward = format!("kinematic {BLOCK} --pulse jump:0.73 --toward -1,0 --json");
        assert_eq!(json(&toward).0, 0);
        // Free rocking.
        let (code, answer) = json(&format!("kinematic {BLOCK} --from -0.5 --json"));
        let first = answer["answer"]["rocking"]["impacts"][0]["time"].as_f64().expect("a time");
        assert!(code == 0 && (first - 0.490_864_457_849_559).abs() < 1e-9);
        let given = format!("kinematic {BLOCK} --from 0.5 --restitution 1 --seconds 3 --json");
        let (code, answer) = json(&given);
        assert_eq!((code, &answer["answer"]["rocking"]["fate"]), (3, &"rocks".into()));
    }

    #[test]
    fn all_blocks_in_time() {
        let run = format!("simulate {BLOCK} --ground structures/records/ricker.csv --fast --json");
        let (code, answer) = json(&format!("{run} --scale 2"));
        let fate = |answer: &Value| answer["answer"]["shaken"]["fate"].clone();
        assert_eq!((code, fate(&answer)), (1, "overturns".into()), "{answer}");
        // As far as the mechanism (0.3298), within what fast steps are good for.
        let far = |answer: &Value| {
            answer["answer"]["shaken"]["blocks"][0]["greatest_over_thickness"].as_f64()
        };
        let went = far(&json(&run).1).expect("a way");
        assert!((went / 0.3298 - 1.0).abs() < 0.03, "{went}");
        let (code, answer) = json(&format!("{run} --scale 0.1"));
        assert_eq!((code, fate(&answer)), (0, "rests".into()));
        assert!(far(&answer).is_some_and(|f| f < 1e-2), "{answer}");
    }

    /// Saved, checked, told on a page with its record, and put the same way again.
    #[test]
    fn all_blocks_in_time_are_filed() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |name: &str| folder.path().join(name).display().to_string();
        let [saved, page, csv] = ["result.json", "page.html", "ways.csv"].map(path);
        let run =
            format!("simulate {BLOCK} --pulse half-sine:3,0.25 --scale 1.1 --fast --seconds 2");
        let (code, out, error) =
            voussoir(&format!("{run} --frames 10 --save {saved} --report {page} --csv {csv}"));
        assert_eq!(code, 3, "{error}");
        assert!(out.contains("half-sine:3,0.25, × 1.1"), "{out}");
        assert!(
            out.contains("--fast --seconds 2 --pulse half-sine:3,0.25 --scale 1.1 --save"),
            "{out}"
        );
        let text = std::fs::read_to_string(&saved).expect("a result");
        let file: Value = serde_json::from_str(&text).expect("JSON");
        assert!(file["question"].get("shake").is_some());
        assert_eq!(file["run"]["frames"].as_array().map(Vec::len), Some(10));
        let (code, out, error) = voussoir(&format!("check {saved}"));
        assert_eq!(code, 0, "{error}");
        assert!(out.contains("confirmed, not proved"), "{out}");
        let page = std::fs::read_to_string(&page).expect("a page");
        for words in [
            "Displacements of the blocks</h3>",
            "Displacements of the blocks that moved farthest",
            "× 1.1",
        ] {
            assert!(page.contains(words), "{words}");
        }
        assert_eq!(std::fs::read_to_string(&csv).expect("a table").lines().count(), 11);
        // Without frames the result holds none, whatever the page and the table took.
        let (_, out, _) = voussoir(&format!("{run} --csv {csv} --json"));
        let file: Value = serde_json::from_str(&out).expect("JSON");
        assert!(file["shaken"].is_null() && file["answer"]["shaken"]["blocks"].is_array());
    }

    #[test]
    fn what_says_nothing_is_refused() {
        for (arguments, word) in [
            ("kinematic BLOCK --scale 2", "--scale requires"),
            ("kinematic BLOCK --restitution 0.9", "--restitution requires"),
            ("kinematic BLOCK --pulse jump:1 --fc 1.2", "--fc cannot be combined"),
            ("kinematic BLOCK --pulse square:1,1", "is not a pulse"),
            ("kinematic BLOCK --pulse jump:1 --restitution 1.5", "not a coefficient of"),
            ("kinematic BLOCK --ground structures/records/missing.csv", "missing.csv"),
            ("kinematic BLOCK --ground structures/README.md", "README.md"),
            ("kinematic structures/oblique-sliding.json --pulse jump:1", "slides"),
            ("simulate BLOCK --scale 2", "--scale requires"),
            ("simulate BLOCK --pulse double-jump:1", "waits for a landing"),
            ("simulate BLOCK --pulse jump:1 --toward 0,0,1", "parallel to gravity"),
        ] {
            let (code, _, error) = voussoir(&arguments.replace("BLOCK", BLOCK));
            assert!(code == 2 && error.contains(word), "{arguments}: {code} {error}");
        }
    }
}
