//! An error of a scene as a page shows it: its words, its place, the line it stands in.

use crate::{error::InputError, scene::Source};
use serde_json::{Value, json};

/// So many characters of a line are shown on either side of the place: a mesh on one line is not
/// sent whole.
const AROUND: usize = 70;

/// The error with the line of `text` it points at and the column of the pointer there, from 0.
pub fn value(error: &InputError, text: &str) -> Value {
    let excerpt = error.position.and_then(|(line, column)| {
        let whole: Vec<char> = text.lines().nth(line.checked_sub(1)?)?.chars().collect();
        let at = column.saturating_sub(1).min(whole.len());
        let from = at.saturating_sub(AROUND);
        let shown: String = whole[from..whole.len().min(at + AROUND)].iter().collect();
        Some(json!({ "line": line, "column": column, "text": shown, "at": at - from }))
    });
    json!({
        "text": error.message,
        "path": if error.path.0.is_empty() { String::new() } else { error.path.to_string() },
        "hint": error.hint,
        "excerpt": excerpt,
    })
}

/// The error, located in the text it is about.
pub fn located(error: InputError, source: &Source) -> InputError {
    if error.position.is_some() || error.path.0.is_empty() {
        return error;
    }
    source.located(error)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::read_str;

    #[test]
    fn the_pointer_stands_below_the_value() {
        let text = "{ \"format\": \"voussoir-scene/1\",\n  \"gravity\": [0, 0, \"x\"] }";
        let shown = value(&read_str("s", text).unwrap_err(), text);
        let line = shown["excerpt"]["text"].as_str().unwrap();
        let at = usize::try_from(shown["excerpt"]["at"].as_u64().unwrap()).unwrap();
        assert_eq!(&line[at..at + 3], "\"x\"", "{shown}");
        assert_eq!(shown["excerpt"]["line"], 2);
    }
}
