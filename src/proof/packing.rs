//! The angle of maximum stability of a packing as a result: every round verified, names instead of
//! indices.

use super::{
    ResultFile,
    result::{QuestionKind, Versions},
};
use crate::{
    analysis::{
        Deciding, Doubt, Fabric, Outcome, Packing, Stability, Tilted,
        coulomb::Found,
        stability::{Round, without},
    },
    error::{Finding, FindingCode, InputError},
    interface::Timings,
    scene::Scene,
    verdict::mechanism::JointMotion,
};
use serde::{Deserialize, Serialize};

/// The version of the format.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema,
)]
pub enum PackingFormat {
    /// Version 1.
    #[default]
    #[serde(rename = "voussoir-packing/1")]
    V1,
}

/// The answer about a packing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
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
    /// Why the answer is undecided, where it is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub doubt: Option<Doubt>,
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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PackingDirection {
    /// Unit direction towards which the ground tips.
    pub toward: [f64; 3],
    /// What became of the tilt.
    pub status: Outcome,
    /// The tilt with joints that open as they slide, an upper bound for dry friction, degrees; 90
    /// where the packing is wedged.
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
    /// Grains that move in the round with the answer, the one with the greatest tilt, the fastest
    /// first.
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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Removed {
    /// Degrees; absent where they fell with those before, or the verification failed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tilt_deg: Option<f64>,
    /// Grains that lost balance there.
    pub grains: Vec<String>,
}

impl PackingDirection {
    /// The tilt that counts: with dry friction where known, else the bound. One without an answer
    /// governs: it must not hide.
    pub fn governing(&self) -> f64 {
        if self.dry == Some(Found::NotAtRest) {
            return f64::NEG_INFINITY;
        }
        self.dry_deg.or(self.tilt_deg).unwrap_or(f64::NEG_INFINITY)
    }
}

impl PackingFile {
    /// Packs the answers of all directions about the packing of `scene`. Also gives the result of
    /// the least direction in full, which `voussoir check` proves. `None` without any direction.
    ///
    /// # Errors
    /// The scene cannot be written without the grains that fell first.
    pub fn new(
        scene: &Scene,
        moving_mass: f64,
        packing: &Packing,
    ) -> Result<Option<(Self, ResultFile)>, InputError> {
        let Packing { model, loose, directions: answers } = packing;
        let mut directions = Vec::new();
        let mut files: Vec<ResultFile> = Vec::new();
        let mut warnings: Vec<Finding> = model.findings().cloned().collect();
        for Stability { rounds, answer, reached } in answers {
            let Some((round, total)) = rounds.get(*answer).zip(rounds.last().map(|r| r.moved))
            else {
                continue;
            };
            let refused = rounds.iter().flat_map(|r| &r.tilt.load_factor.findings().fails);
            for text in refused {
                let warning =
                    Finding::new(FindingCode::Numerics, format!("certificate refused: {text}"));
                if !warnings.contains(&warning) {
                    warnings.push(warning);
                }
            }
            let tilt_deg = |r: &Round| Some(r.tilt.angle_deg()).filter(|a| a.is_finite());
            let removed = if rounds.len() > 1 {
                rounds
                    .iter()
                    .map(|r| Removed { tilt_deg: tilt_deg(r), grains: r.moving.clone() })
                    .collect()
            } else {
                Vec::new()
            };
            let one = Tilted { directions: vec![round.tilt.clone()], level: None };
            let Some(file) = ResultFile::tilt(&without(scene, &round.gone)?, model, &one) else {
                continue;
            };
            let Some(&factor) = file.answer.bound() else { continue };
            let degrees = |v: f64| v.atan().to_degrees();
            let count = |kinds: &[JointMotion]| {
                file.mechanism
                    .iter()
                    .flat_map(|m| &m.joints)
                    .filter(|j| kinds.contains(&j.motion))
                    .count()
            };
            directions.push(PackingDirection {
                toward: round.tilt.toward.into(),
                status: factor.status,
                tilt_deg: tilt_deg(round),
                bracket_deg: factor
                    .lower
                    .zip(factor.upper)
                    .filter(|_| factor.status == Outcome::Found)
                    .map(|(l, u)| [degrees(l), degrees(u)]),
                dry: file.dry.as_ref().map(|d| d.found),
                dry_deg: file.dry.as_ref().and_then(|d| d.value).map(degrees),
                moved: total,
                reached: *reached && factor.status == Outcome::Found,
                moving: round.moving.clone(),
                part: file.answer.part().cloned(),
                joints: [
                    count(&[JointMotion::Hinge]),
                    count(&[JointMotion::Slide, JointMotion::HingeAndSlide]),
                    count(&[JointMotion::Part, JointMotion::Crush]),
                ],
                removed,
            });
            files.push(file);
        }
        let by_tilt = |&i: &usize, &j: &usize| {
            directions[i].governing().total_cmp(&directions[j].governing())
        };
        let Some(least) = (0..directions.len()).min_by(by_tilt) else { return Ok(None) };
        let file = files.swap_remove(least);
        debug_assert_eq!(file.question, QuestionKind::Tilt);
        let mut left_out = file.left_out.clone();
        if !loose.is_empty() {
            left_out
                .insert(0, format!("{} grains without a contact path to a support", loose.len()));
        }
        let packing = Self {
            format: PackingFormat::V1,
            name: scene.name.clone(),
            grains: model.assembly.free().count(),
            contacts: model.interfaces.list.len(),
            moving_mass,
            least,
            directions,
            fabric: None,
            doubt: None,
            left_out,
            warnings,
            timings: model.timings,
            versions: Versions::default(),
        };
        Ok(Some((packing, file)))
    }
}
