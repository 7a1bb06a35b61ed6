//! Arguments of `kinematic`.

use super::{
    Common, DIRECTIONS, Rocking,
    parse::{Written, at_least_one, control, direction, finite, output},
};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct Kinematic {
    #[command(flatten)]
    pub common: Common,
    /// An earthquake towards this direction (its part across gravity); may be given several times.
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, value_parser = direction)]
    pub toward: Vec<[f64; 3]>,
    /// Earthquakes towards this many directions, evenly spread, the first along x; the worst is the
    /// answer.
    #[arg(long, value_name = "N", default_value_t = DIRECTIONS, conflicts_with = "toward", value_parser = clap::value_parser!(u16).range(1..=3600))]
    pub all: u16,
    /// The point of a free block, m, whose way measures the motion; by default the centre of mass
    /// of the block next to the centre of all masses that move.
    #[arg(long, value_name = "BLOCK=X,Y,Z", allow_hyphen_values = true, value_parser = control)]
    pub control: Option<(String, [f64; 3])>,
    /// Factor of confidence, by which accelerations are divided [default: 1.35].
    #[arg(long, value_name = "FC", value_parser = at_least_one)]
    pub fc: Option<f64>,
    /// Ways of the control point, m, that become points of the curve, beside others.
    #[arg(long, value_name = "V1,V2,…", value_delimiter = ',', value_parser = finite)]
    pub at: Vec<f64>,
    /// The linear analysis alone: no curve.
    #[arg(long, conflicts_with = "at")]
    pub linear: bool,
    /// The α0 that is needed: exit code 1 if that of the worst direction, with dry friction too
    /// unless --law associative, is below, 3 if that stays open.
    #[arg(long, value_name = "ALPHA", allow_negative_numbers = true, value_parser = finite)]
    pub require: Option<f64>,
    /// Do not ask as well whether it stands without an earthquake.
    #[arg(long)]
    pub skip_dead: bool,
    #[command(flatten)]
    pub rocking: Rocking,
    /// Write directions, curve and limit states to this file, comma-separated; of a mechanism in
    /// time its history.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv))]
    pub csv: Option<PathBuf>,
    /// Draw the capacity curve to this file: exact and straight, SLV and SLC; of a mechanism in time
    /// its way over the thickness, and the ground below.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Svg))]
    pub svg: Option<PathBuf>,
}
