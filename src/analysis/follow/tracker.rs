//! A scene on its way: where a linkage is at a value of the parameter, what its contacts are there,
//! and what forces leave.

use super::{
    linkage::{Configuration, Linkage},
    point::{End, Path, Point},
    program::{self, Hold, Margin},
    rebalance::rebalanced,
};
use crate::{Control, assess};
use check::{
    path::{Carried, Corner, Drive, member},
    terms::Law,
    verdict::{Rate, Verdict},
};
use model::{
    assembly::{Assembly, Pose, Wrench},
    interface::{Interface, Model, detect},
};
use nalgebra::{DMatrix, DVector, Vector3};
use solve::deadline::Deadline;
use std::collections::HashSet;

pub(super) struct Tracker<'a> {
    pub carried: &'a Carried<'a>,
    pub drive: &'a Drive,
    /// Bounding box diagonal of the scene, m.
    pub size: f64,
    /// When it has to end.
    pub deadline: Deadline,
    /// Blocks that touch at these poses and did not at the start, in words ([`meets`]); whether it
    /// is known of those that may come to touch where they do.
    pub meets: &'a dyn Fn(&[Pose], bool) -> Option<String>,
    /// Hears of what there is of the path, made where that is wanted, as it grows.
    pub hears: &'a dyn Fn(&dyn Fn() -> Path),
}

/// Where a linkage is at a value of the parameter.
#[derive(Clone)]
pub(super) struct At {
    pub place: Configuration,
    pub load_factor: f64,
}

impl<'a> Tracker<'a> {
    pub fn start(&self) -> &'a Assembly {
        &self.carried.start.assembly
    }

    pub fn linkage(&self, closed: &[Vec<usize>], holds: &[Hold]) -> Linkage<'a> {
        Linkage::new(self.carried, closed, holds, self.drive)
    }

    /// Dead and live loads at poses; members that yield are among the dead ones.
    pub fn loads(&self, linkage: &Linkage, poses: &[Pose]) -> [Vec<Wrench>; 2] {
        let [mut dead, live] = self.start().loads_at(poses);
        let start = self.start();
        for (own, hold) in self.carried.start.interfaces.members.iter().zip(&linkage.holds) {
            if let Hold::Yields(amount) = hold {
                let own = member::displaced(start, poses, own);
                let center = |i: usize| start.blocks[i].centroid + poses[i].shift;
                member::wrenches(&own, *amount, center).into_iter().for_each(|(i, w)| dead[i] += w);
            }
        }
        [dead, live]
    }

    /// Where a linkage is at a value; equilibrium picks what its corners leave free.
    pub fn at(&self, linkage: &Linkage, near: &Configuration, value: f64) -> Option<At> {
        let demand = self.drive.demand(value);
        let driven = linkage.drive(near, self.drive, value);
        let mut place = linkage.close(&driven, demand.as_ref(), &[])?;
        let basis = place.free.clone();
        let count = basis.ncols();
        if count == 0 {
            let load_factor = self.load_factor(linkage, &place);
            return Some(At { place, load_factor });
        }
        let wide = if self.drive.is_push() { linkage.free(&place, None) } else { basis.clone() };
        let residual = |place: &Configuration| self.residual(linkage, place, &wide);
        let go = |place: &Configuration, by: &DVector<f64>| {
            linkage.close(&linkage.moved(place, &(&basis * by)), demand.as_ref(), &[])
        };
        let mut best = f64::INFINITY;
        for _ in 0..30 {
            let (r, scale) = residual(&place);
            let size = r.amax() / scale;
            if size <= 1e-14 || (size <= 1e-10 && size >= 0.5 * best) {
                let load_factor = self.load_factor(linkage, &place);
                return Some(At { place, load_factor });
            }
            best = best.min(size);
            let mut j = DMatrix::zeros(r.len(), count);
            const STEP: f64 = 1e-6;
            for k in 0..count {
                let mut by = DVector::zeros(count);
                by[k] = STEP;
                let ahead = residual(&go(&place, &by)?).0;
                by[k] = -STEP;
                let behind = residual(&go(&place, &by)?).0;
                j.set_column(k, &((ahead - behind) / (2.0 * STEP)));
            }
            let svd = j.svd(true, true);
            let least = 1e-9 * svd.singular_values.max();
            let by = svd.solve(&-r, least).ok()?;
            let by = &by * (0.1 / by.norm().max(0.1));
            place = go(&place, &by)?;
        }
        None
    }

    /// Power of the loads in the free motions, aligned with those of `basis`, at the load factor
    /// that leaves least of it; and its scale.
    fn residual(
        &self,
        linkage: &Linkage,
        place: &Configuration,
        basis: &DMatrix<f64>,
    ) -> (DVector<f64>, f64) {
        let free = linkage.free(place, None);
        let free = if self.drive.is_push() { free } else { place.free.clone() };
        let aligned = &free * free.tr_mul(basis);
        let [dead, live] = self.loads(linkage, &place.poses);
        let a = linkage.power(place, &dead, &aligned);
        let scale = dead.iter().map(|w| w.force.norm()).sum::<f64>() * self.size;
        if !self.drive.is_push() {
            return (a, scale);
        }
        let b = linkage.power(place, &live, &aligned);
        let l = -a.dot(&b) / b.dot(&b);
        (a + b * l, scale)
    }

    /// The load factor in equilibrium with a linkage, by the free motions of this very place: those
    /// of a place a step away give one that is off by the step.
    fn load_factor(&self, linkage: &Linkage, place: &Configuration) -> f64 {
        if !self.drive.is_push() {
            return 0.0;
        }
        let free = &linkage.free(place, None);
        let [dead, live] = self.loads(linkage, &place.poses);
        let (a, b) = (linkage.power(place, &dead, free), linkage.power(place, &live, free));
        -a.dot(&b) / b.dot(&b)
    }

    /// The room of the forces there; members that yield carry what they yield at.
    pub fn margin(&self, poses: &[Pose], closed: &[Vec<usize>], holds: &[Hold]) -> Option<Margin> {
        let mut model = self.carried.touching(poses, closed).model;
        let given = pin(&mut model, holds);
        let mut margin = program::margin(&model, self.drive.is_push())?;
        for (k, w) in given {
            margin.forces[k] = vec![w];
            margin.bare[k] = vec![w];
        }
        Some(margin)
    }

    /// The same by forces of a pose near by, where these are soon in balance; of a program otherwise.
    /// Where supports move, and what they carry is asked of every point, of a program always.
    pub fn margin_near(
        &self,
        at: &At,
        closed: &[Vec<usize>],
        holds: &[Hold],
        near: Option<&Margin>,
    ) -> Option<Margin> {
        let poses = &at.place.poses;
        near.filter(|_| self.drive.is_push())
            .and_then(|near| {
                let model = self.carried.touching(poses, closed).model;
                rebalanced(&model, near, Some(at.load_factor))
            })
            .or_else(|| self.margin(poses, closed, holds))
    }

    /// The corner that is open and has sunk deepest.
    pub fn deepest(&self, poses: &[Pose], closed: &[Vec<usize>]) -> Option<Corner> {
        self.open(poses, closed).into_iter().min_by(|a, b| a.gap.total_cmp(&b.gap))
    }

    /// Corners that are not closed.
    pub fn open(&self, poses: &[Pose], closed: &[Vec<usize>]) -> Vec<Corner> {
        let list = self.carried.corners(poses).into_iter().enumerate();
        list.flat_map(|(k, c)| c.into_iter().filter(move |c| !closed[k].contains(&c.point)))
            .collect()
    }

    /// How the blocks of a linkage that is pushed move there.
    fn mechanism(&self, linkage: &Linkage, place: &Configuration) -> Vec<Rate> {
        if !self.drive.is_push() {
            return Vec::new();
        }
        let free = linkage.free(place, None);
        let [_, live] = self.loads(linkage, &place.poses);
        // Of several motions the dead load has the same power against the live load in each.
        let power = linkage.power(place, &live, &free);
        linkage.rates(place, &(free * power))
    }

    pub fn point(
        &self,
        value: f64,
        (linkage, at): (&Linkage, &At),
        closed: &[Vec<usize>],
        margin: &Margin,
    ) -> Point {
        Point {
            value,
            poses: at.place.poses.clone(),
            closed: closed.to_vec(),
            load_factor: if self.drive.is_push() { at.load_factor } else { 0.0 },
            forces: margin.forces.clone(),
            proving: None,
            room: margin.room,
            rates: self.mechanism(linkage, &at.place),
            touch: None,
        }
    }

    /// Corners closed with those that have just come together.
    pub(super) fn with_closed(
        &self,
        poses: &[Pose],
        closed: &[Vec<usize>],
    ) -> Result<Vec<Vec<usize>>, End> {
        let mut now = closed.to_vec();
        for c in self.open(poses, closed).into_iter().filter(|c| c.gap.abs() <= 1e-8) {
            // Copies that meet beside each other touch at other points than those that parted.
            if c.apart > 1e-7 {
                return Err(End::Stuck(
                    "a joint that had opened completely closes at another place".into(),
                ));
            }
            now[c.interface].push(c.point);
            now[c.interface].sort_unstable();
        }
        Ok(now)
    }

    /// Corners that are about to open where the room is used up.
    pub(super) fn lost(
        &self,
        poses: &[Pose],
        closed: &[Vec<usize>],
        margin: &Margin,
    ) -> Vec<(usize, usize)> {
        let displaced = self.carried.touching(poses, closed);
        let mut lost = Vec::new();
        let list = &displaced.model.interfaces.list;
        let largest = margin.bare.iter().flatten().map(|w| w.force.norm()).fold(0.0, f64::max);
        for (c, (face, forces)) in list.iter().zip(&margin.bare).enumerate() {
            let k = displaced.from[c];
            for (point, w) in face.points.iter().zip(forces) {
                if w.force.dot(&face.frame.n) > 1e-6 * largest {
                    continue;
                }
                let near = |p: &&usize| {
                    (self.carried.copies(poses, k, **p)[0] - point).norm()
                        <= 1e-9 * self.carried.size(k)
                };
                lost.extend(closed[k].iter().find(near).map(|&p| (k, p)));
            }
        }
        lost
    }

    /// Whether nothing balances the loads there.
    pub(super) fn falls_there(&self, poses: &[Pose], closed: &[Vec<usize>]) -> bool {
        if self.drive.is_push() {
            return false;
        }
        let control = Control { law: Law::Associative, ..Control::default() };
        assess(&self.carried.touching(poses, closed).model, &control).verdict == Verdict::Unstable
    }
}

/// Makes loads of what members carry that yield; where these forces stand, and they.
pub(super) fn pin(model: &mut Model, holds: &[Hold]) -> Vec<(usize, Wrench)> {
    let first = model.interfaces.list.len();
    let mut given = Vec::new();
    for (m, hold) in holds.iter().enumerate() {
        if let Hold::Yields(amount) = *hold
            && amount != 0.0
        {
            let own = &mut model.interfaces.members[m];
            let Assembly { blocks, dead, .. } = &mut model.assembly;
            let on = member::wrenches(own, amount, |i| blocks[i].centroid);
            on.into_iter().for_each(|(i, w)| dead[i] += w);
            (own.least, own.greatest) = (0.0, 0.0);
            let force = Vector3::new(amount, 0.0, 0.0);
            given.push((first + m, Wrench { force, moment: Vector3::zeros() }));
        }
    }
    given
}

/// Bounding box diagonal of the contacts, m.
pub(super) fn size(model: &Model) -> f64 {
    let corners = || model.interfaces.list.iter().flat_map(|f| &f.points);
    let all = |f: fn(f64, f64) -> f64, from: f64| {
        corners().fold(Vector3::repeat(from), |a, p| a.zip_map(p, f))
    };
    (all(f64::max, f64::NEG_INFINITY) - all(f64::min, f64::INFINITY)).norm()
}

/// Blocks of a scene that touch at these poses and neither did at the start nor are among the
/// `joined`, in words.
pub(super) fn meets(
    start: &Model,
    joined: &HashSet<(usize, usize)>,
    poses: &[Pose],
) -> Option<String> {
    let found = match detect(&start.assembly.at(poses)) {
        Ok(found) => found,
        Err(e) => return Some(e.to_string()),
    };
    let pair = |f: &Interface| (f.a.min(f.b), f.a.max(f.b));
    let known: HashSet<_> = start.interfaces.list.iter().map(pair).collect();
    found.list.iter().map(pair).find(|p| !known.contains(p) && !joined.contains(p)).map(|(a, b)| {
        let id = |i: usize| &start.assembly.blocks[i].id;
        format!("{} and {}, which were apart at the start, come into contact", id(a), id(b))
    })
}
