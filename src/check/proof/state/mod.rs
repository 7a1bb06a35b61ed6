//! Results of `state`: displacements are saved, step by step, and everything else follows from them
//! by the laws of the joints, once here, for who answers and for who checks.

mod verify;

pub(super) use verify::verify;

use super::{
    answer::Answer,
    member::{MemberLine, lines},
    result::Direction,
};
use crate::{
    elastic::{
        EventKind, Grip, JointKind, JointState, Joints, PathEnd, PathFactor, Quadrature, Residuals,
        System, Touch, Track, Where, events, frequencies,
    },
    terms::Bound,
    verdict::{Rate, Verdict, exact::Grade},
};
use model::interface::Model;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The answer about joints that yield.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StateAnswer {
    /// `stable` where the forces of the state balance every block; else the verdict that `assess`
    /// gives, `undecided` where forces exist and no state was found.
    pub verdict: Verdict,
    /// How exactly it is proved that it stands; absent where no state was found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub proof: Option<Grade>,
    /// Where joints with an area are integrated.
    pub quadrature: Quadrature,
    /// What is left of balance, of Signorini's and of Coulomb's conditions, the worst of all states.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub residuals: Option<Residuals>,
    /// Displacement of every free block under the dead load.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub displacements: Vec<Displacement>,
    /// What every joint does under the dead load.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub joints: Vec<JointAnswer>,
    /// The greatest numbers of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub greatest: Option<Greatest>,
    /// Lowest frequencies of small motion about the state under the dead load, Hz, ascending,
    /// contacts as they are; 0 of motions that nothing resists.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub frequencies: Vec<f64>,
    /// Along a live load: how far the path goes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load_factor: Option<PathFactor>,
    /// The point whose way the curve shows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Watched {
    /// The block.
    pub block: String,
    /// Where it is at the start, m.
    pub point: [f64; 3],
}

/// A point of the curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CurvePoint {
    /// The load factor.
    pub load_factor: f64,
    /// Displacement of the control point, m.
    pub displacement: [f64; 3],
    /// Rotation vector of its block, rad.
    pub rotation: [f64; 3],
}

/// What happens to a joint, or to a member.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Event {
    /// The load factor at which it has happened.
    pub load_factor: f64,
    /// What.
    pub kind: EventKind,
    /// The joint.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub between: Option<[String; 2]>,
    /// The member.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub member: Option<String>,
}

/// The evidence: displacements, from which everything follows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StateResult {
    /// The states, the dead load first.
    pub steps: Vec<StepResult>,
    /// The bound on the live load, with its evidence.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bound: Option<Direction>,
    /// Steps of Newton's method that they took.
    pub newton_steps: usize,
}

/// A saved state.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StepResult {
    /// The load factor.
    pub load_factor: f64,
    /// Displacements of the free blocks that have moved.
    pub displacements: Vec<Displacement>,
}

/// What an answer is made of.
pub struct Given<'a> {
    /// The scene.
    pub model: &'a Model,
    /// Its joints with their stiffness.
    pub joints: &'a Joints,
    /// How their faces were summed up.
    pub quadrature: Quadrature,
    /// The states.
    pub track: &'a Track,
    /// How exactly the verdict is proved.
    pub proof: Option<Grade>,
    /// A block and a point of it, m, whose displacement is told.
    pub control: Option<(usize, Vector3<f64>)>,
    /// How the path under the live load ended.
    pub end: PathEnd,
    /// The bound of rigid blocks on the live load.
    pub bound: Option<Bound>,
}

impl Given<'_> {
    /// The answer that follows.
    pub fn answer(&self) -> StateAnswer {
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
    pub fn without(verdict: Verdict, quadrature: Quadrature) -> Self {
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
    /// What it says of joints that yield.
    pub fn state(&self) -> Option<&StateAnswer> {
        match self {
            Self::State(a) => Some(a),
            _ => None,
        }
    }
}
