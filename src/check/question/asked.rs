//! What every question says of itself, whatever the scene.

use crate::terms::Law;
use base::error::{InputError, JsonPath};

/// An option without any effect where the answer is one number, and what to do about it.
pub type Idle = (&'static str, &'static str);

/// A row holds one value.
pub(super) const IDLE_SENSITIVITY: Idle =
    ("sensitivity", "remove it: rows hold one value; let the numbers vary instead");

/// The options of a question.
pub trait Asked: Sized {
    /// Refuses options that mean nothing, whatever the scene; `path` is that of the question.
    ///
    /// # Errors
    /// The first option that means nothing, with its place.
    fn check(&self, _path: &JsonPath) -> Result<(), InputError> {
        Ok(())
    }

    /// How joints slide.
    fn law(&self) -> Law;

    /// The same, where it can be chosen.
    fn law_mut(&mut self) -> Option<&mut Law> {
        None
    }

    /// The value below which an answer counts as failure.
    fn require(&self) -> Option<f64> {
        None
    }

    /// Whether it is told how the value changes with what was assumed.
    fn sensitivity(&self) -> bool {
        false
    }

    /// What the value of an answer is, with its unit; nothing where the answer is a verdict.
    fn quantity(&self) -> Option<&'static str> {
        None
    }

    /// The first option without any effect in rows of a sweep, where the answer is one number.
    fn idle_in_rows(&self) -> Option<Idle> {
        None
    }

    /// The same without what one number cannot show: the verdict beside a load factor, the other
    /// end of a range.
    #[must_use]
    fn for_one_number(self) -> Self {
        self
    }
}

/// What is a field of the options: `law`, `require`, `sensitivity`.
macro_rules! chosen {
    (law) => {
        fn law(&self) -> Law {
            self.law
        }

        fn law_mut(&mut self) -> Option<&mut Law> {
            Some(&mut self.law)
        }
    };
    (require) => {
        fn require(&self) -> Option<f64> {
            self.require
        }
    };
    (sensitivity) => {
        fn sensitivity(&self) -> bool {
            self.sensitivity
        }
    };
    ($($field:ident),+) => {
        $(chosen!($field);)+
    };
}
pub(super) use chosen;
