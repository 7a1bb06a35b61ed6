//! What depends on a number of a scene.

use serde_json::Value;

/// What changes with a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Touches {
    /// Joints, loads, gravity: blocks and contacts stay.
    Loads,
    /// Masses: contacts stay.
    Masses,
    /// Anything.
    Shapes,
}

impl Touches {
    /// What depends on the number to which these tokens of a JSON pointer lead. Where it is not
    /// sure, everything does; interfaces given by hand take their law from many places.
    pub fn of<T: AsRef<str>>(tokens: &[T], scene: &Value) -> Self {
        let given =
            scene.get("interfaces").and_then(Value::as_array).is_some_and(|list| !list.is_empty());
        let tokens: Vec<&str> = tokens.iter().map(AsRef::as_ref).collect();
        match tokens[..] {
            _ if given => Self::Shapes,
            ["joints" | "loads" | "gravity", ..] => Self::Loads,
            ["materials", _, "density"] | ["blocks", _, "density" | "mass"] => Self::Masses,
            _ => Self::Shapes,
        }
    }
}
