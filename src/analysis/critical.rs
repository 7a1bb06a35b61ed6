//! At what value of a number in the scene does the verdict flip?
//!
//! The range is scanned first, since a verdict may flip more than once (a voussoir arch is not
//! monotone in anything but its load). Between neighbours whose verdicts differ the flip is
//! narrowed ([`critical_value`](super::critical_value)). A value at which the scene falls less than at both its
//! neighbours may hide a window in which it stands: there the least equilibrium error is followed to its
//! lowest point. A window in which it falls, between two values at which it stands, has no such
//! trace; only a finer scan finds it.

use super::{
    Assessment, Control, Law, Proved, assess,
    critical_value::{Flip, Probe, refine},
};
use base::{
    error::{InputError, JsonPath},
    tolerance,
};
pub use check::terms::Method;
use check::{question::CriticalOptions, verdict::Verdict};
use model::interface::prepare_until;
use scene::Scene;

/// What is varied, and how the range is scanned.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// JSON pointer of the number.
    pub pointer: String,
    /// One end.
    pub from: f64,
    /// The other end.
    pub to: f64,
    /// Values scanned, both ends among them; [`SCAN`](check::question::SCAN) where nothing is said, or every whole number
    /// up to [`WHOLE`](check::question::WHOLE) of them.
    pub scan: Option<usize>,
}

/// One value of the scan.
#[derive(Clone, Debug)]
pub struct Scanned {
    /// The value.
    pub value: f64,
    /// Its verdict and least equilibrium error, or why there is no scene.
    pub outcome: Result<(Verdict, f64), InputError>,
}

/// A change of verdict.
#[derive(Clone, Debug)]
pub struct Change {
    /// The value at which it flips.
    pub value: f64,
    /// How the value was found.
    pub method: Method,
    /// The nearest value below with its verdict and evidence.
    pub below: Probe<Proved<Assessment>>,
    /// The nearest value above.
    pub above: Probe<Proved<Assessment>>,
}

/// The answer of [`critical`].
#[derive(Clone, Debug)]
pub struct Critical {
    /// What was varied.
    pub range: Range,
    /// Whether the number is a count, of which only whole values make scenes.
    pub whole: bool,
    /// For which law of sliding.
    pub law: Law,
    /// The scan, from `from` to `to`.
    pub scan: Vec<Scanned>,
    /// The changes of verdict, in the order of the scan.
    pub changes: Vec<Change>,
    /// Ranges in which it stands and needs self-stress by turns: undecided.
    pub by_turns: Vec<[f64; 2]>,
    /// Without a flip: both ends of the range with their evidence, where there are scenes.
    pub ends: Vec<Probe<Proved<Assessment>>>,
    /// What the reader should know.
    pub notes: Vec<String>,
    /// Scenes asked.
    pub probes: usize,
}

/// Finds every flip of the verdict in a range.
///
/// # Errors
/// The pointer names no number, or no value of the scan makes a scene; the first error is returned.
pub fn critical(scene: &Scene, range: &Range, control: &Control) -> Result<Critical, InputError> {
    scene
        .with_field(&range.pointer, range.from)
        .or_else(|e| scene.with_field(&range.pointer, range.to).map_err(|_| e))?;
    let whole = is_whole(scene, range);
    let statics = Control { law: Law::Associative, ..*control };
    let mut probes = 0;
    let mut ask = |value: f64, control: Control| {
        if probes > 0 && control.deadline.is_over() {
            return Err(InputError::at(JsonPath::root(), "time limit reached"));
        }
        probes += 1;
        // The first is asked whatever the time: an answer that says what is open is worth it.
        let is_over = || probes > 1 && control.deadline.is_over();
        probe_until(scene, &range.pointer, value, &control, &is_over)
    };
    let mut scan: Vec<Scanned> = Vec::new();
    let mut found: Vec<Probe> = Vec::new();
    let mut ends = Vec::new();
    // Values at which admissible forces exist and dry friction stays undecided.
    let mut open: Vec<f64> = Vec::new();
    let values = values(range, whole);
    let count = values.len();
    let mut notes = Vec::new();
    for (k, value) in values.into_iter().enumerate() {
        if k > 0 && control.deadline.is_over() {
            notes.push(format!("time limit reached after {k} of {count} values of the scan: the rest of the range is not known"));
            break;
        }
        control.doing(|| format!("value {} of {count} of the scan", k + 1));
        let answer = ask(value, *control);
        let outcome = answer
            .as_ref()
            .map(|p| (p.assessment.verdict, p.equilibrium_error()))
            .map_err(Clone::clone);
        scan.push(Scanned { value, outcome });
        if let Ok(probe) = answer {
            if k == 0 || k + 1 == count {
                ends.push(probe.clone());
            }
            if probe.assessment.verdict != Verdict::Undecided {
                found.push(probe);
            } else if control.law == Law::Coulomb
                && let Ok(probe) = ask(value, statics)
                && probe.assessment.verdict != Verdict::Undecided
            {
                open.push(value);
                found.push(probe);
            }
        }
    }
    if let (true, Some(error)) = (
        scan.iter().all(|s| s.outcome.is_err()),
        scan.iter().find_map(|s| s.outcome.as_ref().err()),
    ) {
        return Err(error.clone());
    }
    if !whole {
        for (at, window) in windows(&found, &mut |v| ask(v, statics)).into_iter().rev() {
            let with_law = ask(window.value, *control).unwrap_or(window);
            notes.push(format!("an interval between two scanned values, found by following the least equilibrium error: {}", with_law.value));
            found.insert(at, with_law);
        }
    }
    let mut narrowing = Narrowing {
        ask: &mut ask,
        laws: [statics, *control],
        whole,
        open: &open,
        least: 1e-3 * (range.to - range.from).abs(),
        changes: Vec::new(),
        notes: &mut notes,
    };
    for pair in found.windows(2) {
        if let [a, b] = pair {
            narrowing.between(a, b, NESTED);
        }
    }
    let (changes, by_turns) = steady(narrowing.changes);
    notes.extend(by_turns.iter().map(|[from, to]| {
        format!(
            "between {from} and {to} it alternately stands and needs a self-stress: undecided there"
        )
    }));
    // Where there are flips, they say it all.
    let ends =
        if changes.is_empty() { ends.into_iter().map(Probe::proved).collect() } else { Vec::new() };
    Ok(Critical {
        range: range.clone(),
        whole,
        law: control.law,
        scan,
        changes,
        by_turns,
        ends,
        notes,
        probes,
    })
}

/// The verdict at a value.
///
/// # Errors
/// There is no scene with this value.
pub fn probe(
    scene: &Scene,
    pointer: &str,
    value: f64,
    control: &Control,
) -> Result<Probe, InputError> {
    probe_until(scene, pointer, value, control, &|| false)
}

/// The same, given up as soon as `is_over` while contacts are looked for.
fn probe_until(
    scene: &Scene,
    pointer: &str,
    value: f64,
    control: &Control,
    is_over: &dyn Fn() -> bool,
) -> Result<Probe, InputError> {
    let model = prepare_until(&scene.with_field(pointer, value)?, is_over)?;
    let assessment = assess::unproved(&model, control);
    Ok(Probe { value, model, assessment })
}

/// A count takes whole numbers only.
fn is_whole(scene: &Scene, range: &Range) -> bool {
    range.options().is_whole(scene)
}

fn values(range: &Range, whole: bool) -> Vec<f64> {
    range.options().values(whole)
}

impl Range {
    fn options(&self) -> CriticalOptions {
        CriticalOptions {
            law: Law::default(),
            vary: self.pointer.clone(),
            between: [self.from, self.to],
            scan: self.scan,
        }
    }
}

/// Changes of verdict that are looked for between two neighbours of the scan: falls, self-stress,
/// stands, and back again. More: time lost where the verdict is noise.
const NESTED: usize = 3;

/// A flip between two probes, and whether there is another verdict between them as well.
enum Narrowed {
    /// The value, how it was found, and the nearest probes on both sides.
    Flip(f64, Method, Box<[Probe; 2]>),
    /// A probe between with a third verdict.
    Third(Box<Probe>),
}

/// Finds the flips between neighbours of the scan.
struct Narrowing<'a> {
    ask: &'a mut dyn FnMut(f64, Control) -> Result<Probe, InputError>,
    /// Admissible forces alone, and the law that is asked for.
    laws: [Control; 2],
    whole: bool,
    /// Values at which admissible forces exist and dry friction stays undecided.
    open: &'a [f64],
    /// The scale of values near zero.
    least: f64,
    changes: Vec<Change>,
    notes: &'a mut Vec<String>,
}

impl Narrowing<'_> {
    /// Every flip between two probes, in their order: just beside one the verdict is held against
    /// that of the neighbour again.
    fn between(&mut self, a: &Probe, b: &Probe, nested: usize) {
        let open = [a, b].iter().any(|p| self.open.contains(&p.value));
        let settled = a.admissible() != b.admissible() || !open;
        if a.assessment.verdict == b.assessment.verdict || !settled {
            return;
        }
        let narrowed = match (self.whole, a.admissible() == b.admissible()) {
            (true, _) => Ok(scanned(a, b)),
            (false, true) => self.halve(a.clone(), b.clone()),
            (false, false) => self.by_margin(a, b),
        };
        let (value, method, sides) = match narrowed {
            Ok(Narrowed::Third(third)) if nested > 0 => {
                self.between(a, &third, nested - 1);
                self.between(&third, b, nested - 1);
                return;
            }
            Ok(Narrowed::Flip(value, method, sides)) => (value, method, sides),
            Ok(Narrowed::Third(_)) => {
                let (from, to) = (a.value, b.value);
                self.notes.push(format!("between {from} and {to} the verdict alternates"));
                return;
            }
            Err(e) => {
                self.notes.push(format!(
                    "the range from {} to {} could not be narrowed: {e}",
                    a.value, b.value
                ));
                (0.5 * (a.value + b.value), Method::Scan, Box::new([a.clone(), b.clone()]))
            }
        };
        let [one, other] = &*sides;
        if nested > 0 {
            self.between(a, one, nested - 1);
        }
        if let Some(side) = [one, other]
            .into_iter()
            .find(|p| self.laws[1].law == Law::Coulomb && p.assessment.rests_on_statics())
        {
            self.notes.push(format!(
                "at {} admissible forces exist; whether the loads produce them with dry friction is undecided",
                side.value
            ));
        }
        let (below, above) = if one.value <= other.value { (one, other) } else { (other, one) };
        let (below, above) = (below.clone().proved(), above.clone().proved());
        self.changes.push(Change { value, method, below, above });
        if nested > 0 {
            self.between(other, b, nested - 1);
        }
    }

    /// Between a probe that falls and one that does not, by the least equilibrium error.
    fn by_margin(&mut self, a: &Probe, b: &Probe) -> Result<Narrowed, InputError> {
        let [statics, full] = self.laws;
        let is_first = a.admissible() == Some(false);
        let (falls, stands) = if is_first { (a, b) } else { (b, a) };
        let mut ask = |v| (self.ask)(v, statics);
        let Flip { value, falls, mut stands, linear, .. } =
            refine(&mut ask, falls.clone(), stands.clone(), self.least)?;
        // With dry friction what stands by statics may be no more than wedged.
        if full.law == Law::Coulomb
            && let Ok(dry) = (self.ask)(stands.value, full)
            && dry.assessment.verdict != Verdict::Undecided
        {
            stands = dry;
        }
        let method = if linear { Method::Margin } else { Method::Halving };
        let sides = if is_first { [falls, stands] } else { [stands, falls] };
        Ok(Narrowed::Flip(value, method, Box::new(sides)))
    }

    /// Halves the range between two different verdicts.
    fn halve(&mut self, mut a: Probe, mut b: Probe) -> Result<Narrowed, InputError> {
        loop {
            let (middle, scale) =
                (0.5 * (a.value + b.value), a.value.abs().max(b.value.abs()).max(self.least));
            if (a.value - b.value).abs() <= tolerance::DRY_CRITICAL_WIDTH * scale {
                break;
            }
            let probe = (self.ask)(middle, self.laws[1])?;
            match probe.assessment.verdict {
                v if v == a.assessment.verdict => a = probe,
                v if v == b.assessment.verdict => b = probe,
                // As close as it gets.
                Verdict::Undecided => break,
                _ => return Ok(Narrowed::Third(Box::new(probe))),
            }
        }
        let value = 0.5 * (a.value + b.value);
        Ok(Narrowed::Flip(value, Method::Halving, Box::new([a, b])))
    }
}

/// A flip that lies somewhere between two values of the scan.
fn scanned(a: &Probe, b: &Probe) -> Narrowed {
    Narrowed::Flip(0.5 * (a.value + b.value), Method::Scan, Box::new([a.clone(), b.clone()]))
}

/// So many flips in a row between standing and standing only with self-stress are no flips: what is
/// wedged is told from what is not by forces that all but suffice, and each value falls to either
/// side. Fewer: two flips that are ones are taken for noise.
const BY_TURNS: usize = 3;

/// Rows of flips by turns become a range, whose two sides are told.
fn steady(changes: Vec<Change>) -> (Vec<Change>, Vec<[f64; 2]>) {
    let wedged =
        |c: &Change| [&c.below, &c.above].iter().all(|p| p.assessment.verdict != Verdict::Unstable);
    let (mut left, mut by_turns) = (Vec::new(), Vec::new());
    for group in changes.chunk_by(|a, b| wedged(a) && wedged(b)) {
        match group {
            [first, .., last] if group.len() >= BY_TURNS => {
                let ends = [first, last].map(|c| [&c.below, &c.above]);
                let sides = ends.concat();
                let by = |a: &&&Probe<_>, b: &&&Probe<_>| a.value.total_cmp(&b.value);
                let (Some(below), Some(above)) =
                    (sides.iter().min_by(by).copied(), sides.iter().max_by(by).copied())
                else {
                    continue;
                };
                by_turns.push([below.value, above.value]);
                if below.assessment.verdict != above.assessment.verdict {
                    let value = 0.5 * (below.value + above.value);
                    let (below, above) = (below.clone(), above.clone());
                    left.push(Change { value, method: Method::Scan, below, above });
                }
            }
            _ => left.extend(group.iter().cloned()),
        }
    }
    (left, by_turns)
}

/// Standing values between neighbours of the scan that all fall, with where they belong.
fn windows(
    found: &[Probe],
    ask: &mut dyn FnMut(f64) -> Result<Probe, InputError>,
) -> Vec<(usize, Probe)> {
    let mut list = Vec::new();
    for k in 1..found.len().saturating_sub(1) {
        let [a, b, c] = [&found[k - 1], &found[k], &found[k + 1]];
        let t = Probe::equilibrium_error;
        if [a, b, c].iter().any(|p| p.admissible() != Some(false)) || t(b) > t(a) || t(b) >= t(c) {
            continue;
        }
        if let Some(window) = lowest(a, b, c, ask) {
            let at = if (window.value - b.value) * (c.value - b.value) > 0.0 { k + 1 } else { k };
            list.push((at, window));
        }
    }
    list
}

/// Follows the equilibrium error downhill between three falling values; returns the first that stands.
fn lowest(
    a: &Probe,
    b: &Probe,
    c: &Probe,
    ask: &mut dyn FnMut(f64) -> Result<Probe, InputError>,
) -> Option<Probe> {
    // Golden sections: the part kept at each step.
    const KEPT: f64 = 0.618_033_988_749_895;
    const STEPS: usize = 24;
    let (mut low, mut middle, mut high) = (a.value, (b.value, b.equilibrium_error()), c.value);
    for _ in 0..STEPS {
        let right = (high - middle.0).abs() > (middle.0 - low).abs();
        let value = if right {
            middle.0 + (1.0 - KEPT) * (high - middle.0)
        } else {
            middle.0 - (1.0 - KEPT) * (middle.0 - low)
        };
        let probe = ask(value).ok()?;
        if probe.admissible() == Some(true) {
            return Some(probe);
        }
        let t = probe.equilibrium_error();
        match (t < middle.1, right) {
            (true, true) => (low, middle) = (middle.0, (value, t)),
            (true, false) => (high, middle) = (middle.0, (value, t)),
            (false, true) => high = value,
            (false, false) => low = value,
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn range(from: f64, to: f64, scan: usize) -> Range {
        Range { pointer: "/templates/0/arch/thickness".into(), from, to, scan: Some(scan) }
    }

    fn arch(voussoirs: usize) -> Scene {
        let text = format!(
            r#"{{ "format": "voussoir-scene/1", "joints": {{ "default": {{ "friction": "infinite" }} }},
            "templates": [ {{ "arch": {{ "radius": 1, "thickness": 0.2, "depth": 1, "voussoirs": {voussoirs} }} }} ] }}"#
        );
        scene::read_str("test", text).unwrap().0
    }

    #[test]
    fn scan_reaches_both_ends_and_counts_are_whole() {
        assert_eq!(values(&range(0.1, 0.3, 3), false), [0.1, 0.2, 0.3]);
        assert_eq!(values(&range(4.0, 7.0, 30), true), [4.0, 5.0, 6.0, 7.0]);
        let mut count = range(4.0, 7.0, 9);
        count.scan = None;
        assert_eq!(values(&count, true), [4.0, 5.0, 6.0, 7.0]);
        count.pointer = "/templates/0/arch/voussoirs".into();
        assert!(is_whole(&arch(8), &count));
        assert!(!is_whole(&arch(8), &range(0.1, 0.3, 3)));
    }

    #[test]
    fn the_zero_of_the_equilibrium_error_is_far_closer_than_verdicts_can_tell() {
        // Five-hinge closed form for 16 straight voussoirs.
        let exact = 0.10707620314306167;
        let control = Control { law: Law::Associative, ..Control::default() };
        let answer = critical(&arch(16), &range(0.05, 0.25, 5), &control).unwrap();
        let [change] = &answer.changes[..] else { panic!("{:?}", answer.changes.len()) };
        println!(
            "{} {} {} in {} scenes",
            change.below.value, change.value, change.above.value, answer.probes
        );
        assert_eq!(change.method, Method::Margin);
        assert!((change.value / exact - 1.0).abs() < 1e-9, "{}", change.value / exact - 1.0);
        assert!(
            change.below.value < exact && exact < change.above.value,
            "{} {}",
            change.below.value,
            change.above.value
        );
        assert!(change.above.value - change.below.value < 1e-8 * exact);
        assert!(answer.probes < 30, "{}", answer.probes);
    }
}
