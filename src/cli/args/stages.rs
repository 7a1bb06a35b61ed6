//! Arguments of `stages`.

use super::{
    Common, Pictures,
    parse::{Written, direction, output},
};
use clap::{ArgGroup, Args};
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(group = ArgGroup::new("asks_order").args(["any_order", "order"]))]
pub struct Stages {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub pictures: Pictures,
    /// In place of the stages of the scene: an order in which its free blocks can be placed one by one
    /// so that it stands all the time, with as few of them held as can be.
    #[arg(long)]
    pub any_order: bool,
    /// The same for a given order: every free block once, first placed first, `*` for any letters of a
    /// name (all of these in the order of the scene). What has to be held is sought.
    #[arg(long, value_name = "ID,…", value_delimiter = ',', conflicts_with = "any_order")]
    pub order: Vec<String>,
    /// So many blocks can be held at a time: the exit code says whether that is enough [default: any
    /// number].
    #[arg(long, value_name = "N", requires = "asks_order")]
    pub hands: Option<usize>,
    /// Sets of blocks that the search for the least holds looks at, at most, of every structure
    /// that stands by itself [default: 5000].
    #[arg(long, value_name = "N", requires = "asks_order", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub tries: Option<u32>,
    /// Tilts towards this direction (its part across gravity); may be given several times.
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, conflicts_with_all = ["any_order", "order"], value_parser = direction)]
    pub toward: Vec<[f64; 3]>,
    /// Tilts towards this many directions, evenly spread, the first along x [default: 8].
    #[arg(long, value_name = "N", conflicts_with_all = ["toward", "any_order", "order"], value_parser = clap::value_parser!(u16).range(1..=3600))]
    pub all: Option<u16>,
    /// No load factors and no tilts: verdicts alone.
    #[arg(long, conflicts_with_all = ["toward", "all", "any_order", "order", "chart"])]
    pub skip_margin: bool,
    /// No least forces on what stages hold.
    #[arg(long)]
    pub skip_held: bool,
    /// Write the stages to this file, comma-separated, a row a stage.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv))]
    pub csv: Option<PathBuf>,
    /// Draw the margins, stage by stage, to this file (SVG).
    #[arg(long, value_name = "FILE", conflicts_with_all = ["any_order", "order"], value_parser = output(Written::Svg))]
    pub chart: Option<PathBuf>,
}
