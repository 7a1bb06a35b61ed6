//! Verifying critical values: the scene is made anew at both ends of every flip, and the verdict
//! proved there.

use super::{CriticalResult, FlipResult, ScanPoint, Side, exhausted};
use crate::{
    proof::{
        recompute::Recompute,
        result::{QuestionKind, ResultFile},
        verify::{Verification, answer, failure, require},
    },
    verdict::{Verdict, claim::Findings},
};
use base::tolerance;
use model::interface::prepare;
use scene::Scene;

/// Adds the parts of a result of `critical`.
pub fn verify(all: &mut Verification, file: &ResultFile, scene: &Scene, again: &dyn Recompute) {
    let (Some(c), Some(said)) = (&file.critical, file.answer.critical()) else {
        return all.part("answer", failure("the answer is not one to its question"));
    };
    let mut f = Findings::default();
    let proved: Vec<_> = c.flips.iter().filter_map(FlipResult::proved).collect();
    require(
        &mut f,
        proved == said,
        format!("the answer names the {} flips that have a proof on both sides", proved.len()),
    );
    let (low, high) = (c.between[0].min(c.between[1]), c.between[0].max(c.between[1]));
    // A flip at the very end of the range has its other side just outside.
    let slack = 100.0 * tolerance::CRITICAL_WIDTH * low.abs().max(high.abs());
    require(
        &mut f,
        said.iter().all(|v| low - slack <= v.lower && v.upper <= high + slack),
        format!("they lie between {low} and {high}"),
    );
    scanned(&mut f, c);
    require(&mut f, file.certificate.claim.is_none(), "nothing else is claimed");
    all.part("answer", f);
    all.claimed = !said.is_empty() || exhausted(file).is_some();
    for side in sides(c) {
        all.part(format!("{} = {}", c.vary, side.value), one(scene, c, side, all.refuted(), again));
    }
    if !all.refuted() {
        all.part("scan", asked_again(scene, c, again));
    }
}

/// All values with evidence.
fn sides(c: &CriticalResult) -> impl Iterator<Item = &Side> {
    c.flips.iter().flat_map(|flip| [&flip.below, &flip.above]).chain(&c.ends)
}

/// The values of the scan that have no evidence.
fn asked_again(scene: &Scene, c: &CriticalResult, again: &dyn Recompute) -> Findings {
    let mut f = Findings { computed: true, ..Findings::default() };
    let rest: Vec<&ScanPoint> =
        c.scan.iter().filter(|s| sides(c).all(|side| side.value != s.value)).collect();
    let mut otherwise = 0;
    for said in &rest {
        match is_so(scene, c, said, again) {
            Some(true) => {}
            Some(false) => otherwise += 1,
            None => {
                f.unchecked.push(format!("the verdicts at {} values of the scan", rest.len()));
                return f;
            }
        }
    }
    let text = format!(
        "{} values asked again (computed, not proved), {otherwise} of them otherwise than said",
        rest.len()
    );
    require(&mut f, otherwise == 0, text);
    f
}

/// The scan is the way there, computed and not proved; it agrees with what is proved, and with the
/// scene.
fn scanned(f: &mut Findings, c: &CriticalResult) {
    let near =
        |a: f64, b: f64| (a - b).abs() <= tolerance::SAVED * (c.between[1] - c.between[0]).abs();
    let within = |v: f64| {
        (v - c.between[0]) * (v - c.between[1]) <= 0.0 || c.between.iter().any(|&end| near(v, end))
    };
    let order = (c.between[1] - c.between[0]).signum();
    let sorted = c.scan.windows(2).all(|w| (w[1].value - w[0].value) * order > 0.0)
        && c.scan.iter().all(|s| within(s.value));
    let whole = !c.whole || c.scan.iter().all(|s| s.value.fract() == 0.0);
    let proved = |v: f64| sides(c).filter(move |s| s.value == v).filter_map(Side::verdict);
    // Whether a pre-stress is needed may have stayed open on one of the two occasions.
    let falls = |v: Verdict| v == Verdict::Unstable;
    let agrees = c.scan.iter().all(|s| {
        proved(s.value).all(|v| {
            s.verdict.is_none_or(|said| said == Verdict::Undecided || falls(said) == falls(v))
        })
    });
    require(
        f,
        sorted && whole && agrees,
        format!(
            "the scan lies in the range and agrees with what is proved: {} values, computed",
            c.scan.len()
        ),
    );
    require(
        f,
        reaches_the_ends(c),
        "the scan goes from one end of the range to the other, or says where it stopped",
    );
    let ends = |s: &Side| c.between.iter().any(|&end| near(s.value, end)) || c.whole;
    require(f, c.ends.iter().all(ends), "the ends are those of the range");
}

/// Whether the scan begins at one end of the range and reaches the other, or was cut short in even
/// steps, with a note.
fn reaches_the_ends(c: &CriticalResult) -> bool {
    let [a, b] = c.between;
    let near = |x: f64, y: f64| {
        (x - y).abs()
            <= tolerance::SAVED
                * (b - a).abs().max(if c.whole { 1.0 / tolerance::SAVED } else { 0.0 })
    };
    let (Some(first), Some(last)) = (c.scan.first(), c.scan.last()) else { return false };
    let steps = c.scan.get(1).map_or(1.0, |second| (b - a) / (second.value - first.value));
    let even = c.whole || (steps - steps.round()).abs() <= tolerance::SAVED * steps.abs();
    near(first.value, a) && even && (near(last.value, b) || !c.notes.is_empty())
}

/// Whether a value of the scan is as it is said to be; nothing where no solver can tell.
fn is_so(
    scene: &Scene,
    c: &CriticalResult,
    said: &ScanPoint,
    again: &dyn Recompute,
) -> Option<bool> {
    let here = again.with_value(scene, &c.vary, said.value, c.law)?;
    Some(match (here, said.verdict) {
        (Err(_), None) => true,
        (Ok(_), Some(Verdict::Undecided)) => true,
        (Ok((verdict, unbalance)), Some(wanted)) => {
            let said = said.unbalance.unwrap_or(0.0);
            verdict == wanted
                && (unbalance - said).abs() <= tolerance::SAVED * said.abs() + tolerance::UNBALANCE
        }
        _ => false,
    })
}

fn one(
    scene: &Scene,
    c: &CriticalResult,
    side: &Side,
    refuted: bool,
    again: &dyn Recompute,
) -> Findings {
    match scene.with_field(&c.vary, side.value).and_then(|scene| prepare(&scene)) {
        Ok(model) => {
            answer(again, &model, QuestionKind::Assess, &side.answer, &side.certificate, refuted).0
        }
        Err(e) => failure(e.to_string()),
    }
}
