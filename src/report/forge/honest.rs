//! Honest results of a scene, with the forces and rates they were made of.

use crate::{
    analysis::{
        Assessment, Control, Law, LoadFactor, Outcome, assess,
        coulomb::{self, DryLoadFactor},
        critical,
        critical::Range,
        flip::Probe,
        limit, thrust,
        thrust::{first_support, outwards},
        tilt,
        tilt::tilted,
    },
    error::InputError,
    interface::{Model, prepare},
    report::{Leaning, ResultFile, critical::Side, result::assessment, verify::verify_model},
    scene::Scene,
    verdict::{Verdict, thrust::ThrustAt},
};
use nalgebra::Vector3;
use serde_json::{Value, json};

/// A proved result.
pub(super) struct Honest {
    /// The question.
    pub name: &'static str,
    pub scene: Scene,
    pub model: Model,
    pub file: Value,
    /// The verdict under dead load, as computed.
    pub standing: Assessment,
    /// The load factor, where it was asked.
    pub limit: Option<(LoadFactor, Option<DryLoadFactor>)>,
    /// Critical: proofs at the ends of the range, far from the flip.
    pub ends: Vec<Value>,
}

/// Seconds for a question.
const SECONDS: f64 = 10.0;
/// One scene in so many is asked further questions.
const TILTED: usize = 4;
const THRUST: usize = 5;
const CRITICAL: usize = 6;

/// The results of a scene that are proved. Not every scene is asked everything: `turn` says which of a family it is.
pub(super) fn results(scene: &Scene, turn: usize) -> Result<Vec<Honest>, InputError> {
    let control = Control { law: Law::Coulomb, seconds: SECONDS, ..Control::default() };
    let model = prepare(scene)?;
    let standing = assess(&model, &control);
    let mut list = Vec::new();
    let mut add = |name, file: ResultFile, limit, ends| {
        if verify_model(&file, scene, &model).proved()
            && let Ok(file) = serde_json::to_value(&file)
        {
            list.push(Honest { name, scene: scene.clone(), model: model.clone(), file, standing: standing.clone(), limit, ends });
        }
    };
    add("assess", ResultFile::assessment(scene, &model, &standing), None, Vec::new());
    let bound = limit(&model, &control);
    let dry = matches!(bound.outcome, Outcome::Found | Outcome::Unbounded)
        .then(|| coulomb::load_factor_from(&model, &bound, Some(standing.verdict), &control));
    let mut file = ResultFile::load_factor(scene, &model, &bound);
    if let Some(dry) = &dry {
        file = file.with_dry(&model, dry);
    }
    add("limit", file.with_dead_load(&model, &standing), Some((bound, dry)), Vec::new());
    if turn.is_multiple_of(TILTED)
        && let Ok(leaning) = leaning(&model, standing.verdict, &control)
        && let Some(file) = ResultFile::tilt(scene, &leaning)
    {
        add("tilt", file, None, Vec::new());
    }
    if turn.is_multiple_of(THRUST)
        && let Some(support) = first_support(&model)
        && let Some(direction) = outwards(&model, support)
    {
        let at = ThrustAt { support, direction: direction.into() };
        add("thrust", ResultFile::thrust(scene, &model, &thrust::answer(&model, at, &control)), None, Vec::new());
    }
    if turn.is_multiple_of(CRITICAL) {
        let range = Range { pointer: "/joints/default/friction".into(), from: 0.02, to: 1.5, scan: Some(4) };
        let found = critical(scene, &range, &Control { law: Law::Associative, ..control })?;
        let ends = [range.from, range.to].into_iter().filter_map(|v| end(scene, &range.pointer, v, &control)).collect();
        add("critical", ResultFile::critical(scene, &model, &found), None, ends);
    }
    Ok(list)
}

/// Tilts in two directions, with dry friction.
fn leaning(model: &Model, level: Verdict, control: &Control) -> Result<Vec<Leaning>, InputError> {
    [Vector3::x(), Vector3::y()]
        .into_iter()
        .map(|direction| {
            let tilt = tilt(model, direction, control)?;
            let turned = tilted(model, direction, tilt.load_factor.value)?;
            let dry = match tilt.load_factor.outcome {
                Outcome::Found | Outcome::Unbounded => {
                    let dry = tilt::dry(model, &tilt, Some(level), control)?;
                    Some((tilted(model, direction, dry.value)?, dry))
                }
                _ => None,
            };
            Ok(Leaning { model: turned, tilt, dry })
        })
        .collect()
}

/// A value of the scene with its verdict and the proof of it.
fn end(scene: &Scene, pointer: &str, value: f64, control: &Control) -> Option<Value> {
    let control = Control { law: Law::Associative, ..*control };
    let Probe { model, assessment: answer, .. } = critical::probe(scene, pointer, value, &control).ok()?;
    let (answer, certificate, _) = assessment(&model, &answer);
    Some(json!(Side { value, answer, certificate }))
}
