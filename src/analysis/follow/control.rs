//! The control point of what is pushed, and the motion that a live load begins at a pose under dry
//! friction.

use super::{
    advance::{AT_REST, Push, Stage, Step, UNSETTLED, live_power},
    rested::Rested,
    tracker::Tracker,
};
use base::tolerance;
use check::{
    path::{Demand, Spot},
    verdict::Rate,
};
use model::{
    assembly::{Pose, Wrench},
    interface::Model,
};
use nalgebra::Vector3;

impl Tracker<'_> {
    /// How far a block moves at most at these rates, m/s.
    pub(super) fn farthest(&self, rates: &[Rate]) -> f64 {
        let speed =
            |(r, b): (&Rate, &model::assembly::Block)| r.velocity.norm() + r.spin.norm() * b.size;
        rates.iter().zip(&self.start().blocks).map(speed).fold(0.0, f64::max)
    }

    /// How far the control point is still to go, m; nothing where there is none.
    pub(super) fn left(&self, poses: &[Pose], value: f64) -> Option<f64> {
        let Demand { block, point, toward, value } = self.drive.demand(value)?;
        let way = poses[block].way(&self.start().blocks[block].centroid, &point);
        Some(value - toward.dot(&way))
    }

    /// How fast the control point goes at these rates, m/s; 0 where there is none.
    pub(super) fn speed(&self, rates: &[Rate], poses: &[Pose]) -> f64 {
        let Some(Demand { block, point, toward, .. }) = self.drive.demand(0.0) else { return 0.0 };
        let arm = poses[block].turn * (point - self.start().blocks[block].centroid);
        (rates[block].velocity + rates[block].spin.cross(&arm)).dot(&toward)
    }

    /// Whether the control point is where it is to go.
    pub(super) fn is_there(&self, push: Option<Push>) -> bool {
        let Some(Demand { block, .. }) = self.drive.demand(0.0) else { return true };
        let small = AT_REST * tolerance::ON_THE_WAY * self.start().blocks[block].size;
        push.is_none_or(|p| p.left.abs() <= small)
    }

    /// Forces and rates at a pose, of what touches there: the motion that dry friction begins, per
    /// unit of the way of the control point.
    pub(super) fn flow(&self, here: &Rested) -> Option<Rested> {
        let found = self.carried.displaced(&here.poses);
        let spot = |at: &Vector3<f64>, normal: Vector3<f64>| Spot {
            at: *at,
            gap: 0.0,
            normal,
            side: check::path::Side::Neither,
        };
        let spots =
            found.model.interfaces.list.iter().zip(&found.from).map(|(f, &k)| {
                (k, f.points.iter().map(|p| spot(p, f.frame.n)).collect::<Vec<Spot>>())
            });
        let stage = Stage { spots: spots.collect(), model: found.model };
        let step = Step {
            poses: &here.poses,
            goals: &here.poses,
            guess: Some((&here.rates[..], self.size)),
            reach: self.size,
            push: Some(Push { left: self.size, power: here.power }),
        };
        let solved = self.solve(&stage, here, step)?;
        if solved.change > UNSETTLED {
            return None;
        }
        let per = |r: &Rate| Rate { velocity: r.velocity / self.size, spin: r.spin / self.size };
        let rates: Vec<Rate> = solved.rates.iter().map(per).collect();
        Some(Rested {
            touch: touch(&stage),
            forces: solved.forces,
            proving: None,
            load_factor: solved.load_factor,
            power: live_power(&stage.model, &rates),
            rates,
            ..here.clone()
        })
    }

    /// Replaces the live load by a unit force on the control point: as one of the forces that close
    /// gaps it keeps that point where it is to be.
    pub(super) fn hold_control(&self, model: &mut Model, poses: &[Pose]) {
        let Some(Demand { block, point, toward, .. }) = self.drive.demand(0.0) else { return };
        let arm = poses[block].turn * (point - self.start().blocks[block].centroid);
        let assembly = &mut model.assembly;
        assembly.live = vec![Wrench::zero(); assembly.blocks.len()];
        assembly.live[block] = Wrench { force: toward, moment: arm.cross(&toward) };
    }
}

/// The joint at the start of every contact, and its places.
fn touch(stage: &Stage) -> Vec<(usize, Vec<Vector3<f64>>)> {
    stage.spots.iter().map(|(k, spots)| (*k, spots.iter().map(|s| s.at).collect())).collect()
}
