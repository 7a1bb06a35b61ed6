//! Reading: what is refused and in which words; that writing and reading is the identity; that the
//! schema says what the reader does.

use super::*;
use base::error::{InputError, JsonPath};
use proptest::prelude::*;
use serde_json::{Value, json};

/// The error about a scene whose first line holds the format and whose second line is `rest`.
fn error(rest: &str) -> String {
    let text = format!("{{ \"format\": \"voussoir-scene/1\",\n{rest}");
    match read_str("s.json", text) {
        Ok(_) => "accepted".into(),
        Err(e) => e.to_string(),
    }
}

#[test]
fn wrong_text_is_refused_with_place_and_remedy() {
    let cases = [
        // not JSON
        (
            r#" "gravity": [0, 0"#,
            "s.json:2:18: gravity: the file ends in the middle of a value; hint: it is cut off, or a closing bracket or quote is missing",
        ),
        (
            r#" "name": "x"#,
            "s.json:2:12: name: the file ends in the middle of a value; hint: it is cut off, or a closing bracket or quote is missing",
        ),
        (
            r#" "gravity": [0, 0, NaN] }"#,
            "s.json:2:20: gravity[2]: must be a finite number; hint: JSON has no NaN or infinity: give a finite number",
        ),
        (
            r#" "gravity": [0, 0, -Infinity] }"#,
            "s.json:2:21: gravity[2]: must be a finite number; hint: JSON has no NaN or infinity: give a finite number",
        ),
        (
            r#" "gravity": [0, 0, .5] }"#,
            "s.json:2:20: gravity[2]: not JSON: expected a value; hint: write numbers like -0.5 or 1e-3",
        ),
        (
            r#" "gravity": [0, 0, 1,] }"#,
            "s.json:2:22: gravity: a comma before a closing bracket; hint: remove the comma",
        ),
        (
            r#" "gravity": [0 0 1] }"#,
            "s.json:2:16: gravity: not JSON: expected `,` or `]`; hint: a comma or a closing bracket is missing before this point",
        ),
        (
            r#" "name": 'x' }"#,
            "s.json:2:10: name: not JSON: expected a value; hint: write strings in double quotes",
        ),
        (
            "// a remark\n}",
            "s.json:2:1: not JSON: expected a key in double quotes; hint: JSON has no comments",
        ),
        (
            " \"name\": \"ä\", \"source\": \"a\nb\" }",
            "s.json:3:1: source: not JSON: a line break or control character inside a string; hint: close the quotes, or write \\n",
        ),
        (
            r#" "name": "ä" } x"#,
            "s.json:2:16: text after the end of the scene; hint: one file holds one scene: remove what follows its closing brace",
        ),
        // JSON, but out of range or of another type
        (
            r#" "gravity": [0, 0, 1e999] }"#,
            "s.json:2:20: gravity[2]: the number is too large for a 64-bit float; hint: numbers must be finite, at most 1.8e308",
        ),
        (
            r#" "gravity": [0, 0, "-9.81"] }"#,
            "s.json:2:20: gravity[2]: expected a number, got string \"-9.81\"; hint: write numbers without quotes",
        ),
        (
            r#" "gravity": [0, 0, null] }"#,
            "s.json:2:20: gravity[2]: expected a number, got null; hint: many programs write NaN and infinity as null: give a finite number",
        ),
        (r#" "gravity": [0, 0] }"#, "s.json:2:13: gravity: expected 3 elements, got 2"),
        (
            r#" "gravity": [0, 0, 1, 2] }"#,
            "s.json:2:13: gravity: too many elements: 4; hint: a point or vector has 3, a prism's corner 2, a pair 2",
        ),
        (r#" "blocks": {} }"#, "s.json:2:12: blocks: expected a list, got an object"),
        (r#" "blocks": [7] }"#, "s.json:2:13: blocks[0]: expected an object, got integer 7"),
        (r#" "materials": [] }"#, "s.json:2:15: materials: expected an object, got a list"),
        (
            r#" "loads": { "live": [ { "at": [1, 2] } ] } }"#,
            "s.json:2:31: loads.live[0].at: expected a point [x, y, z] or \"centroid\"",
        ),
        (
            r#" "joints": { "default": { "friction": "inf" } } }"#,
            "s.json:2:39: joints.default.friction: expected a coefficient of friction (a number >= 0) or \"infinite\", got string \"inf\"",
        ),
        // keys
        (
            r#" "blokcs": [] }"#,
            "s.json:2:2: blokcs: unknown key; hint: did you mean \"blocks\"? (or remove it)",
        ),
        (
            r#" "materials": { "a": { "density": 1, "colour": 2 } } }"#,
            "s.json:2:38: materials.a.colour: unknown key; hint: choose one of \"density\", \"young\", \"poisson\", \"action\" (or remove it)",
        ),
        (
            r#" "blocks": [ { "id": "a" } ] }"#,
            "s.json:2:14: blocks[0]: the key \"shape\" is missing; hint: add \"shape\": …",
        ),
        (
            r#" "name": "a", "name": "b" }"#,
            "s.json:2:15: name: the key is given twice; hint: keep one of them",
        ),
        (
            r#" "materials": { "a": { "density": 1 }, "a": { "density": 2 } } }"#,
            "s.json:2:40: materials.a: the name is given twice; hint: keep one of them",
        ),
        // kinds
        (
            r#" "blocks": [ { "id": "a", "shape": { "bix": {} } } ] }"#,
            "s.json:2:38: blocks[0].shape.bix: unknown kind \"bix\"; hint: did you mean \"box\"?",
        ),
        (
            r#" "blocks": [ { "id": "a", "shape": { "cylinder": { "radius": 1 } } } ] }"#,
            "s.json:2:38: blocks[0].shape.cylinder: unknown kind \"cylinder\"; hint: spheres are the only round shapes: use a \"prism\" or \"polyhedron\" with enough sides for a body on flat ends (it does not roll), or a \"clump\" of spheres for one that rolls",
        ),
        (
            r#" "blocks": [ { "id": "a", "box": { "size": [1, 1, 1] } } ] }"#,
            "s.json:2:27: blocks[0].box: unknown key; hint: write \"shape\": { \"box\": { … } }",
        ),
        (
            r#" "blocks": [ { "id": "a", "shape": "box" } ] }"#,
            "s.json:2:36: blocks[0].shape: \"box\" lacks its values; hint: write { \"box\": { … } }",
        ),
        (
            r#" "blocks": [ { "id": "a", "shape": { "sphere": { "radius": 1 }, "box": { "size": [1, 1, 1] } } } ] }"#,
            "s.json:2:36: blocks[0].shape: needs exactly one kind, got \"sphere\", \"box\"; hint: for example { \"box\": { \"size\": [1, 1, 1] } } for a shape",
        ),
        (
            r#" "blocks": [ { "id": "a", "shape": { "polyhedron": { "vertices": [], "faces": [[0, -1, 2]] } } } ] }"#,
            "s.json:2:84: blocks[0].shape.polyhedron.faces[0][1]: expected a whole number >= 0, got integer -1",
        ),
    ];
    for (rest, expected) in cases {
        assert_eq!(error(rest), expected, "for {rest}");
    }
}

#[test]
fn the_format_is_looked_at_first() {
    let error = |text: &str| read_str("s.json", text).unwrap_err().to_string();
    assert!(error("").starts_with("s.json:1:1: the file is empty"), "{}", error(""));
    assert!(error(" \n ").contains("the file is empty"));
    assert!(error("[1, 2]").starts_with("s.json:1:1: a scene is a JSON object, not a list"));
    assert!(
        error("{\"dtype\": \"Assembly\"}")
            .starts_with("s.json:1:1: not a scene: the key \"format\" is missing")
    );
    assert!(
        error("{\"x\": 1,\n \"format\": \"voussoir-scene/2\"}")
            .starts_with("s.json:2:12: format: unknown format \"voussoir-scene/2\"")
    );
    assert!(
        error("{\"format\": \"voussoir-result/1\"}")
            .ends_with("hint: `voussoir check` reads results")
    );
}

#[test]
fn bytes_that_are_no_utf8_are_refused_where_they_lie() {
    let error = |bytes: &[u8]| read_bytes("s.json", bytes.to_vec()).unwrap_err().to_string();
    assert_eq!(
        error(b"{\n \"name\": \"\xff\""),
        "s.json:2:11: the file is not text in UTF-8; hint: save it as UTF-8"
    );
    assert!(error(b"\xff\xfe{\0").contains("UTF-16"));
    let missing = read_file(std::path::Path::new("no-such-file.json")).unwrap_err();
    assert!(missing.to_string().starts_with("no-such-file.json: cannot be read: "), "{missing}");
}

#[test]
fn a_byte_order_mark_is_skipped() {
    let (scene, source) = read_str("s.json", "\u{feff}{\"format\": \"voussoir-scene/1\"}").unwrap();
    assert_eq!(scene, Scene::default());
    assert_eq!(source.locate(&JsonPath::root().key("format")), Some((1, 12)));
}

#[test]
fn deep_nesting_is_refused_without_overflow() {
    let open = "[".repeat(100_000);
    let close = "]".repeat(100_000);
    for text in [open.clone(), format!("{open}{close}"), "{\"a\":".repeat(100_000)] {
        assert!(!error(&format!("\"gravity\": {text} }}")).is_empty());
        let at = error(&format!("\"loads\": {{ \"live\": [ {{ \"at\": {text} }} ] }} }}"));
        assert!(at.contains("nested too deeply") && at.len() < 400, "{at}");
    }
}

#[test]
fn an_error_found_later_gets_the_place_of_its_path() {
    let text = "{ \"format\": \"voussoir-scene/1\",\n  \"blocks\": [\n    { \"id\": \"a\", \"shape\": { \"sphere\": { \"radius\": 1 } } } ] }";
    let (_, source) = read_str("s.json", text).unwrap();
    let block = JsonPath::root().key("blocks").index(0);
    let located =
        |path: &JsonPath| source.located(InputError::at(path.clone(), "wrong")).to_string();
    assert_eq!(
        located(&block.key("shape").key("sphere").key("radius")),
        "s.json:3:51: blocks[0].shape.sphere.radius: wrong"
    );
    // The file leaves the density out: the block stands for it.
    assert_eq!(located(&block.key("density")), "s.json:3:5: blocks[0].density: wrong");
    assert_eq!(located(&JsonPath::root().key("gravity")), "s.json:1:1: gravity: wrong");
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        any::<f64>().prop_filter("finite", |x| x.is_finite()),
        (-1000i32..1000).prop_map(f64::from),
        Just(0.1)
    ]
}

fn vector() -> impl Strategy<Value = [f64; 3]> {
    [number(), number(), number()]
}

fn name() -> impl Strategy<Value = String> {
    prop_oneof!["[a-z]{1,3}", any::<String>()]
}

fn shape() -> impl Strategy<Value = Shape> {
    let faces = prop::collection::vec(prop::collection::vec(any::<usize>(), 0..5), 0..4);
    prop_oneof![
        vector().prop_map(|size| Shape::Cuboid { size }),
        (prop::collection::vec(vector(), 0..5), faces)
            .prop_map(|(vertices, faces)| Shape::Polyhedron { vertices, faces }),
        (prop::collection::vec([number(), number()], 0..5), number())
            .prop_map(|(polygon, depth)| Shape::Prism { polygon, depth }),
        number().prop_map(|radius| Shape::Sphere { radius }),
        vector().prop_map(|normal| Shape::Plane { normal }),
        prop::collection::vec((vector(), number()), 0..4).prop_map(|list| Shape::Clump {
            spheres: list.into_iter().map(|(at, radius)| Ball { at, radius }).collect()
        }),
    ]
}

fn some<S: Strategy>(strategy: S) -> impl Strategy<Value = Option<S::Value>> {
    prop::option::of(strategy)
}

fn block() -> impl Strategy<Value = BlockSpec> {
    let rotation = some((vector(), number()).prop_map(|(axis, angle)| Rotation { axis, angle }));
    let mass = (some(name()), some(number()), some(number()), some(vector()));
    (name(), shape(), vector(), rotation, any::<bool>(), mass).prop_map(
        |(id, shape, at, rotation_deg, support, mass)| {
            let (material, density, mass, centroid) = mass;
            BlockSpec {
                at,
                rotation_deg,
                support,
                material,
                density,
                mass,
                centroid,
                ..BlockSpec::new(id, shape)
            }
        },
    )
}

fn friction() -> impl Strategy<Value = Friction> {
    prop_oneof![number().prop_map(Friction::Coefficient), Just(Friction::Infinite)]
}

fn pair() -> impl Strategy<Value = [String; 2]> {
    [name(), name()]
}

fn joints() -> impl Strategy<Value = Joints> {
    let strength = || {
        (
            some(friction()),
            [
                some(number()),
                some(number()),
                some(number()),
                some(number()),
                some(number()),
                some(number()),
                some(number()),
                some(number()),
            ],
        )
    };
    let spec = || {
        strength().prop_map(
            |(
                friction,
                [
                    friction_angle_deg,
                    cohesion,
                    tension,
                    compression,
                    pore_pressure,
                    rolling_arm,
                    normal_stiffness,
                    shear_stiffness,
                ],
            )| JointSpec {
                friction,
                friction_angle_deg,
                cohesion,
                tension,
                compression,
                pore_pressure,
                rolling_arm,
                normal_stiffness,
                shear_stiffness,
            },
        )
    };
    let rule =
        (some(pair()), some(pair()), spec()).prop_map(|(between, blocks, s)| JointOverride {
            between,
            blocks,
            friction: s.friction,
            friction_angle_deg: s.friction_angle_deg,
            cohesion: s.cohesion,
            tension: s.tension,
            compression: s.compression,
            pore_pressure: s.pore_pressure,
            rolling_arm: s.rolling_arm,
            normal_stiffness: s.normal_stiffness,
            shear_stiffness: s.shear_stiffness,
        });
    (spec(), prop::collection::vec(rule, 0..3))
        .prop_map(|(default, overrides)| Joints { default, overrides })
}

fn load() -> impl Strategy<Value = Load> {
    let at = some(prop_oneof![
        vector().prop_map(At::Point),
        Just(At::Centroid(load::Centroid::Centroid))
    ]);
    (
        some(name()),
        some(vector()),
        some(vector()),
        at,
        [any::<bool>(), any::<bool>()],
        some(vector()),
        some(vector()),
    )
        .prop_map(|(block, force, moment, at, [arm, massless], acceleration, weight)| Load {
            id: None,
            action: None,
            road: None,
            block,
            force,
            moment,
            at,
            arm,
            massless,
            acceleration,
            weight,
        })
}

fn scene() -> impl Strategy<Value = Scene> {
    let list = |n| 0..n;
    let interface =
        (pair(), prop::collection::vec(vector(), 0..5), some(vector()), some(friction())).prop_map(
            |(between, points, normal, friction)| InterfaceSpec {
                between,
                points,
                normal,
                friction,
            },
        );
    let mass =
        (name(), vector(), number()).prop_map(|(block, at, mass)| PushingMass { block, at, mass });
    let loads = (
        prop::collection::vec(load(), list(3)),
        prop::collection::vec(load(), list(3)),
        prop::collection::vec(mass, list(2)),
    )
        .prop_map(|(dead, live, masses)| Loads { dead, live, masses });
    let materials =
        prop::collection::btree_map(
            name(),
            (number(), some(number()), some(number())).prop_map(|(density, young, poisson)| {
                Material { density, young, poisson, action: None }
            }),
            list(3),
        );
    let contact =
        vector().prop_map(|[gap, angle_deg, min_area]| ContactSpec { gap, angle_deg, min_area });
    let parts = (
        prop::collection::vec(block(), list(4)),
        prop::collection::vec(interface, list(3)),
        loads,
        contact,
    );
    (name(), name(), vector(), materials, joints(), parts).prop_map(
        |(name, source, gravity, materials, joints, parts)| {
            let (blocks, interfaces, loads, contact) = parts;
            Scene {
                name,
                source,
                gravity,
                materials,
                joints,
                blocks,
                interfaces,
                loads,
                contact,
                ..Scene::default()
            }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn writing_and_reading_is_the_identity(scene in scene()) {
        let text = serde_json::to_string_pretty(&scene).unwrap();
        let (read, _) = read_str("s.json", text.as_str()).map_err(|e| TestCaseError::fail(e.to_string()))?;
        prop_assert_eq!(&read, &scene);
        let complaint = complaint(&schema(), &schema(), &serde_json::to_value(&scene).unwrap());
        prop_assert_eq!(complaint, None);
    }

    /// A scene cut off anywhere, or with one byte changed, is read or refused with a place; never a
    /// panic.
    #[test]
    fn broken_text_never_panics(scene in scene(), cut in any::<prop::sample::Index>(), byte in any::<u8>()) {
        let text = serde_json::to_string_pretty(&scene).unwrap().into_bytes();
        let at = cut.index(text.len());
        let error = read_bytes("s.json", text[..at].to_vec()).expect_err("a part of a scene is no scene");
        prop_assert!(error.position.is_some());
        let mut changed = text;
        changed[at] = byte;
        if let Err(error) = read_bytes("s.json", changed) {
            prop_assert!(error.position.is_some());
        }
    }
}

/// What is wrong with `value` by the parts of JSON Schema that decide about keys and types.
fn complaint(root: &Value, schema: &Value, value: &Value) -> Option<String> {
    if let Some(name) = schema["$ref"].as_str() {
        return complaint(
            root,
            root.pointer(name.trim_start_matches('#')).expect("the reference exists"),
            value,
        );
    }
    if let Some(constant) = schema.get("const") {
        return (constant != value).then(|| format!("{value} is not {constant}"));
    }
    if let Some(kinds) = schema.get("oneOf").or(schema.get("anyOf")).and_then(Value::as_array) {
        let complaints: Vec<_> = kinds.iter().map(|s| complaint(root, s, value)).collect();
        return if complaints.contains(&None) {
            None
        } else {
            Some(format!("{value} fits no kind: {complaints:?}"))
        };
    }
    let types: Vec<&str> = match &schema["type"] {
        Value::String(t) => vec![t],
        Value::Array(list) => list.iter().filter_map(Value::as_str).collect(),
        _ => vec![],
    };
    let fits = |t: &&str| match *t {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "number" => value.is_number(),
        "integer" => value.is_u64() || value.is_i64(),
        "boolean" => value.is_boolean(),
        "null" => value.is_null(),
        _ => false,
    };
    if !types.is_empty() && !types.iter().any(fits) {
        return Some(format!("{value} is no {types:?}"));
    }
    if let Some(list) = value.as_array() {
        let count = list.len() as u64;
        if schema["minItems"].as_u64().is_some_and(|n| count < n)
            || schema["maxItems"].as_u64().is_some_and(|n| count > n)
        {
            return Some(format!("{count} elements in {value}"));
        }
        return schema.get("items").and_then(|s| list.iter().find_map(|v| complaint(root, s, v)));
    }
    let map = value.as_object()?;
    for key in schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str) {
        if !map.contains_key(key) {
            return Some(format!("{key} is missing"));
        }
    }
    map.iter().find_map(|(key, inner)| match schema["properties"].get(key) {
        Some(s) => complaint(root, s, inner),
        None => match &schema["additionalProperties"] {
            Value::Bool(false) => Some(format!("{key} is unknown")),
            Value::Object(_) => complaint(root, &schema["additionalProperties"], inner),
            _ => None,
        },
    })
}

#[test]
fn the_schema_and_the_reader_agree() {
    let schema = schema();
    assert_eq!(schema["title"], "voussoir scene, version 1");
    assert!(schema.get("$id").is_none());
    let with = |patch: Value| {
        let mut scene = json!({ "format": "voussoir-scene/1" });
        scene.as_object_mut().unwrap().extend(patch.as_object().unwrap().clone());
        scene
    };
    let block = |patch: Value| {
        let mut block = json!({ "id": "a", "shape": { "box": { "size": [1, 1, 1] } } });
        block.as_object_mut().unwrap().extend(patch.as_object().unwrap().clone());
        with(json!({ "blocks": [block] }))
    };
    let good = [
        with(json!({})),
        block(
            json!({ "support": true, "at": [0, 0, 0.5], "rotation_deg": { "axis": [0, 0, 1], "angle": 30 }, "mass": 3 }),
        ),
        block(
            json!({ "shape": { "polyhedron": { "vertices": [[0, 0, 0]], "faces": [[0, 0, 0]] } } }),
        ),
        block(json!({ "shape": { "prism": { "polygon": [[0, 0], [1, 0], [1, 1]], "depth": 1 } } })),
        block(json!({ "shape": { "sphere": { "radius": 1 } } })),
        with(
            json!({ "materials": { "stone": { "density": 2400 } }, "joints": { "default": { "friction": "infinite" } } }),
        ),
        with(
            json!({ "joints": { "overrides": [{ "blocks": ["a", "b"], "friction_angle_deg": 30 }] } }),
        ),
        with(
            json!({ "joints": { "default": { "friction": 0.5, "cohesion": 1e5, "tension": 1e4, "compression": 5e6 },
            "overrides": [{ "blocks": ["a", "b"], "pore_pressure": 9810, "rolling_arm": 0.01 }] } }),
        ),
        with(
            json!({ "interfaces": [{ "between": ["a", "b"], "points": [[0, 0, 0]], "normal": [0, 0, 1], "friction": 0.5 }] }),
        ),
        with(
            json!({ "loads": { "live": [{ "block": "a", "force": [1, 0, 0], "at": "centroid" }, { "weight": [1, 0, 0] }] } }),
        ),
        with(json!({ "contact": { "gap": 1e-3 } })),
    ];
    let bad = [
        json!({}),
        json!({ "format": "voussoir-scene/2" }),
        with(json!({ "extra": 1 })),
        with(json!({ "gravity": [0, 0] })),
        block(json!({ "extra": 1 })),
        block(json!({ "id": 1 })),
        block(json!({ "shape": { "box": { "size": [1, 1, 1], "extra": 1 } } })),
        block(json!({ "shape": { "cube": {} } })),
        block(json!({ "shape": { "box": { "size": [1, 1, 1] }, "sphere": { "radius": 1 } } })),
        block(json!({ "rotation_deg": { "axis": [0, 0, 1] } })),
        with(json!({ "materials": { "stone": {} } })),
        with(json!({ "joints": { "default": { "mu": 0.5 } } })),
        with(json!({ "joints": { "default": { "friction": "high" } } })),
        with(json!({ "interfaces": [{ "between": ["a"], "points": [] }] })),
        with(json!({ "loads": { "live": [{ "at": "top" }] } })),
        with(json!({ "contact": { "extra": 1 } })),
        with(json!({ "templates": [{ "no_such_template": {} }] })),
    ];
    for (scenes, fine) in [(&good[..], true), (&bad[..], false)] {
        for scene in scenes {
            assert_eq!(
                complaint(&schema, &schema, scene).is_none(),
                fine,
                "schema: {scene} {:?}",
                complaint(&schema, &schema, scene)
            );
            assert_eq!(read_str("s.json", scene.to_string()).is_ok(), fine, "reader: {scene}");
        }
    }
}
