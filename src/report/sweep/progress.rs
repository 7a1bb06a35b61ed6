//! How far a sweep is, as a page and as JSON (`"format": "voussoir-progress/1"`).

use crate::text::{Layout, Page, Role};
use base::number::count;
use serde::Serialize;
use std::collections::BTreeMap;
use sweep::{Header, Row};

/// How far a sweep is.
#[derive(Clone, Debug, Serialize)]
pub struct SweepProgress {
    format: &'static str,
    name: String,
    /// Rows that are asked for.
    rows: usize,
    /// Rows that are done.
    done: usize,
    /// How they ended.
    counts: BTreeMap<&'static str, usize>,
    /// The first row that is missing.
    #[serde(skip_serializing_if = "Option::is_none")]
    first_missing: Option<usize>,
    /// Lines that are no rows, left out.
    damaged: usize,
    /// Tasks of the cluster by what they do.
    tasks: Vec<(String, usize)>,
}

impl SweepProgress {
    /// Of the rows in a file or folder; `tasks` are what the cluster says, with how many of each.
    pub fn new(header: &Header, rows: &[Row], damaged: usize, tasks: Vec<(String, usize)>) -> Self {
        let mut counts = BTreeMap::new();
        rows.iter().for_each(|row| *counts.entry(row.answer.status.word()).or_default() += 1);
        let first_missing = header
            .shard
            .rows(header.rows)
            .zip(rows.iter().map(|r| Some(r.row)).chain(std::iter::repeat(None)));
        Self {
            format: "voussoir-progress/1",
            name: header.plan.name.clone(),
            rows: header.shard.rows(header.rows).count(),
            done: rows.len(),
            counts,
            first_missing: first_missing
                .into_iter()
                .find(|(wanted, there)| Some(*wanted) != *there)
                .map(|(wanted, _)| wanted),
            damaged,
            tasks,
        }
    }

    /// Whether every row is there.
    pub fn is_complete(&self) -> bool {
        self.done >= self.rows
    }
}

/// The page.
pub fn progress(progress: &SweepProgress, layout: Layout) -> Page {
    let mut page = Page::new(layout);
    let list = |parts: Vec<String>| parts.join(", ");
    let counts = list(progress.counts.iter().map(|(word, n)| format!("{n} {word}")).collect());
    let ended = if counts.is_empty() { counts } else { format!(": {counts}") };
    let role = if progress.is_complete() { Role::Value } else { Role::Unsure };
    page.title(
        &progress.name,
        format!("{} of {}{ended}", progress.done, count(progress.rows, "row")),
        role,
    );
    page.blank();
    if let Some(first) = progress.first_missing {
        page.row(
            "missing",
            [format!(
                "{}, the first is row {first}",
                count(progress.rows - progress.done.min(progress.rows), "row")
            )],
        );
    }
    if progress.damaged > 0 {
        page.row(
            "damaged",
            [format!("{} ignored; their rows count as missing", count(progress.damaged, "line"))],
        );
    }
    if !progress.tasks.is_empty() {
        page.row(
            "tasks",
            [list(progress.tasks.iter().map(|(word, n)| format!("{n} {word}")).collect())],
        );
    }
    page
}
