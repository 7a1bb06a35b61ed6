//! The JSON Schema of the scene format, made from the types that read it.

use super::Scene;

/// The JSON Schema (draft 2020-12) of a scene file.
pub fn schema() -> serde_json::Value {
    let mut schema = schemars::schema_for!(Scene);
    schema.insert("title".into(), "voussoir scene, version 1".into());
    schema.to_value()
}
