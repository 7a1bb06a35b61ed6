//! The positions of a train with their load factors.

use super::{Part, Section};
use crate::tell::moving::value;
use base::number::{count, short};
use check::proof::result::ResultFile;
use model::train::is_symmetric;

/// Characters of a number.
const WIDE: usize = 8;

/// A row for each position.
pub(super) fn section(file: &ResultFile) -> Option<Section> {
    let all: Vec<_> = file.directions.iter().filter_map(|d| d.answer.moving()).collect();
    let both = file.scene.input.train.as_ref().is_some_and(is_symmetric);
    let row = |a: &&check::proof::moving::MovingAnswer| {
        let factor = value(a);
        let travel = if both { "both" } else { a.travel.words().trim_start_matches("towards ") };
        let factor = factor.strip_prefix("λ = ").unwrap_or(&factor);
        vec![short(a.x), travel.into(), factor.into()]
    };
    let mut rows: Vec<Vec<String>> = all.iter().map(row).collect();
    rows.dedup();
    let note = format!(
        "{}: steps, and places around the least, which are shown once where they read alike.",
        count(all.len(), "position")
    );
    let columns = ["#position, m", "towards", "#λ"];
    // A value in words takes the room of two.
    let wide = rows.iter().any(|row| row[2].chars().count() > WIDE);
    let table = |rows| Part::table(&columns, rows, &note).across(if wide { 2 } else { 4 });
    (!rows.is_empty()).then(|| Section::new("Positions of the train", vec![table(rows)]))
}
