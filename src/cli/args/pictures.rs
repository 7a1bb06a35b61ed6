//! Arguments of pictures and tables.

use super::parse::{Written, output};
use clap::Args;
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
}

/// Tables of an answer.
#[derive(Debug, Args)]
pub struct Tables {
    /// Write joints with their forces to this file, comma-separated, and blocks to another with
    /// `.blocks` before its ending.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv))]
    pub csv: Option<PathBuf>,
}
