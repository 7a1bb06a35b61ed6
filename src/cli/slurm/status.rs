//! `voussoir sweep status`

use super::{folder_of, watch::tasks};
use crate::cli::{
    args::SweepStatus,
    exit::Exit,
    terminal::{self, Terminal},
};
use std::collections::BTreeMap;
use voussoir::{
    report::{json, sweep as report},
    sweep::{
        Folder, read_rows,
        slurm::{Job, TaskState},
    },
};

pub fn run(args: &SweepStatus, terminal: &Terminal) -> anyhow::Result<Exit> {
    let beside = folder_of(&args.rows);
    let place = if args.rows.is_dir() { args.rows.clone() } else { beside };
    let (header, rows, damaged, jobs) = if place.is_dir() {
        let folder = Folder::open(&place)?;
        let gathered = folder.read()?;
        let jobs = match tasks(&Job::read(&place)?.unwrap_or_default()) {
            Ok(tasks) => {
                let mut jobs: BTreeMap<(TaskState, String), usize> = BTreeMap::new();
                tasks.into_values().for_each(|t| {
                    *jobs.entry((t.state, said(t.state, t.word, t.reason))).or_default() += 1
                });
                jobs.into_iter().map(|((_, word), many)| (word, many)).collect()
            }
            Err(e) => {
                terminal::say(&format!(
                    "note: the state of the tasks is unknown: {}",
                    terminal::words(&e)
                ));
                Vec::new()
            }
        };
        (folder.header.clone(), gathered.rows.into_values().collect(), gathered.damaged, jobs)
    } else {
        let (header, rows) = read_rows(&args.rows)?;
        (header, rows, 0, Vec::new())
    };
    let progress = report::SweepProgress::new(&header, &rows, damaged, jobs);
    if args.json {
        terminal::print(&json::pretty(&progress)?)?;
    } else {
        terminal.page(&report::progress(&progress, terminal.layout(&args.rows)))?;
    }
    Ok(if progress.is_complete() { Exit::Yes } else { Exit::Undecided })
}

/// Slurm's word, with the reason where that helps.
fn said(state: TaskState, word: String, reason: String) -> String {
    let word = word.to_lowercase();
    if matches!(state, TaskState::Pending | TaskState::Ended)
        && reason != "None"
        && !reason.is_empty()
    {
        format!("{word} ({reason})")
    } else {
        word
    }
}
