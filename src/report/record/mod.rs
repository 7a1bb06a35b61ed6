//! The record of an assessment, to be filed and printed: a first page that a person reads and signs,
//! then the results, then appendices. It says nothing that the result does not hold.

mod asked;
mod cover;
mod date;
mod heaps;
mod joints;
mod laws;
mod limits;
mod loads;
mod moved;
mod pieces;
mod positions;
mod proof;
mod reactions;
mod section;

pub use cover::Cover;
pub use date::date;
pub use section::{Part, Section};
use section::{listed, percent, quantity};

use super::view::View;
pub use joints::weak;

use crate::drawing::Aspect;
use check::proof::result::ResultFile;
use check::question::QuestionKind;
use model::interface::Model;

/// A record.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record {
    /// The first page.
    pub cover: Cover,
    /// What came out, beside the words of the answer.
    pub results: Vec<Section>,
    /// All that it was asked of, in tables; the proof, the file.
    pub appendices: Vec<Section>,
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
        let mut results = joints::sections(model, view);
        results.extend(reactions::sections(view));
        results.extend(loads::members(view));
        results.extend(moved::sections(file));
        let mut appendices = vec![pieces::section(model)];
        appendices.extend(laws::section(model, view));
        appendices.push(loads::section(model, view, idle));
        appendices.extend(loads::soil(view));
        appendices.extend(positions::section(file));
        appendices.extend(laws::tolerances(file, model));
        appendices.extend(proof::sections(file));
        appendices.push(Section::new("Origin", vec![Part::Facts(at.facts())]));
        Self { cover: Cover::new(file, model, view, from), results, appendices }
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
