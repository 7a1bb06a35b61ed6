//! Independent parts: what stands beside a scene changes nothing about it, whatever it weighs,
//! wherever it stands in the list.

use crate::ask::model;
use nalgebra::Vector3;
use voussoir::{
    analysis::{self, Control, Law, Outcome, coulomb, critical::Range, thrust},
    interface::{self, Model},
    scene::{self, Scene},
    verdict::{
        Evidence, Rate, Verdict, claim,
        thrust::{Extreme, ThrustAt},
    },
};

fn scene(blocks: &str, friction: &str, loads: &str) -> Scene {
    let text = format!(
        r#"{{"format": "voussoir-scene/1", "materials": {{"s": {{"density": 2000}}}}, "joints": {{"default": {{"friction": {friction}}}}},
        "blocks": [{blocks}], "loads": {{{loads}}}}}"#
    );
    scene::read_str("test", text).unwrap().0
}

fn block(id: &str, size: [f64; 3], at: [f64; 3], support: bool) -> String {
    format!(
        r#"{{"id": "{id}", "shape": {{"box": {{"size": {size:?}}}}}, "at": {at:?}, "material": "s", "support": {support}}}"#
    )
}

/// A column of blocks, each a little off the one below, on a slab.
fn column(count: usize, off: f64, x: f64, loads: &str) -> Model {
    let mut list = vec![block("slab", [4.0, 4.0, 1.0], [x, 0.0, -0.5], true)];
    for k in 0..count {
        let shift = off * k as f64;
        list.push(block(
            &format!("c{k}"),
            [1.0, 0.7, 0.5],
            [x + shift, 0.0, 0.25 + 0.5 * k as f64],
            false,
        ));
    }
    model(&scene(&list.join(","), "0.6", loads))
}

/// A block between two posts, held by friction alone: statics can, the loads cannot.
fn squeezed(x: f64) -> Model {
    let list = [
        block("left", [1.0, 1.0, 1.0], [x - 1.0, 0.0, 0.0], true),
        block("right", [1.0, 1.0, 1.0], [x + 1.0, 0.0, 0.0], true),
        block("held", [1.0, 1.0, 0.5], [x, 0.0, 0.0], false),
    ];
    model(&scene(&list.join(","), "0.5", ""))
}

fn arch(thickness: f64, live: bool) -> Scene {
    let loads = if live { r#""live": [{"weight": [1, 0, 0]}]"# } else { "" };
    let text = format!(
        r#"{{"format": "voussoir-scene/1", "joints": {{"default": {{"friction": 0.7}}}}, "loads": {{{loads}}},
        "templates": [{{"arch": {{"radius": 1, "thickness": {thickness}, "depth": 0.3, "voussoirs": 9}}}}]}}"#
    );
    scene::read_str("test", text).unwrap().0
}

const SIDEWAYS: &str = r#""live": [{"weight": [1, 0, 0]}]"#;

/// Falls freely.
fn loose(x: f64) -> Model {
    let list = [
        block("far", [1.0; 3], [x, 0.0, 0.0], true),
        block("loose", [1.0; 3], [x, 0.0, 50.0], false),
    ];
    model(&scene(&list.join(","), "0.6", ""))
}

/// Everything as many times as heavy, and its loads.
fn heavier(mut m: Model, by: f64) -> Model {
    let a = &mut m.assembly;
    a.blocks.iter_mut().for_each(|b| b.mass *= by);
    a.blocks.iter_mut().for_each(|b| b.inertia *= by);
    a.dead.iter_mut().chain(&mut a.live).for_each(|w| *w = *w * by);
    a.dead_forces.iter_mut().for_each(|f| f.force *= by);
    m
}

/// Two scenes as one, the blocks of `a` first.
fn union(a: &Model, b: &Model) -> Model {
    let (mut both, n) = (a.clone(), a.assembly.blocks.len());
    let (to, from) = (&mut both.assembly, b.assembly.clone());
    to.blocks.extend(from.blocks.into_iter().map(|mut block| {
        block.id = format!("b.{}", block.id);
        block
    }));
    to.dead.extend(from.dead);
    to.live.extend(from.live);
    to.dead_forces.extend(from.dead_forces.into_iter().map(|mut f| {
        f.block += n;
        f
    }));
    both.interfaces.list.extend(b.interfaces.list.iter().cloned().map(|mut face| {
        (face.a, face.b) = (face.a + n, face.b + n);
        face
    }));
    both
}

/// Both orders, with where the blocks and contacts of `a` begin.
fn both(a: &Model, b: &Model) -> [(Model, usize, usize); 2] {
    [(union(a, b), 0, 0), (union(b, a), b.assembly.blocks.len(), b.interfaces.list.len())]
}

/// Scenes that say nothing about the others: at rest, soft (a tall column), 1e9 times heavier, 1e-9
/// times lighter, of the least and the greatest weights.
fn resting() -> Vec<Model> {
    let plain = || column(3, 0.1, 100.0, "");
    vec![
        plain(),
        column(40, 0.0, 100.0, ""),
        heavier(plain(), 1e9),
        heavier(plain(), 1e-9),
        heavier(plain(), 1e-160),
        heavier(plain(), 1e90),
        model(&{
            let mut far = arch(0.25, false);
            far.blocks.clear();
            far
        }),
    ]
}

fn bits(rates: &[Rate]) -> Vec<u64> {
    rates
        .iter()
        .flat_map(|q| q.velocity.iter().chain(&q.spin).map(|v| v.to_bits()).collect::<Vec<_>>())
        .collect()
}

fn asked() -> Vec<Model> {
    vec![
        column(3, 0.15, 0.0, SIDEWAYS),
        column(4, 0.45, 0.0, ""),
        squeezed(0.0),
        model(&arch(0.2, true)),
        model(&arch(0.08, false)),
        column(
            2,
            0.3,
            0.0,
            r#""live": [{"block": "c1", "force": [10000, 3000, 0]}], "dead": [{"block": "c1", "moment": [0, 300, 0]}]"#,
        ),
    ]
}

fn control() -> Control {
    Control::default()
}

#[test]
fn a_stranger_at_rest_changes_no_digit_of_a_verdict() {
    for (k, a) in asked().iter().enumerate() {
        let alone = analysis::assess(a, &control());
        for (s, stranger) in resting().iter().enumerate() {
            for (m, first, contact) in both(a, stranger) {
                let got = analysis::assess(&m, &control());
                assert_eq!(got.verdict, alone.verdict, "{k} {s}");
                let range = first..first + a.assembly.blocks.len();
                assert_eq!(bits(&got.rates[range.clone()]), bits(&alone.rates), "{k} {s}");
                assert!(
                    (0..got.rates.len())
                        .all(|i| range.contains(&i) || got.rates[i] == Rate::zero()),
                    "{k} {s}"
                );
                assert_eq!(
                    got.forces[contact..contact + a.interfaces.list.len()],
                    alone.forces,
                    "{k} {s}"
                );
                if alone.verdict != Verdict::Stable {
                    assert_eq!(got.equilibrium_error, alone.equilibrium_error, "{k} {s}");
                    let name = got.part.clone().unwrap();
                    let own = first + a.assembly.free().next().unwrap();
                    assert_eq!((name.first, name.of_parts), (m.assembly.blocks[own].id.clone(), 2));
                } else {
                    assert_eq!(got.part, None);
                }
            }
        }
    }
}

/// Forces that a proof to rounding cannot measure: a light block under one of 1e9 kg/m³ that is
/// pushed aslant. What stands beside it is too large for an exact proof, has joints whose strength
/// leaves none, or is held by forces without room.
#[test]
fn a_stranger_without_an_exact_proof_takes_none_away() {
    let sizes = [(1.0, 0.5), (1e9, 1.5), (1.3, 2.5)];
    let mut list = vec![block("slab", [1.0, 0.7, 1.0], [0.0, 0.0, -0.5], true)];
    list.extend(
        sizes
            .iter()
            .enumerate()
            .map(|(k, (_, z))| block(&format!("c{k}"), [1.0, 0.7, 1.0], [0.0, 0.0, *z], false)),
    );
    let mut a = model(&scene(
        &list.join(","),
        "0.7",
        r#""dead": [{"block": "c1", "force": [848.0, 254.8, 0]}]"#,
    ));
    for (k, (density, _)) in sizes.iter().enumerate() {
        let by = density / 2000.0;
        a.assembly.blocks[k + 1].mass *= by;
        a.assembly.blocks[k + 1].inertia *= by;
        a.assembly.dead[k + 1] = a.assembly.dead[k + 1] * by;
    }
    a.assembly.dead_forces.iter_mut().for_each(|f| f.force *= sizes[1].0 / 2000.0);
    let row = |count: usize| {
        let mut list = vec![block(
            "ground",
            [count as f64, 1.0, 1.0],
            [100.0 + 0.5 * count as f64, 0.0, -0.5],
            true,
        )];
        list.extend(
            (0..count)
                .map(|k| block(&format!("r{k}"), [1.0; 3], [100.5 + k as f64, 0.0, 0.5], false)),
        );
        list.join(",")
    };
    let crushable = r#"0.6, "compression": 1e6"#;
    let strangers = [
        model(&scene(&row(1600), "0.6", "")),
        model(&scene(&row(1), crushable, "")),
        model(&scene(&row(1), "0", "")),
    ];
    let alone = analysis::assess(&a, &control());
    assert_eq!(alone.verdict, Verdict::Stable);
    for stranger in &strangers {
        for (m, ..) in both(&a, stranger) {
            let got = analysis::assess(&m, &control());
            assert_eq!(got.verdict, Verdict::Stable);
            let proof =
                claim::verify(&m, &claim::Claim::Stable, Evidence::new(&got.forces, &got.rates));
            assert!(proof.proved(), "{:?}", proof.fails);
        }
    }
}

/// Two parts fall, whatever the live load: a heavy stranger hides neither.
#[test]
fn a_heavy_stranger_keeps_no_proof_from_several_parts_that_fall() {
    let mut a = column(4, 0.45, 0.0, r#""live": [{"weight": [0, 1, 0]}]"#);
    a = union(&a, &loose(30.0));
    let control = Control { law: Law::Associative, ..control() };
    let alone = analysis::limit(&a, &control);
    assert_eq!(alone.outcome, Outcome::Impossible);
    for by in [1.0, 1e6, 1e9, 1e15] {
        for (m, ..) in both(&a, &heavier(column(1, 0.0, 100.0, ""), by)) {
            let got = analysis::limit(&m, &control);
            assert_eq!(got.outcome, Outcome::Impossible, "{by}");
            let proof = claim::verify(
                &m,
                &claim::Claim::Impossible,
                Evidence::new(&got.forces, &got.rates),
            );
            assert!(proof.proved(), "{by}: {:?}", proof.fails);
            // What moves beside a mechanism that is proved has to be one as well.
            let mut rates = got.rates.clone();
            let still = (0..rates.len())
                .find(|&i| !m.assembly.blocks[i].support && rates[i] == Rate::zero())
                .unwrap();
            rates[still].velocity = Vector3::new(0.0, 0.0, -1.0);
            assert!(
                !claim::verify(&m, &claim::Claim::Impossible, Evidence::new(&got.forces, &rates))
                    .proved(),
                "{by}"
            );
        }
    }
}

#[test]
fn the_worst_part_decides() {
    let [falls, pre_stress] = [column(4, 0.45, 0.0, ""), squeezed(300.0)];
    for by in [1e-9, 1.0, 1e9] {
        for (m, ..) in both(&falls, &heavier(squeezed(300.0), by)) {
            assert_eq!(analysis::assess(&m, &control()).verdict, Verdict::Unstable);
        }
        for (m, first, _) in both(&pre_stress, &heavier(loose(100.0), by)) {
            let a = analysis::assess(&m, &control());
            assert_eq!(a.verdict, Verdict::Unstable);
            // The loose block, not the one between the posts.
            assert!((0..3).all(|i| a.rates[first + i] == Rate::zero()));
            assert_eq!(a.floating.len(), 1);
        }
    }
}

#[test]
fn a_stranger_changes_no_digit_of_a_load_factor() {
    for (k, a) in asked()
        .iter()
        .enumerate()
        .filter(|(_, a)| a.assembly.live.iter().any(|w| w.force != Vector3::zeros()))
    {
        let alone = analysis::limit(a, &control());
        assert_eq!(alone.outcome, Outcome::Found, "{k}");
        let dry = coulomb::load_factor(a, &alone, &control());
        let mut strangers = resting();
        // Bears more, and one on which the live load wedges nothing but presses.
        strangers.push(heavier(column(1, 0.0, 100.0, SIDEWAYS), 1e9));
        strangers.push(column(
            1,
            0.0,
            100.0,
            r#""live": [{"block": "c0", "force": [0, 0, -1e12]}]"#,
        ));
        for (s, stranger) in strangers.iter().enumerate() {
            for (m, first, _) in both(a, stranger) {
                let got = analysis::limit(&m, &control());
                assert_eq!(
                    (got.outcome, got.value.map(f64::to_bits)),
                    (Outcome::Found, alone.value.map(f64::to_bits)),
                    "{k} {s}: {:?} {:?}",
                    got.value,
                    alone.value
                );
                assert_eq!(got.bracket, alone.bracket, "{k} {s}");
                assert_eq!(
                    bits(&got.rates[first..first + a.assembly.blocks.len()]),
                    bits(&alone.rates),
                    "{k} {s}"
                );
                // The other part is in balance there as well.
                let parts = interface::parts(&m);
                for part in &parts {
                    let loads = part.units.own_load_factor(got.value.unwrap());
                    let s = voussoir::verdict::certificate::statics(
                        &part.model,
                        &part.take_forces(&got.forces),
                        loads,
                    );
                    assert!(s.equilibrium_error < 1e-5 && s.cone_excess < 1e-12, "{k} {s:?}");
                }
                let both = coulomb::load_factor(&m, &got, &control());
                assert_eq!(
                    (both.found, both.value.map(f64::to_bits)),
                    (dry.found, dry.value.map(f64::to_bits)),
                    "{k} {s}: {:?} {:?}",
                    both.value,
                    dry.value
                );
            }
        }
    }
}

#[test]
fn parts_without_a_live_load_stand_or_leave_no_load_factor() {
    let a = column(3, 0.15, 0.0, SIDEWAYS);
    for falls in [column(4, 0.45, 100.0, ""), loose(100.0), heavier(loose(100.0), 1e-12)] {
        for (m, first, _) in both(&a, &falls) {
            let got = analysis::limit(&m, &control());
            assert_eq!(got.outcome, Outcome::Impossible);
            assert!((0..a.assembly.blocks.len()).all(|i| got.rates[first + i] == Rate::zero()));
        }
    }
}

/// A block on a slope that needs the live load to stay, from λ = 10 on, beside one that slides at λ
/// = 4.
#[test]
fn parts_that_need_and_refuse_the_live_load_leave_none() {
    let wall = [
        block("wall", [1.0, 3.0, 6.0], [-1.0, 0.0, 0.0], true),
        block("hung", [1.0, 1.0, 1.0], [0.0, 0.0, 0.5], false),
    ]
    .join(",");
    let hung =
        model(&scene(&wall, "0.5", r#""live": [{"block": "hung", "force": [-4000, 0, 0]}]"#));
    let flat = [
        block("slab", [4.0, 4.0, 1.0], [100.0, 0.0, -0.5], true),
        block("slides", [1.0, 1.0, 1.0], [100.0, 0.0, 0.5], false),
    ]
    .join(",");
    let slides = |force: f64| {
        model(&scene(
            &flat,
            "0.4",
            &format!(r#""live": [{{"block": "slides", "force": [{force}, 0, 0]}}]"#),
        ))
    };
    // It slides at 0.4 × 19620 N; the other needs 2 × 19620 N, at λ = 9.81.
    for by in [1e-6, 1.0, 1e6] {
        for (m, ..) in both(&hung, &heavier(slides(2000.0), by)) {
            let got = analysis::limit(&m, &control());
            assert_eq!(got.outcome, Outcome::Impossible);
        }
        for (m, ..) in both(&hung, &heavier(slides(500.0), by)) {
            let got = analysis::limit(&m, &control());
            assert_eq!(got.outcome, Outcome::Found);
            let value = got.found().unwrap();
            assert!((value - 0.4 * 19620.0 / 500.0).abs() < 1e-6, "{value}");
        }
    }
}

#[test]
fn a_stranger_changes_no_digit_of_a_tilt_or_a_thrust() {
    for (k, a) in [column(3, 0.15, 0.0, ""), model(&arch(0.2, false))].iter().enumerate() {
        let toward = Vector3::new(1.0, 0.2, 0.0);
        let alone = analysis::tilt(a, toward, &control()).unwrap();
        let support = thrust::bearing_supports(a)[0];
        let ends = |m: &Model, support: usize| {
            let at = ThrustAt { support, direction: [1.0, 0.0, 0.0] };
            let standing = analysis::assess(m, &control());
            [Extreme::Least, Extreme::Greatest].map(|e| {
                let end = thrust::thrust(m, at, e, &standing.forces, &control());
                (
                    end.outcome,
                    end.value.map(f64::to_bits),
                    end.bracket.lower.to_bits(),
                    end.bracket.upper.to_bits(),
                )
            })
        };
        let thrusts = ends(a, support);
        // What is flatter stands longer.
        for (s, stranger) in
            [1e-9, 1.0, 1e9].map(|by| heavier(column(1, 0.0, 100.0, ""), by)).iter().enumerate()
        {
            for (m, first, _) in both(a, stranger) {
                let got = analysis::tilt(&m, toward, &control()).unwrap();
                assert_eq!(
                    got.angle_deg().map(f64::to_bits),
                    alone.angle_deg().map(f64::to_bits),
                    "{k} {s}: {:?} {:?}",
                    got.angle_deg(),
                    alone.angle_deg()
                );
                assert_eq!(got.load_factor.bracket, alone.load_factor.bracket);
                assert_eq!(ends(&m, first + support), thrusts, "{k} {s}");
            }
        }
    }
}

#[test]
fn a_stranger_changes_no_digit_of_a_critical_value() {
    let range =
        Range { pointer: "/templates/0/arch/thickness".into(), from: 0.06, to: 0.2, scan: Some(4) };
    let control = Control { law: Law::Associative, ..control() };
    let alone = analysis::critical(&arch(0.1, false), &range, &control).unwrap();
    for density in [1e-6, 2000.0, 1e12] {
        let mut more = scene(
            &[
                block("slab", [4.0, 4.0, 1.0], [100.0, 0.0, -0.5], true),
                block("still", [1.0, 1.0, 1.0], [100.0, 0.0, 0.5], false),
            ]
            .join(","),
            "0.7",
            "",
        );
        more.templates = arch(0.1, false).templates;
        more.materials.values_mut().for_each(|m| m.density = density);
        let got = analysis::critical(&more, &range, &control).unwrap();
        let values = |c: &analysis::Critical| {
            c.changes.iter().map(|c| c.value.to_bits()).collect::<Vec<_>>()
        };
        assert_eq!((values(&got), got.probes), (values(&alone), alone.probes), "{density}");
    }
}

#[test]
fn at_survey_coordinates_the_verdicts_are_the_same() {
    let verdict = |m: &Model| analysis::assess(m, &control());
    for (k, a) in asked().iter().enumerate() {
        let here = verdict(a);
        for by in [1024.0, 1_048_576.0, 5e6] {
            let mut m = a.clone();
            let shift = Vector3::new(by, -by, 0.0);
            m.assembly.blocks.iter_mut().for_each(|b| b.centroid += shift);
            m.interfaces.list.iter_mut().for_each(|f| {
                f.points.iter_mut().chain(f.pieces.iter_mut().flatten()).for_each(|p| *p += shift)
            });
            assert_eq!(verdict(&m).verdict, here.verdict, "{k} {by}");
        }
    }
}

/// A couple of 1e11 N m on a block of one kilogramme in a socket that holds it.
#[test]
fn moments_count_in_the_load_of_a_block() {
    let mut list = vec![
        block("floor", [3.0, 3.0, 1.0], [0.0, 0.0, -1.0], true),
        block("key", [1.0; 3], [0.0; 3], false),
    ];
    for (k, at) in [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0]]
        .into_iter()
        .enumerate()
    {
        list.push(block(&format!("w{k}"), [1.0; 3], at, true));
    }
    let m = model(&scene(
        &list.join(","),
        "0.3",
        r#""dead": [{"block": "key", "moment": [0, 0, 1e11]}]"#,
    ));
    let a = analysis::assess(&m, &Control { law: Law::Associative, ..control() });
    assert_eq!(a.verdict, Verdict::Stable);
    assert!(claim::verify(&m, &claim::Claim::Stable, Evidence::new(&a.forces, &a.rates)).proved());
}
