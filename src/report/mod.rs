//! Answers for people and for programs. No mechanics here: one file per format.

mod cells;
pub mod contacts;
pub mod critical;
pub mod drawing;
pub mod forge;
pub mod heaps;
pub mod imported;
pub mod inspection;
pub mod json;
pub mod packing;
pub mod page;
mod part;
pub mod read;
pub mod result;
pub mod simulation;
pub mod study;
pub mod sweep;
pub mod table;
pub mod text;
pub mod thrust;
pub mod trajectory;
pub mod verification;
pub mod verify;
pub mod view;
pub mod vtk;
pub mod work;

pub use inspection::Inspection;
pub use packing::PackingFile;
pub use result::{Leaning, ResultFile};
pub use simulation::Simulation;
pub use verification::VerificationFile;
pub use verify::verify;
