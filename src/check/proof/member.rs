//! The forces in the members of a scene, as an answer has them and as its evidence.

use crate::verdict::{
    Forces, certificate,
    mechanism::MemberMotion,
    member::{Bounds, amounts},
};
use model::{
    assembly::{Member, MemberKind},
    interface::Model,
};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// The force in one member: of the forces that prove the answer, which may not be the only ones.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MemberLine {
    /// Its name; that of a strip with the number of the joint.
    pub member: String,
    /// What it is.
    pub kind: MemberKind,
    /// The force, N: tension > 0 in a tie, strut, bar or tendon; the size of a shear; the normal
    /// force of a finger.
    pub force: f64,
    /// The friction force of a finger, N.
    pub friction: Option<f64>,
    /// Its least force, N, where there is one.
    pub least: Option<f64>,
    /// Its greatest force, N, where there is one.
    pub greatest: Option<f64>,
    /// How it carries.
    pub state: MemberState,
}

/// A member of a mechanism.
#[derive(
    Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, schemars::JsonSchema,
)]
#[serde(deny_unknown_fields)]
pub struct MemberWords {
    /// Its name.
    pub member: String,
    /// What it does.
    pub motion: MemberMotion,
}

/// How a member carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MemberState {
    /// Next to nothing.
    Slack,
    /// Less than its strength.
    Carries,
    /// As much as it can.
    AtStrength,
}

/// A force below this share of the total load is none. Larger: small forces that hold something are
/// called slack. Smaller: the engine's noise is called a force.
const SLACK: f64 = 1e-9;
/// Forces within this share of a strength have reached it.
const REACHED: f64 = 1e-6;

/// The forces in all members.
pub fn lines(model: &Model, forces: &Forces) -> Vec<MemberLine> {
    let assembly = &model.assembly;
    let joints = model.interfaces.list.len();
    let members = &model.interfaces.members;
    if members.is_empty() {
        return Vec::new();
    }
    let total: f64 = assembly.free().map(|i| certificate::load_scale(assembly, i)).sum();
    let own = members.iter().zip(forces.iter().skip(joints));
    own.map(|(member, forces)| line(member, &amounts(forces), total)).collect()
}

fn line(member: &Member, a: &Vector3<f64>, total: f64) -> MemberLine {
    let finite = |v: f64| v.is_finite().then_some(v);
    let (force, friction, least) = match Bounds::of(member) {
        Bounds::Range(least, _) => (a.x, None, finite(least)),
        Bounds::Disc(_) => (a.x.hypot(a.y), None, None),
        Bounds::Cone { .. } => (a.x, Some(a.y.hypot(a.z)), None),
    };
    let greatest = finite(member.greatest);
    let at = |end: Option<f64>| {
        end.is_some_and(|end| end != 0.0 && (force - end).abs() <= REACHED * end.abs())
    };
    let state = if force.abs() <= SLACK * total {
        MemberState::Slack
    } else if at(least) || at(greatest) {
        MemberState::AtStrength
    } else {
        MemberState::Carries
    };
    let (id, kind) = (member.id.clone(), member.kind);
    MemberLine { member: id, kind, force, friction, least, greatest, state }
}

/// Whether two lists say the same, forces up to rounding.
pub fn agree(here: &[MemberLine], said: &[MemberLine]) -> bool {
    let most = here.iter().map(|l| l.force.abs()).fold(0.0, f64::max);
    let near = |a: f64, b: f64| (a - b).abs() <= base::tolerance::SAVED * most.max(a.abs());
    let same = |(a, b): (&MemberLine, &MemberLine)| {
        near(a.force, b.force)
            && near(a.friction.unwrap_or(0.0), b.friction.unwrap_or(0.0))
            && MemberLine { force: a.force, friction: a.friction, ..b.clone() } == *a
    };
    here.len() == said.len() && here.iter().zip(said).all(same)
}
