//! Grains that flow: what is measured of drums, hoppers and shear boxes, the engine against exact
//! motions, and grains as files.

use crate::ask::{cuboid, fixed, model, scene, sphere};
use nalgebra::{Rotation3, Vector3};
use serde_json::json;
use std::ops::ControlFlow;
use voussoir::{
    analysis::{
        Control, Law, assess,
        repose::{self, Growing, Heap, seen::Seen},
        stability::held,
    },
    assembly::{self, Solid},
    dynamics::granular::{Course, Disturbance, Moment, ROUNDS, flow},
    import::{ImportOptions, import_bytes},
    report::{
        chart,
        grains::{GrainFormat, rows, written},
        heaps::{HeapResult, ReposeFile},
        tell,
    },
    scene::{BlockSpec, FloorKind, GrainKind, Protocol, ProtocolKind, Scene, Shape, Sizes},
    tolerance::GRAIN_GAP,
    verdict::Verdict,
};

fn run(protocol: &Protocol, seed: u64) -> Heap {
    repose::heap(protocol, seed, &mut |_| ControlFlow::Continue(())).unwrap()
}

fn from(own: &[BlockSpec]) -> Growing<'_> {
    Growing { own: Some(own), ..Growing::default() }
}

/// The charts of the page: what was seen is drawn as it was seen, a line a seed.
fn charts(protocol: &Protocol, heap: &Heap) -> Vec<chart::Chart> {
    let file = ReposeFile::new(protocol, vec![HeapResult::new(heap, None)]);
    let charts = tell::heaps(&file);
    let columns: Vec<Vec<[f64; 2]>> = match heap.seen.as_ref().expect("seen") {
        Seen::Drum { course, .. } | Seen::Hopper { course, .. } => vec![course.clone()],
        Seen::Cell(flown) => {
            [1, 2].map(|k| flown.course.iter().map(|c| [c[0], c[k]]).collect()).to_vec()
        }
        Seen::Shear { course, .. } => {
            [1, 2].map(|k| course.iter().map(|c| [c[0], c[k]]).collect()).to_vec()
        }
    };
    assert_eq!(charts.len(), columns.len());
    for (chart, course) in charts.iter().zip(columns) {
        let [line] = &chart.series[..] else { panic!("one seed") };
        assert!(line.line && line.name == format!("seed {}", heap.seed));
        assert_eq!(line.points, course.iter().map(|c| c.map(Some)).collect::<Vec<_>>());
        assert_eq!(line.hints.len(), line.points.len());
    }
    charts
}

/// Height of the centre of the only free block over the time, and where it is.
fn watched(scene: &Scene, course: &Course) -> Vec<(f64, Vector3<f64>)> {
    let assembly = model(scene).assembly;
    let ball = assembly.free().next().unwrap();
    let natural = (course.diameter / assembly.gravity.norm()).sqrt();
    let mut seen = Vec::new();
    let mut look = |m: &Moment| {
        seen.push((m.flow.time * natural, (m.center)(ball)));
        ControlFlow::Continue(())
    };
    flow(&assembly, course, &mut look, &mut |_| true).unwrap();
    seen
}

/// A ball that nothing touches falls along a parabola, whatever turns around it; seen from supports
/// that turn it does not, and turned back it does again.
#[test]
fn a_ball_in_free_flight_is_the_same_from_a_turning_drum() {
    let far = fixed(cuboid("far", [1.0, 1.0, 1.0], [0.0, 0.0, 900.0]));
    let start = Vector3::new(3.0, 1.0, 2.0);
    let scene = scene(0.5, json!([far, sphere("ball", 0.5, start.into())]), json!({}));
    let axis = Vector3::y_axis();
    // Two thirds of a turn while it falls some 100 d (gravity is 1 in these scenes).
    let rate = 0.3;
    let course = Course {
        stages: vec![Disturbance::Spin(axis, rate, 4.2)],
        diameter: 1.0,
        finer: 4.0,
        settled: false,
        ..Course::default()
    };
    let thrown = (axis.into_inner() * rate).cross(&start);
    let path = watched(&scene, &course);
    assert!(path.len() > 30);
    for (time, there) in path {
        let seen = Rotation3::from_axis_angle(&axis, rate * time) * there;
        let fell = Vector3::z() * (-0.5 * time * time);
        let want = start + thrown * time + fell;
        // What the frame adds is added from step to step: good to the angle of a step, 1 / 400.
        assert!(
            (seen - want).norm() < 0.01 * (1.0 + (want - start).norm()),
            "{time}: {seen} {want}"
        );
    }
}

/// What is poured falls from so far above the highest grain, and not before its turn.
#[test]
fn layers_are_poured_from_the_height_of_drop() {
    let floor = fixed(cuboid("floor", [20.0, 20.0, 1.0], [0.0, 0.0, -1.0]));
    let scene = scene(0.5, json!([floor, sphere("ball", 0.5, [0.0, 0.0, 0.5])]), json!({}));
    for drop in [3.0, 12.0] {
        let course = Course {
            stages: vec![Disturbance::Pour(vec![vec![1]], 1.0, drop)],
            diameter: 1.0,
            settled: false,
            ..Course::default()
        };
        let path = watched(&scene, &course);
        let falls = path.iter().take_while(|(time, _)| drop - 0.5 * time * time > 1.0);
        assert!(falls.clone().count() > 3);
        for (time, there) in falls {
            let want = drop - 0.5 * time * time;
            assert!((there.z - want).abs() < 0.02 * drop, "{time}: {} {want}", there.z);
        }
    }
}

/// A ball that falls from h comes back to e² h.
#[test]
fn restitution_is_speed_apart_over_speed_together() {
    let floor = fixed(cuboid("floor", [20.0, 20.0, 1.0], [0.0, 0.0, -1.0]));
    let scene = scene(0.5, json!([floor, sphere("ball", 0.5, [0.0, 0.0, 4.5])]), json!({}));
    for e in [0.0, 0.3, 0.6, 0.9] {
        let course = Course {
            stages: vec![Disturbance::Settle],
            diameter: 1.0,
            restitution: e,
            settled: false,
            horizon: 60.0,
            ..Course::default()
        };
        let path = watched(&scene, &course);
        let heights: Vec<f64> = path.iter().map(|(_, c)| c.z - 0.5).collect();
        let low = heights.windows(2).position(|w| w[1] > w[0] || w[1] < 0.02).unwrap();
        let back = heights[low + 1..].iter().copied().fold(0.0, f64::max);
        assert!((back - e * e * 4.0).abs() < 0.25, "e = {e}: {back}");
    }
}

/// What grains weigh, where they are and how large: written, and read back.
#[test]
fn grains_are_written_and_read_back() {
    for grain in [GrainKind::Sphere, GrainKind::Clump] {
        let protocol =
            Protocol { grain, grains: 30, size: Some([5.0, 4.0]), ..Protocol::default() };
        let scene = voussoir::generate::deposit(&protocol, 3).unwrap().scene;
        let want = rows(&scene).unwrap();
        assert_eq!(
            want.iter()
                .filter(|r| !r.fixed)
                .map(|r| &r.id)
                .collect::<std::collections::BTreeSet<_>>()
                .len(),
            30
        );
        for (format, name) in [(GrainFormat::Csv, "g.csv"), (GrainFormat::Dump, "g.dump")] {
            let text = written(&scene, format).unwrap();
            let options = ImportOptions {
                density: Some(protocol.density),
                friction: Some(voussoir::scene::Friction::Coefficient(0.5)),
                ..ImportOptions::default()
            };
            let read = import_bytes(name, text.as_bytes(), &options).unwrap().scene;
            let found = rows(&read).unwrap();
            assert_eq!(found.len(), want.len(), "{name}");
            for (a, b) in found.iter().zip(&want) {
                assert!((a.center - b.center).norm() < 1e-15 && a.fixed == b.fixed, "{name}");
                assert!((a.radius - b.radius).abs() < 1e-15 && a.grain == b.grain, "{name}");
                assert!((a.mass / b.mass - 1.0).abs() < 1e-9, "{name}: {} {}", a.mass, b.mass);
            }
        }
        let points = written(&scene, GrainFormat::Vtk).unwrap();
        let xml = roxmltree::Document::parse(&points).unwrap();
        let piece = xml.descendants().find(|n| n.has_tag_name("Piece")).unwrap();
        assert_eq!(piece.attribute("NumberOfPoints"), Some(want.len().to_string().as_str()));
    }
}

#[test]
fn tables_of_grains_that_are_none_are_refused_with_their_line() {
    let said = |name: &str, text: &str| {
        import_bytes(name, text.as_bytes(), &ImportOptions::default()).unwrap_err().to_string()
    };
    assert!(said("g.csv", "a,b\n1,2\n").starts_with("g.csv:1:1: no column \"x\""));
    assert!(
        said("g.csv", "x,y,z,radius\n0,0,0,1\n0,0,nan,1\n").starts_with("g.csv:3:1: z: expected")
    );
    assert!(said("g.csv", "x,y,z,radius\n0,0,0,-1\n").contains("must be > 0"));
    assert!(said("g.csv", "x,y,z,radius\n0,0\n").contains("expected a finite number, got \"\""));
    assert!(said("g.dump", "ITEM: TIMESTEP\n0\nITEM: ATOMS id type\n1 1\n").contains("no column"));
    // Shares of the box are no lengths.
    let scaled = "ITEM: TIMESTEP\n0\nITEM: ATOMS id xs ys zs radius\n1 0.5 0.5 0.5 0.005\n";
    assert!(said("s.dump", scaled).contains("no column \"x\""));
    assert!(said("g.csv", "").contains("no blocks found"));
}

/// A dump of several times in a periodic box: what is not read is said.
#[test]
fn times_and_periodic_sides_of_a_dump_are_told() {
    let at = |time: usize, z: f64| {
        format!(
            "ITEM: TIMESTEP\n{time}\nITEM: BOX BOUNDS pp fm pp\n0 1\n0 1\n0 1\nITEM: ATOMS id x y z radius\n1 0 0 {z} 0.1\n"
        )
    };
    let dump = at(0, 0.5) + &at(10, 0.25);
    let read = import_bytes("t.dump", dump.as_bytes(), &ImportOptions::default()).unwrap();
    assert_eq!(read.scene.blocks.len(), 1);
    assert_eq!(read.scene.blocks[0].at[2], 0.25);
    for part in ["the last is read: 2", "periodic sides along x, z"] {
        assert!(read.findings.iter().any(|f| f.text.contains(part)), "{part}: {:?}", read.findings);
    }
    let closed = dump.replace("pp", "ff");
    let read = import_bytes("t.dump", closed.as_bytes(), &ImportOptions::default()).unwrap();
    assert!(!read.findings.iter().any(|f| f.text.contains("periodic")), "{:?}", read.findings);
}

/// What a type means is a guess, and is said.
#[test]
fn spheres_that_are_taken_for_supports_are_told() {
    let dump = "ITEM: ATOMS id type x y z radius\n1 1 0 0 0.015 0.005\n2 2 0 0 0.005 0.005\n";
    let read = import_bytes("t.dump", dump.as_bytes(), &ImportOptions::default()).unwrap();
    assert_eq!(read.scene.blocks.iter().filter(|b| b.support).count(), 1);
    let said = |t: &str| t.contains("spheres of type 2, read as supports: 1");
    assert!(read.findings.iter().any(|f| said(&f.text)), "{:?}", read.findings);
}

/// A heap is made by all threads, and is the same to the last bit on any number of them.
#[test]
fn the_number_of_threads_changes_nothing() {
    let protocol = Protocol { grains: 300, size: Some([8.0, 6.0]), ..Protocol::default() };
    let heaps = [1, 2, 3].map(|threads| {
        let growing = Growing { threads, ..Growing::default() };
        let mut go_on = |_: &_| ControlFlow::Continue(());
        repose::grown(&protocol, 1, &growing, &mut go_on).unwrap()
    });
    let [one, two, three] = heaps.map(|h| (h.time, h.grains, h.scene));
    assert!(one == two && two == three);
}

/// Grains that begin where a heap came to rest stay there; what lies outside is refused.
#[test]
fn a_packing_of_ones_own_is_where_it_starts() {
    let protocol =
        Protocol { grains: 40, size: Some([6.0, 4.0]), rate: Some(2.0), ..Protocol::default() };
    let heap = run(&protocol, 3);
    let own: Vec<_> = heap.scene.blocks.iter().filter(|b| !b.support).cloned().collect();
    let mut go_on = |_: &_| ControlFlow::Continue(());
    let again = repose::grown(&protocol, 3, &from(&own), &mut go_on).unwrap();
    assert!(again.rested && again.grains == [own.len(), 0], "{:?}", again.grains);
    let [before, after] = [&heap, &again].map(|h| assembly::resolve(&h.scene).unwrap());
    for i in before.free() {
        let now = after.find(&before.blocks[i].id).unwrap();
        let way = (after.blocks[now].centroid - before.blocks[i].centroid).norm();
        assert!(way < 0.05 * protocol.diameter, "{}: {way}", before.blocks[i].id);
    }
    let mut outside = own.clone();
    outside[0].at[0] = 1.0;
    let said = repose::grown(&protocol, 3, &from(&outside), &mut go_on).unwrap_err().to_string();
    assert!(said.contains("lies outside the box"), "{said}");
    assert!(repose::grown(&protocol, 3, &from(&[]), &mut go_on).is_err());
}

/// A grading curve gives the masses that it says, and the box knows how high they fill it.
#[test]
fn grains_follow_a_grading_curve() {
    let curve = vec![[0.006, 0.0], [0.01, 0.5], [0.02, 1.0]];
    let sizes = Sizes::Curve(curve.clone());
    let diameter = sizes.median().unwrap();
    assert!((diameter - 0.01).abs() < 1e-15);
    let protocol = Protocol { grains: 3000, diameter, sizes, ..Protocol::default() };
    let deposit = voussoir::generate::deposit(&protocol, 1).unwrap();
    let assembly = assembly::resolve(&deposit.scene).unwrap();
    let grains: Vec<(f64, f64)> = assembly
        .free()
        .filter_map(|i| match &assembly.blocks[i].solid {
            Solid::Sphere { radius, .. } => Some((2.0 * radius, assembly.blocks[i].mass)),
            _ => None,
        })
        .collect();
    assert_eq!(grains.len(), 3000);
    let all: f64 = grains.iter().map(|g| g.1).sum();
    let finer = grains.iter().filter(|g| g.0 <= 0.01).map(|g| g.1).sum::<f64>() / all;
    assert!((finer - 0.5).abs() < 0.03, "{finer}");
    assert!(grains.iter().all(|g| (0.006..=0.02).contains(&g.0)));
}

/// Beverloo's discharge, coarsely: few grains. That of 1,000 grains is in docs/grains.md.
#[test]
fn a_hopper_runs_out_as_beverloo_has_it() {
    let protocol = Protocol {
        kind: ProtocolKind::Hopper,
        grains: 450,
        size: Some([9.0, 4.5]),
        ..Protocol::default()
    };
    let heap = run(&protocol, 1);
    assert!(charts(&protocol, &heap)[0].title.contains("Discharged"));
    let Some(Seen::Hopper { rate, beverloo, bulk_density, course }) = &heap.seen else {
        panic!("{:?}", heap.refused)
    };
    let share = bulk_density / protocol.density;
    assert!((0.5..0.66).contains(&share), "{share}");
    assert!((rate.mean / beverloo - 1.0).abs() < 0.25, "{rate:?} and not {beverloo}");
    assert!(course.windows(2).all(|w| w[1][1] >= w[0][1]), "nothing runs back");
    assert!(heap.grains[1] > 200 && heap.slope.is_none());
}

#[test]
fn a_drum_carries_its_grains_up_to_a_slope() {
    let protocol = Protocol {
        kind: ProtocolKind::Drum,
        grains: 300,
        size: Some([18.0, 4.0]),
        rate: Some(2.0),
        ..Protocol::default()
    };
    let heap = run(&protocol, 1);
    assert!(charts(&protocol, &heap)[0].y.label.contains("degrees"));
    let Some(Seen::Drum { angle_deg, by_centre_deg, froude, .. }) = &heap.seen else {
        panic!("{:?}", heap.refused)
    };
    assert!((18.0..40.0).contains(&angle_deg.mean), "{angle_deg:?}");
    // Two methods: the surface, and the place of all grains.
    assert!((angle_deg.mean - by_centre_deg.mean).abs() < 5.0, "{angle_deg:?} {by_centre_deg:?}");
    assert!((froude / (9.0 * 2f64.to_radians().powi(2)) - 1.0).abs() < 1e-9, "{froude}");
    assert_eq!(heap.grains, [300, 0], "nothing leaves a drum");
    // A smooth drum without friction turns under them.
    let smooth = Protocol { floor: FloorKind::Flat, ..protocol.clone() };
    let heap = run(&smooth, 1);
    let lining = |b: &&BlockSpec| b.support && matches!(b.shape, Shape::Sphere { .. });
    assert_eq!(heap.scene.blocks.iter().filter(lining).count(), 0);
    let Some(Seen::Drum { by_centre_deg, .. }) = &heap.seen else { panic!("{:?}", heap.refused) };
    assert!(by_centre_deg.mean.abs() < 6.0, "{by_centre_deg:?}");
    let crowded = Protocol { grains: 3000, ..protocol };
    let said = repose::heap(&crowded, 1, &mut |_| ControlFlow::Break(())).unwrap_err().to_string();
    assert!(said.contains("larger drum"), "{said}");
}

/// Grains without friction resist shear far less than those with it, and the lid bears what it is
/// told to.
#[test]
fn a_shear_box_tells_friction() {
    let of = |friction: f64| {
        let protocol = Protocol {
            kind: ProtocolKind::Shear,
            grains: 250,
            size: Some([9.0, 5.0]),
            rate: Some(0.2),
            friction,
            ..Protocol::default()
        };
        let heap = run(&protocol, 1);
        charts(&protocol, &heap);
        match heap.seen.clone() {
            Some(Seen::Shear { residual, peak, normal_stress, .. }) => {
                let lid = protocol.pressure * protocol.density * 9.81 * protocol.diameter;
                assert!(normal_stress > lid && normal_stress < 1.5 * lid, "{normal_stress} {lid}");
                assert!(peak >= residual.mean);
                residual.mean
            }
            other => panic!("{other:?}: {:?}", heap.refused),
        }
    };
    let (smooth, rough) = (of(0.0), of(0.5));
    assert!((0.0..0.25).contains(&smooth), "{smooth}");
    assert!(rough > smooth + 0.1 && rough < 0.8, "{smooth} {rough}");
}

/// Friction of steady shear in a periodic cell beside that of glass beads; the same on two threads and in
/// other units.
#[test]
fn a_cell_tells_the_internal_friction_that_is_published() {
    let cell = |friction: f64, rate: f64| Protocol {
        kind: ProtocolKind::Cell,
        grains: 250,
        rate: Some(rate),
        friction,
        stiffness: 300.0,
        ..Protocol::default()
    };
    let flown = |protocol: &Protocol, threads: usize| {
        let growing = Growing { threads, ..Growing::default() };
        let mut go_on = |_: &_| ControlFlow::Continue(());
        let heap = repose::grown(protocol, 1, &growing, &mut go_on).unwrap();
        charts(protocol, &heap);
        match heap.seen.clone() {
            Some(Seen::Cell(flown)) => flown,
            other => panic!("{other:?}: {:?}", heap.refused),
        }
    };
    let protocol = cell(0.5, 0.1);
    let rough = flown(&protocol, 1);
    let off = rough.friction.mean / rough.published.friction - 1.0;
    assert!(off.abs() < 0.1 && rough.steps > 20.0, "{off} {rough:?}");
    let share = rough.solid_fraction.mean;
    assert!((0.56..0.6).contains(&share), "{share}");
    assert_eq!(flown(&protocol, 2), rough, "threads");
    let small = Protocol { diameter: protocol.diameter * 0.125, ..protocol };
    let apart = (flown(&small, 1).friction.mean - rough.friction.mean).abs();
    assert!(apart < 4.0 * rough.friction.error, "{apart}");
    // Without friction it is far less, and the grains lie denser.
    let smooth = flown(&cell(0.0, 0.1), 1);
    assert!(smooth.friction.mean < 0.8 * rough.friction.mean, "{smooth:?}");
    assert!(smooth.solid_fraction.mean > share, "{smooth:?}");
}

/// The lid of a long shear box is one clump of hundreds of spheres.
#[test]
fn a_long_shear_box_has_a_lid() {
    let size = Some([50.0, 8.0]);
    let protocol = Protocol { kind: ProtocolKind::Shear, grains: 100, size, ..Protocol::default() };
    let deposit = voussoir::generate::deposit(&protocol, 1).unwrap();
    assert!(deposit.lid.is_some());
    assembly::resolve(&deposit.scene).unwrap();
}

/// What a heap at rest is asked by statics: whether forces hold it. Where they do not, the run went
/// on, and the grains that creep have names.
#[test]
fn a_heap_at_rest_is_confirmed_by_statics() {
    let hulls = [1, 2, 3].map(|seed| (GrainKind::Hull, seed));
    let heaps = [(GrainKind::Sphere, 3), (GrainKind::Clump, 3)].into_iter().chain(hulls);
    for (grain, seed) in heaps {
        let protocol =
            Protocol { grain, grains: 40, size: Some([6.0, 4.0]), ..Protocol::default() };
        let control = Control { law: Law::Associative, ..Control::default() };
        let mut go_on = |_: &_| ControlFlow::Continue(());
        let growing = Growing { statics: Some(&control), ..Growing::default() };
        let heap = repose::grown(&protocol, seed, &growing, &mut go_on).unwrap();
        let statics = heap.statics.clone().expect("asked");
        assert!((1..=ROUNDS).contains(&statics.rounds));
        let (model, _) = held(&model(&heap.scene));
        let verdict = assess(&model, &control).verdict;
        let stands = matches!(verdict, Verdict::Stable | Verdict::Conditional);
        assert_eq!(statics.admissible, stands, "{grain:?}: what is said holds of what is given");
        assert_eq!(statics.creeping.is_empty(), statics.admissible, "{statics:?}");
        assert!(statics.creeping.iter().all(|id| model.assembly.find(id).is_some()));
        // Also where grains rest on corners: friction acts where they touch.
        assert!(statics.admissible, "{grain:?} {seed}: {statics:?}");
        // What presses is where it is solved for: no two dig into each other beside it.
        let overlaps = model.interfaces.left_out.map_or(0, |l| l.overlaps);
        assert_eq!(overlaps, 0, "{grain:?}: pairs that overlap by more than {GRAIN_GAP}");
    }
}
