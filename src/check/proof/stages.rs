//! Results of `stages`: every stage with its verdict, its margin and the least forces on what it
//! holds, each with its evidence. What is said of all of them follows from these, and is worked out
//! once here, for who answers and for who checks.

use super::{
    answer::{Answer, FactorStatus, LimitAnswer, LoadFactorAnswer, TiltAnswer},
    certificate::{Certificate, Proven},
    derive::{At, Derivation, failure, motion, require},
    evidence::{HeldEvidence, StageEvidence, StagesEvidence},
    told::Told,
};
use crate::{
    path::reaction,
    question::{StagesOptions, directions},
    terms::{Bound, Doubt, Order, Outcome},
    verdict::{
        Verdict,
        claim::{Claim, Findings},
        exact::Grade,
        thrust::{Extreme, ThrustAt},
        tilted::no_tilt,
    },
};
use base::tolerance;
use model::{
    assembly::{self, AskedStages, Stage, Wrench},
    interface::{Model, at_stage},
};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::Serialize;
use serde_with::skip_serializing_none;
use std::sync::Arc;

/// What is said of all stages.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct StagesAnswer {
    /// The verdict of the worst stage.
    pub verdict: Verdict,
    /// The worst stage: the first that falls, or else stands only with self-stress, or is
    /// undecided, or else the one of the least margin.
    pub worst: String,
    /// How many stages there are.
    pub stages: usize,
    /// How many stand, from the first on.
    pub stand_first: usize,
    /// How many stand in all.
    pub stand: usize,
    /// The stage of the least load factor of its live load, where any has one.
    pub least_load_factor: Option<LeastMargin>,
    /// The stage that falls at the least tilt, in degrees, where any was asked for it.
    pub least_tilt_deg: Option<LeastMargin>,
    /// Of an order: the most blocks that are held at a time; absent where none was found.
    pub most_held: Option<usize>,
    /// Of an order: with fewer held at a time there is none, as far as the search went.
    pub least_held: Option<usize>,
    /// Of an order: so many blocks can be held at a time, where that was said.
    pub hands: Option<usize>,
    /// How exactly the verdicts are proved, the weakest of all; absent where one is undecided.
    pub proof: Option<Grade>,
}

/// A least margin.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct LeastMargin {
    /// The stage.
    pub stage: String,
    /// The margin; absent where it did not come out, or has no limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// What became of it.
    pub status: FactorStatus,
}

/// All stages.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct StagesResult {
    /// The stages are those of this order.
    pub order: Option<Order>,
    /// So many blocks can be held at a time, where that was said.
    pub hands: Option<usize>,
    /// In their order.
    pub list: Vec<StageResult>,
}

/// One stage.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct StageResult {
    /// Its name.
    pub name: String,
    /// Blocks that stand, supports among them.
    pub blocks: usize,
    /// Blocks that this stage holds.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub held: Vec<String>,
    /// Does it stand?
    pub verdict: Told,
    /// Where it stands and that was asked: the load factor of its live load, or else the least
    /// tilt.
    pub margin: Option<Told>,
    /// Why it has no margin although that was asked: loads that no tilt can turn.
    pub no_margin: Option<String>,
    /// Where it stands: the forces of its proof on supports and on what it holds. They are one
    /// state of equilibrium among others.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub reactions: Vec<Reaction>,
    /// Where it stands and that was asked: the least forces on what it holds.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub least_forces: Vec<HeldForce>,
    /// Why its verdict or its margin is undecided; it stands under `run`.
    #[serde(skip)]
    pub doubt: Option<Doubt>,
}

/// A force on a support or on what is held.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Reaction {
    /// The block.
    pub support: String,
    /// The force of the other blocks and of members on it, N.
    pub force: [f64; 3],
    /// Its moment about the block's centre of mass, N·m.
    pub moment: [f64; 3],
}

/// The least force on what is held, along a direction.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct HeldForce {
    /// The block that is held.
    pub block: String,
    /// Unit direction: down, or outwards.
    pub direction: [f64; 3],
    /// The least force of the other blocks on it along that, N; its own weight is not in it. Below
    /// zero: they can push it the other way.
    pub least: Bound,
    /// Its own weight along that, N.
    pub weight: f64,
    /// The least force that holds it against that, N: 0 where the others can do without. Nothing
    /// where the least force did not come out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub needed: Option<f64>,
    /// The evidence.
    #[serde(skip)]
    pub certificate: Arc<Certificate>,
}

impl HeldForce {
    /// What holds a block against the others and its own weight, as far as it must.
    pub fn needed(least: &Bound, weight: f64) -> Option<f64> {
        match (least.status, least.value) {
            (Outcome::Found, Some(value)) => Some((weight + value).max(0.0)),
            (Outcome::Unbounded, _) => Some(0.0),
            _ => None,
        }
    }
}

impl StageResult {
    /// Its verdict.
    pub fn stands(&self) -> Verdict {
        self.verdict.answer.verdict().unwrap_or(Verdict::Undecided)
    }

    /// Its load factor, where that is its margin.
    pub fn load_factor(&self) -> Option<&LoadFactorAnswer> {
        match &self.margin.as_ref()?.answer {
            Answer::Limit(a) => Some(&a.load_factor),
            _ => None,
        }
    }

    /// Its least tilt in degrees, where that is its margin.
    pub fn tilt_deg(&self) -> Option<&LoadFactorAnswer> {
        match &self.margin.as_ref()?.answer {
            Answer::Tilt(TiltAnswer { tilt_deg, .. }) => Some(tilt_deg),
            _ => None,
        }
    }
}

impl StagesAnswer {
    /// Whether every stage stands and no margin that was asked for is open or below nothing.
    pub fn is_safe(&self) -> bool {
        let margins = [&self.least_load_factor, &self.least_tilt_deg].into_iter().flatten();
        let good = |m: &LeastMargin| match m.status {
            FactorStatus::Found => m.value.is_some_and(|v| v >= 0.0),
            FactorStatus::Unbounded => true,
            _ => false,
        };
        self.verdict == Verdict::Stable && margins.into_iter().all(good)
    }

    /// Of an order: whether as many blocks can be held as have to be; nothing where that is not
    /// known.
    pub fn hands_do(&self) -> Option<bool> {
        match (self.hands, self.most_held, self.least_held) {
            (Some(hands), _, Some(least)) if hands < least => Some(false),
            (Some(hands), Some(most), _) => (most <= hands).then_some(true),
            (None, Some(_), _) => Some(true),
            _ => None,
        }
    }
}

/// What orders margins: the least first, and before all what did not come out.
pub fn governing(margin: &LoadFactorAnswer) -> f64 {
    match (margin.status, margin.value) {
        (FactorStatus::Found, Some(value)) => value,
        (FactorStatus::Unbounded, _) => f64::INFINITY,
        _ => f64::NEG_INFINITY,
    }
}

/// What orders verdicts: the worst first.
fn rank(verdict: Verdict) -> u8 {
    match verdict {
        Verdict::Unstable => 0,
        Verdict::Conditional => 1,
        Verdict::Undecided => 2,
        Verdict::Stable => 3,
    }
}

impl StagesResult {
    /// Which stages they are.
    pub fn asked(&self) -> AskedStages<'_> {
        match &self.order {
            Some(order) => AskedStages::InOrder(&order.placed),
            None => AskedStages::OfScene,
        }
    }

    /// What is said of all of them; where there are none, that nothing is known.
    pub fn answer(&self) -> StagesAnswer {
        self.of_each().unwrap_or(StagesAnswer {
            verdict: Verdict::Undecided,
            worst: String::new(),
            stages: 0,
            stand_first: 0,
            stand: 0,
            least_load_factor: None,
            least_tilt_deg: None,
            most_held: None,
            least_held: self.order.as_ref().map(|o| o.least_held),
            hands: self.hands,
            proof: None,
        })
    }

    fn of_each(&self) -> Option<StagesAnswer> {
        let list = &self.list;
        let least = |of: fn(&StageResult) -> Option<&LoadFactorAnswer>| {
            let there = list.iter().filter_map(|s| Some((s, of(s)?)));
            there.min_by(|a, b| governing(a.1).total_cmp(&governing(b.1))).map(|(s, margin)| {
                LeastMargin { stage: s.name.clone(), value: margin.value, status: margin.status }
            })
        };
        let least_load_factor = least(StageResult::load_factor);
        let least_tilt_deg = least(StageResult::tilt_deg);
        let first = list.iter().min_by_key(|s| rank(s.stands()))?;
        let verdict = first.stands();
        let weakest = least_load_factor.as_ref().or(least_tilt_deg.as_ref());
        let worst = match (verdict, weakest) {
            (Verdict::Stable, Some(margin)) => margin.stage.clone(),
            _ => first.name.clone(),
        };
        let stands = |s: &&StageResult| s.stands() == Verdict::Stable;
        let grades = list.iter().map(|s| s.verdict.answer.proof());
        let proof = grades.reduce(|a, b| Some(a?.and(b?))).flatten();
        Some(StagesAnswer {
            verdict,
            worst,
            stages: list.len(),
            stand_first: list.iter().take_while(stands).count(),
            stand: list.iter().filter(stands).count(),
            least_load_factor,
            least_tilt_deg,
            most_held: self.order.as_ref().and_then(Order::most_held),
            least_held: self.order.as_ref().map(|o| o.least_held),
            hands: self.hands,
            proof,
        })
    }
}

/// Every stage is made anew from the scene, and its answers are derived there.
pub(super) fn derive(
    d: &mut Derivation,
    o: &StagesOptions,
    e: &StagesEvidence,
) -> Result<Told, String> {
    let (scene, model) = (d.scene, d.model);
    if o.has_order() != e.order.is_some() {
        return Err("the evidence is for another order than the question".into());
    }
    let asked = match &e.order {
        Some(order) => AskedStages::InOrder(&order.placed),
        None => AskedStages::OfScene,
    };
    let here = assembly::asked_stages(asked, scene, &model.assembly).map_err(|e| e.to_string())?;
    let mut f = Findings::default();
    require(
        &mut f,
        e.stages.len() <= here.len(),
        format!("the stages are those of the scene ({} in all)", here.len()),
    );
    if let Some(order) = &e.order {
        complete(d, &mut f, o, order);
    }
    d.part("stages", f);
    let nothing = StageEvidence::default();
    let mut list = Vec::new();
    for (k, own) in here.iter().enumerate() {
        let there = at_stage(scene, model, own).map_err(|e| format!("{}: {e}", own.name))?;
        let evidence = e.stages.get(k).unwrap_or(&nothing);
        list.push(stage(
            d,
            o,
            (own, model.ids(&own.holds().collect::<Vec<_>>())),
            &there,
            evidence,
        ));
    }
    let result = StagesResult { order: e.order.clone(), hands: o.hands, list };
    let answer = result.answer();
    d.check.claimed = answer.verdict != Verdict::Undecided;
    let mut told = Told::new(model, Answer::Stages(Box::new(answer)), &Arc::default());
    told.stages = Some(result);
    Ok(told)
}

/// An order: every free block is placed, and with fewer held there is none, as far as a search like
/// the one before finds out.
fn complete(d: &Derivation, f: &mut Findings, o: &StagesOptions, order: &Order) {
    let free = d.model.assembly.free().count();
    let all = order.placed.is_empty() || order.placed.len() == free;
    require(f, all, format!("all {free} free blocks are placed"));
    require(
        f,
        order.given != o.order.is_empty(),
        "the order is recorded as given where the question gives it, and only there",
    );
    if order.given && !order.placed.is_empty() {
        let path = base::error::JsonPath::root();
        let asked = assembly::named_blocks(&o.order, d.scene, &d.model.assembly, &path);
        let same = asked
            .is_ok_and(|list| d.model.ids(&list).iter().eq(order.placed.iter().map(|p| &p.block)));
        require(f, same, "the order is the one that was given");
    }
    let least = order.least_held;
    f.computed = true;
    if least == 0 || !f.fails.is_empty() || !d.asks_again() {
        return;
    }
    let text = format!("no order was found with fewer than {least} blocks held at a time");
    match d.again.least_held(order, d.scene, d.model) {
        Some(Ok(here)) => require(f, least <= here, format!("{text} (searched again, not proved)")),
        Some(Err(e)) => f.fails.push(e.to_string()),
        None => f.unchecked.push(text),
    }
}

/// One stage; `model` is made anew for it.
fn stage(
    d: &mut Derivation,
    o: &StagesOptions,
    (stage, held): (&Stage, Vec<String>),
    model: &Model,
    e: &StageEvidence,
) -> StageResult {
    let name = &stage.name;
    let mut f = Findings::default();
    let (answer, proven) = d.verdict(&mut f, model, &e.standing);
    let said = answer.verdict;
    let stands = said == Verdict::Stable;
    let mut verdict = Told::new(model, Answer::Verdict(answer), &e.standing.certificate);
    verdict.motion = motion(&e.standing, said);
    verdict.in_words(model, proven.as_ref());
    d.part(name.clone(), f);
    let asks_margin = stands && !o.skip_margin && !o.has_order();
    let no_margin = no_tilt(model).filter(|_| asks_margin);
    let margin =
        (asks_margin && no_margin.is_none()).then(|| margin(d, o, name, model, e)).flatten();
    if margin.is_none() && (e.limit.is_some() || !e.tilts.is_empty()) {
        d.part(name.clone(), failure("the evidence has a margin that was not asked for"));
    }
    let reactions = proven.filter(|_| stands).map_or_else(Vec::new, |p| reactions_of(model, &p));
    let least_forces = if stands { d.held_forces(o, (name, &held), model, e) } else { Vec::new() };
    StageResult {
        name: name.clone(),
        blocks: model.assembly.blocks.len(),
        held,
        verdict,
        margin,
        no_margin,
        reactions,
        least_forces,
        doubt: None,
    }
}

/// The load factor of its live load, or else the least tilt.
fn margin(
    d: &mut Derivation,
    o: &StagesOptions,
    name: &str,
    model: &Model,
    e: &StageEvidence,
) -> Option<Told> {
    let nothing = Default::default();
    let claimed = d.check.claimed;
    let told = if model.assembly.live.iter().any(|w| *w != Wrench::zero()) {
        let own = e.limit.as_ref().unwrap_or(&nothing);
        let at: At = &|_| Ok(model.clone());
        let factor = d.factor(&format!("{name}, load factor"), model, at, (own, o.law), None);
        let answer = LimitAnswer {
            load_factor: factor.answer,
            verdict: None,
            part: factor.part,
            proof: factor.proof,
        };
        let mut told = Told::new(model, Answer::Limit(answer), &own.bound);
        told.in_words(model, factor.proven.as_ref());
        told.dry = factor.dry;
        Some(told)
    } else {
        let asked = directions(model.assembly.gravity, &o.toward, o.all);
        d.tilts(model, &asked, (&e.tilts, o.law), None)
    };
    d.check.claimed = claimed;
    told
}

impl Derivation<'_> {
    /// The least forces on all that is held, where they were asked for.
    fn held_forces(
        &mut self,
        o: &StagesOptions,
        (name, held): (&str, &[String]),
        model: &Model,
        e: &StageEvidence,
    ) -> Vec<HeldForce> {
        let touched: Vec<&String> = held.iter().filter(|id| touches(model, id)).collect();
        let complete = o.skip_held
            || touched
                .iter()
                .all(|id| e.least_forces.iter().any(|h| h.block == ***id && is_down(h, model)));
        if !complete {
            self.part(name, failure("the least force on a held block is missing"));
        }
        let mut list = Vec::new();
        for own in &e.least_forces {
            let title = format!("{name}, held {}", own.block);
            match least(own, model, held, self.known()) {
                Ok((force, f)) => {
                    self.part(title, f);
                    list.push(force);
                }
                Err(text) => self.part(title, failure(text)),
            }
        }
        list
    }
}

fn touches(model: &Model, id: &str) -> bool {
    let Some(i) = model.assembly.find(id) else { return false };
    model.interfaces.list.iter().any(|f| f.a == i || f.b == i)
}

fn is_down(held: &HeldEvidence, model: &Model) -> bool {
    let down = model.assembly.gravity.normalize();
    (Vector3::from(held.direction) - down).norm() <= tolerance::ALONG
}

/// The weight of a block along a direction, N; what is rounding is nothing.
fn weight_along(model: &Model, block: usize, direction: [f64; 3]) -> f64 {
    let gravity = model.assembly.gravity;
    let share = gravity.normalize().dot(&Vector3::from(direction));
    if share.abs() <= tolerance::ALONG { 0.0 } else { model.assembly.weight(block) * share }
}

/// The reactions that the forces of a proof make on everything that does not move.
fn reactions_of(model: &Model, proven: &Proven) -> Vec<Reaction> {
    let blocks = &model.assembly.blocks;
    let on = |i: usize| {
        let w = reaction::on_support(model, &proven.forces, i);
        let zero = w.force == Vector3::zeros() && w.moment == Vector3::zeros();
        (!zero).then(|| Reaction {
            support: blocks[i].id.clone(),
            force: w.force.into(),
            moment: w.moment.into(),
        })
    };
    (0..blocks.len()).filter(|&i| blocks[i].support).filter_map(on).collect()
}

/// The least force on what is held.
fn least(
    e: &HeldEvidence,
    model: &Model,
    held: &[String],
    known: bool,
) -> Result<(HeldForce, Findings), String> {
    let mut f = Findings::default();
    let fits = held.contains(&e.block);
    let support =
        model.assembly.find(&e.block).filter(|&i| fits && model.assembly.blocks[i].support);
    let support = support.ok_or(format!("the stage does not hold {}", e.block))?;
    let along = (Vector3::from(e.direction).norm() - 1.0).abs() <= tolerance::ALONG;
    require(&mut f, along, "its direction is a unit vector");
    let none = |status| Bound { status, value: None, lower: None, upper: None };
    let own = ThrustAt { support, direction: e.direction };
    let claim = e.certificate.prove(&mut f, model, known).and_then(|p| p.claim);
    let (fits, least) = match claim {
        None => (true, none(Outcome::Undecided)),
        Some(Claim::Thrust { at, extreme, value, lower, upper }) => {
            let bound = Bound {
                status: Outcome::Found,
                value: Some(value),
                lower: Some(lower),
                upper: Some(upper),
            };
            (at == own && extreme == Extreme::Least, bound)
        }
        Some(Claim::EndlessThrust { at, extreme }) => {
            (at == own && extreme == Extreme::Least, none(Outcome::Unbounded))
        }
        Some(_) => (false, none(Outcome::Undecided)),
    };
    require(&mut f, fits, "the least force is the one claimed");
    let weight = weight_along(model, support, e.direction);
    let force = HeldForce {
        block: e.block.clone(),
        direction: e.direction,
        needed: HeldForce::needed(&least, weight),
        least,
        weight,
        certificate: e.certificate.clone(),
    };
    Ok((force, f))
}
