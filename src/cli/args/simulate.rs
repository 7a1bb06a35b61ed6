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
    /// Fast steps only: to be trusted 3 % away from a limit.
    #[arg(long, conflicts_with = "fine")]
    pub fast: bool,
    /// Fine steps only: to be trusted 1 % away from a limit, at four times the cost. By default
    /// fine steps follow unless fast ones show that it stands.
    #[arg(long)]
    pub fine: bool,
    /// Time to simulate at most, in seconds of the scene; by default ten times √(height / gravity).
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = positive)]
    pub seconds: Option<f64>,
    /// Go on to the end although the outcome is clear.
    #[arg(long)]
    pub to_the_end: bool,
    /// Add this factor × the live loads.
    #[arg(long, value_name = "LAMBDA", default_value_t = 0.0, allow_negative_numbers = true, value_parser = finite)]
    pub load_factor: f64,
    /// Threads of the simulation; 0 for as many as there are processors. The answer does not depend
    /// on them.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(0..=256))]
    pub threads: u16,
    #[command(flatten)]
    pub ground: Ground,
    /// The direction in which the ground moves (its part across gravity) [default: 1,0].
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, value_parser = direction)]
    pub toward: Option<[f64; 3]>,
    /// On ground that moves: draw the ways of the blocks that go farthest, over their thickness,
    /// and the ground below them to this file.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Svg))]
    pub chart: Option<PathBuf>,
    /// Write where every block is, time by time, to this file as it happens; on ground that moves
    /// the way of every block over its thickness.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv))]
    pub csv: Option<PathBuf>,
    /// So many times are kept in --csv, and in the result of --json and --save if given.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub frames: Option<u32>,
    /// Do not ask for the verdict to compare with.
    #[arg(long)]
    pub skip_verdict: bool,
}
