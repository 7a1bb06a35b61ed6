//! Whether an answer is what was required of it.

use super::answer::{Answer, FactorStatus};
use crate::{elastic::PathEnd, question::Question, terms::Found, verdict::Verdict};
use schemars::JsonSchema;
use serde::Serialize;
use serde_with::skip_serializing_none;

/// What was required of a load factor or, of a tilt, of an angle in degrees.
#[skip_serializing_none]
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Required {
    /// The least value that is enough.
    pub least: f64,
    /// Whether it is reached; absent where that is open.
    pub met: Option<bool>,
}

impl Required {
    /// What was required, where anything was.
    pub(super) fn of(question: &Question, answer: &Answer) -> Option<Self> {
        let least = question.require()?;
        Some(Self { least, met: holds(question, answer) })
    }
}

/// Whether the answer to a question about a load factor or an angle is a yes: it is known, and as
/// much as is required where anything is; `None` where that is open. A requirement inside the bracket
/// is not decided. Where dry friction was asked for, the bound alone meets no requirement.
pub fn holds(question: &Question, answer: &Answer) -> Option<bool> {
    let require = question.require();
    if let Answer::State(a) = answer {
        return match (a.load_factor, require) {
            _ if a.verdict == Verdict::Undecided => None,
            _ if a.verdict != Verdict::Stable => Some(false),
            (Some(l), Some(r)) if l.reached >= r || l.value.is_some_and(|v| v >= r) => Some(true),
            (Some(l), Some(r)) if l.associative.upper.is_some_and(|u| u < r) => Some(false),
            (Some(l), Some(_)) if l.value.is_some() => Some(false),
            (_, Some(_)) => None,
            (Some(l), None) if l.end == PathEnd::Open => None,
            (_, None) => Some(true),
        };
    }
    let said = answer.load_factor()?;
    let scale = |lambda: f64| match question {
        Question::Tilt(_) | Question::Repose(_) => lambda.atan().to_degrees(),
        _ => lambda,
    };
    // A scene that needs a pre-stress already without its live load, or falls, is no yes.
    let negative = said.associative.found().is_some_and(|(.., upper)| upper < 0.0);
    let level = answer.verdict();
    let dead = matches!(level, Some(Verdict::Conditional | Verdict::Unstable)) || negative;
    let is_open = level == Some(Verdict::Undecided);
    let (lower, upper) = (said.lower.map(scale), said.upper.map(scale));
    match (said.status, require) {
        (FactorStatus::Impossible | FactorStatus::NotAtRest, _) => Some(false),
        _ if dead => Some(false),
        (_, Some(r)) if said.associative.upper.map(scale).is_some_and(|u| u < r) => Some(false),
        // Nor is one of which that is not known.
        _ if is_open => None,
        (FactorStatus::Found | FactorStatus::Unbounded, None)
        | (FactorStatus::Unbounded, Some(_)) => Some(true),
        // Seen at rest there, whatever is known beyond.
        (_, Some(r)) if lower.is_some_and(|l| l >= r) => Some(true),
        (FactorStatus::Found, Some(r)) if upper.is_some_and(|u| u < r) => Some(false),
        // Of a value with dry friction that slides, the ends are what was seen beside it.
        (FactorStatus::Found, Some(r))
            if matches!(said.found, Some(Found::FixedPoint | Found::Rests | Found::RestsBelow)) =>
        {
            Some(said.value.map(scale).is_none_or(|v| v >= r))
        }
        (FactorStatus::Found | FactorStatus::AtLeast | FactorStatus::Undecided, _) => None,
    }
}
