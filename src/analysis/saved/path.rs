//! Paths and their points.

use crate::follow::{
    End, EventKind, Point,
    answer::{Followed, PointProof},
};
use base::error::{Finding, FindingCode};
use check::{
    path::{Carried, Drive, saved::write_poses},
    proof::{
        answer::Answer,
        certificate::Certificate,
        path::{
            Bracketed, DrivenBy, MovingSupport, PathAnswer, PathEvent, PathEventKind, PathPoint,
            PathResult, PathStatus, Reaction, hinges, is_good, slips,
        },
        result::{QuestionKind, ResultFile},
    },
    verdict::{
        Rate,
        claim::Claim,
        evidence::{write_forces, write_members, write_rates},
    },
};
use model::interface::Model;
use scene::Scene;

/// The result of `settle` or `push`.
pub fn path(scene: &Scene, model: &Model, followed: &Followed) -> ResultFile {
    let carried = Carried::new(model);
    let id = |i: usize| model.assembly.blocks[i].id.clone();
    let (question, driven_by) = match &followed.drive {
        Drive::Settle(moves) => {
            let list = moves.0.iter().map(|m| MovingSupport {
                support: id(m.support),
                way: m.way.into(),
                turn: m.turn.into(),
            });
            (QuestionKind::Settle, DrivenBy::Supports(list.collect()))
        }
        Drive::Push { block, point, toward } => (
            QuestionKind::Push,
            DrivenBy::Control {
                block: id(*block),
                point: (*point).into(),
                toward: (*toward).into(),
            },
        ),
    };
    let point = |p: &Point, proof: &PointProof| point(&carried, followed, p, proof);
    let path = &followed.path;
    let points: Vec<PathPoint> =
        path.points.iter().zip(&followed.proofs).map(|(p, proof)| point(p, proof)).collect();
    let ends: Vec<PathPoint> = match &path.end {
        End::Falls(list) => {
            list.iter().zip(&followed.ends).map(|(p, proof)| point(p, proof)).collect()
        }
        _ => Vec::new(),
    };
    let joints = |list: &[usize]| -> Vec<[String; 2]> {
        let faces = list.iter().map(|&k| &carried.joints[k]);
        faces.map(|f| [id(f.a), id(f.b)]).collect()
    };
    let events = path.events.iter().map(|e| PathEvent {
        value: e.value,
        kind: match e.kind {
            EventKind::Opens => PathEventKind::Opens,
            EventKind::Closes => PathEventKind::Closes,
            EventKind::Jumps => PathEventKind::Jumps,
            EventKind::Falls => PathEventKind::Falls,
            EventKind::Yields => PathEventKind::Yields,
            EventKind::Slides => PathEventKind::Slides,
            EventKind::Sticks => PathEventKind::Sticks,
        },
        opens: joints(&e.opens),
        closes: joints(&e.closes),
        jump: (e.jump > 0.0).then_some(e.jump),
        yields: e.yields.iter().map(|&m| model.interfaces.members[m].id.clone()).collect(),
        slides: joints(&e.slides),
    });
    let events = events.collect();
    let least = followed.least.as_ref().map(|(_, forces, rates)| {
        let free: Vec<Rate> = rates
            .iter()
            .zip(&model.assembly.blocks)
            .map(|(r, b)| if b.support { Rate::zero() } else { *r })
            .collect();
        Certificate {
            forces: write_forces(model, forces),
            members: write_members(model, forces),
            rates: write_rates(&model.assembly, &free),
            ..Certificate::none()
        }
    });
    let answer = answer(model, followed, &points, &ends);
    let between = path.between;
    let result = PathResult { driven_by, points, events, ends, between, least };
    let mut file = ResultFile::new(
        question,
        scene,
        model,
        Answer::Path(Box::new(answer)),
        Certificate::none(),
    );
    let refused = followed.proofs.iter().chain(&followed.ends).flat_map(|p| &p.findings.fails);
    file.warnings.extend(
        refused.map(|f| Finding::new(FindingCode::Numerics, format!("certificate refused: {f}"))),
    );
    file.path = Some(result);
    file
}

fn point(carried: &Carried, followed: &Followed, p: &Point, proof: &PointProof) -> PathPoint {
    let model = carried.start;
    let load_factor = match proof.claim {
        Some(Claim::LoadFactor { value, .. } | Claim::DryLoadFactor { value }) => Some(value),
        _ => None,
    };
    let reactions = followed.reactions(proof).into_iter().map(|(i, w)| Reaction {
        support: model.assembly.blocks[i].id.clone(),
        force: w.force.into(),
        moment: w.moment.into(),
    });
    PathPoint {
        value: p.value,
        load_factor,
        reactions: reactions.collect(),
        hinges: hinges(carried, &p.poses),
        slips: slips(carried, &p.poses),
        poses: write_poses(&model.assembly, &p.poses),
        certificate: certificate(proof),
        bound: proof.bound.as_deref().map(certificate),
    }
}

fn certificate(proof: &PointProof) -> Certificate {
    Certificate {
        claim: proof.claim,
        forces: write_forces(&proof.model, &proof.forces),
        members: write_members(&proof.model, &proof.forces),
        base: None,
        base_members: Vec::new(),
        rates: write_rates(&proof.model.assembly, &proof.rates),
        verified: proof.findings.holds.clone(),
    }
}

/// The answer that the points prove.
fn answer(
    model: &Model,
    followed: &Followed,
    points: &[PathPoint],
    ends: &[PathPoint],
) -> PathAnswer {
    let good = |p: &&PathPoint| p.certificate.claim.is_some_and(|c| is_good(&c));
    let last = points.iter().take_while(good).last().map(|p| p.value);
    let whole = points.iter().all(|p| good(&p));
    let unproved = || Some("a point on the way could not be proved".to_string());
    let open = |why| (PathStatus::Open, last, None, why);
    let (status, value, falls_at, why) = match (&followed.path.end, ends) {
        (End::Falls(_), [stands, falls])
            if stands.certificate.claim == Some(Claim::Stable)
                && falls.certificate.claim == Some(Claim::Unstable) =>
        {
            (PathStatus::Falls, Some(stands.value), Some(falls.value), None)
        }
        (End::Falls(_), _) => open(Some("it falls, but that could not be proved".into())),
        (End::Reached, _) if whole => (PathStatus::Reached, last, None, None),
        (End::Vanishes, _) if whole => (PathStatus::Vanishes, last, None, None),
        (End::Reached | End::Vanishes, _) => open(unproved()),
        (End::Slides(k), _) => {
            let f = &model.interfaces.list[*k];
            let [a, b] = [f.a, f.b].map(|i| &model.assembly.blocks[i].id);
            let why = format!("{a} and {b} slide on each other");
            (PathStatus::Slides, last, None, Some(why))
        }
        (End::Stuck(text), _) => open(Some(text.clone())),
    };
    let least_reaction = followed.least.as_ref().filter(|l| l.0.holds).map(|(l, ..)| Bracketed {
        value: l.value,
        lower: l.lower,
        upper: l.upper,
    });
    PathAnswer { status, value, falls_at, least_reaction, why }
}
