//! A forged result in the making: other evidence, and the answer that follows from it.

use super::{honest::Honest, mutate::told};
use check::verdict::{
    Forces, Rate,
    evidence::{write_forces, write_rates},
};
use serde_json::{Value, json};

/// A false result.
pub(super) struct Forgery {
    pub kind: &'static str,
    pub what: String,
    pub file: Value,
}

/// A forged result in the making.
#[derive(Clone)]
pub(super) struct Draft {
    file: Value,
}

impl Draft {
    pub fn of(honest: &Honest) -> Self {
        Self { file: honest.file.clone() }
    }

    /// Puts a value at a pointer whose parent is there.
    #[must_use]
    pub fn set(mut self, pointer: &str, value: impl Into<Value>) -> Self {
        let (parent, key) = pointer.rsplit_once('/').unwrap_or_default();
        if let Some(Value::Object(map)) = self.file.pointer_mut(parent) {
            map.insert(key.into(), value.into());
        }
        self
    }

    /// Takes away what is at a pointer.
    #[must_use]
    pub fn without(mut self, pointer: &str) -> Self {
        let (parent, key) = pointer.rsplit_once('/').unwrap_or_default();
        if let Some(Value::Object(map)) = self.file.pointer_mut(parent) {
            map.remove(key);
        }
        self
    }

    #[must_use]
    pub fn forces(self, honest: &Honest, pointer: &str, forces: &Forces) -> Self {
        self.set(pointer, json!(write_forces(&honest.model, forces)))
    }

    #[must_use]
    pub fn rates(self, honest: &Honest, pointer: &str, rates: &[Rate]) -> Self {
        self.set(pointer, json!(write_rates(&honest.model.assembly, rates)))
    }

    /// The forgery with the answer that follows from its evidence; nothing where it is the honest
    /// result, or none (numbers that are not finite have no JSON).
    pub fn done(self, honest: &Honest, kind: &'static str, what: String) -> Option<Forgery> {
        let changed = self.file != honest.file;
        let file = told(self.file).filter(|_| changed)?;
        Some(Forgery { kind, what, file })
    }
}
