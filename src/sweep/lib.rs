//! One question over many scenes that differ in a few numbers or words.
//!
//! A [`Plan`] names a scene, a question and the numbers that vary, each by JSON pointer. [`open`]
//! checks all of it and gives a [`Sweep`]; [`run`] answers it row by row into a file of rows
//! ([`Header`], then one [`Row`] a line as it ends), which a later run takes up where a killed one
//! left it. Row *i* is a function of (plan, scene, *i*) alone: not of threads, shards, or of which
//! rows ran before. [`merge`] puts shards together, [`Folder`] and [`slurm`] spread them over the
//! machines of a cluster, [`summarize`] says what the rows have in common.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

mod distribution;
mod file;
mod folder;
mod fragility;
mod influence;
pub mod keep;
mod lognormal;
mod mean;
mod merge;
mod open;
pub mod path;
mod plan;
mod pointer;
mod records;
mod row;
mod run;
mod sampling;
mod shard;
pub mod slurm;
pub mod study;
mod sum;
mod summary;
mod worst;

pub use file::{Opened, RowsFile, parse_rows, read_rows};
pub use folder::{Folder, Gathered, Tally};
pub use fragility::{Fragility, Proportion, is_sample, wilson};
pub use influence::{Influence, groups, influence, same};
pub use lognormal::LognormalFit;
pub use mean::Mean;
pub use merge::{Merged, merge};
pub use open::{MOST_ROWS, Sweep, open, open_bytes, read_plan};
pub use plan::{Lognormal, Normal, Parameter, Plan, Sampling, Vary, schema};
pub use row::{Header, Row, RowAnswer, RowStatus};
pub use run::{Done, Event, RunOptions, measure, run, run_in, run_until};
pub use shard::Shard;
pub use summary::{Quantiles, Shown, Summary, summarize, value_of};
pub use worst::{Between, Worst, worst};
