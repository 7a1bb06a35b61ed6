//! One integration binary: tests by behaviour.

mod cli;
mod reference;
