//! Contacts that were left out, and what the answer is with them.

use base::number::{rounded_down, short};
use check::question::QuestionKind;
use check::{
    proof::result::ResultFile,
    terms::{Closed, ClosedAnswer, ClosedEnd, Difference, Law, Outcome},
    verdict::Verdict,
};

/// What an answer is with contacts that were left out, where that is another one or not known.
pub fn left_out(file: &ResultFile) -> Option<String> {
    let said = file.left_out_contacts.as_ref()?;
    // Time runs with the shapes themselves, not with these contacts.
    if matches!(file.question.kind(), QuestionKind::Simulate | QuestionKind::Shake) {
        return None;
    }
    let other = match &said.closed {
        Some(Closed { difference: Difference::None, .. }) => return None,
        Some(closed) => format!("with them closed {}", closed_words(file, closed)),
        None => "with them the answer may differ".to_string(),
    };
    let l = said.contacts;
    let overlaps = (l.overlaps > 0).then(|| {
        format!("{} that overlap by up to {} m", pairs(l.overlaps), short(l.deepest_overlap))
    });
    let near = (l.near_misses > 0).then(|| {
        format!("{} left apart by up to {} m", pairs(l.near_misses), short(l.greatest_gap))
    });
    let what = overlaps.into_iter().chain(near).collect::<Vec<_>>().join(" and ");
    Some(format!("without contacts between {what}; {other}"))
}

fn pairs(n: usize) -> String {
    if n == 1 { "1 pair of blocks".into() } else { format!("{n} pairs of blocks") }
}

fn closed_words(file: &ResultFile, closed: &Closed) -> String {
    let bound = |v: f64| match file.question.kind() {
        QuestionKind::Tilt => format!("it falls at {:.4}°", v.atan().to_degrees()),
        _ => format!("the load factor is {}", rounded_down(v)),
    };
    let text = match &closed.answer {
        ClosedAnswer::Thrust { least, greatest } => {
            let member = file.answer.thrust().is_some_and(|t| t.member.is_some());
            let what = if member { "force" } else { "thrust" };
            // Of forces that exist, as the range beside it is.
            return format!("the least {what} is {}, the greatest {}", end(least), end(greatest));
        }
        ClosedAnswer::Flips { values, start } => flips(values, *start),
        ClosedAnswer::Verdict(v) => verdict(*v).into(),
        ClosedAnswer::LoadFactor { status, value } => match (status, value) {
            (Outcome::Found, Some(value)) => bound(*value),
            (Outcome::Unbounded, _) => "there is no limit".into(),
            (Outcome::Impossible, _) => verdict(Verdict::Unstable).into(),
            (Outcome::Found | Outcome::Undecided, _) => verdict(Verdict::Undecided).into(),
        },
    };
    // The bound of the answer itself is what it is to be held against.
    let dry = file.dry.is_some() || file.motion.is_some();
    match closed.law {
        Law::Associative if dry => format!("{text} if joints that slide open"),
        _ => text,
    }
}

/// Flips that one line names; of more it names the ends, and the saved answer has them all.
const NAMED: usize = 4;

fn flips(values: &[f64], start: Verdict) -> String {
    let list = |values: &[f64]| values.iter().map(|v| short(*v)).collect::<Vec<_>>().join(", ");
    match values {
        [] => format!("{} throughout", verdict(start)),
        [first, .., last] if values.len() > NAMED => {
            format!("it flips {} times from {} to {}", values.len(), short(*first), short(*last))
        }
        values => format!("it flips at {}", list(values)),
    }
}

fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Stable => "it stands",
        Verdict::Conditional => "it stands only with self-stress",
        Verdict::Unstable => "it falls",
        Verdict::Undecided => "it is undecided",
    }
}

fn end(end: &ClosedEnd) -> String {
    match *end {
        ClosedEnd { status: Outcome::Found, value: Some(v) } => format!("{} N", short(v)),
        ClosedEnd { status: Outcome::Unbounded, .. } => "without a limit".into(),
        _ => "undecided".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_names_few_flips() {
        assert_eq!(flips(&[], Verdict::Stable), "it stands throughout");
        assert_eq!(flips(&[0.25, 0.5], Verdict::Stable), "it flips at 0.25, 0.5");
        let many = [0.1, 0.2, 0.3, 0.4, 0.5];
        assert_eq!(flips(&many, Verdict::Unstable), "it flips 5 times from 0.1 to 0.5");
    }
}
