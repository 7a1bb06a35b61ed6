//! Edges and corners that meet edges and corners, joints that are open, blocks drawn twice, supports
//! that are sheets: what stands, what falls, and what is said to be open.

use crate::ask::{check, cuboid, fixed, prism, scene};
use serde_json::{Value, json};
use voussoir::{
    analysis::{
        Answer, AssessOptions, Control, DoubtCause, Law, LimitOptions, Outcome, Question, ask,
        assess, critical, critical::Range, doubt,
    },
    error::FindingCode,
    interface::{Model, prepare},
    proof::{ResultFile, saved},
    scene::Scene,
    verdict::{
        Evidence, Verdict,
        claim::{self, Claim},
        no_forces,
    },
};

/// A plank of unit depth from its foot at `-reach` to a ridge at height 1; the other way round on the
/// right.
fn plank(id: &str, reach: f64, thickness: f64, side: f64) -> Value {
    let length = reach.hypot(1.0);
    let out = [-thickness / length, thickness * reach / length];
    let corners = [[-reach, 0.0], [0.0, 1.0], [out[0], 1.0 + out[1]], [out[0] - reach, out[1]]];
    prism(id, &corners.map(|[x, z]| [-side * x, z]))
}

/// Two planks that lean on each other edge to edge.
fn planks(friction: f64, [left, right]: [(f64, f64); 2], more: Value) -> Scene {
    let blocks = json!([
        fixed(cuboid("floor", [8.0, 2.0, 1.0], [0.0, 0.0, -1.0])),
        plank("left", left.0, left.1, -1.0),
        plank("right", right.0, right.1, 1.0),
    ]);
    scene(friction, blocks, more)
}

fn result(scene: &Scene, question: impl Into<Question>) -> ResultFile {
    let (question, model) = (question.into(), prepare(scene).unwrap());
    let answer = ask(&question, scene, &model, &Control::default()).unwrap();
    let file = saved::of_question(&question, scene, &model, &answer, &Control::default()).unwrap();
    // Whatever is undecided claims nothing; all that is claimed is proved.
    let found = check(scene, &file);
    assert!(!found.refuted() && (found.proved() || !found.claimed), "{found:?}");
    file
}

fn verdict(scene: &Scene) -> ResultFile {
    result(scene, AssessOptions { law: Law::Coulomb })
}

fn says(model: &Model, code: FindingCode) -> Vec<String> {
    model.findings().filter(|f| f.code == code).map(|f| f.text.clone()).collect()
}

#[test]
fn planks_edge_to_edge_stand_above_the_friction_that_balance_gives() {
    // Their ridge carries the moment of the weight about the foot.
    for (reach, thickness) in
        [(0.466_307_658_154_998_6, 0.022_067_582_558), (0.3, 0.1), (0.8, 0.01)]
    {
        let want = reach / 2.0 - thickness / f64::hypot(reach, 1.0) / 2.0;
        let scene = planks(0.3, [(reach, thickness); 2], json!({}));
        let range = Range {
            pointer: "/joints/default/friction".into(),
            from: want / 2.0,
            to: want * 2.0,
            scan: None,
        };
        let answer = critical(&scene, &range, &Control::default()).unwrap();
        let [flip] = &answer.changes[..] else { panic!("{:?}", answer.changes) };
        assert!((flip.value - want).abs() < 1e-7 * want, "{} not {want}", flip.value);
        let stands = verdict(&planks(want * 1.01, [(reach, thickness); 2], json!({})));
        assert_eq!(stands.answer.verdict(), Some(Verdict::Stable));
        assert_eq!(stands.flattened, [["left".to_string(), "right".into()]]);
        let falls = verdict(&planks(want * 0.99, [(reach, thickness); 2], json!({})));
        assert_eq!((falls.answer.verdict(), falls.flattened.len()), (Some(Verdict::Unstable), 0));
    }
}

#[test]
fn where_another_normal_may_hold_it_is_undecided_until_one_is_named() {
    let unlike = [(0.8, 0.05), (0.3, 0.05)];
    let open = planks(0.35, unlike, json!({}));
    let model = prepare(&open).unwrap();
    let question = AssessOptions { law: Law::Coulomb }.into();
    let answer = ask(&question, &open, &model, &Control::default()).unwrap();
    let Answer::Assess(a) = &answer else { panic!() };
    assert_eq!(a.verdict, Verdict::Undecided);
    let why = doubt(&answer, &model, &Control::default()).unwrap();
    assert!(
        why.cause == DoubtCause::Edges && why.evidence.contains("left meets one of right"),
        "{why:?}"
    );
    for (normal, want) in
        [([1.0, 0.0, 0.0], Verdict::Unstable), ([0.8, 0.0, -0.6], Verdict::Stable)]
    {
        let named = |between: [&str; 2], n: [f64; 3]| {
            let interface = json!({ "between": between, "normal": n });
            planks(0.35, unlike, json!({ "interfaces": [interface] }))
        };
        let back = normal.map(|c: f64| -c);
        for scene in [named(["left", "right"], normal), named(["right", "left"], back)] {
            let file = verdict(&scene);
            assert_eq!((file.answer.verdict(), file.flattened.len()), (Some(want), 0));
        }
        let wrong = prepare(&named(["left", "right"], back)).unwrap_err();
        assert!(wrong.to_string().contains("pushes one of them into"), "{wrong}");
    }
}

#[test]
fn a_load_factor_lies_between_the_flat_and_any_normal() {
    let pushed = json!({ "loads": { "live": [{ "weight": [1, 0, 0] }] } });
    let scene = planks(0.3, [(0.4, 0.02); 2], pushed);
    let file = result(&scene, LimitOptions::default());
    let bound = file.answer.bound().unwrap();
    assert_eq!(bound.status, Outcome::Undecided);
    let (lower, upper) = (bound.lower.unwrap(), bound.upper.unwrap());
    assert!(0.0 < lower && lower * 1.1 < upper, "{lower} {upper}");
}

#[test]
fn a_motion_that_closes_one_of_the_normals_proves_nothing() {
    let scene = planks(0.3, [(0.4, 0.02); 2], json!({}));
    let model = prepare(&scene).unwrap();
    let bare = model.without_flats().unwrap();
    let falls = assess(&bare, &Control::default());
    assert_eq!(falls.verdict, Verdict::Unstable);
    let proved = |model: &Model| {
        let none = no_forces(&model.interfaces);
        claim::verify(model, &Claim::Unstable, Evidence::new(&none, &falls.rates)).proved()
    };
    assert!(proved(&bare) && !proved(&model));
}

#[test]
fn answers_do_not_depend_on_units_mirrors_or_order() {
    let one = |size: f64, side: f64, turned: bool| {
        let scaled = |v: Value| -> Value {
            let corners = v["shape"]["prism"]["polygon"].as_array().unwrap().iter();
            let corners: Vec<[f64; 2]> = corners
                .map(|p| [p[0].as_f64().unwrap() * size * side, p[1].as_f64().unwrap() * size])
                .collect();
            let mut v = v;
            v["shape"]["prism"]["polygon"] = json!(corners);
            v["shape"]["prism"]["depth"] = json!(size);
            v
        };
        let floor = cuboid("floor", [8.0 * size, 2.0 * size, size], [0.0, 0.0, -size]);
        let mut blocks = vec![
            fixed(floor),
            scaled(plank("a", 0.8, 0.05, -1.0)),
            scaled(plank("b", 0.5, 0.05, 1.0)),
        ];
        if turned {
            blocks.reverse();
        }
        let push = json!({ "loads": { "live": [{ "weight": [side, 0, 0] }] } });
        let file = result(&scene(0.6, json!(blocks), push), LimitOptions::default());
        let bound = file.answer.bound().unwrap();
        (bound.status, bound.lower.unwrap_or(f64::NAN), bound.upper.unwrap_or(f64::NAN))
    };
    let want = one(1.0, 1.0, false);
    for (size, side, turned) in
        [(1.0, -1.0, false), (1.0, 1.0, true), (1e-3, 1.0, false), (1e3, -1.0, true)]
    {
        let got = one(size, side, turned);
        let near =
            |a: f64, b: f64| (a - b).abs() <= 1e-6 * (1.0 + a.abs()) || a.is_nan() && b.is_nan();
        assert!(got.0 == want.0 && near(got.1, want.1) && near(got.2, want.2), "{got:?} {want:?}");
    }
}

#[test]
fn a_foot_near_the_corner_of_slab_and_kerb_stands_as_in_it() {
    for dx in [0.0, 1e-6, 1e-5, 1e-4, 2e-4] {
        let strut = [[dx, 0.0], [0.2 + dx, 0.1], [2.0, 2.1], [2.0, 2.3]];
        let blocks = json!([
            fixed(cuboid("slab", [8.0, 2.0, 1.0], [1.0, 0.0, -1.0])),
            fixed(cuboid("kerb", [1.0, 2.0, 0.2], [-0.5, 0.0, 0.0])),
            fixed(cuboid("wall", [0.5, 2.0, 3.0], [2.25, 0.0, 1.0])),
            prism("strut", &strut),
        ]);
        let file = verdict(&scene(0.1, blocks, json!({})));
        assert_eq!(file.answer.verdict(), Some(Verdict::Stable), "{dx}");
        assert!(file.flattened.is_empty());
    }
}

#[test]
fn a_square_in_a_groove_touches_both_sides_of_it() {
    let blocks = json!([
        fixed(prism("groove", &[[-2.0, -1.0], [2.0, -1.0], [2.0, 0.5], [0.0, 0.0], [-2.0, 0.5]])),
        prism("square", &[[0.0, 0.0], [0.5, 0.5], [0.0, 1.0], [-0.5, 0.5]]),
        fixed(cuboid("left", [0.5, 2.0, 0.2], [-0.75, 0.0, 0.4])),
        fixed(cuboid("right", [0.5, 2.0, 0.2], [0.75, 0.0, 0.4])),
    ]);
    let scene = scene(0.5, blocks, json!({}));
    let model = prepare(&scene).unwrap();
    let on_groove = model.interfaces.list.iter().filter(|f| (f.a, f.b) == (0, 1));
    assert_eq!(on_groove.filter(|f| f.ways.is_empty()).count(), 2);
    assert_eq!(verdict(&scene).answer.verdict(), Some(Verdict::Stable));
}

#[test]
fn open_joints_and_blocks_drawn_twice_are_said() {
    let brick = |id: &str, z: f64| cuboid(id, [0.25, 0.1, 0.065], [0.0, 0.0, z]);
    let floor = || fixed(cuboid("floor", [2.0, 1.0, 0.1], [0.0, 0.0, -0.1]));
    for gap in [0.005, 0.01] {
        let blocks = json!([floor(), brick("low", gap), brick("high", 0.065 + 2.0 * gap)]);
        let mut open = scene(0.5, blocks, json!({}));
        let told = says(&prepare(&open).unwrap(), FindingCode::Unjoined);
        let text = told.first().unwrap_or_else(|| panic!("{gap}"));
        let remedy = text.split("\"gap\": ").nth(1).unwrap().split(' ').next().unwrap();
        open.contact.gap = remedy.parse().unwrap();
        let closed = prepare(&open).unwrap();
        assert!(says(&closed, FindingCode::Unjoined).is_empty());
        assert_eq!(closed.interfaces.list.len(), 2);
    }
    let blocks = json!([floor(), brick("low", 0.0), brick("again", 0.0), brick("far", 3.0)]);
    let twice = scene(0.5, blocks, json!({}));
    let model = prepare(&twice).unwrap();
    assert_eq!(says(&model, FindingCode::Twice).len(), 1);
    assert!(says(&model, FindingCode::Overlap).is_empty());
    assert!(verdict(&twice).left_out_contacts.is_none());
}

#[test]
fn what_falls_by_itself_falls_whatever_touches_elsewhere() {
    let blocks = json!([
        fixed(cuboid("floor", [4.0, 2.0, 1.0], [0.0, 0.0, -1.0])),
        cuboid("low", [1.0, 1.0, 1.0], [0.0, 0.0, 0.0]),
        cuboid("into", [1.0, 1.0, 1.0], [0.1, 0.0, 0.7]),
        cuboid("far", [1.0, 1.0, 1.0], [1.5, 0.0, 3.0]),
    ]);
    let file = verdict(&scene(0.5, blocks, json!({})));
    assert_eq!(file.answer.verdict(), Some(Verdict::Unstable));
}

#[test]
fn unstable_balance_is_said() {
    let floor = || fixed(cuboid("floor", [4.0, 2.0, 1.0], [0.0, 0.0, -1.0]));
    let wedge = prism("wedge", &[[0.0, 0.0], [0.5, 1.0], [-0.5, 1.0]]);
    let standing = verdict(&scene(0.5, json!([floor(), wedge]), json!({})));
    assert_eq!(
        (standing.answer.verdict(), &standing.in_balance[..]),
        (Some(Verdict::Stable), &["wedge".to_string()][..])
    );
    let brick = cuboid("brick", [1.0, 1.0, 1.0], [0.0, 0.0, 0.0]);
    assert!(verdict(&scene(0.5, json!([floor(), brick]), json!({}))).in_balance.is_empty());
}

#[test]
fn a_support_may_be_a_sheet() {
    let corners = json!([[-2, -2, 0], [2, -2, 0], [2, 2, 0], [-2, 2, 0]]);
    for (face, up) in [
        (json!([[0, 1, 2, 3]]), 1.0),
        (json!([[3, 2, 1, 0]]), 1.0),
        (json!([[0, 1, 2], [0, 2, 3]]), -1.0),
    ] {
        let sheet = fixed(
            json!({ "id": "ground", "shape": { "polyhedron": { "vertices": corners, "faces": face } } }),
        );
        let at = if up > 0.0 { 0.0 } else { -1.0 };
        let blocks = json!([sheet, cuboid("brick", [1.0, 1.0, 1.0], [0.0, 0.0, at])]);
        let scene = scene(0.5, blocks, json!({ "gravity": [0, 0, -up] }));
        let model = prepare(&scene).unwrap();
        assert_eq!(model.interfaces.list.len(), 1);
        assert_eq!(verdict(&scene).answer.verdict(), Some(Verdict::Stable));
        // A free block needs a volume all the same.
        let mut free = scene.clone();
        free.blocks[0].support = false;
        free.blocks[1].support = true;
        assert!(prepare(&free).unwrap_err().to_string().contains("flat"));
    }
}

#[test]
fn masses_that_the_engine_does_not_hold_are_said_before_it_runs() {
    let column = |density: f64| {
        let mut heavy = cuboid("heavy", [1.0, 1.0, 1.0], [0.0, 0.0, 1.0]);
        heavy["density"] = json!(density);
        let blocks = json!([
            fixed(cuboid("floor", [4.0, 2.0, 1.0], [0.0, 0.0, -1.0])),
            cuboid("light", [1.0, 1.0, 1.0], [0.0, 0.0, 0.0]),
            heavy,
        ]);
        prepare(&scene(0.5, blocks, json!({}))).unwrap()
    };
    assert!(voussoir::dynamics::beyond(&column(1e3)).is_none());
    let said = voussoir::dynamics::beyond(&column(1e6)).unwrap();
    assert!(said.text.contains("light and heavy") && said.text.contains("1e6"), "{}", said.text);
}
