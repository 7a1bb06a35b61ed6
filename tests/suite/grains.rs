//! Packings of grains: exact piles of 500 grains and more, rounds of loose grains, averages over
//! contacts, heaps that flow.

use crate::ask::{cuboid, fixed, ground, model, prove, scene, sphere, template};
use nalgebra::Vector3;
use serde_json::{Value, json};
use std::ops::ControlFlow;
use voussoir::{
    analysis::{
        Control, Law, Outcome, Packing, Tilted, assess, fabric, repose, stability,
        stability::{held, without},
    },
    error::FindingCode,
    generate::deposit,
    proof::{packing::PackingFile, saved},
    report::json as text,
    scene::{
        BlockSpec, FloorKind, GrainKind, Protocol, ProtocolKind, Scene, Shape, Sizes, read_str,
    },
};

fn pile(packing: &str, layers: usize, friction: f64) -> Scene {
    template(
        friction,
        json!({ "lattice": { "packing": packing, "radius": 1.0, "layers": layers } }),
        json!({}),
    )
}

fn associative() -> Control {
    Control { law: Law::Associative, ..Control::default() }
}

/// The tilt in degrees, proved, and how many grains there are.
fn falls_at(scene: &Scene, toward: [f64; 3]) -> (f64, usize) {
    let model = model(scene);
    let answer = stability(&model, &[], toward.into(), 0.0, &associative()).expect("a direction");
    let round = answer.rounds.into_iter().next_back().expect("a round");
    let angle = round.tilt.angle_deg().expect("an angle");
    let rest = without(scene, &round.gone).expect("a scene");
    let own = round.tilt.model.clone();
    let tilted = Tilted { directions: vec![round.tilt], level: None };
    prove(&rest, &saved::tilt(&rest, &own, &tilted).expect("a direction"));
    (angle, model.assembly.free().count())
}

#[test]
fn a_triangular_pile_of_528_discs_falls_at_thirty_degrees() {
    // R08 with 32 rows.
    let (angle, grains) = falls_at(&pile("triangular", 32, 0.5), [1.0, 0.0, 0.0]);
    assert!(grains == 528 && (angle - 30.0).abs() < 1e-5, "{grains} grains: {angle}");
}

#[test]
fn piles_of_spheres_fall_as_their_pockets_do() {
    // R09 and R05: saddle and sphere of the pocket of three, and of the pocket of four.
    for (packing, toward, want) in [
        ("fcc", [0.0, -1.0, 0.0], 19.471220634),
        ("fcc", [0.0, 1.0, 0.0], 35.264389683),
        ("square", [1.0, 0.0, 0.0], 35.264389683),
        ("bed", [1.0, 1.0, 0.0], 45.0),
    ] {
        let (angle, _) = falls_at(&pile(packing, 4, 0.5), toward);
        assert!(
            (angle - want).abs() < 1e-5,
            "{packing} towards {toward:?}: {angle}, expected {want}"
        );
    }
}

#[test]
fn a_tetrahedral_pile_of_560_spheres_falls_as_its_apex_does() {
    // R09 with 14 layers.
    let (angle, grains) = falls_at(&pile("fcc", 14, 0.5), [0.0, -1.0, 0.0]);
    assert!(grains == 560 && (angle - 19.471220634).abs() < 1e-5, "{grains} grains: {angle}");
}

fn clump(id: &str, balls: &[[f64; 3]]) -> Value {
    let spheres: Vec<Value> = balls.iter().map(|at| json!({ "at": at, "radius": 1.0 })).collect();
    json!({ "id": id, "shape": { "clump": { "spheres": spheres } } })
}

#[test]
fn clumps_of_spheres_have_exact_limits() {
    let one = |friction: f64, block: Value| scene(friction, json!([ground(), block]), json!({}));
    // Two spheres in a row along y: they slide or topple along it, and roll across it at once.
    let dumbbell =
        |friction: f64| one(friction, clump("dumbbell", &[[0.0, -1.0, 1.0], [0.0, 1.0, 1.0]]));
    assert!(
        (falls_at(&dumbbell(0.5), [0.0, 1.0, 0.0]).0 - 0.5f64.atan().to_degrees()).abs() < 1e-6
    );
    assert!((falls_at(&dumbbell(2.0), [0.0, 1.0, 0.0]).0 - 45.0).abs() < 1e-6);
    assert!(falls_at(&dumbbell(0.5), [1.0, 0.0, 0.0]).0.abs() < 1e-6);
    // Overlapping by half a radius: the centre of mass is in the middle still, the feet are closer.
    let peanut = one(2.0, clump("peanut", &[[0.0, -0.5, 1.0], [0.0, 0.5, 1.0]]));
    assert!((falls_at(&peanut, [0.0, 1.0, 0.0]).0 - 0.5f64.atan().to_degrees()).abs() < 1e-6);
    // Three spheres and a fourth on top: over the edge between two feet.
    let (foot, rise) = (2.0 / 3f64.sqrt(), (8.0f64 / 3.0).sqrt());
    let feet = [60.0, 180.0, 300.0f64]
        .map(|a| [foot * a.to_radians().cos(), foot * a.to_radians().sin(), 1.0]);
    let tetrapod =
        one(2.0, clump("tetrapod", &[feet[0], feet[1], feet[2], [0.0, 0.0, 1.0 + rise]]));
    let want = (0.5 * foot / (1.0 + rise / 4.0)).atan().to_degrees();
    assert!((falls_at(&tetrapod, [1.0, 0.0, 0.0]).0 - want).abs() < 1e-6);
    // R04 on three spheres that are one block, and turned as a whole with its frame.
    let bed = feet.map(|p| [p[0], p[1], 0.0]);
    let turn = json!({ "axis": [0, 0, 1], "angle": 30 });
    let mut fixed_bed = fixed(clump("bed", &bed));
    fixed_bed["rotation_deg"] = turn;
    let pocket = scene(0.5, json!([fixed_bed, sphere("ball", 1.0, [0.0, 0.0, rise])]), json!({}));
    let saddle = [30f64.to_radians().cos(), 30f64.to_radians().sin(), 0.0];
    assert!((falls_at(&pocket, saddle).0 - 19.471220634).abs() < 1e-6);
}

#[test]
fn clumps_that_cannot_be_are_refused_with_their_place() {
    let bad = |spheres: Value| {
        let block = json!([{ "id": "c", "shape": { "clump": { "spheres": spheres } } }]);
        voussoir::interface::prepare(&scene(0.5, block, json!({})))
            .expect_err("a refusal")
            .to_string()
    };
    assert!(
        bad(json!([])).contains("blocks[0].shape.clump.spheres: a clump needs at least one sphere"),
        "{}",
        bad(json!([]))
    );
    assert!(bad(json!([{ "at": [0, 0, 0], "radius": 0 }])).contains("spheres[0].radius"));
    assert!(
        bad(json!(vec![json!({ "at": [0, 0, 0], "radius": 1 }); 2001])).contains("at most 2000")
    );
}

#[test]
fn grains_of_every_shape_have_the_volume_of_their_sphere() {
    for grain in [GrainKind::Sphere, GrainKind::Clump, GrainKind::Hull] {
        let protocol = Protocol {
            grain,
            sizes: Sizes::Even(0.0),
            elongation: 1.7,
            ..small(ProtocolKind::Drain)
        };
        let deposit = deposit(&protocol, 3).unwrap();
        let model = model(&deposit.scene);
        let want = protocol.density * std::f64::consts::PI / 6.0 * protocol.diameter.powi(3);
        assert_eq!(model.assembly.free().count(), 40);
        assert!(
            model
                .assembly
                .free()
                .all(|i| (model.assembly.blocks[i].mass / want - 1.0).abs() < 1e-12),
            "{grain:?}"
        );
        // Nothing touches before it falls, whatever its shape.
        let free = |i: usize| !model.assembly.blocks[i].support;
        assert!(!model.interfaces.list.iter().any(|f| free(f.a) || free(f.b)), "{grain:?}");
        assert!(
            model.interfaces.findings.iter().all(|f| f.code != FindingCode::Overlap),
            "{:?}",
            model.interfaces.findings
        );
    }
}

#[test]
fn heaps_of_clumps_and_hulls_rest_reload_and_are_asked_about() {
    for grain in [GrainKind::Clump, GrainKind::Hull] {
        let protocol = Protocol { grain, ..small(ProtocolKind::Drain) };
        let heap = repose::heap(&protocol, 3, &mut |_| ControlFlow::Continue(())).unwrap();
        assert!(heap.rested, "{grain:?}: {:?}", heap.findings);
        let written = text::pretty(&heap.scene).unwrap();
        assert_eq!(
            read_str("heap", written.as_str()).unwrap().0,
            heap.scene,
            "written and read back"
        );
        let margin = repose::margin(&heap, &associative()).unwrap();
        assert!(
            margin.tilt.model.interfaces.list.len() > heap.grains[0],
            "{grain:?} at rest touch"
        );
        assert_ne!(margin.tilt.load_factor.outcome, Outcome::Undecided, "{grain:?}");
        if grain == GrainKind::Clump {
            assert!(
                margin.degrees().is_some_and(|d| d > 0.0) && margin.loose + margin.unbalanced == 0,
                "{:?}",
                margin.degrees()
            );
        }
    }
}

#[test]
fn frictionless_heaps_and_one_layer_beds_are_told_for_what_they_are() {
    // Without friction all but the grains that the floor holds run out; one layer has no surface to
    // fit.
    for protocol in [
        Protocol { friction: 0.0, ..small(ProtocolKind::Drain) },
        Protocol { grains: 12, ..small(ProtocolKind::Tilt) },
    ] {
        let heap = repose::heap(&protocol, 1, &mut |_| ControlFlow::Continue(())).unwrap();
        assert!(
            heap.slope.is_none()
                && heap.findings.iter().any(|f| f.text.contains("cells of the surface")),
            "{:?}",
            heap.findings
        );
        assert_eq!(heap.rested, !heap.findings.iter().any(|f| f.text.contains("still moves")));
    }
}

#[test]
fn frictionless_piles_and_beds_have_an_answer() {
    for (packing, want) in [("fcc", 19.471220634), ("bed", 35.264389683)] {
        let toward = if packing == "fcc" { [0.0, -1.0, 0.0] } else { [1.0, 0.0, 0.0] };
        let (angle, _) = falls_at(&pile(packing, 2, 0.0), toward);
        assert!((angle - want).abs() < 1e-5, "{packing}: {angle}");
    }
}

/// A ball on a step that rolls at a slight tilt, beside heavy boxes that slide at the friction
/// angle.
fn one_loose_grain() -> Scene {
    let ground = fixed(cuboid("ground", [40.0, 40.0, 1.0], [0.0, 0.0, -1.0]));
    let ridges = [-0.2, 0.2].map(|x: f64| fixed(sphere(&format!("r{x}"), 0.2, [x, 10.0, 0.2])));
    let height = 0.2 + (0.7f64.powi(2) - 0.04).sqrt();
    let blocks = json!([
        ground,
        ridges[0],
        ridges[1],
        sphere("ball", 0.5, [0.0, 10.0, height]),
        cuboid("one", [2.0, 2.0, 0.5], [0.0, 0.0, 0.0]),
        cuboid("two", [2.0, 2.0, 0.5], [5.0, 0.0, 0.0]),
    ]);
    scene(0.5, blocks, json!({}))
}

#[test]
fn loose_grains_are_taken_away_until_enough_moves() {
    let scene = one_loose_grain();
    let model = model(&scene);
    let toward = Vector3::x();
    let first = stability(&model, &[], toward, 0.0, &associative()).unwrap();
    let ball = (0.2f64 / (0.49f64 - 0.04).sqrt()).atan().to_degrees();
    assert!(first.reached && first.rounds.len() == 1);
    assert!(
        (first.rounds[0].tilt.angle_deg().unwrap() - ball).abs() < 1e-6,
        "{} and not {ball}",
        first.rounds[0].tilt.angle_deg().unwrap()
    );
    assert_eq!(first.rounds[0].moving, ["ball"]);
    let half = stability(&model, &[], toward, 0.5, &associative()).unwrap();
    let last = &half.rounds[half.answer];
    // The two blocks are parts of their own that slide at the same tilt: a round moves one of them.
    assert!(
        half.reached && half.rounds.len() == 2 && last.moved > 0.5,
        "{:?}",
        half.rounds.iter().map(|r| &r.moving).collect::<Vec<_>>()
    );
    assert!(
        (last.tilt.angle_deg().unwrap() - 0.5f64.atan().to_degrees()).abs() < 1e-6,
        "{}",
        last.tilt.angle_deg().unwrap()
    );
    assert_eq!(last.gone, ["ball"], "what fell is gone");
    assert!(last.tilt.model.assembly.find("ball").is_none());
    // As a result, with the grains that fell and a proof of the last round.
    let (file, proof) =
        saved::packing(&scene, 0.5, &Packing { model, loose: Vec::new(), directions: vec![half] })
            .unwrap()
            .unwrap();
    assert_eq!(file.directions[0].removed[0].grains, ["ball"]);
    assert_eq!(file.directions[0].status, Outcome::Found);
    prove(&proof.scene.input, &proof);
    let read: PackingFile = serde_json::from_str(&text::pretty(&file).unwrap()).unwrap();
    assert_eq!(read, file, "written and read back");
}

#[test]
fn grains_that_nothing_holds_are_left_out() {
    let mut scene = pile("fcc", 2, 0.5);
    let mut lost = voussoir::generate::expand(&scene.templates[0]).unwrap().pop().unwrap();
    (lost.id, lost.at) = ("lost".into(), [0.0, 0.0, 50.0]);
    scene.blocks.push(lost);
    let before = model(&scene);
    let (model, loose) = held(&before);
    let rest = without(&scene, &loose).unwrap();
    assert_eq!(loose, ["lost"]);
    assert!(model.assembly.find("lost").is_none() && rest.blocks.iter().all(|b| b.id != "lost"));
    assert_eq!(assess(&model, &associative()).verdict, voussoir::verdict::Verdict::Stable);
}

#[test]
fn the_averages_of_one_sphere_in_a_pocket() {
    // On three spheres at 54.7° to each other's normals, frictionless: every normal force is W / (3
    // cos α), cos α = √(2/3).
    let scene = pile("fcc", 1, 0.0);
    let model = model(&scene);
    let forces = assess(&model, &associative()).forces.clone();
    let f = fabric(&model, &forces).unwrap();
    let weight = 4.0 / 3.0 * std::f64::consts::PI;
    assert_eq!((f.grains, f.contacts, f.rattlers), (1, 3, 1), "it carries only itself");
    assert_eq!((f.coordination, f.coordination_without_rattlers), (3.0, 0.0));
    assert!(
        (f.mean_force - weight / (3.0 * (2.0f64 / 3.0).sqrt())).abs() < 1e-8 * weight,
        "{}",
        f.mean_force
    );
    assert!((f.greatest_force - 1.0).abs() < 1e-8 && f.mobilised.is_none());
    // F = diag(1/6, 1/6, 2/3); σ = Σ l ⊗ f / V with l the radius: trace = Σ R f / V, σ_zz = R cos²α
    // Σ f / V.
    for (k, want) in [1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0].into_iter().enumerate() {
        assert!((f.tensor[k][k] - want).abs() < 1e-12, "{:?}", f.tensor);
        let stress = want * 3.0 * f.mean_force / weight;
        assert!((f.stress[k][k] - stress).abs() < 1e-8, "{:?}, expected {stress}", f.stress);
    }
    assert!((f.anisotropy - 0.5).abs() < 1e-12);
    assert!(
        (f.normals.iter().sum::<f64>() - 1.0).abs() < 1e-12
            && (f.forces.iter().sum::<f64>() - 1.0).abs() < 1e-12
    );
    // The normals lie 35.3° from gravity: 1 − cos = 0.18, the second of nine bins.
    assert!((f.normals[1] - 1.0).abs() < 1e-12, "{:?}", f.normals);
}

/// A drain small enough for a test.
fn small(kind: ProtocolKind) -> Protocol {
    Protocol { kind, grains: 40, size: Some([6.0, 4.0]), rate: Some(2.0), ..Protocol::default() }
}

#[test]
fn a_deposit_follows_from_its_seed_and_reloads_bit_for_bit() {
    let [one, again, other] =
        [7, 7, 8].map(|seed| deposit(&small(ProtocolKind::Drain), seed).unwrap().scene);
    assert_eq!(one, again);
    assert_ne!(one.blocks, other.blocks);
    let written = text::pretty(&one).unwrap();
    assert_eq!(read_str("deposit", written.as_str()).unwrap().0, one);
}

#[test]
fn nothing_overlaps_before_it_falls() {
    for kind in
        [ProtocolKind::Drain, ProtocolKind::Funnel, ProtocolKind::Cylinder, ProtocolKind::Tilt]
    {
        let deposit =
            deposit(&Protocol { grains: 300, sizes: Sizes::Even(0.5), ..small(kind) }, 1).unwrap();
        let spheres: Vec<(Vector3<f64>, f64, bool)> = (deposit.scene.blocks.iter())
            .filter_map(|b| match b.shape {
                voussoir::scene::Shape::Sphere { radius } => {
                    Some((Vector3::from(b.at), radius, b.support))
                }
                _ => None,
            })
            .collect();
        let overlaps = |i: usize, j: usize| {
            let (p, q) = (&spheres[i], &spheres[j]);
            !(p.2 && q.2) && (p.0 - q.0).norm() < p.1 + q.1
        };
        let count = (0..spheres.len())
            .flat_map(|i| (0..i).map(move |j| (i, j)))
            .filter(|&(i, j)| overlaps(i, j))
            .count();
        assert_eq!(count, 0, "{kind:?}");
        assert_eq!(deposit.layers.iter().map(Vec::len).sum::<usize>(), 300);
    }
}

/// On a flat floor nothing is fixed, and the loose grains are the same.
#[test]
fn a_flat_floor_is_a_plane() {
    for kind in [ProtocolKind::Drain, ProtocolKind::Funnel, ProtocolKind::Cylinder] {
        let of = |floor| {
            let blocks = deposit(&Protocol { floor, ..small(kind) }, 1).unwrap().scene.blocks;
            let (fixed, loose): (Vec<_>, Vec<_>) = blocks.into_iter().partition(|b| b.support);
            let is_ball = |b: &&BlockSpec| matches!(b.shape, Shape::Sphere { .. });
            (
                fixed.iter().filter(is_ball).count(),
                fixed.iter().any(|b| b.id == "floor"),
                loose.len(),
            )
        };
        let ((balls, is_there, loose), flat) = (of(FloorKind::Rough), of(FloorKind::Flat));
        assert!(balls > 20 && is_there && loose == 40, "{kind:?}");
        assert_eq!(flat, (0, true, 40), "{kind:?}");
    }
}

#[test]
fn values_out_of_range_are_refused_with_their_place() {
    let bad = |change: fn(&mut Protocol)| {
        let mut protocol = small(ProtocolKind::Drain);
        change(&mut protocol);
        deposit(&protocol, 1).expect_err("a refusal").to_string()
    };
    assert!(bad(|p| p.grains = 0).contains("grains"));
    assert!(bad(|p| p.grains = usize::MAX).contains("at most"));
    assert!(bad(|p| p.diameter = f64::NAN).contains("diameter"));
    assert!(bad(|p| p.sizes = Sizes::Even(1.0)).contains("sizes"));
    assert!(bad(|p| p.friction = -0.1).contains("friction"));
    assert!(bad(|p| p.size = Some([6.0, 0.0])).contains("size[1]"));
    let coarse = |p: &mut Protocol| {
        (p.kind, p.sizes, p.drop) = (ProtocolKind::Funnel, Sizes::Even(0.9), 9.0);
        (p.grain, p.elongation, p.size) = (GrainKind::Clump, 2.0, Some([4.0, 4.0]));
    };
    let full = bad(coarse);
    assert!(full.contains("size: only 0 of 40 grains fit loosely into a circle of 2 d"), "{full}");
    assert!(bad(|p| p.drop = -1.0).contains("drop"));
    let low = bad(|p| (p.kind, p.drop) = (ProtocolKind::Funnel, 1.0));
    assert!(low.contains("drop: must be at least 1.26, got 1"), "{low}");
    assert!(bad(|p| (p.grain, p.elongation) = (GrainKind::Clump, 2.5)).contains("elongation"));
    assert!(bad(|p| (p.grain, p.corners) = (GrainKind::Hull, 3)).contains("corners"));
    let still = bad(|p| (p.kind, p.rate) = (ProtocolKind::Drum, Some(0.0)));
    assert!(still.contains("rate: must be > 0, got 0") && still.contains("degrees"), "{still}");
    let light = bad(|p| (p.kind, p.pressure) = (ProtocolKind::Shear, 0.0));
    assert!(light.contains("pressure: must be > 0") && light.contains("ρ g d"), "{light}");
    assert!(bad(|p| (p.grain, p.rolling_arm) = (GrainKind::Hull, 0.1)).contains("rolling_arm"));
}

#[test]
fn a_small_heap_comes_to_rest_in_the_same_place_in_every_unit_of_length() {
    let heap = |diameter: f64| {
        let protocol = Protocol { diameter, ..small(ProtocolKind::Drain) };
        repose::heap(&protocol, 3, &mut |_| ControlFlow::Continue(())).unwrap()
    };
    let (one, again, large) = (heap(0.01), heap(0.01), heap(10.24));
    assert!(one.rested, "{:?}", one.findings);
    assert_eq!(one.scene, again.scene, "bit for bit");
    assert_eq!(one.grains, large.grains, "the same grains fall over the edge");
    let written: Value = serde_json::from_str(&text::pretty(&one.scene).unwrap()).unwrap();
    assert_eq!(read_str("heap", written.to_string()).unwrap().0, one.scene);
}

/// Before it starts, of a box in which no slope has cells enough; the default is one that has.
#[test]
fn a_box_that_is_too_short_is_told_before_it_is_filled() {
    let said = |grains: usize, size: Option<[f64; 2]>| {
        repose::judge::foretold(&Protocol { grains, size, ..Protocol::default() })
    };
    assert!(said(500, None).is_some_and(|t| t.contains("at most 5 cells")));
    assert!(said(2000, None).is_none() && said(500, Some([15.0, 4.0])).is_none());
    let cylinder = Protocol { grains: 500, kind: ProtocolKind::Cylinder, ..Protocol::default() };
    assert!(repose::judge::foretold(&cylinder).is_none());
}

#[test]
fn a_heap_that_is_stopped_says_that_it_still_moves() {
    let mut looks = 0;
    let heap = repose::heap(&small(ProtocolKind::Drain), 1, &mut |_| {
        looks += 1;
        if looks < 3 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    })
    .unwrap();
    assert!(!heap.rested);
    assert!(heap.findings.iter().any(|f| f.text.contains("still moves")), "{:?}", heap.findings);
}

/// Grains that lie next to each other are no faces that fail to meet: nobody is told to widen a
/// tolerance fifty-fold, and no answer is asked again with such contacts closed.
#[test]
fn neighbours_in_a_packing_are_no_near_misses() {
    let ground = json!({ "id": "ground", "shape": { "box": { "size": [4, 4, 1] } }, "at": [0, 0, -0.5], "support": true });
    let ball = |id: &str, x: f64| json!({ "id": id, "shape": { "sphere": { "radius": 0.5 } }, "at": [x, 0, 0.5] });
    let balls = model(&scene(0.5, json!([ground, ball("a", 0.0), ball("b", 1.01)]), json!({})));
    let text: Vec<String> = balls.findings().map(|f| f.text.clone()).collect();
    assert!(
        text.iter().any(|t| t.contains("1 pair of round blocks, or of one and a wall, lie")
            && t.contains("nearest: a and b")),
        "{text:?}"
    );
    assert!(!text.iter().any(|t| t.contains("raise")), "{text:?}");
    assert_eq!(balls.interfaces.left_out, None);
    // Nor is a wall beside a grain that rests on others; beside one that hardly touches anything it is.
    let wall = json!({ "id": "wall", "shape": { "box": { "size": [1, 4, 4] } }, "at": [2.01, 0, 2], "support": true });
    for (other, misses) in [(0.0, 0), (-0.2, 1)] {
        let blocks = json!([ground, wall, ball("a", other), ball("b", 1.0)]);
        let left_out = model(&scene(0.5, blocks, json!({}))).interfaces.left_out;
        assert_eq!(left_out.map_or(0, |l| l.near_misses), misses, "{other}");
    }
}

#[test]
fn a_packing_that_nothing_holds_falls_and_has_no_fabric() {
    let ball = |k: usize, support: bool| {
        let shape = voussoir::scene::Shape::Sphere { radius: 0.1 };
        let spec = voussoir::scene::BlockSpec::new(format!("ball{k}"), shape);
        voussoir::scene::BlockSpec { at: [k as f64, 0.0, 0.0], support, ..spec }
    };
    let mut scene = pile("fcc", 1, 0.5);
    scene.templates.clear();
    scene.blocks = (0..3).map(|k| ball(k, k == 0)).collect();
    let model = model(&scene);
    let (held, loose) = held(&model);
    assert!(loose.is_empty() && held.assembly.free().count() == 2);
    let toward = [nalgebra::Vector3::x()];
    let packing = voussoir::analysis::stability::packing(&held, &toward, 0.0, &associative());
    let direction = &packing.unwrap().directions[0];
    let outcome = direction.rounds[direction.answer].tilt.load_factor.outcome;
    assert_eq!(outcome, Outcome::Impossible);
    let nothing = model.interfaces.list.iter().map(|_| Vec::new()).collect();
    assert!(fabric(&model, &nothing).is_none());
}
