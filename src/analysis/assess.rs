//! Does it stand under its dead load? Program V, its bracket recomputed from the scene; then, where
//! admissible forces exist and contacts form closed chains that could hold self-stress, the state
//! under dry friction (program C).

use super::{
    Bracket, Deciding, Proved,
    coulomb::{DryState, StateMotion, state},
    flats::beside_flats,
    forest::{Fate, Forest},
    ladder::{Control, Rung, is_large, run, steps},
    parts,
    proved::is_proved,
    repair,
};
use base::tolerance;
use check::{
    terms::{Attempt, Law},
    verdict::{
        Evidence, Forces, Rate, Verdict, certificate,
        claim::{self, Claim},
        exact::existence,
        law,
        mechanism::{self, Mechanism},
        no_forces,
    },
};
use model::interface::{Model, floating, is_forest};
use nalgebra::Vector3;
use solve::{
    EngineSettings, Settings,
    program::{self, LiveLoad, Statics, StaticsOptions, Unknowns},
};

/// The answer of [`assess`], with its evidence.
#[derive(Clone, Debug)]
pub struct Assessment {
    /// Does it stand?
    pub verdict: Verdict,
    /// Bracket of the least equilibrium error, in multiples of gravity.
    pub equilibrium_error: Bracket,
    /// The equilibrium error that separates stable from unstable: [`tolerance::EQUILIBRIUM_ERROR`], or the rounding
    /// of the scene's own coordinates where that is larger.
    pub threshold: f64,
    /// The part that decides, where there are several.
    pub part: Option<Deciding>,
    /// The forces that leave the upper end of the bracket.
    pub forces: Forces,
    /// The load factor of these forces: 0 except inside `limit`, where any multiple of the live
    /// load may help.
    pub(super) load_factor: f64,
    /// The rates that prove the lower end (all zero where it is zero).
    pub rates: Vec<Rate>,
    /// The mechanism, where it is unstable.
    pub mechanism: Option<Mechanism>,
    /// The state under dry friction, where it had to be computed.
    pub state: Option<DryState>,
    /// Free blocks without a contact path to a support, by groups.
    pub floating: Vec<Vec<usize>>,
    /// What was tried.
    pub attempts: Vec<Attempt>,
    /// What the scene did not need.
    pub left_out: Vec<String>,
}

/// Best first; measured on the reference cases. Beside each rung: for how many questions it was the
/// last that was tried, on the grid of `study --extreme` (2,381) and for random scenes (714 of
/// `trials soak 500`), and which of them stay open without it.
const LADDER: [Rung; 8] = [
    // Grid 2,281, random 610. Without it 3 walls of the grid.
    Rung::FORCES,
    // Grid 4, random 40. Without it none: later ones decide those.
    Rung::RATES,
    // Grid 58, random 5. Without it 2 walls of the grid.
    Rung { unit: 4.0, tolerance: 1e-12, engine: EngineSettings::clarabel(1e-9), ..Rung::FORCES },
    // Grid 4, random 3. Without it none.
    Rung { local: false, tolerance: 1e-12, engine: EngineSettings::clarabel(1e-7), ..Rung::FORCES },
    // Grid 0, random 5. Without it none.
    Rung {
        unit: 8.0,
        local: false,
        tolerance: 1e-12,
        engine: EngineSettings::clarabel(1e-9),
        ..Rung::RATES
    },
    // Grid 13, random 5. Without it 3, at a friction of 1e6 between unequal masses or sizes.
    Rung {
        tolerance: 1e-10,
        engine: EngineSettings::Clarabel { regularization: 1e-8, equilibrate: false },
        ..Rung::FORCES
    },
    // Grid 19, of which 10 stay open, random 3. Without it 7, of mass ratios 1e-6, 1e6 and 1e9.
    Rung { even: true, tolerance: 1e-12, engine: EngineSettings::clarabel(1e-9), ..Rung::FORCES },
    // Grid 2, random 43. Without it none.
    Rung { even: true, tolerance: 1e-12, engine: EngineSettings::clarabel(1e-9), ..Rung::RATES },
];

/// How exactly a least equilibrium error is sought that is far from zero. Larger: forces and mechanism leave
/// more between the ends of its bracket. Smaller: large packings that fall take twice as many
/// iterations.
const FALLS: f64 = 1e-6;

/// Tried first where the program is large.
const LARGE: [Rung; 1] = [Rung { tolerance: 1e-10, ..Rung::INTERIOR }];

/// Decides whether an assembly stands under its dead load, part by part.
pub fn assess(model: &Model, control: &Control) -> Proved<Assessment> {
    Proved::new(model, unproved(model, control))
}

/// The same without the check, for searches that keep few of their verdicts.
pub(super) fn unproved(model: &Model, control: &Control) -> Assessment {
    parts::assess::assess(model, control)
}

/// The same for one part.
pub(super) fn of_part(model: &Model, control: &Control) -> Assessment {
    let (Some(less), Some(wide)) = (model.without_flats(), model.every_way()) else {
        return with_normals(model, control);
    };
    let mut bare = with_normals(&less, control);
    bare.forces = beside_flats(model, &bare.forces);
    if let Some(state) = &mut bare.state {
        state.forces = beside_flats(model, &state.forces);
    }
    let settles = |a: &Assessment| match a.verdict {
        Verdict::Stable => true,
        Verdict::Unstable => is_proved(model, a),
        Verdict::Conditional | Verdict::Undecided => false,
    };
    if settles(&bare) {
        return bare;
    }
    let flat = with_normals(model, control);
    if flat.verdict != Verdict::Unstable || settles(&flat) {
        return flat;
    }
    let every = with_normals(&wide, &Control { law: Law::Associative, ..*control });
    let Assessment { rates, mechanism, equilibrium_error, .. } = every;
    match every.verdict {
        Verdict::Unstable => Assessment { rates, mechanism, equilibrium_error, ..flat },
        _ => Assessment {
            verdict: Verdict::Undecided,
            equilibrium_error: Bracket { lower: 0.0, ..flat.equilibrium_error },
            mechanism: None,
            ..flat
        },
    }
}

/// The same where every contact has one normal.
fn with_normals(model: &Model, control: &Control) -> Assessment {
    if let Some(answer) = falls_freely(model) {
        return answer;
    }
    if let Some(answer) = by_statics(model, control.law) {
        return answer;
    }
    let mut answer = least_equilibrium_error(model, LiveLoad::Absent, control);
    answer.floating = floating(model);
    if answer.verdict == Verdict::Stable && control.law == Law::Coulomb {
        settle(model, control, &mut answer);
    }
    answer
}

/// Whether forces prove that it stands.
fn holds(model: &Model, forces: &Forces) -> bool {
    claim::verify(model, &Claim::Stable, Evidence::new(forces, &[])).proved()
}

/// Whether forces of the live load alone prove that it may grow without limit, beside those that
/// hold the scene at some load factor.
pub(super) fn wedges(model: &Model, (standing, base): (f64, &Forces), forces: &Forces) -> bool {
    let evidence = Evidence { forces, base: Some(base), rates: &[] };
    claim::verify(model, &Claim::Unbounded { standing }, evidence).proved()
}

/// An answer that says nothing yet but these forces and the ends of the least equilibrium error.
pub(super) fn from_forces(model: &Model, forces: Forces, [lower, upper]: [f64; 2]) -> Assessment {
    Assessment {
        verdict: Verdict::Undecided,
        equilibrium_error: Bracket { lower, upper },
        threshold: tolerance::EQUILIBRIUM_ERROR,
        part: None,
        forces,
        load_factor: 0.0,
        rates: vec![Rate::zero(); model.assembly.blocks.len()],
        mechanism: None,
        state: None,
        floating: Vec::new(),
        attempts: Vec::new(),
        left_out: Vec::new(),
    }
}

/// Where contacts form no closed chain, and each can carry what it has to, statics alone has the
/// forces. What falls is left to the program, whose mechanism is the one of the least equilibrium error.
fn by_statics(model: &Model, law: Law) -> Option<Assessment> {
    let forest = Forest::of(model)?;
    let forces = (forest.fate() == Fate::Stands).then(|| forest.forces())??;
    let balance = certificate::statics(model, &forces, 0.0);
    (balance.balanced && holds(model, &forces)).then(|| Assessment {
        verdict: Verdict::Stable,
        left_out: match law {
            Law::Associative => vec![format!("the program: {STATICS_ALONE}")],
            Law::Coulomb => vec![format!("{NO_STATE_NEEDED}, and any program: {STATICS_ALONE}")],
        },
        ..from_forces(model, forces.clone(), [0.0, balance.equilibrium_error])
    })
}

/// Why a scene without closed chains needs no program.
const STATICS_ALONE: &str =
    "contacts form no closed chain, so statics alone determines the force in each";

/// How the line begins that says that program C was left out.
pub(super) const NO_STATE_NEEDED: &str = "the state under dry friction";

/// What the state under dry friction does not know about members.
const MEMBERS_YIELD: &str = "the stiffness of members relative to the joints: under dry friction a member is as stiff as an average joint, and members with a given stiffness keep their ratios";

/// Admissible forces exist: are they such as the loads produce?
fn settle(model: &Model, control: &Control, answer: &mut Assessment) {
    if is_forest(model) {
        answer.left_out.push(format!("{NO_STATE_NEEDED}: {STATICS_ALONE}"));
        return;
    }
    if !model.interfaces.members.is_empty() {
        answer.left_out.push(MEMBERS_YIELD.into());
    }
    let state = state(model, control);
    answer.verdict = match state.motion {
        StateMotion::Rests => Verdict::Stable,
        StateMotion::Moves => Verdict::Conditional,
        StateMotion::Undecided => Verdict::Undecided,
    };
    if state.motion == StateMotion::Moves {
        answer.rates = law::motion(model, &state.forces).rates;
        answer.mechanism = Some(mechanism::read(model, &answer.rates));
    }
    answer.state = Some(state);
}

/// Blocks that touch nothing that is held fall with 1 g: no program is needed to see it.
pub(super) fn falls_freely(model: &Model) -> Option<Assessment> {
    let Model { assembly, interfaces, .. } = model;
    let floating = floating(model);
    let mut rates = vec![Rate::zero(); assembly.blocks.len()];
    for group in &floating {
        let force: Vector3<f64> = group.iter().map(|&i| assembly.dead[i].force).sum();
        let weight: f64 = group.iter().map(|&i| certificate::load_scale(assembly, i)).sum();
        if force.norm() > tolerance::FALLS_FREELY * weight {
            group.iter().for_each(|&i| rates[i].velocity = force.normalize());
        }
    }
    let forces = no_forces(interfaces);
    let kinematics = certificate::kinematics(model, &rates, &forces);
    if kinematics.norm == 0.0 {
        return None;
    }
    let statics = certificate::statics(model, &forces, 0.0);
    let count: usize = floating.iter().map(Vec::len).sum();
    Some(Assessment {
        verdict: Verdict::Unstable,
        equilibrium_error: Bracket {
            lower: kinematics.dead_power / kinematics.norm,
            upper: statics.equilibrium_error,
        },
        threshold: tolerance::EQUILIBRIUM_ERROR,
        part: None,
        mechanism: Some(mechanism::read(model, &rates)),
        forces,
        load_factor: 0.0,
        rates,
        state: None,
        floating,
        attempts: Vec::new(),
        left_out: vec![format!(
            "the whole program: {count} free blocks have no contact path to a support"
        )],
    })
}

/// Program V down the ladder until its bracket decides.
pub(super) fn least_equilibrium_error(
    model: &Model,
    live: LiveLoad,
    control: &Control,
) -> Assessment {
    let Model { assembly, interfaces, .. } = model;
    let options = StaticsOptions {
        keep_all: control.keep_all,
        live: live != LiveLoad::Absent,
        symmetry: true,
        ..StaticsOptions::default()
    };
    let mut base = Statics::new(model, options);
    let zero = no_forces(interfaces);
    let unloaded = certificate::statics(model, &zero, 0.0);
    let mut answer = Assessment {
        left_out: base.left_out.clone(),
        ..from_forces(model, zero, [0.0, unloaded.equilibrium_error])
    };
    let mut balanced = unloaded.balanced;
    // Bounds on crushing that one rung found hold for all.
    let mut sections = base.sections.clone();
    let large = if is_large(&base) { &LARGE[..] } else { &[] };
    // With a free load factor only the force form yields its value; with strengths there is no
    // other.
    let forces_only = live == LiveLoad::AnyMultiple || base.in_forces_only();
    let ladder: Vec<Rung> = large
        .iter()
        .copied()
        .chain(LADDER)
        .filter(|step| !(forces_only && step.unknowns == Unknowns::Rates))
        .collect();
    for (whole, step) in steps(&ladder, base.is_part()) {
        if control.deadline.is_over() {
            break;
        }
        if whole && base.is_part() {
            base = Statics::new(model, StaticsOptions { symmetry: false, ..options });
            answer.left_out.clone_from(&base.left_out);
        }
        let mut statics = step.scaled(&base);
        statics.sections = std::mem::take(&mut sections);
        let settings = Settings { where_positive: FALLS, ..step.settings(control.deadline) };
        let build = |statics: &Statics| program::equilibrium_error(statics, live, step.unknowns);
        let mut done = run(model, &mut statics, build, &settings, None);
        let (mut lower, mut upper) = (0.0, f64::INFINITY);
        if let Some(mut c) = done.candidate.take() {
            repair::cut(interfaces, &mut c.forces);
            let lambda = if live == LiveLoad::AnyMultiple {
                c.solution.x.last().copied().unwrap_or(0.0)
            } else {
                0.0
            };
            let mut s = certificate::statics(model, &c.forces, lambda);
            // The mechanism is weighed by the forces that came with it: others hide what its joints
            // close by.
            let k = certificate::kinematics(model, &c.rates, &c.forces);
            // What the engine's last digits leave may be no more than that.
            if !s.balanced
                && let Some(mut better) = existence::improved(model, &c.forces, lambda)
            {
                repair::cut(interfaces, &mut better);
                let left = certificate::statics(model, &better, lambda);
                if left.equilibrium_error < s.equilibrium_error {
                    (s, c.forces) = (left, better);
                }
            }
            if !s.balanced {
                s.balanced = existence::exists(model, &c.forces, lambda);
            }
            upper = if s.is_within_strength() { s.equilibrium_error } else { f64::INFINITY };
            let mut k = k;
            if !k.is_admissible(assembly)
                && live == LiveLoad::Absent
                && !s.balanced
                && let Some(mended) =
                    repair::admissible(model, &c.rates, (0.0, 0.5 * k.gain()), control.deadline)
            {
                k = certificate::kinematics(model, &mended, &c.forces);
                c.rates = mended;
            }
            if k.is_admissible(assembly) {
                lower = ((k.gain() - k.slack - (lambda * k.live_power).abs()) / k.norm).max(0.0);
            }
            if upper < answer.equilibrium_error.upper {
                (answer.equilibrium_error.upper, answer.forces, answer.load_factor) =
                    (upper, c.forces, lambda);
                balanced = s.balanced;
            }
            if lower > answer.equilibrium_error.lower {
                (answer.equilibrium_error.lower, answer.rates) = (lower, c.rates);
            }
        }
        let name = format!(
            "least equilibrium error in {}",
            if step.unknowns == Unknowns::Forces { "forces" } else { "rates" }
        );
        answer.attempts.push(done.attempt(
            name,
            statics.unit / statics.total_load(),
            &step,
            None,
            [lower, upper],
        ));
        sections = statics.sections;
        let b = answer.equilibrium_error;
        // Re-added without rounding, or the next attempt.
        answer.verdict = if balanced && (live != LiveLoad::Absent || holds(model, &answer.forces)) {
            Verdict::Stable
        } else if b.lower > tolerance::EQUILIBRIUM_ERROR {
            Verdict::Unstable
        } else {
            Verdict::Undecided
        };
        if answer.verdict != Verdict::Undecided {
            break;
        }
    }
    if answer.verdict == Verdict::Unstable {
        // Half of the power is left to prove it with.
        let power = certificate::kinematics(model, &answer.rates, &no_forces(interfaces));
        let most = 0.5 * (power.gain() - tolerance::EQUILIBRIUM_ERROR * power.norm);
        let with_live = live == LiveLoad::AnyMultiple;
        if let Some(mended) =
            repair::admissible(model, &answer.rates, (0.0, most), control.deadline)
                .filter(|_| !with_live)
        {
            let k = certificate::kinematics(model, &mended, &no_forces(interfaces));
            (answer.equilibrium_error.lower, answer.rates) = (k.gain() / k.norm, mended);
        }
        answer.mechanism = Some(mechanism::read(model, &answer.rates));
    }
    answer
}
