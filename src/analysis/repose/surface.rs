//! The free surface of a heap, read cell by cell, and the straight line through it.
//!
//! Ways x run downhill along the bed, heights z stand on it. Where the bed has been turned, both
//! count as gravity sees them: against the bed such a surface is nearly level, and a line through
//! it would explain little of its roughness.

use model::assembly;
use nalgebra::Vector3;
use scene::{Protocol, ProtocolKind};
use serde::{Deserialize, Serialize};
use std::{collections::BTreeMap, f64::consts::TAU};

/// A straight line through the free surface.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Slope {
    /// Degrees; positive where the surface falls towards the edge.
    pub angle_deg: f64,
    /// Coefficient of determination of the fit.
    pub r_squared: f64,
    /// Cells on it.
    pub cells: usize,
    /// Standard error of the angle by the scatter of the cells, degrees: of this heap, not of others.
    pub error_deg: f64,
}

/// Length of a cell along the slope, d. Shorter: cells whose highest grain is one of the layer
/// below. Longer: 2,000 grains make six cells, through which any line fits.
pub(super) const CELL: f64 = 1.5;
/// Width of a strip across the slope, d; a box is divided evenly into about such strips.
const STRIP: f64 = 2.0;
/// Sectors around a heap in the open.
const SECTORS: usize = 8;
/// Cells lower than this, d, are the rough floor with single grains on it: the toe.
const TOE: f64 = 1.0;
/// Fewest cells through which a line is laid at all, if only to say why it is no slope.
const LINE: usize = 3;

/// A straight line through cells of the surface.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Fit {
    pub slope: Slope,
    /// Standard deviation of the cells from the line, m.
    pub scatter: f64,
    /// Root of the sum of the squared ways from their mean, m.
    pub spread: f64,
    /// The cells on it, (way, height), m.
    pub cells: Vec<(f64, f64)>,
    /// Its ends against the bed, (way, height), m.
    pub ends: [(f64, f64); 2],
}

/// What was read from the surface, before anything is said of it.
#[derive(Clone, Debug, Default)]
pub(super) struct Reading {
    /// The mean surface step by step, m.
    pub surface: Vec<Vector3<f64>>,
    /// The line through it; `None` where fewer than three cells lie between wall and toe.
    pub mean: Option<Fit>,
    /// The ends of that line, m.
    pub line: [Vector3<f64>; 2],
    /// The lines along strips or sectors.
    pub parts: Vec<Fit>,
}

/// Centres and radii of spheres, one of whose tops is the top of the grain as it has moved.
fn tops(block: &assembly::Block) -> Vec<(Vector3<f64>, f64)> {
    match &block.solid {
        assembly::Solid::Sphere { center, radius } => vec![(*center, *radius)],
        assembly::Solid::Clump { balls, .. } => balls.clone(),
        assembly::Solid::Polyhedron(p) => p.vertices.iter().map(|v| (*v, 0.0)).collect(),
    }
}

/// Reads the surface from tops of grains; the bed has been turned by `turned` radians.
pub(super) fn read(protocol: &Protocol, spots: &[(Vector3<f64>, f64)], turned: f64) -> Reading {
    let d = protocol.diameter;
    let open = matches!(protocol.kind, ProtocolKind::Funnel | ProtocolKind::Cylinder);
    let [length, width] = protocol.size().map(|s| s * d);
    let strips = (width / (STRIP * d)).round().max(1.0);
    // In the open the foot of the highest grains' mean is the middle.
    let middle = spots.iter().map(|(c, _)| *c).sum::<Vector3<f64>>() / spots.len().max(1) as f64;
    // By path and step along it: the highest grain (way, height).
    let mut cells: BTreeMap<(usize, usize), (f64, f64)> = BTreeMap::new();
    for (c, r) in spots {
        let (path, way) = if open {
            let (x, y) = (c.x - middle.x, c.y - middle.y);
            let sector = (y.atan2(x) / TAU).rem_euclid(1.0) * SECTORS as f64;
            ((sector as usize).min(SECTORS - 1), x.hypot(y))
        } else {
            // What hangs over the edge is no part of the surface.
            if c.x < 0.0 || c.x > length {
                continue;
            }
            let across = ((c.y / width + 0.5) * strips).clamp(0.0, strips - 1.0);
            (across as usize, c.x)
        };
        let step = (way / (CELL * d)) as usize;
        let cell = cells.entry((path, step)).or_insert((way, f64::NEG_INFINITY));
        if c.z + r > cell.1 {
            *cell = (way, c.z + r);
        }
    }
    let mut paths: BTreeMap<usize, Vec<(f64, f64)>> = BTreeMap::new();
    let mut steps: BTreeMap<usize, Vec<(f64, f64)>> = BTreeMap::new();
    for ((path, step), cell) in cells {
        paths.entry(path).or_default().push(cell);
        steps.entry(step).or_default().push(cell);
    }
    let full = paths.len();
    let mean = |cells: &Vec<(f64, f64)>| {
        let n = cells.len() as f64;
        (cells.iter().map(|c| c.0).sum::<f64>() / n, cells.iter().map(|c| c.1).sum::<f64>() / n)
    };
    // A step that not every path reaches lies beyond the toe of the mean.
    let profile: Vec<(f64, f64)> =
        steps.values().filter(|cells| 2 * cells.len() > full).map(mean).collect();
    let between = |cells: &[(f64, f64)]| inner(cells, d).and_then(|c| Fit::through(c, turned));
    let mean = between(&profile);
    // In the plane of the section through the middle; in the open along x.
    let from = if open { middle } else { Vector3::zeros() };
    let place = |(x, z): (f64, f64)| Vector3::new(from.x + x, from.y, z);
    Reading {
        line: mean.as_ref().map_or([Vector3::zeros(); 2], |f| f.ends.map(place)),
        surface: profile.into_iter().map(place).collect(),
        mean,
        parts: paths.values().filter_map(|cells| between(cells)).collect(),
    }
}

/// The cells without the first (at the wall, or the top) and without the toe.
fn inner(cells: &[(f64, f64)], d: f64) -> Option<&[(f64, f64)]> {
    // Beyond the last cell that stands clear of the floor is the toe; its own last cell is cut by
    // it.
    cells.get(1..cells.iter().rposition(|c| c.1 > TOE * d)?)
}

/// The error of an angle by that of its tangent, degrees.
fn error(of_tangent: f64, angle: f64) -> f64 {
    (of_tangent * angle.cos().powi(2)).to_degrees()
}

impl Fit {
    /// The least squares of the heights; `None` through fewer than three cells.
    pub fn through(cells: &[(f64, f64)], turned: f64) -> Option<Self> {
        if cells.len() < LINE {
            return None;
        }
        let (sin, cos) = turned.sin_cos();
        let seen: Vec<(f64, f64)> =
            cells.iter().map(|(x, z)| (x * cos + z * sin, z * cos - x * sin)).collect();
        let n = seen.len() as f64;
        let sum = |f: &dyn Fn(&(f64, f64)) -> f64| seen.iter().map(f).sum::<f64>();
        let (x, z) = (sum(&|c| c.0) / n, sum(&|c| c.1) / n);
        let xx = sum(&|c| (c.0 - x).powi(2));
        let xz = sum(&|c| (c.0 - x) * (c.1 - z));
        let zz = sum(&|c| (c.1 - z).powi(2));
        if xx <= 0.0 {
            return None;
        }
        let rest = sum(&|c| (c.1 - z - xz / xx * (c.0 - x)).powi(2));
        // Back against the bed.
        let end = |way: f64| {
            let height = z + xz / xx * (way - x);
            (way * cos - height * sin, way * sin + height * cos)
        };
        Some(Self {
            ends: [seen.first(), seen.last()].map(|c| end(c.map_or(x, |c| c.0))),
            slope: Slope {
                angle_deg: (-xz / xx).atan().to_degrees(),
                // A level surface leaves a line nothing to explain.
                r_squared: if zz > 0.0 { xz * xz / (xx * zz) } else { 0.0 },
                cells: seen.len(),
                error_deg: error((rest / (n - 2.0) / xx).sqrt(), (-xz / xx).atan()),
            },
            scatter: (rest / (n - 2.0)).sqrt(),
            spread: xx.sqrt(),
            cells: cells.to_vec(),
        })
    }

    /// Height that the line falls between its ends as gravity sees them, m.
    pub fn fall(&self) -> f64 {
        let [(x0, z0), (x1, z1)] = self.ends;
        (x1 - x0).hypot(z1 - z0) * self.slope.angle_deg.to_radians().sin().abs()
    }
}

/// Reads the surface of a heap that lies still.
pub(super) fn of(protocol: &Protocol, heap: &assembly::Assembly) -> Reading {
    let spots: Vec<(Vector3<f64>, f64)> = heap.free().flat_map(|i| tops(&heap.blocks[i])).collect();
    // How far the bed of a tilt has been turned shows in the gravity that its heap is left with.
    let turned = match protocol.kind {
        ProtocolKind::Tilt => heap.gravity.x.atan2(-heap.gravity.z),
        _ => 0.0,
    };
    read(protocol, &spots, turned)
}
