//! Questions and answers: the only place where the stages are composed.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod agreement;
mod alike;
pub mod ask;
pub mod assess;
mod attempt;
pub mod closing;
pub mod coulomb;
pub mod critical;
pub mod doubt;
pub mod flip;
pub mod follow;
mod forest;
pub mod geometric;
mod in_time;
pub mod kinematic;
mod known;
pub mod limit;
mod mend;
pub mod moving;
mod near;
mod parts;
pub mod piles;
mod proved;
pub mod question;
pub mod recompute;
pub mod repose;
pub mod reuse;
pub mod rocking;
pub mod saved;
mod settling;
pub mod stability;
pub mod stages;
pub mod state;
pub mod still;
pub mod thrust;
pub mod tilt;

pub use agreement::agreement;
pub use ask::{Answer, Limited, Tilted, ask, ask_among, ask_on};
pub use assess::{Assessment, assess};
pub use attempt::Control;
pub use check::ground::ShakeOptions;
pub use check::rocking::{RockOptions, RockPoint};
pub use check::terms::{Closed, Difference, Doubt, DoubtCause, LeftOutContacts};
pub use check::{
    terms::{Agreement, Attempt, Bracket, Deciding, ForceAgreement, Law, Outcome},
    verdict::fabric::{self, Fabric, fabric},
};
pub use closing::left_out;
pub use critical::{Critical, critical};
pub use doubt::doubt;
pub use kinematic::Kinematic;
pub use limit::{LoadFactor, limit};
pub use moving::Moving;
pub use proved::{Claims, Proved};
pub use question::{
    AssessOptions, ControlPoint, CriticalOptions, KinematicOptions, LimitOptions, MovingOptions,
    PushOptions, Question, ReposeOptions, SimulateOptions, ThrustOptions, TiltOptions,
};
pub use rocking::Rocking;
pub use settling::{SettleOptions, SupportMove};
pub use stability::{Packing, Stability, stability};
pub use stages::{Stages, StagesOptions, stages};
pub use state::StateOptions;
pub use tilt::{Tilt, tilt};
pub use {
    ask::ask_watched,
    in_time::{ShakenScene, Watch, burdens},
};
