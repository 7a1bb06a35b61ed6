//! Tilts for people.

use super::{
    factor::{self, Dry, at_rest_to, dry_of, dry_value, falls_by_itself, found, status},
    telling::{FactorWords, PLAIN, Telling},
};
use crate::text::{
    options::{SHOWN, TextOptions, cut},
    page::{Page, Role},
};
use analysis::{Outcome, coulomb::Found};
use base::number::{point, rounded_up};
use check::proof::result::ResultFile;

pub(super) const TELLING: Telling = Telling {
    verb: "tilt",
    asked: |_| {
        [
            "At what inclination of the ground does it fall?",
            "Gravity keeps its size and is rotated by this angle towards the direction given; weights \
             and dead loads rotate with it.",
        ]
    },
    title,
    why: |page, file| factor::why(page, file, TILT),
    rows: directions,
    factor: Some(TILT),
    ..PLAIN
};

/// What it is called.
const TILT: FactorWords = FactorWords { name: "tilt", without: "when level", tilt: true };

/// The tilt in a line.
fn title(file: &ResultFile) -> (String, Role) {
    let toward = file.answer.toward().map(|d| format!(" towards {}", point(d))).unwrap_or_default();
    let dry = dry_of(file);
    let role = if matches!(dry, Dry::Never) { Role::Bad } else { Role::Value };
    let moves = "moves even when level with dry friction";
    match (status(&file.answer), found(&file.answer)) {
        (Outcome::Found, Some(_)) if falls_by_itself(file) => {
            ("falls even when level".to_string(), Role::Bad)
        }
        (Outcome::Found, Some((value, _, upper))) => {
            let most = rounded_up(upper.atan().to_degrees());
            let text = match dry {
                Dry::Same => format!("falls at a tilt of {}°{toward}", at_rest_to(value)),
                Dry::Other(v) => format!(
                    "falls at a tilt of {}°{toward} with dry friction (proved upper bound {most}°)",
                    at_rest_to(v)
                ),
                Dry::Never => format!("{moves} (with self-stress up to {most}°{toward})"),
                Dry::UpTo(v) => format!(
                    "stands up to a tilt of {}°{toward} at least with dry friction, falls at {most}° at the latest",
                    at_rest_to(v)
                ),
                Dry::Undecided => format!(
                    "falls at a tilt of {most}°{toward} at the latest; with dry friction undecided"
                ),
            };
            (text, role)
        }
        (Outcome::Unbounded, _) => match (dry_value(file), dry) {
            (Some(v), _) => (
                format!(
                    "falls at a tilt of {}°{toward} with dry friction ({WEDGED})",
                    at_rest_to(v)
                ),
                Role::Value,
            ),
            (None, Dry::Never) => (moves.to_string(), Role::Bad),
            (None, Dry::UpTo(v)) => (
                format!(
                    "stands up to a tilt of {}°{toward} at least with dry friction, undecided beyond ({WEDGED})",
                    at_rest_to(v)
                ),
                Role::Unsure,
            ),
            (None, Dry::Undecided) => {
                (format!("with dry friction undecided ({WEDGED})"), Role::Unsure)
            }
            (None, Dry::Same | Dry::Other(_)) => {
                ("stands at every tilt below 90°".to_string(), Role::Good)
            }
        },
        (Outcome::Impossible, _) => (format!("falls, however it is tilted{toward}"), Role::Bad),
        _ => (format!("undecided{toward}"), Role::Unsure),
    }
}

/// Where only dry friction sets a limit.
const WEDGED: &str = "at no tilt if joints that slide opened";

/// Every direction of a tilt.
pub(super) fn directions(page: &mut Page, file: &ResultFile, options: TextOptions) {
    // Eight directions are what is asked for by default: they are shown in full.
    let options = TextOptions { verbose: options.verbose || file.directions.len() <= 8, ..options };
    let width = file
        .directions
        .iter()
        .filter_map(|d| d.answer.toward())
        .map(|d| point(d).chars().count())
        .max()
        .unwrap_or(0);
    let lines: Vec<String> = file
        .directions
        .iter()
        .map(|d| {
            let toward = d.answer.toward().map(point).unwrap_or_default();
            let dry = d.dry.as_ref().map(|dry| (dry.found, dry.value.map(at_rest_to)));
            let dry = match dry {
                Some((Found::FixedPoint | Found::Rests | Found::RestsBelow, Some(angle))) => {
                    format!(", with dry friction {angle}°")
                }
                Some((Found::NotAtRest, _)) => {
                    ", with dry friction it moves even when level".into()
                }
                Some((Found::Undecided, _)) => ", with dry friction undecided".into(),
                _ => String::new(),
            };
            let answer = match (status(&d.answer), found(&d.answer)) {
                (Outcome::Found, Some((value, ..))) => format!("{}°{dry}", at_rest_to(value)),
                (Outcome::Unbounded, _) => format!("stands at every tilt below 90°{dry}"),
                (Outcome::Impossible, _) => "falls at every tilt".into(),
                _ => "undecided".into(),
            };
            format!("{toward:<width$}  {answer}")
        })
        .collect();
    page.row("towards", cut(&lines, SHOWN, options));
}
