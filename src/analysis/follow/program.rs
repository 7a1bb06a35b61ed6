//! What programs say at one pose: how much room its forces have, and where it goes next.

use check::path::{self, Carried, Drive};
use check::verdict::{self, Forces, Rate, claim};
use model::{assembly::Pose, interface::Model};
use scene::Friction;
use solve::{
    EngineSettings, Settings, Solution,
    program::{self, ConicProgram, Statics, StaticsOptions, Unknowns},
};

/// The room that the forces of a pose have.
#[derive(Clone)]
pub struct Margin {
    /// By how much of the mean load of a point every point may be pressed less; < 0 where no forces
    /// balance the loads.
    pub room: f64,
    /// Forces that leave this room everywhere; what they are without it.
    pub forces: Forces,
    /// The part of them that lies on the edge of what joints carry at the points that decide.
    pub bare: Forces,
    /// The forces as columns of [`Statics`].
    pub columns: Vec<f64>,
}

/// Settings tried one after the other.
const SETTINGS: [(f64, f64); 3] = [(1e-12, 1e-9), (1e-11, 1e-8), (1e-10, 1e-7)];
/// A hundredth of what both sides of a solution that is good at once differ by, and a hundred times
/// what those of one that counts do.
const AGREES: f64 = 1e-8;

/// The room at a pose; `live` where the load factor is free.
pub fn margin(model: &Model, live: bool) -> Option<Margin> {
    let options = StaticsOptions { live, ..StaticsOptions::default() };
    let statics = Statics::new(model, options);
    let (program, layout, pressed) = program::margin(&statics, &model.interfaces, live);
    let solution = solved(&program)?;
    let x = layout.forces(&solution.x, &solution.z);
    let room = solution.x[x.len()];
    let all: Vec<f64> = x.iter().zip(&pressed).map(|(x, p)| x + room.max(0.0) * p).collect();
    Some(Margin {
        room,
        forces: statics.forces(&model.interfaces, &all),
        bare: statics.forces(&model.interfaces, x),
        columns: all,
    })
}

/// Where a pose goes next.
pub struct Next {
    /// Corners that stay closed, joint by joint.
    pub closed: Vec<Vec<usize>>,
    /// What members do, one by one.
    pub holds: Vec<Hold>,
    /// A joint that slides.
    pub slides: Option<usize>,
    /// Forces.
    pub forces: Forces,
    /// Rates of all blocks, supports among them.
    pub rates: Vec<Rate>,
}

/// What a member does while a linkage moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hold {
    /// It carries nothing and cannot.
    Idle,
    /// It keeps its extent, m.
    Keeps(f64),
    /// It yields at this amount, N.
    Yields(f64),
}

/// What the members of a displaced scene do at these rates.
fn holds(
    carried: &Carried,
    poses: &[Pose],
    model: &Model,
    rates: &[Rate],
    fastest: f64,
) -> Vec<Hold> {
    let start = carried.start;
    let own = start.interfaces.members.iter().zip(&model.interfaces.members);
    own.map(|(at_start, member)| {
        if member.is_idle() {
            return Hold::Idle;
        }
        let power = verdict::member::power(&model.assembly, member, rates).x;
        let keeps = Hold::Keeps(path::member::extent(&start.assembly, poses, at_start));
        let at = |amount: f64| if amount.is_finite() { Hold::Yields(amount) } else { keeps };
        if power.abs() <= REST * fastest {
            keeps
        } else if power < 0.0 {
            at(member.greatest)
        } else {
            at(member.least)
        }
    })
    .collect()
}

/// Speeds below this × the fastest are none.
const REST: f64 = 1e-6;

/// The mechanism that a pose starts to move in, with these corners closed.
pub fn next(
    carried: &Carried,
    poses: &[Pose],
    closed: &[Vec<usize>],
    drive: &Drive,
) -> Option<Next> {
    let displaced = carried.touching(poses, closed);
    let model = &displaced.model;
    let (forces, rates) = match drive {
        Drive::Settle(moves) => {
            let supports = moves.rates(model);
            least_reaction(model, &supports)?
        }
        Drive::Push { .. } => load_factor(model)?,
    };
    let blocks = &model.assembly.blocks;
    let list = &carried.start.interfaces.list;
    let speed = |k: usize, p: usize| {
        let [a, b] = carried.copies(poses, k, p);
        let at = |i: usize, x| rates[i].velocity + rates[i].spin.cross(&(x - blocks[i].centroid));
        let v = at(list[k].b, b) - at(list[k].a, a);
        let n = carried.normal(poses, k, p);
        let vn = n.dot(&v);
        (v.norm(), vn, (v - n * vn).norm())
    };
    // Of the blocks, not of the closed corners: all of these may stay closed.
    let fastest = rates
        .iter()
        .zip(blocks)
        .map(|(r, b)| r.velocity.norm() + 0.5 * b.size * r.spin.norm())
        .fold(0.0, f64::max);
    let mut slides = None;
    let kept = closed
        .iter()
        .enumerate()
        .map(|(k, c)| {
            c.iter()
                .copied()
                .filter(|&p| {
                    let (v, vn, vt) = speed(k, p);
                    let mu = match list[k].law.friction {
                        Friction::Coefficient(mu) => mu,
                        Friction::Infinite => 0.0,
                    };
                    if v > REST * fastest
                        && vn - mu * vt <= REST * fastest
                        && vt > 1e2 * REST * fastest
                    {
                        slides = Some(k);
                    }
                    v <= REST * fastest
                })
                .collect()
        })
        .collect();
    let holds = holds(carried, poses, model, &rates, fastest);
    Some(Next { closed: kept, holds, slides, forces, rates })
}

/// Forces of least power on supports that move at these rates, and the rates of all blocks.
pub fn least_reaction(model: &Model, supports: &[Rate]) -> Option<(Forces, Vec<Rate>)> {
    // A plane scene knows no reaction out of its plane.
    let plane = Statics::new(model, StaticsOptions::default());
    let across = plane.plane.is_some_and(|p| {
        supports.iter().any(|r| {
            p.axis.dot(&r.velocity).abs() > 1e-12 * r.velocity.norm()
                || r.spin.cross(&p.axis).norm() > 1e-12 * r.spin.norm()
        })
    });
    let statics = if across {
        Statics::new(model, StaticsOptions { keep_all: true, ..StaticsOptions::default() })
    } else {
        plane
    };
    let (total, blocks) = (statics.total_load(), model.assembly.blocks.len());
    let columns = program::reaction_columns(&statics, model, supports);
    let speed = supports
        .iter()
        .zip(&model.assembly.blocks)
        .map(|(r, b)| r.velocity.norm() + r.spin.norm() * b.size)
        .fold(0.0, f64::max);
    let by = total * speed;
    let objective: Vec<f64> = columns.iter().map(|c| c / by).collect();
    let (program, layout) = program::thrust(&statics, &objective);
    let solution = solved(&program)?;
    let x = layout.forces(&solution.x, &solution.z);
    let mut rates = rates(&statics, blocks, layout.rates(&solution.x, &solution.z), by);
    for (i, r) in supports.iter().enumerate().filter(|(i, _)| model.assembly.blocks[*i].support) {
        rates[i] = *r;
    }
    Some((statics.forces(&model.interfaces, x), rates))
}

/// Forces and rates at the greatest load factor, as the program has them: nothing is mended, so that
/// what rests in it is at rest.
fn load_factor(model: &Model) -> Option<(Forces, Vec<Rate>)> {
    let statics = Statics::new(model, StaticsOptions { live: true, ..StaticsOptions::default() });
    let scale = claim::natural_factor(&model.assembly);
    let (program, layout) = program::load_factor(&statics, scale, Unknowns::Forces);
    let solution = solved(&program)?;
    let x = layout.forces(&solution.x, &solution.z);
    let blocks = model.assembly.blocks.len();
    let rates = rates(&statics, blocks, layout.rates(&solution.x, &solution.z), 1.0);
    Some((statics.forces(&model.interfaces, x), rates))
}

pub(super) fn rates(statics: &Statics, blocks: usize, y: &[f64], by: f64) -> Vec<Rate> {
    let list = statics.rates(blocks, y).into_iter();
    list.map(|(velocity, spin)| Rate { velocity: velocity * by, spin: spin * by }).collect()
}

/// The first solution whose two sides agree.
pub(super) fn solved(program: &ConicProgram) -> Option<Solution> {
    let mut best: Option<(f64, Solution)> = None;
    for (tolerance, regularization) in SETTINGS {
        let engine = EngineSettings::clarabel(regularization);
        let settings = Settings { tolerance, engine, ..Settings::default() };
        let solution = solve::solve(program, &settings);
        if !solution.is_finite() {
            continue;
        }
        let gap = solution.trace.last().map_or(f64::INFINITY, |l| {
            (l.primal - l.dual).abs() + l.primal_residual + l.dual_residual
        });
        if best.as_ref().is_none_or(|(g, _)| gap < *g) {
            best = Some((gap, solution));
        }
        if gap <= AGREES * 1e-2 {
            break;
        }
    }
    best.filter(|(gap, _)| *gap <= 1e2 * AGREES).map(|b| b.1)
}
