//! Errors of the library as exceptions of the package.

use pyo3::prelude::*;
use voussoir::error::InputError;

/// Why there is no answer.
#[derive(Debug)]
pub enum Trouble {
    /// The scene, a plan or the question cannot be used as it is.
    Input(Box<InputError>),
    /// Time was over before there was anything to answer with.
    TimeIsUp(String),
    /// The system refuses, or the program failed.
    Other(String),
}

impl std::fmt::Display for Trouble {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Input(e) => e.fmt(f),
            Self::TimeIsUp(text) | Self::Other(text) => f.write_str(text),
        }
    }
}

impl From<InputError> for Trouble {
    fn from(error: InputError) -> Self {
        Self::Input(Box::new(error))
    }
}

impl Trouble {
    /// The same, of anything that only has words.
    pub fn other(error: impl std::fmt::Display) -> Self {
        Self::Other(error.to_string())
    }

    /// The exception of the package.
    pub fn raise(self, py: Python) -> PyErr {
        self.exception(py).unwrap_or_else(|e| e)
    }

    fn exception(self, py: Python) -> PyResult<PyErr> {
        let errors = py.import("voussoir._errors")?;
        let value = match self {
            Self::Input(e) => {
                let InputError { file, position, path, message, hint } = *e;
                let path = if path.0.is_empty() { String::new() } else { path.to_string() };
                let (line, column) = position.unzip();
                errors.getattr("InputError")?.call1((message, path, hint, file, line, column))?
            }
            Self::TimeIsUp(text) => errors.getattr("TimeIsUp")?.call1((text,))?,
            Self::Other(text) => errors.getattr("VoussoirError")?.call1((text,))?,
        };
        Ok(PyErr::from_value(value))
    }
}
