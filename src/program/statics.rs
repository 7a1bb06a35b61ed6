//! The equilibrium of the free blocks, reduced and scaled.

use super::{
    Unknowns,
    bearing::{Bearing, bearings, ends_are_all},
    carried::carried,
    conic::Sparse,
    planar,
    planar::Plane,
    section::{Section, sections},
};
use crate::{
    assembly::{Assembly, Gyration, Wrench},
    interface::Interfaces,
    scene::Friction,
};
use nalgebra::{Matrix3, Vector3};

/// What to leave out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Keep everything, for comparison: three dimensions, every tangential force.
    pub keep_all: bool,
    /// Whether the live load takes part (it must then lie in the plane of a plane scene).
    pub live: bool,
    /// Whether columns are the normal and tangential forces themselves, friction left to the caller
    /// ([`coulomb`](super::coulomb)), instead of coordinates of the friction cone.
    pub split: bool,
    /// For studies: friction cones in space replaced by pyramids.
    pub pyramid: Option<Pyramid>,
    /// For studies: newtons and metres as they are, no scaling.
    pub unscaled: bool,
}

/// A friction cone made of flat facets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pyramid {
    /// Number of facets, at least 3.
    pub facets: usize,
    /// Around the cone (edges outside) instead of inside it.
    pub around: bool,
}

/// A free block and the scales of its rows.
#[derive(Clone, Debug)]
pub struct FreeBlock {
    /// Index into the assembly.
    pub block: usize,
    /// Force scale, N: the greatest of own weight and dead load.
    pub weight: f64,
    /// What moments are measured by: the block's own radii of gyration, or metres ([`Options::unscaled`]).
    pub gyration: Gyration,
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
    /// The joints that can crush.
    pub sections: Vec<Section>,
    /// Scaled equilibrium operator.
    pub matrix: Sparse,
    /// Scaled dead load, with the water in the joints.
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
        let mut plane = if options.keep_all { None } else { planar::find(assembly, interfaces, loads) };
        let free: Vec<FreeBlock> = assembly
            .free()
            .map(|block| FreeBlock {
                block,
                weight: if options.unscaled { 1.0 } else { assembly.weight(block).max(assembly.dead[block].force.norm()) },
                gyration: if options.unscaled { Gyration::new(&Matrix3::identity(), 1.0) } else { assembly.blocks[block].gyration.clone() },
            })
            .collect();
        let mut row_of = vec![None; assembly.blocks.len()];
        for (row, f) in free.iter().enumerate() {
            row_of[f.block] = Some(row);
        }

        let mut list = bearings(assembly, interfaces, plane, options);
        // What the area resists is shared among all corners, not only the outermost two.
        if plane.is_some() && !interfaces.list.iter().all(|f| f.law.is_dry()) && !ends_are_all(&list, interfaces) {
            plane = None;
            list = bearings(assembly, interfaces, plane, options);
        }
        let dimension = if plane.is_some() { 3 } else { 6 };
        let columns = list.last().map_or(0, |b| b.column + b.basis.len());
        let total: f64 = free.iter().map(|f| f.weight).sum();
        let supported = interfaces.list.iter().filter(|f| assembly.blocks[f.a].support || assembly.blocks[f.b].support).count();
        let mut this = Self {
            plane,
            matrix: Sparse::zeros(dimension * free.len(), columns),
            dead: vec![0.0; dimension * free.len()],
            live: vec![0.0; dimension * free.len()],
            unit: if options.unscaled { 1.0 } else { UNIT_SHARE * total / supported.max(1) as f64 },
            free,
            bearings: Vec::new(),
            sections: Vec::new(),
            left_out: Vec::new(),
            rates_per_block: dimension,
        };
        let load = carried(assembly, interfaces, |i| row_of[i].map_or(0.0, |row: usize| this.free[row].weight));
        for bearing in &mut list {
            let face = &interfaces.list[bearing.interface];
            bearing.presumed = load[face.a].min(load[face.b]);
            bearing.unit = this.unit;
            let point = 0.5 * (face.points[bearing.points[0]] + face.points[bearing.points[1]]);
            for (k, Wrench { force, moment }) in bearing.basis.iter().enumerate() {
                for (block, sign) in [(face.a, -1.0), (face.b, 1.0)] {
                    if let Some(row) = row_of[block] {
                        let moment = moment + (point - assembly.blocks[block].centroid).cross(force);
                        this.add_column(row, bearing.column + k, Wrench { force: *force, moment } * (sign * this.unit));
                    }
                }
            }
        }
        let mut loads = assembly.dead.clone();
        for face in &interfaces.list {
            for (point, force) in face.points.iter().zip(face.uplift()) {
                for (block, sign) in [(face.a, -1.0), (face.b, 1.0)] {
                    let moment = (point - assembly.blocks[block].centroid).cross(&force);
                    loads[block] += Wrench { force, moment } * sign;
                }
            }
        }
        for row in 0..this.free.len() {
            let block = this.free[row].block;
            let (dead, live) = (this.scaled(row, loads[block]), this.scaled(row, assembly.live[block]));
            let first = row * dimension;
            this.dead[first..first + dimension].copy_from_slice(&dead[..dimension]);
            this.live[first..first + dimension].copy_from_slice(&live[..dimension]);
        }
        if let Some(plane) = plane {
            let points: usize = interfaces.list.iter().map(|f| f.points.len()).sum();
            left_out.push(format!(
                "plane scene (mirrored about the plane normal to {}): {} of {} contact points, 3 of 6 rates a block",
                direction_name(plane.axis),
                list.len(),
                points
            ));
        }
        let frictionless = interfaces.list.iter().filter(|f| f.law.friction == Friction::Coefficient(0.0) && f.law.is_dry()).count();
        if frictionless > 0 && !options.keep_all {
            left_out.push(format!("tangential forces of {frictionless} frictionless interfaces"));
        }
        if interfaces.support_pairs > 0 {
            left_out.push(format!("{} contacts between supports", interfaces.support_pairs));
        }
        this.sections = sections(interfaces, &list);
        this.bearings = list;
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
        let FreeBlock { weight, gyration, .. } = &self.free[row];
        let f = wrench.force / *weight;
        match self.plane {
            Some(p) => {
                let m = p.axis.dot(&wrench.moment) * gyration.force(&p.axis).norm() / weight;
                [p.e1.dot(&f), p.e2.dot(&f), m, 0.0, 0.0, 0.0]
            }
            None => {
                let m = gyration.force(&wrench.moment) / *weight;
                [f.x, f.y, f.z, m.x, m.y, m.z]
            }
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

    /// Measures every block by the greatest load instead of its own: rates of light blocks among heavy ones then come out as exactly as
    /// those of the heavy ones, at the cost of their forces.
    pub fn even(&mut self) {
        let greatest = self.free.iter().map(|f| f.weight).fold(0.0, f64::max);
        let by: Vec<f64> = self.free.iter().map(|f| f.weight / greatest).collect();
        let d = self.rates_per_block;
        for (i, v) in self.matrix.i.iter().zip(&mut self.matrix.v) {
            *v *= by[*i / d];
        }
        for (row, (dead, live)) in self.dead.iter_mut().zip(&mut self.live).enumerate() {
            *dead *= by[row / d];
            *live *= by[row / d];
        }
        self.free.iter_mut().for_each(|f| f.weight = greatest);
    }

    /// Whether joints have strengths or couples, for which only programs in forces exist.
    pub fn in_forces_only(&self) -> bool {
        self.bearings.iter().any(|b| b.limits().is_some())
    }

    /// The unknowns that a program can be written in.
    pub(super) fn unknowns(&self, wanted: Unknowns) -> Unknowns {
        if self.in_forces_only() { Unknowns::Forces } else { wanted }
    }

    /// What acts on block `b` at every point of every interface, N and N·m, from scaled columns `x` brought into their cones.
    pub fn forces(&self, interfaces: &Interfaces, x: &[f64]) -> Vec<Vec<Wrench>> {
        let mut forces: Vec<Vec<Wrench>> = interfaces.list.iter().map(|f| vec![Wrench::zero(); f.points.len()]).collect();
        for bearing in &self.bearings {
            let mut c = x[bearing.column..bearing.column + bearing.basis.len()].to_vec();
            bearing.admit(&mut c);
            let mut total = Wrench::zero();
            for (basis, c) in bearing.basis.iter().zip(&c) {
                total += *basis * (c * bearing.unit);
            }
            for k in bearing.points {
                forces[bearing.interface][k] += total * 0.5;
            }
        }
        forces
    }

    /// Velocity of the centre of mass and spin of every block (zero for supports) from scaled rates `y`, in units where
    /// a velocity of 1 and a spin that moves the block's mass at 1 (root mean square) weigh the same.
    pub fn rates(&self, blocks: usize, y: &[f64]) -> Vec<(Vector3<f64>, Vector3<f64>)> {
        let mut rates = vec![(Vector3::zeros(), Vector3::zeros()); blocks];
        for (row, free) in self.free.iter().enumerate() {
            let y = &y[row * self.rates_per_block..(row + 1) * self.rates_per_block];
            let (v, gyration) = (1.0 / free.weight, &free.gyration);
            rates[free.block] = match self.plane {
                Some(p) => ((p.e1 * y[0] + p.e2 * y[1]) * v, p.axis * (y[2] * v * gyration.force(&p.axis).norm())),
                None => (Vector3::new(y[0], y[1], y[2]) * v, gyration.spin(&Vector3::new(y[3], y[4], y[5])) * v),
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

fn direction_name(d: Vector3<f64>) -> String {
    match (0..3).find(|&k| d[k].abs() > 1.0 - 1e-9) {
        Some(k) => ["x", "y", "z"][k].to_string(),
        None => format!("({:.4}, {:.4}, {:.4})", d.x, d.y, d.z),
    }
}
