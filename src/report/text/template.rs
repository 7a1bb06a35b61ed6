//! The parameters of a template, as the schema of scenes words them.

use serde_json::Value;
use std::fmt::Write;

/// Lists deeper than this are not unfolded.
const DEPTH: usize = 2;

/// What a template is, and its parameters with units, alternatives and the values that `own` (the
/// template's own values, as [`scene::generate::default_template`] gives them) has.
pub fn template(name: &str, own: &Value) -> String {
    let schema = scene::schema();
    let kinds = schema["$defs"]["Template"]["oneOf"].as_array().into_iter().flatten();
    let kind = kinds
        .map(|kind| &kind["properties"][name])
        .find(|kind| !kind.is_null())
        .unwrap_or(&Value::Null);
    let kind = behind(&schema, kind);
    let mut text = format!(
        "{name}: {}\n\nParameters, as key=value; lengths in m, angles in degrees:\n\n",
        said(kind)
    );
    list(&mut text, &schema, kind, "", &own[name], DEPTH);
    text
}

fn list(text: &mut String, schema: &Value, kind: &Value, before: &str, own: &Value, depth: usize) {
    let needed = |key: &str| kind["required"].as_array().into_iter().flatten().any(|k| k == key);
    for (key, field) in kind["properties"].as_object().into_iter().flatten() {
        let value = match (&own[key.as_str()], needed(key)) {
            (Value::Null, false) => String::new(),
            (Value::Null, true) => " (needed)".to_string(),
            (value, _) => format!("={value}"),
        };
        // What holds the field, in a list or behind a choice of nothing.
        let inner = [field, &field["items"], &field["anyOf"][0]].map(|f| behind(schema, f));
        let named = [&field["$ref"], &field["items"]["$ref"], &field["anyOf"][0]["$ref"]]
            .iter()
            .any(|r| r.is_string());
        let own_words = said(field);
        let words = if own_words.is_empty() && named {
            inner.iter().map(|f| said(f)).find(|w| !w.is_empty()).unwrap_or_default()
        } else {
            own_words
        };
        // Writing into a string cannot fail.
        let _ = writeln!(text, "  {before}{key}{value}\n      {words}");
        for inner in inner {
            for choice in
                inner["oneOf"].as_array().into_iter().flatten().filter(|c| c["const"].is_string())
            {
                let _ = writeln!(
                    text,
                    "      {}: {}",
                    choice["const"].as_str().unwrap_or_default(),
                    said(choice)
                );
            }
            if depth > 1 && inner["properties"].is_object() {
                let place = if field["items"]["$ref"].is_string() {
                    format!("{before}{key}.0.")
                } else {
                    format!("{before}{key}.")
                };
                list(text, schema, inner, &place, &Value::Null, depth - 1);
            }
        }
    }
}

/// What a reference leads to; the value itself where it is none.
fn behind<'a>(schema: &'a Value, value: &'a Value) -> &'a Value {
    let name = value["$ref"].as_str().and_then(|r| r.strip_prefix("#/$defs/"));
    name.map_or(value, |name| &schema["$defs"][name])
}

/// The description of a schema on one line.
fn said(schema: &Value) -> String {
    schema["description"]
        .as_str()
        .unwrap_or_default()
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
}
