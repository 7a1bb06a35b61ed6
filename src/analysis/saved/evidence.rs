//! What was found, as evidence: names instead of indices.

use super::proof::{certificate, factor, standing};
use super::{
    in_time::{rocking_answer, seen, shaken_answer},
    path::path_evidence,
};
use crate::{
    Answer as Answered, Assessment, ControlPoint, Critical, Kinematic, Moving, Proved, Question,
    Tilt, Tilted,
    critical::Change,
    critical_value::Probe,
    geometric::Geometric,
    stages::{Staged, Stages},
    state::Stated,
    thrust::Thrust,
};
use base::error::{InputError, JsonPath};
use check::{
    elastic::Quadrature,
    proof::{
        evidence::{
            AssessEvidence, CriticalEvidence, Evidence, FactorEvidence, FlipEvidence, HeldEvidence,
            KinematicEvidence, LimitEvidence, MovingEvidence, PositionEvidence, RockEvidence,
            ScanPoint, SideEvidence, StageEvidence, StagesEvidence, StateEvidence, StepEvidence,
            ThrustEvidence, TiltEvidence,
        },
        kinematic::Control,
        state::displacements,
    },
    question::{DIRECTIONS, directions},
    verdict::{Verdict, thrust::Sought},
};
use model::interface::Model;
use nalgebra::Vector3;

/// The evidence for an answer, and the question with what was not said written out.
pub(super) fn of(
    question: &Question,
    model: &Model,
    answer: &Answered,
) -> Result<(Question, Evidence), InputError> {
    let mut question = question.clone();
    let evidence = match (&mut question, answer) {
        (Question::Assess(_), Answered::Assess(a)) => {
            Evidence::Assess(AssessEvidence { standing: standing(model, a), simulation: None })
        }
        (Question::Limit(_), Answered::Limit(l)) => Evidence::Limit(LimitEvidence {
            factor: factor(model, &l.bound, l.dry.as_ref().map(|dry| (model, dry))),
            dead: l.dead.as_ref().map(|dead| standing(model, dead)),
            sided: Vec::new(),
        }),
        (Question::Moving(_), Answered::Moving(m)) => Evidence::Moving(moving(model, m)),
        (Question::Tilt(o), Answered::Tilt(t)) => {
            said(&o.toward, &mut o.all);
            Evidence::Tilt(tilt(model, t))
        }
        (Question::Critical(_), Answered::Critical(c)) => Evidence::Critical(critical(c)),
        (Question::Thrust(o), Answered::Thrust(t)) => {
            match t.at {
                Sought::Thrust(at) => {
                    o.support = Some(model.assembly.blocks[at.support].id.clone());
                    o.direction = Some(at.direction);
                }
                Sought::Member(at) => {
                    o.member = Some(model.interfaces.members[at.member].id.clone());
                    o.direction = at.along;
                }
            }
            Evidence::Thrust(thrust(model, t))
        }
        (Question::Settle(_), Answered::Path(p)) => Evidence::Settle(path_evidence(model, p)),
        (Question::Push(_), Answered::Path(p)) => Evidence::Push(path_evidence(model, p)),
        (Question::Kinematic(o), Answered::Kinematic(k)) => {
            // Worst first, as they are told.
            o.toward = k.directions.iter().map(|d| d.quake.toward.into()).collect();
            o.all = None;
            o.fc = Some(k.confidence);
            Evidence::Kinematic(kinematic(model, k))
        }
        (Question::Stages(o), Answered::Stages(s)) => {
            if !o.skip_margin && !o.has_order() {
                said(&o.toward, &mut o.all);
            }
            let toward = directions(model.assembly.gravity, &o.toward, o.all);
            Evidence::Stages(stages(s, &toward))
        }
        (Question::Without(_), Answered::Without(w)) => Evidence::Without(w.evidence()),
        (Question::State(o), Answered::State(s)) => {
            let named = s.control.map(|(i, point)| ControlPoint {
                block: model.assembly.blocks[i].id.clone(),
                point: point.into(),
            });
            if !o.dead_only {
                o.control = named;
            }
            Evidence::State(state(model, o.quadrature, s))
        }
        (Question::Rock(_), Answered::Rock(r)) => {
            let [(under, towards), (other, against)] = &r.built.proofs;
            Evidence::Rock(RockEvidence {
                towards: certificate(under, towards),
                against: certificate(other, against),
                history: Box::new(rocking_answer(model, r)),
            })
        }
        (Question::Simulate(o), Answered::Simulate(outcome)) => {
            let seen = Box::new(seen(model, o, None, outcome));
            Evidence::Simulate(check::proof::evidence::SimulateEvidence { seen, standing: None })
        }
        (Question::Shake(_), Answered::Shake(s)) => {
            Evidence::Shake(Box::new(shaken_answer(model, s)))
        }
        (Question::Combinations(_), Answered::Combinations(c)) => {
            Evidence::Combinations(c.evidence())
        }
        (Question::Meet(_), Answered::Meet(m)) => Evidence::Meet(m.evidence()),
        (Question::Repose(_), _) => {
            return Err(InputError::at(
                JsonPath::root(),
                "a packing is saved in a file of its own",
            ));
        }
        _ => {
            return Err(InputError::at(
                JsonPath::root(),
                "the answer does not belong to the question",
            ));
        }
    };
    Ok((question, evidence))
}

/// Writes out how many directions are asked about where nothing is said.
fn said(toward: &[[f64; 3]], all: &mut Option<u16>) {
    if toward.is_empty() && all.is_none() {
        *all = Some(DIRECTIONS);
    }
}

fn tilted(t: &Tilt) -> FactorEvidence {
    factor(&t.model, &t.load_factor, t.dry.as_ref().map(|d| (&d.model, &d.load_factor)))
}

fn tilt(model: &Model, t: &Tilted) -> TiltEvidence {
    TiltEvidence {
        directions: t.directions.iter().map(tilted).collect(),
        level: t.level.as_ref().map(|a| standing(model, a)),
        sided: Vec::new(),
    }
}

fn moving(model: &Model, m: &Moving) -> MovingEvidence {
    let position = |s: &crate::moving::Stood| PositionEvidence {
        travel: s.position.travel,
        x: s.position.x,
        factor: factor(model, &s.bound, s.dry.as_ref().map(|dry| (model, dry))),
    };
    MovingEvidence {
        positions: m.positions.iter().map(position).collect(),
        dead: m.dead.as_ref().map(|a| standing(model, a)),
    }
}

fn side(probe: &Probe<Proved<Assessment>>) -> SideEvidence {
    SideEvidence { value: probe.value, standing: standing(&probe.model, &probe.assessment) }
}

/// A flip with its proofs.
pub fn flip(f: &Change) -> FlipEvidence {
    FlipEvidence { value: f.value, method: f.method, below: side(&f.below), above: side(&f.above) }
}

fn critical(c: &Critical) -> CriticalEvidence {
    let scan = c.scan.iter().map(|s| {
        let known = s.outcome.as_ref().ok();
        ScanPoint {
            value: s.value,
            verdict: known.map(|k| k.0),
            equilibrium_error: known.map(|k| k.1),
        }
    });
    CriticalEvidence {
        scan: scan.collect(),
        flips: c.changes.iter().map(flip).collect(),
        ends: c.ends.iter().map(side).collect(),
    }
}

fn thrust(model: &Model, t: &Thrust) -> ThrustEvidence {
    let (shrunk, factor) = match &t.factor {
        Some(Geometric::Found(flip)) => {
            (vec![side(&flip.stands), side(&flip.falls)], Some(1.0 / flip.value))
        }
        Some(Geometric::Beyond(probe)) => (vec![side(probe)], None),
        Some(Geometric::Open(_)) | None => (Vec::new(), None),
    };
    let ends = match &t.ends[..] {
        [least, greatest] => Some([certificate(model, least), certificate(model, greatest)]),
        _ => None,
    };
    ThrustEvidence { standing: standing(model, &t.standing), ends, factor, shrunk }
}

fn kinematic(model: &Model, k: &Kinematic) -> KinematicEvidence {
    let under = &k.directions[0].quake.model;
    let control = k.control.map(|(i, point): (usize, Vector3<f64>)| Control {
        block: under.assembly.blocks[i].id.clone(),
        point: point.into(),
    });
    let direction = |d: &crate::kinematic::Quaked| {
        let own = &d.quake.model;
        factor(own, &d.bound, d.dry.as_ref().map(|dry| (own, dry)))
    };
    let tied = k.with_members.as_ref().and_then(|t| t.as_ref().ok());
    KinematicEvidence {
        directions: k.directions.iter().map(direction).collect(),
        dead: k.dead.as_ref().map(|a| standing(model, a)),
        control,
        curve: k.curve.as_ref().map(|c| path_evidence(&k.curve_model, c)),
        curve_with_members: tied.map(|t| path_evidence(under, t)),
        sided: Vec::new(),
    }
}

fn stages(s: &Stages, toward: &[Vector3<f64>]) -> StagesEvidence {
    StagesEvidence {
        order: s.order.clone(),
        stages: s.stages.iter().map(|own| stage(own, toward)).collect(),
    }
}

fn stage(s: &Staged, toward: &[Vector3<f64>]) -> StageEvidence {
    let model = &s.model;
    let (mut limit, mut tilts) = (None, Vec::new());
    match &s.margin {
        Some(Answered::Limit(l)) => {
            limit = Some(factor(model, &l.bound, l.dry.as_ref().map(|dry| (model, dry))));
        }
        Some(Answered::Tilt(t)) => {
            debug_assert!(t.directions.len() == toward.len());
            tilts = t.directions.iter().map(tilted).collect();
        }
        _ => {}
    }
    let held = |end: &Proved<crate::thrust::ThrustEnd>| match end.at {
        Sought::Thrust(at) => Some(HeldEvidence {
            block: model.assembly.blocks[at.support].id.clone(),
            direction: at.direction,
            certificate: certificate(model, end),
        }),
        Sought::Member(_) => None,
    };
    StageEvidence {
        standing: standing(model, &s.verdict),
        limit,
        tilts,
        least_forces: match s.verdict.verdict {
            Verdict::Stable => s.held.iter().filter_map(held).collect(),
            _ => Vec::new(),
        },
    }
}

fn state(model: &Model, asked: Quadrature, s: &Stated) -> StateEvidence {
    let step = |step: &check::elastic::Step| StepEvidence {
        load_factor: step.load_factor,
        displacements: displacements(model, &step.displaced),
    };
    StateEvidence {
        quadrature: (s.quadrature != asked).then_some(s.quadrature),
        steps: s.track.iter().flat_map(|t| &t.steps).map(step).collect(),
        end: s.end,
        bound: s.bound.as_ref().map(|l| factor(model, l, None)),
        standing: s.verdict.as_ref().map(|a| standing(model, a)),
    }
}
