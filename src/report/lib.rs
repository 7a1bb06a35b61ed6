//! Answers for people and for programs. No mechanics here: one file per format.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod cells;
pub mod contacts;
pub mod drawing;
pub mod gltf;
pub mod grains;
pub mod ground;
pub mod heaps;
pub mod imported;
pub mod inspection;
pub mod json;
pub mod keys;
pub mod kinematic;
pub mod moving;
pub mod obj;
pub mod page;
pub mod path;
mod plot;
pub mod record;
pub mod stages;
pub mod state;
pub mod study;
pub mod sweep;
pub mod table;
pub mod text;
pub mod trajectory;
pub mod view;
pub mod vtk;

pub use inspection::Inspection;
