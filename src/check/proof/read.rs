//! JSON text → [`Saved`], with errors that name file, line and column.

use super::result::Saved;
use base::error::{InputError, JsonPath};
use scene::Source;
use serde::Deserialize;

/// Whether a text calls itself a result, whatever its version.
pub fn is_result(text: &str) -> bool {
    version(text).is_some()
}

/// The version of a text that calls itself a result.
fn version(text: &str) -> Option<String> {
    #[derive(Deserialize)]
    struct Head {
        format: String,
    }
    let head = serde_json::from_str::<Head>(text.trim_start_matches('\u{feff}')).ok()?;
    head.format.strip_prefix("voussoir-result/").map(str::to_string)
}

/// Reads a result from text; `name` stands for the file in messages.
///
/// # Errors
/// The text is not JSON, or is not a result of a version this program knows.
pub fn read_str(name: impl Into<String>, text: impl Into<String>) -> Result<Saved, InputError> {
    let source = Source::new(name, text);
    if let Some(version) = version(&source.text).filter(|v| v != "3") {
        let message =
            format!("this is a result of version {version}; this program reads version 3");
        let hint = "ask the question again with --save: the scene is in the file under \"scene\" (before version 3 under scene.input)";
        return Err(InputError {
            file: Some(source.name),
            ..InputError::at(JsonPath::root(), message).hint(hint)
        });
    }
    let mut deserializer = serde_json::Deserializer::from_str(&source.text);
    serde_path_to_error::deserialize(&mut deserializer)
        .map_err(|e| (e.path().to_string(), e.into_inner()))
        .and_then(|file| deserializer.end().map(|()| file).map_err(|e| (String::new(), e)))
        .map_err(|(path, e): (String, serde_json::Error)| {
            let place =
                if path.is_empty() || path == "." { String::new() } else { format!("{path}: ") };
            // The position is given in front, once.
            let message = e.to_string();
            let message = message.split(" at line ").next().unwrap_or(&message);
            InputError {
                file: Some(source.name.clone()),
                position: Some((e.line(), e.column())),
                ..InputError::at(JsonPath::root(), format!("{place}{message}"))
                    .hint("save the result again with --save")
            }
        })
}
