//! Answers are what the printed schemas say: every verb's result, and resolved scenes.

use serde_json::Value;
use std::process::Command;

fn run(args: &[&str]) -> Value {
    let done = Command::new(env!("CARGO_BIN_EXE_voussoir"))
        .args(args)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    serde_json::from_slice(&done.stdout)
        .unwrap_or_else(|e| panic!("{args:?}: {e}: {}", String::from_utf8_lossy(&done.stderr)))
}

/// Where a value is not what a schema says (draft 2020-12, the words that these schemas use).
fn wrong(schema: &Value, root: &Value, value: &Value, at: &str, out: &mut Vec<String>) {
    let Some(rules) = schema.as_object() else {
        if schema == &Value::Bool(false) {
            out.push(format!("{at}: nothing may stand here"));
        }
        return;
    };
    for (word, rule) in rules {
        match word.as_str() {
            "$ref" => {
                let target = rule.as_str().unwrap().trim_start_matches('#');
                wrong(
                    root.pointer(target).unwrap_or_else(|| panic!("{rule}")),
                    root,
                    value,
                    at,
                    out,
                );
            }
            "type" => {
                let is = |name: &str| match name {
                    "null" => value.is_null(),
                    "boolean" => value.is_boolean(),
                    "string" => value.is_string(),
                    "number" => value.is_number(),
                    "integer" => value.is_i64() || value.is_u64(),
                    "array" => value.is_array(),
                    "object" => value.is_object(),
                    other => panic!("{other}"),
                };
                let fits = rule.as_str().map_or_else(
                    || rule.as_array().unwrap().iter().any(|r| is(r.as_str().unwrap())),
                    is,
                );
                if !fits {
                    out.push(format!("{at}: {value} is no {rule}"));
                }
            }
            "properties" => {
                for (key, rule) in rule.as_object().unwrap() {
                    value
                        .get(key)
                        .into_iter()
                        .for_each(|v| wrong(rule, root, v, &format!("{at}/{key}"), out));
                }
            }
            "required" => {
                let missing =
                    rule.as_array().unwrap().iter().filter(|key| {
                        value.is_object() && value.get(key.as_str().unwrap()).is_none()
                    });
                out.extend(missing.map(|key| format!("{at}: {key} is missing")));
            }
            "additionalProperties" => {
                let known =
                    |key: &String| rules.get("properties").is_some_and(|p| p.get(key).is_some());
                for (key, v) in
                    value.as_object().into_iter().flatten().filter(|(key, _)| !known(key))
                {
                    wrong(rule, root, v, &format!("{at}/{key}"), out);
                }
            }
            "items" => {
                for (k, v) in value.as_array().into_iter().flatten().enumerate() {
                    wrong(rule, root, v, &format!("{at}/{k}"), out);
                }
            }
            "minItems" | "maxItems" => {
                let (count, rule) =
                    (value.as_array().map(|a| a.len() as u64), rule.as_u64().unwrap());
                if count.is_some_and(|n| if word == "minItems" { n < rule } else { n > rule }) {
                    out.push(format!("{at}: {word} {rule}"));
                }
            }
            "minimum" | "maximum" => {
                let (v, rule) = (value.as_f64(), rule.as_f64().unwrap());
                if v.is_some_and(|v| if word == "minimum" { v < rule } else { v > rule }) {
                    out.push(format!("{at}: {word} {rule}"));
                }
            }
            "enum" if !rule.as_array().unwrap().contains(value) => {
                out.push(format!("{at}: {value} is none of {rule}"))
            }
            "const" if rule != value => out.push(format!("{at}: {value} is not {rule}")),
            "anyOf" | "oneOf" => {
                let each: Vec<Vec<String>> = rule
                    .as_array()
                    .unwrap()
                    .iter()
                    .map(|rule| {
                        let mut own = Vec::new();
                        wrong(rule, root, value, at, &mut own);
                        own
                    })
                    .collect();
                let fit = each.iter().filter(|own| own.is_empty()).count();
                if fit == 0 || (word == "oneOf" && fit > 1) {
                    out.push(format!(
                        "{at}: fits {fit} of {word}: {:?}",
                        each.into_iter().flatten().collect::<Vec<_>>()
                    ));
                }
            }
            "allOf" => {
                rule.as_array().unwrap().iter().for_each(|rule| wrong(rule, root, value, at, out))
            }
            "enum" | "const" | "$schema" | "$defs" | "title" | "description" | "default"
            | "format" | "examples" => {}
            other => panic!("this schema uses {other}, which is not checked here"),
        }
    }
}

#[track_caller]
fn fits(schema: &Value, value: &Value, what: &str) {
    let mut out = Vec::new();
    wrong(schema, schema, value, "", &mut out);
    assert!(out.is_empty(), "{what}: {out:#?}");
}

#[test]
fn every_verb_answers_as_the_schema_says() {
    let schema = run(&["schema", "result"]);
    let questions: [&[&str]; 26] = [
        &["assess", "structures/oppenheim-arch.json"],
        &["assess", "structures/semicircular-arch-thin.json", "--simulate"],
        &["assess", "structures/squeezed-block.json"],
        &["assess", "structures/floating-block.json"],
        &["limit", "structures/oppenheim-arch.json"],
        &["limit", "structures/block-in-groove.json"],
        &["limit", "structures/block-under-roof.json"],
        &["limit", "structures/oppenheim-arch.json", "--law", "associative", "--skip-dead"],
        &["tilt", "structures/column.json", "--all", "4"],
        &["tilt", "structures/oppenheim-arch.json", "--toward", "1,0,0", "--skip-dead"],
        &["thrust", "structures/oppenheim-arch.json"],
        &["thrust", "structures/tied-arch.json", "--member", "tie"],
        &["limit", "structures/tied-arch.json"],
        &["assess", "structures/grip-two-fingers.json"],
        &["simulate", "structures/grip-two-fingers.json", "--fast"],
        &["settle", "structures/spreading-arch.json", "--move", "springer_right=0.12,0,0"],
        &[
            "push",
            "structures/oppenheim-arch.json",
            "--control",
            "v02=-2.0972209616733786,0,10.543441764334727",
            "--toward",
            "1,0",
        ],
        &[
            "critical",
            "structures/semicircular-arch-thick.json",
            "--vary",
            "/templates/0/arch/thickness",
            "--between",
            "0.05",
            "0.3",
            "--scan",
            "4",
        ],
        &["simulate", "structures/column.json", "--fast", "--frames", "3"],
        &[
            "limit",
            "structures/bridge-single-axle.json",
            "--moving",
            "--law",
            "associative",
            "--skip-dead",
        ],
        &["kinematic", "structures/overturning-wall.json", "--all", "3"],
        &["kinematic", "structures/overturning-wall-with-tie.json", "--toward", "1,0"],
        &["stages", "structures/barrel-on-centring.json", "--toward", "1,0"],
        &["without", "structures/a-frame-stands.json"],
        &["stages", "structures/a-frame-stands.json", "--any-order"],
        &["state", "structures/block-on-bed.json"],
    ];
    for question in questions {
        let result = run(&[question, &["--json"]].concat());
        fits(&schema, &result, &question.join(" "));
        // A key that is not there yet is a mistake, not an extension.
        let mut other = result.clone();
        other["stand"] = true.into();
        let mut out = Vec::new();
        wrong(&schema, &schema, &other, "", &mut out);
        assert!(!out.is_empty(), "{question:?}");
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("rock.json");
    run(&[
        "kinematic",
        "structures/slender-block.json",
        "--ground",
        "structures/records/bursts.asc",
        "--json",
        "--save",
        path.to_str().expect("a path"),
    ]);
    let saved = std::fs::read_to_string(path).expect("saved");
    fits(&schema, &serde_json::from_str(&saved).expect("JSON"), "rock");
}

#[test]
fn resolved_scenes_are_what_the_schema_says() {
    let schema = run(&["schema", "model"]);
    for name in [
        "oppenheim-arch",
        "sphere-pile",
        "mortared-pier",
        "floating-block",
        "column-with-closed-gap",
        "tied-arch",
        "grip-three-fingers",
    ] {
        fits(&schema, &run(&["check", &format!("structures/{name}.json"), "--json"]), name);
    }
}
