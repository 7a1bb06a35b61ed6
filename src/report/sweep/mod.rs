//! Sweeps as text, table and chart.

pub(crate) mod chart;
pub(crate) mod group;
mod progress;
mod table;
mod text;

use analysis::Question;
use serde::Serialize;
use sweep::{Header, Summary};

pub use chart::{Kind, chart};
pub use progress::{SweepProgress, progress};
pub use table::csv;
pub use text::summary;

/// The summary as JSON (`"format": "voussoir-summary/1"`).
#[derive(Clone, Debug, Serialize)]
pub struct Document<'a> {
    format: &'static str,
    name: &'a str,
    question: &'a Question,
    /// Rows of the plan; `summary.rows` are there.
    rows: usize,
    summary: &'a Summary,
}

impl<'a> Document<'a> {
    /// A summary with what it is about.
    pub fn new(header: &'a Header, summary: &'a Summary) -> Self {
        Self {
            format: "voussoir-summary/1",
            name: &header.plan.name,
            question: &header.plan.question,
            rows: header.rows,
            summary,
        }
    }
}
