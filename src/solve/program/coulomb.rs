//! Programs C and D: dry friction without dilatancy.
//!
//! *Law.* At each contact point, with `u` the rate of the joint (opening positive): `u_n ≥ 0 ⟂ f_n
//! ≥ 0` (Signorini) and `‖f_t‖ ≤ μ f_n`, `f_t` against `u_t` and at its limit where `u_t ≠ 0`
//! (Coulomb). Sliding does not open the joint, so there is no energy to minimise; with the friction
//! limits `s` held fixed there is (Tresca), and Coulomb's law is `s = μ f_n`.
//!
//! *State (C).* `min ½ fᵀ C f + (1/2ε) ‖A f + w‖²` subject to `f_n ≥ 0`, `‖f_t‖ ≤ s`: always
//! feasible, what cannot balance accelerates. `C` is a contact compliance (mean area / area of the
//! point), which picks among admissible forces those that the loads produce; forces are in mean
//! block loads, rows scaled by the root of each block's load × the mean one, so that the
//! multipliers `(A f + w) / ε` are accelerations ([`Contacts::by_mass`]). The rate of a joint is
//! the gradient, `u = C f + Aᵀ (A f + w) / ε`.
//!
//! *Load factor (D).* `max λ − ½ δ fᵀ C f` subject to `A f + w + λ ℓ = 0` and the same limits; `u =
//! δ C f + Aᵀ y` with the multipliers `y`.
//!
//! *More than friction.* Cohesion `c` and tension `T` make the limit `μ f_n + c` and `f_n ≥ −T`;
//! the couples of a rolling arm are limited by `f_n` in the same way ([`Disc`]), and what rolls or
//! twists does not open either. Crushing bounds the normal forces
//! ([`CrushingJoint`](super::CrushingJoint)), held and associative: what crushes closes.
//!
//! *Twin (De Saxcé & Feng 1998).* `f` in the friction cone with a linear term `μ‖u_t‖ f_n`: the
//! fixed point is in the sliding rates instead of the limits. It serves as a second opinion; where
//! dilatancy jams it does not settle. Sources: Haslinger 1983 (fixed point on the Tresca limit),
//! Acary, Brémond & Huber 2018 (natural map), Gilbert, Casapulla & Ahmed 2006 (sequence of convex
//! programs for non-associative limit analysis).

use super::{
    BearingCone, Cone, ConicProgram, Disc, MemberColumns, MemberSet, Statics, StaticsOptions,
    equilibrium_error::copy,
};
use model::interface::Model;
use scene::Friction;

/// A contact point of programs C and D.
#[derive(Clone, Debug)]
pub struct SlidingPoint {
    /// First column of its forces `(f_n, f_t…)` and couples.
    pub column: usize,
    /// Number of columns.
    pub columns: usize,
    /// Tensile strength, in units of the forces; infinite where the first column has no lower bound.
    pub tension: f64,
    /// Greatest first force, in units of the forces; infinite but for members.
    pub most: f64,
    /// The first force at which it is at ease: what a member was stressed to beforehand.
    pub rest: f64,
    /// Its limits: friction, and rolling and twisting where there is an arm. None where sliding is
    /// excluded.
    pub discs: Vec<Disc>,
}

/// The equilibrium in normal and tangential forces, in mean block loads, with the compliance of the
/// contacts.
#[derive(Clone, Debug)]
pub struct Contacts {
    /// Equilibrium, columns `(f_n, f_t…, couples…)` per point, unit = mean block load.
    pub statics: Statics,
    /// The contact points in column order.
    pub points: Vec<SlidingPoint>,
    /// Compliance of each column.
    pub compliance: Vec<f64>,
    /// The load that presumably passes each limit, in units of the forces: what a change of it is
    /// measured by.
    pub passing: Vec<f64>,
    /// The load of the lighter of the two blocks at each limit, in units of the forces: what a
    /// wrong limit accelerates.
    pub lighter: Vec<f64>,
    /// How many blocks each row, and how many bearings each column stands for: what is summed over
    /// the scene counts them.
    pub row_images: Vec<f64>,
    pub(super) column_images: Vec<f64>,
}

impl SlidingPoint {
    /// Of a member.
    fn of(m: &MemberColumns) -> Self {
        let (tension, most, discs) = match m.set {
            MemberSet::Range(least, greatest) => (-least / m.unit, greatest / m.unit, Vec::new()),
            MemberSet::Disc(most) if most.is_infinite() => {
                (f64::INFINITY, f64::INFINITY, Vec::new())
            }
            // The normal force of a finger is given: its friction is a limit that stays.
            MemberSet::Disc(most) | MemberSet::Cone { most, .. } => {
                let disc = m.disc(m.column, 0, 0.0, most);
                (f64::INFINITY, f64::INFINITY, vec![disc])
            }
        };
        let rest = m.rest / m.unit;
        Self { column: m.column, columns: m.amounts.len(), tension, most, rest, discs }
    }
}

/// How friction is held fixed in one convex program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeldQuantity {
    /// The limit `s` of each disc (Tresca).
    Limits,
    /// The sliding rate `μ‖u_t‖` of each disc (De Saxcé).
    SlidingRates,
}

/// What is asked of a program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Objective {
    /// C: the state, with this ε.
    State(f64),
    /// D: the load factor, with this δ and live load multiplied by the second number.
    LoadFactor(f64, f64),
}

/// A limit is reached by forces of this share of it. More: rounding hides some. Less: sticking
/// joints count as sliding.
const REACHED: f64 = 0.999;

impl Contacts {
    /// Builds the contacts of an assembly.
    ///
    /// A plane scene is solved as plane only where every interface is wholly represented by its two
    /// ends: the compliance of inner points would be lost.
    pub fn new(model: &Model, options: StaticsOptions) -> Self {
        let Model { assembly, interfaces, .. } = model;
        let mut statics = Statics::new(model, StaticsOptions { split: true, ..options });
        let mean = statics.total_load() / statics.free_count().max(1) as f64;
        statics.rescale(mean / statics.unit, false);
        let share = |b: &super::Bearing| {
            let face = &interfaces.list[b.interface];
            face.area * b.point_count() as f64 / face.points.len() as f64
        };
        let areas: Vec<f64> = statics.bearings.iter().map(share).collect();
        let column_images = statics.column_images();
        let with_area = || {
            statics
                .bearings
                .iter()
                .zip(&areas)
                .filter(|(_, a)| **a > 0.0)
                .map(|(b, a)| (column_images[b.column], a))
        };
        let mean_area = with_area().map(|(n, a)| n * a).sum::<f64>()
            / with_area().map(|(n, _)| n).sum::<f64>().max(1.0);
        let mut compliance = Vec::with_capacity(statics.matrix.columns);
        let mut points: Vec<SlidingPoint> = statics
            .bearings
            .iter()
            .zip(&areas)
            .map(|(b, &area)| {
                // Edges and points have no area; they count as an average contact.
                let c = if area > 0.0 { mean_area / area } else { 1.0 };
                compliance.extend(std::iter::repeat_n(c, b.basis.len()));
                let limits = match (b.cone, interfaces.list[b.interface].law.friction) {
                    (BearingCone::Limited(limits), _) => limits.discs(b.column, b.unit),
                    (_, Friction::Coefficient(slope)) if b.basis.len() > 1 => {
                        vec![Disc {
                            normal: b.column,
                            first: b.column + 1,
                            count: b.basis.len() - 1,
                            slope,
                            constant: 0.0,
                        }]
                    }
                    _ => Vec::new(),
                };
                let tension = b.limits().map_or(0.0, |l| l.tension / b.unit);
                SlidingPoint {
                    column: b.column,
                    columns: b.basis.len(),
                    tension,
                    most: f64::INFINITY,
                    rest: 0.0,
                    discs: limits,
                }
            })
            .collect();
        let joints = points.len();
        // An average joint is as many bearings side by side; in a plane they are pairs, so that a
        // member that yielded like one bearing would be another one there.
        let bearings: f64 = statics.bearings.iter().map(|b| b.image_count() as f64).sum();
        let joint = interfaces.list.len() as f64 / bearings.max(1.0);
        for m in &statics.members {
            // As an average joint; among members whose stiffness is known, as that.
            let c = joint * m.stiffness.map_or(1.0, |k| 1.0 / k);
            compliance.extend(std::iter::repeat_n(c, m.amounts.len()));
            points.push(SlidingPoint::of(m));
        }
        let row_images = statics.row_images();
        let passing = points
            .iter()
            .zip(&statics.bearings)
            .flat_map(|(p, b)| p.discs.iter().map(|_| b.presumed / b.unit));
        let of_members = || points[joints..].iter().zip(&statics.members);
        let passing = passing
            .chain(of_members().flat_map(|(p, m)| p.discs.iter().map(|_| m.presumed / m.unit)))
            .collect();
        let weight = |block: usize| {
            let loaded = assembly.weight(block).max(assembly.dead[block].force.norm());
            if assembly.blocks[block].support { f64::INFINITY } else { loaded }
        };
        let lighter = |b: &super::Bearing| {
            weight(interfaces.list[b.interface].a).min(weight(interfaces.list[b.interface].b))
                / b.unit
        };
        let lighter = points
            .iter()
            .zip(&statics.bearings)
            .flat_map(|(p, b)| p.discs.iter().map(move |_| lighter(b)))
            .chain(of_members().flat_map(|(p, m)| {
                let least = m.basis.iter().flatten().map(|(i, _)| weight(*i));
                let least = least.fold(f64::INFINITY, f64::min) / m.unit;
                p.discs.iter().map(move |_| least)
            }))
            .collect();
        Self { statics, points, compliance, passing, lighter, row_images, column_images }
    }

    /// Measures the blocks for [`Objective::State`]: what is left of a block's load over ε is then
    /// the block's acceleration, whatever the others weigh, as if every mass were on its way for a
    /// while.
    pub fn by_mass(&mut self) {
        let mean = self.statics.unit;
        self.statics.measure(|weight| (weight * mean).sqrt());
    }

    /// The load that presumably passes through the block of each row, as the rows measure it.
    pub fn carried(&self) -> Vec<f64> {
        let Statics { free, bearings, matrix, .. } = &self.statics;
        let mut passing = vec![0.0; matrix.columns];
        for b in bearings {
            passing[b.column..b.column + b.basis.len()].fill(b.presumed);
        }
        for m in &self.statics.members {
            passing[m.column..m.column + m.amounts.len()].fill(m.presumed);
        }
        let block: Vec<usize> =
            free.iter().enumerate().flat_map(|(k, f)| f.rows.clone().map(move |_| k)).collect();
        let mut carried = vec![f64::MIN_POSITIVE; free.len()];
        for (&i, &j) in matrix.i.iter().zip(&matrix.j) {
            carried[block[i]] = f64::max(carried[block[i]], passing[j]);
        }
        block.iter().map(|&k| carried[k] / free[k].weight).collect()
    }

    /// One convex program of the sequence; `held` are the limits or the sliding rates per point.
    pub fn program(
        &self,
        objective: Objective,
        quantity: HeldQuantity,
        held: &[f64],
    ) -> ConicProgram {
        let (rows, forces) = (self.statics.matrix.rows, self.statics.matrix.columns);
        let extra = match objective {
            Objective::State(_) => rows,
            Objective::LoadFactor(..) => 1,
        };
        let mut p = ConicProgram::new(forces + extra);
        let weight = if let Objective::LoadFactor(delta, _) = objective { delta } else { 1.0 };
        p.quadratic =
            self.compliance.iter().zip(&self.column_images).map(|(c, n)| c * weight * n).collect();
        p.cone(Cone::Zero(rows));
        copy(&mut p, &self.statics, 0, 0);
        match objective {
            Objective::State(epsilon) => {
                p.quadratic.extend(self.row_images.iter().map(|n| n / epsilon));
                for row in 0..rows {
                    p.matrix.push(row, forces + row, 1.0);
                }
            }
            Objective::LoadFactor(_, scale) => {
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
        match quantity {
            HeldQuantity::Limits => self.limit_cones(&mut p),
            HeldQuantity::SlidingRates => self.friction_cones(&mut p),
        }
        // Of `½ c (x − r)²` what is linear.
        for point in self.points.iter().filter(|point| point.rest != 0.0) {
            p.objective[point.column] = -self.at_ease(point, weight);
        }
        self.hold(&mut p, quantity, held);
        p
    }

    /// The slope at zero that the compliance of a stressed member adds, times the number of images.
    fn at_ease(&self, point: &SlidingPoint, weight: f64) -> f64 {
        let column = point.column;
        self.compliance[column] * weight * self.column_images[column] * point.rest
    }

    /// Every limit, point by point.
    pub fn discs(&self) -> impl Iterator<Item = &Disc> {
        self.points.iter().flat_map(|p| &p.discs)
    }

    /// Puts new limits or sliding rates (one per disc) into a program made by [`Self::program`].
    pub fn hold(&self, p: &mut ConicProgram, quantity: HeldQuantity, held: &[f64]) {
        match quantity {
            HeldQuantity::Limits => {
                let mut row = self.statics.matrix.rows + self.points.len();
                for (disc, &s) in self.discs().zip(held) {
                    let rows = if disc.count == 1 { 2 } else { 3 };
                    p.rhs[row] = s;
                    if disc.count == 1 {
                        p.rhs[row + 1] = s;
                    }
                    row += rows;
                }
            }
            HeldQuantity::SlidingRates => {
                for point in self.points.iter().filter(|point| point.rest == 0.0) {
                    p.objective[point.column] = 0.0;
                }
                for (disc, &rate) in self.discs().zip(held) {
                    p.objective[disc.normal] += rate * self.column_images[disc.normal];
                }
            }
        }
    }

    /// `f_n ≥ −T` for all points, then `‖f_t‖ ≤ s` disc by disc, then crushing.
    fn limit_cones(&self, p: &mut ConicProgram) {
        let first = p.cone(Cone::NonNegative(self.points.len()));
        for (k, point) in self.points.iter().enumerate() {
            // A row for every point, so that limits keep their places.
            if point.tension.is_infinite() {
                p.rhs[first + k] = 1.0;
                continue;
            }
            p.matrix.push(first + k, point.column, -1.0);
            p.rhs[first + k] = point.tension;
        }
        for disc in self.discs() {
            if disc.count == 1 {
                let row = p.cone(Cone::NonNegative(2));
                p.matrix.push(row, disc.first, 1.0);
                p.matrix.push(row + 1, disc.first, -1.0);
            } else {
                let row = p.cone(Cone::SecondOrder(3));
                p.matrix.push(row + 1, disc.first, -1.0);
                p.matrix.push(row + 2, disc.first + 1, -1.0);
            }
        }
        self.most_rows(p);
        self.statics.section_rows(p, 0);
    }

    /// The upper bounds of members.
    fn most_rows(&self, p: &mut ConicProgram) {
        for point in self.points.iter().filter(|point| point.most.is_finite()) {
            let by = 1.0 / point.most.abs().max(1.0);
            let row = p.cone(Cone::NonNegative(1));
            p.matrix.push(row, point.column, by);
            p.rhs[row] = point.most * by;
        }
    }

    fn friction_cones(&self, p: &mut ConicProgram) {
        for point in &self.points {
            // A cone with its apex at zero bounds the normal force by itself.
            if point.tension.is_finite()
                && !point.discs.iter().any(|d| d.slope > 0.0 && d.constant == 0.0)
            {
                let row = p.cone(Cone::NonNegative(1));
                p.matrix.push(row, point.column, -1.0);
                p.rhs[row] = point.tension;
            }
            for disc in &point.discs {
                disc.cone(p);
            }
        }
        self.most_rows(p);
        self.statics.section_rows(p, 0);
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

    /// Multipliers of the rows in the state that leaves this residual: its accelerations over ε.
    pub fn multipliers(&self, residual: &[f64], epsilon: f64) -> Vec<f64> {
        residual.iter().zip(&self.row_images).map(|(r, n)| n * (r / epsilon)).collect()
    }

    /// The load factor at which these forces, off balance by `residual`, balance best.
    pub fn best_factor(&self, lambda: f64, residual: &[f64]) -> f64 {
        let dot = |a: &[f64], b: &[f64]| {
            a.iter().zip(b).zip(&self.row_images).map(|((a, b), n)| a * b * n).sum::<f64>()
        };
        lambda - dot(residual, &self.statics.live) / dot(&self.statics.live, &self.statics.live)
    }

    /// Rates of the joints, `Aᵀ q` per column, from the multipliers of the rows.
    pub fn joint_rates(&self, q: &[f64]) -> Vec<f64> {
        let mut u = vec![0.0; self.statics.matrix.columns];
        let m = &self.statics.matrix;
        for ((&i, &j), &v) in m.i.iter().zip(&m.j).zip(&m.v) {
            u[j] += v * q[i];
        }
        u.iter_mut().zip(&self.column_images).for_each(|(u, n)| *u /= n);
        u
    }

    /// Limits `μ f_n + c` of forces, per disc.
    pub fn limits(&self, forces: &[f64]) -> Vec<f64> {
        self.points
            .iter()
            .flat_map(|p| p.discs.iter().map(|d| d.limit(forces[p.column].max(-p.tension))))
            .collect()
    }

    /// What limits that were held, while those of the forces are `next`, can make of accelerations
    /// at most, in multiples of gravity: only where a limit is reached does it matter.
    pub fn unsettled(&self, forces: &[f64], held: &[f64], next: &[f64]) -> f64 {
        let reached = |d: &Disc, s: f64| {
            forces[d.first..d.first + d.count].iter().map(|v| v * v).sum::<f64>().sqrt()
                >= REACHED * s
        };
        let off =
            self.discs().zip(held).zip(next).zip(&self.lighter).map(|(((d, &s), n), load)| {
                let off = (n - s).abs() / load;
                if reached(d, s) { off } else { 0.0 }
            });
        off.fold(0.0, f64::max)
    }

    /// `μ‖u_t‖` of joint rates, per disc.
    pub fn sliding(&self, u: &[f64]) -> Vec<f64> {
        let size =
            |d: &Disc| u[d.first..d.first + d.count].iter().map(|v| v * v).sum::<f64>().sqrt();
        self.discs().map(|d| d.slope * size(d)).collect()
    }

    /// Forces with every point put back into its cone (normal part to ≥ −T, the others cut to their
    /// limits).
    pub fn cut(&self, forces: &[f64]) -> Vec<f64> {
        let mut f = forces.to_vec();
        for p in &self.points {
            let normal = f[p.column].max(-p.tension).min(p.most);
            f[p.column] = normal;
            for disc in &p.discs {
                let part = &mut f[disc.first..disc.first + disc.count];
                let (size, limit) =
                    (part.iter().map(|v| v * v).sum::<f64>().sqrt(), disc.limit(normal));
                if size > limit {
                    part.iter_mut().for_each(|v| *v *= limit / size);
                }
            }
        }
        f
    }
}
