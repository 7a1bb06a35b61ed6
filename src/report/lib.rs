//! Answers for people and for programs. No mechanics here: one file per format.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod cells;
pub mod chart;
pub mod contacts;
pub mod drawing;
mod error;
pub mod gltf;
pub mod grains;
pub mod ground;
pub mod heaps;
pub mod imported;
pub mod inspection;
pub mod json;
pub mod keys;
pub mod models;
pub mod obj;
pub mod page;
pub mod record;
pub mod study;
pub mod sweep;
pub mod table;
pub mod tell;
pub mod text;
pub mod trajectory;
pub mod view;
pub mod vtk;

pub use error::ReportError;
pub use inspection::Inspection;
