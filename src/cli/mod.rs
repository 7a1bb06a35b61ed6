//! Arguments, terminal and exit codes; one file per verb. No mechanics: what is asked is a call to the library.

pub mod again;
pub mod args;
pub mod assess;
pub mod check;
pub mod critical;
pub mod exit;
pub mod generate;
mod heap;
pub mod import;
mod input;
pub mod limit;
mod output;
mod progress;
mod question;
pub mod repose;
pub mod schema;
pub mod simulate;
mod slurm;
pub mod study;
pub mod sweep;
pub mod terminal;
pub mod thrust;
pub mod tilt;
