//! Other words and numbers beside the same evidence.

use super::{Forgery, Honest, edit::Draft};
use serde_json::{Value, json};

const VERDICTS: [&str; 3] = ["stable", "conditional", "unstable"];

/// False words and numbers, all evidence as it was.
pub(super) fn forge(honest: &Honest) -> Vec<Forgery> {
    let file = &honest.file;
    let mut made: Vec<Option<Forgery>> = Vec::new();
    let draft = || Draft::of(honest);
    made.push(draft().set("/scene/name", "Another scene").done(
        honest,
        "title",
        "the name of another scene",
    ));
    for key in ["blocks", "supports", "interfaces", "contact_points"] {
        let more = file["scene"][key].as_u64().unwrap_or(0) + 1;
        made.push(draft().set(&format!("/scene/{key}"), more).done(
            honest,
            "counts",
            format!("{more} {key}"),
        ));
    }
    match honest.name {
        "assess" => made.extend(verdicts(honest, "/answer", "/certificate")),
        "limit" => made.extend(verdicts(honest, "/dead_load/answer", "/dead_load/certificate")),
        "tilt" => made.extend(tilts(honest)),
        "thrust" => made.extend(thrusts(honest)),
        _ => made.extend(flips(honest)),
    }
    made.extend(mechanism(honest));
    made.extend(dry(honest));
    made.into_iter().flatten().collect()
}

/// Every other verdict: in the word, in the claim, in both.
fn verdicts(honest: &Honest, answer: &str, certificate: &str) -> Vec<Option<Forgery>> {
    let Some(true_word) = honest.file.pointer(&format!("{answer}/verdict")).and_then(Value::as_str)
    else {
        return Vec::new();
    };
    // An undecided one claims nothing; any other word is false only against a proof.
    if !VERDICTS.contains(&true_word) {
        return Vec::new();
    }
    let mut made = Vec::new();
    for word in VERDICTS.into_iter().filter(|w| *w != true_word) {
        let (said, claim) = (format!("{answer}/verdict"), format!("{certificate}/claim"));
        let what = format!("{word} instead of {true_word}");
        made.push(Draft::of(honest).set(&said, word).done(
            honest,
            "verdict",
            format!("{what}, the word"),
        ));
        made.push(Draft::of(honest).set(&claim, word).done(
            honest,
            "verdict",
            format!("{what}, the claim"),
        ));
        let both = Draft::of(honest).set(&said, word).set(&claim, word);
        made.push(both.clone().done(honest, "verdict", format!("{what}, word and claim")));
        made.push(both.without(&format!("{certificate}/base")).done(
            honest,
            "verdict",
            format!("{what}, without the base"),
        ));
    }
    let upper = honest
        .file
        .pointer(&format!("{answer}/unbalance/upper"))
        .and_then(Value::as_f64)
        .unwrap_or(0.0);
    let lower = honest
        .file
        .pointer(&format!("{answer}/unbalance/lower"))
        .and_then(Value::as_f64)
        .unwrap_or(0.0);
    for (low, high) in [(2.0 * upper + 0.01, 3.0 * upper + 0.02), (0.0, 0.5 * lower), (1e30, 1e300)]
    {
        // A bracket that leaves out the true one.
        if low > upper || (high < lower && lower > 1e-6) {
            let draft = Draft::of(honest)
                .set(&format!("{answer}/unbalance"), json!({ "lower": low, "upper": high }));
            made.push(draft.done(
                honest,
                "unbalance",
                format!("an unbalance of {low} to {high} instead of {lower} to {upper}"),
            ));
        }
    }
    made
}

/// Blocks that do not move, hinges elsewhere, other motions.
fn mechanism(honest: &Honest) -> Vec<Option<Forgery>> {
    let Some(said) = honest.file.get("mechanism").filter(|m| !m.is_null()) else {
        return Vec::new();
    };
    let draft = || Draft::of(honest);
    let done = |d: Draft, what: &str| d.done(honest, "mechanism", what);
    let moving: Vec<&str> =
        said["moving"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
    let resting =
        honest.model.assembly.blocks.iter().map(|b| b.id.as_str()).find(|id| !moving.contains(id));
    let mut made = Vec::new();
    if !moving.is_empty() {
        made.push(done(draft().set("/mechanism/moving", json!([])), "nothing moves"));
        made.push(done(draft().without("/mechanism/moving/0"), "a moving block is left out"));
    }
    if let Some(resting) = resting {
        made.push(done(
            draft().set("/mechanism/moving", json!([&moving[..], &[resting]].concat())),
            "a block that rests moves",
        ));
    }
    if let Some(joint) = said["joints"].get(0) {
        made.push(done(draft().without("/mechanism/joints/0"), "a moving joint is left out"));
        let motion = if joint["motion"] == "slide" { "hinge" } else { "slide" };
        made.push(done(
            draft().set("/mechanism/joints/0/motion", motion),
            "another motion of a joint",
        ));
        let far = joint["at"]
            .as_array()
            .map(|at| at.iter().map(|x| x.as_f64().unwrap_or(0.0) + 1e3).collect::<Vec<f64>>());
        made.push(done(
            draft().set("/mechanism/joints/0/at", json!(far)),
            "a hinge a kilometre away",
        ));
        made.push(done(
            draft().set("/mechanism/joints/0/at", json!([0.0, -0.0, 1e300])),
            "a hinge at the end of the world",
        ));
        made.push(done(
            draft().set("/mechanism/joints/0/between", json!(["nobody", "nobody"])),
            "a joint between others",
        ));
    }
    made
}

/// The words about dry friction.
fn dry(honest: &Honest) -> Vec<Option<Forgery>> {
    let Some(dry) = honest.file.get("dry").filter(|d| !d.is_null()) else { return Vec::new() };
    let Some(value) = dry["value"].as_f64().filter(|v| v.abs() > 1e-5) else { return Vec::new() };
    let said = dry["found"].as_str().unwrap_or_default();
    let mut made = Vec::new();
    // How it was found is what the reader takes the bound's place for.
    let other = if said == "nothing_slides" { "fixed_point" } else { "nothing_slides" };
    made.push(Draft::of(honest).set("/dry/found", other).done(
        honest,
        "dry word",
        format!("found: {other} instead of {said}"),
    ));
    let unlimited = Draft::of(honest).set("/dry/found", "unlimited");
    made.push(unlimited.clone().done(honest, "dry word", format!("unlimited instead of {value}")));
    let bare = Draft::of(honest).without("/dry/certificate/claim");
    // What needs a live load to stand is not at rest without.
    for word in if value > 0.0 { &["unlimited", "not_at_rest"][..] } else { &["unlimited"][..] } {
        let bare = bare.clone().set("/dry/found", *word).without("/dry/value");
        made.push(bare.done(
            honest,
            "dry, nothing claimed",
            format!("{word} instead of {value}, without a claim"),
        ));
    }
    for other in [0.5 * value, 2.0 * value] {
        let bare = bare
            .clone()
            .set("/dry/found", "rests")
            .set("/dry/value", other)
            .set("/dry/rests_at", other);
        made.push(bare.done(
            honest,
            "dry, nothing claimed",
            format!("rests up to {other} instead of {value}, without a claim"),
        ));
    }
    let bound =
        honest.file.pointer("/answer/load_factor/associative/value").and_then(Value::as_f64);
    if bound.is_some_and(|b| (b - value).abs() > 1e-3 * b.abs()) {
        let draft = Draft::of(honest).set("/answer/load_factor/value", bound);
        made.push(draft.done(
            honest,
            "law",
            format!("the bound {bound:?} is said to hold with dry friction, where it is {value}"),
        ));
    }
    made
}

/// Another direction governs, another angle.
fn tilts(honest: &Honest) -> Vec<Option<Forgery>> {
    let mut made = Vec::new();
    let draft = || Draft::of(honest);
    if let Some(angle) =
        honest.file["answer"]["tilt_deg"]["value"].as_f64().filter(|angle| *angle > 1e-3)
    {
        for by in [0.5, 0.999, 1.001, -1.0] {
            made.push(draft().set("/answer/tilt_deg/value", by * angle).done(
                honest,
                "tilt",
                format!("{by} × the angle"),
            ));
            let first = draft()
                .set("/answer/tilt_deg/value", by * angle)
                .set("/directions/0/answer/tilt_deg/value", by * angle);
            made.push(first.done(honest, "tilt", format!("{by} × the angle, twice")));
        }
    }
    let governing = |d: &Value| {
        if d.pointer("/dry/found").is_some_and(|found| found == "not_at_rest") {
            return f64::NEG_INFINITY;
        }
        let dry = d.pointer("/dry/value").and_then(Value::as_f64).map(|v| v.atan().to_degrees());
        dry.or(d.pointer("/answer/tilt_deg/associative/value").and_then(Value::as_f64))
            .unwrap_or(f64::NEG_INFINITY)
    };
    let list: Vec<&Value> = honest.file["directions"].as_array().into_iter().flatten().collect();
    let least = list.iter().map(|d| governing(d)).fold(f64::INFINITY, f64::min);
    for (k, direction) in list.iter().enumerate().filter(|(_, d)| governing(d) > least + 1e-3) {
        let mut other = draft()
            .set("/answer", direction["answer"].clone())
            .set("/certificate", direction["certificate"].clone());
        other = match direction.get("dry") {
            Some(dry) => other.set("/dry", dry.clone()),
            None => other.without("/dry"),
        };
        let what = format!("direction {k} governs, which tilts further");
        made.push(other.clone().without("/mechanism").done(honest, "direction", what.clone()));
        made.push(other.done(honest, "direction", what));
        let toward = direction["answer"]["toward"].clone();
        made.push(draft().set("/answer/toward", toward).done(
            honest,
            "direction",
            "the direction of another tilt",
        ));
    }
    made
}

/// Other thrusts, another factor, a line of thrust somewhere else.
fn thrusts(honest: &Honest) -> Vec<Option<Forgery>> {
    let mut made = Vec::new();
    let draft = || Draft::of(honest);
    let Some(said) = honest.file["answer"].get("thrust").filter(|t| !t.is_null()) else {
        return made;
    };
    if let Some(factor) = said["geometric_factor"]["value"].as_f64() {
        for value in [50.5, 0.9 * factor, 1.01 * factor] {
            let one = draft().set("/answer/thrust/geometric_factor/value", value);
            made.push(one.clone().done(
                honest,
                "geometric factor",
                format!("{value} instead of {factor}"),
            ));
            let all = one
                .set("/answer/thrust/geometric_factor/lower", 1.0)
                .set("/answer/thrust/geometric_factor/upper", 100.0);
            made.push(all.done(
                honest,
                "geometric factor",
                format!("{value} instead of {factor}, in a wide bracket"),
            ));
        }
    }
    let ends = [("least", "greatest"), ("greatest", "least")];
    for (one, other) in
        ends.into_iter().filter(|(a, b)| said[a]["status"] == "found" && said[a] != said[b])
    {
        let draft = draft().set(&format!("/answer/thrust/{one}"), said[other].clone());
        made.push(draft.done(honest, "thrust", format!("the {other} thrust as the {one}")));
    }
    let sections: Vec<&Value> =
        honest.file["thrust"]["sections"].as_array().into_iter().flatten().collect();
    let normal = |s: &Value, end: &str| s[end]["normal"].as_f64().unwrap_or(0.0).abs();
    let largest =
        sections.iter().map(|s| normal(s, "least").max(normal(s, "greatest"))).fold(0.0, f64::max);
    for end in ["least", "greatest"] {
        // One section that carries something.
        let Some((k, section)) =
            sections.iter().enumerate().find(|(_, s)| normal(s, end) > 0.1 * largest)
        else {
            continue;
        };
        let line = &section[end];
        let here = |key: &str| format!("/thrust/sections/{k}/{end}/{key}");
        let number = |key: &str| line[key].as_f64().unwrap_or(0.0);
        for key in ["inside", "in_kern"] {
            let other = !line[key].as_bool().unwrap_or(false);
            made.push(draft().set(&here(key), other).done(
                honest,
                "section",
                format!("{key}: {other}"),
            ));
        }
        for key in ["normal", "shear", "eccentricity", "used"] {
            let value = 2.0 * number(key)
                + 0.25 * if matches!(key, "normal" | "shear") { largest } else { 1.0 };
            made.push(draft().set(&here(key), value).done(
                honest,
                "section",
                format!("{key}: {value} instead of {}", number(key)),
            ));
        }
        made.push(draft().set(&here("at"), json!([1e3, 0.0, 0.0])).done(
            honest,
            "section",
            "the line of thrust a kilometre away",
        ));
        made.push(draft().without(&format!("/thrust/sections/{k}")).done(
            honest,
            "section",
            "a section is left out",
        ));
    }
    made
}

/// Flips somewhere else.
fn flips(honest: &Honest) -> Vec<Option<Forgery>> {
    let mut made = Vec::new();
    let draft = || Draft::of(honest);
    let Some(flip) = honest.file["answer"]["critical"].get(0) else { return made };
    let value = flip["value"].as_f64().unwrap_or(0.0);
    for to in [value * 1.001, value * 0.999, 1.2, 0.03] {
        // Outside of the true bracket, which is far narrower.
        if (to - value).abs() > 1e-4 * value.abs() {
            let one = draft().set("/answer/critical/0/value", to);
            made.push(one.clone().done(honest, "critical", format!("{to} instead of {value}")));
            let two = one.set("/critical/flips/0/value", to);
            made.push(two.clone().done(
                honest,
                "critical",
                format!("{to} instead of {value}, twice"),
            ));
            let wide =
                two.set("/answer/critical/0/lower", 0.02).set("/answer/critical/0/upper", 1.5);
            made.push(wide.clone().done(
                honest,
                "critical",
                format!("{to} in a wide bracket instead of {value}"),
            ));
            if let [low, high] = &honest.ends[..] {
                // With proofs: both ends are what they are said to be.
                let proved = wide
                    .set("/critical/flips/0/below", low.clone())
                    .set("/critical/flips/0/above", high.clone());
                made.push(proved.done(
                    honest,
                    "critical",
                    format!("{to} in a wide bracket that is proved, instead of {value}"),
                ));
            }
        }
    }
    let swapped = draft()
        .set("/answer/critical/0/below", flip["above"].clone())
        .set("/answer/critical/0/above", flip["below"].clone());
    made.push(swapped.done(honest, "critical", "the two verdicts changed places"));
    made.push(draft().set("/answer/critical", json!([])).done(honest, "critical", "no flip"));
    for (k, point) in honest.file["critical"]["scan"].as_array().into_iter().flatten().enumerate() {
        if let Some(word @ ("stable" | "unstable")) = point["verdict"].as_str() {
            let other = if word == "stable" { "unstable" } else { "stable" };
            made.push(draft().set(&format!("/critical/scan/{k}/verdict"), other).done(
                honest,
                "scan",
                format!("{other} instead of {word}"),
            ));
        }
    }
    let whole = !honest.file["critical"]["whole"].as_bool().unwrap_or(false);
    made.push(draft().set("/critical/whole", whole).done(
        honest,
        "scan",
        format!("whole: {whole}"),
    ));
    made.push(draft().set("/critical/between", json!([value, 1e6])).done(
        honest,
        "scan",
        "another range",
    ));
    made.push(draft().set("/critical/vary", "/gravity/2").done(
        honest,
        "scan",
        "another number varies",
    ));
    made
}
