//! Reading files and standard input.

use super::{claim, exit::TimeIsUp, progress::Stage};
use std::{collections::BTreeSet, path::Path};
use voussoir::{
    deadline::Deadline,
    error::{Finding, InputError, JsonPath},
    import::{Reach, read_meshes},
    interface::{Model, prepare_until},
    limits,
    scene::{self, Scene, Shape, Source},
};

/// The bytes of a file, or of standard input for `-`, with a name for messages. No output may go to
/// the file.
pub fn bytes(path: &Path) -> anyhow::Result<(String, Vec<u8>)> {
    claim::read(path)?;
    Ok(read(path)?)
}

/// As [`bytes`], of a file that holds text.
pub fn text(path: &Path) -> anyhow::Result<(String, String)> {
    let (name, bytes) = bytes(path)?;
    let source = scene::text(name, bytes)?;
    Ok((source.name, source.text))
}

fn read(path: &Path) -> Result<(String, Vec<u8>), InputError> {
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
pub fn scene(path: &Path, reach: Reach) -> anyhow::Result<(Scene, Source, Vec<Finding>)> {
    let (name, bytes) = bytes(path)?;
    scene_of(path, name, bytes, reach)
}

/// As [`scene`], of a file that is already in memory. Paths are relative to its folder; to the
/// current one for standard input.
pub fn scene_of(
    path: &Path,
    name: String,
    bytes: Vec<u8>,
    reach: Reach,
) -> anyhow::Result<(Scene, Source, Vec<Finding>)> {
    let (mut scene, source) = scene::read_bytes(name, bytes)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let findings = read_meshes(&mut scene, folder, reach).map_err(|e| source.located(e))?;
    let meshes = scene.blocks.iter().filter_map(|b| match &b.shape {
        Shape::Mesh { path, .. } => Some(folder.join(path)),
        _ => None,
    });
    meshes.collect::<BTreeSet<_>>().iter().try_for_each(|mesh| claim::read(mesh))?;
    Ok((scene, source, findings))
}

/// The scene resolved, with its interfaces; errors have their place in what was read of it.
pub fn prepared(
    scene: &Scene,
    source: Option<&Source>,
    deadline: Deadline,
) -> anyhow::Result<Model> {
    let _stage = Stage::begin(true, "looking for contacts");
    let is_over = || deadline.is_over();
    prepare_until(scene, &is_over).map_err(|e| match (is_over(), source) {
        (true, _) => TimeIsUp(e.to_string()).into(),
        (false, Some(source)) => source.located(e).into(),
        (false, None) => e.into(),
    })
}
