//! Spheres of a table (CSV) or of a dump of LIGGGHTS or LAMMPS: columns by their names, in any order.
//!
//! `x`, `y`, `z` and `radius` (or `diameter`) are needed. `fixed` other than 0, and type 2 where
//! there is no such column, make a support; `id` names a grain. Scaled coordinates (`xs`) are no
//! lengths, and no substitute for `x`. Of a table all other columns are left out. Spheres that share
//! their `mol` (`grain` in a table) are a clump. Of a dump of several times the last one is read.

use super::{
    raw::{Grain, Raw, tally},
    text::{error, lines, shorten},
};
use base::error::{FindingCode, InputError};
use std::collections::BTreeMap;

/// Columns that are known and their other names.
const NAMES: [(&str, &[&str]); 8] = [
    ("x", &["xu"]),
    ("y", &["yu"]),
    ("z", &["zu"]),
    ("radius", &["r"]),
    ("diameter", &["d"]),
    ("fixed", &["support"]),
    ("grain", &["mol"]),
    ("type", &[]),
];

/// What a dump has that grains alone do not: earlier times, and sides that repeat themselves.
fn of_dump(head: &[(usize, String)], raw: &mut Raw) {
    let times = head.iter().filter(|(_, t)| t.starts_with("ITEM: ATOMS")).count();
    if times > 1 {
        let text = format!("times of the dump, of which the last is read: {times}");
        raw.say(FindingCode::LeftOut, text);
    }
    let bounds = head.iter().rev().find_map(|(_, t)| t.strip_prefix("ITEM: BOX BOUNDS"));
    // Tilts of the box may stand before the kinds of its sides.
    let kinds = bounds.unwrap_or_default().split_whitespace().filter(|w| w.len() == 2);
    let kinds = kinds.filter(|w| w.chars().all(|c| "pfsm".contains(c)));
    let around: Vec<&str> =
        kinds.zip(["x", "y", "z"]).filter(|(w, _)| *w == "pp").map(|(_, axis)| axis).collect();
    if !around.is_empty() {
        raw.say(
            FindingCode::LeftOut,
            format!(
                "periodic sides along {}, left out: grains do not touch across them, and those at the sides may fall",
                around.join(", ")
            ),
        );
    }
}

/// The spheres of a file.
pub(super) fn read(bytes: &[u8]) -> Result<Raw, InputError> {
    let lines = lines(bytes)?;
    let last = lines.iter().rposition(|(_, t)| t.starts_with("ITEM: ATOMS"));
    let is_dump = last.is_some();
    let (head, body) = match last {
        Some(at) => (&lines[at], &lines[at + 1..]),
        None => match lines.split_first() {
            Some((head, body)) => (head, body),
            None => return Ok(Raw::default()),
        },
    };
    let split = |text: &str| -> Vec<String> {
        let apart =
            |c: char| if is_dump { c.is_whitespace() } else { matches!(c, ',' | ';' | '\t') };
        let words = text.split(apart).map(|w| w.trim().trim_matches('"').to_string());
        words.filter(|w| !(is_dump && w.is_empty())).collect()
    };
    let titles = split(head.1.trim_start_matches("ITEM: ATOMS"));
    let column = |name: &str| {
        let others = NAMES.iter().find(|(n, _)| *n == name).map_or(&[][..], |(_, o)| o);
        titles.iter().position(|t| {
            t.eq_ignore_ascii_case(name) || others.contains(&t.to_ascii_lowercase().as_str())
        })
    };
    let needed = |name: &str| {
        column(name).ok_or_else(|| {
            error(head.0, format!("no column {name:?} among {:?}", shorten(&titles.join(", "))))
                .hint("grains need columns x, y, z (xs, ys, zs are fractions of the box, not lengths) and radius, named in the first line")
        })
    };
    let place = [needed("x")?, needed("y")?, needed("z")?];
    let (size, half) = match column("radius") {
        Some(radius) => (radius, 1.0),
        None => (column("diameter").map_or_else(|| needed("radius"), Ok)?, 0.5),
    };
    let mut raw = Raw::default();
    if let Some(at) = last {
        of_dump(&lines[..=at], &mut raw);
    }
    let mut parts: BTreeMap<String, Vec<Grain>> = BTreeMap::new();
    let mut order: Vec<String> = Vec::new();
    let mut by_type = 0;
    for (line, text) in body {
        if text.starts_with("ITEM:") {
            break;
        }
        let words = split(text);
        let number = |k: usize| -> Result<f64, InputError> {
            let word = words.get(k).map_or("", String::as_str);
            word.parse().ok().filter(|v: &f64| v.is_finite()).ok_or_else(|| {
                error(
                    *line,
                    format!("{}: expected a finite number, got {:?}", titles[k], shorten(word)),
                )
                .hint("give as many columns as the header names, and numbers with a decimal point")
            })
        };
        let at = [number(place[0])?, number(place[1])?, number(place[2])?];
        let radius = half * number(size)?;
        if radius <= 0.0 {
            return Err(error(*line, format!("the radius must be > 0, got {radius}")).hint("in m"));
        }
        let support = match (column("fixed"), column("type")) {
            (Some(k), _) => number(k)? != 0.0,
            (None, Some(k)) if is_dump => {
                let is_second = number(k)? == 2.0;
                by_type += usize::from(is_second);
                is_second
            }
            _ => false,
        };
        let id = column("id").and_then(|k| words.get(k)).cloned().unwrap_or_default();
        let id = if id.parse::<f64>().is_ok() || id.is_empty() {
            format!("g{}", if id.is_empty() { line.to_string() } else { id })
        } else {
            id
        };
        let key = column("grain")
            .and_then(|k| words.get(k))
            .filter(|w| *w != "0")
            .map_or_else(|| format!("line {line}"), |w| format!("grain {w}"));
        if !parts.contains_key(&key) {
            order.push(key.clone());
        }
        parts.entry(key).or_default().push(Grain {
            id,
            spheres: vec![(at, radius)],
            support,
            line: *line,
            ..Grain::default()
        });
    }
    let clumps = parts.values().filter(|p| p.len() > 1).count();
    for key in &order {
        let Some(part) = parts.remove(key) else { continue };
        let spheres = part.iter().flat_map(|g| g.spheres.clone()).collect();
        raw.grains.extend(part.into_iter().next().map(|first| Grain { spheres, ..first }));
    }
    let mut taken: BTreeMap<String, usize> = BTreeMap::new();
    let mut renamed = Vec::new();
    for grain in &mut raw.grains {
        let n = taken.entry(grain.id.clone()).or_default();
        *n += 1;
        if *n > 1 {
            renamed.push(grain.id.clone());
            grain.id = format!("{}-line{}", grain.id, grain.line);
        }
    }
    if !renamed.is_empty() {
        raw.say(
            FindingCode::Converted,
            format!("grains of the same name, renamed by their line: {}", tally(&renamed)),
        );
    }
    if by_type > 0 {
        raw.say(
            FindingCode::Converted,
            format!(
                "spheres of type 2, read as supports: {by_type}; add a column `fixed` to choose them yourself"
            ),
        );
    }
    if clumps > 0 {
        raw.say(FindingCode::Converted, format!("spheres of one grain, read as clumps: {clumps}"));
    }
    Ok(raw)
}
