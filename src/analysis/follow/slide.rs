//! Motions that slide: from step to step under dry friction.

use super::{
    advance::live_power,
    branch::{CLEAR, Follow, NARROW, Trial, WIDTH},
    linkage::Linkage,
    passed::{Passed, turned_far},
    point::{End, Event, Path, Point},
    rested::{JointChange, Rested},
    root::narrow,
    tracker::Tracker,
};
use crate::{Control, assess};
use check::{
    terms::Law,
    verdict::{Rate, Verdict},
};
use model::assembly::Pose;
use nalgebra::UnitQuaternion;

/// Where a step does not come to rest, it is halved until it is shorter than this × the longest one:
/// that is where equilibrium ends. Longer: the two sides are far apart. Shorter: rounding of the
/// poses passes for a fall.
const SHORTEST: f64 = 1e-7;
/// Events are known to this × the longest step in scenes of no more than [`FEW`] blocks; in others
/// they lie between two points.
const EVENT: f64 = 1e-4;
const FEW: usize = 24;
/// Steps at most.
const STEPS: usize = 4000;
/// Steps in a row that do not come to rest: what comes is sudden. Fewer: where equilibrium ends is
/// known less well. More: time.
const FAILS: usize = 8;
/// The same of all steps.
const ALL_FAILS: usize = 16;

impl Tracker<'_> {
    /// Why a motion that slides cannot be followed, where it cannot: a joint of edges or corners,
    /// whose faces are not known, or members.
    fn bars_sliding(&self) -> Option<End> {
        let start = self.carried.start;
        if start.interfaces.members.iter().any(|m| !m.is_idle()) {
            let text = "a joint slides, which is not followed in scenes with members";
            return Some(End::Stuck(text.into()));
        }
        (0..start.interfaces.list.len()).find(|&k| !self.carried.may_slide(k)).map(End::Slides)
    }

    /// Follows under dry friction from a pose at which something begins to slide.
    ///
    /// # Errors
    /// No motion under dry friction leads on from there.
    pub(super) fn slide(
        &self,
        how: &Follow,
        value: f64,
        poses: &[Pose],
        rates: &[Rate],
        path: &mut Path,
    ) -> Result<End, End> {
        if how.drive.is_push() && !how.dry {
            return Err(End::Stuck("the pushed part slides".into()));
        }
        if let Some(end) = self.bars_sliding() {
            return Ok(end);
        }
        let start = self.carried.start;
        let blocks = start.assembly.blocks.len();
        let mut here = Rested {
            value,
            poses: poses.to_vec(),
            touch: Vec::new(),
            forces: Vec::new(),
            proving: None,
            joints: self.joints(poses, |_| false),
            rates: vec![Rate::zero(); blocks],
            load_factor: 0.0,
            power: 0.0,
        };
        if how.drive.is_push() {
            here = self.begins(&here, rates)?;
            // Where dry friction rules from here on, the bound of before is not the value.
            path.points.pop_if(|p| p.value >= value);
            path.points.push(self.slid_point(&here));
        }
        // The first step that there is tells that it slides and does not fall.
        let first = [1e-2, 1e-4, 1e-6].map(|by| by * how.step);
        let Some(next) = first.into_iter().find_map(|by| self.advance(&here, value + by)) else {
            return Err(End::Stuck("no motion under dry friction was found".into()));
        };
        path.events.push(Event { value: here.value, beyond: next.value });
        here = next;
        path.between += 1;
        let mut passed = Passed::new(here.value, here.load_factor);
        let mut before: Option<Rested> = None;
        let mut fails: Option<f64> = None;
        let mut step = how.step;
        let (mut in_a_row, mut all) = (0, 0);
        for _ in 0..STEPS {
            if here.value >= how.until {
                return Ok(how.ends());
            }
            if self.deadline.is_over() {
                return Ok(End::Stuck("time limit reached".into()));
            }
            let grid = ((here.value / how.step + 1e-9).floor() + 1.0) * how.step;
            let aim = how.until.min(grid);
            let mut value =
                if here.value + 1.000_001 * step >= aim { aim } else { here.value + step };
            if let Some(fails) = fails.filter(|f| *f <= value) {
                value = 0.5 * (here.value + fails);
            }
            let Some(next) = self.advance(&here, value) else {
                fails = Some(value);
                step = 0.5 * (value - here.value);
                in_a_row += 1;
                all += 1;
                if step <= SHORTEST * how.step || in_a_row >= FAILS || all >= ALL_FAILS {
                    if let Some(end) = self.turns_on(how, &here, value, path) {
                        return Ok(end);
                    }
                    return Ok(self.ceases(&here, before.as_ref(), value, path));
                }
                continue;
            };
            if how.drive.is_push() && next.load_factor <= 0.0 {
                return Ok(self.vanished(&here, next, path));
            }
            in_a_row = 0;
            let mut next = next;
            if value - here.value <= EVENT * how.step {
                // So near that slips are rounding.
                next.joints.clone_from(&here.joints);
            }
            let few = start.assembly.free().count() <= FEW;
            let next = if next.joints == here.joints || !few {
                next
            } else {
                self.locate(&here, next, how.step, path)
            };
            let changed = next.joints != here.joints;
            if changed {
                path.events.push(Event { value: here.value, beyond: next.value });
            }
            if let Some(text) = (self.meets)(&next.poses, true) {
                return Ok(End::Stuck(text));
            }
            let (is_push, points) = (how.drive.is_push(), path.points.len());
            // What was asked for lies beside the way, and changes none of its steps.
            for &asked in how.at.iter().filter(|v| here.value < **v && **v < next.value) {
                path.points.extend(self.advance(&here, asked).map(|at| self.slid_point(&at)));
            }
            // Poses far from each other are not seen to be linked where what slides has turned back.
            if is_push && passed.go(next.value, next.load_factor) {
                let last = path.points.last();
                if last.is_none_or(|p| p.value < here.value) {
                    path.points.push(self.slid_point(&here));
                    path.between -= 1;
                }
            }
            let asked = next.value == how.until || how.at.contains(&next.value);
            let wanted = changed || (!is_push && next.value == aim) || asked;
            if wanted || turned_far(path, &next.poses) {
                path.points.push(self.slid_point(&next));
                passed = Passed::new(next.value, next.load_factor);
            } else {
                path.between += 1;
            }
            if !changed && path.points.len() > points {
                (self.hears)(&|| path.clone());
            }
            if fails.is_none() {
                step = (2.0 * step).min(how.step);
            }
            fails = fails.filter(|f| *f > next.value);
            before = Some(std::mem::replace(&mut here, next));
        }
        Ok(End::Stuck("it needs too many steps".into()))
    }

    /// Between two poses whose joints differ, the first that differs; the last that does not becomes
    /// a point. Where another corner touches than before, at the next pose it lay apart by what it
    /// slid since, so that this place is known to the shortest step.
    fn locate(&self, low: &Rested, high: Rested, step: f64, path: &mut Path) -> Rested {
        let (mut low, mut high) = (low.clone(), high);
        let joints = low.joints.clone();
        let touch = |at: &Rested| -> Vec<JointChange> { at.joints.iter().map(|j| j.0).collect() };
        let before = touch(&low);
        loop {
            let width = high.value - low.value;
            let touches = touch(&high) != before;
            if width <= if touches { SHORTEST } else { EVENT } * step {
                break;
            }
            let Some(middle) = self.advance(&low, 0.5 * (low.value + high.value)) else { break };
            // Slips of steps as short as these are rounding.
            let same = match width <= EVENT * step {
                true => touch(&middle) == before,
                false => middle.joints == joints,
            };
            if same { low = middle } else { high = middle }
        }
        if path.points.last().is_none_or(|p| p.value < low.value) && !low.touch.is_empty() {
            path.points.push(self.slid_point(&low));
        }
        high
    }

    fn slid_point(&self, at: &Rested) -> Point {
        let list = &self.carried.start.interfaces.list;
        if self.drive.is_push() {
            // What a step leads to is known at its end; what moves there, of what touches there.
            let at = self.flow(at).unwrap_or_else(|| at.clone());
            return Point {
                value: at.value,
                poses: at.poses,
                closed: vec![Vec::new(); list.len()],
                load_factor: at.load_factor,
                forces: at.forces,
                proving: None,
                room: 0.0,
                rates: at.rates,
                touch: Some(at.touch),
            };
        }
        Point {
            value: at.value,
            poses: at.poses.clone(),
            closed: vec![Vec::new(); list.len()],
            load_factor: 0.0,
            forces: at.forces.clone(),
            proving: at.proving.clone(),
            room: 0.0,
            rates: Vec::new(),
            touch: Some(at.touch.clone()),
        }
    }

    /// How the blocks of a linkage move where it has come to, per unit of the way of the control
    /// point; none where supports move.
    pub(super) fn heading(&self, linkage: &Linkage, low: &(f64, Trial)) -> Vec<Rate> {
        let back = 1e-6 * self.size;
        let pushed = self.drive.is_push();
        let before = pushed.then(|| self.at(linkage, &low.1.at.place, low.0 - back)).flatten();
        let poses = &low.1.at.place.poses;
        let rate = |(a, b): (&Pose, &Pose)| Rate {
            velocity: (a.shift - b.shift) / back,
            spin: (a.turn * b.turn.inverse()).scaled_axis() / back,
        };
        before.map_or_else(Vec::new, |b| poses.iter().zip(&b.place.poses).map(rate).collect())
    }

    /// The motion that dry friction begins where these rates lead without it.
    fn begins(&self, here: &Rested, rates: &[Rate]) -> Result<Rested, End> {
        let found = self.carried.displaced(&here.poses);
        if rates.len() != here.poses.len() {
            return Err(End::Stuck("no motion was found".into()));
        }
        let speed = self.speed(rates, &here.poses);
        let power = live_power(&found.model, rates);
        let per = |r: &Rate| Rate { velocity: r.velocity / speed, spin: r.spin / speed };
        let driven =
            Rested { power: power / speed, rates: rates.iter().map(per).collect(), ..here.clone() };
        let flow = (speed > 0.0 && power > 0.0).then(|| self.flow(&driven)).flatten();
        flow.ok_or_else(|| End::Stuck("no motion under dry friction was found".into()))
    }

    /// The load factor vanishes between two poses.
    fn vanished(&self, here: &Rested, beyond: Rested, path: &mut Path) -> End {
        let width = WIDTH * beyond.value;
        let ends = narrow(
            (here.value, here.load_factor, here.clone()),
            (beyond.value, beyond.load_factor, beyond),
            width,
            |v, near| {
                // From so near that nothing is found, or from where the step began.
                let at = self.advance(near, v).or_else(|| self.advance(here, v))?;
                Some((at.load_factor, at))
            },
        );
        let Some([(_, _, low), _]) = ends else {
            return End::Stuck("the point where the load factor vanishes was not found".into());
        };
        path.points.push(self.slid_point(&low));
        End::Vanishes
    }

    /// Equilibrium ends between a pose and a value: does it fall?
    fn ceases(&self, here: &Rested, before: Option<&Rested>, beyond: f64, path: &mut Path) -> End {
        if path.points.last().is_none_or(|p| p.value < here.value) {
            path.points.push(self.slid_point(here));
        }
        let why = "no equilibrium under dry friction was found just beyond: what follows is sudden";
        let stuck = End::Stuck(why.into());
        if self.drive.is_push() {
            return stuck;
        }
        // On as it went: so near by that the way is straight.
        let rates = before
            .map_or(&here.rates, |b| if b.value < here.value { &here.rates } else { &b.rates });
        let control =
            Control { law: Law::Associative, deadline: self.deadline, ..Control::default() };
        let blocks = &self.start().blocks;
        let by = beyond - here.value;
        let at = |by: f64| {
            let value = here.value + by;
            let poses: Vec<Pose> = here
                .poses
                .iter()
                .zip(rates)
                .enumerate()
                .map(|(i, (pose, rate))| {
                    if blocks[i].support {
                        return self.drive.pose(i, value);
                    }
                    let turn = UnitQuaternion::from_scaled_axis(rate.spin * by) * pose.turn;
                    Pose { shift: pose.shift + rate.velocity * by, turn }
                })
                .collect();
            let found = self.carried.displaced(&poses);
            if found.deepest.is_some_and(|c| c.gap < -base::tolerance::JOINT_CLOSED) {
                return None;
            }
            let verdict = assess(&found.model, &control);
            (verdict.verdict == Verdict::Unstable).then(|| Point {
                value,
                poses,
                closed: vec![Vec::new(); self.carried.start.interfaces.list.len()],
                load_factor: 0.0,
                forces: verdict.forces.clone(),
                proving: None,
                room: 0.0,
                rates: verdict.rates.clone(),
                touch: Some(touch(&found)),
            })
        };
        let mut falls = (0..12).find_map(|k| at(by * 2f64.powi(k)));
        // As near as it is proved.
        let mut known = 0.0;
        while let Some(high) = falls.as_ref().map(|f| f.value - here.value)
            && high - known > NARROW * beyond
        {
            match at(0.5 * (known + high)) {
                Some(nearer) => falls = Some(nearer),
                None => known = 0.5 * (known + high),
            }
        }
        if let Some(clear) = falls.as_ref().and_then(|f| at(CLEAR * (f.value - here.value))) {
            falls = Some(clear);
        }
        let Some(falls) = falls else { return stuck };
        path.events.push(Event { value: here.value, beyond: falls.value });
        End::Falls(Box::new([self.slid_point(here), falls]))
    }
}

/// The joint at the start of every contact, and its places.
fn touch(found: &check::path::Displaced) -> Vec<(usize, Vec<nalgebra::Vector3<f64>>)> {
    let list = found.model.interfaces.list.iter().map(|f| f.points.clone());
    found.from.iter().copied().zip(list).collect()
}
