//! The scene where it has come to, as the start of what follows.
//!
//! The corners of a linkage are carried from where they touched at the start. Joints that have slid
//! touch elsewhere. Where they stick, the scene at that pose is a start like any other: its contacts
//! are carried from there on, and what follows is told in the poses and joints of the first start.
//!
//! *From sliding to turning.* A joint that slides may come to where it would rather turn: a block
//! that is pushed over the edge of a table. Held at the joints that slide, the scene has a mechanism
//! at every pose; before that place its forces lie outside the friction cones, beyond it they do
//! not. The place is where their room goes through zero.

use super::{
    branch::{BranchPoint, Follow, ROOM, WIDTH},
    point::{End, Event, Path, Point},
    program::{self, Hold},
    rested::Rested,
    root::narrow,
    tracker::Tracker,
};
use check::path::{Carried, Displaced, Drive};
use model::{assembly::Pose, interface::Model};
use nalgebra::Vector3;
use scene::Friction;

/// A pose as a start.
pub(super) struct Anchor<'a> {
    /// The joints of the first start.
    first: &'a Carried<'a>,
    /// The parameter there.
    value: f64,
    poses: Vec<Pose>,
    /// The scene there.
    pub here: Displaced,
}

/// Where joints that slide begin to stick while others turn.
#[derive(Clone)]
struct Turn {
    /// The parameter there.
    value: f64,
    poses: Vec<Pose>,
    /// The corners that stay closed, by the contacts there.
    closed: Vec<Vec<usize>>,
}

/// Where two mechanisms all but begin together the program may give a mixture of them, which slides;
/// so much farther, over what a step was short of, it does not. Fewer: a place is missed, in a scene
/// or in its mirror image.
const NUDGES: [f64; 6] = [0.0, 1e-3, 2e-3, 3e-3, 5e-3, 1e-2];

/// Ends of the search for that place, over what a step was short of.
const BEYOND: [f64; 7] = [1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0];

impl<'a> Anchor<'a> {
    pub fn new(first: &'a Carried<'a>, value: f64, poses: Vec<Pose>) -> Self {
        let here = first.displaced(&poses);
        Self { first, value, poses, here }
    }

    /// Poses since the first start of what has these since this one.
    fn poses(&self, since: &[Pose]) -> Vec<Pose> {
        let both =
            |(a, b): (&Pose, &Pose)| Pose { shift: a.shift + b.shift, turn: b.turn * a.turn };
        self.poses.iter().zip(since).map(both).collect()
    }

    /// What drives it from here on, its parameter counted from here.
    fn drive(&self, drive: &Drive) -> Drive {
        match *drive {
            // In proportion to the parameter, about an axis that stays.
            Drive::Settle(ref moves) => Drive::Settle(moves.clone()),
            Drive::Push { block, point, toward } => {
                let center = self.first.start.assembly.blocks[block].centroid;
                Drive::Push { block, point: self.poses[block].apply(&center, &point), toward }
            }
        }
    }

    /// Every corner of every contact.
    fn all(&self) -> Vec<Vec<usize>> {
        self.here.model.interfaces.list.iter().map(|f| (0..f.points.len()).collect()).collect()
    }

    /// Follows from here on; `begin` takes the first leg from a state in which all that touches is
    /// closed, and `whole` says what of the path there is with what follows.
    pub fn follow(
        &self,
        from: &Tracker,
        how: &Follow,
        (whole, begin): (
            &dyn Fn(Path) -> Path,
            impl FnOnce(&Tracker, &Follow, BranchPoint, &mut Path) -> Result<BranchPoint, End>,
        ),
    ) -> Path {
        let carried = Carried::new(&self.here.model);
        let drive = self.drive(from.drive);
        let later = |v: &f64| (*v > self.value).then_some(v - self.value);
        let own = Follow {
            drive: drive.clone(),
            until: how.until - self.value,
            at: how.at.iter().filter_map(later).collect(),
            from: None,
            ..how.clone()
        };
        // What has slid may touch what it did not touch at the start.
        let meets = |poses: &[Pose], _: bool| (from.meets)(&self.poses(poses), true);
        let hears: &dyn Fn(&dyn Fn() -> Path) = &|path: &dyn Fn() -> Path| {
            (from.hears)(&|| whole(self.told(&carried, path(), how)));
        };
        let tracker = Tracker { carried: &carried, drive: &drive, meets: &meets, hears, ..*from };
        let state = BranchPoint {
            value: 0.0,
            poses: vec![Pose::start(); self.poses.len()],
            closed: self.all(),
            holds: vec![Hold::Idle; carried.start.interfaces.members.len()],
        };
        let mut path = Path::new();
        let next = begin(&tracker, &own, state, &mut path);
        path.end = tracker.goes_on(&own, next, &mut path);
        self.told(&carried, path, how)
    }

    /// A path from here as one from the first start.
    fn told(&self, carried: &Carried, own: Path, how: &Follow) -> Path {
        let joint = |k: usize| self.joint(carried, k);
        let value = |v: f64| {
            // To the last digit what was asked for.
            let v = self.value + v;
            let asked = how.at.iter().chain([&how.until]);
            asked.copied().find(|a| (a - v).abs() <= 4.0 * f64::EPSILON * v).unwrap_or(v)
        };
        let point = |p: Point| Point { value: value(p.value), ..self.point(carried, p) };
        let event = |e: Event| Event { value: value(e.value), beyond: value(e.beyond) };
        Path {
            points: own.points.into_iter().map(point).collect(),
            events: own.events.into_iter().map(event).collect(),
            end: match own.end {
                End::Falls(ends) => End::Falls(Box::new(ends.map(point))),
                End::Slides(k) => End::Slides(joint(k)),
                end => end,
            },
            first: None,
            between: own.between,
        }
    }

    /// The joint of the first start that a joint from here on is of.
    fn joint(&self, carried: &Carried, k: usize) -> usize {
        if let Some(&from) = self.here.from.get(k) {
            return from;
        }
        let own = &carried.joints[k];
        let is_of = |f: &model::interface::Interface| (f.a, f.b) == (own.a, own.b);
        self.first.joints.iter().position(is_of).unwrap_or_default()
    }

    fn point(&self, carried: &Carried, own: Point) -> Point {
        let touch: Vec<(usize, Vec<Vector3<f64>>)> = own.touch.unwrap_or_else(|| {
            let now = carried.touching(&own.poses, &own.closed);
            let places = now.model.interfaces.list.into_iter().map(|f| f.points);
            now.from.into_iter().zip(places).collect()
        });
        Point {
            poses: self.poses(&own.poses),
            closed: vec![Vec::new(); self.first.start.interfaces.list.len()],
            touch: Some(touch.into_iter().map(|(k, at)| (self.joint(carried, k), at)).collect()),
            ..own
        }
    }
}

impl Tracker<'_> {
    /// Goes on from a pose that slides to where it turns instead, between there and a little beyond
    /// the value where no sliding motion was found; nothing where there is no such place.
    pub(super) fn turns_on(
        &self,
        how: &Follow,
        here: &Rested,
        beyond: f64,
        path: &mut Path,
    ) -> Option<End> {
        let short = beyond - here.value;
        let held = |v: f64| NUDGES.into_iter().find_map(|by| self.held_on(here, v + by * short));
        let (room, low) = held(here.value)?;
        let turn = if room >= ROOM {
            // A step went over that place.
            low
        } else {
            let ends = BEYOND.into_iter().map(|by| here.value + by * short);
            let (high, over, turn) = ends.into_iter().find_map(|v| {
                let (over, turn) = held(v)?;
                (over > 0.0).then_some((v, over, turn))
            })?;
            let [_, (_, _, turn)] =
                narrow((here.value, -room, low), (high, -over, turn), WIDTH * high, |v, _| {
                    held(v).map(|(room, turn)| (-room, turn))
                })?;
            turn
        };
        let value = turn.value;
        let anchor = Anchor::new(self.carried, value, turn.poses);
        path.events.push(Event { value, beyond: value });
        let begin = |tracker: &Tracker, how: &Follow, state: BranchPoint, path: &mut Path| {
            tracker.run(how, BranchPoint { closed: turn.closed, ..state }, path)
        };
        let before = path.clone();
        let whole = |own: Path| before.clone().and(own);
        let own = anchor.follow(self, how, (&whole, begin));
        *path = before.and(own);
        Some(path.end.clone())
    }

    /// Follows from poses where joints have slid: as a linkage where these stick, else as what slides.
    pub(super) fn follow_slid(&self, how: &Follow, value: f64, poses: Vec<Pose>) -> Path {
        let slid: Vec<bool> = (0..self.carried.joints.len())
            .map(|k| self.carried.slid(&poses, k).is_some())
            .collect();
        let held = self.held(value, poses.clone(), &|k| slid[k]);
        let held = held.filter(|(room, _)| *room >= ROOM).map(|(_, turn)| turn.closed);
        let anchor = Anchor::new(self.carried, value, poses);
        let begin =
            |tracker: &Tracker, how: &Follow, state: BranchPoint, path: &mut Path| match held {
                Some(closed) => tracker.run(how, BranchPoint { closed, ..state }, path),
                None => tracker.leg(how, state, path, true),
            };
        anchor.follow(self, how, (&|path| path, begin))
    }

    /// The same straight on from a pose near by, with the joints held that slide there.
    fn held_on(&self, here: &Rested, value: f64) -> Option<(f64, Turn)> {
        let blocks = &self.start().blocks;
        let by = value - here.value;
        let poses: Vec<Pose> = (0..blocks.len())
            .map(|i| {
                if blocks[i].support {
                    return self.drive.pose(i, value);
                }
                let (pose, rate) = (&here.poses[i], &here.rates[i]);
                let turn = nalgebra::UnitQuaternion::from_scaled_axis(rate.spin * by) * pose.turn;
                Pose { shift: pose.shift + rate.velocity * by, turn }
            })
            .collect();
        self.held(value, poses, &|k| here.joints[k].1)
    }

    /// The room of the forces of the mechanism that there is at a pose with some joints held; nothing
    /// where it has none that only turns.
    fn held(
        &self,
        value: f64,
        poses: Vec<Pose>,
        holds: &dyn Fn(usize) -> bool,
    ) -> Option<(f64, Turn)> {
        let anchor = Anchor::new(self.carried, value, poses);
        let start = vec![Pose::start(); anchor.poses.len()];
        let mut sticky: Model = anchor.here.model.clone();
        for (c, face) in sticky.interfaces.list.iter_mut().enumerate() {
            if holds(anchor.here.from[c]) {
                face.law.friction = Friction::Infinite;
            }
        }
        let drive = anchor.drive(self.drive);
        let next = program::next(&Carried::new(&sticky), &start, &anchor.all(), &drive)?;
        let moves = !self.drive.is_push() || self.speed(&next.rates, &anchor.poses) > 0.0;
        if next.slides.is_some() || !moves {
            return None;
        }
        let carried = Carried::new(&anchor.here.model);
        let bare = carried.touching(&start, &next.closed).model;
        let room = program::margin(&bare, self.drive.is_push())?.room;
        Some((room, Turn { value, poses: anchor.poses, closed: next.closed }))
    }
}
