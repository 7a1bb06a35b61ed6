//! A session with the engine that the settings name; clarabel takes what is not made like a program
//! of contacts.

use super::{EngineSettings, Passed, Settings, Solution, clarabel, interior};
use crate::program::ConicProgram;

/// A program that is solved several times with changed right-hand sides and objectives.
pub enum Session {
    Clarabel(Box<clarabel::Session>),
    Interior(Box<interior::Session>),
}

impl Session {
    /// Sets a program up; `None` where the engine refuses it.
    pub fn new(program: &ConicProgram, settings: &Settings) -> Option<Self> {
        match settings.engine {
            EngineSettings::Clarabel { regularization, equilibrate } => {
                clarabel::Session::new(program, settings, regularization, equilibrate)
                    .map(|s| Self::Clarabel(Box::new(s)))
            }
            EngineSettings::Interior => match interior::Session::new(program, settings) {
                Some(s) => Some(Self::Interior(Box::new(s))),
                None => {
                    Self::new(program, &Settings { engine: EngineSettings::default(), ..*settings })
                }
            },
        }
    }

    /// Changes the right-hand side; false where the engine refuses it.
    pub fn set_rhs(&mut self, rhs: &[f64]) -> bool {
        match self {
            Self::Clarabel(s) => s.set_rhs(rhs),
            Self::Interior(s) => s.set_rhs(rhs),
        }
    }

    /// Changes the objective; false where the engine refuses it.
    pub fn set_objective(&mut self, objective: &[f64]) -> bool {
        match self {
            Self::Clarabel(s) => s.set_objective(objective),
            Self::Interior(s) => s.set_objective(objective),
        }
    }

    /// Lets the next solve begin near a point that a program alike passed; false where the engine has no
    /// use for it.
    pub fn begin_near(&mut self, passed: &Passed) -> bool {
        match self {
            Self::Clarabel(_) => false,
            Self::Interior(s) => s.begin_near(passed),
        }
    }

    /// Solves the program as it stands.
    pub fn solve(&mut self) -> Solution {
        match self {
            Self::Clarabel(s) => s.solve(),
            Self::Interior(s) => s.solve(),
        }
    }
}
