//! Asking questions in tests. Every answer is packed into a result, written, read back and proved
//! from the scene alone before its value is compared: an answer without a proof fails, whatever its
//! digits.

use serde_json::{Value, json};
use voussoir::{
    analysis::{
        Control, Law, Limited, LoadFactor, MovingOptions, Outcome, Proved, Question, Tilted,
        assess, coulomb, limit, tilt,
    },
    import::{Reach, read_meshes},
    interface::{Model, prepare},
    proof::{self, ResultFile, Saved, saved as packed, verify::Verified},
    report,
    scene::{Scene, read_file, read_str},
    verdict::Verdict,
};

/// A scene in units of its own (density 1 kg/m³, gravity 1 m/s²) with one friction; `more` adds or
/// replaces keys.
pub fn scene(friction: f64, blocks: Value, more: Value) -> Scene {
    let mut value = json!({
        "format": "voussoir-scene/1", "gravity": [0, 0, -1], "materials": { "unit": { "density": 1 } },
        "joints": { "default": { "friction": number_or_infinite(friction) } }, "blocks": blocks,
    });
    for (key, part) in more.as_object().expect("an object") {
        value[key] = part.clone();
    }
    for block in value["blocks"].as_array_mut().expect("a list") {
        if ["density", "mass", "material"].iter().all(|k| block.get(k).is_none()) {
            block["material"] = json!("unit");
        }
    }
    read(value)
}

/// A scene from a file, with the meshes it names.
pub fn open(path: &std::path::Path) -> Scene {
    let (mut scene, _) = read_file(path).unwrap_or_else(|e| panic!("{e}"));
    read_meshes(&mut scene, path.parent().expect("a folder"), Reach::Folder)
        .unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    scene
}

/// A scene from one template in units of its own.
pub fn template(friction: f64, template: Value, more: Value) -> Scene {
    let mut template = template;
    for parameters in template.as_object_mut().expect("an object").values_mut() {
        parameters["material"] = json!("unit");
    }
    let mut more = more;
    more["templates"] = json!([template]);
    scene(friction, json!([]), more)
}

fn read(value: Value) -> Scene {
    read_str("test", value.to_string()).unwrap_or_else(|e| panic!("{e}\n{value}")).0
}

fn number_or_infinite(friction: f64) -> Value {
    if friction.is_infinite() { json!("infinite") } else { json!(friction) }
}

/// A live load of each block's own weight along `direction`.
pub fn push(direction: [f64; 3]) -> Value {
    json!({ "loads": { "live": [{ "weight": direction }] } })
}

/// A box by its size and the centre of its bottom face.
pub fn cuboid(id: &str, size: [f64; 3], foot: [f64; 3]) -> Value {
    json!({ "id": id, "shape": { "box": { "size": size } }, "at": [foot[0], foot[1], foot[2] + size[2] / 2.0] })
}

/// A prism of depth 1.
pub fn prism(id: &str, polygon: &[[f64; 2]]) -> Value {
    json!({ "id": id, "shape": { "prism": { "polygon": polygon, "depth": 1.0 } } })
}

/// A sphere.
pub fn sphere(id: &str, radius: f64, at: [f64; 3]) -> Value {
    json!({ "id": id, "shape": { "sphere": { "radius": radius } }, "at": at })
}

/// The block as a support.
pub fn fixed(mut block: Value) -> Value {
    block["support"] = json!(true);
    block
}

/// A support with its top at z = 0.
pub fn ground() -> Value {
    fixed(cuboid("ground", [40.0, 40.0, 1.0], [0.0, 0.0, -1.0]))
}

/// Resolves and detects.
pub fn model(scene: &Scene) -> Model {
    prepare(scene).unwrap_or_else(|e| panic!("{}: {e}", scene.name))
}

/// Writes a result, reads it back and proves it from the scene alone.
pub fn prove(scene: &Scene, file: &ResultFile) {
    let found = check(scene, file);
    let fails: Vec<_> = found
        .parts
        .iter()
        .flat_map(|(part, f)| f.fails.iter().map(move |text| format!("{part}: {text}")))
        .collect();
    assert!(
        found.proved(),
        "{}: not proved: {fails:#?}\nwarnings {:#?}\ntrace {:#?}",
        scene.name,
        file.warnings().collect::<Vec<_>>(),
        file.run.trace
    );
}

/// A result as it is read from its file.
pub fn saved(file: &ResultFile) -> Saved {
    let text = report::json::pretty(file).expect("JSON");
    proof::read::read_str("result", text.as_str()).unwrap_or_else(|e| panic!("{e}"))
}

/// What the verification of a result on a scene finds, after a round through its file.
pub fn check(scene: &Scene, file: &ResultFile) -> Verified {
    proof::verify(&saved(file), scene).unwrap_or_else(|e| panic!("{}: {e}", scene.name))
}

/// Whether a result is still called proved after its file was edited.
pub fn survives(scene: &Scene, file: &ResultFile, edit: impl FnOnce(&mut Value)) -> bool {
    let honest = file.to_value().expect("JSON");
    let mut value = honest.clone();
    edit(&mut value);
    match proof::read::read_str("edited", value.to_string()) {
        Ok(read) => proof::verify(&read, scene).is_ok_and(|v| v.proved()),
        Err(_) => false,
    }
}

/// No leaf of what a result tells can be another: each is one that the comparison sees.
#[track_caller]
pub fn leaves_hold(file: &ResultFile) {
    let honest = file.to_value().expect("JSON")["answer"].take();
    let mut all = Vec::new();
    leaves(&honest, String::new(), &mut all);
    assert!(all.len() > 3);
    for pointer in all {
        let mut forged = honest.clone();
        let leaf = forged.pointer_mut(&pointer).expect("a leaf");
        *leaf = match &*leaf {
            Value::Number(n) => json!(10.0 * n.as_f64().expect("a number") + 1e-2),
            Value::String(s) => json!(format!("{s} ")),
            Value::Bool(b) => json!(!*b),
            _ => json!(1),
        };
        let seen = proof::compare::difference(&forged, &honest);
        assert_eq!(seen.as_deref(), Some(&pointer[..]));
    }
}

/// All leaves, of lists those of the first, a middle and the last item.
fn leaves(value: &Value, at: String, all: &mut Vec<String>) {
    match value {
        Value::Array(list) => {
            let mut picked = vec![0, list.len() / 2, list.len().saturating_sub(1)];
            picked.dedup();
            for k in picked.into_iter().filter(|k| *k < list.len()) {
                leaves(&list[k], format!("{at}/{k}"), all);
            }
        }
        Value::Object(map) => {
            map.iter().for_each(|(k, v)| leaves(v, format!("{at}/{k}"), all));
        }
        _ => all.push(at),
    }
}

/// What is edited, and how.
pub type Edit<'a> = (&'a str, &'a dyn Fn(&mut Value));

/// Edits of what a result follows from, with the answer that follows then: none is called proved.
#[track_caller]
pub fn edits_are_refused(scene: &Scene, file: &ResultFile, edits: &[Edit]) {
    for (what, edit) in edits {
        for consistent in [false, true] {
            let survives = survives(scene, file, |value| {
                let honest = value.clone();
                edit(value);
                assert_ne!(*value, honest, "{what} is no edit");
                if consistent {
                    told(value);
                }
            });
            assert!(!survives, "{what} is called proved");
        }
    }
}

/// Gives a file the answer that follows from the rest of it, as a forger who knows the program would.
pub fn told(value: &mut Value) {
    let Ok(saved) = proof::read::read_str("forged", value.to_string()) else { return };
    let model = model(&saved.scene);
    let evidence = (saved.evidence, saved.closed);
    let known = &proof::recompute::JustComputed;
    let derived =
        proof::derive::derive(saved.question, &saved.scene, &model, evidence, saved.run, known);
    if let Ok(derived) = derived {
        value["answer"] = derived.file.to_value().expect("JSON")["answer"].take();
    }
}

/// Asks a question; the answer as a file, proved from the scene alone.
pub fn asked(scene: &Scene, question: &Question) -> ResultFile {
    let model = model(scene);
    let answer = voussoir::analysis::ask(question, scene, &model, &Control::default());
    let file = packed::of(question, scene, &model, &answer.expect("an answer")).expect("a result");
    prove(scene, &file);
    file
}

/// The verdict by a law of sliding, with proof.
pub fn verdict(scene: &Scene, law: Law) -> Verdict {
    let model = model(scene);
    let answer = assess(&model, &Control { law, ..Control::default() });
    let steps = answer.state.as_ref().map(|s| &s.steps);
    assert_ne!(
        answer.verdict,
        Verdict::Undecided,
        "{}: {:?} {steps:?}",
        scene.name,
        answer.equilibrium_error
    );
    prove(scene, &packed::assessment(scene, &model, &answer).unwrap());
    answer.verdict
}

/// Are there admissible forces (associative law)? With proof.
pub fn stands(scene: &Scene) -> bool {
    verdict(scene, Law::Associative) == Verdict::Stable
}

/// The answer about the load factor, with proof.
fn answer(scene: &Scene) -> Proved<LoadFactor> {
    let model = model(scene);
    let limited = Limited { bound: limit(&model, &Control::default()), dry: None, dead: None };
    prove(scene, &packed::load_factor(scene, &model, &limited).unwrap());
    limited.bound
}

/// What becomes of the load factor, with its value where there is one, with proof.
pub fn outcome(scene: &Scene) -> (Outcome, Option<f64>) {
    let answer = answer(scene);
    (answer.outcome, answer.value)
}

/// The load factor, with proof.
pub fn load_factor(scene: &Scene) -> f64 {
    let (outcome, value) = outcome(scene);
    assert_eq!(outcome, Outcome::Found, "{}", scene.name);
    value.expect("a value")
}

/// The least load factor of the train, with proof of every position.
pub fn moving(scene: &Scene) -> f64 {
    let options = MovingOptions { law: Law::Associative, ..MovingOptions::default() };
    let model = model(scene);
    let question = Question::Moving(options);
    let answer = voussoir::analysis::ask(&question, scene, &model, &Control::default());
    let file = packed::of(&question, scene, &model, &answer.expect("an answer")).expect("a result");
    prove(scene, &file);
    file.answer.load_factor().and_then(|l| l.value).expect("a load factor")
}

/// The load factor is `want` within a relative tolerance, and its proved bracket contains `want` up
/// to `rounding` (relative: the digits of `want`, or of the coordinates).
#[track_caller]
pub fn bracketed(what: &str, scene: &Scene, want: f64, tolerance: f64, rounding: f64) {
    let answer = answer(scene);
    let LoadFactor { outcome, value, bracket, .. } = *answer;
    assert_eq!(outcome, Outcome::Found, "{what}");
    close(what, value.expect("a value"), want, tolerance);
    let slack = rounding * want.abs();
    assert!(
        bracket.lower - slack <= want && want <= bracket.upper + slack,
        "{what}: {want:.12} is outside [{:.12}, {:.12}] by more than {slack:.1e}",
        bracket.lower,
        bracket.upper
    );
}

/// The load factor is `want` within a relative tolerance, and its proved bracket contains `want` up
/// to 1e-10 of it.
#[track_caller]
pub fn exact(what: &str, scene: &Scene, want: f64, tolerance: f64) {
    bracketed(what, scene, want, tolerance, 1e-10);
}

/// The tilt in degrees towards a direction, 90 where it is wedged, with proof.
pub fn tilt_deg(scene: &Scene, toward: [f64; 3]) -> f64 {
    let model = model(scene);
    let answer = tilt(&model, toward.into(), &Control::default()).expect("a tilt");
    let angle = answer.angle_deg().expect("an angle");
    let tilted = Tilted { directions: vec![answer], level: None };
    prove(scene, &packed::tilt(scene, &model, &tilted).expect("a direction"));
    angle
}

/// The load factor with dry friction, the associative one (where there is a limit) and the number
/// of convex programs, with proof.
pub fn dry(scene: &Scene) -> (f64, Option<f64>, usize) {
    let model = model(scene);
    let l = limit(&model, &Control::default());
    let d = coulomb::load_factor(&model, &l, &Control::default());
    let limited = Limited { bound: l.clone(), dry: Some(d.clone()), dead: None };
    let file = packed::load_factor(scene, &model, &limited).unwrap();
    prove(scene, &file);
    assert_eq!(
        file.dry.as_ref().and_then(|d| d.value),
        d.value,
        "{}: natural map {:.1e}",
        scene.name,
        d.natural_map
    );
    let value = d.value.unwrap_or_else(|| panic!("{}: {:?}", scene.name, d.found));
    assert!(
        l.value.is_none_or(|bound| value <= l.bracket.upper + 1e-6 * bound.abs()),
        "{}: {value} above {:?}",
        scene.name,
        l.value
    );
    (value, l.value, d.solves)
}

/// `got` is `want` within a relative tolerance.
#[track_caller]
pub fn close(what: &str, got: f64, want: f64, tolerance: f64) {
    let error = (got - want).abs();
    assert!(
        error <= tolerance * want.abs(),
        "{what}: {got:.12}, expected {want:.12}: off by {error:.1e}, allowed {:.1e}",
        tolerance * want.abs()
    );
    println!("{what}: {got:.12}, expected {want:.12}: off by {error:.1e}");
}

/// The verdict on the two sides of a critical value.
#[track_caller]
pub fn flips(what: &str, make: impl Fn(f64) -> Scene, stands_at: f64, falls_at: f64) {
    assert!(stands(&make(stands_at)), "{what}: must stand at {stands_at}");
    assert!(!stands(&make(falls_at)), "{what}: must fall at {falls_at}");
    println!("{what}: stands at {stands_at}, falls at {falls_at}");
}
