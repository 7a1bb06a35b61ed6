//! Stages of construction: every one a scene of its own, of blocks, contacts and members that were
//! found once. Each is answered with its proof; where it stands, with a margin (the load factor of
//! its live load, or else the least tilt) and the least forces on what it holds.
//!
//! Blocks are rigid and stand where the scene puts them: a stage does not know how the one before
//! has settled, and forces of one do not stay in the next.
//!
//! What stood still stands where nothing that it rests on has changed: an independent part that
//! several stages have alike is answered once, and its proof checked in each.

use super::{
    Answer, Assessment, Control, LimitOptions, Proved, Question, StagesOptions, TiltOptions, ask,
    doubt,
    known::Known,
    thrust::{ThrustEnd, level, outwards, thrust},
};
use crate::{
    assembly::{self, Stage, Wrench},
    error::{InputError, JsonPath},
    interface::{Model, at_stage},
    parallel,
    scene::Scene,
    terms::Doubt,
    verdict::{
        Verdict,
        thrust::{Extreme, ThrustAt},
        tilted::no_tilt,
    },
};

/// The answer of `stages`.
#[derive(Clone, Debug)]
pub struct Stages {
    /// The stages are the scene without each of its free blocks.
    pub remove_each: bool,
    /// In their order; at least one.
    pub stages: Vec<Staged>,
}

/// A stage with its answers.
#[derive(Clone, Debug)]
pub struct Staged {
    /// What stands and what is held.
    pub stage: Stage,
    /// Its blocks, contacts and loads.
    pub model: Model,
    /// Does it stand?
    pub verdict: Proved<Assessment>,
    /// Where it stands and that was asked: [`Answer::Limit`] of its live load where it has one,
    /// else [`Answer::Tilt`].
    pub margin: Option<Answer>,
    /// Why there is none although it was asked for.
    pub no_margin: Option<String>,
    /// Where it stands and that was asked: the least forces on blocks that it holds and that touch
    /// free ones.
    pub held: Vec<Proved<ThrustEnd>>,
    /// Why a verdict or a margin is undecided.
    pub doubt: Option<Doubt>,
}

/// Answers every stage of a scene, prepared whole as `model`, on as many threads as there are
/// processors; the answers do not depend on them.
///
/// # Errors
/// The scene has no stages, or one of them means nothing.
pub fn stages(
    options: &StagesOptions,
    scene: &Scene,
    model: &Model,
    control: &Control,
) -> Result<Stages, InputError> {
    let list = assembly::asked_stages(options.remove_each, scene, &model.assembly)?;
    let known = Known::default();
    let answered = parallel::try_map(0, &list, |stage| {
        staged(options, scene, (model, stage), &known, control)
    });
    let stages = answered.map_err(|e| {
        InputError::at(JsonPath::root(), format!("threads cannot be started: {e}"))
    })??;
    Ok(Stages { remove_each: options.remove_each, stages })
}

fn staged(
    options: &StagesOptions,
    scene: &Scene,
    (whole, stage): (&Model, &Stage),
    known: &Known,
    control: &Control,
) -> Result<Staged, InputError> {
    let model = at_stage(scene, whole, stage)?;
    let verdict = known.assess(&model, control);
    let stands = verdict.verdict == Verdict::Stable;
    let asked = stands && !options.skip_margin && !options.remove_each;
    let no_margin = if asked { no_tilt(&model) } else { None };
    let margin = (asked && no_margin.is_none())
        .then(|| margin(options, scene, &model, control))
        .transpose()?;
    let held = match stands && !options.skip_held {
        true => held(whole, &model, stage, &verdict, control),
        false => Vec::new(),
    };
    let doubt = doubt(&Answer::Assess(verdict.clone()), &model, control)
        .or_else(|| margin.as_ref().and_then(|m| doubt(m, &model, control)));
    Ok(Staged { stage: stage.clone(), model, verdict, margin, no_margin, held, doubt })
}

/// The load factor of the live load, or else the least tilt.
fn margin(
    options: &StagesOptions,
    scene: &Scene,
    model: &Model,
    control: &Control,
) -> Result<Answer, InputError> {
    let law = options.law;
    let question = match model.assembly.live.iter().any(|w| *w != Wrench::zero()) {
        true => Question::Limit(LimitOptions { law, require: None, skip_dead: true }),
        false => Question::Tilt(TiltOptions {
            law,
            require: None,
            toward: options.toward.clone(),
            all: options.all,
            skip_dead: true,
        }),
    };
    ask(&question, scene, model, control)
}

/// The least forces on what a stage holds: down, and outwards where that is a direction.
fn held(
    whole: &Model,
    model: &Model,
    stage: &Stage,
    standing: &Proved<Assessment>,
    control: &Control,
) -> Vec<Proved<ThrustEnd>> {
    let down = model.assembly.gravity.normalize();
    let find = |i: usize| model.assembly.find(&whole.assembly.blocks[i].id);
    let touches = |i: usize| model.interfaces.list.iter().any(|f| f.a == i || f.b == i);
    let mut ends = Vec::new();
    for support in stage.holds().filter_map(find).filter(|&i| touches(i)) {
        let out = outwards(model, support);
        let out = out.and_then(|d| level(&model.assembly.gravity, d, 1.0));
        for direction in [Some(down), out].into_iter().flatten() {
            let at = ThrustAt { support, direction: direction.into() };
            ends.push(thrust(model, at, Extreme::Least, &standing.forces, control));
        }
    }
    ends
}
