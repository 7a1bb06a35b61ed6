//! Programs C and D: dry friction without dilatancy.
//!
//! *Law.* At each contact point, with `u` the rate of the joint (opening positive): `u_n ≥ 0 ⟂ f_n ≥ 0` (Signorini) and
//! `‖f_t‖ ≤ μ f_n`, `f_t` against `u_t` and at its limit where `u_t ≠ 0` (Coulomb). Sliding does not open the joint, so there
//! is no energy to minimise; with the friction limits `s` held fixed there is (Tresca), and Coulomb's law is `s = μ f_n`.
//!
//! *State (C).* `min ½ fᵀ C f + (1/2ε) ‖A f + w‖²` subject to `f_n ≥ 0`, `‖f_t‖ ≤ s`: always feasible, what cannot balance
//! accelerates. `C` is a contact compliance (mean area / area of the point), which picks among admissible forces those that the
//! loads produce; forces are in mean block loads, rows scaled by each block's load. The rate of a joint is the gradient,
//! `u = C f + Aᵀ (A f + w) / ε`.
//!
//! *Load factor (D).* `max λ − ½ δ fᵀ C f` subject to `A f + w + λ ℓ = 0` and the same limits; `u = δ C f + Aᵀ y` with the
//! multipliers `y`.
//!
//! *Twin (De Saxcé & Feng 1998).* `f` in the friction cone with a linear term `μ‖u_t‖ f_n`: the fixed point is in the sliding
//! rates instead of the limits. It serves as a second opinion; where dilatancy jams it does not settle.
//! Sources: Haslinger 1983 (fixed point on the Tresca limit), Acary, Brémond & Huber 2018 (natural map), Gilbert, Casapulla &
//! Ahmed 2006 (sequence of convex programs for non-associative limit analysis).

use super::{Cone, ConicProgram, Options, Statics, unbalance::copy};
use crate::{assembly::Assembly, interface::Interfaces, scene::Friction};

/// A contact point of programs C and D.
#[derive(Clone, Debug)]
pub struct Point {
    /// First column of its forces `(f_n, f_t…)`.
    pub column: usize,
    /// Number of tangential components: 0, 1 or 2.
    pub tangents: usize,
    /// Coefficient of friction; infinite where sliding is excluded.
    pub mu: f64,
}

/// The equilibrium in normal and tangential forces, in mean block loads, with the compliance of the contacts.
#[derive(Clone, Debug)]
pub struct Contacts {
    /// Equilibrium, columns `(f_n, f_t…)` per point, unit = mean block load.
    pub statics: Statics,
    /// The contact points in column order.
    pub points: Vec<Point>,
    /// Compliance of each column.
    pub compliance: Vec<f64>,
}

/// How friction is held fixed in one convex program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hold {
    /// The limit `s` of the tangential force (Tresca).
    Limits,
    /// The sliding rate `μ‖u_t‖` (De Saxcé).
    SlidingRates,
}

/// What is asked of a program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Aim {
    /// C: the state, with this ε.
    State(f64),
    /// D: the load factor, with this δ and live load multiplied by the second number.
    LoadFactor(f64, f64),
}

impl Contacts {
    /// Builds the contacts of an assembly.
    ///
    /// A plane scene is solved as plane only where every interface is wholly represented by its two ends: the compliance of
    /// inner points would be lost.
    pub fn new(assembly: &Assembly, interfaces: &Interfaces, keep_all: bool, live: bool) -> Self {
        let options = Options { keep_all, live, split: true };
        let mut statics = Statics::new(assembly, interfaces, options);
        if statics.plane.is_some() && !ends_are_all(&statics, interfaces) {
            statics = Statics::new(assembly, interfaces, Options { keep_all: true, ..options });
        }
        let mean = statics.free.iter().map(|f| f.weight).sum::<f64>() / statics.free.len().max(1) as f64;
        statics.rescale(mean / statics.unit, false);
        let share = |b: &super::Bearing| {
            let face = &interfaces.list[b.interface];
            let points = if b.points[0] == b.points[1] { 1.0 } else { 2.0 };
            face.area * points / face.points.len() as f64
        };
        let areas: Vec<f64> = statics.bearings.iter().map(share).collect();
        let with_area: Vec<f64> = areas.iter().copied().filter(|&a| a > 0.0).collect();
        let mean_area = with_area.iter().sum::<f64>() / with_area.len().max(1) as f64;
        let mut compliance = Vec::with_capacity(statics.matrix.columns);
        let points = statics
            .bearings
            .iter()
            .zip(&areas)
            .map(|(b, &area)| {
                // Edges and points have no area; they count as an average contact.
                let c = if area > 0.0 { mean_area / area } else { 1.0 };
                compliance.extend(std::iter::repeat_n(c, b.basis.len()));
                let mu = match interfaces.list[b.interface].friction {
                    Friction::Coefficient(mu) => mu,
                    Friction::Infinite => f64::INFINITY,
                };
                Point { column: b.column, tangents: b.basis.len() - 1, mu }
            })
            .collect();
        Self { statics, points, compliance }
    }

    /// One convex program of the sequence; `held` are the limits or the sliding rates per point.
    pub fn program(&self, aim: Aim, hold: Hold, held: &[f64]) -> ConicProgram {
        let (rows, forces) = (self.statics.matrix.rows, self.statics.matrix.columns);
        let extra = match aim {
            Aim::State(_) => rows,
            Aim::LoadFactor(..) => 1,
        };
        let mut p = ConicProgram::new(forces + extra);
        let weight = if let Aim::LoadFactor(delta, _) = aim { delta } else { 1.0 };
        p.quadratic = self.compliance.iter().map(|c| c * weight).collect();
        p.cone(Cone::Zero(rows));
        copy(&mut p, &self.statics, 0, 0);
        match aim {
            Aim::State(epsilon) => {
                p.quadratic.resize(forces + rows, 1.0 / epsilon);
                for row in 0..rows {
                    p.matrix.push(row, forces + row, 1.0);
                }
            }
            Aim::LoadFactor(_, scale) => {
                p.quadratic.push(0.0);
                p.objective[forces] = -1.0;
                for row in 0..rows {
                    p.matrix.push(row, forces, scale * self.statics.live[row]);
                }
            }
        }
        for row in 0..rows {
            p.rhs[row] = -self.statics.dead[row];
        }
        match hold {
            Hold::Limits => self.limit_cones(&mut p),
            Hold::SlidingRates => self.friction_cones(&mut p),
        }
        self.hold(&mut p, hold, held);
        p
    }

    /// Puts new limits or sliding rates into a program made by [`Self::program`].
    pub fn hold(&self, p: &mut ConicProgram, hold: Hold, held: &[f64]) {
        match hold {
            Hold::Limits => {
                let mut row = self.statics.matrix.rows + self.points.len();
                for (point, &s) in self.points.iter().zip(held) {
                    match (point.tangents, point.mu.is_finite()) {
                        (1, true) => {
                            p.rhs[row] = s;
                            p.rhs[row + 1] = s;
                            row += 2;
                        }
                        (2, true) => {
                            p.rhs[row] = s;
                            row += 3;
                        }
                        _ => {}
                    }
                }
            }
            Hold::SlidingRates => {
                for (point, &rate) in self.points.iter().zip(held) {
                    p.objective[point.column] = rate;
                }
            }
        }
    }

    /// `f_n ≥ 0` for all points, then `‖f_t‖ ≤ s` point by point.
    fn limit_cones(&self, p: &mut ConicProgram) {
        let first = p.cone(Cone::NonNegative(self.points.len()));
        for (k, point) in self.points.iter().enumerate() {
            p.matrix.push(first + k, point.column, -1.0);
        }
        for point in self.points.iter().filter(|p| p.mu.is_finite()) {
            if point.tangents == 1 {
                let row = p.cone(Cone::NonNegative(2));
                p.matrix.push(row, point.column + 1, 1.0);
                p.matrix.push(row + 1, point.column + 1, -1.0);
            } else if point.tangents == 2 {
                let row = p.cone(Cone::SecondOrder(3));
                p.matrix.push(row + 1, point.column + 1, -1.0);
                p.matrix.push(row + 2, point.column + 2, -1.0);
            }
        }
    }

    fn friction_cones(&self, p: &mut ConicProgram) {
        for point in &self.points {
            if point.tangents == 0 || point.mu.is_infinite() {
                let row = p.cone(Cone::NonNegative(1));
                p.matrix.push(row, point.column, -1.0);
            } else if point.tangents == 1 {
                let row = p.cone(Cone::NonNegative(2));
                for (k, sign) in [(0, 1.0), (1, -1.0)] {
                    p.matrix.push(row + k, point.column, -point.mu);
                    p.matrix.push(row + k, point.column + 1, sign);
                }
            } else {
                let row = p.cone(Cone::SecondOrder(3));
                p.matrix.push(row, point.column, -point.mu);
                p.matrix.push(row + 1, point.column + 1, -1.0);
                p.matrix.push(row + 2, point.column + 2, -1.0);
            }
        }
    }

    /// `A f + w` per row.
    pub fn residual(&self, forces: &[f64], lambda: f64) -> Vec<f64> {
        let mut r = self.statics.dead.clone();
        for (r, l) in r.iter_mut().zip(&self.statics.live) {
            *r += lambda * l;
        }
        self.statics.matrix.multiply_add(1.0, forces, &mut r);
        r
    }

    /// Rates of the joints, `Aᵀ q` per column.
    pub fn joint_rates(&self, q: &[f64]) -> Vec<f64> {
        let mut u = vec![0.0; self.statics.matrix.columns];
        let m = &self.statics.matrix;
        for ((&i, &j), &v) in m.i.iter().zip(&m.j).zip(&m.v) {
            u[j] += v * q[i];
        }
        u
    }

    /// Limits `μ f_n` of forces.
    pub fn limits(&self, forces: &[f64]) -> Vec<f64> {
        self.points.iter().map(|p| if p.mu.is_finite() { p.mu * forces[p.column].max(0.0) } else { 0.0 }).collect()
    }

    /// `μ‖u_t‖` of joint rates.
    pub fn sliding(&self, u: &[f64]) -> Vec<f64> {
        let t = |p: &Point| u[p.column + 1..=p.column + p.tangents].iter().map(|v| v * v).sum::<f64>().sqrt();
        self.points.iter().map(|p| if p.mu.is_finite() { p.mu * t(p) } else { 0.0 }).collect()
    }

    /// Forces with every point put back into its friction cone (tangential part cut to `μ f_n`, normal part to ≥ 0).
    pub fn cut(&self, forces: &[f64]) -> Vec<f64> {
        let mut f = forces.to_vec();
        for p in &self.points {
            let x = &mut f[p.column..=p.column + p.tangents];
            x[0] = x[0].max(0.0);
            let t = x[1..].iter().map(|v| v * v).sum::<f64>().sqrt();
            let limit = if p.mu.is_finite() {
                p.mu * x[0]
            } else if x[0] > 0.0 {
                f64::INFINITY
            } else {
                0.0
            };
            if t > limit {
                x[1..].iter_mut().for_each(|v| *v *= limit / t);
            }
        }
        f
    }
}

fn ends_are_all(statics: &Statics, interfaces: &Interfaces) -> bool {
    let mut seen = vec![0usize; interfaces.list.len()];
    for b in &statics.bearings {
        seen[b.interface] += if b.points[0] == b.points[1] { 1 } else { 2 };
    }
    seen.iter().zip(&interfaces.list).all(|(&n, f)| n == f.points.len())
}
