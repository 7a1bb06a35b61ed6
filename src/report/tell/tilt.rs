//! Tilts for people.

use super::{
    factor::{self, Dry, at_rest_to, degrees, dry_of, dry_value, falls_by_itself, found, status},
    telling::{FactorWords, PLAIN, Telling},
};
use crate::text::{
    options::{SHOWN, TextOptions, cut},
    page::{Page, Role},
};
use analysis::{Outcome, coulomb::Found};
use base::number::point;
use check::proof::result::ResultFile;

pub(super) const TELLING: Telling = Telling {
    verb: "tilt",
    asked: |_| {
        [
            "At what inclination of the ground does it fall?",
            "Gravity keeps its size and is turned by this angle towards the direction given; weights \
             and dead loads turn with it.",
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
    match (status(&file.answer), found(&file.answer)) {
                (Outcome::Found, Some(_)) if falls_by_itself(file) => ("falls even when level".to_string(), Role::Bad),
                (Outcome::Found, Some(l)) => {
                    let bound = degrees(l);
                    let text = match dry_of(file) {
                        Dry::Same => format!("falls at a tilt of {bound}°{toward}"),
                        Dry::Other(v) => {
                            format!("falls at a tilt of {}°{toward} with dry friction, at {bound}° at the latest", at_rest_to(v))
                        }
                        Dry::Never => format!("not even at rest when level with dry friction (with a pre-stress up to {bound}°{toward})"),
                        Dry::UpTo(v) => {
                            let up_to = at_rest_to(v);
                            format!("falls at a tilt of {bound}°{toward} at the latest; with dry friction at rest up to {up_to}°")
                        }
                        Dry::Undecided => format!("falls at a tilt of {bound}°{toward} at the latest; with dry friction undecided"),
                    };
                    (text, if matches!(dry_of(file), Dry::Never) { Role::Bad } else { Role::Value })
                }
                (Outcome::Unbounded, _) => match dry_value(file) {
                    Some(v) => {
                        let angle = at_rest_to(v);
                        let text =
                            format!("stands at every tilt where joints open as they slide; falls at {angle}°{toward} with dry friction");
                        (text, Role::Value)
                    }
                    None => match dry_of(file) {
                        Dry::Never => ("not even at rest when level with dry friction".to_string(), Role::Bad),
                        Dry::UpTo(v) => {
                            let up_to = at_rest_to(v);
                            let text = "stands at every tilt where joints open as they slide; with dry friction at rest up to";
                            (format!("{text} {up_to}°{toward}, then undecided"), Role::Unsure)
                        }
                        Dry::Undecided => {
                            ("stands at every tilt where joints open as they slide; with dry friction undecided".to_string(), Role::Unsure)
                        }
                        Dry::Same | Dry::Other(_) => ("stands at every tilt below 90°".to_string(), Role::Good),
                    },
                },
                (Outcome::Impossible, _) => (format!("falls, however it is tilted{toward}"), Role::Bad),
                _ => (format!("undecided{toward}"), Role::Unsure),
            }
}

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
                Some((Found::NotAtRest, _)) => ", with dry friction not even level".into(),
                Some((Found::Undecided, _)) => ", with dry friction undecided".into(),
                _ => String::new(),
            };
            let answer = match (status(&d.answer), found(&d.answer)) {
                (Outcome::Found, Some(l)) => format!("{}°{dry}", degrees(l)),
                (Outcome::Unbounded, _) => format!("stands at every tilt below 90°{dry}"),
                (Outcome::Impossible, _) => "falls at every tilt".into(),
                _ => "undecided".into(),
            };
            format!("{toward:<width$}  {answer}")
        })
        .collect();
    page.row("towards", cut(&lines, SHOWN, options));
}
