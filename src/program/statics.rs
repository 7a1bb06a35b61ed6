//! The equilibrium of the free blocks, reduced and scaled.

use super::{carried::carried, conic::Sparse, planar, planar::Plane};
use crate::{
    assembly::{Assembly, Wrench},
    interface::Interfaces,
    scene::Friction,
};
use nalgebra::Vector3;

/// What to leave out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Keep everything, for comparison: three dimensions, every tangential force.
    pub keep_all: bool,
    /// Whether the live load takes part (it must then lie in the plane of a plane scene).
    pub live: bool,
    /// Whether columns are the normal and tangential forces themselves, friction left to the caller
    /// ([`coulomb`](super::coulomb)), instead of coordinates of the friction cone.
    pub split: bool,
}

/// A free block and the scales of its rows.
#[derive(Clone, Debug)]
pub struct FreeBlock {
    /// Index into the assembly.
    pub block: usize,
    /// Force scale, N: the greatest of own weight and dead load.
    pub weight: f64,
    /// Length scale of moments, m: half the block's size.
    pub length: f64,
}

/// The cone of one contact point, in scaled coordinates where it is a standard, self-dual cone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BearingCone {
    /// Every column ≥ 0: a normal force alone (μ = 0), or the two edges of a plane friction cone.
    Rays,
    /// `x₀ ≥ ‖x₁, x₂‖`: the circular friction cone, its columns scaled by μ.
    Circular,
    /// `x₀ ≥ 0`, the others free: no sliding.
    Rough,
}

/// One contact point of the program (or a mirrored pair of them) and its columns.
#[derive(Clone, Debug)]
pub struct Bearing {
    /// Index of the interface.
    pub interface: usize,
    /// Points of the interface that share the force equally: one, or two mirror images.
    pub points: [usize; 2],
    /// First column.
    pub column: usize,
    /// Force on block `b` per unit of each column.
    pub basis: Vec<Vector3<f64>>,
    /// The cone the columns lie in.
    pub cone: BearingCone,
    /// Force unit of the columns, N.
    pub unit: f64,
    /// Load that presumably passes here, N ([`carried`](super::carried)).
    presumed: f64,
}

/// `A x + w + λ ℓ = 0`, reduced and scaled. `A` has `d·n_free` rows, `d` = 6 in space and 3 in a plane.
#[derive(Clone, Debug)]
pub struct Statics {
    /// The mirror plane, where the scene is solved in it.
    pub plane: Option<Plane>,
    /// The free blocks in row order.
    pub free: Vec<FreeBlock>,
    /// The contact points in column order.
    pub bearings: Vec<Bearing>,
    /// Scaled equilibrium operator.
    pub matrix: Sparse,
    /// Scaled dead load.
    pub dead: Vec<f64>,
    /// Scaled live load.
    pub live: Vec<f64>,
    /// Common force unit of the columns, N.
    pub unit: f64,
    /// What was left out, one line each.
    pub left_out: Vec<String>,
    rates_per_block: usize,
}

impl Statics {
    /// Builds the equilibrium of an assembly.
    pub fn new(assembly: &Assembly, interfaces: &Interfaces, options: Options) -> Self {
        let mut left_out = Vec::new();
        let loads: &[&[Wrench]] = if options.live { &[&assembly.dead, &assembly.live] } else { &[&assembly.dead] };
        let plane = if options.keep_all { None } else { planar::find(assembly, interfaces, loads) };
        let free: Vec<FreeBlock> = assembly
            .free()
            .map(|block| FreeBlock {
                block,
                weight: assembly.weight(block).max(assembly.dead[block].force.norm()),
                length: 0.5 * assembly.blocks[block].size,
            })
            .collect();
        let mut row_of = vec![None; assembly.blocks.len()];
        for (row, f) in free.iter().enumerate() {
            row_of[f.block] = Some(row);
        }

        let mut bearings = bearings(assembly, interfaces, plane, options);
        let dimension = if plane.is_some() { 3 } else { 6 };
        let columns = bearings.last().map_or(0, |b| b.column + b.basis.len());
        let total: f64 = free.iter().map(|f| f.weight).sum();
        let supported = interfaces.list.iter().filter(|f| assembly.blocks[f.a].support || assembly.blocks[f.b].support).count();
        let mut this = Self {
            plane,
            matrix: Sparse::zeros(dimension * free.len(), columns),
            dead: vec![0.0; dimension * free.len()],
            live: vec![0.0; dimension * free.len()],
            unit: UNIT_SHARE * total / supported.max(1) as f64,
            free,
            bearings: Vec::new(),
            left_out: Vec::new(),
            rates_per_block: dimension,
        };
        let load = carried(assembly, interfaces, |i| row_of[i].map_or(0.0, |row: usize| this.free[row].weight));
        for bearing in &mut bearings {
            let face = &interfaces.list[bearing.interface];
            bearing.presumed = load[face.a].min(load[face.b]);
            bearing.unit = this.unit;
            let point = 0.5 * (face.points[bearing.points[0]] + face.points[bearing.points[1]]);
            for (k, force) in bearing.basis.iter().enumerate() {
                for (block, sign) in [(face.a, -1.0), (face.b, 1.0)] {
                    if let Some(row) = row_of[block] {
                        let force = force * (sign * this.unit);
                        let moment = (point - assembly.blocks[block].centroid).cross(&force);
                        this.add_column(row, bearing.column + k, Wrench { force, moment });
                    }
                }
            }
        }
        for row in 0..this.free.len() {
            let block = this.free[row].block;
            let (dead, live) = (this.scaled(row, assembly.dead[block]), this.scaled(row, assembly.live[block]));
            let first = row * dimension;
            this.dead[first..first + dimension].copy_from_slice(&dead[..dimension]);
            this.live[first..first + dimension].copy_from_slice(&live[..dimension]);
        }
        if let Some(plane) = plane {
            let points: usize = interfaces.list.iter().map(|f| f.points.len()).sum();
            left_out.push(format!(
                "plane scene (mirrored about the plane normal to {}): {} of {} contact points, 3 of 6 rates a block",
                direction_name(plane.axis),
                bearings.len(),
                points
            ));
        }
        let frictionless = interfaces.list.iter().filter(|f| f.friction == Friction::Coefficient(0.0)).count();
        if frictionless > 0 && !options.keep_all {
            left_out.push(format!("tangential forces of {frictionless} frictionless interfaces"));
        }
        if interfaces.support_pairs > 0 {
            left_out.push(format!("{} contacts between supports", interfaces.support_pairs));
        }
        this.bearings = bearings;
        this.left_out = left_out;
        this
    }

    /// Rates per block: 3 in a plane, 6 in space.
    pub fn dimension(&self) -> usize {
        self.rates_per_block
    }

    fn add_column(&mut self, row: usize, column: usize, wrench: Wrench) {
        let first = row * self.rates_per_block;
        for (k, value) in self.scaled(row, wrench).into_iter().take(self.rates_per_block).enumerate() {
            self.matrix.push(first + k, column, value);
        }
    }

    /// A wrench on the block of `row` in scaled row coordinates (the first `dimension` entries count).
    fn scaled(&self, row: usize, wrench: Wrench) -> [f64; 6] {
        let FreeBlock { weight, length, .. } = self.free[row];
        let (f, m) = (wrench.force / weight, wrench.moment / (weight * length));
        match self.plane {
            Some(p) => [p.e1.dot(&f), p.e2.dot(&f), p.axis.dot(&m), 0.0, 0.0, 0.0],
            None => [f.x, f.y, f.z, m.x, m.y, m.z],
        }
    }

    /// Multiplies the force unit by `factor`. With `local` units, no bearing's unit exceeds `LOCAL_UNIT` × the load that
    /// presumably passes there: without it a grain on a mountain is lost in the mountain's unit.
    pub fn rescale(&mut self, factor: f64, local: bool) {
        self.unit *= factor;
        let mut by = vec![1.0; self.matrix.columns];
        for bearing in &mut self.bearings {
            let unit = if local { self.unit.min(LOCAL_UNIT * bearing.presumed) } else { self.unit };
            by[bearing.column..bearing.column + bearing.basis.len()].fill(unit / bearing.unit);
            bearing.unit = unit;
        }
        for (j, v) in self.matrix.j.iter().zip(&mut self.matrix.v) {
            *v *= by[*j];
        }
    }

    /// Forces on block `b` at every point of every interface, N, from scaled columns `x` projected onto their cones.
    pub fn forces(&self, interfaces: &Interfaces, x: &[f64]) -> Vec<Vec<Vector3<f64>>> {
        let mut forces: Vec<Vec<Vector3<f64>>> = interfaces.list.iter().map(|f| vec![Vector3::zeros(); f.points.len()]).collect();
        for bearing in &self.bearings {
            let mut c = [0.0; 3];
            let n = bearing.basis.len();
            c[..n].copy_from_slice(&x[bearing.column..bearing.column + n]);
            project(bearing.cone, &mut c[..n]);
            let force = bearing.basis.iter().zip(&c).map(|(b, c)| b * (c * bearing.unit)).sum::<Vector3<f64>>();
            for k in bearing.points {
                forces[bearing.interface][k] += 0.5 * force;
            }
        }
        forces
    }

    /// Velocity of the centre of mass and spin of every block (zero for supports) from scaled rates `y`, in units where
    /// a velocity of 1 and a spin of 1 / length weigh the same.
    pub fn rates(&self, blocks: usize, y: &[f64]) -> Vec<(Vector3<f64>, Vector3<f64>)> {
        let mut rates = vec![(Vector3::zeros(), Vector3::zeros()); blocks];
        for (row, free) in self.free.iter().enumerate() {
            let y = &y[row * self.rates_per_block..(row + 1) * self.rates_per_block];
            let (v, s) = (1.0 / free.weight, 1.0 / (free.weight * free.length));
            rates[free.block] = match self.plane {
                Some(p) => ((p.e1 * y[0] + p.e2 * y[1]) * v, p.axis * (y[2] * s)),
                None => (Vector3::new(y[0], y[1], y[2]) * v, Vector3::new(y[3], y[4], y[5]) * s),
            };
        }
        rates
    }
}

/// Greatest local unit, in presumed loads. Larger: blocks 1e9 times smaller than their neighbours are lost.
/// Smaller: ordinary walls get uneven units and stall.
const LOCAL_UNIT: f64 = 1e5;

/// Force unit = this × total load / number of interfaces on supports. Greater: the residual in block weights is lost.
/// Smaller: the interior-point path is cut short before tall stacks are resolved.
const UNIT_SHARE: f64 = 8.0;

fn bearings(assembly: &Assembly, interfaces: &Interfaces, plane: Option<Plane>, options: Options) -> Vec<Bearing> {
    let mut list = Vec::new();
    let mut column = 0;
    for (index, face) in interfaces.list.iter().enumerate() {
        let n = face.frame.n;
        let (basis, cone) = match (plane, face.friction) {
            (_, Friction::Coefficient(mu)) if mu == 0.0 && !options.keep_all => (vec![n], BearingCone::Rays),
            (Some(p), _) if options.split => (vec![n, p.axis.cross(&n)], BearingCone::Rough),
            (None, _) if options.split => (vec![n, face.frame.t1, face.frame.t2], BearingCone::Rough),
            (Some(p), Friction::Coefficient(mu)) => {
                let t = p.axis.cross(&n);
                let scale = 1.0 / mu.hypot(1.0);
                (vec![(n + t * mu) * scale, (n - t * mu) * scale], BearingCone::Rays)
            }
            (Some(p), Friction::Infinite) => (vec![n, p.axis.cross(&n)], BearingCone::Rough),
            (None, Friction::Coefficient(mu)) => {
                let (normal, shear) = if mu > 1.0 { (1.0 / mu, 1.0) } else { (1.0, mu) };
                (vec![n * normal, face.frame.t1 * shear, face.frame.t2 * shear], BearingCone::Circular)
            }
            (None, Friction::Infinite) => (vec![n, face.frame.t1, face.frame.t2], BearingCone::Rough),
        };
        let points: Vec<[usize; 2]> = match plane {
            None => (0..face.points.len()).map(|k| [k, k]).collect(),
            Some(p) => {
                let t = p.axis.cross(&n);
                let along = |k: &usize| t.dot(&(face.points[*k] - face.points[0]));
                let by = |a: &usize, b: &usize| along(a).total_cmp(&along(b));
                let (Some(low), Some(high)) = ((0..face.points.len()).min_by(by), (0..face.points.len()).max_by(by)) else { continue };
                let size = assembly.blocks[face.a].size.min(assembly.blocks[face.b].size);
                let pair = |k: usize| [k, planar::mirror_of(&face.points, face.points[k], p.axis, p.offset, size).unwrap_or(k)];
                if along(&high) - along(&low) <= f64::EPSILON * size { vec![pair(low)] } else { vec![pair(low), pair(high)] }
            }
        };
        for points in points {
            list.push(Bearing { interface: index, points, column, basis: basis.clone(), cone, unit: 1.0, presumed: 0.0 });
            column += basis.len();
        }
    }
    list
}

/// Nearest point of the standard cone.
fn project(cone: BearingCone, x: &mut [f64]) {
    match cone {
        BearingCone::Rays => x.iter_mut().for_each(|v| *v = v.max(0.0)),
        BearingCone::Rough if x[0] < 0.0 => x.fill(0.0),
        BearingCone::Rough => {}
        BearingCone::Circular => {
            let t = x[1].hypot(x[2]);
            if t <= -x[0] {
                x.fill(0.0);
            } else if t > x[0] {
                let r = 0.5 * (x[0] + t);
                (x[0], x[1], x[2]) = (r, x[1] / t * r, x[2] / t * r);
            }
        }
    }
}

fn direction_name(d: Vector3<f64>) -> String {
    match (0..3).find(|&k| d[k].abs() > 1.0 - 1e-9) {
        Some(k) => ["x", "y", "z"][k].to_string(),
        None => format!("({:.4}, {:.4}, {:.4})", d.x, d.y, d.z),
    }
}
