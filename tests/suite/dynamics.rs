//! Simulations of scenes whose outcome is known: slides and topplings 1 % either side of the limit,
//! arches, columns, drums, blocks that are not convex, loads of every kind; invariance,
//! reproducibility, and contact forces that are read rightly.

use crate::ask::{cuboid, model, prism, push, scene, template};
use nalgebra::Vector3;
use serde_json::{Value, json};
use std::ops::ControlFlow;
use voussoir::{
    analysis::{Control, Law, agreement, assess},
    dynamics::{Fate, Fidelity, SimulationOutcome, SimulationSettings, simulate},
    interface::Model,
    scene::Scene,
    verdict::Verdict,
};

fn run_with(model: &Model, settings: &SimulationSettings) -> SimulationOutcome {
    simulate(model, settings, &mut |_| ControlFlow::Continue(())).expect("a simulation")
}

fn run(scene: &Scene, fidelity: Option<Fidelity>) -> SimulationOutcome {
    run_with(&model(scene), &SimulationSettings { fidelity, ..SimulationSettings::default() })
}

#[track_caller]
fn becomes(what: &str, scene: &Scene, want: Fate) -> SimulationOutcome {
    let outcome = run(scene, None);
    assert_eq!(outcome.fate, want, "{what}: {:?}", outcome.runs);
    outcome
}

/// A block on flat ground under gravity tilted towards x by `angle`: the same as a block on an
/// incline.
fn inclined(friction: f64, size: [f64; 3], angle: f64) -> Scene {
    let ground = json!({ "id": "ground", "shape": { "box": { "size": [20, 20, 1] } }, "at": [0, 0, -0.5], "support": true });
    let (s, c) = angle.sin_cos();
    scene(
        friction,
        json!([ground, cuboid("block", size, [0.0, 0.0, 0.0])]),
        json!({ "gravity": [s, 0, -c] }),
    )
}

#[test]
fn slides_one_percent_beyond_the_friction_angle_and_not_before() {
    for friction in [0.2, 0.5, 0.8] {
        for fidelity in [Fidelity::Fast, Fidelity::Fine] {
            let at = |share: f64| {
                run(&inclined(friction, [1.0, 1.0, 0.4], (friction * share).atan()), Some(fidelity))
                    .fate
            };
            assert_eq!(
                (at(0.99), at(1.01)),
                (Fate::Stands, Fate::Falls),
                "friction {friction}, {fidelity:?}"
            );
        }
    }
}

#[test]
fn topples_one_percent_beyond_the_limit_and_not_before() {
    for (width, height) in [(0.8, 2.0), (1.0, 1.0), (1.0, 0.7)] {
        for fidelity in [Fidelity::Fast, Fidelity::Fine] {
            let at = |share: f64| {
                run(
                    &inclined(3.0, [width, 1.0, height], (share * width / height).atan()),
                    Some(fidelity),
                )
                .fate
            };
            assert_eq!(
                (at(0.99), at(1.01)),
                (Fate::Stands, Fate::Falls),
                "{width} × {height}, {fidelity:?}"
            );
        }
    }
}

#[test]
fn drums_do_not_rock_and_topple_where_they_should() {
    // On a side of the twelve-cornered base, and on a corner of it; the limit is inradius or
    // circumradius over half the height.
    let drum = |turn: f64, share: f64| {
        let (n, radius, height) = (12, 0.5, 2.0);
        let angle = |i: usize| turn + std::f64::consts::TAU * i as f64 / n as f64;
        let ring =
            |z: f64| (0..n).map(move |i| [radius * angle(i).cos(), radius * angle(i).sin(), z]);
        let mut faces: Vec<Vec<usize>> =
            (0..n).map(|i| vec![i, (i + 1) % n, n + (i + 1) % n, n + i]).collect();
        faces.extend([(0..n).rev().collect(), (n..2 * n).collect()]);
        let vertices: Vec<[f64; 3]> = ring(0.0).chain(ring(height)).collect();
        let reach = (0..n).map(|i| radius * angle(i).cos()).fold(0.0, f64::max);
        let (s, c) = (share * 2.0 * reach / height).atan().sin_cos();
        let ground = json!({ "id": "ground", "shape": { "box": { "size": [20, 20, 1] } }, "at": [0, 0, -0.5], "support": true });
        let block = json!({ "id": "drum", "shape": { "polyhedron": { "vertices": vertices, "faces": faces } } });
        scene(3.0, json!([ground, block]), json!({ "gravity": [s, 0, -c] }))
    };
    let still = becomes("a drum at rest", &drum(0.0, 0.0), Fate::Stands);
    assert!(still.runs[0].relative < 1e-5 && still.runs.len() == 1, "{:?}", still.runs);
    for turn in [0.0, std::f64::consts::PI / 12.0] {
        becomes("a drum inside its limit", &drum(turn, 0.99), Fate::Stands);
        becomes("a drum beyond its limit", &drum(turn, 1.01), Fate::Falls);
    }
}

fn arch(thickness: f64, voussoirs: usize) -> Scene {
    template(
        0.7,
        json!({ "arch": { "radius": 1.0, "thickness": thickness, "depth": 1.0, "voussoirs": voussoirs } }),
        json!({}),
    )
}

#[test]
fn arches_of_fifteen_voussoirs_stand_or_fall_by_their_thickness() {
    becomes("t/R = 0.12", &arch(0.12, 15), Fate::Stands);
    becomes("t/R = 0.09", &arch(0.09, 15), Fate::Falls);
}

/// The least thickness of 16 straight-chord voussoirs is 0.1070762 R (five-hinge closed form,
/// Milankovitch 1907 for the limit).
#[test]
fn fine_steps_tell_an_arch_one_percent_from_its_least_thickness() {
    let at = |share: f64| run(&arch(0.107_076_2 * share, 16), Some(Fidelity::Fine));
    let (thick, thin) = (at(1.01), at(0.99));
    assert_eq!(
        (thick.fate, thin.fate),
        (Fate::Stands, Fate::Falls),
        "{:?} {:?}",
        thick.runs,
        thin.runs
    );
}

fn stack(count: usize, size: [f64; 3], offset: impl Fn(usize) -> f64) -> Scene {
    let ground = cuboid("ground", [4.0, 4.0, 1.0], [0.0, 0.0, -1.0]);
    let mut blocks = vec![ground];
    blocks[0]["support"] = json!(true);
    blocks.extend(
        (0..count).map(|i| cuboid(&format!("b{i}"), size, [offset(i), 0.0, size[2] * i as f64])),
    );
    scene(0.7, Value::Array(blocks), json!({ "gravity": [0, 0, -9.81] }))
}

#[test]
fn a_column_of_a_hundred_blocks_stands_five_seconds() {
    let settings = SimulationSettings {
        fidelity: Some(Fidelity::Fine),
        seconds: Some(5.0),
        ..SimulationSettings::default()
    };
    let outcome = run_with(&model(&stack(100, [1.0, 1.0, 0.5], |_| 0.0)), &settings);
    assert_eq!(outcome.fate, Fate::Stands, "{:?}", outcome.runs);
}

#[test]
fn the_harmonic_overhang_holds_at_99_percent_and_not_at_101() {
    // The edge of the table is the edge of the ground, at x = 2; block i counts from below.
    let overhang = |share: f64| {
        stack(4, [1.0, 1.0, 0.2], |i| {
            1.5 + (0..=i).map(|k| share * 0.5 / (4 - k) as f64).sum::<f64>()
        })
    };
    becomes("0.99", &overhang(0.99), Fate::Stands);
    becomes("1.01", &overhang(1.01), Fate::Falls);
}

#[test]
fn blocks_that_are_not_convex_rest_on_what_they_touch() {
    let portal = [
        [-1.25, 2.0],
        [-0.75, 2.0],
        [-0.75, 2.5],
        [0.75, 2.5],
        [0.75, 2.0],
        [1.25, 2.0],
        [1.25, 3.0],
        [-1.25, 3.0],
    ];
    let post = |id: &str, x: f64, hold: bool| {
        let mut post = cuboid(id, [0.5, 1.0, 2.0], [x, 0.0, 0.0]);
        post["support"] = json!(hold);
        post
    };
    let outcome = becomes(
        "on two posts",
        &scene(
            0.6,
            json!([post("a", -1.0, true), post("b", 1.0, true), prism("u", &portal)]),
            json!({}),
        ),
        Fate::Stands,
    );
    let shares: Vec<f64> = outcome.contacts.iter().map(|c| c.force.z / 1.75).collect();
    assert!(shares.len() == 2 && shares.iter().all(|s| (s.abs() - 0.5).abs() < 1e-6), "{shares:?}");
    // The left foot stands on nothing: it turns about the right one.
    becomes(
        "on one post",
        &scene(0.6, json!([post("b", 1.0, true), prism("u", &portal)]), json!({})),
        Fate::Falls,
    );
}

/// Reactions and weight cancel to 1e-6, vertically and with friction, at any unit.
#[test]
fn reactions_add_up_to_the_loads() {
    let scenes = [
        arch(0.15, 15),
        inclined(0.8, [1.0, 1.0, 0.5], 0.5),
        template(
            0.6,
            json!({ "wall": { "size": [1, 0.5, 0.4], "courses": 4, "blocks": 3, "first": "half", "base": "course" } }),
            json!({ "gravity": [0, 0, -9.81] }),
        ),
        stack(6, [1.0, 1.0, 0.5], |i| 0.02 * i as f64),
    ];
    for scene in &scenes {
        let outcome = becomes("at rest", scene, Fate::Stands);
        assert!(outcome.reaction_error < 1e-6, "{:.1e}", outcome.reaction_error);
    }
}

/// Two blocks one on the other under a push: each contact carries what is above it, friction
/// included.
#[test]
fn contact_forces_are_those_of_statics() {
    let blocks = json!([
        { "id": "ground", "shape": { "box": { "size": [4, 4, 1] } }, "at": [0, 0, -0.5], "support": true },
        cuboid("lower", [1.0, 1.0, 0.5], [0.0, 0.0, 0.0]), cuboid("upper", [1.0, 1.0, 0.5], [0.0, 0.0, 0.5]),
    ]);
    let dead = json!({ "loads": { "dead": [ { "block": "upper", "force": [0.1, 0.05, -0.2] }, { "block": "lower", "force": [0.02, 0, 0], "moment": [0, 0, 0.01] } ] } });
    let outcome = becomes("two blocks", &scene(0.7, blocks, dead), Fate::Stands);
    let want =
        [((0, 1), Vector3::new(-0.12, -0.05, 1.2)), ((1, 2), Vector3::new(-0.1, -0.05, 0.7))];
    assert_eq!(outcome.contacts.len(), 2);
    for (contact, (pair, force)) in outcome.contacts.iter().zip(want) {
        assert_eq!((contact.a, contact.b), pair);
        assert!((contact.force - force).norm() < 1e-6, "{:?} {}", pair, contact.force);
    }
}

#[test]
fn loads_at_points_moments_and_accelerations_act() {
    let ground = json!({ "id": "ground", "shape": { "box": { "size": [20, 20, 1] } }, "at": [0, 0, -0.5], "support": true });
    let with = |load: Value| {
        scene(
            2.0,
            json!([ground, cuboid("block", [1.0, 1.0, 1.0], [0.0, 0.0, 0.0])]),
            json!({ "loads": { "dead": [load] } }),
        )
    };
    // A cube of weight 1 topples at a horizontal force of 1 at its centre, 1/2 at its top, a moment
    // of 1/2, or a push of 1 g.
    for (share, fate) in [(0.98, Fate::Stands), (1.02, Fate::Falls)] {
        let f = share;
        becomes("at the centre", &with(json!({ "block": "block", "force": [f, 0, 0] })), fate);
        becomes(
            "at the top",
            &with(json!({ "block": "block", "force": [0.5 * f, 0, 0], "at": [0, 0, 1] })),
            fate,
        );
        becomes("moment", &with(json!({ "block": "block", "moment": [0, 0.5 * f, 0] })), fate);
        becomes("acceleration", &with(json!({ "acceleration": [f, 0, 0] })), fate);
    }
}

#[test]
fn live_loads_act_with_their_factor() {
    let pushed = scene(
        0.9,
        json!([
            cuboid("ground", [9.0, 9.0, 1.0], [0.0, 0.0, -1.0]),
            cuboid("block", [0.8, 1.0, 1.6], [0.0, 0.0, 0.0])
        ]),
        push([1.0, 0.0, 0.0]),
    );
    for (factor, fate) in [(0.0, Fate::Stands), (0.49, Fate::Stands), (0.51, Fate::Falls)] {
        let mut loaded = pushed.clone();
        loaded.blocks[0].support = true;
        loaded.loads = loaded.loads.fixed(factor);
        becomes(&format!("factor {factor}"), &loaded, fate);
    }
}

#[test]
fn the_outcome_does_not_depend_on_units() {
    let base = arch(0.11, 9);
    let want = run(&base, Some(Fidelity::Fast));
    for (length, gravity, density) in
        [(1e-3_f64, 1.0_f64, 1.0), (1e3, 9.81, 2400.0), (1.0, 1e-2, 1e-3)]
    {
        let text = json!({ "format": "voussoir-scene/1", "gravity": [0, 0, -gravity], "materials": { "unit": { "density": density } }, "joints": { "default": { "friction": 0.7 } },
            "templates": [ { "arch": { "radius": length, "thickness": 0.11 * length, "depth": length, "voussoirs": 9, "material": "unit" } } ] });
        let scaled = voussoir::scene::read_str("scaled", text.to_string()).expect("a scene").0;
        let got = run(&scaled, Some(Fidelity::Fast));
        assert_eq!(got.fate, want.fate);
        let time = |o: &SimulationOutcome| o.runs[0].time;
        let unit = (length / gravity).sqrt();
        assert!(
            (time(&got) / unit / time(&want) - 1.0).abs() < 0.05,
            "{} {}",
            time(&got) / unit,
            time(&want)
        );
        assert!(
            (got.runs[0].relative / want.runs[0].relative - 1.0).abs() < 0.2,
            "{} {}",
            got.runs[0].relative,
            want.runs[0].relative
        );
    }
}

#[test]
fn the_same_bits_come_out_on_any_number_of_threads() {
    let wall = template(
        0.6,
        json!({ "wall": { "size": [1, 0.5, 0.4], "courses": 5, "blocks": 4, "first": "half", "base": "course" } }),
        json!({ "gravity": [0.2, 0.1, -1] }),
    );
    for scene in [wall, arch(0.09, 15)] {
        let model = model(&scene);
        let bits = |threads: usize| {
            let outcome = run_with(
                &model,
                &SimulationSettings {
                    threads,
                    frames: 7,
                    fidelity: Some(Fidelity::Fast),
                    seconds: Some(3.0),
                    ..SimulationSettings::default()
                },
            );
            let numbers = outcome.frames.iter().flat_map(|f| &f.blocks).flat_map(|p| {
                p.center
                    .iter()
                    .chain(p.turn.coords.iter())
                    .chain(p.velocity.iter())
                    .copied()
                    .collect::<Vec<_>>()
            });
            let forces =
                outcome.contacts.iter().flat_map(|c| c.force.iter().copied().collect::<Vec<_>>());
            numbers.chain(forces).map(f64::to_bits).collect::<Vec<_>>()
        };
        let one = bits(1);
        assert!(one.len() > 100 && one == bits(1));
        for threads in [2, 3, 8] {
            assert!(one == bits(threads), "{threads} threads");
        }
    }
}

#[test]
fn frames_are_evenly_spread_and_the_watcher_may_stop() {
    let model = model(&stack(2, [1.0, 1.0, 0.5], |_| 0.0));
    let settings = SimulationSettings {
        frames: 10,
        fidelity: Some(Fidelity::Fast),
        to_the_end: true,
        seconds: Some(1.0),
        ..SimulationSettings::default()
    };
    let outcome = run_with(&model, &settings);
    assert!((11..=12).contains(&outcome.frames.len()), "{}", outcome.frames.len());
    let gaps: Vec<f64> = outcome.frames.windows(2).map(|f| f[1].time - f[0].time).collect();
    assert!(gaps.iter().all(|g| (g - gaps[0]).abs() < 1e-12 && *g > 0.09), "{gaps:?}");
    let stopped =
        simulate(&model, &settings, &mut |_| ControlFlow::Break(())).expect("a simulation");
    assert_eq!(stopped.fate, Fate::Undecided);
    assert!(stopped.runs[0].time < 0.5 * outcome.runs[0].time);
}

#[test]
fn a_block_that_touches_nothing_falls_at_once() {
    let mut scene = stack(1, [1.0, 1.0, 1.0], |_| 0.0);
    scene.blocks[1].at[2] += 5.0;
    let outcome = becomes("in free fall", &scene, Fate::Falls);
    // h = g t² / 2 once the load has grown: 5 % of the thickness takes a little longer than √(0.1 h
    // / g).
    let (time, least) = (outcome.collapse.expect("a time"), (0.1_f64 / 9.81).sqrt());
    assert!(time > least && time < 4.0 * least, "{time}");
}

/// Of scenes whose resultants statics fixes, simulation and verdict agree force by force; where
/// they fall, on the motion.
#[test]
fn forces_and_motions_are_those_of_the_verdict() {
    let compare = |scene: &Scene| {
        let model = model(scene);
        let answer = assess(&model, &Control::default());
        let outcome = run_with(&model, &SimulationSettings::default());
        agreement(&model, &answer, &outcome)
    };
    let standing = compare(&stack(5, [1.0, 1.0, 0.5], |i| 0.03 * i as f64));
    let forces = standing.forces.expect("forces");
    assert!(
        standing.agrees == Some(true)
            && forces.determinate
            && forces.pairs == 5
            && forces.largest < 1e-6,
        "{forces:?}"
    );
    // Where a joint slides the mechanism of limit analysis lifts by the friction angle, and the
    // block does not.
    let lift = 1.0 / f64::hypot(1.0, 0.5);
    for (scene, want) in
        [(inclined(0.5, [1.0, 1.0, 0.4], 0.6), lift), (inclined(3.0, [0.5, 1.0, 2.0], 0.3), 1.0)]
    {
        let falling = compare(&scene);
        let motion = falling.motion.expect("a motion");
        assert!(
            falling.agrees == Some(true) && (motion - want).abs() < 2e-3,
            "{motion} for {want}"
        );
    }
    assert!(compare(&arch(0.09, 15)).motion.expect("a motion") > 0.9);
}

/// A sphere of radius r with a rolling arm c rolls down an incline steeper than c/r.
#[test]
fn a_rolling_arm_holds_a_sphere_up_to_its_slope() {
    let at = |share: f64| {
        let (s, c) = (share * 0.1_f64).atan().sin_cos();
        let blocks = json!([
            { "id": "ground", "shape": { "box": { "size": [20, 20, 1] } }, "at": [0, 0, -0.5], "support": true },
            { "id": "ball", "shape": { "sphere": { "radius": 0.5 } }, "at": [0, 0, 0.5] },
        ]);
        let mut scene = scene(0.8, blocks, json!({ "gravity": [s, 0, -c] }));
        scene.joints.default.rolling_arm = Some(0.05);
        scene
    };
    for (share, fate) in [(0.9, Fate::Stands), (0.97, Fate::Stands), (1.03, Fate::Falls)] {
        becomes(&format!("{share} of c/r"), &at(share), fate);
    }
}

/// A sphere of radius r in a groove, with a rolling arm c: 30° + atan(c/r), and no earlier, by
/// couples that the engine does not know.
#[test]
fn a_rolling_arm_holds_a_sphere_in_a_groove_beyond_its_slope() {
    let at = |share: f64| {
        let (s, c) = (share * 35.71059f64.to_radians().tan()).atan().sin_cos();
        let ball = |id: &str, x: f64, z: f64, support: bool| json!({ "id": id, "shape": { "sphere": { "radius": 0.5 } }, "at": [x, 0, z], "support": support });
        let blocks = json!([
            ball("left", -0.5, 0.0, true),
            ball("right", 0.5, 0.0, true),
            ball("ball", 0.0, 0.75f64.sqrt(), false)
        ]);
        let mut scene = scene(0.5, blocks, json!({ "gravity": [s, 0, -c] }));
        scene.joints.default.rolling_arm = Some(0.05);
        scene
    };
    for (share, fate) in [(0.97, Fate::Stands), (1.03, Fate::Falls)] {
        becomes(&format!("{share} of the slope"), &at(share), fate);
    }
}

/// Three spheres on the ground and a fourth above them, rigidly joined: it topples over two of
/// them.
#[test]
fn a_clump_topples_at_the_limit_and_not_before() {
    let (r, foot) = (0.5, 1.0 / 3f64.sqrt());
    let limit = 0.5 * foot / (r * (1.0 + (8.0f64 / 3.0).sqrt() / 4.0));
    let at = |share: f64| {
        let (s, c) = (share * limit).atan().sin_cos();
        let ball = |degrees: f64| json!({ "at": [foot * degrees.to_radians().cos(), foot * degrees.to_radians().sin(), r], "radius": r });
        let spheres = json!([ball(60.0), ball(180.0), ball(300.0), { "at": [0, 0, r + (2.0f64 / 3.0).sqrt()], "radius": r }]);
        let ground = json!({ "id": "ground", "shape": { "box": { "size": [20, 20, 1] } }, "at": [0, 0, -0.5], "support": true });
        scene(
            0.8,
            json!([ground, { "id": "clump", "shape": { "clump": { "spheres": spheres } } }]),
            json!({ "gravity": [s, 0, -c] }),
        )
    };
    for (share, fate) in [(0.97, Fate::Stands), (1.03, Fate::Falls)] {
        becomes(&format!("{share} of the limit"), &at(share), fate);
    }
}

/// Water in a joint takes its part off the pressure that friction sees.
#[test]
fn water_in_a_joint_lets_it_slide_earlier() {
    for (share, fate) in [(0.97, Fate::Stands), (1.03, Fate::Falls)] {
        let ground = json!({ "id": "ground", "shape": { "box": { "size": [20, 20, 1] } }, "at": [0, 0, -0.5], "support": true });
        let push = json!({ "loads": { "dead": [ { "block": "block", "force": [0.5 * 0.6 * share, 0, 0] } ] } });
        let mut scene =
            scene(0.5, json!([ground, cuboid("block", [2.0, 1.0, 0.5], [0.0, 0.0, 0.0])]), push);
        // Weight 1, area 2: the water carries 0.4.
        scene.joints.default.pore_pressure = Some(0.2);
        becomes(&format!("{share} of μ (W − U)"), &scene, fate);
    }
}

#[test]
fn strengths_that_are_left_out_are_told_and_not_compared() {
    let mut scene = stack(2, [1.0, 1.0, 0.5], |_| 0.0);
    scene.joints.default.cohesion = Some(1e4);
    let outcome = becomes("glued", &scene, Fate::Stands);
    assert!(outcome.findings.iter().any(|f| f.text.contains("cohesion")), "{:?}", outcome.findings);
    let model = model(&scene);
    let answer = assess(&model, &Control::default());
    assert_eq!(agreement(&model, &answer, &outcome).agrees, None);
}

#[test]
fn many_simulations_in_a_work_stealing_pool_do_not_pile_up_on_one_stack() {
    // A worker that waited for the engine began the next simulation on top of the last, until the
    // stack was full.
    use rayon::prelude::*;
    use std::cell::Cell;
    thread_local! { static DEPTH: Cell<usize> = const { Cell::new(0) }; }
    let text = r#"{ "format": "voussoir-scene/1", "joints": { "default": { "friction": 0.6 } },
        "templates": [{ "column": { "blocks": 2, "size": [1, 1, 0.5] } }] }"#;
    let (scene, _) = voussoir::scene::read_str("test", text).unwrap();
    let model = voussoir::interface::prepare(&scene).unwrap();
    let settings = voussoir::dynamics::SimulationSettings {
        fidelity: Some(voussoir::dynamics::Fidelity::Fast),
        ..Default::default()
    };
    let one = |_| {
        DEPTH.set(DEPTH.get() + 1);
        let depth = DEPTH.get();
        let watch = &mut |_: &voussoir::dynamics::Progress| std::ops::ControlFlow::Continue(());
        assert!(voussoir::dynamics::simulate(&model, &settings, watch).is_ok());
        DEPTH.set(DEPTH.get() - 1);
        depth
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(pool.install(|| (0..24).into_par_iter().map(one).max()), Some(1));
}

/// A ball on a floor that lie `gap` apart, closed within `contact.gap`.
fn ball_on_floor(gap: f64) -> Scene {
    let ground = json!({ "id": "ground", "shape": { "box": { "size": [2, 2, 1] } }, "at": [0, 0, -0.5], "support": true });
    let ball =
        json!({ "id": "ball", "shape": { "sphere": { "radius": 0.5 } }, "at": [0, 0, 0.5 + gap] });
    scene(0.5, json!([ground, ball]), json!({ "contact": { "gap": 1e-3 } }))
}

/// What counts as touching in the verdict does so here: grains that were left with overlaps of
/// 5e-4 of their size were thrown out of their heap.
#[test]
fn balls_whose_gap_or_overlap_was_closed_touch_from_the_start() {
    let exact = becomes("touching", &ball_on_floor(0.0), Fate::Stands).runs[0].displacement;
    for gap in [-5e-4, 5e-4] {
        let outcome = becomes("closed", &ball_on_floor(gap), Fate::Stands);
        let moved = outcome.runs[0].displacement;
        assert!((moved - exact).abs() < 1e-6, "{gap}: {moved} instead of {exact}");
    }
}

#[test]
fn heaps_that_were_left_at_rest_stand_in_time_and_by_verdict() {
    for name in ["heap.1.json", "heap.2.json"] {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("tests/cases/findings/confusing")
            .join(name);
        let (heap, _) = voussoir::scene::read_file(&path).expect("a scene");
        becomes(name, &heap, Fate::Stands);
        let associative = Control { law: Law::Associative, ..Control::default() };
        assert_eq!(assess(&model(&heap), &associative).verdict, Verdict::Stable, "{name}");
    }
}
