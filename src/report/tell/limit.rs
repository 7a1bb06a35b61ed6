//! Load factors for people.

use super::{
    factor::{self, Dry, dry_of, dry_value, falls_by_itself, found, status},
    telling::{FactorWords, PLAIN, Telling},
};
use crate::text::page::Role;
use analysis::Outcome;
use base::number::{rounded_down, rounded_up};
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
    let dry = dry_of(file);
    let role = if matches!(dry, Dry::Never) { Role::Bad } else { Role::Value };
    match (status(&file.answer), found(&file.answer)) {
        (Outcome::Found, Some((value, _, upper))) => {
            let most = rounded_up(upper);
            let text = match dry {
                Dry::Same => carries(value),
                Dry::Other(v) => {
                    format!("{} with dry friction (proved upper bound {most})", carries(v))
                }
                Dry::Never if upper < 0.0 => format!("load factor at most {most}"),
                // That it falls without is said beside it.
                Dry::Never if falls_by_itself(file) => {
                    format!("no load factor with dry friction (proved upper bound {most})")
                }
                Dry::Never => format!(
                    "no load factor with dry friction: the blocks move under the dead load alone (at most {most} with self-stress)"
                ),
                Dry::UpTo(v) => format!(
                    "{} at least with dry friction, at most {most}; undecided in between",
                    carries(v)
                ),
                Dry::Undecided => {
                    format!("load factor at most {most}; with dry friction undecided")
                }
            };
            (text, if upper < 0.0 { Role::Bad } else { role })
        }
        (Outcome::Unbounded, _) => match (dry_value(file), dry) {
            (Some(v), _) => (format!("{} with dry friction ({WEDGES})", carries(v)), Role::Value),
            (None, Dry::Never) => (
                "no load factor with dry friction: the blocks move under the dead load alone"
                    .into(),
                Role::Bad,
            ),
            (None, Dry::UpTo(v)) => (
                format!("{} at least with dry friction, undecided beyond ({WEDGES})", carries(v)),
                Role::Unsure,
            ),
            (None, Dry::Undecided) => {
                (format!("with dry friction undecided ({WEDGES})"), Role::Unsure)
            }
            (None, Dry::Same | Dry::Other(_)) => {
                ("no limit: the live load wedges the blocks".into(), Role::Good)
            }
        },
        (Outcome::Impossible, _) => ("falls, whatever the live load".into(), Role::Bad),
        _ if matches!(dry, Dry::Never) => {
            ("no load factor with dry friction; the upper bound is undecided".into(), Role::Bad)
        }
        _ => ("undecided".into(), Role::Unsure),
    }
}

/// Where only dry friction sets a limit.
const WEDGES: &str = "no limit if joints that slide opened";

/// What a load factor means.
fn carries(value: f64) -> String {
    match value > 0.0 {
        true => format!("carries {} × the live load", rounded_down(value)),
        false => format!("load factor {}", rounded_down(value)),
    }
}
