//! The angle of maximum stability of a packing: every round, the least direction in full.

use super::tilt;
use crate::{
    Packing, Stability, Tilted,
    stability::{Round, without},
};
use base::error::{Finding, FindingCode, InputError};
use check::{
    proof::{
        ResultFile,
        packing::{PackingDirection, PackingFile, PackingFormat, Removed, Versions},
    },
    terms::Outcome,
    verdict::mechanism::JointMotion,
};
use scene::Scene;

/// Packs the answers of all directions about the packing of `scene`. Also gives the result of
/// the least direction in full, which `voussoir check` proves. `None` without any direction.
///
/// # Errors
/// The scene cannot be written without the grains that fell first.
pub fn packing(
    scene: &Scene,
    moving_mass: f64,
    packing: &Packing,
) -> Result<Option<(PackingFile, ResultFile)>, InputError> {
    let Packing { model, loose, directions: answers } = packing;
    let mut directions = Vec::new();
    let mut files: Vec<ResultFile> = Vec::new();
    let mut warnings: Vec<Finding> = model.findings().cloned().collect();
    for Stability { rounds, answer, reached } in answers {
        let Some((round, total)) = rounds.get(*answer).zip(rounds.last().map(|r| r.moved)) else {
            continue;
        };
        let refused = rounds.iter().flat_map(|r| &r.tilt.load_factor.findings().fails);
        for text in refused {
            let warning =
                Finding::new(FindingCode::Numerics, format!("certificate rejected: {text}"));
            if !warnings.contains(&warning) {
                warnings.push(warning);
            }
        }
        let tilt_deg = |r: &Round| r.tilt.angle_deg();
        let removed = if rounds.len() > 1 {
            rounds
                .iter()
                .map(|r| Removed { tilt_deg: tilt_deg(r), grains: r.moving.clone() })
                .collect()
        } else {
            Vec::new()
        };
        let one = Tilted { directions: vec![round.tilt.clone()], level: None };
        let file = tilt(&without(scene, &round.gone)?, &round.tilt.model, &one)?;
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
    let by_tilt =
        |&i: &usize, &j: &usize| directions[i].governing().total_cmp(&directions[j].governing());
    let Some(least) = (0..directions.len()).min_by(by_tilt) else { return Ok(None) };
    let file = files.swap_remove(least);
    let mut left_out = file.run.left_out.clone();
    if !loose.is_empty() {
        left_out.insert(0, format!("{} grains without a contact path to a support", loose.len()));
    }
    let packing = PackingFile {
        format: PackingFormat::V1,
        name: scene.name.clone(),
        grains: model.assembly.free().count(),
        contacts: model.interfaces.list.len(),
        moving_mass,
        least,
        directions,
        fabric: None,
        fabric_forces: None,
        doubt: None,
        left_out,
        warnings,
        timings: model.timings,
        versions: Versions::default(),
    };
    Ok(Some((packing, file)))
}
