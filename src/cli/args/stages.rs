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
    /// Find an order of placing the free blocks one by one in which it always stands.
    ///
    /// It is asked in place of the stages of the scene. As few blocks as possible are held.
    #[arg(long)]
    pub any_order: bool,
    /// Examine this order of placing the free blocks, first placed first.
    ///
    /// It names every free block once; `*` stands for any letters of a name (matches are taken in
    /// the order of the scene). The blocks that must be held are found.
    #[arg(long, value_name = "ID,…", value_delimiter = ',', conflicts_with = "any_order")]
    pub order: Vec<String>,
    /// Most blocks that may be held at once [default: any number].
    ///
    /// The exit code states whether that is enough.
    #[arg(long, value_name = "N", requires = "asks_order")]
    pub hands: Option<usize>,
    /// Most sets of blocks examined for the least number held [default: 5000].
    ///
    /// The limit applies to every structure that stands by itself.
    #[arg(long, value_name = "N", requires = "asks_order", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub tries: Option<u32>,
    /// Direction of the tilt; may be given several times.
    ///
    /// Only its part across gravity counts.
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, conflicts_with_all = ["any_order", "order"], value_parser = direction)]
    pub toward: Vec<[f64; 3]>,
    /// Number of directions of the tilt, evenly spread, the first along x [default: 8].
    #[arg(long, value_name = "N", conflicts_with_all = ["toward", "any_order", "order"], value_parser = clap::value_parser!(u16).range(1..=3600))]
    pub all: Option<u16>,
    /// Verdicts only, without load factors or tilts.
    #[arg(long, conflicts_with_all = ["toward", "all", "any_order", "order", "chart"])]
    pub skip_margin: bool,
    /// Skip the least forces on what the stages hold.
    #[arg(long)]
    pub skip_held: bool,
    /// Write the stages to this file, one per row (CSV).
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv), help_heading = "Output")]
    pub csv: Option<PathBuf>,
    /// Draw the margins of the stages to this file (SVG).
    #[arg(long, value_name = "FILE", conflicts_with_all = ["any_order", "order"], value_parser = output(Written::Svg), help_heading = "Pictures")]
    pub chart: Option<PathBuf>,
}
