//! Pulses with a formula.

use super::{Jump, Motion, Piece, Shape, When};
use nalgebra::Vector3;
use std::f64::consts::PI;

/// A pulse along the direction asked about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pulse {
    /// A constant acceleration.
    Rectangle {
        /// m/s².
        acceleration: f64,
        /// s.
        duration: f64,
    },
    /// Half a sine.
    HalfSine {
        /// m/s².
        acceleration: f64,
        /// s.
        duration: f64,
    },
    /// A full sine.
    Sine {
        /// m/s².
        acceleration: f64,
        /// s.
        duration: f64,
    },
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

/// How pulses are written.
pub const PULSES: &str =
    "rectangle:A,T, half-sine:A,T, sine:A,T (m/s², s), jump:V or double-jump:V (m/s)";

impl Pulse {
    /// The motion of the ground.
    pub fn motion(&self) -> Motion {
        let along = |a: f64| Vector3::new(a, 0.0, 0.0);
        let one = |end: f64, shape: Shape| Motion {
            pieces: vec![Piece { start: 0.0, end, shape }],
            jumps: Vec::new(),
        };
        let jump = |when: When, v: f64| Jump { when, by: along(v) };
        match *self {
            Self::Rectangle { acceleration, duration } => {
                one(duration, Shape::Line { from: along(acceleration), slope: Vector3::zeros() })
            }
            Self::HalfSine { acceleration, duration } => one(
                duration,
                Shape::Sine { amplitude: along(acceleration), omega: PI / duration, phase: 0.0 },
            ),
            Self::Sine { acceleration, duration } => one(
                duration,
                Shape::Sine {
                    amplitude: along(acceleration),
                    omega: 2.0 * PI / duration,
                    phase: 0.0,
                },
            ),
            Self::Jump { velocity } => {
                Motion { pieces: Vec::new(), jumps: vec![jump(When::At(0.0), velocity)] }
            }
            Self::DoubleJump { velocity } => Motion {
                pieces: Vec::new(),
                jumps: vec![jump(When::At(0.0), velocity), jump(When::FirstLanding, -velocity)],
            },
        }
    }
}

impl std::str::FromStr for Pulse {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let wrong = || format!("{text:?} is not a pulse; hint: {PULSES}");
        let (kind, numbers) = text.split_once(':').ok_or_else(wrong)?;
        let list = numbers
            .split(',')
            .map(|n| n.trim().parse::<f64>().ok().filter(|v| v.is_finite()))
            .collect::<Option<Vec<f64>>>()
            .ok_or_else(wrong)?;
        let pulse = match (kind.trim(), list.as_slice()) {
            ("rectangle", &[acceleration, duration]) => Self::Rectangle { acceleration, duration },
            ("half-sine", &[acceleration, duration]) => Self::HalfSine { acceleration, duration },
            ("sine", &[acceleration, duration]) => Self::Sine { acceleration, duration },
            ("jump", &[velocity]) => return Ok(Self::Jump { velocity }),
            ("double-jump", &[velocity]) => return Ok(Self::DoubleJump { velocity }),
            _ => return Err(wrong()),
        };
        if list[1] <= 0.0 {
            return Err(format!("{text:?}: a pulse must last longer than 0 s; hint: {PULSES}"));
        }
        Ok(pulse)
    }
}
