//! Answers for people and for programs. No mechanics here: one file per format.

pub mod contacts;
pub mod critical;
pub mod heaps;
pub mod inspection;
pub mod json;
pub mod packing;
pub mod read;
pub mod result;
pub mod simulation;
pub mod study;
pub mod svg;
pub mod sweep;
pub mod text;
pub mod thrust;
pub mod trajectory;
pub mod verification;
pub mod verify;
pub mod work;

pub use inspection::Inspection;
pub use packing::PackingFile;
pub use result::{Leaning, ResultFile};
pub use simulation::Simulation;
pub use verification::VerificationFile;
pub use verify::verify;
