//! What a file says compared with what is derived, leaf by leaf: words exactly, numbers to what
//! arithmetic of another machine may change.

use serde::Serialize;
use serde_json::Value;
use std::collections::HashMap;

/// Numbers agree to this share of themselves; of a vector, of its greatest component. Larger: changed
/// digits pass. Smaller: honest results of another machine are refused.
const SAME: f64 = 1e-9;
/// What this share of the greatest number in the same place is, is rounding of sums. Larger: small
/// numbers can be changed. Smaller: forces that cancel differ from machine to machine.
const ROUNDING: f64 = 1e-12;
/// Numbers that are themselves what is left of cancelling ones, with the size below which they are
/// rounding: of `equilibrium_error` in multiples of gravity, of residuals in shares of what they are left of.
const LEFT: [(&str, f64); 2] = [("equilibrium_error", 1e-9), ("residuals", 1e-9)];
/// Grades, which are sizes of rounding errors.
const GRADES: [&str; 2] = ["to_rounding", "natural_map"];
/// A grade is another one on another machine: as good within this factor. Larger: a worse proof is
/// called a better one.
const GRADE: f64 = 4.0;
/// Grades below this are those of doubles themselves.
const FINEST: f64 = 1e-15;

/// Where two values differ, as a JSON path from the top; nothing where they agree.
pub fn first_difference<T: Serialize>(said: &T, here: &T) -> Option<String> {
    let json = |v: &T| serde_json::to_value(v).unwrap_or_default();
    difference(&json(said), &json(here))
}

/// The same of two JSON values; `here` sets the scales.
pub fn difference(said: &Value, here: &Value) -> Option<String> {
    let mut own = Compare { scales: HashMap::new() };
    own.scale(here, "");
    own.values(said, here, (String::new(), ""), 0.0)
}

struct Compare {
    /// The greatest number by place, whatever its position in a list.
    scales: HashMap<String, f64>,
}

impl Compare {
    fn scale(&mut self, value: &Value, place: &str) {
        match value {
            Value::Number(n) => {
                let size = n.as_f64().unwrap_or(0.0).abs();
                match self.scales.get_mut(place) {
                    Some(all) => *all = all.max(size),
                    None => drop(self.scales.insert(place.to_string(), size)),
                }
            }
            Value::Array(list) => list.iter().for_each(|v| self.scale(v, place)),
            Value::Object(map) => {
                map.iter().for_each(|(k, v)| self.scale(v, &format!("{place}.{k}")));
            }
            _ => {}
        }
    }

    fn values(
        &self,
        said: &Value,
        here: &Value,
        (at, place): (String, &str),
        vector: f64,
    ) -> Option<String> {
        match (said, here) {
            (Value::Number(a), Value::Number(b)) => {
                let (a, b) = (a.as_f64().unwrap_or(f64::NAN), b.as_f64().unwrap_or(f64::NAN));
                (!self.near(a, b, place, vector)).then_some(at)
            }
            (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
                let size = |v: &Value| v.as_f64().unwrap_or(0.0).abs();
                let vector = b.iter().map(size).fold(0.0, f64::max);
                a.iter()
                    .zip(b)
                    .enumerate()
                    .find_map(|(k, (a, b))| self.values(a, b, (format!("{at}/{k}"), place), vector))
            }
            (Value::Object(a), Value::Object(b)) => {
                let other = a.keys().find(|k| !b.contains_key(*k));
                if let Some(k) = other.or_else(|| b.keys().find(|k| !a.contains_key(*k))) {
                    return Some(format!("{at}/{k}"));
                }
                a.iter().zip(b.values()).find_map(|((k, a), first)| {
                    let b = b.get(k).unwrap_or(first);
                    self.values(a, b, (format!("{at}/{k}"), &format!("{place}.{k}")), 0.0)
                })
            }
            (a, b) => (a != b).then_some(at),
        }
    }

    fn near(&self, a: f64, b: f64, place: &str, vector: f64) -> bool {
        if a == b {
            return true;
        }
        if place.rsplit('.').next().is_some_and(|key| GRADES.contains(&key)) {
            return a.min(b) >= 0.0 && a.max(b) <= GRADE * a.min(b).max(FINEST);
        }
        let is = |(key, _): &&(&str, f64)| place.split('.').any(|part| part == *key);
        let left = LEFT.iter().find(is).map_or(0.0, |l| l.1);
        let greatest = self.scales.get(place).copied().unwrap_or(0.0);
        (a - b).abs() <= SAME * a.abs().max(b.abs()).max(vector) + ROUNDING * greatest + left
    }
}

#[cfg(test)]
mod tests {
    use super::difference;
    use serde_json::json;

    #[test]
    fn rounding_is_no_difference_and_all_else_is_one() {
        let here = json!({
            "a": 1.0, "force": [1e6, 1e-4, 0.0], "word": "stable", "proof": { "to_rounding": 1e-12 },
            "equilibrium_error": { "upper": 1e-15 }, "list": [{ "f": 1e9 }, { "f": 1e-6 }],
            "natural_map": 1e-7,
        });
        let at = |pointer: &str, value: serde_json::Value| {
            let mut said = here.clone();
            *said.pointer_mut(pointer).unwrap() = value;
            difference(&said, &here)
        };
        for (pointer, value) in [
            ("/a", json!(1.0 + 1e-10)),
            ("/force/1", json!(2e-4)),
            ("/equilibrium_error/upper", json!(9e-15)),
            ("/list/1/f", json!(1e-4)),
            ("/proof/to_rounding", json!(2e-12)),
        ] {
            assert_eq!(at(pointer, value.clone()), None, "{pointer} {value}");
        }
        for (pointer, value) in [
            ("/a", json!(1.0 + 1e-8)),
            ("/a", json!("1.0")),
            ("/force/1", json!(1.0)),
            ("/word", json!("unstable")),
            ("/equilibrium_error/upper", json!(1e-8)),
            ("/list/0", json!({})),
            ("/list", json!([])),
            ("/proof/to_rounding", json!(1e-13)),
            ("/proof", json!("exact")),
            ("/natural_map", json!(5e-324)),
            ("/natural_map", json!(-1e-7)),
        ] {
            assert_eq!(
                at(pointer, value.clone()).as_deref().map(|p| p.starts_with(pointer)),
                Some(true),
                "{pointer} {value}"
            );
        }
        let mut more = here.clone();
        more["b"] = json!(null);
        assert_eq!(difference(&more, &here).as_deref(), Some("/b"));
        assert_eq!(difference(&here, &more).as_deref(), Some("/b"));
    }
}
