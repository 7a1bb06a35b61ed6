//! What the targets have in common.

use libfuzzer_sys::Corpus;
use voussoir::{
    interface::{Model, prepare},
    scene::{Scene, read_bytes},
};

/// Scenes beyond this are not prepared: the fuzzer looks for mistakes, not for large inputs.
const MOST: u64 = 60;

/// Whether a scene is small enough to be prepared a million times: the counts of its templates
/// multiply.
pub fn is_small(scene: &Scene) -> bool {
    fn product(value: &serde_json::Value) -> u64 {
        match value {
            serde_json::Value::Number(n) => n.as_u64().unwrap_or(1).max(1),
            serde_json::Value::Array(list) => list.iter().map(product).fold(1, u64::saturating_mul),
            serde_json::Value::Object(map) => {
                map.values().map(product).fold(1, u64::saturating_mul)
            }
            _ => 1,
        }
    }
    let templates: u64 = scene
        .templates
        .iter()
        .map(|t| serde_json::to_value(t).map_or(u64::MAX, |v| product(&v)))
        .fold(0, u64::saturating_add);
    templates.saturating_add(scene.blocks.len() as u64) <= MOST
}

/// An error names a remedy or at least the place, in a text of reasonable length.
pub fn said(error: &voussoir::error::InputError) {
    let text = error.to_string();
    assert!(!error.message.is_empty() && text.len() < 20_000, "{text}");
}

/// A scene as read is what is written and read again; a small one is an error or a sound model.
pub fn scene(bytes: &[u8], and_prepare: bool) -> Corpus {
    match read_bytes("fuzzed", bytes.to_vec()) {
        Err(e) => said(&e),
        Ok((scene, source)) => {
            let text = voussoir::report::json::pretty(&scene).expect("a scene has a JSON form");
            let again = voussoir::scene::read_str("again", text).expect("what was written is read");
            assert!(again.0 == scene, "the scene changed on the way");
            if and_prepare && is_small(&scene) {
                match prepare(&scene) {
                    Err(e) => said(&source.located(e)),
                    Ok(model) => sound(&model),
                }
            }
        }
    }
    Corpus::Keep
}

/// What every model promises the stages after it.
pub fn sound(model: &Model) {
    let finite = |v: &nalgebra::Vector3<f64>| v.iter().all(|x| x.is_finite());
    for block in &model.assembly.blocks {
        assert!(
            block.mass > 0.0
                && block.mass.is_finite()
                && finite(&block.centroid)
                && block.size > 0.0
        );
        assert!(block.inertia.iter().all(|x| x.is_finite()));
    }
    for face in &model.interfaces.list {
        assert!(
            face.a != face.b
                && face.a < model.assembly.blocks.len()
                && face.b < model.assembly.blocks.len()
        );
        assert!(!face.points.is_empty() && face.points.iter().all(finite));
        assert!(face.area >= 0.0 && face.area.is_finite());
        let f = &face.frame;
        assert!(
            (f.n.norm() - 1.0).abs() < 1e-9 && (f.t1.cross(&f.t2) - f.n).norm() < 1e-9,
            "no right-handed frame: {f:?}"
        );
    }
    for finding in model.findings() {
        assert!(!finding.text.is_empty());
    }
}
