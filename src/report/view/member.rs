//! Members as there is something to see of them.

use check::proof::{member::MemberState, result::ResultFile};
use model::{
    assembly::{Action, MemberKind},
    interface::Model,
};
use nalgebra::Vector3;

/// A member.
#[derive(Clone, Debug, PartialEq)]
pub struct ViewMember {
    /// Its name.
    pub id: String,
    /// What it is.
    pub kind: MemberKind,
    /// Its ends and deviators, or where it acts, m.
    pub points: Vec<Vector3<f64>>,
    /// The block at each of them; none at the ground.
    pub bodies: Vec<Option<usize>>,
    /// Of what pushes: the direction in which it does.
    pub direction: Option<Vector3<f64>>,
    /// Its force, N, where an answer has one.
    pub force: Option<f64>,
    /// Its greatest force, N; infinite where it never yields.
    pub strength: f64,
    /// Whether an answer has it carry nothing.
    pub slack: bool,
}

/// The members of a model.
pub fn of(model: &Model) -> Vec<ViewMember> {
    // What pushes at one point is held against something else; the last end is what is pushed.
    let bodies = |m: &model::assembly::Member| match (m.action.points().len(), m.action.ends()) {
        (1, ends) => vec![ends.last().copied().flatten()],
        (_, ends) => ends,
    };
    let view = |m: &model::assembly::Member| ViewMember {
        id: m.id.clone(),
        kind: m.kind,
        points: m.action.points(),
        bodies: bodies(m),
        direction: match &m.action {
            Action::Push { direction, .. } => Some(*direction),
            Action::Press { normal, .. } => Some(*normal),
            Action::Line(_) | Action::Shear { .. } => None,
        },
        force: None,
        strength: m.greatest.max(-m.least),
        slack: false,
    };
    model.interfaces.members.iter().map(view).collect()
}

/// The forces that a result has in them.
pub fn forces(members: &mut [ViewMember], file: &ResultFile) {
    for member in members {
        if let Some(line) = file.members.iter().find(|l| l.member == member.id) {
            member.force = Some(line.force);
            member.slack = line.state == MemberState::Slack;
        }
    }
}
