//! Scenes that are images of themselves: one part gives the answer of the whole, with a certificate
//! of the whole; what is not quite symmetric is solved whole.

use crate::ask::{self, close, cuboid, dry, fixed, ground, model, push, scene, sphere, template};
use serde_json::{Value, json};
use voussoir::{
    analysis::{
        Answer, Control, Law, Outcome, Question, TiltOptions, assess, coulomb, limit, tilt,
    },
    assembly::Wrench,
    program::{Statics, StaticsOptions},
    scene::Scene,
    verdict::Verdict,
};

fn keep_all() -> Control {
    Control { keep_all: true, ..Control::default() }
}

fn dome(thickness: f64, more: Value) -> Scene {
    template(
        0.7,
        json!({ "dome": { "radius": 2.0, "thickness": thickness, "rings": 4, "segments": 12 } }),
        more,
    )
}

fn arch(thickness: f64, voussoirs: usize) -> Scene {
    template(
        0.8,
        json!({ "arch": { "radius": 1.0, "thickness": thickness, "depth": 1.0, "voussoirs": voussoirs } }),
        json!({}),
    )
}

fn wall_pushed(direction: [f64; 3]) -> Scene {
    template(
        0.6,
        json!({ "wall": { "size": [1, 0.5, 0.4], "courses": 4, "blocks": 4, "first": "half", "base": "course" } }),
        push(direction),
    )
}

/// `n` cubes around the vertical on a table with `n` sides, which makes one part of them, each
/// turned by the same angle against its radius, so that there is no mirror; each is pushed along
/// its own face.
fn pinwheel(n: usize, mu: f64) -> Scene {
    let mut blocks = vec![ground()];
    let mut loads = Vec::new();
    for k in 0..n {
        let turn = std::f64::consts::TAU * k as f64 / n as f64;
        let mut block =
            cuboid(&format!("b{k}"), [1.0, 0.7, 0.5], [2.0 * turn.cos(), 2.0 * turn.sin(), 1.0]);
        block["rotation_deg"] = json!({ "axis": [0, 0, 1], "angle": turn.to_degrees() + 20.0 });
        blocks.push(block);
        let along = turn + 20f64.to_radians();
        loads.push(json!({ "block": format!("b{k}"), "force": [along.cos(), along.sin(), 0.0] }));
    }
    let corner = |k: usize| (std::f64::consts::TAU * k as f64 / n as f64).sin_cos();
    let mut table = ask::prism(
        "table",
        &(0..n).map(|k| [6.0 * corner(k).1, 6.0 * corner(k).0]).collect::<Vec<_>>(),
    );
    table["rotation_deg"] = json!({ "axis": [1, 0, 0], "angle": 90 });
    table["at"] = json!([0, 0, 0.5]);
    blocks.push(table);
    scene(mu, json!(blocks), json!({ "loads": { "live": loads } }))
}

fn pile(more: Value) -> Scene {
    let r = 2.0 / 3f64.sqrt();
    let at = |k: usize| {
        [
            r * (std::f64::consts::TAU * k as f64 / 3.0).cos(),
            r * (std::f64::consts::TAU * k as f64 / 3.0).sin(),
            1.0,
        ]
    };
    let top = sphere("top", 1.0, [0.0, 0.0, 1.0 + (4.0 - r * r).sqrt()]);
    scene(
        0.4,
        json!([
            ground(),
            sphere("a", 1.0, at(0)),
            sphere("b", 1.0, at(1)),
            sphere("c", 1.0, at(2)),
            top
        ]),
        more,
    )
}

/// A block between two posts, held by nothing but a squeeze.
fn squeezed() -> Scene {
    let bar = cuboid("bar", [1.0, 1.0, 1.0], [0.0, 0.0, 0.5]);
    let post = |id: &str, x: f64| fixed(cuboid(id, [1.0, 1.0, 2.0], [x, 0.0, 0.0]));
    scene(0.7, json!([post("left", -1.0), post("right", 1.0), bar]), json!({}))
}

fn line(left_out: &[String]) -> Option<&str> {
    left_out.iter().find(|l| l.starts_with("symmetry")).map(String::as_str)
}

#[test]
fn verdicts_of_the_part_are_those_of_the_whole() {
    let critical = 0.10707620314306167;
    let cases = [
        (
            "thick dome",
            dome(0.3, json!({})),
            Verdict::Stable,
            "12 equal parts around the vertical, each its own mirror image): 5 of 49",
        ),
        (
            "thin dome",
            dome(0.02, json!({})),
            Verdict::Unstable,
            "12 equal parts around the vertical, each its own mirror image): 5 of 49",
        ),
        (
            "arch with a keystone",
            arch(0.12, 27),
            Verdict::Stable,
            "mirror images of each other): 14 of 27",
        ),
        (
            "arch above its limit",
            arch(critical * (1.0 + 1e-6), 16),
            Verdict::Stable,
            "mirror images of each other): 8 of 16",
        ),
        (
            "arch below its limit",
            arch(critical * (1.0 - 1e-6), 16),
            Verdict::Unstable,
            "mirror images of each other): 8 of 16",
        ),
        (
            "wall",
            wall_pushed([0.0, 1.0, 0.0]),
            Verdict::Stable,
            "mirror images of each other): 10 of 18",
        ),
        (
            "spheres",
            pile(json!({})),
            Verdict::Stable,
            "3 equal parts around the vertical, each its own mirror image): 2 of 4",
        ),
        (
            "squeezed block",
            squeezed(),
            Verdict::Conditional,
            "mirror images of each other): 1 of 1",
        ),
    ];
    for (name, s, want, words) in cases {
        assert_eq!(ask::verdict(&s, Law::Coulomb), want, "{name}");
        let m = model(&s);
        let part = assess(&m, &Control::default());
        let whole = assess(&m, &keep_all());
        let line = line(&part.left_out).unwrap_or_else(|| panic!("{name}: {:?}", part.left_out));
        assert!(line.contains(words), "{name}: {line}");
        assert_eq!(part.verdict, whole.verdict, "{name}");
        assert!(
            (part.equilibrium_error.lower - whole.equilibrium_error.lower).abs() <= 1e-8,
            "{name}: {:?} {:?}",
            part.equilibrium_error,
            whole.equilibrium_error
        );
        assert!(part.attempts[0].size[0] < whole.attempts[0].size[0], "{name}");
        let acceleration = |a: &voussoir::analysis::Assessment| {
            a.state.as_ref().and_then(|s| s.steps.last()).map(|s| s.acceleration)
        };
        if want == Verdict::Conditional {
            close(
                name,
                acceleration(&part).expect("a state"),
                acceleration(&whole).expect("a state"),
                1e-3,
            );
        }
    }
}

/// Thousands of equal blocks far from the origin: their masses and moments, added up one by one,
/// once put the centre 1e-12 sizes off the mirror, and the scene was solved whole.
#[test]
fn many_blocks_far_away_are_halved() {
    let at = |k: usize| [8192.0 + (k % 60) as f64, 4096.0 + (k / 60) as f64, 0.5];
    let mut blocks = vec![fixed(cuboid("floor", [100.0, 100.0, 1.0], [8221.5, 4120.5, -0.5]))];
    blocks.extend((0..3000).map(|k| cuboid(&format!("b{k}"), [0.5, 0.5, 1.0], at(k))));
    let m = model(&scene(0.6, json!(blocks), push([1.0, 0.0, 0.0])));
    let statics = Statics::new(
        &m,
        StaticsOptions { live: true, symmetry: true, ..StaticsOptions::default() },
    );
    assert!(statics.is_part(), "{:?}", statics.left_out);
}

/// Ties from block to block around the third ring of a dome, from centre to centre.
fn hooped(thickness: f64, strength: Value, more: Value) -> Scene {
    let bare = model(&dome(thickness, json!({})));
    let at = |id: &str| {
        let block = bare.assembly.blocks.iter().find(|b| b.id == id);
        block.map(|b| [b.centroid.x, b.centroid.y, b.centroid.z])
    };
    let end = |k: usize| {
        let id = format!("r02_{:02}", k % 12);
        json!({ "block": id, "at": at(&id) })
    };
    let tie = |k: usize| {
        json!({ "id": format!("hoop_{k}"),
            "tie": { "between": [end(k), end(k + 1)], "strength": strength } })
    };
    let mut all = json!({ "members": (0..12).map(tie).collect::<Vec<_>>() });
    if let (Some(all), Some(more)) = (all.as_object_mut(), more.as_object()) {
        all.extend(more.clone());
    }
    dome(thickness, all)
}

/// An arch between two blocks of soil: pushed on either side towards the span.
fn between_soil(k: f64) -> Scene {
    let soil = |block: &str, x: f64| {
        json!({ "id": block, "soil": { "block": block, "face": "extrados",
            "direction": [x, 0, 0], "surface": 2.0, "unit_weight": 0.5, "k": k } })
    };
    let members = (0..4)
        .flat_map(|n| [soil(&format!("v{n:02}"), 1.0), soil(&format!("v{:02}", 15 - n), -1.0)]);
    template(
        0.8,
        json!({ "arch": { "radius": 1.0, "thickness": 0.1, "depth": 1.0, "voussoirs": 16 } }),
        json!({ "members": members.collect::<Vec<_>>() }),
    )
}

/// What a member takes in the part it takes in the whole: verdict and forces, whichever of its
/// images stood for it.
#[test]
fn members_stand_for_their_images() {
    let around = "12 equal parts around the vertical";
    let halves = "mirror images of each other";
    let prestressed = |strength: f64| {
        let mut scene = hooped(0.02, json!(strength), json!({}));
        for member in &mut scene.members {
            let mut value = serde_json::to_value(&*member).unwrap();
            value["tie"]["prestress"] = json!(0.3 * strength);
            *member = serde_json::from_value(value).unwrap();
        }
        scene
    };
    let cases = [
        ("hooped where no hoop is needed", hooped(0.3, json!(0.05), json!({})), around),
        ("hooped", hooped(0.02, json!("infinite"), json!({})), around),
        ("strong hoops", hooped(0.02, json!(1.0), json!({})), around),
        ("weak hoops", hooped(0.02, json!(1e-4), json!({})), around),
        ("prestressed hoops", prestressed(1.0), around),
        ("strong soil", between_soil(6.0), halves),
        ("weak soil", between_soil(0.01), halves),
    ];
    let (mut verdicts, mut rested) = (Vec::new(), 0);
    for (name, s, said) in cases {
        let m = model(&s);
        for law in [Law::Associative, Law::Coulomb] {
            let control = Control { law, ..Control::default() };
            let part = assess(&m, &control);
            let whole = assess(&m, &Control { keep_all: true, ..control });
            let line = line(&part.left_out);
            assert!(line.is_some_and(|l| l.contains(said)), "{name}: {:?}", part.left_out);
            assert_eq!(part.verdict, whole.verdict, "{name}, {law:?}");
            verdicts.push((name, part.verdict));
        }
        // The state on contacts that yield is one alone.
        let (part, whole) =
            (coulomb::state(&m, &Control::default()), coulomb::state(&m, &keep_all()));
        assert_eq!(part.motion, whole.motion, "{name}");
        if part.motion == coulomb::StateMotion::Rests {
            let joints = m.interfaces.list.len();
            let size = |w: &[Wrench]| w[0].force.norm();
            let most = part.forces[joints..].iter().map(|w| size(w)).fold(0.0, f64::max);
            for (a, b) in part.forces.iter().zip(&whole.forces).skip(joints) {
                let off = (a[0].force - b[0].force).norm();
                // The last ε yields by 1e-4, in space half as much as in a plane.
                assert!(off <= 3e-3 * most, "{name}: {a:?} {b:?}");
            }
            rested += 1;
        }
    }
    assert!(rested >= 3, "{rested}");
    // Both kinds of verdict were compared.
    for wanted in [Verdict::Stable, Verdict::Unstable] {
        assert!(verdicts.iter().any(|v| v.1 == wanted), "{verdicts:?}");
    }
    assert!(verdicts.contains(&("strong soil", Verdict::Stable)), "{verdicts:?}");
}

#[test]
fn load_factors_of_the_part_are_those_of_the_whole() {
    let spread: Vec<Value> = (0..12)
        .map(|k| {
            let a = std::f64::consts::TAU * (k as f64 + 0.5) / 12.0;
            json!({ "block": format!("r03_{k:02}"), "force": [a.cos(), a.sin(), 0.0] })
        })
        .collect();
    let cases = [
        ("dome spread at its top ring", dome(0.3, json!({ "loads": { "live": spread } }))),
        ("wall pushed out of its plane", wall_pushed([0.0, 1.0, 0.0])),
        ("wall pulled down and out", wall_pushed([0.0, 1.0, -0.3])),
        (
            "dome with hoops that yield, spread at its top ring",
            hooped(0.3, json!(0.05), json!({ "loads": { "live": spread.clone() } })),
        ),
        ("spheres lifted", pile(push([0.0, 0.0, 1.0]))),
        ("pinwheel", pinwheel(5, 0.3)),
        ("arch lifted", {
            let mut s = arch(0.15, 9);
            s.loads.live = serde_json::from_value(json!([{ "block": "v04", "force": [0, 0, -1] }]))
                .expect("a load");
            s
        }),
    ];
    for (name, s) in cases {
        let m = model(&s);
        let part = limit(&m, &Control::default());
        let whole = limit(&m, &keep_all());
        assert!(line(&part.left_out).is_some(), "{name}: {:?}", part.left_out);
        assert_eq!((part.outcome, whole.outcome), (whole.outcome, part.outcome), "{name}");
        if part.outcome == Outcome::Found {
            close(name, part.value.unwrap(), whole.value.unwrap(), 1e-7);
            assert_eq!(Some(ask::load_factor(&s)), part.value, "{name}");
        }
    }
    // Each block slides along its own face: λ = μ × weight / force.
    close("pinwheel", ask::load_factor(&pinwheel(7, 0.3)), 0.3 * 0.35, 1e-8);
}

#[test]
fn dry_load_factors_of_the_part_are_those_of_the_whole() {
    let s = pinwheel(3, 0.3);
    close("pinwheel", dry(&s).0, 0.3 * 0.35, 1e-6);
    for (name, s) in [("pinwheel", s), ("wall pulled down and out", wall_pushed([0.0, 1.0, -0.3]))]
    {
        let m = model(&s);
        let value = |control: &Control| {
            let bound = limit(&m, control);
            coulomb::load_factor(&m, &bound, control)
        };
        let (part, whole) = (value(&Control::default()), value(&keep_all()));
        assert_eq!(part.found, whole.found, "{name}");
        close(name, part.value.unwrap(), whole.value.unwrap(), 1e-5);
    }
}

#[test]
fn scenes_that_are_not_quite_symmetric_are_solved_whole() {
    let whole = |name: &str, s: &Scene| {
        let m = model(s);
        let a = assess(&m, &Control { law: Law::Associative, ..Control::default() });
        assert_eq!(line(&a.left_out), None, "{name}");
    };
    let mut heavier = pinwheel(4, 0.3);
    heavier.blocks[2].density = Some(1.0 + 1e-6);
    heavier.blocks[2].material = None;
    whole("one block heavier by a millionth", &heavier);
    let mut moved = pinwheel(4, 0.3);
    moved.blocks[2].at[0] += 1e-6;
    whole("one block moved by a millionth", &moved);
    let mut rough = squeezed();
    rough.joints.overrides =
        serde_json::from_value(json!([{ "blocks": ["left", "bar"], "friction": 0.71 }]))
            .unwrap_or_else(|e| panic!("{e}"));
    whole("one joint rougher", &rough);
    let mut crushing = arch(0.2, 9);
    crushing.joints.default.compression = Some(1e6);
    whole("joints that crush", &crushing);
    let mut uneven = serde_json::to_value(hooped(0.3, json!(0.05), json!({})).members).unwrap();
    for (k, more) in [(5, 1e-6), (6, 2e-6), (8, 3e-6)] {
        uneven[k]["tie"]["strength"] = json!(0.05 * (1.0 + more));
    }
    whole("three hoops stronger by millionths", &dome(0.3, json!({ "members": uneven })));
    let dowel = json!({ "id": "d", "dowel": { "blocks": ["r00_00", "r01_00"], "strength": 1.0,
        "at": [1.9, 0.0, 0.5], "normal": [0.0, 0.0, 1.0] } });
    whole("a dowel", &dome(0.3, json!({ "members": [dowel] })));
    // A load across breaks the symmetry in `limit`, not in `assess`.
    let m = model(&wall_pushed([1.0, 0.0, 0.0]));
    assert_eq!(line(&limit(&m, &Control::default()).left_out), None);
    assert!(line(&assess(&m, &Control::default()).left_out).is_some());
}

/// A dome with twelve equal parts is its own image under a quarter of a turn and not under half of
/// one: of eight directions two are solved.
#[test]
fn directions_that_are_images_of_each_other_are_solved_once() {
    let carried =
        |left_out: &[String]| left_out.iter().any(|l| l.contains("by symmetry of the scene"));
    let question =
        |law| Question::Tilt(TiltOptions { law, all: Some(8), ..TiltOptions::default() });
    let tilts = |scene: &Scene, law, control: &Control| match voussoir::analysis::ask(
        &question(law),
        scene,
        &model(scene),
        control,
    )
    .unwrap()
    {
        Answer::Tilt(tilted) => tilted.directions,
        _ => panic!("not a tilt"),
    };
    let own = dome(0.3, json!({}));
    let whole = model(&own);
    let all = tilts(&own, Law::Associative, &Control::default());
    let solved: Vec<usize> = (0..8).filter(|&k| !carried(&all[k].load_factor.left_out)).collect();
    assert_eq!(solved, [0, 1]);
    for direction in &all {
        assert!(direction.load_factor.grade().is_some(), "{:?}", direction.toward);
        let alone = tilt(&whole, direction.toward, &Control::default()).unwrap();
        let (got, want) = (direction.load_factor.value.unwrap(), alone.load_factor.value.unwrap());
        close("the tangent of the tilt", got, want, 1e-6);
        let moving =
            |t: &voussoir::analysis::Tilt| t.load_factor.mechanism.as_ref().unwrap().moving.len();
        assert_eq!(moving(direction), moving(&alone));
    }
    ask::asked(&own, &question(Law::Associative));
    let kept = tilts(&own, Law::Associative, &keep_all());
    assert!(kept.iter().all(|d| !carried(&d.load_factor.left_out)));
}

/// The same with dry friction: two square blocks slide at their friction towards every side.
#[test]
fn images_of_a_direction_have_its_dry_value() {
    let blocks = json!([
        ground(),
        cuboid("low", [1.0, 1.0, 1.0], [0.0, 0.0, 0.0]),
        cuboid("high", [0.8, 0.8, 0.6], [0.0, 0.0, 1.0]),
    ]);
    let scene = scene(0.3, blocks, json!({}));
    let question = Question::Tilt(TiltOptions { all: Some(4), ..TiltOptions::default() });
    let model = model(&scene);
    let Answer::Tilt(tilted) =
        voussoir::analysis::ask(&question, &scene, &model, &Control::default()).unwrap()
    else {
        panic!("not a tilt")
    };
    assert!(tilted.directions[3].load_factor.attempts.is_empty());
    for direction in &tilted.directions {
        let dry = &direction.dry.as_ref().unwrap().load_factor;
        assert!(dry.claim().is_some());
        close("the tangent of the tilt", dry.value.unwrap(), 0.3, 1e-6);
    }
    ask::asked(&scene, &question);
}
