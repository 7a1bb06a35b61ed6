//! A number of a scene by its JSON pointer (RFC 6901), such as `/templates/0/arch/thickness`.

use super::{Scene, read_str};
use base::error::{InputError, JsonPath};
use serde_json::{Map, Number, Value, json};

impl Scene {
    /// The scene as a JSON value. Written here once, so that no other crate writes it again for
    /// itself.
    ///
    /// # Errors
    /// None that a scene can bring about.
    pub fn to_value(&self) -> Result<Value, serde_json::Error> {
        serde_json::to_value(self)
    }

    /// The scene that a JSON value is.
    ///
    /// # Errors
    /// It is none: the key that is not known, or the value that does not fit.
    pub fn from_value(value: Value) -> Result<Self, serde_json::Error> {
        serde_json::from_value(value)
    }

    /// The number at a pointer; `None` where there is none.
    pub fn field(&self, pointer: &str) -> Option<f64> {
        self.to_value().ok()?.pointer(pointer)?.as_f64()
    }

    /// The same scene with another number at a pointer. What stands there must be a number (or the
    /// word `"infinite"`), or a key that was left out.
    ///
    /// # Errors
    /// The pointer names nothing, or something that is no number; the scene with the new number
    /// cannot be read.
    pub fn with_field(&self, pointer: &str, value: f64) -> Result<Self, InputError> {
        let number = number(value).ok_or_else(|| {
            InputError::at(JsonPath::root(), format!("{pointer}: not a finite number: {value}"))
        })?;
        let mut document =
            self.to_value().map_err(|e| InputError::at(JsonPath::root(), e.to_string()))?;
        *place(&mut document, pointer)? = Value::Number(number);
        let (scene, _) = read_str("", document.to_string()).map_err(|e| InputError {
            file: None,
            position: None,
            ..e
        })?;
        Ok(scene)
    }
}

/// Whole numbers without a decimal point, so that counts can be read as well.
fn number(value: f64) -> Option<Number> {
    const EXACT: f64 = 9_007_199_254_740_992.0;
    if value.fract() == 0.0 && value.abs() < EXACT {
        Some(Number::from(value as i64))
    } else {
        Number::from_f64(value)
    }
}

fn place<'a>(document: &'a mut Value, pointer: &str) -> Result<&'a mut Value, InputError> {
    let Some(rest) = pointer.strip_prefix('/') else {
        let error = InputError::at(JsonPath::root(), format!("{pointer:?} is not a JSON pointer"));
        return Err(error.hint("start with a slash: /templates/0/arch/thickness"));
    };
    let tokens: Vec<String> =
        rest.split('/').map(|t| t.replace("~1", "/").replace("~0", "~")).collect();
    let (mut here, mut path) = (document, JsonPath::root());
    for (depth, token) in tokens.iter().enumerate() {
        let next = tokens.get(depth + 1);
        here = match here {
            Value::Object(map) => {
                leave_in(map, token, next.map(String::as_str));
                let keys: Vec<String> = map.keys().cloned().collect();
                path = path.key(token);
                match map.get_mut(token) {
                    Some(value) => value,
                    None => {
                        return Err(missing(
                            pointer,
                            &path,
                            &format!("there are {}", keys.join(", ")),
                        ));
                    }
                }
            }
            Value::Array(list) => {
                let (count, index) = (list.len(), token.parse::<usize>().ok());
                path = path.index(index.unwrap_or(usize::MAX));
                match index.and_then(|i| list.get_mut(i)) {
                    Some(value) => value,
                    None => {
                        return Err(missing(
                            pointer,
                            &path,
                            &format!("the list has {count} entries, counted from 0"),
                        ));
                    }
                }
            }
            _ => {
                return Err(missing(
                    pointer,
                    &path.key(token),
                    "the value above it is neither an object nor a list",
                ));
            }
        };
    }
    if here.is_number() || here.is_null() || here == "infinite" {
        return Ok(here);
    }
    let kind = match here {
        Value::Object(_) => "an object",
        Value::Array(_) => "a list",
        Value::String(_) => "text",
        _ => "true or false",
    };
    let error = InputError::at(path, format!("{pointer} names {kind}, not a number"));
    Err(error.hint("point at a number inside it"))
}

/// Writes out what the format lets one leave out: an origin, and the last key itself (whether there
/// is such a key is for the reader to say).
fn leave_in(map: &mut Map<String, Value>, token: &str, next: Option<&str>) {
    if map.contains_key(token) {
        return;
    }
    match next {
        None => drop(map.insert(token.to_string(), Value::Null)),
        Some(_) if token == "at" => drop(map.insert(token.to_string(), json!([0.0, 0.0, 0.0]))),
        Some("default") if token == "joints" => {
            drop(map.insert(token.to_string(), json!({ "default": {} })))
        }
        Some(_) => {}
    }
}

fn missing(pointer: &str, path: &JsonPath, hint: &str) -> InputError {
    InputError::at(path.clone(), format!("the scene has nothing at {pointer}")).hint(hint)
}

#[cfg(test)]
mod tests {
    use crate::{Friction, read_str};

    fn scene() -> crate::Scene {
        let text = r#"{ "format": "voussoir-scene/1", "joints": { "default": { "friction": "infinite" } }, "blocks": [
            { "id": "a", "shape": { "box": { "size": [1, 1, 1] } } } ],
            "templates": [ { "arch": { "radius": 5, "thickness": 0.8, "depth": 1, "voussoirs": 27 } } ] }"#;
        read_str("test", text).unwrap().0
    }

    #[test]
    fn numbers_are_read_and_set() {
        let scene = scene();
        assert_eq!(scene.field("/templates/0/arch/thickness"), Some(0.8));
        for (pointer, value) in [
            ("/templates/0/arch/thickness", 0.75),
            ("/templates/0/arch/voussoirs", 28.0),
            ("/joints/default/friction", 0.5),
            // Left out: an origin, an optional key.
            ("/blocks/0/at/2", 1.5),
            ("/templates/0/arch/embrace_deg", 157.5),
        ] {
            let other = scene.with_field(pointer, value).unwrap();
            assert_ne!(other, scene, "{pointer}");
            assert_eq!(other.field(pointer), Some(value), "{pointer}");
        }
        let other = scene.with_field("/joints/default/friction", 0.5).unwrap();
        assert_eq!(other.joints.default.friction, Some(Friction::Coefficient(0.5)));
    }

    #[test]
    fn a_pointer_that_leads_nowhere_is_refused_with_its_place() {
        let scene = scene();
        for (pointer, says) in [
            ("templates/0", "JSON pointer"),
            ("/template/0/arch/thickness", "nothing at"),
            ("/templates/1/arch/thickness", "1 entries"),
            ("/templates/x/arch/thickness", "nothing at"),
            ("/templates/0/arch", "an object"),
            ("/blocks/0/id", "text"),
            ("/templates/0/arch/thicknes", "thickness"),
            ("/templates/0/arch/radius/0", "neither an object nor a list"),
            ("", "JSON pointer"),
        ] {
            let error = scene.with_field(pointer, 1.0).unwrap_err().to_string();
            assert!(error.contains(says), "{pointer}: {error}");
        }
        assert!(scene.with_field("/templates/0/arch/thickness", f64::NAN).is_err());
        assert!(scene.with_field("/templates/0/arch/voussoirs", 2.5).is_err());
    }
}
