//! Every reference case of `tests/cases/masonry_cases.json` that asks for an associative answer
//! or a verdict. Skipped, saying so, where that folder is absent; the transcribed cases in
//! `published.rs` always run.

use serde_json::{Value, json};
use voussoir::{
    analysis::{
        Control, Law, LoadFactor, Outcome, Proved, assess, limit,
        thrust::{Ends, answer, outwards},
    },
    interface::{Model, prepare},
    scene::{Scene, read_str},
    verdict::{Verdict, claim::Findings, exact::Grade, thrust::ThrustAt},
};

/// Friction for "infinite (no sliding)".
fn friction(mu: f64) -> Value {
    if mu.is_infinite() { json!("infinite") } else { json!(mu) }
}

fn point(p: &Value) -> Value {
    match p.as_array().map(Vec::len) {
        Some(2) => json!([p[0], 0.0, p[1]]),
        _ => p.clone(),
    }
}

/// A case (or a variant of one) as a scene; `case` gives what the variant does not say.
pub fn scene(case: &Value, variant: &Value, mu: f64) -> Scene {
    let get = |key: &str| variant.get(key).or_else(|| case.get(key));
    let g = case["gravity"].as_f64().unwrap_or(1.0);
    let gravity = match case["query"].get("gravity_dir") {
        Some(d) => json!([g * d[0].as_f64().unwrap(), 0.0, g * d[1].as_f64().unwrap()]),
        None => json!([0.0, 0.0, -g]),
    };
    let mut blocks = Vec::new();
    for b in get("blocks").and_then(Value::as_array).into_iter().flatten() {
        let mut block = json!({
            "id": b["id"], "support": b["fixed"],
            "shape": { "prism": { "polygon": b["vertices"], "depth": 1.0 } },
        });
        if let Some(d) = b.get("density") {
            block["density"] = d.clone();
        }
        if let Some(w) = b.get("weight_override") {
            block["mass"] = json!(w.as_f64().unwrap() / g);
            block.as_object_mut().unwrap().remove("density");
        }
        if let Some(c) = b.get("centroid_override") {
            block["centroid"] = point(c);
        }
        blocks.push(block);
    }
    for b in get("blocks3d").and_then(Value::as_array).into_iter().flatten() {
        let at: Vec<f64> = (0..3)
            .map(|k| b["origin"][k].as_f64().unwrap() + b["size"][k].as_f64().unwrap() / 2.0)
            .collect();
        blocks.push(
            json!({ "id": b["id"], "support": b["fixed"], "density": b["density"], "at": at, "shape": { "box": { "size": b["size"] } } }),
        );
    }
    let mut value = json!({ "format": "voussoir-scene/1", "name": case["name"], "gravity": gravity, "blocks": blocks,
        "joints": { "default": { "friction": friction(mu) } } });
    for pair in case["mu"].get("pairs").and_then(Value::as_array).into_iter().flatten() {
        let overrides =
            value["joints"].as_object_mut().unwrap().entry("overrides").or_insert(json!([]));
        overrides
            .as_array_mut()
            .unwrap()
            .push(json!({ "blocks": [pair["i"], pair["j"]], "friction": pair["mu"] }));
    }
    if let Some(contacts) = get("explicit_contacts").and_then(Value::as_array) {
        let mut list = Vec::new();
        for c in contacts {
            for side in ["i", "j"] {
                if !value["blocks"].as_array().unwrap().iter().any(|b| b["id"] == c[side]) {
                    value["blocks"].as_array_mut().unwrap().push(json!({ "id": c[side], "support": true, "at": [0.0, 0.0, -1000.0], "shape": { "box": { "size": [1.0, 1.0, 1.0] } } }));
                }
            }
            let mut contact = json!({ "between": [c["i"], c["j"]], "points": [point(&c["point"])], "normal": point(&c["normal_from_i_to_j"]) });
            if let Some(mu) = c.get("mu").filter(|m| m.is_number()) {
                contact["friction"] = mu.clone();
            }
            list.push(contact);
        }
        value["interfaces"] = json!(list);
    }
    let query = &case["query"];
    if let Some(live) = query.get("live") {
        let load = match live["kind"].as_str().unwrap() {
            "body" => json!({ "weight": point(&live["dir"]) }),
            "point" => {
                json!({ "block": live["block"], "at": point(&live["at"]), "force": point(&live["force"]) })
            }
            "torque_z" => {
                json!({ "block": value["blocks"][live["block"].as_u64().unwrap() as usize]["id"], "moment": [0.0, 0.0, 1.0] })
            }
            other => panic!("{other}"),
        };
        value["loads"] = json!({ "live": [load] });
    }
    read_str("case", value.to_string()).unwrap_or_else(|e| panic!("{}: {e}", case["id"])).0
}

fn model(scene: &Scene) -> Model {
    prepare(scene).unwrap_or_else(|e| panic!("{}: {e}", scene.name))
}

/// How many answers are proved, and how many of them exactly.
#[derive(Default)]
struct Grades {
    all: usize,
    exact: usize,
}

impl Grades {
    fn add(&mut self, case: &Value, proof: &Findings) {
        self.all += 1;
        self.exact += usize::from(proof.grade == Grade::Exact);
        println!("{}: proved: {}, {}", case["id"], proof.proved(), proof.grade);
    }

    fn verdict(&mut self, case: &Value, variant: &Value, mu: f64) -> Verdict {
        let model = model(&scene(case, variant, mu));
        let a = assess(&model, &Control { law: Law::Associative, ..Control::default() });
        if a.claim().or(a.refused()).is_some() {
            self.add(case, a.findings());
        }
        a.verdict
    }

    fn limit(&mut self, case: &Value, model: &Model) -> Proved<LoadFactor> {
        let l = limit(model, &Control::default());
        if l.claim().or(l.refused()).is_some() {
            self.add(case, l.findings());
        }
        l
    }
}

pub fn mu_of(case: &Value) -> f64 {
    match &case["mu"] {
        Value::Number(n) => n.as_f64().unwrap(),
        Value::String(s) if s.starts_with("infinite") => f64::INFINITY,
        _ => 0.5,
    }
}

fn close(case: &Value, got: f64, want: f64, failures: &mut Vec<String>) {
    let e = &case["expected"];
    let tol = e["tol_rel"].as_f64().map_or(0.0, |t| t * want.abs())
        + e["tol_abs"].as_f64().unwrap_or(0.0);
    let ok = (got - want).abs() <= tol;
    println!(
        "{} {}: {got:.12} expected {want:.12} ({:.1e}, allowed {tol:.1e})",
        case["id"],
        if ok { "met" } else { "NOT MET" },
        (got - want).abs()
    );
    if !ok {
        failures.push(format!("{}: {got} expected {want}", case["id"]));
    }
}

/// The file of reference cases.
pub fn cases() -> Value {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cases/masonry_cases.json");
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

#[test]
fn masonry_cases() {
    let file = cases();
    let mut failures = Vec::new();
    let mut seen = 0;
    let mut grades = Grades::default();
    let expect = |grades: &mut Grades,
                  case: &Value,
                  variant: &Value,
                  mu: f64,
                  want: Verdict,
                  failures: &mut Vec<String>| {
        let got = grades.verdict(case, variant, mu);
        println!(
            "{} {}: {got:?} at mu {mu} {}",
            case["id"],
            if got == want { "met" } else { "NOT MET" },
            variant["label"]
        );
        if got != want {
            failures.push(format!("{}: {got:?} expected {want:?} (mu {mu})", case["id"]));
        }
    };
    for case in file["cases"].as_array().unwrap() {
        let (e, query) = (&case["expected"], &case["query"]);
        let mu = mu_of(case);
        if case.get("generator").is_some()
            && case.get("blocks").is_none()
            && case.get("variants").is_none()
            && case.get("blocks3d").is_none()
        {
            println!("{}: given by a generator only: see published.rs", case["id"]);
            continue;
        }
        seen += 1;
        match query["type"].as_str().unwrap() {
            "lambda_max" => {
                let m = model(&scene(case, case, mu));
                if let Some(word) = e["verdict"].as_str().filter(|w| w.starts_with("unstable")) {
                    expect(&mut grades, case, case, mu, Verdict::Unstable, &mut failures);
                    println!("   {word}; findings: {:?}", m.findings().collect::<Vec<_>>());
                    continue;
                }
                let l = grades.limit(case, &m);
                if e["static"] == "unbounded" {
                    println!("{}: {:?}", case["id"], l.outcome);
                    if l.outcome != Outcome::Unbounded {
                        failures
                            .push(format!("{}: {:?} expected unbounded", case["id"], l.outcome));
                    }
                    continue;
                }
                let want = ["value", "associative", "corner_model", "associative_plus_x"]
                    .iter()
                    .find_map(|k| e[*k].as_f64())
                    .unwrap();
                let value = l.value.unwrap_or(f64::NAN);
                // E11 gives torque / (μ W).
                let got =
                    if case["id"] == "E11" { value / (mu * m.assembly.weight(1)) } else { value };
                if l.found().is_none_or(|v| v < l.bracket.lower || v > l.bracket.upper) {
                    failures.push(format!("{}: {:?} {:?}", case["id"], l.outcome, l.bracket));
                    for a in &l.attempts {
                        println!("   {a:?}");
                    }
                }
                close(case, got, want, &mut failures);
            }
            "tilt_critical_deg" => {
                let mut c = case.clone();
                c["query"]["live"] = json!({ "kind": "body", "dir": [1, 0] });
                let m = model(&scene(&c, &c, mu));
                let l = grades.limit(case, &m);
                close(
                    case,
                    l.found().unwrap().atan().to_degrees(),
                    e["value"].as_f64().unwrap(),
                    &mut failures,
                );
            }
            "verdict_flip" => {
                for (k, variant) in case["variants"].as_array().into_iter().flatten().enumerate() {
                    println!(
                        "   variant {k}: {:?}",
                        variant
                            .as_object()
                            .unwrap()
                            .iter()
                            .filter(|(_, v)| !v.is_array())
                            .collect::<Vec<_>>()
                    );
                    let want = match variant
                        .get("expected")
                        .or_else(|| variant.get("verdict"))
                        .and_then(Value::as_str)
                    {
                        Some(w) if w.contains("unstable") || w.contains("infeasible") => {
                            Verdict::Unstable
                        }
                        Some(_) => Verdict::Stable,
                        None if k == 0 => Verdict::Stable,
                        None => Verdict::Unstable,
                    };
                    expect(&mut grades, case, variant, mu, want, &mut failures);
                }
            }
            "mu_min" => {
                let value = e["value"].as_f64().unwrap();
                let tol = e["tol_abs"].as_f64().unwrap();
                if !e["stable_with_mu"].is_null()
                    || case.get("blocks").is_some()
                    || case.get("explicit_contacts").is_some()
                {
                    expect(&mut grades, case, case, value + tol, Verdict::Stable, &mut failures);
                    expect(&mut grades, case, case, value - tol, Verdict::Unstable, &mut failures);
                }
            }
            "verdict" => match query.get("mu_list") {
                Some(list) => {
                    for mu in list.as_array().unwrap() {
                        expect(
                            &mut grades,
                            case,
                            case,
                            mu.as_f64().unwrap(),
                            Verdict::Stable,
                            &mut failures,
                        );
                    }
                }
                None if query.get("gravity_rotations").is_some() => {
                    expect(&mut grades, case, case, mu, Verdict::Stable, &mut failures);
                }
                None => expect(&mut grades, case, case, mu, Verdict::Unstable, &mut failures),
            },
            kind @ ("thrust_min" | "thrust_unique" | "thrust_range") => {
                let m = model(&scene(case, case, mu));
                let support = m.assembly.find(query["support"].as_str().unwrap()).unwrap();
                let direction = outwards(&m, support).unwrap().into();
                let t = answer(
                    &m,
                    ThrustAt { support, direction },
                    Ends::Both,
                    &Control { law: Law::Associative, ..Control::default() },
                );
                let [least, greatest] = [0, 1].map(|k| t.ends[k].value.unwrap_or(f64::NAN));
                close(
                    case,
                    least,
                    e["value"].as_f64().or(e["min"].as_f64()).unwrap(),
                    &mut failures,
                );
                match kind {
                    "thrust_unique" => {
                        close(case, greatest, e["value"].as_f64().unwrap(), &mut failures)
                    }
                    "thrust_range" => {
                        close(case, greatest, e["max"].as_f64().unwrap(), &mut failures)
                    }
                    _ => {}
                }
            }
            other => {
                println!("{}: query {other}: not asked here", case["id"]);
                seen -= 1;
            }
        }
    }
    println!(
        "{seen} cases asked, {} not met; {} of {} proofs exact",
        failures.len(),
        grades.exact,
        grades.all
    );
    assert!(failures.is_empty(), "{failures:#?}");
}
