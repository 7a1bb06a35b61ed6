//! The command line: parse, dispatch, exit code.

mod cli;

use clap::Parser;
use cli::{
    args::{Cli, Verb},
    exit::{Exit, TimeIsUp},
    terminal::{self, Terminal},
};
use std::process::ExitCode;

#[global_allocator]
static MEMORY: cli::memory::Counted = cli::memory::Counted;

fn main() -> ExitCode {
    let arguments = match Cli::try_parse() {
        Ok(arguments) => arguments,
        Err(answer) => return terminal::usage(&answer).into(),
    };
    let terminal = Terminal::new(arguments.color);
    if let Err(error) = arguments.max_memory.map_or(Ok(()), cli::memory::limit) {
        terminal::error(&error);
        return Exit::Usage.into();
    }
    cli::memory::heed_group(arguments.max_memory);
    let result = match arguments.verb {
        Verb::Assess(a) => cli::assess::run(&a, &terminal),
        Verb::Limit(a) => cli::limit::run(&a, &terminal),
        Verb::Tilt(a) => cli::tilt::run(&a, &terminal),
        Verb::Critical(a) => cli::critical::run(&a, &terminal),
        Verb::Thrust(a) => cli::thrust::run(&a, &terminal),
        Verb::Settle(a) => cli::path::settle(&a, &terminal),
        Verb::Push(a) => cli::path::push(&a, &terminal),
        Verb::Kinematic(a) => cli::kinematic::run(&a, &terminal),
        Verb::Study(a) => cli::study::run(&a, &terminal),
        Verb::Simulate(a) => cli::simulate::run(&a, &terminal),
        Verb::Repose(a) => cli::repose::run(&a, &terminal),
        Verb::Generate(a) => cli::generate::run(&a),
        Verb::Import(a) => cli::import::run(&a),
        Verb::Check(a) => cli::check::run(&a, &terminal),
        Verb::Sweep(a) => cli::sweep::run(&a, &terminal),
        Verb::Schema(a) => cli::schema::run(&a),
        Verb::Completions(a) => cli::completions::run(&a),
        Verb::Man(a) => cli::man::run(&a),
    };
    match result {
        Ok(exit) => exit.into(),
        Err(error) => {
            terminal::error(&error);
            let open = error.is::<TimeIsUp>();
            if open { Exit::Undecided } else { Exit::Usage }.into()
        }
    }
}
