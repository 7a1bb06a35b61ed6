//! The command, for whoever carries it: parse, dispatch, exit code.

use super::{
    again,
    args::{Cli, Verb},
    exit::{Exit, TimeIsUp},
    terminal::{self, Terminal},
};
use clap::{CommandFactory, FromArgMatches};
use std::{ffi::OsString, path::PathBuf};

/// How the program that carries the command keeps to `--max-memory` and to the limit of its control
/// group: both are called before anything large is there.
#[derive(Clone, Copy, Debug)]
pub struct Memory {
    /// Never takes more than so many bytes from now on.
    ///
    /// # Errors
    /// Why it cannot, in words.
    pub limit: fn(u64) -> Result<(), String>,
    /// Heeds the limit of the control group, where that is lower than the one given.
    pub heed_group: fn(Option<u64>),
}

/// Runs `voussoir` with these arguments, the first of them the program's own name, and says how it
/// ended. It writes to standard output and standard error, and may end the process (`--time-limit`,
/// memory). Interrupts are left to the system.
pub fn run(arguments: impl IntoIterator<Item = OsString>, memory: Memory) -> Exit {
    let mut command = Cli::command();
    let parsed = command.try_get_matches_from_mut(arguments).and_then(|matches| {
        let again = again::typed(&command, &matches);
        Ok((Cli::from_arg_matches(&matches)?, again))
    });
    let (arguments, again) = match parsed {
        Ok(parsed) => parsed,
        Err(answer) => return terminal::usage(&answer),
    };
    let terminal = Terminal::new(arguments.color, again.join(" "));
    if let Err(error) = arguments.max_memory.map_or(Ok(()), memory.limit) {
        terminal::error(&anyhow::Error::msg(error));
        return Exit::Usage;
    }
    (memory.heed_group)(arguments.max_memory);
    terminal::heed_environment();
    match dispatch(&arguments.verb, &terminal) {
        Ok(exit) => exit,
        Err(error) => {
            terminal::error(&error);
            if error.is::<TimeIsUp>() { Exit::Undecided } else { Exit::Usage }
        }
    }
}

/// As [`run`], of a program that is called by another path than that of its process: a script.
pub fn run_as(
    program: PathBuf,
    arguments: impl IntoIterator<Item = OsString>,
    memory: Memory,
) -> Exit {
    super::called::set_by(program);
    run(arguments, memory)
}

fn dispatch(verb: &Verb, terminal: &Terminal) -> anyhow::Result<Exit> {
    match verb {
        Verb::Assess(a) => super::assess::run(a, terminal),
        Verb::Limit(a) => super::limit::run(a, terminal),
        Verb::Tilt(a) => super::tilt::run(a, terminal),
        Verb::Critical(a) => super::critical::run(a, terminal),
        Verb::Thrust(a) => super::thrust::run(a, terminal),
        Verb::Settle(a) => super::path::settle(a, terminal),
        Verb::Push(a) => super::path::push(a, terminal),
        Verb::Kinematic(a) => super::kinematic::run(a, terminal),
        Verb::Stages(a) => super::stages::run(a, terminal),
        Verb::Without(a) => super::without::run(a, terminal),
        Verb::Combinations(a) => super::combinations::run(a, terminal),
        Verb::State(a) => super::state::run(a, terminal),
        Verb::Study(a) => super::study::run(a, terminal),
        Verb::Simulate(a) => super::simulate::run(a, terminal),
        Verb::Repose(a) => super::repose::run(a, terminal),
        Verb::Generate(a) => super::generate::run(a),
        Verb::Import(a) => super::import::run(a),
        Verb::Check(a) => super::check::run(a, terminal),
        Verb::Sweep(a) => super::sweep::run(a, terminal),
        Verb::Open(a) => super::open::run(a),
        Verb::Schema(a) => super::schema::run(a),
        Verb::Completions(a) => super::completions::run(a),
        Verb::Man(a) => super::man::run(a),
    }
}
