//! Members between displaced ends.
//!
//! A tie, strut, bar or tendon pulls along the line between its points as these have moved with
//! their blocks; soil and toothed corners push in the direction that they have in the scene, where
//! the block has come to. Bounds stay what they are, except that what has gone slack carries
//! nothing: a tie that is shorter than it was at the start, a strut that is longer, soil that the
//! block has moved away from.

use crate::verdict::member::legs;
use base::tolerance;
use model::assembly::{Action, Anchor, Assembly, Member, Pose, Wrench};
use nalgebra::Vector3;

/// The way of a point with its block since the start, m; none on the ground.
fn way(
    assembly: &Assembly,
    poses: &[Pose],
    block: Option<usize>,
    at: &Vector3<f64>,
) -> Vector3<f64> {
    block.map_or_else(Vector3::zeros, |i| poses[i].way(&assembly.blocks[i].centroid, at))
}

/// Whether it is known what a member does after large displacements: lines, and pushes from the
/// ground.
pub fn is_followed(member: &Member) -> bool {
    matches!(member.action, Action::Line(_) | Action::Push { from: None, .. })
}

/// By how much a member has yielded to a positive amount since the start, m: how much longer it has
/// become, or how far the block has moved against the push.
pub fn extent(assembly: &Assembly, poses: &[Pose], member: &Member) -> f64 {
    match &member.action {
        Action::Line(anchors) => anchors
            .windows(2)
            .map(|pair| {
                let [p, q] = [pair[0], pair[1]];
                let start = q.at - p.at;
                let by =
                    way(assembly, poses, q.block, &q.at) - way(assembly, poses, p.block, &p.at);
                // ‖start + by‖ − ‖start‖ without the rounding of a difference.
                by.dot(&(2.0 * start + by)) / ((start + by).norm() + start.norm())
            })
            .sum(),
        Action::Push { on, at, direction, .. } => {
            -direction.dot(&way(assembly, poses, Some(*on), at))
        }
        Action::Shear { .. } | Action::Press { .. } => 0.0,
    }
}

/// What extents of a member are measured by, m: its length, or the size of the block that it pushes.
pub fn scale(assembly: &Assembly, member: &Member) -> f64 {
    match &member.action {
        Action::Line(anchors) => {
            anchors.windows(2).map(|pair| (pair[1].at - pair[0].at).norm()).sum()
        }
        Action::Push { on, .. } | Action::Press { on, .. } => assembly.blocks[*on].size,
        Action::Shear { blocks: [a, b], .. } => {
            assembly.blocks[*a].size.min(assembly.blocks[*b].size)
        }
    }
}

/// The member at poses.
#[must_use]
pub fn displaced(assembly: &Assembly, poses: &[Pose], member: &Member) -> Member {
    let mut moved = member.clone();
    match &mut moved.action {
        Action::Line(anchors) => {
            for Anchor { block, at } in anchors {
                *at += way(assembly, poses, *block, at);
            }
        }
        Action::Push { on, at, .. } | Action::Press { on, at, .. } => {
            *at += way(assembly, poses, Some(*on), at);
        }
        Action::Shear { blocks, at, .. } => *at += way(assembly, poses, Some(blocks[0]), at),
    }
    let slack = tolerance::JOINT_CLOSED * scale(assembly, member);
    let extent = extent(assembly, poses, member);
    // What takes both signs, a bar, is never slack.
    if member.least == 0.0 && extent < -slack {
        moved.greatest = 0.0;
    }
    if member.greatest == 0.0 && extent > slack {
        moved.least = 0.0;
    }
    moved
}

/// What this amount of a member, as it lies now, does to each of its blocks: wrenches about these
/// centres.
pub fn wrenches(
    member: &Member,
    amount: f64,
    center: impl Fn(usize) -> Vector3<f64>,
) -> Vec<(usize, Wrench)> {
    let mut list = Vec::new();
    for leg in legs(member).iter().filter(|leg| leg.axis == 0) {
        for (block, sign) in [(leg.a, -1.0), (leg.b, 1.0)] {
            let Some(i) = block else { continue };
            let force = leg.direction * (sign * amount);
            let moment = (leg.at - center(i)).cross(&force);
            list.push((i, Wrench { force, moment }));
        }
    }
    list
}
