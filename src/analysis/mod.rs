//! Questions and answers: the only place where the stages are composed.

pub mod agreement;
pub mod ask;
pub mod assess;
mod attempt;
pub mod closing;
pub mod coulomb;
pub mod critical;
pub mod doubt;
mod ends;
pub mod fabric;
pub mod flip;
pub mod geometric;
pub mod limit;
mod mend;
mod parts;
mod proved;
pub mod question;
pub mod repose;
pub mod reuse;
pub mod stability;
pub mod thrust;
pub mod tilt;

pub use agreement::{Agreement, ForceAgreement, agreement};
pub use ask::{Answer, Limited, Tilted, Watch, ask, ask_watched};
pub use assess::{Assessment, assess};
pub use attempt::{Attempt, Control, Law};
pub use closing::{Closed, Difference, LeftOutContacts, left_out};
pub use critical::{Critical, critical};
pub use doubt::{Doubt, DoubtCause, doubt};
pub use fabric::{Fabric, fabric};
pub use limit::{LoadFactor, Outcome, limit};
pub use parts::Deciding;
pub use proved::{Claims, Proved};
pub use question::{
    AssessOptions, CriticalOptions, LimitOptions, Question, ReposeOptions, SimulateOptions,
    ThrustOptions, TiltOptions,
};
pub use stability::{Packing, Stability, stability};
pub use tilt::{Tilt, tilt};

use serde::{Deserialize, Serialize};

/// Two ends that enclose a value.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Bracket {
    /// Lower end.
    #[serde(deserialize_with = "ends::lower")]
    #[schemars(with = "Option<f64>")]
    pub lower: f64,
    /// Upper end.
    #[serde(deserialize_with = "ends::upper")]
    #[schemars(with = "Option<f64>")]
    pub upper: f64,
}

impl Bracket {
    /// Upper minus lower end.
    pub fn width(&self) -> f64 {
        self.upper - self.lower
    }

    /// Whether the ends meet within `width`: ends that cross by more enclose nothing.
    pub fn is_narrow(&self, width: f64) -> bool {
        self.width().abs() <= width
    }
}
