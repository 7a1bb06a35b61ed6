//! What an answer claims, for the check that knows no program ([`check::verify`]).

use super::{
    Assessment, LoadFactor, Outcome,
    assess::NO_STATE_NEEDED,
    coulomb::{DryLoadFactor, Found},
};
use crate::{
    interface::Model,
    verdict::{
        Forces, Verdict,
        check::{self, Claim},
    },
};

impl Assessment {
    /// What it claims; nothing where it is undecided.
    pub fn claim(&self) -> Option<Claim> {
        match self.verdict {
            Verdict::Stable => Some(Claim::Stable),
            Verdict::Unstable => Some(Claim::Unstable),
            Verdict::Conditional => Some(Claim::Conditional),
            Verdict::Undecided => None,
        }
    }

    /// Whether it counts as standing although the state under dry friction, which could deny it, was not asked.
    pub fn rests_on_statics(&self) -> bool {
        let forest = self.left_out.iter().any(|l| l.starts_with(NO_STATE_NEEDED));
        self.verdict == Verdict::Stable && self.state.is_none() && !forest
    }

    /// Of a conditional verdict: the forces without the pre-stress.
    pub fn base(&self) -> Option<&Forces> {
        self.state.as_ref().filter(|_| self.verdict == Verdict::Conditional).map(|s| &s.forces)
    }

    /// Whether what it claims is proved from the scene alone.
    pub fn proved(&self, model: &Model) -> bool {
        self.claim().is_some_and(|c| check::verify(model, &c, &self.forces, self.base(), &self.rates).proved())
    }
}

impl LoadFactor {
    /// What it claims; nothing where it is undecided.
    pub fn claim(&self) -> Option<Claim> {
        match self.outcome {
            Outcome::Found => Some(Claim::LoadFactor { value: self.value, lower: self.bracket.lower, upper: self.bracket.upper }),
            Outcome::Unbounded => self.base.as_ref().map(|(standing, _)| Claim::Unbounded { standing: *standing }),
            Outcome::Impossible => Some(Claim::Impossible),
            Outcome::Undecided => None,
        }
    }

    /// Whether what it claims is proved from the scene alone.
    pub fn proved(&self, model: &Model) -> bool {
        let base = self.base.as_ref().map(|b| &b.1);
        self.claim().is_some_and(|c| check::verify(model, &c, &self.forces, base, &self.rates).proved())
    }
}

impl DryLoadFactor {
    /// What it claims; nothing where there is no value.
    pub fn claim(&self) -> Option<Claim> {
        matches!(self.found, Found::NothingSlides | Found::FixedPoint).then_some(Claim::DryLoadFactor { value: self.value })
    }

    /// Whether what it claims is proved from the scene alone.
    pub fn proved(&self, model: &Model) -> bool {
        self.claim().is_some_and(|c| check::verify(model, &c, &self.forces, None, &self.rates).proved())
    }
}
