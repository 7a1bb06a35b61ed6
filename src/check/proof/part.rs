//! The part of a scene that an answer names: recomputed, like everything else that a result says.

use crate::{
    terms::Deciding,
    verdict::{Rate, claim::Findings},
};
use model::interface::{Model, parts};

/// Verifies that there is such a part, and that where anything moves it does.
pub(super) fn verify(f: &mut Findings, model: &Model, said: Option<&Deciding>, rates: &[Rate]) {
    let Some(said) = said else { return };
    let parts = parts(model);
    let Some(index) = (0..parts.len()).find(|&k| Deciding::new(&parts, k).as_ref() == Some(said))
    else {
        f.fails.push(format!("the scene has no such part: {said}"));
        return;
    };
    let moves = |i: usize| rates.get(i).is_some_and(|q| *q != Rate::zero());
    if (0..rates.len()).any(moves) && !parts[index].blocks.iter().any(|&i| moves(i)) {
        f.fails.push(format!("nothing moves in {said}"));
        return;
    }
    f.holds.push(format!("decided by {said}"));
}
