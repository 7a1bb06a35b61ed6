//! JSON pointers (RFC 6901) into a scene: finding the number, changing it, and what depends on it.

use super::Parameter;
use base::error::{InputError, JsonPath};
use scene::{Touches, suggest};
use serde_json::{Map, Value};

/// A pointer that is known to lead to a number or a word of a scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Pointer {
    tokens: Vec<String>,
    /// The same place as a path, for messages about the scene.
    pub path: JsonPath,
}

impl Pointer {
    /// Follows a pointer to a number. Its last key may be missing in an object that is there.
    ///
    /// # Errors
    /// At the root of the returned path: it is no pointer, leads nowhere, or not to a number.
    pub fn find(text: &str, scene: &Value) -> Result<Self, InputError> {
        let (pointer, value) = Self::follow(text, scene)?;
        // A coefficient of friction may be the word "infinite".
        match value.filter(|v| !v.is_number() && *v != "infinite") {
            None => Ok(pointer),
            Some(value) => {
                let hint = match value {
                    Value::String(_) => "list words to vary as \"values\": [\"one\", \"another\"]",
                    _ => "the pointer must lead to a single number",
                };
                let text =
                    format!("{} of the scene is not a number: {}", pointer.path, what(value));
                Err(InputError::at(JsonPath::root(), text).hint(hint))
            }
        }
    }

    /// The same to a number or a word.
    ///
    /// # Errors
    /// As [`Self::find`].
    pub fn find_word(text: &str, scene: &Value) -> Result<Self, InputError> {
        let (pointer, value) = Self::follow(text, scene)?;
        match value.filter(|v| v.is_object() || v.is_array()) {
            None => Ok(pointer),
            Some(value) => {
                let text = format!("{} of the scene is not a word: {}", pointer.path, what(value));
                Err(InputError::at(JsonPath::root(), text)
                    .hint("the pointer must lead to a single word"))
            }
        }
    }

    /// Where a pointer leads; nothing where only its last key is missing.
    fn follow<'a>(text: &str, scene: &'a Value) -> Result<(Self, Option<&'a Value>), InputError> {
        let root = JsonPath::root;
        let Some(rest) = text.strip_prefix('/') else {
            return Err(InputError::at(root(), format!("not a JSON pointer: {text:?}"))
                .hint("a pointer starts at the root of the scene: \"/joints/default/friction\""));
        };
        let tokens: Vec<String> =
            rest.split('/').map(|t| t.replace("~1", "/").replace("~0", "~")).collect();
        let (mut value, mut path) = (scene, root());
        for (depth, token) in tokens.iter().enumerate() {
            let last = depth + 1 == tokens.len();
            let next = match value {
                Value::Object(map) => {
                    path = path.key(token.as_str());
                    match map.get(token) {
                        Some(next) => next,
                        None if last => return Ok((Self { tokens, path }, None)),
                        None => return Err(no_key(text, token, map)),
                    }
                }
                Value::Array(list) => {
                    let index = index(token);
                    path = path.index(index.unwrap_or(0));
                    match index.and_then(|i| list.get(i)) {
                        Some(next) => next,
                        None => {
                            let message = format!(
                                "{text:?} does not exist: {token:?} is none of the {} elements of its list",
                                list.len()
                            );
                            return Err(
                                InputError::at(root(), message).hint("elements are counted from 0")
                            );
                        }
                    }
                }
                _ => {
                    let message = format!(
                        "{text:?} does not exist: {path} of the scene is {value}, which has no {token:?}"
                    );
                    return Err(InputError::at(root(), message));
                }
            };
            value = next;
        }
        Ok((Self { tokens, path }, Some(value)))
    }

    /// The number there, where there is one.
    pub fn get<'a>(&self, scene: &'a Value) -> Option<&'a Value> {
        self.tokens.iter().try_fold(scene, |value, token| match value {
            Value::Object(map) => map.get(token),
            Value::Array(list) => list.get(index(token)?),
            _ => None,
        })
    }

    /// Puts a number or a word there.
    pub fn set(&self, scene: &mut Value, parameter: &Parameter) {
        let Some((last, parents)) = self.tokens.split_last() else { return };
        let parent = parents.iter().try_fold(scene, |value, token| match value {
            Value::Object(map) => map.get_mut(token),
            Value::Array(list) => list.get_mut(index(token)?),
            _ => None,
        });
        match parent {
            Some(Value::Object(map)) => drop(map.insert(last.clone(), parameter.value())),
            Some(Value::Array(list)) => {
                if let Some(element) = index(last).and_then(|i| list.get_mut(i)) {
                    *element = parameter.value();
                }
            }
            _ => {}
        }
    }

    /// What depends on this number.
    pub fn touches(&self, scene: &Value) -> Touches {
        Touches::of(&self.tokens, scene)
    }
}

fn no_key(text: &str, token: &str, map: &Map<String, Value>) -> InputError {
    let hint = suggest(token, map.keys().map(String::as_str));
    InputError {
        hint,
        ..InputError::at(
            JsonPath::root(),
            format!("{text:?} does not exist: the scene has no key {token:?} there"),
        )
    }
}

fn index(token: &str) -> Option<usize> {
    let plain =
        token.bytes().all(|b| b.is_ascii_digit()) && (token == "0" || !token.starts_with('0'));
    if plain { token.parse().ok() } else { None }
}

/// A value in a few words.
fn what(value: &Value) -> String {
    match value {
        Value::Object(map) => format!(
            "an object with {}",
            map.keys().map(|k| format!("{k:?}")).collect::<Vec<_>>().join(", ")
        ),
        Value::Array(list) => format!("a list of {}", list.len()),
        scalar => scalar.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn leads_to_numbers_only_and_says_why_not() {
        let scene =
            json!({ "a/b": [{ "m~n": 1.5 }], "t": [1, { "u": "infinite", "v": "word", "w": {} }] });
        let mut changed = scene.clone();
        Pointer::find("/a~1b/0/m~0n", &scene).unwrap().set(&mut changed, &3.0.into());
        Pointer::find("/t/1/u", &scene).unwrap().set(&mut changed, &0.25.into());
        Pointer::find("/t/1/w/new", &scene).unwrap().set(&mut changed, &(-0.0).into());
        assert_eq!(
            changed,
            json!({ "a/b": [{ "m~n": 3 }], "t": [1, { "u": 0.25, "v": "word", "w": { "new": 0 } }] })
        );
        for (text, word) in [
            ("t/0", "not a JSON pointer"),
            ("", "not a JSON pointer"),
            ("/", "unknown"),
            ("/t/2", "none of the 2 elements"),
            ("/t/01", "none of the 2"),
            ("/t/-1", "none of the 2"),
            ("/t/0/x", "which has no \"x\""),
            ("/t/1/v", "not a number"),
            ("/t/1/w", "not a number"),
            ("/s/x", "no key \"s\""),
        ] {
            // Where it does not end at a number it may end at a word.
            assert_eq!(Pointer::find_word(text, &scene).is_ok(), matches!(text, "/" | "/t/1/v"));
            match Pointer::find(text, &scene) {
                Err(e) => assert!(e.to_string().contains(word), "{e}"),
                Ok(p) => assert!(word == "unknown" && p.get(&scene).is_none()),
            }
        }
    }

    #[test]
    fn what_depends_on_a_number() {
        let free = json!({ "joints": { "default": {} }, "materials": { "m": { "density": 1 } }, "templates": [{ "arch": { "radius": 1 } }], "gravity": [0, 0, -9] });
        let touches =
            |text: &str, scene: &Value| Pointer::find(text, scene).unwrap().touches(scene);
        assert_eq!(touches("/joints/default/friction", &free), Touches::Loads);
        assert_eq!(touches("/gravity/2", &free), Touches::Loads);
        assert_eq!(touches("/materials/m/density", &free), Touches::Masses);
        assert_eq!(touches("/templates/0/arch/radius", &free), Touches::Shapes);
        let mut given = free.clone();
        given["interfaces"] = json!([{}]);
        assert_eq!(touches("/joints/default/friction", &given), Touches::Shapes);
    }
}
