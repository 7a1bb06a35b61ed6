//! Bytes → sweep plan over a fixed scene → the scenes of its first rows.
#![no_main]
use libfuzzer_sys::fuzz_target;
use std::sync::LazyLock;
use voussoir::sweep::{Sweep, read_plan};

static SCENE: LazyLock<serde_json::Value> = LazyLock::new(|| {
    serde_json::json!({
        "format": "voussoir-scene/1", "materials": { "m": { "density": 2400 } }, "joints": { "default": { "friction": 0.6 } },
        "blocks": [
            { "id": "t", "shape": { "box": { "size": [4, 4, 1] } }, "at": [0, 0, -0.5], "support": true },
            { "id": "b", "shape": { "box": { "size": [0.4, 1, 1] } }, "at": [0, 0, 0.5], "material": "m" }
        ],
        "templates": [ { "arch": { "radius": 1, "thickness": 0.2, "depth": 1, "voussoirs": 7, "at": [9, 0, 0] } } ],
        "loads": { "live": [{ "weight": [1, 0, 0] }] }
    })
});

fuzz_target!(|bytes: &[u8]| {
    match read_plan("fuzzed", bytes.to_vec()) {
        Err(e) => voussoir_fuzz::said(&e),
        Ok((plan, source)) => match Sweep::new(plan, SCENE.clone()) {
            Err(e) => voussoir_fuzz::said(&source.located(e)),
            Ok(sweep) => {
                for row in [0, sweep.rows() / 2, sweep.rows().saturating_sub(1)] {
                    let parameters = sweep.parameters(row);
                    assert_eq!(parameters.len(), sweep.labels().len());
                    let _ = sweep.scene_with(&parameters).map_err(|e| voussoir_fuzz::said(&e));
                }
            }
        },
    }
});
