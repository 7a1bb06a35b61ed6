//! Program D: the load factor with dry friction.
//!
//! Where the associative mechanism slides nowhere, it and its forces obey Coulomb's law as they
//! stand, and the associative load factor is the answer. Otherwise the fixed point on the friction
//! limits is followed as δ falls. What is found are forces that balance at λ and a mechanism that
//! obeys Coulomb's law with them: *a* complementary solution. Load factors without dilatancy are
//! not unique (Ferris & Tin-Loi 2001; Gilbert, Casapulla & Ahmed 2006); the associative value
//! bounds them all from above. A run that does not settle is undecided and gives no number.
//!
//! Forces and a mechanism at λ say that the scene moves there, not that it comes to rest below:
//! that is asked of the state ([`rest`](super::rest)).

use super::{
    answer::DryLoadFactor, crushing::within_strength, distance::Distance, rest::up_to_rest,
    state::state,
};
use crate::{Control, LoadFactor, Outcome, ladder::is_large, repair};
use base::tolerance;
use check::{
    terms::{Found, StateMotion},
    verdict::{Forces, Rate, Verdict, certificate, claim},
};
use model::{
    assembly::Wrench,
    interface::{Model, is_forest},
    strength::laws::unlimited,
};
use solve::{
    EngineSettings, Settings,
    coulomb::{CoulombLaw, FixedPoint, Solvers, StoppingCriterion, iterate},
    program::{
        StaticsOptions,
        coulomb::{Contacts, HeldQuantity, Objective},
    },
};

/// δ, and the change of the friction limits (mean block loads) at which the next one is taken up.
/// The error of the law falls with δ, the engine's noise in the forces grows with its tolerance /
/// δ: the last stage, for what is not exact enough by then, has a larger δ than the one before and
/// the engine's finest tolerance.
const STAGES: [(f64, StoppingCriterion); 4] = [
    (1e-4, StoppingCriterion { change: 3e-2, solves: 20 }),
    (1e-5, StoppingCriterion { change: 3e-3, solves: 20 }),
    (6e-8, StoppingCriterion { change: 3e-5, solves: 20 }),
    (5e-7, StoppingCriterion { change: 1e-7, solves: 10 }),
];
/// What δ is multiplied by for fixed points of Coulomb's law that are not exact enough for it.
/// Smaller: rounding.
const FURTHER: [f64; 3] = [0.1, 1e-2, 1e-3];
/// Stages after which a value is looked for.
const LEAST_STAGES: usize = 3;
/// A stage that ends with a change of this × the wanted one is lost. Larger: minutes on walls of
/// 1,000 blocks that stay undecided. Smaller: values that the next stages would still find.
const LOST: f64 = 10.0;
/// The engine's tolerance before and after.
const TOLERANCES: [f64; 2] = [1e-11, 1e-13];

/// The load factor with dry friction of one part, up to which it comes to rest; `associative` is
/// the answer of [`limit`](crate::limit()) for the same part, `dead` the verdict under
/// the dead load alone, where it is known.
pub(crate) fn of_part(
    model: &Model,
    associative: &LoadFactor,
    dead: Option<Verdict>,
    control: &Control,
) -> DryLoadFactor {
    // What falls by itself has none to look for, but one below zero where nothing could be wedged.
    let is_below_zero = associative.found().is_some_and(|bound| bound <= 0.0);
    let answer = || match dead {
        Some(Verdict::Unstable) if !(is_below_zero && is_forest(model)) => {
            DryLoadFactor::unanswered(associative)
        }
        _ => complementary(model, associative, control),
    };
    up_to_rest(
        answer,
        &model.assembly,
        associative,
        dead,
        &|lambda| model.at_load_factor(lambda),
        control,
    )
}

/// Forces and a mechanism that obey Coulomb's law together at a load factor; nothing is said about
/// what happens below.
pub(crate) fn complementary(
    model: &Model,
    associative: &LoadFactor,
    control: &Control,
) -> DryLoadFactor {
    let mut answer = DryLoadFactor::unanswered(associative);
    if associative.outcome == Outcome::Impossible || control.deadline.is_over() {
        return answer;
    }
    if associative.outcome == Outcome::Found {
        let distance = Distance::of(model, &associative.forces, &associative.rates);
        distance.told(&mut answer);
        if distance.is_obeyed() {
            (answer.found, answer.value) = (Found::NothingSlides, associative.value);
            return answer;
        }
    }
    if associative.outcome == Outcome::Unbounded && part_rests_alone(model, control) {
        answer.found = Found::Unlimited;
        return answer;
    }
    let options = StaticsOptions {
        keep_all: control.keep_all,
        live: true,
        symmetry: true,
        ..StaticsOptions::default()
    };
    let contacts = Contacts::new(model, options);
    let is_part = contacts.statics.is_part();
    let scene = Scene { model, associative };
    lowered(&scene, contacts, control, &mut answer);
    if answer.found == Found::Undecided && is_part {
        let whole = Contacts::new(model, StaticsOptions { symmetry: false, ..options });
        lowered(&scene, whole, control, &mut answer);
    }
    answer
}

/// What a value is asked of.
struct Scene<'a> {
    model: &'a Model,
    associative: &'a LoadFactor,
}

/// Lowers δ until the law is obeyed.
fn lowered(scene: &Scene, mut contacts: Contacts, control: &Control, answer: &mut DryLoadFactor) {
    let Model { assembly, interfaces, .. } = scene.model;
    let scale = claim::natural_factor(assembly);
    let still = vec![0.0; contacts.discs().count()];
    let first = StoppingCriterion { change: 0.0, solves: 1 };
    let begun = engines(&contacts).iter().find_map(|engine| {
        let settings = Settings {
            deadline: control.deadline,
            tolerance: TOLERANCES[0],
            engine: *engine,
            ..Settings::default()
        };
        let objective = Objective::LoadFactor(STAGES[0].0, scale);
        let (quantity, solvers) = (HeldQuantity::SlidingRates, engine_alone(&settings));
        let from = iterate(&contacts, objective, quantity, still.clone(), first, solvers)?;
        Some((from, settings))
    });
    let Some((mut from, settings)) = begun else { return };
    answer.solves += from.solves;
    let mut law = CoulombLaw::new(&contacts, scale);
    for (stage, (delta, stop)) in STAGES.into_iter().enumerate() {
        if control.deadline.is_over() {
            break;
        }
        control.doing(|| {
            format!("the value with dry friction, step {} of {}", stage + 1, STAGES.len())
        });
        let settings =
            Settings { tolerance: TOLERANCES[usize::from(stage >= LEAST_STAGES)], ..settings };
        let point = within_strength(&mut contacts, interfaces, |c| {
            let solvers = Solvers { law: law.as_mut(), ..engine_alone(&settings) };
            iterate(
                c,
                Objective::LoadFactor(delta, scale),
                HeldQuantity::Limits,
                c.limits(&from.forces),
                stop,
                solvers,
            )
        });
        let Some(point) = point else { break };
        answer.solves += point.solves;
        if stage + 1 >= LEAST_STAGES && accept(scene, &contacts, &point, answer) {
            break;
        }
        let settled = point.change == 0.0 && stage + 1 >= LEAST_STAGES;
        if let Some(law) = law.as_mut().filter(|_| settled) {
            let further = |by: &f64| {
                law.on(&contacts, by * delta, control.deadline)
                    .map(|p| FixedPoint { lambda: scale * p.lambda, ..p })
            };
            if FURTHER.iter().map_while(further).any(|p| accept(scene, &contacts, &p, answer)) {
                break;
            }
        }
        // What wanders at a large δ does not settle at a smaller one; at the smallest it may be the
        // engine's noise.
        let lost = point.change > LOST * stop.change;
        if lost && stage + 1 < LEAST_STAGES {
            break;
        }
        if !lost {
            from = point;
        }
    }
}

/// What solves the programs where Coulomb's law itself does not, the first one that gives any numbers:
/// of large scenes in space the engine on the stiffness matrix, which takes a third of the time (the
/// Armadillo Vault), but knows no joints that crush or take any tension (checked), and no live load on a few blocks.
fn engines(contacts: &Contacts) -> &'static [EngineSettings] {
    const ALL: [EngineSettings; 2] = [EngineSettings::Interior, EngineSettings::clarabel(1e-9)];
    let statics = &contacts.statics;
    let in_space = statics.free.iter().any(|free| free.rows.len() > 3);
    let is_simple =
        statics.sections.is_empty() && contacts.points.iter().all(|p| p.tension.is_finite());
    if is_large(statics) && in_space && is_simple { &ALL } else { &ALL[1..] }
}

/// The engine alone.
fn engine_alone(settings: &Settings) -> Solvers<'_> {
    Solvers { newton: None, law: None, settings }
}

/// Takes a fixed point as the answer if it is more exact than the one before; says whether it is a
/// value.
fn accept(
    scene: &Scene,
    contacts: &Contacts,
    point: &FixedPoint,
    answer: &mut DryLoadFactor,
) -> bool {
    let model = scene.model;
    let mut forces = contacts.statics.forces(&model.interfaces, &point.forces);
    // Beside tensile strengths the engine's last digits are more than the share allowed of a force.
    if certificate::statics(model, &forces, point.lambda).cone_excess > tolerance::CONE {
        repair::cut(&model.interfaces, &mut forces);
    }
    let rates: Vec<Rate> = contacts
        .statics
        .rates(model.assembly.blocks.len(), &point.rates)
        .into_iter()
        .map(|(velocity, spin)| Rate { velocity, spin })
        .collect();
    let distance = Distance::of(model, &forces, &rates);
    // The forces as they are, cut to their limits, balance best at this load factor.
    let lambda =
        contacts.best_factor(point.lambda, &contacts.residual(&point.forces, point.lambda));
    let lambda = lower_end(scene, &forces, &rates, lambda);
    let s = certificate::statics(model, &forces, lambda);
    let found = distance.is_obeyed()
        && s.is_within_strength()
        && s.equilibrium_error <= tolerance::DRY_BALANCE
        && hidden(model, &s.residuals, &rates) <= claim::dry_width(&model.assembly, lambda);
    if found {
        (answer.found, answer.value) = (Found::FixedPoint, Some(lambda));
    }
    (answer.forces, answer.rates) = (forces, rates);
    distance.told(answer);
    found
}

/// The load factor that these forces prove: what they leave off balance at `lambda` may be worth
/// some of it, as the mechanism tells, and as that of the associative bound does, which no value
/// passes.
fn lower_end(
    Scene { model, associative }: &Scene,
    forces: &Forces,
    rates: &[Rate],
    lambda: f64,
) -> f64 {
    let s = certificate::statics(model, forces, lambda);
    let hidden = |rates: &[Rate]| hidden(model, &s.residuals, rates);
    match associative.found() {
        Some(bound) => (lambda - hidden(rates).max(hidden(&associative.rates))).min(bound),
        None => lambda - hidden(rates),
    }
}

/// What forces leave off balance, as a load factor: its power on a mechanism beside that of the
/// live load.
fn hidden(model: &Model, residuals: &[Wrench], rates: &[Rate]) -> f64 {
    let assembly = &model.assembly;
    let power = |wrenches: &[Wrench], i: usize| certificate::power(&wrenches[i], &rates[i]);
    let driven: f64 = assembly.free().map(|i| power(&assembly.live, i)).sum();
    let hidden: f64 = assembly.free().map(|i| power(residuals, i).abs()).sum();
    if driven > 0.0 { hidden / driven } else { 0.0 }
}

/// Whether the live load alone, on joints without any strength, produces the forces that balance
/// it.
pub(crate) fn part_rests_alone(model: &Model, control: &Control) -> bool {
    let Model { assembly, interfaces, .. } = model;
    let (alone, _) = claim::live_alone(assembly);
    let alone = Model::new(alone, unlimited(interfaces).0);
    is_forest(&alone) || state(&alone, control).motion == StateMotion::Rests
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::limit;
    use model::interface::prepare;
    use nalgebra::Vector3;
    use scene::read_str;
    use serde_json::json;

    /// A live load on one block of a large wall concerns few equations, which the engine on the
    /// stiffness matrix does not take; programs are solved all the same.
    #[test]
    fn a_load_on_one_block_of_a_large_wall_is_looked_for() {
        let scene = json!({
            "format": "voussoir-scene/1",
            "joints": { "default": { "friction": 0.3 } },
            "templates": [{ "wall": { "size": [1, 0.5, 0.4], "courses": 12, "blocks": 12 } }],
        });
        let (scene, _) = read_str("wall", scene.to_string()).unwrap();
        let mut model = prepare(&scene).unwrap();
        let control = Control::default();
        for local in [false, true] {
            let assembly = &mut model.assembly;
            let some: Vec<usize> =
                assembly.free().take(if local { 1 } else { usize::MAX }).collect();
            assembly.live.iter_mut().for_each(|wrench| *wrench = Wrench::zero());
            some.into_iter().for_each(|i| assembly.live[i].force = Vector3::new(1e4, 2e3, 0.0));
            let contacts =
                Contacts::new(&model, StaticsOptions { live: true, ..Default::default() });
            assert_eq!(engines(&contacts).len(), 2);
            let associative = limit(&model, &control);
            let answer = complementary(&model, &associative, &control);
            assert!(
                answer.solves > 0,
                "{local} {:?} {:?} {:?}",
                associative.outcome,
                associative.value,
                answer.found
            );
        }
    }
}
