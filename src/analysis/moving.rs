//! How heavy may a train be that drives over the scene? A load factor for every position of it,
//! each proved as one of a scene of its own, and more positions around the least.
//!
//! With dry friction the bounds say where to look: the position with the least is asked for its
//! value, and every other only whether it rests at what that one is known to bear
//! (`coulomb::at_least`). One that does not is asked for its own value, the least bound first.
//!
//! Between neighbouring positions nothing is proved: the steps say how finely it was looked.

mod search;

use super::{
    Assessment, Control, Law, LoadFactor, MovingOptions, Proved, assess, coulomb,
    coulomb::{DryLoadFactor, Found},
    limit,
    watch::Counted,
};
use base::{
    error::{InputError, JsonPath},
    tolerance,
};
use check::verdict::{Rate, Verdict, certificate};
use cholesky::parallel;
use model::{
    assembly::Wrench,
    interface::Model,
    train::{self, Loaded, Position, Standing, Way},
};
use scene::{Scene, Train};
use search::{Dip, Step, dips, golden_section};

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
    /// Whether only the least of all positions was asked for here, which it bears.
    pub fn is_at_least(&self) -> bool {
        self.dry.as_ref().is_some_and(|dry| dry.found == Found::AtLeast)
    }

    /// The load factor to use; nothing where there is none, or no limit, or only the least of all
    /// positions was asked for.
    pub fn value(&self) -> Option<f64> {
        let bound = self.bound.found();
        self.dry.as_ref().map_or(bound, |dry| dry.to_use(bound))
    }
}

/// Positions around a least bound are sought until they are this share of a step apart. Larger: the
/// load factor there may be some 1e-5 of it too high. Smaller: it changes by less than its bracket is
/// wide.
const FINEST: f64 = 1e-3;
/// Where something slides at the worst position, so often the way to both its neighbours is halved.
/// More: a state differs by less from one position to the next than it is asked below a value.
/// Fewer: the least may lie between.
const HALVINGS: usize = 3;
/// Places between two steps at which the mechanisms that were found are asked what they allow there.
/// More: sums for nothing. Fewer: a place between them may be the worst.
const PLACES: usize = 8;
/// So many of these mechanisms, those of the least load factors. Fewer: the one that governs between
/// the steps may be missing.
const MECHANISMS: usize = 24;
/// Where a mechanism allows less than this × the least that is known, positions are asked there. Larger:
/// positions for what brackets differ by. Smaller: a worse position passes.
const LOWER: f64 = 1.0 - 1e-4;
/// So often at most. More: time, for every round finds what the ones before left.
const ROUNDS: usize = 6;
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
        return Err(InputError::at(JsonPath::root(), "the scene has no train")
            .hint("add \"train\": { \"axles\": [ { \"at\": 0, \"force\": 100000 } ], \"path\": [-3, 3], \"step\": 0.1 } to the scene, or ask `limit` about its live load"));
    };
    let dead = (!options.skip_dead).then(|| assess(model, control));
    let asked = Asked { way: &way, dead: dead.as_ref().map(|d| d.verdict), control };
    let mut positions = asked.bounds(&train::positions(train))?;
    let steps: Vec<Step> = positions
        .iter()
        .map(|s| (s.position.travel as u8, s.position.x, s.bound.found().unwrap_or(f64::INFINITY)))
        .collect();
    let follow = |dip: &Dip| {
        let mut list = Vec::new();
        golden_section(dip.between, FINEST * train.step, |x| {
            let stood = asked.bound(&Position { x, ..positions[dip.step].position })?;
            let value = stood.as_ref().and_then(|s| s.bound.found()).unwrap_or(f64::INFINITY);
            list.extend(stood);
            Ok::<f64, InputError>(value)
        })?;
        Ok(list)
    };
    let found: Vec<Stood> = each(&dips(&steps), follow)?.into_iter().flatten().collect();
    put(&mut positions, found);
    for _ in 0..ROUNDS {
        let Some((at, width)) = asked.lower_between(&positions, train)? else { break };
        let mut found: Vec<Stood> = asked.bound(&at)?.into_iter().collect();
        golden_section([at.x - width, at.x + width], FINEST * train.step, |x| {
            let stood = asked.bound(&Position { x, ..at })?;
            let value = stood.as_ref().and_then(|s| s.bound.found()).unwrap_or(f64::INFINITY);
            found.extend(stood);
            Ok::<f64, InputError>(value)
        })?;
        put(&mut positions, found);
    }
    if positions.is_empty() {
        let path = JsonPath::root().key("train").key("path");
        return Err(InputError::at(path, "no position has an axle on a span")
            .hint("make the steps smaller, or move the path"));
    }
    match (control.law, options.every_value) {
        (Law::Associative, _) => {}
        (Law::Coulomb, true) => {
            let values = each(&positions, |s| asked.dry(s))?;
            positions.iter_mut().zip(values).for_each(|(s, dry)| s.dry = dry);
        }
        (Law::Coulomb, false) => asked.least(&mut positions)?,
    }
    Ok(Moving { positions, dead })
}

/// Adds positions in their places.
fn put(positions: &mut Vec<Stood>, more: Vec<Stood>) {
    positions.extend(more);
    positions.sort_by(|a, b| {
        let (a, b) = (a.position, b.position);
        (a.travel as u8).cmp(&(b.travel as u8)).then(a.x.total_cmp(&b.x))
    });
    positions.dedup_by(|a, b| a.position == b.position);
}

/// The answers about a list, in its order, on more than one thread where there can be one: what is
/// asked of each does not depend on that.
fn each<T: Sync, R: Send>(
    list: &[T],
    ask: impl Fn(&T) -> Result<R, InputError> + Sync,
) -> Result<Vec<R>, InputError> {
    match parallel::map(THREADS, list, &ask) {
        Ok(done) => done.into_iter().collect(),
        Err(_) => list.iter().map(ask).collect(),
    }
}

/// What is asked of positions.
struct Asked<'a> {
    way: &'a Way<'a>,
    /// The verdict under the dead load alone, where it is known.
    dead: Option<Verdict>,
    control: &'a Control,
}

impl Asked<'_> {
    /// The bound at a position; nothing where no axle stands on a span.
    fn bound(&self, position: &Position) -> Result<Option<Stood>, InputError> {
        let Some(Loaded { model, axles }) = self.way.at(*position)? else { return Ok(None) };
        let bound = limit(&model, self.control);
        Ok(Some(Stood { position: *position, axles, bound, dry: None }))
    }

    fn bounds(&self, list: &[Position]) -> Result<Vec<Stood>, InputError> {
        let counted = Counted::new(self.control.watcher, "position", list.len());
        let ask = |p: &Position| {
            counted.next();
            self.bound(p)
        };
        Ok(each(list, ask)?.into_iter().flatten().collect())
    }

    /// A position between those that were asked at which one of their mechanisms allows less than the
    /// least of all, and half the distance to the next such place. A mechanism bounds the load factor
    /// wherever the train stands: what it needs is the same everywhere, and what the train does to it
    /// is a sum (its influence line).
    fn lower_between(
        &self,
        positions: &[Stood],
        train: &Train,
    ) -> Result<Option<(Position, f64)>, InputError> {
        let live = |p: Position| Ok(self.way.at(p)?.map(|l| l.model.assembly.live));
        let power = |live: &[Wrench], rates: &[Rate]| -> f64 {
            live.iter().zip(rates).map(|(w, r)| certificate::power(w, r)).sum()
        };
        let mut known: Vec<(f64, &Stood)> =
            positions.iter().filter_map(|s| Some((s.bound.found()?, s))).collect();
        known.sort_by(|a, b| a.0.total_cmp(&b.0));
        let Some(least) = known.first().map(|k| k.0).filter(|least| *least > 0.0) else {
            return Ok(None);
        };
        let mut mechanisms = Vec::new();
        for (value, stood) in known.into_iter().take(MECHANISMS) {
            if let Some(live) = live(stood.position)? {
                let needed = value * power(&live, &stood.bound.rates);
                mechanisms.push((needed, &stood.bound.rates));
            }
        }
        let mut worst: Option<(f64, Position, f64)> = None;
        for pair in positions.windows(2) {
            let [a, b] = [pair[0].position, pair[1].position];
            // Where positions lie closer, golden section was there.
            if a.travel != b.travel || b.x - a.x < 0.5 * train.step {
                continue;
            }
            let width = (b.x - a.x) / PLACES as f64;
            for k in 1..PLACES {
                let at = Position { x: a.x + k as f64 * width, ..a };
                let Some(live) = live(at)? else { continue };
                let allowed = |(needed, rates): &(f64, &Vec<Rate>)| match power(&live, rates) {
                    p if p > 0.0 => needed / p,
                    _ => f64::INFINITY,
                };
                let value = mechanisms.iter().map(allowed).fold(f64::INFINITY, f64::min);
                let is_lower = worst.is_none_or(|w| value < w.0);
                if value < LOWER * least && is_lower {
                    worst = Some((value, at, width));
                }
            }
        }
        Ok(worst.map(|(_, at, width)| (at, width)))
    }

    /// The value with dry friction, as far as the bound leaves something to ask.
    fn dry(&self, stood: &Stood) -> Result<Option<Proved<DryLoadFactor>>, InputError> {
        let loaded = self.way.at(stood.position)?;
        Ok(loaded.and_then(|l| coulomb::beside(&l.model, &stood.bound, self.dead, self.control)))
    }

    /// Finds the least value with dry friction, and of every other position that it is not below.
    fn least(&self, positions: &mut Vec<Stood>) -> Result<(), InputError> {
        let mut floor = None;
        self.down(positions, &mut floor)?;
        for _ in 0..HALVINGS {
            let Some(list) = beside_the_worst(positions) else { break };
            let mut more = self.bounds(&list)?;
            self.down(&mut more, &mut floor)?;
            put(positions, more);
        }
        Ok(())
    }

    /// Asks positions whether they rest at the `floor`, the least load factor that those asked for
    /// their value are known to bear; those that do not for their own, the least bound first.
    fn down(&self, positions: &mut [Stood], floor: &mut Option<f64>) -> Result<(), InputError> {
        let height = |s: &Stood| s.bound.found().unwrap_or(f64::INFINITY);
        let mut open: Vec<usize> = (0..positions.len()).collect();
        open.sort_by(|&a, &b| height(&positions[a]).total_cmp(&height(&positions[b])));
        let mut asked_at = None;
        while !open.is_empty() {
            let left = open.len();
            self.control.doing(|| format!("dry friction, {left} positions left"));
            if let Some(at) = *floor
                && asked_at != *floor
            {
                asked_at = *floor;
                let rests = |&k: &usize| -> Result<_, InputError> {
                    let loaded = self.way.at(positions[k].position)?;
                    let ask = |l: Loaded| {
                        coulomb::at_least(&l.model, &positions[k].bound, at, self.control)
                    };
                    Ok(loaded.and_then(ask))
                };
                let rests = each(&open, rests)?;
                open.iter().zip(rests).for_each(|(&k, dry)| positions[k].dry = dry);
                open.retain(|&k| positions[k].dry.is_none());
                if open.is_empty() {
                    break;
                }
            }
            let k = open.remove(0);
            let dry = self.dry(&positions[k])?;
            let bears = dry.as_ref().and_then(|dry| bears(dry)).filter(|at| *at > 0.0);
            *floor = [*floor, bears].into_iter().flatten().reduce(f64::min);
            positions[k].dry = dry;
        }
        Ok(())
    }
}

/// What others are asked whether they bear it: a position as good as the same rests somewhat below
/// this value, and not at it.
fn bears(dry: &DryLoadFactor) -> Option<f64> {
    let below = dry.value.map(|v| v - tolerance::REST_BELOW * v.abs());
    // Without a value, what it was seen to rest at.
    Some(dry.rests_at?.min(below.unwrap_or(f64::INFINITY)))
}

/// Half-way to both neighbours of the position with the least value, where dry friction made it less
/// than the bound, around which more positions were asked already.
fn beside_the_worst(positions: &[Stood]) -> Option<Vec<Position>> {
    let valued = positions.iter().enumerate().filter_map(|(k, s)| Some((k, s.value()?)));
    let (k, value) = valued.min_by(|a, b| a.1.total_cmp(&b.1))?;
    let worst = &positions[k];
    let slides = value < (1.0 - tolerance::REST_BELOW) * worst.bound.found()?;
    let beside = [k.checked_sub(1), Some(k + 1)].into_iter().flatten();
    let middle = |other: usize| {
        let Position { travel, x } = positions.get(other)?.position;
        let here = worst.position;
        (travel == here.travel).then_some(Position { x: 0.5 * (x + here.x), ..here })
    };
    slides.then(|| beside.filter_map(middle).collect())
}
