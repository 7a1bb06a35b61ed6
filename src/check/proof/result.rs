//! The result file (`"format": "voussoir-result/3"`): the question, the scene and the evidence, from
//! which the answer is derived, the answer as it was derived, and what it took.

use super::{
    answer::{Answer, Nested},
    evidence::{ClosedEvidence, Evidence},
    simulation::FrameResult,
    told::{Counts, Told},
    work::Work,
};
use crate::{
    question::Question,
    terms::{Attempt, Doubt, StateStep},
};
use base::error::Finding;
use model::interface::Timings;
use scene::Scene;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use serde_with::skip_serializing_none;
use std::ops::Deref;

/// The format, as files name it.
pub const FORMAT: &str = "voussoir-result/3";

/// The version of the format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum ResultFormat {
    /// Version 3.
    #[default]
    #[serde(rename = "voussoir-result/3")]
    V3,
}

/// A result: what was asked, what is told, and from what it follows. Made by
/// [`derive`](super::derive::derive) alone.
#[derive(Clone, Debug)]
pub struct ResultFile {
    /// What was asked.
    pub question: Question,
    /// The scene.
    pub scene: SceneSummary,
    /// What is told.
    pub(super) told: Told,
    /// What it follows from.
    pub(super) evidence: Evidence,
    /// The answer with contacts closed that were left out, where it was asked.
    pub(super) closed: Option<ClosedEvidence>,
    /// What it took.
    pub run: Run,
}

/// The scene that a result is about.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneSummary {
    /// Its name.
    pub name: String,
    /// How much there is of it.
    pub counts: Counts,
    /// The scene itself.
    pub input: Scene,
}

/// How an answer came about. Nothing in it is a claim.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Run {
    /// The program's version.
    pub voussoir: String,
    /// Why the answer is undecided, where it is.
    pub doubt: Option<Doubt>,
    /// Why something is not in the answer, by what is missing.
    #[serde(default, skip_serializing_if = "Why::is_empty")]
    pub why: Why,
    /// What the user should know of how it came about.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<Finding>,
    /// What the scene did not need.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub left_out: Vec<String>,
    /// Seconds per stage.
    pub timings: Timings,
    /// What it cost, beside the seconds.
    pub work: Option<Work>,
    /// Every attempt at a program.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub trace: Vec<Attempt>,
    /// The continuation of the state under dry friction.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub state_steps: Vec<StateStep>,
    /// Convex programs of load factors with dry friction.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub dry_solves: usize,
    /// Steps of Newton's method.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub newton_steps: usize,
    /// Poses through which a path was followed beside its points.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub between: usize,
    /// Scenes that were asked about on the way.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub scenes: usize,
    /// Where every block was at the times asked for.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub frames: Vec<FrameResult>,
}

/// Why something is not in an answer.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Why {
    /// A path was not followed any further.
    pub path: Option<String>,
    /// There is no curve.
    pub no_curve: Option<String>,
    /// There is no curve with members.
    pub no_curve_with_members: Option<String>,
    /// There is no geometric safety factor.
    pub without_factor: Option<String>,
    /// Stages are undecided, by their names.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub stages: Vec<(String, Doubt)>,
    /// Values of a range make no scene.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub no_scene: Vec<(f64, String)>,
    /// What is said of a range.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub range: Vec<String>,
}

impl Why {
    fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

impl Run {
    /// Of this program.
    pub fn new(timings: Timings) -> Self {
        Self { voussoir: env!("CARGO_PKG_VERSION").to_string(), timings, ..Self::default() }
    }
}

impl ResultFile {
    /// The answer with what is required of it.
    pub fn nested(&self) -> Nested {
        Nested { answer: self.told.answer.clone(), required: self.told.required }
    }

    /// What it follows from.
    pub fn evidence(&self) -> &Evidence {
        &self.evidence
    }

    /// The result as it is read from its file.
    ///
    /// # Errors
    /// None that a result can bring about.
    pub fn saved(&self) -> Result<Saved, serde_json::Error> {
        Ok(Saved {
            format: ResultFormat::V3,
            question: self.question.clone(),
            scene: self.scene.input.clone(),
            evidence: self.evidence.clone(),
            closed: self.closed.clone(),
            answer: serde_json::to_value(&self.told)?,
            run: self.run.clone(),
        })
    }

    /// The answer with contacts closed that were left out, where it was asked.
    pub fn closed(&self) -> Option<&ClosedEvidence> {
        self.closed.as_ref()
    }

    /// Puts beside the answer why something is not in it.
    pub(super) fn add_why(&mut self) {
        let why = self.run.why.clone();
        match &mut self.told.answer {
            Answer::Path(a) if a.why.is_none() => a.why = why.path,
            Answer::Kinematic(a) => {
                (a.no_curve, a.no_curve_with_members) = (why.no_curve, why.no_curve_with_members);
                if let Some(curve) = a.curve.as_mut().filter(|c| c.why.is_none()) {
                    curve.why = why.path;
                }
            }
            _ => {}
        }
        if let Some(thrust) = &mut self.told.thrust {
            thrust.without_factor = why.without_factor;
        }
        for stage in self.told.stages.iter_mut().flat_map(|s| &mut s.list) {
            let own = why.stages.iter().find(|(name, _)| *name == stage.name);
            stage.doubt = own.map(|(_, doubt)| doubt.clone());
        }
    }

    /// What the user should know: of the scene, and of how the answer came about.
    pub fn warnings(&self) -> impl Iterator<Item = &Finding> {
        self.told.scene_warnings.iter().chain(&self.run.warnings)
    }

    /// The result as a JSON value. Written here once, so that no other crate writes it again for
    /// itself.
    ///
    /// # Errors
    /// None that a result can bring about.
    pub fn to_value(&self) -> Result<Value, serde_json::Error> {
        let mut value = json!({
            "format": ResultFormat::V3,
            "question": self.question,
            "answer": serde_json::to_value(&self.told)?,
            "evidence": serde_json::to_value(&self.evidence)?,
            "scene": serde_json::to_value(&self.scene.input)?,
            "run": serde_json::to_value(&self.run)?,
        });
        if let (Some(closed), Some(map)) = (&self.closed, value.as_object_mut()) {
            map.insert("closed".into(), serde_json::to_value(closed)?);
        }
        Ok(value)
    }
}

impl Serialize for ResultFile {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.to_value().map_err(serde::ser::Error::custom)?.serialize(serializer)
    }
}

impl Deref for ResultFile {
    type Target = Told;

    fn deref(&self) -> &Told {
        &self.told
    }
}

/// A result as it stands in a file: the answer in it is only compared with what is derived.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Saved {
    /// The format and its version.
    pub format: ResultFormat,
    /// What was asked.
    pub question: Question,
    /// The scene, so that the result can be verified on its own.
    pub scene: Scene,
    /// What the answer follows from.
    pub evidence: Evidence,
    /// The answer with contacts closed that were left out. Computed.
    #[serde(default)]
    pub closed: Option<ClosedEvidence>,
    /// What is told ([`Told`]).
    #[schemars(with = "Told")]
    pub answer: Value,
    /// What it took.
    #[serde(default)]
    pub run: Run,
}

/// The JSON Schema (draft 2020-12) of a result file.
pub fn schema() -> Value {
    let mut schema = schemars::schema_for!(Saved);
    schema.insert("title".into(), "voussoir result, version 3".into());
    schema.to_value()
}

fn is_zero(n: &usize) -> bool {
    *n == 0
}
