//! Arguments of studies.

use super::parse::{Written, output};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct Study {
    /// Scenes to study, by name: arch, wall, openings, corner, groove, column, courses, tiny. All
    /// of them by default.
    #[arg(long, value_name = "NAMES", value_delimiter = ',', conflicts_with = "extreme")]
    pub scenes: Vec<String>,
    /// Every other setting of each knob, no simulations, no repetition: under a minute.
    #[arg(long, conflicts_with = "extreme")]
    pub quick: bool,
    /// Runs per setting, of which the median counts; 3 by default, 1 with --quick.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1000), conflicts_with = "extreme")]
    pub repeat: Option<u16>,
    /// What leaving things out saves instead: load factors with and without omissions.
    #[arg(long, conflicts_with_all = ["extreme", "quick", "csv", "svg"])]
    pub omissions: bool,
    /// The stiff and extreme grid instead.
    #[arg(long)]
    pub extreme: bool,
    /// Rocking blocks on ground that moves instead: the mechanism's integrator and the engine on exact
    /// values.
    #[arg(long, conflicts_with_all = ["scenes", "quick", "repeat", "omissions", "extreme", "keep", "report"])]
    pub rocking: bool,
    /// Joints that yield instead: the state with stiffness, springs and dampers relaxed to rest, and the
    /// engine on closed forms.
    #[arg(long, conflicts_with_all = ["scenes", "quick", "repeat", "omissions", "extreme", "keep", "report", "rocking"])]
    pub yielding: bool,
    /// Keep every cell in this file as soon as it is asked; the same command takes it up again after
    /// a kill at any point (--extreme).
    #[arg(long, value_name = "FILE", conflicts_with = "omissions", value_parser = output(Written::Lines))]
    pub keep: Option<PathBuf>,
    /// Write every run to this file, comma-separated.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv))]
    pub csv: Option<PathBuf>,
    /// Draw the charts into this folder: one per scene, and profile.svg over all.
    #[arg(long, value_name = "FOLDER", conflicts_with = "extreme", value_parser = output(Written::Folder))]
    pub svg: Option<PathBuf>,
    /// Write charts with values where one points, and a table to sort, as a page for a browser to
    /// this file.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Html))]
    pub report: Option<PathBuf>,
    /// Print every run as JSON.
    #[arg(long)]
    pub json: bool,
    /// Lists in full.
    #[arg(short, long)]
    pub verbose: bool,
    /// No progress.
    #[arg(short, long)]
    pub quiet: bool,
}
