//! Whether contacts that were left out could change the answer: it is asked once more with them
//! closed. The answer stays that of the scene as it is; the other stands beside it.
//!
//! Asked are `assess`, `limit` and `tilt`. A load factor or tilt is asked with associative sliding,
//! which takes a small part of the time that dry friction takes, and compared with the bound of the
//! answer; a verdict as it was asked in scenes of few contacts, else whether forces exist.

use super::{
    Answer, AssessOptions, Control, KinematicOptions, LimitOptions, LoadFactor, MovingOptions,
    Question, TiltOptions, ask,
};
use crate::{
    interface::{self, Model},
    scene::Scene,
    terms::{Closed, ClosedAnswer, Law, LeftOutContacts},
};

/// With more contact points than this the question is not put again: it would take longer than
/// seconds.
pub const MOST_POINTS: usize = 3_000;
/// With more contact points than this a verdict is asked again without dry friction.
const MOST_POINTS_DRY: usize = 600;

/// An answer as far as it can be compared: of a load factor the bound, of tilts the least. With
/// `law` associative a verdict is whether forces exist.
fn compared(answer: &Answer, law: Law) -> Option<ClosedAnswer> {
    let factor = |l: &LoadFactor| ClosedAnswer::LoadFactor { status: l.outcome, value: l.found() };
    match answer {
        Answer::Assess(a) => Some(ClosedAnswer::verdict(a.verdict, law)),
        Answer::Limit(l) => Some(factor(&l.bound)),
        Answer::Tilt(t) => ClosedAnswer::least(t.directions.iter().map(|d| factor(&d.load_factor))),
        Answer::Moving(m) => ClosedAnswer::least(m.positions.iter().map(|s| factor(&s.bound))),
        Answer::Kinematic(k) => ClosedAnswer::least(k.directions.iter().map(|d| factor(&d.bound))),
        _ => None,
    }
}

/// How joints slide where a question is put again.
pub fn law_again(question: &Question, model: &Model) -> Law {
    match question {
        Question::Assess(o) if model.contact_points() <= MOST_POINTS_DRY => o.law,
        _ => Law::Associative,
    }
}

/// The same question with contacts closed; nothing where it is not put again.
pub fn again(
    question: &Question,
    scene: &Scene,
    model: &Model,
    control: &Control,
) -> Option<(Law, ClosedAnswer)> {
    if control.deadline.is_over() || model.contact_points() > MOST_POINTS {
        return None;
    }
    let other = interface::closed(model).ok().flatten()?;
    if other.contact_points() > MOST_POINTS {
        return None;
    }
    let law = law_again(question, model);
    let question = match question {
        Question::Assess(_) => Question::Assess(AssessOptions { law }),
        Question::Limit(_) => Question::Limit(LimitOptions { law, require: None, skip_dead: true }),
        Question::Tilt(o) => {
            Question::Tilt(TiltOptions { law, require: None, skip_dead: true, ..o.clone() })
        }
        Question::Moving(_) => {
            Question::Moving(MovingOptions { law, skip_dead: true, ..MovingOptions::default() })
        }
        Question::Kinematic(o) => Question::Kinematic(KinematicOptions {
            law,
            require: None,
            skip_dead: true,
            linear: true,
            at: Vec::new(),
            ..o.clone()
        }),
        _ => return None,
    };
    let answer = ask(&question, scene, &other, control).ok()?;
    Some((law, compared(&answer, law)?))
}

/// What was left out, and what the answer is with it; nothing where nothing was left out.
pub fn left_out(
    question: &Question,
    scene: &Scene,
    model: &Model,
    answer: &Answer,
    control: &Control,
) -> Option<LeftOutContacts> {
    let contacts = model.interfaces.left_out?;
    let closed = again(question, scene, model, control).and_then(|(law, closed)| {
        let given = compared(answer, law)?;
        Some(Closed { law, answer: closed, difference: closed.beside(given) })
    });
    Some(LeftOutContacts { contacts, closed })
}
