//! The fixed point of one program: friction held, solved, held anew.

use super::{anderson::Anderson, law::Law, newton::Newton};
use crate::{
    interface::Interfaces,
    program::{
        ConicProgram,
        coulomb::{Aim, Contacts, Hold},
    },
    solve::{Session, Settings, Solution},
    verdict::certificate,
};

/// Where an iteration ended.
#[derive(Clone, Debug)]
pub(super) struct FixedPoint {
    /// Forces per column in mean block loads, cut back into the friction cones.
    pub forces: Vec<f64>,
    /// Rates of the blocks: multipliers of the rows.
    pub rates: Vec<f64>,
    /// The load factor (0 for a state).
    pub lambda: f64,
    /// Last change of what was held, each in the load that presumably passes there.
    pub change: f64,
    /// What is unsettled can make this of accelerations at most, in multiples of gravity.
    pub noise: f64,
    /// Convex programs solved.
    pub solves: usize,
}

/// When to stop.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stop {
    /// Change of what is held, in the load that presumably passes there: a measure relative to the current value would let blocks that
    /// are squeezed by ever smaller forces hang, one that is the same everywhere overlooks light blocks among heavy ones.
    pub change: f64,
    /// Most convex programs.
    pub solves: usize,
}

/// What solves the programs of one fixed point.
pub(super) struct Means<'a> {
    /// Newton's method, where the program can be written in the rates, and the rates it starts from.
    pub newton: Option<(&'a mut Newton, &'a [f64])>,
    /// Coulomb's law itself, for load factors.
    pub law: Option<&'a mut Law>,
    /// Settings of the engine, which solves what Newton's method does not.
    pub settings: &'a Settings,
}

/// Iterates from the limits or sliding rates `start`. `None` where the engine refuses the program or leaves no numbers.
pub(super) fn iterate(contacts: &Contacts, aim: Aim, hold: Hold, start: Vec<f64>, stop: Stop, means: Means) -> Option<FixedPoint> {
    let Means { mut newton, mut law, settings } = means;
    let end = settings.deadline;
    let mut rates = newton.as_ref().map_or_else(Vec::new, |(_, rates)| rates.to_vec());
    let mut held = start;
    let mut engine: Option<Engine> = None;
    let mut anderson = Anderson::default();
    let mut best: Option<FixedPoint> = None;
    if let (Some(law), Aim::LoadFactor(delta, scale)) = (&mut law, aim)
        && let Some(point) = law.on(contacts, delta, end)
    {
        return Some(FixedPoint { lambda: scale * point.lambda, ..point });
    }
    for k in 1..=stop.solves {
        let solved = match (&mut newton, aim) {
            (Some((newton, _)), Aim::State(epsilon)) => newton.solve(contacts, (epsilon, hold, &held), &rates, end),
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
                Some(engine) => engine.again(contacts, hold, &held),
                None => engine.insert(Engine::new(contacts, (aim, hold, &held), settings)?).session.solve().into(),
            };
            let Some(solution) = solution.filter(Solution::is_finite) else { break };
            (forces, rates, lambda) = read(contacts, aim, &solution);
        }
        if let (Some(law), Aim::LoadFactor(delta, scale)) = (&mut law, aim)
            && let Some(point) = law.near(contacts, delta, &rates, lambda / scale, end)
        {
            return Some(FixedPoint { lambda: scale * point.lambda, solves: k, ..point });
        }
        // Under these limits there is no load factor: those that came before wander.
        if best.is_some() && contacts.residual(&forces, lambda).iter().any(|r| r.abs() > UNBALANCED) && matches!(aim, Aim::LoadFactor(..)) {
            break;
        }
        let next = match hold {
            Hold::Limits => contacts.limits(&forces),
            Hold::SlidingRates => contacts.sliding(&joint_rates(contacts, aim, &forces, &rates)),
        };
        let local = |x: &[f64]| -> Vec<f64> { x.iter().zip(&contacts.passing).map(|(x, p)| x / p).collect() };
        let (now, then) = (local(&held), local(&next));
        let change = now.iter().zip(&then).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        if !then.iter().all(|x| x.is_finite()) {
            break;
        }
        // The last iterate is kept unless an earlier one was much better: near the end the change is the engine's noise.
        if best.as_ref().is_none_or(|b| change < 10.0 * b.change) {
            let noise = if hold == Hold::Limits { contacts.unsettled(&forces, &held, &next) } else { change };
            best = Some(FixedPoint { forces: contacts.cut(&forces), rates: rates.clone(), lambda, change, noise, solves: k });
        } else if let Some(best) = &mut best {
            best.solves = k;
        }
        if change <= stop.change {
            break;
        }
        held = anderson.next(&now, &then).iter().zip(&contacts.passing).map(|(x, p)| x * p).collect();
    }
    best
}

/// Forces of a load factor that leave more of a block's load than this are no solution: the program has none. Larger: such forces are taken
/// for one. Smaller: the engine's noise ends iterations.
const UNBALANCED: f64 = 1e-2;

/// The engine with the program of one fixed point.
struct Engine {
    program: ConicProgram,
    session: Session,
}

impl Engine {
    fn new(contacts: &Contacts, (aim, hold, held): (Aim, Hold, &[f64]), settings: &Settings) -> Option<Self> {
        let program = contacts.program(aim, hold, held);
        let session = Session::new(&program, settings)?;
        Some(Self { program, session })
    }

    /// Solves with something else held.
    fn again(&mut self, contacts: &Contacts, hold: Hold, held: &[f64]) -> Option<Solution> {
        contacts.hold(&mut self.program, hold, held);
        let accepted = match hold {
            Hold::Limits => self.session.set_rhs(&self.program.rhs),
            Hold::SlidingRates => self.session.set_objective(&self.program.objective),
        };
        accepted.then(|| self.session.solve())
    }
}

/// Fixed points again and again, with the bounds on crushing that the last one broke added to the contacts.
pub(super) fn within_strength(
    contacts: &mut Contacts,
    interfaces: &Interfaces,
    mut solve: impl FnMut(&Contacts) -> Option<FixedPoint>,
) -> Option<FixedPoint> {
    let mut solves = 0;
    for _ in 0..MOST_ROUNDS {
        let point = solve(contacts)?;
        solves += point.solves;
        let broken = certificate::crushed(interfaces, &contacts.statics.forces(interfaces, &point.forces));
        if broken.is_empty() {
            return Some(FixedPoint { solves, ..point });
        }
        contacts.statics.bound(&broken);
    }
    None
}

/// Fixed points tried with ever more bounds on crushing. Fewer: states near the strength stay undecided. More: time lost.
const MOST_ROUNDS: usize = 20;

fn read(contacts: &Contacts, aim: Aim, solution: &Solution) -> (Vec<f64>, Vec<f64>, f64) {
    let forces = solution.x[..contacts.statics.matrix.columns].to_vec();
    let (rates, lambda) = match aim {
        Aim::State(epsilon) => (contacts.multipliers(&contacts.residual(&forces, 0.0), epsilon), 0.0),
        Aim::LoadFactor(_, scale) => {
            (solution.z[..contacts.statics.matrix.rows].to_vec(), scale * solution.x[contacts.statics.matrix.columns])
        }
    };
    (forces, rates, lambda)
}

/// `u`, the compliance of the contacts included.
fn joint_rates(contacts: &Contacts, aim: Aim, forces: &[f64], rates: &[f64]) -> Vec<f64> {
    let weight = if let Aim::LoadFactor(delta, _) = aim { delta } else { 1.0 };
    let mut u = contacts.joint_rates(rates);
    for ((u, c), f) in u.iter_mut().zip(&contacts.compliance).zip(forces) {
        *u += weight * c * f;
    }
    u
}
