//! What holds the grains of a protocol: floors, walls, drums, bins, boxes; lengths in mean
//! diameters.

use super::super::{numbered, random::Random, support};
use crate::{Ball, BlockSpec, FloorKind, Protocol, ProtocolKind, Rotation, Shape};
use base::error::InputError;
use std::f64::consts::{PI, TAU};

/// Distance of grains in the loose layers over the greatest diameter.
const LOOSE: f64 = 1.05;
/// Tries to place a fixed grain on the floor, per d² of floor. Fewer: holes in which a grain lies
/// on the flat ground and rolls at once.
const TRIES: f64 = 80.0;
/// Least distance of fixed grains, in d; they may overlap. Larger: the same holes.
const APART: f64 = 0.7;
/// Walls are so thick, in d: more than a grain passes in a step.
const WALL: f64 = 4.0;
/// Sides of the hollow cylinder.
const SIDES: usize = 16;
/// Sides of the drum and of the orifice.
const ROUND: usize = 32;
/// Least distance of fixed grains on a lid, d. Smaller: more balls than a clump has.
const LID: f64 = 0.9;
/// Share of the volume that poured grains fill, to know where the middle of their bed will be.
const POURED: f64 = 0.6;

/// Floor and walls around the grains.
pub(super) struct Vessel {
    kind: ProtocolKind,
    length: f64,
    width: f64,
    /// Where the loose layers lie: from x to x, from y to y.
    pub cell: [f64; 4],
    /// Layers begin above this height.
    pub base: f64,
    /// Layers end below this height.
    pub ceiling: f64,
    /// Grains below this height have fallen out.
    pub lost: f64,
    /// The floor, and the grains that are fixed on it.
    pub below: Vec<BlockSpec>,
}

/// How far apart grains of this reach lie in loose layers, d.
pub(super) fn pitch(p: &Protocol, reach: f64) -> f64 {
    LOOSE * p.sizes.greatest(p.diameter) * reach
}

impl Vessel {
    pub fn new(p: &Protocol, random: &mut Random) -> Self {
        let [length, width] = p.size();
        let d = p.diameter;
        // In the open, the floor.
        let heap = 2.0 * (p.grains as f64).cbrt().max(4.0) + 4.0;
        let boxed = [0.0, length, -width / 2.0, width / 2.0];
        let r = length / 4.0;
        let (cell, floor) = match p.kind {
            ProtocolKind::Drain | ProtocolKind::Tilt | ProtocolKind::Shear => (boxed, boxed),
            ProtocolKind::Funnel | ProtocolKind::Cylinder => {
                ([-r, r, -r, r], [-heap, heap, -heap, heap])
            }
            ProtocolKind::Drum => {
                let (r, w) = (length / 2.0, width / 2.0);
                // Unrolled; where its ends meet fixed grains are as far apart as elsewhere.
                let over = 0.5 * (1.0 - APART);
                ([-r, r, -w, w], [-over, PI * length + over, -w, w])
            }
            ProtocolKind::Hopper => ([-2.0 * r, 2.0 * r, -2.0 * r, 2.0 * r], [0.0; 4]),
            ProtocolKind::Cell => {
                // No narrower than its rows, by rounding.
                let side = (p.grains as f64).cbrt().ceil() * pitch(p, 1.0) * (1.0 + 1e-9);
                ([0.0, side, 0.0, side], [0.0, side, 0.0, side])
            }
        };
        let mut below = Vec::new();
        let spots = match (p.kind, p.floor) {
            (ProtocolKind::Hopper | ProtocolKind::Cell, _) | (_, FloorKind::Flat) => Vec::new(),
            (_, FloorKind::Rough) => rough(floor, APART, random),
        };
        match p.kind {
            ProtocolKind::Hopper => below.extend(plate(d, length, width)),
            ProtocolKind::Drum => {
                below.extend(spots.iter().enumerate().map(|(i, [s, y])| {
                    let (sin, cos) = (s / (0.5 * length)).sin_cos();
                    let at = [0.5 * length * cos, *y, 0.5 * length * sin];
                    ball(numbered("f", i, spots.len()), at, d)
                }));
            }
            _ => {
                // It ends before the outermost fixed grains do: over the edge nothing lies on it.
                let closed = matches!(p.kind, ProtocolKind::Shear | ProtocolKind::Cell);
                let end = if closed { 0.0 } else { 0.5 };
                let low = [floor[0], floor[2], -0.5 - WALL];
                let slab = wall(d, "floor".into(), low, [floor[1] - end, floor[3], -0.5]);
                below.push(BlockSpec { material: Some("grain".into()), ..slab });
                let fixed = spots.iter().enumerate();
                below
                    .extend(fixed.map(|(i, at)| {
                        ball(numbered("f", i, spots.len()), [at[0], at[1], 0.0], d)
                    }));
            }
        }
        let (base, ceiling, lost) = match p.kind {
            ProtocolKind::Drum => (0.5 - length / 2.0, length / 2.0 - 0.5, -length),
            ProtocolKind::Cell => (0.0, f64::INFINITY, -BELOW),
            ProtocolKind::Hopper => (0.0, f64::INFINITY, -BELOW),
            ProtocolKind::Shear => (0.5, f64::INFINITY, -2.0 * BELOW - WALL),
            _ => (0.5, f64::INFINITY, -BELOW),
        };
        Self { kind: p.kind, length, width, cell, base, ceiling, lost, below }
    }

    /// Whether a grain with so much room around it lies inside.
    pub fn holds(&self, [x, y, z]: [f64; 3], room: f64) -> bool {
        let [x0, x1, y0, y1] = self.cell;
        let inside = match self.kind {
            ProtocolKind::Funnel | ProtocolKind::Cylinder | ProtocolKind::Hopper => {
                x.hypot(y) <= x1 - room
            }
            // The fixed grains reach in by half a diameter.
            ProtocolKind::Drum => x.hypot(z) <= x1 - 0.5 - room && (y0..=y1).contains(&y),
            // Beyond the edge of a drain lies nothing, but grains may hang over it.
            ProtocolKind::Drain => (x0..=x1 + 0.5).contains(&x) && (y0..=y1).contains(&y),
            ProtocolKind::Tilt | ProtocolKind::Shear | ProtocolKind::Cell => {
                (x0..=x1).contains(&x) && (y0..=y1).contains(&y)
            }
        };
        inside && z > if self.kind == ProtocolKind::Drum { self.lost } else { 0.0 }
    }

    /// What it is and how large, for people.
    pub fn says(&self, p: &Protocol) -> String {
        let d = p.diameter;
        let [x0, x1, y0, y1] = self.cell.map(|c| c * d);
        match self.kind {
            ProtocolKind::Drain | ProtocolKind::Tilt | ProtocolKind::Shear | ProtocolKind::Cell => {
                format!("the box (x from {x0} to {x1}, y from {y0} to {y1} m, z > 0)")
            }
            ProtocolKind::Drum => format!("the drum (radius {x1} m, y from {y0} to {y1} m)"),
            _ => format!("the circle of radius {x1} m about the middle, or below the floor"),
        }
    }

    /// That not all grains fit in.
    pub fn full(&self, p: &Protocol, placed: usize) -> InputError {
        let place = super::TemplatePath::template("repose");
        let [_, within, ..] = self.cell;
        let (what, hint) = match p.kind {
            ProtocolKind::Drum => (
                format!("the drum of {} × {} d", self.length, self.width),
                "take fewer grains, or a larger drum: size=[diameter,length], in d",
            ),
            _ => (
                format!("a circle of {} d", 2.0 * within),
                "take smaller grains, or a larger size, in d",
            ),
        };
        let text = format!("only {placed} of {} grains fit loosely into {what}", p.grains);
        place.error("size", text, hint)
    }

    /// Walls up to `top`, those that are taken away, lifted or pushed, and the lid.
    pub fn walls(
        &self,
        p: &Protocol,
        top: f64,
        random: &mut Random,
    ) -> (Vec<BlockSpec>, Vec<String>, Option<String>) {
        let (d, length, h, w) = (p.diameter, self.length, self.width / 2.0, WALL);
        let (mut walls, mut gates, mut lid) = (Vec::new(), Vec::new(), None);
        match self.kind {
            ProtocolKind::Drain | ProtocolKind::Tilt => {
                // Beyond the edge the side walls go on, so that what flows over it stays between
                // them.
                let mut side = |id: &str, low, high| walls.push(wall(d, id.into(), low, high));
                side("back", [-w, -h - w, -1.0], [0.0, h + w, top]);
                side("right", [-w, -h - w, -1.0], [length + w, -h, top]);
                side("left", [-w, h, -1.0], [length + w, h + w, top]);
                side("gate", [length, -h - w, -1.0], [length + w, h + w, top]);
                if p.kind == ProtocolKind::Drain {
                    gates.push("gate".into());
                }
            }
            ProtocolKind::Cylinder => {
                walls = ring(d, "cylinder", SIDES, self.cell[1], [0.6, top]);
                gates = walls.iter().map(|b| b.id.clone()).collect();
            }
            ProtocolKind::Funnel | ProtocolKind::Cell => {}
            ProtocolKind::Hopper => {
                walls = ring(d, "bin", ROUND, length / 2.0, [-1.0, top]);
                walls.push(wall(d, "plug".into(), [-h, -h, -1.0], [h, h, 0.0]));
                gates.push("plug".into());
            }
            ProtocolKind::Drum => {
                let r = length / 2.0;
                walls = ring(d, "drum", ROUND, r, [-h, h]);
                for side in &mut walls {
                    // From upright to level: z becomes y.
                    let [x, y, z] = side.at;
                    side.at = [x, z, y];
                    let angle = side.rotation_deg.as_ref().map_or(0.0, |r| -r.angle);
                    side.rotation_deg = Some(Rotation { axis: [0.0, 1.0, 0.0], angle });
                    if let Shape::Cuboid { size: [_, across, along] } = &mut side.shape {
                        std::mem::swap(across, along);
                    }
                }
                let r = r + w;
                walls.push(wall(d, "right".into(), [-r, -h - w, -r], [r, -h, r]));
                walls.push(wall(d, "left".into(), [-r, h, -r], [r, h + w, r]));
            }
            ProtocolKind::Shear => {
                // As long as the box may be pushed, so that nothing opens.
                let w = length;
                let (split, high) = (bed_split(p), 2.0 * top + 4.0);
                for (name, [low, high]) in [("lower", [-1.0, split]), ("upper", [split, high])] {
                    let mut side = |id: &str, x: [f64; 2], y: [f64; 2]| {
                        let id = format!("{name}-{id}");
                        if name == "upper" {
                            gates.push(id.clone());
                        }
                        walls.push(wall(d, id, [x[0], y[0], low], [x[1], y[1], high]));
                    };
                    side("back", [-w, 0.0], [-h - w, h + w]);
                    side("front", [length, length + w], [-h - w, h + w]);
                    side("right", [-w, length + w], [-h - w, -h]);
                    side("left", [-w, length + w], [h, h + w]);
                }
                let block = self.lid(p, top, random);
                lid = Some(block.id.clone());
                walls.push(block);
            }
        }
        (walls, gates, lid)
    }

    /// A rough lid as heavy as its pressure wants.
    fn lid(&self, p: &Protocol, top: f64, random: &mut Random) -> BlockSpec {
        let d = p.diameter;
        // Inside the walls: it glides along them without touching.
        let spots = rough(self.cell, LID, random);
        let spheres = spots
            .iter()
            .map(|at| Ball { at: [at[0] * d, at[1] * d, 0.0], radius: 0.5 * d })
            .collect();
        BlockSpec {
            at: [0.0, 0.0, (top + 1.0) * d],
            material: Some("grain".into()),
            mass: Some(p.pressure * p.density * d.powi(3) * self.length * self.width),
            ..BlockSpec::new("lid", Shape::Clump { spheres })
        }
    }
}

/// Grains this far below the floor are gone, d.
const BELOW: f64 = 3.0;

/// The height at which the halves of a shear box meet, d: about the middle of the bed.
pub fn bed_split(p: &Protocol) -> f64 {
    let [length, width] = p.size();
    let volume = p.grains as f64 * PI / 6.0 * p.sizes.mean_volume(p.diameter);
    0.5 + 0.5 * volume / (POURED * length * width)
}

fn ball(id: String, at: [f64; 3], d: f64) -> BlockSpec {
    BlockSpec {
        at: at.map(|c| c * d),
        material: Some("grain".into()),
        ..support(id, Shape::Sphere { radius: 0.5 * d })
    }
}

fn wall(d: f64, id: String, low: [f64; 3], high: [f64; 3]) -> BlockSpec {
    let size = [0, 1, 2].map(|k| (high[k] - low[k]) * d);
    let at = [0, 1, 2].map(|k| 0.5 * (high[k] + low[k]) * d);
    BlockSpec { at, material: Some("wall".into()), ..support(id, Shape::Cuboid { size }) }
}

/// The sides of an upright hollow cylinder.
fn ring(d: f64, name: &str, sides: usize, r: f64, [low, high]: [f64; 2]) -> Vec<BlockSpec> {
    let step = TAU / sides as f64;
    let one = |k: usize| {
        let half = (r + WALL) * (0.5 * step).tan();
        let mut side = wall(d, numbered(name, k, sides), [r, -half, low], [r + WALL, half, high]);
        let angle = step * k as f64;
        let (sin, cos) = angle.sin_cos();
        side.at = [side.at[0] * cos, side.at[0] * sin, side.at[2]];
        side.rotation_deg = Some(Rotation { axis: [0.0, 0.0, 1.0], angle: angle.to_degrees() });
        side
    };
    (0..sides).map(one).collect()
}

/// A flat floor with a round hole, in pieces around it; the hole is a regular polygon of the
/// circle's area.
fn plate(d: f64, bin: f64, orifice: f64) -> Vec<BlockSpec> {
    let step = TAU / ROUND as f64;
    let inner = 0.5 * orifice * (step / step.sin()).sqrt();
    let outer = (0.5 * bin + 1.0) / (0.5 * step).cos();
    let one = |k: usize| {
        let corner = |r: f64, side: usize, z: f64| {
            let (sin, cos) = (step * (k + side) as f64).sin_cos();
            [r * cos * d, r * sin * d, z * d]
        };
        let level = |z: f64| {
            [corner(inner, 0, z), corner(outer, 0, z), corner(outer, 1, z), corner(inner, 1, z)]
        };
        let vertices = [level(-1.0), level(0.0)].concat();
        let faces = [
            vec![3, 2, 1, 0],
            vec![4, 5, 6, 7],
            vec![0, 1, 5, 4],
            vec![1, 2, 6, 5],
            vec![2, 3, 7, 6],
            vec![3, 0, 4, 7],
        ];
        BlockSpec {
            material: Some("grain".into()),
            ..support(
                numbered("floor", k, ROUND),
                Shape::Polyhedron { vertices, faces: faces.to_vec() },
            )
        }
    };
    (0..ROUND).map(one).collect()
}

/// Places of fixed grains on the floor, at random and at least `apart` from each other: a lattice
/// would make the heap crystallise.
fn rough([x0, x1, y0, y1]: [f64; 4], apart: f64, random: &mut Random) -> Vec<[f64; 2]> {
    let tries = (TRIES * (x1 - x0) * (y1 - y0)) as usize;
    let mut cells: std::collections::HashMap<(i64, i64), Vec<[f64; 2]>> = Default::default();
    let key = |p: [f64; 2]| ((p[0] / apart).floor() as i64, (p[1] / apart).floor() as i64);
    let mut list = Vec::new();
    for _ in 0..tries {
        let p = [random.between(x0 + 0.5, x1 - 0.5), random.between(y0 + 0.5, y1 - 0.5)];
        let (i, j) = key(p);
        let near = (-1..=1)
            .flat_map(|a| (-1..=1).map(move |b| (i + a, j + b)))
            .filter_map(|k| cells.get(&k))
            .flatten();
        if near.into_iter().all(|q| (p[0] - q[0]).hypot(p[1] - q[1]) >= apart) {
            cells.entry((i, j)).or_default().push(p);
            list.push(p);
        }
    }
    list
}
