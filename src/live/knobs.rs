//! The numbers of a scene that one may vary, with a range that makes sense to begin with.

use super::desk::Edits;
use crate::error::{InputError, JsonPath};
use serde_json::{Value, json};

/// A page lists no more numbers than this.
const MOST: usize = 240;

/// Parts of a scene whose numbers are offered. Corners of blocks are not: there are thousands.
const PARTS: [&str; 5] = ["templates", "joints", "loads", "materials", "members"];

/// The numbers of a scene as it is written: pointer, value, range, whether it is a count.
pub fn knobs(scene: &Value) -> Vec<Value> {
    let mut list = Vec::new();
    for part in PARTS {
        if let Some(value) = scene.get(part) {
            walk(value, &mut vec![part.to_string()], &mut list);
        }
    }
    list.truncate(MOST);
    list
}

fn walk(value: &Value, path: &mut Vec<String>, list: &mut Vec<Value>) {
    let mut deeper = |key: String, value: &Value| {
        path.push(key);
        walk(value, path, list);
        path.pop();
    };
    match value {
        Value::Object(map) => map.iter().for_each(|(k, v)| deeper(k.clone(), v)),
        Value::Array(all) => all.iter().enumerate().for_each(|(k, v)| deeper(k.to_string(), v)),
        Value::Number(number) => {
            if let Some(v) = number.as_f64().filter(|v| v.is_finite()) {
                let (low, high) = range(path, v);
                let whole = number.is_u64() && counts(path);
                list.push(json!({
                    "pointer": pointer(path), "label": label(path), "value": v,
                    "low": low, "high": high, "whole": whole,
                }));
            }
        }
        Value::Null | Value::Bool(_) | Value::String(_) => {}
    }
}

fn pointer(path: &[String]) -> String {
    path.iter().map(|p| format!("/{}", p.replace('~', "~0").replace('/', "~1"))).collect()
}

/// The place in words: the first of a list without its number, components by their axis.
fn label(path: &[String]) -> String {
    const VECTORS: [&str; 6] = ["at", "force", "moment", "weight", "acceleration", "direction"];
    let words = path.windows(2).filter_map(|w| match w[1].parse::<usize>() {
        Ok(k) if VECTORS.contains(&w[0].as_str()) => Some((*["x", "y", "z"].get(k)?).to_string()),
        Ok(0) => None,
        Ok(k) => Some((k + 1).to_string()),
        Err(_) => Some(w[1].replace('_', " ")),
    });
    words.collect::<Vec<_>>().join(" ")
}

/// Numbers that are counts: a template of 13.5 voussoirs is none.
fn counts(path: &[String]) -> bool {
    const COUNTS: [&str; 8] =
        ["voussoirs", "courses", "blocks", "count", "lunes", "rings", "spans", "per_course"];
    let last = path.last().map_or("", String::as_str);
    COUNTS.iter().any(|c| last.contains(c))
}

/// A range to begin with; any number can be typed.
fn range(path: &[String], v: f64) -> (f64, f64) {
    let last = path.last().map_or("", String::as_str);
    let place = path.iter().any(|p| p == "at" || p == "road") || last == "x" || last == "z";
    match v {
        _ if last == "friction" => (0.0, (2.0 * v).max(1.5)),
        _ if place => (v - v.abs().max(1.0), v + v.abs().max(1.0)),
        0.0 => (-1.0, 1.0),
        _ if counts(path) => (1.0, (3.0 * v).max(2.0)),
        v if v > 0.0 => (0.2 * v, 3.0 * v),
        v => (3.0 * v, 0.2 * v),
    }
}

/// Forces whose place is given as a point: these can be dragged.
pub fn loads(scene: &Value) -> Vec<Value> {
    let mut list = Vec::new();
    for kind in ["dead", "live"] {
        let loads = scene.get("loads").and_then(|l| l.get(kind)).and_then(Value::as_array);
        for (k, load) in loads.into_iter().flatten().enumerate() {
            if let (Some(at), Some(_), None) =
                (load.get("at").filter(|a| a.is_array()), load.get("block"), load.get("arm"))
            {
                list.push(json!({ "pointer": format!("/loads/{kind}/{k}"), "at": at }));
            }
        }
    }
    list
}

/// A scene with values changed. Only what is there can be changed, and only to its like: a number to
/// a number, a word to a word, a point to a point.
///
/// # Errors
/// The first change that leads nowhere or to something else.
pub fn change(scene: &mut Value, edits: &Edits) -> Result<(), InputError> {
    let refuse = |text: String| Err(InputError::at(JsonPath::root(), text));
    for (pointer, value) in edits {
        match scene.pointer_mut(pointer) {
            Some(old) if alike(old, value) => *old = value.clone(),
            Some(_) => return refuse(format!("{pointer}: {value} has the wrong type")),
            None => return refuse(format!("{pointer}: no such value in the scene")),
        }
    }
    Ok(())
}

fn alike(a: &Value, b: &Value) -> bool {
    match (a, b) {
        (Value::Array(a), Value::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| alike(a, b))
        }
        // A coefficient of friction may be the word "infinite".
        (Value::String(word), Value::Number(_)) => word == "infinite",
        (Value::Number(_), Value::Number(_)) | (Value::String(_), Value::String(_)) => true,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_found_and_changed_to_their_like() {
        let mut scene = json!({ "templates": [{ "arch": { "thickness": 0.5, "voussoirs": 27, "pinned": true } }],
            "joints": { "default": { "friction": 0.7 } }, "loads": { "live": [{ "block": "k", "at": [0, 0, 1], "force": [0, 0, -1] }] },
            "blocks": [{ "density": 1 }] });
        let list = knobs(&scene);
        let of = |pointer: &str| list.iter().find(|k| k["pointer"] == pointer).unwrap();
        assert_eq!(list.len(), 9);
        assert_eq!(of("/templates/0/arch/voussoirs")["whole"], true);
        assert_eq!(of("/joints/default/friction")["low"], 0.0);
        assert_eq!(of("/templates/0/arch/thickness")["label"], "arch thickness");
        assert_eq!(of("/loads/live/0/at/2")["label"], "live at z");
        for knob in &list {
            let [v, low, high] = ["value", "low", "high"].map(|k| knob[k].as_f64().unwrap());
            assert!(low <= v && v <= high && low < high, "{knob}");
        }
        assert_eq!(loads(&scene)[0]["pointer"], "/loads/live/0");
        let edits = |p: &str, v: Value| Edits::from([(p.to_string(), v)]);
        change(&mut scene, &edits("/templates/0/arch/thickness", 0.25.into())).unwrap();
        change(&mut scene, &edits("/loads/live/0/at", json!([1, 0, 1]))).unwrap();
        assert_eq!(scene["templates"][0]["arch"]["thickness"], 0.25);
        for (pointer, value) in [
            ("/templates/0/arch/thickness", json!("x")),
            ("/templates/0/arch/none", json!(1)),
            ("/loads/live/0/at", json!([1])),
            ("/templates/0/arch/pinned", json!(1)),
        ] {
            assert!(change(&mut scene, &edits(pointer, value)).is_err(), "{pointer}");
        }
    }
}
