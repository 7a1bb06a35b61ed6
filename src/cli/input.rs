//! Reading files and standard input.

use std::path::Path;
use voussoir::{
    error::{InputError, JsonPath},
    limits,
    scene::{self, Scene, Source},
};

/// The bytes of a file, or of standard input for `-`, with a name for messages.
pub fn bytes(path: &Path) -> Result<(String, Vec<u8>), InputError> {
    if path.as_os_str() != "-" {
        return Ok((path.display().to_string(), limits::read_file(path, limits::PER_BYTE)?));
    }
    let name = "standard input".to_string();
    let bytes = match limits::read(std::io::stdin().lock(), limits::PER_BYTE) {
        Ok(bytes) => bytes,
        Err(e) => Err(InputError::at(JsonPath::root(), format!("cannot be read: {e}"))),
    };
    match bytes {
        Ok(bytes) => Ok((name, bytes)),
        Err(e) => Err(InputError { file: Some(name), ..e }),
    }
}

/// A scene from a file or from standard input.
pub fn scene(path: &Path) -> Result<(Scene, Source), InputError> {
    let (name, bytes) = bytes(path)?;
    scene::read_bytes(name, bytes)
}
