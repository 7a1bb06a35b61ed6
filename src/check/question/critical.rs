//! Which values of a range are scanned.

use super::CriticalOptions;
use scene::Scene;

/// Values scanned where nothing is said. Fewer: more flips stay unseen. More: time.
pub const SCAN: usize = 33;
/// Whole numbers scanned where nothing is said.
pub const WHOLE: usize = 1000;

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
