//! Discs and spheres of radius 1. A row of spheres with all centres in one vertical plane is a
//! scene of discs: out of that plane nothing pulls. `saddle`: tilted midway between two spheres of
//! the bed; `sphere`: straight over one.

use crate::ask::*;
use nalgebra::Vector3;
use serde_json::{Value, json};
use voussoir::scene::Scene;

const X: [f64; 3] = [1.0, 0.0, 0.0];

fn named(prefix: &str, centers: &[[f64; 3]], support: bool) -> Vec<Value> {
    let spheres = centers.iter().enumerate().map(|(k, &c)| sphere(&format!("{prefix}{k}"), 1.0, c));
    spheres.map(|s| if support { fixed(s) } else { s }).collect()
}

/// Free spheres on a bed of fixed ones.
fn heap(friction: f64, bed: &[[f64; 3]], free: Vec<Value>) -> Scene {
    scene(friction, json!([named("bed", bed, true), free].concat()), json!({}))
}

#[test]
fn a_disc_rolls_out_of_a_groove_whatever_the_friction() {
    // R02: at the limit the lower contact alone carries, its friction has no moment about the disc:
    // 30° below μ = √3, then wedged. R03: centres 2 g apart: asin(g / 2).
    let groove = |g: f64, friction: f64| {
        let top = (4.0 - g * g).sqrt();
        heap(friction, &[[-g, 0.0, 0.0], [g, 0.0, 0.0]], vec![sphere("disc", 1.0, [0.0, 0.0, top])])
    };
    for friction in [0.0, 0.5, 1.7] {
        close(&format!("R02, μ = {friction}"), tilt_deg(&groove(1.0, friction), X), 30.0, 1e-6);
    }
    assert_eq!(tilt_deg(&groove(1.0, 1.74), X), 90.0, "wedged above √3");
    close(
        "R03",
        tilt_deg(&groove(1.1, 0.1), X),
        1.1_f64.atan2((4.0 - 1.21_f64).sqrt()).to_degrees(),
        1e-6,
    );
    close("R03", 1.1_f64.atan2((4.0 - 1.21_f64).sqrt()).to_degrees(), 33.36701, 1e-6);
}

/// Three touching unit spheres about the origin; the first lies towards −y.
fn three() -> [[f64; 3]; 3] {
    let r = 2.0 / 3.0_f64.sqrt();
    [-90.0, 30.0, 150.0_f64].map(|a| [r * a.to_radians().cos(), r * a.to_radians().sin(), 0.0])
}

#[test]
fn a_sphere_rolls_out_of_a_pocket_of_three() {
    // R04: tan θ = 1 / (2 √2 cos α), α from the saddle (which lies towards +y here).
    let top = [0.0, 0.0, (8.0_f64 / 3.0).sqrt()];
    let pocket = |friction: f64| heap(friction, &three(), vec![sphere("ball", 1.0, top)]);
    for (friction, alpha) in [
        (0.0, 0.0),
        (0.5, 60.0),
        (1.0, 0.0),
        (1.0, 60.0),
        (1.4, 0.0),
        (0.3, 25.0),
        (0.3, -40.0_f64),
    ] {
        let (sin, cos) = alpha.to_radians().sin_cos();
        let want = (1.0 / (8.0_f64.sqrt() * cos)).atan().to_degrees();
        close(
            &format!("R04, μ = {friction}, α = {alpha}°"),
            tilt_deg(&pocket(friction), [sin, cos, 0.0]),
            want,
            1e-6,
        );
    }
    assert_eq!(tilt_deg(&pocket(1.7), [0.0, 1.0, 0.0]), 90.0, "wedged");
}

#[test]
fn a_sphere_rolls_out_of_a_pocket_of_four() {
    // R05: over the saddle atan(1 / √2), over a sphere atan 1 = 45°.
    let bed = [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]];
    for friction in [0.0, 0.4, 0.9] {
        let pocket = heap(friction, &bed, vec![sphere("ball", 1.0, [0.0, 0.0, 2.0_f64.sqrt()])]);
        close("R05 saddle", tilt_deg(&pocket, X), 35.264389682754654, 1e-6);
        close("R05 sphere", tilt_deg(&pocket, [1.0, 1.0, 0.0]), 45.0, 1e-6);
    }
}

#[test]
fn a_small_sphere_sits_deeper() {
    // R13: radius q = 0.5, height H = √((1 + q)² − 4/3): atan((1/√3) / H) and atan((2/√3) / H).
    let height = (1.5_f64.powi(2) - 4.0 / 3.0).sqrt();
    let pocket = heap(0.1, &three(), vec![sphere("ball", 0.5, [0.0, 0.0, height])]);
    close(
        "R13 saddle",
        tilt_deg(&pocket, [0.0, 1.0, 0.0]),
        (1.0 / 3.0_f64.sqrt() / height).atan().to_degrees(),
        1e-6,
    );
    close(
        "R13 sphere",
        tilt_deg(&pocket, [0.0, -1.0, 0.0]),
        (2.0 / 3.0_f64.sqrt() / height).atan().to_degrees(),
        1e-6,
    );
    close("R13", (1.0 / 3.0_f64.sqrt() / height).atan().to_degrees(), 31.09093, 1e-6);
}

#[test]
fn four_spheres_need_friction_between_them_and_on_the_ground() {
    // R07: √3 − √2 between the spheres, a quarter of it on the ground.
    let pile = |between: f64, below: f64| {
        let infinite = |mu: f64| if mu.is_infinite() { json!("infinite") } else { json!(mu) };
        let overrides: Vec<_> = (0..3)
            .map(|k| json!({ "blocks": ["ground", format!("s{k}")], "friction": infinite(below) }))
            .collect();
        let mut blocks = vec![ground()];
        blocks.extend(named("s", &three().map(|c| [c[0], c[1], 1.0]), false));
        blocks.push(sphere("top", 1.0, [0.0, 0.0, 1.0 + (8.0_f64 / 3.0).sqrt()]));
        scene(
            0.0,
            json!(blocks),
            json!({ "joints": { "default": { "friction": infinite(between) }, "overrides": overrides } }),
        )
    };
    let critical = 3.0_f64.sqrt() - 2.0_f64.sqrt();
    assert!((critical - 0.3178372452).abs() < 1e-10);
    flips("R07 between", |mu| pile(mu, 1.0), critical + 1e-6, critical - 1e-6);
    flips("R07 ground", |mu| pile(1.0, mu), critical / 4.0 + 1e-6, critical / 4.0 - 1e-6);
    assert!(stands(&pile(critical + 1e-6, critical / 4.0 + 1e-6)), "both just enough");
}

#[test]
fn a_triangular_pile_of_discs_falls_at_thirty_degrees() {
    // R08: n rows on a fixed row, whatever n and μ < √3: frictionless, each shares along the
    // lattice lines; the apex rolls out above.
    for (n, friction) in [(3, 0.0), (3, 0.8), (6, 0.0), (6, 0.3), (6, 1.7)] {
        let row = |count: usize, level: usize| -> Vec<[f64; 3]> {
            (0..count)
                .map(|k| [2.0 * k as f64 + level as f64, 0.0, level as f64 * 3.0_f64.sqrt()])
                .collect()
        };
        let free: Vec<_> = (1..=n).flat_map(|level| row(n + 1 - level, level)).collect();
        let pile = heap(friction, &row(n + 1, 0), named("d", &free, false));
        close(&format!("R08, n = {n}, μ = {friction}"), tilt_deg(&pile, X), 30.0, 1e-6);
    }
}

#[test]
fn a_tetrahedral_pile_of_spheres_falls_as_its_apex_does() {
    // R09: 4 layers (20 spheres) of close packing on a fixed layer of 15, with R04's pocket.
    let [u, v, w] = [
        Vector3::new(2.0, 0.0, 0.0),
        Vector3::new(1.0, 3.0_f64.sqrt(), 0.0),
        Vector3::new(1.0, 1.0 / 3.0_f64.sqrt(), (8.0_f64 / 3.0).sqrt()),
    ];
    let layer = |count: usize, level: usize| -> Vec<[f64; 3]> {
        let cells = (0..count).flat_map(|i| (0..count - i).map(move |j| (i, j)));
        cells.map(|(i, j)| (u * i as f64 + v * j as f64 + w * level as f64).into()).collect()
    };
    let free: Vec<_> = (1..=4).flat_map(|level| layer(5 - level, level)).collect();
    assert_eq!(free.len(), 20);
    for friction in [0.0, 0.5, 1.4] {
        let pile = heap(friction, &layer(5, 0), named("s", &free, false));
        // The bed's spheres form upright triangles with an edge along x: the saddle lies towards
        // −y, a sphere towards +y.
        close("R09 saddle", tilt_deg(&pile, [0.0, -1.0, 0.0]), 19.47122063449069, 1e-6);
        close("R09 sphere", tilt_deg(&pile, [0.0, 1.0, 0.0]), 35.264389682754654, 1e-6);
    }
}

#[test]
fn a_disc_rolls_over_a_step() {
    // R12: the resultant passes through the step's edge at acos(1 − h / R).
    for (h, want) in [(0.2, 36.86989764584402), (0.5, 60.0)] {
        let reach = (1.0 - (1.0 - h) * (1.0_f64 - h)).sqrt();
        let step = fixed(cuboid("step", [4.0, 4.0, h], [reach + 2.0, 0.0, 0.0]));
        for friction in [0.0, 0.05] {
            let disc = scene(
                friction,
                json!([ground(), step, sphere("disc", 1.0, [0.0, 0.0, 1.0])]),
                json!({}),
            );
            close(&format!("R12, h = {h}, μ = {friction}"), tilt_deg(&disc, X), want, 1e-6);
        }
    }
}

#[test]
fn two_discs_on_top_of_each_other_roll_at_once() {
    // R14: nothing resists rolling; the load factor is 0, found, and the column stands upright (in
    // unstable equilibrium).
    let column = scene(
        0.5,
        json!([
            ground(),
            sphere("lower", 1.0, [0.0, 0.0, 1.0]),
            sphere("upper", 1.0, [0.0, 0.0, 3.0])
        ]),
        push(X),
    );
    let got = load_factor(&column);
    assert!(got.abs() < 1e-8, "{got}");
    assert!(stands(&column));
}
