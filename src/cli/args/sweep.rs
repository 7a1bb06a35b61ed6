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
    /// The file of rows (JSON lines), which is continued if it holds rows of this plan; by default
    /// the plan's name with the ending `.rows.jsonl`, in the current folder.
    #[arg(short, long, value_name = "FILE", value_parser = output(Written::Lines))]
    pub output: Option<PathBuf>,
    /// Do every N-th row, starting with the K-th; `sweep merge` puts the files together.
    #[arg(long, value_name = "K/N", default_value_t = Shard::ALL)]
    pub shard: Shard,
    /// Threads; by default one a processor.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Begin again where the file holds rows already.
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
    /// Do the rows in an array of Slurm tasks, watch them arrive in the folder OUT.slurm, and merge
    /// them into OUT at the end. The same command goes on where an array was stopped.
    #[arg(long, conflicts_with_all = ["shard", "threads"])]
    pub slurm: bool,
    /// Watch an array that was submitted for this file of rows, and merge at the end.
    #[arg(long, value_name = "OUT", conflicts_with_all = ["plan", "slurm", "output", "shard", "threads", "restart"])]
    pub attach: Option<PathBuf>,
    /// Cut the sweep into so many tasks; by default as many as keep what starting them takes below
    /// 5 % of the work, a few rows being measured first.
    #[arg(long, value_name = "N", requires = "slurm", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub tasks: Option<u32>,
    /// The partition; by default the cluster's own choice.
    #[arg(long, value_name = "NAME", requires = "slurm", value_parser = word)]
    pub partition: Option<String>,
    /// Time limit of a task, as sbatch takes it (minutes, or [DAYS-]HOURS:MINUTES:SECONDS).
    #[arg(long, value_name = "TIME", requires = "slurm", value_parser = word)]
    pub time: Option<String>,
    /// Processors a task.
    #[arg(long, value_name = "N", requires = "slurm", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub cpus: u16,
    /// Another option of sbatch, such as --sbatch-arg=--account=stone; may be given several times.
    #[arg(long, value_name = "OPTION", requires = "slurm", allow_hyphen_values = true, value_parser = one_line)]
    pub sbatch_arg: Vec<String>,
    /// The nodes see the folder of the output under the same path, although it looks like a disk of
    /// this machine.
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
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub struct Task {
    /// The folder of the sweep.
    pub folder: PathBuf,
    /// The K-th of N shards.
    #[arg(long, value_name = "K/N")]
    pub shard: Shard,
    /// Threads; by default one a processor.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
}

#[derive(Debug, Subcommand)]
pub enum SweepVerb {
    /// How far a sweep is: rows that are done, tasks that run, wait or were stopped.
    ///
    /// Works while rows are being written. Exit code 3 if rows are missing.
    Status(SweepStatus),
    /// Do one shard of a sweep on a cluster, from its folder alone; this is what a task of the
    /// array runs.
    ///
    /// Rows that any earlier run of any task has done are left out.
    Task(Task),
    /// Put files of rows together, in the order of the rows, and sum them up.
    ///
    /// Exit code 3 if rows are missing or have no answer.
    Merge(Merge),
}

#[derive(Debug, Args)]
pub struct Merge {
    /// Files of rows of one plan, or folders of a sweep on a cluster, which may still be running.
    #[arg(required = true)]
    pub rows: Vec<PathBuf>,
    /// Write all rows to this file.
    #[arg(short, long, value_name = "FILE", value_parser = output(Written::Lines))]
    pub output: Option<PathBuf>,
    #[command(flatten)]
    pub summary: Summary,
}

/// What is made of rows.
#[derive(Debug, Args)]
pub struct Summary {
    /// Write the rows as a table.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv))]
    pub csv: Option<PathBuf>,
    /// Draw a chart.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Svg))]
    pub svg: Option<PathBuf>,
    /// Write charts with values where one points, and a table to sort, as a page for a browser to
    /// this file.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Html))]
    pub report: Option<PathBuf>,
    /// Which chart: `line` (value against one number), `heat` (against two), `fragility` (share
    /// that fails); by default what suits the plan.
    #[arg(long, value_enum, value_name = "KIND", requires = "svg", hide_possible_values = true)]
    pub chart: Option<Chart>,
    /// Print the summary as one JSON object and nothing else.
    #[arg(long)]
    pub json: bool,
    /// The first line only, and no progress.
    #[arg(short, long)]
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
