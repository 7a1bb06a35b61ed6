//! Results of `settle` and `push`: a curve, each point of it with its poses and its proof.

mod derive;
mod links;

pub(super) use derive::{curve, derive};

use super::certificate::Certificate;
use crate::{path::Carried, path::saved::SavedPose, verdict::claim::Claim};
use base::tolerance;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::Serialize;
use serde_with::skip_serializing_none;
use std::sync::Arc;

/// How far it goes.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct PathAnswer {
    /// How it ends.
    pub status: PathStatus,
    /// The last value of the parameter that is proved: it stands there, or has the load factor of
    /// the last point. Settle: a share of the movement; push: the way of the control point, m.
    /// Absent where nothing is proved.
    pub value: Option<f64>,
    /// It falls: at this value it is proved to.
    pub falls_at: Option<f64>,
    /// It jumps here first: the motion turns back, and what is told of beyond is what it may come to
    /// by a motion that is not followed.
    pub jumps_at: Option<f64>,
    /// Settle: the least power that the blocks' forces on the supports can have at the start as
    /// these begin to move, J per unit of the parameter. Where one support moves straight by 1 m it
    /// is its least reaction in that direction, N.
    pub least_reaction: Option<Bracketed>,
    /// Why it was not followed any further; it stands under `run`.
    #[serde(skip)]
    pub why: Option<String>,
}

/// A value between two proved ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Bracketed {
    /// The value.
    pub value: f64,
    /// Lower end.
    pub lower: f64,
    /// Upper end.
    pub upper: f64,
}

/// How a path ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PathStatus {
    /// All of the movement was followed: it stands to its end.
    Reached,
    /// It falls on the way.
    Falls,
    /// The load factor vanishes: beyond it would have to be pulled back.
    Vanishes,
    /// A joint slides from here on, and no motion under dry friction was found that leads on.
    Slides,
    /// It was not followed any further.
    Open,
}

/// The curve.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct PathResult {
    /// What moves it.
    pub driven_by: DrivenBy,
    /// Points, in order. A jump has two at one value.
    pub points: Vec<PathPoint>,
    /// What happens on the way.
    pub events: Vec<PathEvent>,
    /// It falls: the last pose that is proved to stand and the first that is proved to fall, of the
    /// same linkage.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ends: Vec<PathPoint>,
    /// Settle: evidence for the least reaction at the start.
    #[serde(skip)]
    pub least: Option<Arc<Certificate>>,
}

/// What moves a structure.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum DrivenBy {
    /// Supports, in proportion to the parameter.
    Supports(Vec<MovingSupport>),
    /// Live loads, a point of a block going this way.
    Control {
        /// The block.
        block: String,
        /// The point of it at the start, m.
        point: [f64; 3],
        /// Unit direction.
        toward: [f64; 3],
    },
}

/// How far a support moves while the parameter goes from 0 to 1.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct MovingSupport {
    /// The support.
    pub support: String,
    /// The way, m.
    pub way: [f64; 3],
    /// The turn about its centre of mass: axis × angle, rad.
    pub turn: [f64; 3],
}

/// A point of the curve: a scene of its own.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct PathPoint {
    /// The parameter.
    pub value: f64,
    /// The load factor, where there is a live load; that of the certificate.
    pub load_factor: Option<f64>,
    /// The blocks' forces on the supports that move.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub reactions: Vec<Reaction>,
    /// Joints that have opened and still touch.
    pub hinges: Vec<Hinge>,
    /// Joints that have slid and still touch.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub slips: Vec<Slip>,
    /// Where the blocks are. Computed, not proved: the proof is about the scene that they make.
    #[serde(skip)]
    pub poses: Vec<SavedPose>,
    /// What is proved of that scene.
    #[serde(skip)]
    pub certificate: Arc<Certificate>,
    /// Its claim, where that holds.
    #[serde(skip)]
    pub proved: Option<Claim>,
    /// Of a load factor with dry friction, or where a joint slides and none is known: the load factor
    /// of joints that open as they slide, which no value passes.
    #[serde(rename = "bound")]
    pub most: Option<f64>,
}

/// The blocks' force on a support.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Reaction {
    /// The support.
    pub support: String,
    /// N.
    pub force: [f64; 3],
    /// About its centre of mass, N·m.
    pub moment: [f64; 3],
}

/// A joint that has opened and still touches.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Hinge {
    /// The blocks.
    pub between: [String; 2],
    /// The middle of what touches, m.
    pub at: [f64; 3],
    /// How wide it is open at most, m.
    pub width: f64,
}

/// A joint that has slid and still touches.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Slip {
    /// The blocks.
    pub between: [String; 2],
    /// The middle of what touches, m.
    pub at: [f64; 3],
    /// How far the blocks have slid there since the start at most, m.
    pub way: f64,
}

/// Something that happens on the way, as poses, forces and rates of the points show it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct PathEvent {
    /// The parameter.
    pub value: f64,
    /// What.
    pub kind: PathEventKind,
    /// Joints that open.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub opens: Vec<[String; 2]>,
    /// Joints that close.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub closes: Vec<[String; 2]>,
    /// Members that yield, or that go slack as it falls.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub yields: Vec<String>,
    /// Joints that begin to slide, or that stick again.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub slides: Vec<[String; 2]>,
    /// The longest way of a block in a jump, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub jump: Option<f64>,
}

/// What happens on the way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum PathEventKind {
    /// Another joint opens, and the motion goes on steadily.
    Opens,
    /// A joint closes.
    Closes,
    /// The motion turns back: it goes on elsewhere at the same value, by a jump.
    Jumps,
    /// It falls as these joints open.
    Falls,
    /// A member reaches what it can carry: from here on it yields, or goes slack.
    Yields,
    /// Joints slide from here on: followed under dry friction, without opening.
    Slides,
    /// Joints that slid stick from here on.
    Sticks,
}

/// Joints that have opened and still touch, from the poses.
pub fn hinges(carried: &Carried, poses: &[model::assembly::Pose]) -> Vec<Hinge> {
    let middle = |points: &[Vector3<f64>]| -> [f64; 3] {
        (points.iter().sum::<Vector3<f64>>() / points.len() as f64).into()
    };
    let mut corners = carried.corners(poses);
    corners.resize(carried.joints.len(), Vec::new());
    let corners = corners.into_iter().enumerate();
    corners
        .filter_map(|(k, corners)| {
            let (closed, widest): (Vec<Vector3<f64>>, f64) =
                if let Some(spots) = carried.slid(poses, k) {
                    let small = tolerance::JOINT_CLOSED * carried.size(k);
                    let (closed, open): (Vec<_>, Vec<_>) =
                        spots.into_iter().partition(|s| s.gap.abs() <= small);
                    let widest = open.iter().map(|s| s.gap).fold(0.0, f64::max);
                    (closed.into_iter().map(|s| s.at).collect(), widest)
                } else {
                    let (closed, open): (Vec<_>, Vec<_>) =
                        corners.into_iter().partition(|c| c.apart <= tolerance::JOINT_CLOSED);
                    let widest = open.iter().map(|c| c.apart).fold(0.0, f64::max);
                    let at = |c: &crate::path::Corner| carried.copies(poses, k, c.point)[0];
                    (closed.iter().map(at).collect(), widest * carried.size(k))
                };
            (!closed.is_empty() && widest > 0.0).then(|| Hinge {
                between: between(carried, k),
                at: middle(&closed),
                width: widest,
            })
        })
        .collect()
}

fn between(carried: &Carried, k: usize) -> [String; 2] {
    let face = &carried.joints[k];
    [face.a, face.b].map(|i| carried.start.assembly.blocks[i].id.clone())
}

/// Joints that have slid and still touch, from the poses.
pub fn slips(carried: &Carried, poses: &[model::assembly::Pose]) -> Vec<Slip> {
    (0..carried.joints.len())
        .filter_map(|k| {
            let small = tolerance::JOINT_CLOSED * carried.size(k);
            let spots = carried.slid(poses, k)?;
            let closed: Vec<Vector3<f64>> =
                spots.iter().filter(|s| s.gap.abs() <= small).map(|s| s.at).collect();
            let way = closed.iter().map(|at| carried.slip(poses, k, at)).fold(0.0, f64::max);
            let at = closed.iter().sum::<Vector3<f64>>() / closed.len().max(1) as f64;
            Some(Slip { between: between(carried, k), at: at.into(), way })
        })
        .collect()
}

/// Whether a point with this claim is one of the curve that is proved.
pub fn is_good(claim: &Claim) -> bool {
    matches!(claim, Claim::Stable | Claim::LoadFactor { .. } | Claim::DryLoadFactor { .. })
}
