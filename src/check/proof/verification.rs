//! What the verification of a result found (`"format": "voussoir-verification/1"`), for programs.

use super::derive::Verification;
use crate::verdict::exact::Grade;
use base::error::Finding;
use serde::Serialize;

/// The outcome and its reasons.
#[derive(Clone, Debug, Serialize)]
pub struct VerificationFile<'a> {
    format: &'static str,
    name: &'a str,
    /// Whether any part fails.
    refuted: bool,
    /// Whether the answer claims something and every part holds.
    proved: bool,
    /// The weakest grade of all that holds; absent where nothing is proved.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    proof: Option<Grade>,
    parts: Vec<Part<'a>>,
    /// What is to be known about the scene.
    scene: &'a [Finding],
}

#[derive(Clone, Debug, Serialize)]
struct Part<'a> {
    title: &'a str,
    fails: &'a [String],
    holds: &'a [String],
}

impl<'a> VerificationFile<'a> {
    /// The verification of the result called `name`.
    pub fn new(name: &'a str, verification: &'a Verification) -> Self {
        let part = |(title, findings): &'a (String, crate::verdict::claim::Findings)| Part {
            title,
            fails: &findings.fails,
            holds: &findings.holds,
        };
        Self {
            format: "voussoir-verification/1",
            name,
            refuted: verification.refuted(),
            proved: verification.proved(),
            proof: verification.proved().then(|| verification.grade()),
            parts: verification.parts.iter().map(part).collect(),
            scene: &verification.scene,
        }
    }
}
