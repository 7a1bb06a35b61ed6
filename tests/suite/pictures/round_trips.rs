//! Models of other programs come back by `import` as the same blocks with the same contacts.

use super::{arch, ball_on_box};
use crate::ask::{cuboid, ground, model, scene, template};
use serde_json::json;
use std::collections::BTreeMap;
use voussoir::{
    import::{ImportOptions, import_bytes},
    interface::Model,
    report::{
        gltf,
        models::{self, Program},
        view::View,
    },
    scene::{Friction, Scene},
};

/// Relative to volumes, areas and the size of the scene.
const SAME: f64 = 1e-9;

fn scenes() -> Vec<Scene> {
    let mut slick = cuboid("c", [0.7, 0.3, 0.4], [0.1, 0.0, 0.7]);
    slick["material"] = json!("slick");
    let mut heavy = scene(
        0.6,
        json!([ground(), cuboid("a <&' b", [1.0, 2.0, 0.5], [0.01, 0.2, 0.25]), slick]),
        json!({ "gravity": [0.1, 0.0, -9.0],
            "materials": { "unit": { "density": 1 }, "slick": { "density": 3 } },
            "joints": { "default": { "friction": 0.6 },
                "overrides": [{ "between": ["slick", "unit"], "friction": 0.3 }] } }),
    );
    let turned = json!({ "id": "turned", "shape": { "box": { "size": [0.2, 0.3, 0.4] } }, "at": [0.0, 0.0, 1.1],
        "rotation_deg": { "axis": [0, 0, 1], "angle": 33 }, "material": "slick", "mass": 7.0, "centroid": [0.01, 0.0, 0.02] });
    heavy.blocks.push(serde_json::from_value(turned).expect("a block"));
    let dome = json!({ "dome": { "radius": 5.0, "thickness": 0.5, "rings": 3, "segments": 8 } });
    let mut plumb = heavy.clone();
    plumb.gravity = [0.0, 0.0, -9.0];
    vec![
        plumb,
        arch(0.15, 3.0, json!({})),
        heavy,
        template(0.7, dome, json!({})),
        scene(
            0.5,
            json!([ground(), { "id": "ell", "shape": { "prism": {
                "polygon": [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]], "depth": 1.0 } }, "at": [0, 0, 0] }]),
            json!({}),
        ),
    ]
}

/// Volume, mass, whether it is held, centre of mass.
fn blocks(m: &Model) -> BTreeMap<String, ([f64; 2], bool, [f64; 3])> {
    let of = |b: &voussoir::assembly::Block| {
        (b.id.clone(), ([b.solid.volume(), b.mass], b.support, b.centroid.into()))
    };
    m.assembly.blocks.iter().map(of).collect()
}

/// Area that touches and friction of every pair.
fn contacts(m: &Model) -> BTreeMap<[String; 2], (f64, Option<f64>)> {
    let mut all = BTreeMap::new();
    for f in &m.interfaces.list {
        let mut pair = [f.a, f.b].map(|k| m.assembly.blocks[k].id.clone());
        pair.sort();
        let mu = match f.law.friction {
            Friction::Coefficient(mu) => Some(mu),
            Friction::Infinite => None,
        };
        let sum: &mut (f64, Option<f64>) = all.entry(pair).or_default();
        *sum = (sum.0 + f.area, mu);
    }
    all
}

fn compared(name: &str, before: &Scene, bytes: &[u8], has_friction: bool) {
    let options = ImportOptions {
        friction: (!has_friction).then_some(Friction::Coefficient(0.6)),
        ..ImportOptions::default()
    };
    let came = import_bytes(name, bytes, &options).unwrap_or_else(|e| panic!("{name}: {e}"));
    let (old, new) = (model(before), model(&came.scene));
    let gravity = (old.assembly.gravity - new.assembly.gravity).norm();
    assert!(gravity < 1e-12 || name.ends_with("dat"), "{name}: gravity {gravity}");
    let (a, b) = (blocks(&old), blocks(&new));
    assert_eq!(a.keys().collect::<Vec<_>>(), b.keys().collect::<Vec<_>>(), "{name}");
    for (id, one) in &a {
        let other = &b[id];
        let near = |x: f64, y: f64, size: f64| (x - y).abs() <= SAME * size;
        assert_eq!(one.1, other.1, "{name}: support of {id}");
        assert!(near(one.0[0], other.0[0], one.0[0]), "{name}: volume of {id}: {one:?} {other:?}");
        // Of what is held the mass is nobody's matter.
        assert!(
            one.1 || near(one.0[1], other.0[1], one.0[1]),
            "{name}: mass of {id}: {one:?} {other:?}"
        );
        let is_apart = (0..3).any(|k| !near(one.2[k], other.2[k], 10.0));
        // 3DEC has densities, and so no centres of mass apart from the shape.
        assert!(
            one.1 || !is_apart || name.ends_with("dat"),
            "{name}: centre of {id}: {one:?} {other:?}"
        );
    }
    let (a, b) = (contacts(&old), contacts(&new));
    assert_eq!(a.keys().collect::<Vec<_>>(), b.keys().collect::<Vec<_>>(), "{name}");
    for (pair, one) in &a {
        let other = &b[pair];
        assert!(
            (one.0 - other.0).abs() <= SAME * one.0.max(1.0),
            "{name} {pair:?}: {one:?} {other:?}"
        );
        if has_friction {
            assert_eq!(one.1, other.1, "{name} {pair:?}");
        }
    }
}

#[test]
fn models_come_back() {
    let mut all = scenes();
    all.push(ball_on_box());
    for (k, before) in all.iter().enumerate() {
        let view = View::bare(&model(before));
        // What is up in a scene is up in its glTF, which turns one whose gravity leans.
        if before.gravity[0] == 0.0 {
            compared(&format!("{k}.glb"), before, &gltf::binary(&view).unwrap(), false);
        }
        let file = models::model(&view, Program::Mujoco).unwrap();
        compared(&format!("{k}.xml"), before, file.text.as_bytes(), true);
        match models::model(&view, Program::ThreeDec) {
            Ok(file) => compared(&format!("{k}.3ddat"), before, file.text.as_bytes(), false),
            Err(e) => assert!(k == 5 && e.to_string().contains("MJCF"), "{k}: {e}"),
        }
    }
}

/// What a model has no place for is named.
#[test]
fn what_is_not_in_a_model_is_told() {
    let view = View::bare(&model(&arch(0.15, 3.0, json!({}))));
    let said = models::model(&view, Program::Mujoco).unwrap().notes.join("\n");
    assert!(said.contains("loads, left out: 1"), "{said}");
    let grain = cuboid("grain", [1e-5; 3], [0.0, 0.0, 5e-6]);
    let view = View::bare(&model(&scene(0.6, json!([ground(), grain]), json!({}))));
    let said = models::model(&view, Program::Mujoco).unwrap().notes.join("\n");
    assert!(said.contains("least that MuJoCo takes: 1"), "{said}");
    let view = View::bare(&model(&scenes()[4]));
    for (program, word) in [(Program::Mujoco, "convex hull"), (Program::ThreeDec, "joined")] {
        let said = models::model(&view, program).unwrap().notes.join("\n");
        assert!(said.contains("\"ell\"") && said.contains(word), "{said}");
    }
}

/// Bodies of shapes that touch, as robots and brick files have them, are blocks that can be asked about.
#[test]
fn shapes_of_one_body_may_touch() {
    let geom = |at: f64, high: f64| {
        format!("<geom type='box' size='0.5 0.5 {high}' pos='0 {at} {high}' density='1000'/>")
    };
    let model_of = format!(
        "<mujoco><worldbody><geom name='floor' type='plane' size='5 5 1'/><body name='ell'><freejoint/>{}{}</body></worldbody></mujoco>",
        geom(0.0, 1.0),
        geom(1.0, 0.5)
    );
    let came = import_bytes("ell.xml", model_of.as_bytes(), &ImportOptions::default()).unwrap();
    let ell = model(&came.scene);
    let block = ell.assembly.blocks.iter().find(|b| b.id == "ell").unwrap();
    assert!((block.mass / 3000.0 - 1.0).abs() < 1e-12, "{}", block.mass);
    assert!((block.solid.volume() / 3.0 - 1.0).abs() < 4e-6);
    let area: f64 = ell.interfaces.list.iter().map(|f| f.area).sum();
    assert!((area / 2.0 - 1.0).abs() < 1e-5, "{area}");
}
