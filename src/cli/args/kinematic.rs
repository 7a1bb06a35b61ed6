//! Arguments of `kinematic`.

use super::{
    By, Common, DIRECTIONS, Rocking,
    parse::{Requirement, Written, at_least_one, control, direction, finite, output, requirement},
};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct Kinematic {
    #[command(flatten)]
    pub common: Common,
    /// Direction of the earthquake; may be given several times.
    ///
    /// Only its part across gravity counts.
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, value_parser = direction)]
    pub toward: Vec<[f64; 3]>,
    /// Number of directions of the earthquake, evenly spread, the first along x.
    ///
    /// The worst direction is the answer.
    #[arg(long, value_name = "N", default_value_t = DIRECTIONS, conflicts_with = "toward", value_parser = clap::value_parser!(u16).range(1..=3600))]
    pub all: u16,
    /// Point of a free block, m, whose displacement measures the motion.
    ///
    /// By default it is the centre of mass of the block next to the centre of all masses that move.
    #[arg(long, value_name = "BLOCK=X,Y,Z", allow_hyphen_values = true, value_parser = control)]
    pub control: Option<(String, [f64; 3])>,
    /// Confidence factor, by which accelerations are divided [default: 1.35].
    #[arg(long, value_name = "FC", value_parser = at_least_one)]
    pub fc: Option<f64>,
    /// Additional displacements of the control point to report, in m.
    #[arg(long, value_name = "V1,V2,…", value_delimiter = ',', value_parser = finite)]
    pub at: Vec<f64>,
    /// Linear analysis only, without the capacity curve.
    #[arg(long, conflicts_with = "at")]
    pub linear: bool,
    /// Required α0, or `site` for the earthquake of the site, `site:0.8` for a share of it.
    ///
    /// Exit code 1 if the worst direction has less, 3 if undecided. A site is always required;
    /// unless `--law associative` is given, the α0 under dry friction must reach it too.
    #[arg(long, value_name = "ALPHA|site", allow_negative_numbers = true, value_parser = requirement)]
    pub require: Option<Requirement>,
    /// Verification that governs at the site: `linear` or `displacement`; by default both.
    ///
    /// Either may be chosen (Circolare 7/2019, C8.7.1.2.1).
    #[arg(long, value_name = "BY", value_enum, hide_possible_values = true)]
    pub verify: Option<By>,
    /// Skip the check that it stands without an earthquake.
    #[arg(long)]
    pub skip_dead: bool,
    /// Report how α0 changes with every number that was assumed.
    ///
    /// These are friction, density, strengths and loads. The derivatives follow from the proof.
    /// Where it leaves them open, both sides are computed, not proved.
    #[arg(long)]
    pub sensitivity: bool,
    #[command(flatten)]
    pub rocking: Rocking,
    /// Write directions, curve and limit states to this file (CSV).
    ///
    /// For a mechanism in time it holds the history.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv), help_heading = "Output")]
    pub csv: Option<PathBuf>,
    /// Draw the capacity curve with SLV and SLC to this file (SVG).
    ///
    /// It shows the exact curve and the straight line. For a mechanism in time it shows the
    /// displacement relative to the thickness, and the ground below.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Svg), help_heading = "Pictures")]
    pub svg: Option<PathBuf>,
}
