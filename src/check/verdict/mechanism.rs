//! Reading a collapse mechanism: which blocks move, which joints hinge, slide or part.

use super::{
    Rate, certificate,
    member::{self, Bounds},
};
use base::tolerance;
use model::{
    assembly::{Assembly, Member},
    interface::{Interface, Model},
    strength::crushing::crushes,
};
use nalgebra::Vector3;
use scene::Friction;
use serde::{Deserialize, Serialize};

/// What a joint does in a mechanism.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, schemars::JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum JointMotion {
    /// Turns about an edge or a corner that stays in contact.
    Hinge,
    /// Slides (with the associated lift μ‖v_t‖ that limit analysis gives a sliding joint).
    Slide,
    /// Turns about an edge that slides.
    HingeAndSlide,
    /// Parts over its whole area.
    Part,
    /// Turns about a line inside the contact; what lies beyond it is crushed.
    Crush,
}

/// A joint that moves.
#[derive(Clone, Debug, PartialEq)]
pub struct MovingJoint {
    /// Index of the interface.
    pub interface: usize,
    /// What it does.
    pub motion: JointMotion,
    /// Where it keeps contact (mean of the closed or sliding corners), the middle of the line about
    /// which it turns where it is crushed beyond (of the crushed corners, where all are), or its
    /// middle where it parts, m.
    pub at: Vector3<f64>,
}

/// What a member does in a mechanism.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, schemars::JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum MemberMotion {
    /// Gives way at its strength: a tie lengthens, a strut shortens, soil is pushed back.
    Yields,
    /// Goes slack, or lets go.
    Slackens,
    /// A finger slides over the block.
    Slides,
}

/// A member that lengthens, shortens, goes slack or slides.
#[derive(Clone, Debug, PartialEq)]
pub struct MovingMember {
    /// Index of the member.
    pub member: usize,
    /// What it does.
    pub motion: MemberMotion,
}

/// A collapse mechanism in words.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mechanism {
    /// Blocks that move, the fastest first; those that are equally fast in the order of the scene.
    pub moving: Vec<usize>,
    /// Joints that move, in interface order.
    pub joints: Vec<MovingJoint>,
    /// Members that move, in their order.
    pub members: Vec<MovingMember>,
}

/// Reads the rates of a mechanism.
pub fn read(model: &Model, rates: &[Rate]) -> Mechanism {
    let Model { assembly, interfaces, .. } = model;
    let speed = |i: usize| certificate::speed(assembly, i, &rates[i]);
    let fastest = assembly.free().map(speed).fold(0.0, f64::max);
    let mut moving: Vec<usize> =
        assembly.free().filter(|&i| speed(i) > tolerance::MECHANISM_REST * fastest).collect();
    moving.sort_by(|&i, &j| speed(j).total_cmp(&speed(i)));
    let alike = |i: &usize, j: &usize| speed(*i) - speed(*j) <= tolerance::SAME_SPEED * fastest;
    moving.chunk_by_mut(alike).for_each(<[usize]>::sort_unstable);
    let joints =
        (0..interfaces.list.len())
            .filter_map(|k| {
                joint(assembly, &interfaces.list[k], rates, fastest)
                    .map(|(motion, at)| MovingJoint { interface: k, motion, at })
            })
            .collect();
    let members = (0..interfaces.members.len()).filter_map(|m| {
        let motion = member_motion(assembly, &interfaces.members[m], rates, fastest)?;
        Some(MovingMember { member: m, motion })
    });
    Mechanism { moving, joints, members: members.collect() }
}

fn member_motion(
    assembly: &Assembly,
    own: &Member,
    rates: &[Rate],
    fastest: f64,
) -> Option<MemberMotion> {
    let rest = tolerance::MECHANISM_REST * fastest;
    let u = member::power(assembly, own, rates);
    if u.norm() <= rest {
        return None;
    }
    Some(match Bounds::of(own) {
        Bounds::Range(least, greatest) => {
            // Lengthening is power against a tension.
            let gives = if u.x < 0.0 { greatest > 0.0 } else { least < 0.0 };
            if gives { MemberMotion::Yields } else { MemberMotion::Slackens }
        }
        Bounds::Disc(_) => MemberMotion::Yields,
        Bounds::Cone { mu, .. } => {
            let lift = u.x - mu * u.y.hypot(u.z);
            if lift > rest {
                MemberMotion::Slackens
            } else if u.y.hypot(u.z) > rest {
                MemberMotion::Slides
            } else {
                MemberMotion::Yields
            }
        }
    })
}

fn joint(
    assembly: &Assembly,
    face: &Interface,
    rates: &[Rate],
    fastest: f64,
) -> Option<(JointMotion, Vector3<f64>)> {
    let rest = tolerance::MECHANISM_REST * fastest;
    // Per corner: does it keep contact (closed or sliding), and how fast does it slide?
    let corners: Vec<(Vector3<f64>, bool, f64, f64)> = face
        .points
        .iter()
        .map(|p| {
            let v = super::at(assembly, rates, face.b, p) - super::at(assembly, rates, face.a, p);
            let vn = face.frame.n.dot(&v);
            let vt = (v - face.frame.n * vn).norm();
            let lift = match face.law.friction {
                Friction::Coefficient(mu) => mu * vt,
                Friction::Infinite => 0.0,
            };
            (*p, vn - lift <= rest, vt, vn)
        })
        .collect();
    if corners.iter().all(|c| c.2 <= rest && c.3 <= rest) {
        return None;
    }
    let kept: Vec<_> = corners.iter().filter(|c| c.1).collect();
    let crushed: Vec<_> = corners.iter().filter(|c| c.3 < -rest).collect();
    let mean = |points: &mut dyn Iterator<Item = Vector3<f64>>, n: usize| {
        points.sum::<Vector3<f64>>() / n as f64
    };
    if crushes(face) && !crushed.is_empty() {
        // Where an edge of the contact neither opens nor closes: the axis passes there.
        let turns: Vec<Vector3<f64>> = corners
            .iter()
            .zip(corners.iter().cycle().skip(1))
            .filter(|(p, q)| p.3.min(q.3) < 0.0 && p.3.max(q.3) >= 0.0)
            .map(|(p, q)| p.0 + (q.0 - p.0) * (p.3 / (p.3 - q.3)))
            .collect();
        let at = match turns.len() {
            0 => mean(&mut crushed.iter().map(|c| c.0), crushed.len()),
            n => mean(&mut turns.into_iter(), n),
        };
        return Some((JointMotion::Crush, at));
    }
    if kept.is_empty() {
        return Some((JointMotion::Part, mean(&mut corners.iter().map(|c| c.0), corners.len())));
    }
    let slides = kept.iter().any(|c| c.2 > rest);
    let motion = match (kept.len() == corners.len(), slides) {
        (true, true) => JointMotion::Slide,
        (_, false) => JointMotion::Hinge,
        (false, true) => JointMotion::HingeAndSlide,
    };
    Some((motion, mean(&mut kept.iter().map(|c| c.0), kept.len())))
}
