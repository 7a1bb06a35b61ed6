//! What can be asked: one type for verbs, plans, result files and the library, checked where it is
//! made ([`Question::check`]).

mod critical;
mod directions;
mod settle;
mod stages;
mod state;

pub use critical::{SCAN, WHOLE};
pub use directions::{DIRECTIONS, directions, spread};
pub use settle::{SettleOptions, SupportMove};
pub use stages::{MOST_TRIES, StagesOptions};
pub use state::StateOptions;

use crate::{ground::ShakeOptions, path::saved::SavedPose, rocking::RockOptions, terms::Law};
use base::{
    error::{InputError, JsonPath},
    limits::SCANNED,
};
use directions::check_directions;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// A question with its options.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Question {
    /// Does it stand under its dead load?
    Assess(AssessOptions),
    /// How large may the live load grow?
    Limit(LimitOptions),
    /// How heavy may the train of the scene be that drives over it? Of its positions the least.
    Moving(MovingOptions),
    /// At what tilt does it fall? In several directions the least.
    Tilt(TiltOptions),
    /// At what value of a number in the scene does the verdict flip?
    Critical(CriticalOptions),
    /// Least or greatest thrust on a support, or force in a member.
    Thrust(ThrustOptions),
    /// The angle of maximum stability of a packing of grains; in several directions the least.
    Repose(ReposeOptions),
    /// Does it stand in time, by the rigid-body engine? A second opinion, not a proof.
    Simulate(SimulateOptions),
    /// How far may supports move until it falls?
    Settle(SettleOptions),
    /// How does the load factor fall as it moves?
    Push(PushOptions),
    /// Does every stage of its construction stand, and how safely?
    Stages(StagesOptions),
    /// At what acceleration does a mechanism start under an earthquake, and how does its resistance
    /// fall as it moves? In several directions the least.
    Kinematic(KinematicOptions),
    /// What forces and displacements follow from the stiffness of its joints, under its dead load and
    /// along its live load? Forces and laws are checked; that it goes there is computed.
    State(StateOptions),
    /// What does its mechanism do on ground that moves? Computed from where it starts, which is
    /// proved.
    Rock(RockOptions),
    /// What do all its blocks do on ground that moves, by the rigid-body engine? Not a proof.
    Shake(ShakeOptions),
}

/// What is asked, without options.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum QuestionKind {
    /// Does it stand?
    Assess,
    /// How large may the live load grow?
    Limit,
    /// How heavy may the train be that drives over it?
    Moving,
    /// At what tilt does it fall?
    Tilt,
    /// At what value of a number in the scene does the verdict flip?
    Critical,
    /// How hard does it push a support?
    Thrust,
    /// How steep may a packing be?
    Repose,
    /// What happens in time, and does it agree with the verdict?
    Simulate,
    /// How far may supports move until it falls?
    Settle,
    /// How does the load factor fall as it moves?
    Push,
    /// Under an earthquake: at what acceleration does it start to move, and what then?
    Kinematic,
    /// Does every stage of its construction stand?
    Stages,
    /// What follows from the stiffness of its joints?
    State,
    /// What does its mechanism do on ground that moves?
    Rock,
    /// What do all its blocks do on ground that moves?
    Shake,
}

/// Options of `assess`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AssessOptions {
    /// How joints slide.
    pub law: Law,
}

/// Options of `limit`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct LimitOptions {
    /// How joints slide.
    pub law: Law,
    /// A load factor below this counts as failure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub require: Option<f64>,
    /// Whether it stands under its dead load alone is not asked as well. Rows of a sweep never ask
    /// it: a plan has no such key.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub skip_dead: bool,
}

/// Options of `moving`: `limit` with a train, position by position.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct MovingOptions {
    /// How joints slide.
    pub law: Law,
    /// A load factor below this counts as failure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub require: Option<f64>,
    /// Whether it stands under its dead load alone is not asked as well. Rows of a sweep ask it with
    /// dry friction only: a plan has no such key.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub skip_dead: bool,
    /// With dry friction: the value at every position, and not at the others than the worst only that
    /// it is not less.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub every_value: bool,
}

/// Options of `tilt`.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct TiltOptions {
    /// How joints slide.
    pub law: Law,
    /// A tilt below this, in degrees, counts as failure.
    pub require: Option<f64>,
    /// Tip towards these directions.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub toward: Vec<[f64; 3]>,
    /// Tip towards this many directions, evenly spread, the first along x; 8 where nothing is said.
    pub all: Option<u16>,
    /// Whether it stands level is not asked as well. Rows of a sweep ask it with dry friction only: a
    /// plan has no such key.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub skip_dead: bool,
}

/// Options of `critical`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CriticalOptions {
    /// How joints slide.
    #[serde(default)]
    pub law: Law,
    /// JSON pointer of the number that varies.
    pub vary: String,
    /// Both ends of the range.
    pub between: [f64; 2],
    /// Values scanned, both ends among them: 33 where nothing is said, or every whole number up to
    /// 1000 of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scan: Option<usize>,
}

/// Options of `thrust`.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ThrustOptions {
    /// Whether there must be forces only, or such as the loads produce.
    pub law: Law,
    /// The support; the first that touches a free block where nothing is said.
    pub support: Option<String>,
    /// Direction of the thrust, outwards where nothing is said; of a dowel's shear.
    pub direction: Option<[f64; 3]>,
    /// The force in this member in place of a thrust.
    pub member: Option<String>,
    /// The greatest thrust instead of the least.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub greatest: bool,
    /// Both ends, and the geometric safety factor. Rows of a sweep ask one end only: a plan has no
    /// such key.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub range: bool,
}

/// Options of `repose`.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ReposeOptions {
    /// How grains slide.
    pub law: Law,
    /// An angle below this, in degrees, counts as failure.
    pub require: Option<f64>,
    /// Tip towards these directions.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub toward: Vec<[f64; 3]>,
    /// Tip towards this many directions, evenly spread, the first along x; 8 where nothing is said.
    pub all: Option<u16>,
    /// The share of the grains' mass that has to move; 0, the first grain, where nothing is said.
    pub moving_mass: f64,
}

/// Options of `simulate`.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SimulateOptions {
    /// Fast steps only: to be trusted 3 % away from a limit.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub fast: bool,
    /// Fine steps from the start.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub fine: bool,
    /// Time to simulate at most, s.
    pub seconds: Option<f64>,
    /// Simulate until then although the outcome is clear.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub to_the_end: bool,
    /// This factor × the live loads is added.
    pub load_factor: Option<f64>,
}

/// Options of `push`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PushOptions {
    /// The point whose way is the parameter, m.
    pub control: ControlPoint,
    /// The direction in which its way is measured.
    pub toward: [f64; 3],
    /// Values of the parameter that become the points of the curve, beside its start, its events and
    /// its end, m; empty: where it bends.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub at: Vec<f64>,
    /// Poses to begin at, as a result of the same scene has them; empty: the start.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub from: Vec<SavedPose>,
}

/// Options of `kinematic`.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct KinematicOptions {
    /// How joints slide.
    pub law: Law,
    /// A load factor α0 below this counts as failure.
    pub require: Option<f64>,
    /// Earthquakes towards these directions.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub toward: Vec<[f64; 3]>,
    /// Earthquakes towards this many directions, evenly spread, the first along x; 8 where nothing is
    /// said.
    pub all: Option<u16>,
    /// The point whose way measures the motion; where nothing is said the centre of mass of the block
    /// next to the centre of all masses that move.
    pub control: Option<ControlPoint>,
    /// Factor of confidence; 1.35 where nothing is said.
    pub fc: Option<f64>,
    /// Ways of the control point that become points of the curve, beside others, m.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub at: Vec<f64>,
    /// The linear analysis alone, without a curve. Rows of a sweep ask nothing else: a plan has no
    /// such key.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub linear: bool,
    /// Whether it stands under its dead load alone is not asked as well. Rows of a sweep ask it with
    /// dry friction only: a plan has no such key.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub skip_dead: bool,
}

/// A point of a block.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ControlPoint {
    /// The block.
    pub block: String,
    /// Where it is at the start, m.
    pub point: [f64; 3],
}

impl Question {
    /// Refuses options that mean nothing, whatever the scene. Paths are relative to the question.
    ///
    /// # Errors
    /// The first option that means nothing, with its place.
    pub fn check(&self) -> Result<(), InputError> {
        let path = JsonPath::root().key(self.word());
        let refuse = |key: &str, text: String| Err(InputError::at(path.key(key), text));
        match self {
            Self::Thrust(o) if o.member.is_some() && o.support.is_some() => {
                refuse("member", "a member and a support are both given".into())
            }
            Self::Assess(_) | Self::Limit(_) | Self::Moving(_) | Self::Thrust(_) => Ok(()),
            Self::Tilt(o) => check_directions(&path, &o.toward, o.all),
            Self::Repose(o) if !(0.0..=1.0).contains(&o.moving_mass) => {
                refuse("moving_mass", format!("must be a share from 0 to 1, got {}", o.moving_mass))
            }
            Self::Repose(o) => check_directions(&path, &o.toward, o.all),
            Self::Critical(o) if o.between[0] == o.between[1] => {
                refuse("between", "the range is empty".into())
            }
            Self::Critical(o) if o.scan.is_some_and(|n| !(2..=SCANNED).contains(&n)) => {
                let text = format!("must be from 2, both ends of the range, to {SCANNED}");
                refuse("scan", text)
            }
            Self::Critical(_) => Ok(()),
            Self::Simulate(o) if o.fast && o.fine => {
                refuse("fine", "\"fast\" and \"fine\" are both given".into())
            }
            Self::Simulate(o) if o.seconds.is_some_and(|s| s.is_nan() || s <= 0.0) => {
                refuse("seconds", "must be > 0".into())
            }
            Self::Simulate(_) => Ok(()),
            Self::Settle(o) => o.check(&path),
            Self::Push(o) if !Vector3::from(o.toward).normalize().iter().all(|v| v.is_finite()) => {
                refuse("toward", "the direction has no length".into())
            }
            Self::Push(o) if o.at.iter().any(|v| !(*v >= 0.0 && v.is_finite())) => {
                refuse("at", "must be ways from 0 on".into())
            }
            Self::Push(_) => Ok(()),
            Self::Stages(o) => o.check(&path),
            Self::Kinematic(o) if o.fc.is_some_and(|f| !(f >= 1.0 && f.is_finite())) => refuse(
                "fc",
                format!("a factor of confidence is at least 1, got {}", o.fc.unwrap_or(f64::NAN)),
            ),
            Self::Kinematic(o) if o.at.iter().any(|v| !(*v >= 0.0 && v.is_finite())) => {
                refuse("at", "must be ways from 0 on".into())
            }
            Self::Kinematic(o) if o.linear && !o.at.is_empty() => {
                refuse("at", "the linear analysis has no curve".into())
            }
            Self::Kinematic(o) => check_directions(&path, &o.toward, o.all),
            Self::State(o) if o.at.iter().any(|v| !(*v > 0.0 && v.is_finite())) => {
                refuse("at", "must be load factors above 0".into())
            }
            Self::State(o) if o.dead_only && (!o.at.is_empty() || o.control.is_some()) => {
                refuse("dead_only", "without a live load there is no curve".into())
            }
            Self::State(_) => Ok(()),
            Self::Rock(o) => o.check().map_err(|e| e.under(&path)),
            Self::Shake(o) => o.check().map_err(|e| e.under(&path)),
        }
    }

    /// Refuses options without any effect where the answer is one number, as in rows of a sweep.
    /// Paths are relative to the question.
    ///
    /// # Errors
    /// The first such option, with its place.
    pub fn check_for_one_number(&self) -> Result<(), InputError> {
        let (key, hint) = match self {
            Self::Limit(LimitOptions { skip_dead: true, .. }) => {
                ("skip_dead", "remove it: rows never ask for the verdict without the live load")
            }
            Self::Moving(MovingOptions { skip_dead: true, .. }) => (
                "skip_dead",
                "remove it: rows ask for the verdict without the train where dry friction needs it, and nowhere else",
            ),
            Self::Tilt(TiltOptions { skip_dead: true, .. }) => (
                "skip_dead",
                "remove it: rows ask for the verdict when level where dry friction needs it, and nowhere else",
            ),
            Self::Thrust(ThrustOptions { range: true, .. }) => (
                "range",
                "remove it: a row has one number, the least thrust or with \"greatest\": true the greatest; two plans give both",
            ),
            Self::Kinematic(KinematicOptions { skip_dead: true, .. }) => (
                "skip_dead",
                "remove it: rows ask for the verdict without an earthquake where dry friction needs it, and nowhere else",
            ),
            Self::Stages(StagesOptions { skip_margin: true, .. }) => {
                ("skip_margin", "remove it: rows ask for no margins")
            }
            Self::Stages(StagesOptions { skip_held: true, .. }) => {
                ("skip_held", "remove it: rows ask for no forces on what is held")
            }
            Self::Stages(o) if o.all.is_some() || !o.toward.is_empty() => {
                (if o.all.is_some() { "all" } else { "toward" }, "remove it: rows ask for no tilts")
            }
            Self::Kinematic(KinematicOptions { linear: true, .. }) => {
                ("linear", "remove it: rows show α0, and ask for no curve")
            }
            Self::Kinematic(o) if !o.at.is_empty() => ("at", "remove it: rows ask for no curve"),
            Self::Rock(RockOptions { fate_only: true, .. }) => {
                ("fate_only", "remove it: rows end by themselves once their fate is known")
            }
            Self::State(o) if !o.at.is_empty() => ("at", "remove it: rows show no curve"),
            Self::State(StateOptions { control: Some(_), .. }) => {
                ("control", "remove it: rows show no curve")
            }
            _ => return Ok(()),
        };
        let path = JsonPath::root().key(self.word()).key(key);
        Err(InputError::at(path, "does nothing in rows of a sweep").hint(hint))
    }

    /// What is asked, without options.
    pub fn kind(&self) -> QuestionKind {
        match self {
            Self::Assess(_) => QuestionKind::Assess,
            Self::Limit(_) => QuestionKind::Limit,
            Self::Moving(_) => QuestionKind::Moving,
            Self::Tilt(_) => QuestionKind::Tilt,
            Self::Critical(_) => QuestionKind::Critical,
            Self::Thrust(_) => QuestionKind::Thrust,
            Self::Repose(_) => QuestionKind::Repose,
            Self::Simulate(_) => QuestionKind::Simulate,
            Self::Settle(_) => QuestionKind::Settle,
            Self::Push(_) => QuestionKind::Push,
            Self::Kinematic(_) => QuestionKind::Kinematic,
            Self::Stages(_) => QuestionKind::Stages,
            Self::State(_) => QuestionKind::State,
            Self::Rock(_) => QuestionKind::Rock,
            Self::Shake(_) => QuestionKind::Shake,
        }
    }

    /// As files and the command line call it.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Assess(_) => "assess",
            Self::Limit(_) => "limit",
            Self::Moving(_) => "moving",
            Self::Tilt(_) => "tilt",
            Self::Critical(_) => "critical",
            Self::Thrust(_) => "thrust",
            Self::Repose(_) => "repose",
            Self::Simulate(_) => "simulate",
            Self::Settle(_) => "settle",
            Self::Push(_) => "push",
            Self::Kinematic(_) => "kinematic",
            Self::Stages(_) => "stages",
            Self::Rock(_) => "rock",
            Self::Shake(_) => "shake",
            Self::State(_) => "state",
        }
    }

    /// How joints slide.
    pub fn law(&self) -> Law {
        match self {
            Self::Assess(o) => o.law,
            Self::Limit(o) => o.law,
            Self::Moving(o) => o.law,
            Self::Tilt(o) => o.law,
            Self::Critical(o) => o.law,
            Self::Thrust(o) => o.law,
            Self::Repose(o) => o.law,
            Self::Kinematic(o) => o.law,
            Self::Stages(o) => o.law,
            // What slides in time does not open.
            Self::Simulate(_) | Self::Shake(_) | Self::State(_) => Law::Coulomb,
            // Hinges alone are followed, which are the same for both.
            Self::Settle(_) | Self::Push(_) | Self::Rock(_) => Law::Associative,
        }
    }

    /// The value below which an answer counts as failure.
    pub fn require(&self) -> Option<f64> {
        match self {
            Self::Assess(_)
            | Self::Critical(_)
            | Self::Thrust(_)
            | Self::Simulate(_)
            | Self::Settle(_)
            | Self::Push(_)
            | Self::Stages(_)
            | Self::Rock(_)
            | Self::Shake(_) => None,
            Self::Limit(o) => o.require,
            Self::Moving(o) => o.require,
            Self::Tilt(o) => o.require,
            Self::Repose(o) => o.require,
            Self::Kinematic(o) => o.require,
            Self::State(o) => o.require,
        }
    }

    /// What the value of an answer is, with its unit; nothing where the answer is a verdict.
    pub fn quantity(&self) -> Option<&'static str> {
        match self {
            Self::Rock(RockOptions { scan: Some(_), .. }) => {
                Some("least scale at which it overturns")
            }
            Self::Assess(_) | Self::Simulate(_) | Self::Rock(_) | Self::Shake(_) => None,
            Self::Thrust(ThrustOptions { member: Some(_), greatest, .. }) => {
                Some(if *greatest { "greatest force in N" } else { "least force in N" })
            }
            Self::Thrust(o) => {
                Some(if o.greatest { "greatest thrust in N" } else { "least thrust in N" })
            }
            Self::Limit(_) => Some("load factor"),
            Self::Moving(_) => Some("least load factor of the train"),
            Self::Tilt(_) => Some("tilt in degrees"),
            Self::Critical(_) => Some("value at which the verdict flips"),
            Self::Repose(_) => Some("angle of maximum stability in degrees"),
            Self::Settle(_) => Some("share of the movement up to which it stands"),
            Self::Kinematic(_) => Some("α0"),
            Self::State(StateOptions { dead_only: true, .. }) => Some("greatest displacement in m"),
            Self::State(_) => Some("load factor of the path"),
            Self::Stages(o) if o.remove_each => Some("blocks that may be taken out"),
            Self::Stages(o) if o.has_order() => Some("blocks held at a time"),
            Self::Stages(_) => Some("stages that stand before the first that does not"),
            Self::Push(_) => Some("way of the control point up to which it resists in m"),
        }
    }

    /// The same without what one number cannot show: the verdict beside a load factor, the other
    /// end of a range.
    #[must_use]
    pub fn for_one_number(&self) -> Self {
        match self.clone() {
            Self::Limit(o) => Self::Limit(LimitOptions { skip_dead: true, ..o }),
            // With dry friction all positions share it.
            Self::Moving(o) => {
                Self::Moving(MovingOptions { skip_dead: o.law == Law::Associative, ..o })
            }
            // With dry friction all directions share it.
            Self::Tilt(o) => Self::Tilt(TiltOptions { skip_dead: o.law == Law::Associative, ..o }),
            Self::Thrust(o) => Self::Thrust(ThrustOptions { range: false, ..o }),
            Self::Kinematic(o) => Self::Kinematic(KinematicOptions {
                skip_dead: o.law == Law::Associative,
                linear: true,
                ..o
            }),
            Self::Stages(o) => {
                Self::Stages(StagesOptions { skip_margin: true, skip_held: true, ..o })
            }
            Self::Rock(o) => Self::Rock(RockOptions { fate_only: true, ..o }),
            other => other,
        }
    }
}
