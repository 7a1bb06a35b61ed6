//! Every case of `tests/cases/granular_cases.json`, asked as the file words it and proved,
//! against the file's own numbers. Skipped, saying so, where that folder is absent; the same cases
//! with more digits and more variants are in `analytic` and `strength`.

use crate::ask::*;
use serde_json::{Value, json};
use std::path::Path;
use voussoir::scene::Scene;

const X: [f64; 3] = [1.0, 0.0, 0.0];
/// Midway between two spheres of a bed as [`three`] and the lattice lay it, and straight over one.
const SADDLE: [f64; 3] = [0.0, 1.0, 0.0];
const SPHERE: [f64; 3] = [0.0, -1.0, 0.0];

fn ball(radius: f64, at: [f64; 3]) -> Value {
    sphere("ball", radius, at)
}

/// A free sphere on fixed unit spheres.
fn on(bed: &[[f64; 3]], free: Value, mu: f64, arm: f64) -> Scene {
    let mut blocks: Vec<Value> =
        bed.iter().enumerate().map(|(k, &c)| fixed(sphere(&format!("bed{k}"), 1.0, c))).collect();
    blocks.push(free);
    scene(
        mu,
        json!(blocks),
        json!({ "joints": { "default": { "friction": mu, "rolling_arm": arm } } }),
    )
}

fn groove(g: f64, mu: f64, arm: f64) -> Scene {
    on(&[[-g, 0.0, 0.0], [g, 0.0, 0.0]], ball(1.0, [0.0, 0.0, (4.0 - g * g).sqrt()]), mu, arm)
}

/// Three touching unit spheres about the origin; the first lies towards −y.
fn three() -> [[f64; 3]; 3] {
    let r = 2.0 / 3f64.sqrt();
    [-90.0, 30.0, 150.0f64].map(|a| [r * a.to_radians().cos(), r * a.to_radians().sin(), 0.0])
}

fn pocket(radius: f64, mu: f64) -> Scene {
    on(&three(), ball(radius, [0.0, 0.0, ((1.0 + radius).powi(2) - 4.0 / 3.0).sqrt()]), mu, 0.0)
}

fn four(mu: f64) -> Scene {
    on(
        &[[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]],
        ball(1.0, [0.0, 0.0, 2f64.sqrt()]),
        mu,
        0.0,
    )
}

fn pile(packing: &str, layers: usize, mu: f64) -> Scene {
    template(
        mu,
        json!({ "lattice": { "packing": packing, "radius": 1.0, "layers": layers } }),
        json!({}),
    )
}

/// Spheres on the ground and one above, with one friction between them and another on the ground.
fn heap(lower: &[[f64; 2]], top: f64, between: f64, below: f64) -> Scene {
    let mut blocks = vec![ground(), sphere("top", 1.0, [0.0, 0.0, top])];
    blocks.extend(
        lower.iter().enumerate().map(|(k, p)| sphere(&format!("s{k}"), 1.0, [p[0], p[1], 1.0])),
    );
    let overrides: Vec<Value> = (0..lower.len())
        .map(|k| json!({ "blocks": ["ground", format!("s{k}")], "friction": below }))
        .collect();
    scene(
        0.0,
        json!(blocks),
        json!({ "joints": { "default": { "friction": between }, "overrides": overrides } }),
    )
}

fn step(h: f64, mu: f64) -> Scene {
    let reach = (1.0 - (1.0 - h) * (1.0 - h)).sqrt();
    let step = fixed(cuboid("step", [4.0, 4.0, h], [reach + 2.0, 0.0, 0.0]));
    scene(mu, json!([ground(), step, ball(1.0, [0.0, 0.0, 1.0])]), json!({}))
}

/// A block along y in a trough whose faces make `angle` with the horizontal.
fn trough(angle: f64, mu: f64) -> Scene {
    let (sin, cos) = angle.to_radians().sin_cos();
    let face = |side: f64| -> Vec<[f64; 3]> {
        [(0.2, -5.0), (1.2, -5.0), (1.2, 5.0), (0.2, 5.0)]
            .iter()
            .map(|&(s, y)| [side * s * cos, y, s * sin])
            .collect()
    };
    let wall = |id: &str, side: f64| fixed(cuboid(id, [1.0, 10.0, 1.0], [2.0 * side, 0.0, 0.0]));
    scene(
        mu,
        json!([
            wall("left", -1.0),
            wall("right", 1.0),
            cuboid("block", [1.0, 10.0, 1.0], [0.0; 3])
        ]),
        json!({ "loads": { "live": [{ "weight": [0, 1, 0] }] }, "interfaces": [
            { "between": ["left", "block"], "points": face(-1.0), "normal": [sin, 0.0, cos] },
            { "between": ["right", "block"], "points": face(1.0), "normal": [-sin, 0.0, cos] },
        ] }),
    )
}

/// One scene of every kind of case, for questions about the scenes themselves.
pub fn scenes() -> Vec<(&'static str, Scene)> {
    let corners = [[1.0, 0.0], [-0.5, 0.75f64.sqrt()], [-0.5, -(0.75f64.sqrt())]]
        .map(|p| p.map(|c| 2.0 / 3f64.sqrt() * c));
    vec![
        ("groove", groove(1.1, 0.1, 0.0)),
        ("groove with a rolling arm", groove(1.1, 0.1, 0.05)),
        ("pocket", pocket(0.5, 0.3)),
        ("four", four(0.3)),
        ("pile", pile("fcc", 3, 0.3)),
        ("discs", pile("triangular", 3, 0.3)),
        ("heap", heap(&corners, 1.0 + (8.0f64 / 3.0).sqrt(), 0.4, 0.2)),
        ("step", step(0.2, 0.05)),
        ("trough", trough(45.0, 0.5)),
    ]
}

/// Stands just above a least friction, falls just below.
fn least(case: &str, critical: f64, make: impl Fn(f64) -> Scene) {
    flips(case, make, critical * (1.0 + 1e-6), critical * (1.0 - 1e-6));
}

/// Asks what the case wants under this key of `expected`. The file gives six or seven digits.
fn ask(id: &str, key: &str, want: &Value, tolerance: f64) {
    let what = format!("{id}, {key}");
    let number = want.as_f64();
    let tilt = |scenes: &[Scene], toward: [f64; 3]| {
        for scene in scenes {
            let (got, want) = (tilt_deg(scene, toward), number.unwrap_or(90.0));
            assert!(
                (got - want).abs() <= tolerance,
                "{what}: {got}, expected {want} within {tolerance}"
            );
        }
    };
    let mu = key.strip_prefix("mu ").and_then(|t| t.parse::<f64>().ok()).unwrap_or(f64::NAN);
    let want = number.unwrap_or(f64::NAN);
    match (id, key) {
        ("R01", _) => tilt(
            &[scene(
                mu,
                json!([ground(), cuboid("block", [1.0, 1.0, 1.0 / 0.5], [0.0; 3])]),
                json!({}),
            )],
            X,
        ),
        ("R02", _) => tilt(&[groove(1.0, mu, 0.0)], X),
        ("R03", _) => tilt(&[groove(1.1, 0.1, 0.0)], X),
        ("R04", "saddle") => tilt(&[pocket(1.0, 0.0), pocket(1.0, 0.5), pocket(1.0, 1.4)], SADDLE),
        ("R04", "sphere") => tilt(&[pocket(1.0, 0.0), pocket(1.0, 1.4)], SPHERE),
        ("R04", _) => tilt(&[pocket(1.0, mu)], SADDLE),
        ("R05", "saddle") => tilt(&[four(0.0), four(0.9)], X),
        ("R05", "sphere") => tilt(&[four(0.0), four(0.9)], [1.0, 1.0, 0.0]),
        ("R06", "cylinder-cylinder") => {
            least(&what, want, |mu| heap(&[[-1.0, 0.0], [1.0, 0.0]], 1.0 + 3f64.sqrt(), mu, 1.0))
        }
        ("R06", "ground") => {
            least(&what, want, |mu| heap(&[[-1.0, 0.0], [1.0, 0.0]], 1.0 + 3f64.sqrt(), 1.0, mu))
        }
        ("R07", _) => {
            let lower = three().map(|c| [c[0], c[1]]);
            let top = 1.0 + (8.0f64 / 3.0).sqrt();
            least(&what, want, |mu| {
                if key == "ground" {
                    heap(&lower, top, 1.0, mu)
                } else {
                    heap(&lower, top, mu, 1.0)
                }
            });
        }
        ("R08", _) => tilt(
            &[(3, 0.0), (3, 0.8), (6, 0.3), (6, 1.7)].map(|(n, mu)| pile("triangular", n, mu)),
            X,
        ),
        // The lattice's bed has its upright triangles the other way round.
        ("R09", "saddle") => tilt(&[0.0, 0.5, 1.4].map(|mu| pile("fcc", 4, mu)), [0.0, -1.0, 0.0]),
        ("R09", "sphere") => tilt(&[0.0, 0.5, 1.4].map(|mu| pile("fcc", 4, mu)), [0.0, 1.0, 0.0]),
        ("R10", _) => {
            let joints =
                json!({ "joints": { "default": { "friction": 0.8, "rolling_arm": 0.1 } } });
            tilt(&[scene(0.8, json!([ground(), ball(1.0, [0.0, 0.0, 1.0])]), joints)], X);
        }
        ("R11", _) => tilt(&[groove(1.0, 0.5, 0.1)], X),
        ("R12", h) => tilt(
            &[step(h.parse().expect("a height"), 0.0), step(h.parse().expect("a height"), 0.05)],
            X,
        ),
        ("R13", "saddle") => tilt(&[pocket(0.5, 0.1)], SADDLE),
        ("R13", "sphere") => tilt(&[pocket(0.5, 0.1)], SPHERE),
        ("R14", _) => {
            let discs = json!([
                ground(),
                sphere("lower", 1.0, [0.0, 0.0, 1.0]),
                sphere("upper", 1.0, [0.0, 0.0, 3.0])
            ]);
            let got = load_factor(&scene(0.5, discs, push(X)));
            assert!((got - want).abs() <= tolerance, "{what}: {got}");
        }
        ("R15", _) => {
            let cubes = (0..10).map(|k| cuboid(&format!("c{k}"), [1.0; 3], [0.0, 0.0, k as f64]));
            let got =
                load_factor(&scene(1.0, std::iter::once(ground()).chain(cubes).collect(), push(X)));
            assert!((got - want).abs() <= tolerance, "{what}: {got}");
        }
        ("R16" | "R17", law) => {
            let (coulomb, associative, _) =
                dry(&if id == "R16" { trough(45.0, 0.5) } else { trough(30.0, 0.2) });
            let tan = if law == "coulomb" { coulomb } else { associative.unwrap() };
            let got = if id == "R16" { tan.atan().to_degrees() } else { tan };
            assert!((got - want).abs() <= tolerance, "{what}: {got}, expected {want}");
        }
        _ => panic!("nobody asks case {what}"),
    }
}

#[test]
fn every_granular_case_comes_out_as_its_file_says() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/granular_cases.json");
    let text = std::fs::read_to_string(&path).expect("the cases");
    let file: Value = serde_json::from_str(&text).expect("JSON");
    let cases = file["cases"].as_array().expect("cases");
    for case in cases {
        let (id, tolerance) =
            (case["id"].as_str().expect("an id"), case["tolerance"].as_f64().expect("a tolerance"));
        for (key, want) in case["expected"].as_object().expect("expected values") {
            ask(id, key, want, tolerance);
        }
    }
    assert_eq!(cases.len(), 17, "cases R01 to R17");
}
