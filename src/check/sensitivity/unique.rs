//! Whether all forces and all mechanisms that prove a load factor give it the same derivative.
//!
//! Given forces `f` and rates `q` that prove λ, every other such mechanism keeps closed what `f`
//! presses and slides the way in which `f` lies on its friction cone: `D q' = 0`. Every other such
//! forces press nowhere where `q` opens, and along one direction where it slides; they are `f` plus
//! columns of `Cᵀ`, and balance the same loads. The derivative is linear in either. It is the same
//! for all `q'` where its gradient `h` lies in the rows of `D`, and the same for all `f'` where its
//! gradient `g` is `C y` for some motion `y`. Corners of which neither rates nor forces tell anything
//! count as free on both sides, so that what is said to be the same is, up to rounding.
//!
//! Blocks that are held together are one body ([`bodies`](super::bodies)).

use super::{
    bodies::{Bodies, Row, dot, norm, spans},
    lagrangian::{Change, Pair, Proof, nearest, turn},
    numbers::Number,
    varied::Varied,
};
use crate::verdict::{
    at, certificate,
    joint::{Strength, rolling_arm},
    member::{self, Bounds},
};
use base::tolerance;
use model::{
    assembly::Assembly,
    interface::{Interface, Model},
};
use nalgebra::Vector3;
use scene::{Friction, Touches};

/// What forces and mechanisms leave open of a derivative, × itself, up to which it is one. Larger:
/// bends are overlooked. Smaller: rounding is taken for one.
const ONE: f64 = 3e-5;
/// Derivatives by which a number changed by its own size changes λ by less than this × λ count as
/// nothing.
const NOTHING: f64 = 1e-5;
/// The same below which they are rounding, and zero.
const ZERO: f64 = 1e-8;
/// Forces below this × the load of the lesser block press nothing, as do those below [`ROUNDING`] ×
/// the greatest force. Larger: small blocks on large ones are loose. Smaller: what solvers leave of
/// open joints holds them closed.
const PRESSES: f64 = 1e-6;
/// See [`PRESSES`].
const ROUNDING: f64 = 1e-9;
/// What of a gradient other mechanisms change counts from this × the share of the forces that holds
/// nothing. Larger: bends are overlooked. Smaller: what solvers leave of open joints is one.
const STRAYS: f64 = 3.0;
/// A force lies on its cone where it has less room to it than this × itself.
const ON_CONE: f64 = 1e-4;

/// What a corner of a joint may do beside what it does.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Free {
    /// Any force.
    Force,
    /// A normal force without friction.
    Normal,
    /// A force along the joint, whose normal force is that at which it crushes.
    Tangent,
    /// A force along one direction, as it slides this way.
    Slides(Vector3<f64>),
    /// None: it opens, or crushes as it slides.
    Nothing,
}

/// A corner beside the others.
struct Corner {
    free: Free,
    /// Its force is inside its cone: it neither opens nor slides.
    held: bool,
    /// Its force is on its cone, which lets it slide this way.
    may: Option<Vector3<f64>>,
    /// What of its force is neither: what solvers leave, N.
    stray: Vector3<f64>,
}

/// Forces and mechanisms beside those of a proof.
pub struct Faces<'a> {
    proof: &'a Proof<'a>,
    corners: Vec<Vec<Corner>>,
    /// Joints roll, or members slide: nothing is said.
    unclear: bool,
    /// Motions that the forces allow.
    rates: Bodies,
    /// Motions against which forces that the mechanism allows have no power.
    forces: Bodies,
    /// Size of the forces between the bodies, N.
    size: f64,
    /// What of the forces holds nothing, × all of them.
    stray: f64,
}

impl<'a> Faces<'a> {
    /// Those of a proof.
    pub fn new(proof: &'a Proof<'a>) -> Self {
        let corners = corners(proof);
        let interfaces = &proof.model.interfaces;
        let is_one = |index: usize, is_held: &dyn Fn(&Corner) -> bool| {
            let points = &interfaces.list[index].points;
            let held = points.iter().zip(&corners[index]).filter(|(_, c)| is_held(c));
            spans(&held.map(|(p, _)| *p).collect::<Vec<_>>())
        };
        let bodies = |is_held: &dyn Fn(&Corner) -> bool| {
            let joined = (0..interfaces.list.len()).filter(|k| is_one(*k, is_held));
            Bodies::new(proof.model, joined)
        };
        let rates = bodies(&|c| c.held);
        let forces = bodies(&|c| c.free == Free::Force);
        let mut own = Self { proof, corners, unclear: false, rates, forces, size: 0.0, stray: 0.0 };
        let (mut held, mut open) = (Vec::new(), Vec::new());
        for index in 0..interfaces.list.len() {
            own.joint(index, &mut held, &mut open);
        }
        own.members(&mut held, &mut open);
        own.stray = own.strays();
        own.rates.solved(held);
        own.forces.solved(open);
        own
    }

    fn joint(&mut self, index: usize, held: &mut Vec<Row>, open: &mut Vec<Row>) {
        let (proof, face) = (self.proof, &self.proof.model.interfaces.list[index]);
        let mu = friction(face);
        let rolls = proof.corners(index).iter().any(|c| c.rolling > 0.0);
        self.unclear |= rolling_arm(face) > 0.0 && rolls;
        let ends = [Some(face.a), Some(face.b)];
        let frame = face.frame;
        let axes = [frame.n, frame.t1, frame.t2];
        if proof.crushes(index) && !self.rates.are_one(ends) {
            held.extend(self.rates.proportional(proof, face));
        }
        for (k, point) in face.points.iter().enumerate() {
            let corner = &self.corners[index][k];
            if !self.forces.are_one(ends) {
                let row = |d: &Vector3<f64>| self.forces.row(ends, point, d);
                match corner.free {
                    Free::Nothing => {}
                    Free::Normal => open.push(row(&frame.n)),
                    Free::Tangent => open.extend(axes[1..].iter().map(row)),
                    Free::Slides(way) => open.push(row(&(frame.n - way * mu))),
                    Free::Force => open.extend(axes.iter().map(row)),
                }
                if corner.free != Free::Nothing {
                    self.size = self.size.hypot(proof.forces[index][k].force.norm());
                }
            }
            if self.rates.are_one(ends) {
                continue;
            }
            let row = |d: &Vector3<f64>| self.rates.row(ends, point, d);
            match (corner.held, corner.may) {
                (true, _) => held.extend(axes.iter().map(row)),
                (false, Some(_)) if corner.free == Free::Normal => held.push(row(&frame.n)),
                (false, Some(way)) => {
                    held.extend([row(&frame.n.cross(&way)), row(&(frame.n - way * mu))]);
                }
                (false, None) => {}
            }
        }
    }

    /// What forces of open joints, and forces beside their cones, leave on the bodies, over what all
    /// forces do there: no gradient is known better.
    fn strays(&self) -> f64 {
        let (mut all, mut stray) = (self.rates.nothing(), self.rates.nothing());
        for (index, face) in self.proof.model.interfaces.list.iter().enumerate() {
            let ends = [Some(face.a), Some(face.b)];
            if self.rates.are_one(ends) {
                continue;
            }
            for (k, point) in face.points.iter().enumerate() {
                let force = self.proof.forces[index][k].force;
                put(&mut all, self.rates.row(ends, point, &force), 1.0);
                let own = &self.corners[index][k].stray;
                put(&mut stray, self.rates.row(ends, point, own), 1.0);
            }
        }
        if norm(&all) > 0.0 { norm(&stray) / norm(&all) } else { 0.0 }
    }

    fn members(&mut self, held: &mut Vec<Row>, open: &mut Vec<Row>) {
        let proof = self.proof;
        let Model { assembly, interfaces, .. } = proof.model;
        let list = interfaces.members.iter().zip(proof.forces.iter().skip(interfaces.list.len()));
        for (own, forces) in list.filter(|(m, _)| !m.is_idle()) {
            let u = member::power(assembly, own, proof.rates);
            let amounts = member::amounts(forces);
            let bounds = Bounds::of(own);
            let moves = u.norm() > tolerance::MECHANISM_REST * proof.fastest;
            // A cone that slides, a disc that yields.
            self.unclear |= moves && !matches!(bounds, Bounds::Range(..));
            if moves {
                continue;
            }
            let inside = bounds.margin(&amounts) > ON_CONE * amounts.norm();
            let legs = member::legs(own);
            for axis in 0..bounds.axes() {
                let row = |bodies: &Bodies| {
                    let legs = legs.iter().filter(|l| l.axis == axis);
                    legs.flat_map(|l| bodies.row([l.a, l.b], &l.at, &l.direction)).collect()
                };
                if inside {
                    held.push(row(&self.rates));
                }
                open.push(row(&self.forces));
            }
            self.size = self.size.hypot(amounts.norm());
        }
    }

    /// Change of the load factor per unit of a number, and whether all that proves it gives the same;
    /// nothing where there is no such scene with the same joints.
    pub fn slope(&self, varied: &Varied, number: &Number) -> Option<(f64, bool)> {
        let proof = self.proof;
        let pair = proof.beside(varied, number);
        let change = proof.change(&pair);
        let slope = proof.slope_of(varied, &change)?;
        let least = proof.value.abs() / varied.scale(number);
        let allowed = (ONE * slope.abs()).max(NOTHING * least) * proof.live;
        let one = !self.unclear
            && self.is_one_by_rates(&pair, &change, allowed)
            && self.open_by_forces(&pair, number) <= allowed;
        Some((if slope.abs() <= ZERO * least { 0.0 } else { slope }, one))
    }

    /// Whether other mechanisms of the size of this one change the derivative by no more than what is
    /// allowed, W, or than what of the forces is not known.
    fn is_one_by_rates(&self, pair: &Pair, change: &Change, allowed: f64) -> bool {
        let (proof, bodies) = (self.proof, &self.rates);
        let assembly = &proof.model.assembly;
        let mut h = bodies.nothing();
        let mut live = bodies.nothing();
        for i in assembly.free() {
            bodies.add(&mut h, assembly, i, &change.loads[i], -1.0);
            bodies.add(&mut live, assembly, i, &assembly.live[i], 1.0);
        }
        for (model, by) in pair.sides(proof.model) {
            self.add_room(&mut h, model, by);
        }
        // No motion at the same power of the live load changes it: what this one has is taken away.
        let own = bodies.rates(proof.rates);
        let by = dot(&h, &own) / proof.live;
        h.iter_mut().zip(&live).for_each(|(h, l)| *h -= by * l);
        let open = norm(&bodies.outside_rows(&h));
        open * norm(&own) <= allowed || open <= STRAYS * self.stray * norm(&h)
    }

    /// What friction and strengths leave, by the rates: these slide and open where they do.
    fn add_room(&self, h: &mut [f64], model: &Model, by: f64) {
        let (proof, own) = (self.proof, &self.proof.model.interfaces);
        for (index, (f, g)) in own.list.iter().zip(&model.interfaces.list).enumerate() {
            if f.law == g.law && f.points == g.points {
                continue;
            }
            let ends = [Some(f.a), Some(f.b)];
            if proof.crushes(index) {
                let more = proof.room_of(index, g) - proof.room_of(index, f);
                put(h, self.rates.along(proof, f), by * more);
                continue;
            }
            let (before, after) = (Strength::of(f), Strength::of(g));
            for (k, point) in f.points.iter().enumerate() {
                let (n, corner) = (f.frame.n, proof.corners(index)[k]);
                let there = nearest(point, g);
                let more = [0, 1].map(|i| after.at(there)[i] - before.at(k)[i]);
                let normal = n.dot(&proof.forces[index][k].force);
                let along = corner.velocity - n * n.dot(&corner.velocity);
                let way = if corner.sliding > 0.0 { along / corner.sliding } else { along };
                let shear = (friction(g) - friction(f)) * normal + more[0];
                let opens = if corner.opening > 0.0 { more[1] } else { 0.0 };
                let d = way * shear + (n - way * friction(f)) * opens;
                if d != Vector3::zeros() {
                    put(h, self.rates.row(ends, point, &d), by);
                }
            }
        }
        // Members yield one way, at a force of their own.
        for (m, other) in own.members.iter().zip(&model.interfaces.members) {
            let (Bounds::Range(low, high), Bounds::Range(least, most)) =
                (Bounds::of(m), Bounds::of(other))
            else {
                continue;
            };
            let u = member::power(&proof.model.assembly, m, proof.rates).x;
            // What it takes up is `most × (−u)⁺` and `−least × u⁺`.
            let force = if u < 0.0 { high - most } else { low - least };
            if u == 0.0 || force == 0.0 || !force.is_finite() {
                continue;
            }
            for leg in member::legs(m) {
                put(h, self.rates.row([leg.a, leg.b], &leg.at, &leg.direction), by * force);
            }
        }
    }

    /// By how much other forces, as large as these, change the derivative, W.
    fn open_by_forces(&self, pair: &Pair, number: &Number) -> f64 {
        let proof = self.proof;
        let sides = pair.sides(proof.model);
        let mut g = Vec::new();
        let mut touched = false;
        for (index, f) in proof.model.interfaces.list.iter().enumerate() {
            if self.forces.are_one([Some(f.a), Some(f.b)]) {
                continue;
            }
            let changes = number.touches == Touches::Shapes
                || sides.iter().any(|(m, _)| friction(&m.interfaces.list[index]) != friction(f));
            touched |= changes;
            let n = f.frame.n;
            for (k, own) in self.corners[index].iter().enumerate() {
                let (mut d, mut lift) = (Vector3::zeros(), 0.0);
                for (model, by) in sides.iter().filter(|_| changes) {
                    let other = &model.interfaces.list[index];
                    let velocity = velocity(&model.assembly, proof, other, &f.points[k]);
                    d -= turn(f, other).inverse() * velocity * *by;
                    lift += by * friction(other) * proof.corners(index)[k].sliding;
                }
                let along = |axis: &Vector3<f64>| axis.dot(&d);
                match own.free {
                    Free::Nothing => {}
                    Free::Normal => g.push(along(&n)),
                    Free::Tangent => g.extend([f.frame.t1, f.frame.t2].iter().map(along)),
                    Free::Slides(way) => g.push(along(&(n - way * friction(f))) + lift),
                    Free::Force => g.extend([n, f.frame.t1, f.frame.t2].iter().map(along)),
                }
            }
        }
        if !touched {
            return 0.0;
        }
        norm(&self.forces.outside_columns(g)) * self.size
    }
}

/// Adds an equation to factors of rates.
fn put(into: &mut [f64], row: Row, by: f64) {
    for (body, factors) in row {
        (0..6).for_each(|i| into[6 * body + i] += by * factors[i]);
    }
}

/// What the corners of all joints may do.
fn corners(proof: &Proof) -> Vec<Vec<Corner>> {
    let Model { assembly, interfaces, .. } = proof.model;
    let rest = tolerance::MECHANISM_REST * proof.fastest;
    let greatest = proof.forces.iter().flatten().map(|w| w.force.norm()).fold(0.0, f64::max);
    let load = |i: usize| match assembly.blocks[i].support {
        true => f64::INFINITY,
        false => certificate::load_scale(assembly, i),
    };
    let of = |(index, face): (usize, &Interface)| {
        let strength = Strength::of(face);
        let least = (PRESSES * load(face.a).min(load(face.b))).max(ROUNDING * greatest);
        let (n, mu) = (face.frame.n, friction(face));
        let rough = face.law.friction == Friction::Infinite;
        let crushes = proof.crushes(index);
        let one = |k: usize| {
            let corner = proof.corners(index)[k];
            let force = proof.forces[index][k].force;
            let [cohesion, tension] = strength.at(k);
            let normal = n.dot(&force) + tension;
            let shear = force - n * n.dot(&force);
            let room = mu * n.dot(&force) + cohesion - shear.norm();
            let slides = corner.sliding > rest;
            let way = match shear.norm() > least {
                _ if slides => (corner.velocity - n * n.dot(&corner.velocity)) / corner.sliding,
                true => -shear / shear.norm(),
                false => Vector3::zeros(),
            };
            let free = match () {
                () if crushes && slides => Free::Nothing,
                () if crushes => Free::Tangent,
                () if corner.opening > rest => Free::Nothing,
                () if mu == 0.0 && cohesion == 0.0 && !rough => Free::Normal,
                () if slides => Free::Slides(way),
                () => Free::Force,
            };
            let presses = normal > least || (rough && shear.norm() > least);
            let presses = presses && !crushes && free != Free::Nothing;
            let inside = rough || room > ON_CONE * force.norm().max(normal);
            let held = presses && free == Free::Force && inside;
            let stray = match () {
                () if held || crushes => Vector3::zeros(),
                () if !presses => force + n * tension,
                () if free == Free::Normal => shear,
                () => shear + way * (mu * n.dot(&force) + cohesion),
            };
            Corner { free, held, may: Some(way).filter(|_| presses && !held), stray }
        };
        (0..face.points.len()).map(one).collect()
    };
    interfaces.list.iter().enumerate().map(of).collect()
}

/// Coefficient of friction; none where nothing slides.
fn friction(face: &Interface) -> f64 {
    match face.law.friction {
        Friction::Coefficient(mu) => mu,
        Friction::Infinite => 0.0,
    }
}

/// Velocity of a joint of another scene at the corner that is next to a point, by the rates of a proof.
fn velocity(
    assembly: &Assembly,
    proof: &Proof,
    other: &Interface,
    point: &Vector3<f64>,
) -> Vector3<f64> {
    let p = &other.points[nearest(point, other)];
    at(assembly, proof.rates, other.b, p) - at(assembly, proof.rates, other.a, p)
}
