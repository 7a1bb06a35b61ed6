//! Arguments of simulations.

use super::{
    Common, Ground, Pictures,
    parse::{Written, direction, finite, output, positive},
};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct Simulate {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub pictures: Pictures,
    /// Fast steps only: reliable if 3 % or more away from a limit.
    #[arg(long, conflicts_with = "fine")]
    pub fast: bool,
    /// Fine steps only: reliable if 1 % or more away from a limit, at four times the cost.
    ///
    /// By default fine steps follow unless fast ones show that it stands.
    #[arg(long)]
    pub fine: bool,
    /// Longest simulated time, in s; by default ten times √(height / gravity).
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = positive)]
    pub seconds: Option<f64>,
    /// Continue to the end even if the outcome is clear.
    #[arg(long)]
    pub to_the_end: bool,
    /// Add this factor × the live loads.
    #[arg(long, value_name = "LAMBDA", default_value_t = 0.0, allow_negative_numbers = true, value_parser = finite)]
    pub load_factor: f64,
    /// Threads of the simulation; 0 for one per processor.
    ///
    /// The answer does not depend on them.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(0..=256), help_heading = "Solver and limits")]
    pub threads: u16,
    #[command(flatten)]
    pub ground: Ground,
    /// Direction in which the ground moves [default: 1,0].
    ///
    /// Only its part across gravity counts.
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, value_parser = direction)]
    pub toward: Option<[f64; 3]>,
    /// On moving ground: draw displacements of blocks and ground to this file (SVG).
    ///
    /// It shows the blocks that displace most, relative to their thickness, and the ground below
    /// them.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Svg), help_heading = "Pictures")]
    pub chart: Option<PathBuf>,
    /// Write the position of every block, time by time, to this file (CSV).
    ///
    /// It is written while the simulation runs. On moving ground it holds the displacement of every
    /// block relative to its thickness.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv), help_heading = "Output")]
    pub csv: Option<PathBuf>,
    /// Number of times kept in --csv and, if given, in the result of --json and --save.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000), help_heading = "Output")]
    pub frames: Option<u32>,
    /// Skip the verdict to compare with.
    #[arg(long)]
    pub skip_verdict: bool,
}
