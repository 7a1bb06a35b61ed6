//! Foreign files → [`Scene`].
//!
//! | format | what is read | a block is |
//! |---|---|---|
//! | COMPAS JSON | Assembly, CRA_Assembly, BlockModel, lists of meshes; versions 0.x, 1 and 2 | a node of the graph, an element, a mesh |
//! | OBJ | polygons as they are, objects and groups | an object, else a group, else a connected part |
//! | DXF | ASCII and binary, closed polylines, 3DFACE and polyface meshes, inserted blocks | an outline, given a depth; a body |
//! | 3DEC | `block create` (polyhedron, brick, prism, tetrahedron), `block fix`, `block property density` | a command |
//! | SVG | closed paths, polygons, rectangles, circles; layers of Inkscape | an outline, given a depth |
//! | PLY | ASCII and binary, both byte orders | a file |
//! | STL | ASCII and binary | a `solid`, a binary file |
//! | MJCF, URDF, SDF | shapes that touch of rigid bodies; what is articulated is refused | a free body with all that is welded to it; a shape that is held |
//! | glTF | text and binary, triangles; exact shapes of our own exports | a node with a mesh |
//! | Chrono bricks | rows of corners, y up; applied forces as dead loads | a row, the hull of its corners |
//! | packing list | tables (CSV) of boxes with their places, in order | a box; a stage a box |
//! | grains | tables (CSV), dumps of LIGGGHTS and LAMMPS | a sphere, a clump of them |
//!
//! Importers say what the file says: faces keep their corners and their order, nothing is welded,
//! turned or closed. Whether a block is a proper solid is judged later, by
//! `model::assembly::resolve`, for scenes of every origin alike. What a scene needs and the file
//! does not have (supports, friction) is taken from [`ImportOptions`]; what is still missing then
//! is a [`Finding`], not an error.
//!
//! Single meshes are read as well: those that the blocks of a scene name ([`read_meshes`]).
//!
//! Coordinates of the scene = rotation that brings [`ImportOptions::up`] to z ×
//! [`ImportOptions::scale`] × coordinates of the file.

mod chrono;
mod compas;
mod drawing;
mod dxf;
mod finish;
mod format;
mod gltf;
mod grains;
mod layer;
mod mesh;
mod mjcf;
mod obj;
mod options;
mod packing;
mod ply;
mod raw;
mod rigid;
mod sdf;
mod stl;
mod surface;
mod svg;
mod text;
mod threedec;
mod urdf;
mod xml;

#[cfg(test)]
mod tests;

pub use format::Format;
pub use format::{FORMATS, Known};
pub use layer::{LayerRule, Role};
pub use mesh::{Reach, read_meshes};
pub use options::{ImportOptions, Up};

use crate::Scene;
use base::{
    error::{Finding, InputError, JsonPath},
    limits,
};
use raw::Raw;
use std::path::Path;

/// A scene made from foreign files, and what is worth knowing about the way there.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The scene.
    pub scene: Scene,
    /// What was read how, what was left out, what is still missing.
    pub findings: Vec<Finding>,
    /// Where each block of the scene comes from.
    pub origins: Vec<Origin>,
    /// Files that could not be read, of several: they are not in the scene.
    pub unread: Vec<InputError>,
}

/// Where a block comes from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// The file, as the user gave it.
    pub file: String,
    /// Where the block begins there: a line, counted from 1; none in files without lines.
    pub line: Option<usize>,
    /// The line of each of its faces, where faces have lines.
    pub lines: Vec<usize>,
}

impl Origin {
    /// The place of a face, or of the block: `vault.obj:41`.
    pub fn place(&self, face: Option<usize>) -> String {
        let line = face.and_then(|f| self.lines.get(f)).or(self.line.as_ref());
        line.map_or_else(|| self.file.clone(), |line| format!("{}:{line}", self.file))
    }
}

/// Imports one file (and the files of [`ImportOptions::support_files`]).
///
/// # Errors
/// A file cannot be read or makes no sense; an option is out of its range or names a block that is
/// not there.
pub fn import_file(path: &Path, options: &ImportOptions) -> Result<Imported, InputError> {
    import_files(&[path], options)
}

/// Imports several files into one scene, in order; the files of [`ImportOptions::support_files`]
/// come last and all their blocks are supports.
///
/// Where two files use the same id, the ids of every file get its name in front (`blocks-12`), and
/// a finding says so.
///
/// Of several files one that cannot be read is left out ([`Imported::unread`]).
///
/// # Errors
/// As for [`import_file`], where no file can be read.
pub fn import_files<P: AsRef<Path>>(
    paths: &[P],
    options: &ImportOptions,
) -> Result<Imported, InputError> {
    options.check()?;
    let (mut files, mut unread) = (Vec::new(), Vec::new());
    for path in paths {
        match load(path.as_ref(), false, options) {
            Ok(file) => files.push(file),
            Err(e) => unread.push(e),
        }
    }
    if files.is_empty() && !unread.is_empty() {
        return Err(unread.remove(0));
    }
    add_support_files(&mut files, options)?;
    Ok(Imported { unread, ..finish::scene(files, options)? })
}

/// Imports a file that is already in memory; `name` stands for it in messages, its extension tells
/// the format.
///
/// # Errors
/// As for [`import_file`]; the files of [`ImportOptions::support_files`] are read here too.
pub fn import_bytes(
    name: &str,
    bytes: &[u8],
    options: &ImportOptions,
) -> Result<Imported, InputError> {
    options.check()?;
    let mut files = vec![read(name, bytes, None, false, options)?];
    add_support_files(&mut files, options)?;
    finish::scene(files, options)
}

fn add_support_files(files: &mut Vec<Raw>, options: &ImportOptions) -> Result<(), InputError> {
    for path in &options.support_files {
        files.push(load(path, true, options)?);
    }
    Ok(())
}

fn load(path: &Path, is_support: bool, options: &ImportOptions) -> Result<Raw, InputError> {
    let name = path.display().to_string();
    let bytes = limits::read_file(path, limits::PER_FOREIGN_BYTE)?;
    let folder = path.parent().unwrap_or(Path::new(""));
    read(&name, &bytes, Some(folder), is_support, options)
}

/// One file, read but not yet scaled, turned or merged with others; `folder` holds the files that it
/// names.
fn read(
    name: &str,
    bytes: &[u8],
    folder: Option<&Path>,
    is_support: bool,
    options: &ImportOptions,
) -> Result<Raw, InputError> {
    let path = Path::new(name);
    let stem =
        path.file_stem().map_or_else(|| "block".into(), |s| s.to_string_lossy().into_owned());
    let result = Format::of(path, bytes, options.format).and_then(|format| {
        let has_layers =
            matches!(format, Format::Dxf | Format::Svg | Format::ThreeDec | Format::Obj);
        if !(has_layers || options.layers.is_empty()) {
            let text = format!("rules for layers, but a {format} file has none");
            return Err(InputError::at(JsonPath::root(), text).hint(
                "choose what is held with `--support ID`, and the density with `--density`",
            ));
        }
        let mut raw = match format {
            Format::Compas => compas::read(bytes),
            Format::Obj => obj::read(bytes, &stem, options),
            Format::Dxf => dxf::read(bytes, options),
            Format::ThreeDec => threedec::read(bytes, options),
            Format::Svg => svg::read(bytes, options),
            Format::Ply => ply::read(bytes, &stem),
            Format::Stl => stl::read(bytes, &stem),
            Format::Chrono => chrono::read(bytes),
            Format::Packing => packing::read(bytes, options),
            Format::Grains => grains::read(bytes),
            Format::Mjcf => mjcf::read(bytes, folder),
            Format::Urdf => urdf::read(bytes, folder),
            Format::Sdf => sdf::read(bytes, folder),
            Format::Gltf => gltf::read(bytes, folder),
        }?;
        if raw.is_empty() {
            return Err(InputError::at(
                JsonPath::root(),
                format!("no blocks found in this {format} file"),
            )
            .hint("export the blocks as closed meshes, or grains as rows, and check that this is the right file"));
        }
        raw.stem = stem;
        raw.name = name.into();
        raw.origin = format!(
            "{} ({format})",
            path.file_name().map_or_else(|| name.into(), |f| f.to_string_lossy())
        );
        raw.blocks.iter_mut().for_each(|b| b.support |= is_support);
        raw.grains.iter_mut().for_each(|g| g.support |= is_support);
        Ok(raw)
    });
    result.map_err(|e| InputError { file: Some(name.into()), ..e })
}
