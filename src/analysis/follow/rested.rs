//! A pose under dry friction, and how its joints touch.

use super::tracker::Tracker;
use base::tolerance;
use check::{
    path::Side,
    verdict::{Forces, Rate},
};
use model::assembly::Pose;
use nalgebra::Vector3;

/// What a joint does over a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum JointChange {
    /// It touches nowhere.
    Open,
    /// It touches along an edge or at a point, on the face of one block or of neither.
    Hinged(Side),
    /// It touches all over.
    Closed,
}

/// A pose under dry friction.
#[derive(Clone)]
pub(super) struct Rested {
    pub value: f64,
    pub poses: Vec<Pose>,
    /// The joint at the start of every contact, and where it touches.
    pub touch: Vec<(usize, Vec<Vector3<f64>>)>,
    /// Forces there.
    pub forces: Forces,
    /// Others that prove that it stands, where these leave no room for a proof.
    pub proving: Option<Forces>,
    /// How each joint touches, and whether it slid in the step that led here.
    pub joints: Vec<(JointChange, bool)>,
    /// How the blocks moved in that step, per unit of the parameter.
    pub rates: Vec<Rate>,
    /// The load factor that balances it; 0 where none is asked for.
    pub load_factor: f64,
    /// The power of the live load on these rates; 0 where there is none.
    pub power: f64,
}

impl Tracker<'_> {
    /// How every joint touches.
    pub(super) fn joints(
        &self,
        poses: &[Pose],
        slides: impl Fn(usize) -> bool,
    ) -> Vec<(JointChange, bool)> {
        let touch = |k: usize| {
            let spots = self.carried.spots(poses, k);
            let small = tolerance::JOINT_CLOSED * self.carried.size(k);
            let closed: Vec<Side> =
                spots.iter().filter(|s| s.gap.abs() <= small).map(|s| s.side).collect();
            match closed[..] {
                [] => JointChange::Open,
                _ if closed.len() == spots.len() => JointChange::Closed,
                [side, ..] if closed.iter().all(|s| *s == side) => JointChange::Hinged(side),
                _ => JointChange::Hinged(Side::Neither),
            }
        };
        (0..self.carried.joints.len()).map(|k| (touch(k), slides(k))).collect()
    }
}
