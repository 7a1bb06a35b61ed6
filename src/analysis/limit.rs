//! How large may the live load grow? Program L, λ's bracket recomputed from the scene.
//!
//! Forces that balance up to a residual `r` bound λ from below by `λ − |r·q|`, a mechanism `q` with
//! inadmissibility `e` bounds it from above by `(−w·q + Σ e f_n) / ℓ·q`; both corrections are
//! first-order in the residuals. They steer the search; what is answered is proved: a mechanism
//! that closes no joint, and forces at the lower end near which others balance exactly (`prove`),
//! or the number that the proof rests on.

use super::{
    Proved,
    assess::{least_equilibrium_error, wedges},
    flats::beside_flats,
    ladder::{Control, Rung, is_large, run, steps},
    parts,
    proved::is_proved,
    repair,
    warm_start::Near,
};
use base::tolerance;
use check::{
    terms::{Attempt, Bracket, Deciding, Outcome},
    verdict::{
        Forces, Rate, Verdict, certificate, claim,
        exact::{
            existence,
            motion::{self, MotionProof},
        },
        mechanism::{self, Mechanism},
        no_forces,
    },
};
use model::{assembly::Wrench, interface::Model, strength::laws::unlimited};
use solve::{
    EngineSettings, Passed,
    deadline::Deadline,
    program::{self, LiveLoad, Statics, StaticsOptions, Unknowns},
};

/// The answer of [`limit`], with its evidence.
#[derive(Clone, Debug)]
pub struct LoadFactor {
    /// What became of it.
    pub outcome: Outcome,
    /// The load factor (of the forces), where there is one.
    pub value: Option<f64>,
    /// Its bracket; infinite ends where nothing is known.
    pub bracket: Bracket,
    /// The part that decides, where there are several.
    pub part: Option<Deciding>,
    /// Found: forces at the lower end of the bracket. Unbounded: forces that balance the live load
    /// alone. Otherwise the best there is.
    pub forces: Forces,
    /// Unbounded: forces at the load factor `standing`, under which the scene stands.
    pub base: Option<(f64, Forces)>,
    /// Found: the collapse mechanism. Impossible: rates that gain power whatever the multiple.
    pub rates: Vec<Rate>,
    /// The mechanism in words.
    pub mechanism: Option<Mechanism>,
    /// What was tried.
    pub attempts: Vec<Attempt>,
    /// What the scene did not need.
    pub left_out: Vec<String>,
    /// The answers of the parts, in their order and their own units; `None` where no live load
    /// acts.
    pub(super) parts: Vec<Option<LoadFactor>>,
}

impl LoadFactor {
    /// The load factor, where it was found.
    pub fn found(&self) -> Option<f64> {
        self.value.filter(|_| self.outcome == Outcome::Found)
    }
}

/// Best first; measured on the reference cases and on walls pushed in and out of their plane. Beside
/// each rung: for how many load factors it was the last that was tried, on the grid of
/// `study --extreme` (434), for random scenes pushed by their weight (445) and for 171 walls, and
/// which of them stay open without it.
const LADDER: [Rung; 8] = [
    // Grid 186, random 210, walls 167. Without it one column of mass ratio 1e9.
    Rung { unit: 16.0, tolerance: 1e-9, engine: EngineSettings::clarabel(1e-9), ..Rung::RATES },
    // Grid 216, random 235, walls 4. Without it 8 of the grid.
    Rung::FORCES,
    // Grid 19. Without it 2 columns of mass ratio 1e9.
    Rung { unit: 8.0, engine: EngineSettings::clarabel(1e-9), ..Rung::FORCES },
    // Grid 10. Without it 3, at a friction of 1e6 and mass ratios of 1e9 and 1e-6.
    Rung { local: false, engine: EngineSettings::clarabel(1e-7), ..Rung::FORCES },
    // None: what came so far is solved in forces only.
    Rung { local: false, ..Rung::RATES },
    // Grid 1. Without it that one, a column of mass ratio 1e9.
    Rung {
        tolerance: 1e-10,
        engine: EngineSettings::Clarabel { regularization: 1e-8, equilibrate: false },
        ..Rung::FORCES
    },
    // None: what came so far is solved in forces only.
    Rung { even: true, tolerance: 1e-12, engine: EngineSettings::clarabel(1e-9), ..Rung::RATES },
    // Grid 2. Without it one of them, a column of mass ratio 1e9.
    Rung { even: true, tolerance: 1e-12, engine: EngineSettings::clarabel(1e-9), ..Rung::FORCES },
];

/// Tried first where the program is large; the second is reached by load factors far below the
/// natural one, now that their size is known.
const LARGE: [Rung; 2] =
    [Rung { tolerance: 1e-7, ..Rung::INTERIOR }, Rung { tolerance: 1e-8, ..Rung::INTERIOR }];

/// First, after those for large programs, where all blocks touch in points, as spheres do: on
/// random packings of 5,000 (three to seven contacts a grain) three other rungs leave brackets of
/// 1e-3 to 1e-5 of the value, one after the other.
const POINTS: Rung = Rung { local: false, engine: EngineSettings::clarabel(1e-7), ..Rung::FORCES };

/// How many rungs are tried before asking whether the load factor is unbounded or impossible (it is
/// neither where both ends of the bracket are known): two by clarabel; one where the program is
/// large, for the same method again would say the same.
const BEFORE_DIAGNOSIS: usize = 2;
const BEFORE_DIAGNOSIS_LARGE: usize = 1;

/// The greatest multiple of the live load under which admissible contact forces exist, part by
/// part. The live load must not be zero.
pub fn limit(model: &Model, control: &Control) -> Proved<LoadFactor> {
    Proved::new(model, unproved(model, control))
}

/// The same without the check.
pub(super) fn unproved(model: &Model, control: &Control) -> LoadFactor {
    parts::limit::limit(model, control, &Near::default())
}

/// The same for one part.
pub(super) fn of_part(model: &Model, control: &Control) -> LoadFactor {
    of_part_near(model, control, &mut None)
}

/// The same, begun near what the program of other loads passed where blocks touch in points; this one's
/// point is left there. On walls, whose forces are far from determined by balance, it costs more than it
/// saves: 23 iterations in place of 19 on one of 14 × 14.
pub(super) fn of_part_near(
    model: &Model,
    control: &Control,
    near: &mut Option<Passed>,
) -> LoadFactor {
    let (Some(less), Some(wide)) = (model.without_flats(), model.every_way()) else {
        return with_normals(model, control, near);
    };
    let mut bare = with_normals(&less, control, &mut None);
    bare.forces = beside_flats(model, &bare.forces);
    bare.base = bare.base.map(|(at, forces)| (at, beside_flats(model, &forces)));
    if is_proved(model, &bare) {
        return bare;
    }
    let flat = with_normals(model, control, near);
    if is_proved(model, &flat) {
        return flat;
    }
    let every = with_normals(&wide, control, &mut None);
    let lower = match flat.outcome {
        Outcome::Impossible => f64::NEG_INFINITY,
        _ => flat.bracket.lower,
    };
    let both = LoadFactor {
        outcome: match every.outcome {
            Outcome::Impossible => Outcome::Impossible,
            _ => Outcome::Found,
        },
        bracket: Bracket { lower, upper: every.bracket.upper },
        rates: every.rates,
        mechanism: every.mechanism,
        ..flat
    };
    match is_proved(model, &both) {
        true => both,
        false => LoadFactor { outcome: Outcome::Undecided, mechanism: None, ..both },
    }
}

/// The same where every contact has one normal.
fn with_normals(model: &Model, control: &Control, near: &mut Option<Passed>) -> LoadFactor {
    let Model { assembly, interfaces, .. } = model;
    // The last of many directions may find the time already over: nothing is built for it.
    if control.deadline.is_over() {
        return unknown(model, Vec::new());
    }
    let options = StaticsOptions {
        keep_all: control.keep_all,
        live: true,
        symmetry: true,
        ..StaticsOptions::default()
    };
    let mut statics = Statics::new(model, options);
    let natural = claim::natural_factor(assembly);
    let mut answer = unknown(model, statics.left_out.clone());
    let mut scale = natural;
    let forces_only = statics.in_forces_only();
    let points = !interfaces.list.is_empty() && interfaces.list.iter().all(|f| f.points.len() == 1);
    let large = is_large(&statics);
    let first = LARGE.into_iter().filter(|_| large).chain(points.then_some(POINTS));
    let ladder: Vec<Rung> = first
        .chain(LADDER)
        .filter(|step| !(forces_only && step.unknowns == Unknowns::Rates))
        .collect();
    let before_diagnosis = if large { BEFORE_DIAGNOSIS_LARGE } else { BEFORE_DIAGNOSIS };
    let mut inside = None;
    for (index, (whole, step)) in steps(&ladder, statics.is_part()).enumerate() {
        if index == before_diagnosis
            && !answer.bracket.width().is_finite()
            && diagnose(model, control, &mut answer)
        {
            return answer;
        }
        if whole && statics.is_part() {
            statics = Statics::new(model, StaticsOptions { symmetry: false, ..options });
            answer.left_out.clone_from(&statics.left_out);
        }
        if control.deadline.is_over() {
            break;
        }
        let from = if index == 0 && points { near.take() } else { None };
        let way = (step, scale, control.deadline);
        let passed = climb(model, &mut statics, way, from, &mut answer);
        if index == 0 && points {
            *near = passed;
        }
        // Without a value the bracket is as wide as can be.
        let value = answer.value.map_or(0.0, f64::abs);
        if answer.bracket.is_narrow(claim::width(value, natural)) {
            let mut proved = answer.clone();
            if prove(model, control, &mut proved, natural, &mut inside) {
                answer = proved;
                answer.outcome = Outcome::Found;
                break;
            }
        }
        // Once its size is known, scale the live load so that the factor is near one.
        if value > 1e-6 * natural {
            scale = value;
        }
    }
    if answer.outcome == Outcome::Found {
        answer.mechanism = Some(mechanism::read(model, &answer.rates));
    } else if answer.bracket.width() < 0.0 {
        // Ends that cross enclose nothing: the first-order allowances did not hold.
        (answer.value, answer.bracket) = (None, Bracket::UNKNOWN);
    }
    answer
}

/// The share by which a load factor is lowered for forces that lie strictly inside their cones; the
/// first that is enough. Larger: a wider bracket than [`tolerance::LOAD_FACTOR_WIDTH`]. Smaller: no
/// room for what rounding leaves.
const INWARDS: [f64; 3] = [0.0, 1e-8, 2e-7];

/// Makes the evidence of a load factor as exact as it can be, and the bracket what it proves: a
/// mechanism that closes no joint, and forces at the lower end near which others balance exactly.
/// At the limit itself forces have no room; mixed with a little of those that hold the scene at
/// another load factor they have (`inside`, sought once). False where the forces leave too much
/// out of balance for a proof.
fn prove(
    model: &Model,
    control: &Control,
    answer: &mut LoadFactor,
    natural: f64,
    inside: &mut Option<(f64, Forces)>,
) -> bool {
    let Model { assembly, interfaces, .. } = model;
    let Some(value) = answer.value else { return false };
    let k = certificate::kinematics(model, &answer.rates, &answer.forces);
    let width = claim::width(value, natural);
    let mut moved = motion::motion(model, &answer.rates);
    let is_proof = |m: &MotionProof| m.is_admissible() && m.gain().lower.is_finite();
    if !moved.as_ref().is_some_and(is_proof)
        && let Some(mended) = repair::admissible(
            model,
            &answer.rates,
            (value, 0.1 * width * k.live_power),
            control.deadline,
        )
    {
        let other = motion::motion(model, &mended);
        if claim::upper_bound(other, || f64::INFINITY).is_finite() {
            (answer.rates, moved) = (mended, other);
        }
    }
    let upper = |forces: &Forces, rates: &[Rate]| {
        claim::upper_bound(moved, || certificate::kinematics(model, rates, forces).upper())
            + tolerance::LOAD_FACTOR_ELSEWHERE * width
    };
    answer.bracket.upper = upper(&answer.forces, &answer.rates);
    let start = value.min(answer.bracket.upper);
    let mut best: Option<(f64, f64, Forces)> = None;
    let mut proved = false;
    for share in INWARDS {
        let (mut lambda, mut forces) = (start, answer.forces.clone());
        if share > 0.0 {
            // Where no exact proof is tried, forces elsewhere are of no use.
            if assembly.free().count() > existence::MOST_BLOCKS {
                break;
            }
            let (other, held) = inside.get_or_insert_with(|| elsewhere(model, control));
            // Nor are those so far away that their share is more than the bracket may be wide.
            if held.is_empty() || *other > start || share * (start - *other) > width {
                break;
            }
            lambda = start - share * (start - *other);
            let mix = |(a, b): (&Wrench, &Wrench)| {
                let mut sum = *a * (1.0 - share);
                sum += *b * share;
                sum
            };
            forces = forces
                .iter()
                .zip(&*held)
                .map(|(a, b)| a.iter().zip(b).map(mix).collect())
                .collect();
        }
        repair::cut(interfaces, &mut forces);
        let forces = existence::improved(model, &forces, lambda).unwrap_or(forces);
        let left = certificate::statics(model, &forces, lambda).equilibrium_error;
        let exact = existence::exists(model, &forces, lambda);
        if exact || best.as_ref().is_none_or(|(least, ..)| left < *least) {
            best = Some((left, lambda, forces));
        }
        if exact {
            proved = true;
            break;
        }
    }
    if let Some((left, lambda, forces)) = best {
        proved |= left <= tolerance::LOOSE_BALANCE;
        (answer.bracket.lower, answer.forces) = (lambda, forces);
        answer.bracket.upper = upper(&answer.forces, &answer.rates);
    }
    answer.value =
        Some(value.clamp(answer.bracket.lower, answer.bracket.upper.max(answer.bracket.lower)));
    proved
}

/// An answer whose evidence was carried over from the same scene in another place, made as exact as
/// it can be there; `None` where its bracket is no longer narrow.
pub(super) fn carried(
    model: &Model,
    mut answer: LoadFactor,
    control: &Control,
) -> Option<LoadFactor> {
    if answer.outcome == Outcome::Found {
        let natural = claim::natural_factor(&model.assembly);
        let proved = prove(model, control, &mut answer, natural, &mut None);
        let value = answer.value.map_or(0.0, f64::abs);
        let width = claim::width(value, natural);
        if !proved || !answer.bracket.is_narrow(width) {
            return None;
        }
    }
    let moves = answer.mechanism.is_some();
    answer.mechanism = moves.then(|| mechanism::read(model, &answer.rates));
    Some(answer)
}

/// A load factor at which the scene stands with room, and forces that hold it there: without the
/// live load where it stands without; no forces where none are found.
fn elsewhere(model: &Model, control: &Control) -> (f64, Forces) {
    for live in [LiveLoad::Absent, LiveLoad::AnyMultiple] {
        let held = least_equilibrium_error(model, live, control);
        if held.verdict == Verdict::Stable {
            return (held.load_factor, held.forces);
        }
    }
    (0.0, Vec::new())
}

/// The answer before anything is known.
fn unknown(model: &Model, left_out: Vec<String>) -> LoadFactor {
    let Model { assembly, interfaces, .. } = model;
    LoadFactor {
        outcome: Outcome::Undecided,
        value: None,
        bracket: Bracket::UNKNOWN,
        part: None,
        forces: no_forces(interfaces),
        base: None,
        rates: vec![Rate::zero(); assembly.blocks.len()],
        mechanism: None,
        attempts: Vec::new(),
        left_out,
        parts: Vec::new(),
    }
}

/// One attempt at program L; tightens the bracket in `answer`. Bounds on crushing that it finds
/// stay in `base`. It begins near a point that the program of other loads passed, and returns its own.
fn climb(
    model: &Model,
    base: &mut Statics,
    (step, scale, deadline): (Rung, f64, Deadline),
    from: Option<Passed>,
    answer: &mut LoadFactor,
) -> Option<Passed> {
    let assembly = &model.assembly;
    let mut statics = step.scaled(base);
    let settings = step.settings(deadline);
    let build = |statics: &Statics| program::load_factor(statics, scale, step.unknowns);
    let mut done = run(model, &mut statics, build, &settings, from);
    let (mut lower, mut upper, mut engine_value) = (f64::NEG_INFINITY, f64::INFINITY, None);
    if let Some(c) = done.candidate.take() {
        let lambda = scale
            * if step.unknowns == Unknowns::Forces {
                c.solution.x[statics.matrix.columns]
            } else {
                -c.solution.z[0]
            };
        engine_value = Some(lambda);
        let k = certificate::kinematics(model, &c.rates, &c.forces);
        let s = certificate::statics(model, &c.forces, lambda);
        let hidden: f64 =
            assembly.free().map(|i| certificate::power(&s.residuals[i], &c.rates[i]).abs()).sum();
        if k.live_power > 0.0 {
            // Rates that are no mechanism bound nothing.
            let natural = claim::natural_factor(assembly);
            let allowed = tolerance::LOAD_FACTOR_BEHIND * lambda.abs()
                + tolerance::LOAD_FACTOR_WIDTH * natural;
            if k.behind(&c.forces) <= allowed {
                upper = k.upper();
            }
            if s.equilibrium_error <= tolerance::LOOSE_BALANCE && s.is_within_strength() {
                lower = lambda - hidden / k.live_power;
            }
        }
        if lower > answer.bracket.lower {
            (answer.bracket.lower, answer.value, answer.forces) = (lower, Some(lambda), c.forces);
        }
        if upper < answer.bracket.upper {
            (answer.bracket.upper, answer.rates) = (upper, c.rates);
        }
        pair(model, answer);
    }
    let name = format!(
        "load factor in {}",
        if step.unknowns == Unknowns::Forces { "forces" } else { "rates" }
    );
    let engine_value = engine_value.filter(|v| v.is_finite());
    answer.attempts.push(done.attempt(
        name,
        statics.unit / statics.total_load(),
        &step,
        engine_value,
        [lower, upper],
    ));
    base.sections = statics.sections;
    done.passed
}

/// The bracket of the best forces and the best mechanism together. Each end is corrected to first
/// order by the other side, and the best of the other side corrects best: a mechanism weighed by
/// the forces of a poor attempt may seem to fall below the limit.
fn pair(model: &Model, answer: &mut LoadFactor) {
    let assembly = &model.assembly;
    let Some(value) = answer.value.filter(|_| answer.bracket.width().is_finite()) else { return };
    let k = certificate::kinematics(model, &answer.rates, &answer.forces);
    let lower = |value: f64| {
        let s = certificate::statics(model, &answer.forces, value);
        let hidden: f64 = assembly
            .free()
            .map(|i| certificate::power(&s.residuals[i], &answer.rates[i]).abs())
            .sum();
        value - hidden / k.live_power
    };
    let mut bracket = Bracket { lower: lower(value), upper: k.upper() };
    // The engine's load factor may pass what the mechanism proves by a last digit; its forces are
    // then those of the end itself. Ends that cross are left as they are: they prove nothing.
    if bracket.lower <= bracket.upper && bracket.upper < value {
        bracket.lower = lower(bracket.upper);
        answer.value = Some(bracket.upper);
    }
    answer.bracket = bracket;
}

/// One attempt at program L with a way of one's own, for studies: nothing is tried again.
pub fn attempt(model: &Model, way: &Formulation) -> LoadFactor {
    let assembly = &model.assembly;
    let mut statics = Statics::new(model, StaticsOptions { live: true, ..way.options });
    let mut answer = unknown(model, statics.left_out.clone());
    let scale = if way.options.unscaled { 1.0 } else { claim::natural_factor(assembly) };
    let Formulation { unknowns, unit, local, tolerance, engine, .. } = *way;
    climb(
        model,
        &mut statics,
        (Rung { unknowns, unit, local, even: false, tolerance, engine }, scale, Deadline::NEVER),
        None,
        &mut answer,
    );
    let value = answer.value.map_or(0.0, f64::abs);
    if answer.bracket.is_narrow(claim::width(value, claim::natural_factor(assembly))) {
        answer.outcome = Outcome::Found;
    }
    answer
}

/// How one attempt goes about it.
#[derive(Clone, Copy, Debug)]
pub struct Formulation {
    /// What to leave out and how to scale.
    pub options: StaticsOptions,
    /// The unknowns.
    pub unknowns: Unknowns,
    /// Factor on the force unit.
    pub unit: f64,
    /// Whether small blocks get units of their own.
    pub local: bool,
    /// The engine's tolerance.
    pub tolerance: f64,
    /// What solves it.
    pub engine: EngineSettings,
}

impl Formulation {
    /// The first way of [`limit`] in the given unknowns.
    pub fn usual(unknowns: Unknowns) -> Self {
        let step = LADDER.into_iter().find(|step| step.unknowns == unknowns).unwrap_or(LADDER[0]);
        let Rung { unit, local, tolerance, engine, .. } = step;
        Self { options: StaticsOptions::default(), unknowns, unit, local, tolerance, engine }
    }
}

/// Joints with no more than this × the greatest force of all carry rounding, which does not balance
/// blocks that no live load acts on; the first that is enough. Larger: loads are left out of balance.
/// Smaller: rounding stays.
const ROUNDING: [f64; 3] = [1e-13, 1e-11, 1e-9];

/// Is there no load factor at all, or no limit to it? Returns true where that is the answer.
fn diagnose(model: &Model, control: &Control, answer: &mut LoadFactor) -> bool {
    let Model { assembly, interfaces, .. } = model;
    let any = least_equilibrium_error(model, LiveLoad::AnyMultiple, control);
    answer.attempts.extend(any.attempts.iter().cloned());
    if any.verdict == Verdict::Unstable {
        answer.outcome = Outcome::Impossible;
        answer.bracket = Bracket { lower: f64::NEG_INFINITY, upper: f64::NEG_INFINITY };
        (answer.forces, answer.rates) = (any.forces, repair::at_rest(model, &any.rates));
        answer.mechanism = Some(mechanism::read(model, &answer.rates));
        return true;
    }
    // The live load in the size of the dead load, so that the same threshold applies.
    let (alone, natural) = claim::live_alone(assembly);
    let (unlimited, kept) = unlimited(interfaces);
    let wedge = least_equilibrium_error(&Model::new(alone, unlimited), LiveLoad::Absent, control);
    answer.attempts.extend(wedge.attempts.iter().cloned());
    if wedge.verdict == Verdict::Stable && any.verdict == Verdict::Stable {
        answer.outcome = Outcome::Unbounded;
        answer.value = None;
        answer.bracket = Bracket { lower: f64::INFINITY, upper: f64::INFINITY };
        let mut forces = no_forces(interfaces);
        for (k, own) in kept.into_iter().zip(&wedge.forces) {
            forces[k] = own.iter().map(|&v| v * (1.0 / natural)).collect();
        }
        let proves = |forces: &Forces| wedges(model, (any.load_factor, &any.forces), forces);
        if !proves(&forces)
            && let Some(mended) =
                ROUNDING.iter().map(|share| repair::without(&forces, *share)).find(proves)
        {
            forces = mended;
        }
        (answer.forces, answer.base) = (forces, Some((any.load_factor, any.forces)));
        return true;
    }
    false
}
