//! Which format a file has.

use super::{
    chrono, packing, stl,
    text::{split, unmarked},
    threedec, xml,
};
use base::error::{InputError, JsonPath};
use std::{fmt, path::Path};

/// A foreign file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// JSON written by COMPAS: Assembly, CRA_Assembly, BlockModel, lists of meshes.
    Compas,
    /// Wavefront OBJ.
    Obj,
    /// Drawing exchange format (ASCII), closed outlines.
    Dxf,
    /// Commands of 3DEC that make blocks.
    ThreeDec,
    /// Scalable vector graphics, closed outlines.
    Svg,
    /// Polygon file format (Stanford).
    Ply,
    /// Stereolithography.
    Stl,
    /// Models of MuJoCo.
    Mjcf,
    /// Unified robot description format.
    Urdf,
    /// Simulation description format (Gazebo).
    Sdf,
    /// glTF 2.0, as text or binary.
    Gltf,
    /// Brick files of Chrono's masonry simulator.
    Chrono,
    /// A list of boxes with their places (CSV).
    Packing,
    /// Spheres, as a table or as a dump of LIGGGHTS or LAMMPS.
    Grains,
}

/// A format for people.
#[derive(Clone, Copy, Debug)]
pub struct Known {
    /// Which one.
    pub format: Format,
    /// What it is called.
    pub name: &'static str,
    /// Endings of its files that say so alone.
    pub endings: &'static [&'static str],
    /// What becomes a block.
    pub holds: &'static str,
    /// Arguments of `voussoir import`.
    pub example: &'static str,
}

const fn known(
    format: Format,
    name: &'static str,
    endings: &'static [&'static str],
    holds: &'static str,
    example: &'static str,
) -> Known {
    Known { format, name, endings, holds, example }
}

/// All that are read.
pub const FORMATS: [Known; 14] = [
    known(
        Format::Dxf,
        "DXF",
        &["dxf"],
        "outlines and bodies of a drawing",
        "arch.dxf --depth 0.5 --layer GROUND=support",
    ),
    known(
        Format::Svg,
        "SVG",
        &["svg"],
        "outlines of a drawing",
        "arch.svg --depth 0.5 --layer ground=support",
    ),
    known(
        Format::Obj,
        "OBJ",
        &["obj"],
        "objects, groups or connected parts",
        "vault.obj --support-below 0.1",
    ),
    known(Format::Ply, "PLY", &["ply"], "a file a block", "*.ply --support base"),
    known(
        Format::Stl,
        "STL",
        &["stl"],
        "a solid, or a file, a block",
        "*.stl --support base --scale 0.001",
    ),
    known(Format::Gltf, "glTF", &["gltf", "glb"], "nodes with a mesh", "vault.glb --support base"),
    known(Format::Compas, "COMPAS JSON", &["json"], "nodes, elements, meshes", "assembly.json"),
    known(
        Format::ThreeDec,
        "3DEC",
        &["3ddat", "3dec"],
        "commands that create blocks",
        "geometry.dat --layer base=support",
    ),
    known(Format::Mjcf, "MJCF", &["mjcf"], "bodies of MuJoCo, also as .xml", "scene.xml"),
    known(Format::Urdf, "URDF", &["urdf"], "bodies of robots", "object.urdf"),
    known(Format::Sdf, "SDF", &["sdf"], "bodies of Gazebo", "world.sdf"),
    known(
        Format::Chrono,
        "Chrono bricks",
        &[],
        "rows of corners (.txt)",
        "bricks.txt --friction 0.5",
    ),
    known(
        Format::Packing,
        "packing list",
        &["csv"],
        "boxes with their places, in order",
        "pallet.csv --friction 0.4",
    ),
    known(
        Format::Grains,
        "grains",
        &["csv", "dump", "liggghts", "lammpstrj"],
        "spheres and clumps",
        "heap.dump --friction 0.5",
    ),
];

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = FORMATS.iter().find(|k| k.format == *self).map_or("", |k| k.name);
        f.write_str(name)
    }
}

impl Format {
    /// The format the user asked for, else by the extension, else by the content.
    pub(super) fn of(
        path: &Path,
        bytes: &[u8],
        asked: Option<Format>,
    ) -> Result<Format, InputError> {
        let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
        let by_ending = || {
            let ending = ending.as_deref()?;
            let all = FORMATS.iter().filter(|k| k.endings.contains(&ending)).map(|k| k.format);
            // Boxes and spheres are both tables.
            all.into_iter().find(|f| *f != Format::Packing || packing::looks_like(bytes))
        };
        asked.or_else(by_ending).or_else(|| Format::by_content(bytes)).ok_or_else(|| {
            let names: Vec<&str> = FORMATS.iter().map(|k| k.name).collect();
            let hint = format!(
                "known formats are {}; `voussoir import` alone lists them with their endings",
                names.join(", ")
            );
            InputError::at(
                JsonPath::root(),
                "the format is unknown from both the extension and the content",
            )
            .hint(hint)
        })
    }

    fn by_content(bytes: &[u8]) -> Option<Format> {
        let text = unmarked(bytes).trim_ascii_start();
        let statement = |line: &[u8]| {
            [&b"v "[..], b"o ", b"g ", b"f ", b"mtllib "].iter().any(|s| line.starts_with(s))
        };
        if text.starts_with(b"<") {
            match xml::root(bytes)? {
                "mujoco" => Some(Format::Mjcf),
                "robot" => Some(Format::Urdf),
                "sdf" => Some(Format::Sdf),
                "svg" | "svg:svg" => Some(Format::Svg),
                _ => None,
            }
        } else if bytes.starts_with(b"glTF") || is_gltf(text) {
            Some(Format::Gltf)
        } else if text.starts_with(b"ITEM:") {
            Some(Format::Grains)
        } else if text.starts_with(b"{") || text.starts_with(b"[") {
            Some(Format::Compas)
        } else if text.starts_with(b"AutoCAD Binary DXF")
            || (text.starts_with(b"0")
                && split(text).nth(1).is_some_and(|l| l.trim_ascii() == b"SECTION"))
        {
            Some(Format::Dxf)
        } else if chrono::looks_like(text) {
            Some(Format::Chrono)
        } else if packing::looks_like(text) {
            Some(Format::Packing)
        } else if threedec::looks_like(text) {
            Some(Format::ThreeDec)
        } else if text.starts_with(b"ply\n") || text.starts_with(b"ply\r") {
            Some(Format::Ply)
        } else if stl::looks_like(bytes) || stl::looks_like(text) {
            Some(Format::Stl)
        } else if split(text).take(100).any(|line| statement(line.trim_ascii_start())) {
            Some(Format::Obj)
        } else {
            None
        }
    }
}

/// Whether a JSON text has the keys that every glTF has and files of COMPAS do not.
fn is_gltf(text: &[u8]) -> bool {
    let has = |key: &[u8]| text.windows(key.len()).any(|w| w == key);
    text.starts_with(b"{") && has(b"\"asset\"") && has(b"\"version\"") && !has(b"\"dtype\"")
}
