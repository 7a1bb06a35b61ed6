//! Random scenes: walls, arches, domes, flat arches, stacks, cairns and heaps of spheres, then
//! perturbed.
//!
//! Scene *i* depends on (seed, *i*) alone. Perturbations are drawn over decades, so that some are
//! far below what a contact tolerance closes, some near it, and some leave blocks in the air.

use super::{super::random::Random, Perturbation};
use base::error::InputError;
use nalgebra::{Unit, UnitQuaternion, Vector3};
use scene::{
    BlockSpec, Friction, Load, Material, Rotation, Scene, Shape, Template,
    generate::expand,
    template::{Arch, Dome, FlatArch, Lattice, Packing, Wall, WallBase, WallEnd},
};
/// The kinds of structures, in the order of the table.
pub const FAMILIES: [&str; 7] = ["wall", "arch", "dome", "flat arch", "stack", "cairn", "heap"];

/// A named material, for all blocks.
const STONE: &str = "stone";

/// Scene number `index` of the soak `seed`, its family and its perturbations.
///
/// # Errors
/// A template refused its values, which would be a mistake in this file.
pub fn scene(
    seed: u64,
    index: usize,
) -> Result<(Scene, &'static str, Vec<Perturbation>), InputError> {
    let random = &mut Random::of(seed, index);
    let family = FAMILIES[index % FAMILIES.len()];
    let blocks = blocks(family, random)?;
    let mut scene =
        Scene { name: format!("soak {seed}/{index}: {family}"), blocks, ..Scene::default() };
    scene.joints.default.friction = Some(Friction::Coefficient(random.between(0.1, 0.9)));
    scene.materials.insert(STONE.into(), Material::of_density(random.decades(1.0, 4.0)));
    scene.blocks.iter_mut().for_each(|b| b.material = Some(STONE.into()));
    let perturbations = perturb(&mut scene, random);
    Ok((scene, family, perturbations))
}

fn blocks(family: &str, random: &mut Random) -> Result<Vec<BlockSpec>, InputError> {
    let template = match family {
        "wall" => Template::Wall(Wall {
            size: [1.0, random.between(0.3, 1.0), random.between(0.3, 0.8)],
            courses: random.count(2, 7),
            blocks: random.count(2, 6),
            first: if random.chance(0.5) { WallEnd::Whole } else { WallEnd::Half },
            base: if random.chance(0.5) { WallBase::Slab } else { WallBase::Course },
            ..Wall::default()
        }),
        "arch" => Template::Arch(Arch {
            radius: Some(1.0),
            thickness: random.between(0.06, 0.25),
            depth: random.between(0.2, 1.0),
            embrace_deg: Some(random.between(100.0, 180.0)),
            voussoirs: random.count(5, 25),
            ..Arch::default()
        }),
        "dome" => Template::Dome(Dome {
            radius: 1.0,
            thickness: random.between(0.05, 0.2),
            rings: random.count(2, 4),
            segments: random.count(5, 9),
            ..Dome::default()
        }),
        "flat arch" => Template::FlatArch(FlatArch {
            span: 1.0,
            height: random.between(0.15, 0.5),
            depth: random.between(0.2, 0.5),
            voussoirs: 2 * random.count(1, 5) + 1,
            center_depth: Some(random.between(0.5, 2.0)),
            ..FlatArch::default()
        }),
        "heap" => Template::Lattice(Lattice {
            packing: [Packing::Fcc, Packing::Square, Packing::Triangular, Packing::Bed]
                [random.count(0, 3)],
            radius: 0.5,
            layers: random.count(2, 4),
            ..Lattice::default()
        }),
        "stack" => return Ok(pile(random, |_| 0.0)),
        _ => return Ok(pile(random, |random| random.between(0.0, 360.0))),
    };
    expand(&template)
}

/// Boxes on one another, each pushed off the middle of the one below and turned about the vertical
/// by `turn`.
fn pile(random: &mut Random, turn: impl Fn(&mut Random) -> f64) -> Vec<BlockSpec> {
    let cuboid = |size: [f64; 3]| Shape::Cuboid { size };
    let mut list = vec![BlockSpec {
        support: true,
        at: [0.0, 0.0, -0.25],
        ..BlockSpec::new("base", cuboid([2.0, 2.0, 0.5]))
    }];
    let off = random.between(0.0, 0.3);
    let (mut x, mut y, mut z) = (0.0, 0.0, 0.0);
    for k in 0..random.count(2, 12) {
        let size = [random.between(0.4, 1.0), random.between(0.4, 1.0), random.between(0.1, 0.6)];
        x += off * random.between(-1.0, 1.0);
        y += off * random.between(-1.0, 1.0);
        let angle = turn(random);
        let rotation_deg = (angle != 0.0).then_some(Rotation { axis: [0.0, 0.0, 1.0], angle });
        list.push(BlockSpec {
            at: [x, y, z + size[2] / 2.0],
            rotation_deg,
            ..BlockSpec::new(format!("b{k:02}"), cuboid(size))
        });
        z += size[2];
    }
    list
}

fn perturb(scene: &mut Scene, random: &mut Random) -> Vec<Perturbation> {
    let mut done = Vec::new();
    if random.chance(0.3) {
        done.push(Perturbation::Gaps);
        let size = random.decades(-8.0, -2.0);
        for block in scene.blocks.iter_mut().filter(|b| !b.support) {
            let by = random.vector() * size;
            block.at = (Vector3::from(block.at) + by).into();
        }
    }
    if random.chance(0.3) {
        done.push(Perturbation::Rotations);
        let size = random.decades(-8.0, -2.0);
        for block in scene.blocks.iter_mut().filter(|b| !b.support) {
            let axis = Unit::new_normalize(random.vector() + Vector3::new(0.0, 0.0, 1e-3));
            rotate(block, &UnitQuaternion::from_axis_angle(&axis, size));
        }
    }
    if random.chance(0.3) {
        done.push(Perturbation::Missing);
        for _ in 0..random.count(1, 3) {
            let free: Vec<usize> =
                (0..scene.blocks.len()).filter(|&i| !scene.blocks[i].support).collect();
            if free.len() > 1 {
                scene.blocks.remove(free[random.count(0, free.len() - 1)]);
            }
        }
    }
    if random.chance(0.5) {
        done.push(Perturbation::Pushed);
        let angle = random.between(0.0, std::f64::consts::TAU);
        let by = random.between(0.0, 0.5);
        scene.loads.dead.push(Load {
            weight: Some([by * angle.cos(), by * angle.sin(), 0.0]),
            ..Load::default()
        });
    }
    if random.chance(0.3) {
        done.push(Perturbation::Uneven);
        for block in &mut scene.blocks {
            block.material = None;
            block.density = Some(random.decades(2.0, 5.0));
        }
    }
    if random.chance(0.3) {
        done.push(Perturbation::Moved);
        let turn = UnitQuaternion::from_axis_angle(
            &Vector3::z_axis(),
            random.between(0.0, std::f64::consts::TAU),
        );
        let (scale, by) = (random.decades(-3.0, 3.0), random.vector() * 100.0);
        for block in &mut scene.blocks {
            let at = turn * Vector3::from(block.at);
            turn_shape(block, &turn);
            grow(&mut block.shape, scale);
            block.at = ((at + by) * scale).into();
        }
        for load in &mut scene.loads.dead {
            load.weight = load.weight.map(|w| (turn * Vector3::from(w)).into());
        }
    }
    done
}

/// Turns a block about its own middle.
fn rotate(block: &mut BlockSpec, turn: &UnitQuaternion<f64>) {
    let middle = match &block.shape {
        Shape::Polyhedron { vertices, .. } => {
            let sum: Vector3<f64> = vertices.iter().map(|v| Vector3::from(*v)).sum();
            sum / vertices.len().max(1) as f64
        }
        _ => Vector3::zeros(),
    };
    let own = rotation(block);
    let (before, after) = (own * middle, turn * (own * middle));
    block.at = (Vector3::from(block.at) + before - after).into();
    turn_shape(block, turn);
}

fn rotation(block: &BlockSpec) -> UnitQuaternion<f64> {
    block.rotation_deg.as_ref().map_or(UnitQuaternion::identity(), |r| {
        UnitQuaternion::from_axis_angle(&Unit::new_normalize(r.axis.into()), r.angle.to_radians())
    })
}

/// Turns a block about the origin of its frame.
fn turn_shape(block: &mut BlockSpec, turn: &UnitQuaternion<f64>) {
    let all = turn * rotation(block);
    block.rotation_deg = all.axis_angle().map(|(axis, angle)| Rotation {
        axis: axis.into_inner().into(),
        angle: angle.to_degrees(),
    });
}

fn grow(shape: &mut Shape, by: f64) {
    match shape {
        Shape::Cuboid { size } => size.iter_mut().for_each(|x| *x *= by),
        Shape::Polyhedron { vertices, .. } => vertices.iter_mut().flatten().for_each(|x| *x *= by),
        Shape::Prism { polygon, depth } => {
            polygon.iter_mut().flatten().for_each(|x| *x *= by);
            *depth *= by;
        }
        Shape::Mesh { scale, .. } => *scale *= by,
        Shape::Sphere { radius } => *radius *= by,
        Shape::Plane { .. } => {}
        Shape::Clump { spheres } => {
            for ball in spheres {
                ball.at.iter_mut().for_each(|x| *x *= by);
                ball.radius *= by;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashMap;

    #[test]
    fn a_scene_depends_on_its_number_alone_and_can_be_read() {
        let mut seen: HashMap<&str, usize> = HashMap::new();
        for index in 0..70 {
            let (one, family, perturbations) = scene(3, index).unwrap();
            assert_eq!(scene(3, index).unwrap().0, one);
            assert_ne!(scene(4, index).unwrap().0, one);
            let text = serde_json::to_string(&one).unwrap();
            assert_eq!(scene::read_str("soak", text).unwrap().0, one);
            *seen.entry(family).or_default() += 1;
            assert!(perturbations.len() <= 6);
        }
        assert!(FAMILIES.iter().all(|f| seen[f] == 10));
    }

    #[test]
    fn moving_a_scene_keeps_its_verdict() {
        // A stack turned, moved and grown as a whole is the same stack.
        use analysis::{Control, assess};
        use model::interface::prepare;
        let verdict = |scene: &Scene| {
            let m = prepare(scene).unwrap();
            assess(&m, &Control::default()).verdict
        };
        let mut compared = 0;
        for index in 0..140 {
            let (scene, _, perturbations) = scene(9, index).unwrap();
            if perturbations == [Perturbation::Moved] {
                let mut still = scene.clone();
                let first = rotation(&scene.blocks[0]);
                if scene.blocks.iter().all(|b| b.rotation_deg.is_some()) {
                    for block in &mut still.blocks {
                        let at = first.inverse() * Vector3::from(block.at);
                        turn_shape(block, &first.inverse());
                        block.at = at.into();
                    }
                    assert_eq!(verdict(&still), verdict(&scene), "{}", scene.name);
                    compared += 1;
                }
            }
        }
        assert!(compared > 2, "{compared}");
    }
}
