//! PEER AT2: four lines of header, the third with the unit, the fourth with the number of samples
//! and the time between them; then samples, several a line.

use super::{
    format::Format,
    raw::{Column, Raw, counted, error, number, shortened, words},
    unit::{UNITS, Unit},
};
use base::error::InputError;

/// Lines in which the header must be over.
const HEADER: usize = 8;

pub(super) fn is_at2(lines: &[(usize, String)]) -> bool {
    lines.iter().take(HEADER).any(|(_, l)| {
        let l = l.trim().to_uppercase();
        l.contains("NPTS") || l.starts_with("PEER ") || l.contains("TIME SERIES IN UNITS")
    })
}

pub(super) fn read(lines: &[(usize, String)]) -> Result<Raw, InputError> {
    let head = || lines.iter().take(HEADER);
    let Some((at, counts)) = head().find(|(_, l)| l.to_uppercase().contains("NPTS")) else {
        return Err(error(1, "the header of this AT2 file is cut off: no line with NPTS and DT")
            .hint("line 4 must give the number of samples and the time step, such as \"NPTS= 4000, DT= .0100 SEC\""));
    };
    let (count, step) = counts_of(*at, counts)?;
    let (mut unit, mut unit_line) = (None, *at);
    for (line, text) in head().take_while(|(n, _)| n < at) {
        let upper = text.to_uppercase();
        if let Some(kind) = ["VELOCITY", "DISPLACEMENT"].into_iter().find(|k| upper.contains(k))
            && upper.contains("TIME SERIES")
        {
            return Err(error(*line, format!("this is a record of {}", kind.to_lowercase()))
                .hint("give the record of acceleration (.AT2)"));
        }
        if let Some((_, name)) = upper.split_once("UNITS OF") {
            unit_line = *line;
            unit = Unit::read(name);
            if unit.is_none() {
                return Err(error(
                    *line,
                    format!("{:?} is not a unit of acceleration", shortened(name)),
                )
                .hint(format!("units are {}", UNITS)));
            }
        }
    }
    let mut column = Column { unit, ..Column::default() };
    for (line, text) in lines.iter().filter(|(n, _)| n > at) {
        for word in words(text) {
            column.values.push(number(*line, word)?);
            column.lines.push(*line);
        }
    }
    let mut findings = Vec::new();
    counted(*at, "NPTS", count, &mut column, &mut findings)?;
    Ok(Raw { format: Format::Peer, step, columns: vec![column], unit_line, findings })
}

/// "NPTS= 4000, DT= .0100 SEC", or in older files "4000 0.0100 NPTS, DT".
fn counts_of(line: usize, text: &str) -> Result<(usize, f64), InputError> {
    let upper = text.to_uppercase();
    let numbers: Vec<f64> = upper
        .split(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '-' | '+')))
        .filter_map(|w| w.parse().ok())
        .collect();
    let after = |key: &str| -> Option<f64> {
        let (_, rest) = upper.split_once(key)?;
        let rest = rest.trim_start_matches([' ', '=', ':']);
        rest.split(|c: char| c.is_whitespace() || c == ',').next()?.parse().ok()
    };
    let found = after("NPTS").zip(after("DT")).or(match numbers.as_slice() {
        [count, step, ..] => Some((*count, *step)),
        _ => None,
    });
    match found {
        Some((count, step)) if count >= 1.0 && count.fract() == 0.0 && step > 0.0 => {
            Ok((count as usize, step))
        }
        _ => Err(error(
            line,
            format!("no number of samples and no time step in {:?}", shortened(text)),
        )
        .hint("such as \"NPTS= 4000, DT= .0100 SEC\"")),
    }
}
