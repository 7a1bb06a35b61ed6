//! Answers for people and for programs. No mechanics here: one file per format.

pub mod json;
pub mod read;
pub mod result;
pub mod sweep;
pub mod text;
pub mod verify;

pub use result::{Leaning, ResultFile};
pub use verify::verify;
