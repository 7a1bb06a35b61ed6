//! `--keep` of `settle` and `push`: the points of a path are on the disk as soon as they are proved.

use super::{claim, question::Session, terminal};
use std::path::Path;
use voussoir::{
    analysis::Question,
    proof::{ResultFile, kept::KeptPath},
};

/// Asks about a path, from where the file has it.
pub fn ask(session: &Session, question: &Question, file: &Path) -> anyhow::Result<ResultFile> {
    claim::written(file)?;
    let Session { scene, model, .. } = session;
    let kept = KeptPath::open(file, question, scene, model)?;
    let points = kept.points();
    if points > 0 && session.shows_progress() {
        terminal::say(&format!("note: {} already holds {points} points", file.display()));
    }
    let asked = kept.ask(question, scene, model, &session.control());
    let (result, failed) = asked.map_err(|e| session.refuse(e))?;
    if let Some(e) = failed {
        terminal::say(&format!("warning: {e}; later points are not in the checkpoint"));
    }
    Ok(result)
}
