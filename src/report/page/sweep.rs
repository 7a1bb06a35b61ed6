//! The page of a sweep: its words, charts of the value against what varies, and a table of all rows
//! to sort.

use super::tables;
use crate::{
    sweep::chart::{ROWS, charts, label},
    text::Page,
};
use serde_json::{Value, json};
use sweep::{Header, Row, Summary};

/// The page; `text` is the summary in words.
///
/// # Errors
/// Only if memory runs out.
pub fn sweep(
    text: &Page,
    header: &Header,
    rows: &[Row],
    summary: &Summary,
) -> Result<String, serde_json::Error> {
    tables(text, &charts(header, rows, summary), &[table(header, rows)])
}

fn table(header: &Header, rows: &[Row]) -> Value {
    let directions = rows.iter().any(|r| r.answer.toward.is_some());
    let errors = rows.iter().any(|r| r.error.is_some());
    let mut columns: Vec<&str> = vec!["row"];
    columns.extend((0..header.plan.vary.len()).map(|k| label(header, k)));
    columns.extend([
        "status",
        header.plan.question.quantity().unwrap_or("value"),
        "lower",
        "upper",
    ]);
    columns.extend(directions.then_some("towards"));
    columns.extend(errors.then_some("error"));
    columns.push("seconds");
    let line = |r: &Row| {
        let a = &r.answer;
        let mut cells: Vec<Value> = vec![json!(r.row)];
        cells.extend(r.parameters.iter().map(|v| json!(v)));
        cells.extend([json!(a.status.word()), json!(a.value), json!(a.lower), json!(a.upper)]);
        cells.extend(directions.then(|| json!(a.toward.map(base::number::point))));
        cells.extend(errors.then(|| json!(r.error)));
        cells.push(json!(r.seconds));
        cells
    };
    let left = rows.len().saturating_sub(ROWS);
    let note =
        if left > 0 { format!("{left} more rows are in the output file.") } else { String::new() };
    json!({ "title": "Rows", "columns": columns, "rows": rows.iter().take(ROWS).map(line).collect::<Vec<_>>(), "note": note })
}
