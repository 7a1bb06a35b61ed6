//! Moments: those of the system, or of the page on WebAssembly, where no system has any.

#[cfg(not(target_arch = "wasm32"))]
pub use std::time::Instant;
#[cfg(target_arch = "wasm32")]
pub use web_time::Instant;
