//! The range of a thrust, the line of thrust, the geometric safety factor.

use super::{certificate, side, verdict_answer, warn, with_dead_load};
use crate::{
    geometric::Geometric,
    thrust::{Thrust, ThrustEnd},
};
use check::{
    proof::{
        answer::Answer,
        certificate::Certificate,
        critical::Side,
        result::{MechanismWords, QuestionKind, ResultFile},
        thrust::{ThrustAnswer, ThrustResult, factor, table},
    },
    terms::{Bound, Outcome},
    verdict::thrust::Sought,
};
use model::interface::Model;
use scene::Scene;

/// The result of `thrust`. Where the scene does not stand, it is the verdict.
pub fn thrust(scene: &Scene, model: &Model, t: &Thrust) -> ResultFile {
    let [least, greatest] = &t.ends[..] else {
        let mut file = ResultFile::new(
            QuestionKind::Thrust,
            scene,
            model,
            Answer::Verdict(verdict_answer(&t.standing)),
            certificate(model, &t.standing),
        );
        file.mechanism = t.standing.mechanism.as_ref().map(|m| MechanismWords::new(model, m));
        file.trace.clone_from(&t.standing.attempts);
        warn(&mut file, &t.standing);
        return file;
    };
    let (shrunk, without_factor, value) = match &t.factor {
        Some(Geometric::Found(flip)) => {
            (vec![&flip.stands, &flip.falls], None, Some(1.0 / flip.value))
        }
        Some(Geometric::Beyond(probe)) => (vec![&**probe], None, None),
        Some(Geometric::Open(why)) => (Vec::new(), Some(why.clone()), None),
        None => (Vec::new(), None, None),
    };
    let refused: Vec<_> = shrunk.iter().map(|probe| &probe.assessment).collect();
    let shrunk: Vec<Side> = shrunk.iter().map(|probe| side(probe)).collect();
    let (support, direction, member) = match t.at {
        Sought::Thrust(at) => {
            (Some(model.assembly.blocks[at.support].id.clone()), Some(at.direction), None)
        }
        Sought::Member(at) => {
            (None, at.along, Some(model.interfaces.members[at.member].id.clone()))
        }
    };
    let answer = ThrustAnswer {
        support,
        direction,
        member,
        least: bound(least),
        greatest: bound(greatest),
        geometric_factor: factor(&shrunk, value),
    };
    let mut file = ResultFile::new(
        QuestionKind::Thrust,
        scene,
        model,
        Answer::Thrust(Box::new(answer)),
        Certificate::none(),
    );
    let lines =
        table(model, [least, greatest].map(|e| (e.outcome == Outcome::Found).then_some(&e.forces)));
    let [low, high] = [least, greatest].map(|end| certificate(model, end));
    file.thrust =
        Some(ThrustResult { least: low, greatest: high, shrunk, without_factor, sections: lines });
    file.left_out.clone_from(&least.left_out);
    file.trace = least.attempts.iter().chain(&greatest.attempts).cloned().collect();
    [least, greatest].into_iter().for_each(|end| warn(&mut file, end));
    refused.into_iter().for_each(|assessment| warn(&mut file, assessment));
    with_dead_load(file, model, &t.standing)
}

fn bound(end: &ThrustEnd) -> Bound {
    Bound::new(end.outcome, end.value, end.bracket)
}
