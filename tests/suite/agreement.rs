//! Verdict against simulation over the scenes of `structures/` and real assemblies, away from their
//! limits: two methods that share nothing but the blocks and where they touch. Where they disagree,
//! the reason is listed here.

use crate::ask::model;
use nalgebra::Vector3;
use std::{ops::ControlFlow, path::PathBuf};
use voussoir::{
    analysis::{Agreement, Control, agreement, assess},
    assembly::MemberKind,
    dynamics::{SimulationSettings, simulate},
    import,
    scene::Scene,
    verdict::Verdict,
};

/// Scenes within 3 % of a limit, where a simulation may err: not counted.
const NEAR: [(&str, &str); 12] = [
    ("arch-at-critical-plus", "1e-6 above its least thickness"),
    ("arch-at-critical-minus", "1e-6 below its least thickness"),
    ("elliptical-arch", "1e-6 above its least thickness"),
    ("ring-with-vertical-joints", "0.1 % above its least thickness"),
    ("dome-slices-stand", "0.1 % above its least thickness"),
    ("dome-slices-fall", "0.1 % below its least thickness"),
    ("leaning-stack-stands", "just inside its limit"),
    ("leaning-stack-falls", "just outside its limit"),
    ("leaning-tower-1000", "1e-5 below the critical shift"),
    ("harmonic-overhang-stands", "just inside its limit"),
    ("harmonic-overhang-falls", "just outside its limit"),
    ("block-on-incline-slides", "0.02 % above its friction angle"),
];

/// Scenes that a fixed number of iterations cannot follow: run by hand, not here, for their time.
const SLOW: [(&str, &str); 5] = [
    ("column-1000", "forces travel through 1000 blocks in more iterations than a step has"),
    ("running-bond-wall-40", "1,660 blocks: minutes"),
    ("dome", "stands; 3 s in this profile"),
    (
        "dome-with-openings",
        "needs self-stress; the engine's friction holds the stones over its openings, in 22 s",
    ),
    ("dome-with-oculus", "stands; 3 s in this profile"),
];

/// Scenes on which verdict and simulation disagree, or the simulation stays undecided, and why.
const DISAGREE: [(&str, &str); 2] = [
    (
        "mass-ratio-1e9",
        "a block between the ground and one of 1e9 times its mass: the iterations do not converge",
    ),
    (
        "tiny-on-huge",
        "a block of 1e-6 m on one of 1 km: the engine's contact distances are not that fine",
    ),
];

/// Scenes whose joints have strengths that the simulation leaves out, or that have grips, and it
/// says so: nothing to compare.
fn has_strengths(scene: &Scene) -> bool {
    let interfaces = model(scene).interfaces;
    let strong = |law| !voussoir::assembly::JointLaw { pore_pressure: 0.0, ..law }.friction_only();
    interfaces.members.iter().any(|m| m.kind == MemberKind::Grip)
        || interfaces.list.iter().any(|f| strong(f.law))
}

fn compare(scene: &Scene) -> (Agreement, f64) {
    let model = model(scene);
    let answer = assess(&model, &Control::default());
    let outcome =
        simulate(&model, &SimulationSettings::default(), &mut |_| ControlFlow::Continue(()))
            .expect("a simulation");
    let seconds = outcome.runs.iter().map(|r| r.seconds).sum();
    (agreement(&model, &answer, &outcome), seconds)
}

fn listed(list: &[(&str, &str)], name: &str) -> bool {
    list.iter().any(|(n, _)| *n == name)
}

#[test]
fn simulations_of_the_structures_agree_with_their_verdicts() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("structures");
    let mut names: Vec<String> = std::fs::read_dir(&folder)
        .expect("structures/")
        .filter_map(|entry| {
            entry
                .expect("an entry")
                .file_name()
                .to_string_lossy()
                .strip_suffix(".json")
                .map(str::to_string)
        })
        .filter(|name| name != "expected")
        .collect();
    names.sort();
    for (name, _) in NEAR.iter().chain(&SLOW).chain(&DISAGREE) {
        assert!(names.iter().any(|n| n == name), "{name} is listed here but not in structures/");
    }
    let (mut agreed, mut counted) = (0, 0);
    let mut wrong = Vec::new();
    for name in names.iter().filter(|n| !listed(&NEAR, n) && !listed(&SLOW, n)) {
        let scene = crate::ask::open(&folder.join(format!("{name}.json")));
        if has_strengths(&scene) {
            println!("{name}: its joints have strengths, or it has grips");
            continue;
        }
        let (a, seconds) = compare(&scene);
        counted += 1;
        agreed += usize::from(a.agrees == Some(true));
        let forces = a.forces.as_ref().map(|f| (f.mean, f.largest, f.determinate));
        println!(
            "{name}: {:?}, {:?}, motion {:?}, forces {forces:?}, {seconds:.2} s",
            a.verdict, a.fate, a.motion
        );
        if (a.agrees == Some(true)) == listed(&DISAGREE, name) {
            wrong.push(format!("{name}: verdict {:?}, simulation {:?}", a.verdict, a.fate));
        }
        // What statics fixes, both must find.
        if let Some(f) = a.forces.filter(|f| f.determinate) {
            assert!(f.mean < 1e-3, "{name}: forces differ by {:.1e}", f.mean);
        }
    }
    println!("{agreed} of {counted} agree");
    assert!(wrong.is_empty(), "other than listed: {wrong:#?}");
    assert!(counted >= 60 && agreed as f64 >= 0.95 * counted as f64, "{agreed} of {counted}");
}

/// Loaded scenes on which the two disagree 5 % from the limit, and why.
const DISAGREE_LOADED: [(&str, &str); 3] = [
    (
        "bridge-prestwood at 0.95",
        "soil resists once it is pushed: the ring comes to rest after 4 % of its thickness, which is undecided",
    ),
    (
        "wall-with-two-openings at 0.95",
        "with dry friction several states are possible: the verdict's has no admissible rest, the simulation finds one",
    ),
    (
        "sliver at 0.95",
        "a slab of 1e5 times its thickness: contacts sink in by more than the 5 % of its lean that are left",
    ),
];

/// Scenes of `structures/` at 0.95 and 1.05 of their load factor, the verdict asked again there
/// (with dry friction the limit may be lower), and at 0.95 and 1.05 of their tilt.
#[test]
fn simulations_either_side_of_a_limit_agree_with_their_verdicts() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("structures");
    let text =
        std::fs::read_to_string(folder.join("expected.json")).expect("structures/expected.json");
    let list: Vec<serde_json::Value> = serde_json::from_str(&text).expect("JSON");
    let (mut agreed, mut counted) = (0, 0);
    let mut wrong = Vec::new();
    for entry in &list {
        let file = entry["file"].as_str().expect("a file");
        let name = file.trim_end_matches(".json");
        if listed(&NEAR, name) || listed(&SLOW, name) || listed(&DISAGREE, name) {
            continue;
        }
        let scene = crate::ask::open(&folder.join(file));
        if has_strengths(&scene) {
            continue;
        }
        for share in [0.95, 1.05] {
            let mut scene = scene.clone();
            if let Some(lambda) = entry["expect"]["load_factor"].as_f64().filter(|l| *l > 0.0) {
                scene.loads = scene.loads.fixed(share * lambda);
            } else if let Some(tilt) =
                entry["expect"]["tilt_deg"].as_f64().filter(|_| scene.loads.dead.is_empty())
            {
                let toward = Vector3::new(
                    entry["toward"][0].as_f64().expect("x"),
                    entry["toward"][1].as_f64().expect("y"),
                    0.0,
                )
                .normalize();
                let (s, c) = (share * tilt).to_radians().sin_cos();
                let strength = Vector3::from(scene.gravity).norm();
                scene.gravity = (toward * (s * strength) - Vector3::z() * (c * strength)).into();
            } else {
                continue;
            }
            let (a, seconds) = compare(&scene);
            let name = format!("{name} at {share}");
            println!(
                "{name}: {:?}, {:?}, motion {:?}, {seconds:.2} s",
                a.verdict, a.fate, a.motion
            );
            if a.verdict == Verdict::Undecided {
                continue;
            }
            counted += 1;
            agreed += usize::from(a.agrees == Some(true));
            if (a.agrees == Some(true)) == listed(&DISAGREE_LOADED, &name) {
                wrong.push(format!("{name}: verdict {:?}, simulation {:?}", a.verdict, a.fate));
            }
        }
    }
    println!("{agreed} of {counted} agree");
    assert!(wrong.is_empty(), "other than listed: {wrong:#?}");
    assert!(counted >= 40 && agreed as f64 >= 0.95 * counted as f64, "{agreed} of {counted}");
}

/// Frame H and the shelf fall although admissible forces exist; type-b and the cubes stand (facts
/// known for these files).
#[test]
fn real_assemblies_do_what_is_known_of_them() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/cases/compas");
    for (name, supports, friction, up, stands) in [
        ("cra-H", &["0", "1"][..], 0.84, import::Up::Z, false),
        ("cra-shelf", &["0"], 0.9, import::Up::Z, false),
        ("cra-shelf-stable", &["0"], 0.9, import::Up::Z, true),
        ("cra-cubes", &["0"], 0.84, import::Up::Z, true),
        ("cra-type-b", &["0", "1"], 0.84, import::Up::X, true),
    ] {
        let options = import::ImportOptions {
            supports: supports.iter().map(|s| s.to_string()).collect(),
            friction: Some(voussoir::scene::Friction::Coefficient(friction)),
            up: Some(up),
            ..import::ImportOptions::default()
        };
        let scene = import::import_file(&folder.join(format!("{name}.json")), &options)
            .unwrap_or_else(|e| panic!("{e}"))
            .scene;
        let (a, _) = compare(&scene);
        println!("{name}: {a:?}");
        assert_eq!(a.agrees, Some(true), "{name}: {a:?}");
        assert_eq!(a.fate == voussoir::dynamics::Fate::Stands, stands, "{name}");
    }
}

/// Reference cases on which the two disagree 5 % from the limit, and why.
const DISAGREE_CASES: [(&str, &str); 1] = [(
    "E16 at 1.05",
    "conditional, and the simulation rests: below the associative bound more than one state may be possible, not looked into",
)];

/// Reference cases of classes A, B and E that ask for a load factor, at 0.95 and 1.05 of it.
#[test]
fn simulations_of_the_reference_cases_agree_with_their_verdicts() {
    let file = crate::reference::cases();
    let (mut agreed, mut counted) = (0, 0);
    let mut wrong = Vec::new();
    for case in file["cases"].as_array().expect("cases") {
        let (id, class) =
            (case["id"].as_str().expect("an id"), case["cls"].as_str().unwrap_or_default());
        let drawn = case.get("blocks").is_some() || case.get("blocks3d").is_some();
        if !["A", "B", "E"].contains(&class) || case["query"]["type"] != "lambda_max" || !drawn {
            continue;
        }
        let scene = crate::reference::scene(case, case, crate::reference::mu_of(case));
        let m = model(&scene);
        let limit = voussoir::analysis::limit(&m, &Control::default());
        let dry = voussoir::analysis::coulomb::load_factor(&m, &limit, &Control::default()).value;
        let Some(dry) = dry.filter(|&v| v > 0.0 && m.assembly.blocks.len() <= 80) else {
            println!("{id}: no load factor with dry friction, or too large");
            continue;
        };
        for share in [0.95, 1.05] {
            let mut scene = scene.clone();
            scene.loads = scene.loads.fixed(share * dry);
            let (a, seconds) = compare(&scene);
            counted += 1;
            agreed += usize::from(a.agrees == Some(true));
            let name = format!("{id} at {share}");
            println!("{name}: {:?}, {:?}, {seconds:.2} s", a.verdict, a.fate);
            if (a.agrees == Some(true)) == listed(&DISAGREE_CASES, &name) {
                wrong.push(format!("{name}: verdict {:?}, simulation {:?}", a.verdict, a.fate));
            }
        }
    }
    println!("{agreed} of {counted} agree");
    assert!(wrong.is_empty(), "other than listed: {wrong:#?}");
    assert!(counted >= 30 && agreed as f64 >= 0.95 * counted as f64, "{agreed} of {counted}");
}
