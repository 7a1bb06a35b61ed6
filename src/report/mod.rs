//! Answers for people and for programs. No mechanics here: one file per format.

pub mod contacts;
pub mod heaps;
pub mod json;
pub mod packing;
pub mod read;
pub mod result;
pub mod simulation;
pub mod text;
pub mod trajectory;
pub mod verify;

pub use packing::PackingFile;
pub use result::{Leaning, ResultFile};
pub use simulation::Simulation;
pub use verify::verify;
