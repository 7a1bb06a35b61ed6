//! Piles from numbers: closed forms, agreement with the questions about scenes, mistakes.

use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use voussoir::{
    analysis::{
        self, Control, Law,
        piles::{Decided, Pile, Piles},
    },
    assembly::Put,
    interface::Model,
    scene::read_str,
    verdict::Verdict,
};

fn piles(blocks: &str, rest: &str) -> Piles {
    let text = format!(
        r#"{{ "format": "voussoir-scene/1", "joints": {{ "default": {{ "friction": 0.6 }} }},
        "blocks": [ {blocks} ]{rest} }}"#
    );
    let mut piles = Piles::new(&read_str("shapes", &text).unwrap().0).unwrap();
    piles.margin = true;
    piles
}

fn boxes(sizes: &[[f64; 3]]) -> Piles {
    let blocks: Vec<String> = sizes
        .iter()
        .enumerate()
        .map(|(k, size)| {
            format!(
                r#"{{ "id": "{k}", "support": {}, "shape": {{ "box": {{ "size": {size:?} }} }} }}"#,
                k == 0
            )
        })
        .collect();
    piles(&blocks.join(", "), "")
}

fn put(shape: usize, at: [f64; 3]) -> Put {
    Put { shape, at: at.into(), turn: UnitQuaternion::identity(), mass: None }
}

/// A linear congruential generator (Knuth, MMIX).
struct Random(u64);

impl Random {
    fn within(&mut self, from: f64, to: f64) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        from + (to - from) * (self.0 >> 33) as f64 / (1u64 << 31) as f64
    }
}

/// Boxes of 0.5 × 0.4 × 0.2 m, one on the other, as they come.
fn stack(random: &mut Random, count: usize) -> Vec<Put> {
    let mut list = vec![put(0, [0.0, 0.0, -0.1])];
    let (mut x, mut y) = (0.0, 0.0);
    for k in 0..count {
        x += random.within(-0.12, 0.12);
        y += random.within(-0.12, 0.12);
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), random.within(0.0, 1.5));
        list.push(Put { turn, ..put(1, [x, y, 0.1 + 0.2 * k as f64]) });
    }
    list
}

const BRICK: [f64; 3] = [0.5, 0.4, 0.2];

#[test]
fn a_column_tips_about_its_foot_or_slides_on_it() {
    let piles = boxes(&[[9.0, 9.0, 0.2], BRICK]);
    for count in 1..12 {
        let list: Vec<Put> = std::iter::once(put(0, [0.0, 0.0, -0.1]))
            .chain((0..count).map(|k| put(1, [0.0, 0.0, 0.1 + 0.2 * f64::from(k)])))
            .collect();
        let answer = piles.ask(&list).unwrap();
        let exact = (0.2 / (0.1 * f64::from(count))).min(0.6);
        let margin = answer.margin.unwrap();
        assert_eq!((answer.verdict, answer.by), (Verdict::Stable, Decided::Statics));
        for end in [margin.lower, margin.upper] {
            assert!((end - exact).abs() <= 1e-12 * exact, "{count} boxes: {end} for {exact}");
        }
    }
}

#[test]
fn on_an_incline_it_slides_downhill_first() {
    // A wedge of slope 0.25, and a flat slab on it that cannot tip before it slides.
    let slope = 0.25_f64.atan();
    let wedge = r#"{ "id": "wedge", "support": true, "shape": { "prism": { "polygon": [[-2, -0.5], [2, 0.5], [2, -1], [-2, -1]], "depth": 2 } } },
        { "id": "slab", "shape": { "box": { "size": [1, 1, 0.1] } } }"#;
    let piles = piles(wedge, "");
    let turn = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -slope);
    let at = turn * Vector3::new(0.0, 0.0, 0.05);
    let answer = piles.ask(&[put(0, [0.0; 3]), Put { at, turn, ..put(1, [0.0; 3]) }]).unwrap();
    let exact = (0.6_f64.atan() - slope).tan();
    let margin = answer.margin.unwrap();
    assert!(margin.lower <= exact + 1e-12 && margin.upper >= exact - 1e-12, "{margin:?} {exact}");
    assert!(margin.width() <= 2e-4 * exact, "{margin:?}");
}

/// The verdict of `assess` on the same model.
fn assessed(model: &Model) -> Verdict {
    analysis::assess(model, &Control::default()).verdict
}

#[test]
fn statics_alone_agrees_with_the_programs() {
    let piles = boxes(&[[9.0, 9.0, 0.2], BRICK]);
    let mut random = Random(11);
    let (mut stand, mut fall) = (0, 0);
    for _ in 0..30 {
        let list = stack(&mut random, 10);
        let answer = piles.ask(&list).unwrap();
        let model = piles.model(&list).unwrap();
        assert_eq!(answer.by, Decided::Statics);
        assert_eq!(answer.verdict, assessed(&model));
        match answer.verdict {
            Verdict::Stable => stand += 1,
            _ => fall += 1,
        }
        // What it bears in eight directions is no less, and in one of them little more.
        if let Some(margin) = answer.margin {
            borne(&model, margin.lower, 3);
        }
    }
    assert!(stand >= 5 && fall >= 5, "{stand} stand, {fall} fall");
}

/// Load factors of the model in so many horizontal directions, none below `margin`; the least.
fn borne(model: &Model, margin: f64, directions: usize) -> f64 {
    let mut least = f64::INFINITY;
    let control = Control { law: Law::Associative, ..Control::default() };
    for k in 0..directions {
        let (sin, cos) = (std::f64::consts::TAU * k as f64 / directions as f64).sin_cos();
        let mut pushed = model.clone();
        let assembly = &mut pushed.assembly;
        let g = assembly.gravity.norm();
        for (block, live) in assembly.blocks.iter().zip(&mut assembly.live) {
            if !block.support {
                live.force = Vector3::new(cos, sin, 0.0) * (block.mass * g);
            }
        }
        let factor = analysis::limit(&pushed, &control);
        assert!(factor.bracket.upper >= margin * (1.0 - 1e-9), "{:?} {margin}", factor.bracket);
        least = least.min(factor.bracket.upper);
    }
    least
}

#[test]
fn closed_chains_are_asked_of_programs() {
    // A beam on two posts, of which one is slender: the frame falls across first.
    let piles = boxes(&[[9.0, 9.0, 0.2], [0.3, 0.3, 1.0], [0.2, 0.3, 1.0], [2.0, 0.3, 0.2]]);
    let list = [
        put(0, [0.0, 0.0, -0.1]),
        put(1, [-0.8, 0.0, 0.5]),
        put(2, [0.8, 0.0, 0.5]),
        put(3, [0.0, 0.0, 1.1]),
    ];
    let answer = piles.ask(&list).unwrap();
    assert_eq!((answer.verdict, answer.by), (Verdict::Stable, Decided::Program));
    let margin = answer.margin.unwrap();
    assert!(margin.lower >= 0.97 * margin.upper && margin.lower > 0.1, "{margin:?}");
    let least = borne(&piles.model(&list).unwrap(), margin.lower, 24);
    assert!(least <= 1.05 * margin.upper, "{least} {margin:?}");
}

#[test]
fn units_places_and_directions_change_nothing() {
    let ask = |length: f64, move_it: &dyn Fn(&Put) -> Put, mass: f64| -> Vec<Pile> {
        let piles = boxes(&[[9.0, 9.0, 0.2], BRICK].map(|size| size.map(|x| x * length)));
        let mut random = Random(5);
        (0..10)
            .map(|_| {
                let list: Vec<Put> = stack(&mut random, 5)
                    .iter()
                    .map(|p| move_it(&Put { at: p.at * length, mass: Some(mass), ..*p }))
                    .collect();
                piles.ask(&list).unwrap()
            })
            .collect()
    };
    let turn =
        UnitQuaternion::from_rotation_matrix(&Rotation3::from_axis_angle(&Vector3::z_axis(), 0.7));
    let away = Vector3::new(4e4, -2e4, 300.0);
    let moved = move |p: &Put| Put { at: turn * p.at + away, turn: turn * p.turn, ..*p };
    let plain = ask(1.0, &|p| *p, 50.0);
    for other in [ask(1e3, &|p| *p, 50.0), ask(1.0, &moved, 50.0), ask(1.0, &|p| *p, 5e7)] {
        for (one, other) in plain.iter().zip(&other) {
            assert_eq!((one.verdict, one.by), (other.verdict, other.by));
            let ends = |p: &Pile| p.margin.map_or(0.0, |m| m.lower);
            assert!((ends(one) - ends(other)).abs() < 1e-8);
        }
    }
}

/// A slab far away that is a billion times as heavy, or as light, is a part of its own.
#[test]
fn what_lies_beside_changes_nothing() {
    let piles = boxes(&[[9.0, 9.0, 0.2], BRICK, [1.0, 1.0, 0.1]]);
    let mut random = Random(11);
    for chained in [false, true] {
        let mut list = stack(&mut random, 4);
        if chained {
            // A second brick beside the first one, and one across both.
            list = vec![put(0, [0.0, 0.0, -0.1])];
            let [length, _, height] = BRICK;
            let at = |x: f64, k: f64| [x * length, 0.0, (k + 0.5) * height];
            list.extend([(-0.6, 0.0), (0.6, 0.0), (0.1, 1.0)].map(|(x, k)| put(1, at(x, k))));
        }
        let alone = piles.ask(&list).unwrap();
        assert!(alone.margin.is_some() && (alone.by == Decided::Program) == chained, "{alone:?}");
        for mass in [1e-7, 1e11] {
            let slab = Put { mass: Some(mass), ..put(2, [3.5, 3.5, 0.05]) };
            let beside = piles.ask(&[&list[..], &[slab]].concat()).unwrap();
            assert_eq!((alone.verdict, alone.by), (beside.verdict, beside.by), "{mass}");
            let [one, other] = [&alone, &beside].map(|p| p.margin.unwrap());
            assert!(other.lower <= one.upper && one.lower <= other.upper, "{one:?} {other:?}");
        }
    }
}

#[test]
fn too_close_to_say_is_left_to_the_programs() {
    // The centre of the upper brick lies on the edge of the lower one, to the last digit or nearly.
    let piles = boxes(&[[9.0, 9.0, 0.2], [0.5, 0.5, 0.25]]);
    for (lean, by) in [(0.25, Decided::Program), (0.25 - 1e-6, Decided::Statics)] {
        let list =
            [put(0, [0.0, 0.0, -0.1]), put(1, [0.0, 0.0, 0.125]), put(1, [lean, 0.0, 0.375])];
        let answer = piles.ask(&list).unwrap();
        assert_eq!(answer.by, by);
        assert_eq!(answer.verdict, assessed(&piles.model(&list).unwrap()));
    }
}

#[test]
fn mistakes_are_named() {
    let one = r#"{ "id": "a", "support": true, "shape": { "box": { "size": [1, 1, 1] } } }, { "id": "b", "shape": { "box": { "size": [1, 1, 1] } } }"#;
    let shelf = piles(one, "");
    for (list, place) in [
        (put(2, [0.0; 3]), "put[0].shape"),
        (put(1, [0.0, f64::NAN, 0.0]), "put[0].pose"),
        (Put { mass: Some(0.0), ..put(1, [0.0; 3]) }, "put[0].mass"),
    ] {
        let error = shelf.ask(&[list]).unwrap_err();
        assert_eq!(error.path.to_string(), place);
        assert!(error.hint.is_some());
    }
    for rest in [
        r#", "loads": { "live": [ { "weight": [1, 0, 0] } ] }"#,
        r#", "loads": { "dead": [ { "block": "b", "force": [0, 0, -1] } ] }"#,
    ] {
        let text = format!(
            r#"{{ "format": "voussoir-scene/1", "joints": {{ "default": {{ "friction": 0.6 }} }}, "blocks": [ {one} ]{rest} }}"#
        );
        let error = Piles::new(&read_str("shapes", &text).unwrap().0).unwrap_err();
        assert_eq!(error.path.to_string(), "loads");
    }
}
