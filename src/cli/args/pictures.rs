//! Arguments of pictures and tables.

use super::parse::{Written, output};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use voussoir::report::drawing::Aspect;

/// Pictures of an answer.
#[derive(Debug, Args)]
pub struct Pictures {
    /// Draw the answer to this file (SVG).
    ///
    /// It shows blocks, joints, the line of thrust or chains of forces, and beside them the motion.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Svg), help_heading = "Pictures")]
    pub svg: Option<PathBuf>,
    /// Viewpoint of --svg: front, back, left, right, top, corner, or a direction.
    ///
    /// A direction is written like 1,-2,0.5. By default a plane scene is viewed along its normal,
    /// and others from a corner.
    #[arg(
        long,
        value_name = "FROM",
        requires = "svg",
        allow_hyphen_values = true,
        help_heading = "Pictures"
    )]
    pub view: Option<Aspect>,
    /// Write blocks, joints, forces and mechanisms to this file for ParaView (.vtp).
    ///
    /// Lines of thrust are included. `simulate` writes the blocks time by time, `settle` and `push`
    /// point by point (.pvd, with a folder of the same name beside it).
    #[arg(long, value_name = "FILE", help_heading = "Pictures")]
    pub vtk: Option<PathBuf>,
    /// Write a 3D model with animations to this file (.gltf or .glb, glTF 2.0).
    ///
    /// It holds the blocks as named nodes with their materials, lines of thrust, members, and every
    /// mechanism or film as an animation, for Blender, Rhino and viewers on the web.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Gltf), help_heading = "Pictures")]
    pub gltf: Option<PathBuf>,
    /// Write the displaced blocks to this file, one object per block (OBJ).
    ///
    /// The displacement is that of the mechanism, or of the end of a film. The head of the file
    /// states its size.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Obj), help_heading = "Pictures")]
    pub obj: Option<PathBuf>,
    /// Write the blocks as a model of another program to this file: MuJoCo (.xml), 3DEC (.3ddat).
    ///
    /// It holds shapes, masses, supports, gravity and friction. What it has no place for, such as
    /// loads and ties, is reported.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Model), help_heading = "Pictures")]
    pub model: Option<PathBuf>,
    /// Leave supports out of --svg, --gltf, --obj and --report.
    #[arg(long, value_name = "WHAT", value_enum, help_heading = "Pictures")]
    pub hide: Option<Hide>,
    /// Draw dimensions in --svg and --report: width and height; span, rise and thickness of bridges.
    ///
    /// They are drawn in metres, where the structure is seen from the side.
    #[arg(long, help_heading = "Pictures")]
    pub dimensions: bool,
}

/// What pictures can leave out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Hide {
    /// Blocks that are held in place.
    Supports,
}

/// Tables of an answer.
#[derive(Debug, Args)]
pub struct Tables {
    /// Write the joints with their forces to this file (CSV).
    ///
    /// The blocks are written to another file, with `.blocks` before its ending.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv), help_heading = "Output")]
    pub csv: Option<PathBuf>,
}
