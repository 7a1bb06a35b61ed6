//! `--keep` of `settle` and `push`: the points of a path are on the disk as soon as they are proved.

use super::{claim, question::Session, terminal};
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::path::Path;
use voussoir::{
    analysis::{
        Question,
        follow::answer::{Followed, GoesOn},
    },
    keep::Kept,
    proof::{
        ResultFile,
        path::{Bracketed, PathResult},
    },
    report::record::digest,
};

/// What `--keep` keeps: points that are new, and what happened up to there.
#[derive(Clone, Serialize, Deserialize)]
struct Piece {
    path: PathResult,
    /// The least reaction, of the start.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    least_reaction: Option<Bracketed>,
}

/// Asks about a path, from where the file has it.
pub fn ask(session: &Session, question: &Question, file: &Path) -> anyhow::Result<ResultFile> {
    claim::written(file)?;
    let scene = digest(serde_json::to_string(&session.scene)?.as_bytes());
    let blocks = session.model.assembly.blocks.len();
    let contacts = session.model.interfaces.list.len();
    let of =
        json!({ "scene": scene, "blocks": blocks, "contacts": contacts, "question": question });
    let kept = Kept::<Piece>::open(file, "voussoir-path/1", of)?;
    let before = kept.there.iter().cloned().reduce(|before, next| Piece {
        path: before.path.and(next.path),
        least_reaction: before.least_reaction,
    });
    // The start is no place to go on from.
    let before = before.filter(|b| b.path.points.last().is_some_and(|p| !p.poses.is_empty()));
    let from = before.as_ref().and_then(|b| b.path.points.last()).map(|p| p.poses.clone());
    if let Some(before) = before.as_ref().filter(|_| session.shows_progress()) {
        let points = before.path.points.len();
        terminal::say(&format!("note: {} holds {points} points already", file.display()));
    }
    let mut ended = false;
    let mut hears = |new: &Followed| {
        // What comes after a point without a proof is none of a path that is proved.
        ended |= new.proofs.iter().any(|p| p.claim.is_none());
        let found = ResultFile::path(&session.scene, &session.model, new);
        let (Some(path), false) = (found.path, ended) else { return };
        let least_reaction = found.answer.path().and_then(|a| a.least_reaction);
        if let Err(e) = kept.append(&Piece { path, least_reaction }) {
            ended = true;
            terminal::say(&format!("warning: {e}; nothing more is kept"));
        }
    };
    let from = from.as_deref().unwrap_or_default();
    let answer = session.ask_on(question, GoesOn { from, hears: &mut hears })?;
    let mut result = session.result(question, &answer)?;
    if let Some(before) = before {
        result.goes_on(before.path, before.least_reaction);
    }
    Ok(result)
}
