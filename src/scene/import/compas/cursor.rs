//! A place in a JSON value that knows the way to it and takes off COMPAS envelopes.

use crate::import::text::shorten;
use base::error::{InputError, JsonPath};
use serde_json::Value;

/// A value and the way to it.
#[derive(Clone, Debug)]
pub(super) struct Cursor<'a> {
    value: &'a Value,
    path: JsonPath,
}

impl<'a> Cursor<'a> {
    pub fn root(value: &'a Value) -> Self {
        Self { value, path: JsonPath::root() }
    }

    pub fn value(&self) -> &'a Value {
        self.value
    }

    pub fn path(&self) -> &JsonPath {
        &self.path
    }

    pub fn error(&self, message: impl Into<String>) -> InputError {
        InputError::at(self.path.clone(), message)
    }

    /// The value inside all envelopes around it.
    pub fn open(&self) -> Cursor<'a> {
        let mut at = self.clone();
        while let Some(object) =
            at.value.as_object().filter(|o| o.contains_key("dtype") || o.contains_key("datatype"))
        {
            let Some((key, value)) =
                ["data", "value"].into_iter().find_map(|k| object.get_key_value(k))
            else {
                break;
            };
            at = Cursor { value, path: at.path.key(key) };
        }
        at
    }

    /// Whether this is an object with this key and something in it.
    pub fn has(&self, key: &str) -> bool {
        self.value.get(key).is_some_and(|v| !v.is_null())
    }

    /// A member of an object, opened; none where it is absent or null.
    pub fn get(&self, key: &str) -> Option<Cursor<'a>> {
        let value = self.value.as_object()?.get(key).filter(|v| !v.is_null())?;
        Some(Cursor { value, path: self.path.key(key) }.open()).filter(|c| !c.value.is_null())
    }

    /// A member of an object that has to be there.
    pub fn need(&self, key: &str) -> Result<Cursor<'a>, InputError> {
        self.get(key).ok_or_else(|| {
            self.error(format!("{key:?} is missing, found {}", describe(self.value)))
                .hint("expected a COMPAS Assembly, CRA_Assembly, BlockModel or lists of meshes")
        })
    }

    /// The elements of a list, not opened.
    pub fn items(&self) -> Option<Vec<Cursor<'a>>> {
        let list = self.value.as_array()?;
        Some(
            list.iter()
                .enumerate()
                .map(|(i, value)| Cursor { value, path: self.path.index(i) })
                .collect(),
        )
    }

    /// The members of an object, opened, as numbers where all keys are whole numbers, else in the
    /// order of the file.
    pub fn members(&self) -> Result<Vec<(&'a str, Cursor<'a>)>, InputError> {
        let object = self.value.as_object().ok_or_else(|| {
            self.error(format!("expected an object, got {}", describe(self.value)))
                .hint("export the file again")
        })?;
        let mut members: Vec<(&str, Cursor)> = object
            .iter()
            .map(|(k, value)| (k.as_str(), Cursor { value, path: self.path.key(k) }.open()))
            .collect();
        if let Some(numbers) =
            members.iter().map(|(k, _)| k.parse::<i64>().ok()).collect::<Option<Vec<i64>>>()
        {
            let mut numbered: Vec<_> = numbers.into_iter().zip(members).collect();
            numbered.sort_by_key(|(number, _)| *number);
            members = numbered.into_iter().map(|(_, member)| member).collect();
        }
        Ok(members)
    }

    /// A yes or no; Python's 0 and 1 count.
    pub fn flag(&self, key: &str) -> Result<Option<bool>, InputError> {
        let Some(at) = self.get(key) else { return Ok(None) };
        match (at.value.as_bool(), at.value.as_i64()) {
            (Some(flag), _) => Ok(Some(flag)),
            (_, Some(number @ 0..=1)) => Ok(Some(number == 1)),
            _ => Err(at
                .error(format!("expected true or false, got {}", describe(at.value)))
                .hint("write true for a support")),
        }
    }

    /// A finite number.
    pub fn number(&self) -> Result<f64, InputError> {
        // JSON numbers are finite; serde_json refuses 1e999.
        self.value.as_f64().ok_or_else(|| {
            self.error(format!("expected a number, got {}", describe(self.value)))
                .hint("look for missing coordinates in the export")
        })
    }

    /// A point or vector: `[x, y, z]` or `{x, y, z}`, in an envelope or not.
    pub fn point(&self) -> Result<[f64; 3], InputError> {
        let at = self.open();
        let mut point = [0.0; 3];
        if let Some(list) = at.items().filter(|list| list.len() == 3) {
            for (value, item) in point.iter_mut().zip(&list) {
                *value = item.number()?;
            }
        } else if at.value.is_object() {
            for (value, axis) in point.iter_mut().zip(["x", "y", "z"]) {
                *value = at.need(axis)?.number()?;
            }
        } else {
            return Err(at
                .error(format!("expected three coordinates, got {}", describe(at.value)))
                .hint("export the file again"));
        }
        Ok(point)
    }
}

/// What a value is, for messages.
pub(super) fn describe(value: &Value) -> String {
    match value {
        Value::Null => "null".into(),
        Value::Bool(_) | Value::Number(_) => value.to_string(),
        Value::String(text) => format!("{:?}", shorten(text)),
        Value::Array(list) => format!("a list of {}", list.len()),
        Value::Object(object) => {
            let keys: Vec<String> = object.keys().take(6).map(|k| shorten(k)).collect();
            format!(
                "an object with {} keys ({}{})",
                object.len(),
                keys.join(", "),
                if object.len() > 6 { ", …" } else { "" }
            )
        }
    }
}
