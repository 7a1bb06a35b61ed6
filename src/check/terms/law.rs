//! How joints slide.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a joint slides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Law {
    /// A joint that slides opens by μ × the slip. Admissible forces are then enough to stand.
    Associative,
    /// Dry friction: a joint slides without opening. Forces must also be such as the loads produce.
    #[default]
    Coulomb,
}
