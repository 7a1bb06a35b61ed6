//! Random scenes whose blocks meet at edges and corners: planks that lean on each other, houses of
//! cards, shores, squares in grooves, stones held at their corners, tripods.

use super::super::random::Random;
use base::{error::InputError, plane::polygon};
use nalgebra::{Rotation3, Vector2, Vector3};
use scene::{BlockSpec, Friction, Load, Material, Scene, Shape};

/// The kinds of scenes, in the order of the table.
pub const FAMILIES: [&str; 6] = ["a-frame", "cards", "shore", "groove", "corners", "tripod"];

/// The material of all blocks.
const WOOD: &str = "wood";

type P2 = Vector2<f64>;

/// Scene number `index` of the trial `seed`, with its family: its weights sideways are the live load.
///
/// # Errors
/// A load that cannot be, which would be a mistake in this file.
pub fn scene(seed: u64, index: usize) -> Result<(Scene, &'static str), InputError> {
    let random = &mut Random::of(seed, index);
    let family = FAMILIES[index % FAMILIES.len()];
    let mut blocks = match family {
        "a-frame" => a_frame(random),
        "cards" => cards(random),
        "shore" => shore(random),
        "groove" => groove(random),
        "corners" => corners(random),
        _ => tripod(random),
    };
    blocks.iter_mut().filter(|b| !b.support).for_each(|b| b.material = Some(WOOD.into()));
    let mut scene =
        Scene { name: format!("edges {seed}/{index}: {family}"), blocks, ..Scene::default() };
    scene.joints.default.friction = Some(Friction::Coefficient(random.between(0.1, 1.0)));
    scene.materials.insert(WOOD.into(), Material::of_density(random.between(300.0, 3000.0)));
    let side = if random.chance(0.5) { 1.0 } else { -1.0 };
    scene.loads.live.push(Load { weight: Some([side, 0.0, 0.0]), ..Load::default() });
    Ok((scene, family))
}

fn prism(id: impl Into<String>, polygon: &[P2], depth: f64, support: bool) -> BlockSpec {
    let polygon = polygon.iter().map(|&p| p.into()).collect();
    BlockSpec { support, ..BlockSpec::new(id, Shape::Prism { polygon, depth }) }
}

fn floor(depth: f64) -> BlockSpec {
    let corners = [[-9.0, -0.5], [9.0, -0.5], [9.0, 0.0], [-9.0, 0.0]].map(P2::from);
    prism("floor", &corners, depth, true)
}

/// A plank from its foot to where its inner side ends, on the left of that line seen upwards.
fn plank(foot: P2, top: P2, thickness: f64) -> [P2; 4] {
    let out = P2::new(foot.y - top.y, top.x - foot.x).normalize() * thickness;
    [foot, top, top + out, foot + out]
}

fn mirrored(polygon: [P2; 4]) -> [P2; 4] {
    polygon.map(|p| P2::new(-p.x, p.y))
}

/// Two planks, not alike, whose upper inner edges meet.
fn a_frame(random: &mut Random) -> Vec<BlockSpec> {
    let top = P2::new(0.0, 1.0);
    let mut leg =
        || plank(P2::new(-random.between(0.2, 0.9), 0.0), top, random.decades(-2.0, -0.7));
    let (left, right) = (leg(), mirrored(leg()));
    vec![floor(1.0), prism("left", &left, 0.5, false), prism("right", &right, 0.5, false)]
}

/// Pairs of cards side by side; on top of them a card that lies, and another pair.
fn cards(random: &mut Random) -> Vec<BlockSpec> {
    let (half, thickness) = (random.between(0.15, 0.5), random.decades(-2.3, -1.3));
    let left = plank(P2::new(-half, 0.0), P2::new(0.0, 1.0), thickness);
    let wide = 2.0 * (half + 3.0 * thickness);
    let mut blocks = vec![floor(0.6)];
    let mut pair = |name: &str, x: f64, z: f64| {
        let at = P2::new(x, z);
        blocks.push(prism(format!("{name}l"), &left.map(|p| p + at), 0.5, false));
        blocks.push(prism(format!("{name}r"), &mirrored(left).map(|p| p + at), 0.5, false));
    };
    let count = random.count(1, 3);
    (0..count).for_each(|k| pair(&k.to_string(), wide * k as f64, 0.0));
    if count > 1 && random.chance(0.6) {
        let height = left[2].y;
        let lid = [[-0.2, 0.0], [wide + 0.2, 0.0], [wide + 0.2, thickness], [-0.2, thickness]];
        pair("up", wide / 2.0, height + thickness);
        blocks.push(prism("lid", &lid.map(|p| P2::from(p) + P2::new(0.0, height)), 0.5, false));
    }
    blocks
}

/// A strut in the corner of slab and kerb, its head on a wall or on the edge of one.
fn shore(random: &mut Random) -> Vec<BlockSpec> {
    let head = P2::new(random.between(0.5, 2.0), random.between(0.6, 2.0));
    let along = head.normalize();
    let across = P2::new(along.y, -along.x) * random.between(0.03, 0.2);
    let foot = [P2::zeros(), across + along * random.between(0.0, 0.2)];
    let foot = [foot[0], foot[1].sup(&P2::new(0.01, 0.01))];
    let tail = head + across - along * random.between(0.1, 0.3);
    let low = if random.chance(0.5) { head.y } else { head.y - 0.5 };
    let wall = [[head.x, low], [head.x + 0.5, low], [head.x + 0.5, low + 1.0], [head.x, low + 1.0]];
    let kerb = [[-1.0, 0.0], [0.0, 0.0], [0.0, 0.3], [-1.0, 0.3]].map(P2::from);
    let strut = polygon::hull(&[foot[0], foot[1], head, tail], 0.0);
    vec![
        floor(1.0),
        prism("kerb", &kerb, 1.0, true),
        prism("wall", &wall.map(P2::from), 1.0, true),
        prism("strut", &strut, 0.2, false),
    ]
}

/// A stone with its lowest edge in a groove, and props beside it.
fn groove(random: &mut Random) -> Vec<BlockSpec> {
    let slopes = [random.between(0.1, 0.8), random.between(0.1, 0.8)];
    let groove =
        [[-2.0, -1.0], [2.0, -1.0], [2.0, 2.0 * slopes[1]], [0.0, 0.0], [-2.0, 2.0 * slopes[0]]];
    let steep = [random.between(1.0, 2.0), random.between(1.0, 2.0)];
    let (right, left) = (0.5, 0.5);
    let stone = [
        P2::zeros(),
        P2::new(right, right * steep[1]),
        P2::new(0.0, 2.0),
        P2::new(-left, left * steep[0]),
    ];
    let mut blocks =
        vec![prism("groove", &groove.map(P2::from), 1.0, true), prism("stone", &stone, 0.8, false)];
    for (name, corner, out) in [("right", stone[1], 1.0), ("left", stone[3], -1.0)] {
        if random.chance(0.7) {
            let out = P2::new(out, random.between(-0.3, 0.3));
            blocks.push(prism(name, &pointed(random, corner, out), 1.0, true));
        }
    }
    blocks
}

/// A wedge with its edge at a point, its body towards `out`.
fn pointed(random: &mut Random, at: P2, out: P2) -> [P2; 3] {
    let out = out.normalize();
    let across = P2::new(-out.y, out.x) * random.between(0.05, 0.3);
    [at, at + out * 0.5 + across, at + out * 0.5 - across]
}

/// A stone held at some of its edges by the edges of wedges.
fn corners(random: &mut Random) -> Vec<BlockSpec> {
    let count = random.count(4, 7);
    let turn = random.between(0.0, 6.3);
    let around = |k: usize, by: f64| {
        let angle = turn + (k as f64 + by) * std::f64::consts::TAU / count as f64;
        P2::new(angle.cos(), angle.sin())
    };
    let ring: Vec<P2> = (0..count).map(|k| around(k, random.between(-0.2, 0.2))).collect();
    let stone = polygon::hull(&ring, 0.0);
    let mut blocks = vec![prism("stone", &stone, 0.8, false)];
    for (k, &corner) in stone.iter().enumerate() {
        // Those below, and some of the others.
        if corner.y < -0.2 || random.chance(0.4) {
            let out =
                corner.normalize() + P2::new(random.between(-0.2, 0.2), random.between(-0.2, 0.2));
            blocks.push(prism(format!("wedge{k}"), &pointed(random, corner, out), 1.0, true));
        }
    }
    blocks
}

/// Three square legs that meet at the ends of their upper inner edges.
fn tripod(random: &mut Random) -> Vec<BlockSpec> {
    let (reach, thickness, edge) =
        (random.between(0.3, 0.9), random.between(0.05, 0.2), random.between(0.05, 0.2));
    // The inner edges make a triangle around the axis.
    let inside = edge / (2.0 * 3.0_f64.sqrt());
    let side = plank(P2::new(-reach - inside, 0.0), P2::new(-inside, 1.0), thickness);
    let mut blocks = vec![BlockSpec { support: true, ..floor(18.0) }];
    for k in 0..3 {
        let turn = Rotation3::from_axis_angle(
            &Vector3::z_axis(),
            f64::from(k) * std::f64::consts::TAU / 3.0,
        );
        let corner = |y: f64| side.map(|p| turn * Vector3::new(p.x, y * edge / 2.0, p.y));
        let vertices = [corner(-1.0), corner(1.0)].concat().into_iter().map(Into::into).collect();
        // Seen from the front (y < 0) the side goes clockwise.
        let faces = vec![
            vec![0, 3, 2, 1],
            vec![4, 5, 6, 7],
            vec![0, 1, 5, 4],
            vec![1, 2, 6, 5],
            vec![2, 3, 7, 6],
            vec![3, 0, 4, 7],
        ];
        blocks.push(BlockSpec::new(format!("leg{k}"), Shape::Polyhedron { vertices, faces }));
    }
    blocks
}
