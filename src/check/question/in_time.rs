//! What is asked of a scene on ground that moves; the options have modules of their own.

use super::asked::{Asked, Idle};
use crate::{ground::ShakeOptions, rocking::RockOptions, terms::Law};
use base::error::{InputError, JsonPath};

impl Asked for RockOptions {
    fn check(&self, path: &JsonPath) -> Result<(), InputError> {
        Self::check(self).map_err(|e| e.under(path))
    }

    /// Hinges alone are followed, which are the same for both.
    fn law(&self) -> Law {
        Law::Associative
    }

    fn quantity(&self) -> Option<&'static str> {
        self.scan.map(|_| "least scale at which it overturns")
    }

    fn idle_in_rows(&self) -> Option<Idle> {
        let hint = "remove it: a row ends once its outcome is known";
        self.fate_only.then_some(("fate_only", hint))
    }

    fn for_one_number(self) -> Self {
        Self { fate_only: true, ..self }
    }
}

impl Asked for ShakeOptions {
    fn check(&self, path: &JsonPath) -> Result<(), InputError> {
        Self::check(self).map_err(|e| e.under(path))
    }

    /// What slides in time does not open.
    fn law(&self) -> Law {
        Law::Coulomb
    }
}
