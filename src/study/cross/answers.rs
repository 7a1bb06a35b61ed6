//! What a scene answers, as far as it is proved.

use crate::{
    analysis::{
        Control, Law, Outcome, assess,
        coulomb::{self, DryLoadFactor, Found},
        limit,
    },
    deadline::Deadline,
    interface::Model,
    verdict::Verdict,
};

/// A question may take so many seconds; more counts as undecided. More: two scenes in a hundred
/// take most of the time.
const SECONDS: f64 = 2.0;

/// How all questions are asked.
pub fn control() -> Control {
    Control { law: Law::Coulomb, deadline: Deadline::within(SECONDS), ..Control::default() }
}

/// The answers of a scene. What its certificate does not prove is undecided.
#[derive(Clone, Copy, Debug)]
pub struct Answers {
    /// Does it stand?
    pub verdict: Verdict,
    /// What became of the load factor.
    pub outcome: Outcome,
    /// The bound on the load factor, and the proved upper end of its bracket.
    pub bound: Option<[f64; 2]>,
    /// The load factor with dry friction.
    pub dry: Option<f64>,
    /// Whether it is without limit with dry friction as well.
    pub is_unlimited: bool,
}

/// The verdict of an assembly.
pub fn verdict(model: &Model) -> Verdict {
    assess(model, &control()).verdict
}

impl Answers {
    /// Asks a model.
    pub fn of(model: &Model) -> Self {
        let verdict = verdict(model);
        let bound = limit(model, &control());
        let outcome = bound.outcome;
        let has_limit = matches!(outcome, Outcome::Found | Outcome::Unbounded);
        let dry =
            has_limit.then(|| coulomb::load_factor_from(model, &bound, Some(verdict), &control()));
        // A value that is proved and up to which the state was seen to rest, or one that was seen
        // only.
        let is_known = |d: &DryLoadFactor| match d.found {
            Found::NothingSlides | Found::FixedPoint => d.is_reached(),
            Found::Rests => true,
            Found::Unlimited | Found::NotAtRest | Found::Undecided => false,
        };
        Self {
            verdict,
            outcome,
            bound: (outcome == Outcome::Found).then_some([bound.value, bound.bracket.upper]),
            dry: dry.as_ref().filter(|d| is_known(d)).map(|d| d.value),
            is_unlimited: dry.is_some_and(|d| d.found == Found::Unlimited),
        }
    }

    /// Whether two answers are the same to the last bit.
    pub fn is_same(&self, other: &Self) -> bool {
        let bits = |a: &Self| {
            (
                a.verdict,
                a.outcome,
                a.bound.map(|b| b.map(f64::to_bits)),
                a.dry.map(f64::to_bits),
                a.is_unlimited,
            )
        };
        bits(self) == bits(other)
    }
}
