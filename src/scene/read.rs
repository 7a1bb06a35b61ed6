//! JSON text → [`Scene`], with errors that name file, line, column and JSON path.

use super::Scene;
use crate::error::InputError;

/// The text a scene was read from, kept to say where an error lies.
#[derive(Clone, Debug)]
pub struct Source {
    /// File name as given by the user.
    pub name: String,
    /// The text.
    pub text: String,
}

/// Reads a scene file.
///
/// # Errors
/// The file cannot be read, is not JSON, or is not a scene.
pub fn read_file(path: &std::path::Path) -> Result<(Scene, Source), InputError> {
    let name = path.display().to_string();
    let text = std::fs::read_to_string(path).map_err(|e| InputError::at(Default::default(), format!("{name}: {e}")))?;
    read_str(name, text)
}

/// Reads a scene from text; `name` stands for the file in messages.
///
/// # Errors
/// The text is not JSON, or is not a scene.
pub fn read_str(name: impl Into<String>, text: impl Into<String>) -> Result<(Scene, Source), InputError> {
    let source = Source { name: name.into(), text: text.into() };
    let scene = serde_json::from_str(&source.text).map_err(|e| InputError::at(Default::default(), e.to_string()))?;
    Ok((scene, source))
}
