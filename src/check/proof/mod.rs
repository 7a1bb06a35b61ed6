//! Results as files: an answer is what follows from question, scene and evidence ([`derive`](derive())),
//! and a file is verified by deriving it again ([`verify`](verify())). No ink here; that is what
//! reports are for.

pub mod answer;
pub mod certificate;
pub mod combinations;
pub mod compare;
pub mod critical;
pub mod derive;
pub mod evidence;
pub mod kinematic;
pub mod meet;
pub mod member;
pub mod moving;
pub mod packing;
pub mod path;
pub mod read;
pub mod recompute;
pub mod result;
pub mod rocking;
mod sensitivity;
pub mod shaken;
pub mod simulation;
pub mod stages;
pub mod state;
pub mod thrust;
pub mod told;
pub mod verification;
pub mod verify;
pub mod without;
pub mod work;

pub use answer::Answer;
pub use derive::{Derived, Verification, derive};
pub use evidence::Evidence;
pub use packing::PackingFile;
pub use result::{ResultFile, Run, Saved};
pub use simulation::Simulation;
pub use verification::VerificationFile;
pub use verify::verify;
