//! How heavy may a train be that drives over the scene? A load factor for every position of it,
//! each proved as one of a scene of its own, and more positions around the least.
//!
//! Between neighbouring positions nothing is proved: the steps say how finely it was looked.

use super::{
    Assessment, Control, LoadFactor, MovingOptions, Proved, assess, coulomb,
    coulomb::DryLoadFactor, limit,
};
use crate::{
    error::{InputError, JsonPath},
    interface::Model,
    parallel,
    scene::Scene,
    train::{self, Position, Standing, Way},
    verdict::Verdict,
};

/// The answer about a train.
#[derive(Clone, Debug)]
pub struct Moving {
    /// Every position at which an axle stands on a span, by direction of travel and place; at least
    /// one.
    pub positions: Vec<Stood>,
    /// Whether the scene stands under its dead load alone, where that was asked.
    pub dead: Option<Proved<Assessment>>,
}

/// The scene with the train in one place.
#[derive(Clone, Debug)]
pub struct Stood {
    /// Where the train is.
    pub position: Position,
    /// The axles on the spans.
    pub axles: Vec<Standing>,
    /// The load factor with joints that open as they slide: a bound.
    pub bound: Proved<LoadFactor>,
    /// With dry friction, where that was asked and the bound has a value or no limit.
    pub dry: Option<Proved<DryLoadFactor>>,
}

impl Stood {
    /// The load factor to use; nothing where there is none, or no limit.
    pub fn value(&self) -> Option<f64> {
        let bound = self.bound.found();
        self.dry.as_ref().map_or(bound, |dry| dry.to_use(bound))
    }
}

/// Positions around a least one are sought until they are this share of a step apart. Larger: the
/// load factor there may be some 1e-5 of it too high. Smaller: it changes by less than its bracket is
/// wide.
const FINEST: f64 = 1e-3;
/// Other dips of the steps than the lowest are followed where they are no higher than so many times it.
/// Smaller: the lowest of two alike may be missed. Larger: time for nothing.
const DIPS: f64 = 1.1;
/// Dips that are followed at most, the lowest first.
const MOST_DIPS: usize = 4;
/// Positions that are asked at once: a sweep runs several of these.
const THREADS: usize = 2;

/// Asks about every position of the train of the scene.
pub(super) fn moving(
    options: &MovingOptions,
    scene: &Scene,
    model: &Model,
    control: &Control,
) -> Result<Moving, InputError> {
    let (Some(train), Some(way)) = (&scene.train, Way::of(scene, model)) else {
        return Err(InputError::at(JsonPath::root(), "the scene has no train to drive over it")
            .hint("add \"train\": { \"axles\": [ { \"at\": 0, \"force\": 100000 } ], \"path\": [-3, 3], \"step\": 0.1 } to the scene, or ask `limit` about its live load"));
    };
    let dead = (!options.skip_dead).then(|| assess(model, control));
    let verdict = dead.as_ref().map(|d| d.verdict);
    let asked = |position: &Position| at(&way, *position, verdict, control);
    let mut positions = each(&train::positions(train), &asked)?;
    let dips = dips(&positions);
    let found = each_dip(&dips, &|&dip| follow(dip, FINEST * train.step, &asked))?;
    positions.extend(found.into_iter().flatten());
    positions.sort_by(|a, b| {
        let key = |s: &Stood| s.position;
        let (a, b) = (key(a), key(b));
        (a.travel as u8).cmp(&(b.travel as u8)).then(a.x.total_cmp(&b.x))
    });
    positions.dedup_by(|a, b| a.position == b.position);
    if positions.is_empty() {
        let path = JsonPath::root().key("train").key("path");
        return Err(InputError::at(path, "at no position an axle stands on a span")
            .hint("make the steps smaller, or move the path"));
    }
    Ok(Moving { positions, dead })
}

/// One position; nothing where no axle stands on a span.
fn at(way: &Way, position: Position, dead: Option<Verdict>, control: &Control) -> Asked {
    let Some(train::Loaded { model, axles }) = way.at(position)? else { return Ok(None) };
    let bound = limit(&model, control);
    let dry = coulomb::beside(&model, &bound, dead, control);
    Ok(Some(Stood { position, axles, bound, dry }))
}

/// What comes of a position.
type Asked = Result<Option<Stood>, InputError>;

/// All positions, in their order, on more than one thread where there can be one: what is asked of
/// each does not depend on that.
fn each(
    list: &[Position],
    asked: &(impl Fn(&Position) -> Asked + Sync),
) -> Result<Vec<Stood>, InputError> {
    let done = match parallel::map(THREADS, list, asked) {
        Ok(done) => done,
        Err(_) => list.iter().map(asked).collect(),
    };
    done.into_iter().filter_map(Result::transpose).collect()
}

/// A dip of the steps: the positions on both sides of one that is no higher than they are, and its
/// value.
#[derive(Clone, Copy)]
struct Dip {
    between: [f64; 2],
    lowest: (Position, f64),
}

/// The dips of the steps that may hold the least load factor, the lowest first.
fn dips(positions: &[Stood]) -> Vec<Dip> {
    let value = |s: &Stood| s.value().unwrap_or(f64::INFINITY);
    let same = |k: usize, other: usize| {
        positions.get(other).filter(|s| s.position.travel == positions[k].position.travel)
    };
    let dip = |k: usize| {
        let here = value(&positions[k]);
        let (before, after) = (k.checked_sub(1).and_then(|j| same(k, j)), same(k, k + 1));
        // Of two alike the first.
        let is_low =
            before.is_none_or(|s| here < value(s)) && after.is_none_or(|s| here <= value(s));
        let x = positions[k].position.x;
        let end = |s: Option<&Stood>| s.map_or(x, |s| s.position.x);
        (here.is_finite() && is_low).then(|| Dip {
            between: [end(before), end(after)],
            lowest: (positions[k].position, here),
        })
    };
    let mut list: Vec<Dip> = (0..positions.len()).filter_map(dip).collect();
    list.sort_by(|a, b| a.lowest.1.total_cmp(&b.lowest.1));
    let least = list.first().map_or(f64::NAN, |d| d.lowest.1);
    // Below zero the scene does not stand without the train: there is nothing to search for.
    list.retain(|d| least > 0.0 && d.lowest.1 <= DIPS * least);
    list.truncate(MOST_DIPS);
    list
}

fn each_dip(
    dips: &[Dip],
    follow: &(impl Fn(&Dip) -> Result<Vec<Stood>, InputError> + Sync),
) -> Result<Vec<Vec<Stood>>, InputError> {
    match parallel::map(THREADS, dips, follow) {
        Ok(done) => done.into_iter().collect(),
        Err(_) => dips.iter().map(follow).collect(),
    }
}

/// Golden section on the load factors of a dip (J. Kiefer, *Sequential minimax search for a
/// maximum*, Proc. AMS 4, 1953): every position on the way, each with its own proof. A position
/// without a value counts as high; it is kept, and governs.
fn follow(
    dip: Dip,
    finest: f64,
    asked: &impl Fn(&Position) -> Asked,
) -> Result<Vec<Stood>, InputError> {
    let share = 0.5 * (5f64.sqrt() - 1.0);
    let [mut low, mut high] = dip.between;
    let mut list = Vec::new();
    let mut ask = |x: f64| {
        let stood = asked(&Position { x, ..dip.lowest.0 })?;
        let value = stood.as_ref().and_then(Stood::value).unwrap_or(f64::INFINITY);
        list.extend(stood);
        Ok::<f64, InputError>(value)
    };
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
    Ok(list)
}
