//! Results of `stages`: every stage with its verdict, its margin and the least forces on what it
//! holds, each with its evidence. What is said of all of them follows from these, and is worked out
//! once here, for who answers and for who checks.

mod verify;

pub(super) use verify::verify;
pub use verify::{reactions_of, weight_along};

use super::{
    answer::{Answer, FactorStatus, LoadFactorAnswer, TiltAnswer},
    certificate::{Certificate, DryResult},
    member::MemberLine,
    result::{CoulombState, Direction, MechanismWords, QuestionKind, ResultFile},
};
use crate::{
    terms::{Bound, Doubt, Order, Outcome},
    verdict::{Verdict, exact::Grade},
};
use model::assembly::AskedStages;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What is said of all stages.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StagesAnswer {
    /// The verdict of the worst stage.
    pub verdict: Verdict,
    /// The worst stage: the first that falls, or else stands only with a pre-stress, or is
    /// undecided, or else the one of the least margin.
    pub worst: String,
    /// How many stages there are.
    pub stages: usize,
    /// How many stand, from the first on.
    pub stand_first: usize,
    /// How many stand in all.
    pub stand: usize,
    /// The stage of the least load factor of its live load, where any has one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub least_load_factor: Option<LeastMargin>,
    /// The stage that falls at the least tilt, in degrees, where any was asked for it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub least_tilt_deg: Option<LeastMargin>,
    /// Of blocks taken out one at a time: those without which the rest stands.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub removable: Option<Vec<String>>,
    /// Of an order: the most blocks that are held at a time; absent where none was found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub most_held: Option<usize>,
    /// Of an order: with fewer held at a time there is none, as far as the search went.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub least_held: Option<usize>,
    /// Of an order: so many blocks can be held at a time, where that was said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hands: Option<usize>,
    /// How exactly the verdicts are proved, the weakest of all; absent where one is undecided.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub proof: Option<Grade>,
}

/// A least margin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StagesResult {
    /// The stages are the scene without each of its free blocks.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub remove_each: bool,
    /// The stages are those of this order.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub order: Option<Order>,
    /// So many blocks can be held at a time, where that was said.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hands: Option<usize>,
    /// In their order.
    pub list: Vec<StageResult>,
}

/// One stage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StageResult {
    /// Its name.
    pub name: String,
    /// Blocks that stand, supports among them.
    pub blocks: usize,
    /// Blocks that this stage holds.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub held: Vec<String>,
    /// Does it stand?
    pub verdict: StageProof,
    /// Where it stands and that was asked: the load factor of its live load, or else the least
    /// tilt.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub margin: Option<StageProof>,
    /// Why it has no margin although that was asked: loads that no tilt can turn.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub no_margin: Option<String>,
    /// Where it stands: the forces of its proof on supports and on what it holds. They are one
    /// state of equilibrium among others.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub reactions: Vec<Reaction>,
    /// Where it stands and that was asked: the least forces on what it holds.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub least_forces: Vec<HeldForce>,
    /// Why its verdict or its margin is undecided.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub doubt: Option<Doubt>,
}

/// A force on a support or on what is held.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Reaction {
    /// The block.
    pub support: String,
    /// The force of the other blocks and of members on it, N.
    pub force: [f64; 3],
    /// Its moment about the block's centre of mass, N·m.
    pub moment: [f64; 3],
}

/// The least force on what is held, along a direction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
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
    pub certificate: Certificate,
}

/// An answer about one stage with its evidence, as a result of its own has it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StageProof {
    /// What was asked of the stage.
    pub question: QuestionKind,
    /// The answer.
    pub answer: Answer,
    /// The evidence.
    pub certificate: Certificate,
    /// Tilt: every direction asked for, where there are several.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub directions: Vec<Direction>,
    /// Limit and the least direction of a tilt: the load factor with dry friction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dry: Option<DryResult>,
    /// The state under dry friction, where it had to be computed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coulomb_state: Option<CoulombState>,
    /// The mechanism in words.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mechanism: Option<MechanismWords>,
    /// The forces in the members, of the forces that prove the answer.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub members: Vec<MemberLine>,
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

impl From<ResultFile> for StageProof {
    fn from(file: ResultFile) -> Self {
        Self {
            question: file.question,
            answer: file.answer,
            certificate: file.certificate,
            directions: file.directions,
            dry: file.dry,
            coulomb_state: file.coulomb_state,
            mechanism: file.mechanism,
            members: file.members,
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
            None if self.remove_each => AskedStages::RemoveEach,
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
            removable: None,
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
        let removable = self.remove_each.then(|| {
            let names = list.iter().filter(stands).map(|s| s.name.trim_start_matches(WITHOUT));
            names.map(String::from).collect()
        });
        Some(StagesAnswer {
            verdict,
            worst,
            stages: list.len(),
            stand_first: list.iter().take_while(stands).count(),
            stand: list.iter().filter(stands).count(),
            least_load_factor,
            least_tilt_deg,
            removable,
            most_held: self.order.as_ref().and_then(Order::most_held),
            least_held: self.order.as_ref().map(|o| o.least_held),
            hands: self.hands,
            proof,
        })
    }
}

/// How the names of stages without a block begin.
const WITHOUT: &str = "without ";
