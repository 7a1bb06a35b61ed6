//! The only way to hold an answer: with the check of what it claims, on the scene and by nothing
//! that found it ([`check::verify`]). What the check refuses is taken back here and nowhere else.

use super::{
    Assessment, Bracket, LoadFactor, Outcome,
    assess::NO_STATE_NEEDED,
    coulomb::{DryLoadFactor, Found},
    thrust::ThrustEnd,
};
use check::verdict::{
    Evidence, Forces, Verdict,
    claim::{self, Claim, Findings},
    exact::Grade,
    thrust::{MemberAt, Sought},
};
use model::interface::Model;
use solve::clock::Instant;
use std::ops::Deref;

/// What claims something about a scene, with the evidence for it.
pub trait Claims {
    /// What is claimed; nothing where it is undecided.
    fn claim(&self) -> Option<Claim>;

    /// What proves it.
    fn evidence(&self) -> Evidence<'_>;

    /// Claims nothing any more: undecided. The evidence stays, for whoever wants to see what was
    /// refused.
    fn withdraw(&mut self);
}

/// An answer that was checked: what it says is proved from the scene, or it says that it is
/// undecided.
#[derive(Clone, Debug)]
pub struct Proved<T> {
    answer: T,
    claim: Option<Claim>,
    refused: Option<Claim>,
    findings: Findings,
    seconds: f64,
}

impl<T: Claims> Proved<T> {
    /// Checks an answer on the model that it is about, and takes it back where the check fails.
    pub fn new(model: &Model, mut answer: T) -> Self {
        let start = Instant::now();
        let claim = answer.claim();
        let findings =
            claim.map(|c| claim::verify(model, &c, answer.evidence())).unwrap_or_default();
        let refused = claim.filter(|_| !findings.proved());
        if refused.is_some() {
            answer.withdraw();
        }
        Self {
            answer,
            claim: claim.filter(|_| refused.is_none()),
            refused,
            findings,
            seconds: start.elapsed().as_secs_f64(),
        }
    }
}

/// Whether an answer is proved as it stands: a search goes on until one is.
pub(super) fn is_proved(model: &Model, answer: &impl Claims) -> bool {
    answer.claim().is_some_and(|c| claim::verify(model, &c, answer.evidence()).proved())
}

impl<T> Proved<T> {
    /// What is proved; nothing where the answer is undecided.
    pub fn claim(&self) -> Option<Claim> {
        self.claim
    }

    /// What was claimed and is not proved.
    pub fn refused(&self) -> Option<Claim> {
        self.refused
    }

    /// What the check found.
    pub fn findings(&self) -> &Findings {
        &self.findings
    }

    /// How exactly it is proved; nothing where nothing is.
    pub fn grade(&self) -> Option<Grade> {
        self.claim.map(|_| self.findings.grade)
    }

    /// Seconds that the check took.
    pub fn seconds(&self) -> f64 {
        self.seconds
    }
}

impl<T> Deref for Proved<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.answer
    }
}

impl Claims for Assessment {
    fn claim(&self) -> Option<Claim> {
        match self.verdict {
            Verdict::Stable => Some(Claim::Stable),
            Verdict::Unstable => Some(Claim::Unstable),
            Verdict::Conditional => Some(Claim::Conditional),
            Verdict::Undecided => None,
        }
    }

    fn evidence(&self) -> Evidence<'_> {
        Evidence { forces: &self.forces, base: self.base(), rates: &self.rates }
    }

    fn withdraw(&mut self) {
        self.verdict = Verdict::Undecided;
    }
}

impl Assessment {
    /// Whether it counts as standing although the state under dry friction, which could deny it,
    /// was not asked.
    pub fn rests_on_statics(&self) -> bool {
        let forest = self.left_out.iter().any(|l| l.starts_with(NO_STATE_NEEDED));
        self.verdict == Verdict::Stable && self.state.is_none() && !forest
    }

    /// Of a conditional verdict: the forces without the self-stress.
    fn base(&self) -> Option<&Forces> {
        self.state.as_ref().filter(|_| self.verdict == Verdict::Conditional).map(|s| &s.forces)
    }
}

impl Claims for LoadFactor {
    fn claim(&self) -> Option<Claim> {
        match self.outcome {
            Outcome::Found => {
                let Bracket { lower, upper } = self.bracket;
                self.value.map(|value| Claim::LoadFactor { value, lower, upper })
            }
            Outcome::Unbounded => {
                self.base.as_ref().map(|(standing, _)| Claim::Unbounded { standing: *standing })
            }
            Outcome::Impossible => Some(Claim::Impossible),
            Outcome::Undecided => None,
        }
    }

    fn evidence(&self) -> Evidence<'_> {
        Evidence {
            forces: &self.forces,
            base: self.base.as_ref().map(|b| &b.1),
            rates: &self.rates,
        }
    }

    fn withdraw(&mut self) {
        self.outcome = Outcome::Undecided;
    }
}

impl Claims for DryLoadFactor {
    /// What is seen of states is computed, not proved: it is no claim.
    fn claim(&self) -> Option<Claim> {
        matches!(self.found, Found::NothingSlides | Found::FixedPoint)
            .then_some(self.value)?
            .map(|value| Claim::DryLoadFactor { value })
    }

    fn evidence(&self) -> Evidence<'_> {
        Evidence::new(&self.forces, &self.rates)
    }

    fn withdraw(&mut self) {
        (self.found, self.value) = (Found::Undecided, None);
    }
}

impl Claims for ThrustEnd {
    fn claim(&self) -> Option<Claim> {
        let Self { at, extreme, value, .. } = *self;
        let Bracket { lower, upper } = self.bracket;
        match (self.outcome, at) {
            (Outcome::Found, Sought::Thrust(at)) => {
                value.map(|value| Claim::Thrust { at, extreme, value, lower, upper })
            }
            (Outcome::Found, Sought::Member(MemberAt { member, along })) => value
                .map(|value| Claim::MemberForce { member, along, extreme, value, lower, upper }),
            (Outcome::Unbounded, Sought::Thrust(at)) => Some(Claim::EndlessThrust { at, extreme }),
            (Outcome::Unbounded, Sought::Member(MemberAt { member, along })) => {
                Some(Claim::EndlessMemberForce { member, along, extreme })
            }
            (Outcome::Impossible | Outcome::Undecided, _) => None,
        }
    }

    fn evidence(&self) -> Evidence<'_> {
        Evidence { forces: &self.forces, base: self.base.as_ref(), rates: &self.rates }
    }

    fn withdraw(&mut self) {
        self.outcome = Outcome::Undecided;
    }
}
