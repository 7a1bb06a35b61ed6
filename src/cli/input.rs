//! Reading files and standard input.

use std::{io::Read, path::Path};
use voussoir::{
    error::{InputError, JsonPath},
    scene::{self, Scene, Source},
};

/// The bytes of a file, or of standard input for `-`, with a name for messages.
pub fn bytes(path: &Path) -> Result<(String, Vec<u8>), InputError> {
    let mut bytes = Vec::new();
    let (name, result) = if path.as_os_str() == "-" {
        ("standard input".to_string(), std::io::stdin().lock().read_to_end(&mut bytes).map(drop))
    } else {
        (path.display().to_string(), std::fs::read(path).map(|b| bytes = b))
    };
    match result {
        Ok(()) => Ok((name, bytes)),
        Err(e) => Err(InputError { file: Some(name), ..InputError::at(JsonPath::root(), format!("cannot be read: {e}")) }),
    }
}

/// A scene from a file or from standard input.
pub fn scene(path: &Path) -> Result<(Scene, Source), InputError> {
    let (name, bytes) = bytes(path)?;
    scene::read_bytes(name, bytes)
}
