//! Answers, as they were found and proved: one type for all questions.

use super::{
    Assessment, Control, Critical, LoadFactor, Proved, Question, Tilt, coulomb::DryLoadFactor,
    follow::answer::Followed, in_time, kinematic::Kinematic, moving::Moving, rocking::Rocking,
    stability::Packing, stages::Stages, state::Stated, thrust::Thrust, without::Without,
};
use base::error::InputError;
use check::proof::{
    ResultFile,
    combinations::CombinationsEvidence,
    evidence::NestedEvidence,
    meet::{MeetEvidence, MeetPoint, MeetSide},
};
use dynamics::SimulationOutcome;
use model::interface::Model;
use scene::Scene;

/// What answers a question about a scene, prepared as a model: [`ask`](super::ask()).
pub(super) type Door = fn(&Question, &Scene, &Model, &Control) -> Result<Answer, InputError>;

/// An answer.
#[derive(Clone, Debug)]
pub enum Answer {
    /// Does it stand?
    Assess(Proved<Assessment>),
    /// How large may the live load grow?
    Limit(Box<Limited>),
    /// How heavy may a train be?
    Moving(Box<Moving>),
    /// At what tilt does it fall?
    Tilt(Tilted),
    /// Where does the verdict flip?
    Critical(Box<Critical>),
    /// How hard does it push a support?
    Thrust(Box<Thrust>),
    /// How steep may a packing be?
    Repose(Packing),
    /// How far does it go, and what holds it on the way?
    Path(Box<Followed>),
    /// Under an earthquake: at what acceleration does it start to move?
    Kinematic(Box<Kinematic>),
    /// Does every stage of its construction stand?
    Stages(Box<Stages>),
    /// Which single blocks may be taken out?
    Without(Box<Without>),
    /// What follows from the stiffness of its joints?
    State(Box<Stated>),
    /// On ground that moves: what does its mechanism do?
    Rock(Box<Rocking>),
    /// What happens in time?
    Simulate(Box<SimulationOutcome>),
    /// On ground that moves: what do all blocks do?
    Shake(Box<in_time::ShakenScene>),
    /// In every combination of actions.
    Combinations(Box<Combined>),
    /// Where what is required is met.
    Meet(Box<Met>),
}

/// The answer about a live load.
#[derive(Clone, Debug)]
pub struct Limited {
    /// The bound: joints open as they slide.
    pub bound: Proved<LoadFactor>,
    /// With dry friction, where that was asked and the bound has a value or no limit.
    pub dry: Option<Proved<DryLoadFactor>>,
    /// Whether it stands under its dead load alone, where that was asked and is not settled by the
    /// bound.
    pub dead: Option<Proved<Assessment>>,
}

impl From<Proved<LoadFactor>> for Limited {
    /// The bound alone.
    fn from(bound: Proved<LoadFactor>) -> Self {
        Self { bound, dry: None, dead: None }
    }
}

/// The answer about tilts.
#[derive(Clone, Debug)]
pub struct Tilted {
    /// One a direction, in the order in which they were asked; at least one.
    pub directions: Vec<Tilt>,
    /// Whether it stands level, where that was asked.
    pub level: Option<Proved<Assessment>>,
}

/// The answer of `combinations`.
#[derive(Clone, Debug)]
pub struct Combined {
    /// One a combination, in the order of the scene.
    pub list: Vec<InCombination>,
}

/// A combination with its answer.
#[derive(Clone, Debug)]
pub struct InCombination {
    /// Its name.
    pub name: String,
    /// The scene with its factors, prepared.
    pub model: Model,
    /// The answer.
    pub answer: Answer,
    /// The same as it is told.
    pub file: ResultFile,
}

impl Combined {
    /// The one that governs.
    pub fn worst(&self) -> Option<&InCombination> {
        let height = |c: &&InCombination| c.file.nested().height();
        let by = |a: (u8, f64), b: (u8, f64)| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1));
        self.list.iter().min_by(|a, b| by(height(a), height(b)))
    }

    /// What it is derived from.
    pub(super) fn evidence(&self) -> CombinationsEvidence {
        let one = |c: &InCombination| NestedEvidence {
            question: c.file.question.clone(),
            evidence: c.file.evidence().clone(),
        };
        CombinationsEvidence { list: self.list.iter().map(one).collect() }
    }
}

/// The answer of `meet`.
#[derive(Clone, Debug)]
pub struct Met {
    /// The scan, as far as it went.
    pub scan: Vec<MeetPoint>,
    /// Both sides of every change, the lower value first; without one the ends of the range, where
    /// there are scenes.
    pub sides: Vec<[Probe; 2]>,
    /// Why values of the scan make no scene.
    pub no_scene: Vec<(f64, String)>,
    /// Scenes asked.
    pub probes: usize,
}

/// The answer at a value.
#[derive(Clone, Debug)]
pub struct Probe {
    /// The value.
    pub value: f64,
    /// The scene there, prepared.
    pub model: Model,
    /// The answer.
    pub answer: Answer,
    /// The same as it is told.
    pub file: ResultFile,
}

impl Probe {
    /// Whether what is required is met.
    pub fn met(&self) -> Option<bool> {
        self.file.nested().holds()
    }

    /// What is obtained beyond what is required.
    pub(super) fn beyond(&self) -> Option<f64> {
        let required = self.file.required?;
        Some(required.obtained? - required.least)
    }

    pub(super) fn point(&self) -> MeetPoint {
        let obtained = self.file.required.and_then(|r| r.obtained);
        MeetPoint { value: self.value, met: self.met(), obtained }
    }
}

impl Met {
    /// What it is derived from.
    pub(super) fn evidence(&self) -> MeetEvidence {
        let one = |p: &Probe| MeetSide {
            value: p.value,
            own: NestedEvidence {
                question: p.file.question.clone(),
                evidence: p.file.evidence().clone(),
            },
        };
        MeetEvidence {
            scan: self.scan.clone(),
            sides: self.sides.iter().map(|[a, b]| [one(a), one(b)]).collect(),
        }
    }

    /// The side of the first change at which what is required is met.
    pub fn first(&self) -> Option<&Probe> {
        self.sides.first()?.iter().find(|p| p.met() == Some(true))
    }
}
