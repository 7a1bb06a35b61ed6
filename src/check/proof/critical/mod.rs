//! Results of `critical`: the flips, each with a verdict and its evidence on both sides.

mod verify;

pub(super) use verify::verify;

use super::{answer::Answer, certificate::Certificate, result::ResultFile};
use crate::{
    terms::{Law, Method},
    verdict::Verdict,
};
use base::tolerance;
use serde::{Deserialize, Serialize};

/// A value at which the verdict flips.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CriticalValue {
    /// The value.
    pub value: f64,
    /// The nearest value below whose verdict is proved.
    pub lower: f64,
    /// The nearest value above whose verdict is proved.
    pub upper: f64,
    /// The verdict below.
    pub below: Verdict,
    /// The verdict above.
    pub above: Verdict,
}

/// The scan and the flips.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CriticalResult {
    /// JSON pointer of the number that varies.
    pub vary: String,
    /// The range.
    pub between: [f64; 2],
    /// Whether the number is a count.
    pub whole: bool,
    /// For which law of sliding the scan was asked; dry friction where nothing is said.
    #[serde(default)]
    pub law: Law,
    /// The scan: computed, not proved.
    pub scan: Vec<ScanPoint>,
    /// The flips, in the order of the scan.
    pub flips: Vec<FlipResult>,
    /// Without a flip: the verdicts at the ends of the range.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ends: Vec<Side>,
    /// What the reader should know.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
    /// Scenes asked in all.
    pub scenes: usize,
}

/// A value of the scan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ScanPoint {
    /// The value.
    pub value: f64,
    /// Its verdict.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub verdict: Option<Verdict>,
    /// Its least unbalance, g, as the mechanism bounds it from below.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unbalance: Option<f64>,
    /// Why there is no scene with this value.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
}

/// A flip.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FlipResult {
    /// The value.
    pub value: f64,
    /// How it was found.
    pub method: Method,
    /// The nearest value below.
    pub below: Side,
    /// The nearest value above.
    pub above: Side,
}

/// One value with its verdict and the evidence for it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Side {
    /// The value.
    pub value: f64,
    /// The verdict.
    pub answer: Answer,
    /// The evidence.
    pub certificate: Certificate,
}

impl Side {
    /// Its verdict, where it is proved.
    pub fn verdict(&self) -> Option<Verdict> {
        self.answer
            .verdict()
            .filter(|v| *v != Verdict::Undecided && self.certificate.claim.is_some())
    }
}

impl FlipResult {
    /// The value with its ends, where both are proved and differ: near together, or the middle of
    /// what the scan leaves.
    pub fn proved(&self) -> Option<CriticalValue> {
        let (below, above) = (self.below.verdict()?, self.above.verdict()?);
        let (lower, upper) = (self.below.value, self.above.value);
        let value = CriticalValue { value: self.value, lower, upper, below, above };
        let is_known = match self.method {
            Method::Margin | Method::Halving => is_narrow(lower, upper),
            Method::Scan => self.value == middle(lower, upper),
        };
        (below != above && lower <= self.value && self.value <= upper && is_known).then_some(value)
    }
}

/// Whether two ends are near enough to each other for a value between them.
pub fn is_narrow(lower: f64, upper: f64) -> bool {
    upper - lower <= tolerance::CRITICAL_BRACKET * lower.abs().max(upper.abs())
}

/// The middle of two ends.
pub fn middle(lower: f64, upper: f64) -> f64 {
    0.5 * (lower + upper)
}

/// The verdict throughout the range, where the scan found no flip and left nothing open.
pub fn exhausted(file: &ResultFile) -> Option<Verdict> {
    let c = file.critical.as_ref()?;
    let first = c.ends.first()?.verdict()?;
    let same = c.scan.iter().all(|s| s.verdict == Some(first))
        && c.ends.iter().all(|e| e.verdict() == Some(first));
    (same && c.flips.is_empty() && c.ends.len() == 2).then_some(first)
}
