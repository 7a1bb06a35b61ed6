//! The numbers of a scene that are assumed, not drawn: strengths, densities, loads and where they act.

use scene::Touches;
use serde_json::Value;

/// Numbers told at most. More: minutes for scenes whose blocks all have a density of their own.
pub const MOST: usize = 200;

/// A number of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    /// Its JSON pointer.
    pub pointer: String,
    /// The number.
    pub value: f64,
    /// Its unit; empty where it has none.
    pub unit: &'static str,
    /// Whether it is a coordinate, whose size says nothing.
    pub place: bool,
    /// The block that it belongs to, where one is named beside it.
    pub block: Option<String>,
    /// Whether less than zero of it means something.
    pub signed: bool,
    /// What depends on it.
    pub touches: Touches,
}

/// The numbers of a scene that were assumed, in the order of its keys.
pub fn numbers(scene: &Value) -> Vec<Number> {
    let mut found = Vec::new();
    let mut tokens = Vec::new();
    walk(scene, scene, (&mut tokens, None), &mut found);
    found
}

fn walk<'a>(
    scene: &Value,
    value: &'a Value,
    (tokens, block): (&mut Vec<String>, Option<&'a str>),
    found: &mut Vec<Number>,
) {
    match value {
        Value::Object(map) => {
            let block = map.get("block").and_then(Value::as_str).or(block);
            for (key, value) in map {
                // Shapes are drawn, and may hold very many numbers.
                if key != "shape" {
                    tokens.push(key.clone());
                    walk(scene, value, (tokens, block), found);
                    tokens.pop();
                }
            }
        }
        Value::Array(list) => {
            for (k, value) in list.iter().enumerate() {
                tokens.push(k.to_string());
                walk(scene, value, (tokens, block), found);
                tokens.pop();
            }
        }
        Value::Number(n) => {
            let words: Vec<&str> = tokens.iter().map(String::as_str).collect();
            let (Some(kind), Some(value)) = (kind(&words), n.as_f64()) else { return };
            // What is zero of a vector is no force.
            if value == 0.0 && kind.signed && !kind.place {
                return;
            }
            let pointer = tokens.iter().map(|t| t.replace('~', "~0").replace('/', "~1"));
            found.push(Number {
                pointer: pointer.fold(String::new(), |all, t| format!("{all}/{t}")),
                value,
                unit: kind.unit,
                place: kind.place,
                block: block.map(str::to_string),
                signed: kind.signed,
                touches: kind.touches.unwrap_or_else(|| Touches::of(tokens, scene)),
            });
        }
        _ => {}
    }
}

/// What a number is.
#[derive(Default)]
struct Kind {
    unit: &'static str,
    place: bool,
    signed: bool,
    /// What depends on it, where that is known to be less than it seems.
    touches: Option<Touches>,
}

/// What is assumed, by its place in the scene.
fn kind(tokens: &[&str]) -> Option<Kind> {
    let last = tokens.iter().rev().find(|t| t.parse::<usize>().is_err())?;
    let plain = |unit| Some(Kind { unit, ..Kind::default() });
    let place = Kind { unit: "m", place: true, signed: true, touches: None };
    // Of members and of what fills a bridge no contact depends.
    let among = |unit| Some(Kind { unit, touches: Some(Touches::Masses), ..Kind::default() });
    let signed = |unit| Some(Kind { unit, signed: true, ..Kind::default() });
    match (tokens.first()?, *last) {
        (&("joints" | "interfaces"), "friction") => plain(""),
        (&"joints", "friction_angle_deg") => plain("°"),
        (&"joints", "cohesion" | "tension" | "compression" | "pore_pressure") => plain("Pa"),
        (&"joints", "rolling_arm") => plain("m"),
        (&("materials" | "blocks"), "density") => plain("kg/m³"),
        (&("loads" | "blocks"), "mass") => plain("kg"),
        (&"loads", "force") => signed("N"),
        (&"loads", "moment") => signed("N·m"),
        (&"loads", "acceleration") => signed("m/s²"),
        (&"loads", "weight") => signed(""),
        (&"loads", "at" | "x") => Some(place),
        (&"loads", "patch" | "across") => plain("m"),
        (&"members", "strength" | "debonding") if tokens.contains(&"strip") => among("N/m"),
        (&"members", "strength" | "tension" | "compression") => among("N"),
        (&"members", "friction" | "k") => among(""),
        (&"members", "unit_weight") => among("N/m³"),
        (&"members", "at" | "ground" | "surface") => {
            Some(Kind { touches: Some(Touches::Masses), ..place })
        }
        (&"templates", "unit_weight") => among("N/m³"),
        (&"templates", "parapets") => among("N/m"),
        _ => None,
    }
}
