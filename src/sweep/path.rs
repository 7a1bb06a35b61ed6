//! Paths whose points are on the disk as soon as they are proved.

use crate::keep::{Kept, digest};
use analysis::saved;
use analysis::{
    Control, Question, ask_on,
    follow::answer::{Followed, GoesOn},
};
use base::error::{InputError, RowsError};
use check::proof::{ResultFile, evidence::PathEvidence};
use model::interface::Model;
use scene::Scene;
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::path::Path;

/// What is kept: points that are new, and what happened up to there.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Piece {
    path: PathEvidence,
}

/// A file of the points of one path, which goes on from the last of them.
#[derive(Debug)]
pub struct KeptPath {
    kept: Kept<Piece>,
    before: Option<Piece>,
}

impl KeptPath {
    /// Begins a file, or takes up one of the same question about the same scene.
    ///
    /// # Errors
    /// The file cannot be written, is being written by another run, or is about another path.
    pub fn open(
        file: &Path,
        question: &Question,
        scene: &Scene,
        model: &Model,
    ) -> Result<Self, RowsError> {
        let text = serde_json::to_string(scene).map_err(|e| RowsError::File {
            file: file.display().to_string(),
            what: "written",
            cause: e.into(),
        })?;
        let of = json!({
            "scene": digest(text.as_bytes()),
            "blocks": model.assembly.blocks.len(),
            "contacts": model.interfaces.list.len(),
            "question": question,
        });
        let kept = Kept::<Piece>::open(file, "voussoir-path/2", of)?;
        let before = kept
            .there
            .iter()
            .cloned()
            .reduce(|before, next| Piece { path: before.path.and(next.path) });
        // The start is no place to go on from.
        let before = before.filter(|b| b.path.points.last().is_some_and(|p| !p.poses.is_empty()));
        Ok(Self { kept, before })
    }

    /// How many points there are already.
    pub fn points(&self) -> usize {
        self.before.as_ref().map_or(0, |b| b.path.points.len())
    }

    /// Asks the question that the file is about, from where it has the path: the result, and why
    /// the last points are not in the file where they could not be written.
    ///
    /// # Errors
    /// As [`ask_on`], and where the question is about no path.
    pub fn ask(
        self,
        question: &Question,
        scene: &Scene,
        model: &Model,
        control: &Control,
    ) -> Result<(ResultFile, Option<RowsError>), InputError> {
        let last = self.before.as_ref().and_then(|b| b.path.points.last());
        let from = last.map(|p| p.poses.clone()).unwrap_or_default();
        let (mut ended, mut failed) = (false, None);
        let mut hears = |new: &Followed| {
            // What comes after a point without a proof is none of a path that is proved.
            ended |= new.proofs.iter().any(|p| p.claim.is_none());
            if ended {
                return;
            }
            let path = saved::path_evidence(model, new);
            if let Err(e) = self.kept.append(&Piece { path }) {
                ended = true;
                failed = Some(e);
            }
        };
        let path = GoesOn { from: &from, hears: &mut hears };
        let answer = ask_on(question, scene, model, control, path)?;
        let before = self.before.map(|b| b.path);
        let result = saved::of_path(question, scene, model, &answer, before)?;
        Ok((result, failed))
    }
}
