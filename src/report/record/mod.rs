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
mod section;

pub use date::date;
pub use section::{Part, Section};
use section::{listed, percent, quantity};

use super::view::View;
pub use joints::weak;

use crate::drawing::{self, Aspect};
use check::proof::result::ResultFile;
use check::question::QuestionKind;
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
        let idle = matches!(file.question.kind(), QuestionKind::Assess | QuestionKind::Tilt);
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
            ("command", &self.command),
            ("made", &self.made),
        ]
        .into_iter()
        .filter(|(_, text)| !text.is_empty())
        .map(|(name, text)| [name.into(), text.clone()])
        .collect()
    }
}
