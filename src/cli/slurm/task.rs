//! `voussoir sweep task`: one task of the array.

use crate::cli::{args::Task, exit::Exit, terminal};
use anyhow::Context;
use std::time::Instant;
use voussoir::sweep::{Folder, RunOptions, run_in};

pub fn run(args: &Task) -> anyhow::Result<Exit> {
    let start = Instant::now();
    let seen = || {
        format!(
            "this node finds no sweep in {}; it must see the folder under the same path",
            args.folder.display()
        )
    };
    let folder = Folder::open(&args.folder).with_context(seen)?;
    let sweep = folder.sweep()?;
    let options = RunOptions {
        shard: args.shard,
        threads: args.threads.map(terminal::threads),
        restart: false,
    };
    let (number, of) = args.shard.numbers();
    let name = format!("task-{number:0width$}", width = of.to_string().len());
    let done = run_in(&sweep, &folder, &name, &options, &|_| {})?;
    let seconds = start.elapsed().as_secs_f64();
    terminal::print(&format!(
        "shard {}: {done} rows in {seconds:.1} s, the others were already done\n",
        args.shard
    ))?;
    Ok(Exit::Yes)
}
