//! Reading files and standard input.

use std::path::Path;
use voussoir::{
    error::{Finding, InputError, JsonPath},
    import::{Reach, read_meshes},
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

/// A scene from a file or from standard input, with the meshes it names.
pub fn scene(path: &Path, reach: Reach) -> Result<(Scene, Source, Vec<Finding>), InputError> {
    let (name, bytes) = bytes(path)?;
    scene_of(path, name, bytes, reach)
}

/// As [`scene`], of a file that is already in memory. Paths are relative to its folder; to the current one for standard input.
pub fn scene_of(path: &Path, name: String, bytes: Vec<u8>, reach: Reach) -> Result<(Scene, Source, Vec<Finding>), InputError> {
    let (mut scene, source) = scene::read_bytes(name, bytes)?;
    let findings = read_meshes(&mut scene, path.parent().unwrap_or(Path::new("")), reach).map_err(|e| e.located(&source))?;
    Ok((scene, source, findings))
}
