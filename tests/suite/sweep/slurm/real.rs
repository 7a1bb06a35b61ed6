//! On a real Slurm: a node goes down, a task is cancelled, the terminal is lost; the file is that
//! of one machine.

use super::{
    super::{
        arch,
        command::{desk, expect_in},
    },
    cluster::Cluster,
    rows_of, untimed,
};
use serde_json::Value;
use std::{
    fs,
    io::Read,
    path::Path,
    process::{Child, Command, Stdio},
    thread::sleep,
    time::{Duration, Instant},
};

fn voussoir(folder: &Path, cluster: &Cluster, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_voussoir"));
    command.args(args).current_dir(folder).env("SLURM_CONF", &cluster.config);
    command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

/// Waits until `enough`, or until patience ends.
#[track_caller]
fn until(what: &str, seconds: u64, mut enough: impl FnMut() -> bool) {
    let start = Instant::now();
    while !enough() {
        assert!(start.elapsed() < Duration::from_secs(seconds), "waited {seconds} s for {what}");
        sleep(Duration::from_millis(100));
    }
}

/// A sweep without faults, and one with all of them. Prints the seconds; says why where there is no
/// Slurm.
fn survives(rows: usize, tasks: usize) -> Result<(), String> {
    let cluster = Cluster::start()?;
    let folder = desk(rows);
    let at = folder.path();
    // Rows of some 10 ms, so that there is a middle to be disturbed in.
    let mut scene = arch();
    scene["templates"][0]["arch"]["voussoirs"] = 100.into();
    fs::write(at.join("scene.json"), scene.to_string()).unwrap();
    let start = Instant::now();
    expect_in(
        0,
        voussoir(
            at,
            &cluster,
            &["sweep", "plan.json", "-o", "alone.jsonl", "-q", "--threads", "4"],
        )
        .output()
        .unwrap(),
    );
    let alone = start.elapsed().as_secs_f64();
    expect_in(
        0,
        voussoir(at, &cluster, &["sweep", "merge", "alone.jsonl", "-o", "merged.jsonl", "-q"])
            .output()
            .unwrap(),
    );

    let slurm = ["sweep", "plan.json", "--slurm", "--tasks", &tasks.to_string(), "-o", "out.jsonl"];
    let start = Instant::now();
    expect_in(0, voussoir(at, &cluster, &[&slurm[..], &["-q"]].concat()).output().unwrap());
    eprintln!(
        "{rows} rows: {alone:.1} s on four threads, {:.1} s in {tasks} tasks of two nodes with two cores",
        start.elapsed().as_secs_f64()
    );
    assert_eq!(untimed(&at.join("out.jsonl")), untimed(&at.join("merged.jsonl")));

    // Once more, and now nothing goes well.
    let slurm =
        ["sweep", "plan.json", "--slurm", "--tasks", &tasks.to_string(), "-o", "stormy.jsonl"];
    let done = at.join("stormy.jsonl.slurm");
    let start = Instant::now();
    let mut watching: Child = voussoir(at, &cluster, &slurm).spawn().unwrap();
    let mut job = String::new();
    until("the first rows", 60, || {
        if watching.try_wait().unwrap().is_some() {
            let mut said = String::new();
            watching.stderr.take().unwrap().read_to_string(&mut said).unwrap();
            panic!("it ended early: {said}");
        }
        let record: Option<Value> = fs::read_to_string(done.join("job.json"))
            .ok()
            .and_then(|t| serde_json::from_str(&t).ok());
        job = record.map(|r| r["jobs"][0].to_string()).unwrap_or_default();
        !job.is_empty() && rows_of(&done) > rows / 10
    });
    watching.kill().unwrap();
    watching.wait().unwrap();
    let running = |node: &str| {
        let text = cluster.answer("squeue", &["-h", "-r", "-t", "running", "-o", "%K %N"]);
        text.lines()
            .filter_map(|l| l.split_once(' '))
            .filter(|l| l.1 == node)
            .map(|l| l.0.to_string())
            .collect::<Vec<_>>()
    };
    until("tasks on both nodes", 60, || !running("n1").is_empty() && !running("n2").is_empty());
    let cancelled = running("n2")[0].clone();
    assert!(cluster.slurm("scancel", &[&format!("{job}_{cancelled}")]));
    assert!(cluster.kill_node(1) > 0, "no task ran on the node");
    let attached = voussoir(at, &cluster, &["sweep", "--attach", "stormy.jsonl"]).spawn().unwrap();
    until("the node to be missed", 120, || {
        cluster.answer("sinfo", &["-h", "-n", "n1", "-o", "%T"]).contains("down")
    });
    cluster.start_node(1);
    // Slurm makes a task that lost its node wait two minutes, until its credential has ended.
    let hurry = || {
        for line in cluster.answer("squeue", &["-h", "-r", "-t", "pending", "-o", "%A %r"]).lines()
        {
            if let Some(("BeginTime", job)) = line.split_once(' ').map(|(job, why)| (why, job)) {
                cluster.slurm("scontrol", &["update", &format!("jobid={job}"), "starttime=now"]);
            }
        }
    };
    until("the tasks that are left", 600, || {
        hurry();
        cluster.answer("squeue", &["-h", "-o", "%K"]).trim().is_empty()
    });
    let half = expect_in(3, attached.wait_with_output().unwrap());
    let said = String::from_utf8_lossy(&half.stderr).into_owned();
    assert!(
        said.contains(&format!("task {cancelled} of job {job} was stopped: CANCELLED")),
        "{said}"
    );
    let again = fs::read_dir(done.join("rows"))
        .unwrap()
        .filter(|e| e.as_ref().unwrap().file_name().to_string_lossy().ends_with("-2.jsonl"));
    assert!(again.count() > 0, "no task was started again");
    expect_in(
        3,
        voussoir(at, &cluster, &["sweep", "merge", "stormy.jsonl.slurm", "-q"]).output().unwrap(),
    );
    expect_in(0, voussoir(at, &cluster, &slurm).output().unwrap());
    eprintln!(
        "{rows} rows: {:.1} s with a node lost, a task cancelled and the terminal lost",
        start.elapsed().as_secs_f64()
    );
    assert_eq!(untimed(&at.join("stormy.jsonl")), untimed(&at.join("merged.jsonl")));
    // Bad input on the same cluster.
    let refused = expect_in(
        2,
        voussoir(at, &cluster, &["sweep", "plan.json", "--slurm", "-o", "x", "--partition", "new"])
            .output()
            .unwrap(),
    );
    assert!(String::from_utf8_lossy(&refused.stderr).contains("this cluster has main"));
    let refused = expect_in(
        2,
        voussoir(at, &cluster, &["sweep", "plan.json", "--slurm", "-o", "x", "--time", "soon"])
            .output()
            .unwrap(),
    );
    assert!(String::from_utf8_lossy(&refused.stderr).contains("sbatch reports an error"));
    Ok(())
}

#[test]
fn a_node_lost_a_task_cancelled_and_the_terminal_gone_on_a_real_slurm() {
    if let Err(why) = survives(1_500, 8) {
        crate::skipped(&why);
    }
}

/// The figures of the documentation: minutes.
#[test]
#[ignore = "takes minutes"]
fn ten_thousand_rows_on_a_real_slurm() {
    if let Err(why) = survives(10_000, 8) {
        crate::skipped(&why);
    }
}
