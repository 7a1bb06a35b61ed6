//! Large displacements that slide, under dry friction: closed forms of blocks, wedges and tables;
//! every point with proof from its poses alone.

use crate::ask::{asked, cuboid, fixed, model, prism, push, scene, template};
use serde_json::{Value, json};
use voussoir::{
    analysis::{ControlPoint, LimitOptions, PushOptions, Question, SettleOptions, SupportMove},
    path::saved::read_poses,
    proof::{
        ResultFile,
        answer::Required,
        path::{PathEventKind, PathPoint, PathResult, PathStatus},
    },
    scene::Scene,
};

fn settled(scene: &Scene, moves: &[(&str, [f64; 3], [f64; 3])], at: &[f64]) -> ResultFile {
    let moves = moves
        .iter()
        .map(|(support, way, turn_deg)| SupportMove {
            turn_deg: *turn_deg,
            ..SupportMove::along(*support, *way)
        })
        .collect();
    let options = SettleOptions { moves, at: at.to_vec(), ..Default::default() };
    asked(scene, &Question::Settle(options))
}

fn path(file: &ResultFile) -> &PathResult {
    file.path.as_ref().expect("a path")
}

fn status(file: &ResultFile) -> PathStatus {
    file.answer.path().expect("a path").status
}

fn close(value: f64, expected: f64, relative: f64) {
    let off = (value - expected).abs();
    assert!(off <= relative * expected.abs(), "{value} instead of {expected}");
}

/// The way of a block at a point.
fn way(scene: &Scene, point: &PathPoint, block: &str) -> [f64; 3] {
    let assembly = model(scene).assembly;
    let poses = read_poses(&assembly, &point.poses).expect("poses");
    poses[assembly.find(block).expect("a block")].shift.into()
}

/// A table turns under a block, which slides down when the tangent of its tilt is μ, and is not
/// stopped by anything: it falls there.
#[test]
fn a_block_on_a_table_that_tilts_slides_at_its_angle_of_friction() {
    for mu in [0.2_f64, 0.5, 0.8] {
        let blocks = json!([
            fixed(cuboid("table", [4.0, 1.0, 0.5], [0.0, 0.0, -0.5])),
            cuboid("block", [1.0, 1.0, 0.5], [0.0, 0.0, 0.0]),
        ]);
        let scene = scene(mu, blocks, json!({}));
        let file = settled(&scene, &[("table", [0.0; 3], [0.0, 45.0, 0.0])], &[]);
        assert_eq!(status(&file), PathStatus::Falls);
        let said = file.answer.path().unwrap();
        let expected = mu.atan().to_degrees() / 45.0;
        close(said.value.unwrap(), expected, 1e-7);
        close(said.falls_at.unwrap(), expected, 1e-7);
        assert!(said.value < said.falls_at);
    }
}

/// Faces at 20° to the vertical: as each support moves out by `s` the wedge between them sinks by
/// `s / tan 20°`, and whatever its depth friction leaves `W / (2 tan(20° + φ))` of thrust.
fn wedge(mu: f64) -> Scene {
    let (b, t) = (0.5, 20f64.to_radians().tan());
    let top = b + t;
    scene(
        mu,
        json!([
            prism("key", &[[-b, 0.0], [b, 0.0], [top, 1.0], [-top, 1.0]]),
            fixed(prism("left", &[[-2.0, 0.0], [-b, 0.0], [-top, 1.0], [-2.0, 1.0]])),
            fixed(prism("right", &[[b, 0.0], [2.0, 0.0], [2.0, 1.0], [top, 1.0]])),
        ]),
        json!({}),
    )
}

const APART: [(&str, [f64; 3], [f64; 3]); 2] =
    [("left", [-0.2, 0.0, 0.0], [0.0; 3]), ("right", [0.2, 0.0, 0.0], [0.0; 3])];

#[test]
fn a_wedge_between_supports_that_part_sinks_at_a_constant_thrust() {
    let tangent = 20f64.to_radians().tan();
    for mu in [0.1_f64, 0.3, 0.7] {
        let scene = wedge(mu);
        let file = settled(&scene, &APART, &[0.1, 0.3]);
        assert_eq!(status(&file), PathStatus::Reached, "{:?}", file.answer.path());
        let weight = 1.0 + tangent;
        let thrust = 0.5 * weight / (20f64.to_radians() + mu.atan()).tan();
        let points = &path(&file).points;
        assert!(points.iter().any(|p| p.value == 0.1) && points.last().unwrap().value == 1.0);
        for p in points {
            let [x, y, z] = way(&scene, p, "key");
            let sinks = -0.2 * p.value / tangent;
            assert!((z - sinks).abs() < 1e-9 && x.abs() < 1e-9 && y.abs() < 1e-9, "{z} {sinks}");
            for r in &p.reactions {
                close(r.force[0].abs(), thrust, 1e-7);
            }
            if p.value > 0.0 {
                assert_eq!((p.slips.len(), p.hinges.len()), (2, 0));
                // Along the face.
                for slip in &p.slips {
                    close(slip.way, 0.2 * p.value / 20f64.to_radians().sin(), 1e-7);
                }
            }
        }
        let [event] = &path(&file).events[..] else { panic!("{:?}", path(&file).events) };
        assert_eq!((event.kind, event.slides.len(), event.value), (PathEventKind::Slides, 2, 0.0));
    }
}

/// A support drawn away from under a block that rests on two: the one that carries more takes it
/// along, and the other slides beneath it with μ × what it carries. Three thin slabs do the same: the
/// lower face of the first and the upper of the last are near each other, and never meet.
#[test]
fn a_support_drawn_away_slides_under_what_rests_on_another() {
    draws_away(&[cuboid("block", [2.0, 1.0, 0.5], [-0.25, 0.0, 0.0])]);
    let slab = |id: &str, z: f64| cuboid(id, [2.0, 1.0, 0.05], [-0.25, 0.0, z]);
    draws_away(&[slab("block", 0.0), slab("second", 0.05), slab("third", 0.1)]);
}

fn draws_away(resting: &[Value]) {
    let mut blocks = vec![
        fixed(cuboid("left", [2.0, 1.0, 0.5], [-1.0, 0.0, -0.5])),
        fixed(cuboid("right", [2.0, 1.0, 0.5], [1.0, 0.0, -0.5])),
    ];
    blocks.extend(resting.iter().cloned());
    let scene = scene(0.4, json!(blocks), json!({}));
    let file = settled(&scene, &[("right", [0.5, 0.0, 0.0], [0.0; 3])], &[]);
    assert_eq!(status(&file), PathStatus::Reached, "{:?}", file.answer.path());
    for p in path(&file).points.iter().filter(|p| p.value > 0.0) {
        assert!(way(&scene, p, "block").iter().all(|w| w.abs() < 1e-9));
        let [fx, _, fz] = p.reactions[0].force;
        assert!(fz < 0.0);
        close(fx, 0.4 * fz, 1e-7);
        let [slip] = &p.slips[..] else { panic!("{:?}", p.slips) };
        close(slip.way, 0.5 * p.value, 1e-7);
    }
}

fn pushed(scene: &Scene, block: &str, point: [f64; 3], toward: [f64; 3], at: &[f64]) -> ResultFile {
    let control = ControlPoint { block: block.into(), point };
    let options = PushOptions { control, toward, at: at.to_vec(), from: Vec::new() };
    asked(scene, &Question::Push(options))
}

/// Load factors of the points up to a way of the control point, m.
fn factors(file: &ResultFile, to: f64) -> Vec<f64> {
    let points = path(file).points.iter().filter(|p| p.value <= to);
    points.map(|p| p.load_factor.expect("a load factor")).collect()
}

/// What slid with a friction of `μ` up to where the edge lies `μ h / 2` before its centre of mass
/// turns about the edge from there, sticking to it: where the centre is at a distance `x` before it,
/// at one of `r` from it, `λ = x / √(r² − x²)`, down to zero where the centre is above it.
fn tips_over_the_edge(file: &ResultFile, edge: f64, end: f64) {
    let said = file.answer.path().expect("a path");
    assert_eq!(said.status, PathStatus::Vanishes, "{said:?}");
    close(said.value.expect("a value"), end, 1e-6);
    let radius = (end - edge).hypot(0.25);
    let beyond = path(file).points.iter().filter(|p| p.value > edge + 1e-3);
    let mut seen = 0;
    for p in beyond {
        let x = (end - p.value).max(0.0);
        let exact = x / (radius * radius - x * x).sqrt();
        let off = (p.load_factor.expect("a load factor") - exact).abs();
        assert!(off < 1e-5, "{off} at {}", p.value);
        assert_eq!(p.hinges.len(), 1);
        seen += 1;
    }
    assert!(seen > 2, "{seen}");
}

/// Pushed by its own weight × λ a block slides at λ = μ, until what presses it, `μ h / 2` before its
/// centre of mass, reaches the edge of the table; from there it tips over it.
#[test]
fn a_block_that_is_pushed_slides_at_its_friction_up_to_the_edge_and_tips_over_it() {
    let blocks = json!([
        fixed(cuboid("table", [4.0, 1.0, 0.5], [0.0, 0.0, -0.5])),
        cuboid("block", [1.0, 1.0, 0.5], [1.0, 0.0, 0.0]),
    ]);
    let scene = scene(0.3, blocks, push([1.0, 0.0, 0.0]));
    let ways: Vec<f64> = (1..40).map(|k| 0.025 * f64::from(k)).collect();
    let file = pushed(&scene, "block", [1.0, 0.0, 0.25], [1.0, 0.0, 0.0], &ways);
    assert!(ways.iter().all(|w| path(&file).points.iter().any(|p| p.value == *w)));
    let edge = 1.0 - 0.3 * 0.25;
    let found = factors(&file, edge - 1e-6);
    assert!(found.len() >= 37, "{}", found.len());
    found.iter().for_each(|l| close(*l, 0.3, 1e-6));
    for p in path(&file).points.iter().filter(|p| p.value < edge - 1e-6) {
        assert!((way(&scene, p, "block")[2]).abs() < 1e-9, "it does not rise");
        assert!(p.value == 0.0 || (p.slips[0].way - p.value).abs() < 1e-9);
    }
    let first = &path(&file).events[0];
    assert_eq!((first.kind, first.value), (PathEventKind::Slides, 0.0));
    tips_over_the_edge(&file, edge, 1.0);
    // Another number is not proved by the same evidence.
    let other = |v: &mut Value| {
        let claim = &mut v["evidence"]["push"]["points"][20]["certificate"]["claim"];
        let own = claim.as_object_mut().unwrap().values_mut().next().unwrap();
        for key in ["value", "lower", "upper"] {
            if let Some(number) = own.get(key).and_then(Value::as_f64) {
                own[key] = json!(1.001 * number);
            }
        }
    };
    crate::ask::edits_are_refused(&scene, &file, &[("another load factor", &other)]);
}

/// Pushed up an incline at an angle α it slides at `tan(α + φ)`, and stays on it.
#[test]
fn a_block_that_is_pushed_up_an_incline_slides_at_the_tangent_of_both_angles() {
    let (angle, mu) = (10f64.to_radians(), 0.6_f64);
    let at =
        |x: f64, y: f64| [x * angle.cos() - y * angle.sin(), x * angle.sin() + y * angle.cos()];
    let slope = prism("slope", &[at(-4.0, -1.0), at(4.0, -1.0), at(4.0, 0.0), at(-4.0, 0.0)]);
    let block = prism("block", &[at(-0.5, 0.0), at(0.5, 0.0), at(0.5, 0.4), at(-0.5, 0.4)]);
    let scene = scene(mu, json!([fixed(slope), block]), push([1.0, 0.0, 0.0]));
    let [x, z] = at(0.0, 0.2);
    let file = pushed(&scene, "block", [x, 0.0, z], [1.0, 0.0, 0.0], &[]);
    // It never ends: where it is followed no farther that is said, and no answer.
    assert_eq!(status(&file), PathStatus::Open, "{:?}", file.answer.path());
    let last = path(&file).points.last().map(|p| p.value).expect("a point");
    assert!(last > 1.0 && file.run.why.path.iter().any(|why| why.contains("still resists")));
    for (p, l) in path(&file).points.iter().zip(factors(&file, f64::INFINITY)) {
        close(l, (angle + mu.atan()).tan(), 1e-6);
        let rise = way(&scene, p, "block")[2];
        assert!((rise - p.value * angle.tan()).abs() < 1e-9, "{rise} at {}", p.value);
    }
}

/// Of a stack whose top joint has a friction of 0.2 the top slides at λ = 0.2, whatever the others
/// could carry, up to where it begins to tip, and over the edge from there.
#[test]
fn a_stack_that_is_pushed_slides_at_its_weakest_joint() {
    let blocks = json!([
        fixed(cuboid("ground", [20.0, 1.0, 0.5], [0.0, 0.0, -0.5])),
        cuboid("a", [1.0, 1.0, 0.5], [0.0, 0.0, 0.0]),
        cuboid("b", [1.0, 1.0, 0.5], [0.0, 0.0, 0.5]),
        cuboid("c", [1.0, 1.0, 0.5], [0.0, 0.0, 1.0]),
    ]);
    let joints = json!({
        "default": { "friction": 0.6 }, "overrides": [{ "blocks": ["b", "c"], "friction": 0.2 }],
    });
    let mut more = push([1.0, 0.0, 0.0]);
    more["joints"] = joints;
    let scene = scene(0.6, blocks, more);
    let ways: Vec<f64> = (1..50).map(|k| 0.01 * f64::from(k)).collect();
    let file = pushed(&scene, "c", [0.0, 0.0, 1.25], [1.0, 0.0, 0.0], &ways);
    let edge = 0.5 - 0.2 * 0.25;
    let found = factors(&file, edge - 1e-6);
    assert!(found.len() > 40, "{}", found.len());
    found.iter().for_each(|l| close(*l, 0.2, 1e-6));
    for p in &path(&file).points {
        assert!(way(&scene, p, "b").iter().all(|w| w.abs() < 1e-9));
    }
    tips_over_the_edge(&file, edge, 0.5);
}

/// What slid is in the poses: none of it can be changed.
#[test]
fn changed_slips_and_poses_are_refused() {
    let scene = wedge(0.3);
    let file = settled(&scene, &APART, &[]);
    crate::ask::leaves_hold(&file);
    let middle = path(&file).points.len() / 2;
    let poses = |v: &mut Value, change: &dyn Fn(&mut Vec<Value>)| {
        let own = &mut v["evidence"]["settle"]["points"][middle]["poses"];
        change(own.as_array_mut().unwrap());
    };
    let edits: [crate::ask::Edit; 2] = [
        ("a wedge that has not sunk", &|v| {
            poses(v, &|list| list.retain(|pose| pose["block"] != "key"));
        }),
        ("a wedge that has sunk more", &|v| {
            poses(v, &|list| {
                let key = list.iter_mut().find(|pose| pose["block"] == "key").unwrap();
                key["shift"][2] = json!(key["shift"][2].as_f64().unwrap() - 1e-3);
            });
        }),
    ];
    crate::ask::edits_are_refused(&scene, &file, &edits);
}

/// Units, places and densities change no share of the movement.
#[test]
fn units_change_nothing_about_a_motion_that_slides() {
    let arch = |scale: f64, density: f64, at: f64| {
        let arch = json!({
            "radius": scale, "thickness": 0.2 * scale, "depth": scale, "voussoirs": 10,
            "at": [at, 0.0, -at],
        });
        let more = json!({ "materials": { "unit": { "density": density } } });
        template(0.4, json!({ "arch": arch }), more)
    };
    let ends = |scale: f64, density: f64, at: f64| {
        let scene = arch(scale, density, at);
        let file = settled(&scene, &[("springer_right", [0.05 * scale, 0.0, 0.0], [0.0; 3])], &[]);
        (status(&file), file.answer.path().unwrap().value.unwrap())
    };
    let (how, value) = ends(1.0, 1.0, 0.0);
    for (scale, density, at) in [(1e-3, 1e3, 0.0), (1e3, 1e-3, 0.0), (1.0, 1.0, 1e3)] {
        let (other, there) = ends(scale, density, at);
        assert_eq!(other, how);
        close(there, value, 1e-6);
    }
}

/// A block pushed by its own weight bears λ = μ: what is required beyond is said not to be met, in the
/// result too.
#[test]
fn what_is_required_and_not_there_is_said() {
    let blocks = json!([
        fixed(cuboid("table", [4.0, 1.0, 0.5], [0.0, 0.0, -0.5])),
        cuboid("block", [1.0, 1.0, 0.5], [0.0, 0.0, 0.0]),
    ]);
    let scene = scene(0.5, blocks, push([1.0, 0.0, 0.0]));
    for (least, met) in [(0.45, true), (0.55, false)] {
        let options = LimitOptions { require: Some(least), ..LimitOptions::default() };
        let file = asked(&scene, &Question::Limit(options));
        let found = file.required.map(|Required { least, met, .. }| (least, met));
        assert_eq!(found, Some((least, Some(met))));
    }
}

/// Of an arch whose joint slides at once the proved number is the bound, and no load factor.
#[test]
fn where_a_joint_slides_at_once_the_bound_is_no_load_factor() {
    let arch = json!({
        "radius": 2.158388777979293, "thickness": 1.1623333537181528, "depth": 1, "voussoirs": 10,
        "embrace_deg": 106.4432364439703,
    });
    let load = json!({ "loads": { "live": [{ "block": "v06", "force": [1000, 0, -300] }] } });
    let scene = template(0.7, json!({ "arch": arch }), load);
    let file = pushed(&scene, "v06", [1.0, 0.0, 2.0], [1.0, 0.0, 0.0], &[]);
    assert_eq!(status(&file), PathStatus::Slides);
    let last = path(&file).points.last().expect("a point");
    assert!(last.load_factor.is_none() && last.most.is_some(), "{last:?}");
}
