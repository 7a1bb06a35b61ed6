//! Program C: do the loads themselves produce the forces that hold the scene?
//!
//! Admissible forces may need self-stress: a block between two posts is held
//! by any squeeze, but nothing squeezes it. The state of the scene on slightly compliant contacts
//! answers it. What balances leaves an acceleration that falls with ε; what does not keeps it, and
//! is then a motion that obeys Coulomb's law with the forces at hand. *Proved:* a state that moves
//! is a solution of the law (its natural map is recomputed from the forces). *Computed, not
//! proved:* that a state at rest is the one the loads produce; rest under self-stress and motion
//! are often both exact solutions. Where one step of the state's equation leads nowhere, blocks are
//! followed there as it comes about, in many ([`Exact::flowed`]); friction then holds on wherever they
//! have slid to, and the loads are put on at once.

use super::crushing::within_strength;
use crate::ladder::Control;
use base::tolerance;
use check::{
    terms::{StateMotion, StateStep},
    verdict::{
        Forces,
        law::{self, Released},
    },
};
use model::interface::Model;
use solve::{
    Settings,
    clock::Instant,
    coulomb::{Exact, FixedPoint, Newton, Solved, Solvers, StoppingCriterion, iterate},
    deadline::Deadline,
    program::{
        StaticsOptions,
        coulomb::{Contacts, HeldQuantity, Objective},
    },
};

/// The state of a scene under its dead load with dry friction.
#[derive(Clone, Debug)]
pub struct DryState {
    /// What it does.
    pub motion: StateMotion,
    /// The continuation in ε.
    pub steps: Vec<StateStep>,
    /// Contact forces of the last step, N.
    pub forces: Forces,
    /// Whether it had to be sought from afar, followed as it comes about: the dearest way.
    pub from_afar: bool,
    /// What it took: rows of all matrices that were factored.
    pub work: usize,
}

/// The ε of the continuation. Fewer: long chains of joints, an arch of 10,000 slices, still bend
/// too far at the last one. More: the engine's noise over ε passes for an acceleration.
const EPSILONS: [f64; 7] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9];

/// The engine's tolerance per ε: the rates are the imbalance over ε, and want no more than five
/// digits. Larger: the rates are noise. Smaller: the engine reaches its noise (3e-10 on vaults of
/// 400 blocks) first, and crawls there for five times as many iterations as it took to come so far.
const TOLERANCE_PER_EPSILON: f64 = 1e-5;

/// The engine's tolerance at large ε. Larger: the friction limits settle no better than that.
const COARSEST_TOLERANCE: f64 = 1e-9;

/// Steps of ε before the law itself is solved where no verdict came out. Fewer: time lost on scenes
/// that rest plainly. More: the limits of states near the edge of friction do not settle.
const BEFORE_EXACT: usize = 2;

/// Where a fixed point took no more programs than this, the next is sought the same way; where it
/// took more, or none because the law was followed already, the law is followed. Fewer: a bridge of
/// 40 voussoirs takes half as long again. More: values of bridges of several rings come out lower
/// (8.417 for 8.487 with 16).
const EASY: usize = 4;

/// Friction limits that change by more than this, in the loads that pass there, at so many ε one
/// after the other, the law itself having been tried or followed in vain, do not settle at smaller
/// ones. Less or fewer: states are lost (2 of 993 with one ε, none with two; one of 500 where one was
/// enough after that). More: minutes for states that stay open.
const HOPELESS: (f64, usize) = (0.1, 2);
/// With more rows than this one such ε is enough where it was followed in vain. Fewer: see there. More:
/// a quarter longer for each state of the Armadillo Vault that stays open.
const HOPELESS_AT_ONCE: usize = 1_000;

/// Most factorisations of a state that is followed as it comes about, and their rows in all: fewer of
/// large scenes, where each takes milliseconds. Fewer: what moves is not told, and walls of 400 blocks
/// that rest are not seen to. More: half a minute for each state that stays open.
const FACTORS: [usize; 2] = [3_000, 20_000];
const ROWS: usize = 6_600_000;
/// A motion is told once time grew by this since the state before. Less: what still slows down passes for
/// one. More: what goes on and on takes longer.
const STAYS_FOR: f64 = 3.0;

/// A fixed point is none of the law where it is further from it than so many times the one before
/// (and than [`tolerance::MOTION_BREACH`]): joints that crush may lead there.
const ASTRAY: f64 = 10.0;
/// After so many of them nothing is to be had.
const MOST_ASTRAY: usize = 3;

/// An acceleration counts when it is more than this × what unsettled friction can make. Less: noise
/// that falls passes for rest. More: time lost.
const NOISE: f64 = 10.0;

/// Most programs of a fixed point with more than [`HOPELESS_AT_ONCE`] rows, which has no twin either:
/// what it does not settle in so many is followed as it comes about. More: a fifth longer for the
/// Armadillo Vault.
const SOLVES_OF_LARGE: usize = 6;

/// When a fixed point has settled.
const STOP: StoppingCriterion = StoppingCriterion { change: 1e-5, solves: 25 };

/// Computes the state; of a symmetric scene from one part of it, and where that leaves it open from
/// the whole.
pub fn state(model: &Model, control: &Control) -> DryState {
    continued(model, control, (f64::INFINITY, usize::MAX))
}

/// The same with no more than about so much [`DryState::work`] before anything came out.
pub fn within(model: &Model, control: &Control, work: usize) -> DryState {
    continued(model, control, (f64::INFINITY, work))
}

/// The same, followed on where it rests down to this ε: contacts then yield as springs beside which
/// nothing else does.
pub fn refined(model: &Model, control: &Control, epsilon: f64) -> DryState {
    continued(model, control, (epsilon, usize::MAX))
}

/// The continuation in ε down to the `least`, with no more work than `most`.
fn continued(model: &Model, control: &Control, (least, most): (f64, usize)) -> DryState {
    let options =
        StaticsOptions { keep_all: control.keep_all, symmetry: true, ..StaticsOptions::default() };
    let contacts = Contacts::new(model, options);
    let is_part = contacts.statics.is_part();
    let part = of_part(model, contacts, control, (least, most));
    if part.motion != StateMotion::Undecided || !is_part {
        return part;
    }
    let whole = Contacts::new(model, StaticsOptions { symmetry: false, ..options });
    let mut answer = of_part(model, whole, control, (least, most.saturating_sub(part.work)));
    answer.steps.splice(0..0, part.steps);
    answer.work += part.work;
    answer.from_afar |= part.from_afar;
    answer
}

/// The state as it comes about, as long as that leads anywhere.
#[derive(Default)]
struct Following {
    /// The factorisations it took.
    factors: usize,
    /// Whether it led nowhere: at the next ε it is much the same.
    is_lost: bool,
    /// Whether the last state came from it.
    is_followed: bool,
}

impl Following {
    /// The state at this ε, or at one before at which it was seen to move, which is told.
    fn follow(
        &mut self,
        law: &mut Exact,
        (model, contacts): (&Model, &Contacts),
        history: &[StepOutcome],
        epsilon: &mut f64,
        (most, end): (usize, Deadline),
    ) -> Option<(Solved, f64)> {
        if self.is_lost {
            return None;
        }
        let moves = |at: f64, state: &(Solved, f64)| {
            let point = by_the_law(contacts, state.clone(), 0);
            let forces = contacts.statics.forces(&model.interfaces, &point.forces);
            decide(history, at, &point, &law::motion(model, &forces)) == StateMotion::Moves
        };
        let looked = history.last().map_or(0.0, |last| last.epsilon / STAYS_FOR);
        let asked = (*epsilon, looked);
        let allowed = (ROWS / contacts.statics.matrix.rows).clamp(FACTORS[0], FACTORS[1]);
        let (before, most) = (law.factors, most.min(allowed.saturating_sub(self.factors)));
        let (reached, solved) = law.flowed(contacts, asked, moves, most, end).unzip();
        self.factors += law.factors - before;
        self.is_followed = solved.is_some();
        self.is_lost = !self.is_followed;
        *epsilon = reached.unwrap_or(*epsilon);
        solved
    }
}

/// The same of a part or of the whole.
fn of_part(
    model: &Model,
    mut contacts: Contacts,
    control: &Control,
    (least, most): (f64, usize),
) -> DryState {
    let interfaces = &model.interfaces;
    let settings = Settings { tolerance: 1e-10, deadline: control.deadline, ..Settings::default() };
    let mut answer = DryState {
        motion: StateMotion::Undecided,
        steps: Vec::new(),
        forces: Vec::new(),
        from_afar: false,
        work: 0,
    };
    let still = vec![0.0; contacts.discs().count()];
    let once = StoppingCriterion { solves: 1, ..STOP };
    let mut exact = f64::INFINITY;
    let mut exactly: Option<Option<Exact>> = None;
    contacts.by_mass();
    let mut newton = Newton::new(&contacts);
    let mut history: Vec<StepOutcome> = Vec::new();
    let mut trail: Vec<(f64, Vec<f64>)> = Vec::new();
    let (mut hopeless, mut astray, mut following) = (0, 0, Following::default());
    let rows = contacts.statics.matrix.rows;
    let rest = vec![0.0; rows];
    // The associative state is the first guess of the friction limits.
    let solvers =
        Solvers { newton: newton.as_mut().map(|n| (n, &rest[..])), law: None, settings: &settings };
    let mut last = iterate(
        &contacts,
        Objective::State(EPSILONS[0]),
        HeldQuantity::SlidingRates,
        still,
        once,
        solvers,
    );
    let mut reached = f64::INFINITY;
    let work = |newton: &Option<Newton>, exact: &Option<Option<Exact>>| {
        let exact = exact.as_ref().and_then(Option::as_ref);
        rows * (newton.as_ref().map_or(0, |n| n.factors) + exact.map_or(0, |e| e.factors))
    };
    while let Some(mut epsilon) = EPSILONS.into_iter().find(|&epsilon| epsilon < reached) {
        let left = most.saturating_sub(work(&newton, &exactly)) / rows;
        let is_spent = left == 0 && answer.motion == StateMotion::Undecided;
        let Some(from) = last.take().filter(|_| !is_spent && !control.deadline.is_over()) else {
            break;
        };
        let end = (left, control.deadline);
        let start = Instant::now();
        let sections = contacts.statics.sections.clone();
        let tolerance =
            (TOLERANCE_PER_EPSILON * epsilon).clamp(settings.tolerance, COARSEST_TOLERANCE);
        let settings = Settings { tolerance, ..settings };
        let is_late = history.len() >= BEFORE_EXACT || exactly.is_some();
        if is_late && exactly.is_none() {
            exactly = Some(Exact::new(&contacts));
        }
        let mut exact_solver = exactly.as_mut().and_then(Option::as_mut).filter(|_| is_late);
        let was_followed = following.is_followed;
        let followed = exact_solver
            .as_mut()
            .filter(|_| was_followed || from.solves == 0 || from.solves > EASY)
            .and_then(|e| {
                let along = (!was_followed)
                    .then(|| e.on(&contacts, &mut trail, epsilon, control.deadline))
                    .flatten();
                along.or_else(|| {
                    following.follow(e, (model, &contacts), &history, &mut epsilon, end)
                })
            })
            .map(|solved| by_the_law(&contacts, solved, 0));
        // What came about in time is no start for what asks where it is all at once.
        if was_followed && followed.is_none() {
            break;
        }
        let is_followed = followed.is_some();
        let point = followed.or_else(|| {
            within_strength(&mut contacts, interfaces, |c| {
                settled(model, c, (epsilon, &from), newton.as_mut(), &settings)
            })
        });
        let Some(mut point) = point else { break };
        let mut forces = contacts.statics.forces(interfaces, &point.forces);
        let mut moved = law::motion(model, &forces);
        let rests = decide(&history, epsilon, &point, &moved) == StateMotion::Rests;
        let is_lost = !is_followed
            && (point.change > tolerance::COULOMB_SETTLED
                || moved.natural_map_in_loads > tolerance::MOTION_BREACH);
        if is_lost && exactly.is_none() {
            exactly = Some(Exact::new(&contacts));
        }
        if !is_followed
            && point.change > 0.0
            && !rests
            && (is_late || is_lost)
            && let Some(solver) = exactly.as_mut().and_then(Option::as_mut)
            && let Some(solved) =
                solver.near(&contacts, epsilon, &point.rates, control.deadline).or_else(|| {
                    let follow = || {
                        following.follow(solver, (model, &contacts), &history, &mut epsilon, end)
                    };
                    is_lost.then(follow).flatten()
                })
        {
            point = by_the_law(&contacts, solved, point.solves);
            forces = contacts.statics.forces(interfaces, &point.forces);
            moved = law::motion(model, &forces);
        }
        reached = epsilon;
        answer.from_afar |= following.is_followed || following.is_lost;
        let decided = match decide(&history, epsilon, &point, &moved) {
            // As it comes about, what slows down may go on again: it rests where nothing is left.
            StateMotion::Rests
                if following.is_followed && moved.acceleration > tolerance::LEAST_MOTION =>
            {
                StateMotion::Undecided
            }
            decided => decided,
        };
        answer.steps.push(StateStep {
            epsilon,
            acceleration: moved.acceleration,
            change: point.change,
            natural_map: moved.natural_map,
            natural_map_in_loads: moved.natural_map_in_loads,
            solves: point.solves,
            seconds: start.elapsed().as_secs_f64(),
        });
        // A fixed point that the law does not know leads nowhere: back to the one before.
        if let Some(before) = history.last()
            && answer.motion == StateMotion::Undecided
            && moved.natural_map_in_loads
                > tolerance::MOTION_BREACH.max(ASTRAY * before.natural_map_in_loads)
        {
            astray += 1;
            if astray == MOST_ASTRAY {
                break;
            }
            contacts.statics.sections = sections;
            last = Some(from);
            continue;
        }
        history.push(StepOutcome {
            epsilon,
            natural_map_in_loads: moved.natural_map_in_loads,
            accelerations: moved.accelerations,
            change: point.change,
            noise: point.noise,
        });
        trail.push((epsilon, point.rates.clone()));
        last = Some(point);
        match (answer.motion, decided) {
            // Rest once told is followed to its limit.
            (StateMotion::Rests, _) => answer.forces = forces,
            // A motion once told is followed while it obeys the law more and more exactly.
            (StateMotion::Moves, decided)
                if decided != StateMotion::Moves || moved.natural_map_in_loads >= exact =>
            {
                break;
            }
            (_, decided) => {
                (answer.motion, answer.forces, exact) =
                    (decided, forces, moved.natural_map_in_loads)
            }
        }
        let is_unsettled = history.last().is_some_and(|s| s.change > HOPELESS.0);
        let was_tried = history.len() > BEFORE_EXACT || following.is_lost;
        hopeless = if is_unsettled && was_tried { hopeless + 1 } else { 0 };
        let is_dear = following.is_lost && rows > HOPELESS_AT_ONCE;
        if hopeless == if is_dear { 1 } else { HOPELESS.1 }
            || (answer.motion == StateMotion::Rests && epsilon <= least)
            || (answer.motion == StateMotion::Moves
                && (exact <= tolerance::NATURAL_MAP || following.is_followed))
        {
            break;
        }
    }
    answer.work = work(&newton, &exactly);
    answer
}

/// What a solution of the law itself, with the imbalance it leaves, is as a fixed point.
fn by_the_law(contacts: &Contacts, (solved, left): (Solved, f64), solves: usize) -> FixedPoint {
    FixedPoint {
        forces: contacts.cut(&solved.forces),
        rates: solved.rates,
        lambda: 0.0,
        change: left,
        noise: left,
        solves,
    }
}

/// The fixed point on the limits; where it does not settle, the twin on the sliding rates has a
/// try. Of joints that hold tension it may settle where the law does not hold.
fn settled(
    model: &Model,
    contacts: &Contacts,
    (epsilon, from): (f64, &FixedPoint),
    mut newton: Option<&mut Newton>,
    settings: &Settings,
) -> Option<FixedPoint> {
    let objective = Objective::State(epsilon);
    let is_large = contacts.statics.matrix.rows > HOPELESS_AT_ONCE;
    let breach = |point: &FixedPoint| {
        let forces = contacts.statics.forces(&model.interfaces, &point.forces);
        law::motion(model, &forces).natural_map_in_loads
    };
    let solvers = Solvers {
        newton: newton.as_deref_mut().map(|n| (n, &from.rates[..])),
        law: None,
        settings,
    };
    let by_limits = iterate(
        contacts,
        objective,
        HeldQuantity::Limits,
        contacts.limits(&from.forces),
        StoppingCriterion { solves: if is_large { SOLVES_OF_LARGE } else { STOP.solves }, ..STOP },
        solvers,
    )?;
    if by_limits.change <= tolerance::COULOMB_SETTLED || is_large {
        return Some(by_limits);
    }
    let sliding = contacts.sliding(&contacts.joint_rates(&by_limits.rates));
    let solvers =
        Solvers { newton: newton.map(|n| (n, &by_limits.rates[..])), law: None, settings };
    let by_rates = iterate(contacts, objective, HeldQuantity::SlidingRates, sliding, STOP, solvers);
    match by_rates {
        Some(twin)
            if twin.change <= STOP.change
                && breach(&twin) <= tolerance::MOTION_BREACH.max(breach(&by_limits)) =>
        {
            Some(FixedPoint { solves: twin.solves + by_limits.solves, ..twin })
        }
        _ => Some(by_limits),
    }
}

/// What one ε left.
struct StepOutcome {
    epsilon: f64,
    /// How far it is from Coulomb's law.
    natural_map_in_loads: f64,
    /// Acceleration of each block, in multiples of gravity.
    accelerations: Vec<f64>,
    change: f64,
    noise: f64,
}

/// What the state tells beside those at the ε before it.
fn decide(
    history: &[StepOutcome],
    epsilon: f64,
    point: &FixedPoint,
    moved: &Released,
) -> StateMotion {
    let [.., before] = history else { return StateMotion::Undecided };
    if before.change.max(point.change) > tolerance::COULOMB_SETTLED {
        return StateMotion::Undecided;
    }
    let by = before.epsilon / epsilon;
    let [falls_to, stays_above] =
        [tolerance::ACCELERATION_FALLS, tolerance::ACCELERATION_STAYS].map(|a| a.powf(by.log10()));
    // An acceleration that grew as ε fell, or that unsettled friction may have made, is no measure
    // for the next one.
    let grew = |i: usize| matches!(history, [.., earlier, _] if before.accelerations[i] > 2.0 * earlier.accelerations[i]);
    let is_measure = |i: usize| before.accelerations[i] > NOISE * before.noise && !grew(i);
    let rest = (NOISE * point.noise).clamp(tolerance::EQUILIBRIUM_ERROR, tolerance::AT_REST);
    // What fell twice in a row is no chance of unsettled friction.
    let fell = |i: usize| {
        matches!(history, [.., earlier, _]
            if earlier.change <= tolerance::COULOMB_SETTLED
                && before.accelerations[i] < tolerance::ACCELERATION_FALLS * earlier.accelerations[i])
    };
    // Every block for itself: what sinks on soft joints must not hide what moves beside it.
    // What the compliance explains falls with ε; what is left of it may hide no motion.
    let falls = |(i, &a): (usize, &f64)| {
        let earlier = before.accelerations[i];
        a <= rest
            || ((is_measure(i) || fell(i))
                && a < falls_to * earlier
                && (by * a - earlier) / (by - 1.0) <= tolerance::LEAST_MOTION)
    };
    if moved.accelerations.iter().enumerate().all(falls) {
        return StateMotion::Rests;
    }
    let stays = |(i, &a): (usize, &f64)| {
        a == moved.acceleration && is_measure(i) && a > stays_above * before.accelerations[i]
    };
    if moved.is_motion() && moved.accelerations.iter().enumerate().any(stays) {
        StateMotion::Moves
    } else {
        StateMotion::Undecided
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use model::interface::prepare;
    use scene::read_str;

    /// A cube on a slope of 45° slides; asked with no work allowed it stays open, with as much as it
    /// took it comes out.
    #[test]
    fn what_takes_more_work_than_is_allowed_is_given_up() {
        let text = r#"{ "format": "voussoir-scene/1", "joints": { "default": { "friction": 0.5 } },
            "gravity": [6.9, 0, -6.9], "blocks": [
            { "id": "base", "support": true, "at": [0, 0, -0.5], "shape": { "box": { "size": [9, 9, 1] } } },
            { "id": "a", "at": [0, 0, 0.5], "shape": { "box": { "size": [2, 2, 1] } } } ] }"#;
        let model = prepare(&read_str("slope", text).unwrap().0).unwrap();
        let control = Control::default();
        let whole = state(&model, &control);
        assert_eq!(whole.motion, StateMotion::Moves);
        assert!(whole.work > 0);
        let none = within(&model, &control, 0);
        assert_eq!((none.motion, none.steps.len()), (StateMotion::Undecided, 0));
        assert_eq!(within(&model, &control, whole.work).motion, StateMotion::Moves);
    }
}
