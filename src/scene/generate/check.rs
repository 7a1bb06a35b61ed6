//! Ranges of template parameters, each refusal with its place, the value and a remedy.

use super::MAX_BLOCKS;
use base::{
    error::{InputError, JsonPath},
    limits,
};

/// The place of a template (or a part of one) in errors.
pub struct TemplatePath(pub JsonPath);

impl TemplatePath {
    /// The template called `name`.
    pub fn template(name: &str) -> Self {
        Self(JsonPath::root().key(name))
    }

    /// An error at one of the fields.
    pub fn error(
        &self,
        field: &str,
        message: impl Into<String>,
        hint: impl Into<String>,
    ) -> InputError {
        InputError::at(self.0.key(field), message).hint(hint)
    }

    /// A length in m.
    pub fn length(&self, field: &str, value: f64) -> Result<(), InputError> {
        if value.is_finite() && value > 0.0 {
            return Ok(());
        }
        Err(self.error(field, format!("must be > 0, got {value}"), "a length in m"))
    }

    /// The three lengths of a box.
    pub fn size(&self, field: &str, size: [f64; 3]) -> Result<(), InputError> {
        match size.iter().position(|s| !(s.is_finite() && *s > 0.0)) {
            None => Ok(()),
            Some(k) => Err(InputError::at(
                self.0.key(field).index(k),
                format!("must be > 0, got {}", size[k]),
            )
            .hint("lengths of a block along x, y, z in m")),
        }
    }

    /// A finite number.
    pub fn finite(&self, field: &str, value: f64) -> Result<(), InputError> {
        if value.is_finite() {
            Ok(())
        } else {
            Err(self.error(field, format!("must be a finite number, got {value}"), "a number in m"))
        }
    }

    /// A count from `least` up.
    pub fn count(&self, field: &str, value: usize, least: usize) -> Result<(), InputError> {
        if value >= least {
            return Ok(());
        }
        Err(self.error(
            field,
            format!("must be at least {least}, got {value}"),
            "the number of pieces",
        ))
    }

    /// The number of blocks that a product of counts makes.
    pub fn total(&self, field: &str, factors: &[usize]) -> Result<(), InputError> {
        match factors.iter().try_fold(1_usize, |product, f| product.checked_mul(*f)) {
            Some(total) if total <= MAX_BLOCKS => limits::afford(
                &format!("a template of {total} blocks"),
                total as u64,
                limits::PER_BLOCK,
            )
            .map_err(|e| InputError { path: self.0.key(field), ..e }),
            _ => Err(self.error(
                field,
                format!(
                    "makes {} blocks, more than {MAX_BLOCKS}",
                    factors.iter().map(ToString::to_string).collect::<Vec<_>>().join(" × ")
                ),
                "give fewer, or several templates",
            )),
        }
    }
}
