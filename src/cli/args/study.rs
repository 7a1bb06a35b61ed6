//! Arguments of studies.

use super::parse::{Written, output};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub struct Study {
    /// Scenes to study, by name; by default all of them.
    ///
    /// They are arch, wall, openings, corner, groove, column, courses and tiny.
    #[arg(long, value_name = "NAMES", value_delimiter = ',', conflicts_with = "extreme")]
    pub scenes: Vec<String>,
    /// Every other setting, no simulations, no repetition: less than a minute.
    #[arg(long, conflicts_with = "extreme")]
    pub quick: bool,
    /// Runs per setting, of which the median counts; 3 by default, 1 with --quick.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1000), conflicts_with = "extreme")]
    pub repeat: Option<u16>,
    /// Measure the time that reductions save: load factors with and without them.
    #[arg(long, conflicts_with_all = ["extreme", "quick", "csv", "svg"])]
    pub omissions: bool,
    /// Study the grid of stiff and extreme scenes instead.
    #[arg(long)]
    pub extreme: bool,
    /// Study rocking blocks on moving ground instead.
    ///
    /// The integrator of the mechanism and the engine are compared with exact values.
    #[arg(long, conflicts_with_all = ["scenes", "quick", "repeat", "omissions", "extreme", "keep", "report"])]
    pub rocking: bool,
    /// Study elastic joints instead.
    ///
    /// The state with stiffness, springs and dampers relaxed to rest, and the engine are compared
    /// with closed forms.
    #[arg(long, conflicts_with_all = ["scenes", "quick", "repeat", "omissions", "extreme", "keep", "report", "rocking"])]
    pub yielding: bool,
    /// Compare predictions with the laboratory tests in this folder instead.
    ///
    /// Each folder in it is a group of tests: `experiment.json` and the scenes that it names. Name
    /// groups with --scenes to compare these alone.
    #[arg(long, value_name = "FOLDER", num_args = 0..=1, default_missing_value = "structures/experiments", conflicts_with_all = ["quick", "repeat", "omissions", "extreme", "keep", "rocking", "yielding"])]
    pub experiments: Option<PathBuf>,
    /// Checkpoint to this file; run the same command again to resume (--extreme).
    ///
    /// Every cell is written as soon as it is answered, so the run may be interrupted at any
    /// moment.
    #[arg(long, value_name = "FILE", conflicts_with = "omissions", value_parser = output(Written::Lines), help_heading = "Output")]
    pub keep: Option<PathBuf>,
    /// Write every run to this file (CSV).
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv), help_heading = "Output")]
    pub csv: Option<PathBuf>,
    /// Draw the charts into this folder: one per scene, and profile.svg over all.
    #[arg(long, value_name = "FOLDER", conflicts_with = "extreme", value_parser = output(Written::Folder), help_heading = "Pictures")]
    pub svg: Option<PathBuf>,
    /// Write interactive charts and a sortable table to this file (HTML).
    ///
    /// Charts show values under the pointer.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Html), help_heading = "Output")]
    pub report: Option<PathBuf>,
    /// Print every run as JSON.
    #[arg(long, help_heading = "Output")]
    pub json: bool,
    /// Print lists in full.
    #[arg(short, long, help_heading = "Output")]
    pub verbose: bool,
    /// Print no progress.
    #[arg(short, long, help_heading = "Output")]
    pub quiet: bool,
}
