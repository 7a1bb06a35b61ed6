//! `voussoir sweep PLAN --slurm`: what can be wrong is found out, then an array is submitted and
//! watched.

use super::{folder_of, watch};
use crate::cli::{
    args, called, exit::Exit, output::Sink, question::quoted, sinks::Sinks, terminal,
    terminal::Terminal,
};
use anyhow::{Context, bail};
use std::path::Path;
use voussoir::sweep::{
    Folder, Row, RowsFile, Shard, Sweep, measure,
    slurm::{self, Job, Script},
};

/// Rows that are measured first, and seconds after which no other one is begun.
const MEASURED: (usize, f64) = (16, 5.0);
/// Tasks of an array, as clusters are set up by default.
const MOST_TASKS: usize = 1000;
/// The name of the batch script.
const SCRIPT: &str = "job.sh";

pub fn run(
    args: &args::Sweep,
    sweep: &Sweep,
    output: &Path,
    sinks: &Sinks,
    terminal: &Terminal,
) -> anyhow::Result<Exit> {
    if args.slurm.dry_run {
        return dry_run(&args.slurm, sweep);
    }
    slurm::require_commands()?;
    let partition = slurm::partition(&slurm::partitions()?, args.slurm.partition.as_deref())?;
    Sink::again(Some(output))?;
    let path = folder_of(output);
    if !args.slurm.shared {
        slurm::require_shared(&path, &partition.name)?;
    }
    if let Some(job) = Job::read(&path)?.map_or(Ok(None), |job| job.alive())? {
        if args.restart {
            bail!("job {job} is still computing {}; stop it with `scancel {job}`", path.display());
        }
        terminal::say(&format!(
            "note: job {job} is still computing these rows; no new job is submitted"
        ));
        return watch::run(
            &Folder::create(&path, &sweep.header(Shard::ALL))?,
            output,
            &args.summary,
            sinks,
            terminal,
        );
    }
    // Held until all is submitted, so that nobody else does the same; and it says whether these are
    // rows of this plan.
    let held = RowsFile::open(output, &sweep.header(Shard::ALL), args.restart)?;
    let folder = match submitted(args, sweep, &path, &held.rows, &partition, output) {
        Ok(folder) => folder,
        Err(e) => {
            // Nothing runs, and a header alone would look like a sweep that was begun.
            if held.rows.is_empty() {
                let _ = std::fs::remove_file(output);
            }
            return Err(e);
        }
    };
    drop(held);
    watch::run(&folder, output, &args.summary, sinks, terminal)
}

/// Submits what is missing; rows that are there `earlier` count.
fn submitted(
    args: &args::Sweep,
    sweep: &Sweep,
    path: &Path,
    earlier: &[Row],
    partition: &slurm::Partition,
    output: &Path,
) -> anyhow::Result<Folder> {
    if args.restart {
        Folder::remove(path)?;
    }
    let folder = Folder::create(path, &sweep.header(Shard::ALL))?;
    let there = folder.read()?;
    let mut new = earlier.iter().filter(|row| !there.rows.contains_key(&row.row)).peekable();
    if new.peek().is_some() {
        let file = folder.fresh("earlier")?;
        new.try_for_each(|row| file.append(row))?;
    }
    let mut missing = folder.missing(&folder.read()?);
    let tasks = match args.slurm.tasks {
        Some(tasks) => (tasks as usize).min(sweep.rows()),
        None if missing.is_empty() => 1,
        None => {
            let file = folder.fresh("measured")?;
            let seconds = measure(sweep, &missing, MEASURED.0, MEASURED.1, Some(&file))?;
            missing = folder.missing(&folder.read()?);
            cut(&args.slurm, missing.len(), seconds, Some(partition.cpus))
        }
    };
    if !missing.is_empty() {
        let script = script(&args.slurm, sweep, tasks, &missing)?;
        Sink::again(Some(&path.join(SCRIPT)))?.write(&script.to_string())?;
        let number = slurm::submit(path, SCRIPT)?;
        let mut job = Job::read(path)?.unwrap_or_default();
        (job.tasks, job.jobs) = (tasks, [job.jobs, vec![number]].concat());
        job.write(path)?;
        if !args.summary.quiet {
            let (many, rows, partition) = (script.array.len(), missing.len(), &partition.name);
            terminal::say(&format!(
                "job {number}: {rows} rows in {many} tasks on partition {partition}, written to {}\nnote: this program may be stopped; `voussoir sweep --attach {}` continues to watch, `scancel {number}` stops the job",
                path.display(),
                quoted(&output.display().to_string())
            ));
        }
    }
    Ok(folder)
}

/// The script as it would be submitted. The rows that are measured are not kept.
fn dry_run(args: &args::Slurm, sweep: &Sweep) -> anyhow::Result<Exit> {
    let all: Vec<usize> = (0..sweep.rows()).collect();
    let tasks = match args.tasks {
        Some(tasks) => (tasks as usize).min(all.len()),
        None => {
            // A cluster is not needed for a look at the script.
            let slots = slurm::partitions()
                .ok()
                .and_then(|all| slurm::partition(&all, args.partition.as_deref()).ok());
            cut(
                args,
                all.len(),
                measure(sweep, &all, MEASURED.0, MEASURED.1, None)?,
                slots.map(|p| p.cpus),
            )
        }
    };
    terminal::print(&script(args, sweep, tasks, &all)?.to_string())?;
    Ok(Exit::Yes)
}

fn cut(args: &args::Slurm, rows: usize, seconds: Option<f64>, cpus: Option<usize>) -> usize {
    let own = usize::from(args.cpus);
    slurm::tasks(rows, seconds.unwrap_or(0.0), own, cpus.map(|all| all / own), MOST_TASKS)
}

fn script(
    args: &args::Slurm,
    sweep: &Sweep,
    tasks: usize,
    missing: &[usize],
) -> anyhow::Result<Script> {
    let program = called::path().context("the path of this program is unknown")?;
    let program =
        program.to_str().context("the path of this program is not valid text")?.to_string();
    let mut open = vec![false; tasks];
    missing.iter().for_each(|row| open[row % tasks] = true);
    Ok(Script {
        name: if sweep.plan.name.is_empty() { "Sweep".into() } else { sweep.plan.name.clone() },
        rows: sweep.rows(),
        tasks,
        array: (1..=tasks).filter(|k| open[k - 1]).collect(),
        cpus: args.cpus.into(),
        partition: args.partition.clone(),
        time: args.time.clone(),
        more: args.sbatch_arg.clone(),
        program,
    })
}
