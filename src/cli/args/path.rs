//! Arguments of `settle` and `push`.

use super::{
    Common, Pictures,
    parse::{Written, control, direction, finite, output, support_move},
};
use clap::Args;
use std::path::PathBuf;
use voussoir::analysis::SupportMove;

#[derive(Debug, Args)]
pub struct Settle {
    #[command(flatten)]
    pub common: Common,
    /// Imposed movement of a support while the parameter goes from 0 to 1.
    ///
    /// DX,DY,DZ is the displacement in m and RX,RY,RZ the rotation about the centre of mass in
    /// degrees (axis × angle). `out:D` moves the support D metres outwards: horizontally away from
    /// the mean of the centres of mass of all supports that the name matches. `*` stands for any
    /// letters of a name.
    #[arg(long = "move", value_name = "SUPPORT=DX,DY,DZ[,RX,RY,RZ]|out:D", required_unless_present = "cracks", allow_hyphen_values = true, value_parser = support_move)]
    pub moves: Vec<SupportMove>,
    /// Find the imposed movement of a support that explains the cracks in this file.
    ///
    /// The file looks like { "cracks": [ { "between": ["v03", "v04"], "side": "intrados", "width":
    /// 0.004 } ] }. Sides are "intrados", "extrados" or a point near the crack. Widths, in m, are
    /// optional.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["moves", "at", "csv", "chart", "from", "keep", "svg", "vtk", "save", "report"])]
    pub cracks: Option<PathBuf>,
    /// Additional shares of the movement to report.
    #[arg(long, value_name = "S1,S2,…", value_delimiter = ',', value_parser = finite)]
    pub at: Vec<f64>,
    #[command(flatten)]
    pub curve: Curve,
}

#[derive(Debug, Args)]
pub struct Push {
    #[command(flatten)]
    pub common: Common,
    /// Point of a free block, m, whose displacement is the parameter.
    #[arg(long, value_name = "BLOCK=X,Y,Z", allow_hyphen_values = true, value_parser = control)]
    pub control: (String, [f64; 3]),
    /// Direction in which the displacement is measured.
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, value_parser = direction)]
    pub toward: [f64; 3],
    /// Displacements of the control point to report, in m.
    ///
    /// They are reported in addition to the start, the events and the end. By default the points
    /// follow the bends of the curve.
    #[arg(long, value_name = "V1,V2,…", value_delimiter = ',', value_parser = finite)]
    pub at: Vec<f64>,
    #[command(flatten)]
    pub curve: Curve,
}

/// The curve as a file.
#[derive(Debug, Args)]
pub struct Curve {
    /// Write the curve to this file, one point per row (CSV).
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv), help_heading = "Output")]
    pub csv: Option<PathBuf>,
    /// Draw the curve to this file (SVG).
    #[arg(long, value_name = "FILE", value_parser = output(Written::Svg), help_heading = "Pictures")]
    pub chart: Option<PathBuf>,
    /// Continue from the last pose of this result.
    ///
    /// The result must have been saved for the same scene and motion. The answer is how much
    /// further it goes.
    #[arg(long, value_name = "RESULT")]
    pub from: Option<PathBuf>,
    /// Checkpoint to this file; run the same command again to resume.
    ///
    /// Every point is written as soon as it is proved, so the run may be interrupted at any moment.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Lines), help_heading = "Output")]
    pub keep: Option<PathBuf>,
    #[command(flatten)]
    pub pictures: Pictures,
}
