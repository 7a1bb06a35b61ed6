//! One linkage after the other, from event to event.

use super::{
    drop::{self, Landing},
    linkage::Linkage,
    passed::{Passed, turned_far},
    point::{End, Event, Path, Point},
    program::{self, Hold, Margin},
    root::narrow,
    tracker::{At, Tracker, size},
};
use crate::{Control, assess};
use base::tolerance;
use check::{
    path::{Carried, Demand, Drive},
    terms::Law,
    verdict::{Rate, Verdict, claim::natural_factor},
};
use model::{
    assembly::Pose,
    interface::{Interface, Model},
};
use nalgebra::Vector3;
use solve::deadline::Deadline;

/// How a path is followed.
#[derive(Clone, Debug)]
pub struct Follow {
    /// What moves it.
    pub drive: Drive,
    /// The parameter at which it ends at the latest.
    pub until: f64,
    /// Values that become points of the curve, in order.
    pub at: Vec<f64>,
    /// The longest step.
    pub step: f64,
    /// The parameter and the poses to begin at, where that is not the start.
    pub from: Option<(f64, Vec<Pose>)>,
    /// What a live load pushes is followed where it slides, under dry friction.
    pub dry: bool,
}

impl Follow {
    /// All of the way was followed.
    pub(super) fn ends(&self) -> End {
        match self.drive.is_push() {
            false => End::Reached,
            true => End::Stuck(
                "it still resists after the control point has moved by twice the size of the moving part"
                    .into(),
            ),
        }
    }
}

/// Gaps below this × the size of the smaller block overlap. Nearer to zero: rounding of the poses is
/// taken for a joint that closes. Farther: joints sink in before they are seen to close, up to
/// [`tolerance::JOINT_CLOSED`](base::tolerance::JOINT_CLOSED), where they are no pose any more.
const OVERLAP: f64 = -1e-10;
/// Values of the parameter are known to this × what they are. Larger: the two sides of a fall are far
/// apart. Smaller: the last digits of a double.
pub(super) const WIDTH: f64 = 1e-13;
/// Rooms above this, in mean loads of a contact point, are none that is missing. Nearer to zero: the
/// noise of the engine ends a leg. Farther: forces that pull are taken for none.
pub(super) const ROOM: f64 = -1e-9;

/// The last value at which it stands and the first at which it falls are this near to each other,
/// where verdicts can tell them so near. Smaller: scenes asked for digits that nobody needs.
pub(super) const NARROW: f64 = 1e-8;
/// What falls is told so many times as far from the last pose that stands as a verdict needs. Nearer:
/// the poses as they are written prove nothing. Farther: digits.
pub(super) const CLEAR: f64 = 1.5;

/// What says which blocks touch at some poses and did not at the start.
type Meets<'a> = &'a dyn Fn(&[Pose], bool) -> Option<String>;
/// What hears of a path that may be taken up again.
type Hears<'a> = &'a dyn Fn(&dyn Fn() -> Path);

/// Follows the motion of a scene from where it is.
///
/// `meets` says which blocks touch at some poses and did not at the start; with `true` but for those
/// whose faces are known to be near ([`Carried::joints`]). `hears` is called where a path may be
/// taken up again: its last point lies within a leg.
pub(super) fn follow(
    start: &Model,
    how: &Follow,
    deadline: Deadline,
    (meets, hears): (Meets<'_>, Hears<'_>),
) -> Path {
    let carried = Carried::new(start);
    let blocks = &start.assembly.blocks;
    let tracker =
        Tracker { carried: &carried, drive: &how.drive, size: size(start), deadline, meets, hears };
    let all = || start.interfaces.list.iter().map(|f| (0..f.points.len()).collect()).collect();
    let (value, poses, closed): (f64, Vec<Pose>, Vec<Vec<usize>>) = match &how.from {
        None => (0.0, vec![Pose::start(); blocks.len()], all()),
        Some((value, poses)) => (*value, poses.clone(), carried.closed(poses)),
    };
    if (0..carried.joints.len()).any(|k| carried.slid(&poses, k).is_some()) {
        return tracker.follow_slid(how, value, poses);
    }
    let mut path = Path::new();
    // The first mechanism says what members do.
    let holds = vec![Hold::Idle; start.interfaces.members.len()];
    let first = tracker.leg(how, BranchPoint { value, poses, closed, holds }, &mut path, true);
    path.end = tracker.goes_on(how, first, &mut path);
    path
}

/// So many mechanisms at most: more is no path but a fall.
const LEGS: usize = 200;

/// A pose at which a mechanism is to be found.
pub(super) struct BranchPoint {
    pub value: f64,
    pub poses: Vec<Pose>,
    pub closed: Vec<Vec<usize>>,
    pub holds: Vec<Hold>,
}

#[derive(Clone)]
pub(super) struct Trial {
    pub at: At,
    pub margin: Option<Margin>,
}

impl Tracker<'_> {
    /// From the end of one leg to the end of the path.
    pub(super) fn goes_on(
        &self,
        how: &Follow,
        first: Result<BranchPoint, End>,
        path: &mut Path,
    ) -> End {
        let mut next = first;
        for _ in 0..LEGS {
            match next {
                Ok(state) => next = self.leg(how, state, path, false),
                Err(end) => return end,
            }
        }
        End::Stuck("the mechanism changes too often".into())
    }

    /// From one change of the mechanism to the next.
    pub(super) fn leg(
        &self,
        how: &Follow,
        state: BranchPoint,
        path: &mut Path,
        first: bool,
    ) -> Result<BranchPoint, End> {
        let stuck = |text: &str| End::Stuck(text.to_string());
        let next = program::next(self.carried, &state.poses, &state.closed, self.drive)
            .ok_or_else(|| {
                if self.falls_there(&state.poses, &state.closed) {
                    stuck("the scene does not stand at this point, before anything moves")
                } else {
                    stuck("no mechanism was found: the blocks may be wedged")
                }
            })?;
        let rates = next.rates.clone();
        let wrong = self.drive.is_push() && !self.advances(&next.rates, &state.poses);
        if first {
            path.first = Some((next.forces, next.rates));
        }
        if wrong {
            return Err(stuck(
                "in the mechanism the control point does not move in the given direction",
            ));
        }
        if let Some(k) = next.slides {
            if first {
                // What is known of the start, although nothing can be followed from there.
                path.points.extend(path.first.iter().map(|(forces, _)| Point {
                    value: state.value,
                    poses: state.poses.clone(),
                    closed: state.closed.clone(),
                    load_factor: 0.0,
                    forces: forces.clone(),
                    proving: None,
                    room: 0.0,
                    rates: Vec::new(),
                    touch: None,
                }));
            }
            return Err(match self.slide(how, state.value, &state.poses, &rates, path) {
                Ok(end) => end,
                Err(_) => End::Slides(k),
            });
        }
        self.run(how, BranchPoint { closed: next.closed, holds: next.holds, ..state }, path)
    }

    /// Whether the control point moves where it is to go.
    fn advances(&self, rates: &[Rate], poses: &[Pose]) -> bool {
        let Some(Demand { block, point, toward, .. }) = self.drive.demand(0.0) else { return true };
        let blocks = &self.start().blocks;
        let arm = poses[block].turn * (point - blocks[block].centroid);
        let speed = (rates[block].velocity + rates[block].spin.cross(&arm)).dot(&toward);
        let fastest =
            rates.iter().zip(blocks).map(|(r, b)| r.velocity.norm() + b.size * r.spin.norm());
        speed > 1e-6 * fastest.fold(0.0, f64::max)
    }

    /// Follows one linkage until it no longer holds.
    pub(super) fn run(
        &self,
        how: &Follow,
        state: BranchPoint,
        path: &mut Path,
    ) -> Result<BranchPoint, End> {
        let stuck = |text: &str| End::Stuck(text.to_string());
        let BranchPoint { value, poses, closed, holds } = state;
        let linkage = self.linkage(&closed, &holds);
        let place = linkage.place(&poses);
        let at =
            self.at(&linkage, &place, value).ok_or_else(|| stuck("the linkage does not close"))?;
        // Of several motions that begin at once the one in equilibrium may lie far from here.
        if self.deepest(&at.place.poses, &closed).is_some_and(|c| c.gap < -tolerance::JOINT_CLOSED)
        {
            return Err(stuck(
                "in the next pose in equilibrium blocks overlap: several motions may begin there at once",
            ));
        }
        let margin = self
            .margin(&at.place.poses, &closed, &linkage.holds)
            .ok_or_else(|| stuck("no balanced forces were found"))?;
        if path.points.is_empty()
            || path.points.last().is_some_and(|p| p.value < value || p.closed != closed)
        {
            path.points.push(self.point(value, (&linkage, &at), &closed, &margin));
        }
        if how.drive.is_push() && at.load_factor <= 0.0 {
            let natural = natural_factor(self.start());
            return Err(match at.load_factor.abs() <= tolerance::VANISHES * natural {
                true => End::Vanishes,
                false => End::Stuck(format!(
                    "where contacts open or close the load factor drops suddenly to {:.3}",
                    at.load_factor
                )),
            });
        }
        let mut here = (value, Trial { at, margin: Some(margin) });
        let next = self.along(how, &linkage, &mut here, &closed, path);
        // Where it is not followed any further the last pose is a point, wanted or not.
        if let (Err(End::Stuck(_)), Some(m)) = (&next, &here.1.margin)
            && path.points.last().is_none_or(|p| p.value < here.0)
        {
            path.points.push(self.point(here.0, (&linkage, &here.1.at), &closed, m));
            path.between = path.between.saturating_sub(1);
        }
        next
    }

    /// The same from `here`, which is left at the last pose at which nothing had happened.
    fn along(
        &self,
        how: &Follow,
        linkage: &Linkage,
        here: &mut (f64, Trial),
        closed: &[Vec<usize>],
        path: &mut Path,
    ) -> Result<BranchPoint, End> {
        let stuck = |text: &str| End::Stuck(text.to_string());
        let holds = &linkage.holds;
        let mut step = how.step;
        let mut passed = Passed::new(here.0, here.1.at.load_factor);
        loop {
            if here.0 >= how.until {
                return Err(how.ends());
            }
            if self.deadline.is_over() {
                return Err(stuck("time limit reached"));
            }
            let stop = how.at.iter().copied().filter(|&v| v > here.0).fold(how.until, f64::min);
            // The next multiple of the step; what rounding left short of one is on it.
            let grid = ((here.0 / how.step + 1e-9).floor() + 1.0) * how.step;
            // A step that all but reaches its aim reaches it.
            let aim = stop.min(grid);
            let value = if here.0 + 1.000_001 * step >= aim { aim } else { here.0 + step };
            let Some(at) = self.at(linkage, &here.1.at.place, value) else {
                step *= 0.25;
                if step < 1e-9 * how.step {
                    return Err(stuck("the linkage cannot move any further"));
                }
                continue;
            };
            let margin = self.margin_near(&at, closed, holds, here.1.margin.as_ref());
            let trial = Trial { margin, at };
            let overlaps = self.deepest(&trial.at.place.poses, closed).filter(|c| c.gap < OVERLAP);
            if let Some(text) = self.turns(holds, &here.1.at.place.poses, &trial.at.place.poses) {
                return Err(End::Stuck(text));
            }
            let room = trial.margin.as_ref().map(|m| m.room);
            let lacks = room.is_some_and(|r| r < ROOM);
            if (room.is_none() || lacks)
                && overlaps.is_none()
                && let Some(excess) = self.excess(linkage, &trial.at.place.poses, closed)
                && excess.by > 0.0
            {
                let there = (value, trial, excess);
                return self.yields(how, linkage, here.clone(), there, closed, path);
            }
            if room.is_none() {
                step *= 0.25;
                if step < 1e-6 * how.step {
                    return Err(stuck("no balanced forces were found"));
                }
                continue;
            }
            if overlaps.is_some() || lacks {
                return self.event(how, linkage, here.clone(), (value, trial), closed, path);
            }
            if how.drive.is_push() && trial.at.load_factor <= 0.0 {
                return Err(self.vanishes(linkage, here.clone(), (value, trial), closed, path));
            }
            if let Some(text) = (self.meets)(&trial.at.place.poses, false) {
                return Err(End::Stuck(text));
            }
            let point = |at: &(f64, Trial)| {
                let margin = at.1.margin.as_ref()?;
                Some(self.point(at.0, (linkage, &at.1.at), closed, margin))
            };
            let there = (value, trial);
            let load_factor = there.1.at.load_factor;
            let wanted = how.at.contains(&value) || value == how.until;
            if how.drive.is_push() && how.at.is_empty() && passed.go(value, load_factor) {
                path.points.extend(point(here));
                path.between -= 1;
                (self.hears)(&|| path.clone());
            }
            let wanted = wanted || turned_far(path, &there.1.at.place.poses);
            if wanted || (!how.drive.is_push() && value == aim) {
                path.points.extend(point(&there));
                passed = Passed::new(value, load_factor);
                (self.hears)(&|| path.clone());
            } else {
                path.between += 1;
            }
            *here = there;
            step = how.step;
        }
    }

    fn vanishes(
        &self,
        linkage: &Linkage,
        here: (f64, Trial),
        there: (f64, Trial),
        closed: &[Vec<usize>],
        path: &mut Path,
    ) -> End {
        let ends = narrow(
            (here.0, here.1.at.load_factor, here.1.at),
            (there.0, there.1.at.load_factor, there.1.at),
            WIDTH * there.0,
            |v, near| self.at(linkage, &near.place, v).map(|at| (at.load_factor, at)),
        );
        if let Some([low, _]) = &ends
            && let Some(margin) = self.margin(&low.2.place.poses, closed, &linkage.holds)
        {
            path.points.push(self.point(low.0, (linkage, &low.2), closed, &margin));
            return End::Vanishes;
        }
        End::Stuck("the point where the load factor vanishes was not found".into())
    }

    /// The first event between two values, and what comes after it.
    fn event(
        &self,
        how: &Follow,
        linkage: &Linkage,
        here: (f64, Trial),
        there: (f64, Trial),
        closed: &[Vec<usize>],
        path: &mut Path,
    ) -> Result<BranchPoint, End> {
        let stuck = |text: &str| End::Stuck(text.to_string());
        let width = WIDTH * there.0;
        let gap = |at: &At| self.deepest(&at.place.poses, closed).map_or(1.0, |c| c.gap - OVERLAP);
        let mut high = there;
        // The joint that closes first.
        let mut closing = None;
        if gap(&high.1.at) < 0.0 {
            let [low, beyond] = narrow(
                (here.0, gap(&here.1.at).max(0.0), here.1.at.clone()),
                (high.0, gap(&high.1.at), high.1.at.clone()),
                width,
                |v, near| self.at(linkage, &near.place, v).map(|at| (gap(&at), at)),
            )
            .ok_or_else(|| stuck("the point where a joint closes was not found"))?;
            let margin = self.margin(&low.2.place.poses, closed, &linkage.holds);
            high = (low.0, Trial { at: low.2.clone(), margin });
            closing = Some((low, beyond));
        }
        let room = |m: &Option<Margin>| m.as_ref().map_or(-1.0, |m| m.room);
        if room(&high.1.margin) < ROOM {
            let [low, beyond] = narrow(
                (here.0, room(&here.1.margin).max(0.0), here.1.clone()),
                (high.0, room(&high.1.margin), high.1.clone()),
                width,
                |v, near| {
                    let at = self.at(linkage, &near.at.place, v)?;
                    let margin = Some(self.margin(&at.place.poses, closed, &linkage.holds)?);
                    Some((room(&margin), Trial { at, margin }))
                },
            )
            .ok_or_else(|| stuck("the point where balanced forces cease to exist was not found"))?;
            return self.changes(how, linkage, (low.0, low.2), (beyond.0, beyond.2), closed, path);
        }
        let Some((low, beyond)) = closing else {
            return Err(stuck("an event could not be located"));
        };
        let now = self.with_closed(&low.2.place.poses, closed)?;
        path.events.push(Event { value: low.0, beyond: beyond.0 });
        if let Some(m) = self.margin(&low.2.place.poses, closed, &linkage.holds) {
            path.points.push(self.point(low.0, (linkage, &low.2), closed, &m));
        }
        let holds = linkage.holds.clone();
        Ok(BranchPoint { value: low.0, poses: low.2.place.poses, closed: now, holds })
    }

    /// Forces cease: another joint opens, steadily or by a jump, or it falls.
    fn changes(
        &self,
        how: &Follow,
        old: &Linkage,
        low: (f64, Trial),
        beyond: (f64, Trial),
        closed: &[Vec<usize>],
        path: &mut Path,
    ) -> Result<BranchPoint, End> {
        let stuck = |text: &str| End::Stuck(text.to_string());
        if let Some(m) = &low.1.margin {
            path.points.push(self.point(low.0, (old, &low.1.at), closed, m));
        }
        let poses = &beyond.1.at.place.poses;
        let lost = beyond.1.margin.as_ref().map_or_else(Vec::new, |m| self.lost(poses, closed, m));
        if lost.is_empty() {
            // Nothing is about to open: the edge that was reached is that of friction.
            let rates = self.heading(old, &low);
            return Err(match self.slide(how, low.0, &low.1.at.place.poses, &rates, path) {
                Ok(end) => end,
                Err(_) => self.slips_away(how, old, low, beyond, closed, path),
            });
        }
        let mut now = closed.to_vec();
        for &(k, p) in &lost {
            now[k].retain(|&q| q != p);
        }
        path.events.push(Event { value: low.0, beyond: beyond.0 });
        let holds = old.holds.clone();
        match drop::drop(self, &now, &holds, &lost, &beyond.1.at.place, beyond.0) {
            Landing::Steady(closed) => {
                // Straight on: a program at this very pose would not tell this branch from others.
                let state =
                    BranchPoint { value: beyond.0, poses: beyond.1.at.place.poses, closed, holds };
                self.run(how, state, path)
            }
            Landing::Elsewhere { poses, closed } => {
                Ok(BranchPoint { value: beyond.0, poses, closed, holds })
            }
            Landing::Nowhere => {
                let end = self.falls(old, &low, closed);
                Err(end.unwrap_or_else(|| stuck("it falls, but no proof of it was found")))
            }
            Landing::Lost(text) => {
                let fallen = if how.drive.is_push() { None } else { self.falls(old, &low, closed) };
                Err(fallen.unwrap_or_else(|| stuck(&text)))
            }
        }
    }

    /// A joint slides, and there is no motion under dry friction that leads on: it falls, or is not
    /// followed.
    fn slips_away(
        &self,
        how: &Follow,
        old: &Linkage,
        low: (f64, Trial),
        beyond: (f64, Trial),
        closed: &[Vec<usize>],
        path: &mut Path,
    ) -> End {
        let end = self.slides(&beyond.1, closed);
        if !matches!(end, End::Slides(_)) {
            return end;
        }
        let fallen = if how.drive.is_push() { None } else { self.falls(old, &low, closed) };
        let Some(falls) = fallen else { return end };
        path.events.push(Event { value: low.0, beyond: beyond.0 });
        falls
    }

    fn slides(&self, trial: &Trial, closed: &[Vec<usize>]) -> End {
        let displaced = self.carried.touching(&trial.at.place.poses, closed);
        let list = displaced.model.interfaces.list.iter();
        let used = |(c, face): (usize, &Interface)| {
            let sum: Vector3<f64> = trial.margin.as_ref()?.bare[c].iter().map(|w| w.force).sum();
            let n = face.frame.n.dot(&sum);
            Some((
                (sum - face.frame.n * n).norm() / (n * face.law.friction.mu()),
                displaced.from[c],
            ))
        };
        let most = list.enumerate().filter_map(used).max_by(|a, b| a.0.total_cmp(&b.0));
        most.map_or_else(
            || End::Stuck("balanced forces cease to exist".into()),
            |m| End::Slides(m.1),
        )
    }

    /// Proof that it stands just before and falls just after.
    pub(super) fn falls(
        &self,
        linkage: &Linkage,
        low: &(f64, Trial),
        closed: &[Vec<usize>],
    ) -> Option<End> {
        let control = Control { law: Law::Associative, ..Control::default() };
        let at = |value: f64| {
            let at = self.at(linkage, &low.1.at.place, value)?;
            let displaced = self.carried.touching(&at.place.poses, closed);
            let verdict = assess(&displaced.model, &control);
            let point = Point {
                value,
                poses: at.place.poses,
                closed: closed.to_vec(),
                load_factor: 0.0,
                forces: verdict.forces.clone(),
                proving: None,
                room: 0.0,
                rates: verdict.rates.clone(),
                touch: None,
            };
            Some((verdict.verdict, point))
        };
        let side = |sign: f64, wanted: Verdict| {
            // Away from the limit until a proof is found.
            (0..12).find_map(|k| {
                let (verdict, point) = at(low.0 * (1.0 + sign * 1e-10 * 4f64.powi(k)))?;
                (verdict == wanted).then_some(point)
            })
        };
        let mut stands = side(-1.0, Verdict::Stable)?;
        let mut falls = side(1.0, Verdict::Unstable)?;
        while falls.value - stands.value > NARROW * falls.value {
            match at(0.5 * (stands.value + falls.value)) {
                Some((Verdict::Stable, point)) => stands = point,
                Some((Verdict::Unstable, point)) => falls = point,
                _ => break,
            }
        }
        let clear = low.0 + CLEAR * (falls.value - low.0);
        if let Some((Verdict::Unstable, point)) = at(clear) {
            falls = point;
        }
        Some(End::Falls(Box::new([stands, falls])))
    }
}
