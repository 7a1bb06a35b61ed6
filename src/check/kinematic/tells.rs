//! What a mechanism leaves open: whether the joints that it keeps closed allow another one.
//!
//! A mechanism that opens as many joints as any that is as bad (which interior points find) leaves
//! one motion only where it is the only one. With more, δ, e* and all that follows are those of one
//! among several that start at the same load factor.

use crate::verdict::{Rate, certificate, member};
use base::{plane::Sets, tolerance};
use model::interface::Model;
use nalgebra::{DMatrix, Vector3};
use scene::Friction;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Whether a mechanism is the only one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Unique {
    /// The joints that it keeps closed allow no other.
    Only,
    /// They allow others, which start at the same load factor.
    OneOfSeveral,
    /// Too many bodies move to tell.
    Unknown,
}

/// With more bodies the motions that they are left with are not counted: it takes minutes.
const MOST_BODIES: usize = 120;
/// Singular values below this × the greatest are free motions. Larger: stiff linkages of unequal
/// bodies are loose. Smaller: rates known to 1e-9 hold joints apart that are closed.
const FREE: f64 = 1e-7;

/// Bodies and what ties them together.
struct Bodies<'a> {
    model: &'a Model,
    rates: &'a [Rate],
    rest: f64,
    /// The body of each block; none where it rests.
    of: Vec<Option<usize>>,
    centers: Vec<Vector3<f64>>,
    /// What spins are multiplied by, m.
    length: f64,
    rows: Vec<Vec<(usize, f64)>>,
}

/// Below this speed a block rests, m/s of the rates.
fn resting(model: &Model, rates: &[Rate]) -> f64 {
    let assembly = &model.assembly;
    let speed = |i: usize| certificate::speed(assembly, i, &rates[i]);
    tolerance::MECHANISM_REST * assembly.free().map(speed).fold(0.0, f64::max)
}

/// The body that each block moves with, and one block of each: blocks whose joints stay closed all
/// over are one. What rests has none.
pub fn bodies(model: &Model, rates: &[Rate]) -> (Vec<Option<usize>>, Vec<usize>) {
    let assembly = &model.assembly;
    let speed = |i: usize| certificate::speed(assembly, i, &rates[i]);
    let rest = resting(model, rates);
    let still = |i: usize| assembly.blocks[i].support || speed(i) <= rest;
    let mut sets = Sets::new(assembly.blocks.len());
    for f in model.interfaces.list.iter().filter(|f| !still(f.a) && !still(f.b)) {
        let parts = f.points.iter().any(|p| relative(model, rates, f.a, f.b, p).norm() > rest);
        if !parts && f.points.len() >= 3 {
            sets.join(f.a, f.b);
        }
    }
    let mut leads: Vec<usize> = Vec::new();
    let of: Vec<Option<usize>> = (0..assembly.blocks.len())
        .map(|i| {
            (!still(i)).then(|| {
                let lead = sets.find(i);
                leads.iter().position(|&l| l == lead).unwrap_or_else(|| {
                    leads.push(lead);
                    leads.len() - 1
                })
            })
        })
        .collect();
    (of, leads)
}

/// Whether the joints that a mechanism keeps closed allow no other.
pub fn is_unique(model: &Model, rates: &[Rate]) -> Unique {
    let assembly = &model.assembly;
    let rest = resting(model, rates);
    let (of, leads) = bodies(model, rates);
    if leads.len() > MOST_BODIES {
        return Unique::Unknown;
    }
    let length = leads.iter().map(|&i| assembly.blocks[i].size).fold(0.0, f64::max);
    let centers = leads.iter().map(|&i| assembly.blocks[i].centroid).collect();
    let mut bodies = Bodies { model, rates, rest, of, centers, length, rows: Vec::new() };
    bodies.joints();
    bodies.members();
    if bodies.free() > 1 { Unique::OneOfSeveral } else { Unique::Only }
}

/// Velocity of block `b` against block `a` at a point.
fn relative(model: &Model, rates: &[Rate], a: usize, b: usize, p: &Vector3<f64>) -> Vector3<f64> {
    crate::verdict::at(&model.assembly, rates, b, p)
        - crate::verdict::at(&model.assembly, rates, a, p)
}

impl Bodies<'_> {
    /// `direction · (velocity of b − velocity of a)` at a point is zero.
    fn row(
        &mut self,
        [a, b]: [Option<usize>; 2],
        at: &Vector3<f64>,
        direction: &Vector3<f64>,
    ) -> Vec<(usize, f64)> {
        let mut row = Vec::new();
        for (block, sign) in [(a, -1.0), (b, 1.0)] {
            let Some(body) = block.and_then(|i| self.of[i]) else { continue };
            let arm = (at - self.centers[body]) / self.length;
            let turn = arm.cross(direction);
            row.extend((0..3).map(|k| (6 * body + k, sign * direction[k])));
            row.extend((0..3).map(|k| (6 * body + 3 + k, sign * turn[k])));
        }
        row
    }

    fn joints(&mut self) {
        let model = self.model;
        for f in &model.interfaces.list {
            if self.of[f.a] == self.of[f.b] {
                continue;
            }
            for p in &f.points {
                let v = relative(model, self.rates, f.a, f.b, p);
                let vn = f.frame.n.dot(&v);
                let along = v - f.frame.n * vn;
                let (mu, infinite) = match f.law.friction {
                    Friction::Coefficient(mu) => (mu, false),
                    Friction::Infinite => (0.0, true),
                };
                if vn - mu * along.norm() > self.rest {
                    continue;
                }
                let ends = [Some(f.a), Some(f.b)];
                if along.norm() <= self.rest {
                    let fixed = if mu > 0.0 || infinite {
                        vec![f.frame.n, f.frame.t1, f.frame.t2]
                    } else {
                        vec![f.frame.n]
                    };
                    for direction in fixed {
                        let row = self.row(ends, p, &direction);
                        self.rows.push(row);
                    }
                } else {
                    // It slides along one direction, and opens with it as associative friction
                    // does.
                    let way = along.normalize();
                    let across = f.frame.n.cross(&way);
                    let lift = f.frame.n - way * (vn / along.norm());
                    for direction in [across, lift] {
                        let row = self.row(ends, p, &direction);
                        self.rows.push(row);
                    }
                }
            }
        }
    }

    /// Members that neither lengthen nor shorten hold their ends apart.
    fn members(&mut self) {
        let model = self.model;
        for m in model.interfaces.members.iter().filter(|m| !m.is_idle()) {
            let power = member::power(&model.assembly, m, self.rates);
            let legs = member::legs(m);
            for axis in 0..3 {
                if power[axis].abs() > self.rest || !legs.iter().any(|l| l.axis == axis) {
                    continue;
                }
                let mut all = Vec::new();
                for leg in legs.iter().filter(|l| l.axis == axis) {
                    let row = self.row([leg.a, leg.b], &leg.at, &leg.direction);
                    all.extend(row);
                }
                self.rows.push(all);
            }
        }
    }

    /// How many motions are free.
    fn free(&self) -> usize {
        let unknowns = 6 * self.centers.len();
        let mut gram = DMatrix::<f64>::zeros(unknowns, unknowns);
        for row in self.rows.iter().filter(|r| !r.is_empty()) {
            for &(i, a) in row {
                for &(j, b) in row {
                    gram[(i, j)] += a * b;
                }
            }
        }
        let values = gram.symmetric_eigenvalues();
        let greatest = values.iter().copied().fold(0.0, f64::max);
        values.iter().filter(|v| **v <= FREE * FREE * greatest).count()
    }
}
