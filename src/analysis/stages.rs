//! Stages of construction: every one a scene of its own, of blocks, contacts and members that were
//! found once. Each is answered with its proof; where it stands, with a margin (the load factor of
//! its live load, or else the least tilt) and the least forces on what it holds.
//!
//! Blocks are rigid and stand where the scene puts them: a stage does not know how the one before
//! has settled, and forces of one do not stay in the next.
//!
//! What stood still stands where nothing that it rests on has changed: an independent part that
//! several stages have alike is answered once, and its proof checked in each.

mod order;

use check::question::{MOST_TRIES, StagesOptions};

use super::{
    Answer, Assessment, Control, LimitOptions, Proved, Question, TiltOptions,
    answer::Door,
    doubt,
    part_cache::Known,
    thrust::{ThrustEnd, level, outwards, thrust},
    watch::Counted,
};
use base::error::{InputError, JsonPath};
use check::{
    terms::{Doubt, Order},
    verdict::{
        Verdict,
        thrust::{Extreme, ThrustAt},
        tilted::no_tilt,
    },
};
use cholesky::parallel;
use model::{
    assembly::{self, AskedStages, Placed, Stage, Wrench},
    interface::{Model, at_stage},
};
use scene::Scene;

/// The answer of `stages`.
#[derive(Clone, Debug)]
pub struct Stages {
    /// The order of which they are the stages.
    pub order: Option<Order>,
    /// So many blocks can be held at a time, where that was said.
    pub hands: Option<usize>,
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
pub(super) fn stages(
    options: &StagesOptions,
    scene: &Scene,
    model: &Model,
    control: &Control,
    door: Door,
) -> Result<Stages, InputError> {
    let known = Known::default();
    let order = match options.has_order() {
        true => Some(ordered(options, scene, model, &known, control)?),
        false => None,
    };
    let asked = match &order {
        Some(order) => AskedStages::InOrder(&order.placed),
        None => AskedStages::OfScene,
    };
    let list = assembly::asked_stages(asked, scene, &model.assembly)?;
    let counted = Counted::new(control.watcher, "stage", list.len());
    let answered = parallel::try_map(0, &list, |stage| {
        counted.next();
        staged(options, scene, (model, stage), &known, (control, door))
    });
    let stages = answered.map_err(|e| {
        InputError::at(JsonPath::root(), format!("threads cannot be started: {e}"))
    })??;
    Ok(Stages { order, hands: options.hands, stages })
}

/// The order that is given or sought.
fn ordered(
    options: &StagesOptions,
    scene: &Scene,
    model: &Model,
    known: &Known,
    control: &Control,
) -> Result<Order, InputError> {
    let path = JsonPath::root().key("stages").key("order");
    let named = || assembly::named_blocks(&options.order, scene, &model.assembly, &path);
    let given = (!options.any_order).then(named).transpose()?;
    if model.assembly.free().next().is_none() {
        return Err(InputError::at(JsonPath::root(), "there is no free block to place"));
    }
    let tries = options.tries.unwrap_or(order::TRIES);
    order::order((given.as_deref(), tries), scene, model, known, control)
}

/// No order does with fewer blocks held at a time than this number, as far as a search with that
/// many tries knows; for who checks what was said about it.
///
/// # Errors
/// As `stages`.
pub fn least_held(said: &Order, scene: &Scene, model: &Model) -> Result<usize, InputError> {
    if said.tries > MOST_TRIES {
        let text = format!("the search for an order is limited to {MOST_TRIES} tries");
        return Err(InputError::at(JsonPath::root(), text));
    }
    let of = |p: &Placed| model.assembly.find(&p.block);
    let given: Vec<usize> = said.placed.iter().filter_map(of).collect();
    let given = said.given.then_some(given.as_slice());
    let (known, control) = (Known::default(), Control::default());
    Ok(order::order((given, said.tries), scene, model, &known, &control)?.least_held)
}

fn staged(
    options: &StagesOptions,
    scene: &Scene,
    (whole, stage): (&Model, &Stage),
    known: &Known,
    (control, door): (&Control, Door),
) -> Result<Staged, InputError> {
    let model = at_stage(scene, whole, stage)?;
    let verdict = known.assess(&model, control);
    let stands = verdict.verdict == Verdict::Stable;
    let only_verdict = options.skip_margin || options.has_order();
    let asked = stands && !only_verdict;
    let no_margin = if asked { no_tilt(&model) } else { None };
    let margin = (asked && no_margin.is_none())
        .then(|| margin(options, scene, &model, (control, door)))
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
    (control, door): (&Control, Door),
) -> Result<Answer, InputError> {
    let law = options.law;
    let question = match model.assembly.live.iter().any(|w| *w != Wrench::zero()) {
        true => Question::Limit(LimitOptions { law, skip_dead: true, ..LimitOptions::default() }),
        false => Question::Tilt(TiltOptions {
            law,
            toward: options.toward.clone(),
            all: options.all,
            skip_dead: true,
            ..TiltOptions::default()
        }),
    };
    door(&question, scene, model, control)
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
