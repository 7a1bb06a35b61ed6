//! Questions and answers: the only place where the stages are composed.

pub mod agreement;
pub mod ask;
pub mod assess;
mod attempt;
pub mod coulomb;
pub mod critical;
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

pub use crate::{
    terms::{Agreement, Attempt, Bracket, Deciding, ForceAgreement, Law, Outcome},
    verdict::fabric::{self, Fabric, fabric},
};
pub use agreement::agreement;
pub use ask::{Answer, Limited, Tilted, Watch, ask, ask_watched};
pub use assess::{Assessment, assess};
pub use attempt::Control;
pub use critical::{Critical, critical};
pub use limit::{LoadFactor, limit};
pub use proved::{Claims, Proved};
pub use question::{
    AssessOptions, CriticalOptions, LimitOptions, Question, ReposeOptions, SimulateOptions,
    ThrustOptions, TiltOptions,
};
pub use stability::{Packing, Stability, stability};
pub use tilt::{Tilt, tilt};
