//! Sweeps on a cluster: with commands that stand in for Slurm's everywhere, with a real Slurm where
//! one can be brought up.

mod cluster;
mod real;

use super::command::{desk, expect_in, rows};
use serde_json::Value;
use std::{
    ffi::OsString,
    fs,
    path::Path,
    process::{Command, Output, Stdio},
};
use tempfile::TempDir;

/// Commands that answer as Slurm does. They are files of the repository: one that a test has just
/// written cannot always be run, for a process that another test is starting may still have it
/// open.
const FAKES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/suite/sweep/slurm/fakes");

/// A folder with a plan, and a path to the commands.
struct Fake {
    desk: TempDir,
    path: OsString,
}

impl Fake {
    fn new(samples: usize) -> Self {
        let path =
            std::env::join_paths([Path::new(FAKES), Path::new("/usr/bin"), Path::new("/bin")])
                .unwrap();
        Self { desk: desk(samples), path }
    }

    fn at(&self) -> &Path {
        self.desk.path()
    }

    fn ask(&self, args: &[&str], environment: &[(&str, &str)]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_voussoir"));
        command
            .args(args)
            .current_dir(self.at())
            .env("PATH", &self.path)
            .envs(environment.iter().copied());
        command.stdin(Stdio::null()).output().unwrap()
    }

    #[track_caller]
    fn expect(&self, code: i32, args: &[&str], environment: &[(&str, &str)]) -> Output {
        expect_in(code, self.ask(args, environment))
    }

    #[track_caller]
    fn refused(&self, args: &[&str], environment: &[(&str, &str)], word: &str) {
        let error = String::from_utf8(self.expect(2, args, environment).stderr).unwrap();
        assert!(error.contains(word), "{error}");
        assert!(self.submitted().is_empty(), "{args:?} was submitted");
    }

    fn submitted(&self) -> Vec<String> {
        fs::read_to_string(self.at().join("submitted"))
            .unwrap_or_default()
            .lines()
            .map(str::to_string)
            .collect()
    }

    /// The merged rows of one machine, times left out.
    fn alone(&self) -> Vec<String> {
        self.expect(0, &["sweep", "plan.json", "-o", "alone.jsonl", "-q"], &[]);
        self.expect(0, &["sweep", "merge", "alone.jsonl", "-o", "merged.jsonl", "-q"], &[]);
        untimed(&self.at().join("merged.jsonl"))
    }
}

/// Lines without their times.
fn untimed(path: &Path) -> Vec<String> {
    let text = fs::read_to_string(path).unwrap();
    text.lines()
        .map(|l| l.rsplit_once(",\"seconds\":").map_or(l, |(row, _)| row).to_string())
        .collect()
}

#[test]
fn an_array_gives_the_file_of_one_machine_and_goes_on_where_it_was_stopped() {
    let fake = Fake::new(40);
    let slurm = ["sweep", "plan.json", "--slurm", "--tasks", "4", "-o", "out.jsonl"];
    let stopped = fake.expect(3, &slurm, &[("FAKE_SKIP", "2")]);
    let said = String::from_utf8_lossy(&stopped.stderr).into_owned();
    assert!(said.contains("10 of 40 rows are missing, the first is row 1"), "{said}");
    assert!(said.contains("sweep --attach out.jsonl") && said.contains("scancel 17"), "{said}");
    // A half-finished folder can be looked at and merged.
    let status = fake.expect(
        3,
        &["sweep", "status", "out.jsonl", "--json"],
        &[("FAKE_STATE", "2|CANCELLED|None")],
    );
    let status: Value = serde_json::from_slice(&status.stdout).unwrap();
    assert_eq!((&status["done"], &status["first_missing"]), (&30.into(), &1.into()));
    assert_eq!(status["tasks"][0][0], "cancelled");
    let page = fake.expect(3, &["sweep", "status", "out.jsonl.slurm"], &[]);
    assert!(String::from_utf8_lossy(&page.stdout).contains("30 of 40 rows: 30 found"));
    fake.expect(3, &["sweep", "merge", "out.jsonl.slurm", "-o", "half.jsonl", "-q"], &[]);
    assert_eq!(rows(&fake.at().join("half.jsonl")).len(), 30);
    fake.expect(3, &["sweep", "--attach", "out.jsonl", "-q"], &[]);
    fake.expect(0, &slurm, &[]);
    assert_eq!(fake.submitted(), ["1-4", "2"]);
    assert_eq!(untimed(&fake.at().join("out.jsonl")), fake.alone());
    // Once all is there nothing is submitted.
    fake.expect(0, &slurm, &[]);
    fake.expect(0, &["sweep", "--attach", "out.jsonl", "-q"], &[]);
    fake.expect(0, &["sweep", "status", "out.jsonl"], &[]);
    assert_eq!(fake.submitted().len(), 2);
    // Unless all is to be done again.
    fake.expect(0, &[&slurm[..], &["--restart"]].concat(), &[]);
    assert_eq!(fake.submitted(), ["1-4", "2", "1-4"]);
}

#[test]
fn rows_that_are_there_are_not_done_again() {
    let fake = Fake::new(12);
    fake.expect(0, &["sweep", "plan.json", "-o", "out.jsonl", "-q"], &[]);
    let whole = fs::read_to_string(fake.at().join("out.jsonl")).unwrap();
    let half: String = whole.lines().take(7).map(|l| format!("{l}\n")).collect();
    fs::write(fake.at().join("out.jsonl"), half).unwrap();
    // Here a few rows are measured first: they are rows as well, and the last ones.
    fake.expect(0, &["sweep", "plan.json", "--slurm", "-o", "out.jsonl", "-q"], &[]);
    let folder = fake.at().join("out.jsonl.slurm/rows");
    let of = |name: &str| rows(&folder.join(name)).len();
    assert_eq!((of("earlier.jsonl"), of("measured.jsonl")), (6, 6));
    assert!(fake.submitted().is_empty());
    assert_eq!(untimed(&fake.at().join("out.jsonl")), fake.alone());
}

#[test]
fn a_task_killed_again_and_again_loses_no_row_and_does_none_twice() {
    const ROWS: usize = 160;
    let fake = Fake::new(ROWS);
    fake.expect(
        3,
        &["sweep", "plan.json", "--slurm", "--tasks", "2", "-o", "out.jsonl", "-q"],
        &[("FAKE_SKIP", "1")],
    );
    let folder = fake.at().join("out.jsonl.slurm");
    let size = || {
        fs::read_dir(folder.join("rows"))
            .unwrap()
            .map(|e| e.unwrap().metadata().map_or(0, |m| m.len()))
            .sum::<u64>()
    };
    let task = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_voussoir"));
        command
            .args(["sweep", "task", "out.jsonl.slurm", "--shard", "1/2", "--threads", "2"])
            .current_dir(fake.at());
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    };
    let all = size();
    for kill in 1..=6 {
        let mut child = task().spawn().unwrap();
        while size() < all + kill * all / 9 && child.try_wait().unwrap().is_none() {
            std::thread::yield_now();
        }
        child.kill().unwrap();
        child.wait().unwrap();
    }
    assert!(rows_of(&folder) < ROWS, "it was over before it was killed");
    expect_in(0, task().output().unwrap());
    fake.expect(0, &["sweep", "--attach", "out.jsonl", "-q"], &[]);
    assert_eq!(untimed(&fake.at().join("out.jsonl")), fake.alone());
    assert_eq!(rows_of(&folder), ROWS);
}

/// Whole rows in all files of a folder, those that are there twice counted twice.
fn rows_of(folder: &Path) -> usize {
    let lines =
        |path: &Path| fs::read_to_string(path).unwrap().matches('\n').count().saturating_sub(1);
    fs::read_dir(folder.join("rows"))
        .map_or(0, |files| files.map(|e| lines(&e.unwrap().path())).sum())
}

#[test]
fn what_slurm_cannot_do_is_said_before_anything_is_submitted() {
    let fake = Fake::new(6);
    let slurm = |more: &[&'static str]| {
        [&["sweep", "plan.json", "--slurm", "-o", "out.jsonl", "--tasks", "2"], more].concat()
    };
    fake.refused(&slurm(&[]), &[("PATH", "/nonexistent")], "`sbatch` is not on the path");
    fake.refused(
        &slurm(&["--partition", "new"]),
        &[],
        "no partition \"new\"; hint: this cluster has main, old",
    );
    fake.refused(&slurm(&["--partition", "old"]), &[], "starts no jobs");
    fake.refused(&slurm(&["--partition", "a b"]), &[], "not a single word");
    fake.refused(&slurm(&["--sbatch-arg=account"]), &[], "not an option");
    fake.refused(&slurm(&["--threads", "2"]), &[], "cannot be used with");
    fake.refused(&["sweep", "plan.json", "--tasks", "2"], &[], "--slurm");
    fake.refused(&["sweep", "--attach", "out.jsonl"], &[], "no job was submitted for out.jsonl");
    fake.refused(&["sweep", "plan.json", "--slurm", "-o", "nowhere/out.jsonl"], &[], "nowhere");
    fake.refused(&["sweep", "plan.json", "--slurm", "-o", "scene.json"], &[], "would overwrite");
    std::fs::copy(fake.at().join("scene.json"), fake.at().join("other.json")).unwrap();
    fake.refused(
        &["sweep", "plan.json", "--slurm", "-o", "other.json"],
        &[],
        "not the header of a file of rows",
    );
    fake.refused(&["sweep", "task", "out.jsonl.slurm", "--shard", "1/2"], &[], "finds no sweep");
    fake.refused(&["sweep", "status", "out.jsonl"], &[], "cannot be read");
    assert!(!fake.at().join("out.jsonl").exists() && !fake.at().join("out.jsonl.slurm").exists());
    // A disk of this machine, where the nodes are others.
    let mounts = fs::read_to_string("/proc/self/mountinfo").unwrap();
    let mount = voussoir::sweep::slurm::mount_of(
        fake.at().canonicalize().unwrap().to_str().unwrap(),
        &mounts,
    )
    .unwrap();
    if voussoir::sweep::slurm::is_shared(&mount, &["far".to_string()], "here") {
        crate::skipped(&format!("in part: {} is a shared file system", mount.kind));
    } else {
        fake.refused(&slurm(&[]), &[("FAKE_HOST", "far")], "which nodes such as far cannot reach");
        fake.expect(0, &slurm(&["--shared", "-q"]), &[("FAKE_HOST", "far")]);
        assert_eq!(fake.submitted(), ["1-2"]);
        fs::remove_file(fake.at().join("submitted")).unwrap();
        fs::remove_dir_all(fake.at().join("out.jsonl.slurm")).unwrap();
        fs::remove_file(fake.at().join("out.jsonl")).unwrap();
    }
    // Slurm's own refusals in its own words; a job that is alive is not submitted again.
    fake.refused(
        &slurm(&[]),
        &[("FAKE_REFUSAL", "Invalid account")],
        "sbatch reports an error: Invalid account",
    );
    assert!(
        !fake.at().join("out.jsonl").exists(),
        "a submission that is refused leaves a header behind"
    );
    fake.expect(0, &slurm(&["-q"]), &[]);
    fs::remove_file(fake.at().join("submitted")).unwrap();
    fake.refused(
        &slurm(&["--restart"]),
        &[("FAKE_STATE", "1|RUNNING|None")],
        "job 17 is still computing",
    );
    fs::write(fake.at().join("out.jsonl.slurm/job.json"), "{").unwrap();
    fake.refused(&slurm(&[]), &[], "not the record of a job");
    // Rows of another plan.
    fs::write(
        fake.at().join("out.jsonl.slurm/job.json"),
        r#"{"format":"voussoir-slurm/1","tasks":2,"jobs":[17]}"#,
    )
    .unwrap();
    let mut plan: Value =
        serde_json::from_str(&fs::read_to_string(fake.at().join("plan.json")).unwrap()).unwrap();
    plan["seed"] = 9.into();
    fs::write(fake.at().join("plan.json"), plan.to_string()).unwrap();
    fake.refused(&slurm(&[]), &[], "the seed differs");
}

#[test]
fn a_dry_run_prints_the_script_and_leaves_nothing() {
    let fake = Fake::new(8);
    let args = [
        "sweep",
        "plan.json",
        "--slurm",
        "--dry-run",
        "--tasks",
        "3",
        "--cpus",
        "2",
        "--time",
        "10",
        "--sbatch-arg=--account=stone",
    ];
    let before = fs::read_dir(fake.at()).unwrap().count();
    let text = String::from_utf8(fake.expect(0, &args, &[]).stdout).unwrap();
    for line in ["--array=1-3", "--cpus-per-task=2", "--time=10", "--account=stone", "--requeue"] {
        assert!(text.lines().any(|l| l == format!("#SBATCH {line}")), "{line}: {text}");
    }
    // Also where there is no Slurm.
    let few = fake.expect(
        0,
        &["sweep", "plan.json", "--slurm", "--dry-run"],
        &[("PATH", "/nonexistent")],
    );
    assert!(String::from_utf8_lossy(&few.stdout).contains("#SBATCH --array=1\n"));
    assert_eq!(fs::read_dir(fake.at()).unwrap().count(), before);
    assert!(fake.submitted().is_empty());
}
