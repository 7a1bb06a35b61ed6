//! What proves an answer, from the scene alone: verdicts with their evidence, exact arithmetic,
//! results as files and their verification. No solver, no thread, no clock; nothing here knows a
//! program of limit analysis.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod elastic;
pub mod ground;
pub mod kinematic;
pub mod path;
pub mod proof;
pub mod question;
pub mod rocking;
pub mod sensitivity;
pub mod terms;
pub mod verdict;
