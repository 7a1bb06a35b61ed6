//! # voussoir
//!
//! Tells whether things made of rigid pieces that only touch stand or fall, and proves it.

#![warn(missing_docs)]

pub mod error;
pub mod tolerance;

pub mod scene;

pub mod generate;

pub mod import;

pub mod assembly;

pub mod interface;

pub mod program;

pub mod solve;

pub mod verdict;

pub mod analysis;

pub mod report;
