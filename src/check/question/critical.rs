//! What is asked of a number of the scene, and which values of its range are scanned.

use super::asked::{Asked, chosen};
use crate::terms::Law;
use base::{
    error::{InputError, JsonPath},
    limits::SCANNED,
};
use scene::Scene;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Values scanned where nothing is said. Fewer: more flips stay unseen. More: time.
pub const SCAN: usize = 33;
/// Whole numbers scanned where nothing is said.
pub const WHOLE: usize = 1000;

/// Options of `critical`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CriticalOptions {
    /// How joints slide.
    #[serde(default)]
    pub law: Law,
    /// JSON pointer of the number that varies.
    pub vary: String,
    /// Both ends of the range.
    pub between: [f64; 2],
    /// Values scanned, both ends among them: 33 where nothing is said, or every whole number up to
    /// 1000 of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scan: Option<usize>,
}

impl Asked for CriticalOptions {
    fn check(&self, path: &JsonPath) -> Result<(), InputError> {
        let refuse = |key: &str, text: String| Err(InputError::at(path.key(key), text));
        if self.between[0] == self.between[1] {
            return refuse("between", "the range is empty".into());
        }
        if self.scan.is_some_and(|n| !(2..=SCANNED).contains(&n)) {
            let text = format!("must be from 2 (both ends of the range) to {SCANNED}");
            return refuse("scan", text);
        }
        Ok(())
    }

    chosen!(law);

    fn quantity(&self) -> Option<&'static str> {
        Some("value at which the verdict flips")
    }
}

impl CriticalOptions {
    /// Whether the number is a count, which takes whole numbers only.
    pub fn is_whole(&self, scene: &Scene) -> bool {
        let [from, to] = self.between;
        let readable = |v: f64| scene.with_field(&self.vary, v).is_ok();
        let low = from.min(to);
        let whole = [low.ceil(), low.floor(), from.max(to).floor()];
        !readable(low.floor() + 0.5)
            && !readable(low.ceil() + 0.5)
            && whole.into_iter().any(readable)
    }

    /// The values, from one end to the other.
    pub fn values(&self, whole: bool) -> Vec<f64> {
        let [from, to] = self.between;
        let every = ((to - from).abs() + 1.0).min(WHOLE as f64) as usize;
        let last = self.scan.unwrap_or(if whole { every } else { SCAN }).max(2) - 1;
        // Exact at both ends, symmetric between them.
        let at = |k: usize| (from * (last - k) as f64 + to * k as f64) / last as f64;
        let mut values: Vec<f64> = (0..=last).map(at).collect();
        if whole {
            values.iter_mut().for_each(|v| *v = v.round());
            values.dedup();
        }
        values
    }
}
