//! The angle of maximum stability of a packing as a result: every round verified, names instead of indices.

use super::{
    Leaning, ResultFile,
    result::{QuestionKind, Versions},
};
use crate::{
    analysis::{Deciding, Fabric, Outcome, Stability, coulomb::Found, stability::Round},
    error::{Finding, FindingCode},
    interface::{Model, Timings},
    verdict::mechanism::JointMotion,
};
use serde::{Deserialize, Serialize};

/// The version of the format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum PackingFormat {
    /// Version 1.
    #[default]
    #[serde(rename = "voussoir-packing/1")]
    V1,
}

/// The answer about a packing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PackingFile {
    /// The format and its version.
    pub format: PackingFormat,
    /// Name of the scene.
    pub name: String,
    /// Free grains that were asked about.
    pub grains: usize,
    /// Contacts between blocks.
    pub contacts: usize,
    /// Share of the mass of the free grains that has to move.
    pub moving_mass: f64,
    /// Index of the direction with the least tilt.
    pub least: usize,
    /// Every direction asked for.
    pub directions: Vec<PackingDirection>,
    /// How the packing carries its load when level.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fabric: Option<Fabric>,
    /// What the question did not need.
    pub left_out: Vec<String>,
    /// What the user should know.
    pub warnings: Vec<Finding>,
    /// Seconds per stage.
    pub timings: Timings,
    /// Versions.
    pub versions: Versions,
}

/// One direction.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PackingDirection {
    /// Unit direction towards which the ground tips.
    pub toward: [f64; 3],
    /// What became of the tilt.
    pub status: Outcome,
    /// The tilt with joints that open as they slide, an upper bound for dry friction, degrees; 90 where the packing is wedged.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tilt_deg: Option<f64>,
    /// Its bracket, degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bracket_deg: Option<[f64; 2]>,
    /// How the tilt with dry friction was found, where it was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dry: Option<Found>,
    /// The tilt with dry friction, degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dry_deg: Option<f64>,
    /// Share of the mass of the free grains that has moved, earlier rounds included.
    pub moved: f64,
    /// Whether that is as much as was asked for.
    pub reached: bool,
    /// Grains that move in the round with the answer, the one with the greatest tilt, the fastest first.
    pub moving: Vec<String>,
    /// The part of the packing that loses balance there, where it has several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub part: Option<Deciding>,
    /// Joints of its mechanism that roll, slide and part.
    pub joints: [usize; 3],
    /// All rounds, where there are several: the tilt (degrees) and the grains that lost balance.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub removed: Vec<Removed>,
}

/// One round.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Removed {
    /// Degrees; absent where they fell with those before, or the verification failed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tilt_deg: Option<f64>,
    /// Grains that lost balance there.
    pub grains: Vec<String>,
}

impl PackingDirection {
    /// The tilt that counts: with dry friction where known, else the bound. One without an answer governs: it must not hide.
    pub fn governing(&self) -> f64 {
        if self.dry == Some(Found::NotAtRest) {
            return f64::NEG_INFINITY;
        }
        self.dry_deg.or(self.tilt_deg).unwrap_or(f64::NEG_INFINITY)
    }
}

impl PackingFile {
    /// Packs the answers of all directions; `model` is the packing when level, `loose` what nothing held. Also gives the result of the
    /// least direction in full, which `voussoir check` proves. `None` without any direction.
    pub fn new(model: &Model, name: &str, moving_mass: f64, answers: Vec<Stability>, loose: &[String]) -> Option<(Self, ResultFile)> {
        let mut directions = Vec::new();
        let mut files: Vec<ResultFile> = Vec::new();
        let mut warnings: Vec<Finding> = model.findings().cloned().collect();
        for answer in answers {
            let Stability { rounds, answer, reached } = answer;
            let many = rounds.len() > 1;
            let total = rounds.last()?.moved;
            let (mut removed, mut chosen) = (Vec::new(), None);
            for (index, round) in rounds.into_iter().enumerate() {
                let Round { scene, model, tilt, dry, moving, .. } = round;
                let file = ResultFile::tilt(&scene, &[Leaning { model, tilt, dry }])?;
                // The first round has the findings of the packing itself; later ones only what was refused.
                let fresh = |w: &&Finding| w.code == FindingCode::Numerics && !warnings.contains(w);
                let fresh: Vec<Finding> = file.warnings.iter().filter(fresh).cloned().collect();
                warnings.extend(fresh);
                if many {
                    removed.push(Removed { tilt_deg: file.answer.tilt_deg, grains: moving.clone() });
                }
                if index == answer {
                    chosen = Some((file, moving));
                }
            }
            let (file, moving) = chosen?;
            let factor = file.answer.load_factor?;
            let degrees = |v: f64| v.atan().to_degrees();
            let count = |kinds: &[JointMotion]| file.mechanism.iter().flat_map(|m| &m.joints).filter(|j| kinds.contains(&j.motion)).count();
            directions.push(PackingDirection {
                toward: file.answer.toward?,
                status: factor.status,
                tilt_deg: file.answer.tilt_deg,
                bracket_deg: factor
                    .lower
                    .zip(factor.upper)
                    .filter(|_| factor.status == Outcome::Found)
                    .map(|(l, u)| [degrees(l), degrees(u)]),
                dry: file.dry.as_ref().map(|d| d.found),
                dry_deg: file.dry.as_ref().and_then(|d| d.value).map(degrees),
                moved: total,
                reached: reached && factor.status == Outcome::Found,
                moving,
                part: file.answer.part.clone(),
                joints: [
                    count(&[JointMotion::Hinge]),
                    count(&[JointMotion::Slide, JointMotion::HingeAndSlide]),
                    count(&[JointMotion::Part, JointMotion::Crush]),
                ],
                removed,
            });
            files.push(file);
        }
        let least = (0..directions.len()).min_by(|&i, &j| directions[i].governing().total_cmp(&directions[j].governing()))?;
        let file = files.swap_remove(least);
        debug_assert_eq!(file.question, QuestionKind::Tilt);
        let mut left_out = file.left_out.clone();
        if !loose.is_empty() {
            left_out.insert(0, format!("{} grains without a contact path to a support", loose.len()));
        }
        let packing = Self {
            format: PackingFormat::V1,
            name: name.to_string(),
            grains: model.assembly.free().count(),
            contacts: model.interfaces.list.len(),
            moving_mass,
            least,
            directions,
            fabric: None,
            left_out,
            warnings,
            timings: model.timings,
            versions: Versions::default(),
        };
        Some((packing, file))
    }
}
