//! What the verification of a result found (`"format": "voussoir-verification/2"`), for programs.

use super::verify::Verified;
use crate::verdict::{claim::Findings, exact::Grade};
use base::error::Finding;
use serde::Serialize;
use serde_json::Value;

/// The outcome and its reasons.
#[derive(Clone, Debug, Serialize)]
pub struct VerificationFile<'a> {
    format: &'static str,
    name: &'a str,
    /// The weakest grade of what the answer rests on.
    grade: Told,
    /// Whether the answer claims something, every part holds, and nothing stayed open.
    confirmed: bool,
    parts: Vec<Part<'a>>,
    /// The answer as it follows from the evidence; absent where the evidence is none for its
    /// question.
    #[serde(skip_serializing_if = "Option::is_none")]
    answer: Option<Value>,
    /// What is to be known about the scene.
    scene: &'a [Finding],
}

/// How well something is known.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
enum Told {
    /// A theorem about the resolved numbers of the scene.
    Exact,
    /// Proved, but for this number.
    ToRounding(f64),
    /// Computed, and computed again here; no proof of it is possible.
    Computed,
    /// Computed, and not again here: this build has nothing that does.
    Unchecked,
    /// Some part does not hold.
    Refuted,
    /// Nothing is claimed.
    Nothing,
}

#[derive(Clone, Debug, Serialize)]
struct Part<'a> {
    title: &'a str,
    grade: Told,
    fails: &'a [String],
    holds: &'a [String],
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    open: &'a [String],
}

impl Told {
    fn of(f: &Findings) -> Self {
        match f.grade {
            _ if !f.fails.is_empty() => Self::Refuted,
            _ if !f.unchecked.is_empty() => Self::Unchecked,
            _ if f.computed => Self::Computed,
            Grade::Exact => Self::Exact,
            Grade::ToRounding(by) => Self::ToRounding(by),
        }
    }
}

impl<'a> VerificationFile<'a> {
    /// The verification of the result called `name`.
    pub fn new(name: &'a str, verified: &'a Verified) -> Self {
        let check = &verified.check;
        let part = |(title, f): &'a (String, Findings)| Part {
            title,
            grade: Told::of(f),
            fails: &f.fails,
            holds: &f.holds,
            open: &f.unchecked,
        };
        let grade = match check.grade() {
            _ if check.refuted() => Told::Refuted,
            _ if !check.claimed => Told::Nothing,
            _ if check.unchecked().next().is_some() => Told::Unchecked,
            _ if check.computed() => Told::Computed,
            Grade::Exact => Told::Exact,
            Grade::ToRounding(by) => Told::ToRounding(by),
        };
        Self {
            format: "voussoir-verification/2",
            name,
            grade,
            confirmed: check.proved(),
            parts: check.parts.iter().map(part).collect(),
            answer: verified.file.as_ref().and_then(|f| serde_json::to_value(&f.told).ok()),
            scene: &check.scene,
        }
    }
}
