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
    /// Point of a free block, m, whose displacement along the live load is the curve.
    ///
    /// By default it is the centre of mass of the block with the greatest live load.
    #[arg(long, value_name = "BLOCK=X,Y,Z", allow_hyphen_values = true, value_parser = control)]
    pub control: Option<(String, [f64; 3])>,
    /// Additional load factors to report.
    #[arg(long, value_name = "L1,L2,…", value_delimiter = ',', value_parser = finite)]
    pub at: Vec<f64>,
    /// How joints with an area are integrated: `area` or `corners`.
    ///
    /// `area` integrates exactly over the part in compression. `corners` integrates at the corners
    /// of each joint, like the state under dry friction in the other questions (three times too
    /// stiff in rotation).
    #[arg(long, value_enum, value_name = "WHERE", default_value_t = Quadrature::Area, hide_possible_values = true, help_heading = "Solver and limits")]
    pub quadrature: Quadrature,
    /// Compute the state under the dead load alone, even if there is a live load.
    #[arg(long, conflicts_with_all = ["control", "at", "require", "chart"])]
    pub dead_only: bool,
    /// Required load factor: exit code 1 if that of the path is lower.
    #[arg(long, value_name = "LAMBDA", allow_negative_numbers = true, value_parser = finite)]
    pub require: Option<f64>,
    /// Write the curve to this file, one point per row (CSV).
    ///
    /// Without a live load it holds the joints, one per row.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv), help_heading = "Output")]
    pub csv: Option<PathBuf>,
    /// Draw the load factor against the displacement to this file (SVG).
    #[arg(long, value_name = "FILE", value_parser = output(Written::Svg), help_heading = "Pictures")]
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
