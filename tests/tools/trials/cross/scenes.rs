//! The scenes: those of the soak, and some in which friction decides what the loads produce: wedges
//! between two planes of rock, blocks in a groove, blocks squeezed between posts. All have a live
//! load; some joints have strengths.

use crate::{random::Random, soak};
use base::error::InputError;
use nalgebra::Vector3;
use scene::{BlockSpec, Friction, JointOverride, Load, Material, Scene, Shape};

/// The kinds of structures, in the order of the table.
pub const FAMILIES: [&str; 10] =
    ["wall", "arch", "dome", "flat arch", "stack", "cairn", "heap", "wedge", "groove", "squeezed"];

/// Scene number `index` of the stream `seed`, and its family.
///
/// # Errors
/// A template refused its values, which would be a mistake in the generator.
pub fn scene(seed: u64, index: usize) -> Result<(Scene, &'static str), InputError> {
    let (round, place) = (index / FAMILIES.len(), index % FAMILIES.len());
    let family = FAMILIES[place];
    let random = &mut Random::apart(seed, index);
    let mut scene = match family {
        "wedge" => wedge(random),
        "groove" => groove(random),
        "squeezed" => squeezed(random),
        _ => soak::scene(seed, round * soak::FAMILIES.len() + place)?.0,
    };
    scene.name = format!("cross {seed}/{index}: {family}");
    one_by_one(&mut scene);
    let angle = random.between(0.0, std::f64::consts::TAU);
    let along = [angle.cos(), angle.sin(), random.between(-0.3, 0.1)];
    let free: Vec<String> =
        scene.blocks.iter().filter(|b| !b.support).map(|b| b.id.clone()).collect();
    // The weight of all blocks, or a multiple of that of one.
    let pushed = if random.chance(0.7) || free.is_empty() {
        free
    } else {
        vec![free[random.count(0, free.len() - 1)].clone()]
    };
    scene.loads.live = pushed
        .into_iter()
        .map(|id| Load { block: Some(id), weight: Some(along), ..Load::default() })
        .collect();
    if family != "heap" && random.chance(0.1) {
        strengthen(&mut scene, random);
    }
    Ok((scene, family))
}

/// Names the blocks of loads on all blocks, so that others can be added without being loaded.
fn one_by_one(scene: &mut Scene) {
    let free: Vec<String> =
        scene.blocks.iter().filter(|b| !b.support).map(|b| b.id.clone()).collect();
    let named = |load: &Load| match load.block {
        Some(_) => vec![load.clone()],
        None => free.iter().map(|id| Load { block: Some(id.clone()), ..load.clone() }).collect(),
    };
    scene.loads.dead = scene.loads.dead.iter().flat_map(named).collect();
}

/// Cohesion, tension and crushing of the size that the weight of the scene presses with.
fn strengthen(scene: &mut Scene, random: &mut Random) {
    let (low, high) = extent(scene);
    let density = scene
        .materials
        .values()
        .map(|m| m.density)
        .chain(scene.blocks.iter().filter_map(|b| b.density))
        .fold(0.0, f64::max);
    let pressure = density * 9.81 * (high - low).norm();
    let joint = &mut scene.joints.default;
    joint.cohesion = Some(pressure * random.decades(-3.0, -1.0));
    joint.tension = Some(pressure * random.decades(-4.0, -2.0));
    joint.compression = random.chance(0.5).then(|| pressure * random.decades(0.0, 2.0));
}

/// The corners of a box around all blocks. Blocks turn about the origins of their frames, which
/// their distance from it allows for.
pub fn extent(scene: &Scene) -> (Vector3<f64>, Vector3<f64>) {
    let mut low = Vector3::repeat(f64::INFINITY);
    let mut high = -low;
    for block in &scene.blocks {
        let reach = |points: &mut dyn Iterator<Item = f64>| points.fold(0.0, f64::max);
        let far = |p: &[f64; 3]| Vector3::from(*p).norm();
        let reach = match &block.shape {
            Shape::Cuboid { size } => 0.5 * far(size),
            Shape::Prism { polygon, depth } => {
                reach(&mut polygon.iter().map(|p| p[0].hypot(p[1]).hypot(0.5 * depth)))
            }
            Shape::Polyhedron { vertices, .. } => reach(&mut vertices.iter().map(far)),
            Shape::Mesh { vertices, scale, .. } => scale * reach(&mut vertices.iter().map(far)),
            Shape::Sphere { radius } => *radius,
            Shape::Plane { .. } => 0.0,
            Shape::Clump { spheres } => reach(&mut spheres.iter().map(|s| far(&s.at) + s.radius)),
        };
        let at = Vector3::from(block.at);
        low = low.inf(&at.add_scalar(-reach));
        high = high.sup(&at.add_scalar(reach));
    }
    (low, high)
}

fn empty(friction: f64, density: f64) -> Scene {
    let mut scene = Scene::default();
    scene.joints.default.friction = Some(Friction::Coefficient(friction));
    scene.materials.insert("stone".into(), Material::of_density(density));
    scene
}

fn support(block: BlockSpec) -> BlockSpec {
    BlockSpec { support: true, ..block }
}

fn stone(block: BlockSpec) -> BlockSpec {
    BlockSpec { material: Some("stone".into()), ..block }
}

/// A tetrahedron of rock on two planes that meet in a line which plunges to its toe (Hoek & Bray,
/// Rock Slope Engineering).
fn wedge(random: &mut Random) -> Scene {
    let mut near = |p: [f64; 3]| Vector3::from(p) + random.vector() * 0.25;
    let (toe, line, left, right) =
        (Vector3::zeros(), near([-0.2, 3.0, 1.7]), near([-1.4, 0.8, 1.5]), near([1.2, 0.7, 1.6]));
    let plain = |v: Vector3<f64>| -> [f64; 3] { v.into() };
    let mut scene = empty(random.between(0.2, 0.9), random.decades(1.0, 4.0));
    // Rock behind a face, as thick as half a metre.
    let rock = |id: &str, side: Vector3<f64>, other: Vector3<f64>| {
        let normal = line.cross(&side).normalize();
        let out = normal * (-0.5 * normal.dot(&other).signum());
        let vertices = [toe, line, side, toe + out, line + out, side + out].map(plain).to_vec();
        let faces = vec![
            vec![2, 1, 0],
            vec![3, 4, 5],
            vec![0, 1, 4, 3],
            vec![1, 2, 5, 4],
            vec![2, 0, 3, 5],
        ];
        support(BlockSpec::new(id, Shape::Polyhedron { vertices, faces }))
    };
    let faces = vec![vec![0, 2, 1], vec![0, 1, 3], vec![0, 3, 2], vec![1, 2, 3]];
    let vertices = [toe, line, left, right].map(plain).to_vec();
    scene.blocks = vec![
        rock("left", left, right),
        rock("right", right, left),
        stone(BlockSpec::new("wedge", Shape::Polyhedron { vertices, faces })),
    ];
    let exception = |side: &str, mu: f64| JointOverride {
        between: None,
        blocks: Some([side.into(), "wedge".into()]),
        friction: Some(Friction::Coefficient(mu)),
        friction_angle_deg: None,
        cohesion: None,
        tension: None,
        compression: None,
        pore_pressure: None,
        rolling_arm: None,
        normal_stiffness: None,
        shear_stiffness: None,
    };
    scene.joints.overrides = vec![
        exception("left", random.between(0.1, 0.9)),
        exception("right", random.between(0.1, 0.9)),
    ];
    scene
}

/// Blocks one behind the other in a groove with the shape of a V, and perhaps some more on top of
/// them.
fn groove(random: &mut Random) -> Scene {
    let mut scene = empty(random.between(0.15, 0.95), random.decades(1.0, 4.0));
    let steep = random.between(0.5, 2.0);
    let (count, depth) = (random.count(1, 3), random.between(0.5, 3.0));
    let long = depth * count as f64 + 1.0;
    let prism = |id: String, polygon: Vec<[f64; 2]>, depth: f64| {
        BlockSpec::new(id, Shape::Prism { polygon, depth })
    };
    scene.blocks = vec![
        support(prism("left".into(), vec![[-2.0, 0.0], [0.0, 0.0], [-2.0, 2.0 * steep]], long)),
        support(prism("right".into(), vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0 * steep]], long)),
    ];
    let (foot, top) = (random.between(0.1, 0.4), random.between(0.6, 1.2));
    for k in 0..count {
        let y = depth * (k as f64 - 0.5 * (count - 1) as f64);
        let polygon = vec![
            [-foot, foot * steep],
            [foot, foot * steep],
            [top, top * steep],
            [-top, top * steep],
        ];
        let block = prism(format!("b{k}"), polygon, depth);
        scene.blocks.push(stone(BlockSpec { at: [0.0, y, 0.0], ..block }));
        if random.chance(0.4) {
            let size = [random.between(0.3, 1.0) * top, 0.8 * depth, random.between(0.2, 1.0)];
            let at = [random.between(-0.3, 0.3) * top, y, top * steep + 0.5 * size[2]];
            scene.blocks.push(stone(BlockSpec {
                at,
                ..BlockSpec::new(format!("t{k}"), Shape::Cuboid { size })
            }));
        }
    }
    scene
}

/// Blocks in a row between two posts, some with a floor below the first, some with a block on top.
fn squeezed(random: &mut Random) -> Scene {
    let mut scene = empty(random.between(0.1, 1.2), random.decades(1.0, 4.0));
    let cuboid = |id: String, size: [f64; 3], at: [f64; 3]| BlockSpec {
        at,
        ..BlockSpec::new(id, Shape::Cuboid { size })
    };
    let (height, depth) = (random.between(0.3, 1.0), random.between(0.3, 1.0));
    let mut x = 0.0;
    for k in 0..random.count(1, 4) {
        let (width, drop) = (random.between(0.2, 0.8), random.between(-0.2, 0.2) * height);
        let drop = if k == 0 { 0.0 } else { drop };
        scene.blocks.push(stone(cuboid(
            format!("b{k}"),
            [width, depth, height],
            [x + 0.5 * width, 0.0, drop],
        )));
        if random.chance(0.2) {
            let size = [0.6 * width, 0.6 * depth, 0.5 * height];
            scene.blocks.push(stone(cuboid(
                format!("t{k}"),
                size,
                [x + 0.5 * width, 0.0, drop + 0.75 * height],
            )));
        }
        x += width;
    }
    for (id, x) in [("left", -0.25), ("right", x + 0.25)] {
        scene.blocks.push(support(cuboid(
            id.into(),
            [0.5, 2.0 * depth, 4.0 * height],
            [x, 0.0, 0.0],
        )));
    }
    if random.chance(0.4) {
        let size = [0.1, depth, 0.2];
        scene.blocks.push(support(cuboid("floor".into(), size, [0.05, 0.0, -0.5 * height - 0.1])));
    }
    scene
}

#[cfg(test)]
mod tests {
    use super::*;
    use model::interface::prepare;

    #[test]
    fn a_scene_depends_on_its_number_alone_and_can_be_asked() {
        for index in 0..60 {
            let (one, family) = scene(5, index).unwrap();
            assert_eq!(scene(5, index).unwrap().0, one);
            assert_ne!(scene(6, index).unwrap().0, one);
            assert_eq!(family, FAMILIES[index % 10]);
            let text = serde_json::to_string(&one).unwrap();
            assert_eq!(scene::read_str("cross", text).unwrap().0, one);
            assert!(one.loads.live.iter().chain(&one.loads.dead).all(|l| l.block.is_some()));
            let model = prepare(&one).unwrap_or_else(|e| panic!("{}: {e}", one.name));
            if index % 10 > 6 {
                assert!(model.interfaces.list.len() > 1, "{}", one.name);
            }
        }
    }
}
