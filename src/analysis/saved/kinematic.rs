//! Mechanisms under earthquakes, with their curve.

use super::{bound, certificate, dry_result, warn, with_dead_load};
use crate::{Claims, Kinematic, kinematic::Quaked};
use base::error::{Finding, FindingCode};
use check::{
    kinematic::oblique,
    proof::{
        answer::{Answer, LoadFactorAnswer},
        kinematic::{Control, Given, KinematicAnswer, Numbers},
        member::lines,
        path::{PathAnswer, PathResult},
        result::{Direction, MechanismWords, QuestionKind, ResultFile},
    },
    terms::Outcome,
    verdict::Verdict,
};
use model::interface::Model;
use scene::Scene;

/// The result of `kinematic`, the worst direction first; it is the answer.
pub fn kinematic(scene: &Scene, model: &Model, asked: &Kinematic) -> Option<ResultFile> {
    let worst = asked.directions.first()?;
    let under = &worst.quake.model;
    let level = asked.dead.as_ref().map(|a| a.verdict);
    let mut followed = asked.curve.as_ref().map(|c| super::path(scene, &asked.curve_model, c));
    let path = followed.as_mut().and_then(|f| f.path.take());
    let curve = followed.as_ref().and_then(|f| f.answer.path());
    let tied = asked.with_members.as_ref().and_then(|t| t.as_ref().ok());
    let mut tied = tied.map(|t| super::path(scene, under, t));
    let held = tied.as_ref().and_then(|t| t.answer.path()).cloned();
    let list: Vec<Direction> = asked
        .directions
        .iter()
        .enumerate()
        .map(|(k, d)| {
            let curve = (k == 0).then_some(curve.zip(path.as_ref())).flatten();
            direction(scene, asked, d, (k == 0, level), (curve, held.as_ref()))
        })
        .collect();
    let first = list.first()?.clone();
    let mut file =
        ResultFile::new(QuestionKind::Kinematic, scene, under, first.answer, first.certificate);
    file.dry = first.dry;
    file.path = path;
    file.path_with_members = tied.as_mut().and_then(|t| t.path.take());
    file.mechanism = worst.bound.mechanism.as_ref().map(|m| MechanismWords::new(under, m));
    file.members = lines(under, worst.bound.evidence().forces);
    file.left_out.clone_from(&worst.bound.left_out);
    file.trace = asked.directions.iter().flat_map(|d| d.bound.attempts.iter().cloned()).collect();
    for d in &asked.directions {
        warn(&mut file, &d.bound);
        d.dry.iter().for_each(|dry| warn(&mut file, dry));
    }
    let refused = followed.into_iter().chain(tied).flat_map(|f| f.warnings);
    let known = file.warnings.clone();
    file.warnings.extend(refused.filter(|w| !known.contains(w)));
    if !scene.loads.live.is_empty() {
        file.left_out.push("live loads of the scene: the earthquake stands in their place".into());
    }
    file.warnings.extend(oblique(scene, model).into_iter().map(|k| {
        let text = format!("loads.dead[{k}] pulls down and sideways: it is taken for no weight. Where one is in it, make two loads of it, the weight straight down, or say \"massless\": true");
        Finding::new(FindingCode::Loads, text)
    }));
    if list.len() > 1 {
        file.directions = list;
    }
    Some(match &asked.dead {
        Some(dead) => with_dead_load(file, model, dead),
        None => file,
    })
}

fn direction(
    scene: &Scene,
    asked: &Kinematic,
    d: &Quaked,
    (worst, level): (bool, Option<Verdict>),
    (curve, held): (Option<(&PathAnswer, &PathResult)>, Option<&PathAnswer>),
) -> Direction {
    let model = &d.quake.model;
    let dry = d.dry.as_ref().map(|dry| dry_result(model, dry));
    let alpha0 = LoadFactorAnswer::new(bound(&d.bound), dry.as_ref());
    let control = asked.control.filter(|_| worst).map(|(i, point)| Control {
        block: model.assembly.blocks[i].id.clone(),
        point: point.into(),
    });
    let numbers: Numbers = Given {
        scene,
        quake: &d.quake,
        rates: (d.bound.outcome == Outcome::Found).then(|| d.rates()),
        alpha0: alpha0.value,
        fc: asked.confidence,
        control: control.as_ref(),
        curve,
    }
    .numbers();
    let tied = asked.with_members.as_ref().filter(|_| worst);
    let answer = KinematicAnswer {
        toward: d.quake.toward.into(),
        alpha0,
        verdict: level,
        part: d.bound.part.clone(),
        proof: d.bound.grade(),
        fc: asked.confidence,
        control,
        curve: curve.map(|c| c.0.clone()),
        without_members: worst && asked.without_members,
        curve_with_members: held.filter(|_| worst).cloned(),
        no_curve_with_members: tied.and_then(|t| t.as_ref().err()).cloned(),
        no_curve: asked.why.clone().filter(|_| worst),
        numbers,
    };
    Direction {
        answer: Answer::Kinematic(Box::new(answer)),
        certificate: certificate(model, &d.bound),
        dry,
    }
}
