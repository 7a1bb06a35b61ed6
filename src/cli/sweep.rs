//! `voussoir sweep` and `voussoir sweep merge`

use super::{
    args::{Merge, Sweep, SweepVerb},
    claim,
    exit::Exit,
    input,
    output::Sink,
    sinks::{Sinks, bar},
    slurm,
    terminal::{self, Terminal},
};
use anyhow::{Context, bail};
use std::path::{Path, PathBuf};
use voussoir::{
    interface::prepare,
    report::sweep as report,
    scene::Scene,
    sweep::{self, Event, RunOptions},
};

pub fn run(args: &Sweep, terminal: &Terminal) -> anyhow::Result<Exit> {
    match &args.verb {
        Some(SweepVerb::Merge(merge)) => return merged(merge, terminal),
        Some(SweepVerb::Status(status)) => return slurm::status::run(status, terminal),
        Some(SweepVerb::Task(task)) => return slurm::task::run(task),
        None => {}
    }
    if let Some(output) = &args.slurm.attach {
        return slurm::watch::attach(output, &args.summary, terminal);
    }
    let plan = args.plan.as_deref().context("no plan is given")?;
    let (name, bytes) = input::bytes(plan)?;
    let folder = if plan.as_os_str() == "-" {
        Path::new("")
    } else {
        plan.parent().unwrap_or(Path::new(""))
    };
    let sweep = sweep::open_bytes(name, bytes, folder, args.outside.reach())?;
    terminal::notes(&sweep.findings);
    // The scene as the file has it, where that can be resolved before a row gives it its numbers.
    if let Some(model) =
        Scene::from_value(sweep.scene.clone()).ok().and_then(|scene| prepare(&scene).ok())
    {
        terminal::warnings(model.findings());
    }
    args.summary.chart.map_or(Ok(()), |kind| report::Kind::from(kind).fits(&sweep.plan))?;
    claim::read(&folder.join(&sweep.plan.scene))?;
    let output = rows_file(args, plan)?;
    claim::written(&output)?;
    let sinks = Sinks::open(&args.summary)?;
    if args.slurm.slurm {
        return slurm::submit::run(args, &sweep, &output, &sinks, terminal);
    }
    let options = RunOptions {
        shard: args.shard,
        threads: args.threads.map(terminal::threads),
        restart: args.restart,
    };
    let bar = bar(args.summary.quiet);
    let quiet = args.summary.quiet;
    let done = sweep::run(&sweep, &output, &options, &|event| match event {
        Event::Begin { rows, there, mended, unchecked } => {
            bar.set_length((rows - there) as u64);
            if mended > 0 {
                terminal::say(&format!(
                    "note: the last row is incomplete ({mended} bytes) and is computed again"
                ));
            }
            slurm::say_unchecked(unchecked);
            if there > 0 && !quiet {
                terminal::say(&format!(
                    "note: {} already holds {there} of {rows} rows",
                    output.display()
                ));
            }
        }
        Event::Row(_) => bar.inc(1),
    });
    bar.finish_and_clear();
    let done = done?;
    sinks.write(&args.summary, &done.header, &done.rows, terminal)
}

fn merged(args: &Merge, terminal: &Terminal) -> anyhow::Result<Exit> {
    args.rows.iter().try_for_each(|rows| claim::read(rows))?;
    let sinks = Sinks::open(&args.summary)?;
    let rows = args.output.as_deref().map(|p| Sink::open(Some(p))).transpose()?;
    let merged = sweep::merge(&args.rows)?.context("no file of rows is given")?;
    if let Some(rows) = rows {
        rows.write(&merged.text()?)?;
    }
    let exit = sinks.write(&args.summary, &merged.header, &merged.rows, terminal)?;
    slurm::say_damaged(merged.damaged);
    slurm::say_unchecked(merged.unchecked);
    match merged.missing() {
        None => Ok(exit),
        Some((many, first)) => {
            terminal::say(&format!(
                "note: {many} of {} rows are missing, the first is row {first}",
                merged.header.rows
            ));
            Ok(Exit::Undecided)
        }
    }
}

/// Where rows go.
fn rows_file(args: &Sweep, plan: &Path) -> anyhow::Result<PathBuf> {
    match (&args.output, plan.file_stem()) {
        (Some(output), _) if output.as_os_str() == "-" => {
            bail!("--output needs a file, so that an interrupted run can be resumed")
        }
        (Some(output), _) => Ok(output.clone()),
        (None, Some(stem)) if plan.as_os_str() != "-" => {
            let (number, of) = args.shard.numbers();
            let shard = if of > 1 { format!(".{number}-of-{of}") } else { String::new() };
            Ok(PathBuf::from(format!("{}{shard}.rows.jsonl", stem.to_string_lossy())))
        }
        _ => bail!("a plan from standard input needs --output FILE for its rows"),
    }
}
