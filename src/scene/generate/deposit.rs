//! Grains before they fall: a rough floor, walls, and loose layers of grains of random sizes above.
//!
//! Everything follows from the seed ([`random`](super::random)).

mod vessel;

use super::{check::TemplatePath, grain::Grain, numbered, random::Random};
use crate::{
    BlockSpec, Friction, GrainKind, JointOverride, JointSpec, Material, Protocol, ProtocolKind,
    Scene,
};
use base::{error::InputError, number::short};
use rand_pcg::{Pcg64, rand_core::SeedableRng};
pub use vessel::bed_split;
use vessel::{Vessel, pitch};

/// Grains and what holds them, before anything moves.
#[derive(Clone, Debug)]
pub struct Deposit {
    /// The scene: floor and walls are supports.
    pub scene: Scene,
    /// Ids of the walls that are taken away, lifted or pushed.
    pub gates: Vec<String>,
    /// The lid of a shear box, a free block.
    pub lid: Option<String>,
    /// Grains by layers, from below.
    pub layers: Vec<Vec<String>>,
    /// Grains below this height have fallen out, m.
    pub lost: f64,
    /// The edges of a cell that repeats itself, m.
    pub cell: Option<[f64; 3]>,
}

/// Most grains of one heap: more would take days.
const MOST: usize = 200_000;
/// Fewest grains of a cell. Fewer: it is narrower than three grains, and one meets another and its
/// image.
const FEWEST: usize = 200;
/// Least and greatest stiffness of a cell. Less: grains overlap by a tenth. More: steps are too short
/// for any answer.
const STIFFNESS: (f64, f64) = (20.0, 1e6);
/// Corners that a hull may have. More: contacts of hulls cost time.
const CORNERS: std::ops::RangeInclusive<usize> = 6..=100;
/// The stream of random numbers for shapes, so that places and sizes of grains do not depend on
/// their shapes.
const SHAPES: u128 = 1;

/// The grains of a protocol before they fall.
///
/// # Errors
/// A value is out of its range; the grains do not fit into the drum.
pub fn deposit(protocol: &Protocol, seed: u64) -> Result<Deposit, InputError> {
    check(protocol)?;
    build(protocol, None, seed)
}

/// Grains of one's own in what the protocol holds them with: these lie where they lie, whatever the
/// protocol says of their number, sizes and shapes.
///
/// # Errors
/// As [`deposit`]; a grain lies outside.
pub fn filled(protocol: &Protocol, own: &[BlockSpec], seed: u64) -> Result<Deposit, InputError> {
    check(protocol)?;
    if protocol.kind == ProtocolKind::Cell {
        let text = "a cell takes no grains of one's own: it repeats itself, they do not";
        let hint = "remove --start, or shear them in a box: protocol shear";
        return Err(InputError::at(Default::default(), text).hint(hint));
    }
    build(protocol, Some(own), seed)
}

/// Refuses values out of their range.
fn check(p: &Protocol) -> Result<(), InputError> {
    let place = TemplatePath::template("repose");
    place.count("grains", p.grains, 1)?;
    if p.grains > MOST {
        return Err(place.error(
            "grains",
            format!("must be at most {MOST}, got {}", p.grains),
            "the number of free grains",
        ));
    }
    place.length("diameter", p.diameter)?;
    let positive = |field: &str, value: f64, unit: &str| match value.is_finite() && value > 0.0 {
        true => Ok(()),
        false => Err(place.error(field, format!("must be > 0, got {value}"), unit)),
    };
    positive("density", p.density, "kg/m³")?;
    positive("rate", p.rate(), "√(g d), or degrees per √(d/g) of a drum or a bed that is tilted")?;
    if matches!(p.kind, ProtocolKind::Shear | ProtocolKind::Cell) {
        let hint =
            "what presses on the grains of a shear box or a cell, in ρ g d; 10 is the default";
        positive("pressure", p.pressure, hint)?;
    }
    if p.kind == ProtocolKind::Cell {
        cell(p, &place)?;
    }
    let between = |field: &str, value: f64, most: f64| {
        let hint = "see `voussoir repose --help`";
        if (0.0..=most).contains(&value) {
            Ok(())
        } else {
            Err(place.error(field, format!("must be from 0 to {most}, got {value}"), hint))
        }
    };
    p.sizes.check().map_err(|e| e.under(&place.0))?;
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
    between("restitution", p.restitution, 1.0)?;
    between("pressure", p.pressure, 1e3)?;
    between("drop", p.drop, 1e3)?;
    if p.grain == GrainKind::Hull && p.rolling_arm > 0.0 {
        let text = format!("must be 0 for hulls, got {}", p.rolling_arm);
        return Err(place.error(
            "rolling_arm",
            text,
            "hulls resist rolling with their faces; only spheres and clumps have a rolling arm",
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
    if p.kind == ProtocolKind::Hopper && p.size()[1] >= p.size()[0] {
        let [bin, orifice] = p.size();
        let text = format!("the orifice must be smaller than the bin, got {orifice} of {bin}");
        return Err(place.error("size", text, "[diameter of the bin, of the orifice], in d"));
    }
    Ok(())
}

/// Refuses what no cell takes.
fn cell(p: &Protocol, place: &TemplatePath) -> Result<(), InputError> {
    if p.grain != GrainKind::Sphere {
        let text = format!("must be sphere in a cell, got {}", p.grain.plural());
        return Err(place.error("grain", text, "only spheres are sheared in periodic cells"));
    }
    if p.grains < FEWEST {
        let text = format!("must be at least {FEWEST} in a cell, got {}", p.grains);
        return Err(place.error("grains", text, "with fewer, grains meet their own images"));
    }
    if p.size.is_some() {
        let hint = "remove size=…: the edges follow from the pressure";
        return Err(place.error("size", "a cell finds its own size", hint));
    }
    if !(STIFFNESS.0..=STIFFNESS.1).contains(&p.stiffness) {
        let (low, high) = STIFFNESS;
        let text = format!("must be from {low} to {high}, got {}", p.stiffness);
        return Err(place.error(
            "stiffness",
            text,
            "(E / ((1 − ν²) P))^(2/3); 1000 is the default",
        ));
    }
    Ok(())
}

fn build(p: &Protocol, own: Option<&[BlockSpec]>, seed: u64) -> Result<Deposit, InputError> {
    let random = &mut Random(Pcg64::seed_from_u64(seed));
    let vessel = Vessel::new(p, random);
    let mut blocks = vessel.below.clone();
    let (layers, top) = match own {
        Some(own) => lie(p, &vessel, own, &mut blocks)?,
        None => loose(p, &vessel, seed, random, &mut blocks)?,
    };
    let (walls, gates, lid) = vessel.walls(p, top, random);
    blocks.extend(walls);
    let kind = serde_json::to_value(p.kind).ok().and_then(|v| v.as_str().map(str::to_string));
    let count = layers.iter().map(Vec::len).sum::<usize>();
    let mut scene = Scene {
        name: format!("{} of {count} {}, seed {seed}", kind.unwrap_or_default(), p.grain.plural()),
        blocks,
        ..Scene::default()
    };
    scene.source = format!("voussoir repose --question repose, seed {seed}");
    for name in ["grain", "wall"] {
        scene.materials.insert(name.into(), Material::of_density(p.density));
    }
    let arm = (p.rolling_arm > 0.0).then_some(p.rolling_arm * p.diameter);
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
    let cell = (p.kind == ProtocolKind::Cell).then(|| {
        let side = vessel.cell[1];
        [side, side, layers.len() as f64 * pitch(p, 1.0)].map(|edge| edge * p.diameter)
    });
    Ok(Deposit { scene, gates, lid, layers, lost: vessel.lost * p.diameter, cell })
}

/// Loose layers of grains, and the height that they need, d.
fn loose(
    p: &Protocol,
    vessel: &Vessel,
    seed: u64,
    random: &mut Random,
    blocks: &mut Vec<BlockSpec>,
) -> Result<(Vec<Vec<String>>, f64), InputError> {
    let d = p.diameter;
    let mut forms = Random(Pcg64::new(seed.into(), SHAPES));
    let grains: Vec<Grain> = (0..p.grains).map(|_| Grain::new(p, &mut forms)).collect();
    let reach = grains.iter().map(|g| g.reach).fold(1.0, f64::max);
    let pitch = pitch(p, reach);
    if p.kind == ProtocolKind::Funnel && p.drop < pitch {
        let text = format!("must be at least {}, got {}", short(pitch), p.drop);
        let hint =
            "height above the highest grain, in d, at which the next grains start clear of it";
        return Err(TemplatePath::template("repose").error("drop", text, hint));
    }
    let count = |low: f64, high: f64| (((high - low) / pitch).floor() as usize).max(1);
    let [x0, x1, y0, y1] = vessel.cell;
    let [mut nx, mut ny] = [count(x0, x1), count(y0, y1)];
    let (mut layers, mut placed, mut level) = (Vec::new(), 0, 0usize);
    while placed < p.grains {
        let z = vessel.base + pitch * (level as f64 + 0.6);
        if z > vessel.ceiling - 0.5 * pitch {
            return Err(vessel.full(p, placed));
        }
        let mut layer = Vec::new();
        for (i, j) in (0..nx).flat_map(|i| (0..ny).map(move |j| (i, j))) {
            let spread = |n: usize, k: usize, low: f64, high: f64| {
                low + (high - low) * (k as f64 + 0.5) / n as f64
            };
            let (x, y) = (spread(nx, i, x0, x1), spread(ny, j, y0, y1));
            if placed == p.grains || !vessel.holds([x, y, z], 0.5 * pitch) {
                continue;
            }
            let radius = 0.5 * p.sizes.diameter(d, random.unit());
            let grain = &grains[placed];
            let room = 0.5 * pitch - radius * grain.reach;
            let mut near = |c: f64| (c + random.between(-room, room)) * d;
            let at = [near(x), near(y), near(z)];
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
        if layer.is_empty() && vessel.ceiling.is_infinite() {
            if nx.max(ny) == 1 {
                return Err(vessel.full(p, placed));
            }
            // A coarser grid has its middle in a circle that this one misses.
            [nx, ny] = [nx, ny].map(|n| (n - 1).max(1));
            continue;
        }
        layers.push(layer);
        level += 1;
    }
    Ok((layers, 2.0 + pitch * (level as f64 + 2.0)))
}

/// Grains of one's own as one layer, and the height that they need, d.
fn lie(
    p: &Protocol,
    vessel: &Vessel,
    own: &[BlockSpec],
    blocks: &mut Vec<BlockSpec>,
) -> Result<(Vec<Vec<String>>, f64), InputError> {
    if own.is_empty() {
        return Err(InputError::at(
            Default::default(),
            "the scene has no free grain to start with",
        )
        .hint("the protocol uses its own supports, not those of the scene"));
    }
    let (mut layer, mut top) = (Vec::with_capacity(own.len()), 0.0_f64);
    for block in own {
        let at = block.at.map(|c| c / p.diameter);
        if !vessel.holds(at, 0.0) {
            let [x, y, z] = block.at;
            return Err(InputError::at(
                Default::default(),
                format!("grain {:?} at ({x}, {y}, {z}) lies outside {}", block.id, vessel.says(p)),
            )
            .hint("give size=[…], in d, or move the grains"));
        }
        top = top.max(at[2]);
        // Supports are named f…, wall and the like.
        let id = if blocks.iter().any(|b| b.id == block.id) {
            format!("own-{}", block.id)
        } else {
            block.id.clone()
        };
        layer.push(id.clone());
        blocks.push(BlockSpec {
            id,
            support: false,
            material: Some("grain".into()),
            density: None,
            mass: None,
            ..block.clone()
        });
    }
    Ok((vec![layer], top + 5.0))
}
