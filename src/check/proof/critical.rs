//! Results of `critical`: the flips, each with a verdict and its evidence on both sides.

use super::{
    answer::Answer,
    certificate::Certificate,
    derive::{Derivation, require},
    evidence::{CriticalEvidence, ScanPoint, SideEvidence},
    told::Told,
};
use crate::{
    question::CriticalOptions,
    terms::Method,
    verdict::{Verdict, claim::Findings},
};
use base::tolerance;
use model::interface::{Model, prepare};
use schemars::JsonSchema;
use serde::Serialize;
use std::sync::Arc;

/// A value at which the verdict flips.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct CriticalValue {
    /// The value.
    pub value: f64,
    /// The nearest value below whose verdict is proved.
    pub lower: f64,
    /// The nearest value above whose verdict is proved.
    pub upper: f64,
    /// The verdict below.
    pub below: Verdict,
    /// The verdict above.
    pub above: Verdict,
}

/// The scan and the flips.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct CriticalResult {
    /// JSON pointer of the number that varies.
    pub vary: String,
    /// The range.
    pub between: [f64; 2],
    /// Whether the number is a count.
    pub whole: bool,
    /// Whether the scan reached the other end.
    pub complete: bool,
    /// The scan: computed, not proved.
    pub scan: Vec<ScanPoint>,
    /// The flips, in the order of the scan.
    pub flips: Vec<FlipResult>,
    /// Without a flip: the verdicts at the ends of the range.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub ends: Vec<Side>,
}

/// A flip.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct FlipResult {
    /// The value.
    pub value: f64,
    /// How it was found.
    pub method: Method,
    /// The nearest value below.
    pub below: Side,
    /// The nearest value above.
    pub above: Side,
}

/// One value with its verdict and the evidence for it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Side {
    /// The value.
    pub value: f64,
    /// The verdict.
    pub answer: Answer,
    /// The evidence.
    #[serde(skip)]
    pub certificate: Arc<Certificate>,
}

impl Side {
    /// Its verdict, where it is proved.
    pub fn verdict(&self) -> Option<Verdict> {
        self.answer
            .verdict()
            .filter(|v| *v != Verdict::Undecided && self.certificate.claim.is_some())
    }
}

impl FlipResult {
    /// The value with its ends, where both are proved and differ: near together, or the middle of
    /// what the scan leaves.
    pub fn proved(&self) -> Option<CriticalValue> {
        let verdicts = [self.below.verdict()?, self.above.verdict()?];
        CriticalValue::new(
            (self.value, self.method),
            [self.below.value, self.above.value],
            verdicts,
        )
    }
}

impl CriticalValue {
    /// A flip between two values with these verdicts, where they differ. Ends that are far apart prove
    /// no more than that there is one between them: their middle.
    pub fn new(
        (value, method): (f64, Method),
        [lower, upper]: [f64; 2],
        [below, above]: [Verdict; 2],
    ) -> Option<Self> {
        let (value, _) = placed(value, method, [lower, upper]);
        let decided = [below, above].iter().all(|v| *v != Verdict::Undecided);
        let between = lower <= value && value <= upper;
        (decided && below != above && between).then_some(Self { value, lower, upper, below, above })
    }
}

/// Where a flip between two values is, and how that is known.
pub fn placed(value: f64, method: Method, [lower, upper]: [f64; 2]) -> (f64, Method) {
    let between = lower <= value && value <= upper;
    match method != Method::Scan && between && is_narrow(lower, upper) {
        true => (value, method),
        false => (middle(lower, upper), Method::Scan),
    }
}

/// Whether two ends are near enough to each other for a value between them.
fn is_narrow(lower: f64, upper: f64) -> bool {
    upper - lower <= tolerance::CRITICAL_BRACKET * lower.abs().max(upper.abs())
}

/// The middle of two ends.
fn middle(lower: f64, upper: f64) -> f64 {
    0.5 * (lower + upper)
}

impl CriticalResult {
    /// The verdict throughout the range, where the scan found no flip and left nothing open.
    pub fn exhausted(&self) -> Option<Verdict> {
        let first = self.ends.first()?.verdict()?;
        // One value alone that makes no scene, such as a load of exactly zero, is left out.
        let makes_scene = |k: usize| self.scan.get(k).is_some_and(|s| s.verdict.is_some());
        let same = self.complete
            && self.scan.iter().enumerate().all(|(k, s)| match s.verdict {
                Some(verdict) => verdict == first,
                None => k > 0 && makes_scene(k - 1) && makes_scene(k + 1),
            })
            && self.ends.iter().all(|e| e.verdict() == Some(first));
        (same && self.flips.is_empty() && self.ends.len() == 2).then_some(first)
    }

    /// The verdict at which the scan starts.
    pub fn first_verdict(&self) -> Option<Verdict> {
        self.scan.first()?.verdict
    }

    /// All values with evidence.
    fn sides(&self) -> impl Iterator<Item = &Side> {
        self.flips.iter().flat_map(|flip| [&flip.below, &flip.above]).chain(&self.ends)
    }
}

/// The flips that have a proof on both sides. The scan between them is computed.
pub(super) fn derive(
    d: &mut Derivation,
    o: &CriticalOptions,
    e: &CriticalEvidence,
) -> Result<Told, String> {
    let mut flips = Vec::new();
    for flip in &e.flips {
        let (below, above) = (at(d, o, &flip.below)?, at(d, o, &flip.above)?);
        let (lower, upper) = (below.value, above.value);
        let (value, method) = placed(flip.value, flip.method, [lower, upper]);
        flips.push(FlipResult { value, method, below, above });
    }
    let ends = e.ends.iter().map(|side| at(d, o, side)).collect::<Result<_, _>>()?;
    let whole = o.is_whole(d.scene);
    // What is scanned follows from the question; time may have cut it short.
    let values = if e.scan.len() <= MOST { o.values(whole) } else { Vec::new() };
    if e.scan.len() > values.len() || !e.scan.iter().zip(&values).all(|(s, v)| near(o, s.value, *v))
    {
        return Err("the scan does not match the question".into());
    }
    let c = CriticalResult {
        vary: o.vary.clone(),
        between: o.between,
        whole,
        complete: e.scan.len() == values.len(),
        scan: e.scan.clone(),
        flips,
        ends,
    };
    let found: Vec<CriticalValue> = c.flips.iter().filter_map(FlipResult::proved).collect();
    let mut f = Findings::default();
    let (low, high) = (c.between[0].min(c.between[1]), c.between[0].max(c.between[1]));
    // A flip at the very end of the range has its other side just outside.
    let slack = 100.0 * tolerance::CRITICAL_WIDTH * low.abs().max(high.abs());
    require(
        &mut f,
        found.iter().all(|v| low - slack <= v.lower && v.upper <= high + slack),
        format!("flips between {low} and {high}: {}, proved on both sides", found.len()),
    );
    scanned(&mut f, o, &c, &values);
    d.part("answer", f);
    d.check.claimed = !found.is_empty() || c.exhausted().is_some();
    scan_again(d, o, &c);
    let mut told = Told::new(d.model, Answer::Critical(found), &Arc::default());
    told.critical = Some(c);
    Ok(told)
}

/// One value with its verdict.
fn at(d: &mut Derivation, o: &CriticalOptions, e: &SideEvidence) -> Result<Side, String> {
    let title = format!("{} = {}", o.vary, e.value);
    let scene = d.scene.with_field(&o.vary, e.value);
    let model = scene.and_then(|scene| prepare(&scene)).map_err(|e| format!("{title}: {e}"))?;
    Ok(side(d, title, &model, e))
}

/// A verdict on a model as one at a value.
pub(super) fn side(d: &mut Derivation, title: String, model: &Model, e: &SideEvidence) -> Side {
    let mut f = Findings::default();
    let (answer, _) = d.verdict(&mut f, model, &e.standing);
    d.part(title, f);
    let certificate = e.standing.certificate.clone();
    Side { value: e.value, answer: Answer::Verdict(answer), certificate }
}

/// The values of the scan that have no evidence are asked again.
fn scan_again(d: &mut Derivation, o: &CriticalOptions, c: &CriticalResult) {
    let mut f = Findings { computed: true, ..Findings::default() };
    if !d.asks_again() {
        return d.part("scan", f);
    }
    let rest: Vec<&ScanPoint> =
        c.scan.iter().filter(|s| c.sides().all(|side| side.value != s.value)).collect();
    let mut otherwise = 0;
    for said in &rest {
        match d.again.with_value(d.scene, &o.vary, said.value, o.law) {
            None => {
                f.unchecked.push(format!("the verdicts at {} values of the scan", rest.len()));
                return d.part("scan", f);
            }
            Some(here) if is_so(&here, said) => {}
            Some(_) => otherwise += 1,
        }
    }
    let text = format!(
        "{} values computed again (not proved), {otherwise} of them with another verdict",
        rest.len()
    );
    require(&mut f, otherwise == 0, text);
    d.part("scan", f);
}

/// Whether a value of the scan is as it is said to be.
fn is_so(here: &Result<(Verdict, f64), base::error::InputError>, said: &ScanPoint) -> bool {
    match (here, said.verdict) {
        (Err(_), None) | (Ok(_), Some(Verdict::Undecided)) => true,
        (Ok((verdict, equilibrium_error)), Some(wanted)) => {
            let said = said.equilibrium_error.unwrap_or(0.0);
            *verdict == wanted
                && (equilibrium_error - said).abs()
                    <= tolerance::SAVED * said.abs() + tolerance::EQUILIBRIUM_ERROR
        }
        _ => false,
    }
}

/// The scan is the way there, computed and not proved; it agrees with what is proved.
fn scanned(f: &mut Findings, o: &CriticalOptions, c: &CriticalResult, values: &[f64]) {
    let proved = |v: f64| c.sides().filter(move |s| s.value == v).filter_map(Side::verdict);
    // Whether self-stress is needed may have stayed open on one of the two occasions.
    let falls = |v: Verdict| v == Verdict::Unstable;
    let agrees = c.scan.iter().all(|s| {
        proved(s.value).all(|v| {
            s.verdict.is_none_or(|said| said == Verdict::Undecided || falls(said) == falls(v))
        })
    });
    require(
        f,
        agrees,
        format!("the scan agrees with the proofs ({} values, computed)", c.scan.len()),
    );
    let is = |s: &Side, v: Option<&f64>| v.is_some_and(|v| near(o, s.value, *v));
    let ends = match &c.ends[..] {
        [] => true,
        [one] => is(one, values.first()) || is(one, values.last()),
        [one, other] => is(one, values.first()) && is(other, values.last()),
        _ => false,
    };
    require(f, ends, "the ends are those of the range");
}

/// Most values of a scan that are looked at.
const MOST: usize = 1_000_000;

/// Whether two values of a range are one.
fn near(o: &CriticalOptions, a: f64, b: f64) -> bool {
    (a - b).abs() <= tolerance::SAVED * (o.between[1] - o.between[0]).abs()
}
