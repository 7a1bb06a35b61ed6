//! Arguments of `stages`.

use super::{
    Common, Pictures,
    parse::{Written, direction, output},
};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct Stages {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub pictures: Pictures,
    /// In place of the stages of the scene: which of its free blocks can be taken out, one at a time.
    /// Pictures show them by colour.
    #[arg(long)]
    pub remove_each: bool,
    /// Tilts towards this direction (its part across gravity); may be given several times.
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, conflicts_with = "remove_each", value_parser = direction)]
    pub toward: Vec<[f64; 3]>,
    /// Tilts towards this many directions, evenly spread, the first along x [default: 8].
    #[arg(long, value_name = "N", conflicts_with_all = ["toward", "remove_each"], value_parser = clap::value_parser!(u16).range(1..=3600))]
    pub all: Option<u16>,
    /// No load factors and no tilts: verdicts alone.
    #[arg(long, conflicts_with_all = ["toward", "all", "remove_each", "chart"])]
    pub skip_margin: bool,
    /// No least forces on what stages hold.
    #[arg(long, conflicts_with = "remove_each")]
    pub skip_held: bool,
    /// Write the stages to this file, comma-separated, a row a stage.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv))]
    pub csv: Option<PathBuf>,
    /// Draw the margins, stage by stage, to this file (SVG).
    #[arg(long, value_name = "FILE", conflicts_with = "remove_each", value_parser = output(Written::Svg))]
    pub chart: Option<PathBuf>,
}
