//! What links two successive poses of a path, and what happens between them.
//!
//! *Link.* Under Signorini's and Coulomb's laws a place that carries neither parts nor, inside its
//! friction cone, slides. So the points of two blocks that carry at the end of a step lay on each
//! other at its beginning as well, however long it is: hinges are fixed points, and no remainder of
//! second order is left. Where friction is used up they may have slid in the plane of the contact,
//! against what they carry. Poses that are no continuation of each other have no such points.

use super::{PathEvent, PathEventKind};
use crate::{
    path::Carried,
    verdict::{
        Forces, Rate,
        mechanism::{self, JointMotion, MemberMotion},
    },
};
use base::tolerance;
use model::{assembly::Pose, interface::Model};
use nalgebra::Vector3;
use std::collections::BTreeSet;

/// What the poses of a point and the forces there show.
pub(super) struct Seen {
    /// The parameter.
    pub value: f64,
    /// The pose of every block.
    pub poses: Vec<Pose>,
    /// How each joint touches.
    touch: Vec<Touch>,
    /// Places that carry; none where nothing is proved.
    carries: Vec<Place>,
    /// Members that carry all that they can.
    full: BTreeSet<usize>,
    /// Where it falls: joints that part, and that slide; members that give way.
    falling: [Vec<usize>; 3],
}

/// How a joint touches.
#[derive(Clone, Debug, PartialEq)]
struct Touch {
    /// Corners that are where they were at the start; of a joint that has slid none.
    corners: Vec<usize>,
    /// Whether it touches nowhere, along an edge or all over.
    level: Level,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Level {
    Open,
    Edge,
    Face,
}

/// A place that carries.
struct Place {
    joint: usize,
    /// Where the points of the two blocks were at the start, m.
    before: [Vector3<f64>; 2],
    /// From the first block into the second.
    normal: Vector3<f64>,
    /// Where friction is used up: its direction on the second block, zero where there is none.
    limit: Option<Vector3<f64>>,
}

/// A step between two points.
pub(super) struct Step {
    /// By how much the two points of a place that carries were apart that had to be together, over
    /// the size of the smaller block.
    pub off: f64,
    /// The same beyond what a straight way is off by where blocks turn.
    beyond: f64,
    /// How far blocks sink into each other between the two poses, as a part of the smaller one.
    pub sinks: f64,
    /// The greatest turn of a block, rad.
    pub turn: f64,
    /// The longest way of the centre of a block, m.
    pub way: f64,
    /// The farthest that a block goes, way over its size and turn together.
    reach: f64,
    /// Joints that slid.
    slid: BTreeSet<usize>,
}

impl Seen {
    /// What is seen at poses whose `displaced` model these forces balance.
    pub(super) fn new(
        carried: &Carried,
        (value, poses): (f64, Vec<Pose>),
        (model, from): (&Model, &[usize]),
        forces: Option<&Forces>,
        falls: Option<&[Rate]>,
    ) -> Self {
        let touch = (0..carried.joints.len()).map(|k| Touch::of(carried, &poses, k)).collect();
        let places = forces.map_or_else(Vec::new, |f| places(carried, &poses, (model, from), f));
        let members = model.interfaces.members.iter().enumerate();
        let amount = |m: usize| forces.map(|f| f[model.interfaces.list.len() + m][0].force.x);
        let is_full = |bound: f64, a: f64| bound != 0.0 && a / bound >= AT_LIMIT;
        let full = members.filter(|(m, own)| {
            amount(*m).is_some_and(|a| is_full(own.greatest, a) || is_full(own.least, a))
        });
        let full = full.map(|(m, _)| m).collect();
        let mechanism = falls.map(|rates| mechanism::read(model, rates)).unwrap_or_default();
        let moving = |is: fn(JointMotion) -> bool| {
            let mut list: Vec<usize> = mechanism
                .joints
                .iter()
                .filter(|j| is(j.motion))
                .map(|j| from[j.interface])
                .collect();
            list.dedup();
            list
        };
        let falling = [
            moving(|m| !matches!(m, JointMotion::Slide)),
            moving(|m| matches!(m, JointMotion::Slide | JointMotion::HingeAndSlide)),
            mechanism
                .members
                .iter()
                .filter(|m| matches!(m.motion, MemberMotion::Yields | MemberMotion::Slackens))
                .map(|m| m.member)
                .collect(),
        ];
        Self { value, poses, touch, carries: places, full, falling }
    }

    /// The step to another point, by what carries there.
    pub(super) fn step(&self, carried: &Carried, to: &Self) -> Step {
        let sinks = sinks(carried, [&self.poses, &to.poses]);
        Step { sinks, ..self.held(carried, &to.poses, &to.carries, -1.0) }
    }

    /// The step to a point at which nothing balances, by what carries here.
    pub(super) fn step_on(&self, carried: &Carried, to: &Self) -> Step {
        self.held(carried, &to.poses, &self.carries, 1.0)
    }

    /// Whether these places held between these poses and others; `sign` > 0 where the others are
    /// later.
    fn held(&self, carried: &Carried, to: &[Pose], places: &[Place], sign: f64) -> Step {
        let blocks = &carried.start.assembly.blocks;
        // Where the places' own points are together, and where they are to have been.
        let there = if sign > 0.0 { to } else { &self.poses };
        let pairs = || self.poses.iter().zip(to);
        let way = pairs().map(|(a, b)| (b.shift - a.shift).norm()).fold(0.0, f64::max);
        let turn = pairs().map(|(a, b)| a.turn.angle_to(&b.turn)).fold(0.0, f64::max);
        let reach = |i: usize| {
            let (a, b) = (&self.poses[i], &to[i]);
            (b.shift - a.shift).norm() / blocks[i].size + a.turn.angle_to(&b.turn)
        };
        let farthest = (0..blocks.len()).map(reach).fold(0.0, f64::max);
        let mut step = Step {
            off: 0.0,
            beyond: 0.0,
            sinks: 0.0,
            turn,
            way,
            reach: farthest,
            slid: BTreeSet::new(),
        };
        for place in places {
            let face = &carried.joints[place.joint];
            let [a, b] = [(face.a, place.before[0]), (face.b, place.before[1])]
                .map(|(i, at)| there[i].apply(&blocks[i].centroid, &at));
            let size = carried.size(place.joint);
            let apart = (b - a) * sign;
            let mut off = apart.norm();
            if let Some(limit) = place.limit {
                let turned = |i: usize| {
                    let here = if sign > 0.0 { &self.poses[i] } else { &to[i] };
                    there[i].turn * (here.turn.inverse() * place.normal)
                };
                let part = |i: usize| turned(i).dot(&apart).abs();
                let slip = apart - place.normal * place.normal.dot(&apart);
                if limit == Vector3::zeros() || limit.dot(&slip) <= -AGAINST * slip.norm() {
                    off = part(face.a).min(part(face.b));
                    if slip.norm() > (SLIDES * way).max(tolerance::JOINT_CLOSED * size) {
                        step.slid.insert(place.joint);
                    }
                }
            }
            step.off = step.off.max(off / size);
            let curved = (reach(face.a) + reach(face.b)).powi(2);
            step.beyond = step.beyond.max(off / size - curved);
        }
        step
    }

    /// Whether a step to this point is a jump: it is no way that the parameter grows by.
    pub(super) fn jumps_to(&self, to: &Self, step: &Step, last: f64) -> bool {
        (to.value - self.value).abs() <= SAME_VALUE * last.abs()
            && step.off > tolerance::JOINT_CLOSED
    }
}

impl Step {
    /// Whether it is a continuous motion that the laws of contact allow.
    pub(super) fn links(&self) -> bool {
        self.off <= tolerance::JOINT_CLOSED
            && !self.closes()
            && self.turn <= tolerance::LONGEST_TURN
    }

    /// Whether blocks overlap between the two poses.
    pub(super) fn closes(&self) -> bool {
        self.sinks > tolerance::JOINT_CLOSED
    }

    /// The same of a short step that goes straight on.
    pub(super) fn links_straight(&self) -> bool {
        self.beyond <= tolerance::JOINT_CLOSED && self.reach <= STRAIGHT
    }
}

/// Members and joints carry all that they can from this × it on. Nearer to one: rounding of saved
/// forces is taken for room. Farther: what has room slides.
const AT_LIMIT: f64 = 0.999;
/// Slips go against what is carried where the cosine between them is at least this: a step goes round
/// bends. Larger: curved ways of sliding are refused. Smaller: friction drives.
const AGAINST: f64 = 0.5;
/// Slips below this × the way of the blocks in the step are none that is told of.
const SLIDES: f64 = 1e-4;
/// Places carry that bear this × the greatest force on the block that bears less. Larger: light
/// places among heavy ones are free to go. Smaller: noise of an engine holds what opens.
const CARRIES: f64 = 1e-3;
/// Steps that go straight on are no longer than this, beside the size of a block. Longer: another
/// motion. Shorter: the place where a motion that slides comes to fall is not reached.
const STRAIGHT: f64 = 1e-2;
/// Values of the parameter within this × the last one are one: an event has two ends.
const SAME_VALUE: f64 = 1e-9;

/// Part of the way between two points at which it is looked whether anything overlaps.
const BETWEEN: [f64; 3] = [0.25, 0.5, 0.75];

/// How far a joint closes on the way between two neighbouring points, as a part of the smaller block,
/// beyond what straight ways between their poses, which are curved ones in truth, may be off by: a
/// block's way × its turn, eight times what a turn about a fixed point is, for blocks do not turn in
/// proportion to each other.
fn sinks(carried: &Carried, [from, to]: [&[Pose]; 2]) -> f64 {
    let assembly = &carried.start.assembly;
    let off: Vec<f64> = from
        .iter()
        .zip(to)
        .zip(&assembly.blocks)
        .map(|((a, b), block)| {
            let turn = a.turn.angle_to(&b.turn);
            turn * ((b.shift - a.shift).norm() + turn * block.size)
        })
        .collect();
    let list = &carried.joints;
    let mut deepest = 0.0_f64;
    let by_faces: Vec<bool> = (0..list.len())
        .map(|k| [from, to].iter().any(|poses| carried.sinks_by_faces(poses, k)))
        .collect();
    for share in BETWEEN {
        let poses: Vec<Pose> = from
            .iter()
            .zip(to)
            .map(|(a, b)| Pose {
                shift: a.shift.lerp(&b.shift, share),
                turn: a.turn.slerp(&b.turn, share),
            })
            .collect();
        for (k, face) in list.iter().enumerate() {
            let Some(gap) = carried.depth(&poses, k, by_faces[k]) else { continue };
            let allowed = (off[face.a] + off[face.b]) / carried.size(k);
            deepest = deepest.max(-gap - allowed);
        }
    }
    deepest
}

impl Touch {
    fn of(carried: &Carried, poses: &[Pose], k: usize) -> Self {
        let level = |closed: usize, all: usize| match closed {
            0 => Level::Open,
            n if n == all => Level::Face,
            _ => Level::Edge,
        };
        if let Some(spots) = carried.slid(poses, k) {
            let small = tolerance::JOINT_CLOSED * carried.size(k);
            let closed = spots.iter().filter(|s| s.gap.abs() <= small).count();
            return Self { corners: Vec::new(), level: level(closed, spots.len()) };
        }
        let all = carried.joints[k].points.len();
        let is_closed = |p: &usize| carried.corner(poses, k, *p).apart <= tolerance::JOINT_CLOSED;
        let corners: Vec<usize> = (0..all).filter(is_closed).collect();
        Self { level: level(corners.len(), all), corners }
    }

    /// Whether it touches at less than before.
    fn opens_from(&self, before: &Self) -> bool {
        match self.corners.is_empty() || before.corners.is_empty() {
            true => self.level < before.level,
            false => before.corners.iter().any(|p| !self.corners.contains(p)),
        }
    }
}

/// The places that carry.
fn places(
    carried: &Carried,
    poses: &[Pose],
    (model, from): (&Model, &[usize]),
    forces: &Forces,
) -> Vec<Place> {
    let blocks = &carried.start.assembly.blocks;
    let contacts = || model.interfaces.list.iter().zip(forces);
    let mut most = vec![0.0_f64; blocks.len()];
    for (face, own) in contacts() {
        let here = own.iter().map(|w| w.force.norm()).fold(0.0, f64::max);
        for i in [face.a, face.b] {
            most[i] = if blocks[i].support { f64::INFINITY } else { most[i].max(here) };
        }
    }
    let mut list = Vec::new();
    for (c, (face, own)) in contacts().enumerate() {
        let least = CARRIES * most[face.a].min(most[face.b]);
        for (at, w) in face.points.iter().zip(own).filter(|(_, w)| w.force.norm() > least) {
            let normal = face.frame.n;
            let pressed = normal.dot(&w.force);
            let along = w.force - normal * pressed;
            let used_up = along.norm() >= AT_LIMIT * face.law.friction.mu() * pressed;
            list.push(Place {
                joint: from[c],
                before: [face.a, face.b].map(|i| carried.before(poses, i, at)),
                normal,
                limit: used_up.then(|| along.try_normalize(0.0).unwrap_or_default()),
            });
        }
    }
    list
}

/// What happens on the way, from what is seen at its points, from the steps between them and from the
/// two poses between which it falls.
pub(super) fn events(
    carried: &Carried,
    points: &[Seen],
    steps: &[Step],
    ends: &[Seen],
) -> Vec<PathEvent> {
    let names = |joints: Vec<usize>| -> Vec<[String; 2]> {
        let pair = |k: usize| super::between(carried, k);
        joints.into_iter().map(pair).collect()
    };
    let members = |list: Vec<usize>| -> Vec<String> {
        list.into_iter().map(|m| carried.start.interfaces.members[m].id.clone()).collect()
    };
    let event = |value, kind| PathEvent {
        value,
        kind,
        opens: Vec::new(),
        closes: Vec::new(),
        yields: Vec::new(),
        slides: Vec::new(),
        jump: None,
    };
    let which = |a: &Seen, b: &Seen| -> Vec<usize> {
        (0..a.touch.len()).filter(|&k| b.touch[k].opens_from(&a.touch[k])).collect()
    };
    let last = points.last().map_or(0.0, |p| p.value);
    let mut list = Vec::new();
    let mut sliding: Option<BTreeSet<usize>> = None;
    for (k, (pair, step)) in points.windows(2).zip(steps).enumerate() {
        let [a, b] = pair else { continue };
        let (opens, closes) = (which(a, b), which(b, a));
        if a.jumps_to(b, step, last) {
            let own = event(a.value, PathEventKind::Jumps);
            list.push(PathEvent {
                opens: names(opens),
                closes: names(closes),
                jump: Some(step.way),
                ..own
            });
            continue;
        }
        // What opens first of all is the mechanism that begins.
        if k > 0 && !opens.is_empty() {
            list.push(PathEvent { opens: names(opens), ..event(a.value, PathEventKind::Opens) });
        }
        if step.way > 0.0 || step.turn > 0.0 {
            let before = sliding.replace(step.slid.clone()).unwrap_or_default();
            let new =
                |a: &BTreeSet<usize>, b: &BTreeSet<usize>| names((b - a).into_iter().collect());
            let (slides, sticks) = (new(&before, &step.slid), new(&step.slid, &before));
            for (slides, kind) in [(slides, PathEventKind::Slides), (sticks, PathEventKind::Sticks)]
            {
                if !slides.is_empty() {
                    list.push(PathEvent { slides, ..event(a.value, kind) });
                }
            }
        }
        if !closes.is_empty() {
            list.push(PathEvent { closes: names(closes), ..event(b.value, PathEventKind::Closes) });
        }
        let full: Vec<usize> = b.full.difference(&a.full).copied().collect();
        if !full.is_empty() {
            list.push(PathEvent { yields: members(full), ..event(b.value, PathEventKind::Yields) });
        }
    }
    if let [stands, falls] = ends {
        let [parts, slides, yields] = &falls.falling;
        let opens = parts.iter().copied().filter(|&k| stands.touch[k].level == Level::Face);
        list.push(PathEvent {
            opens: names(opens.collect()),
            slides: names(slides.clone()),
            yields: members(yields.clone()),
            ..event(stands.value, PathEventKind::Falls)
        });
    }
    list
}
