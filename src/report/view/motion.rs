//! Mechanisms and displacements as motions that can be followed.
//!
//! The rates of a mechanism say how a motion begins. A block with velocity `v` of its centre of
//! mass and spin `ω` is followed along the screw that they span, the exponential of its twist:
//! after `s` it is turned by `s‖ω‖` about the axis through the point of its body (or beyond) that
//! does not move across `ω`, and shifted along it. So a block that pivots about a hinge keeps that
//! hinge exactly, and no block is deformed, however large `s`; between two blocks that both turn
//! gaps open in the second order of `s`.
//!
//! R. S. Ball, *A Treatise on the Theory of Screws*, Cambridge 1900.

use super::{BlockView, ViewPart, pressure};
use crate::view::ViewShape;
use analysis::coulomb::Found;
use check::{
    proof::{certificate::Certificate, result::ResultFile},
    verdict::{
        Rate,
        claim::Claim,
        evidence::read_rates,
        mechanism::{self, JointMotion as Kind},
    },
};
use model::interface::Model;
use nalgebra::{UnitQuaternion, Vector3};

/// A mechanism.
#[derive(Clone, Debug)]
pub struct ViewMotion {
    /// What it is to the answer.
    pub part: ViewPart,
    /// What it is, in a few words.
    pub name: String,
    /// The rate of each block (arbitrary common scale).
    pub rates: Vec<Rate>,
    /// The greatest speed of a corner on that scale, over 1 m: `s / reach` moves no corner farther
    /// than `s`, to first order.
    pub reach: f64,
    /// Joints that move.
    pub marks: Vec<Mark>,
    /// Whether the rates are displacements, m and rad: of a scale of their own, and shown magnified.
    pub is_displacement: bool,
}

/// A joint that moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    /// Index of the joint.
    pub joint: usize,
    /// What it does.
    pub kind: Kind,
    /// Where, m.
    pub at: Vector3<f64>,
}

/// Where a block is: turned about its centre of mass, which is shifted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewPose {
    /// Shift of the centre of mass, m.
    pub shift: Vector3<f64>,
    /// Rotation.
    pub turn: UnitQuaternion<f64>,
}

impl ViewMotion {
    pub(super) fn new(
        model: &Model,
        part: ViewPart,
        name: &str,
        rates: Vec<Rate>,
        bodies: &[BlockView],
    ) -> Option<Self> {
        let reach = bodies.iter().zip(&rates).map(|(b, r)| speed(b, r)).fold(0.0, f64::max);
        if !(reach.is_finite() && reach > 0.0) {
            return None;
        }
        let read = mechanism::read(model, &rates);
        let marks = read
            .joints
            .iter()
            .map(|j| Mark { joint: j.interface, kind: j.motion, at: j.at })
            .collect();
        Some(Self { part, name: name.into(), rates, reach, marks, is_displacement: false })
    }

    /// Small displacements, of elastic joints.
    fn displacements(rates: Vec<Rate>, bodies: &[BlockView]) -> Option<Self> {
        let reach = bodies.iter().zip(&rates).map(|(b, r)| speed(b, r)).fold(0.0, f64::max);
        (reach.is_finite() && reach > 0.0).then(|| Self {
            part: ViewPart::Answer,
            name: "displacements under the dead load".into(),
            rates,
            reach,
            marks: Vec::new(),
            is_displacement: true,
        })
    }

    /// Where a block is when the corner that moves fastest would have gone `way` m straight on.
    pub fn pose(&self, body: usize, way: f64) -> ViewPose {
        let Some(rate) = self.rates.get(body) else {
            return ViewPose { shift: Vector3::zeros(), turn: UnitQuaternion::identity() };
        };
        let s = way / self.reach;
        let spin = rate.spin.norm();
        if spin * s.abs() < 1e-12 {
            return ViewPose { shift: rate.velocity * s, turn: UnitQuaternion::identity() };
        }
        let axis = rate.spin / spin;
        // The axis passes this far from the centre of mass.
        let arm = axis.cross(&rate.velocity) / spin;
        let turn = UnitQuaternion::from_scaled_axis(rate.spin * s);
        ViewPose { shift: arm - turn * arm + axis * (axis.dot(&rate.velocity) * s), turn }
    }
}

/// The greatest speed of a point of a block.
fn speed(body: &BlockView, rate: &Rate) -> f64 {
    match &body.shape {
        ViewShape::Sphere(radius) => rate.velocity.norm() + radius * rate.spin.norm(),
        ViewShape::Surface(s) => s
            .corners
            .iter()
            .map(|p| (rate.velocity + rate.spin.cross(&(p - body.center))).norm())
            .fold(0.0, f64::max),
    }
}

/// Every mechanism that a result holds.
pub(super) fn of(
    model: &Model,
    file: &ResultFile,
    bodies: &[BlockView],
) -> Result<Vec<ViewMotion>, String> {
    let mut list: Vec<(ViewPart, &str, &Certificate)> = Vec::new();
    let moves =
        |c: &Certificate| !matches!(c.claim, None | Some(Claim::Stable | Claim::Unbounded { .. }));
    list.push((
        ViewPart::Answer,
        if file.answer.as_verdict().is_some() { "mechanism" } else { "collapse mechanism" },
        &file.certificate,
    ));
    if let Some(dry) = file.dry.as_ref().filter(|d| d.found != Found::NothingSlides) {
        list.push((ViewPart::Dry, "collapse mechanism with dry friction", &dry.certificate));
    }
    if let Some(thrust) = &file.thrust {
        list.push((ViewPart::Least, "mechanism at the least thrust", &thrust.least));
        list.push((ViewPart::Greatest, "mechanism at the greatest thrust", &thrust.greatest));
    }
    if let Some(dead) = &file.dead_load {
        list.push((ViewPart::Dead, "mechanism under the dead load", &dead.certificate));
    }
    let mut motions = Vec::new();
    for (part, name, certificate) in list.into_iter().filter(|(_, _, c)| moves(c)) {
        let mut rates = read_rates(&model.assembly, &certificate.rates)?;
        if let Some(Claim::Thrust { at, extreme, .. }) = certificate.claim
            && let Some(support) = rates.get_mut(at.support)
        {
            support.velocity = Vector3::from(at.direction) * extreme.sigma();
        }
        motions.extend(ViewMotion::new(model, part, name, rates, bodies));
    }
    if let Some(state) = file.answer.state() {
        let rates = pressure::displaced(model, state);
        motions.extend(ViewMotion::displacements(rates, bodies));
    }
    Ok(motions)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion(velocity: [f64; 3], spin: [f64; 3]) -> ViewMotion {
        ViewMotion {
            part: ViewPart::Answer,
            name: String::new(),
            rates: vec![Rate { velocity: velocity.into(), spin: spin.into() }],
            reach: 1.0,
            marks: Vec::new(),
            is_displacement: false,
        }
    }

    /// Pivoting about a corner, the corner stays where it is, however far; the start is the rate.
    #[test]
    fn a_hinge_stays_where_it_is() {
        // The centre of mass is at (1, 0, 2) from a hinge along y.
        let (arm, spin) = (Vector3::new(1.0, 0.0, 2.0), Vector3::new(0.0, 0.3, 0.0));
        let motion = motion(spin.cross(&arm).into(), spin.into());
        for way in [1e-6, 0.5, 3.0] {
            let p = motion.pose(0, way);
            assert!((p.shift - arm + p.turn * -arm + arm * 2.0).norm() < 1e-12, "{way}");
        }
        let p = motion.pose(0, 1e-7);
        assert!((p.shift / 1e-7 - spin.cross(&arm)).norm() < 1e-6);
    }

    #[test]
    fn a_block_that_does_not_turn_goes_straight() {
        let p = motion([1.0, 2.0, 3.0], [0.0; 3]).pose(0, 2.0);
        assert_eq!((p.shift, p.turn), (Vector3::new(2.0, 4.0, 6.0), UnitQuaternion::identity()));
        // Along its axis it only screws.
        let p = motion([0.0, 0.0, 1.0], [0.0, 0.0, 2.0]).pose(0, 0.5);
        assert!(
            (p.shift - Vector3::new(0.0, 0.0, 0.5)).norm() < 1e-15
                && (p.turn.angle() - 1.0).abs() < 1e-15
        );
    }
}
