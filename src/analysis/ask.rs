//! The one door: every question goes through [`ask`], whoever asks it, and every answer that comes
//! out of it was checked on the scene ([`Proved`](super::Proved)). A further question is a further arm here, a
//! variant of [`Question`] and one of [`Answer`].

use super::{
    Control, Law, Outcome, Question,
    answer::{Answer, Limited, Tilted},
    assess, combinations, coulomb, critical,
    directions::Tilts,
    follow,
    follow::{
        answer::GoesOn,
        machine::{Built, MachineOptions, machine},
    },
    in_time::{self, Asked},
    kinematic,
    ladder::side_by_side,
    limit, meet,
    model_cache::{Keys, Reuse},
    moving,
    question::{
        CriticalOptions, LimitOptions, ReposeOptions, ThrustOptions, TiltOptions, directions,
    },
    rocking, stability, stages, state, thrust,
    thrust::Thrust,
    without,
};
use base::error::{InputError, JsonPath};
use cholesky::parallel::both;
use model::{assembly::Wrench, interface::Model};
use scene::Scene;
use std::sync::Arc;

/// Answers a question about a scene, prepared as `model`.
///
/// # Errors
/// The question has no meaning, or none for this scene, or this build has no part that answers it.
pub fn ask(
    question: &Question,
    scene: &Scene,
    model: &Model,
    control: &Control,
) -> Result<Answer, InputError> {
    let in_time = &mut |asked: &Asked| in_time::unwatched(asked, scene, model);
    let machine = &|o: &MachineOptions| Ok(Arc::new(machine(scene, model, o, control)?));
    answer(question, scene, model, control, Means { in_time, machine, path: None })
}

/// The same for one of many scenes; what it shares with others by its `keys` is computed once.
///
/// # Errors
/// As [`ask`].
pub fn ask_among(
    question: &Question,
    scene: &Scene,
    model: &Model,
    control: &Control,
    (reuse, keys): (&Reuse, &Keys),
) -> Result<Answer, InputError> {
    let in_time = &mut |asked: &Asked| in_time::unwatched(asked, scene, model);
    let machine =
        &|o: &MachineOptions| reuse.machine(keys, o, || machine(scene, model, o, control));
    answer(question, scene, model, control, Means { in_time, machine, path: None })
}

/// The same, of a path that goes on from where it was followed to before, with somebody who hears of
/// its points as they are found. Other questions are asked as they are.
///
/// # Errors
/// As [`ask`].
pub fn ask_on(
    question: &Question,
    scene: &Scene,
    model: &Model,
    control: &Control,
    path: GoesOn<'_>,
) -> Result<Answer, InputError> {
    let in_time = &mut |asked: &Asked| in_time::unwatched(asked, scene, model);
    let machine = &|o: &MachineOptions| Ok(Arc::new(machine(scene, model, o, control)?));
    answer(question, scene, model, control, Means { in_time, machine, path: Some(path) })
}

/// How the parts of an answer are made that somebody watches or others share.
struct Means<'a, 'b> {
    in_time: &'a mut dyn FnMut(&Asked) -> Result<Answer, InputError>,
    machine: &'a dyn Fn(&MachineOptions) -> Result<Arc<Built>, InputError>,
    path: Option<GoesOn<'b>>,
}

/// The same, with somebody who watches what happens in time.
///
/// # Errors
/// As [`ask`].
pub fn ask_watched(
    question: &Question,
    scene: &Scene,
    model: &Model,
    control: &Control,
    watch: in_time::Watch,
) -> Result<Answer, InputError> {
    let mut watch = Some(watch);
    let in_time = &mut |asked: &Asked| match watch.take() {
        Some(watch) => in_time::watched(asked, scene, model, watch),
        None => in_time::unwatched(asked, scene, model),
    };
    let machine = &|o: &MachineOptions| Ok(Arc::new(machine(scene, model, o, control)?));
    answer(question, scene, model, control, Means { in_time, machine, path: None })
}

fn answer(
    question: &Question,
    scene: &Scene,
    model: &Model,
    control: &Control,
    means: Means<'_, '_>,
) -> Result<Answer, InputError> {
    question.check()?;
    let control = &Control { law: question.law(), ..*control };
    Ok(match question {
        Question::Assess(_) => Answer::Assess(assess(model, control)),
        Question::Limit(options) => {
            Answer::Limit(Box::new(limited(options, scene, model, control)?))
        }
        Question::Moving(options) => {
            Answer::Moving(Box::new(moving::moving(options, scene, model, control)?))
        }
        Question::Tilt(options) => Answer::Tilt(tilted(options, model, control)?),
        Question::Critical(CriticalOptions { vary, between: [from, to], scan, .. }) => {
            let range =
                critical::Range { pointer: vary.clone(), from: *from, to: *to, scan: *scan };
            Answer::Critical(Box::new(critical(scene, &range, control)?))
        }
        Question::Thrust(options) => Answer::Thrust(Box::new(pushed(options, model, control)?)),
        Question::Repose(ReposeOptions { toward, all, moving_mass, .. }) => {
            let toward = directions(model.assembly.gravity, toward, *all);
            Answer::Repose(stability::packing(model, &toward, *moving_mass, control)?)
        }
        Question::Settle(options) => {
            Answer::Path(Box::new(follow::answer::settle(model, options, control, means.path)?))
        }
        Question::Push(options) => {
            // Where it slides it is followed under dry friction, whatever the points are proved by.
            let control = Control { law: Law::Coulomb, ..*control };
            Answer::Path(Box::new(follow::answer::push(model, options, &control, means.path)?))
        }
        Question::Kinematic(options) => {
            Answer::Kinematic(Box::new(kinematic::kinematic(options, scene, model, control)?))
        }
        Question::Stages(options) => {
            Answer::Stages(Box::new(stages::stages(options, scene, model, control, ask)?))
        }
        Question::Without(_) => Answer::Without(Box::new(without::without(scene, model, control)?)),
        Question::State(options) => Answer::State(Box::new(state::state(options, model, control)?)),
        Question::Rock(options) => Answer::Rock(Box::new(rocking::rock(options, means.machine)?)),
        Question::Simulate(options) => (means.in_time)(&Asked::Simulate(options))?,
        Question::Shake(options) => (means.in_time)(&Asked::Shake(options))?,
        Question::Combinations(options) => Answer::Combinations(Box::new(combinations::combined(
            options, scene, model, control, ask,
        )?)),
        Question::Meet(options) => {
            Answer::Meet(Box::new(meet::meet(options, scene, control, ask)?))
        }
    })
}

fn limited(
    options: &LimitOptions,
    scene: &Scene,
    model: &Model,
    control: &Control,
) -> Result<Limited, InputError> {
    if model.assembly.live.iter().all(|w| *w == Wrench::zero()) {
        let path = JsonPath::root().key("loads").key("live");
        let error = InputError::at(path, "the scene has no live load on a free block");
        if scene.train.is_some() {
            return Err(error.hint("for the train of the scene use `limit` with --moving"));
        }
        return Err(error
            .hint("add \"loads\": { \"live\": [ { \"weight\": [1, 0, 0] } ] } to the scene, or ask `tilt`"));
    }
    let dead = || assess(model, control);
    let beside = !options.skip_dead && side_by_side(model, control);
    let (bound, early) = both(beside, || limit(model, control), || beside.then(dead));
    // Where the answer itself says that λ = 0 is too much, there is nothing left to ask.
    let settled = bound.outcome == Outcome::Impossible
        || (bound.outcome == Outcome::Found && bound.bracket.upper < 0.0);
    let dead = (!settled && !options.skip_dead).then(|| early.unwrap_or_else(dead));
    if let Some(value) = bound.found() {
        control.known(|| format!("carries at most {value:.6} × the live load"));
    }
    let dry = coulomb::beside(model, &bound, dead.as_ref().map(|d| d.verdict), control);
    Ok(Limited { bound, dry, dead })
}

fn tilted(options: &TiltOptions, model: &Model, control: &Control) -> Result<Tilted, InputError> {
    let toward = directions(model.assembly.gravity, &options.toward, options.all);
    // All bounds before the first answer with dry friction: where time is short they are worth most.
    let tilts = Tilts::of(model, control);
    let asked = !options.skip_dead;
    let (directions, level) = both(
        asked && side_by_side(model, control),
        || tilts.bounds(&toward),
        || asked.then(|| assess(model, control)),
    );
    let mut directions = directions?;
    let verdict = level.as_ref().map(|l| l.verdict);
    tilts.add_dry(&mut directions, verdict)?;
    Ok(Tilted { directions, level })
}

fn pushed(options: &ThrustOptions, model: &Model, control: &Control) -> Result<Thrust, InputError> {
    let at = match &options.member {
        Some(id) => thrust::member(model, id, options.direction)?,
        None => thrust::place(model, options.support.as_deref(), options.direction)?.into(),
    };
    let ends = match options {
        ThrustOptions { range: true, .. } => thrust::Ends::Both,
        ThrustOptions { greatest: true, .. } => thrust::Ends::Greatest,
        _ => thrust::Ends::Least,
    };
    Ok(thrust::answer(model, at, ends, control))
}
