//! One forgery: some leaves of one part of a result are others.

use crate::random::Random;
use check::proof::{Derived, derive, read::read_str, recompute::JustComputed};
use model::interface::prepare;
use serde_json::Value;

/// What is changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Part {
    /// What is told.
    Answer,
    /// What was asked.
    Question,
    /// What it follows from.
    Evidence,
    /// What it is about.
    Scene,
}

impl Part {
    pub fn word(self) -> &'static str {
        match self {
            Self::Answer => "answer",
            Self::Question => "question",
            Self::Evidence => "evidence",
            Self::Scene => "scene",
        }
    }
}

/// Changes of a number by less than this share may pass for rounding.
const MATERIAL: f64 = 1e-5;

/// A forgery of a file, with what was changed; nothing where nothing was. Where question, evidence or
/// scene are others, the answer is the one that follows from them.
pub(super) fn mutate(honest: &Value, random: &mut Random) -> Option<(Part, String, Value)> {
    let part =
        [Part::Answer, Part::Answer, Part::Evidence, Part::Evidence, Part::Scene, Part::Question]
            [random.count(0, 5)];
    let mut file = honest.clone();
    let mut all = Vec::new();
    leaves(&file[part.word()], format!("/{}", part.word()), &mut all);
    if all.is_empty() {
        return None;
    }
    let mut what = Vec::new();
    for _ in 0..[1, 1, 1, 3][random.count(0, 3)] {
        let pointer = &all[random.count(0, all.len() - 1)];
        if let Some(said) = change(&mut file, pointer, random) {
            what.push(format!("{pointer} {said}"));
        }
    }
    if what.is_empty() || file == *honest {
        return None;
    }
    if part != Part::Answer {
        file = told(file)?;
    }
    Some((part, what.join(", "), file))
}

/// The file with the answer that follows from the rest of it.
pub(super) fn told(mut file: Value) -> Option<Value> {
    let saved = read_str("forged", file.to_string()).ok()?;
    let model = prepare(&saved.scene).ok()?;
    let evidence = (saved.evidence, saved.closed);
    let derived = derive(saved.question, &saved.scene, &model, evidence, saved.run, &JustComputed);
    let Derived { file: own, .. } = derived.ok()?;
    file["answer"] = own.to_value().ok()?["answer"].take();
    Some(file)
}

/// Changes the leaf at a pointer: how; nothing where what came out may be rounding.
fn change(file: &mut Value, pointer: &str, random: &mut Random) -> Option<String> {
    let leaf = file.pointer_mut(pointer)?;
    let old = leaf.clone();
    *leaf = match &old {
        Value::Number(n) => {
            let v = n.as_f64()?;
            let whole = n.is_u64() || n.is_i64();
            let choices =
                [0.0, -v, 2.0 * v, v * (1.0 + 3e-3), v + 1.0, v * (1.0 - 1e-4), 1e300, 5e-324];
            let other = choices[random.count(0, choices.len() - 1)];
            if (other - v).abs() <= MATERIAL * v.abs().max(1e-3) {
                return None;
            }
            match whole {
                true => Value::from(other.clamp(-1e15, 1e15).round() as i64),
                false => Value::from(other),
            }
        }
        Value::String(s) => {
            let words = ["stable", "unstable", "found", "unbounded", "rests", "exact", "falls", ""];
            let other = words[random.count(0, words.len() - 1)];
            if s == other {
                return None;
            }
            Value::from(other)
        }
        Value::Bool(b) => Value::from(!b),
        Value::Null => Value::from(1.0),
        Value::Array(_) | Value::Object(_) => return None,
    };
    (*leaf != old).then(|| format!("{old} -> {leaf}"))
}

/// All leaves below a place, lists by their first, a middle and their last item.
fn leaves(value: &Value, at: String, all: &mut Vec<String>) {
    match value {
        Value::Array(list) => {
            let picked = [0, list.len() / 2, list.len().saturating_sub(1)];
            let mut last = usize::MAX;
            for k in picked.into_iter().filter(|k| *k < list.len()) {
                if k != last {
                    leaves(&list[k], format!("{at}/{k}"), all);
                }
                last = k;
            }
        }
        Value::Object(map) => {
            for (key, value) in map {
                let key = key.replace('~', "~0").replace('/', "~1");
                leaves(value, format!("{at}/{key}"), all);
            }
        }
        _ => all.push(at),
    }
}
