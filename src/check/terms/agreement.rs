//! A verdict beside what happened in time.

use super::Fate;
use crate::verdict::Verdict;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// How far a verdict and a simulation agree.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Agreement {
    /// The verdict.
    pub verdict: Verdict,
    /// What the simulation showed.
    pub fate: Fate,
    /// Whether they say the same; absent where one of them is undecided, or the joints have
    /// strengths that the simulation leaves out. A conditional verdict says that it falls, because
    /// the simulation starts without self-stress.
    pub agrees: Option<bool>,
    /// Where both fall: cosine between the first motion and the mechanism, in the metric of the
    /// kinetic energy. 1 is the same motion; a scene with several ways to fall takes the fastest,
    /// the mechanism is the one that proves most.
    pub motion: Option<f64>,
    /// Where both stand and the contact forces are known.
    pub forces: Option<ForceAgreement>,
}

/// The forces between blocks, simulated against computed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ForceAgreement {
    /// Largest difference between the two resultants of a pair of blocks, over the largest
    /// resultant.
    pub largest: f64,
    /// The pair it is found on.
    pub between: [String; 2],
    /// Root of the mean square of the differences over the root of the mean square of the
    /// resultants.
    pub mean: f64,
    /// Pairs compared.
    pub pairs: usize,
    /// Whether statics alone fixes the resultants; if not, they depend on how contacts yield, and
    /// the two methods need not agree.
    pub determinate: bool,
}

/// Whether a verdict and a simulation say the same; `left_out`: the simulated joints resist less,
/// or more, than those of the verdict.
pub fn agree(verdict: Verdict, fate: Fate, left_out: bool) -> Option<bool> {
    match (verdict, fate) {
        (Verdict::Undecided, _) | (_, Fate::Undecided) => None,
        _ if left_out => None,
        (Verdict::Stable, fate) => Some(fate == Fate::Stands),
        (Verdict::Conditional | Verdict::Unstable, fate) => Some(fate == Fate::Falls),
    }
}
