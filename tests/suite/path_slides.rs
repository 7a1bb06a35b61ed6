//! Large displacements that slide, under dry friction: closed forms of blocks, wedges and tables;
//! every point with proof from its poses alone.

use crate::ask::{asked, cuboid, fixed, model, prism, push, scene, template};
use serde_json::json;
use voussoir::{
    analysis::{ControlPoint, PushOptions, Question, SettleOptions, SupportMove},
    path::saved::read_poses,
    proof::{
        self, ResultFile,
        path::{PathEventKind, PathPoint, PathResult, PathStatus},
    },
    scene::Scene,
};

fn settled(scene: &Scene, moves: &[(&str, [f64; 3], [f64; 3])], at: &[f64]) -> ResultFile {
    let moves = moves
        .iter()
        .map(|(support, way, turn_deg)| SupportMove {
            support: (*support).into(),
            way: *way,
            turn_deg: *turn_deg,
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
/// along, and the other slides beneath it with μ × what it carries.
#[test]
fn a_support_drawn_away_slides_under_what_rests_on_another() {
    let blocks = json!([
        fixed(cuboid("left", [2.0, 1.0, 0.5], [-1.0, 0.0, -0.5])),
        fixed(cuboid("right", [2.0, 1.0, 0.5], [1.0, 0.0, -0.5])),
        cuboid("block", [2.0, 1.0, 0.5], [-0.25, 0.0, 0.0]),
    ]);
    let scene = scene(0.4, blocks, json!({}));
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

/// Pushed by its own weight × λ a block slides: a load factor under dry friction is not followed,
/// and that is said.
#[test]
fn what_slides_under_a_load_factor_is_not_followed() {
    let blocks = json!([
        fixed(cuboid("table", [4.0, 1.0, 0.5], [0.0, 0.0, -0.5])),
        cuboid("block", [1.0, 1.0, 0.5], [0.5, 0.0, 0.0]),
    ]);
    let scene = scene(0.3, blocks, push([1.0, 0.0, 0.0]));
    let control = ControlPoint { block: "block".into(), point: [0.5, 0.0, 0.25] };
    let toward = [1.0, 0.0, 0.0];
    let options = PushOptions { control, toward, at: Vec::new(), from: Vec::new() };
    let file = asked(&scene, &Question::Push(options));
    assert_eq!(status(&file), PathStatus::Slides, "{:?}", file.answer.path());
    let [start] = &path(&file).points[..] else { panic!("more than the start") };
    close(start.load_factor.expect("a load factor"), 0.3, 1e-7);
}

/// What slid is in the poses: none of it can be changed.
#[test]
fn changed_slips_and_poses_are_refused() {
    let scene = wedge(0.3);
    let file = settled(&scene, &APART, &[]);
    let refuse = |what: &str, change: &dyn Fn(&mut PathPoint)| {
        let mut forged = file.clone();
        let points = &mut forged.path.as_mut().unwrap().points;
        let middle = points.len() / 2;
        change(&mut points[middle]);
        assert_ne!(forged, file, "{what}");
        assert!(!proof::verify(&forged, &scene).expect("a scene").proved(), "{what}");
    };
    refuse("another slip", &|p| p.slips[0].way *= 1.001);
    refuse("a slip left out", &|p| p.slips.clear());
    refuse("a wedge that has not sunk", &|p| p.poses.retain(|pose| pose.block != "key"));
    refuse("a wedge that has sunk more", &|p| {
        p.poses.iter_mut().find(|pose| pose.block == "key").unwrap().shift[2] -= 1e-3;
    });
    refuse("a force that does not oppose the slip", &|p| {
        p.certificate.forces[0].forces[0][2] *= -1.0;
    });
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
