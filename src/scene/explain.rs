//! The reader's errors, in words for people: serde's messages name Rust types and no remedy.

use super::{Source, suggest::suggest};
use base::error::{InputError, JsonPath, Step};
use serde::de::IgnoredAny;
use serde_json::error::Category;
use serde_path_to_error::Segment;

/// A kind of file, in the words of its errors.
pub struct Kind {
    /// What it is called: "scene".
    pub noun: &'static str,
    /// The value of its key `format`.
    pub format: &'static str,
    /// What else could help where that key is missing.
    pub otherwise: &'static str,
}

impl Kind {
    pub(super) fn start(&self) -> String {
        format!("a {} starts with {{ \"format\": {:?}", self.noun, self.format)
    }
}

/// Nothing that is read nests deeper; the path of a text that does is cut off here.
const DEEPEST: usize = 10;

fn too_deep(kind: &Kind) -> String {
    format!("a {} has at most {DEEPEST} levels", kind.noun)
}

/// The path of a failed read. Steps that serde cannot name end the path.
pub(super) fn json_path(path: &serde_path_to_error::Path) -> JsonPath {
    let steps = path.iter().take(DEEPEST).map_while(|segment| match segment {
        Segment::Seq { index } => Some(Step::Index(*index)),
        Segment::Map { key } => Some(Step::Key(key.clone())),
        Segment::Enum { variant } => Some(Step::Key(variant.clone())),
        Segment::Unknown => None,
    });
    JsonPath(steps.collect())
}

/// Why the text is not what was expected.
pub(super) fn read_error(
    kind: &Kind,
    source: &Source,
    path: JsonPath,
    error: &serde_json::Error,
) -> InputError {
    // A rotation as three angles: where their list begins is what is wrong.
    let turned = path.0.iter().rposition(|s| matches!(s, Step::Key(k) if k == "rotation_deg"));
    if let Some(k) = turned.filter(|k| matches!(path.0.get(k + 1), Some(Step::Index(_)))) {
        let path = JsonPath(path.0[..=k].to_vec());
        let error = InputError::at(path, "a rotation is an axis and an angle, not a list")
            .hint("write { \"axis\": [0, 0, 1], \"angle\": 45 } for 45° about z");
        let position = source.locate(&error.path);
        return InputError { file: Some(source.name.clone()), position, ..error };
    }
    match error.classify() {
        Category::Data => data_error(source, path, error),
        // The reader says "syntax" also where good JSON has too many elements or keys for the type
        // it is read into.
        _ if serde_json::from_str::<IgnoredAny>(&source.text).is_ok() => {
            misfit(kind, source, path, error)
        }
        _ => syntax_error(kind, source, path, error),
    }
}

/// Good JSON that does not fit, reported by serde_json as a matter of syntax.
fn misfit(kind: &Kind, source: &Source, path: JsonPath, error: &serde_json::Error) -> InputError {
    let message = bare(error);
    let value = value_at(source, &path);
    let result = match (&*message, &value) {
        ("number out of range", _) => {
            InputError::at(path, "the number is too large for a 64-bit float")
                .hint("numbers must be finite, at most 1.8e308")
        }
        (_, Some(serde_json::Value::Array(list))) => {
            InputError::at(path, format!("too many elements: {}", list.len()))
                .hint("a point or vector has 3, a prism's corner 2, a pair 2")
        }
        (_, Some(serde_json::Value::Object(map))) => {
            let keys: Vec<String> = map.keys().map(|k| format!("{k:?}")).collect();
            let found = if keys.is_empty() { "none".into() } else { keys.join(", ") };
            InputError::at(path, format!("needs exactly one kind, got {found}"))
                .hint("for example { \"box\": { \"size\": [1, 1, 1] } } for a shape")
        }
        ("recursion limit exceeded", _) => {
            InputError::at(path, "lists or objects are nested too deeply").hint(too_deep(kind))
        }
        _ => InputError::at(path, message),
    };
    let raw = source.position(source.offset(error.line(), error.column()));
    let position = source.locate(&result.path).unwrap_or(raw);
    InputError { file: Some(source.name.clone()), position: Some(position), ..result }
}

/// Text that is not JSON.
pub(super) fn syntax_error(
    kind: &Kind,
    source: &Source,
    path: JsonPath,
    error: &serde_json::Error,
) -> InputError {
    let offset = if error.classify() == Category::Eof {
        source.text.len()
    } else {
        source.offset(error.line(), error.column())
    };
    let rest = source.text.get(offset..).unwrap_or("");
    let message = bare(error);
    let word: String = rest.chars().take_while(|c| c.is_alphanumeric()).collect();
    let word = word.to_lowercase();
    let (message, hint) = if source.text.trim().is_empty() {
        ("the file is empty".into(), Some(kind.start()))
    } else if error.classify() == Category::Eof {
        (
            "the file ends in the middle of a value".into(),
            Some("it is cut off, or a closing bracket or quote is missing".into()),
        )
    } else if ["nan", "inf", "infinity"].contains(&word.as_str()) {
        let remedy = "JSON has no NaN or infinity: give a finite number";
        ("must be a finite number".into(), Some(remedy.into()))
    } else {
        let before = source.text.get(..offset).unwrap_or("").chars().next_back();
        let hint = match word.as_str() {
            "true" | "false" | "none" | "null" => Some("write true, false and null in lower case"),
            _ if rest.starts_with('\'') => Some("write strings in double quotes"),
            _ if rest.starts_with('/') || rest.starts_with('#') => Some("JSON has no comments"),
            _ if rest.starts_with('+')
                || rest.starts_with('.')
                || before.is_some_and(|c| c.is_ascii_digit() || c == '.' || c == '-') =>
            {
                Some("write numbers like -0.5 or 1e-3")
            }
            _ => None,
        };
        let hint = hint.map(String::from);
        match message.as_str() {
            "trailing comma" => {
                ("a comma before a closing bracket".into(), Some("remove the comma".into()))
            }
            "trailing characters" => {
                let noun = kind.noun;
                (
                    format!("text after the end of the {noun}"),
                    Some(format!(
                        "one file holds one {noun}: remove what follows its closing brace"
                    )),
                )
            }
            "recursion limit exceeded" => {
                ("lists or objects are nested too deeply".into(), Some(too_deep(kind)))
            }
            "expected `,` or `}`" | "expected `,` or `]`" => (
                format!("not JSON: {message}"),
                hint.or(Some("a comma or a closing bracket is missing before this point".into())),
            ),
            "expected value" => ("not JSON: expected a value".into(), hint),
            "key must be a string" => ("not JSON: expected a key in double quotes".into(), hint),
            m if m.starts_with("control character") => (
                "not JSON: a line break or control character inside a string".into(),
                Some("close the quotes, or write \\n".into()),
            ),
            _ => (format!("not JSON: {message}"), hint),
        }
    };
    InputError {
        file: Some(source.name.clone()),
        position: Some(source.position(offset)),
        path,
        message,
        hint,
    }
}

/// Kinds of shapes, which are often written where the key "shape" belongs.
const SHAPES: [&str; 7] = ["box", "polyhedron", "mesh", "prism", "sphere", "clump", "plane"];

/// Kinds of shapes that other programs have, and what stands in for them.
const ROUND: [&str; 5] = ["cylinder", "capsule", "cone", "ellipsoid", "disc"];
const STAND_IN: &str = "spheres are the only round shapes: use a \"prism\" or \"polyhedron\" with enough sides for a body on flat ends (it does not roll), or a \"clump\" of spheres for one that rolls";

/// JSON whose keys or types are not those expected.
fn data_error(source: &Source, path: JsonPath, error: &serde_json::Error) -> InputError {
    let message = bare(error);
    let mut at_key = false;
    let result = if message.starts_with("unknown field") {
        at_key = true;
        let key = last_key(&path).unwrap_or_default();
        let listed: Vec<&str> = expected(&message).collect();
        let hint = match listed.contains(&"shape") && SHAPES.contains(&key.as_str()) {
            true => format!("write \"shape\": {{ \"{key}\": {{ … }} }}"),
            false => {
                suggest(&key, listed).map_or("remove it".into(), |s| format!("{s} (or remove it)"))
            }
        };
        InputError::at(path, "unknown key").hint(hint)
    } else if let Some(rest) = message.strip_prefix("unknown variant `") {
        let word = rest.rsplit_once("`, expected").map_or(rest, |(w, _)| w);
        let inner = path.key(word);
        at_key = source.locate(&inner).is_some();
        let hint = ROUND.contains(&word).then(|| STAND_IN.into());
        let hint = hint.or_else(|| suggest(word, expected(&message)));
        let error =
            InputError::at(if at_key { inner } else { path }, format!("unknown kind {word:?}"));
        InputError { hint, ..error }
    } else if let Some(rest) = message.strip_prefix("missing field `") {
        let key = rest.trim_end_matches('`');
        InputError::at(path, format!("the key {key:?} is missing"))
            .hint(format!("add \"{key}\": …"))
    } else if let Some(rest) = message.strip_prefix("duplicate field `") {
        at_key = true;
        InputError::at(path.key(rest.trim_end_matches('`')), "the key is given twice")
            .hint("keep one of them")
    } else if message.starts_with("invalid type: unit variant") {
        let kind = last_key(&path).unwrap_or_default();
        let parent = JsonPath(path.0[..path.0.len().saturating_sub(1)].to_vec());
        InputError::at(parent, format!("{kind:?} lacks its values"))
            .hint(format!("write {{ \"{kind}\": {{ … }} }}"))
    } else if let Some((got, wanted)) =
        message.strip_prefix("invalid type: ").and_then(|m| m.split_once(", expected "))
    {
        let error = InputError::at(path, format!("expected {}, got {}", plain(wanted), plain(got)));
        InputError { hint: type_hint(got, wanted).map(Into::into), ..error }
    } else if let Some((got, wanted)) =
        message.strip_prefix("invalid value: ").and_then(|m| m.split_once(", expected "))
    {
        InputError::at(path, format!("expected {}, got {}", plain(wanted), plain(got)))
    } else if let Some((got, wanted)) = message
        .strip_prefix("invalid length ")
        .and_then(|m| m.split_once(", expected an array of length "))
    {
        InputError::at(path, format!("expected {wanted} elements, got {got}"))
    } else if message == super::joint::GIVEN_TWICE {
        at_key = true;
        InputError::at(path, message).hint("keep one of them")
    } else {
        InputError::at(path, message)
    };
    let position =
        if at_key { source.locate_key(&result.path) } else { source.locate(&result.path) };
    let raw = source.position(source.offset(error.line(), error.column()));
    InputError {
        file: Some(source.name.clone()),
        position: Some(position.unwrap_or(raw)),
        ..result
    }
}

/// serde_json's message without its position.
fn bare(error: &serde_json::Error) -> String {
    let message = error.to_string();
    message.rsplit_once(" at line ").map_or(message.clone(), |(m, _)| m.to_owned())
}

/// The names in backticks after the last "expected".
fn expected(message: &str) -> impl Iterator<Item = &str> {
    let list = message.rsplit_once("expected ").map_or("", |(_, list)| list);
    list.split('`').skip(1).step_by(2)
}

fn last_key(path: &JsonPath) -> Option<String> {
    match path.0.last() {
        Some(Step::Key(key)) => Some(key.clone()),
        _ => None,
    }
}

/// serde's names of types, in the words of JSON.
fn plain(words: &str) -> String {
    match words {
        "f64" => "a number".into(),
        "usize" | "u64" | "u32" => "a whole number >= 0".into(),
        "a sequence" => "a list".into(),
        "sequence" => "a list".into(),
        "map" | "a map" => "an object".into(),
        _ if words.starts_with("struct ") || words.starts_with("enum ") => "an object".into(),
        _ => match words.strip_prefix("an array of length ") {
            Some(n) => format!("a list of {n}"),
            None => words.replace('`', ""),
        },
    }
}

fn type_hint(got: &str, wanted: &str) -> Option<&'static str> {
    if got.starts_with("string") && matches!(wanted, "f64" | "usize") {
        return Some("write numbers without quotes");
    }
    if got == "null" && wanted == "f64" {
        return Some("many programs write NaN and infinity as null: give a finite number");
    }
    None
}

fn value_at(source: &Source, path: &JsonPath) -> Option<serde_json::Value> {
    let root: serde_json::Value = serde_json::from_str(&source.text).ok()?;
    path.0
        .iter()
        .try_fold(&root, |value, step| match step {
            Step::Key(key) => value.get(key),
            Step::Index(index) => value.get(index),
        })
        .cloned()
}
