//! What every crate of the house stands on: errors, tolerances, numbers, limits, files, plane
//! geometry.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod error;
pub mod files;
pub mod limits;
pub mod number;
pub mod plain;
pub mod plane;
pub mod tolerance;
