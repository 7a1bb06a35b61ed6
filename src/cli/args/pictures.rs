//! Arguments of pictures and tables.

use super::parse::{Written, output};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use voussoir::report::drawing::Aspect;

/// Pictures of an answer.
#[derive(Debug, Args)]
pub struct Pictures {
    /// Draw the answer to this file: blocks, joints, line of thrust or chains of forces, and beside
    /// it how it moves.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Svg))]
    pub svg: Option<PathBuf>,
    /// From where --svg looks: front, back, left, right, top, corner, or a direction such as
    /// 1,-2,0.5; by default along the normal of a plane scene, and from a corner at others.
    #[arg(long, value_name = "FROM", requires = "svg", allow_hyphen_values = true)]
    pub view: Option<Aspect>,
    /// Write blocks, joints, forces, lines of thrust and mechanisms to this file (.vtp) for
    /// ParaView; of `simulate` the blocks, time by time, of `settle` and `push` point by point (.pvd,
    /// with a folder of the same name beside it).
    #[arg(long, value_name = "FILE")]
    pub vtk: Option<PathBuf>,
    /// Write the blocks as named nodes with their materials, lines of thrust, members, and every
    /// mechanism or film as an animation to this file, .gltf or .glb (glTF 2.0): for Blender, Rhino,
    /// and viewers on the web.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Gltf))]
    pub gltf: Option<PathBuf>,
    /// Write the blocks where the mechanism takes them, or at the end of a film, to this file, one
    /// object a block; how far it goes is said in its head.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Obj))]
    pub obj: Option<PathBuf>,
    /// Leave supports out of --svg, --gltf, --obj and --report.
    #[arg(long, value_name = "WHAT", value_enum)]
    pub hide: Option<Hide>,
}

/// What pictures can leave out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Hide {
    /// Blocks that are held.
    Supports,
}

/// Tables of an answer.
#[derive(Debug, Args)]
pub struct Tables {
    /// Write joints with their forces to this file, comma-separated, and blocks to another with
    /// `.blocks` before its ending.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv))]
    pub csv: Option<PathBuf>,
}
