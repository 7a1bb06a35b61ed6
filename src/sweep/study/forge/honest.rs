//! Honest results of a scene, with the forces and rates they were made of.

use analysis::{
    Answer, AssessOptions, Assessment, Control, CriticalOptions, Law, LimitOptions, Limited,
    Proved, Question, ThrustOptions, TiltOptions, ask, critical::probe, recompute::Solvers, saved,
};
use base::error::InputError;
use check::proof::verify::verify_model;
use model::interface::{Model, prepare};
use scene::Scene;
use serde_json::{Value, json};
use solve::deadline::Deadline;

/// A proved result.
pub(super) struct Honest {
    /// The question.
    pub name: &'static str,
    pub scene: Scene,
    pub model: Model,
    pub file: Value,
    /// The verdict under dead load, as computed.
    pub standing: Proved<Assessment>,
    /// The load factor, where it was asked.
    pub limit: Option<Limited>,
    /// Critical: proofs at the ends of the range, far from the flip.
    pub ends: Vec<Value>,
}

/// Seconds for a question.
const SECONDS: f64 = 10.0;
/// One scene in so many is asked further questions.
const TILTED: usize = 4;
const THRUST: usize = 5;
const CRITICAL: usize = 6;

/// The results of a scene that are proved. Not every scene is asked everything: `turn` says which
/// of a family it is.
pub(super) fn results(scene: &Scene, turn: usize) -> Result<Vec<Honest>, InputError> {
    let model = prepare(scene)?;
    let control = || Control { deadline: Deadline::within(SECONDS), ..Control::default() };
    let Answer::Assess(standing) =
        ask(&Question::Assess(AssessOptions::default()), scene, &model, &control())?
    else {
        return Ok(Vec::new());
    };
    let range = CriticalOptions {
        law: Law::Associative,
        vary: "/joints/default/friction".into(),
        between: [0.02, 1.5],
        scan: Some(4),
    };
    let toward = vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let questions = [
        (true, Question::Assess(AssessOptions::default())),
        (true, Question::Limit(LimitOptions::default())),
        (
            turn.is_multiple_of(TILTED),
            Question::Tilt(TiltOptions { toward, ..TiltOptions::default() }),
        ),
        (
            turn.is_multiple_of(THRUST),
            Question::Thrust(ThrustOptions { range: true, ..ThrustOptions::default() }),
        ),
        (turn.is_multiple_of(CRITICAL), Question::Critical(range.clone())),
    ];
    let mut list = Vec::new();
    for (_, question) in questions.iter().filter(|(wanted, _)| *wanted) {
        // Of some scenes not everything can be asked: dead loads that do not hang, supports that
        // nothing pushes.
        let Ok(answer) = ask(question, scene, &model, &control()) else { continue };
        let Some(file) = saved::of(scene, &model, &answer) else { continue };
        if !verify_model(&file, scene, &model, &Solvers).proved() {
            continue;
        }
        let Ok(file) = file.to_value() else { continue };
        let ends = match question {
            Question::Critical(o) => {
                o.between.into_iter().filter_map(|v| end(scene, &o.vary, v, &control())).collect()
            }
            _ => Vec::new(),
        };
        let limit = match answer {
            Answer::Limit(l) => Some(*l),
            _ => None,
        };
        let (name, scene, model, standing) =
            (question.word(), scene.clone(), model.clone(), standing.clone());
        list.push(Honest { name, scene, model, file, standing, limit, ends });
    }
    Ok(list)
}

/// A value of the scene with its verdict and the proof of it.
fn end(scene: &Scene, pointer: &str, value: f64, control: &Control) -> Option<Value> {
    let control = Control { law: Law::Associative, ..*control };
    Some(json!(saved::side(&probe(scene, pointer, value, &control).ok()?.proved())))
}
