//! Large displacements: closed forms of spreading arches, the exact four-bar of an arch that is
//! pushed over, what a settling base carries; every point with proof, and none that was moved.

use crate::ask::{cuboid, fixed, model, prove, push, scene, template};
use nalgebra::Vector3;
use serde_json::{Value, json};
use std::ops::ControlFlow;
use voussoir::{
    analysis::{
        Answer, Control, ControlPoint, PushOptions, Question, SettleOptions, SupportMove, ask,
    },
    deadline::Deadline,
    dynamics::{Fate, Fidelity, SimulationSettings, simulate},
    path::{Carried, Drive, Moves, saved::read_poses},
    proof::{
        ResultFile,
        path::{DrivenBy, PathEventKind, PathPoint, PathResult, PathStatus},
        saved,
    },
    scene::Scene,
};

const NO_SLIDING: f64 = f64::INFINITY;

fn followed(scene: &Scene, question: &Question) -> ResultFile {
    let model = model(scene);
    let answer = ask(question, scene, &model, &Control::default()).expect("an answer");
    assert!(matches!(answer, Answer::Path(_)));
    let file = saved::of(question, scene, &model, &answer).expect("a result");
    prove(scene, &file);
    file
}

fn path(file: &ResultFile) -> &PathResult {
    file.path.as_ref().expect("a path")
}

fn arch(voussoirs: usize, thickness: f64, embrace_deg: f64, more: Value) -> Scene {
    let arch = json!({
        "radius": 1, "thickness": thickness, "depth": 1, "voussoirs": voussoirs,
        "embrace_deg": embrace_deg,
    });
    template(NO_SLIDING, json!({ "arch": arch }), more)
}

fn to(support: &str, way: [f64; 3]) -> SupportMove {
    SupportMove::along(support, way)
}

/// Both supports of an arch move outwards by the parameter, m.
fn spread(scene: &Scene, at: &[f64]) -> ResultFile {
    let moves = vec![to("springer_left", [-1.0, 0.0, 0.0]), to("springer_right", [1.0, 0.0, 0.0])];
    followed(
        scene,
        &Question::Settle(SettleOptions { moves, at: at.to_vec(), ..Default::default() }),
    )
}

/// Horizontal thrust on the right springer over the weight of the arch.
fn thrust(scene: &Scene, point: &PathPoint) -> f64 {
    let m = model(scene);
    let weight: f64 = m.assembly.free().map(|i| m.assembly.weight(i)).sum();
    let right = point.reactions.iter().find(|r| r.support == "springer_right").expect("it moves");
    right.force[0] / weight
}

/// How far the extrados of the crown joint has sunk.
fn crown_drop(scene: &Scene, point: &PathPoint, voussoirs: usize, thickness: f64) -> f64 {
    let m = model(scene);
    let poses = read_poses(&m.assembly, &point.poses).expect("poses");
    let crown = m.assembly.find(&format!("v{:02}", voussoirs / 2)).expect("a keystone");
    let top = Vector3::new(0.0, 0.0, 1.0 + 0.5 * thickness);
    -(poses[crown].apply(&m.assembly.blocks[crown].centroid, &top) - top).z
}

fn close(value: f64, expected: f64, relative: f64) {
    let off = (value - expected).abs();
    assert!(off <= relative * expected.abs(), "{value} instead of {expected}");
}

/// Three hinges, at the extrados of the crown and the intrados of the haunches, until the thrust
/// reaches the extrados of the springings: closed forms of that geometry.
#[test]
fn spreading_arches_fall_where_the_closed_form_says() {
    for (n, t, falls, start, end, drop) in [
        (12, 0.12, 0.025258679449, 0.191389585, 0.213214048, 0.03652223),
        (16, 0.12, 0.01871430258, 0.19165171, 0.209233548, 0.028267788),
        (12, 0.15, 0.070524908919, 0.17711496, 0.242019274, 0.105359767),
        (16, 0.15, 0.058861058481, 0.176565897, 0.234573351, 0.091177719),
        (12, 0.2, 0.135125230862, 0.155438863, 0.292044486, 0.209997974),
        (20, 0.2, 0.152678286557, 0.154244839, 0.305047575, 0.233295142),
    ] {
        let scene = arch(n, t, 180.0, json!({}));
        let file = spread(&scene, &[]);
        let said = file.answer.path().expect("a path").clone();
        assert_eq!(said.status, PathStatus::Falls, "{said:?}");
        let (lower, upper) = (said.value.expect("it stands"), said.falls_at.expect("it falls"));
        assert!(lower < upper && upper - lower < 1e-6 * upper);
        close(lower, falls, 1e-7);
        let p = path(&file);
        let last = p.points.last().expect("points");
        close(thrust(&scene, &p.points[0]), start, 1e-8);
        close(thrust(&scene, last), end, 1e-8);
        close(crown_drop(&scene, last, n, t), drop, 1e-6);
        assert_eq!(last.hinges.len(), 3, "{:?}", last.hinges);
        let [event] = &p.events[..] else { panic!("{:?}", p.events) };
        let springings = event.opens.iter().flatten().filter(|id| id.starts_with("springer"));
        assert_eq!((event.kind, springings.count()), (PathEventKind::Falls, 2));
    }
}

#[test]
fn thrust_and_crown_of_a_spreading_arch_on_the_way() {
    let ways = [0.0, 0.01, 0.02, 0.03, 0.04, 0.05, 0.0588];
    let thrusts = [
        0.1765658973,
        0.1844655331,
        0.1930073919,
        0.2022936067,
        0.2124507186,
        0.2236377617,
        0.2344943028,
    ];
    let drops =
        [0.0, 0.0139702592, 0.0284944294, 0.0436191487, 0.0593987285, 0.0758970563, 0.0910701536];
    let turns =
        [0.0, 0.0180463901, 0.0365690033, 0.0556145684, 0.0752376118, 0.0955024107, 0.1139268128];
    let scene = arch(16, 0.15, 180.0, json!({}));
    let file = spread(&scene, &ways);
    let assembly = model(&scene).assembly;
    for (k, way) in ways.into_iter().enumerate() {
        let point = path(&file).points.iter().find(|p| p.value == way).expect("asked for");
        close(thrust(&scene, point), thrusts[k], 1e-8);
        let drop = crown_drop(&scene, point, 16, 0.15);
        assert!((drop - drops[k]).abs() <= 1e-8 * drops[k] + 1e-10, "{drop}");
        let poses = read_poses(&assembly, &point.poses).unwrap();
        let turn = poses[assembly.find("v08").unwrap()].turn.angle();
        assert!((turn - turns[k]).abs() <= 1e-8 * turns[k] + 1e-10, "{turn}");
    }
}

/// The line of thrust meets the intrados of the next joint. With both hinges open the motion gains
/// power at once, and where the first has closed again the line of thrust of the second leaves the
/// arch elsewhere: at the springing by 0.47 of the thickness in the first of these, so that it falls.
#[test]
fn hinges_of_flatter_arches_jump() {
    for (n, embrace, t, way, opens) in [
        (16, 160.0, 0.15, 0.107189188, [["v02", "v03"], ["v12", "v13"]]),
        (20, 140.0, 0.15, 0.1147231589, [["v02", "v03"], ["v16", "v17"]]),
        (16, 120.0, 0.2, 0.1668102716, [["v00", "v01"], ["v14", "v15"]]),
    ] {
        let file = spread(&arch(n, t, embrace, json!({})), &[]);
        let [fall] = &path(&file).events[..] else { panic!("{:?}", path(&file).events) };
        close(fall.value, way, 1e-7);
        // The hinge jumps, and where that leads to nothing rests.
        assert_eq!(fall.kind, PathEventKind::Falls);
        for pair in opens.map(|pair| pair.map(String::from)) {
            assert!(fall.opens.contains(&pair), "{:?}", fall.opens);
        }
        let said = file.answer.path().unwrap();
        assert_eq!(said.status, PathStatus::Falls);
        close(said.falls_at.unwrap(), way, 1e-7);
    }
}

/// Hinged at joint 1, then at joint 2, by the closed form of three hinges: the first has an
/// equilibrium beyond it, the second has none.
#[test]
fn a_hinge_that_jumps_is_no_collapse() {
    let file = spread(&arch(30, 0.15, 120.0, json!({})), &[]);
    let p = path(&file);
    // The second jump leads nowhere: it falls.
    let [jump, fall] = &p.events[..] else { panic!("{:?}", p.events) };
    assert_eq!((jump.kind, fall.kind), (PathEventKind::Jumps, PathEventKind::Falls));
    close(jump.value, 0.10353114576057415, 1e-8);
    close(fall.value, 0.11384580641253933, 1e-8);
    assert_eq!(jump.opens, [["v01", "v02"], ["v27", "v28"]].map(|pair| pair.map(String::from)));
    assert_eq!(jump.closes, [["v00", "v01"], ["v28", "v29"]].map(|pair| pair.map(String::from)));
    assert!(jump.jump.is_some_and(|way| way > 0.01 && way < 0.03));
}

/// In space: a barrel of courses in running bond, with friction, goes as its plane section does,
/// whose thrust is that of the arch when its supports are as far apart.
#[test]
fn a_barrel_in_running_bond_goes_as_its_section() {
    let barrel =
        json!({ "radius": 1, "thickness": 0.15, "depth": 2, "voussoirs": 16, "courses": 3 });
    let scene = template(0.6, json!({ "barrel": barrel }), json!({}));
    let moves = vec![to("springer_right", [0.1, 0.0, 0.0])];
    let question = Question::Settle(SettleOptions { moves, at: Vec::new(), ..Default::default() });
    let file = followed(&scene, &question);
    assert_eq!(file.answer.path().unwrap().status, PathStatus::Reached);
    let last = path(&file).points.last().unwrap();
    assert_eq!(last.value, 1.0);
    close(thrust(&scene, last), 0.2236377617, 1e-8);
}

/// A dome whose ring of supports spreads: every slice between two meridians goes as the next one,
/// and the supports take up the power that the dome loses as it sinks.
#[test]
fn a_dome_on_a_ring_that_spreads_pushes_all_of_it_alike() {
    let dome = json!({
        "radius": 5, "thickness": 0.6, "rings": 4, "segments": 8, "springing_deg": 80,
        "oculus_deg": 20,
    });
    let scene = template(0.7, json!({ "dome": dome }), json!({}));
    let moves = vec![SupportMove::outwards("springer_*", 0.2)];
    let question = Question::Settle(SettleOptions { moves, ..Default::default() });
    let file = followed(&scene, &question);
    assert_eq!(file.answer.path().unwrap().status, PathStatus::Reached);
    let DrivenBy::Supports(moved) = &path(&file).driven_by else { panic!("supports move") };
    assert_eq!(moved.len(), 8);
    let ways: Vec<Vector3<f64>> = moved.iter().map(|m| m.way.into()).collect();
    for (k, way) in ways.iter().enumerate() {
        let (y, x) = (std::f64::consts::TAU * (k as f64 + 0.5) / 8.0).sin_cos();
        assert_eq!(moved[k].support, format!("springer_{k:02}"));
        assert!((way - 0.2 * Vector3::new(x, y, 0.0)).norm() < 1e-15, "{way}");
    }
    let assembly = model(&scene).assembly;
    let height = |p: &PathPoint| -> f64 {
        let poses = read_poses(&assembly, &p.poses).unwrap();
        assembly.free().map(|i| assembly.weight(i) * poses[i].shift.z).sum()
    };
    let push = |p: &PathPoint| -> f64 {
        let each: Vec<f64> =
            p.reactions.iter().zip(&ways).map(|(r, way)| Vector3::from(r.force).dot(way)).collect();
        each.iter().for_each(|power| close(*power, each[0], 1e-6));
        each.iter().sum()
    };
    let points = &path(&file).points;
    close(push(&points[0]), file.answer.path().unwrap().least_reaction.unwrap().value, 1e-6);
    for pair in points.windows(2) {
        let lost = height(&pair[0]) - height(&pair[1]);
        let mean = 0.5 * (push(&pair[0]) + push(&pair[1]));
        close(mean * (pair[1].value - pair[0].value), lost, 1e-3);
    }
}

/// What a pattern and a way outwards mean, and where they mean nothing.
#[test]
fn supports_move_outwards_where_there_is_an_outwards() {
    let scene = arch(7, 0.15, 157.5, json!({}));
    let settle = |moves: Vec<SupportMove>| {
        let question = Question::Settle(SettleOptions { moves, ..Default::default() });
        ask(&question, &scene, &model(&scene), &Control::default())
    };
    let ways = |moves| {
        let Ok(Answer::Path(found)) = settle(moves) else { panic!("a path") };
        let Drive::Settle(Moves(moves)) = &found.drive else { panic!("supports move") };
        moves.iter().map(|m| m.way).collect::<Vec<_>>()
    };
    let sinks = [0.0, 0.0, -0.01];
    for (asked, left, right) in [
        (SupportMove::outwards("springer_*", 0.01), [-0.01, 0.0, 0.0], [0.01, 0.0, 0.0]),
        (SupportMove::outwards("s*", -0.01), [0.01, 0.0, 0.0], [-0.01, 0.0, 0.0]),
        (to("*_*", sinks), sinks, sinks),
        (
            SupportMove { way: sinks, ..SupportMove::outwards("*", 0.01) },
            [-0.01, 0.0, -0.01],
            [0.01, 0.0, -0.01],
        ),
    ] {
        let found = ways(vec![asked]);
        assert_eq!(found.len(), 2);
        for (way, expected) in found.iter().zip([left, right]) {
            assert!((way - Vector3::from(expected)).norm() < 1e-16, "{way}");
        }
    }
    for (moves, word) in [
        (vec![SupportMove::outwards("pier_*", 0.01)], "pier_*: there is no such support"),
        (vec![SupportMove::outwards("v*", 0.01)], "v*: there is no such support"),
        (vec![SupportMove::outwards("*_left", 0.01)], "springer_left: `out` is undefined"),
        (
            vec![SupportMove::outwards("*", 0.01), to("springer_left", [0.1, 0.0, 0.0])],
            "springer_left: two movements are given",
        ),
        (vec![SupportMove::outwards("*", f64::NAN)], "not finite"),
        (vec![SupportMove::outwards("*", 0.0)], "no support moves"),
    ] {
        let said = settle(moves).expect_err(word).to_string();
        assert!(said.contains(word), "{said}");
    }
    let foot = |x: f64| fixed(cuboid(&format!("s{x}"), [1.0, 1.0, 1.0], [x, 0.0, -1.0]));
    let row = [foot(-2.0), foot(0.0), foot(2.0), cuboid("beam", [6.0, 1.0, 1.0], [0.0; 3])];
    let beam = crate::ask::scene(0.5, json!(row), json!({}));
    let moves = vec![SupportMove::outwards("s*", 0.01)];
    let question = Question::Settle(SettleOptions { moves, ..Default::default() });
    let said = ask(&question, &beam, &model(&beam), &Control::default()).expect_err("no outwards");
    assert!(said.to_string().contains("s0: `out` is undefined at the centre"), "{said}");
}

/// Voussoirs 0 to 2 turn about the intrados of the left springing, with hinges at the extrados of
/// joint 3, the intrados of joint 5 and the extrados of the right springing: a four-bar linkage.
fn capacity(at: &[f64]) -> (Scene, ResultFile) {
    let scene = arch(7, 0.15, 157.5, push([1.0, 0.0, 0.0]));
    let angle = (157.5 / 2.0 - 3.0 * 157.5 / 7.0_f64).to_radians();
    let point = [-1.075 * angle.sin(), 0.0, 1.075 * angle.cos()];
    let control = ControlPoint { block: "v02".into(), point };
    let question = Question::Push(PushOptions {
        control,
        toward: [1.0, 0.0, 0.0],
        at: at.to_vec(),
        from: Vec::new(),
    });
    let file = followed(&scene, &question);
    (scene, file)
}

#[test]
fn the_capacity_curve_of_an_arch_is_that_of_its_linkage() {
    // Ways of the control point at which voussoirs 0 to 2 have turned by 0.01 and 0.02.
    let (scene, file) = capacity(&[0.00870383571502456, 0.01733705120616194]);
    let p = path(&file);
    let assembly = model(&scene).assembly;
    let first = assembly.find("v00").unwrap();
    let turn = |p: &PathPoint| read_poses(&assembly, &p.poses).unwrap()[first].turn.angle();
    let mut seen = 0;
    for (theta, load_factor) in [(0.0, 0.3736116923), (0.01, 0.2913682465), (0.02, 0.2250857921)] {
        let near = p.points.iter().find(|p| (turn(p) - theta).abs() < 1e-9).expect("asked for");
        close(near.load_factor.expect("a value"), load_factor, 1e-7);
        seen += 1;
    }
    assert_eq!(seen, 3);
    // The thrust reaches the intrados of joint 1 where the linkage's own equations say: at this
    // turn it is 2e-10 of the joint's depth away.
    let [event] = &p.events[..] else { panic!("{:?}", p.events) };
    assert_eq!(event.kind, PathEventKind::Jumps);
    assert_eq!(event.opens, [["v00", "v01"].map(String::from)]);
    assert_eq!(event.closes, [["v00", "springer_left"].map(String::from)]);
    let [before, after] =
        [0, 1].map(|k| p.points.iter().filter(|p| p.value >= event.value).nth(k).expect("a jump"));
    close(turn(before), 0.029530164516, 1e-8);
    close(before.load_factor.unwrap(), 0.1715618741, 1e-8);
    // Straight on, the linkage hinged at joint 1, down to where nothing is left.
    assert!(turn(after) < 1e-9);
    close(after.load_factor.unwrap(), 0.1445996059, 1e-6);
    let said = file.answer.path().unwrap();
    assert_eq!(said.status, PathStatus::Vanishes, "{said:?}");
    close(said.value.unwrap(), 0.044874067, 1e-7);
}

/// A column of three blocks that is pushed by its weight turns about its toe as one: at a turn `θ`
/// its load factor is `tan(α − θ)`, `α` the angle between its diagonal and the vertical.
#[test]
fn a_column_turns_about_its_toe_and_only_what_is_asked_for_becomes_a_point() {
    let mut blocks = vec![fixed(cuboid("ground", [4.0, 1.0, 0.5], [0.0, 0.0, -0.5]))];
    for k in 0..3 {
        blocks.push(cuboid(&format!("b{k}"), [0.6, 1.0, 0.5], [0.0, 0.0, 0.5 * f64::from(k)]));
    }
    let scene = scene(NO_SLIDING, json!(blocks), push([1.0, 0.0, 0.0]));
    let pushed = |at: &[f64]| {
        let control = ControlPoint { block: "b2".into(), point: [0.0, 0.0, 1.25] };
        let toward = [1.0, 0.0, 0.0];
        let options = PushOptions { control, toward, at: at.to_vec(), from: Vec::new() };
        followed(&scene, &Question::Push(options))
    };
    // The control point is 0.3 behind the toe and 1.25 above it.
    let way = |turn: f64| 0.3 - 0.3 * turn.cos() + 1.25 * turn.sin();
    let most = (0.3_f64 / 0.75).atan();
    let exact = |p: &PathPoint| {
        let assembly = model(&scene).assembly;
        let turn = read_poses(&assembly, &p.poses).unwrap()[assembly.find("b2").unwrap()].turn;
        let turn = turn.angle();
        assert!((way(turn) - p.value).abs() < 1e-12, "{turn} at {}", p.value);
        (most - turn).tan()
    };
    let ways = [0.1, 0.2, 0.3].map(way);
    for at in [&ways[..], &[]] {
        let file = pushed(at);
        let said = file.answer.path().expect("a path");
        assert_eq!(said.status, PathStatus::Vanishes, "{said:?}");
        close(said.value.expect("a value"), way(most), 1e-9);
        let points = &path(&file).points;
        for p in points {
            let off = (p.load_factor.expect("a value") - exact(p)).abs();
            assert!(off < 1e-9, "{off} at {}", p.value);
        }
        // Between them it was followed all the same.
        let (between, own) = (file.run.between, points.len());
        assert!(between + own > 120, "{between} {own}");
        if at.is_empty() {
            assert!((10..60).contains(&own), "{own}");
            // A straight line between two of them misses the curve by a thousandth.
            for pair in points.windows(2) {
                let [a, b] = [exact(&pair[0]), exact(&pair[1])];
                let turn = 0.5 * ((most - a.atan()) + (most - b.atan()));
                let line =
                    a + (b - a) * (way(turn) - pair[0].value) / (pair[1].value - pair[0].value);
                assert!((line - (most - turn).tan()).abs() < 2e-3 * 0.4, "{line} at {turn}");
            }
        } else {
            let values: Vec<f64> = points.iter().map(|p| p.value).collect();
            assert_eq!((own, &values[1..4]), (5, at));
        }
    }
}

/// Six courses of a wall of 6 on a base of two halves, the right one of which sinks: linear
/// programming by two methods.
fn wall_on_two_bases(friction: f64) -> Scene {
    let mut blocks = vec![
        fixed(cuboid("left", [3.0, 1.0, 0.5], [1.5, 0.0, -0.5])),
        fixed(cuboid("right", [3.0, 1.0, 0.5], [4.5, 0.0, -0.5])),
    ];
    for course in 0..6 {
        let odd = course % 2 == 1;
        let mut x = 0.0;
        while x < 6.0 {
            let length = if odd && (x == 0.0 || x == 5.5) { 0.5 } else { 1.0 };
            let id = format!("c{course}-{x}");
            blocks.push(cuboid(
                &id,
                [length, 1.0, 0.5],
                [x + 0.5 * length, 0.0, 0.5 * f64::from(course)],
            ));
            x += length;
        }
    }
    scene(friction, json!(blocks), json!({}))
}

#[test]
fn a_settling_base_carries_the_least_it_can() {
    for (friction, share) in
        [(0.0, 0.325), (0.3, 0.2708469787), (0.6, 0.2144607843), (1.0, 0.1458333333)]
    {
        let scene = wall_on_two_bases(friction);
        let moves = vec![to("right", [0.0, 0.0, -1.0])];
        let file = followed_for(&scene, moves, 2.0);
        let said = file.answer.path().expect("a path");
        let least = said.least_reaction.expect("a least reaction");
        let m = model(&scene);
        let weight: f64 = m.assembly.free().map(|i| m.assembly.weight(i)).sum();
        close(least.value / weight, share, 1e-8);
        assert!(least.lower <= least.value && least.value <= least.upper);
        assert!(least.upper - least.lower < 1e-6 * weight);
    }
}

/// The answer, which may stay open.
fn followed_open(scene: &Scene, moves: Vec<SupportMove>) -> ResultFile {
    followed_for(scene, moves, f64::INFINITY)
}

/// What is known after so many seconds.
fn followed_for(scene: &Scene, moves: Vec<SupportMove>, seconds: f64) -> ResultFile {
    let model = model(scene);
    let question = Question::Settle(SettleOptions { moves, at: Vec::new(), ..Default::default() });
    let control = Control { deadline: Deadline::within(seconds), ..Control::default() };
    let answer = ask(&question, scene, &model, &control).expect("an answer");
    let file = saved::of(&question, scene, &model, &answer).expect("a result");
    let found = crate::ask::check(scene, &file);
    let fails: Vec<_> = found.parts.iter().flat_map(|(_, f)| &f.fails).collect();
    assert!(fails.is_empty(), "{fails:#?}");
    file
}

/// With friction its joints slide on each other as it sinks. That is followed under dry friction as
/// far as a motion is found, never with the dilatant one, and it is said where it ends.
#[test]
fn a_motion_that_slides_is_followed_as_far_as_dry_friction_leads() {
    let moves = vec![to("right", [0.0, 0.0, -1.0])];
    let file = followed_for(&wall_on_two_bases(0.3), moves, 10.0);
    let said = file.answer.path().unwrap();
    assert!(matches!(said.status, PathStatus::Slides | PathStatus::Open), "{said:?}");
    assert!(said.why.is_some(), "{said:?}");
    let ends = path(&file).points.iter().all(|p| p.certificate.claim.is_some());
    assert!(ends && said.value.is_some());
    let slides = path(&file).events.iter().any(|e| e.kind == PathEventKind::Slides);
    assert!(slides || said.why.as_ref().is_some_and(|why| why.contains("slide")), "{said:?}");
}

#[test]
fn units_and_places_change_no_share_of_the_movement() {
    let expected =
        spread(&arch(12, 0.12, 180.0, json!({})), &[]).answer.path().unwrap().value.unwrap();
    for (scale, density, at) in [(1e-3, 1e3, 0.0), (1e3, 1e-3, 0.0), (1.0, 1.0, 1e4)] {
        let arch = json!({
            "radius": scale, "thickness": 0.12 * scale, "depth": scale, "voussoirs": 12,
            "at": [at, 0.0, -at],
        });
        let more = json!({ "materials": { "unit": { "density": density } } });
        let scene = template(NO_SLIDING, json!({ "arch": arch }), more);
        let moves =
            vec![to("springer_left", [-scale, 0.0, 0.0]), to("springer_right", [scale, 0.0, 0.0])];
        let question =
            Question::Settle(SettleOptions { moves, at: Vec::new(), ..Default::default() });
        let said = followed(&scene, &question).answer.path().unwrap().clone();
        close(said.value.unwrap(), expected, 1e-7);
    }
}

/// Nothing of a result can be changed without being refused.
#[test]
fn moved_poses_and_changed_numbers_are_refused() {
    let scene = arch(12, 0.12, 180.0, json!({}));
    let file = spread(&scene, &[0.01]);
    crate::ask::leaves_hold(&file);
    let points = path(&file).points.len();
    assert!(points > 3);
    let point = |v: &mut Value, k: usize| v["evidence"]["settle"]["points"][k].take();
    let pose = |v: &mut Value, k: usize, change: &dyn Fn(&mut Value)| {
        let mut own = point(v, k);
        let poses = own["poses"].as_array_mut().unwrap();
        change(poses.iter_mut().find(|p| p["block"] == "v05").unwrap());
        v["evidence"]["settle"]["points"][k] = own;
    };
    let more = |v: &mut Value, by: f64| *v = json!(v.as_f64().unwrap() + by);
    for k in 1..points {
        crate::ask::edits_are_refused(
            &scene,
            &file,
            &[
                ("a pose moved by 1e-3 of a block", &|v| {
                    pose(v, k, &|p| more(&mut p["shift"][2], 1e-3 * 0.3));
                }),
                ("a pose turned", &|v| pose(v, k, &|p| more(&mut p["turn"][1], 1e-3))),
                ("another value", &|v| {
                    let value = &mut v["evidence"]["settle"]["points"][k]["value"];
                    *value = json!(value.as_f64().unwrap() * 1.001);
                }),
            ],
        );
    }
    // Ends that are swapped prove no fall.
    let mut value = file.to_value().unwrap();
    value["evidence"]["settle"]["ends"].as_array_mut().unwrap().reverse();
    crate::ask::told(&mut value);
    assert_eq!(value["answer"]["path"]["status"], "open");
    // A pose on the way of which nothing is proved links nothing: no fall beyond it.
    let mut value = file.to_value().unwrap();
    value["evidence"]["settle"]["points"][2]["certificate"] = json!({ "forces": [], "rates": [] });
    crate::ask::told(&mut value);
    assert_eq!(value["answer"]["path"]["status"], "open");
    assert_eq!(value["answer"]["path"]["value"], json!(path(&file).points[1].value));
    // It stands all the way, and no word of where it falls.
    let whole = |v: &mut Value| {
        v["evidence"]["settle"]["end"] = json!("reached");
        v["evidence"]["settle"]["ends"] = json!([]);
        crate::ask::told(v);
    };
    let mut value = file.to_value().unwrap();
    whole(&mut value);
    assert_eq!(value["answer"]["path"]["status"], "open");
}

/// A block at rest beside the arch, whatever it weighs, however large it is and wherever it lies, is
/// no part of what moves.
#[test]
fn a_stranger_changes_nothing_about_a_path() {
    let with = |block: Option<(f64, f64, f64)>| {
        let mut more = push([1.0, 0.0, 0.0]);
        if let Some((x, size, density)) = block {
            let cube = |id: &str, z: f64| json!({ "id": id, "shape": { "box": { "size": [size, size, size] } }, "at": [x, 0, z], "density": density });
            more["blocks"] =
                json!([fixed(cube("z_ground", -0.5 * size)), cube("z_block", 0.5 * size)]);
        }
        arch(12, 0.12, 180.0, more)
    };
    let settled = |scene: &Scene| {
        let said = spread(scene, &[]).answer.path().cloned().unwrap();
        (said.status, said.value, said.falls_at)
    };
    let pushed = |scene: &Scene| {
        let m = model(scene);
        let (block, point) =
            ("v06".to_string(), m.assembly.blocks[m.assembly.find("v06").unwrap()].centroid);
        let question = Question::Push(PushOptions {
            control: ControlPoint { block, point: point.into() },
            toward: [1.0, 0.0, 0.0],
            at: Vec::new(),
            from: Vec::new(),
        });
        let said = followed(scene, &question).answer.path().cloned().unwrap();
        (said.status, said.value, said.falls_at)
    };
    let alone = with(None);
    let expected = (settled(&alone), pushed(&alone));
    assert_eq!(expected.0.0, PathStatus::Falls);
    for stranger in
        [(5.0, 1.0, 1e6), (5.0, 1.0, 1e-6), (500.0, 300.0, 1.0), (5.0, 1e-3, 1.0), (1e4, 1.0, 1.0)]
    {
        let scene = with(Some(stranger));
        assert_eq!((settled(&scene), pushed(&scene)), expected, "{stranger:?}");
    }
}

/// What moves may run into what rests beside it: that is said, and not followed.
#[test]
fn an_arch_that_spreads_into_a_stranger_is_not_followed_through_it() {
    let cube = |id: &str, z: f64| json!({ "id": id, "shape": { "box": { "size": [0.4, 1, 1] } }, "at": [1.275, 0, z] });
    let blocks = json!([fixed(cube("z_ground", -0.5)), cube("z_block", 0.5)]);
    let scene = arch(12, 0.12, 180.0, json!({ "blocks": blocks }));
    let moves = vec![to("springer_left", [-1.0, 0.0, 0.0]), to("springer_right", [1.0, 0.0, 0.0])];
    let file = followed_open(&scene, moves);
    let said = file.answer.path().unwrap();
    assert_eq!(said.status, PathStatus::Open, "{said:?}");
    assert!(said.why.as_ref().is_some_and(|why| why.contains("come into contact")), "{said:?}");
}

/// A path that begins at a saved pose goes on as it would have gone from the start.
#[test]
fn a_path_goes_on_from_a_saved_pose() {
    let scene = arch(12, 0.12, 180.0, json!({}));
    let moves = vec![to("springer_left", [-1.0, 0.0, 0.0]), to("springer_right", [1.0, 0.0, 0.0])];
    let whole = spread(&scene, &[0.01]);
    let pose = path(&whole).points.iter().find(|p| p.value == 0.01).unwrap().poses.clone();
    let question = |moves: &[SupportMove], from: &[voussoir::path::saved::SavedPose]| {
        let (moves, from) = (moves.to_vec(), from.to_vec());
        Question::Settle(SettleOptions { moves, from, at: Vec::new() })
    };
    let rest = followed(&scene, &question(&moves, &pose));
    assert!((path(&rest).points[0].value - 0.01).abs() < 1e-15);
    assert_eq!(rest.answer.path().unwrap().status, PathStatus::Falls);
    assert_eq!(rest.answer.path().unwrap().least_reaction, None);
    let value = |f: &ResultFile| f.answer.path().unwrap().value.unwrap();
    close(value(&rest), value(&whole), 1e-9);
    // Elsewhere than the motion leads, or overlapping, it is no pose to begin at.
    let model = model(&scene);
    let refused = |moves: &[SupportMove], from: &[voussoir::path::saved::SavedPose]| {
        let error = ask(&question(moves, from), &scene, &model, &Control::default());
        error.expect_err("refused").to_string()
    };
    let other = vec![to("springer_left", [-1.0, 0.0, 0.0]), to("springer_right", [1.0, 0.0, 0.1])];
    assert!(refused(&other, &pose).contains("does not put them"));
    let mut sunk = pose.clone();
    sunk.iter_mut().find(|p| p.block == "v05").unwrap().shift[2] -= 0.01;
    assert!(refused(&moves, &sunk).contains("overlap"));
}

/// Points so far apart that something would have to be passed through are no path.
#[test]
fn between_neighbouring_points_nothing_closes() {
    let scene = arch(12, 0.12, 180.0, json!({}));
    let file = spread(&scene, &[]);
    // The mirror image of the hinged pose is none that the other leads to.
    let turned = |v: &mut Value| {
        let points = v["evidence"]["settle"]["points"].as_array_mut().unwrap();
        let poses = points.last_mut().unwrap()["poses"].as_array_mut().unwrap();
        let turn = &mut poses.iter_mut().find(|p| p["block"] == "v03").unwrap()["turn"][1];
        *turn = json!(-turn.as_f64().unwrap());
    };
    crate::ask::edits_are_refused(&scene, &file, &[("a pose in the mirror", &turned)]);
}

/// The same poses in time, by the engine with its own contacts: 3 % before the arch falls they stay
/// where they are, at the pose where it is proved to fall they go.
#[test]
fn poses_on_the_way_stand_in_time_and_the_last_one_falls() {
    for (n, thickness, embrace, falls) in [
        (12, 0.12, 180.0, 0.025258679449),
        (12, 0.15, 180.0, 0.070524908919),
        (16, 0.15, 180.0, 0.058861058481),
        (16, 0.15, 160.0, 0.107189188),
    ] {
        let scene = arch(n, thickness, embrace, json!({}));
        let before = 0.97 * falls;
        let file = spread(&scene, &[before]);
        let start = model(&scene);
        let fate = |point: &PathPoint| {
            let poses = read_poses(&start.assembly, &point.poses).expect("poses");
            let displaced = Carried::new(&start).displaced(&poses).model;
            let settings =
                SimulationSettings { fidelity: Some(Fidelity::Fine), ..Default::default() };
            simulate(&displaced, &settings, &mut |_| ControlFlow::Continue(()))
                .expect("a simulation")
                .fate
        };
        let near = path(&file).points.iter().find(|p| p.value == before).expect("asked for");
        let fates = (fate(near), fate(&path(&file).ends[1]));
        assert_eq!(fates, (Fate::Stands, Fate::Falls), "{n} {thickness} {embrace}");
    }
}

/// Poses that each stand, or fall, or have a load factor, but that no motion leads to from the one
/// before: the answer ends at the last that is linked, and nothing that a forger writes gets beyond.
#[test]
fn poses_that_no_motion_links_are_not_followed() {
    let cube = |size: f64| cuboid("b", [size, size, size], [0.0, 0.0, 0.0]);
    let ground = |x: f64, w: f64| fixed(cuboid("g", [w, 3.0, 1.0], [x, 0.0, -1.0]));
    let pose = |block: &str, shift: [f64; 3], turn: [f64; 3]| json!({ "block": block, "shift": shift, "turn": turn });
    let still = [0.0; 3];
    let settled = |scene: &Scene, support: &str, way: [f64; 3]| {
        let moves = vec![to(support, way)];
        followed(scene, &Question::Settle(SettleOptions { moves, ..Default::default() }))
    };
    let open = |file: &ResultFile, kind: &str, forge: &dyn Fn(&mut Value), last: f64| {
        let mut value = file.to_value().unwrap();
        let mut evidence = value["evidence"][kind].take();
        forge(&mut evidence);
        value["evidence"][kind] = evidence;
        crate::ask::told(&mut value);
        let said = &value["answer"]["path"];
        assert_eq!((said["status"].as_str(), said["value"].as_f64()), (Some("open"), Some(last)));
    };

    // A block on a table that goes along: it is to hang in the air, nine metres above.
    let scene = scene(0.6, json!([ground(0.0, 3.0), cube(1.0)]), json!({}));
    let file = settled(&scene, "g", [0.1, 0.0, -0.1]);
    assert_eq!(file.answer.path().unwrap().status, PathStatus::Reached);
    let in_the_air = |e: &mut Value| {
        let mut falls = e["points"].as_array().unwrap().last().unwrap().clone();
        let stands = falls.clone();
        falls["poses"] =
            json!([pose("g", [0.1, 0.0, -0.1], still), pose("b", [0.1, 0.0, 9.0], still)]);
        falls["value"] = json!(1.0000001);
        falls["certificate"] = json!({ "claim": "unstable", "forces": [],
            "rates": [{ "block": "b", "velocity": [0, 0, -1], "spin": still }] });
        e["end"] = json!("falls");
        e["ends"] = json!([stands, falls]);
    };
    open(&file, "settle", &in_the_air, 1.0);

    // It is to have slid along by half a metre on a table that sinks: nothing pushes it.
    let aside = |e: &mut Value| {
        let last = e["points"].as_array_mut().unwrap().last_mut().unwrap();
        last["poses"] =
            json!([pose("g", [0.1, 0.0, -0.1], still), pose("b", [0.6, 0.0, -0.1], still)]);
        let corner = |x: f64, y: f64| json!([x + 0.6, y, -0.1]);
        last["certificate"]["forces"] = json!([{ "between": ["g", "b"],
            "points": [corner(-0.5, -0.5), corner(0.5, -0.5), corner(0.5, 0.5), corner(-0.5, 0.5)],
            "forces": [[0, 0, 0.25], [0, 0, 0.25], [0, 0, 0.25], [0, 0, 0.25]] }]);
    };
    let before = path(&file).points.iter().rev().nth(1).unwrap().value;
    open(&file, "settle", &aside, before);

    // A slender block that rocks about its edge: its load factor is to vanish five metres farther.
    let slender = json!([ground(0.0, 40.0), cuboid("b", [0.4, 1.0, 2.0], [0.0, 0.0, 0.0])]);
    let scene = crate::ask::scene(0.7, slender, push([1.0, 0.0, 0.0]));
    let control = ControlPoint { block: "b".into(), point: [0.0, 0.0, 1.0] };
    let toward = [1.0, 0.0, 0.0];
    let question =
        Question::Push(PushOptions { control, toward, at: Vec::new(), from: Vec::new() });
    let file = followed(&scene, &question);
    assert_eq!(file.answer.path().unwrap().status, PathStatus::Vanishes);
    let farther = |e: &mut Value| {
        let last = e["points"].as_array_mut().unwrap().last_mut().unwrap();
        let more = |v: &mut Value| *v = json!(v.as_f64().unwrap() + 5.0);
        more(&mut last["value"]);
        more(&mut last["poses"][0]["shift"][0]);
        for own in last["certificate"]["forces"].as_array_mut().unwrap() {
            own["points"].as_array_mut().unwrap().iter_mut().for_each(|p| more(&mut p[0]));
        }
    };
    let points = &path(&file).points;
    open(&file, "push", &farther, points[points.len() - 2].value);
}

/// A block on a table that turns slides at the angle of friction or turns over at that of its
/// diagonal, whatever the table is, wherever on it the block stands.
#[test]
fn a_block_on_a_table_that_turns_goes_at_the_lesser_of_two_angles() {
    for (table, friction, [width, height], x) in [
        (60.0, 0.5, [1.0, 0.6], 0.0),
        (5.0, 0.5, [1.0, 0.6], 1.3),
        (60.0, 0.3, [1.0, 1.0], -0.7),
        (30.0, 1.0, [0.5, 1.5], 0.4),
    ] {
        let ground = fixed(cuboid("g", [table, table, 1.0], [0.0, 0.0, -1.0]));
        let block = cuboid("a", [width, 1.0, height], [x, 0.0, 0.0]);
        let scene = scene(friction, json!([ground, block]), json!({}));
        for turn in [60.0, -60.0] {
            let moves = vec![SupportMove {
                support: "g".into(),
                turn_deg: [0.0, turn, 0.0],
                ..SupportMove::along("g", [0.0; 3])
            }];
            let file =
                followed(&scene, &Question::Settle(SettleOptions { moves, ..Default::default() }));
            let said = file.answer.path().expect("a path");
            let share = f64::min(friction.atan(), (width / height).atan()) / 60_f64.to_radians();
            assert_eq!(said.status, PathStatus::Falls, "{said:?}");
            close(said.value.expect("a value"), share, 1e-6);
            close(said.falls_at.expect("a value"), share, 1e-6);
        }
    }
}

/// Two blocks that start at one load go together, and the load factor vanishes where the centre of
/// each stands over its toe; a third one that is larger changes nothing.
#[test]
fn the_load_factor_of_blocks_that_start_together_vanishes_where_that_of_one_does() {
    for more in [vec![], vec![cuboid("c", [2.0, 2.0, 6.0], [-8.0, 0.0, 0.0])]] {
        let mut blocks = vec![
            fixed(cuboid("g", [30.0, 2.0, 1.0], [0.0, 0.0, -1.0])),
            cuboid("a", [1.0, 1.0, 3.0], [0.0, 0.0, 0.0]),
            cuboid("b", [1.0, 1.0, 3.0], [8.0, 0.0, 0.0]),
        ];
        blocks.extend(more);
        let scene = scene(NO_SLIDING, json!(blocks), push([1.0, 0.0, 0.0]));
        let control = ControlPoint { block: "a".into(), point: [0.0, 0.0, 1.5] };
        for at in [vec![], vec![0.1, 0.33]] {
            let toward = [1.0, 0.0, 0.0];
            let options = PushOptions { control: control.clone(), toward, at, from: Vec::new() };
            let file = followed(&scene, &Question::Push(options));
            let said = file.answer.path().expect("a path");
            assert_eq!(said.status, PathStatus::Vanishes, "{said:?}");
            close(said.value.expect("a value"), 0.5, 1e-9);
        }
    }
}

/// A control point far from the toe goes farther than the joints are wide: what resists there is
/// followed to where it vanishes, not to the size of the joints.
#[test]
fn a_control_point_is_followed_beyond_the_size_of_the_joints() {
    let ground = fixed(cuboid("g", [30.0, 2.0, 1.0], [0.0, 0.0, -1.0]));
    let scene = scene(
        NO_SLIDING,
        json!([ground, cuboid("a", [1.3, 1.0, 2.6], [0.0, 0.0, 0.0])]),
        push([1.0, 0.0, 0.0]),
    );
    let control = ControlPoint { block: "a".into(), point: [-0.65, 0.0, 3.4] };
    let toward = [1.0, 0.0, 0.0];
    let options = PushOptions { control, toward, at: vec![], from: Vec::new() };
    let file = followed(&scene, &Question::Push(options));
    let said = file.answer.path().expect("a path");
    assert_eq!(said.status, PathStatus::Vanishes, "{said:?}");
    // The centre is 0.65 behind the toe and 1.3 above it; the point 1.3 behind it and 3.4 above.
    let turn = (0.65_f64 / 1.3).atan();
    close(said.value.expect("a value"), 1.3 - 1.3 * turn.cos() + 3.4 * turn.sin(), 1e-9);
}

/// What slides over an edge turns there: the same place in the mirror image.
#[test]
fn a_block_that_is_pushed_over_an_edge_turns_where_its_mirror_image_does() {
    let ends: Vec<f64> = [1.0, -1.0]
        .into_iter()
        .map(|side: f64| {
            let scene = scene(
                0.35,
                json!([
                    fixed(cuboid("table", [2.0, 1.0, 1.0], [side * -0.2, 0.0, -1.0])),
                    cuboid("a", [1.0, 1.0, 0.5], [side * 0.1, 0.0, 0.0]),
                ]),
                push([side, 0.0, 0.0]),
            );
            let control = ControlPoint { block: "a".into(), point: [side * 0.1, 0.0, 0.25] };
            let toward = [side, 0.0, 0.0];
            let options = PushOptions { control, toward, at: vec![], from: Vec::new() };
            let file = followed(&scene, &Question::Push(options));
            let said = file.answer.path().expect("a path");
            assert_eq!(said.status, PathStatus::Vanishes, "{said:?}");
            said.value.expect("a value")
        })
        .collect();
    close(ends[1], ends[0], 1e-9);
}
