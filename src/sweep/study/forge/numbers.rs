//! Single numbers of what is claimed, made tiny, huge, negative, a little different, or no numbers.

use super::{Forgery, Honest, edit::Draft};
use crate::study::random::Random;
use serde_json::{Value, json};

/// Where claimed numbers are.
const CLAIMED: [&str; 9] = [
    "/answer/load_factor",
    "/answer/tan_tilt",
    "/answer/tilt_deg",
    "/answer/critical",
    "/certificate/claim",
    "/directions",
    "/dry",
    "/critical/flips",
    "/thrust",
];
/// Numbers below these names are evidence, or of no size of their own.
const OTHERS: [&str; 13] = [
    "forces",
    "base",
    "rates",
    "points",
    "couples",
    "unbalance",
    "standing",
    "direction",
    "toward",
    "natural_map",
    "solves",
    "sections",
    "to_rounding",
];
/// How many of them are changed.
const CHANGED: usize = 4;
/// A change of less than this × the number may still be true.
const MATERIAL: f64 = 1e-3;
/// Numbers below this are rounding of ones that are 0.
const LEAST: f64 = 1e-5;

/// A few numbers, each changed in every way.
pub(super) fn forge(honest: &Honest, random: &mut Random) -> Vec<Forgery> {
    let mut all = Vec::new();
    for pointer in CLAIMED {
        if let Some(value) = honest.file.pointer(pointer) {
            leaves(value, pointer.into(), &mut all);
        }
    }
    let mut made = Vec::new();
    for _ in 0..CHANGED.min(all.len()) {
        let (pointer, value) = all.swap_remove(random.count(0, all.len() - 1));
        let numbers = [
            0.0,
            -0.0,
            5e-324,
            1e-170,
            -value,
            value * (1.0 + 2.0 * MATERIAL),
            2.0 * value,
            value * 2f64.powi(600),
            1e300,
        ];
        let numbers = numbers
            .into_iter()
            .filter(|v| v.is_finite() && (v - value).abs() > MATERIAL * value.abs());
        // To have been seen at rest below the value, or to move above it, may be true.
        let (rests, moves) = (pointer.ends_with("/rests_at"), pointer.ends_with("/moves_at"));
        let decides = honest
            .file
            .pointer(&pointer.replace("/rests_at", "/value").replace("/moves_at", "/value"))
            .and_then(Value::as_f64);
        let lies = |v: &f64| {
            !(rests || moves)
                || decides.is_some_and(|value| if rests { *v > value } else { *v < value })
        };
        let numbers = numbers.into_iter().filter(lies);
        let odd = if rests || moves { &[][..] } else { &[Value::Null][..] };
        for other in numbers
            .map(Value::from)
            .chain(odd.iter().cloned())
            .chain([json!("NaN"), json!("Infinity")])
        {
            // A bracket or a value that is left out may claim less, which is no lie where nothing
            // else is said.
            let what = format!("{pointer}: {other} instead of {value}");
            made.extend(Draft::of(honest).set(&pointer, other).done(honest, "number", what));
        }
    }
    made
}

fn leaves(value: &Value, pointer: String, out: &mut Vec<(String, f64)>) {
    match value {
        Value::Object(map) => {
            for (key, value) in map.iter().filter(|(k, _)| !OTHERS.contains(&k.as_str())) {
                leaves(value, format!("{pointer}/{key}"), out);
            }
        }
        Value::Array(list) => list
            .iter()
            .enumerate()
            .for_each(|(k, value)| leaves(value, format!("{pointer}/{k}"), out)),
        Value::Number(n) => {
            out.extend(n.as_f64().filter(|v| v.abs() > LEAST).map(|v| (pointer, v)))
        }
        _ => {}
    }
}
