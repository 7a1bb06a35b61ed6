//! How a value changes with a number for which forces or mechanisms leave that open: asked again with
//! the number a little less and a little more.
//!
//! Beside a bend the load factor is smooth, and its derivative there, that of the Lagrangian at the
//! forces and rates found there, differs from that at the bend by no more than the step. With dry
//! friction that slides there is no Lagrangian: the values themselves are compared.

use super::{
    Answer, Control, KinematicOptions, Law, LimitOptions, LoadFactor, Question, TiltOptions, ask,
    ladder::side_by_side,
    limit::{self, Formulation},
};
use check::{
    sensitivity::{Number, Proof, Target, Under, Varied},
    terms::{Origin, Sensitivity, Sided},
};
use cholesky::parallel;
use model::{
    interface::{Model, prepare},
    strength::laws::are_dry,
};
use scene::Scene;
use solve::program::Unknowns;

/// Numbers that are asked again at most, those that matter most. More: much more time than the answer
/// itself takes.
const AGAIN: usize = 5;
/// A number is changed by this × its scale. Larger: what bends elsewhere is met. Smaller: solvers do
/// not tell the two sides apart.
const STEP: f64 = 1e-5;
/// The same with dry friction, whose values are known to 1e-5.
const STEP_DRY: f64 = 1e-2;
/// A number of zero is changed by so many of its units × the same.
const FROM_ZERO: f64 = 1.0;

/// Numbers of an answer that have to be asked again, those that matter most first.
pub(super) fn open(found: &Sensitivity) -> Vec<&str> {
    let open = found.numbers.iter().filter(|d| d.origin == Origin::NotAsked);
    open.take(AGAIN).map(|d| d.pointer.as_str()).collect()
}

/// How a value changes with these numbers, on both sides; what time does not allow is left out.
pub(super) fn sided(
    question: &Question,
    (scene, model): (&Scene, &Model),
    target: &Target,
    pointers: &[&str],
    control: &Control,
) -> Vec<Sided> {
    let Ok(varied) = Varied::new(scene, model, target.under) else { return Vec::new() };
    let (all, _) = varied.numbers();
    let Some(question) = beside(question, target) else { return Vec::new() };
    let again = Again { question, varied: &varied, target, control };
    let known = |pointer: &&str| all.iter().find(|n| n.pointer == **pointer);
    let list: Vec<&Number> = pointers.iter().filter_map(known).collect();
    let both = |number: &&Number| {
        let [left, right] = [-1.0, 1.0].map(|sign| again.slope(number, sign));
        let sided = Sided { pointer: number.pointer.clone(), left, right };
        (!control.deadline.is_over()).then_some(sided)
    };
    let done = parallel::map(0, &list, both);
    done.unwrap_or_default().into_iter().flatten().collect()
}

/// The same question about its value alone, in its one direction.
fn beside(question: &Question, target: &Target) -> Option<Question> {
    let law = if target.dry.is_some() { Law::Coulomb } else { Law::Associative };
    let skip_dead = law == Law::Associative;
    let toward = match target.under {
        Under::Load => Vec::new(),
        Under::Tilt(d) | Under::Quake(d) => vec![d.into()],
    };
    Some(match question {
        Question::Limit(_) => LimitOptions { law, skip_dead, ..LimitOptions::default() }.into(),
        Question::Tilt(_) => {
            TiltOptions { law, skip_dead, toward, ..TiltOptions::default() }.into()
        }
        Question::Kinematic(_) => {
            let linear = KinematicOptions { linear: true, ..KinematicOptions::default() };
            KinematicOptions { law, skip_dead, toward, ..linear }.into()
        }
        _ => return None,
    })
}

struct Again<'a> {
    question: Question,
    varied: &'a Varied<'a>,
    target: &'a Target,
    control: &'a Control,
}

impl Again<'_> {
    /// The derivative on one side of a number.
    fn slope(&self, number: &Number, sign: f64) -> Option<f64> {
        let step = if self.target.dry.is_some() { STEP_DRY } else { STEP };
        let zero = number.value == 0.0 && !number.place;
        let scale = if zero { FROM_ZERO } else { self.varied.scale(number) };
        let value = number.value + sign * step * scale;
        if value < 0.0 && !number.signed {
            return None;
        }
        let scene = self.varied.scene_at(number, value).ok()?;
        let model = prepare(&scene).ok()?;
        let number = &Number { value, ..number.clone() };
        if self.target.dry.is_none()
            && let Some(slope) = self.at_once(&scene, &model, number)
        {
            return Some(slope);
        }
        let answer = ask(&self.question, &scene, &model, self.control).ok()?;
        if let Some(dry) = self.target.dry {
            let told = |v: f64| match self.target.under {
                Under::Tilt(_) => v.atan().to_degrees(),
                _ => v,
            };
            return Some((told(value_of(&answer)?) - told(dry)) / (sign * step * scale));
        }
        let (own, found) = bound(&answer, &model)?;
        self.slope_of((&scene, &model), (own, found), number)
    }

    /// The same from the first program, whose forces and rates need no proof here; nothing where it
    /// is large, or did not do.
    fn at_once(&self, scene: &Scene, model: &Model, number: &Number) -> Option<f64> {
        let turns = matches!(self.target.under, Under::Tilt(_)) && !are_dry(&model.interfaces);
        if turns || self.control.keep_all || side_by_side(model, self.control) {
            return None;
        }
        let own = self.target.under.of(scene, model, self.target.bound).ok()?;
        let found = limit::attempt(&own, &Formulation::usual(Unknowns::Rates));
        self.slope_of((scene, model), (&own, &found), number)
    }

    /// The derivative where forces and rates were found.
    fn slope_of(
        &self,
        (scene, model): (&Scene, &Model),
        (own, found): (&Model, &LoadFactor),
        number: &Number,
    ) -> Option<f64> {
        let lambda = found.found()?;
        let varied = Varied::new(scene, model, self.target.under).ok()?;
        let proof = Proof::new(own, &found.forces, &found.rates, lambda)?;
        Some(proof.slope(&varied, number)? * self.target.scale(lambda))
    }
}

/// The value with dry friction.
fn value_of(answer: &Answer) -> Option<f64> {
    match answer {
        Answer::Limit(l) => l.dry.as_ref()?.to_use(l.bound.found()),
        Answer::Tilt(t) => {
            let one = t.directions.first()?;
            one.dry.as_ref()?.load_factor.to_use(one.load_factor.found())
        }
        Answer::Kinematic(k) => {
            let one = k.directions.first()?;
            one.dry.as_ref()?.to_use(one.bound.found())
        }
        _ => None,
    }
}

/// The bound, and the model that it is about.
fn bound<'a>(answer: &'a Answer, model: &'a Model) -> Option<(&'a Model, &'a LoadFactor)> {
    match answer {
        Answer::Limit(l) => Some((model, &l.bound)),
        Answer::Tilt(t) => t.directions.first().map(|t| (&t.model, &*t.load_factor)),
        Answer::Kinematic(k) => k.directions.first().map(|d| (&d.quake.model, &*d.bound)),
        _ => None,
    }
}
