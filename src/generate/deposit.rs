//! Grains before they fall: a rough floor, walls, and loose layers of grains of random sizes above.
//!
//! Everything follows from the seed ([`random`](super::random)).

use super::{check::Place, grain::Grain, numbered, random::Random, support};
use crate::{
    error::InputError,
    scene::{
        BlockSpec, Friction, GrainKind, JointOverride, JointSpec, Material, Protocol, ProtocolKind,
        Scene, Shape,
    },
};
use rand_pcg::{Pcg64, rand_core::SeedableRng};

/// Grains and what holds them, before anything moves.
#[derive(Clone, Debug)]
pub struct Deposit {
    /// The scene: floor and walls are supports.
    pub scene: Scene,
    /// Ids of the walls that are taken away or lifted.
    pub gates: Vec<String>,
    /// Grains by layers, from below.
    pub layers: Vec<Vec<String>>,
}

/// Most grains of one heap: more would take days.
const MOST: usize = 200_000;
/// Most that radii may differ from the mean.
const WIDEST: f64 = 0.9;
/// Distance of grains in the loose layers over the greatest diameter.
const LOOSE: f64 = 1.05;
/// Tries to place a fixed grain on the floor, per d² of floor. Fewer: holes in which a grain lies
/// on the flat ground and rolls at once.
const TRIES: f64 = 80.0;
/// Least distance of fixed grains, in d; they may overlap. Larger: the same holes.
const APART: f64 = 0.7;
/// Walls are so thick, in d: more than a grain passes in a step.
const WALL: f64 = 4.0;
/// Corners that a hull may have. More: contacts of hulls cost time.
const CORNERS: std::ops::RangeInclusive<usize> = 6..=100;
/// The stream of random numbers for shapes, so that places and sizes of grains do not depend on
/// their shapes.
const SHAPES: u128 = 1;
/// Sides of the hollow cylinder.
const SIDES: usize = 16;

/// The grains of a protocol before they fall.
///
/// # Errors
/// A value is out of its range.
pub fn deposit(protocol: &Protocol, seed: u64) -> Result<Deposit, InputError> {
    let p = protocol;
    let place = Place::template("repose");
    place.count("grains", p.grains, 1)?;
    if p.grains > MOST {
        return Err(place.error(
            "grains",
            format!("must be at most {MOST}, got {}", p.grains),
            "the number of free grains",
        ));
    }
    place.length("diameter", p.diameter)?;
    place.length("density", p.density)?;
    place.length("rate", p.rate)?;
    let between = |field: &str, value: f64, most: f64| {
        let hint = "see `voussoir repose --help`";
        if (0.0..=most).contains(&value) {
            Ok(())
        } else {
            Err(place.error(field, format!("must be from 0 to {most}, got {value}"), hint))
        }
    };
    between("sizes", p.sizes, WIDEST)?;
    let longest = if p.grain == GrainKind::Clump { 2.0 } else { 4.0 };
    if !(1.0..=longest).contains(&p.elongation) {
        return Err(place.error(
            "elongation",
            format!("must be from 1 to {longest}, got {}", p.elongation),
            "length over width",
        ));
    }
    if !CORNERS.contains(&p.corners) {
        let text =
            format!("must be from {} to {}, got {}", CORNERS.start(), CORNERS.end(), p.corners);
        return Err(place.error("corners", text, "the number of corners of a hull"));
    }
    between("friction", p.friction, 1e3)?;
    between("wall_friction", p.wall_friction, 1e3)?;
    between("rolling_arm", p.rolling_arm, 1e3)?;
    if p.grain == GrainKind::Hull && p.rolling_arm > 0.0 {
        let text = format!("must be 0 for hulls, got {}", p.rolling_arm);
        return Err(place.error(
            "rolling_arm",
            text,
            "hulls resist rolling by their faces; spheres and clumps take a rolling arm",
        ));
    }
    for (k, s) in p.size().iter().enumerate() {
        if !(4.0..=1e3).contains(s) {
            return Err(InputError::at(
                place.0.key("size").index(k),
                format!("must be from 4 to 1000, got {s}"),
            )
            .hint("in grain diameters"));
        }
    }
    Ok(build(p, &mut Random(Pcg64::seed_from_u64(seed)), seed))
}

fn build(p: &Protocol, random: &mut Random, seed: u64) -> Deposit {
    let d = p.diameter;
    let [length, width] = p.size();
    let mut forms = Random(Pcg64::new(seed.into(), SHAPES));
    let grains: Vec<Grain> = (0..p.grains).map(|_| Grain::new(p, &mut forms)).collect();
    let pitch = LOOSE * (1.0 + p.sizes) * grains.iter().map(|g| g.reach).fold(1.0, f64::max);
    // In diameters: the cell that the loose layers fill, and the floor.
    let heap = 2.0 * (p.grains as f64).cbrt().max(4.0) + 4.0;
    let (cell, floor) = match p.kind {
        ProtocolKind::Drain | ProtocolKind::Tilt => {
            ([0.0, length, -width / 2.0, width / 2.0], [0.0, length, -width / 2.0, width / 2.0])
        }
        ProtocolKind::Funnel | ProtocolKind::Cylinder => {
            let r = length / 4.0;
            ([-r, r, -r, r], [-heap, heap, -heap, heap])
        }
    };
    let wall = |id: String, low: [f64; 3], high: [f64; 3]| {
        let size = [0, 1, 2].map(|k| (high[k] - low[k]) * d);
        let at = [0, 1, 2].map(|k| 0.5 * (high[k] + low[k]) * d);
        BlockSpec { at, material: Some("wall".into()), ..support(id, Shape::Cuboid { size }) }
    };
    let mut blocks = Vec::new();
    // It ends before the outermost fixed grains do: over the edge nothing lies on it.
    let slab =
        wall("floor".into(), [floor[0], floor[2], -0.5 - WALL], [floor[1] - 0.5, floor[3], -0.5]);
    blocks.push(BlockSpec { material: Some("grain".into()), ..slab });
    let spots = rough(floor, random);
    let fixed = spots.iter().enumerate().map(|(i, at)| BlockSpec {
        at: [at[0] * d, at[1] * d, 0.0],
        material: Some("grain".into()),
        ..support(numbered("f", i, spots.len()), Shape::Sphere { radius: 0.5 * d })
    });
    blocks.extend(fixed);

    let count = |low: f64, high: f64| (((high - low) / pitch).floor() as usize).max(1);
    let [nx, ny] = [count(cell[0], cell[1]), count(cell[2], cell[3])];
    let round = matches!(p.kind, ProtocolKind::Funnel | ProtocolKind::Cylinder);
    let (mut layers, mut placed, mut level) = (Vec::new(), 0, 0usize);
    while placed < p.grains {
        let mut layer = Vec::new();
        for (i, j) in (0..nx).flat_map(|i| (0..ny).map(move |j| (i, j))) {
            let spread = |n: usize, k: usize, low: f64, high: f64| {
                low + (high - low) * (k as f64 + 0.5) / n as f64
            };
            let (x, y) = (spread(nx, i, cell[0], cell[1]), spread(ny, j, cell[2], cell[3]));
            if placed == p.grains || (round && x.hypot(y) > cell[1] - 0.5 * pitch) {
                continue;
            }
            let radius = 0.5 * (1.0 + p.sizes * random.between(-1.0, 1.0));
            let grain = &grains[placed];
            let room = 0.5 * pitch - radius * grain.reach;
            let mut near = |c: f64| (c + random.between(-room, room)) * d;
            let at = [near(x), near(y), near(0.5 + pitch * (level as f64 + 0.6))];
            let id = numbered("g", placed, p.grains);
            layer.push(id.clone());
            let (shape, rotation_deg) = grain.of_radius(radius * d);
            blocks.push(BlockSpec {
                at,
                rotation_deg,
                material: Some("grain".into()),
                ..BlockSpec::new(id, shape)
            });
            placed += 1;
        }
        layers.push(layer);
        level += 1;
    }
    let top = 2.0 + pitch * (level as f64 + 2.0);
    let mut gates = Vec::new();
    match p.kind {
        ProtocolKind::Drain | ProtocolKind::Tilt => {
            let (h, w) = (width / 2.0, WALL);
            // Beyond the edge the side walls go on, so that what flows over it stays between them.
            blocks.push(wall("back".into(), [-w, -h - w, -1.0], [0.0, h + w, top]));
            blocks.push(wall("right".into(), [-w, -h - w, -1.0], [length + w, -h, top]));
            blocks.push(wall("left".into(), [-w, h, -1.0], [length + w, h + w, top]));
            blocks.push(wall("gate".into(), [length, -h - w, -1.0], [length + w, h + w, top]));
            if p.kind == ProtocolKind::Drain {
                gates.push("gate".into());
            }
        }
        ProtocolKind::Cylinder => {
            let (r, step) = (cell[1], std::f64::consts::TAU / SIDES as f64);
            for k in 0..SIDES {
                let half = (r + WALL) * (0.5 * step).tan();
                let mut side =
                    wall(numbered("cylinder", k, SIDES), [r, -half, 0.6], [r + WALL, half, top]);
                let angle = step * k as f64;
                let (sin, cos) = angle.sin_cos();
                side.at = [side.at[0] * cos, side.at[0] * sin, side.at[2]];
                side.rotation_deg = Some(crate::scene::Rotation {
                    axis: [0.0, 0.0, 1.0],
                    angle: angle.to_degrees(),
                });
                gates.push(side.id.clone());
                blocks.push(side);
            }
        }
        ProtocolKind::Funnel => {}
    }
    let mut scene = Scene {
        name: format!("{:?} of {} {}, seed {seed}", p.kind, p.grains, p.grain.plural())
            .to_lowercase(),
        blocks,
        ..Scene::default()
    };
    scene.source = format!("voussoir repose --question repose, seed {seed}");
    for name in ["grain", "wall"] {
        scene.materials.insert(name.into(), Material::of_density(p.density));
    }
    let arm = (p.rolling_arm > 0.0).then_some(p.rolling_arm * d);
    scene.joints.default = JointSpec {
        friction: Some(Friction::Coefficient(p.friction)),
        rolling_arm: arm,
        ..JointSpec::default()
    };
    scene.joints.overrides.push(JointOverride {
        between: Some(["grain".into(), "wall".into()]),
        blocks: None,
        friction: Some(Friction::Coefficient(p.wall_friction)),
        friction_angle_deg: None,
        cohesion: None,
        tension: None,
        compression: None,
        pore_pressure: None,
        rolling_arm: Some(0.0),
        normal_stiffness: None,
        shear_stiffness: None,
    });
    Deposit { scene, gates, layers }
}

/// Places of fixed grains on the floor, at random and at least [`APART`] from each other: a lattice
/// would make the heap crystallise.
fn rough([x0, x1, y0, y1]: [f64; 4], random: &mut Random) -> Vec<[f64; 2]> {
    let tries = (TRIES * (x1 - x0) * (y1 - y0)) as usize;
    let mut cells: std::collections::HashMap<(i64, i64), Vec<[f64; 2]>> = Default::default();
    let key = |p: [f64; 2]| ((p[0] / APART).floor() as i64, (p[1] / APART).floor() as i64);
    let mut list = Vec::new();
    for _ in 0..tries {
        let p = [random.between(x0 + 0.5, x1 - 0.5), random.between(y0 + 0.5, y1 - 0.5)];
        let (i, j) = key(p);
        let near = (-1..=1)
            .flat_map(|a| (-1..=1).map(move |b| (i + a, j + b)))
            .filter_map(|k| cells.get(&k))
            .flatten();
        if near.into_iter().all(|q| (p[0] - q[0]).hypot(p[1] - q[1]) >= APART) {
            cells.entry((i, j)).or_default().push(p);
            list.push(p);
        }
    }
    list
}
