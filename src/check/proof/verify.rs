//! Verifying a saved result: the answer is derived from the question, the scene and the evidence in
//! it, and compared with the one that the file gives. Nothing that the file says about itself is
//! believed.

use super::{
    compare,
    derive::{Derived, Verification, derive, failure},
    recompute::Recompute,
    result::{ResultFile, Saved},
};
use base::error::InputError;
use model::interface::{Model, prepare};
use scene::Scene;

/// What the verification of a result found.
#[derive(Clone, Debug)]
pub struct Verified {
    /// The result as it was derived; nothing where the evidence is none for its question.
    pub file: Option<ResultFile>,
    /// What holds, and what does not.
    pub check: Verification,
}

impl std::ops::Deref for Verified {
    type Target = Verification;

    fn deref(&self) -> &Verification {
        &self.check
    }
}

/// Verifies a result against a scene: the one inside it, or one that the reader trusts more.
///
/// # Errors
/// The scene cannot be resolved.
pub fn verify(saved: &Saved, scene: &Scene, again: &dyn Recompute) -> Result<Verified, InputError> {
    Ok(verify_model(saved, scene, &prepare(scene)?, again))
}

/// The same against a scene that is prepared already as `model`.
pub fn verify_model(
    saved: &Saved,
    scene: &Scene,
    model: &Model,
    again: &dyn Recompute,
) -> Verified {
    let evidence = (saved.evidence.clone(), saved.closed.clone());
    match derive(saved.question.clone(), scene, model, evidence, saved.run.clone(), again) {
        Ok(Derived { file, mut check }) => {
            let here = serde_json::to_value(&file.told).unwrap_or_default();
            check.parts.push(("answer in the file".into(), match compare::difference(&saved.answer, &here) {
                None => crate::verdict::claim::Findings { holds: vec!["the answer follows from the evidence".into()], ..Default::default() },
                Some(at) => failure(format!(
                    "the answer in the file does not follow from its evidence: it differs at answer{at}"
                )),
            }));
            Verified { file: Some(file), check }
        }
        Err(text) => {
            let scene = model.findings().cloned().collect();
            let parts = vec![("evidence".into(), failure(text))];
            Verified { file: None, check: Verification { parts, claimed: false, scene } }
        }
    }
}
