//! Honest results of a scene, of every kind of question that it can be asked.

use analysis::{
    Answer, AssessOptions, Assessment, Control, ControlPoint, CriticalOptions, KinematicOptions,
    Law, LimitOptions, Limited, Proved, PushOptions, Question, SettleOptions, SimulateOptions,
    StagesOptions, StateOptions, SupportMove, ThrustOptions, TiltOptions, WithoutOptions, ask,
    assess, recompute::Solvers, saved,
};
use base::error::InputError;
use check::proof::{read::read_str, verify::verify_model};
use model::interface::{Model, prepare};
use scene::Scene;
use serde_json::Value;
use solve::deadline::Deadline;

/// A proved result.
pub(super) struct Honest {
    /// The question.
    pub name: &'static str,
    pub model: Model,
    pub file: Value,
    /// The verdict under dead load, as computed.
    pub standing: Proved<Assessment>,
    /// The load factor, where it was asked.
    pub limit: Option<Limited>,
}

/// Seconds for a question.
const SECONDS: f64 = 10.0;

/// The results of a scene that are proved. Not every scene is asked everything: `turn` says which
/// of a family it is.
pub(super) fn results(scene: &Scene, turn: usize) -> Result<Vec<Honest>, InputError> {
    let model = prepare(scene)?;
    let standing = assess(&model, &control());
    let mut list = Vec::new();
    for question in questions(&model, turn) {
        // Of some scenes not everything can be asked: dead loads that do not hang, supports that
        // nothing pushes.
        let Some((answer, file)) = answered(&question, scene, &model) else { continue };
        let Ok(saved) = read_str("honest", file.to_string()) else { continue };
        if verify_model(&saved, scene, &model, &Solvers::default()).proved() {
            let limit = match answer {
                Answer::Limit(l) => Some(*l),
                _ => None,
            };
            let (name, model, standing) = (question.word(), model.clone(), standing.clone());
            list.push(Honest { name, model, file, standing, limit });
        }
    }
    Ok(list)
}

/// The result of a question; nothing where it cannot be asked.
pub(super) fn asked(question: &Question, scene: &Scene, model: &Model) -> Option<Value> {
    answered(question, scene, model).map(|(_, file)| file)
}

fn answered(question: &Question, scene: &Scene, model: &Model) -> Option<(Answer, Value)> {
    let answer = ask(question, scene, model, &control()).ok()?;
    let file = saved::of(question, scene, model, &answer).ok()?.to_value().ok()?;
    Some((answer, file))
}

fn control() -> Control {
    Control { deadline: Deadline::within(SECONDS), ..Control::default() }
}

/// Questions of every kind; the dear ones by turns.
fn questions(model: &Model, turn: usize) -> Vec<Question> {
    let blocks = &model.assembly.blocks;
    let mut list =
        vec![Question::Assess(AssessOptions::default()), Question::Limit(LimitOptions::default())];
    let toward = vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let free = model
        .assembly
        .free()
        .max_by(|&i, &j| blocks[i].centroid.z.total_cmp(&blocks[j].centroid.z));
    let control = free
        .map(|i| ControlPoint { block: blocks[i].id.clone(), point: blocks[i].centroid.into() });
    match turn % 9 {
        0 => list.push(Question::Tilt(TiltOptions { toward, ..TiltOptions::default() })),
        1 => list.push(Question::Thrust(ThrustOptions { range: true, ..ThrustOptions::default() })),
        2 => list.push(Question::Critical(CriticalOptions {
            law: Law::Associative,
            vary: "/joints/default/friction".into(),
            between: [0.02, 1.5],
            scan: Some(4),
        })),
        3 if blocks.len() < 12 => list.push(WithoutOptions::default().into()),
        3 => list.push(Question::Stages(StagesOptions::default())),
        4 => list.push(Question::Simulate(SimulateOptions {
            fast: true,
            seconds: Some(0.5),
            ..SimulateOptions::default()
        })),
        5 => list
            .push(Question::Kinematic(KinematicOptions { toward, ..KinematicOptions::default() })),
        6 => list.push(Question::State(StateOptions::default())),
        7 => {
            let own = blocks
                .iter()
                .filter(|b| b.support)
                .map(|b| SupportMove::along(b.id.clone(), [0.05 * b.size, 0.0, 0.0]));
            list.push(Question::Settle(SettleOptions {
                moves: own.take(1).collect(),
                ..SettleOptions::default()
            }));
        }
        _ => list.extend(control.map(|control| {
            Question::Push(PushOptions {
                control,
                toward: [1.0, 0.0, 0.0],
                at: Vec::new(),
                from: Vec::new(),
            })
        })),
    }
    list
}
