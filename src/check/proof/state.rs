//! Results of `state`: displacements are saved, step by step, and everything else follows from them
//! by the laws of the joints, once here, for who answers and for who checks.

use super::{
    answer::{Answer, LimitAnswer},
    certificate::Certificate,
    derive::{At, Derivation, computed, require},
    evidence::{StateEvidence, StepEvidence},
    member::{MemberLine, lines},
    told::{Direction, Told},
};
use crate::{
    elastic::{
        EventKind, Grip, JointKind, JointState, Joints, PathEnd, PathFactor, Quadrature, Residuals,
        System, Touch, Track, Where, events, frequencies,
    },
    question::StateOptions,
    terms::{Bound, Law, Outcome},
    verdict::{
        Evidence, Rate, Verdict,
        claim::{self, Claim, Findings},
        exact::Grade,
    },
};
use model::interface::Model;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use std::{collections::HashMap, sync::Arc};

/// Balance and laws hold to this, in multiples of what is greatest. More: forces that balance nothing
/// pass. Less: rounding of displacements in tall scenes is refused.
const HOLDS: f64 = 1e-8;

/// The answer about elastic joints.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct StateAnswer {
    /// `stable` where the forces of the state balance every block; else the verdict that `assess`
    /// gives, `undecided` where forces exist and no state was found.
    pub verdict: Verdict,
    /// How exactly it is proved that it stands; absent where no state was found.
    pub proof: Option<Grade>,
    /// Where joints with an area are integrated.
    pub quadrature: Quadrature,
    /// What is left of balance, of Signorini's and of Coulomb's conditions, the worst of all states.
    pub residuals: Option<Residuals>,
    /// Displacement of every free block under the dead load.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub displacements: Vec<Displacement>,
    /// What every joint does under the dead load.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub joints: Vec<JointAnswer>,
    /// The greatest numbers of them.
    pub greatest: Option<Greatest>,
    /// Lowest frequencies of small motion about the state under the dead load, Hz, ascending,
    /// contacts as they are; 0 of motions that nothing resists.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub frequencies: Vec<f64>,
    /// Along a live load: how far the path goes.
    pub load_factor: Option<PathFactor>,
    /// The point whose way the curve shows.
    pub control: Option<Watched>,
    /// The points of the path, the dead load first.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub curve: Vec<CurvePoint>,
    /// What happens on the way.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub events: Vec<Event>,
    /// What every joint does at the end of the path.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub joints_at_end: Vec<JointAnswer>,
    /// The forces in the members at the end of the path; those under the dead load stand beside the
    /// answer.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub members_at_end: Vec<MemberLine>,
}

/// How far a block has moved: small displacements.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Displacement {
    /// The block.
    pub block: String,
    /// Of its centre of mass, m.
    pub displacement: [f64; 3],
    /// Rotation vector, rad.
    pub rotation: [f64; 3],
}

/// What a joint does.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct JointAnswer {
    /// The two blocks; forces act on the second.
    pub between: [String; 2],
    /// The mean of its corners, m.
    pub at: [f64; 3],
    /// Unit normal from the first block into the second.
    pub normal: [f64; 3],
    /// Pressing force, N.
    pub normal_force: f64,
    /// Size of the shear force, N.
    pub shear_force: f64,
    /// Force on the second block, N.
    pub force: [f64; 3],
    /// Its moment about `at`, N·m.
    pub moment: [f64; 3],
    /// Greatest pressure, Pa; of spheres by Hertz.
    pub greatest_pressure: f64,
    /// Pressed area, m²; of spheres the circle of contact.
    pub pressed_area: f64,
    /// Its share of the joint; absent of spheres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pressed_share: Option<f64>,
    /// How far its sides are apart where they are farthest, m; 0 where all of it presses.
    pub opening: f64,
    /// How far they have come closer where they have most, m; of spheres their approach.
    pub closing: f64,
    /// Displacement of the second block against the first at `at`, along the joint, m.
    pub shear_displacement: f64,
    /// The longest way that a point of it slid in this step, m.
    pub slip: f64,
    /// How much of it presses.
    pub touch: Touch,
    /// How much of that slides.
    pub grip: Grip,
}

/// The greatest numbers of a state, with where they are.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Greatest {
    /// Displacement of a centre of mass, m.
    pub displacement: f64,
    /// The block.
    pub block: String,
    /// Pressure, Pa.
    pub pressure: f64,
    /// The joint.
    pub between: [String; 2],
    /// Opening, m.
    pub opening: f64,
    /// Slip, m.
    pub slip: f64,
}

/// A point of a block.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Watched {
    /// The block.
    pub block: String,
    /// Where it is at the start, m.
    pub point: [f64; 3],
}

/// A point of the curve.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct CurvePoint {
    /// The load factor.
    pub load_factor: f64,
    /// Displacement of the control point, m.
    pub displacement: [f64; 3],
    /// Rotation vector of its block, rad.
    pub rotation: [f64; 3],
}

/// What happens to a joint, or to a member.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Event {
    /// The load factor at which it has happened.
    pub load_factor: f64,
    /// What.
    pub kind: EventKind,
    /// The joint.
    pub between: Option<[String; 2]>,
    /// The member.
    pub member: Option<String>,
}

/// What an answer is made of.
struct Given<'a> {
    /// The scene.
    model: &'a Model,
    /// Its joints with their stiffness.
    joints: &'a Joints,
    /// How their faces were summed up.
    quadrature: Quadrature,
    /// The states.
    track: &'a Track,
    /// How exactly the verdict is proved.
    proof: Option<Grade>,
    /// A block and a point of it, m, whose displacement is told.
    control: Option<(usize, Vector3<f64>)>,
    /// How the path under the live load ended.
    end: PathEnd,
    /// The bound of rigid blocks on the live load.
    bound: Option<Bound>,
}

impl Given<'_> {
    /// The answer that follows.
    fn answer(&self) -> StateAnswer {
        let Self { model, joints, track, .. } = *self;
        let of = |states: &[JointState], step: usize| -> Vec<JointAnswer> {
            (0..joints.list.len()).map(|k| self.joint(k, &states[k], step)).collect()
        };
        let dead = of(&track.dead.joints, 0);
        let displacements = displacements(model, &track.steps[0].displaced);
        let greatest = greatest(&displacements, &dead);
        let system = System::new(model, joints);
        let frequencies = frequencies(&system, &track.at_rest, &track.at_rest.displaced);
        let last = track.steps.len() - 1;
        let live = self.end != PathEnd::None;
        StateAnswer {
            verdict: Verdict::Stable,
            proof: self.proof,
            quadrature: self.quadrature,
            residuals: Some(track.residuals()),
            displacements,
            joints: dead,
            greatest,
            frequencies,
            load_factor: self
                .bound
                .filter(|_| live)
                .map(|b| PathFactor::new(self.end, track, joints, b)),
            control: self.control.filter(|_| live).map(|(i, point)| Watched {
                block: model.assembly.blocks[i].id.clone(),
                point: point.into(),
            }),
            curve: if live { self.curve() } else { Vec::new() },
            events: self.events(),
            joints_at_end: if last > 0 { of(&track.last.joints, last) } else { Vec::new() },
            members_at_end: if last > 0 { lines(model, &track.last_forces) } else { Vec::new() },
        }
    }

    fn curve(&self) -> Vec<CurvePoint> {
        let Some((block, point)) = self.control else { return Vec::new() };
        let arm = point - self.model.assembly.blocks[block].centroid;
        self.track
            .steps
            .iter()
            .map(|s| {
                let q = &s.displaced[block];
                CurvePoint {
                    load_factor: s.load_factor,
                    displacement: (q.velocity + q.spin.cross(&arm)).into(),
                    rotation: q.spin.into(),
                }
            })
            .collect()
    }

    fn events(&self) -> Vec<Event> {
        let pairs = self.track.steps.windows(2);
        pairs
            .flat_map(|w| {
                let happened = events(&w[0].conditions, &w[1].conditions).into_iter();
                happened.map(|(kind, at)| {
                    let (between, member) = match at {
                        Where::Joint(k) => (Some(self.names(k)), None),
                        Where::Member(m) => {
                            (None, Some(self.model.interfaces.members[m].id.clone()))
                        }
                    };
                    Event { load_factor: w[1].load_factor, kind, between, member }
                })
            })
            .collect()
    }

    fn names(&self, k: usize) -> [String; 2] {
        let joint = &self.joints.list[k];
        [joint.a, joint.b].map(|i| self.model.assembly.blocks[i].id.clone())
    }

    fn joint(&self, k: usize, state: &JointState, step: usize) -> JointAnswer {
        let joint = &self.joints.list[k];
        let n = joint.frame.n;
        let normal = state.normal();
        let across = state.force - n * state.force.dot(&n);
        let closing = (-state.opening[0]).max(0.0);
        let (pressure, area, share) = match &joint.kind {
            JointKind::Bed(bed) => {
                (bed.normal * closing, state.area(), Some(state.area() / bed.area()))
            }
            JointKind::Grain(grain) => {
                let circle = std::f64::consts::PI * grain.radius * closing;
                (if circle > 0.0 { 1.5 * normal / circle } else { 0.0 }, circle, None)
            }
        };
        let condition = self.track.steps[step].conditions.joints[k];
        JointAnswer {
            between: self.names(k),
            at: joint.at.into(),
            normal: n.into(),
            normal_force: normal,
            shear_force: across.norm(),
            force: state.force.into(),
            moment: state.moment.into(),
            greatest_pressure: pressure,
            pressed_area: area,
            pressed_share: share,
            opening: state.opening[1].max(0.0),
            closing,
            shear_displacement: state.motion[0].hypot(state.motion[1]),
            slip: state.slip(),
            touch: condition.touch,
            grip: condition.grip,
        }
    }
}

/// Displacements of the free blocks, with names.
pub fn displacements(model: &Model, displaced: &[Rate]) -> Vec<Displacement> {
    let one = |i: usize| Displacement {
        block: model.assembly.blocks[i].id.clone(),
        displacement: displaced[i].velocity.into(),
        rotation: displaced[i].spin.into(),
    };
    model.assembly.free().map(one).collect()
}

fn greatest(displacements: &[Displacement], joints: &[JointAnswer]) -> Option<Greatest> {
    let size = |d: &Displacement| Vector3::from(d.displacement).norm();
    let far = displacements.iter().max_by(|a, b| size(a).total_cmp(&size(b)))?;
    let hard = joints.iter().max_by(|a, b| a.greatest_pressure.total_cmp(&b.greatest_pressure))?;
    let most = |of: fn(&JointAnswer) -> f64| joints.iter().map(of).fold(0.0, f64::max);
    Some(Greatest {
        displacement: size(far),
        block: far.block.clone(),
        pressure: hard.greatest_pressure,
        between: hard.between.clone(),
        opening: most(|j| j.opening),
        slip: most(|j| j.slip),
    })
}

impl StateAnswer {
    /// Without a state: a verdict alone.
    fn without(verdict: Verdict, quadrature: Quadrature) -> Self {
        Self {
            verdict,
            proof: None,
            quadrature,
            residuals: None,
            displacements: Vec::new(),
            joints: Vec::new(),
            greatest: None,
            frequencies: Vec::new(),
            load_factor: None,
            control: None,
            curve: Vec::new(),
            events: Vec::new(),
            joints_at_end: Vec::new(),
            members_at_end: Vec::new(),
        }
    }
}

impl Answer {
    /// What it says of elastic joints.
    pub fn state(&self) -> Option<&StateAnswer> {
        match self {
            Self::State(a) => Some(a),
            _ => None,
        }
    }
}

/// From the displacements the joints' forces are computed, step by step, and with them everything
/// that the answer says; without a state the verdict alone.
pub(super) fn derive(
    d: &mut Derivation,
    o: &StateOptions,
    e: &StateEvidence,
) -> Result<Told, String> {
    let model = d.model;
    let quadrature = e.quadrature.unwrap_or(o.quadrature);
    if e.steps.is_empty() {
        let dead =
            d.dead(model, e.standing.as_ref()).ok_or("there is neither a state nor a verdict")?;
        let verdict = match dead.answer.verdict() {
            Some(Verdict::Stable) | None => Verdict::Undecided,
            Some(other) => other,
        };
        d.check.claimed = verdict != Verdict::Undecided;
        let answer = StateAnswer::without(verdict, quadrature);
        let mut told = Told::new(model, Answer::State(Box::new(answer)), &Arc::default());
        told.dead_load = Some(dead);
        return Ok(told);
    }
    if e.standing.is_some() {
        return Err("the evidence has a verdict beside the state that was not asked for".into());
    }
    let joints = Joints::new(model, quadrature).map_err(|e| e.to_string())?;
    let track = track(model, &joints, e)?;
    d.part("states", laws(&track));
    let mut f = Findings::default();
    let evidence = Evidence::new(&track.forces, &[]);
    let found = claim::verify(model, &Claim::Stable, evidence);
    let proof = found.proved().then_some(found.grade);
    require(&mut f, proof.is_some(), "the forces of the joints balance the dead load");
    let certificate = Certificate::new(model, proof.map(|_| Claim::Stable), evidence, &found);
    f.and(&found);
    d.part("forces under the dead load", f);
    d.check.claimed = proof.is_some();
    let bound = e.bound.as_ref().map(|own| {
        let at: At = &|_| Ok(model.clone());
        let factor = d.factor("bound on the live load", model, at, (own, Law::Associative), None);
        let answer = LimitAnswer {
            load_factor: factor.answer,
            verdict: None,
            part: factor.part,
            proof: factor.proof,
        };
        Direction { answer: Answer::Limit(answer), certificate: own.bound.clone(), dry: None }
    });
    let limit = bound.as_ref().and_then(|b| b.answer.bound()).copied();
    let mut f = Findings::default();
    path(&mut f, (e, o), &track, limit);
    ends_again(d, &mut f, (e, o), &track);
    f.computed |= track.steps.len() > 1;
    d.part("path", f);
    let answer = Given {
        model,
        joints: &joints,
        quadrature,
        track: &track,
        proof,
        control: control(model, o)?,
        end: e.end,
        bound: limit,
    }
    .answer();
    let mut told = Told::new(model, Answer::State(Box::new(answer)), &certificate);
    told.members = lines(model, &track.forces);
    told.bound = bound;
    Ok(told)
}

/// The block and the point whose displacement is told.
fn control(model: &Model, o: &StateOptions) -> Result<Option<(usize, Vector3<f64>)>, String> {
    let Some(c) = &o.control else { return Ok(None) };
    let block = model.assembly.find(&c.block).filter(|&i| !model.assembly.blocks[i].support);
    let block = block.ok_or(format!("{}: there is no such free block", c.block))?;
    Ok(Some((block, c.point.into())))
}

/// The states that the displacements make.
fn track(model: &Model, joints: &Joints, e: &StateEvidence) -> Result<Track, String> {
    let index: HashMap<&str, usize> =
        model.assembly.blocks.iter().enumerate().map(|(i, b)| (b.id.as_str(), i)).collect();
    let read = |step: &StepEvidence| -> Result<Vec<Rate>, String> {
        let mut displaced = vec![Rate::zero(); model.assembly.blocks.len()];
        for d in &step.displacements {
            let Some(&i) = index.get(d.block.as_str()) else {
                return Err(format!("the scene has no block {}", d.block));
            };
            if model.assembly.blocks[i].support {
                return Err(format!("block {} is a support and cannot move", d.block));
            }
            displaced[i] = Rate { velocity: d.displacement.into(), spin: d.rotation.into() };
            if !displaced[i].velocity.iter().chain(&displaced[i].spin).all(|v| v.is_finite()) {
                return Err(format!("block {}: a number is not finite", d.block));
            }
        }
        Ok(displaced)
    };
    let first = &e.steps[0];
    if first.load_factor != 0.0 {
        return Err("the first state is not that of the dead load".into());
    }
    let mut track = Track::start(model, joints, read(first)?);
    for pair in e.steps.windows(2) {
        if !(pair[1].load_factor > pair[0].load_factor && pair[1].load_factor.is_finite()) {
            return Err("the load factors of the path do not increase".into());
        }
        track.push(model, joints, pair[1].load_factor, read(&pair[1])?);
    }
    Ok(track)
}

/// Balance, Signorini's three conditions and Coulomb's, at every state.
fn laws(track: &Track) -> Findings {
    let r = track.residuals();
    let mut f = Findings { grade: Grade::ToRounding(r.worst()), ..Findings::default() };
    for (what, value) in [
        ("equilibrium error of every block, relative to its load", r.balance),
        ("Signorini, gap >= 0 relative to the closure of the joint", r.gap),
        ("Signorini, pressure >= 0", r.pressure),
        ("Signorini, gap x pressure = 0", r.complementarity),
        ("Coulomb, shear within the cone", r.cone),
        ("Coulomb, slip only at the friction limit", r.sticking),
        ("Coulomb, slip against the shear force", r.direction),
    ] {
        require(&mut f, value <= HOLDS, format!("{what}: within {value:.1e}"));
    }
    f
}

/// The path does not reach beyond its bound, and ends where it says.
fn path(
    f: &mut Findings,
    (e, o): (&StateEvidence, &StateOptions),
    track: &Track,
    bound: Option<Bound>,
) {
    let last = track.steps[track.steps.len() - 1].load_factor;
    let live = e.end != PathEnd::None;
    require(
        f,
        bound.is_some() == live && (live || e.steps.len() == 1) && !(live && o.dead_only),
        "a path is given where there is a bound, and only there",
    );
    let Some(bound) = bound else { return };
    let fits = match e.end {
        PathEnd::Bound => bound.status == Outcome::Found,
        PathEnd::Unbounded => bound.status == Outcome::Unbounded,
        PathEnd::None | PathEnd::NoBalance | PathEnd::Open => true,
    };
    require(f, fits, "the end of the path agrees with its bound");
    let Some(top) = bound.upper.filter(|_| bound.status == Outcome::Found) else { return };
    require(f, last <= top, format!("the path ends at {last}, not above the bound {top}"));
    if e.end == PathEnd::Bound {
        let near = bound.value.is_some_and(|v| last >= (1.0 - 2e-3) * v);
        require(f, near, "the path ends a thousandth below the bound");
    }
}

/// That no displacements balance more, or that it was followed far without a bound, is computed: the
/// path is followed again.
fn ends_again(
    d: &Derivation,
    f: &mut Findings,
    (e, o): (&StateEvidence, &StateOptions),
    track: &Track,
) {
    let told = matches!(e.end, PathEnd::NoBalance | PathEnd::Unbounded);
    if !told || !d.asks_again() || !f.fails.is_empty() {
        return;
    }
    let last = track.steps[track.steps.len() - 1].load_factor;
    let text = format!("the path ends at {last}");
    match d.again.stated(o, d.scene, d.model) {
        Some(Err(e)) => f.fails.push(format!("the path cannot be computed for this scene: {e}")),
        Some(Ok((end, there))) => {
            let same = end == e.end && (there - last).abs() <= 1e-6 * last.abs().max(there.abs());
            computed(f, Some(same), text);
        }
        None => computed(f, None, text),
    }
}
