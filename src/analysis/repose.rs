//! The angle of repose: the slope that a heap leaves behind which flowed and came to rest.
//!
//! A heap is made by a [`Protocol`] in the dynamics. Its free surface is the highest grain of every
//! cell 2 d wide; the cells at wall and toe are dropped and a straight line is fitted along each of
//! several paths (strips from the wall to the edge, or sectors from the middle) and through their
//! mean. The heap at rest is then a scene like any other, and its static margin, the tilt that it
//! still bears, is asked for as a cross-check by a method that shares nothing with the dynamics but
//! the places of the grains.

use super::{
    Control, Outcome, Tilt,
    stability::{held, without},
    tilt,
};
use crate::{
    assembly,
    dynamics::granular::{Disturbance, Flow, Rest, flow},
    error::{Finding, FindingCode, InputError},
    generate::{Deposit, deposit},
    interface::prepare,
    scene::{BlockSpec, Protocol, ProtocolKind, Rotation, Scene},
    tolerance::GRAIN_GAP,
};
use nalgebra::{Unit, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};
use std::{collections::BTreeMap, f64::consts::TAU, ops::ControlFlow, time::Instant};

/// Width of a cell, d.
const CELL: f64 = 2.0;
/// Sectors around a heap in the open.
const SECTORS: usize = 8;
/// Fewest cells on a line.
const FEWEST: usize = 3;
/// A stage may take so many √(d/g) to come to rest.
const HORIZON: f64 = 400.0;
/// √(d/g) between two layers that are poured: a grain falls 3 d in the meantime.
const POUR: f64 = 2.5;
/// Rounds in which grains that nothing balances are left out. More: a heap that really falls is
/// taken apart.
const UNBALANCED: usize = 4;
/// Cells lower than this, d, are the rough floor with single grains on it: the toe.
const TOE: f64 = 1.0;

/// A straight line through the free surface.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Slope {
    /// Degrees; positive where the surface falls towards the edge.
    pub angle_deg: f64,
    /// Coefficient of determination of the fit.
    pub r_squared: f64,
    /// Cells on it.
    pub cells: usize,
}

/// The free surface of a heap as its slope was read from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// The mean of the highest grains, step by step down the slope, m.
    pub surface: Vec<Vector3<f64>>,
    /// The ends of the straight line through it, m.
    pub line: [Vector3<f64>; 2],
    /// The slope of that line.
    pub slope: Slope,
}

/// A heap and its slope.
#[derive(Clone, Debug, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Heap {
    /// Its seed.
    pub seed: u64,
    /// The heap as it lies, an explicit scene.
    pub scene: Scene,
    /// Whether it came to rest. Where it did not, nothing below means anything.
    pub rested: bool,
    /// Mean kinetic energy of a grain at the end over m g d.
    pub energy: f64,
    /// Time simulated over √(d/g).
    pub time: f64,
    /// Seconds that the simulation took.
    pub seconds: f64,
    /// Free grains that stayed, and those that fell over the edge.
    pub grains: [usize; 2],
    /// The slope through the mean surface; `None` where fewer than three cells are left.
    pub slope: Option<Slope>,
    /// The slopes of strips or sectors.
    pub parts: Vec<Slope>,
    /// Tilt: the angle at which the bed began to flow, degrees.
    pub avalanche_deg: Option<f64>,
    /// Why there is something to doubt.
    pub findings: Vec<Finding>,
}

/// The static margin of a heap.
#[derive(Clone, Debug)]
pub struct Margin {
    /// The heap without grains that nothing holds.
    pub scene: Scene,
    /// The tilt downhill that it still bears, at most.
    pub tilt: Tilt,
    /// Grains that nothing held.
    pub loose: usize,
    /// Grains that no admissible forces balance as they lie, left out: they still creep, too slowly
    /// for the dynamics to call it motion.
    pub unbalanced: usize,
    /// Seconds: contacts, limit.
    pub seconds: [f64; 2],
}

/// Makes a heap and measures it.
///
/// # Errors
/// A value of the protocol is out of its range.
pub fn heap(
    protocol: &Protocol,
    seed: u64,
    watch: &mut dyn FnMut(&Flow) -> ControlFlow<()>,
) -> Result<Heap, InputError> {
    let Deposit { scene, gates, layers } = deposit(protocol, seed)?;
    let assembly = assembly::resolve(&scene)?;
    let index: BTreeMap<&str, usize> =
        assembly.blocks.iter().enumerate().map(|(i, b)| (b.id.as_str(), i)).collect();
    let find = |ids: &[String]| {
        ids.iter().filter_map(|id| index.get(id.as_str()).copied()).collect::<Vec<_>>()
    };
    let d = protocol.diameter;
    let g = assembly.gravity.norm();
    let natural = (d / g).sqrt();
    let stages = match protocol.kind {
        ProtocolKind::Drain => vec![Disturbance::Settle, Disturbance::Remove(find(&gates))],
        ProtocolKind::Funnel => {
            vec![Disturbance::Pour(layers.iter().map(|l| find(l)).collect(), POUR * natural)]
        }
        ProtocolKind::Cylinder => {
            let height = 3.0 * d * (protocol.grains as f64).cbrt();
            vec![
                Disturbance::Settle,
                Disturbance::Lift(find(&gates), protocol.rate * (g * d).sqrt(), height),
            ]
        }
        // Towards the gate, which goes as soon as the bed has settled.
        ProtocolKind::Tilt => {
            let rate = protocol.rate.to_radians() / natural;
            vec![Disturbance::Settle, Disturbance::Turn(Unit::new_unchecked(-Vector3::y()), rate)]
        }
    };
    let rest = flow(&assembly, &stages, d, HORIZON, watch)?;
    let spots: Vec<(Vector3<f64>, f64)> = assembly
        .free()
        .filter_map(|i| rest.poses[i].map(|p| (i, p)))
        .flat_map(|(i, pose)| tops(&assembly.blocks[i], pose))
        .collect();
    let turned = rest.turned.unwrap_or(0.0);
    let (slope, parts) = {
        let (profile, parts) = surface(protocol, &spots, turned);
        (profile.map(|p| p.slope), parts)
    };
    let mut findings = Vec::new();
    let mut say = |text: String| findings.push(Finding::new(FindingCode::Numerics, text));
    if !rest.rested {
        say(format!(
            "the heap still moves: {:.1e} m g d a grain after {:.0} √(d/g)",
            rest.energy,
            rest.time / natural
        ));
    }
    if slope.is_none() {
        say(format!(
            "fewer than {FEWEST} cells of the surface lie between wall and toe: too few grains for a slope"
        ));
    }
    let free = assembly.free().count();
    Ok(Heap {
        seed,
        scene: settled(&scene, &assembly, &rest, &index),
        rested: rest.rested,
        energy: rest.energy,
        time: rest.time / natural,
        seconds: rest.seconds,
        grains: [free - rest.gone, rest.gone],
        slope,
        parts,
        avalanche_deg: rest.turned.map(f64::to_degrees),
        findings,
    })
}

/// Spheres with these centres and radii, one of whose tops is the top of the grain as it has moved.
fn tops(
    block: &assembly::Block,
    (center, turn): (Vector3<f64>, UnitQuaternion<f64>),
) -> Vec<(Vector3<f64>, f64)> {
    let moved = |p: &Vector3<f64>| center + turn * (p - block.centroid);
    match &block.solid {
        assembly::Solid::Sphere { center, radius } => vec![(moved(center), *radius)],
        assembly::Solid::Clump { balls, .. } => balls.iter().map(|(c, r)| (moved(c), *r)).collect(),
        assembly::Solid::Polyhedron(p) => p.vertices.iter().map(|v| (moved(v), 0.0)).collect(),
    }
}

/// The surface of a heap that lies still, from its scene: what [`heap`] measured.
pub fn profile(protocol: &Protocol, heap: &assembly::Assembly) -> Option<Profile> {
    let spots: Vec<(Vector3<f64>, f64)> = heap
        .free()
        .map(|i| &heap.blocks[i])
        .flat_map(|b| tops(b, (b.centroid, UnitQuaternion::identity())))
        .collect();
    let turned = match protocol.kind {
        ProtocolKind::Tilt => heap.gravity.x.atan2(-heap.gravity.z),
        ProtocolKind::Drain | ProtocolKind::Funnel | ProtocolKind::Cylinder => 0.0,
    };
    surface(protocol, &spots, turned).0
}

/// The heap as a scene: what stayed, where it lies.
fn settled(
    scene: &Scene,
    assembly: &assembly::Assembly,
    rest: &Rest,
    index: &BTreeMap<&str, usize>,
) -> Scene {
    let mut heap = scene.clone();
    heap.contact.gap = GRAIN_GAP;
    if let Some(turned) = rest.turned {
        let (sin, cos) = turned.sin_cos();
        let g = assembly.gravity.norm();
        heap.gravity = [g * sin, 0.0, -g * cos];
    }
    heap.blocks.retain_mut(|block| {
        let Some(&i) = index.get(block.id.as_str()) else { return false };
        let Some((center, turn)) = rest.poses.get(i).copied().flatten() else { return false };
        if !block.support {
            lay(block, &assembly.blocks[i], center, turn);
        }
        true
    });
    heap
}

/// Moves a block: the frame x ↦ R x + t turns about the centre of mass.
fn lay(
    spec: &mut BlockSpec,
    block: &assembly::Block,
    center: Vector3<f64>,
    turn: UnitQuaternion<f64>,
) {
    if matches!(block.solid, assembly::Solid::Sphere { .. }) {
        // A sphere looks the same however it has turned.
        spec.at = center.into();
        return;
    }
    let before = spec
        .rotation_deg
        .as_ref()
        .and_then(|r| Unit::try_new(Vector3::from(r.axis), 0.0).map(|axis| (axis, r.angle)));
    let before = before.map_or(UnitQuaternion::identity(), |(axis, angle)| {
        UnitQuaternion::from_axis_angle(&axis, angle.to_radians())
    });
    spec.at = (center + turn * (Vector3::from(spec.at) - block.centroid)).into();
    spec.rotation_deg = (turn * before).axis_angle().map(|(axis, angle)| Rotation {
        axis: axis.into_inner().into(),
        angle: angle.to_degrees(),
    });
}

/// The fit through the mean surface, and the fits along strips or sectors.
///
/// Where the bed has been tilted by `turned` radians, ways and heights count as gravity sees them:
/// against the bed the surface is nearly level, and a line through it would explain little of its
/// roughness.
fn surface(
    protocol: &Protocol,
    spots: &[(Vector3<f64>, f64)],
    turned: f64,
) -> (Option<Profile>, Vec<Slope>) {
    let d = protocol.diameter;
    let width = CELL * d;
    let open = matches!(protocol.kind, ProtocolKind::Funnel | ProtocolKind::Cylinder);
    let half = 0.5 * protocol.size[1] * d;
    // In the open the foot of the highest grains' mean is the middle.
    let middle = spots.iter().map(|(c, _)| *c).sum::<Vector3<f64>>() / spots.len().max(1) as f64;
    // By path and step along it: the highest grain (way, height).
    let mut cells: BTreeMap<(usize, usize), (f64, f64)> = BTreeMap::new();
    for (c, r) in spots {
        let (path, way) = if open {
            let (x, y) = (c.x - middle.x, c.y - middle.y);
            (
                (((y.atan2(x) / TAU).rem_euclid(1.0) * SECTORS as f64) as usize).min(SECTORS - 1),
                x.hypot(y),
            )
        } else {
            // What hangs over the edge is no part of the surface.
            if c.x < 0.0 || c.x > protocol.size[0] * d {
                continue;
            }
            ((((c.y + half) / width).max(0.0)) as usize, c.x)
        };
        let cell = cells.entry((path, (way / width) as usize)).or_insert((way, f64::NEG_INFINITY));
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
    let parts = paths.values().filter_map(|cells| fit(cells, d, turned)).map(|f| f.0).collect();
    let Some((slope, ends)) = fit(&profile, d, turned) else { return (None, parts) };
    // In the plane of the section through the middle; in the open along x.
    let from = if open { middle } else { Vector3::zeros() };
    let place = |(x, z): (f64, f64)| Vector3::new(from.x + x, from.y, z);
    let surface = profile.into_iter().map(place).collect();
    (Some(Profile { surface, line: ends.map(place), slope }), parts)
}

/// A straight line through cells, the first (at the wall, or the top) and the toe left out, and its
/// ends against the bed.
fn fit(cells: &[(f64, f64)], d: f64, turned: f64) -> Option<(Slope, [(f64, f64); 2])> {
    // Beyond the last cell that stands clear of the floor is the toe; its own last cell is cut by
    // it.
    let end = cells.iter().rposition(|c| c.1 > TOE * d)?;
    let (sin, cos) = turned.sin_cos();
    let inner: Vec<(f64, f64)> =
        cells.get(1..end)?.iter().map(|(x, z)| (x * cos + z * sin, z * cos - x * sin)).collect();
    if inner.len() < FEWEST {
        return None;
    }
    let n = inner.len() as f64;
    let (x, z) =
        (inner.iter().map(|c| c.0).sum::<f64>() / n, inner.iter().map(|c| c.1).sum::<f64>() / n);
    let sum = |f: &dyn Fn(&(f64, f64)) -> f64| inner.iter().map(f).sum::<f64>();
    let (xx, xz, zz) =
        (sum(&|c| (c.0 - x).powi(2)), sum(&|c| (c.0 - x) * (c.1 - z)), sum(&|c| (c.1 - z).powi(2)));
    if xx <= 0.0 {
        return None;
    }
    let r_squared = if zz > 0.0 { xz * xz / (xx * zz) } else { 1.0 };
    // Back against the bed.
    let end = |way: f64| {
        let height = z + xz / xx * (way - x);
        (way * cos - height * sin, way * sin + height * cos)
    };
    let ends = [inner.first(), inner.last()].map(|c| end(c.map_or(x, |c| c.0)));
    let slope = Slope { angle_deg: (-xz / xx).atan().to_degrees(), r_squared, cells: inner.len() };
    Some((slope, ends))
}

/// The tilt downhill that a heap at rest still bears. In the open it is asked for along x.
///
/// # Errors
/// The heap cannot be prepared.
pub fn margin(heap: &Heap, control: &Control) -> Result<Margin, InputError> {
    let start = Instant::now();
    let (mut model, loose) = held(&prepare(&heap.scene)?);
    let contacts = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let down = Vector3::x();
    let (mut gone, mut unbalanced) = (loose.clone(), 0);
    let mut tilt = tilt(&model, down, control)?;
    for _ in 0..UNBALANCED {
        let moving: Vec<usize> =
            tilt.load_factor.mechanism.iter().flat_map(|m| m.moving.iter().copied()).collect();
        if tilt.load_factor.outcome != Outcome::Impossible || moving.is_empty() {
            break;
        }
        let (rest, more) = held(&model.without(&moving));
        if rest.assembly.free().next().is_none() {
            break;
        }
        unbalanced += moving.len() + more.len();
        gone.extend(model.ids(&moving).into_iter().chain(more));
        model = rest;
        tilt = self::tilt(&model, down, control)?;
    }
    let scene = without(&heap.scene, &gone)?;
    Ok(Margin {
        scene,
        tilt,
        loose: loose.len(),
        unbalanced,
        seconds: [contacts, start.elapsed().as_secs_f64()],
    })
}

impl Margin {
    /// Degrees, where found; negative where the heap as it lies has no admissible forces.
    pub fn degrees(&self) -> Option<f64> {
        (self.tilt.load_factor.outcome == Outcome::Found).then(|| self.tilt.angle_deg())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Grains on a plane of 25°: the fit gives that, on every path.
    #[test]
    fn the_slope_of_a_plane() {
        let protocol = Protocol::default();
        let d = protocol.diameter;
        let slope = 25f64.to_radians().tan();
        let spots: Vec<(Vector3<f64>, f64)> = (0..16)
            .flat_map(|i| (0..10).map(move |j| (i, j)))
            .map(|(i, j)| {
                let (x, y) = (i as f64 + 0.5, j as f64 - 4.5);
                (Vector3::new(x * d, y * d, (8.5 - slope * x) * d), 0.5 * d)
            })
            .collect();
        let (mean, parts) = surface(&protocol, &spots, 0.0);
        let Profile { surface: cells, line, slope: mean } = mean.expect("a slope");
        // Its line passes through the tops, which lie half a grain above the centres.
        let top = |x: f64| 9.0 * d - slope * x;
        assert!(cells.iter().chain(&line).all(|p| (p.z - top(p.x)).abs() < 1e-9 && p.y == 0.0));
        assert!(
            (mean.angle_deg - 25.0).abs() < 1e-9 && mean.r_squared > 1.0 - 1e-12 && mean.cells >= 5,
            "{mean:?}"
        );
        assert_eq!(parts.len(), 5);
        assert!(parts.iter().all(|p| (p.angle_deg - 25.0).abs() < 1e-9), "{parts:?}");
        // The same grains where gravity has turned by 10°: ten more, with the same fit.
        let (mean, _) = surface(&protocol, &spots, 10f64.to_radians());
        let Profile { line, slope: mean, .. } = mean.expect("a slope");
        assert!(line.iter().all(|p| (p.z - top(p.x)).abs() < 1e-9), "{line:?}");
        assert!((mean.angle_deg - 35.0).abs() < 1e-9 && mean.r_squared > 1.0 - 1e-12, "{mean:?}");
        assert_eq!(surface(&protocol, &spots[..10], 0.0).0, None, "one row of grains has no slope");
        assert_eq!(surface(&protocol, &[], 0.0), (None, Vec::new()));
    }
}
