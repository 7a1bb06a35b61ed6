//! The equilibrium of a scene, built: the plane it needs, the points, the part that stands for the
//! rest, the scales, the entries.

use super::{
    bearing::{Bearing, bearings, ends_are_all},
    carried::carried,
    conic::Sparse,
    crushing::sections,
    member,
    options::StaticsOptions,
    planar::{self, Plane},
    statics::{FreeBlock, Statics},
    symmetry::{self, BlockOrbit, Part},
};
use model::{
    assembly::{Assembly, Gyration, Wrench},
    interface::{Interfaces, Model},
    strength::{crushing::crushes, uplift},
};
use nalgebra::{DMatrix, Matrix3, Vector3};
use scene::Friction;
use std::collections::HashMap;

/// Force unit = this × total load / number of interfaces on supports. Greater: the residual in
/// block weights is lost. Smaller: the interior-point path is cut short before tall stacks are
/// resolved.
const UNIT_SHARE: f64 = 8.0;

impl Statics {
    /// Builds the equilibrium of an assembly.
    pub fn new(model: &Model, options: StaticsOptions) -> Self {
        let Model { assembly, interfaces, .. } = model;
        let (plane, mut list) = plane_and_bearings(model, options);
        let weight = |block: usize| {
            if options.unscaled {
                1.0
            } else {
                assembly.weight(block).max(load_size(assembly, block))
            }
        };
        let unit = set_units(model, options, &mut list, weight);
        let mut dead = with_water(model);
        let mut left_out = Vec::new();
        if let Some(plane) = plane {
            left_out.push(plane_line(plane, list.len(), interfaces));
        }
        let part = part(model, options, plane, &dead, &list);
        let (orbits, mut blocks, mut images) =
            (part.as_ref().map(|p| p.orbits.clone()), None, None);
        if let Some(part) = part {
            left_out.push(format!(
                "symmetry ({}): {} of {} free blocks, {} of {} contact points",
                part.orbits.name,
                part.blocks.len(),
                assembly.free().count(),
                part.bearings.len(),
                list.len()
            ));
            (blocks, list, images) = (Some(part.blocks), part.bearings, Some(part.members));
        }
        let free = free_blocks(assembly, options, plane, blocks, weight);
        let rows = free.last().map_or(0, |f| f.rows.end);
        let contacts = list.last().map_or(0, |b| b.column + b.basis.len());
        let (mut members, applied) = member::columns(model, plane, options, images, contacts);
        let load = if members.is_empty() { Vec::new() } else { carried(model, weight) };
        for m in &mut members {
            // What passes there is no more than what the lighter block carries.
            let ends = m.basis.iter().flatten().map(|(i, _)| load[*i]);
            (m.presumed, m.unit) = (ends.fold(f64::INFINITY, f64::min), unit);
        }
        let columns = members.last().map_or(contacts, |m| m.column + m.amounts.len());
        let mut this = Self {
            plane,
            matrix: Sparse::zeros(rows, columns),
            dead: vec![0.0; rows],
            live: vec![0.0; rows],
            unit,
            free,
            members,
            applied,
            sections: sections(interfaces, &list),
            bearings: Vec::new(),
            left_out,
            orbits,
        };
        this.fill(model, &list);
        this.applied.iter().for_each(|(block, wrench)| dead[*block] += *wrench);
        for row in 0..this.free.len() {
            let (block, first) = (this.free[row].block, this.free[row].rows.start);
            let (dead, live) =
                (this.scaled(row, dead[block]), this.scaled(row, assembly.live[block]));
            this.dead[first..first + dead.len()].copy_from_slice(&dead);
            this.live[first..first + live.len()].copy_from_slice(&live);
        }
        let frictionless = interfaces
            .list
            .iter()
            .filter(|f| f.law.friction == Friction::Coefficient(0.0) && f.law.is_dry())
            .count();
        if frictionless > 0 && !options.keep_all {
            this.left_out
                .push(format!("tangential forces of {frictionless} frictionless interfaces"));
        }
        if interfaces.support_pairs > 0 {
            this.left_out.push(format!("{} contacts between supports", interfaces.support_pairs));
        }
        this.bearings = list;
        this
    }

    /// The block that stands for a block, and the symmetry that takes it there.
    fn home(&self, block: usize) -> (usize, usize) {
        self.orbits.as_ref().and_then(|orbits| orbits.home(block)).unwrap_or((block, 0))
    }

    /// The entries of the operator.
    fn fill(&mut self, model: &Model, list: &[Bearing]) {
        let Model { assembly, interfaces, .. } = model;
        let mut row_of = vec![None; assembly.blocks.len()];
        self.free.iter().enumerate().for_each(|(row, f)| row_of[f.block] = Some(row));
        for bearing in list {
            let face = &interfaces.list[bearing.interface];
            let point = 0.5 * (face.points[bearing.points[0]] + face.points[bearing.points[1]]);
            for (block, sign) in [(face.a, -1.0), (face.b, 1.0)] {
                // What an image of the bearing does to the block that is kept is the image of what
                // the bearing does here.
                let (home, element) = self.home(block);
                let Some(row) = row_of[home] else { continue };
                let count = bearing.image_count() as f64 / self.free[row].image_count() as f64;
                for (c, Wrench { force, moment }) in bearing.basis.iter().enumerate() {
                    let moment = moment + (point - assembly.blocks[block].centroid).cross(force);
                    let mut wrench = Wrench { force: *force, moment } * (sign * self.unit);
                    if let Some(orbits) = &self.orbits {
                        wrench = orbits.wrench(element, &wrench) * count;
                    }
                    let first = self.free[row].rows.start;
                    for (k, value) in self.scaled(row, wrench).into_iter().enumerate() {
                        self.matrix.push(first + k, bearing.column + c, value);
                    }
                }
            }
        }
        for m in 0..self.members.len() {
            for c in 0..self.members[m].basis.len() {
                for e in 0..self.members[m].basis[c].len() {
                    let (block, wrench) = self.members[m].basis[c][e];
                    let (home, element) = self.home(block);
                    let Some(row) = row_of[home] else { continue };
                    let mut wrench = wrench * self.unit;
                    if let Some(orbits) = &self.orbits {
                        let images = self.members[m].images.len() as f64;
                        let count = images / self.free[row].image_count() as f64;
                        wrench = orbits.wrench(element, &wrench) * count;
                    }
                    let first = self.free[row].rows.start;
                    let values = self.scaled(row, wrench);
                    let column = self.members[m].column + c;
                    for (k, value) in values.into_iter().enumerate() {
                        self.matrix.push(first + k, column, value);
                    }
                }
            }
        }
    }
}

/// The dead load of a block, N, its moment over the radius of gyration.
fn load_size(assembly: &Assembly, block: usize) -> f64 {
    let Wrench { force, moment } = &assembly.dead[block];
    force.norm().hypot(assembly.blocks[block].gyration.force(moment).norm())
}

/// The mirror plane that a plane scene is solved in, and its contact points.
fn plane_and_bearings(model: &Model, options: StaticsOptions) -> (Option<Plane>, Vec<Bearing>) {
    let Model { assembly, interfaces, .. } = model;
    let loads: &[&[Wrench]] =
        if options.live { &[&assembly.dead, &assembly.live] } else { &[&assembly.dead] };
    let plane = if options.keep_all { None } else { planar::find(model, loads) };
    let list = bearings(model, plane, options);
    // What the area resists, and compliance, are shared among all corners, not only the outermost
    // two.
    let shared = options.split || !interfaces.list.iter().all(|f| f.law.is_dry());
    if plane.is_some() && shared && !ends_are_all(&list, interfaces) {
        return (None, bearings(model, None, options));
    }
    (plane, list)
}

/// Gives the bearings their force unit, which is returned, and the load that presumably passes
/// there.
fn set_units(
    model: &Model,
    options: StaticsOptions,
    list: &mut [Bearing],
    weight: impl Fn(usize) -> f64,
) -> f64 {
    let Model { assembly, interfaces, .. } = model;
    let total: f64 = assembly.free().map(&weight).sum();
    let supported = interfaces
        .list
        .iter()
        .filter(|f| assembly.blocks[f.a].support || assembly.blocks[f.b].support)
        .count();
    let unit = if options.unscaled { 1.0 } else { UNIT_SHARE * total / supported.max(1) as f64 };
    let load = carried(model, weight);
    for bearing in list {
        let face = &interfaces.list[bearing.interface];
        bearing.presumed = load[face.a].min(load[face.b]);
        bearing.unit = unit;
    }
    unit
}

/// The dead load with the pressure of the water in the joints.
fn with_water(model: &Model) -> Vec<Wrench> {
    let Model { assembly, interfaces, .. } = model;
    let mut loads = assembly.dead.clone();
    for face in &interfaces.list {
        for (point, force) in face.points.iter().zip(uplift(face)) {
            for (block, sign) in [(face.a, -1.0), (face.b, 1.0)] {
                let moment = (point - assembly.blocks[block].centroid).cross(&force);
                loads[block] += Wrench { force, moment } * sign;
            }
        }
    }
    loads
}

/// The part that a symmetric scene is reduced to. Bounds on crushing tie the points of a joint
/// together, and the components of a dowel's shear or a finger's friction have directions that an
/// image turns: no symmetry is looked for there.
fn part(
    model: &Model,
    options: StaticsOptions,
    plane: Option<Plane>,
    dead: &[Wrench],
    list: &[Bearing],
) -> Option<Part> {
    let Model { assembly, interfaces, .. } = model;
    if !options.symmetry
        || options.keep_all
        || options.unscaled
        || interfaces.list.iter().any(crushes)
        || !interfaces.members.iter().all(member::is_scalar)
    {
        return None;
    }
    let loads: &[&[Wrench]] = if options.live { &[dead, &assembly.live] } else { &[dead] };
    symmetry::part(model, loads, plane, list)
}

/// The free blocks that have rows: all, or those that stand for their images.
fn free_blocks(
    assembly: &Assembly,
    options: StaticsOptions,
    plane: Option<Plane>,
    mut orbits: Option<HashMap<usize, BlockOrbit>>,
    weight: impl Fn(usize) -> f64,
) -> Vec<FreeBlock> {
    let dimension = if plane.is_some() { 3 } else { 6 };
    let mut rows = 0;
    let own = |block: usize| match &mut orbits {
        Some(orbits) => orbits.remove(&block).map(|orbit| (block, orbit)),
        None => Some((block, BlockOrbit::default())),
    };
    let free = assembly.free().filter_map(own).map(|(block, BlockOrbit { images, directions })| {
        let first = rows;
        rows += directions.as_ref().map_or(dimension, DMatrix::ncols);
        let gyration = if options.unscaled {
            Gyration::new(&Matrix3::identity(), 1.0)
        } else {
            assembly.blocks[block].gyration.clone()
        };
        FreeBlock { block, weight: weight(block), gyration, rows: first..rows, directions, images }
    });
    free.collect()
}

fn plane_line(plane: Plane, kept: usize, interfaces: &Interfaces) -> String {
    let all: usize = interfaces.list.iter().map(|f| f.points.len()).sum();
    let name = direction_name(plane.axis);
    format!(
        "plane scene (mirrored about the plane normal to {name}): {kept} of {all} contact points, 3 of 6 rates a block"
    )
}

fn direction_name(d: Vector3<f64>) -> String {
    match (0..3).find(|&k| d[k].abs() > 1.0 - 1e-9) {
        Some(k) => ["x", "y", "z"][k].to_string(),
        None => format!("({:.4}, {:.4}, {:.4})", d.x, d.y, d.z),
    }
}
