//! Results as files, and what proves them: an answer with its evidence, complete enough to be
//! checked from the scene alone ([`verify`](verify())). No ink here; that is what reports are for.

pub mod answer;
pub mod certificate;
pub mod critical;
pub mod kinematic;
pub mod member;
pub mod moving;
pub mod packing;
mod part;
pub mod path;
pub mod read;
pub mod recompute;
pub mod result;
pub mod rocking;
pub mod shaken;
pub mod simulation;
pub mod stages;
pub mod state;
pub mod thrust;
pub mod verification;
pub mod verify;
pub mod work;

pub use answer::Answer;
pub use packing::PackingFile;
pub use result::ResultFile;
pub use simulation::Simulation;
pub use verification::VerificationFile;
pub use verify::verify;
