//! Rows of crushing in a program: bounds on the normal forces of one joint.
//!
//! The bounds along the edges are second-order cones and exact where a rectangle is bent about one
//! axis; what else the strength excludes is added as linear bounds, one by one, where forces break
//! it ([`crushing`](model::strength::crushing::crushing)).

use super::{Cone, ConicProgram, Statics, bearing::Bearing};
use model::strength::crushing::Cut;

/// Rows of bounds are in units of what they allow, unless coefficients would be greater than this:
/// strips of next to no area. Larger: the engine stalls at its first iteration. Smaller: other rows
/// change, and load factors with dry friction are lost.
const GREATEST: f64 = 1e4;

impl Statics {
    /// Adds the bounds that forces break, `(interface, bound)`.
    pub fn bound(&mut self, broken: &[(usize, Cut)]) {
        for (interface, cut) in broken {
            for section in self.sections.iter_mut().filter(|s| s.interface == *interface) {
                section.add(cut, &self.bearings);
            }
        }
    }

    /// The rows of crushing in a program in forces, which start at variable `column`.
    pub(super) fn section_rows(&self, p: &mut ConicProgram, column: usize) {
        let total = self.total_load();
        for section in &self.sections {
            let bearings = &self.bearings[section.bearings.clone()];
            let tension = |b: &Bearing| b.limits().map_or(0.0, |l| l.tension);
            // `Σ weight × (f_n + T)` in units of `per`, on a row.
            let add = |p: &mut ConicProgram,
                       row: usize,
                       weights: &mut dyn Iterator<Item = f64>,
                       per: f64| {
                for (b, weight) in bearings.iter().zip(weights) {
                    p.matrix.push(row, column + b.column, -weight * b.unit / per);
                    p.rhs[row] += weight * tension(b) / per;
                }
            };
            let unit = total.min(section.strength * section.area);
            for (width, distances) in &section.edges {
                let deep = distances.iter().copied().fold(0.0, f64::max);
                // ν² ≤ κ υ with ν = N / unit, υ = M / (unit × deep), as ‖(2ν/√κ, υ − 1)‖ ≤ υ + 1.
                let kappa = 2.0 * section.strength * width * deep / unit;
                let row = p.cone(Cone::SecondOrder(3));
                let moment = unit * deep;
                add(p, row, &mut distances.iter().copied(), moment);
                add(p, row + 1, &mut distances.iter().map(|_| 2.0 / kappa.sqrt()), unit);
                add(p, row + 2, &mut distances.iter().copied(), moment);
                p.rhs[row] += 1.0;
                p.rhs[row + 2] -= 1.0;
            }
            for (weights, capacity) in &section.cuts {
                let row = p.cone(Cone::NonNegative(1));
                let most = bearings.iter().zip(weights).map(|(b, w)| (w * b.unit).abs());
                let bears = section.strength * capacity;
                let per = most.fold(bears, |per, c| per.max(c / GREATEST));
                add(p, row, &mut weights.iter().map(|w| -w), per);
                p.rhs[row] += bears / per;
            }
        }
    }
}
