//! Contacts that detection left out although blocks are close, in numbers.

use scene::ContactSpec;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Pairs of blocks that were left without a contact for a distance that may be a mistake of the
/// geometry.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LeftOut {
    /// Pairs that nearly touch.
    pub near_misses: usize,
    /// The greatest of their gaps, m; 0 where there are none.
    pub greatest_gap: f64,
    /// Pairs that overlap by more than the tolerance.
    pub overlaps: usize,
    /// The deepest of the overlaps, m; 0 where there are none.
    pub deepest_overlap: f64,
    /// Overlaps among them that no tolerance closes.
    pub too_deep: usize,
    /// What `contact.gap` would close all others, relative to the smaller block of a pair.
    pub closing_gap: f64,
    /// What `contact.angle_deg` would.
    pub closing_angle_deg: f64,
}

impl LeftOut {
    /// Pairs in all.
    pub fn pairs(&self) -> usize {
        self.near_misses + self.overlaps
    }

    /// The tolerances that close what can be closed; none where nothing can.
    pub(super) fn closing(&self, spec: &ContactSpec) -> Option<ContactSpec> {
        (self.pairs() > self.too_deep).then(|| ContactSpec {
            gap: self.closing_gap.max(spec.gap),
            angle_deg: self.closing_angle_deg.max(spec.angle_deg),
            ..spec.clone()
        })
    }
}
