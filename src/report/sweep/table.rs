//! The rows as a table (CSV, RFC 4180), in the order of their numbers.

use crate::{
    report::cells::Table,
    sweep::{Header, Row},
};

/// The table: row, the varied numbers, status, value, bracket, how dry friction was found,
/// direction, error, seconds.
///
/// # Errors
/// Only if memory runs out.
pub fn csv(header: &Header, rows: &[Row]) -> Result<String, csv::Error> {
    let mut table = Table::new();
    let labels = header.plan.vary.iter().map(|v| v.label());
    let after = [
        "status", "value", "lower", "upper", "dry", "toward_x", "toward_y", "toward_z", "error",
        "seconds",
    ];
    table.write_record(["row"].into_iter().chain(labels).chain(after))?;
    for row in rows {
        let a = &row.answer;
        let number = |v: Option<f64>| v.map(|v| v.to_string()).unwrap_or_default();
        let dry = a
            .dry
            .and_then(|d| serde_json::to_value(d).ok())
            .and_then(|v| v.as_str().map(String::from))
            .unwrap_or_default();
        let mut record = vec![row.row.to_string()];
        record.extend(row.parameters.iter().map(f64::to_string));
        record.extend([
            a.status.word().to_string(),
            number(a.value),
            number(a.lower),
            number(a.upper),
            dry,
        ]);
        record.extend((0..3).map(|k| number(a.toward.map(|t| t[k]))));
        record.extend([row.error.clone().unwrap_or_default(), row.seconds.to_string()]);
        table.write_record(record)?;
    }
    table.end()
}
