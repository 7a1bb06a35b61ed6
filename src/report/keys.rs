//! A schema as a page for people: a table of keys for every object, in the order in which a reader
//! meets them.

use serde_json::{Map, Value};
use std::{collections::VecDeque, fmt::Write};

type Definitions = Map<String, Value>;

/// The page (Markdown) of a JSON Schema with its definitions under `$defs`.
pub fn page(schema: &Value) -> String {
    let nothing = Map::new();
    let definitions = schema["$defs"].as_object().unwrap_or(&nothing);
    let mut text = String::new();
    let mut told: Vec<String> = Vec::new();
    section(&mut text, schema["title"].as_str().unwrap_or("Keys"), schema, definitions);
    let mut open: VecDeque<String> = named(schema).into();
    while let Some(name) = open.pop_front() {
        let Some(definition) = definitions.get(&name).filter(|_| !told.contains(&name)) else {
            continue;
        };
        section(&mut text, &name, definition, definitions);
        open.extend(named(definition));
        told.push(name);
    }
    text
}

/// The definitions that a schema names, in order; its own are none of them.
fn named(schema: &Value) -> Vec<String> {
    match schema {
        Value::Object(map) => {
            let own = map.get("$ref").and_then(Value::as_str).map(last).into_iter();
            own.chain(map.iter().filter(|(k, _)| *k != "$defs").flat_map(|(_, v)| named(v)))
                .collect()
        }
        Value::Array(list) => list.iter().flat_map(named).collect(),
        _ => Vec::new(),
    }
}

fn last(reference: &str) -> String {
    reference.rsplit('/').next().unwrap_or_default().to_owned()
}

fn section(text: &mut String, title: &str, schema: &Value, definitions: &Definitions) {
    // Writing into a string cannot fail.
    let _ = writeln!(text, "## {title}\n\n{}\n", described(schema));
    if let Some(keys) = schema["properties"].as_object() {
        table(text, keys, &required(schema), definitions);
    }
    let variants = ["oneOf", "anyOf"].iter().find_map(|k| schema[k].as_array());
    let Some(variants) = variants else { return };
    // A variant is a word, a value, or an object with one key that names it.
    let only_key = |v: &'_ Value| -> Option<(String, Value)> {
        let (key, of) = v["properties"].as_object()?.iter().next()?;
        Some((key.clone(), of.clone()))
    };
    let _ = writeln!(text, "| one of | what |\n|---|---|");
    for v in variants {
        let what = match only_key(v) {
            Some((key, of)) => match of.get("$ref").and_then(Value::as_str) {
                Some(reference) => format!("`\"{key}\"`: {}", link(&last(reference))),
                None => format!("`\"{key}\"`"),
            },
            None => kind(v, definitions),
        };
        let _ = writeln!(text, "| {what} | {} |", described(v));
    }
    text.push('\n');
    for (key, of) in variants.iter().filter_map(only_key) {
        if let Some(keys) = of["properties"].as_object() {
            let _ = writeln!(text, "### `{key}`\n");
            table(text, keys, &required(&of), definitions);
        }
    }
}

fn table(text: &mut String, keys: &Definitions, required: &[&str], definitions: &Definitions) {
    let _ = writeln!(text, "| key | is | default | what |\n|---|---|---|---|");
    for (key, of) in keys {
        let default = match of.get("default").filter(|d| !d.is_null()) {
            Some(default) => format!("`{default}`"),
            None if required.contains(&key.as_str()) => "required".into(),
            None => String::new(),
        };
        let _ = writeln!(
            text,
            "| `{key}` | {} | {default} | {} |",
            kind(of, definitions),
            described(of)
        );
    }
    text.push('\n');
}

fn required(schema: &Value) -> Vec<&str> {
    schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str).collect()
}

/// What it says of itself, on one line of a table.
fn described(schema: &Value) -> String {
    let text = schema["description"].as_str().unwrap_or_default();
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace('|', "\\|")
}

fn link(name: &str) -> String {
    format!("[{name}](#{})", name.to_lowercase())
}

/// The type of a value in words.
fn kind(schema: &Value, definitions: &Definitions) -> String {
    if let Some(reference) = schema["$ref"].as_str() {
        let name = last(reference);
        return if definitions.contains_key(&name) { link(&name) } else { name };
    }
    if let Some(word) = schema.get("const") {
        return format!("`{word}`");
    }
    for key in ["anyOf", "oneOf"] {
        if let Some(list) = schema[key].as_array() {
            let kinds: Vec<String> =
                list.iter().filter(|v| v["type"] != "null").map(|v| kind(v, definitions)).collect();
            return kinds.join(" or ");
        }
    }
    let types: Vec<&str> = match &schema["type"] {
        Value::String(one) => vec![one],
        Value::Array(list) => list.iter().filter_map(Value::as_str).collect(),
        _ => return "any value".into(),
    };
    let words = types.into_iter().filter(|t| *t != "null").map(|t| match t {
        "array" => {
            let of = kind(&schema["items"], definitions);
            match (schema["minItems"].as_u64(), schema["maxItems"].as_u64()) {
                (Some(least), Some(most)) if least == most => format!("{most} × {of}"),
                _ => format!("list of {of}"),
            }
        }
        "object" => match schema.get("additionalProperties").filter(|v| v.is_object()) {
            Some(of) => format!("by name: {}", kind(of, definitions)),
            None => "object".into(),
        },
        "boolean" => "true or false".into(),
        "string" => "text".into(),
        other => other.into(),
    });
    words.collect::<Vec<String>>().join(" or ")
}
