//! Whether contacts that were left out could change the answer: it is asked once more with them
//! closed. The answer stays that of the scene as it is; the other stands beside it.
//!
//! Asked are verdicts, load factors, tilts, thrusts and critical values. A load factor or tilt is
//! asked with associative sliding, which takes a small part of the time that dry friction takes, and
//! compared with the bound of the answer; a verdict as it was asked in scenes of few contacts, else
//! whether forces exist; a thrust at the same place in the same direction, where it stands, else
//! whether it does; flips with the law that they were asked for, in scenes of few contacts.

use super::{
    Answer, AssessOptions, Control, Critical, CriticalOptions, KinematicOptions, LimitOptions,
    LoadFactor, MovingOptions, Proved, Question, ThrustOptions, TiltOptions, ask,
    thrust::{Thrust, ThrustEnd},
};
use check::{
    terms::{Closed, ClosedAnswer, ClosedEnd, Law, LeftOutContacts},
    verdict::{Verdict, thrust::Sought},
};
use model::interface::{self, Model};
use scene::Scene;

/// With more contact points than this the question is not put again: it would take longer than
/// seconds.
pub const MOST_POINTS: usize = 3_000;
/// With more contact points than this a verdict is asked again without dry friction, and flips are
/// not.
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
        Answer::Thrust(t) => Some(thrust(t, law)),
        Answer::Critical(c) => Some(flips(c)),
        _ => None,
    }
}

fn thrust(t: &Thrust, law: Law) -> ClosedAnswer {
    let end = |e: &Proved<ThrustEnd>| ClosedEnd { status: e.outcome, value: e.value };
    match &t.ends[..] {
        [least, greatest] => ClosedAnswer::Thrust { least: end(least), greatest: end(greatest) },
        _ => ClosedAnswer::verdict(t.standing.verdict, law),
    }
}

fn flips(c: &Critical) -> ClosedAnswer {
    let start = c.scan.first().and_then(|s| s.outcome.as_ref().ok());
    ClosedAnswer::Flips {
        values: c.changes.iter().map(|f| f.value).collect(),
        start: start.map_or(Verdict::Undecided, |(verdict, _)| *verdict),
    }
}

/// How joints slide where a question is put again.
pub fn law_again(question: &Question, model: &Model) -> Law {
    match question {
        Question::Assess(o) if model.contact_points() <= MOST_POINTS_DRY => o.law,
        Question::Critical(o) => o.law,
        _ => Law::Associative,
    }
}

/// The same question with contacts closed; nothing where it is not put again. Of a thrust both ends,
/// at the support or member that it names.
pub fn again(
    question: &Question,
    scene: &Scene,
    model: &Model,
    control: &Control,
) -> Option<(Law, ClosedAnswer)> {
    let most = match question {
        Question::Critical(_) => MOST_POINTS_DRY,
        _ => MOST_POINTS,
    };
    if control.deadline.is_over() || model.contact_points() > most {
        return None;
    }
    let other = interface::closed(model).ok().flatten()?;
    if other.contact_points() > most {
        return None;
    }
    let law = law_again(question, model);
    let ask = |question: &Question, scene: &Scene| ask(question, scene, &other, control).ok();
    let question = match question {
        Question::Assess(_) => Question::Assess(AssessOptions { law }),
        Question::Limit(_) => {
            Question::Limit(LimitOptions { law, skip_dead: true, ..LimitOptions::default() })
        }
        Question::Tilt(o) => Question::Tilt(TiltOptions {
            law,
            require: None,
            skip_dead: true,
            sensitivity: false,
            ..o.clone()
        }),
        Question::Moving(_) => {
            Question::Moving(MovingOptions { law, skip_dead: true, ..MovingOptions::default() })
        }
        Question::Kinematic(o) => Question::Kinematic(KinematicOptions {
            law,
            require: None,
            skip_dead: true,
            linear: true,
            verify: None,
            sensitivity: false,
            at: Vec::new(),
            ..o.clone()
        }),
        // One end after the other: both in one come with the geometric safety factor.
        Question::Thrust(o) => {
            let end = |greatest| {
                let one = ThrustOptions { law, greatest, range: false, require: None, ..o.clone() };
                match ask(&Question::Thrust(one), scene) {
                    Some(Answer::Thrust(t)) => Some(*t),
                    _ => None,
                }
            };
            let mut least = end(false)?;
            if !least.ends.is_empty() {
                least.ends.extend(end(true)?.ends);
            }
            return Some((law, thrust(&least, law)));
        }
        Question::Critical(o) => {
            let scene = Scene { contact: other.assembly.contact.clone(), ..scene.clone() };
            let same = CriticalOptions { law, ..o.clone() };
            return Some((law, compared(&ask(&Question::Critical(same), &scene)?, law)?));
        }
        _ => return None,
    };
    Some((law, compared(&ask(&question, scene)?, law)?))
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
    let placed = placed(question, model, answer);
    let question = placed.as_ref().unwrap_or(question);
    // What time cut short is no answer to compare with.
    let closed = again(question, scene, model, control).filter(|_| !control.deadline.is_over());
    let closed = closed.and_then(|(law, closed)| {
        let given = compared(answer, law)?;
        Some(Closed { law, difference: closed.beside(&given), answer: closed })
    });
    Some(LeftOutContacts { contacts, closed })
}

/// The question about a thrust as it was understood: contacts that are closed could make another
/// support the first, and another direction outwards. Where it does not stand: whether it does.
fn placed(question: &Question, model: &Model, answer: &Answer) -> Option<Question> {
    let (Question::Thrust(o), Answer::Thrust(t)) = (question, answer) else { return None };
    if t.ends.len() < 2 {
        return Some(Question::Assess(AssessOptions { law: o.law }));
    }
    let (support, member, direction) = match t.at {
        Sought::Thrust(at) => {
            (Some(model.assembly.blocks[at.support].id.clone()), None, Some(at.direction))
        }
        Sought::Member(at) => {
            (None, Some(model.interfaces.members[at.member].id.clone()), at.along)
        }
    };
    Some(Question::Thrust(ThrustOptions { support, member, direction, ..o.clone() }))
}
