//! Rows as they arrive, and what is made of them at the end. Watching may stop and begin again at
//! any time; the job goes on.

use super::{folder_of, say_damaged, say_unchecked};
use crate::cli::{
    args::Summary,
    exit::Exit,
    output::Sink,
    sinks::{Sinks, bar},
    terminal::{self, Terminal},
};
use anyhow::Context;
use std::{
    collections::BTreeMap,
    path::Path,
    thread::sleep,
    time::{Duration, Instant},
};
use voussoir::sweep::{
    Folder, Gathered, Merged, RowsFile, Tally,
    slurm::{self, Job, Task, TaskState},
};

/// Between two looks at the rows at least, so that the end is seen soon; and so many times as long
/// as a look takes, where folders are slow.
const ROWS: Duration = Duration::from_millis(100);
const PER_LOOK: u32 = 10;
/// Between two questions to Slurm, which many ask.
const QUEUE: Duration = Duration::from_secs(5);
/// So long Slurm may give no answer, as when its controller starts anew.
const PATIENCE: Duration = Duration::from_secs(300);
/// So long a shared folder may take to show what the last task has written.
const ARRIVAL: Duration = Duration::from_secs(3);

/// `voussoir sweep --attach OUT`
pub fn attach(output: &Path, summary: &Summary, terminal: &Terminal) -> anyhow::Result<Exit> {
    let folder = Folder::open(&folder_of(output))
        .with_context(|| format!("no job was submitted for {}", output.display()))?;
    slurm::require_commands()?;
    Sink::open(Some(output))?;
    run(&folder, output, summary, &Sinks::open(summary)?, terminal)
}

/// Watches until all rows are there or no task is left, and puts them together.
pub fn run(
    folder: &Folder,
    output: &Path,
    summary: &Summary,
    sinks: &Sinks,
    terminal: &Terminal,
) -> anyhow::Result<Exit> {
    let job = Job::read(&folder.path)?.unwrap_or_default();
    let gathered = rows(folder, &job, summary.quiet)?;
    let missing = folder.missing(&gathered);
    let merged = Merged {
        header: folder.header.clone(),
        rows: gathered.rows.into_values().collect(),
        damaged: gathered.damaged,
        unchecked: gathered.unchecked,
    };
    say_damaged(merged.damaged);
    say_unchecked(merged.unchecked);
    if missing.is_empty() {
        // Refuses a file that another run is writing, or that is none of this plan.
        drop(RowsFile::open(output, &folder.header, false)?);
        Sink::again(Some(output))?.write(&merged.text()?)?;
    }
    let exit = sinks.write(summary, &merged.header, &merged.rows, terminal)?;
    let Some(first) = missing.first() else { return Ok(exit) };
    let log = folder.path.join("log");
    terminal::say(&format!(
        "note: {} of {} rows are missing, the first is row {first}, and no task is left; the logs of the tasks are in {}\nnote: run the command with the plan and --slurm again to submit the missing rows",
        missing.len(),
        folder.header.rows,
        log.display()
    ));
    Ok(Exit::Undecided)
}

fn rows(folder: &Folder, job: &Job, quiet: bool) -> anyhow::Result<Gathered> {
    let all = folder.header.rows;
    let bar = bar(quiet);
    bar.set_length(all as u64);
    let (mut tally, mut counted) = (Tally::default(), None);
    let (mut asked, mut answered) = (None::<Instant>, Instant::now());
    let (mut told, mut left_since) = (BTreeMap::new(), None::<Instant>);
    loop {
        let look = Instant::now();
        let count = tally.count(folder)?;
        let look = look.elapsed();
        bar.set_position(count.min(all) as u64);
        if counted != Some(count) {
            counted = Some(count);
            left_since = None;
            if count >= all {
                // Lines count twice that were done twice.
                let gathered = folder.read()?;
                if gathered.rows.len() >= all {
                    bar.finish_and_clear();
                    return Ok(gathered);
                }
            }
        }
        if left_since.is_some_and(|t| t.elapsed() > ARRIVAL) {
            bar.finish_and_clear();
            return Ok(folder.read()?);
        }
        if left_since.is_none() && asked.is_none_or(|t| t.elapsed() > QUEUE) {
            asked = Some(Instant::now());
            match tasks(job) {
                Ok(tasks) => {
                    answered = Instant::now();
                    bar.set_message(waiting(&tasks));
                    if !quiet {
                        bar.suspend(|| tell(&tasks, &mut told));
                    }
                    if !tasks.values().any(|t| t.state.is_alive()) {
                        left_since = Some(Instant::now());
                    }
                }
                Err(e) if answered.elapsed() > PATIENCE => return Err(e),
                Err(e) if !quiet => bar
                    .suspend(|| terminal::say(&format!("note: {}; retrying", terminal::words(&e)))),
                Err(_) => {}
            }
        }
        sleep(ROWS.max(look * PER_LOOK));
    }
}

/// The tasks of all arrays, by job and number.
pub fn tasks(job: &Job) -> anyhow::Result<BTreeMap<(u64, usize), Task>> {
    let mut all = BTreeMap::new();
    for &number in &job.jobs {
        all.extend(slurm::states(number)?.into_iter().map(|(k, task)| ((number, k), task)));
    }
    Ok(all)
}

/// Why nothing moves, where every task that is left waits.
fn waiting(tasks: &BTreeMap<(u64, usize), Task>) -> String {
    let mut alive = tasks.values().filter(|t| t.state.is_alive());
    let all_wait = alive.clone().all(|t| t.state == TaskState::Pending);
    alive
        .next()
        .filter(|_| all_wait)
        .map(|t| format!(", waiting: {}", t.reason))
        .unwrap_or_default()
}

/// Says of every task that was stopped, once.
fn tell(tasks: &BTreeMap<(u64, usize), Task>, told: &mut BTreeMap<(u64, usize), String>) {
    for (&(job, k), task) in tasks.iter().filter(|t| t.1.state == TaskState::Ended) {
        if told.insert((job, k), task.word.clone()).as_ref() != Some(&task.word) {
            let why = if task.reason == "None" || task.reason.is_empty() {
                String::new()
            } else {
                format!(" ({})", task.reason)
            };
            terminal::say(&format!("note: task {k} of job {job} was stopped: {}{why}", task.word));
        }
    }
}
