//! Arguments, terminal and exit codes; one file per verb. No mechanics: what is asked is a call to
//! the library. Of all this the library shows [`run`](run::run) alone, for programs that carry the
//! command.

pub mod again;
pub mod args;
pub mod assess;
mod called;
mod camera;
pub mod check;
mod claim;
mod combinations;
pub mod completions;
pub mod cracks;
pub mod critical;
pub mod deadline;
pub mod exit;
pub mod generate;
mod ground;
mod heap;
pub mod import;
mod input;
mod kept;
pub mod kinematic;
pub mod limit;
pub mod man;
pub mod moving;
mod nested;
pub mod open;
mod output;
pub mod path;
mod pictures;

mod progress;
mod question;
mod report;
pub mod repose;
pub mod run;
pub mod schema;
pub mod simulate;
mod sinks;
mod slurm;
pub mod stages;
pub mod state;
pub mod study;
pub mod sweep;
pub mod terminal;
pub mod thrust;
pub mod tilt;
mod told;
mod without;
