//! Large displacements with members: closed forms of blocks that ties hold, yield against and let
//! fall; arches whose tie takes its share of the thrust.

use crate::ask::{asked as followed, cuboid, fixed, ground, model, push, scene, template};
use serde_json::{Value, json};
use voussoir::{
    analysis::{ControlPoint, PushOptions, Question, SettleOptions, SupportMove, ask},
    proof::{
        ResultFile,
        path::{PathEventKind, PathPoint, PathResult, PathStatus},
    },
    scene::Scene,
    verdict::claim::Claim,
};

const NO_SLIDING: f64 = f64::INFINITY;

fn path(file: &ResultFile) -> &PathResult {
    file.path.as_ref().expect("a path")
}

fn to(support: &str, way: [f64; 3]) -> SupportMove {
    SupportMove::along(support, way)
}

fn close(value: f64, expected: f64, relative: f64) {
    let off = (value - expected).abs();
    assert!(off <= relative * expected.abs(), "{value} instead of {expected}");
}

fn at(file: &ResultFile, value: f64) -> &PathPoint {
    path(file).points.iter().find(|p| p.value == value).expect("asked for")
}

/// What the tie carries by the certificate of a point.
fn carried(point: &PathPoint) -> f64 {
    point.certificate.members.first().map_or(0.0, |m| m.force[0])
}

fn tie(from: Value, to: Value, strength: Value) -> Value {
    json!([{ "id": "tie", "tie": { "between": [from, to], "strength": strength } }])
}

/// A wall of 0.5 × 3 (depth `scale`, all lengths × `scale`, weights × `density`) that overturns
/// about its right edge while a tie at 2.5 yields on its left; and the load factor when it has
/// turned by `theta`, by moments about that edge.
fn wall(scale: f64, density: f64, at: [f64; 3]) -> (Scene, f64) {
    let size = [0.5 * scale, scale, 3.0 * scale];
    let weight = density * size[0] * size[1] * size[2];
    let strength = 0.2 * weight;
    let shift = |x: f64, z: f64| json!([at[0] + x * scale, at[1], at[2] + z * scale]);
    let mut more = push([1.0, 0.0, 0.0]);
    more["materials"] = json!({ "unit": { "density": density } });
    more["members"] = tie(
        json!({ "block": "wall", "at": shift(-0.5, 2.5) }),
        json!({ "ground": shift(-2.5, 2.5) }),
        json!(strength),
    );
    let foot = |z: f64| [at[0] - 0.25 * scale, at[1], at[2] + z * scale];
    let base = fixed(cuboid("base", [4.0 * scale, scale, scale], foot(-1.0)));
    (scene(NO_SLIDING, json!([base, cuboid("wall", size, foot(0.0))]), more), strength / weight)
}

fn overturning(theta: f64, tie: f64) -> (f64, f64) {
    let (sin, cos) = theta.sin_cos();
    let turned = |x: f64, z: f64| [cos * x + sin * z, -sin * x + cos * z];
    let [x, z] = turned(-0.25, 1.5);
    let [px, pz] = turned(-0.5, 2.5);
    let (ex, ez) = (-2.5 - px, 2.5 - pz);
    let moment = tie * (px * ez - pz * ex) / ex.hypot(ez);
    // Load factor, and the way of the centre of mass.
    ((moment - x) / z, x + 0.25)
}

#[test]
fn a_wall_overturns_against_a_tie_that_yields() {
    let turns = [0.02, 0.05, 0.1, 0.15];
    for (scale, density, at) in [
        (1.0, 1.0, [0.0; 3]),
        (1e-3, 1e3, [0.0; 3]),
        (1e3, 1e-3, [0.0; 3]),
        (1.0, 1.0, [1e3, -2e3, 50.0]),
    ] {
        let (scene, share) = wall(scale, density, at);
        let expected = turns.map(|theta| overturning(theta, share));
        let question = Question::Push(PushOptions {
            control: ControlPoint {
                block: "wall".into(),
                point: [at[0] - 0.25 * scale, at[1], at[2] + 1.5 * scale],
            },
            toward: [1.0, 0.0, 0.0],
            at: expected.map(|e| e.1 * scale).to_vec(),
            from: Vec::new(),
        });
        let file = followed(&scene, &question);
        close(path(&file).points[0].load_factor.unwrap(), overturning(0.0, share).0, 1e-8);
        for (load_factor, way) in expected {
            let point = self::at(&file, way * scale);
            close(point.load_factor.unwrap(), load_factor, 1e-7);
        }
        assert_eq!(file.answer.path().unwrap().status, PathStatus::Vanishes);
        // Straight ahead the load factor ends where moments balance without it.
        let (mut low, mut high) = (0.15_f64, 0.6_f64);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if overturning(middle, share).0 > 0.0 { low = middle } else { high = middle }
        }
        close(file.answer.path().unwrap().value.unwrap(), overturning(low, share).1 * scale, 1e-7);
    }
}

/// A block of 1 × 2 whose base moves away while a tie that never yields holds its left face at 1: it
/// tilts about the lower left edge, until its centre of mass stands above that edge.
#[test]
fn a_block_held_by_a_tie_tilts_as_its_base_moves_and_falls() {
    let blocks = json!([
        fixed(cuboid("base", [4.0, 1.0, 1.0], [0.5, 0.0, -1.0])),
        cuboid("block", [1.0, 1.0, 2.0], [0.5, 0.0, 0.0])
    ]);
    let (anchor, held): ([f64; 2], [f64; 2]) = ([-2.0, 0.5], [0.0, 1.0]);
    let members = tie(
        json!({ "block": "block", "at": [held[0], 0.0, held[1]] }),
        json!({ "ground": [anchor[0], 0.0, anchor[1]] }),
        json!("infinite"),
    );
    let scene = scene(NO_SLIDING, blocks, json!({ "members": members }));
    let length = (held[0] - anchor[0]).hypot(held[1] - anchor[1]);
    // The base has moved by s when the block has turned by θ: the tie keeps its length.
    let base = |theta: f64| {
        let [x, z] = [-theta.sin() * held[1], theta.cos() * held[1]];
        anchor[0] - x + (length * length - (z - anchor[1]).powi(2)).sqrt()
    };
    // Moments about the edge: tie against weight.
    let tension = |theta: f64| {
        let [x, z] = [-theta.sin() * held[1], theta.cos() * held[1]];
        let (ex, ez) = (anchor[0] - base(theta) - x, anchor[1] - z);
        2.0 * (0.5 * theta.cos() - theta.sin()) / ((x * ez - z * ex) / length)
    };
    let turns = [0.05_f64, 0.1, 0.2, 0.3];
    let falls = base(0.5_f64.atan());
    let ways: Vec<f64> = turns.iter().map(|&t| base(t)).collect();
    let moves = vec![to("base", [1.0, 0.0, 0.0])];
    let question =
        Question::Settle(SettleOptions { moves, at: ways.clone(), ..Default::default() });
    let file = followed(&scene, &question);
    for (theta, way) in turns.into_iter().zip(ways) {
        close(carried(at(&file, way)), tension(theta), 1e-7);
    }
    let said = file.answer.path().unwrap();
    assert_eq!(said.status, PathStatus::Falls, "{said:?}");
    close(said.value.unwrap(), falls, 1e-7);
    let [event] = &path(&file).events[..] else { panic!("{:?}", path(&file).events) };
    assert_eq!((event.kind, &event.yields[..]), (PathEventKind::Falls, &["tie".to_string()][..]));
    // What it carries is part of the proof.
    let members = |v: &mut Value, members: &dyn Fn(&Value) -> Value| {
        let own = &mut v["evidence"]["settle"]["points"][2]["certificate"]["members"];
        *own = members(own);
    };
    let edits: [crate::ask::Edit; 2] = [
        ("it carries more", &|v| {
            members(v, &|own| {
                let mut own = own.clone();
                own[0]["force"][0] = json!(own[0]["force"][0].as_f64().unwrap() * 1.01);
                own
            });
        }),
        ("it carries nothing", &|v| members(v, &|_| json!([]))),
    ];
    crate::ask::edits_are_refused(&scene, &file, &edits);
}

/// The arch of the reference values of spreading supports, with a tie across: the supports carry
/// the thrust of the three hinges less what the tie takes.
#[test]
fn a_tie_that_yields_takes_its_share_of_the_thrust_of_a_spreading_arch() {
    let arch =
        json!({ "radius": 1, "thickness": 0.15, "depth": 1, "voussoirs": 16, "embrace_deg": 180 });
    let inner = 0.925;
    let of = |strength: Value| {
        let members = tie(
            json!({ "block": "v00", "at": [-inner, 0.0, 0.0] }),
            json!({ "block": "v15", "at": [inner, 0.0, 0.0] }),
            strength,
        );
        template(NO_SLIDING, json!({ "arch": arch }), json!({ "members": members }))
    };
    let plain = template(NO_SLIDING, json!({ "arch": arch }), json!({}));
    let m = model(&plain);
    let weight: f64 = m.assembly.free().map(|i| m.assembly.weight(i)).sum();
    let strength = 0.02 * weight;
    let moves = vec![to("springer_left", [-1.0, 0.0, 0.0]), to("springer_right", [1.0, 0.0, 0.0])];
    let question = Question::Settle(SettleOptions {
        moves: moves.clone(),
        at: vec![0.01, 0.02, 0.03],
        ..Default::default()
    });
    let scene = of(json!(strength));
    let file = followed(&scene, &question);
    for (way, thrust) in
        [(0.0, 0.1765658973), (0.01, 0.1844655331), (0.02, 0.1930073919), (0.03, 0.2022936067)]
    {
        let point = at(&file, way);
        let right = point.reactions.iter().find(|r| r.support == "springer_right").unwrap();
        close(right.force[0] / weight, thrust - 0.02, 1e-8);
        close(carried(point), strength, 1e-8);
        assert_eq!(point.certificate.claim, Some(Claim::Stable));
    }
}

/// What a member does after large displacements is known of some kinds alone.
#[test]
fn members_that_are_not_followed_are_said() {
    let blocks = json!([ground(), cuboid("block", [1.0, 1.0, 2.0], [0.5, 0.0, 0.0])]);
    let grip = json!([{ "id": "finger", "grip": { "block": "block", "at": [0.0, 0.0, 1.0], "normal": [1, 0, 0], "friction": 0.5, "strength": 0.1 } }]);
    let scene = scene(NO_SLIDING, blocks, json!({ "members": grip }));
    let model = model(&scene);
    let question = Question::Settle(SettleOptions {
        moves: vec![to("ground", [0.01, 0.0, 0.0])],
        at: Vec::new(),
        ..Default::default()
    });
    let error = ask(&question, &scene, &model, &Default::default()).expect_err("refused");
    assert!(error.to_string().contains("not with a grip"), "{error}");
}
