//! JSON text → [`Scene`], with errors that name file, line, column, JSON path and remedy.

use super::{
    Scene, SceneFormat, Source,
    explain::{self, Kind},
};
use base::{
    error::{InputError, JsonPath},
    limits,
};
use serde::{Deserialize, de::DeserializeOwned};

/// Reads a scene file.
///
/// # Errors
/// The file cannot be read, is not UTF-8, is not JSON, or is not a scene.
pub fn read_file(path: &std::path::Path) -> Result<(Scene, Source), InputError> {
    read_bytes(path.display().to_string(), limits::read_file(path, limits::PER_BYTE)?)
}

/// Reads a scene from the bytes of a file; `name` stands for the file in messages.
///
/// # Errors
/// The bytes are not UTF-8, not JSON, or not a scene.
pub fn read_bytes(name: impl Into<String>, bytes: Vec<u8>) -> Result<(Scene, Source), InputError> {
    read_as(&SCENE, text(name, bytes)?)
}

/// The bytes of a file as text.
pub fn text(name: impl Into<String>, bytes: Vec<u8>) -> Result<Source, InputError> {
    match String::from_utf8(bytes) {
        Ok(text) => Ok(Source::new(name, text)),
        Err(e) => {
            let good = e.utf8_error().valid_up_to();
            let bytes = e.into_bytes();
            let source = Source::new(name, String::from_utf8_lossy(&bytes[..good]));
            let utf16 = bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]);
            let message = if utf16 {
                "the file is in UTF-16, not UTF-8"
            } else {
                "the file is not text in UTF-8"
            };
            let error = InputError::at(JsonPath::root(), message).hint("save it as UTF-8");
            Err(InputError {
                position: Some(source.position(source.text.len())),
                file: Some(source.name),
                ..error
            })
        }
    }
}

/// Reads a scene from text; `name` stands for the file in messages. A byte order mark is skipped.
///
/// # Errors
/// The text is not JSON, or is not a scene.
pub fn read_str(
    name: impl Into<String>,
    text: impl Into<String>,
) -> Result<(Scene, Source), InputError> {
    debug_assert_eq!(
        serde_json::to_value(SceneFormat::V1).ok().as_ref().and_then(|v| v.as_str()),
        Some(SCENE.format)
    );
    read_as(&SCENE, Source::new(name, text))
}

const SCENE: Kind = Kind {
    noun: "scene",
    format: "voussoir-scene/1",
    otherwise: "; `voussoir import` reads files of other programs",
};

/// Reads a JSON file of a kind.
pub fn read_as<T: DeserializeOwned>(
    kind: &Kind,
    source: Source,
) -> Result<(T, Source), InputError> {
    let first = source.text.trim_start().chars().next();
    if first.is_some_and(|c| c == '[' || c == '"' || c == '-' || c.is_ascii_digit()) {
        let error = InputError::at(
            JsonPath::root(),
            format!("a {} is a JSON object, not a list, string or number", kind.noun),
        );
        return Err(source.located(error.hint(kind.start())));
    }
    let mut deserializer = serde_json::Deserializer::from_str(&source.text);
    let value = serde_path_to_error::deserialize(&mut deserializer).map_err(|e| {
        let path = explain::json_path(e.path());
        wrong_format(kind, &source)
            .unwrap_or_else(|| explain::read_error(kind, &source, path, e.inner()))
    })?;
    deserializer.end().map_err(|e| explain::syntax_error(kind, &source, JsonPath::root(), &e))?;
    Ok((value, source))
}

/// What is wrong with the key `format`, which is said before anything else: a file of another
/// format is full of strange keys.
fn wrong_format(kind: &Kind, source: &Source) -> Option<InputError> {
    #[derive(Deserialize)]
    struct Head {
        format: Option<serde_json::Value>,
    }
    if !source.text.trim_start().starts_with('{') {
        return None;
    }
    let head: Head = serde_json::from_str(&source.text).ok()?;
    let path = JsonPath::root().key("format");
    let Kind { noun, format: here, otherwise } = kind;
    let is = |text: &str, prefix: &str| !here.starts_with(prefix) && text.starts_with(prefix);
    let error = match head.format {
        None => {
            InputError::at(JsonPath::root(), format!("not a {noun}: the key \"format\" is missing"))
                .hint(format!("add \"format\": \"{here}\"{otherwise}"))
        }
        Some(serde_json::Value::String(s)) if s == *here => return None,
        Some(serde_json::Value::String(s)) if is(&s, "voussoir-result/") => {
            InputError::at(path, format!("this is a result ({s:?}), not a {noun}"))
                .hint("`voussoir check` reads results")
        }
        Some(serde_json::Value::String(s)) if is(&s, "voussoir-sweep/") => {
            InputError::at(path, format!("this is a sweep plan ({s:?}), not a {noun}"))
                .hint("`voussoir sweep` reads plans")
        }
        Some(serde_json::Value::String(s)) if is(&s, "voussoir-scene/") => {
            InputError::at(path, format!("this is a scene ({s:?}), not a {noun}"))
                .hint("name it under the key \"scene\" of a plan")
        }
        Some(other) => InputError::at(path, format!("unknown format {other}"))
            .hint(format!("this program reads \"{here}\"")),
    };
    Some(source.located(error))
}
