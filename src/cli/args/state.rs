//! Arguments of `state`.

use super::{
    Common, Pictures,
    parse::{Written, control, finite, output},
};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct State {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub pictures: Pictures,
    /// The point of a free block, m, whose way along the live load is the curve [default: the centre of
    /// mass of the block with the greatest live load].
    #[arg(long, value_name = "BLOCK=X,Y,Z", allow_hyphen_values = true, value_parser = control)]
    pub control: Option<(String, [f64; 3])>,
    /// Load factors that become points of the curve, beside others.
    #[arg(long, value_name = "L1,L2,…", value_delimiter = ',', value_parser = finite)]
    pub at: Vec<f64>,
    /// Where joints with an area are integrated: `area`, exactly over the part that is pressed;
    /// `corners`, at the corners of each joint, as the state under dry friction of the other questions
    /// has it (three times too stiff against turning).
    #[arg(long, value_enum, value_name = "WHERE", default_value_t = Quadrature::Area, hide_possible_values = true)]
    pub quadrature: Quadrature,
    /// The state under the dead load alone, although there is a live load.
    #[arg(long, conflicts_with_all = ["control", "at", "require", "chart"])]
    pub dead_only: bool,
    /// The load factor that is needed: exit code 1 if that of the path is below.
    #[arg(long, value_name = "LAMBDA", allow_negative_numbers = true, value_parser = finite)]
    pub require: Option<f64>,
    /// Write the curve to this file, comma-separated, a row a point; without a live load the joints, a
    /// row a joint.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv))]
    pub csv: Option<PathBuf>,
    /// Draw load factor against displacement to this file (SVG).
    #[arg(long, value_name = "FILE", value_parser = output(Written::Svg))]
    pub chart: Option<PathBuf>,
}

/// Where joints are integrated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Quadrature {
    Area,
    Corners,
}

impl From<Quadrature> for voussoir::elastic::Quadrature {
    fn from(q: Quadrature) -> Self {
        match q {
            Quadrature::Area => Self::Area,
            Quadrature::Corners => Self::Corners,
        }
    }
}
