//! Members on the way: they keep their length until they yield.

use super::{
    branch::{BranchPoint, Follow, ROOM, Trial, WIDTH},
    linkage::{Configuration, Linkage},
    point::{End, Event, Path},
    program::{self, Hold},
    root::narrow,
    tracker::{Tracker, pin},
};
use base::tolerance;
use check::{
    path::member::{extent, scale},
    verdict::member::amounts,
};
use model::assembly::Pose;

/// By how much the member that is worst off would have to carry more than it can for the others to
/// keep their extents.
#[derive(Clone, Copy, Debug)]
pub(super) struct Excess {
    /// The member.
    pub member: usize,
    /// The bound that it reaches, N.
    pub bound: f64,
    /// How far beyond it, over the weight of the scene; < 0 where none is.
    pub by: f64,
}

/// Part of the longest step after which a member that yields must have gone the way it yields.
const AHEAD: f64 = 1e-4;

impl Tracker<'_> {
    /// What members that keep their extent would carry if nothing limited them; nothing where forces
    /// are missing for another reason, or none keeps it.
    pub(super) fn excess(
        &self,
        linkage: &Linkage,
        poses: &[Pose],
        closed: &[Vec<usize>],
    ) -> Option<Excess> {
        let mut model = self.carried.touching(poses, closed).model;
        let keeps = |m: &usize| matches!(linkage.holds[*m], Hold::Keeps(_));
        let bounds: Vec<(usize, [f64; 2])> = (0..linkage.holds.len())
            .filter(keeps)
            .map(|m| {
                let own = &mut model.interfaces.members[m];
                let bounds = [own.least, own.greatest];
                (own.least, own.greatest) = (f64::NEG_INFINITY, f64::INFINITY);
                (m, bounds)
            })
            .collect();
        if bounds.is_empty() {
            return None;
        }
        pin(&mut model, &linkage.holds);
        let margin = program::margin(&model, self.drive.is_push()).filter(|m| m.room >= ROOM)?;
        let weight: f64 = model.assembly.free().map(|i| model.assembly.dead[i].force.norm()).sum();
        let first = model.interfaces.list.len();
        bounds
            .into_iter()
            .flat_map(|(member, [least, greatest])| {
                let amount = amounts(&margin.forces[first + member]).x;
                [(greatest, amount - greatest), (least, least - amount)]
                    .map(|(bound, over)| Excess { member, bound, by: over / weight })
            })
            .max_by(|a, b| a.by.total_cmp(&b.by))
    }

    /// A member reaches what it can carry: it yields from there on, and the motion goes on with it,
    /// or it falls.
    pub(super) fn yields(
        &self,
        how: &Follow,
        linkage: &Linkage,
        here: (f64, Trial),
        there: (f64, Trial, Excess),
        closed: &[Vec<usize>],
        path: &mut Path,
    ) -> Result<BranchPoint, End> {
        let stuck = |text: &str| End::Stuck(text.to_string());
        let left = |e: &Excess| -e.by;
        let first = self.excess(linkage, &here.1.at.place.poses, closed);
        let ends = narrow(
            (here.0, first.as_ref().map_or(0.0, left).max(0.0), (here.1.at.clone(), there.2)),
            (there.0, left(&there.2), (there.1.at.clone(), there.2)),
            WIDTH * there.0,
            |v, near| {
                let at = self.at(linkage, &near.0.place, v)?;
                let excess = self.excess(linkage, &at.place.poses, closed)?;
                Some((left(&excess), (at, excess)))
            },
        );
        let Some([low, beyond]) = ends else {
            return Err(stuck("the point where a member yields was not found"));
        };
        let Excess { member, bound, .. } = beyond.2.1;
        let at = low.2.0;
        let margin = self.margin(&at.place.poses, closed, &linkage.holds);
        if let Some(m) = &margin {
            path.points.push(self.point(low.0, (linkage, &at), closed, m));
        }
        path.events.push(Event { value: low.0, beyond: beyond.0 });
        let mut holds = linkage.holds.clone();
        holds[member] = Hold::Yields(bound);
        // Does it yield the way it is pulled, as the parameter grows?
        let own = &self.carried.start.interfaces.members[member];
        let onward = self.linkage(closed, &holds);
        let value = low.0 + AHEAD * how.step;
        let goes = self.at(&onward, &at.place, value).is_some_and(|ahead| {
            let by = extent(self.start(), &ahead.place.poses, own)
                - extent(self.start(), &at.place.poses, own);
            let way = if bound > 0.0 || (bound == 0.0 && own.greatest == 0.0) { by } else { -by };
            way > 0.0 && way < 0.01 * self.size
        });
        if goes && self.is_stable(&onward, &at.place) {
            return self.run(
                how,
                BranchPoint { value: low.0, poses: at.place.poses, closed: closed.to_vec(), holds },
                path,
            );
        }
        let low = (low.0, Trial { at, margin });
        // What has gone slack holds nothing up any more.
        let slack = bound == 0.0 && !self.drive.is_push();
        let end = slack.then(|| self.falls(linkage, &low, closed)).flatten();
        Err(end.unwrap_or_else(|| {
            End::Stuck(format!("member {:?} yields, and the scene fails suddenly with it", own.id))
        }))
    }

    /// Whether loads bring back a pose from which its free motion leads away a little; not asked
    /// where the load factor is free, which holds it.
    fn is_stable(&self, linkage: &Linkage, place: &Configuration) -> bool {
        const BY: f64 = 1e-6;
        let free = linkage.free(place, None);
        if self.drive.is_push() || free.ncols() != 1 {
            return true;
        }
        let power = |by: f64| {
            let there = linkage.close(&linkage.moved(place, &(free.column(0) * by)), None, &[])?;
            let [dead, _] = self.loads(linkage, &there.poses);
            Some(linkage.power(&there, &dead, &free)[0])
        };
        power(BY).zip(power(-BY)).is_some_and(|(ahead, behind)| ahead < behind)
    }

    /// Why members do not go on as they did, in words: one that yielded is loaded back, or one that
    /// had gone slack is taut again.
    pub(super) fn turns(&self, holds: &[Hold], from: &[Pose], to: &[Pose]) -> Option<String> {
        let members = self.carried.start.interfaces.members.iter().zip(holds);
        members.filter(|(_, hold)| !matches!(hold, Hold::Keeps(_))).find_map(|(own, hold)| {
            let [before, now] = [from, to].map(|poses| extent(self.start(), poses, own));
            let small = tolerance::JOINT_CLOSED * scale(self.start(), own);
            let back = match hold {
                Hold::Yields(amount) if *amount > 0.0 => now < before - small,
                Hold::Yields(amount) if *amount < 0.0 => now > before + small,
                // Slack: until it would be taut. What had yielded before is not known to be slack.
                _ if own.is_idle() || (now - before).abs() <= small => false,
                _ if own.greatest > 0.0 => now.max(before) > small,
                _ => now.min(before) < -small,
            };
            back.then(|| {
                format!("member {:?} is loaded again after it yielded or went slack", own.id)
            })
        })
    }
}
