//! Rocking: closed forms of blocks and frames, integrated as mechanisms of one degree of freedom.

use crate::ask::{fixed, model, prism, scene};
use nalgebra::Vector3;
use serde_json::{Value, json};
use voussoir::{
    analysis::{
        Control,
        follow::machine::{Built, Exactness, MachineOptions, machine},
    },
    ground::{Motion, Pulse},
    rocking::{RunSettings, Search, run, scan},
    scene::Scene,
};

const NO_SLIDING: f64 = f64::INFINITY;

fn close(what: &str, got: f64, want: f64, relative: f64) {
    assert!((got - want).abs() <= relative * want.abs(), "{what}: {got} instead of {want}");
}

fn ground(half: f64) -> Value {
    fixed(prism("ground", &[[-half, -1.0], [half, -1.0], [half, 0.0], [-half, 0.0]]))
}

/// A block of these half sizes on the ground, g = 9.81 m/s².
fn block(b: f64, h: f64) -> Scene {
    let stone = prism("stone", &[[-b, 0.0], [b, 0.0], [b, 2.0 * h], [-b, 2.0 * h]]);
    let blocks = json!([ground(20.0 * h), stone]);
    scene(NO_SLIDING, blocks, json!({ "gravity": [0, 0, -9.81] }))
}

fn options() -> MachineOptions {
    MachineOptions { toward: Vector3::x(), control: None, restitution: None }
}

fn built(scene: &Scene, options: &MachineOptions) -> Built {
    machine(scene, &model(scene), options, &Control::default()).expect("a machine")
}

/// The block of Housner's examples: b = 0.2 m, h = 1 m.
fn housner() -> Built {
    built(&block(0.2, 1.0), &options())
}

const ALPHA: f64 = 0.197_395_559_849_880_78;

/// The least scale at which it overturns, by halving what a scan of 40 finds.
fn overturns(built: &Built, motion: &Motion, from: f64, to: f64) -> f64 {
    let search = Search { from, to, steps: 40, width: 1e-12 };
    scan(&built.machine, motion, &RunSettings::default(), &search).flips[0].overturns_at()
}

#[test]
fn a_block_is_exact_and_has_housners_numbers() {
    for (ratio, e) in
        [(5.0, 0.942_307_692_3), (6.0, 0.959_459_459_5), (4.0, 0.911_764_705_9), (3.0, 0.85)]
    {
        let built = built(&block(0.2, 0.2 * ratio), &options());
        assert_eq!(built.exactness, Exactness::Exact);
        built.conserving.iter().for_each(|&c| close("restitution", c, e, 1e-9));
    }
    let built = housner();
    let sense = built.machine.senses[0].as_ref().expect("it rocks");
    close("p", sense.frequency().expect("unstable"), 2.686_004_899_734_165_5, 1e-10);
    close("unstable", sense.unstable.expect("unstable"), ALPHA, 1e-10);
    close("release", sense.release(), 9.81 * 0.2, 1e-10);
    close("load factor", built.proofs[0].1.value.unwrap(), 0.2, 1e-8);
}

/// Housner 1963, exact quarter periods by quadrature (30 digits).
#[test]
fn quarter_periods_of_a_free_block() {
    let built = housner();
    for (from, quarter) in [
        (0.2, 0.258_643_530_042_807),
        (0.5, 0.490_864_457_849_559),
        (0.8, 0.853_852_114_838_999),
        (0.95, 1.373_447_810_392_98),
    ] {
        let settings = RunSettings { from, ..RunSettings::default() };
        let history = run(&built.machine, &Motion::default(), &settings);
        close("first impact", history.impacts[0].time, quarter, 1e-9);
    }
}

#[test]
fn amplitudes_decay_over_impacts() {
    let built = housner();
    let settings = RunSettings { from: 0.5, ..RunSettings::default() };
    let history = run(&built.machine, &Motion::default(), &settings);
    let times = [0.490864, 1.344805, 2.104264, 2.788931, 3.411862];
    let peaks = [0.4221935, 0.3609679, 0.3111273, 0.2697009, 0.2347818];
    for k in 0..5 {
        assert!((history.impacts[k].time - times[k]).abs() < 1e-6);
        let peak = history.impacts[k + 1].peak / ALPHA;
        assert!((peak - peaks[k]).abs() < 2e-7, "{peak} {}", peaks[k]);
    }
    assert_eq!(history.fate, voussoir::rocking::Fate::Rests);
    assert!(history.steps < 20_000, "{}", history.steps);
}

#[test]
fn rectangle_that_just_overturns() {
    let built = housner();
    let p = 2.686_004_899_734_165_5;
    for (a, want) in [(1.5, 1.0987024), (2.0, 0.6941387), (3.0, 0.4065343)] {
        let acceleration = a * 9.81 * 0.2;
        let fate = |t: f64| {
            let motion = Pulse::Rectangle { acceleration, duration: t }.motion();
            run(&built.machine, &motion, &RunSettings::default()).overturned()
        };
        let (mut low, mut high) = (0.5 * want / p, 2.0 * want / p);
        assert!(!fate(low) && fate(high));
        while high - low > 1e-13 {
            let middle = 0.5 * (low + high);
            if fate(middle) { high = middle } else { low = middle }
        }
        close("p t1", p * high, want, 1e-6);
    }
}

#[test]
fn half_sine_that_just_overturns() {
    // alpha = 0.2 rad.
    let built = built(&block(0.2_f64.tan(), 1.0), &options());
    let p = built.machine.senses[0].as_ref().and_then(|s| s.frequency()).expect("p");
    let want = [1.321685, 1.801227, 2.296165, 2.795134, 3.295663, 3.796937, 4.800531, 5.804775];
    for (ratio, want) in [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0].into_iter().zip(want) {
        let duration = std::f64::consts::PI / (ratio * p);
        let acceleration = 9.81 * 0.2_f64.tan();
        let motion = Pulse::HalfSine { acceleration, duration }.motion();
        close("A", overturns(&built, &motion, 1.0, 8.0), want, 2e-6);
    }
}

/// Zhang & Makris 2001: bands.
#[test]
fn a_full_sine_overturns_in_bands() {
    let (p, alpha): (f64, f64) = (2.14, 0.25);
    let r = 3.0 * 9.81 / (4.0 * p * p);
    let scene = block(r * alpha.sin(), r * alpha.cos());
    let built = built(&scene, &MachineOptions { restitution: Some(0.9), ..options() });
    let duration = 2.0 * std::f64::consts::PI / (5.0 * p);
    // A = a / (g alpha).
    let motion = Pulse::Sine { acceleration: 9.81 * alpha, duration }.motion();
    let search = Search { from: 1.0, to: 9.0, steps: 80, width: 1e-9 };
    let scan = scan(&built.machine, &motion, &RunSettings::default(), &search);
    let want = [(3.032339, true), (6.743019, false), (7.493, true)];
    assert_eq!(scan.flips.len(), 3);
    for (flip, (value, above)) in scan.flips.iter().zip(want) {
        assert_eq!(flip.overturns_above, above);
        assert!((flip.upper - value).abs() < 2e-6, "{flip:?}");
    }
    // With one impact in the first band, without any beyond the second.
    let impacts =
        |a: f64| scan.seen.iter().find(|s| s.0 > a).and_then(|s| s.1).expect("it overturns there");
    assert_eq!([impacts(4.0), impacts(8.0)], [1, 0]);
}

#[test]
fn velocity_jumps_that_just_overturn() {
    let built = housner();
    let single = overturns(&built, &Pulse::Jump { velocity: 1.0 }.motion(), 0.1, 2.0);
    close("V single", single, 0.734_025_135_1, 1e-8);
    let double = overturns(&built, &Pulse::DoubleJump { velocity: 1.0 }.motion(), 0.1, 0.7);
    close("V double", double, 0.377_913_930_9, 1e-8);
}

/// Columns of b = 0.3 m, h = 1.5 m under a beam of `gamma` times their mass.
fn frame(columns: usize, gamma: f64) -> Scene {
    let (b, h) = (0.3, 1.5);
    let mut blocks = vec![ground(40.0)];
    let at = |k: usize| 4.0 * k as f64;
    for k in 0..columns {
        let x = at(k);
        let outline = [[x - b, 0.0], [x + b, 0.0], [x + b, 2.0 * h], [x - b, 2.0 * h]];
        blocks.push(prism(&format!("column{k}"), &outline));
    }
    if gamma > 0.0 {
        let (x0, x1) = (-b, at(columns - 1) + b);
        let mut beam = prism("beam", &[[x0, 3.0], [x1, 3.0], [x1, 3.5], [x0, 3.5]]);
        let column = 4.0 * b * h;
        beam["density"] = json!(gamma * columns as f64 * column / (0.5 * (x1 - x0)));
        blocks.push(beam);
    }
    scene(NO_SLIDING, json!(blocks), json!({ "gravity": [0, 0, -9.81] }))
}

/// Makris & Vassiliou 2013.
#[test]
fn frames_with_a_loose_beam() {
    let want = [
        (0.0, 2.193113817, 0.9423076923, 0.6004968309),
        (0.5, 1.961580631, 0.9307692308, 0.6713758671),
        (2.0, 1.853519474, 0.9258241758, 0.7105174322),
        (10.0, 1.805053055, 0.9236972705, 0.729595118),
    ];
    for columns in [1, 2, 3] {
        for (gamma, p, e, quarter) in want {
            if (gamma == 0.0) != (columns == 1) {
                continue;
            }
            let built = built(&frame(columns, gamma), &options());
            assert_eq!(built.exactness, Exactness::Exact);
            let own = built.machine.senses[0].as_ref().and_then(|s| s.frequency()).expect("p");
            close("p", own, p, 1e-8);
            close("linear quarter period", 2.0_f64.acosh() / own, quarter, 1e-9);
            built.conserving.iter().for_each(|&c| close("e", c, e, 1e-8));
            close("load factor", built.proofs[0].1.value.unwrap(), 0.2, 1e-8);
            close("release", built.machine.senses[0].as_ref().unwrap().release(), 1.962, 1e-9);
        }
    }
}

mod engine {
    //! The same blocks in the engine, which knows nothing of mechanisms.

    use super::{block, close};
    use crate::ask::model;
    use nalgebra::Vector3;
    use voussoir::{
        dynamics::{Fidelity, Shaken, ShakenFate, Shaking, SimulationSettings, shake},
        ground::{Motion, Pulse},
        scene::Scene,
    };

    const AXES: fn() -> [Vector3<f64>; 3] = || [Vector3::x(), Vector3::y(), Vector3::z()];

    fn shaken(scene: &Scene, motion: &Motion, more: SimulationSettings) -> Shaken {
        let settings = SimulationSettings { fidelity: Some(Fidelity::Fine), ..more };
        let mut watch = |_: &voussoir::dynamics::Progress| std::ops::ControlFlow::Continue(());
        let ground = Shaking { motion, axes: &AXES(), burdens: &[] };
        shake(&model(scene), ground, &settings, &mut watch).expect("an outcome")
    }

    fn overturns(scene: &Scene, motion: &Motion) -> bool {
        let outcome = shaken(scene, motion, SimulationSettings::default());
        matches!(outcome.fate, ShakenFate::Overturned { .. })
    }

    /// First amplitudes that overturn, within 2 %.
    #[test]
    fn first_overturning_amplitudes() {
        let scene = block(0.2, 1.0);
        let p = 2.686_004_899_734_165_5;
        for (a, pt) in [(1.5, 1.0987024), (2.0, 0.6941387), (3.0, 0.4065343)] {
            let motion =
                Pulse::Rectangle { acceleration: a * 9.81 * 0.2, duration: pt / p }.motion();
            assert_eq!([0.98, 1.02].map(|k| overturns(&scene, &motion.scaled(k))), [false, true]);
        }
        let jump = Pulse::Jump { velocity: 0.734_025_135_1 }.motion();
        assert_eq!([0.98, 1.02].map(|k| overturns(&scene, &jump.scaled(k))), [false, true]);
        let scene = block(0.2_f64.tan(), 1.0);
        let p = (0.75 * 9.81 * 0.2_f64.cos()).sqrt();
        for (ratio, a) in [
            (1.0, 1.321685),
            (2.0, 1.801227),
            (3.0, 2.296165),
            (4.0, 2.795134),
            (5.0, 3.295663),
            (6.0, 3.796937),
            (8.0, 4.800531),
            (10.0, 5.804775),
        ] {
            let duration = std::f64::consts::PI / (ratio * p);
            let acceleration = a * 9.81 * 0.2_f64.tan();
            let motion = Pulse::HalfSine { acceleration, duration }.motion();
            assert_eq!([0.98, 1.02].map(|k| overturns(&scene, &motion.scaled(k))), [false, true]);
        }
    }

    /// Housner 1963: what an impact leaves of the speed, told from the highest points before and
    /// after it; the jump of the ground lifts every block to about the same part of its way.
    #[test]
    fn an_impact_keeps_housners_speed() {
        for (slenderness, e) in
            [(5.0, 0.942_307_692_3), (6.0, 0.959_459_459_5), (4.0, 0.911_764_705_9), (3.0, 0.85)]
        {
            let b: f64 = 1.0 / slenderness;
            let (alpha, r) = (b.atan(), b.hypot(1.0));
            let velocity = 0.68 / alpha.cos() * (8.0 / 3.0 * 9.81 * r * (1.0 - alpha.cos())).sqrt();
            let more =
                SimulationSettings { seconds: Some(3.0), every_step: true, ..Default::default() };
            let settings = SimulationSettings { fidelity: Some(Fidelity::Fine), ..more };
            let mut angles: Vec<f64> = Vec::new();
            let mut watch = |progress: &voussoir::dynamics::Progress| {
                angles.extend(progress.moment.map(|f| f.blocks[1].turn.scaled_axis().y));
                std::ops::ControlFlow::Continue(())
            };
            let motion = Pulse::Jump { velocity }.motion();
            let ground = Shaking { motion: &motion, axes: &AXES(), burdens: &[] };
            shake(&model(&block(b, 1.0)), ground, &settings, &mut watch).expect("an outcome");
            // The ground goes to +x, the block leans to −x, comes back, and leans to +x.
            let first = angles.iter().copied().fold(0.0, f64::min);
            let lowest = angles.iter().position(|a| *a == first).expect("an angle");
            let second = angles[lowest..].iter().copied().fold(0.0, f64::max);
            let energy = |angle: f64| (alpha - angle.abs()).cos() - alpha.cos();
            let left = (energy(second) / energy(first)).sqrt();
            close(&format!("what is left of the speed at h/b = {slenderness}"), left, e, 5e-3);
        }
    }
}

/// A wall with a floor on it: the masses that loads stand for rock with it.
#[test]
fn masses_of_dead_loads_take_part() {
    let open = |name: &str| {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("structures").join(name);
        crate::ask::open(&path)
    };
    // Circolare 2019, C8.7.1.2.1: (68.4 × 0.3 + 40 × 0.4) / (68.4 × 3 + 40 × 6).
    let floor = open("overturning-wall-with-floor.json");
    let built = built(&floor, &options());
    close(
        "load factor",
        built.proofs[0].1.value.unwrap(),
        (68.4 * 0.3 + 40.0 * 0.4) / (68.4 * 3.0 + 40.0 * 6.0),
        1e-6,
    );
    // m about the toe: 68.4 (0.6² + 6²) / 3 g + 40 (0.4² + 6²) / g.
    let inertia = (68.4e3 * (0.36 + 36.0) / 3.0 + 40e3 * (0.16 + 36.0)) / 9.81;
    let sense = built.machine.senses[0].as_ref().expect("it rocks");
    let at = sense.law.at(0.1);
    let g = floor_gravity(&floor);
    close("inertia", at.inertia, inertia * 9.81 / g, 1e-9);
}

fn floor_gravity(scene: &Scene) -> f64 {
    model(scene).assembly.gravity.norm()
}

/// Neither units, nor place, nor orientation, nor what stands beside it changes a history.
#[test]
fn histories_do_not_depend_on_units_place_and_strangers() {
    let want = housner();
    let motion = Pulse::Sine { acceleration: 3.0, duration: 0.4 }.motion();
    let free =
        |built: &Built, motion: &Motion| run(&built.machine, motion, &RunSettings::default());
    let first = free(&want, &motion);
    assert!(first.impacts.len() > 3);
    let same = |what: &str, other: &voussoir::rocking::History, time: f64| {
        assert_eq!(first.impacts.len().min(20), other.impacts.len().min(20), "{what}");
        for (a, b) in first.impacts.iter().zip(&other.impacts).take(4) {
            close(what, b.time / time, a.time, 1e-7);
        }
        close(what, other.greatest.q, first.greatest.q, 1e-7);
    };
    // A thousandth of the size at a thousandth of the gravity takes as long.
    let small = scene(
        NO_SLIDING,
        json!([
            ground(20e-3),
            prism("stone", &[[-2e-4, 0.0], [2e-4, 0.0], [2e-4, 2e-3], [-2e-4, 2e-3]])
        ]),
        json!({ "gravity": [0, 0, -9.81e-3] }),
    );
    same("units", &free(&built(&small, &options()), &motion.scaled(1e-3)), 1.0);
    // Far away, and beside a heavier, squatter block.
    let (x, y) = (500e3, 200.0);
    let far = scene(
        NO_SLIDING,
        json!([
            fixed(prism(
                "ground",
                &[[x - 20.0, y - 1.0], [x + 20.0, y - 1.0], [x + 20.0, y], [x - 20.0, y]]
            )),
            prism("heavy", &[[x + 5.0, y], [x + 8.0, y], [x + 8.0, y + 2.0], [x + 5.0, y + 2.0]]),
            prism("stone", &[[x - 0.2, y], [x + 0.2, y], [x + 0.2, y + 2.0], [x - 0.2, y + 2.0]])
        ]),
        json!({ "gravity": [0, 0, -9.81] }),
    );
    same("place and strangers", &free(&built(&far, &options()), &motion), 1.0);
    // Gravity along −x, the ground along z.
    let lying = scene(
        NO_SLIDING,
        json!([
            fixed(prism("ground", &[[-1.0, -20.0], [0.0, -20.0], [0.0, 20.0], [-1.0, 20.0]])),
            prism("stone", &[[0.0, -0.2], [2.0, -0.2], [2.0, 0.2], [0.0, 0.2]])
        ]),
        json!({ "gravity": [-9.81, 0, 0] }),
    );
    let toward = MachineOptions { toward: Vector3::z(), ..options() };
    same("orientation", &free(&built(&lying, &toward), &motion), 1.0);
}

/// Linkages with several hinges are idealisations, and their tables are smooth.
#[test]
fn an_arch_is_an_idealisation() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/structures/oppenheim-arch.json");
    let built = built(&crate::ask::open(path.as_ref()), &options());
    assert!(matches!(built.exactness, Exactness::Idealised(_)));
    close("load factor", built.proofs[0].1.value.unwrap(), 0.373_611_692, 1e-6);
    let sense = built.machine.senses[0].as_ref().expect("it rocks");
    close(
        "release",
        sense.release() / model(&crate::ask::open(path.as_ref())).assembly.gravity.norm(),
        0.373_611_692,
        1e-6,
    );
    // The slope of the inertia and of the resistance by differences.
    let h = 1e-5;
    for q in [0.01, 0.03, 0.06] {
        let [a, b, v] = [q - h, q + h, q].map(|q| sense.law.at(q));
        close("slope of the inertia", (b.inertia - a.inertia) / (2.0 * h), v.growth, 1e-5);
        close("stiffness", (b.resistance - a.resistance) / (2.0 * h), v.stiffness, 1e-5);
    }
    // Without loss, energy stays.
    let settings = RunSettings { from: 0.5, until: Some(3.0), ..RunSettings::default() };
    let mut machine = built.machine.clone();
    machine.restitution = [1.0; 2];
    let history = run(&machine, &Motion::default(), &settings);
    let unstable = sense.unstable.expect("unstable");
    assert!((history.greatest.q.abs() / unstable - 0.5).abs() < 1e-9, "{:?}", history.greatest);
}
