//! The fixed point of one program: friction held, solved, held anew.

use super::{anderson::Anderson, law::CoulombLaw, newton::Newton, point::FixedPoint};
use crate::{
    Session, Settings, Solution,
    program::{
        ConicProgram,
        coulomb::{Contacts, HeldQuantity, Objective},
    },
};

/// When to stop.
#[derive(Clone, Copy, Debug)]
pub struct StoppingCriterion {
    /// Change of what is held, in the load that presumably passes there: a measure relative to the
    /// current value would let blocks that are squeezed by ever smaller forces hang, one that is
    /// the same everywhere overlooks light blocks among heavy ones.
    pub change: f64,
    /// Most convex programs.
    pub solves: usize,
}

/// What solves the programs of one fixed point.
pub struct Solvers<'a> {
    /// Newton's method, where the program can be written in the rates, and the rates it starts
    /// from.
    pub newton: Option<(&'a mut Newton, &'a [f64])>,
    /// Coulomb's law itself, for load factors.
    pub law: Option<&'a mut CoulombLaw>,
    /// Settings of the engine, which solves what Newton's method does not.
    pub settings: &'a Settings,
}

/// Iterates from the limits or sliding rates `start`. `None` where the engine refuses the program
/// or leaves no numbers.
pub fn iterate(
    contacts: &Contacts,
    objective: Objective,
    quantity: HeldQuantity,
    start: Vec<f64>,
    stop: StoppingCriterion,
    solvers: Solvers,
) -> Option<FixedPoint> {
    let Solvers { mut newton, mut law, settings } = solvers;
    let end = settings.deadline;
    let mut rates = newton.as_ref().map_or_else(Vec::new, |(_, rates)| rates.to_vec());
    let mut held = start;
    let mut engine: Option<Engine> = None;
    let mut anderson = Anderson::default();
    let mut best: Option<FixedPoint> = None;
    if let (Some(law), Objective::LoadFactor(delta, scale)) = (&mut law, objective)
        && let Some(point) = law.on(contacts, delta, end)
    {
        return Some(FixedPoint { lambda: scale * point.lambda, ..point });
    }
    for k in 1..=stop.solves {
        let solved = match (&mut newton, objective) {
            (Some((newton, _)), Objective::State(epsilon)) => {
                newton.solve(contacts, (epsilon, quantity, &held), &rates, end)
            }
            _ => None,
        };
        let (forces, lambda);
        if let Some(solved) = solved {
            rates = solved.rates;
            (forces, lambda) = (solved.forces, 0.0);
        } else {
            // Once is enough to know that Newton's method does not get there.
            newton = None;
            let solution = match &mut engine {
                Some(engine) => engine.again(contacts, quantity, &held),
                None => engine
                    .insert(Engine::new(contacts, (objective, quantity, &held), settings)?)
                    .session
                    .solve()
                    .into(),
            };
            let Some(solution) = solution.filter(Solution::is_finite) else { break };
            (forces, rates, lambda) = read(contacts, objective, &solution);
        }
        if let (Some(law), Objective::LoadFactor(delta, scale)) = (&mut law, objective)
            && let Some(point) = law.near(contacts, delta, &rates, lambda / scale, end)
        {
            return Some(FixedPoint { lambda: scale * point.lambda, solves: k, ..point });
        }
        // Under these limits there is no load factor: those that came before wander.
        if best.is_some()
            && contacts.residual(&forces, lambda).iter().any(|r| r.abs() > UNBALANCED)
            && matches!(objective, Objective::LoadFactor(..))
        {
            break;
        }
        let next = match quantity {
            HeldQuantity::Limits => contacts.limits(&forces),
            HeldQuantity::SlidingRates => {
                contacts.sliding(&joint_rates(contacts, objective, &forces, &rates))
            }
        };
        let local = |x: &[f64]| -> Vec<f64> {
            x.iter().zip(&contacts.passing).map(|(x, p)| x / p).collect()
        };
        let (now, then) = (local(&held), local(&next));
        let change = now.iter().zip(&then).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        if !then.iter().all(|x| x.is_finite()) {
            break;
        }
        // The last iterate is kept unless an earlier one was much better: near the end the change
        // is the engine's noise.
        if best.as_ref().is_none_or(|b| change < 10.0 * b.change) {
            let noise = if quantity == HeldQuantity::Limits {
                contacts.unsettled(&forces, &held, &next)
            } else {
                change
            };
            best = Some(FixedPoint {
                forces: contacts.cut(&forces),
                rates: rates.clone(),
                lambda,
                change,
                noise,
                solves: k,
            });
        } else if let Some(best) = &mut best {
            best.solves = k;
        }
        if change <= stop.change {
            break;
        }
        held =
            anderson.next(&now, &then).iter().zip(&contacts.passing).map(|(x, p)| x * p).collect();
    }
    best
}

/// Forces of a load factor that leave more of a block's load than this are no solution: the program
/// has none. Larger: such forces are taken for one. Smaller: the engine's noise ends iterations.
const UNBALANCED: f64 = 1e-2;

/// The engine with the program of one fixed point.
struct Engine {
    program: ConicProgram,
    session: Session,
}

impl Engine {
    fn new(
        contacts: &Contacts,
        (objective, quantity, held): (Objective, HeldQuantity, &[f64]),
        settings: &Settings,
    ) -> Option<Self> {
        let program = contacts.program(objective, quantity, held);
        let session = Session::new(&program, settings)?;
        Some(Self { program, session })
    }

    /// Solves with something else held.
    fn again(
        &mut self,
        contacts: &Contacts,
        quantity: HeldQuantity,
        held: &[f64],
    ) -> Option<Solution> {
        contacts.hold(&mut self.program, quantity, held);
        let accepted = match quantity {
            HeldQuantity::Limits => self.session.set_rhs(&self.program.rhs),
            HeldQuantity::SlidingRates => self.session.set_objective(&self.program.objective),
        };
        accepted.then(|| self.session.solve())
    }
}

fn read(
    contacts: &Contacts,
    objective: Objective,
    solution: &Solution,
) -> (Vec<f64>, Vec<f64>, f64) {
    let forces = solution.x[..contacts.statics.matrix.columns].to_vec();
    let (rates, lambda) = match objective {
        Objective::State(epsilon) => {
            (contacts.multipliers(&contacts.residual(&forces, 0.0), epsilon), 0.0)
        }
        Objective::LoadFactor(_, scale) => (
            solution.z[..contacts.statics.matrix.rows].to_vec(),
            scale * solution.x[contacts.statics.matrix.columns],
        ),
    };
    (forces, rates, lambda)
}

/// `u`, the compliance of the contacts included.
fn joint_rates(
    contacts: &Contacts,
    objective: Objective,
    forces: &[f64],
    rates: &[f64],
) -> Vec<f64> {
    let weight = if let Objective::LoadFactor(delta, _) = objective { delta } else { 1.0 };
    let mut u = contacts.joint_rates(rates);
    for ((u, c), f) in u.iter_mut().zip(&contacts.compliance).zip(forces) {
        *u += weight * c * f;
    }
    u
}
