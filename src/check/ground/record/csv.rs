//! Tables: a column of times and one to three of accelerations, between commas, semicolons, tabs or
//! blanks; a header with units in brackets, or a comment such as `# units: m/s2`.

use super::{
    format::Format,
    raw::{Column, Raw, error, number, shortened},
    unit::{UNITS, Unit},
};
use base::error::{Finding, FindingCode, InputError};

pub(super) fn read(lines: &[(usize, String)]) -> Result<Raw, InputError> {
    let mut unit_of_all = None;
    let mut unit_line = 1;
    let mut header: Option<(usize, Vec<String>)> = None;
    let mut rows: Vec<(usize, Vec<String>)> = Vec::new();
    for (line, text) in lines {
        let text = text.trim();
        if text.is_empty() {
            continue;
        }
        if let Some(comment) = text.strip_prefix('#') {
            if let Some(name) = named(comment) {
                let unit = Unit::read(name).ok_or_else(|| {
                    error(*line, format!("{:?} is not a unit of acceleration", shortened(name)))
                        .hint(format!("units are {}", UNITS))
                })?;
                (unit_of_all, unit_line) = (Some(unit), *line);
            }
            continue;
        }
        let cells = cells(*line, text)?;
        let is_number = |c: &String| c.trim().parse::<f64>().is_ok();
        if rows.is_empty() && header.is_none() && !cells.iter().any(is_number) {
            header = Some((*line, cells));
        } else {
            rows.push((*line, cells));
        }
    }
    let Some((first, cells)) = rows.first() else {
        return Err(error(lines.len().max(1), "the file has no samples").hint(
            "give lines with a time and one to three accelerations, such as \"0.01, 0.35\"",
        ));
    };
    let (first, width) = (*first, cells.len());
    if !(2..=4).contains(&width) {
        return Err(error(
            first,
            format!(
                "{width} numbers in a line: a record needs a time and one to three accelerations"
            ),
        )
        .hint("columns are t,a or t,ax,ay or t,ax,ay,az"));
    }
    let mut findings = Vec::new();
    let (mut time_unit, mut units) = (None, vec![unit_of_all; width - 1]);
    if let Some((line, names)) = &header {
        if names.len() != width {
            return Err(error(
                *line,
                format!("the header has {} columns, line {first} has {width}", names.len()),
            ));
        }
        unit_line = *line;
        for (k, name) in names.iter().enumerate() {
            let Some(name) = bracketed(name) else { continue };
            if k == 0 {
                time_unit = Some(seconds(*line, name)?);
            } else {
                units[k - 1] = Some(Unit::read(name).ok_or_else(|| {
                    error(*line, format!("{:?} is not a unit of acceleration", shortened(name)))
                        .hint(format!("units are {}", UNITS))
                })?);
            }
        }
    }
    if time_unit.is_none() {
        findings.push(Finding::new(
            FindingCode::Assumed,
            "times are taken in seconds: the file gives no unit for them",
        ));
    }
    let mut columns: Vec<Column> =
        units.into_iter().map(|unit| Column { unit, ..Column::default() }).collect();
    let mut times = Vec::with_capacity(rows.len());
    let mut decimals = 0;
    for (line, cells) in &rows {
        if cells.len() != width {
            return Err(error(*line, format!("{} numbers, line {first} has {width}", cells.len()))
                .hint("the file may be incomplete"));
        }
        times.push((*line, number(*line, &cells[0])? * time_unit.unwrap_or(1.0)));
        decimals = decimals.max(digits(&cells[0]));
        for (column, cell) in columns.iter_mut().zip(&cells[1..]) {
            column.values.push(number(*line, cell)?);
            column.lines.push(*line);
        }
    }
    let resolution = 0.5 * 10.0_f64.powi(-decimals) * time_unit.unwrap_or(1.0);
    let step = even(&times, resolution)?;
    Ok(Raw { format: Format::Csv, step, columns, unit_line, findings })
}

/// The cells of a line.
fn cells(line: usize, text: &str) -> Result<Vec<String>, InputError> {
    let semicolons = text.contains(';');
    if semicolons && text.contains(',') {
        return Err(error(
            line,
            format!("decimal commas, or two kinds of separators: {:?}", shortened(text)),
        )
        .hint("write numbers with a decimal point"));
    }
    let split: Vec<String> = if semicolons {
        text.split(';').map(str::to_string).collect()
    } else if text.contains(',') {
        text.split(',').map(str::to_string).collect()
    } else if text.contains('\t') {
        text.split('\t').map(str::to_string).collect()
    } else {
        words_with_brackets(text)
    };
    Ok(split.into_iter().map(|c| c.trim().trim_matches('"').to_string()).collect())
}

/// Words between blanks; a word in brackets belongs to the one before it.
fn words_with_brackets(text: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match words.last_mut() {
            Some(last) if word.starts_with(['(', '[']) => {
                last.push(' ');
                last.push_str(word);
            }
            _ => words.push(word.to_string()),
        }
    }
    words
}

/// What stands in brackets.
fn bracketed(name: &str) -> Option<&str> {
    let open = name.find(['(', '['])?;
    let rest = &name[open + 1..];
    let close = rest.find([')', ']'])?;
    Some(rest[..close].trim())
}

/// The unit that a comment names: `units: g`, `unit = m/s2`.
fn named(comment: &str) -> Option<&str> {
    let lower = comment.to_ascii_lowercase();
    let at = lower.find("unit")?;
    let rest = comment.get(at + 4..)?;
    let rest = rest.strip_prefix(['s', 'S']).unwrap_or(rest).trim_start();
    let name = rest.strip_prefix([':', '='])?.trim();
    (!name.is_empty()).then_some(name)
}

fn seconds(line: usize, name: &str) -> Result<f64, InputError> {
    match name.to_lowercase().as_str() {
        "s" | "sec" | "second" | "seconds" => Ok(1.0),
        "ms" | "msec" | "milliseconds" => Ok(1e-3),
        _ => Err(error(line, format!("{:?} is not a unit of time", shortened(name)))
            .hint("units are s or ms")),
    }
}

/// Digits behind the point.
fn digits(cell: &str) -> i32 {
    let (mantissa, exponent) = cell
        .trim()
        .split_once(['e', 'E'])
        .map_or((cell.trim(), 0), |(m, e)| (m, e.parse().unwrap_or(0)));
    mantissa.split_once('.').map_or(0, |(_, d)| d.len() as i32) - exponent
}

/// The time between two samples, where it is the same all along, up to what the digits leave open.
fn even(times: &[(usize, f64)], resolution: f64) -> Result<f64, InputError> {
    let (Some(first), Some(last)) = (times.first(), times.last()) else { return Ok(0.0) };
    if times.len() < 2 {
        return Err(error(first.0, "a record needs at least two samples"));
    }
    for pair in times.windows(2) {
        if pair[1].1 <= pair[0].1 {
            return Err(error(
                pair[1].0,
                format!("times must increase: {} s follows {} s", pair[1].1, pair[0].1),
            )
            .hint("list samples in order of time, each once, and write times with enough digits"));
        }
    }
    let step = (last.1 - first.1) / (times.len() - 1) as f64;
    let off = |k: usize| times[k].1 - (first.1 + step * k as f64);
    // Times with so few digits that steps are unequal by more than that say nothing certain.
    let allowed = resolution.min(0.05 * step).max(1e-6 * step);
    if (0..times.len()).all(|k| off(k).abs() <= allowed) {
        return Ok(step);
    }
    // Where a step differs most from the common one.
    let mut steps: Vec<f64> = times.windows(2).map(|p| p[1].1 - p[0].1).collect();
    let wrong = {
        let mut sorted = steps.clone();
        sorted.sort_by(f64::total_cmp);
        let common = sorted[sorted.len() / 2];
        steps.iter_mut().for_each(|s| *s = (*s - common).abs());
        (0..steps.len()).max_by(|&a, &b| steps[a].total_cmp(&steps[b])).map(|k| (k, common))
    };
    let Some((k, common)) = wrong else { return Ok(step) };
    Err(error(
        times[k + 1].0,
        format!(
            "samples are not evenly spaced: {} s here, {} s elsewhere",
            base::number::short(times[k + 1].1 - times[k].1),
            base::number::short(common)
        ),
    )
    .hint("give the record an even time step: samples may be missing, or times may have too few digits"))
}
