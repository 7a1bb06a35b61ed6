//! The equilibrium of the free blocks, reduced and scaled.

use super::{
    Unknowns,
    bearing::{Bearing, bearings, ends_are_all},
    carried::carried,
    conic::Sparse,
    planar,
    planar::Plane,
    section::{Section, sections},
    symmetry::{self, BearingOrbit, BlockOrbit, Orbits},
};
use crate::{
    assembly::{Assembly, Gyration, Wrench},
    interface::Interfaces,
    scene::Friction,
};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use std::ops::Range;

/// What to leave out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Keep everything, for comparison: three dimensions, every tangential force.
    pub keep_all: bool,
    /// Whether the live load takes part (it must then lie in the plane of a plane scene).
    pub live: bool,
    /// Whether a scene that is its own image is reduced to one part. Not where what is asked for is not symmetric itself.
    pub symmetry: bool,
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
    /// Its rows: 6 in space, 3 in a plane, fewer where the block is its own image.
    pub rows: Range<usize>,
    /// The row coordinates among those 6 or 3 that the rows stand for, as columns; `None` for themselves.
    directions: Option<DMatrix<f64>>,
    /// The blocks it stands for, itself among them, and the symmetry that takes it there; empty without symmetry.
    images: Vec<(usize, usize)>,
}

impl FreeBlock {
    /// How many blocks it stands for.
    pub fn image_count(&self) -> usize {
        self.images.len().max(1)
    }
}

/// `A x + w + λ ℓ = 0`, reduced and scaled. `A` has `d·n_free` rows, `d` = 6 in space and 3 in a plane, or fewer with symmetry.
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
    orbits: Option<Orbits>,
    /// Images of each bearing, in column order; empty without symmetry.
    bearing_orbits: Vec<BearingOrbit>,
}

impl Statics {
    /// Builds the equilibrium of an assembly.
    pub fn new(assembly: &Assembly, interfaces: &Interfaces, options: Options) -> Self {
        let mut left_out = Vec::new();
        let loads: &[&[Wrench]] = if options.live { &[&assembly.dead, &assembly.live] } else { &[&assembly.dead] };
        let mut plane = if options.keep_all { None } else { planar::find(assembly, interfaces, loads) };
        let mut list = bearings(assembly, interfaces, plane, options);
        // What the area resists, and compliance, are shared among all corners, not only the outermost two.
        let shared = options.split || !interfaces.list.iter().all(|f| f.law.is_dry());
        if plane.is_some() && shared && !ends_are_all(&list, interfaces) {
            plane = None;
            list = bearings(assembly, interfaces, plane, options);
        }
        let dimension = if plane.is_some() { 3 } else { 6 };
        let mut dead = assembly.dead.clone();
        for face in &interfaces.list {
            for (point, force) in face.points.iter().zip(face.uplift()) {
                for (block, sign) in [(face.a, -1.0), (face.b, 1.0)] {
                    let moment = (point - assembly.blocks[block].centroid).cross(&force);
                    dead[block] += Wrench { force, moment } * sign;
                }
            }
        }

        let free: Vec<usize> = assembly.free().collect();
        let weight = |block: usize| if options.unscaled { 1.0 } else { assembly.weight(block).max(assembly.dead[block].force.norm()) };
        let total: f64 = free.iter().map(|&i| weight(i)).sum();
        let supported = interfaces.list.iter().filter(|f| assembly.blocks[f.a].support || assembly.blocks[f.b].support).count();
        let unit = if options.unscaled { 1.0 } else { UNIT_SHARE * total / supported.max(1) as f64 };
        let load = carried(assembly, interfaces, |i| if assembly.blocks[i].support { 0.0 } else { weight(i) });
        for bearing in &mut list {
            let face = &interfaces.list[bearing.interface];
            bearing.presumed = load[face.a].min(load[face.b]);
            bearing.unit = unit;
        }

        let all_points: usize = interfaces.list.iter().map(|f| f.points.len()).sum();
        if let Some(plane) = plane {
            left_out.push(format!(
                "plane scene (mirrored about the plane normal to {}): {} of {} contact points, 3 of 6 rates a block",
                direction_name(plane.axis),
                list.len(),
                all_points
            ));
        }
        // Bounds on crushing tie the points of a joint together; no symmetry is looked for there.
        let reducible = options.symmetry && !options.keep_all && !options.unscaled && !interfaces.list.iter().any(|f| f.crushes());
        let loads: &[&[Wrench]] = if options.live { &[&dead, &assembly.live] } else { &[&dead] };
        let symmetry = if reducible { symmetry::find(assembly, interfaces, loads, plane) } else { None };
        let reduced = symmetry.and_then(|s| Orbits::new(&s, free.iter().copied(), &list, plane));
        let (orbits, mut block_orbits, mut bearing_orbits) = match reduced {
            None => (None, None, Vec::new()),
            Some((orbits, blocks, bearings)) => {
                left_out.push(format!(
                    "symmetry ({}): {} of {} free blocks, {} of {} contact points",
                    orbits.name,
                    blocks.len(),
                    free.len(),
                    bearings.len(),
                    list.len()
                ));
                (Some(orbits), Some(blocks), bearings)
            }
        };
        if !bearing_orbits.is_empty() {
            let mut column = 0;
            list = bearing_orbits
                .iter()
                .map(|(k, _)| {
                    let bearing = Bearing { column, ..list[*k].clone() };
                    column += bearing.basis.len();
                    bearing
                })
                .collect();
        }
        let mut rows = 0;
        let mut row_of = vec![None; assembly.blocks.len()];
        let mut kept = Vec::new();
        for &block in &free {
            let BlockOrbit { images, directions } = match &mut block_orbits {
                None => BlockOrbit { images: Vec::new(), directions: None },
                Some(orbits) => match orbits.remove(&block) {
                    Some(orbit) => orbit,
                    None => continue,
                },
            };
            let first = rows;
            rows += directions.as_ref().map_or(dimension, DMatrix::ncols);
            row_of[block] = Some(kept.len());
            let gyration =
                if options.unscaled { Gyration::new(&Matrix3::identity(), 1.0) } else { assembly.blocks[block].gyration.clone() };
            kept.push(FreeBlock { block, weight: weight(block), gyration, rows: first..rows, directions, images });
        }
        let columns = list.last().map_or(0, |b| b.column + b.basis.len());
        let mut this = Self {
            plane,
            matrix: Sparse::zeros(rows, columns),
            dead: vec![0.0; rows],
            live: vec![0.0; rows],
            unit,
            free: kept,
            bearings: Vec::new(),
            sections: Vec::new(),
            left_out: Vec::new(),
            orbits,
            bearing_orbits: bearing_orbits.drain(..).map(|(_, orbit)| orbit).collect(),
        };
        for (k, bearing) in list.iter().enumerate() {
            let face = &interfaces.list[bearing.interface];
            let point = 0.5 * (face.points[bearing.points[0]] + face.points[bearing.points[1]]);
            for (c, Wrench { force, moment }) in bearing.basis.iter().enumerate() {
                for (block, sign) in [(face.a, -1.0), (face.b, 1.0)] {
                    if assembly.blocks[block].support {
                        continue;
                    }
                    let moment = moment + (point - assembly.blocks[block].centroid).cross(force);
                    let wrench = Wrench { force: *force, moment } * (sign * unit);
                    // What an image of the bearing does to the block that is kept is the image of what the bearing does here.
                    let (home, element) = this.orbits.as_ref().and_then(|o| o.home(block)).unwrap_or((block, 0));
                    let Some(row) = row_of[home] else { continue };
                    let wrench = this.orbits.as_ref().map_or(wrench, |o| o.wrench(element, &wrench));
                    let count = this.bearing_orbits.get(k).map_or(1.0, |o| o.distinct as f64 / this.free[row].image_count() as f64);
                    this.add_column(row, bearing.column + c, wrench * count);
                }
            }
        }
        for row in 0..this.free.len() {
            let FreeBlock { block, ref rows, .. } = this.free[row];
            let (first, dead, live) = (rows.start, this.scaled(row, dead[block]), this.scaled(row, assembly.live[block]));
            this.dead[first..first + dead.len()].copy_from_slice(&dead);
            this.live[first..first + live.len()].copy_from_slice(&live);
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

    /// Whether a symmetry of the scene reduced it to a part.
    pub fn is_part(&self) -> bool {
        self.orbits.is_some()
    }

    /// Load of all free blocks, N.
    pub fn total_load(&self) -> f64 {
        self.free.iter().map(|f| f.weight * f.image_count() as f64).sum()
    }

    /// How many free blocks there are in the whole scene.
    pub fn free_count(&self) -> usize {
        self.free.iter().map(FreeBlock::image_count).sum()
    }

    /// How many blocks each row stands for.
    pub fn row_images(&self) -> Vec<f64> {
        self.free.iter().flat_map(|f| std::iter::repeat_n(f.image_count() as f64, f.rows.len())).collect()
    }

    /// How many bearings each column stands for.
    pub fn column_images(&self) -> Vec<f64> {
        let count = |k: usize| self.bearing_orbits.get(k).map_or(1.0, |o| o.distinct as f64);
        self.bearings.iter().enumerate().flat_map(|(k, b)| std::iter::repeat_n(count(k), b.basis.len())).collect()
    }

    fn add_column(&mut self, row: usize, column: usize, wrench: Wrench) {
        let first = self.free[row].rows.start;
        for (k, value) in self.scaled(row, wrench).into_iter().enumerate() {
            self.matrix.push(first + k, column, value);
        }
    }

    /// A wrench on the block of `row` in its row coordinates.
    fn scaled(&self, row: usize, wrench: Wrench) -> Vec<f64> {
        let FreeBlock { weight, gyration, directions, .. } = &self.free[row];
        let f = wrench.force / *weight;
        let all = match self.plane {
            Some(p) => {
                let m = p.axis.dot(&wrench.moment) * gyration.force(&p.axis).norm() / weight;
                vec![p.e1.dot(&f), p.e2.dot(&f), m]
            }
            None => {
                let m = gyration.force(&wrench.moment) / *weight;
                vec![f.x, f.y, f.z, m.x, m.y, m.z]
            }
        };
        match directions {
            None => all,
            Some(q) => q.tr_mul(&DVector::from_vec(all)).as_slice().to_vec(),
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
        let by: Vec<f64> = self.free.iter().flat_map(|f| std::iter::repeat_n(f.weight / greatest, f.rows.len())).collect();
        for (i, v) in self.matrix.i.iter().zip(&mut self.matrix.v) {
            *v *= by[*i];
        }
        for (row, (dead, live)) in self.dead.iter_mut().zip(&mut self.live).enumerate() {
            *dead *= by[row];
            *live *= by[row];
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
        for (k, bearing) in self.bearings.iter().enumerate() {
            let mut c = x[bearing.column..bearing.column + bearing.basis.len()].to_vec();
            bearing.admit(&mut c);
            let mut total = Wrench::zero();
            for (basis, c) in bearing.basis.iter().zip(&c) {
                total += *basis * (c * bearing.unit);
            }
            match (&self.orbits, self.bearing_orbits.get(k)) {
                (Some(orbits), Some(orbit)) => {
                    let share = 0.5 * orbit.distinct as f64 / orbit.images.len() as f64;
                    for (element, points, sign) in &orbit.images {
                        let image = orbits.wrench(*element, &total) * (sign * share);
                        points.iter().for_each(|&(f, p)| forces[f][p] += image);
                    }
                }
                _ => bearing.points.iter().for_each(|&p| forces[bearing.interface][p] += total * 0.5),
            }
        }
        forces
    }

    /// Velocity of the centre of mass and spin of every block (zero for supports) from the multipliers `y` of its rows, in units where
    /// a velocity of 1 and a spin that moves the block's mass at 1 (root mean square) weigh the same.
    pub fn rates(&self, blocks: usize, y: &[f64]) -> Vec<(Vector3<f64>, Vector3<f64>)> {
        let mut rates = vec![(Vector3::zeros(), Vector3::zeros()); blocks];
        for free in &self.free {
            let y = DVector::from_column_slice(&y[free.rows.clone()]) / free.image_count() as f64;
            let y = free.directions.as_ref().map_or(y.clone(), |q| q * &y);
            let (v, gyration) = (1.0 / free.weight, &free.gyration);
            let (velocity, spin) = match self.plane {
                Some(p) => ((p.e1 * y[0] + p.e2 * y[1]) * v, p.axis * (y[2] * v * gyration.force(&p.axis).norm())),
                None => (Vector3::new(y[0], y[1], y[2]) * v, gyration.spin(&Vector3::new(y[3], y[4], y[5])) * v),
            };
            rates[free.block] = (velocity, spin);
            if let Some(orbits) = &self.orbits {
                for &(block, element) in &free.images {
                    // Velocity and spin turn as force and moment do.
                    let image = orbits.wrench(element, &Wrench { force: velocity, moment: spin });
                    rates[block] = (image.force, image.moment);
                }
            }
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
