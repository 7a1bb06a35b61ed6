//! Contacts that were left out: their numbers are those of the scene, and the answer with them
//! closed is asked again.

use super::{Recompute, again::computed, failure, require};
use crate::{
    proof::{
        answer::Answer,
        result::{QuestionKind, ResultFile},
    },
    terms::{Bound, ClosedAnswer, ClosedEnd, Difference},
    verdict::{Verdict, claim::Findings},
};
use base::tolerance;
use model::interface::{LeftOut, Model};
use scene::Scene;

/// The numbers of what was left out are those of the scene; the answer with it is asked again.
pub(super) fn left_out(
    file: &ResultFile,
    scene: &Scene,
    model: &Model,
    again: &dyn Recompute,
) -> Findings {
    let mut f = Findings::default();
    let (said, here) = (&file.left_out_contacts, model.interfaces.left_out);
    let same = match (said.as_ref().map(|s| s.contacts), here) {
        (None, None) => return f,
        (Some(said), Some(here)) => alike(said, here),
        _ => false,
    };
    require(&mut f, same, "the contacts that were left out are those of the scene");
    let closed = said.as_ref().and_then(|s| s.closed.as_ref());
    let Some(closed) = closed.filter(|_| same) else { return f };
    let given = match (file.question, file.answer.verdict(), file.answer.bound()) {
        (QuestionKind::Assess, Some(verdict), _) => {
            Some(ClosedAnswer::verdict(verdict, closed.law))
        }
        (QuestionKind::Limit, _, Some(b)) => {
            Some(ClosedAnswer::LoadFactor { status: b.status, value: b.value })
        }
        (QuestionKind::Tilt | QuestionKind::Kinematic | QuestionKind::Moving, ..) => {
            let all = file.directions.iter().map(|d| &d.answer).chain([&file.answer]);
            let bounds = all.filter_map(Answer::bound);
            ClosedAnswer::least(
                bounds.map(|b| ClosedAnswer::LoadFactor { status: b.status, value: b.value }),
            )
        }
        (QuestionKind::Thrust, Some(verdict), _) => {
            Some(ClosedAnswer::verdict(verdict, closed.law))
        }
        (QuestionKind::Thrust, ..) => file.answer.thrust().map(|t| {
            let end = |b: &Bound| ClosedEnd { status: b.status, value: b.value };
            ClosedAnswer::Thrust { least: end(&t.least), greatest: end(&t.greatest) }
        }),
        (QuestionKind::Critical, ..) => flips(file),
        (QuestionKind::Assess | QuestionKind::Limit, ..) => None,
        _ => return failure("the question is not one that is asked again with contacts closed"),
    };
    let again = again.closed(file, closed.law, scene, model);
    let ok = again.map(|again| {
        again.is_some_and(|(law, answer)| {
            law == closed.law
                && (answer == closed.answer || answer.beside(&closed.answer) == Difference::None)
        })
    });
    let follows = given.is_some_and(|given| closed.answer.beside(&given) == closed.difference);
    computed(&mut f, ok, "the answer with contacts closed that were left out".into());
    require(&mut f, follows, "how it differs follows from the two");
    f
}

/// The flips that a file claims.
fn flips(file: &ResultFile) -> Option<ClosedAnswer> {
    let (found, c) = (file.answer.critical()?, file.critical.as_ref()?);
    let start = c.scan.first().and_then(|s| s.verdict).unwrap_or(Verdict::Undecided);
    Some(ClosedAnswer::Flips { values: found.iter().map(|f| f.value).collect(), start })
}

/// Counts alike, lengths up to the digits that a file keeps.
fn alike(said: LeftOut, here: LeftOut) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() <= tolerance::SAVED * b.abs();
    (said.near_misses, said.overlaps, said.too_deep)
        == (here.near_misses, here.overlaps, here.too_deep)
        && near(said.greatest_gap, here.greatest_gap)
        && near(said.deepest_overlap, here.deepest_overlap)
        && near(said.closing_gap, here.closing_gap)
        && near(said.closing_angle_deg, here.closing_angle_deg)
}
