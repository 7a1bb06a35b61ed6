//! Load factors for people.

use super::{
    factor::{self, Dry, dry_of, dry_value, falls_by_itself, found, status},
    telling::{FactorWords, PLAIN, Telling},
};
use crate::text::page::Role;
use analysis::Outcome;
use base::number::{bracketed, computed};
use check::proof::result::ResultFile;

pub(super) const TELLING: Telling = Telling {
    verb: "limit",
    asked: |_| {
        [
            "By how much may the live loads listed below be multiplied until it falls?",
            "λ multiplies all live loads together; weights and dead loads stay as they are. λ = 1 is \
             the live loads as listed; the scene falls where λ goes beyond the value above.",
        ]
    },
    title,
    why: |page, file| factor::why(page, file, LAMBDA),
    factor: Some(LAMBDA),
    ..PLAIN
};

/// What it is called.
pub(super) const LAMBDA: FactorWords =
    FactorWords { name: "λ", without: "without its live load", tilt: false };

/// The load factor in a line.
pub(super) fn title(file: &ResultFile) -> (String, Role) {
    match (status(&file.answer), found(&file.answer)) {
            (Outcome::Found, Some((value, lower, upper))) => {
                let role = if upper < 0.0 { Role::Bad } else { Role::Value };
                let bound = bracketed(value, lower, upper);
                let text = match dry_of(file) {
                    Dry::Same => format!("λ = {bound}"),
                    Dry::Other(v) => format!("λ = {} with dry friction, at most {bound}", computed(v)),
                    Dry::Never if upper < 0.0 => format!("λ at most {bound}"),
                    // That it falls without is said beside it.
                    Dry::Never if falls_by_itself(file) => format!("no λ with dry friction, at most {bound}"),
                    Dry::Never => format!("no λ with dry friction: not at rest under the dead load (at most {bound} with a pre-stress)"),
                    Dry::UpTo(v) => format!("λ at most {bound}; with dry friction at rest up to {}, then undecided", computed(v)),
                    Dry::Undecided => format!("λ at most {bound}; with dry friction undecided"),
                };
                (text, if matches!(dry_of(file), Dry::Never) { Role::Bad } else { role })
            }
            (Outcome::Unbounded, _) => match dry_value(file) {
                Some(v) => (format!("the live load wedges where joints open as they slide; with dry friction λ = {}", computed(v)), Role::Value),
                None => match dry_of(file) {
                    Dry::Never => ("no λ with dry friction: not at rest under the dead load".to_string(), Role::Bad),
                    Dry::UpTo(v) => {
                        let text = "the live load wedges where joints open as they slide; with dry friction at rest up to";
                        (format!("{text} λ = {}, then undecided", computed(v)), Role::Unsure)
                    }
                    Dry::Undecided => {
                        ("the live load wedges where joints open as they slide; with dry friction undecided".to_string(), Role::Unsure)
                    }
                    Dry::Same | Dry::Other(_) => ("the live load wedges: it can grow without limit".to_string(), Role::Good),
                },
            },
            (Outcome::Impossible, _) => ("falls, whatever the live load".to_string(), Role::Bad),
            _ if matches!(dry_of(file), Dry::Never) => ("no λ with dry friction, the bound undecided".to_string(), Role::Bad),
            _ => ("undecided".to_string(), Role::Unsure),
    }
}
