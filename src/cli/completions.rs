//! `voussoir completions`: what a shell needs to complete verbs, options and their values.

use super::{
    args::{Cli, Completions},
    exit::Exit,
    terminal,
};
use clap::CommandFactory;

pub fn run(args: &Completions) -> anyhow::Result<Exit> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "voussoir", &mut script);
    terminal::print(&String::from_utf8(script)?)?;
    Ok(Exit::Yes)
}
