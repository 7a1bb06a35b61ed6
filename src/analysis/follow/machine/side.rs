//! The mechanism of one sense.

use super::{
    table,
    terms::{Beside, Exactness, found, refuse},
};
use crate::{
    LoadFactor, Proved,
    follow::{
        linkage::{Configuration, Linkage, Turned},
        program,
    },
};
use base::error::InputError;
use check::{
    path::{Carried, Drive},
    rocking::{Law, Sense},
    terms::Outcome,
    verdict::Rate,
};
use model::{
    assembly::{Block, Pose, Solid},
    interface::Model,
};
use nalgebra::Vector3;

/// The mechanism that limit analysis proves for a model under its live load.
pub(super) struct Side<'a> {
    model: &'a Model,
    masses: &'a [Beside],
    carried: Carried<'a>,
    closed: Vec<Vec<usize>>,
    /// Rates at the start, per radian of the turn of `lead`.
    pub rates: Vec<Rate>,
    /// The block that turns fastest, and its axis.
    lead: usize,
    axis: Vector3<f64>,
    /// 0 towards the direction, 1 against it.
    which: usize,
}

/// The law of a side.
pub(super) struct Lawful {
    pub sense: Sense,
    /// Bodies of the linkage that move, each with the number of its blocks.
    pub bodies: Vec<usize>,
}

/// Speeds below this × the fastest are none.
const REST: f64 = 1e-9;
/// A load factor of the linkage within this × the proved one is that one.
const SAME: f64 = 1e-6;

impl<'a> Side<'a> {
    /// The mechanism; none where nothing moves in this sense.
    pub fn new(
        model: &'a Model,
        masses: &'a [Beside],
        proof: &Proved<LoadFactor>,
        which: usize,
    ) -> Result<Option<Self>, InputError> {
        let sense = ["towards the direction", "against the direction"][which];
        if proof.outcome == Outcome::Unbounded {
            return Ok(None);
        }
        found(proof, sense)?;
        let carried = Carried::new(model);
        let blocks = &model.assembly.blocks;
        let poses = vec![Pose::start(); blocks.len()];
        let all: Vec<Vec<usize>> =
            model.interfaces.list.iter().map(|f| (0..f.points.len()).collect()).collect();
        let drive = drive();
        let next = program::next(&carried, &poses, &all, &drive)
            .ok_or_else(|| refuse(format!("{sense}: the mechanism was not found again")))?;
        if let Some(k) = next.slides {
            let f = &model.interfaces.list[k];
            return Err(refuse(format!(
                "{sense}: the joint between {} and {} slides, and only motions about hinges are followed",
                blocks[f.a].id, blocks[f.b].id
            ))
            .hint("`voussoir simulate --ground` runs it in time with friction"));
        }
        let linkage = Linkage::new(&carried, &next.closed, &[], &drive);
        let place = linkage.place(&poses);
        let free = linkage.free(&place, None);
        if free.ncols() != 1 {
            return Err(refuse(format!(
                "{sense}: the hinges of the mechanism leave {} motions free, not one",
                free.ncols()
            ))
            .hint("`voussoir simulate --ground` runs it in time"));
        }
        let mut rates = linkage.rates(&place, &free.column(0).into_owned());
        let power = |rates: &[Rate], live: bool| -> f64 {
            let loads = if live { &model.assembly.live } else { &model.assembly.dead };
            rates
                .iter()
                .zip(loads)
                .map(|(r, w)| r.velocity.dot(&w.force) + r.spin.dot(&w.moment))
                .sum()
        };
        // Of blocks that turn equally fast, but for rounding, the first.
        let fastest = rates.iter().map(|r| r.spin.norm()).fold(0.0, f64::max);
        let lead = rates.iter().position(|r| r.spin.norm() >= (1.0 - REST) * fastest);
        let Some(lead) = lead.filter(|_| fastest > 0.0) else {
            return Err(refuse(format!("{sense}: nothing rotates in the mechanism")));
        };
        let sign = power(&rates, true).signum();
        rates.iter_mut().for_each(|r| {
            r.velocity *= sign / fastest;
            r.spin *= sign / fastest;
        });
        let own = -power(&rates, false) / power(&rates, true);
        let Some(value) = proof.value else {
            return Err(refuse(format!("{sense}: no load factor was found")));
        };
        if (own - value).abs() > SAME * value.abs() {
            return Err(refuse(format!(
                "{sense}: the linkage has the load factor {own:.9}, the proved one is {value:.9}"
            )));
        }
        let axis = rates[lead].spin;
        let closed = next.closed;
        Ok(Some(Self { model, masses, carried, closed, rates, lead, axis, which }))
    }

    /// The block whose centre moves fastest.
    pub fn fastest(&self) -> usize {
        let speed = |i: usize| self.rates[i].velocity.norm();
        let most = (0..self.rates.len()).map(speed).fold(0.0, f64::max);
        (0..self.rates.len()).find(|&i| speed(i) >= (1.0 - REST) * most).unwrap_or_default()
    }

    pub fn law(
        &self,
        axes: &[Vector3<f64>; 3],
        control: (usize, Vector3<f64>),
        notes: &mut Vec<String>,
    ) -> Result<Lawful, InputError> {
        let drive = drive();
        let linkage = Linkage::new(&self.carried, &self.closed, &[], &drive);
        let start = linkage.place(&vec![Pose::start(); self.rates.len()]);
        let at = |near: &Configuration, angle: f64| -> Option<(Configuration, [f64; 6])> {
            let place = linkage.turn(near, &Turned { block: self.lead, axis: self.axis, angle })?;
            (place.free.ncols() == 1).then_some(())?;
            let mut rates = linkage.rates(&place, &place.free.column(0).into_owned());
            let speed = rates[self.lead].spin.dot(&self.axis);
            rates.iter_mut().for_each(|r| {
                r.velocity /= speed;
                r.spin /= speed;
            });
            let numbers = self.numbers(&place.poses, &rates, axes, control);
            numbers.iter().all(|v| v.is_finite()).then_some((place, numbers))
        };
        let (law, end) = table::law(&start, &at).ok_or_else(|| {
            refuse("the linkage of the mechanism cannot be followed from its start".into())
        })?;
        let quarter = std::f64::consts::FRAC_PI_2;
        if end < quarter {
            notes.push(format!(
                "{}: the linkage was followed up to a rotation of {:.4} rad of {}; beyond this it counts as overturned",
                ["towards the direction", "against the direction"][self.which],
                end,
                self.model.assembly.blocks[self.lead].id
            ));
        }
        let sense = Sense::new(law, end);
        let mut bodies: Vec<(usize, usize)> = Vec::new();
        for (i, &b) in linkage.bodies().iter().enumerate() {
            if self.rates[i] == Rate::zero() || self.model.assembly.blocks[i].support {
                continue;
            }
            match bodies.iter_mut().find(|x| x.0 == b) {
                Some(x) => x.1 += 1,
                None => bodies.push((b, 1)),
            }
        }
        Ok(Lawful { sense, bodies: bodies.into_iter().map(|b| b.1).collect() })
    }

    /// Inertia, resistance, grip along three axes, and way of the control point.
    fn numbers(
        &self,
        poses: &[Pose],
        rates: &[Rate],
        axes: &[Vector3<f64>; 3],
        control: (usize, Vector3<f64>),
    ) -> [f64; 6] {
        let assembly = &self.model.assembly;
        let [dead, _] = assembly.loads_at(poses);
        let mut n = [0.0; 6];
        for i in assembly.free() {
            let (b, r) = (&assembly.blocks[i], &rates[i]);
            let local = poses[i].turn.inverse() * r.spin;
            n[0] += b.mass * r.velocity.norm_squared() + local.dot(&(b.inertia * local));
            n[1] -= dead[i].force.dot(&r.velocity) + dead[i].moment.dot(&r.spin);
            (0..3).for_each(|k| n[2 + k] += b.mass * axes[k].dot(&r.velocity));
        }
        for m in self.masses {
            let r = &rates[m.block];
            let velocity = r.velocity + r.spin.cross(&(poses[m.block].turn * m.arm));
            n[0] += m.mass * velocity.norm_squared();
            (0..3).for_each(|k| n[2 + k] += m.mass * axes[k].dot(&velocity));
        }
        let (block, point) = control;
        n[5] = axes[0].dot(&poses[block].way(&assembly.blocks[block].centroid, &point));
        n
    }
}

/// A push; its point does not matter for what starts.
fn drive() -> Drive {
    Drive::Push { block: 0, point: Vector3::zeros(), toward: Vector3::x() }
}

/// What is left of the speed when one sense ends and the other begins.
pub(super) fn restitution(sides: &[Option<Side>; 2]) -> [f64; 2] {
    let [Some(a), Some(b)] = sides else { return [0.0; 2] };
    let product = |one: &[Rate], other: &[Rate]| -> f64 {
        let assembly = &a.model.assembly;
        let blocks = assembly.free().map(|i| {
            let b = &assembly.blocks[i];
            b.mass * one[i].velocity.dot(&other[i].velocity)
                + one[i].spin.dot(&(b.inertia * other[i].spin))
        });
        let beside = a.masses.iter().map(|m| {
            let [v, w] = [one, other].map(|r| r[m.block].velocity + r[m.block].spin.cross(&m.arm));
            m.mass * v.dot(&w)
        });
        blocks.chain(beside).sum()
    };
    // The motion that ends goes back: its rates are those of its sense, the other way.
    let cross = -product(&a.rates, &b.rates);
    [cross / product(&b.rates, &b.rates), cross / product(&a.rates, &a.rates)]
}

/// How far the machine is the scene.
pub(super) fn exactness(sides: &[Option<Side>; 2], built: &[Option<Lawful>]) -> Exactness {
    let free = sides[0].as_ref().map_or(0, |s| s.model.assembly.free().count());
    let ideal = |text: &str| Exactness::Idealised(text.into());
    for lawful in built.iter().flatten() {
        if lawful.bodies.iter().any(|&n| n > 1) {
            return ideal("blocks that stay together at first are held together all the time");
        }
        if lawful.bodies.len() < free {
            return ideal("blocks that rest at first are held at rest all the time");
        }
        if !matches!(lawful.sense.law, Law::Circular(_)) {
            return ideal("the hinges of the first instant are kept all the time");
        }
    }
    if sides.iter().any(Option::is_none) {
        return ideal("the impact on what holds it in the other sense has no law of its own");
    }
    Exactness::Exact
}

/// The least distance between two parallel planes that hold a block, one of them a facet's, m.
pub(super) fn thickness(block: &Block) -> f64 {
    match &block.solid {
        Solid::Polyhedron(p) => {
            let depth = |n: &Vector3<f64>| {
                let heights = || p.vertices.iter().map(|v| n.dot(&(v - block.centroid)));
                heights().fold(f64::NEG_INFINITY, f64::max)
                    - heights().fold(f64::INFINITY, f64::min)
            };
            p.facets.iter().map(|f| depth(&f.normal)).fold(block.size, f64::min)
        }
        Solid::Sphere { radius, .. } => 2.0 * radius,
        Solid::Clump { balls, .. } => 2.0 * balls.iter().map(|b| b.1).fold(f64::INFINITY, f64::min),
    }
}
