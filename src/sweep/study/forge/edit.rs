//! Changing a result as JSON.

use super::{Forgery, Honest};
use check::{
    proof::{answer::LoadFactorAnswer, certificate::DryResult},
    terms::Bound,
    verdict::{
        Forces, Rate, certificate,
        evidence::{write_forces, write_rates},
    },
};
use serde::Deserialize;
use serde_json::{Value, json};

/// A forged result in the making.
#[derive(Clone)]
pub(super) struct Draft {
    file: Value,
    /// Whether everything that was to be changed was there.
    complete: bool,
}

impl Draft {
    pub fn of(honest: &Honest) -> Self {
        Self { file: honest.file.clone(), complete: true }
    }

    /// Puts a value at a pointer; its parent must be there.
    #[must_use]
    pub fn set(mut self, pointer: &str, value: impl Into<Value>) -> Self {
        let (parent, key) = pointer.rsplit_once('/').unwrap_or_default();
        match self.file.pointer_mut(parent) {
            Some(Value::Object(map)) => drop(map.insert(key.into(), value.into())),
            Some(Value::Array(list)) => {
                match key.parse::<usize>().ok().and_then(|k| list.get_mut(k)) {
                    Some(place) => *place = value.into(),
                    None => self.complete = false,
                }
            }
            _ => self.complete = false,
        }
        self
    }

    /// Takes away what is at a pointer.
    #[must_use]
    pub fn without(mut self, pointer: &str) -> Self {
        let (parent, key) = pointer.rsplit_once('/').unwrap_or_default();
        match self.file.pointer_mut(parent) {
            Some(Value::Object(map)) => drop(map.remove(key)),
            Some(Value::Array(list)) if key.parse().is_ok_and(|k: usize| k < list.len()) => {
                drop(list.remove(key.parse().unwrap_or(0)))
            }
            _ => self.complete = false,
        }
        self
    }

    /// Puts forces into the certificate at a pointer, under a key of it.
    #[must_use]
    pub fn forces(self, honest: &Honest, pointer: &str, forces: &Forces) -> Self {
        let saved = write_forces(&honest.model, forces);
        // Numbers that are not finite have no JSON; `null` is refused, which is right but tells
        // nothing.
        self.set(pointer, json!(saved))
    }

    /// Puts rates into the certificate at a pointer.
    #[must_use]
    pub fn rates(self, honest: &Honest, pointer: &str, rates: &[Rate]) -> Self {
        self.set(pointer, json!(write_rates(&honest.model.assembly, rates)))
    }

    /// Says of the unbalance what the check will find with these forces, so that nothing else gives
    /// the forgery away.
    #[must_use]
    pub fn unbalance(self, honest: &Honest, forces: &Forces) -> Self {
        let upper = certificate::statics(&honest.model, forces, 0.0).unbalance;
        self.set("/answer/unbalance", json!({ "lower": 0.0, "upper": upper }))
    }

    /// Makes what follows from what was changed follow again, so that nothing but the proof gives
    /// the forgery away: the load factor to use, the tilt in degrees, the verdict without the live
    /// load.
    fn consistent(mut self, honest: &Honest) -> Self {
        let untouched =
            |file: &Value, pointer: &str| file.pointer(pointer) == honest.file.pointer(pointer);
        let dry = self.file.get("dry").and_then(|dry| DryResult::deserialize(dry).ok());
        for (key, degrees) in [("load_factor", None), ("tan_tilt", Some("tilt_deg"))] {
            let pointer = format!("/answer/{key}");
            let numbers = ["status", "value", "lower", "upper", "found", "law"]
                .map(|k| format!("{pointer}/{k}"));
            let Some(bound) = self
                .file
                .pointer(&format!("{pointer}/associative"))
                .and_then(|b| Bound::deserialize(b).ok())
            else {
                continue;
            };
            if !numbers.iter().all(|pointer| untouched(&self.file, pointer)) {
                continue;
            }
            let said = LoadFactorAnswer::new(bound, dry.as_ref());
            self.file["answer"][key] = json!(said);
            if let Some(key) =
                degrees.filter(|key| untouched(&self.file, &format!("/answer/{key}")))
            {
                self.file["answer"][key] = json!(said.degrees());
            }
        }
        if let Some(dead) = self
            .file
            .pointer("/dead_load/answer/verdict")
            .filter(|_| untouched(&self.file, "/answer/verdict"))
            .cloned()
            && self.file.pointer("/answer/verdict").is_some()
        {
            self.file["answer"]["verdict"] = dead;
        }
        self
    }

    /// The forgery; none where the result did not hold what was to be changed, or the change
    /// changed nothing.
    pub fn done(
        self,
        honest: &Honest,
        kind: &'static str,
        what: impl Into<String>,
    ) -> Option<Forgery> {
        let this = self.consistent(honest);
        let changed = this.complete && this.file != honest.file;
        changed.then(|| Forgery { kind, what: what.into(), file: this.file })
    }
}
