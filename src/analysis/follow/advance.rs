//! One step under dry friction: poses, forces and slips at the next value of the parameter together.
//!
//! *Law.* Over a step let `u` be the way of one block of a contact against the other, normal part
//! the gap at its end. Then `u_n ≥ 0 ⟂ f_n ≥ 0`, and `‖f_t‖ ≤ μ f_n`, against `u_t` and at its limit
//! where `u_t ≠ 0`: sliding opens nothing. The forces balance the loads at the end of the step.
//!
//! *Program.* At poses near the end let `o` be the way so far, gap included, and `d` what the free
//! blocks still move. With the slips `s = μ‖u_t‖` held, `min Σ (o + s n)·f` over forces in the
//! friction cones that balance the loads has `d` for its multipliers: then `u + s n` lies in the dual
//! cone, and where `s` is what comes out the law holds (De Saxcé & Feng 1998). `s` is a fixed point
//! with Anderson acceleration; the poses follow by Newton's method, program by program, with the
//! contacts found anew from the poses each time. Without friction and with one small step it is the
//! least reaction of supports that yield.
//!
//! *Live load.* Where a live load pushes, its factor `λ` is an unknown of the program and `−ω λ` in
//! its objective, so that the multipliers have a given live power; `ω` is a fixed point beside the
//! slips, such that the control point goes as far as it is to. Without slips and with a small `ω` it
//! is the greatest load factor.

use super::{program, rested::Rested, tracker::Tracker};
use crate::{Control, assess, repair};
use base::tolerance;
use check::{
    path::Spot,
    terms::Law,
    verdict::{Forces, Rate, Verdict, certificate, claim, exact::existence},
};
use model::{assembly::Pose, interface::Model};
use nalgebra::{UnitQuaternion, Vector3};
use scene::Friction;
use solve::{
    coulomb::Anderson,
    program as conic,
    program::{Statics, StaticsOptions},
};

/// What the control point is still to go, and the live power on that.
#[derive(Clone, Copy)]
pub(super) struct Push {
    pub left: f64,
    pub power: f64,
}

/// What one program moves from, and what it is told beforehand.
pub(super) struct Step<'a> {
    pub poses: &'a [Pose],
    /// Where what is driven is to be.
    pub goals: &'a [Pose],
    /// Rates of the step before and how many times these are expected.
    pub guess: Option<(&'a [Rate], f64)>,
    /// What displacements are measured by, m.
    pub reach: f64,
    pub push: Option<Push>,
}

/// Programs of one step at most: two or three where there is a motion, for what carries forces is
/// closed after each. More: time lost where two motions take turns.
const ROUNDS: usize = 7;
/// Slips held anew at most for one program. More: time lost where friction does not settle.
const SOLVES: usize = 12;
/// Slips have settled when they change by less than this × the way of the step; what they are off by
/// is left open, and closed by the next program.
const SETTLED: f64 = 1e-7;
/// Slips that change by more do not settle. Less: motions that the next program makes good are
/// given up. More: time lost.
pub(super) const UNSETTLED: f64 = 1e-2;
/// Poses are at rest when gaps that carry forces are less than this × [`tolerance::JOINT_CLOSED`]
/// beside the size of their joint. Larger: contacts with forces are lost when the pose is read back.
pub(super) const AT_REST: f64 = 0.2;
/// Forces below this × the greatest are none.
const NO_FORCE: f64 = 1e-7;
/// Slips below this × the way of the step are none.
const NO_SLIP: f64 = 1e-4;
/// A block that moves by more than this × the way of what drives it jumps.
const JUMP: f64 = 100.0;

/// Newton's steps at most that close what carries forces.
const CLOSINGS: usize = 6;
/// Added to what is accelerated beside slips, which stays above zero.
const NOT_NEGATIVE: f64 = 10.0;
/// Forces and load factor are those of a pose where the program moves nothing by more than this × the
/// size of the scene. More: those of the pose before. Less: noise of the engine.
const STILL: f64 = 1e-8;
/// Motions of less than this × a step say nothing about how far the live load takes the control
/// point. Less: what closes gaps is taken for it.
const TOLD: f64 = 0.1;
/// By so much more, or less, than before the control point may go in one program. More: a motion that
/// hardly moves it is taken for one.
const MOST_GAIN: f64 = 1e3;
/// A contact is found again within this × the way of a step.
const FOUND_AGAIN: f64 = 20.0;

/// A contact point (or a mirrored pair) of the program of a step.
struct Row {
    interface: usize,
    column: usize,
    n: Vector3<f64>,
    mu: f64,
    /// The way so far; normal part: the gap.
    so_far: Vector3<f64>,
    /// Whether it was apart where the step began: then it slides as far as it closes.
    was_apart: bool,
}

/// The displaced scene of one program.
pub(super) struct Stage {
    pub model: Model,
    /// Joint and places of every contact.
    pub spots: Vec<(usize, Vec<Spot>)>,
}

/// What one program leaves.
pub(super) struct Solved {
    /// Joints, places and whether they slide, of the contacts that carry a force.
    pub active: Vec<(usize, Vector3<f64>, bool)>,
    pub forces: Forces,
    pub rates: Vec<Rate>,
    pub load_factor: f64,
    /// The power of the live load per way of the control point in this motion.
    pub power: f64,
    pub change: f64,
}

impl Tracker<'_> {
    /// The pose at `value` that dry friction leads to from this one; nothing where there is none
    /// near by.
    pub(super) fn advance(&self, from: &Rested, value: f64) -> Option<Rested> {
        let blocks = &self.start().blocks;
        let goal = |i: usize, poses: &[Pose]| {
            if blocks[i].support { self.drive.pose(i, value) } else { poses[i] }
        };
        let reach = self.reach(from.value, value);
        let mut poses = from.poses.clone();
        let mut last: Option<(Solved, Stage)> = None;
        for round in 0..ROUNDS {
            if self.deadline.is_over() {
                return None;
            }
            let stage = self.stage(&poses);
            let power = last.as_ref().map_or(from.power, |(solved, _)| solved.power);
            let push = self.left(&poses, value).map(|left| Push { left, power });
            if let Some((solved, before)) = &last
                && solved.change <= SETTLED
                && self.is_there(push)
                && (push.is_none() || self.farthest(&solved.rates) <= STILL * self.size)
                && self.is_at_rest(&poses, before, &stage, solved)
            {
                return self.rested(from, value, poses, before, solved, reach);
            }
            let goals: Vec<Pose> = (0..blocks.len()).map(|i| goal(i, &poses)).collect();
            let guess = (round == 0).then(|| (&from.rates[..], value - from.value));
            let step = Step { poses: &poses, goals: &goals, guess, reach, push };
            let solved = self.solve(&stage, from, step)?;
            if solved.change > UNSETTLED {
                return None;
            }
            for (i, pose) in poses.iter_mut().enumerate() {
                if blocks[i].support {
                    *pose = goals[i];
                    continue;
                }
                pose.shift += solved.rates[i].velocity;
                pose.turn = UnitQuaternion::from_scaled_axis(solved.rates[i].spin) * pose.turn;
                pose.turn.renormalize();
                // What is no number is as far away as can be.
                let is_near = (pose.shift - from.poses[i].shift).norm() <= JUMP * reach;
                if !is_near {
                    return None;
                }
            }
            if let Some(closed) = self.closed_up(from, &poses, &solved.active, reach, value) {
                poses = closed;
            }
            last = Some((solved, stage));
        }
        None
    }

    /// How far what drives the scene moves between two values, m.
    fn reach(&self, from: f64, to: f64) -> f64 {
        if self.drive.is_push() {
            return to - from;
        }
        let blocks = &self.start().blocks;
        let supports = (0..blocks.len()).filter(|&i| blocks[i].support).map(|i| {
            let [a, b] = [from, to].map(|v| self.drive.pose(i, v));
            (b.shift - a.shift).norm() + a.turn.angle_to(&b.turn) * blocks[i].size
        });
        supports.fold(0.0, f64::max)
    }

    /// All places where joints touch or may.
    fn stage(&self, poses: &[Pose]) -> Stage {
        let all: Vec<_> = (0..self.carried.joints.len())
            .map(|k| self.carried.contacts(poses, k, &self.carried.spots(poses, k)))
            .collect();
        let displaced =
            self.carried.assembled(poses, |k| all[k].iter().map(|(c, _)| c.clone()).collect());
        let spots = all.into_iter().flatten().map(|(_, spots)| spots);
        let spots = displaced.from.iter().copied().zip(spots).collect();
        Stage { model: displaced.model, spots }
    }

    /// Whether everything that carries a force is closed, and nothing overlaps.
    fn is_at_rest(&self, poses: &[Pose], before: &Stage, now: &Stage, solved: &Solved) -> bool {
        let small = |k: usize| AT_REST * tolerance::JOINT_CLOSED * self.carried.size(k);
        let sunk = now.spots.iter().any(|(k, spots)| spots.iter().any(|s| s.gap < -small(*k)));
        let largest = solved.forces.iter().flatten().map(|w| w.force.norm()).fold(0.0, f64::max);
        !sunk
            && before.spots.iter().zip(&solved.forces).all(|((k, spots), forces)| {
                let here = self.carried.spots(poses, *k);
                spots.iter().zip(forces).all(|(s, w)| {
                    w.force.norm() <= NO_FORCE * largest
                        || here.iter().any(|h| {
                            h.gap.abs() <= small(*k)
                                && (h.at - s.at).norm() <= 1e-6 * self.carried.size(*k)
                        })
                })
            })
    }

    /// One program and the slips that settle in it.
    pub(super) fn solve(&self, stage: &Stage, from: &Rested, step: Step<'_>) -> Option<Solved> {
        let Step { poses, goals, guess, reach, push } = step;
        let model = &stage.model;
        let statics = self.statics(model);
        let assembly = &model.assembly;
        let by = statics.total_load() * reach;
        let scale = claim::natural_factor(assembly);
        let way = |to: &[Pose], since: &[Pose], i: usize, at: &Vector3<f64>| {
            let start = self.carried.before(poses, i, at);
            let c = self.start().blocks[i].centroid;
            to[i].way(&c, &start) - since[i].way(&c, &start)
        };
        let rows: Vec<Row> = statics
            .bearings
            .iter()
            .map(|b| {
                let face = &model.interfaces.list[b.interface];
                let n = face.frame.n;
                let mut so_far = Vector3::zeros();
                let mut began = 0.0;
                for p in b.points {
                    let spot = &stage.spots[b.interface].1[p];
                    let slid = way(goals, &from.poses, face.b, &spot.at)
                        - way(goals, &from.poses, face.a, &spot.at);
                    let parts =
                        way(goals, poses, face.b, &spot.at) - way(goals, poses, face.a, &spot.at);
                    let gap = spot.gap + n.dot(&parts);
                    so_far += (slid + n * (gap - n.dot(&slid))) * 0.5;
                    began += 0.5 * (gap - n.dot(&slid));
                }
                let mu = match face.law.friction {
                    Friction::Coefficient(mu) => mu,
                    Friction::Infinite => 0.0,
                };
                let small = 1e-2 * tolerance::JOINT_CLOSED;
                let size = self.carried.size(stage.spots[b.interface].0);
                let was_apart = began.abs() > small * size;
                Row { interface: b.interface, column: b.column, n, mu, so_far, was_apart }
            })
            .collect();
        let at = |r: &Row, k: usize| {
            let [p, q] = statics.bearings[k].points;
            let points = &model.interfaces.list[r.interface].points;
            0.5 * (points[p] + points[q])
        };
        // The way at each contact where blocks move further like this.
        let ways = |rates: &[Rate], times: f64| -> Vec<Vector3<f64>> {
            let moves = |(k, r): (usize, &Row)| {
                let (face, p) = (&model.interfaces.list[r.interface], at(r, k));
                let [a, b] = [face.a, face.b].map(|i| {
                    if assembly.blocks[i].support {
                        Vector3::zeros()
                    } else {
                        check::verdict::at(assembly, rates, i, &p)
                    }
                });
                r.so_far + (b - a) * times
            };
            rows.iter().enumerate().map(moves).collect()
        };
        let slips = |ways: &[Vector3<f64>]| -> Vec<f64> {
            let slip = |(r, u): (&Row, &Vector3<f64>)| r.mu * (u - r.n * r.n.dot(u)).norm() / reach;
            rows.iter().zip(ways).map(slip).collect()
        };
        let rest = vec![Rate::zero(); assembly.blocks.len()];
        let (rates, times) = guess.unwrap_or((&rest, 0.0));
        let mut held = slips(&ways(rates, times));
        // Beside the slips the way that the live load is to have power on; what is accelerated is
        // not negative.
        held.extend(push.map(|p| p.left / reach + NOT_NEGATIVE));
        let run = |held: &[f64]| -> Option<(Forces, Vec<Rate>, f64)> {
            let mut objective = vec![0.0; statics.matrix.columns];
            for ((r, b), s) in rows.iter().zip(&statics.bearings).zip(held) {
                let u = r.so_far + r.n * (s * reach);
                for (k, basis) in b.basis.iter().enumerate() {
                    objective[r.column + k] = b.unit * basis.force.dot(&u) / by;
                }
            }
            let (program, layout) = match push.zip(held.last()) {
                None => conic::thrust(&statics, &objective),
                Some((push, way)) => {
                    let omega = scale * push.power * (way - NOT_NEGATIVE) * reach / by;
                    conic::pushed(&statics, &objective, scale, omega)
                }
            };
            let solution = program::solved(&program)?;
            let x = layout.forces(&solution.x, &solution.z);
            let y = layout.rates(&solution.x, &solution.z);
            let rates = program::rates(&statics, assembly.blocks.len(), y, by);
            let load_factor = push.map_or(0.0, |_| scale * solution.x[x.len()]);
            Some((statics.forces(&model.interfaces, x), rates, load_factor))
        };
        let mut anderson = Anderson::default();
        // How far the control point goes over what the power was thought to take it.
        let mut gain = 1.0;
        let mut best: Option<Solved> = None;
        for solve in 0..SOLVES {
            if self.deadline.is_over() {
                break;
            }
            let (forces, rates, load_factor) = run(&held)?;
            let mut next = slips(&ways(&rates, 1.0));
            if let Some((push, way)) = push.zip(held.last()) {
                let gone = self.speed(&rates, poses);
                let given = (way - NOT_NEGATIVE) * reach;
                if solve == 0 && given.abs() > TOLD * reach {
                    let told = gone / given;
                    gain = if told > 1.0 / MOST_GAIN { told.min(MOST_GAIN) } else { gain };
                }
                next.push(way + (push.left - gone) / (gain * reach));
            }
            let power = push.map_or(0.0, |p| p.power / gain);
            let change = held.iter().zip(&next).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            if !change.is_finite() {
                break;
            }
            let largest = forces.iter().flatten().map(|w| w.force.norm()).fold(0.0, f64::max);
            let slid = slips(&ways(&rates, 1.0));
            let active = rows
                .iter()
                .zip(&statics.bearings)
                .zip(&slid)
                .flat_map(|((r, b), slip)| {
                    let slides = r.was_apart || *slip > NO_SLIP * r.mu;
                    b.points.map(|p| (r.interface, p, slides))
                })
                .filter(|(c, p, _)| forces[*c][*p].force.norm() > NO_FORCE * largest)
                .map(|(c, p, slides)| {
                    (stage.spots[c].0, model.interfaces.list[c].points[p], slides)
                })
                .collect();
            let better = best.as_ref().is_none_or(|b| change < 2.0 * b.change);
            let following = anderson.next(&held, &next);
            if better {
                best = Some(Solved { active, forces, rates, load_factor, power, change });
            }
            if change <= SETTLED {
                break;
            }
            held = following;
        }
        best
    }

    /// Poses near these at which the contacts that carry forces are closed to rounding and those that
    /// do not slide are where they were: without it what is of second order in the step decides
    /// between motions that all but have the same power.
    fn closed_up(
        &self,
        from: &Rested,
        near: &[Pose],
        active: &[(usize, Vector3<f64>, bool)],
        reach: f64,
        value: f64,
    ) -> Option<Vec<Pose>> {
        let blocks = &self.start().blocks;
        let mut poses = near.to_vec();
        for _ in 0..CLOSINGS {
            let mut stage = self.stage(&poses);
            let left = self.left(&poses, value);
            self.hold_control(&mut stage.model, &poses);
            let model = &stage.model;
            let statics = self.statics(model);
            let by = statics.total_load() * reach;
            let slid = |i: usize, at: &Vector3<f64>| {
                let (start, c) = (self.carried.before(&poses, i, at), blocks[i].centroid);
                poses[i].way(&c, &start) - from.poses[i].way(&c, &start)
            };
            let mut objective = vec![0.0; statics.matrix.columns];
            let (mut is_active, mut slides) = (Vec::new(), Vec::new());
            let mut worst = 0.0_f64;
            for b in &statics.bearings {
                let (face, (joint, spots)) =
                    (&model.interfaces.list[b.interface], &stage.spots[b.interface]);
                let n = face.frame.n;
                let near = |at: &Vector3<f64>| {
                    let own = active.iter().filter(|a| a.0 == *joint);
                    own.map(|a| ((a.1 - at).norm(), a.2))
                        .filter(|a| a.0 <= FOUND_AGAIN * reach)
                        .min_by(|a, b| a.0.total_cmp(&b.0))
                };
                let found = near(&spots[b.points[0]].at);
                let mut u = Vector3::zeros();
                for p in b.points {
                    let spot = &spots[p];
                    let slid = slid(face.b, &spot.at) - slid(face.a, &spot.at);
                    u += (slid + n * (spot.gap - n.dot(&slid))) * 0.5;
                }
                is_active.push(found.is_some());
                slides.push(found.is_some_and(|f| f.1));
                if let Some((_, slides)) = found {
                    let off = if slides { n.dot(&u).abs() } else { u.norm() };
                    worst = worst.max(off / self.carried.size(*joint));
                }
                for (k, basis) in b.basis.iter().enumerate() {
                    objective[b.column + k] = b.unit * basis.force.dot(&u) / by;
                }
            }
            let is_there = self.is_there(left.map(|left| Push { left, power: 0.0 }));
            if worst <= 1e-2 * tolerance::JOINT_CLOSED && is_there {
                return Some(poses);
            }
            let scale = statics.total_load();
            let drive = left.map(|left| (scale, scale * left / by));
            let (program, layout) =
                conic::closing(&statics, &objective, &is_active, &slides, drive);
            let solution = program::solved(&program)?;
            let y = layout.rates(&solution.x, &solution.z);
            let rates = program::rates(&statics, blocks.len(), y, by);
            for (i, pose) in poses.iter_mut().enumerate().filter(|(i, _)| !blocks[*i].support) {
                pose.shift += rates[i].velocity;
                pose.turn = UnitQuaternion::from_scaled_axis(rates[i].spin) * pose.turn;
                pose.turn.renormalize();
                let is_near = (pose.shift - near[i].shift).norm() <= reach;
                if !is_near {
                    return None;
                }
            }
        }
        Some(poses)
    }

    fn statics(&self, model: &Model) -> Statics {
        let live = self.drive.is_push();
        let plane = Statics::new(model, StaticsOptions { live, ..StaticsOptions::default() });
        let check::path::Drive::Settle(moves) = self.drive else { return plane };
        // A plane scene knows no motion out of its plane.
        let across = plane.plane.is_some_and(|p| {
            moves.rates(self.carried.start).iter().any(|r| {
                p.axis.dot(&r.velocity).abs() > 1e-12 * r.velocity.norm()
                    || r.spin.cross(&p.axis).norm() > 1e-12 * r.spin.norm()
            })
        });
        if across {
            Statics::new(model, StaticsOptions { keep_all: true, ..StaticsOptions::default() })
        } else {
            plane
        }
    }

    /// What a step has led to.
    fn rested(
        &self,
        from: &Rested,
        value: f64,
        poses: Vec<Pose>,
        stage: &Stage,
        solved: &Solved,
        reach: f64,
    ) -> Option<Rested> {
        let found = self.carried.displaced(&poses);
        let list = &found.model.interfaces.list;
        let mut forces: Forces = check::verdict::no_forces(&found.model.interfaces);
        let largest = solved.forces.iter().flatten().map(|w| w.force.norm()).fold(0.0, f64::max);
        for ((k, spots), own) in stage.spots.iter().zip(&solved.forces) {
            for (spot, w) in spots.iter().zip(own) {
                let near = (0..list.len())
                    .filter(|c| found.from[*c] == *k)
                    .flat_map(|c| (0..list[c].points.len()).map(move |p| (c, p)))
                    .map(|(c, p)| ((list[c].points[p] - spot.at).norm(), c, p))
                    .min_by(|a, b| a.0.total_cmp(&b.0));
                match near {
                    Some((far, c, p)) if far <= 1e-6 * self.carried.size(*k) => forces[c][p] += *w,
                    _ if w.force.norm() <= NO_FORCE * largest => {}
                    _ => return None,
                }
            }
        }
        repair::cut(&found.model.interfaces, &mut forces);
        let proving = self.balanced(&found.model, &forces, solved.load_factor)?;
        let proving = Some(proving).filter(|p| *p != forces);
        let joints = self.joints(&poses, |k| {
            let own = stage.spots.iter().enumerate().filter(|(_, (own, _))| *own == k);
            own.flat_map(|(c, _)| {
                let here = stage.model.interfaces.list[c].points.len();
                (0..here).map(move |p| (c, p))
            })
            .any(|(c, p)| {
                let face = &stage.model.interfaces.list[c];
                let at = &face.points[p];
                let way = |i: usize| {
                    let start = self.carried.before(&poses, i, at);
                    let center = self.start().blocks[i].centroid;
                    poses[i].way(&center, &start) - from.poses[i].way(&center, &start)
                };
                let u = way(face.b) - way(face.a);
                let n = face.frame.n;
                solved.forces[c][p].force.norm() > NO_FORCE * largest
                    && (u - n * n.dot(&u)).norm() > NO_SLIP * reach
            })
        });
        let step = value - from.value;
        let rates: Vec<Rate> = poses
            .iter()
            .zip(&from.poses)
            .map(|(a, b)| Rate {
                velocity: (a.shift - b.shift) / step,
                spin: (a.turn * b.turn.inverse()).scaled_axis() / step,
            })
            .collect();
        let touch = found.from.iter().copied().zip(list.iter().map(|f| f.points.clone())).collect();
        let power = live_power(&found.model, &rates);
        let load_factor = solved.load_factor;
        Some(Rested { value, poses, touch, forces, proving, joints, rates, load_factor, power })
    }

    /// These forces, balanced to what counts as balance; others that are, where that is no small
    /// change; nothing where there are none, for then it does not stand.
    fn balanced(&self, model: &Model, forces: &Forces, lambda: f64) -> Option<Forces> {
        let left = certificate::statics(model, forces, lambda).equilibrium_error;
        if self.drive.is_push() {
            // Its proof is that of its load factor, which finds its own forces.
            return (left <= tolerance::DRY_BALANCE).then(|| forces.clone());
        }
        if left <= tolerance::EQUILIBRIUM_ERROR {
            return Some(forces.clone());
        }
        if let Some(better) = existence::improved(model, forces, 0.0) {
            return Some(better);
        }
        let control =
            Control { law: Law::Associative, deadline: self.deadline, ..Control::default() };
        let any = assess(model, &control);
        (any.verdict == Verdict::Stable).then(|| any.forces.clone())
    }
}

/// The power of the live load.
pub(super) fn live_power(model: &Model, rates: &[Rate]) -> f64 {
    let live = &model.assembly.live;
    model.assembly.free().map(|i| certificate::power(&live[i], &rates[i])).sum()
}
