//! The record of an assessment: what was asked, of what, with which assumptions, what came out, how
//! far the joints are used, pictures, the proof, and what made it. Something to be filed and printed;
//! it says nothing that the result does not hold.

mod asked;
mod date;
mod heaps;
mod joints;
mod laws;
mod loads;
mod moved;
mod pieces;
mod proof;

pub use date::date;

use super::view::View;
use crate::drawing::{self, Aspect};
use check::proof::result::{QuestionKind, ResultFile};
use model::interface::Model;

/// A record, section by section.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    /// What was asked and what the number of the answer means; stands before everything else.
    pub asked: Vec<[String; 2]>,
    /// The drawing of the answer (SVG).
    pub drawing: String,
    /// The rest.
    pub sections: Vec<Section>,
}

/// A heading with what stands under it.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Its heading.
    pub title: String,
    /// What it says.
    pub parts: Vec<Part>,
}

/// A piece of a section.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    /// A paragraph.
    Text(String),
    /// Names with their values.
    Facts(Vec<[String; 2]>),
    /// A table; of a column of numbers the flag is false.
    Table {
        /// Names of the columns, and whether they hold words.
        columns: Vec<(String, bool)>,
        /// Rows.
        rows: Vec<Vec<String>>,
        /// What the columns mean.
        note: String,
    },
}

/// Where a record comes from, as far as the result does not say it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// The file of the scene, as it was typed.
    pub file: String,
    /// The SHA-256 digest of that file, or why there is none.
    pub digest: String,
    /// When the record was made.
    pub made: String,
    /// The command that asks the same again.
    pub command: String,
}

impl Record {
    /// The record of a result; `model` is that of its scene, `view` what there is to see of it.
    pub fn new(file: &ResultFile, model: &Model, view: &View, from: Aspect, at: &Origin) -> Self {
        // Verdicts and tilts are about dead loads alone.
        let idle = matches!(file.question, QuestionKind::Assess | QuestionKind::Tilt);
        let mut record = Self::of_scene(model, view, from, idle);
        let mut asked = asked::facts(file);
        asked.extend(at.facts());
        record.asked = asked;
        let first = joints::sections(model, view).into_iter().chain(moved::sections(file));
        record.sections.splice(0..0, first);
        record.sections.extend(laws::tolerances(file, model));
        record.sections.extend(proof::sections(file));
        record
    }

    fn of_scene(model: &Model, view: &View, from: Aspect, idle: bool) -> Self {
        let mut sections = vec![pieces::section(model)];
        sections.extend(laws::section(model, view));
        sections.extend(loads::sections(model, view, idle));
        Self { asked: Vec::new(), drawing: drawing::printed(view, from), sections }
    }
}

impl Origin {
    fn facts(&self) -> Vec<[String; 2]> {
        [
            ("scene", &self.file),
            ("SHA-256", &self.digest),
            ("asked as", &self.command),
            ("made", &self.made),
        ]
        .into_iter()
        .filter(|(_, text)| !text.is_empty())
        .map(|(name, text)| [name.into(), text.clone()])
        .collect()
    }
}

impl Section {
    fn new(title: &str, parts: Vec<Part>) -> Self {
        Self { title: title.into(), parts }
    }
}

impl Part {
    /// A table; a column whose name begins with `#` holds numbers.
    fn table(columns: &[&str], rows: Vec<Vec<String>>, note: &str) -> Self {
        let column = |c: &&str| match c.strip_prefix('#') {
            Some(name) => (name.into(), false),
            None => (c.to_string(), true),
        };
        Self::Table { columns: columns.iter().map(column).collect(), rows, note: note.into() }
    }
}

/// Rows of a list in full; of longer ones the first, and a row that says how many are not shown.
fn listed(rows: Vec<Vec<String>>, most: usize) -> Vec<Vec<String>> {
    let count = rows.len();
    if count <= most + 1 {
        return rows;
    }
    let mut list: Vec<Vec<String>> = rows.into_iter().take(most).collect();
    list.push(vec![format!("… and {} more", count - most)]);
    list
}

/// A number with its unit and a prefix that leaves it readable: `12.3 kN`.
fn quantity(value: f64, unit: &str) -> String {
    let size = value.abs();
    let (by, prefix) = match size {
        s if s.is_infinite() => return "no limit".into(),
        s if s >= 1e12 => (1.0, ""),
        s if s >= 1e9 => (1e9, "G"),
        s if s >= 1e6 => (1e6, "M"),
        s if s >= 1e3 => (1e3, "k"),
        _ => (1.0, ""),
    };
    format!("{} {prefix}{unit}", base::number::short(value / by))
}

/// A share in per cent, with as many digits as it takes to tell it from all.
fn percent(share: f64) -> String {
    if share.is_nan() {
        "–".into()
    } else if share.is_infinite() {
        "none left".into()
    } else {
        format!("{:.1} %", 100.0 * share)
    }
}
