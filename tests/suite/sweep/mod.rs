//! Sweeps: rows that depend on plan, scene and number alone, files that survive a kill, summaries
//! against hand counts.

mod both;
mod command;
mod plan;
mod rows;
mod shaken;
mod slurm;
mod summary;
mod worst;

use serde_json::{Value, json};
use voussoir::sweep::{Plan, Sweep};

/// A block on a table, pushed: λ = min(friction, width / height).
fn block() -> Value {
    json!({
        "format": "voussoir-scene/1",
        "materials": { "stone": { "density": 2400 }, "other": { "density": 2000 } },
        "joints": { "default": { "friction": 0.6 } },
        "blocks": [
            { "id": "table", "shape": { "box": { "size": [4, 4, 1] } }, "at": [0, 0, -0.5], "support": true },
            { "id": "block", "shape": { "box": { "size": [0.4, 1, 1] } }, "at": [0, 0, 0.5], "material": "stone" }
        ],
        "loads": { "live": [{ "weight": [1, 0, 0] }] }
    })
}

/// A small arch, pushed.
fn arch() -> Value {
    json!({
        "format": "voussoir-scene/1",
        "materials": { "stone": { "density": 2400 } },
        "joints": { "default": { "friction": 0.7 } },
        "templates": [{ "arch": { "radius": 1, "thickness": 0.2, "depth": 1, "voussoirs": 7, "material": "stone" } }],
        "loads": { "live": [{ "weight": [1, 0, 0] }] }
    })
}

fn plan(question: Value, vary: Value, sampling: Value) -> Plan {
    let plan = json!({ "format": "voussoir-sweep/1", "scene": "scene.json", "question": question, "vary": vary, "sampling": sampling, "seed": 5 });
    serde_json::from_value(plan).expect("a plan")
}

fn sweep(scene: Value, question: Value, vary: Value, sampling: Value) -> Sweep {
    Sweep::new(plan(question, vary, sampling), scene).unwrap_or_else(|e| panic!("{e}"))
}
