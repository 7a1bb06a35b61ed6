//! A path of states: the dead load first, then one state an increment of the live load, each from
//! what the joints remember of the one before.

use super::{
    joints::{JointKind, Joints},
    law::AT_LIMIT,
    member::Carries,
    residual::{Residuals, residuals},
    state::{ElasticState, States, corner_forces},
};
use crate::verdict::{Forces, Rate};
use model::interface::Model;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How much of a joint presses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Touch {
    /// All of it.
    Pressed,
    /// A part of it.
    PartlyOpen,
    /// Nothing.
    Open,
}

/// How much of what presses has reached its limit of friction in this step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Grip {
    /// Nothing.
    Sticks,
    /// A part.
    Slips,
    /// All of it: the joint slides.
    Slides,
}

/// What a joint does, in two words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Condition {
    /// How much presses.
    pub touch: Touch,
    /// How much slides.
    pub grip: Grip,
}

/// What all joints and members do, in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Conditions {
    /// One a joint.
    pub joints: Vec<Condition>,
    /// One a member.
    pub members: Vec<Carries>,
}

/// What happens to a joint or a member between two states.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EventKind {
    /// Its edge opens.
    Opens,
    /// All of it presses again.
    Closes,
    /// It parts altogether.
    Parts,
    /// It touches again.
    Touches,
    /// A part of it begins to slide.
    Slips,
    /// All of it slides.
    Slides,
    /// It sticks again.
    Sticks,
    /// A member goes slack.
    Slackens,
    /// It carries again.
    Tightens,
    /// It has reached its strength.
    Yields,
    /// It carries less than its strength again.
    Holds,
}

/// What something happens to, by its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Where {
    /// A joint.
    Joint(usize),
    /// A member.
    Member(usize),
}

/// A state on the path.
#[derive(Clone, Debug)]
pub struct Step {
    /// The load factor.
    pub load_factor: f64,
    /// Displacements of all blocks.
    pub displaced: Vec<Rate>,
    /// What the joints and members do, in words.
    pub conditions: Conditions,
    /// What is left of the laws.
    pub residuals: Residuals,
}

/// A path.
#[derive(Clone, Debug)]
pub struct Track {
    /// The states, the one under the dead load first.
    pub steps: Vec<Step>,
    /// What the joints remember of the last one.
    pub state: ElasticState,
    /// What the joints and members do under the dead load.
    pub dead: States,
    /// The same as forces at the corners.
    pub forces: Forces,
    /// What the joints remember under the dead load.
    pub at_rest: ElasticState,
    /// What the joints and members do in the last state.
    pub last: States,
    /// The forces of the last state, at the corners.
    pub last_forces: Forces,
}

/// Edges that open by less than this share of what their joint closes are closed. More: edges that
/// open go unseen. Less: rounding opens joints that press evenly.
const EDGE: f64 = 1e-9;
/// Joints that close by less than this share of the greatest closing at their blocks are open. More: joints that
/// hardly press are open. Less: rounding closes them.
const TOUCHES: f64 = 1e-12;

impl Track {
    /// Begins with displacements under the dead load.
    pub fn start(model: &Model, joints: &Joints, displaced: Vec<Rate>) -> Self {
        let (state, dead) = ElasticState::start(model, joints).step(model, joints, displaced);
        let forces = corner_forces(model, joints, &dead);
        let step = Step {
            load_factor: 0.0,
            displaced: state.displaced.clone(),
            conditions: conditions(joints, &dead),
            residuals: residuals(model, joints, &dead, &forces, 0.0),
        };
        Self {
            steps: vec![step],
            at_rest: state.clone(),
            state,
            last: dead.clone(),
            dead,
            last_forces: forces.clone(),
            forces,
        }
    }

    /// What the joints and members would do in the next state.
    pub fn ahead(&self, model: &Model, joints: &Joints, displaced: &[Rate]) -> Conditions {
        conditions(joints, &self.state.step(model, joints, displaced.to_vec()).1)
    }

    /// One state on.
    pub fn push(&mut self, model: &Model, joints: &Joints, load_factor: f64, displaced: Vec<Rate>) {
        let (state, last) = self.state.step(model, joints, displaced);
        let forces = corner_forces(model, joints, &last);
        self.steps.push(Step {
            load_factor,
            displaced: state.displaced.clone(),
            conditions: conditions(joints, &last),
            residuals: residuals(model, joints, &last, &forces, load_factor),
        });
        (self.state, self.last, self.last_forces) = (state, last, forces);
    }

    /// The worst of each residual on the whole path.
    pub fn residuals(&self) -> Residuals {
        let mut all = self.steps[0].residuals;
        for s in &self.steps[1..] {
            let r = s.residuals;
            all.balance = all.balance.max(r.balance);
            all.gap = all.gap.max(r.gap);
            all.pressure = all.pressure.max(r.pressure);
            all.complementarity = all.complementarity.max(r.complementarity);
            all.cone = all.cone.max(r.cone);
            all.sticking = all.sticking.max(r.sticking);
            all.direction = all.direction.max(r.direction);
        }
        all
    }

    /// Whether anything that the live load acts on has slid on the way.
    pub fn slides(&self, joints: &Joints) -> bool {
        let loaded: Vec<bool> = (joints.list.iter())
            .map(|j| j.free.iter().any(|i| joints.reached.contains(i)))
            .collect();
        let slides = |c: &Condition| c.grip != Grip::Sticks;
        let here = |s: &Step| s.conditions.joints.iter().zip(&loaded).any(|(c, l)| *l && slides(c));
        self.steps.iter().any(here)
    }
}

/// What all joints and members do, in words.
pub fn conditions(joints: &Joints, states: &States) -> Conditions {
    let members = states.members.iter().map(|p| p.carries).collect();
    let states = &states.joints;
    let closing = joints.greatest_near(|k| -states[k].opening[0]);
    let joints = (joints.list.iter().zip(states).zip(closing))
        .map(|((joint, s), closing)| {
            let [low, high] = s.opening;
            let touch = if -low <= TOUCHES * closing {
                Touch::Open
            } else if high <= EDGE * -low {
                Touch::Pressed
            } else {
                Touch::PartlyOpen
            };
            let mu = match &joint.kind {
                JointKind::Bed(bed) => bed.mu,
                JointKind::Grain(grain) => grain.mu,
            };
            let moves = |s: &&super::law::Spot| s.slip != [0.0; 2];
            let limit =
                |s: &&super::law::Spot| s.shear[0].hypot(s.shear[1]) >= AT_LIMIT * mu * s.normal;
            let all = s.spots.iter().filter(|s| s.normal > 0.0);
            let slide = all.clone().filter(moves).filter(limit).count();
            // Of spheres the rim slides before all does.
            let rim = matches!(joint.kind, JointKind::Grain(_)) && all.clone().any(|s| moves(&s));
            let grip = match (slide, all.count()) {
                (0, _) if !rim => Grip::Sticks,
                (some, all) if some == all => Grip::Slides,
                _ => Grip::Slips,
            };
            Condition { touch, grip }
        })
        .collect();
    Conditions { joints, members }
}

/// What happens between two states, joint by joint, then member by member.
pub fn events(before: &Conditions, after: &Conditions) -> Vec<(EventKind, Where)> {
    let mut list = Vec::new();
    for (k, (a, b)) in before.joints.iter().zip(&after.joints).enumerate() {
        let touch = match (a.touch, b.touch) {
            (a, b) if a == b => None,
            (Touch::Pressed, Touch::PartlyOpen) => Some(EventKind::Opens),
            (_, Touch::Open) => Some(EventKind::Parts),
            (Touch::Open, _) => Some(EventKind::Touches),
            _ => Some(EventKind::Closes),
        };
        let grip = match (a.grip, b.grip) {
            (a, b) if a == b => None,
            (_, Grip::Slides) => Some(EventKind::Slides),
            (Grip::Sticks, Grip::Slips) => Some(EventKind::Slips),
            (_, Grip::Sticks) => Some(EventKind::Sticks),
            // From sliding to slipping: a part of it sticks again.
            _ => Some(EventKind::Slips),
        };
        list.extend(touch.into_iter().chain(grip).map(|kind| (kind, Where::Joint(k))));
    }
    for (m, (a, b)) in before.members.iter().zip(&after.members).enumerate() {
        let kind = match (a, b) {
            (a, b) if a == b => continue,
            (_, Carries::Slack) => EventKind::Slackens,
            (_, Carries::Yields) => EventKind::Yields,
            (Carries::Slack, Carries::Holds) => EventKind::Tightens,
            (_, Carries::Holds) => EventKind::Holds,
        };
        list.push((kind, Where::Member(m)));
    }
    list
}
