//! How far blocks moved on ground that moved.

use super::{Part, Section, listed};
use crate::ground;
use base::number::{fixed, short};
use check::proof::result::ResultFile;

/// Blocks that are listed.
const MOST: usize = 24;

/// The ground, and a table of the blocks, those that went farthest first.
pub(super) fn sections(file: &ResultFile) -> Vec<Section> {
    let Some(a) = file.answer.shaken() else { return Vec::new() };
    let facts = vec![
        ["motion".into(), ground::words(&a.asked.ground)],
        ["towards".into(), base::number::point(a.toward)],
        [
            "steps".into(),
            format!("{} of {} s, {} substeps each", a.steps, short(a.step), a.substeps),
        ],
    ];
    let row = |b: &check::proof::shaken::ShakenBlock| {
        vec![
            b.block.clone(),
            short(b.thickness),
            short(b.greatest_over_thickness * b.thickness),
            format!("{:.4}", b.greatest_over_thickness),
            fixed(b.at, 3),
            format!("{:.4}", b.residual_over_thickness),
            format!("{:.2}", b.greatest_turn_deg),
        ]
    };
    let rows = a.by_way().into_iter().map(row).collect();
    let columns = [
        "block",
        "#thickness, m",
        "#greatest displacement, m",
        "#greatest / thickness",
        "#at, s",
        "#residual / thickness",
        "#greatest rotation, °",
    ];
    let note = "Displacements of the centres of mass relative to the ground, in one simulation: \
                computed, not proved. Other records and other scales give other results.";
    vec![
        Section::new("Ground motion", vec![Part::Facts(facts)]),
        Section::new(
            "Displacements of the blocks",
            vec![Part::table(&columns, listed(rows, MOST), note)],
        ),
    ]
}
