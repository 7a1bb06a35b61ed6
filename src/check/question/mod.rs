//! What can be asked: one type for verbs, plans, result files and the library, checked where it is
//! made ([`Question::check`]). What a question says of itself stands with its options, in a file of
//! its own; here they are listed.

mod asked;
mod assess;
mod combinations;
mod control;
mod critical;
mod directions;
mod in_time;
mod kinematic;
mod limit;
mod meet;
mod moving;
mod push;
mod repose;
mod settle;
mod simulate;
mod stages;
mod state;
mod thrust;
mod tilt;
mod without;

pub use asked::{Asked, Idle};
pub use assess::AssessOptions;
pub use combinations::CombinationsOptions;
pub(crate) use combinations::is_the_same;
pub use control::ControlPoint;
pub use critical::{CriticalOptions, SCAN, WHOLE};
pub use directions::{DIRECTIONS, directions, spread};
pub use kinematic::{CONFIDENCE, KinematicOptions, Verification};
pub use limit::LimitOptions;
pub use meet::MeetOptions;
pub use moving::MovingOptions;
pub use push::PushOptions;
pub use repose::ReposeOptions;
pub use settle::{SettleOptions, SupportMove};
pub use simulate::SimulateOptions;
pub use stages::{MOST_TRIES, StagesOptions};
pub use state::StateOptions;
pub use thrust::ThrustOptions;
pub use tilt::TiltOptions;
pub use without::WithoutOptions;

use crate::{ground::ShakeOptions, rocking::RockOptions, terms::Law};
use base::error::{InputError, JsonPath};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Lists the questions: [`Question`], [`QuestionKind`], and what is asked of whichever it is.
macro_rules! questions {
    ($($(#[$doc:meta])+ $name:ident($options:ident) = $word:literal,)+) => {
        /// A question with its options.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(rename_all = "snake_case", deny_unknown_fields)]
        pub enum Question {
            $($(#[$doc])+ $name($options),)+
        }

        /// What is asked, without options.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum QuestionKind {
            $($(#[$doc])+ $name,)+
        }

        $(impl From<$options> for Question {
            fn from(options: $options) -> Self {
                Self::$name(options)
            }
        })+

        impl Question {
            /// What is asked, without options.
            pub fn kind(&self) -> QuestionKind {
                match self {
                    $(Self::$name(_) => QuestionKind::$name,)+
                }
            }

            /// As files and the command line call it.
            pub fn word(&self) -> &'static str {
                match self {
                    $(Self::$name(_) => $word,)+
                }
            }

            /// Refuses options that mean nothing, whatever the scene. Paths are relative to the
            /// question.
            ///
            /// # Errors
            /// The first option that means nothing, with its place.
            pub fn check(&self) -> Result<(), InputError> {
                let path = JsonPath::root().key(self.word());
                match self {
                    $(Self::$name(o) => Asked::check(o, &path),)+
                }
            }

            /// How joints slide.
            pub fn law(&self) -> Law {
                match self {
                    $(Self::$name(o) => o.law(),)+
                }
            }

            /// The same, where it can be chosen.
            pub fn law_mut(&mut self) -> Option<&mut Law> {
                match self {
                    $(Self::$name(o) => o.law_mut(),)+
                }
            }

            /// The value below which an answer counts as failure.
            pub fn require(&self) -> Option<f64> {
                match self {
                    $(Self::$name(o) => o.require(),)+
                }
            }

            /// Whether it is told how the value changes with what was assumed.
            pub fn sensitivity(&self) -> bool {
                match self {
                    $(Self::$name(o) => o.sensitivity(),)+
                }
            }

            /// What the value of an answer is, with its unit; nothing where the answer is a verdict.
            pub fn quantity(&self) -> Option<&'static str> {
                match self {
                    $(Self::$name(o) => o.quantity(),)+
                }
            }

            fn idle_in_rows(&self) -> Option<Idle> {
                match self {
                    $(Self::$name(o) => o.idle_in_rows(),)+
                }
            }

            /// The same without what one number cannot show: the verdict beside a load factor, the
            /// other end of a range.
            #[must_use]
            pub fn for_one_number(&self) -> Self {
                match self.clone() {
                    $(Self::$name(o) => Self::$name(o.for_one_number()),)+
                }
            }
        }
    };
}

questions! {
    /// Does it stand under its dead load?
    Assess(AssessOptions) = "assess",
    /// How large may the live load grow?
    Limit(LimitOptions) = "limit",
    /// How heavy may the train of the scene be that drives over it? Of its positions the least.
    Moving(MovingOptions) = "moving",
    /// At what tilt does it fall? In several directions the least.
    Tilt(TiltOptions) = "tilt",
    /// At what value of a number in the scene does the verdict flip?
    Critical(CriticalOptions) = "critical",
    /// Least or greatest thrust on a support, or force in a member.
    Thrust(ThrustOptions) = "thrust",
    /// The angle of maximum stability of a packing of grains; in several directions the least.
    Repose(ReposeOptions) = "repose",
    /// Does it stand in time, by the rigid-body engine? A second opinion, not a proof.
    Simulate(SimulateOptions) = "simulate",
    /// How far may supports move until it falls?
    Settle(SettleOptions) = "settle",
    /// How does the load factor fall as it moves?
    Push(PushOptions) = "push",
    /// Does every stage of its construction stand, and how safely?
    Stages(StagesOptions) = "stages",
    /// Which single blocks may be taken out with everything left standing?
    Without(WithoutOptions) = "without",
    /// At what acceleration does a mechanism start under an earthquake, and how does its resistance
    /// fall as it moves? In several directions the least.
    Kinematic(KinematicOptions) = "kinematic",
    /// What forces and displacements follow from the stiffness of its joints, under its dead load and
    /// along its live load? Forces and laws are checked; that it goes there is computed.
    State(StateOptions) = "state",
    /// What does its mechanism do on ground that moves? Computed from where it starts, which is
    /// proved.
    Rock(RockOptions) = "rock",
    /// What do all its blocks do on ground that moves, by the rigid-body engine? Not a proof.
    Shake(ShakeOptions) = "shake",
    /// What is the answer to a question in every combination of actions?
    Combinations(CombinationsOptions) = "combinations",
    /// At what value of a number in the scene is what is required of a question met?
    Meet(MeetOptions) = "meet",
}

impl Question {
    /// Refuses options without any effect where the answer is one number, as in rows of a sweep.
    /// Paths are relative to the question.
    ///
    /// # Errors
    /// The first such option, with its place.
    pub fn check_for_one_number(&self) -> Result<(), InputError> {
        let Some((key, hint)) = self.idle_in_rows() else { return Ok(()) };
        let path = JsonPath::root().key(self.word()).key(key);
        Err(InputError::at(path, "has no effect in the rows of a sweep").hint(hint))
    }
}
