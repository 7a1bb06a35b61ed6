//! Verifying critical values: the scene is made anew at both ends of every flip, and the verdict proved there.

use super::{CriticalResult, FlipResult, Side, exhausted};
use crate::{
    analysis::prepare,
    report::{
        result::{Question, ResultFile},
        verify::{Verification, answer, failure, require},
    },
    scene::Scene,
    tolerance,
    verdict::check::Findings,
};

/// Adds the parts of a result of `critical`.
pub fn verify(all: &mut Verification, file: &ResultFile, scene: &Scene) {
    let (Some(c), Some(said)) = (&file.critical, &file.answer.critical) else {
        return all.part("answer", failure("the answer is not one to its question"));
    };
    let mut f = Findings::default();
    let proved: Vec<_> = c.flips.iter().filter_map(FlipResult::proved).collect();
    require(&mut f, proved == *said, format!("the answer names the {} flips that have a proof on both sides", proved.len()));
    let (low, high) = (c.between[0].min(c.between[1]), c.between[0].max(c.between[1]));
    // A flip at the very end of the range has its other side just outside.
    let slack = 100.0 * tolerance::CRITICAL_WIDTH * low.abs().max(high.abs());
    require(&mut f, said.iter().all(|v| low - slack <= v.lower && v.upper <= high + slack), format!("they lie between {low} and {high}"));
    let others = [file.answer.verdict.is_some(), file.answer.load_factor.is_some(), file.certificate.claim.is_some()];
    require(&mut f, !others.contains(&true), "nothing else is claimed");
    all.part("answer", f);
    all.claimed = !said.is_empty() || exhausted(file).is_some();
    let sides = c.flips.iter().flat_map(|flip| [&flip.below, &flip.above]).chain(&c.ends);
    for side in sides {
        all.part(format!("{} = {}", c.vary, side.value), one(scene, c, side));
    }
}

fn one(scene: &Scene, c: &CriticalResult, side: &Side) -> Findings {
    match scene.with_field(&c.vary, side.value).and_then(|scene| prepare(&scene)) {
        Ok(model) => answer(&model, Question::Assess, &side.answer, &side.certificate).0,
        Err(e) => failure(e.to_string()),
    }
}
