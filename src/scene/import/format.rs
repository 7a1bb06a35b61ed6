//! Which format a file has.

use super::{
    stl,
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
    /// Spheres, as a table or as a dump of LIGGGHTS or LAMMPS.
    Grains,
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Format::Compas => "COMPAS JSON",
            Format::Obj => "OBJ",
            Format::Dxf => "DXF",
            Format::ThreeDec => "3DEC",
            Format::Svg => "SVG",
            Format::Ply => "PLY",
            Format::Stl => "STL",
            Format::Mjcf => "MJCF",
            Format::Urdf => "URDF",
            Format::Sdf => "SDF",
            Format::Gltf => "glTF",
            Format::Grains => "grains",
        })
    }
}

impl Format {
    /// The format the user asked for, else by the extension, else by the content.
    pub(super) fn of(
        path: &Path,
        bytes: &[u8],
        asked: Option<Format>,
    ) -> Result<Format, InputError> {
        let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
        asked
            .or(match extension.as_deref() {
                Some("json") => Some(Format::Compas),
                Some("obj") => Some(Format::Obj),
                Some("dxf") => Some(Format::Dxf),
                Some("3ddat" | "3dec") => Some(Format::ThreeDec),
                Some("svg") => Some(Format::Svg),
                Some("ply") => Some(Format::Ply),
                Some("stl") => Some(Format::Stl),
                Some("gltf" | "glb") => Some(Format::Gltf),
                Some("csv" | "dump" | "liggghts" | "lammpstrj") => Some(Format::Grains),
                _ => None,
            })
            .or_else(|| Format::by_content(bytes))
            .ok_or_else(|| {
                InputError::at(JsonPath::root(), "the format is unknown from both the extension and the content")
                    .hint("known formats are COMPAS JSON, OBJ, DXF, SVG, 3DEC, PLY, STL, glTF, MJCF, URDF, SDF, and tables or dumps of grains; name the file .json, .obj, .dxf, .svg, .3ddat, .ply, .stl, .gltf, .glb, .csv or .dump; the root of an XML file is <mujoco>, <robot> or <sdf>")
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
