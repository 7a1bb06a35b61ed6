//! Where a verdict flips between a value at which a scene falls and one at which it stands.
//!
//! On the falling side the least equilibrium error `t` (program V) measures how far the flip is: it grows
//! linearly from zero with the distance. The zero of the secant through two falling points is
//! therefore the value itself, with an error of the product of their distances, and far closer than
//! the two verdicts can be told apart, which needs `t` above the tolerance. Where `t` does not
//! behave (a contact that is lost at once), the range is halved instead. Both ends of the answer
//! are verdicts with their own evidence.

use super::{Assessment, Proved};
use base::{error::InputError, tolerance};
use check::verdict::Verdict;
use model::interface::Model;

/// A model at one value of what varies, with its verdict: as it was computed on the way of a
/// search, or proved.
#[derive(Clone, Debug)]
pub struct Probe<A = Assessment> {
    /// The value.
    pub value: f64,
    /// The model there.
    pub model: Model,
    /// Its verdict, with the evidence.
    pub assessment: A,
}

impl Probe {
    /// The same, its verdict checked.
    pub fn proved(self) -> Probe<Proved<Assessment>> {
        let Self { value, model, assessment } = self;
        let assessment = Proved::new(&model, assessment);
        Probe { value, model, assessment }
    }

    /// The least equilibrium error as its mechanism proves it. The attempts at a verdict end as soon as
    /// that is enough, so that the upper end may still be far away; measured near the flip, the
    /// lower one holds to 1e-11 g.
    pub fn equilibrium_error(&self) -> f64 {
        self.assessment.equilibrium_error.lower
    }

    /// Whether admissible forces exist; `None` where that is undecided.
    pub fn admissible(&self) -> Option<bool> {
        match self.assessment.verdict {
            Verdict::Stable | Verdict::Conditional => Some(true),
            Verdict::Unstable => Some(false),
            Verdict::Undecided => None,
        }
    }
}

/// A flip between two verdicts.
#[derive(Clone, Debug)]
pub struct Flip<A = Assessment> {
    /// The value at which the verdict flips.
    pub value: f64,
    /// The last value at which it falls, on one side.
    pub falls: Probe<A>,
    /// The last value at which it stands, on the other.
    pub stands: Probe<A>,
    /// Whether the value is the zero of the least equilibrium error; the middle of the two ends otherwise.
    pub linear: bool,
    /// Scenes asked.
    pub probes: usize,
}

/// What can be asked at a value.
pub type Ask<'a> = dyn FnMut(f64) -> Result<Probe, InputError> + 'a;

/// Narrows the flip between two probes, of which one falls and the other stands. `least` is the
/// scale of values near zero.
///
/// # Errors
/// A scene between the two cannot be resolved.
pub fn refine(ask: &mut Ask, falls: Probe, stands: Probe, least: f64) -> Result<Flip, InputError> {
    let mut search = Search { ask, falls, stands, falling: Vec::new(), least, probes: 0 };
    search.falling.push((search.falls.value, search.falls.equilibrium_error()));
    let zero = search.zero()?;
    let slope = search.slope();
    let linear = zero.is_some_and(|z| search.reaches(z)) && slope > 0.0;
    if let (Some(zero), true) = (zero, linear) {
        search.close_in(zero, slope)?;
    }
    let (f, s) = (search.falls.value, search.stands.value);
    let value = zero.filter(|_| linear).map_or(0.5 * (f + s), |z| z.clamp(f.min(s), f.max(s)));
    Ok(Flip { value, falls: search.falls, stands: search.stands, linear, probes: search.probes })
}

struct Search<'a, 'b> {
    ask: &'a mut Ask<'b>,
    falls: Probe,
    stands: Probe,
    /// Value and equilibrium error of the falling points, the last ones last.
    falling: Vec<(f64, f64)>,
    least: f64,
    probes: usize,
}

/// The next point lies at this share of the way to the zero of the secant. More: curvature puts it
/// on the standing side, which has no slope. Less: more steps.
const SHARE: f64 = 0.97;
/// No point is laid nearer to the zero than this × the tolerance of a verdict. Smaller: what falls
/// counts as standing. Larger: fewer digits.
const NEAREST: f64 = 5.0;
/// Scenes asked on the way to the zero. A well-behaved equilibrium error takes some eight, halving some
/// forty.
const MOST: usize = 80;
/// Scenes asked on each side of it.
const MOST_OUTWARDS: usize = 40;

impl Search<'_, '_> {
    fn probe(&mut self, value: f64) -> Result<Option<bool>, InputError> {
        let probe = (self.ask)(value)?;
        self.probes += 1;
        let admissible = probe.admissible();
        match admissible {
            Some(true) => self.stands = probe,
            Some(false) => {
                self.falling.push((value, probe.equilibrium_error()));
                self.falls = probe;
            }
            None => {}
        }
        Ok(admissible)
    }

    fn is_between(&self, value: f64) -> bool {
        (value - self.falls.value) * (value - self.stands.value) < 0.0
    }

    /// Whether a zero is believed: it lies between, or where a verdict cannot tell it from the
    /// standing end.
    fn reaches(&self, zero: f64) -> bool {
        self.is_between(zero)
            || (zero - self.stands.value).abs() * self.slope() <= 2.0 * self.told()
    }

    /// The equilibrium error that a verdict can tell from none.
    fn told(&self) -> f64 {
        self.falls.assessment.threshold.max(tolerance::EQUILIBRIUM_ERROR)
    }

    fn scale(&self) -> f64 {
        self.falls.value.abs().max(self.stands.value.abs()).max(self.least)
    }

    /// Growth of the equilibrium error away from the flip, per unit of the value; 0 where there are not two
    /// points for it.
    fn slope(&self) -> f64 {
        match self.falling[..] {
            [.., (a, s), (b, t)] if a != b => ((t - s) / (b - a)).abs(),
            _ => 0.0,
        }
    }

    /// Zero of the secant through the last two falling points.
    fn secant(&self) -> Option<f64> {
        let [.., (a, s), (b, t)] = self.falling[..] else { return None };
        Some(b - t * (b - a) / (t - s)).filter(|z| z.is_finite() && s > t)
    }

    /// The zero of the equilibrium error; `None` where halving closed the range instead.
    fn zero(&mut self) -> Result<Option<f64>, InputError> {
        let tolerance = 0.1 * tolerance::CRITICAL_WIDTH;
        let (mut last, mut stuck) = (None, 0);
        for _ in 0..MOST {
            let gap = (self.stands.value - self.falls.value).abs();
            if gap <= tolerance::CRITICAL_WIDTH * self.scale() {
                return Ok(self.secant().filter(|&z| self.reaches(z)));
            }
            let middle = 0.5 * (self.falls.value + self.stands.value);
            let secant = self.secant().filter(|&z| self.reaches(z));
            if let (Some(z), Some(l)) = (secant, last)
                && f64::abs(z - l) <= tolerance * self.scale()
            {
                return Ok(Some(z));
            }
            // Below the tolerance of a verdict what falls a little counts as standing.
            let least = NEAREST * self.told();
            if let Some(z) =
                secant.filter(|_| (1.0 - SHARE) * self.falls.equilibrium_error() < least)
            {
                return Ok(Some(z));
            }
            let from_falls = secant
                .filter(|_| stuck < 2)
                .map(|z| self.falls.value + SHARE * (z - self.falls.value));
            last = secant;
            match self.probe(from_falls.filter(|&p| self.is_between(p)).unwrap_or(middle))? {
                // Too close to tell: the other side of the range is still open.
                None if secant.is_some() => return Ok(secant),
                None => return Ok(None),
                Some(_) => {}
            }
            let left = (self.stands.value - self.falls.value).abs();
            // A secant that leaves much of the equilibrium error is none.
            let shrinks = matches!(self.falling[..], [.., (_, s), (_, t)] if t < 0.5 * s);
            stuck =
                if left <= 0.5 * gap || (from_falls.is_some() && shrinks) { 0 } else { stuck + 1 };
        }
        Ok(self.secant())
    }

    /// Moves both ends as close to the zero as verdicts can be told.
    fn close_in(&mut self, zero: f64, slope: f64) -> Result<(), InputError> {
        let outwards = (self.falls.value - zero).signum();
        let mut step = 1.1 * self.told() / slope;
        for _ in 0..MOST_OUTWARDS {
            let value = zero + outwards * step;
            if !self.is_between(value) || self.probe(value)? == Some(false) {
                break;
            }
            step *= 1.3;
        }
        let mut step = 0.1 * tolerance::CRITICAL_WIDTH * self.scale();
        for _ in 0..MOST_OUTWARDS {
            let value = zero - outwards * step;
            let beyond = (self.stands.value - zero) * outwards < 0.0;
            if (beyond && !self.is_between(value)) || self.probe(value)? == Some(true) {
                break;
            }
            step *= 3.0;
        }
        Ok(())
    }
}
