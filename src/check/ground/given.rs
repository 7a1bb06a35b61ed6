//! How the ground moves, as questions, plans and results say it.

use super::{Motion, Pulse, Record, motion::lines};
use base::error::{InputError, JsonPath};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use std::fmt;

/// How the ground moves: by a pulse or by a record, times a scale; at rest where neither is given.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Given {
    /// A formula.
    pub pulse: Option<Formula>,
    /// A record: in a plan the name of its file, relative to the folder of the plan; in a result the
    /// record itself.
    pub record: Option<Recorded>,
    /// It is multiplied by this.
    pub scale: f64,
}

impl Default for Given {
    fn default() -> Self {
        Self { pulse: None, record: None, scale: 1.0 }
    }
}

/// A pulse by its numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Formula {
    /// A constant acceleration.
    Rectangle {
        /// m/s².
        acceleration: f64,
        /// s.
        duration: f64,
    },
    /// Half a sine.
    HalfSine(Wave),
    /// A full sine.
    Sine(Wave),
    /// A jump of the velocity of the ground at the start.
    Jump {
        /// m/s.
        velocity: f64,
    },
    /// A jump at the start, and the opposite one just after the first landing.
    DoubleJump {
        /// m/s.
        velocity: f64,
    },
}

/// A sine or half of one: by its duration or by its frequency.
#[skip_serializing_none]
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Wave {
    /// m/s².
    pub acceleration: f64,
    /// s.
    pub duration: Option<f64>,
    /// Of the full sine, Hz.
    pub frequency: Option<f64>,
}

impl Wave {
    /// The duration of this part of a sine, s.
    fn duration(&self, part: f64) -> Result<f64, String> {
        match (self.duration, self.frequency) {
            (Some(duration), None) => Ok(duration),
            (None, Some(frequency)) => Ok(part / frequency),
            _ => Err("a sine needs either \"duration\" (s) or \"frequency\" (Hz)".into()),
        }
    }
}

impl Formula {
    /// The pulse.
    ///
    /// # Errors
    /// Its numbers are not finite, or it does not last.
    pub fn pulse(&self) -> Result<Pulse, String> {
        let pulse = match *self {
            Self::Rectangle { acceleration, duration } => {
                Pulse::Rectangle { acceleration, duration }
            }
            Self::HalfSine(w) => {
                Pulse::HalfSine { acceleration: w.acceleration, duration: w.duration(0.5)? }
            }
            Self::Sine(w) => {
                Pulse::Sine { acceleration: w.acceleration, duration: w.duration(1.0)? }
            }
            Self::Jump { velocity } => Pulse::Jump { velocity },
            Self::DoubleJump { velocity } => Pulse::DoubleJump { velocity },
        };
        match pulse {
            Pulse::Rectangle { acceleration, duration }
            | Pulse::HalfSine { acceleration, duration }
            | Pulse::Sine { acceleration, duration } => {
                if !(duration > 0.0 && duration.is_finite() && acceleration.is_finite()) {
                    return Err("a pulse must be finite and last longer than 0 s".into());
                }
            }
            Pulse::Jump { velocity } | Pulse::DoubleJump { velocity } => {
                if !velocity.is_finite() {
                    return Err("a velocity jump must be finite".into());
                }
            }
        }
        Ok(pulse)
    }
}

/// As `--pulse` takes it.
impl fmt::Display for Formula {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.pulse() {
            Ok(Pulse::Rectangle { acceleration, duration }) => {
                write!(f, "rectangle:{acceleration},{duration}")
            }
            Ok(Pulse::HalfSine { acceleration, duration }) => {
                write!(f, "half-sine:{acceleration},{duration}")
            }
            Ok(Pulse::Sine { acceleration, duration }) => {
                write!(f, "sine:{acceleration},{duration}")
            }
            Ok(Pulse::Jump { velocity }) => write!(f, "jump:{velocity}"),
            Ok(Pulse::DoubleJump { velocity }) => write!(f, "double-jump:{velocity}"),
            Err(e) => f.write_str(&e),
        }
    }
}

impl From<Pulse> for Formula {
    fn from(pulse: Pulse) -> Self {
        let wave = |acceleration, duration| Wave {
            acceleration,
            duration: Some(duration),
            frequency: None,
        };
        match pulse {
            Pulse::Rectangle { acceleration, duration } => {
                Self::Rectangle { acceleration, duration }
            }
            Pulse::HalfSine { acceleration, duration } => {
                Self::HalfSine(wave(acceleration, duration))
            }
            Pulse::Sine { acceleration, duration } => Self::Sine(wave(acceleration, duration)),
            Pulse::Jump { velocity } => Self::Jump { velocity },
            Pulse::DoubleJump { velocity } => Self::DoubleJump { velocity },
        }
    }
}

/// A record by name, or itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum Recorded {
    /// The name of a file.
    Named(String),
    /// What was read.
    Read(Series),
}

/// Accelerations at even times, m/s².
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Series {
    /// The files, as they were named.
    pub name: String,
    /// Time between two samples, s.
    pub step: f64,
    /// One to three components: along the direction asked about, to its left, up. Samples of each.
    pub components: Vec<Vec<f64>>,
}

impl Series {
    /// The record as it was read.
    pub fn of(record: &Record) -> Self {
        let component = |k: usize| record.samples.iter().map(|s| s[k]).collect();
        Self {
            name: record.name.clone(),
            step: record.step,
            components: (0..record.components).map(component).collect(),
        }
    }

    /// The motion of the ground, linear between samples.
    fn motion(&self) -> Result<Motion, String> {
        let count = self.components.first().map_or(0, Vec::len);
        let even = self.components.iter().all(|c| c.len() == count);
        if !(1..=3).contains(&self.components.len()) || count < 2 || !even {
            return Err(format!(
                "{}: a record needs one to three components with the same number of samples, at least two",
                self.name
            ));
        }
        let finite = self.components.iter().flatten().all(|v| v.is_finite());
        let has_step = self.step > 0.0 && self.step.is_finite();
        if !finite || !has_step {
            return Err(format!("{}: a number of the record is not finite", self.name));
        }
        let at = |i: usize| {
            Vector3::from_fn(|k, _| self.components.get(k).map_or(0.0, |component| component[i]))
        };
        Ok(lines(self.step, &(0..count).map(at).collect::<Vec<_>>()))
    }
}

impl Given {
    /// Whether the ground moves at all.
    pub fn moves(&self) -> bool {
        self.pulse.is_some() || self.record.is_some()
    }

    /// Refuses what means nothing; a record that is only named is not looked into.
    ///
    /// # Errors
    /// As [`Self::unscaled`].
    pub fn check(&self) -> Result<(), InputError> {
        match (&self.pulse, &self.record) {
            (None, Some(Recorded::Named(_))) => Ok(()),
            _ => self.unscaled().map(drop),
        }
    }

    /// The motion as its formula or record has it, without the scale.
    ///
    /// # Errors
    /// Two motions are given, one that means nothing, or a record that nobody has read.
    pub fn unscaled(&self) -> Result<Motion, InputError> {
        let at = |key: &str, text: String| InputError::at(JsonPath::root().key(key), text);
        if !self.scale.is_finite() {
            return Err(at("scale", "must be finite".into()));
        }
        match (&self.pulse, &self.record) {
            (None, None) => Ok(Motion::default()),
            (Some(_), Some(_)) => Err(at("record", "a pulse and a record are both given".into())),
            (Some(formula), None) => {
                formula.pulse().map(|p| p.motion()).map_err(|e| at("pulse", e))
            }
            (None, Some(Recorded::Read(series))) => series.motion().map_err(|e| at("record", e)),
            (None, Some(Recorded::Named(name))) => {
                Err(at("record", format!("the record {name} was not read"))
                    .hint("give the samples themselves: only sweep plans may name files"))
            }
        }
    }

    /// The motion.
    ///
    /// # Errors
    /// As [`Self::unscaled`].
    pub fn motion(&self) -> Result<Motion, InputError> {
        Ok(self.unscaled()?.scaled(self.scale))
    }
}
