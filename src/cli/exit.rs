//! Exit codes.

use std::process::ExitCode;

/// How a verb ended. An interrupt (130) is left to the system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Exit {
    /// Yes, or done.
    Yes = 0,
    /// A clean negative answer: it falls, the requirement is not met, the result is refuted, the
    /// scene has mistakes.
    No = 1,
    /// The command line or an input file is wrong, or a file cannot be written.
    Usage = 2,
    /// The question was asked properly and stayed open.
    Undecided = 3,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        ExitCode::from(exit as u8)
    }
}

/// Nothing came out in time: an error that leaves the question open.
#[derive(Debug)]
pub struct TimeIsUp(pub String);

impl std::fmt::Display for TimeIsUp {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for TimeIsUp {}
