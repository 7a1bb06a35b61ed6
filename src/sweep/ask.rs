//! One question about one scene, its answer verified from the scene alone. A further question is a further arm of [`ask`].

use super::{Question, ReposeOptions, RowAnswer, RowStatus, SimulateOptions, ThrustOptions, TiltOptions};
use crate::{
    analysis::{
        Control, Law, LoadFactor, Outcome, assess,
        coulomb::{self, DryLoadFactor, Found},
        limit, stability,
        stability::held,
        thrust, tilt,
        tilt::{directions, tilted},
    },
    assembly::Wrench,
    dynamics::{self, Fate, Fidelity},
    error::{InputError, JsonPath},
    interface::{Model, prepare},
    scene::Scene,
    verdict::{
        Verdict,
        check::{Claim, verify},
        thrust::Extreme,
    },
};

/// Directions of a tilt where the plan does not say.
const DIRECTIONS: usize = 8;

/// Answers a question about a scene, prepared as `model`.
///
/// # Errors
/// The question has no meaning for this scene.
pub fn ask(question: &Question, scene: &Scene, model: &Model) -> Result<RowAnswer, InputError> {
    match question {
        Question::Assess(options) => Ok(assessed(model, &control(options.law))),
        Question::Limit(options) => limited(model, &control(options.law)),
        Question::Tilt(options) => least_tilt(options, model),
        Question::Thrust(options) => thrust_on(options, model),
        Question::Repose(options) => repose(options, scene, model),
        Question::Simulate(options) => simulated(options, scene, model),
    }
}

fn control(law: Law) -> Control {
    Control { law, ..Control::default() }
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// Does it stand under its dead load?
pub(super) fn assessed(model: &Model, control: &Control) -> RowAnswer {
    let a = assess(model, control);
    let status = match a.verdict {
        _ if !a.proved(model) => RowStatus::Undecided,
        Verdict::Stable => RowStatus::Stable,
        Verdict::Conditional => RowStatus::Conditional,
        Verdict::Unstable => RowStatus::Unstable,
        Verdict::Undecided => RowStatus::Undecided,
    };
    RowAnswer { lower: finite(a.unbalance.lower), upper: finite(a.unbalance.upper), ..RowAnswer::of(status) }
}

/// How large may the live load grow?
///
/// # Errors
/// There is no live load.
pub(super) fn limited(model: &Model, control: &Control) -> Result<RowAnswer, InputError> {
    let assembly = &model.assembly;
    if assembly.live.iter().all(|w| *w == Wrench::zero()) {
        let path = JsonPath::root().key("loads").key("live");
        return Err(InputError::at(path, "there is no live load on a free block to ask about").hint("give one, or ask \"tilt\""));
    }
    let bound = limit(model, control);
    let dry = (control.law == Law::Coulomb && bounds(bound.outcome)).then(|| coulomb::load_factor(model, &bound, control));
    Ok(combined(model, &bound, dry.as_ref().map(|d| (model, d)), |lambda| lambda))
}

fn bounds(outcome: Outcome) -> bool {
    matches!(outcome, Outcome::Found | Outcome::Unbounded)
}

/// The answer by the bound and, where it was asked for, the load factor with dry friction; values are read through `scale`.
fn combined(model: &Model, bound: &LoadFactor, dry: Option<(&Model, &DryLoadFactor)>, scale: fn(f64) -> f64) -> RowAnswer {
    let status = match bound.outcome {
        _ if !bound.proved(model) => RowStatus::Undecided,
        Outcome::Found => RowStatus::Found,
        Outcome::Unbounded => RowStatus::Unbounded,
        Outcome::Impossible => RowStatus::Impossible,
        Outcome::Undecided => RowStatus::Undecided,
    };
    let answer = RowAnswer {
        value: (status == RowStatus::Found).then(|| scale(bound.value)),
        lower: finite(bound.bracket.lower).map(scale),
        upper: finite(bound.bracket.upper).map(scale),
        ..RowAnswer::of(status)
    };
    let Some((model, dry)) = dry else { return answer };
    let proved = dry.proved(model);
    let claims = matches!(dry.found, Found::NothingSlides | Found::FixedPoint);
    let known = proved && coulomb::is_reached(dry.rests_at, dry.value);
    let found = if known || !claims { dry.found } else { Found::Undecided };
    match found {
        // The bound itself is the answer, with its bracket.
        Found::NothingSlides => RowAnswer { dry: Some(found), ..answer },
        Found::FixedPoint => RowAnswer { status: RowStatus::Found, value: Some(scale(dry.value)), lower: None, dry: Some(found), ..answer },
        Found::Unlimited => RowAnswer { dry: Some(found), ..answer },
        Found::Rests => RowAnswer {
            status: RowStatus::Found,
            value: Some(scale(dry.value)),
            lower: Some(scale(dry.rests_at)),
            dry: Some(found),
            ..answer
        },
        Found::NotAtRest => RowAnswer { dry: Some(found), ..RowAnswer::of(RowStatus::Conditional) },
        Found::Undecided => RowAnswer { status: RowStatus::Undecided, value: None, lower: None, dry: Some(found), ..answer },
    }
}

fn least_tilt(options: &TiltOptions, model: &Model) -> Result<RowAnswer, InputError> {
    let control = control(options.law);
    let toward = if options.toward.is_empty() {
        directions(model.assembly.gravity, options.all.map_or(DIRECTIONS, usize::from))
    } else {
        options.toward.iter().map(|&d| d.into()).collect()
    };
    let level = (control.law == Law::Coulomb).then(|| assess(model, &control).verdict);
    let mut least: Option<RowAnswer> = None;
    for direction in toward {
        let tilt = tilt(model, direction, &control)?;
        let turned = tilted(model, direction, tilt.load_factor.value)?;
        let dry = if control.law == Law::Coulomb && bounds(tilt.load_factor.outcome) {
            let dry = tilt::dry(model, &tilt, level, &control)?;
            Some((tilted(model, direction, dry.value)?, dry))
        } else {
            None
        };
        let degrees = |lambda: f64| lambda.atan().to_degrees();
        let answer = combined(&turned, &tilt.load_factor, dry.as_ref().map(|(m, d)| (m, d)), degrees);
        let answer = RowAnswer { toward: Some(tilt.toward.into()), ..answer };
        if least.as_ref().is_none_or(|least| height(&answer) < height(least)) {
            least = Some(answer);
        }
    }
    least.ok_or_else(|| InputError::at(JsonPath::root(), "no direction to tilt towards"))
}

/// Which direction governs: one without an answer must not hide behind the others.
fn height(answer: &RowAnswer) -> f64 {
    match answer.status {
        RowStatus::Unbounded => 90.0,
        _ => answer.value.unwrap_or(f64::NEG_INFINITY),
    }
}

/// Least or greatest thrust on a support, proved on both sides.
fn thrust_on(options: &ThrustOptions, model: &Model) -> Result<RowAnswer, InputError> {
    let at = thrust::place(model, options.support.as_deref(), options.direction)?;
    let control = control(options.law);
    let standing = assess(model, &control);
    if !matches!(standing.verdict, Verdict::Stable | Verdict::Conditional) {
        return Ok(assessed(model, &control));
    }
    let extreme = if options.greatest { Extreme::Greatest } else { Extreme::Least };
    let end = thrust::thrust(model, &at, extreme, &standing.forces, &control);
    let claim = match end.outcome {
        Outcome::Found => Some(Claim::Thrust { at, extreme, value: end.value, lower: end.bracket.lower, upper: end.bracket.upper }),
        Outcome::Unbounded => Some(Claim::EndlessThrust { at, extreme }),
        Outcome::Impossible | Outcome::Undecided => None,
    };
    let proved = claim.is_some_and(|c| verify(model, &c, &end.forces, end.base.as_ref(), &end.rates).proved());
    Ok(match end.outcome {
        Outcome::Found if proved => RowAnswer {
            value: Some(end.value),
            lower: finite(end.bracket.lower),
            upper: finite(end.bracket.upper),
            ..RowAnswer::of(RowStatus::Found)
        },
        Outcome::Unbounded if proved => RowAnswer::of(RowStatus::Unbounded),
        _ => RowAnswer::of(RowStatus::Undecided),
    })
}

/// The least angle of maximum stability of all directions; grains that nothing holds are left out.
fn repose(options: &ReposeOptions, scene: &Scene, model: &Model) -> Result<RowAnswer, InputError> {
    let control = control(options.law);
    let (scene, model, _) = held(scene, model.clone())?;
    let toward = if options.toward.is_empty() {
        directions(model.assembly.gravity, options.all.map_or(DIRECTIONS, usize::from))
    } else {
        options.toward.iter().map(|&d| d.into()).collect()
    };
    let mut least: Option<RowAnswer> = None;
    for direction in toward {
        let found = stability(&scene, &model, direction, options.moving_mass, &control)?;
        let Some(round) = found.rounds.get(found.answer) else { continue };
        let degrees = |lambda: f64| lambda.atan().to_degrees();
        let answer = combined(&round.model, &round.tilt.load_factor, round.dry.as_ref().map(|(m, d)| (m, d)), degrees);
        let answer = RowAnswer { toward: Some(round.tilt.toward.into()), ..answer };
        if least.as_ref().is_none_or(|least| height(&answer) < height(least)) {
            least = Some(answer);
        }
    }
    least.ok_or_else(|| InputError::at(JsonPath::root(), "no direction to tilt towards"))
}

/// What happens in time; always on one thread, the rows are what runs side by side.
fn simulated(options: &SimulateOptions, scene: &Scene, model: &Model) -> Result<RowAnswer, InputError> {
    // As the verb does it: in the scene, whose live loads may act off the centre of mass and turn with their blocks.
    let loaded = match options.load_factor {
        Some(factor) if factor != 0.0 => &prepare(&Scene { loads: scene.loads.fixed(factor), ..scene.clone() })?,
        _ => model,
    };
    let settings =
        dynamics::SimulationSettings { fidelity: options.fast.then_some(Fidelity::Fast), ..dynamics::SimulationSettings::default() };
    let outcome = dynamics::simulate(loaded, &settings, &mut |_| std::ops::ControlFlow::Continue(()))?;
    Ok(RowAnswer::of(match outcome.fate {
        Fate::Stands => RowStatus::Stable,
        Fate::Falls => RowStatus::Unstable,
        Fate::Undecided => RowStatus::Undecided,
    }))
}
