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
    #[arg(long, conflicts_with_all = ["scenes", "quick", "repeat", "omissions", "extreme", "random", "keep", "report"])]
    pub rocking: bool,
    /// Joints that yield instead: the state with stiffness, springs and dampers relaxed to rest, and the
    /// engine on closed forms.
    #[arg(long, conflicts_with_all = ["scenes", "quick", "repeat", "omissions", "extreme", "random", "keep", "report", "rocking"])]
    pub yielding: bool,
    /// So many random scenes instead: verdicts held against their certificates, against omissions
    /// and, of a sample, against simulations. Exit code 1 if any two exclude each other.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000_000), group = "random", conflicts_with_all = ["extreme", "omissions", "quick", "svg", "scenes", "repeat"])]
    pub soak: Option<u32>,
    /// So many random scenes instead, each asked in several ways that must give one answer: with
    /// strangers beside it, at the coordinates of a survey, under loads up to its load factor and
    /// beyond. Exit code 1 if any two proofs exclude each other.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000_000), group = "random", conflicts_with_all = ["extreme", "omissions", "quick", "svg", "scenes", "repeat"])]
    pub cross: Option<u32>,
    /// The results of so many random scenes instead, each changed into false claims, some two
    /// hundred a scene. Exit code 1 if any is called proved.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000_000), group = "random", conflicts_with_all = ["extreme", "omissions", "quick", "svg", "scenes", "repeat"])]
    pub forge: Option<u32>,
    /// Which random scenes (--soak, --cross, --forge).
    #[arg(long, value_name = "SEED", default_value_t = 1, requires = "random")]
    pub seed: u64,
    /// Write the scenes of contradictions (--cross), each as it was asked, or the forged results
    /// that were called proved (--forge) into this folder.
    #[arg(long, value_name = "FOLDER", conflicts_with_all = ["soak", "only"], requires = "random")]
    pub dump: Option<PathBuf>,
    /// Keep every scene in this file as soon as it is asked; the same command takes it up again
    /// after a kill at any point (--soak, --cross, --forge, --extreme).
    #[arg(long, value_name = "FILE", conflicts_with_all = ["only", "omissions"], value_parser = output(Written::Lines))]
    pub keep: Option<PathBuf>,
    /// Print this one of the random scenes, to look at it with other commands; nothing is asked
    /// (--soak, --cross, --forge).
    #[arg(long, value_name = "NUMBER", requires = "random", conflicts_with_all = ["csv", "json"])]
    pub only: Option<u32>,
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
