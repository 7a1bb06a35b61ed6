//! Questions and answers: the only place where the stages are composed.

#![forbid(unsafe_code)]
#![warn(missing_docs)]

pub mod agreement;
pub mod answer;
pub mod ask;
pub mod assess;
pub mod closing;
mod combinations;
pub mod coulomb;
pub mod critical;
pub mod critical_value;
mod directions;
pub mod doubt;
mod flats;
pub mod follow;
mod forest;
pub mod geometric;
pub mod implied;
mod in_time;
pub mod kinematic;
mod ladder;
pub mod limit;
mod meet;
pub mod model_cache;
pub mod moving;
mod part_cache;
mod parts;
pub mod piles;
mod proved;
pub mod recompute;
mod repair;
pub mod repose;
pub mod rocking;
pub mod saved;
mod sensitivity;
pub mod stability;
pub mod stages;
pub mod state;
pub mod thrust;
pub mod tilt;
mod warm_start;
mod watch;
mod without;

pub use agreement::agreement;
pub use answer::{Answer, Combined, InCombination, Limited, Met, Probe, Tilted};
pub use ask::{ask, ask_among, ask_on};
pub use assess::{Assessment, assess};
pub use check::ground::ShakeOptions;
pub use check::question::{
    self, AssessOptions, CombinationsOptions, ControlPoint, CriticalOptions, KinematicOptions,
    LimitOptions, MeetOptions, MovingOptions, PushOptions, Question, ReposeOptions, SettleOptions,
    SimulateOptions, StagesOptions, StateOptions, SupportMove, ThrustOptions, TiltOptions,
    WithoutOptions,
};
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
pub use ladder::Control;
pub use limit::{LoadFactor, limit};
pub use moving::Moving;
pub use proved::{Claims, Proved};
pub use rocking::Rocking;
pub use stability::{Packing, Stability, stability};
pub use stages::Stages;
pub use tilt::{Tilt, tilt};
pub use watch::{Watched, Watcher};
pub use without::{Left, Without};
pub use {
    ask::ask_watched,
    in_time::{ShakenScene, Watch, burdens},
};
