//! How a critical value was found.

/// How a critical value was found.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema,
)]
#[serde(rename_all = "snake_case")]
pub enum Method {
    /// The zero of the least equilibrium error.
    Margin,
    /// By halving the range.
    Halving,
    /// Between two neighbours of the scan (a count, or a range that could not be narrowed).
    Scan,
}
