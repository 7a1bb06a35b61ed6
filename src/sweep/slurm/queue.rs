//! Slurm's commands: `sbatch`, `squeue`, `sinfo`. Every answer is read with care, every refusal
//! passed on in Slurm's own words.

use base::error::SlurmError;
use std::{
    collections::BTreeMap,
    path::Path,
    process::{Command, Stdio},
};

/// A partition as `sinfo` lists it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Partition {
    /// Its name.
    pub name: String,
    /// Whether jobs go there that name none.
    pub default: bool,
    /// Whether it starts jobs.
    pub up: bool,
    /// Processors that are not down.
    pub cpus: usize,
}

/// What Slurm says of a task.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Task {
    /// In one word.
    pub state: TaskState,
    /// Slurm's word.
    pub word: String,
    /// Why it waits, or why it failed.
    pub reason: String,
}

/// What becomes of a task.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TaskState {
    /// It waits.
    Pending,
    /// It runs, or is about to.
    Running,
    /// It has come to its end.
    Completed,
    /// Cancelled, failed, out of time or memory.
    Ended,
}

impl TaskState {
    /// Whether it may still write rows.
    pub fn is_alive(self) -> bool {
        matches!(self, Self::Pending | Self::Running)
    }

    fn of(word: &str) -> Self {
        match word {
            "PENDING" | "REQUEUED" | "REQUEUE_HOLD" | "REQUEUE_FED" | "SPECIAL_EXIT"
            | "RESV_DEL_HOLD" => Self::Pending,
            // Its program has ended, or is being ended.
            "COMPLETED" | "COMPLETING" => Self::Completed,
            "BOOT_FAIL" | "CANCELLED" | "DEADLINE" | "FAILED" | "NODE_FAIL" | "OUT_OF_MEMORY"
            | "PREEMPTED" | "REVOKED" | "TIMEOUT" => Self::Ended,
            _ => Self::Running,
        }
    }
}

/// The commands that a sweep on a cluster needs.
///
/// # Errors
/// One of them is not on the path.
pub fn require_commands() -> Result<(), SlurmError> {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let is_missing =
        |name: &str| !std::env::split_paths(&path).any(|folder| folder.join(name).is_file());
    match ["sbatch", "squeue", "sinfo"].into_iter().find(|name| is_missing(name)) {
        Some(program) => Err(SlurmError::NotInstalled { program: program.into() }),
        None => Ok(()),
    }
}

/// All partitions.
///
/// # Errors
/// Slurm does not answer.
pub fn partitions() -> Result<Vec<Partition>, SlurmError> {
    Ok(read_partitions(&run("sinfo", &["--noheader", "--format=%P|%a|%C"], None)?))
}

/// The partition called `name`, or the one where jobs go that name none.
///
/// # Errors
/// There is none, or it starts no jobs.
pub fn partition(all: &[Partition], name: Option<&str>) -> Result<Partition, SlurmError> {
    let known = || all.iter().map(|p| p.name.as_str()).collect::<Vec<_>>().join(", ");
    let found = all.iter().find(|p| name.map_or(p.default, |n| p.name == n));
    match found {
        Some(p) if p.up => Ok(p.clone()),
        Some(p) => Err(SlurmError::PartitionDown { name: p.name.clone() }),
        None => Err(SlurmError::NoPartition { asked: name.map(str::to_string), known: known() }),
    }
}

/// The host names of the nodes of a partition.
///
/// # Errors
/// Slurm does not answer.
pub fn hosts(partition: &str) -> Result<Vec<String>, SlurmError> {
    let text = run(
        "sinfo",
        &["--noheader", "--Node", &format!("--partition={partition}"), "--format=%n"],
        None,
    )?;
    let mut hosts: Vec<String> =
        text.lines().map(str::trim).filter(|l| !l.is_empty()).map(str::to_string).collect();
    hosts.sort();
    hosts.dedup();
    Ok(hosts)
}

/// Submits the script `script` of `folder` there; returns Slurm's number of the array.
///
/// # Errors
/// Slurm refuses it.
pub fn submit(folder: &Path, script: &str) -> Result<u64, SlurmError> {
    let text = run("sbatch", &["--parsable", script], Some(folder))?;
    // "17" or "17;cluster", after whatever the site's plugins say.
    let number = text.lines().rev().find_map(|line| line.split(';').next()?.trim().parse().ok());
    number.ok_or_else(|| SlurmError::Refused {
        program: "sbatch".into(),
        said: format!("no job number in its answer: {}", text.trim()),
    })
}

/// The tasks of an array that Slurm still remembers, by number.
///
/// # Errors
/// Slurm does not answer.
pub fn states(job: u64) -> Result<BTreeMap<usize, Task>, SlurmError> {
    let arguments =
        ["--noheader", "--array", "--states=all", &format!("--jobs={job}"), "--format=%K|%T|%r"];
    match run("squeue", &arguments, None) {
        Ok(text) => Ok(read_states(&text)),
        // Some minutes after its end Slurm forgets a job.
        Err(SlurmError::Refused { said, .. }) if said.contains("Invalid job id") => {
            Ok(BTreeMap::new())
        }
        Err(e) => Err(e),
    }
}

fn read_partitions(text: &str) -> Vec<Partition> {
    let read = |line: &str| {
        let mut parts = line.trim().split('|');
        let (name, up, cpus) = (parts.next()?, parts.next()?, parts.next()?);
        // Allocated / idle / other / total.
        let mut counts = cpus.split('/').map(|n| n.parse::<usize>().unwrap_or(0));
        let (allocated, idle) = (counts.next()?, counts.next().unwrap_or(0));
        Some(Partition {
            name: name.trim_end_matches('*').into(),
            default: name.ends_with('*'),
            up: up == "up",
            cpus: allocated.saturating_add(idle),
        })
    };
    text.lines().filter_map(read).filter(|p| !p.name.is_empty()).collect()
}

fn read_states(text: &str) -> BTreeMap<usize, Task> {
    let read = |line: &str| {
        let mut parts = line.trim().splitn(3, '|');
        let (number, word, reason) =
            (parts.next()?.parse().ok()?, parts.next()?, parts.next().unwrap_or_default());
        Some((
            number,
            Task { state: TaskState::of(word), word: word.into(), reason: reason.into() },
        ))
    };
    text.lines().filter_map(read).collect()
}

/// Runs a command and returns what it prints.
fn run(program: &str, arguments: &[&str], folder: Option<&Path>) -> Result<String, SlurmError> {
    let mut command = Command::new(program);
    command.args(arguments).stdin(Stdio::null()).env("LC_ALL", "C");
    if let Some(folder) = folder {
        command.current_dir(folder);
    }
    let output = command.output().map_err(|e| match e.kind() {
        std::io::ErrorKind::NotFound => SlurmError::NotInstalled { program: program.into() },
        _ => SlurmError::Refused { program: program.into(), said: e.to_string() },
    })?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let said = String::from_utf8_lossy(&output.stderr).trim().replace('\n', "; ");
    Err(SlurmError::Refused {
        program: program.into(),
        said: if said.is_empty() { output.status.to_string() } else { said },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_answers_of_slurm_are_read() {
        let all = read_partitions("main*|up|1/3/0/4\nold|down|0/0/8/8\n\nbroken\n");
        assert_eq!(all.len(), 2);
        assert_eq!(
            partition(&all, None).unwrap(),
            Partition { name: "main".into(), default: true, up: true, cpus: 4 }
        );
        assert!(matches!(partition(&all, Some("old")), Err(SlurmError::PartitionDown { .. })));
        assert!(partition(&all, Some("new")).unwrap_err().to_string().contains("main, old"));
        let states = read_states(
            "1|RUNNING|None\n2|PENDING|Resources\n3|CANCELLED|None\n4|COMPLETING|None\nN/A|PENDING|x\n",
        );
        assert_eq!(states.len(), 4);
        assert!(
            states[&1].state.is_alive()
                && states[&2].state.is_alive()
                && !states[&4].state.is_alive()
        );
        assert_eq!((states[&3].state, states[&2].reason.as_str()), (TaskState::Ended, "Resources"));
    }
}
