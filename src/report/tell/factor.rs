//! What load factors, tilts and positions of trains have in common.

use super::telling::FactorWords;
use crate::text::{options::TextOptions, page::Page};
use analysis::{Outcome, coulomb::Found};
use base::number::{bracketed, ends, rounded_down, rounded_up};
use check::{
    proof::{answer::Answer, certificate::DryResult, result::ResultFile},
    verdict::{Verdict, claim::Claim},
};

/// What weakens a load factor or a tilt: the scene does not stand without it. Whoever reads one line
/// reads it there.
pub(super) fn without_live_load(file: &ResultFile, words: FactorWords) -> Option<String> {
    let FactorWords { without: place, tilt, .. } = words;
    if falls_by_itself(file) {
        // A tilt has said so already.
        let says_so = match status(&file.answer) {
            Outcome::Impossible => true,
            outcome => tilt && outcome == Outcome::Found,
        };
        return (!says_so).then(|| format!("{place} it falls"));
    }
    let says_so = matches!(dry_of(file), Dry::Never) || status(&file.answer) == Outcome::Impossible;
    match file.answer.verdict().filter(|_| !says_so)? {
        Verdict::Conditional => Some(format!("{place} it stands only with self-stress")),
        Verdict::Unstable => Some(format!("{place} it falls")),
        Verdict::Stable | Verdict::Undecided => None,
    }
}

/// The sentences that say what the answer rests on and what it does not say.
pub(super) fn why(page: &mut Page, file: &ResultFile, words: FactorWords) {
    let tilt = words.tilt;
    match (status(&file.answer), found(&file.answer)) {
        (Outcome::Found, Some((value, ..))) => {
            page.paragraph(&match tilt {
                true => format!(
                    "A tilt of θ adds tan θ × the weight sideways. Contact forces inside the friction cones balance it up to tan θ = {}; beyond it the governing mechanism below moves.",
                    rounded_down(value)
                ),
                false => format!(
                    "Contact forces inside the friction cones balance the dead load and λ × the live load up to λ = {}; beyond it the governing mechanism below moves.{}",
                    rounded_down(value),
                    unit(file)
                ),
            });
            // Where nothing slides both laws are one, which is said next.
            if !matches!(&file.dry, Some(d) if d.found == Found::NothingSlides) {
                page.paragraph(
                    "Joints that slide are taken to open as well (associative): for dry friction this is an upper bound.",
                );
            }
        }
        (Outcome::Unbounded, _) => {
            page.paragraph("Contact forces balance the live load by itself, so any multiple of it can be added. Joints that slide are taken to open as well (associative): with dry friction there may be a limit.");
            if let Some(Claim::Unbounded { standing }) = file.certificate.claim {
                page.paragraph(&format!("It stands at λ = {} and at every greater λ.", rounded_up(standing)));
            }
        }
        (Outcome::Impossible, _) => page.paragraph(
            "The mechanism below gains power under the dead load and none under the live load: no multiple of the live load holds it.",
        ),
        _ if file.run.trace.is_empty() => page.paragraph("The time limit was reached before the first attempt."),
        _ => {
            let l = file.answer.bound();
            let end = |e: Option<f64>| e.map_or("unknown".to_string(), |v| format!("{v:.9}"));
            page.paragraph(&format!(
                "No attempt closed the bracket of the load factor, and none showed that there is no limit or no solution. Lower end {}, upper end {}.",
                end(l.and_then(|l| l.lower)),
                end(l.and_then(|l| l.upper))
            ));
        }
    }
    dry(page, file, words);
    dead_load(page, file, words);
}

/// What λ multiplies.
pub(super) fn unit(file: &ResultFile) -> &'static str {
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
pub(super) fn at_rest_to(tangent: f64) -> String {
    rounded_down(tangent.atan().to_degrees())
}

/// The value of a bound with all digits that are known, for who asks for everything.
pub(super) fn digits(page: &mut Page, file: &ResultFile, options: TextOptions) {
    let Some(words) = super::telling(file).factor.filter(|_| options.verbose) else { return };
    if let (Outcome::Found, Some((value, lower, upper))) =
        (status(&file.answer), found(&file.answer))
    {
        let [low, high] = ends(value, lower, upper);
        let name = if words.tilt { "tan θ" } else { words.name };
        page.row(
            "bound",
            [format!("{name} = {}, between {low} and {high}", bracketed(value, lower, upper))],
        );
    }
    if let Some(v) = file.dry.as_ref().and_then(|d| d.value) {
        page.row("dry value", [format!("{} = {v}", if words.tilt { "tan θ" } else { words.name })]);
    }
}

/// The load factor with dry friction.
pub(super) fn dry(page: &mut Page, file: &ResultFile, own: FactorWords) {
    let Some(dry) = &file.dry else { return };
    let words = |v: f64, digits: fn(f64) -> String| match own.tilt {
        true => format!("{}°", digits(v.atan().to_degrees())),
        false => format!("{} = {}", own.name.trim_end_matches('0'), digits(v)),
    };
    let no_longer = |v: f64| format!(", and no longer at {}", words(v, rounded_up));
    let words = |v: f64| words(v, rounded_down);
    let text = match (dry.found, dry.value) {
        (Found::NothingSlides, Some(_)) => {
            format!("Nothing slides in the mechanism, so dry friction gives the same value{}.", rest(dry, words))
        }
        (Found::Rests, Some(v)) => {
            let moves = dry.moves_at.map(no_longer).unwrap_or_default();
            format!("With dry friction (joints slide without opening) the blocks come to rest up to {}{moves} (computed, not proved). The forces that the upper bound needs are not produced by the loads.", words(v))
        }
        (Found::RestsBelow, Some(v)) => {
            let (moves, above) = match dry.moves_at {
                Some(m) => (no_longer(m), "in between"),
                None => (String::new(), "between there and the bound"),
            };
            format!("With dry friction (joints slide without opening) the blocks come to rest up to {}{moves} (computed, not proved); what they do {above} is undecided.", words(v))
        }
        (Found::NotAtRest, _) if falls_by_itself(file) => {
            "With dry friction there is no load factor: no forces balance the dead load alone.".to_string()
        }
        (Found::NotAtRest, _) => "With dry friction there is no load factor: the blocks move under the dead load alone; equilibrium would need self-stress (computed, not proved).".to_string(),
        (Found::FixedPoint, Some(v)) => {
            let others = if status(&file.answer) == Outcome::Found { ", none above the upper bound" } else { "" };
            format!(
                "With dry friction (joints slide without opening): {}. Forces and a mechanism that together obey Coulomb's law prove that this is a limit{}; there may be others{others}.",
                words(v),
                rest(dry, words)
            )
        }
        (Found::Unlimited, _) => {
            "With dry friction there is no limit either: the live load alone comes to rest on the forces that it produces (computed, not proved)."
                .to_string()
        }
        _ => {
            let rests = dry.rests_at.filter(|&r| r > 0.0).map(|r| format!(" The blocks come to rest up to {} at least (computed, not proved).", words(r)));
            format!(
                "With dry friction the value is undecided: the friction limits did not settle.{}",
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
        Some(rests_at) => {
            format!(" (the blocks come to rest up to {}; beyond, it is undecided)", words(rests_at))
        }
        None => " (whether the blocks come to rest below it is undecided)".into(),
    }
}

/// What dry friction makes of a load factor.
pub(super) enum Dry {
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

pub(super) fn dry_of(file: &ResultFile) -> Dry {
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
pub(super) fn dry_value(file: &ResultFile) -> Option<f64> {
    file.dry
        .as_ref()
        .filter(|d| {
            d.is_reached()
                && matches!(d.found, Found::FixedPoint | Found::Rests | Found::RestsBelow)
        })?
        .value
}

pub(super) fn dead_load(page: &mut Page, file: &ResultFile, words: FactorWords) {
    let place = base::number::capital(words.without);
    let negative = is_negative(file);
    let text = match file.dead_load.as_ref().and_then(|d| d.answer.verdict()) {
        Some(Verdict::Stable) => format!("{place} it stands."),
        Some(Verdict::Conditional) => {
            format!("{place} it stands only with self-stress.")
        }
        Some(Verdict::Unstable) => format!("{place} it falls."),
        Some(Verdict::Undecided) => format!("{place} it is undecided."),
        None if negative => format!("{place} it falls: the greatest λ is below zero."),
        None if status(&file.answer) == Outcome::Impossible => format!("{place} it falls as well."),
        None => return,
    };
    page.paragraph(&text);
}

/// The part of the scene that decides.
pub(crate) fn part(page: &mut Page, file: &ResultFile) {
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

pub(super) fn status(answer: &Answer) -> Outcome {
    answer.bound().map_or(Outcome::Undecided, |b| b.status)
}

/// Whether no forces hold the dead load alone: the bound is below zero, or that is proved by itself.
pub(super) fn falls_by_itself(file: &ResultFile) -> bool {
    let dead = file.dead_load.as_ref().and_then(|d| d.answer.verdict());
    is_negative(file) || dead == Some(Verdict::Unstable)
}

fn is_negative(file: &ResultFile) -> bool {
    found(&file.answer).is_some_and(|(_, _, upper)| upper < 0.0)
}

/// Value and bracket where a load factor was found.
pub(super) fn found(answer: &Answer) -> Option<(f64, f64, f64)> {
    answer.bound()?.found()
}
