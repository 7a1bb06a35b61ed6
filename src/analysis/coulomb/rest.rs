//! Up to which load factor does the scene come to rest under dry friction?
//!
//! Forces and a mechanism that obey Coulomb's law at λ show that the scene can move there. Whether
//! it rests below is another matter: part of it may be wedged, and stand on nothing but a
//! self-stress that the loads do not produce, while the mechanism moves something else. So the state
//! ([`state`]) is asked under the dead load, on the way, and just below the value, and where it
//! stays open there just above; where it does not rest, the value is no load factor of the scene,
//! and the greatest one up to which it rests is sought by halving. Where not everything came out
//! between that and motion, or the bound, and it is little, the end up to which it rests is the
//! value. *Computed, not proved:* that a state comes to rest.

use super::{
    answer::DryLoadFactor,
    distance::slides_nowhere,
    state::{DryState, within},
};
use crate::{Control, LoadFactor, Outcome};
use base::{number, tolerance};
use check::{
    terms::{Found, MANY, StateMotion, is_reached, resolution},
    verdict::{Forces, Verdict, claim, law},
};
use cholesky::parallel;
use model::{
    assembly::Assembly,
    interface::{Model, is_forest},
};

/// Where the state is asked on the way to a value, in shares of it. Fewer: what comes loose on the
/// way and wedges again is not seen.
const ON_THE_WAY: [f64; 3] = [0.25, 0.5, 0.75];
/// The same on the way to a bound, where no value was found. Fewer: states next to the bound are
/// asked first, which take longest (a dome of 145 blocks: 40 s at 0.999 times the bound, where it
/// moves at 0.95 in 1 s).
const ON_THE_WAY_TO_A_BOUND: [f64; 4] = [0.25, 0.5, 0.75, 0.95];
/// The same for scenes of no more than [`FEW`] free blocks in which something slides: there the law
/// may have both rest and motion for an answer over a whole range of load factors, and a motion
/// anywhere in it refutes all values above.
const ON_THE_WAY_OF_FEW: [f64; 11] =
    [0.05, 0.15, 0.25, 0.35, 0.45, 0.55, 0.65, 0.75, 0.85, 0.95, 0.99];
const FEW: usize = 100;
/// The same for scenes of more than [`MANY`] free blocks, a state of which takes seconds; the last
/// one is near enough to the bound to be a value. They are asked beside the search for one.
const ON_THE_WAY_OF_MANY: [f64; 2] = [0.65, 1.0 - 0.95 * tolerance::REST_WITHIN];

/// No more free blocks than this: a value is searched for even where the state next to the bound
/// rests and had to be sought from afar. More: a minute and longer for a search that finds none
/// (walls of 30 × 30 and 40 × 40). Fewer: values are lost (25 × 25 has one).
const MOST_SEARCHED: usize = 800;

/// How far below the value the state is asked, in shares of it; the next one where the one before
/// does not come out. Nearer: states that neither rest nor move. Farther: what the value says is
/// not seen.
const BELOW: [f64; 4] = [tolerance::REST_BELOW, 1e-2, 0.05, 0.2];

/// How far above a value the state is asked, in shares of it, where it was not seen at rest just
/// below; the last one is as far as what rests may be from what moves. Nearer: motions too slow to be
/// told. Farther: less is known of the value.
const ABOVE: [f64; 4] = [tolerance::REST_BELOW, 1e-2, 0.05, 0.9 * tolerance::REST_WITHIN];

/// Load factors are asked about there, as far as this share of the way to where they come from: in so few
/// digits that they do not hang on the last ones of another answer (the last bits of a bound decided
/// which states of the Armadillo Vault came out). Another scale of the live load, but a power of ten, asks
/// next to them. Larger: states that are not where they should be, and no value just below a bound.
/// Smaller: more digits.
const ABOUT: f64 = 5e-3;

/// Without an end to the load factor: where the state is asked, in multiples of the one at which
/// live and dead load weigh the same.
const WITHOUT_END: [f64; 3] = [0.1, 1.0, 10.0];

/// Most states asked while halving. Fewer: the value is known to fewer digits than
/// [`tolerance::DRY_CRITICAL_WIDTH`].
const MOST: usize = 40;
/// Most pairs of states of slow scenes: what is between them is then a 81st of what it was. Of more than
/// [`MANY`] free blocks there are more until that is as little as is asked of a value, and no more after
/// that where states had to be sought from afar. Fewer: the value is known to fewer digits. More:
/// seconds each for digits that mean little.
const MOST_OF_SLOW: usize = 4;

/// Most states that stay undecided where none was seen to move: without one there is no value, only
/// how far it was seen at rest. While halving so many more, but for more than [`MANY`] free blocks.
/// More: minutes, for these states take longest. Fewer: it is seen at rest less far.
const MOST_OPEN: usize = 4;

/// Where states are slow and had to be sought from afar, one is given up that is so many times the
/// work of the dearest that came out. Less: states are given up that would rest. More: a minute for
/// three next to where a dome of 145 blocks moves, of which one would be told (21.3918° for 21.3829°).
const DEARER: usize = 2;

/// So many states on the way are asked at a time. More: those above one that moves are asked in
/// vain. Fewer: threads wait.
const AT_A_TIME: usize = 4;

/// States asked of a scene under load factors.
struct Probe<'a> {
    at: &'a (dyn Fn(f64) -> Model + Sync),
    control: &'a Control,
    /// All that came out, with their load factors.
    seen: Vec<(f64, DryState)>,
    /// Most of them that stay undecided.
    most_open: usize,
    /// Of more than [`MANY`] free blocks: how narrow what lies between rest and motion has to be.
    told: Option<f64>,
    /// Whether each further state takes seconds: more than [`MANY`] free blocks, or more than [`FEW`]
    /// of which states had to be sought from afar.
    is_slow: bool,
}

impl Probe<'_> {
    /// The state at a load factor; nothing where the time is over.
    fn state(&self, lambda: f64) -> Option<(f64, DryState)> {
        if self.control.deadline.is_over() {
            return None;
        }
        self.control
            .doing(|| format!("dry friction: whether it rests at {lambda:.6} of the live load"));
        Some((lambda, within(&(self.at)(lambda), self.control, self.work())))
    }

    /// What the state does at a load factor, which is asked once; nothing where the time is over.
    fn ask(&mut self, lambda: f64) -> Option<StateMotion> {
        if let Some((_, known)) = self.seen.iter().find(|(seen, _)| *seen == lambda) {
            return Some(known.motion);
        }
        self.seen.push(self.state(lambda)?);
        self.seen.last().map(|(_, state)| state.motion)
    }

    /// The states that do this, with their load factors.
    fn seen_to(&self, motion: StateMotion) -> impl Iterator<Item = &(f64, DryState)> {
        self.seen.iter().filter(move |(_, state)| state.motion == motion)
    }

    /// The least load factor at which it moves.
    fn moves(&self) -> Option<&(f64, DryState)> {
        self.seen_to(StateMotion::Moves).min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The greatest load factor at which it rests. What rests above one at which it moves does not
    /// count.
    fn rests(&self) -> Option<&(f64, DryState)> {
        let moves = self.moves().map_or(f64::INFINITY, |m| m.0);
        self.seen_to(StateMotion::Rests)
            .filter(|(lambda, _)| *lambda < moves)
            .max_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The same, or the dead load, at which it is known to rest.
    fn rests_at(&self) -> f64 {
        self.rests().map_or(0.0, |r| r.0)
    }

    /// How much work the next state may be: some more than the dearest that came out from afar.
    fn work(&self) -> usize {
        let told = |s: &&(f64, DryState)| s.1.from_afar && s.1.motion != StateMotion::Undecided;
        let dearest = self.seen.iter().filter(told).map(|s| s.1.work).max();
        dearest.filter(|_| self.is_slow).map_or(usize::MAX, |work| DEARER * work)
    }

    /// Whether some of them had to be sought from afar.
    fn is_dear(&self) -> bool {
        self.seen.iter().any(|(_, state)| state.from_afar)
    }

    /// How narrow what lies between rest and the rest has to be where nothing moves.
    fn open_width(&self) -> f64 {
        if self.is_slow && self.is_dear() { tolerance::REST_WITHIN } else { tolerance::REST_BELOW }
    }

    /// Whether nothing more is to be had.
    fn is_hopeless(&self) -> bool {
        self.seen_to(StateMotion::Moves).next().is_none()
            && self.seen_to(StateMotion::Undecided).count() >= self.most_open
    }

    /// The search for a value of a scene of many blocks, with the states on the way to its bound
    /// (from the `first` load factor on) beside it, or in place of it.
    fn beside(
        &mut self,
        search: impl FnOnce() -> DryLoadFactor,
        (first, bound): (Option<f64>, f64),
        assembly: &Assembly,
        associative: &LoadFactor,
    ) -> DryLoadFactor {
        // What falls by itself is asked nothing else.
        let states = || {
            let mut seen: Vec<(f64, DryState)> =
                first.into_iter().flat_map(|at| self.state(at)).collect();
            if seen.iter().all(|(_, state)| state.motion == StateMotion::Rests) {
                seen.extend(self.states(&ON_THE_WAY_OF_MANY.map(|share| on_the_way(share, bound))));
            }
            seen
        };
        let answer;
        if assembly.free().count() <= MOST_SEARCHED {
            (answer, self.seen) = parallel::both(true, search, states);
        } else {
            self.seen = states();
            let is_near = self.rests_at() >= (1.0 - tolerance::REST_WITHIN) * bound;
            let is_enough = is_near && self.is_dear();
            answer = if is_enough { DryLoadFactor::unanswered(associative) } else { search() };
        }
        answer
    }

    /// The states at these load factors, all at once, as far as there was time.
    fn states(&self, at: &[f64]) -> Vec<(f64, DryState)> {
        let one = |lambda: &f64| self.state(*lambda);
        let states = parallel::map(0, at, one).unwrap_or_else(|_| at.iter().map(one).collect());
        states.into_iter().flatten().collect()
    }

    /// Asks at these load factors; false where the time is over before.
    fn ask_all(&mut self, at: &[f64]) -> bool {
        let states = self.states(at);
        let in_time = states.len() == at.len();
        self.seen.extend(states);
        in_time
    }

    /// Asks at these shares of a load factor, some at a time on all threads, until one moves or
    /// nothing more is to be had; false where the time is over before.
    fn climb(&mut self, shares: &[f64], of: f64) -> bool {
        for some in shares.chunks(AT_A_TIME) {
            let at: Vec<f64> = some.iter().map(|share| on_the_way(*share, of)).collect();
            let in_time = self.ask_all(&at);
            if self.moves().is_some_and(|m| m.0 <= of) || self.is_hopeless() {
                break;
            }
            if !in_time {
                return false;
            }
        }
        true
    }

    /// Narrows what lies between rest and the rest, by halving, or where each state is slow by two
    /// at a time; false where the time is over before. Without a state that moves there is no value,
    /// and no more digits are sought than a value may be off.
    fn narrow(&mut self, end: f64) -> bool {
        for pairs in 0..MOST {
            let is_late = pairs >= MOST_OF_SLOW;
            let width = match (self.moves(), self.told) {
                (Some(_), Some(told)) if is_late || self.is_dear() => told,
                _ if self.is_slow && is_late => break,
                (Some(_), _) => tolerance::DRY_CRITICAL_WIDTH,
                (None, _) => self.open_width(),
            };
            let rests = self.rests_at();
            let not_at_rest = self.seen.iter().filter(|s| s.1.motion != StateMotion::Rests);
            let above = not_at_rest.map(|s| s.0).filter(|at| *at > rests).fold(end, f64::min);
            if self.is_hopeless() || above - rests <= width * above.abs() {
                break;
            }
            if !self.ask_all(&between(rests, above, self.is_slow)) {
                return false;
            }
        }
        true
    }
}

/// Makes a complementary solution the load factor up to which the scene comes to rest. `dead` is
/// the verdict under the dead load, where it is known, `at` the `assembly` under a load factor as
/// its dead load.
pub(crate) fn up_to_rest(
    complementary: impl FnOnce() -> DryLoadFactor,
    assembly: &Assembly,
    associative: &LoadFactor,
    dead: Option<Verdict>,
    at: &(dyn Fn(f64) -> Model + Sync),
    control: &Control,
) -> DryLoadFactor {
    let is_large = assembly.free().count() > MANY;
    let told = is_large.then(|| resolution(assembly));
    let (seen, most_open) = (Vec::new(), MOST_OPEN);
    let mut probe = Probe { at, control, seen, most_open, told, is_slow: is_large };
    let towards = associative.found().filter(|&bound| {
        is_large
            && bound > 0.0
            && dead.is_none_or(|dead| dead == Verdict::Stable)
            && !slides_nowhere(&at(bound), associative)
            && !is_forest(&at(0.0))
    });
    // The dead load is asked first, where it is not known.
    let first = dead.is_none().then_some(0.0);
    let mut answer = match towards {
        Some(bound) => probe.beside(complementary, (first, bound), assembly, associative),
        None => complementary(),
    };
    let bound = associative.value.filter(|_| associative.outcome == Outcome::Found);
    // Nothing may be added to the dead load, as far as numbers tell: the value is zero where that
    // rests.
    let least = tolerance::LOAD_FACTOR_FLOOR * claim::natural_factor(assembly);
    let nothing_more = bound.is_some() && associative.bracket.upper <= least;
    let negative = bound.is_some_and(|b| b <= 0.0);
    if !matches!(associative.outcome, Outcome::Found | Outcome::Unbounded) {
        if dead == Some(Verdict::Unstable) {
            (answer.found, answer.value) = (Found::NotAtRest, None);
        }
        return answer;
    }
    // Where contacts form no closed chain there is nothing that could be wedged, and what the dead
    // load leaves standing stands up to the value; up to the bound, where no other one came out. A
    // value of which the dead load falls already is not reached from it; one below zero says so
    // itself.
    let is_open = answer.found == Found::Undecided;
    let has_value = !is_open || bound.is_some_and(|_| associative.bracket.lower >= 0.0);
    if has_value && is_forest(&at(0.0)) {
        let falls = match dead {
            _ if negative => false,
            Some(dead) => dead == Verdict::Unstable,
            None => probe.ask(0.0) == Some(StateMotion::Moves),
        };
        if falls {
            (answer.found, answer.value) = (Found::NotAtRest, None);
            answer.moves_at = Some(0.0).filter(|_| dead.is_none());
        } else if is_open {
            let lower = associative.bracket.lower;
            answer.rests_at = Some(lower);
            rests_below(&mut answer, (lower, &associative.forces));
        } else {
            answer.rests_at = answer.value;
        }
        return answer;
    }
    // No forces at all hold the dead load: the bound proves it, and needs no time.
    if bound.is_some() && associative.bracket.upper < 0.0 {
        (answer.found, answer.value) = (Found::NotAtRest, None);
        return answer;
    }
    if (negative && !nothing_more) || control.deadline.is_over() {
        return answer;
    }
    // What moves under less than the dead load says nothing about more.
    if answer.value.is_some_and(|v| v < 0.0) {
        (answer.found, answer.value) = (Found::Undecided, None);
    }
    let rests = match dead {
        Some(Verdict::Stable) => Some(StateMotion::Rests),
        // Its own proof says so.
        Some(Verdict::Unstable) => {
            (answer.found, answer.value) = (Found::NotAtRest, None);
            return answer;
        }
        Some(Verdict::Conditional) => Some(StateMotion::Moves),
        Some(Verdict::Undecided) => Some(StateMotion::Undecided),
        None => probe.ask(0.0),
    };
    match rests {
        Some(StateMotion::Rests) => answer.rests_at = Some(0.0),
        Some(StateMotion::Moves) => {
            (answer.found, answer.value, answer.moves_at) = (Found::NotAtRest, None, Some(0.0))
        }
        // What is not known at the dead load is not known above it.
        Some(StateMotion::Undecided) | None => {
            (answer.found, answer.value) = (Found::Undecided, None)
        }
    }
    if rests == Some(StateMotion::Rests) && nothing_more {
        rests_below(&mut answer, (0.0, &associative.forces));
    } else if rests == Some(StateMotion::Rests) {
        climb(&mut probe, &mut answer, associative, assembly);
    }
    answer
}

/// From the dead load, at which the state rests, upwards.
fn climb(
    probe: &mut Probe,
    answer: &mut DryLoadFactor,
    associative: &LoadFactor,
    assembly: &Assembly,
) {
    let blocks = assembly.free().count();
    let bound = associative.value.filter(|_| associative.outcome == Outcome::Found);
    let on_the_way = match blocks {
        _ if blocks > MANY => &ON_THE_WAY_OF_MANY[..],
        _ if blocks > FEW && answer.value.is_none() => &ON_THE_WAY_TO_A_BOUND[..],
        _ if blocks > FEW || answer.found == Found::NothingSlides => &ON_THE_WAY[..],
        _ => &ON_THE_WAY_OF_FEW[..],
    };
    // A value, or where none was found the bound above all values.
    let goal = answer.value.or(associative.value);
    match goal {
        Some(goal) => {
            // Not what was asked beside the search.
            if probe.seen.iter().all(|(lambda, _)| *lambda == 0.0) {
                probe.climb(on_the_way, goal);
            }
            if blocks > FEW && probe.is_dear() {
                probe.is_slow = true;
            }
            below(probe, goal, answer.value.is_some());
            if answer.value.is_some() && !probe.is_slow {
                above(probe, goal, bound.unwrap_or(f64::INFINITY));
            }
        }
        None => {
            let natural = claim::natural_factor(assembly);
            probe.climb(&WITHOUT_END, natural);
        }
    }
    // Where nothing else is known, the bracket from below is what there is to say.
    let is_known = |probe: &Probe| answer.value.is_some_and(|v| is_reached(probe.rests_at(), v));
    let end = probe.moves().map(|m| m.0).or(goal.filter(|_| !is_known(probe)));
    if !probe.is_slow {
        probe.most_open += MOST_OPEN;
    }
    let mut narrow = end.is_none_or(|end| probe.narrow(end));
    // On the way to what came out of halving it is asked once more, until no motion refutes it.
    while let Some(moves) =
        probe.moves().map(|m| m.0).filter(|_| narrow && on_the_way.len() == ON_THE_WAY_OF_FEW.len())
    {
        let value = probe.rests_at();
        narrow = probe.climb(on_the_way, value);
        match probe.moves() {
            Some((lower, _)) if *lower < moves => narrow = probe.narrow(*lower),
            _ => break,
        }
    }
    let (rests_at, moves_at) = (probe.rests_at(), probe.moves().map(|m| m.0));
    (answer.rests_at, answer.moves_at) = (Some(rests_at), moves_at);
    // Where not everything came out up to where it moves, or else to the proved bound, and that is
    // little, the safe end is a value.
    let is_open =
        |end: f64| probe.seen_to(StateMotion::Undecided).any(|(at, _)| *at > rests_at && *at < end);
    let is_told = |end| is_open(end) || is_told(rests_at, end, resolution(assembly));
    let narrow = narrow && moves_at.is_none_or(is_told);
    let open_to = match moves_at {
        Some(end) => Some(end).filter(|end| !narrow || is_open(*end)),
        None => bound.filter(|_| !is_known(probe)),
    };
    let is_near = open_to.is_some_and(|end| rests_at >= (1.0 - tolerance::REST_WITHIN) * end);
    if let Some((rests_at, state)) = probe.rests().filter(|_| is_near) {
        return rests_below(answer, (*rests_at, &state.forces));
    }
    let Some((moves_at, moving)) = probe.moves() else { return };
    if !narrow {
        (answer.found, answer.value) = (Found::Undecided, None);
        return;
    }
    (answer.found, answer.value) = (Found::Rests, Some(rests_at));
    // The evidence is that of the states on both sides.
    if let Some((_, state)) = probe.rests() {
        answer.forces.clone_from(&state.forces);
    }
    answer.rates = law::motion(&(probe.at)(*moves_at), &moving.forces).rates;
    (answer.natural_map, answer.natural_map_in_loads) = (f64::INFINITY, f64::INFINITY);
}

/// A share of a load factor, with few digits.
fn on_the_way(share: f64, of: f64) -> f64 {
    number::roundest(share * of, ABOUT * (share * of).abs())
}

/// A load factor that is this share further than another, with few digits.
fn next_to(value: f64, share: f64) -> f64 {
    number::roundest((1.0 + share) * value, ABOUT * (share * value).abs())
}

/// Where to ask between rest and what does not rest.
fn between(rests: f64, above: f64, is_slow: bool) -> Vec<f64> {
    let width = above - rests;
    let shares: &[f64] = if is_slow { &[1.0 / 3.0, 2.0 / 3.0] } else { &[0.5] };
    shares.iter().map(|share| number::roundest(rests + share * width, ABOUT * width)).collect()
}

/// Whether what lies between rest and motion is as little as a value says. Pairs of slow scenes may
/// end before.
fn is_told(rests: f64, moves: f64, resolution: f64) -> bool {
    moves - rests <= resolution * moves.abs()
}

/// Asks next to a load factor, nearer first; without a value, what does not come out far below the
/// bound does not next to it.
fn below(probe: &mut Probe, goal: f64, is_value: bool) {
    let halfway = probe.rests_at();
    let is_far = halfway < ON_THE_WAY[ON_THE_WAY.len() - 1] * goal;
    if !is_value && (is_far || goal - halfway <= probe.open_width() * goal.abs()) {
        return;
    }
    for share in BELOW {
        let lambda = next_to(goal, -share);
        if probe.moves().is_some()
            || lambda <= halfway
            || probe.is_hopeless()
            || probe.ask(lambda) != Some(StateMotion::Undecided)
        {
            break;
        }
    }
}

/// Asks above a value below which it was not seen at rest, up to the bound, until it moves.
fn above(probe: &mut Probe, value: f64, bound: f64) {
    for share in ABOVE {
        let lambda = next_to(value, share);
        if is_reached(probe.rests_at(), value) || probe.moves().is_some() || lambda > bound {
            break;
        }
        probe.ask(lambda);
    }
}

/// The load factor up to which it was seen at rest is the value, with forces that hold it there.
fn rests_below(answer: &mut DryLoadFactor, (rests_at, forces): (f64, &Forces)) {
    (answer.found, answer.value) = (Found::RestsBelow, Some(rests_at));
    answer.forces.clone_from(forces);
    (answer.natural_map, answer.natural_map_in_loads) = (f64::INFINITY, f64::INFINITY);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever the last digits of the load factor that it comes from, the same is asked.
    #[test]
    fn states_are_asked_at_few_digits() {
        for of in [0.505_112_201_3, 0.505_112_201_4, 0.505_112_3] {
            assert_eq!(on_the_way(0.65, of), 0.328);
            assert_eq!(next_to(of, -tolerance::REST_BELOW), 0.504_607);
            assert_eq!(between(0.328, on_the_way(0.905, of), true), [0.371, 0.414]);
            assert_eq!(between(0.3519, 0.3567, false), [0.3543]);
        }
        // Each is where it should be: below, next enough to be a value, and in between.
        for k in 0..400 {
            let of = 1.07_f64.powi(k - 200);
            let far = 1.0 - 0.95 * tolerance::REST_WITHIN;
            assert!(on_the_way(far, of) >= (1.0 - tolerance::REST_WITHIN) * of);
            assert!(on_the_way(0.99, of) < of && on_the_way(0.95, of) < on_the_way(0.99, of));
            let near = next_to(of, -tolerance::REST_BELOW);
            assert!(near < of && is_reached(near, of), "{near} {of}");
            assert!(next_to(of, tolerance::REST_BELOW) > of);
            let halves = between(of, 1.001 * of, false);
            assert!(halves.iter().all(|at| *at > of && *at < 1.001 * of));
            let negative = between(-of, 0.5 * of, true);
            assert!(-of < negative[0] && negative[0] < negative[1] && negative[1] < 0.5 * of);
        }
    }

    /// A dome of 145 blocks at μ = 0.8: its result was refuted, for at 0.393071 it still rests.
    #[test]
    fn a_value_with_rest_above_it_is_the_safe_end_alone() {
        let (rests, moves) = (0.3930695669986692, 0.39441110135702645);
        let few = 4.0 * tolerance::DRY_CRITICAL_WIDTH;
        assert!(!is_told(rests, moves, few));
        assert!(is_told(rests, moves, 1.0 / 64.0) && is_told(rests, (1.0 + few) * rests, few));
    }
}
