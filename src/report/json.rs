//! JSON for people and programs: one member a line, but what fits on a line stays on it (points,
//! forces, faces).

use base::plain;
use serde::Serialize;
use serde_json::Value;

/// Values up to this many characters stay on one line.
const LINE: usize = 120;

/// The JSON text of a value, ending in a newline. Numbers keep every digit; what is not finite
/// becomes `null`.
///
/// # Errors
/// The value has no JSON form (a map with keys that are not text).
pub fn pretty(value: &impl Serialize) -> Result<String, serde_json::Error> {
    Ok(text(&serde_json::to_value(value)?))
}

/// The same of a JSON value.
pub fn text(value: &Value) -> String {
    let mut text = String::new();
    write(value, 0, &mut text);
    text.push('\n');
    plain::json(text)
}

fn write(value: &Value, indent: usize, out: &mut String) {
    if let Some(line) = one_line(value, LINE.saturating_sub(indent)) {
        out.push_str(&line);
        return;
    }
    let pad = " ".repeat(indent + 2);
    match value {
        Value::Object(map) => {
            for (i, (key, value)) in map.iter().enumerate() {
                out.push_str(if i == 0 { "{\n" } else { ",\n" });
                out.push_str(&format!("{pad}{}: ", Value::from(key.as_str())));
                write(value, indent + 2, out);
            }
            out.push_str(&format!("\n{}}}", &pad[2..]));
        }
        Value::Array(list) => {
            for (i, value) in list.iter().enumerate() {
                out.push_str(if i == 0 { "[\n" } else { ",\n" });
                out.push_str(&pad);
                write(value, indent + 2, out);
            }
            out.push_str(&format!("\n{}]", &pad[2..]));
        }
        scalar => out.push_str(&scalar.to_string()),
    }
}

/// The value on one line, if it fits into `room`. Gives up as soon as it does not, so that deep
/// values cost nothing.
fn one_line(value: &Value, room: usize) -> Option<String> {
    let mut line = match value {
        Value::Array(_) => "[".to_string(),
        Value::Object(_) => "{".to_string(),
        scalar => return Some(scalar.to_string()),
    };
    let member = |key: Option<&str>, value: &Value, line: &mut String| {
        if line.len() > 1 {
            line.push_str(", ");
        }
        if let Some(key) = key {
            line.push_str(&format!("{}: ", Value::from(key)));
        }
        line.push_str(&one_line(value, room.checked_sub(line.len())?)?);
        (line.len() < room).then_some(())
    };
    match value {
        Value::Array(list) => list.iter().try_for_each(|v| member(None, v, &mut line))?,
        Value::Object(map) => map.iter().try_for_each(|(k, v)| member(Some(k), v, &mut line))?,
        _ => {}
    }
    line.push(if value.is_array() { ']' } else { '}' });
    Some(line)
}

#[cfg(test)]
mod tests {
    use super::pretty;
    use serde_json::{Value, json};

    #[test]
    fn short_values_stay_on_a_line_and_long_ones_do_not() {
        let points: Vec<[f64; 3]> = (0..9).map(|i| [f64::from(i), 0.1, 1e-300]).collect();
        let value = json!({ "a": [], "b": {}, "points": points, "text": "\"ü\n", "deep": { "x": [1, [2, null]] } });
        let text = pretty(&value).unwrap();
        assert_eq!(serde_json::from_str::<Value>(&text).unwrap(), value);
        assert!(text.contains("\n    [3.0, 0.1, 1e-300],\n"), "{text}");
        assert!(text.contains("\n  \"deep\": {\"x\": [1, [2, null]]}\n}\n"), "{text}");
        assert!(text.lines().all(|l| l.len() <= 130));
    }
}
