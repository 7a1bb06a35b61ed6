//! The rows as a table (CSV, RFC 4180), in the order of their numbers.

use crate::cells::{Cell, Table};
use check::question::Question;
use sweep::{Header, Parameter, Row};

/// The table: row, the varied numbers, status, value, bracket, how dry friction was found,
/// direction, error, seconds; of an earthquake a0 (m/s²), d0 (m) and the share of that of the site.
///
/// # Errors
/// Only if memory runs out.
pub fn csv(header: &Header, rows: &[Row]) -> Result<String, csv::Error> {
    let labels = header.plan.vary.iter().map(|v| v.label().to_string());
    let after = [
        "status", "value", "lower", "upper", "dry", "toward_x", "toward_y", "toward_z", "error",
        "seconds",
    ];
    let quake = matches!(header.plan.question, Question::Kinematic(_));
    let more: &[&str] = if quake { &["a0", "d0", "site"] } else { &[] };
    let head = std::iter::once(String::from("row")).chain(labels);
    let mut table = Table::with_head(head.chain(after.iter().chain(more).map(|s| s.to_string())))?;
    for row in rows {
        let a = &row.answer;
        let dry = a
            .dry
            .and_then(|d| serde_json::to_value(d).ok())
            .and_then(|v| v.as_str().map(String::from))
            .unwrap_or_default();
        let mut record: Vec<Cell> = vec![row.row.into()];
        record.extend(row.parameters.iter().map(|p| match p {
            Parameter::Number(number) => Cell::from(*number),
            Parameter::Word(word) => word.as_str().into(),
        }));
        record.extend([
            a.status.word().into(),
            a.value.into(),
            a.lower.into(),
            a.upper.into(),
            dry.into(),
        ]);
        record.extend((0..3).map(|k| a.toward.map(|t| t[k]).into()));
        record.extend([row.error.clone().unwrap_or_default().into(), row.seconds.into()]);
        if quake {
            record.extend([a.a0, a.d0, a.site].map(Cell::from));
        }
        table.write_record(record)?;
    }
    table.end()
}
