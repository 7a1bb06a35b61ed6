//! What clarabel and the house ask of the crate of this name, with the clock that the page hands in: no
//! bindings are generated for it.

pub use std::time::Duration;

#[link(wasm_import_module = "page")]
unsafe extern "C" {
    /// Seconds since some moment.
    safe fn seconds() -> f64;
}

/// A moment, since some other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Instant(Duration);

impl Instant {
    /// This one.
    pub fn now() -> Self {
        Self(Duration::try_from_secs_f64(seconds()).unwrap_or_default())
    }

    /// What has passed since then.
    pub fn elapsed(&self) -> Duration {
        Self::now().saturating_duration_since(*self)
    }

    /// What has passed between two, nothing where the other is later.
    pub fn saturating_duration_since(&self, other: Self) -> Duration {
        self.0.saturating_sub(other.0)
    }

    /// A later one, where a clock can show it.
    pub fn checked_add(&self, by: Duration) -> Option<Self> {
        self.0.checked_add(by).map(Self)
    }
}
