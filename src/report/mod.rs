//! Answers for people and for programs. No mechanics here: one file per format.

pub mod result;
pub mod text;

pub use result::ResultFile;
