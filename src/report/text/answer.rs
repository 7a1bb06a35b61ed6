//! The first line and the sentences below it.

use super::{
    SHOWN, TextOptions, cut,
    left_out::left_out,
    page::{Page, Role},
    simulation,
};
use analysis::{Outcome, coulomb::Found};
use base::number::{
    bracketed, computed, computed_tilt, decimals, ends, moving, moving_tilt, point,
};
use check::question::QuestionKind;
use check::{
    proof::{answer::Answer, certificate::DryResult, result::ResultFile},
    verdict::{Verdict, claim::Claim},
};

/// What is said with the contact tolerances that it rests on, where the scene has widened them.
pub(super) fn under(file: &ResultFile, text: impl std::fmt::Display) -> String {
    match file.scene.input.contact.widened() {
        Some(words) => format!("{text} (contact tolerances widened by the scene: {words})"),
        None => text.to_string(),
    }
}

/// The answer in one line.
pub(super) fn title(page: &mut Page, file: &ResultFile) {
    let (text, role) = match file.question.kind() {
        QuestionKind::Assess => match file.answer.verdict() {
            Some(Verdict::Stable) => ("stands".to_string(), Role::Good),
            Some(Verdict::Conditional) => ("stands only with a pre-stress".to_string(), Role::Bad),
            Some(Verdict::Unstable) => ("falls".to_string(), Role::Bad),
            Some(Verdict::Undecided) | None => ("undecided".to_string(), Role::Unsure),
        },
        QuestionKind::Simulate => simulation::title(file),
        QuestionKind::Limit | QuestionKind::Moving => match (status(&file.answer), found(&file.answer)) {
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
        },
        QuestionKind::Tilt | QuestionKind::Repose => {
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
        QuestionKind::Critical => super::critical::title(file),
        QuestionKind::Thrust => super::thrust::title(file),
        QuestionKind::Settle | QuestionKind::Push => super::path::title(file),
        QuestionKind::Kinematic => super::kinematic::title(file),
        QuestionKind::Stages => super::stages::title(file),
        QuestionKind::State => super::state::title(file),
        QuestionKind::Rock => super::rocking::title(file),
        QuestionKind::Shake => super::shaken::title(file),
    };
    let text = match super::moving::place(file) {
        Some(place) => text + &place,
        None => text,
    };
    let (text, role) = match without_live_load(file) {
        Some(words) => (format!("{text}; {words}"), Role::Bad),
        None => (text, role),
    };
    let (text, role) = match left_out(file) {
        Some(words) if role == Role::Good => (format!("{text}; {words}"), Role::Unsure),
        Some(words) => (format!("{text}; {words}"), role),
        None => (text, role),
    };
    let text = match &file.run.doubt {
        Some(doubt) => format!("{text}: {}; {}", doubt.evidence, doubt.next),
        None => text,
    };
    page.title(&file.scene.name, under(file, text), role);
}

/// What weakens a load factor or a tilt: the scene does not stand without it. Whoever reads one line
/// reads it there.
fn without_live_load(file: &ResultFile) -> Option<String> {
    let place = match file.question.kind() {
        QuestionKind::Limit => "without its live load",
        QuestionKind::Moving => "without the train",
        QuestionKind::Tilt => "when level",
        QuestionKind::Kinematic => "without an earthquake",
        _ => return None,
    };
    if falls_by_itself(file) {
        // A tilt has said so already.
        let says_so = match status(&file.answer) {
            Outcome::Impossible => true,
            outcome => file.question.kind() == QuestionKind::Tilt && outcome == Outcome::Found,
        };
        return (!says_so).then(|| format!("{place} it falls"));
    }
    let says_so = matches!(dry_of(file), Dry::Never) || status(&file.answer) == Outcome::Impossible;
    match file.answer.verdict().filter(|_| !says_so)? {
        Verdict::Conditional => Some(format!("{place} it stands only with a pre-stress")),
        Verdict::Unstable => Some(format!("{place} it falls")),
        Verdict::Stable | Verdict::Undecided => None,
    }
}

/// The sentences that say what the answer rests on and what it does not say.
pub(super) fn why(page: &mut Page, file: &ResultFile) {
    match file.question.kind() {
        QuestionKind::Assess => {
            super::verdict::verdict(page, file);
            return simulation::why(page, file);
        }
        QuestionKind::Simulate => return simulation::why(page, file),
        QuestionKind::Critical => return super::critical::why(page, file),
        QuestionKind::Thrust => return super::thrust::why(page, file),
        QuestionKind::Settle | QuestionKind::Push => return super::path::why(page, file),
        QuestionKind::Stages => return super::stages::why(page, file),
        QuestionKind::State => return super::state::why(page, file),
        QuestionKind::Rock => return super::rocking::why(page, file),
        QuestionKind::Shake => return super::shaken::why(page, file),
        QuestionKind::Kinematic => {
            super::kinematic::why(page, file);
            dry(page, file);
            return dead_load(page, file);
        }
        QuestionKind::Moving => super::moving::why(page, file),
        QuestionKind::Limit | QuestionKind::Tilt | QuestionKind::Repose => {}
    }
    let tilt = file.question.kind() == QuestionKind::Tilt;
    match (status(&file.answer), found(&file.answer)) {
        (Outcome::Found, Some((value, lower, upper))) => {
            let [low, high] = ends(value, lower, upper);
            if tilt {
                page.paragraph(&format!(
                    "Tilting by θ adds tan θ × the weight sideways. The greatest tan θ is {} (between {low} and {high}).",
                    bracketed(value, lower, upper)
                ));
            } else {
                page.paragraph(&format!(
                    "Contact forces inside the friction cones balance the dead load and λ × the live load up to λ = {}, between {low} and {high}; beyond it the mechanism below moves.{}",
                    bracketed(value, lower, upper),
                    unit(file)
                ));
            }
            page.paragraph(
                "Sliding counts as associative here (a joint that slides opens as well): for dry friction this is an upper bound.",
            );
        }
        (Outcome::Unbounded, _) => {
            page.paragraph("Contact forces balance the live load by itself, so that any multiple of it can be added. Sliding counts as associative here (a joint that slides opens as well): with dry friction there may be a limit.");
            if let Some(Claim::Unbounded { standing }) = file.certificate.claim {
                page.paragraph(&format!("It stands at λ = {} and at every greater λ.", moving(standing)));
            }
        }
        (Outcome::Impossible, _) => page.paragraph(
            "The mechanism below gains power under the dead load and none under the live load: no multiple of the live load holds it.",
        ),
        _ if file.run.trace.is_empty() => page.paragraph("The time limit left no time for an attempt."),
        _ => {
            let l = file.answer.bound();
            let end = |e: Option<f64>| e.map_or("unknown".to_string(), |v| format!("{v:.9}"));
            page.paragraph(&format!(
                "No attempt closed the bracket of the load factor, and none showed that there is no limit or no answer. Lower end {}, upper end {}.",
                end(l.and_then(|l| l.lower)),
                end(l.and_then(|l| l.upper))
            ));
        }
    }
    dry(page, file);
    dead_load(page, file);
}

/// What λ multiplies.
fn unit(file: &ResultFile) -> &'static str {
    if file.question.kind() == QuestionKind::Moving {
        return "";
    }
    let live = &file.scene.input.loads.live;
    match live.as_slice() {
        [one]
            if one
                .weight
                .is_some_and(|w| (w.iter().map(|c| c * c).sum::<f64>() - 1.0).abs() < 1e-12) =>
        {
            " The live load is the weight of the blocks, so λ is an acceleration in multiples of gravity."
        }
        _ => "",
    }
}

/// The tilt up to which blocks are at rest, by its tangent.
fn at_rest_to(tangent: f64) -> String {
    computed_tilt(tangent.atan().to_degrees())
}

/// The load factor with dry friction.
fn dry(page: &mut Page, file: &ResultFile) {
    let Some(dry) = &file.dry else { return };
    let words =
        |v: f64, tilt: fn(f64) -> String, factor: fn(f64) -> String| match file.question.kind() {
            QuestionKind::Tilt => format!("{}°", tilt(v.atan().to_degrees())),
            QuestionKind::Kinematic => format!("α = {}", factor(v)),
            _ => format!("λ = {}", factor(v)),
        };
    let no_longer = |v: f64| format!(", and no longer at {}", words(v, moving_tilt, moving));
    let words = |v: f64| words(v, computed_tilt, computed);
    let text = match (dry.found, dry.value) {
        (Found::NothingSlides, Some(_)) => {
            format!("In the mechanism nothing slides, so with dry friction it is the same{}.", rest(dry, words))
        }
        (Found::Rests, Some(v)) => {
            let moves = dry.moves_at.map(no_longer).unwrap_or_default();
            format!("With dry friction (joints slide without opening) the blocks come to rest up to {}{moves}: the forces that the bound needs are not such as the loads produce. Computed, not proved.", words(v))
        }
        (Found::RestsBelow, Some(v)) => {
            let (moves, above) = match dry.moves_at {
                Some(m) => (no_longer(m), "in between"),
                None => (String::new(), "between there and the bound"),
            };
            format!("With dry friction (joints slide without opening) the blocks come to rest up to {}{moves}; what they do {above} is not known. Computed, not proved.", words(v))
        }
        (Found::NotAtRest, _) if falls_by_itself(file) => {
            "With dry friction there is no load factor: already the dead load finds no forces that balance it.".to_string()
        }
        (Found::NotAtRest, _) => "With dry friction there is no load factor: already without the load the blocks do not come to rest, for the forces that hold them would need a pre-stress that nobody applied. Computed, not proved.".to_string(),
        (Found::FixedPoint, Some(v)) => {
            let others = if status(&file.answer) == Outcome::Found { ", none above the associative one" } else { "" };
            format!(
                "With dry friction (joints slide without opening): {}. Forces and a mechanism that obey Coulomb's law together prove that it is one{}; there may be others{others}.",
                words(v),
                rest(dry, words)
            )
        }
        (Found::Unlimited, _) => {
            "With dry friction the live load alone comes to rest as well, on forces that it produces itself: no limit (computed, not proved)."
                .to_string()
        }
        _ => {
            let rests = dry.rests_at.filter(|&r| r > 0.0).map(|r| format!(" The blocks come to rest up to {} at least (computed, not proved).", words(r)));
            format!(
                "With dry friction no value came out: the friction limits had not settled.{}",
                rests.unwrap_or_default()
            )
        }
    };
    page.paragraph(&text);
}

/// Up to where the blocks were seen at rest below a value.
fn rest(dry: &DryResult, words: impl Fn(f64) -> String) -> String {
    match dry.rests_at {
        _ if dry.is_reached() => String::new(),
        Some(rests_at) => format!(
            " (the blocks were seen at rest up to {}; what they do from there on did not come out)",
            words(rests_at)
        ),
        None => " (whether the blocks come to rest below it did not come out)".into(),
    }
}

/// What dry friction makes of a load factor.
enum Dry {
    /// Nothing slides, or it was not asked for: the answer is the bound.
    Same,
    /// A value of its own.
    Other(f64),
    /// It does not rest under the dead load.
    Never,
    /// It rests up to there; what it does from there on did not come out.
    UpTo(f64),
    /// It did not come out.
    Undecided,
}

fn dry_of(file: &ResultFile) -> Dry {
    match &file.dry {
        None => Dry::Same,
        Some(d) => match (d.found, d.value) {
            (Found::NotAtRest, _) => Dry::Never,
            (Found::Unlimited, _) => Dry::Same,
            (Found::NothingSlides, Some(_)) if d.is_reached() => Dry::Same,
            (Found::FixedPoint | Found::Rests | Found::RestsBelow, Some(v)) if d.is_reached() => {
                Dry::Other(v)
            }
            _ => d.rests_at.filter(|&r| r > 0.0).map_or(Dry::Undecided, Dry::UpTo),
        },
    }
}

/// The load factor with dry friction, where it is proved to be one of its own.
fn dry_value(file: &ResultFile) -> Option<f64> {
    file.dry
        .as_ref()
        .filter(|d| {
            d.is_reached()
                && matches!(d.found, Found::FixedPoint | Found::Rests | Found::RestsBelow)
        })?
        .value
}

fn dead_load(page: &mut Page, file: &ResultFile) {
    let place = match file.question.kind() {
        QuestionKind::Tilt => "When level",
        QuestionKind::Kinematic => "Without an earthquake",
        QuestionKind::Moving => "Without the train",
        _ => "Without its live load",
    };
    let negative = is_negative(file);
    let text = match file.dead_load.as_ref().and_then(|d| d.answer.verdict()) {
        Some(Verdict::Stable) => format!("{place} it stands."),
        Some(Verdict::Conditional) => {
            format!("{place} it stands only with a pre-stress that nobody applied.")
        }
        Some(Verdict::Unstable) => format!("{place} it falls."),
        Some(Verdict::Undecided) => format!("{place} it is undecided whether it stands."),
        None if negative => format!("{place} it falls: the greatest λ is below zero."),
        None if status(&file.answer) == Outcome::Impossible => format!("{place} it falls as well."),
        None => return,
    };
    page.paragraph(&text);
}

/// Every direction of a tilt.
pub(super) fn directions(page: &mut Page, file: &ResultFile, options: TextOptions) {
    if file.question.kind() != QuestionKind::Tilt {
        return;
    }
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

/// The part of the scene that decides.
pub(super) fn part(page: &mut Page, file: &ResultFile) {
    let dry = file
        .dry
        .as_ref()
        .filter(|_| !matches!(dry_of(file), Dry::Same))
        .and_then(|d| d.part.as_ref());
    let lines = match (file.answer.part(), dry) {
        (Some(bound), Some(dry)) if bound != dry => {
            vec![format!("{bound}"), format!("with dry friction {dry}")]
        }
        (bound, dry) => bound.or(dry).map(ToString::to_string).into_iter().collect(),
    };
    page.row("decided by", lines);
}

fn status(answer: &Answer) -> Outcome {
    answer.bound().map_or(Outcome::Undecided, |b| b.status)
}

/// Whether no forces hold the dead load alone: the bound is below zero, or that is proved by itself.
fn falls_by_itself(file: &ResultFile) -> bool {
    let dead = file.dead_load.as_ref().and_then(|d| d.answer.verdict());
    is_negative(file) || dead == Some(Verdict::Unstable)
}

fn is_negative(file: &ResultFile) -> bool {
    found(&file.answer).is_some_and(|(_, _, upper)| upper < 0.0)
}

/// Value and bracket where a load factor was found.
fn found(answer: &Answer) -> Option<(f64, f64, f64)> {
    answer.bound()?.found()
}

/// The angle of a load factor, with the digits its bracket supports.
fn degrees((value, lower, upper): (f64, f64, f64)) -> String {
    let [v, l, u] = [value, lower, upper].map(|x| x.atan().to_degrees());
    // Nobody reads an angle to more than a millionth of a degree.
    format!("{v:.*}", decimals(v, l, u).min(6))
}
