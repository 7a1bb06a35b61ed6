//! JSON text → [`Scene`], with errors that name file, line, column, JSON path and remedy.

use super::{Format, Scene, Source, explain};
use crate::error::{InputError, JsonPath};
use serde::Deserialize;

/// Reads a scene file.
///
/// # Errors
/// The file cannot be read, is not UTF-8, is not JSON, or is not a scene.
pub fn read_file(path: &std::path::Path) -> Result<(Scene, Source), InputError> {
    let name = path.display().to_string();
    match std::fs::read(path) {
        Ok(bytes) => read_bytes(name, bytes),
        Err(e) => Err(InputError { file: Some(name), ..InputError::at(JsonPath::root(), format!("cannot be read: {e}")) }),
    }
}

/// Reads a scene from the bytes of a file; `name` stands for the file in messages.
///
/// # Errors
/// The bytes are not UTF-8, not JSON, or not a scene.
pub fn read_bytes(name: impl Into<String>, bytes: Vec<u8>) -> Result<(Scene, Source), InputError> {
    match String::from_utf8(bytes) {
        Ok(text) => read_str(name, text),
        Err(e) => {
            let good = e.utf8_error().valid_up_to();
            let bytes = e.into_bytes();
            let source = Source::new(name, String::from_utf8_lossy(&bytes[..good]));
            let utf16 = bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]);
            let message = if utf16 { "the file is in UTF-16, not UTF-8" } else { "the file is not text in UTF-8" };
            let error = InputError::at(JsonPath::root(), message).hint("save it as UTF-8");
            Err(InputError { position: Some(source.position(source.text.len())), file: Some(source.name), ..error })
        }
    }
}

/// Reads a scene from text; `name` stands for the file in messages. A byte order mark is skipped.
///
/// # Errors
/// The text is not JSON, or is not a scene.
pub fn read_str(name: impl Into<String>, text: impl Into<String>) -> Result<(Scene, Source), InputError> {
    let source = Source::new(name, text);
    let first = source.text.trim_start().chars().next();
    if first.is_some_and(|c| c == '[' || c == '"' || c == '-' || c.is_ascii_digit()) {
        let error = InputError::at(JsonPath::root(), "a scene is a JSON object, not a list, string or number");
        return Err(error.hint("a scene starts with { \"format\": \"voussoir-scene/1\"").located(&source));
    }
    let mut deserializer = serde_json::Deserializer::from_str(&source.text);
    let scene = serde_path_to_error::deserialize(&mut deserializer).map_err(|e| {
        let path = explain::json_path(e.path());
        wrong_format(&source).unwrap_or_else(|| explain::scene_error(&source, path, e.inner()))
    })?;
    deserializer.end().map_err(|e| explain::syntax_error(&source, JsonPath::root(), &e))?;
    Ok((scene, source))
}

/// What is wrong with the key `format`, which is said before anything else: a file of another format is full of strange keys.
fn wrong_format(source: &Source) -> Option<InputError> {
    #[derive(Deserialize)]
    struct Head {
        format: Option<serde_json::Value>,
    }
    const HERE: &str = "voussoir-scene/1";
    debug_assert_eq!(serde_json::to_value(Format::V1).ok().as_ref().and_then(|v| v.as_str()), Some(HERE));
    if !source.text.trim_start().starts_with('{') {
        return None;
    }
    let head: Head = serde_json::from_str(&source.text).ok()?;
    let path = JsonPath::root().key("format");
    let error = match head.format {
        None => InputError::at(JsonPath::root(), "not a scene: the key \"format\" is missing")
            .hint(format!("add \"format\": \"{HERE}\"; `voussoir import` reads files of other programs")),
        Some(serde_json::Value::String(s)) if s == HERE => return None,
        Some(serde_json::Value::String(s)) if s.starts_with("voussoir-result/") => {
            InputError::at(path, format!("this is a result ({s:?}), not a scene")).hint("`voussoir check` reads results")
        }
        Some(other) => InputError::at(path, format!("unknown format {other}")).hint(format!("this program reads \"{HERE}\"")),
    };
    Some(error.located(source))
}
