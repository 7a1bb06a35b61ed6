//! Results of `moving`: a load factor for every position of a train, each claimed and proved as one
//! of a scene of its own; the least is the answer.

use super::{
    answer::{Answer, FactorStatus, LoadFactorAnswer},
    derive::{At, Derivation, failure, require},
    evidence::{MovingEvidence, PositionEvidence},
    told::{Direction, Told},
};
use crate::{
    terms::Deciding,
    verdict::{Verdict, claim::Findings, exact::Grade},
};
use base::tolerance;
use model::train::{self, Position, Standing, Travel, Way};
use schemars::JsonSchema;
use serde::Serialize;
use serde_with::skip_serializing_none;

/// The answer about one position of a train; that of a result is the least.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct MovingAnswer {
    /// Which way the train goes.
    pub travel: Travel,
    /// Where its origin is, x in the scene, m.
    pub x: f64,
    /// The axles that stand on a span.
    pub axles: Vec<Standing>,
    /// By how much their forces may be multiplied.
    pub load_factor: LoadFactorAnswer,
    /// Whether it stands without the train, where that was asked.
    pub verdict: Option<Verdict>,
    /// The part of the scene that decides the bound, where it has several.
    pub part: Option<Deciding>,
    /// How exactly that bound is proved; absent where it is undecided.
    pub proof: Option<Grade>,
}

impl MovingAnswer {
    /// Where the train is.
    pub fn position(&self) -> Position {
        Position { travel: self.travel, x: self.x }
    }

    /// What orders positions: one without an answer governs, for it must not hide behind the others;
    /// of these the least bound comes first. Of which it is only known that they bear what another
    /// one does, they come last.
    pub fn governing(&self) -> (f64, f64) {
        let l = &self.load_factor;
        let value = match l.status {
            FactorStatus::Unbounded | FactorStatus::AtLeast => f64::INFINITY,
            _ => l.value.unwrap_or(f64::NEG_INFINITY),
        };
        (value, l.associative.value.unwrap_or(f64::INFINITY))
    }

    /// Whether it is not below this one, as far as values are: up to where that was seen at rest.
    fn bears(&self, least: &Self) -> bool {
        let (own, other) = (&self.load_factor, &least.load_factor);
        let floor = other.value.map(|v| v - 1.01 * tolerance::REST_BELOW * v.abs()).or(other.lower);
        own.status != FactorStatus::AtLeast || own.lower.zip(floor).is_some_and(|(l, f)| l >= f)
    }
}

/// Which of these answers counts: the first of the least; nothing where one is about something else.
pub fn least<'a>(answers: impl Iterator<Item = &'a Answer>) -> Option<usize> {
    let keys: Vec<(f64, f64)> =
        answers.map(|a| a.moving().map(MovingAnswer::governing)).collect::<Option<_>>()?;
    let order = |a: &(f64, f64), b: &(f64, f64)| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1));
    (0..keys.len()).min_by(|&i, &j| order(&keys[i], &keys[j]))
}

impl Answer {
    /// What it says of a train.
    pub fn moving(&self) -> Option<&MovingAnswer> {
        match self {
            Self::Moving(a) => Some(a),
            _ => None,
        }
    }
}

/// The answer about a train, position by position; the least is the answer. A step of its way that is
/// missing is refused.
pub(super) fn derive(d: &mut Derivation, e: &MovingEvidence) -> Result<Told, String> {
    let (Some(train), Some(way)) = (&d.scene.train, Way::of(d.scene, d.model)) else {
        return Err("the scene has no train".into());
    };
    let law = d.question.law();
    let dead = d.dead(d.model, e.dead.as_ref());
    let level = dead.as_ref().and_then(|d| d.answer.verdict());
    let mut f = Findings::default();
    let at = |p: &PositionEvidence| Position { travel: p.travel, x: p.x };
    let [from, to] = train.path;
    let travels = train::travels(train);
    let inside = |p: Position| travels.contains(&p.travel) && (from..=to).contains(&p.x);
    require(
        &mut f,
        e.positions.iter().all(|p| inside(at(p))),
        "every position lies on the path of the train",
    );
    let near = |a: Position, b: &Position| {
        a.travel == b.travel && (a.x - b.x).abs() <= tolerance::SAVED * train.step
    };
    let steps = train::positions(train);
    // A step that cannot be made ready counts as missing, too.
    let is_missing = |p: &&Position| {
        !e.positions.iter().any(|q| near(at(q), p)) && !matches!(way.at((*p).to_owned()), Ok(None))
    };
    let missing: Vec<&Position> = steps.iter().filter(is_missing).collect();
    require(
        &mut f,
        missing.is_empty(),
        match missing.first() {
            None => {
                format!("of {} steps, none with an axle on a span is missing", steps.len())
            }
            Some(p) => format!(
                "{} steps are missing, the first at x = {} {}",
                missing.len(),
                p.x,
                p.travel.words()
            ),
        },
    );
    d.part("answer", f);
    let mut all = Vec::new();
    for p in &e.positions {
        let title = format!("train at x = {} {}", p.x, p.travel.words());
        let under = match way.at(at(p)) {
            Ok(Some(under)) => under,
            Ok(None) => return Err(format!("{title}: no axle stands on a span")),
            Err(e) => return Err(format!("{title}: {e}")),
        };
        let model: At = &|_| Ok(under.model.clone());
        let factor = d.factor(&title, &under.model, model, (&p.factor, law), level);
        let answer = MovingAnswer {
            travel: p.travel,
            x: p.x,
            axles: under.axles,
            load_factor: factor.answer,
            verdict: level,
            part: factor.part,
            proof: factor.proof,
        };
        let direction = Direction {
            answer: Answer::Moving(Box::new(answer)),
            certificate: p.factor.bound.clone(),
            dry: factor.dry,
        };
        all.push((direction, factor.proven, under.model));
    }
    let least = least(all.iter().map(|d| &d.0.answer)).ok_or("no position is given")?;
    let (direction, proven, under) = &all[least];
    let worst = direction.answer.moving();
    let bears = |(d, ..): &(Direction, _, _)| {
        d.answer.moving().zip(worst).is_some_and(|(a, least)| a.bears(least))
    };
    if !all.iter().all(bears) {
        d.part(
            "answer",
            failure(
                "a position without a load factor of its own may carry less than the governing one",
            ),
        );
    }
    let mut told = Told::new(d.model, direction.answer.clone(), &direction.certificate);
    told.in_words(under, proven.as_ref());
    told.dry.clone_from(&direction.dry);
    told.directions = all.into_iter().map(|d| d.0).collect();
    told.dead_load = dead;
    d.check.claimed = told.answer.proof().is_some();
    Ok(told)
}
