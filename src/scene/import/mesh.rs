//! The files that blocks of a scene name: `{ "mesh": { "path": "stone.obj" } }`.
//!
//! A scene may come from anybody, and its paths with it. So a path stays within the folder of the
//! scene, links resolved, unless the user says otherwise ([`Reach`]); it is opened from there
//! without following a link, so that what was looked at is what is read. Only regular files are
//! opened ([`files`]). What is read is put into the scene, as the file has it: from there on the
//! scene needs no file, and neither does a result that holds it.

use super::{Format, raw::list, read, rigid, text::shorten};
use crate::{Scene, Shape};
use base::{
    error::{Finding, InputError, JsonPath},
    files, limits,
};
use std::{
    collections::HashMap,
    fs::File,
    io,
    path::{Component, Path, PathBuf},
};

/// Which files a scene may name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reach {
    /// Those in its own folder and in the folders below.
    #[default]
    Folder,
    /// Any.
    Anywhere,
}

/// One file, as it was read.
struct Mesh {
    vertices: Vec<[f64; 3]>,
    faces: Vec<Vec<usize>>,
    /// Bytes of the file.
    length: u64,
}

/// Reads the files that the blocks of a scene name, into the scene; `folder` is where the scene
/// lies. Blocks whose mesh is there already are left alone. Each file is read once; returned is
/// what is worth knowing about the reading.
///
/// # Errors
/// A path leaves the folder, names no regular file, or the file is no single mesh; paths are those
/// of the blocks.
pub fn read_meshes(
    scene: &mut Scene,
    folder: &Path,
    reach: Reach,
) -> Result<Vec<Finding>, InputError> {
    let mut known: HashMap<PathBuf, Mesh> = HashMap::new();
    let mut findings = Vec::new();
    let mut total = 0_u64;
    for (k, block) in scene.blocks.iter_mut().enumerate() {
        let Shape::Mesh { path: name, vertices, faces, .. } = &mut block.shape else { continue };
        if !(vertices.is_empty() && faces.is_empty()) {
            continue;
        }
        let place = JsonPath::root().key("blocks").index(k).key("shape").key("mesh").key("path");
        let refuse = |e: InputError| {
            // The reader's line is one of the mesh, not of the scene.
            let line = e.position.map_or(String::new(), |(line, _)| format!("line {line}: "));
            InputError {
                hint: e.hint,
                ..InputError::at(
                    place.clone(),
                    format!("block {:?}: {name}: {line}{}", block.id, e.message),
                )
            }
        };
        let file = find(folder, Path::new(name.as_str()), reach).map_err(refuse)?;
        if !known.contains_key(&file.path) {
            let (mesh, said) =
                file.open().and_then(|opened| load(&opened, name)).map_err(refuse)?;
            findings.extend(
                said.into_iter().map(|f| Finding { text: format!("{name}: {}", f.text), ..f }),
            );
            known.insert(file.path.clone(), mesh);
        }
        let Some(mesh) = known.get(&file.path) else { continue };
        // A thousand blocks may name one file: each has its own copy.
        total = total.saturating_add(mesh.length);
        limits::afford("the meshes up to this one", total, limits::PER_FOREIGN_BYTE)
            .map_err(refuse)?;
        (*vertices, *faces) = (mesh.vertices.clone(), mesh.faces.clone());
    }
    Ok(findings)
}

/// The one mesh of a file that another file names, within the folder of that one; with what is worth
/// knowing.
///
/// # Errors
/// There is no folder, for the file is in memory; the path leaves it, or names no single mesh.
pub(super) fn beside(
    folder: Option<&Path>,
    name: &str,
) -> Result<(rigid::Mesh, Vec<Finding>), InputError> {
    let read = || load(&opened_beside(folder, name)?, name);
    let (mesh, said) = read().map_err(|e| of_file(name, e))?;
    let named = |f: Finding| Finding { text: format!("{name}: {}", f.text), ..f };
    let mesh = rigid::Mesh { vertices: mesh.vertices, faces: mesh.faces };
    Ok((mesh, said.into_iter().map(named).collect()))
}

/// The bytes of a file that another file names, within the folder of that one.
///
/// # Errors
/// There is no folder, for the file is in memory; the path leaves it, or cannot be read.
pub(super) fn bytes_beside(folder: Option<&Path>, name: &str) -> Result<Vec<u8>, InputError> {
    let read = || limits::read_opened(&opened_beside(folder, name)?, limits::PER_FOREIGN_BYTE);
    read().map_err(|e| of_file(name, e))
}

fn opened_beside(folder: Option<&Path>, name: &str) -> Result<File, InputError> {
    let Some(folder) = folder else {
        let e = InputError::at(JsonPath::root(), "not at hand, for its scene is read from memory");
        return Err(e.hint("import from the file itself, with what it names beside it"));
    };
    let found = find(folder, Path::new(name), Reach::Folder).and_then(|file| file.open());
    found.map_err(|e| match e.hint.as_deref() {
        Some(OUTSIDE) => e.hint("put the file beside the scene"),
        _ => e,
    })
}

/// The error with the file that it is about, which is not the one being read.
fn of_file(name: &str, e: InputError) -> InputError {
    let place = e.position.map_or(String::new(), |(line, column)| format!(" {line}:{column}:"));
    let message = format!("file {:?}:{place} {}", shorten(name), e.message);
    InputError { message, position: None, ..e }
}

/// A file that is meant.
struct Meant {
    /// Its whole path, without links on the way.
    path: PathBuf,
    /// The folder that it must not leave, and the way from there.
    below: Option<(PathBuf, PathBuf)>,
}

impl Meant {
    /// Opens it, unless something else has come in its place since it was found.
    fn open(&self) -> Result<File, InputError> {
        match &self.below {
            None => files::open(&self.path),
            Some((folder, way)) => files::open_below(folder, way),
        }
        .map_err(missing)
    }
}

/// The file that a path means.
fn find(folder: &Path, path: &Path, reach: Reach) -> Result<Meant, InputError> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    // First by the letters alone, so that files elsewhere are not even asked for.
    if reach == Reach::Folder && leaves(path) {
        return Err(outside("the path leaves the folder of the scene"));
    }
    let file = folder.join(path).canonicalize().map_err(missing)?;
    if reach == Reach::Anywhere {
        return Ok(Meant { path: file, below: None });
    }
    let folder = folder.canonicalize().map_err(missing)?;
    match file.strip_prefix(&folder) {
        Ok(way) if way.as_os_str().is_empty() => Ok(Meant { path: file, below: None }),
        Ok(way) => Ok(Meant { below: Some((folder, way.to_path_buf())), path: file }),
        Err(_) => Err(outside("a link leads out of the folder of the scene")),
    }
}

/// Whether a path is absolute or has more steps up than down before them.
fn leaves(path: &Path) -> bool {
    let mut depth = 0_usize;
    path.components().any(|step| match step {
        Component::Prefix(_) | Component::RootDir => true,
        Component::CurDir => false,
        Component::Normal(_) => {
            depth += 1;
            false
        }
        Component::ParentDir => match depth.checked_sub(1) {
            Some(less) => {
                depth = less;
                false
            }
            None => true,
        },
    })
}

fn outside(what: &str) -> InputError {
    InputError::at(JsonPath::root(), format!("{what}, and is not followed")).hint(OUTSIDE)
}

const OUTSIDE: &str =
    "put the file beside the scene, or give --allow-outside if you trust the scene";

fn missing(e: io::Error) -> InputError {
    InputError::at(JsonPath::root(), format!("cannot be read: {e}"))
        .hint("the path is relative to the folder of the scene")
}

/// The one mesh of a file.
fn load(file: &File, name: &str) -> Result<(Mesh, Vec<Finding>), InputError> {
    let bytes = limits::read_opened(file, limits::PER_FOREIGN_BYTE)?;
    let error = |text: String, hint: &str| Err(InputError::at(JsonPath::root(), text).hint(hint));
    let format = Format::of(Path::new(name), &bytes, None)?;
    if !matches!(format, Format::Obj | Format::Ply | Format::Stl) {
        let what = if format == Format::Compas { "JSON".into() } else { format.to_string() };
        return error(
            format!("this is {what}, not a mesh"),
            "name an OBJ, PLY or STL file; `voussoir import` makes scenes of other files",
        );
    }
    let raw = read(name, &bytes, None, false, &Default::default())?;
    let names: Vec<String> = raw.blocks.iter().map(|b| format!("{:?}", b.id)).collect();
    let mut blocks = raw.blocks.into_iter();
    let (Some(solid), None) = (blocks.next(), blocks.next()) else {
        let text =
            format!("the file has {} meshes ({}), a block takes one", names.len(), list(&names));
        return error(
            text,
            "split the file, or make a scene of all of them with `voussoir import`",
        );
    };
    Ok((
        Mesh { vertices: solid.vertices, faces: solid.faces, length: bytes.len() as u64 },
        raw.findings,
    ))
}
