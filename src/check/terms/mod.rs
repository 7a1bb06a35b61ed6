//! The terms in which answers are given: plain values that stand in result files, below those who
//! find answers and those who check them.

mod agreement;
mod attempt;
mod bound;
mod bracket;
mod closed;
mod deciding;
mod doubt;
mod ends;
mod friction;
mod law;
mod method;
mod order;
mod outcome;
mod sensitivity;
mod simulation;

pub use agreement::{Agreement, ForceAgreement, agree};
pub use attempt::{Attempt, Engine, Status};
pub use bound::Bound;
pub use bracket::Bracket;
pub use closed::{Closed, ClosedAnswer, ClosedEnd, Difference, LeftOutContacts};
pub use deciding::Deciding;
pub use doubt::{Doubt, DoubtCause};
pub use friction::MANY;
pub use friction::{Found, StateMotion, StateStep, is_reached, resolution};
pub use law::Law;
pub use method::Method;
pub use order::Order;
pub use outcome::Outcome;
pub use sensitivity::{Changing, Derivative, Origin, Sensitivity, Sided};
pub use simulation::{Fate, Fidelity, Run, Stop};
