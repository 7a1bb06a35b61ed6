//! What a scene answers, as far as it is proved.

use analysis::{
    Answer, AssessOptions, Control, Law, LimitOptions, Limited, Outcome, Question, ask,
    coulomb::{DryLoadFactor, Found},
};
use base::error::{InputError, JsonPath};
use check::verdict::Verdict;
use model::interface::Model;
use scene::Scene;
use solve::deadline::Deadline;

/// A question may take so many seconds, bound, verdict and dry friction together; more counts as
/// undecided. More: two scenes in a hundred take most of the time.
const SECONDS: f64 = 4.0;

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

/// The verdict of a scene; undecided where the question is refused.
pub fn verdict(scene: &Scene, model: &Model) -> Verdict {
    let question = Question::Assess(AssessOptions { law: Law::Coulomb });
    match ask(&question, scene, model, &control()) {
        Ok(Answer::Assess(answer)) => answer.verdict,
        _ => Verdict::Undecided,
    }
}

impl Answers {
    /// Asks a scene, prepared as `model`.
    ///
    /// # Errors
    /// The scene has no live load to ask about.
    pub fn of(scene: &Scene, model: &Model) -> Result<Self, InputError> {
        let question = Question::Limit(LimitOptions { law: Law::Coulomb, ..Default::default() });
        let Answer::Limit(answer) = ask(&question, scene, model, &control())? else {
            return Err(InputError::at(JsonPath::root(), "no load factor was answered"));
        };
        let Limited { bound, dry, dead } = *answer;
        // A value that is proved and up to which the state was seen to rest, or one that was seen
        // only.
        let is_known = |d: &DryLoadFactor| match d.found {
            Found::NothingSlides | Found::FixedPoint => d.is_reached(),
            Found::Rests | Found::RestsBelow => true,
            Found::Unlimited | Found::AtLeast | Found::NotAtRest | Found::Undecided => false,
        };
        Ok(Self {
            verdict: dead.map_or_else(|| verdict(scene, model), |d| d.verdict),
            outcome: bound.outcome,
            bound: bound.found().map(|value| [value, bound.bracket.upper]),
            dry: dry.as_ref().filter(|d| is_known(d)).and_then(|d| d.value),
            is_unlimited: dry.is_some_and(|d| d.found == Found::Unlimited),
        })
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
