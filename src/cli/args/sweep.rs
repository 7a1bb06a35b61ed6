//! Arguments of sweeps.

use super::Outside;
use super::parse::{Written, one_line, output, word};
use clap::{Args, Subcommand, ValueEnum};
use std::path::PathBuf;
use voussoir::sweep::Shard;

#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct Sweep {
    #[command(subcommand)]
    pub verb: Option<SweepVerb>,
    /// The plan (JSON), `-` for standard input.
    #[arg(required_unless_present = "attach")]
    pub plan: Option<PathBuf>,
    /// File of rows (JSON lines); it is continued if it holds rows of this plan.
    ///
    /// By default it is the plan's name with the ending `.rows.jsonl`, in the current folder.
    #[arg(short, long, value_name = "FILE", value_parser = output(Written::Lines), help_heading = "Output")]
    pub output: Option<PathBuf>,
    /// Compute every N-th row from the K-th on; `sweep merge` joins the files.
    #[arg(long, value_name = "K/N", default_value_t = Shard::ALL)]
    pub shard: Shard,
    /// Threads; by default one per processor.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024), help_heading = "Solver and limits")]
    pub threads: Option<u16>,
    /// Start again even if the file already holds rows.
    #[arg(long)]
    pub restart: bool,
    #[command(flatten)]
    pub outside: Outside,
    #[command(flatten)]
    pub slurm: Slurm,
    #[command(flatten)]
    pub summary: Summary,
}

/// A sweep on a cluster.
#[derive(Debug, Args)]
#[command(next_help_heading = "On a Slurm cluster")]
pub struct Slurm {
    /// Compute the rows in an array of Slurm tasks and merge them at the end.
    ///
    /// They arrive in the folder OUT.slurm and are merged into OUT. The same command resumes where
    /// an array was stopped.
    #[arg(long, conflicts_with_all = ["shard", "threads"])]
    pub slurm: bool,
    /// Watch the array submitted for this file of rows, and merge at the end.
    #[arg(long, value_name = "OUT", conflicts_with_all = ["plan", "slurm", "output", "shard", "threads", "restart"])]
    pub attach: Option<PathBuf>,
    /// Number of tasks.
    ///
    /// By default a few rows are measured first, and the number keeps the time to start the tasks
    /// below 5 % of the work.
    #[arg(long, value_name = "N", requires = "slurm", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub tasks: Option<u32>,
    /// Partition; by default the cluster's own choice.
    #[arg(long, value_name = "NAME", requires = "slurm", value_parser = word)]
    pub partition: Option<String>,
    /// Time limit of a task, in minutes or as [DAYS-]HOURS:MINUTES:SECONDS (sbatch).
    #[arg(long, value_name = "TIME", requires = "slurm", value_parser = word)]
    pub time: Option<String>,
    /// Processors per task.
    #[arg(long, value_name = "N", requires = "slurm", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub cpus: u16,
    /// Further option of sbatch, such as --sbatch-arg=--account=stone; repeatable.
    #[arg(long, value_name = "OPTION", requires = "slurm", allow_hyphen_values = true, value_parser = one_line)]
    pub sbatch_arg: Vec<String>,
    /// State that the nodes see the folder of the output under the same path.
    ///
    /// It is needed if the folder looks like a disk of this machine.
    #[arg(long, requires = "slurm")]
    pub shared: bool,
    /// Print the batch script; submit and write nothing.
    #[arg(long, requires = "slurm")]
    pub dry_run: bool,
}

#[derive(Debug, Args)]
pub struct SweepStatus {
    /// The output of a sweep on a cluster, its folder, or any file of rows.
    pub rows: PathBuf,
    /// Print one JSON object and nothing else.
    #[arg(long, help_heading = "Output")]
    pub json: bool,
}

#[derive(Debug, Args)]
pub struct Task {
    /// The folder of the sweep.
    pub folder: PathBuf,
    /// Compute the K-th of N shards.
    #[arg(long, value_name = "K/N")]
    pub shard: Shard,
    /// Threads; by default one per processor.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024), help_heading = "Solver and limits")]
    pub threads: Option<u16>,
}

#[derive(Debug, Subcommand)]
pub enum SweepVerb {
    /// Report the progress of a sweep: rows done, and tasks running, waiting or stopped.
    ///
    /// Works while rows are being written. Exit code 3 if rows are missing.
    Status(SweepStatus),
    /// Compute one shard of a sweep on a cluster, from its folder alone.
    ///
    /// This is what a task of the array runs. Rows that any earlier run has computed are skipped.
    Task(Task),
    /// Join files of rows, in the order of the rows, and summarise them.
    ///
    /// Exit code 3 if rows are missing or have no answer.
    Merge(Merge),
}

#[derive(Debug, Args)]
pub struct Merge {
    /// Files of rows of one plan, or folders of a sweep on a cluster (it may still run).
    #[arg(required = true)]
    pub rows: Vec<PathBuf>,
    /// Write all rows to this file.
    #[arg(short, long, value_name = "FILE", value_parser = output(Written::Lines), help_heading = "Output")]
    pub output: Option<PathBuf>,
    #[command(flatten)]
    pub summary: Summary,
}

/// What is made of rows.
#[derive(Debug, Args)]
pub struct Summary {
    /// Write the rows to this file (CSV).
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv), help_heading = "Output")]
    pub csv: Option<PathBuf>,
    /// Draw a chart to this file (SVG).
    #[arg(long, value_name = "FILE", value_parser = output(Written::Svg), help_heading = "Pictures")]
    pub svg: Option<PathBuf>,
    /// Write interactive charts and a sortable table to this file (HTML).
    ///
    /// Charts show values under the pointer.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Html), help_heading = "Output")]
    pub report: Option<PathBuf>,
    /// Kind of chart: `line`, `heat` or `fragility`; by default the one that suits the plan.
    ///
    /// `line` shows the value against one number, `heat` against two, and `fragility` the share
    /// that fails.
    #[arg(
        long,
        value_enum,
        value_name = "KIND",
        requires = "svg",
        hide_possible_values = true,
        help_heading = "Pictures"
    )]
    pub chart: Option<Chart>,
    /// Print the summary as one JSON object and nothing else.
    #[arg(long, help_heading = "Output")]
    pub json: bool,
    /// Print the first line only, and no progress.
    #[arg(short, long, help_heading = "Output")]
    pub quiet: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Chart {
    Line,
    Heat,
    Fragility,
}

impl From<Chart> for voussoir::report::sweep::Kind {
    fn from(chart: Chart) -> Self {
        match chart {
            Chart::Line => Self::Line,
            Chart::Heat => Self::Heat,
            Chart::Fragility => Self::Fragility,
        }
    }
}
