//! Trains, position by position.

use super::{bound, certificate, dry_result, warn, with_dead_load};
use crate::{Claims, Moving, moving::Stood};
use check::{
    proof::{
        answer::{Answer, LoadFactorAnswer},
        member::lines,
        moving::{MovingAnswer, least},
        result::{Direction, MechanismWords, QuestionKind, ResultFile},
    },
    verdict::Verdict,
};
use model::{interface::Model, train::Position};
use scene::Scene;

/// The result of `moving`, one entry per position; the least is the answer.
pub fn moving(scene: &Scene, model: &Model, moved: &Moving) -> Option<ResultFile> {
    let level = moved.dead.as_ref().map(|a| a.verdict);
    let list: Vec<Direction> = moved.positions.iter().map(|s| direction(model, s, level)).collect();
    let least = least(list.iter().map(|d| &d.answer))?;
    let (worst, first) = (&moved.positions[least], list[least].clone());
    let mut file =
        ResultFile::new(QuestionKind::Moving, scene, model, first.answer, first.certificate);
    file.dry = first.dry;
    file.mechanism = worst.bound.mechanism.as_ref().map(|m| MechanismWords::new(model, m));
    file.members = lines(model, worst.bound.evidence().forces);
    file.left_out.clone_from(&worst.bound.left_out);
    file.trace = moved.positions.iter().flat_map(|s| s.bound.attempts.iter().cloned()).collect();
    for s in &moved.positions {
        warn(&mut file, &s.bound);
        s.dry.iter().for_each(|dry| warn(&mut file, dry));
    }
    if !scene.loads.live.is_empty() {
        file.left_out.push("live loads of the scene: the train stands in their place".into());
    }
    file.directions = list;
    Some(match &moved.dead {
        Some(dead) => with_dead_load(file, model, dead),
        None => file,
    })
}

fn direction(model: &Model, s: &Stood, level: Option<Verdict>) -> Direction {
    let dry = s.dry.as_ref().map(|dry| dry_result(model, dry));
    let Position { travel, x } = s.position;
    let answer = MovingAnswer {
        travel,
        x,
        axles: s.axles.clone(),
        load_factor: LoadFactorAnswer::new(bound(&s.bound), dry.as_ref()),
        verdict: level,
        part: s.bound.part.clone(),
        proof: s.bound.grade(),
    };
    Direction {
        answer: Answer::Moving(Box::new(answer)),
        certificate: certificate(model, &s.bound),
        dry,
    }
}
