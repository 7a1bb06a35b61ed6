//! Places between the steps of a way at which something may be least.

/// Dips of the steps other than the lowest are followed where they are no higher than so many times
/// it. Smaller: the lowest of two alike may be missed. Larger: time for nothing.
const DIPS: f64 = 1.1;
/// Dips that are followed at most, the lowest first.
const MOST_DIPS: usize = 4;

/// A dip of the steps: the places on both sides of one that is no higher than they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dip {
    /// The step that is low, by its number.
    pub step: usize,
    /// The places of its neighbours, its own at the end of a way.
    pub between: [f64; 2],
}

/// A step: the way that it belongs to, its place there, and the value (infinite where there is
/// none).
pub type Step = (u8, f64, f64);

/// The dips of the steps that may hold the least value, the lowest first; none where the least is
/// not above zero.
pub fn dips(steps: &[Step]) -> Vec<Dip> {
    let same = |k: usize, other: usize| steps.get(other).filter(|s| s.0 == steps[k].0);
    let dip = |k: usize| {
        let (_, x, here) = steps[k];
        let (before, after) = (k.checked_sub(1).and_then(|j| same(k, j)), same(k, k + 1));
        // Of two alike the first.
        let is_low = before.is_none_or(|s| here < s.2) && after.is_none_or(|s| here <= s.2);
        let end = |s: Option<&Step>| s.map_or(x, |s| s.1);
        (here.is_finite() && is_low).then(|| Dip { step: k, between: [end(before), end(after)] })
    };
    let mut list: Vec<Dip> = (0..steps.len()).filter_map(dip).collect();
    let value = |d: &Dip| steps[d.step].2;
    list.sort_by(|a, b| value(a).total_cmp(&value(b)));
    let least = list.first().map_or(f64::NAN, value);
    list.retain(|d| least > 0.0 && value(d) <= DIPS * least);
    list.truncate(MOST_DIPS);
    list
}

/// Golden section (J. Kiefer, *Sequential minimax search for a maximum*, Proc. AMS 4, 1953) between
/// two places, until they are no more than `finest` apart; `ask` gives the value at a place,
/// infinite where there is none.
///
/// # Errors
/// The first of `ask`.
pub fn golden_section<E>(
    between: [f64; 2],
    finest: f64,
    mut ask: impl FnMut(f64) -> Result<f64, E>,
) -> Result<(), E> {
    let share = 0.5 * (5f64.sqrt() - 1.0);
    let [mut low, mut high] = between;
    let inner = |low: f64, high: f64| (high - share * (high - low), low + share * (high - low));
    let (mut a, mut b) = inner(low, high);
    let (mut at_a, mut at_b) = (f64::NAN, f64::NAN);
    while high - low > finest {
        // The width falls by a constant share, so that this ends.
        if at_a.is_nan() {
            at_a = ask(a)?;
        }
        if at_b.is_nan() {
            at_b = ask(b)?;
        }
        if at_a <= at_b {
            (high, b, at_b) = (b, a, at_a);
            (a, at_a) = (inner(low, high).0, f64::NAN);
        } else {
            (low, a, at_a) = (a, b, at_b);
            (b, at_b) = (inner(low, high).1, f64::NAN);
        }
    }
    Ok(())
}
