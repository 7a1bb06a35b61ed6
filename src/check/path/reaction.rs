//! What moving supports carry: from forces, and the least of it from a mechanism.
//!
//! Let supports move at given rates, and `R` be the power of the blocks' forces on them. For all
//! admissible forces in equilibrium and any rates `q` of the free blocks that follow with
//! inadmissibility `e`, virtual work gives `R ≥ w·q − D − Σ e f_n` (see
//! [`thrust`](crate::verdict::thrust), of which this is the case of any movement). A support that
//! yields carries the least there is.

use crate::verdict::{Forces, Rate, certificate, in_every_way};
use base::tolerance;
use model::{assembly::Wrench, interface::Model};

/// What forces and a mechanism prove about the least power on moving supports.
#[derive(Clone, Debug)]
pub struct Least {
    /// The power of the forces, J per unit of the parameter.
    pub value: f64,
    /// No admissible forces have less.
    pub lower: f64,
    /// Some have no more.
    pub upper: f64,
    /// Whether forces and mechanism are good enough to say so.
    pub holds: bool,
}

/// The force on a support, N, and its moment about the support's centre of mass, N·m.
pub fn on_support(model: &Model, forces: &Forces, support: usize) -> Wrench {
    let Model { assembly, interfaces, .. } = model;
    let center = assembly.blocks[support].centroid;
    let mut sum = Wrench::zero();
    for (face, forces) in interfaces.list.iter().zip(forces) {
        let sign = f64::from(u8::from(face.b == support)) - f64::from(u8::from(face.a == support));
        if sign == 0.0 {
            continue;
        }
        for (p, w) in face.points.iter().zip(forces) {
            let moment = w.moment + (p - center).cross(&w.force);
            sum += Wrench { force: w.force, moment } * sign;
        }
    }
    for (own, forces) in interfaces.members.iter().zip(forces.iter().skip(interfaces.list.len())) {
        let amount = crate::verdict::member::amounts(forces).x;
        let on = super::member::wrenches(own, amount, |i| assembly.blocks[i].centroid);
        on.into_iter().filter(|(i, _)| *i == support).for_each(|(_, w)| sum += w);
    }
    sum
}

/// The power of forces on supports that move at these rates, and the bracket of its least value;
/// `rates` are those of all blocks, supports among them.
pub fn least(model: &Model, forces: &Forces, rates: &[Rate]) -> Least {
    if let Some((wide, forces)) = in_every_way(model, forces) {
        return least(&wide, &forces, rates);
    }
    let assembly = &model.assembly;
    let supports = || (0..rates.len()).filter(|&i| assembly.blocks[i].support);
    let value: f64 =
        supports().map(|i| certificate::power(&on_support(model, forces, i), &rates[i])).sum();
    let s = certificate::statics(model, forces, 0.0);
    let k = certificate::kinematics(model, rates, forces);
    let hidden: f64 =
        assembly.free().map(|i| certificate::power(&s.residuals[i], &rates[i]).abs()).sum();
    let largest = forces.iter().flatten().map(|f| f.force.norm()).fold(0.0, f64::max);
    let total: f64 = assembly.free().map(|i| certificate::load_scale(assembly, i)).sum();
    let speed = supports()
        .map(|i| rates[i].velocity.norm() + assembly.blocks[i].size * rates[i].spin.norm())
        .fold(0.0, f64::max);
    let behind = k.excess * largest.max(total);
    let allowed =
        tolerance::LOAD_FACTOR_BEHIND * value.abs() + tolerance::LOAD_FACTOR_WIDTH * total * speed;
    let (lower, upper) = (k.gain() - k.slack, value + hidden);
    let width = tolerance::THRUST_WIDTH * value.abs() + tolerance::THRUST_FLOOR * total * speed;
    let holds = s.equilibrium_error <= tolerance::LOOSE_BALANCE
        && s.cone_excess <= tolerance::CONE
        && behind <= allowed
        && upper - lower <= 2.0 * width;
    Least { value, lower, upper, holds }
}
