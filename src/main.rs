//! The command line: the library's command, with the allocator that keeps to its limits.

mod memory;

use std::process::ExitCode;

#[global_allocator]
static MEMORY: memory::Counted = memory::Counted;

fn main() -> ExitCode {
    memory::heed_threads();
    voussoir::command::run(std::env::args_os(), memory::LIMITS).into()
}
