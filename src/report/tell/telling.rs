//! What there is to tell of the answers to a question.

use crate::{
    ReportError,
    chart::Chart,
    text::{
        options::TextOptions,
        page::{Page, Role},
    },
};
use base::number::short;
use check::proof::{
    answer::{Quantity, Required},
    result::ResultFile,
};

/// Makes a table.
type Csv = fn(&ResultFile) -> Result<String, ReportError>;

/// How the answers to a question are told.
pub(crate) struct Telling {
    /// The verb of the command that asks it.
    pub verb: &'static str,
    /// The question, and what its number means.
    pub asked: fn(&ResultFile) -> [&'static str; 2],
    /// The first line, without what weakens it.
    pub title: fn(&ResultFile) -> (String, Role),
    /// Sentences below it.
    pub why: fn(&mut Page, &ResultFile),
    /// Its own rows.
    pub rows: fn(&mut Page, &ResultFile, TextOptions),
    /// Commands that may come next, by the scene and by the command that asks the same again.
    pub next: fn(&ResultFile, &str, &str) -> Vec<(String, &'static str)>,
    /// Of a load factor what it is called.
    pub factor: Option<FactorWords>,
    /// Its table.
    pub csv: Option<Csv>,
    /// Its charts.
    pub charts: fn(&ResultFile) -> Vec<Chart>,
}

/// What a load factor is called.
#[derive(Clone, Copy)]
pub(crate) struct FactorWords {
    /// Its letter.
    pub name: &'static str,
    /// Where the load that it multiplies is not there.
    pub without: &'static str,
    /// It is the tangent of a tilt.
    pub tilt: bool,
}

/// What most questions have.
pub(super) const PLAIN: Telling = Telling {
    verb: "",
    asked: |_| [""; 2],
    title: |_| ("undecided".into(), Role::Unsure),
    why: |_, _| {},
    rows: |_, _, _| {},
    next: |_, _, again| keep(again).into(),
    factor: None,
    csv: None,
    charts: |_| Vec::new(),
};

/// The command that looks for mistakes in a scene.
pub(super) fn look(scene: &str) -> (String, &'static str) {
    (format!("voussoir check {scene}"), "mistakes in the scene, near misses, overlaps")
}

/// The commands that keep an answer and verify it.
pub(super) fn keep(again: &str) -> [(String, &'static str); 2] {
    [
        (format!("{again} --save result.json"), "save the answer with its proof"),
        ("voussoir check result.json".into(), "verify it from the scene alone"),
    ]
}

/// What was required, and whether it is there, in words.
pub(super) fn words_of(required: Required) -> String {
    let what = match required.quantity {
        Quantity::LoadFactor | Quantity::Alpha0 => short(required.least),
        Quantity::GeometricFactor => format!("geometric safety factor {}", short(required.least)),
        Quantity::TiltDeg => format!("{}°", short(required.least)),
        Quantity::Site => format!("ζ_E {}", short(required.least)),
    };
    let met = match required.met {
        Some(true) => "met",
        Some(false) => "not met",
        None => "undecided",
    };
    format!("required {what}: {met}")
}
