//! The answer that follows from question, scene and evidence. It is computed here and nowhere else, by
//! who asks and by who checks alike.

mod closed;
mod dry;
mod factor;
mod nested;
mod part;
mod verdict;

pub(super) use factor::{At, Factor};
pub(super) use part::deciding;

use super::{
    certificate::Certificate,
    combinations, critical,
    evidence::{
        AssessEvidence, ClosedEvidence, Evidence, LimitEvidence, SimulateEvidence, Standing,
        TiltEvidence,
    },
    kinematic, meet, moving, path,
    recompute::Recompute,
    result::{ResultFile, Run, SceneSummary},
    rocking, sensitivity, shaken, stages, state, thrust,
    told::{Direction, Told},
    without,
};
use crate::{
    proof::answer::{Answer, LimitAnswer, Required, SimulationAnswer, TiltAnswer},
    question::{LimitOptions, Question, SimulateOptions, TiltOptions, directions},
    terms::{Fate, Found, Law, StateMotion},
    verdict::{
        Verdict,
        claim::{Claim, Findings},
        exact::Grade,
        tilted::{direction, tilted},
    },
};
use base::error::Finding;
use model::interface::{self, Model};
use nalgebra::Vector3;
use scene::Scene;

/// What the check of a result found.
#[derive(Clone, Debug, Default)]
pub struct Verification {
    /// A title and the findings for each part of the result.
    pub parts: Vec<(String, Findings)>,
    /// Whether the main answer claims anything; an undecided one does not.
    pub claimed: bool,
    /// What is to be known about the scene that all of it is about.
    pub scene: Vec<Finding>,
}

impl Verification {
    /// Whether any part fails.
    pub fn refuted(&self) -> bool {
        self.parts.iter().any(|(_, f)| !f.fails.is_empty())
    }

    /// The weakest grade of all that holds.
    pub fn grade(&self) -> Grade {
        self.parts.iter().fold(Grade::Exact, |all, (_, f)| all.and(f.grade))
    }

    /// Whether something that holds is computed, not proved.
    pub fn computed(&self) -> bool {
        !self.refuted() && self.parts.iter().any(|(_, f)| f.computed)
    }

    /// What only a solver could compute again, which this build has none of.
    pub fn unchecked(&self) -> impl Iterator<Item = &str> {
        self.parts.iter().flat_map(|(_, f)| &f.unchecked).map(String::as_str)
    }

    /// Whether the answer is proved: it claims something, every part holds, and nothing had to stay
    /// unchecked.
    pub fn proved(&self) -> bool {
        self.claimed && !self.refuted() && self.unchecked().next().is_none()
    }

    pub(super) fn part(&mut self, title: impl Into<String>, findings: Findings) {
        self.parts.push((title.into(), findings));
    }
}

/// An answer with the check of everything that it rests on.
#[derive(Clone, Debug)]
pub struct Derived {
    /// The result.
    pub file: ResultFile,
    /// What holds, and what does not.
    pub check: Verification,
}

/// A derivation under way.
pub(super) struct Derivation<'a> {
    pub question: &'a Question,
    pub scene: &'a Scene,
    pub model: &'a Model,
    pub again: &'a dyn Recompute,
    pub check: Verification,
}

/// Derives the answer to a question about a scene, prepared as `model`, and checks what it rests on.
///
/// # Errors
/// The question means nothing, or the evidence is none for it: why.
pub fn derive(
    question: Question,
    scene: &Scene,
    model: &Model,
    (evidence, closed): (Evidence, Option<ClosedEvidence>),
    run: Run,
    again: &dyn Recompute,
) -> Result<Derived, String> {
    question.check().map_err(|e| e.to_string())?;
    let check = Verification { scene: model.findings().cloned().collect(), ..Default::default() };
    let mut own = Derivation { question: &question, scene, model, again, check };
    let mut told = own.told(&evidence)?;
    own.left_out(&mut told, closed.as_ref())?;
    own.sensitivity(&mut told, &evidence)?;
    // In time blocks meet as their shapes do.
    if !matches!(told.answer, Answer::Simulation(_) | Answer::Shaken(_)) || told.motion.is_some() {
        told.flattened = flattened(model, &told.certificate, own.check.claimed);
    }
    if matches!(&told.answer, Answer::Verdict(v) if v.verdict == Verdict::Stable) {
        told.in_balance = model.ids(&interface::in_balance(model));
    }
    told.required = Required::of(&question, scene, &told.answer);
    told.scene_warnings = model.own_findings().cloned().collect();
    let check = own.check;
    let name = scene.name.clone();
    let scene = SceneSummary { name, counts: told.counts, input: scene.clone() };
    let mut file = ResultFile { question, scene, told, evidence, closed, run };
    file.add_why();
    Ok(Derived { file, check })
}

impl Derivation<'_> {
    fn told(&mut self, evidence: &Evidence) -> Result<Told, String> {
        match (self.question, evidence) {
            (Question::Assess(_), Evidence::Assess(e)) => self.assess(e),
            (Question::Limit(o), Evidence::Limit(e)) => self.limit(o, e),
            (Question::Tilt(o), Evidence::Tilt(e)) => self.tilt(o, e),
            (Question::Simulate(o), Evidence::Simulate(e)) => self.simulate(o, e),
            (Question::Moving(_), Evidence::Moving(e)) => moving::derive(self, e),
            (Question::Critical(o), Evidence::Critical(e)) => critical::derive(self, o, e),
            (Question::Thrust(o), Evidence::Thrust(e)) => thrust::derive(self, o, e),
            (Question::Settle(_), Evidence::Settle(e)) | (Question::Push(_), Evidence::Push(e)) => {
                path::derive(self, e)
            }
            (Question::Kinematic(o), Evidence::Kinematic(e)) => kinematic::derive(self, o, e),
            (Question::Stages(o), Evidence::Stages(e)) => stages::derive(self, o, e),
            (Question::Without(_), Evidence::Without(e)) => without::derive(self, e),
            (Question::State(o), Evidence::State(e)) => state::derive(self, o, e),
            (Question::Rock(o), Evidence::Rock(e)) => rocking::derive(self, o, e),
            (Question::Shake(o), Evidence::Shake(e)) => shaken::derive(self, o, e),
            (Question::Combinations(o), Evidence::Combinations(e)) => {
                combinations::derive(self, o, e)
            }
            (Question::Meet(o), Evidence::Meet(e)) => meet::derive(self, o, e),
            _ => {
                Err(format!("the evidence does not answer the question `{}`", self.question.word()))
            }
        }
    }

    /// How the value changes with what was assumed, where that is asked.
    fn sensitivity(&mut self, told: &mut Told, evidence: &Evidence) -> Result<(), String> {
        if !self.question.sensitivity() {
            return match evidence.sided().is_empty() {
                true => Ok(()),
                false => Err("derivatives were not asked for".into()),
            };
        }
        let Some(target) = told.answer.target() else { return Ok(()) };
        let scene = (self.scene, self.model);
        let (question, again) = (self.question, self.again);
        let ask = |pointers: &[&str]| again.sided(question, scene, &target, pointers);
        let ask: sensitivity::Again<'_> = &ask;
        let evidence = (&*told.certificate, evidence.sided());
        let found = sensitivity::derive(scene, &target, evidence, self.asks_again().then_some(ask));
        let (found, f) = found.map_err(|e| e.to_string())?;
        told.sensitivity = Some(found);
        self.part("sensitivity", f);
        Ok(())
    }

    /// Adds a part of the check.
    pub(super) fn part(&mut self, title: impl Into<String>, findings: Findings) {
        self.check.part(title, findings);
    }

    /// Whether evidence with a check was checked this moment, by who asks.
    pub(super) fn known(&self) -> bool {
        self.again.just_computed()
    }

    /// Whether what is computed and not proved is to be computed again.
    pub(super) fn asks_again(&self) -> bool {
        !self.again.just_computed() && !self.check.refuted()
    }

    fn assess(&mut self, e: &AssessEvidence) -> Result<Told, String> {
        let mut f = Findings::default();
        let (answer, proven) = self.verdict(&mut f, self.model, &e.standing);
        let verdict = answer.verdict;
        self.part("answer", f);
        self.check.claimed = verdict != Verdict::Undecided;
        let mut told = Told::new(self.model, Answer::Verdict(answer), &e.standing.certificate);
        told.motion = motion(&e.standing, verdict);
        told.in_words(self.model, proven.as_ref());
        if let Some(seen) = &e.simulation {
            if seen.asked != SimulateOptions::default() {
                return Err(
                    "the simulation beside a verdict must use the defaults of `simulate`".into()
                );
            }
            told.simulation = Some(seen.told(Some(verdict)));
            self.simulated(seen);
        }
        Ok(told)
    }

    fn simulate(&mut self, o: &SimulateOptions, e: &SimulateEvidence) -> Result<Told, String> {
        if e.seen.asked != *o {
            return Err("the simulation is not the one that was asked for".into());
        }
        let beside = e.standing.as_ref().map(|standing| {
            let mut f = Findings::default();
            let (answer, proven) = self.verdict(&mut f, self.model, standing);
            self.part("answer", f);
            (answer, proven, standing)
        });
        let verdict = beside.as_ref().map(|b| b.0.clone());
        self.check.claimed = verdict.as_ref().is_some_and(|v| v.verdict != Verdict::Undecided)
            || e.seen.fate != Fate::Undecided;
        let simulation = e.seen.told(verdict.as_ref().map(|v| v.verdict));
        let answer = Answer::Simulation(SimulationAnswer { fate: e.seen.fate, verdict });
        let nothing = Default::default();
        let certificate = beside.as_ref().map_or(&nothing, |b| &b.2.certificate);
        let mut told = Told::new(self.model, answer, certificate);
        told.motion = beside.as_ref().and_then(|b| motion(b.2, b.0.verdict));
        told.in_words(self.model, beside.as_ref().and_then(|b| b.1.as_ref()));
        told.simulation = Some(simulation);
        self.simulated(&e.seen);
        Ok(told)
    }

    /// What the engine did, which it does again.
    fn simulated(&mut self, seen: &super::simulation::Seen) {
        let text = "the simulation gives the same result when run again";
        let mut f = Findings { computed: true, ..Findings::default() };
        if self.asks_again() {
            match self.again.simulated(seen, self.scene, self.model) {
                None => f.unchecked.push(text.into()),
                Some(Err(e)) => {
                    f.fails.push(format!("the history cannot be computed for this scene: {e}"))
                }
                Some(Ok(here)) if here.fate != seen.fate => f.fails.push(format!(
                    "run again, the outcome is {:?} instead of {:?}",
                    here.fate, seen.fate
                )),
                Some(Ok(here)) => match super::compare::first_difference(seen, &here) {
                    None => f.holds.push(format!("{text} (computed, not proved)")),
                    // Another machine may round otherwise, from which another history comes.
                    Some(place) => f.unchecked.push(format!(
                        "run again here, the simulation differs at {place}: not confirmed"
                    )),
                },
            }
        }
        self.part("simulation", f);
    }

    fn limit(&mut self, o: &LimitOptions, e: &LimitEvidence) -> Result<Told, String> {
        let model = self.model;
        let dead = self.dead(model, e.dead.as_ref());
        let verdict = dead.as_ref().and_then(|d| d.answer.verdict());
        let at: At = &|_| Ok(model.clone());
        let factor = self.factor("answer", model, at, (&e.factor, o.law), verdict);
        let answer = LimitAnswer {
            load_factor: factor.answer,
            verdict,
            part: factor.part.clone(),
            proof: factor.proof,
        };
        let mut told = Told::new(model, Answer::Limit(answer), &e.factor.bound);
        told.in_words(model, factor.proven.as_ref());
        self.check.claimed = factor.is_claimed(verdict);
        told.dry = factor.dry;
        told.dead_load = dead;
        Ok(told)
    }

    fn tilt(&mut self, o: &TiltOptions, e: &TiltEvidence) -> Result<Told, String> {
        let level = self.dead(self.model, e.level.as_ref());
        let verdict = level.as_ref().and_then(|d| d.answer.verdict());
        let asked = directions(self.model.assembly.gravity, &o.toward, o.all);
        let told = self.tilts(self.model, &asked, (&e.directions, o.law), verdict);
        let mut told = told.ok_or("no direction is given")?;
        told.dead_load = level;
        Ok(told)
    }

    /// Tilts of a scene towards directions: the least, with all of them beside it where there are
    /// several. A direction without evidence is undecided, and governs.
    pub(super) fn tilts(
        &mut self,
        model: &Model,
        asked: &[Vector3<f64>],
        (list, law): (&[super::evidence::FactorEvidence], Law),
        level: Option<Verdict>,
    ) -> Option<Told> {
        let nothing = Default::default();
        let mut all = Vec::new();
        if list.len() > asked.len() {
            let text = format!(
                "the evidence has {} directions, the question has {}",
                list.len(),
                asked.len()
            );
            self.part("answer", failure(text));
        }
        for (k, &toward) in asked.iter().enumerate() {
            let evidence = list.get(k).unwrap_or(&nothing);
            let unit = match tilted(model, toward, evidence.value()) {
                Ok(turned) => turned,
                Err(e) => {
                    self.part("answer", failure(e.to_string()));
                    continue;
                }
            };
            let toward = direction(model.assembly.gravity.normalize(), toward);
            let title = format!("tilt towards {}", base::number::point(toward.into()));
            let at: At = &|tilt: f64| tilted(model, toward, Some(tilt));
            let factor = self.factor(&title, &unit, at, (evidence, law), level);
            let claimed = factor.is_claimed(level);
            let answer = TiltAnswer {
                toward: toward.into(),
                tan_tilt: factor.answer,
                tilt_deg: factor.answer.degrees(),
                verdict: level,
                part: factor.part.clone(),
                proof: factor.proof,
            };
            let direction = Direction {
                answer: Answer::Tilt(answer),
                certificate: evidence.bound.clone(),
                dry: factor.dry,
            };
            all.push((direction, factor.proven, unit, claimed));
        }
        let least = (0..all.len())
            .min_by(|&i, &j| all[i].0.governing().total_cmp(&all[j].0.governing()))?;
        let (direction, proven, unit, claimed) = &all[least];
        let mut told = Told::new(unit, direction.answer.clone(), &direction.certificate);
        told.in_words(unit, proven.as_ref());
        told.dry.clone_from(&direction.dry);
        self.check.claimed = *claimed;
        if all.len() > 1 {
            told.directions = all.into_iter().map(|d| d.0).collect();
        }
        Some(told)
    }
}

/// The flats of a scene that matter to an answer: what the forces press; all where nothing is claimed,
/// or by many proofs.
fn flattened(model: &Model, certificate: &Certificate, claimed: bool) -> Vec<[String; 2]> {
    let Model { assembly, interfaces, .. } = model;
    // What falls falls whichever of the normals acts.
    let falls = matches!(certificate.claim, Some(Claim::Unstable | Claim::Impossible));
    if falls || interfaces.list.iter().all(|f| f.ways.is_empty()) {
        return Vec::new();
    }
    let forces = certificate.read(model).map(|read| read.0).unwrap_or_default();
    let pressed =
        |k: usize| forces.get(k).is_some_and(|f| f.iter().any(|w| w.force != Vector3::zeros()));
    let all = !claimed || certificate.is_empty();
    let list = interfaces.list.iter().enumerate();
    let flats = list.filter(|(k, f)| !f.ways.is_empty() && (all || pressed(*k)));
    flats.map(|(_, f)| [f.a, f.b].map(|i| assembly.blocks[i].id.clone())).collect()
}

/// What is told of the state under dry friction: where the verdict rests on it.
pub(super) fn motion(e: &Standing, verdict: Verdict) -> Option<StateMotion> {
    e.state.filter(|state| match state {
        StateMotion::Rests => verdict == Verdict::Stable,
        StateMotion::Moves => verdict == Verdict::Conditional,
        StateMotion::Undecided => verdict == Verdict::Undecided,
    })
}

impl Factor {
    /// Whether anything is claimed: a bound, or that the dead load alone is not held.
    fn is_claimed(&self, dead: Option<Verdict>) -> bool {
        self.proof.is_some()
            || (self.dry.as_ref().is_some_and(|d| d.found == Found::NotAtRest)
                && dead == Some(Verdict::Unstable))
    }
}

pub(super) fn failure(text: impl Into<String>) -> Findings {
    Findings { fails: vec![text.into()], ..Findings::default() }
}

pub(super) fn require(f: &mut Findings, ok: bool, text: impl Into<String>) {
    if ok { &mut f.holds } else { &mut f.fails }.push(text.into());
}

/// Requires what was computed again, where that was possible.
pub(super) fn computed(f: &mut Findings, ok: Option<bool>, text: String) {
    f.computed = true;
    match ok {
        Some(ok) => require(f, ok, format!("{text} (computed again, not proved)")),
        None => f.unchecked.push(text),
    }
}
