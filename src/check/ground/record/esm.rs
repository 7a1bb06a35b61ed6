//! ESM and ITACA ASCII: lines `KEY: value`, then one sample a line.

use super::{
    format::Format,
    raw::{Column, Raw, counted, error, number, shortened},
    unit::{UNITS, Unit},
};
use base::error::InputError;

/// Keys that only such files have.
const KEYS: [&str; 6] =
    ["SAMPLING_INTERVAL_S", "NDATA", "EVENT_NAME", "DATA_TYPE", "HEADER_FORMAT", "STATION_CODE"];

fn key(line: &str) -> Option<(&str, &str)> {
    let (key, value) = line.split_once(':')?;
    let is_key = |c: char| c.is_ascii_uppercase() || c.is_ascii_digit() || "_/^".contains(c);
    let key = key.trim();
    (!key.is_empty()
        && key.chars().all(is_key)
        && key.starts_with(|c: char| c.is_ascii_uppercase()))
    .then(|| (key, value.trim()))
}

pub(super) fn is_esm(lines: &[(usize, String)]) -> bool {
    lines.iter().take(80).any(|(_, l)| key(l).is_some_and(|(k, _)| KEYS.contains(&k)))
}

pub(super) fn read(lines: &[(usize, String)]) -> Result<Raw, InputError> {
    let mut header: Vec<(usize, &str, &str)> = Vec::new();
    let mut body = lines.len();
    for (index, (line, text)) in lines.iter().enumerate() {
        match key(text) {
            Some((k, value)) => header.push((*line, k, value)),
            None if text.trim().is_empty() => {}
            None => {
                body = index;
                break;
            }
        }
    }
    let last = header.last().map_or(1, |h| h.0);
    let find = |k: &str| header.iter().find(|h| h.1 == k && !h.2.is_empty()).copied();
    let need = |k: &str, such: &str| {
        find(k).ok_or_else(|| {
            error(last, format!("the header is cut off: it has no {k}"))
                .hint(format!("ESM and ITACA files have a line such as \"{k}: {such}\""))
        })
    };
    let (step_line, _, step) = need("SAMPLING_INTERVAL_S", "0.005000")?;
    let step = number(step_line, step)?;
    if step <= 0.0 {
        return Err(error(step_line, format!("SAMPLING_INTERVAL_S must be > 0, got {step}")));
    }
    let (count_line, _, count) = need("NDATA", "8000")?;
    let count: usize = count.parse().map_err(|_| {
        error(count_line, format!("NDATA is not a number of samples: {:?}", shortened(count)))
    })?;
    if let Some((line, _, kind)) = find("DATA_TYPE")
        && !kind.to_uppercase().contains("ACCELERATION")
    {
        return Err(error(line, format!("this is a record of {}", kind.to_lowercase()))
            .hint("give the record of acceleration"));
    }
    let unit = match find("UNITS") {
        Some((line, _, name)) => Some((
            line,
            Unit::read(name).ok_or_else(|| {
                error(line, format!("{:?} is not a unit of acceleration", shortened(name)))
                    .hint(format!("units are {}", UNITS))
            })?,
        )),
        None => None,
    };
    // Announced as PGA_CM/S^2 in the unit that its key names.
    let announced = header.iter().find_map(|(line, k, value)| {
        let of = Unit::read(k.strip_prefix("PGA_")?)?;
        Some(number(*line, value).ok()? * of.value())
    });
    let mut column = Column { unit: unit.map(|u| u.1), ..Column::default() };
    column.announced = announced.map(f64::abs).filter(|a| *a > 0.0);
    for (line, text) in lines[body..].iter().filter(|(_, t)| !t.trim().is_empty()) {
        column.values.push(number(*line, text)?);
        column.lines.push(*line);
    }
    let mut findings = Vec::new();
    counted(count_line, "NDATA", count, &mut column, &mut findings)?;
    let unit_line = unit.map_or(last, |u| u.0);
    Ok(Raw { format: Format::Esm, step, columns: vec![column], unit_line, findings })
}
