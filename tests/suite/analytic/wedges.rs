//! Wedges, grooves and the rock wedge: sliding on two planes at once. Values are those of
//! associative sliding, which presses the planes harder when it shears across the line of sliding;
//! zero dilatancy gives less.

use crate::ask::*;
use nalgebra::Vector3;
use serde_json::json;
use voussoir::{
    analysis::{Law, Outcome},
    scene::Scene,
    verdict::Verdict,
};

/// A16: a wedge of half angle `a` between two blocks on a floor, everything of friction μ, pressed
/// down by λ.
fn wedge(a: f64, friction: f64) -> Scene {
    let t = a.to_radians().tan();
    let x = |z: f64| 0.1 + t * z;
    scene(
        friction,
        json!([
            ground(),
            prism("right", &[[x(0.0), 0.0], [3.0, 0.0], [3.0, 1.0], [x(1.0), 1.0]]),
            prism("left", &[[-x(1.0), 1.0], [-3.0, 1.0], [-3.0, 0.0], [-x(0.0), 0.0]]),
            prism("wedge", &[[-x(0.2), 0.2], [x(0.2), 0.2], [x(1.4), 1.4], [-x(1.4), 1.4]]),
        ]),
        json!({ "loads": { "live": [{ "block": "wedge", "force": [0, 0, -1], "at": [0, 0, 1.4] }] } }),
    )
}

#[test]
fn a_wedge_drives_its_blocks_apart() {
    // A16: P = 2 N (sin a + μ cos a) − W_wedge, N = μ W_block / ((1 − μ²) cos a − 2 μ sin a)
    // (textbook wedge).
    for (a, friction) in [(20.0, 0.3), (10.0, 0.3), (30.0, 0.2), (40.0, 0.3_f64)] {
        let (sin, cos) = f64::to_radians(a).sin_cos();
        let t = sin / cos;
        let (block, own) = (2.9 - 0.5 * t, 1.2 * (0.2 + 1.6 * t));
        let normal = friction * block / ((1.0 - friction * friction) * cos - 2.0 * friction * sin);
        let want = 2.0 * normal * (sin + friction * cos) - own;
        exact(&format!("half angle {a}°, μ = {friction}"), &wedge(a, friction), want, 1e-6);
    }
    exact("A16", &wedge(20.0, 0.3), 0.6267940184401498, 1e-6);
}

#[test]
fn a_wedge_locks_itself() {
    // Where the denominator of A16 vanishes, a ≥ 90° − 2 atan μ: 28.07° for μ = 0.6.
    assert_eq!(outcome(&wedge(35.0, 0.6)).0, Outcome::Unbounded);
}

/// A block in a V groove along y, faces at ω from the vertical, on contact points 0.2 and 1.2 up
/// each face at y = ± 5, its centre of mass at 0.5 above the bottom line.
fn groove(omega: f64, friction: f64) -> Scene {
    let (sin, cos) = omega.to_radians().sin_cos();
    let face = |side: f64| -> Vec<[f64; 3]> {
        [(0.2, -5.0), (1.2, -5.0), (1.2, 5.0), (0.2, 5.0)]
            .iter()
            .map(|&(s, y)| [side * s * sin, y, s * cos])
            .collect()
    };
    scene(
        friction,
        json!([
            fixed(cuboid("left", [1.0, 10.0, 1.0], [-2.0, 0.0, 0.0])),
            fixed(cuboid("right", [1.0, 10.0, 1.0], [2.0, 0.0, 0.0])),
            cuboid("block", [1.0, 10.0, 1.0], [0.0; 3]),
        ]),
        json!({
            "loads": { "live": [{ "weight": [0, 1, 0] }] },
            "interfaces": [
                { "between": ["left", "block"], "points": face(-1.0), "normal": [cos, 0.0, sin] },
                { "between": ["right", "block"], "points": face(1.0), "normal": [-cos, 0.0, sin] },
            ]
        }),
    )
}

#[test]
fn a_block_in_a_groove_is_held_by_both_faces() {
    // E05, E06, E08, R16, R17: tan θ = μ / √(sin² ω − μ² cos² ω), derived from the cones of both
    // faces.
    for (case, omega, friction, want) in [
        ("E05", 45.0, 0.5, 0.8164965809277261),
        ("E06", 60.0, 0.4, 0.4747126632775414),
        ("E08", 60.0, 0.84, 47.961432766493175_f64.to_radians().tan()),
        ("R17", 60.0, 0.2, 0.23249527748763857),
    ] {
        let (sin, cos) = f64::to_radians(omega).sin_cos();
        let formula: f64 = friction / f64::sqrt(sin * sin - friction * friction * cos * cos);
        assert!((formula - want).abs() < 1e-9, "{case}: {formula}");
        exact(case, &groove(omega, friction), want, 1e-6);
    }
    close("R16", tilt_deg(&groove(45.0, 0.5), [0.0, 1.0, 0.0]), 39.23, 1e-4);
}

/// Shear along the groove alone, as in the conventional theory of wedges: tan θ = μ / sin ω (E05,
/// E06, E08, R16, R17).
#[test]
fn with_dry_friction_a_block_in_a_groove_slides_along_it() {
    for (case, omega, friction, want) in [
        ("E05", 45.0, 0.5, f64::sqrt(0.5)),
        ("E06", 60.0, 0.4, 0.46188021535170065),
        ("E08, type c", 60.0, 0.84, 44.12602113704874_f64.to_radians().tan()),
        ("E08, type a", 30.0, 0.84, 59.23728046576109_f64.to_radians().tan()),
        ("R17", 60.0, 0.2, 0.2 / f64::to_radians(60.0).sin()),
    ] {
        close(case, dry(&groove(omega, friction)).0, want, 1e-5);
    }
}

#[test]
fn a_steep_groove_locks_the_block() {
    // E08, types a and b: μ ≥ tan ω.
    assert_eq!(outcome(&groove(30.0, 0.84)).0, Outcome::Unbounded);
    assert_eq!(tilt_deg(&groove(30.0, 0.84), [0.0, 1.0, 0.0]), 90.0);
}

/// E09: the tetrahedral rock wedge of Hoek & Bray, Rock Slope Engineering: planes A 45/105 and B
/// 70/235, upper surface 12/195, face 65/185 (dip / direction of dip), 40 m high. The rock beside
/// each plane is a prism on the wedge's face.
fn rock_wedge(factor: f64) -> Scene {
    let o = Vector3::zeros();
    let t = Vector3::new(-25.031132967729032, 61.13067219967384, 40.0);
    let pa = Vector3::new(-27.354605945379106, 16.796166722890057, 30.769688183203307);
    let pb = Vector3::new(3.9802600440309734, 14.655948579139933, 32.05411819666589);
    // A triangle seen counter-clockwise from outside the wedge, and its outer normal.
    let outward = |[a, b, c]: [Vector3<f64>; 3], inside: Vector3<f64>| {
        let n = (b - a).cross(&(c - a));
        if n.dot(&(inside - a)) > 0.0 {
            ([a, c, b], -n.normalize())
        } else {
            ([a, b, c], n.normalize())
        }
    };
    let inside = (o + t + pa + pb) / 4.0;
    let rock = |id: &str, face: [Vector3<f64>; 3]| {
        let ([a, b, c], n) = outward(face, inside);
        let vertices: Vec<[f64; 3]> =
            [a, b, c, a + 10.0 * n, b + 10.0 * n, c + 10.0 * n].iter().map(|&p| p.into()).collect();
        // The face towards the wedge is seen from outside the rock, that is from the wedge.
        let faces = json!([[2, 1, 0], [3, 4, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]]);
        fixed(
            json!({ "id": id, "shape": { "polyhedron": { "vertices": vertices, "faces": faces } } }),
        )
    };
    let vertices: Vec<[f64; 3]> = [o, t, pa, pb].iter().map(|&p| p.into()).collect();
    let corner = |p: Vector3<f64>| [o, t, pa, pb].iter().position(|&q| q == p).expect("a corner");
    let faces: Vec<_> = [[o, t, pa], [o, t, pb], [o, pa, pb], [t, pa, pb]]
        .map(|f| outward(f, inside).0.map(corner))
        .to_vec();
    let angle = |deg: f64| deg.to_radians().tan() / factor;
    scene(
        0.0,
        json!([
            rock("A", [o, t, pa]),
            rock("B", [o, t, pb]),
            json!({ "id": "wedge", "shape": { "polyhedron": { "vertices": vertices, "faces": faces } } }),
        ]),
        json!({ "joints": { "default": { "friction": 0 }, "overrides": [
            { "blocks": ["A", "wedge"], "friction": angle(30.0) }, { "blocks": ["B", "wedge"], "friction": angle(20.0) } ] } }),
    )
}

#[test]
fn the_factor_of_safety_of_a_rock_wedge() {
    // E09: dry and without cohesion, tan φ / F on both planes. Shear along the line of intersection
    // alone gives F = 1.2335 (Hoek & Bray); the cones of both planes (conic programming) give more.
    let factor = 1.346291918773204;
    flips("E09", rock_wedge, factor * (1.0 - 1e-5), factor * (1.0 + 1e-5));
    // With dry friction: beyond it the forces exist, but the weight does not produce them.
    let dry = 1.233509249802143;
    assert_eq!(verdict(&rock_wedge(dry * (1.0 - 1e-3)), Law::Coulomb), Verdict::Stable);
    assert_eq!(verdict(&rock_wedge(dry * (1.0 + 1e-3)), Law::Coulomb), Verdict::Conditional);
}

/// A direction of tilting that is read, kept and read again stays the same to the last digit: a
/// bracket that is proved to be as wide as rounding has no room for another one.
#[test]
fn the_rock_wedge_falls_in_every_direction_as_its_proof_says() {
    let wedge = open(concat!(env!("CARGO_MANIFEST_DIR"), "/structures/rock-wedge.json").as_ref());
    for k in 0..12 {
        let across = -0.55 + 0.1 * f64::from(k);
        let [one, ten] = [1.0, 10.0].map(|by| tilt_deg(&wedge, [by, by * across, 0.0]));
        close(&format!("towards 1,{across}"), ten, one, 1e-7);
    }
}
