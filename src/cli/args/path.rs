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
    /// How supports move while the parameter goes from 0 to 1: their way in m and their turn about
    /// their centres of mass in degrees (axis × angle), or `out:D`, D metres outwards: horizontally
    /// away from the mean of the centres of mass of all supports that the name fits. `*` stands for
    /// any letters of a name.
    #[arg(long = "move", value_name = "SUPPORT=DX,DY,DZ[,RX,RY,RZ]|out:D", required_unless_present = "cracks", allow_hyphen_values = true, value_parser = support_move)]
    pub moves: Vec<SupportMove>,
    /// The other way round: which movement of which support explains these cracks, in a file like
    /// { "cracks": [ { "between": ["v03", "v04"], "side": "intrados", "width": 0.004 } ] }. Sides are
    /// "intrados", "extrados" or a point near them; widths, m, may be left out.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["moves", "at", "csv", "chart", "from", "keep", "svg", "vtk", "save", "report"])]
    pub cracks: Option<PathBuf>,
    /// Shares of the movement that become points of the curve, beside others.
    #[arg(long, value_name = "S1,S2,…", value_delimiter = ',', value_parser = finite)]
    pub at: Vec<f64>,
    #[command(flatten)]
    pub curve: Curve,
}

#[derive(Debug, Args)]
pub struct Push {
    #[command(flatten)]
    pub common: Common,
    /// The point of a free block, m, whose way is the parameter.
    #[arg(long, value_name = "BLOCK=X,Y,Z", allow_hyphen_values = true, value_parser = control)]
    pub control: (String, [f64; 3]),
    /// The direction in which its way is measured.
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, value_parser = direction)]
    pub toward: [f64; 3],
    /// Ways of the control point, m, that become the points of the curve, beside its start, its events
    /// and its end; without them the points follow its bends.
    #[arg(long, value_name = "V1,V2,…", value_delimiter = ',', value_parser = finite)]
    pub at: Vec<f64>,
    #[command(flatten)]
    pub curve: Curve,
}

/// The curve as a file.
#[derive(Debug, Args)]
pub struct Curve {
    /// Write the curve to this file, comma-separated, a row a point.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv))]
    pub csv: Option<PathBuf>,
    /// Draw the curve to this file (SVG).
    #[arg(long, value_name = "FILE", value_parser = output(Written::Svg))]
    pub chart: Option<PathBuf>,
    /// Begin at the last pose of this result, which was saved for the same scene and motion: how much
    /// further it goes.
    #[arg(long, value_name = "RESULT")]
    pub from: Option<PathBuf>,
    /// Keep every point in this file as soon as it is proved; the same command takes it up again
    /// after a kill at any point.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Lines))]
    pub keep: Option<PathBuf>,
    #[command(flatten)]
    pub pictures: Pictures,
}
