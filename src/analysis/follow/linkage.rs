//! Blocks that move as one, and the corners that keep them together: finite rotations, gaps closed
//! to rounding.

use super::program::Hold;
use check::path::{self, Carried, Demand, Drive};
use check::verdict::member::legs;
use model::{
    assembly::{Pose, Wrench},
    interface::Model,
};
use nalgebra::{DMatrix, DVector, UnitQuaternion, Vector3};

/// A corner that must be open by a stated gap.
#[derive(Clone, Copy, Debug)]
pub struct OpenBy {
    /// The interface.
    pub interface: usize,
    /// Its point.
    pub point: usize,
    /// The gap, m.
    pub gap: f64,
}

mod turned;

pub use turned::Turned;

struct Link {
    /// A block of it, a support where it has one.
    lead: usize,
    /// The mean of its blocks' centres of mass at the start.
    center: Vector3<f64>,
    /// First of its six unknowns; none where a support holds it.
    column: Option<usize>,
}

struct Hinge {
    bodies: [usize; 2],
    point: Vector3<f64>,
    size: f64,
}

/// Bodies of blocks whose joints stay closed all over, and the closed corners between them.
pub struct Linkage<'a> {
    start: &'a Model,
    carried: &'a Carried<'a>,
    body_of: Vec<usize>,
    bodies: Vec<Link>,
    hinges: Vec<Hinge>,
    /// What members do.
    pub holds: Vec<Hold>,
    /// Members that keep their extent, m.
    kept: Vec<(usize, f64)>,
    /// What rotations are measured by, m.
    length: f64,
    unknowns: usize,
}

/// Where the bodies of a linkage are.
#[derive(Clone)]
pub struct Configuration {
    motions: Vec<Pose>,
    /// The pose of every block.
    pub poses: Vec<Pose>,
    /// The motions that it leaves free, one a column, in the unknowns of the linkage.
    pub free: DMatrix<f64>,
}

/// Newton steps at most: it converges twice as many digits a step.
const STEPS: usize = 40;
/// Gaps that count as closed, over the size of the smaller block.
const CLOSED: f64 = 1e-12;
/// Singular values smaller than this × the greatest are none: motions that are free.
const FREE: f64 = 1e-9;

impl<'a> Linkage<'a> {
    /// The linkage of these closed corners and of members that keep their extent.
    pub fn new(
        carried: &'a Carried<'a>,
        closed: &[Vec<usize>],
        holds: &[Hold],
        supports: &Drive,
    ) -> Self {
        let start = carried.start;
        let blocks = &start.assembly.blocks;
        let list = &start.interfaces.list;
        let mut parent: Vec<usize> = (0..blocks.len()).collect();
        let find = |parent: &mut Vec<usize>, mut i: usize| {
            while parent[i] != i {
                parent[i] = parent[parent[i]];
                i = parent[i];
            }
            i
        };
        for (k, points) in closed.iter().enumerate() {
            if !carried.spans(k, points) {
                continue;
            }
            let (a, b) = (find(&mut parent, list[k].a), find(&mut parent, list[k].b));
            // A support stays the root of its body.
            match (blocks[a].support, blocks[b].support) {
                (true, true) if !supports.together(a, b) => {}
                (true, _) => parent[b] = a,
                _ => parent[a] = b,
            }
        }
        let mut bodies: Vec<Link> = Vec::new();
        let mut body_at = vec![usize::MAX; blocks.len()];
        let mut body_of = vec![0; blocks.len()];
        let mut counts = Vec::new();
        let mut unknowns = 0;
        for i in 0..blocks.len() {
            let root = find(&mut parent, i);
            if body_at[root] == usize::MAX {
                body_at[root] = bodies.len();
                let column = (!blocks[root].support).then(|| {
                    unknowns += 6;
                    unknowns - 6
                });
                bodies.push(Link { lead: root, center: Vector3::zeros(), column });
                counts.push(0.0);
            }
            let body = body_at[root];
            body_of[i] = body;
            bodies[body].center += blocks[i].centroid;
            counts[body] += 1.0;
        }
        bodies.iter_mut().zip(counts).for_each(|(b, n)| b.center /= n);
        let mut hinges = Vec::new();
        for (k, points) in closed.iter().enumerate() {
            let bodies = [body_of[list[k].a], body_of[list[k].b]];
            if bodies[0] != bodies[1] {
                let size = carried.size(k);
                hinges.extend(points.iter().map(|&p| Hinge {
                    bodies,
                    point: list[k].points[p],
                    size,
                }));
            }
        }
        let moves = |m: usize| {
            let ends = start.interfaces.members[m].action.ends().into_iter().flatten();
            let mut ends = ends.map(|i| body_of[i]).collect::<Vec<_>>();
            ends.dedup();
            // Ends on one body, and on supports alone, are where they are.
            ends.iter().any(|&b| bodies[b].column.is_some())
        };
        let kept = holds
            .iter()
            .enumerate()
            .filter_map(|(m, hold)| match hold {
                Hold::Keeps(extent) if moves(m) => Some((m, *extent)),
                _ => None,
            })
            .collect();
        let length = blocks.iter().filter(|b| !b.support).map(|b| b.size).fold(0.0, f64::max);
        let holds = holds.to_vec();
        Self { start, carried, body_of, bodies, hinges, holds, kept, length, unknowns }
    }

    /// The bodies where their leading blocks are.
    pub fn place(&self, poses: &[Pose]) -> Configuration {
        let motion = |b: &Link| {
            let pose = poses[b.lead];
            let c = self.start.assembly.blocks[b.lead].centroid;
            Pose { shift: pose.way(&c, &b.center), turn: pose.turn }
        };
        let motions: Vec<Pose> = self.bodies.iter().map(motion).collect();
        self.placed(motions, DMatrix::zeros(self.unknowns, 0))
    }

    fn placed(&self, motions: Vec<Pose>, free: DMatrix<f64>) -> Configuration {
        let blocks = &self.start.assembly.blocks;
        let poses = (0..blocks.len())
            .map(|i| {
                let b = self.body_of[i];
                let shift = motions[b].way(&self.bodies[b].center, &blocks[i].centroid);
                Pose { shift, turn: motions[b].turn }
            })
            .collect();
        Configuration { motions, poses, free }
    }

    /// Puts bodies of supports where they belong.
    pub fn drive(&self, place: &Configuration, supports: &Drive, value: f64) -> Configuration {
        let mut poses = place.poses.clone();
        let mut motions = place.motions.clone();
        for (k, b) in self.bodies.iter().enumerate().filter(|(_, b)| b.column.is_none()) {
            let c = self.start.assembly.blocks[b.lead].centroid;
            let pose = supports.pose(b.lead, value);
            poses[b.lead] = pose;
            motions[k] = Pose { shift: pose.way(&c, &b.center), turn: pose.turn };
        }
        self.placed(motions, place.free.clone())
    }

    /// Moves the free bodies by these unknowns.
    pub fn moved(&self, place: &Configuration, by: &DVector<f64>) -> Configuration {
        let mut motions = place.motions.clone();
        for (motion, body) in motions.iter_mut().zip(&self.bodies) {
            if let Some(c) = body.column {
                motion.shift += by.fixed_rows::<3>(c) * self.length;
                let turn = Vector3::from(by.fixed_rows::<3>(c + 3));
                motion.turn = UnitQuaternion::from_scaled_axis(turn) * motion.turn;
                motion.turn.renormalize();
            }
        }
        self.placed(motions, place.free.clone())
    }

    fn row(
        &self,
        place: &Configuration,
        j: &mut DMatrix<f64>,
        row: usize,
        body: usize,
        at: &Vector3<f64>,
        along: &Vector3<f64>,
    ) {
        if let Some(c) = self.bodies[body].column {
            let center = self.bodies[body].center + place.motions[body].shift;
            let spin = (at - center).cross(along);
            for k in 0..3 {
                j[(row, c + k)] += along[k] * self.length;
                j[(row, c + 3 + k)] += spin[k];
            }
        }
    }

    /// Equations and their derivatives at a place.
    fn equations(
        &self,
        place: &Configuration,
        demand: Option<&Demand>,
        open: &[OpenBy],
    ) -> (DMatrix<f64>, DVector<f64>) {
        let corners = 3 * self.hinges.len();
        let rows = corners + self.kept.len() + usize::from(demand.is_some()) + open.len();
        // Never fewer rows than unknowns: all right singular vectors are wanted.
        let mut j = DMatrix::zeros(rows.max(self.unknowns), self.unknowns);
        let mut r = DVector::zeros(rows.max(self.unknowns));
        let way =
            |body: usize, p: &Vector3<f64>| place.motions[body].way(&self.bodies[body].center, p);
        for (k, h) in self.hinges.iter().enumerate() {
            let [a, b] = h.bodies.map(|b| way(b, &h.point));
            for axis in 0..3 {
                let (row, e) = (3 * k + axis, Vector3::ith(axis, 1.0 / h.size));
                r[row] = e.dot(&(b - a));
                self.row(place, &mut j, row, h.bodies[1], &(h.point + b), &e);
                self.row(place, &mut j, row, h.bodies[0], &(h.point + a), &-e);
            }
        }
        let mut row = corners;
        for &(m, extent) in &self.kept {
            let (assembly, own) = (&self.start.assembly, &self.start.interfaces.members[m]);
            let by = path::member::scale(assembly, own);
            r[row] = (path::member::extent(assembly, &place.poses, own) - extent) / by;
            for leg in legs(&path::member::displaced(assembly, &place.poses, own)) {
                // A positive amount shortens: it pulls its ends together.
                let along = leg.direction / -by;
                for (block, sign) in [(leg.a, -1.0), (leg.b, 1.0)] {
                    let Some(i) = block else { continue };
                    self.row(place, &mut j, row, self.body_of[i], &leg.at, &(along * sign));
                }
            }
            row += 1;
        }
        if let Some(d) = demand {
            let b = self.body_of[d.block];
            let (w, e) = (way(b, &d.point), d.toward / self.length);
            r[row] = e.dot(&w) - d.value / self.length;
            self.row(place, &mut j, row, b, &(d.point + w), &e);
            row += 1;
        }
        for o in open {
            let face = &self.start.interfaces.list[o.interface];
            let [xa, xb] = self.carried.copies(&place.poses, o.interface, o.point);
            let parted = self.carried.parted(&place.poses, o.interface, o.point);
            let size = self.carried.size(o.interface);
            let n = self.carried.normal(&place.poses, o.interface, o.point) / size;
            r[row] = n.dot(&parted) - o.gap / size;
            self.row(place, &mut j, row, self.body_of[face.b], &xb, &n);
            self.row(place, &mut j, row, self.body_of[face.a], &xa, &-n);
            row += 1;
        }
        (j, r)
    }

    /// Closes the gaps from a place near by (Newton, least change); none where it does not come to
    /// rest.
    pub fn close(
        &self,
        near: &Configuration,
        demand: Option<&Demand>,
        open: &[OpenBy],
    ) -> Option<Configuration> {
        let mut place = near.clone();
        let mut best = f64::INFINITY;
        let limit = if open.is_empty() { CLOSED } else { 1e3 * CLOSED };
        for step in 0..STEPS {
            let (j, r) = self.equations(&place, demand, open);
            let size = r.amax();
            if !size.is_finite() || (step > 4 && size > 0.5 * best && size > limit) {
                return None;
            }
            let settled = size <= 0.01 * CLOSED || (size <= limit && size > 0.5 * best);
            best = best.min(size);
            if self.unknowns == 0 {
                return (size <= limit).then_some(place);
            }
            let svd = j.svd(true, true);
            let least = FREE * svd.singular_values.max();
            if settled {
                place.free = free(&svd, least);
                return Some(place);
            }
            let by = svd.solve(&-r, least).ok()?;
            place = self.moved(&place, &by);
        }
        None
    }

    /// The free motions at a place.
    pub fn free(&self, place: &Configuration, demand: Option<&Demand>) -> DMatrix<f64> {
        if self.unknowns == 0 {
            return DMatrix::zeros(0, 0);
        }
        let svd = self.equations(place, demand, &[]).0.svd(true, true);
        free(&svd, FREE * svd.singular_values.max())
    }

    /// The free motions at a place in which these corners open no further.
    pub fn free_with(&self, place: &Configuration, still: &[OpenBy]) -> DMatrix<f64> {
        let svd = self.equations(place, None, still).0.svd(true, true);
        free(&svd, FREE * svd.singular_values.max())
    }

    /// Power of loads on the blocks for every free motion.
    pub fn power(
        &self,
        place: &Configuration,
        loads: &[Wrench],
        motions: &DMatrix<f64>,
    ) -> DVector<f64> {
        let mut unit = DVector::zeros(self.unknowns);
        let blocks = &self.start.assembly.blocks;
        for (i, w) in loads.iter().enumerate() {
            let b = self.body_of[i];
            if let Some(c) = self.bodies[b].column {
                let center = self.bodies[b].center + place.motions[b].shift;
                let arm = blocks[i].centroid + place.poses[i].shift - center;
                let m = w.moment + arm.cross(&w.force);
                for k in 0..3 {
                    unit[c + k] += w.force[k] * self.length;
                    unit[c + 3 + k] += m[k];
                }
            }
        }
        motions.tr_mul(&unit)
    }

    /// The motion between two places, in unknowns, to first order.
    pub fn between(&self, from: &Configuration, to: &Configuration) -> DVector<f64> {
        let mut by = DVector::zeros(self.unknowns);
        for (k, body) in self.bodies.iter().enumerate() {
            if let Some(c) = body.column {
                let (a, b) = (&from.motions[k], &to.motions[k]);
                by.fixed_rows_mut::<3>(c).copy_from(&((b.shift - a.shift) / self.length));
                by.fixed_rows_mut::<3>(c + 3).copy_from(&(b.turn * a.turn.inverse()).scaled_axis());
            }
        }
        by
    }
}

fn free(svd: &nalgebra::SVD<f64, nalgebra::Dyn, nalgebra::Dyn>, least: f64) -> DMatrix<f64> {
    let Some(v) = &svd.v_t else { return DMatrix::zeros(0, 0) };
    let columns: Vec<DVector<f64>> = (0..svd.singular_values.len())
        .filter(|&k| svd.singular_values[k] <= least)
        .map(|k| v.row(k).transpose())
        .collect();
    if columns.is_empty() { DMatrix::zeros(v.ncols(), 0) } else { DMatrix::from_columns(&columns) }
}
