//! Contacts that were left out: how many there are is the scene's matter; the answer with them
//! closed is computed, and computed again.

use super::{Derivation, computed};
use crate::{
    proof::{answer::Answer, critical::CriticalResult, evidence::ClosedEvidence, told::Told},
    question::{AssessOptions, Question},
    terms::{Bound, Closed, ClosedAnswer, ClosedEnd, Difference, LeftOutContacts},
    verdict::{Rate, Verdict, claim::Findings, evidence::read_rates},
};

impl Derivation<'_> {
    /// Adds contacts that were left out, where there are any, with the answer in which they are
    /// closed, where that was asked.
    pub(super) fn left_out(
        &mut self,
        told: &mut Told,
        e: Option<&ClosedEvidence>,
    ) -> Result<(), String> {
        let Some(contacts) = self.model.interfaces.left_out else {
            return match e {
                Some(_) => Err("the evidence closes contacts, but none were left out".into()),
                None => Ok(()),
            };
        };
        // What falls while they are at rest falls with them as well.
        if matches!(&told.answer, Answer::Verdict(v) if v.verdict == Verdict::Unstable)
            && self.check.claimed
            && let Ok(rates) = read_rates(&self.model.assembly, &told.certificate.rates)
            && self.model.interfaces.apart.iter().flatten().all(|&i| rates[i] == Rate::zero())
        {
            return Ok(());
        }
        let mut f = Findings::default();
        f.holds.push("contacts were left out".into());
        let closed = match e {
            None => None,
            Some(e) => {
                let given = given(self.question, told, e)
                    .ok_or("this question is not repeated with contacts closed")?;
                f.computed = true;
                if self.asks_again() {
                    // Where it does not stand, or one end was asked, whether it does was asked again.
                    let verdict = match (self.question, &told.answer) {
                        (Question::Thrust(o), Answer::Verdict(_)) => {
                            Some(Question::Assess(AssessOptions { law: o.law }))
                        }
                        _ => None,
                    };
                    let question = verdict.as_ref().unwrap_or(self.question);
                    let here = self.again.closed(question, e.law, self.scene, self.model);
                    let same = here.map(|here| {
                        here.is_some_and(|(law, answer)| {
                            law == e.law
                                && (answer == e.answer
                                    || answer.beside(&e.answer) == Difference::None)
                        })
                    });
                    computed(&mut f, same, "the answer with the left-out contacts closed".into());
                }
                let difference = e.answer.beside(&given);
                Some(Closed { law: e.law, answer: e.answer.clone(), difference })
            }
        };
        self.part("contacts left out", f);
        told.left_out_contacts = Some(LeftOutContacts { contacts, closed });
        Ok(())
    }
}

/// The answer that it is compared with.
fn given(question: &Question, told: &Told, e: &ClosedEvidence) -> Option<ClosedAnswer> {
    let factor = |b: &Bound| ClosedAnswer::LoadFactor { status: b.status, value: b.value };
    match (question, &told.answer) {
        (Question::Assess(_) | Question::Thrust(_), Answer::Verdict(a)) => {
            Some(ClosedAnswer::verdict(a.verdict, e.law))
        }
        (Question::Thrust(_), Answer::Thrust(t)) => {
            let end = |b: &Bound| ClosedEnd { status: b.status, value: b.value };
            Some(ClosedAnswer::Thrust { least: end(&t.least), greatest: end(&t.greatest) })
        }
        (
            Question::Limit(_) | Question::Tilt(_) | Question::Kinematic(_) | Question::Moving(_),
            answer,
        ) => {
            let all = told.directions.iter().map(|d| &d.answer).chain([answer]);
            ClosedAnswer::least(all.filter_map(Answer::bound).map(factor))
        }
        (Question::Critical(_), Answer::Critical(found)) => {
            let scan = told.critical.as_ref().and_then(CriticalResult::first_verdict);
            let values = found.iter().map(|f| f.value).collect();
            Some(ClosedAnswer::Flips { values, start: scan.unwrap_or(Verdict::Undecided) })
        }
        _ => None,
    }
}
