//! What compliant contacts answer rates with: the state of [`coulomb`](super::coulomb) in the rates of the blocks.
//!
//! *Law.* Each point has one compliance `c` for all its columns. With the rates `q = (A f + w) / ε` of the blocks and `u = Aᵀ q` of its joint,
//! the forces of program C are therefore no unknowns: `f = P_K(−u / c)`, the nearest point of its set `K` (limits held), or
//! `f = P_K(−(u + r n) / c)` with the friction cone as `K` (sliding rates `r` held). What remains is one equation a block,
//! `g(q) = ε q − A f(q) − w = 0`, the gradient of a convex function that is once differentiable, and `∂g/∂q = ε + A D Aᵀ` with
//! `D = P_K′ / c`, symmetric and positive definite (Alart & Curnier 1991; Qi & Sun 1993 for Newton's method on it).

use super::coulomb::{Contacts, Hold, Point};

/// Most columns of a point: a force and three couples.
const MOST: usize = 6;

/// A contact point and the blocks it acts on.
#[derive(Clone, Debug)]
struct Joint {
    /// The free blocks it touches, in row order; how many there are.
    blocks: [usize; 2],
    count: usize,
    /// Which of the neighbours of the first block the second one is.
    neighbour: usize,
    /// First entry of its part of `A`: for each block, `columns × d` numbers, a column of the point after the other.
    first: usize,
    /// First disc.
    disc: usize,
}

/// Program C in the rates.
#[derive(Clone, Debug)]
pub struct Response {
    dimension: usize,
    rows: usize,
    joints: Vec<Joint>,
    /// The parts of `A`, joint by joint.
    operator: Vec<f64>,
    /// Where each column of the lower triangle of `∂g/∂q` starts, and where the last ends.
    starts: Vec<usize>,
    /// Rows of its entries.
    entries: Vec<usize>,
}

impl Response {
    /// The equilibrium of contacts, point by point. `None` where forces of several points are bounded together (crushing), or a point acts
    /// on more than two blocks.
    pub fn new(contacts: &Contacts) -> Option<Self> {
        let statics = &contacts.statics;
        let (d, rows, matrix) = (statics.dimension(), statics.matrix.rows, &statics.matrix);
        if !statics.sections.is_empty() || d > MOST {
            return None;
        }
        let mut point_of = vec![None; matrix.columns];
        let (mut joints, mut size, mut disc) = (Vec::with_capacity(contacts.points.len()), 0, 0);
        for (k, p) in contacts.points.iter().enumerate() {
            if p.columns > MOST {
                return None;
            }
            point_of.get_mut(p.column..p.column + p.columns)?.fill(Some(k));
            joints.push(Joint { blocks: [0; 2], count: 0, neighbour: 0, first: size, disc });
            size += 2 * d * p.columns;
            disc += p.discs.len();
        }
        for (&i, &j) in matrix.i.iter().zip(&matrix.j) {
            let joint = joints.get_mut(point_of[j]?)?;
            let block = i / d;
            if !joint.blocks[..joint.count].contains(&block) {
                if joint.count == 2 {
                    return None;
                }
                joint.blocks[joint.count] = block;
                joint.count += 1;
                joint.blocks[..joint.count].sort_unstable();
            }
        }
        let mut operator = vec![0.0; size];
        for ((&i, &j), &v) in matrix.i.iter().zip(&matrix.j).zip(&matrix.v) {
            let k = point_of[j]?;
            let (joint, point) = (&joints[k], &contacts.points[k]);
            let side = usize::from(joint.blocks[0] != i / d);
            operator[joint.first + (side * point.columns + j - point.column) * d + i % d] += v;
        }
        let mut neighbours = vec![Vec::new(); rows / d];
        for joint in joints.iter().filter(|j| j.count == 2) {
            neighbours[joint.blocks[0]].push(joint.blocks[1]);
        }
        for list in &mut neighbours {
            list.sort_unstable();
            list.dedup();
        }
        for joint in joints.iter_mut().filter(|j| j.count == 2) {
            joint.neighbour = neighbours[joint.blocks[0]].binary_search(&joint.blocks[1]).ok()?;
        }
        let (mut starts, mut entries) = (vec![0], Vec::new());
        for (block, list) in neighbours.iter().enumerate() {
            for k in 0..d {
                entries.extend(block * d + k..(block + 1) * d);
                entries.extend(list.iter().flat_map(|b| b * d..(b + 1) * d));
                starts.push(entries.len());
            }
        }
        Some(Self { dimension: d, rows, joints, operator, starts, entries })
    }

    /// The lower triangle of `∂g/∂q`: where each column starts, and the rows of its entries.
    pub fn pattern(&self) -> (&[usize], &[usize]) {
        (&self.starts, &self.entries)
    }

    /// Whether forces follow from rates in closed form: with sliding rates held, only where a point has one friction cone and no couples.
    pub fn is_explicit(contacts: &Contacts, hold: Hold) -> bool {
        hold == Hold::Limits || contacts.points.iter().all(|p| p.discs.len() < 2)
    }

    /// Forces per column and `g` per row at the rates `q`.
    pub fn forces(&self, contacts: &Contacts, epsilon: f64, hold: Hold, held: &[f64], q: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let mut forces = vec![0.0; contacts.compliance.len()];
        let mut gradient: Vec<f64> = q.iter().zip(&contacts.statics.dead).map(|(q, w)| epsilon * q - w).collect();
        let d = self.dimension;
        for (joint, point) in self.joints.iter().zip(&contacts.points) {
            let (n, c) = (point.columns, contacts.compliance[point.column]);
            let wanted = self.wanted(joint, point, c, q);
            let own = &held[joint.disc..joint.disc + point.discs.len()];
            let f = answer(point, c, hold, own, &wanted, None);
            forces[point.column..point.column + n].copy_from_slice(&f[..n]);
            for side in 0..joint.count {
                let row = joint.blocks[side] * d;
                for (k, f) in f.iter().enumerate().take(n).filter(|(_, f)| **f != 0.0) {
                    let from = joint.first + (side * n + k) * d;
                    for (g, a) in gradient[row..row + d].iter_mut().zip(&self.operator[from..from + d]) {
                        *g -= a * f;
                    }
                }
            }
        }
        (forces, gradient)
    }

    /// `∂g/∂q` at the rates `q`, its lower triangle in the order of [`Self::pattern`].
    pub fn derivative(&self, contacts: &Contacts, epsilon: f64, hold: Hold, held: &[f64], q: &[f64]) -> Vec<f64> {
        let mut values = vec![0.0; self.entries.len()];
        for k in 0..self.rows {
            values[self.starts[k]] = epsilon;
        }
        let d = self.dimension;
        for (joint, point) in self.joints.iter().zip(&contacts.points) {
            let (n, c) = (point.columns, contacts.compliance[point.column]);
            let wanted = self.wanted(joint, point, c, q);
            let own = &held[joint.disc..joint.disc + point.discs.len()];
            let mut slope = [[0.0; MOST]; MOST];
            answer(point, c, hold, own, &wanted, Some(&mut slope));
            let part = |side: usize, k: usize, i: usize| self.operator[joint.first + (side * n + k) * d + i];
            for side in 0..joint.count {
                // A D / c of one block, then its products with Aᵀ of this block and the one after it.
                let mut left = [[0.0; MOST]; MOST];
                for (j, left) in left.iter_mut().enumerate().take(n) {
                    for (k, s) in slope.iter().enumerate().take(n).filter(|(_, s)| s[j] != 0.0) {
                        let s = s[j] / c;
                        for (i, l) in left.iter_mut().enumerate().take(d) {
                            *l += part(side, k, i) * s;
                        }
                    }
                }
                for other in 0..=side {
                    let column = joint.blocks[other] * d;
                    for i in 0..d {
                        let start = self.starts[column + i];
                        let (start, from) = if other == side { (start, i) } else { (start + d - i + joint.neighbour * d, 0) };
                        for (k, left) in left.iter().enumerate().take(n) {
                            let a = part(other, k, i);
                            if a != 0.0 {
                                for (v, l) in values[start..start + d - from].iter_mut().zip(&left[from..d]) {
                                    *v += l * a;
                                }
                            }
                        }
                    }
                }
            }
        }
        values
    }

    /// `−u / c` of a point.
    fn wanted(&self, joint: &Joint, point: &Point, c: f64, q: &[f64]) -> [f64; MOST] {
        let d = self.dimension;
        let mut wanted = [0.0; MOST];
        for side in 0..joint.count {
            let q = &q[joint.blocks[side] * d..(joint.blocks[side] + 1) * d];
            for (k, w) in wanted.iter_mut().enumerate().take(point.columns) {
                let from = joint.first + (side * point.columns + k) * d;
                *w -= self.operator[from..from + d].iter().zip(q).map(|(a, q)| a * q).sum::<f64>() / c;
            }
        }
        wanted
    }
}

/// The forces of a point nearest to `wanted`, and with `slope` how they change with it (`slope[i][j]`: column `i` with `wanted` `j`).
fn answer(
    point: &Point,
    c: f64,
    hold: Hold,
    held: &[f64],
    wanted: &[f64; MOST],
    mut slope: Option<&mut [[f64; MOST]; MOST]>,
) -> [f64; MOST] {
    let mut f = *wanted;
    if let Some(slope) = slope.as_deref_mut() {
        for (k, row) in slope.iter_mut().enumerate().take(point.columns) {
            row[k] = 1.0;
        }
    }
    let cone = point.discs.first().filter(|d| hold == Hold::SlidingRates && d.slope > 0.0);
    if let (Some(disc), Some(&rate)) = (cone, held.first()) {
        // Tension beyond cohesion / μ does not count: the cone ends there.
        let tension = point.tension.min(disc.constant / disc.slope);
        f[0] -= rate / c;
        let at = disc.first - point.column..disc.first - point.column + disc.count;
        onto_cone(&mut f, at, [disc.slope, disc.constant, tension], slope);
        return f;
    }
    if f[0] < -point.tension {
        f[0] = -point.tension;
        if let Some(slope) = slope.as_deref_mut() {
            slope[0][0] = 0.0;
        }
    }
    for (disc, &s) in point.discs.iter().zip(held) {
        let s = if hold == Hold::Limits { s } else { disc.constant };
        let at = disc.first - point.column..disc.first - point.column + disc.count;
        onto_disc(&mut f, at, s, slope.as_deref_mut());
    }
    f
}

/// Cuts a part of `f` to the length `s`.
fn onto_disc(f: &mut [f64; MOST], at: std::ops::Range<usize>, s: f64, slope: Option<&mut [[f64; MOST]; MOST]>) {
    let size = f[at.clone()].iter().map(|v| v * v).sum::<f64>().sqrt();
    if size <= s {
        return;
    }
    let by = s / size;
    if let Some(slope) = slope {
        for i in at.clone() {
            for j in at.clone() {
                slope[i][j] = by * (f64::from(u8::from(i == j)) - f[i] / size * f[j] / size);
            }
        }
    }
    f[at].iter_mut().for_each(|v| *v *= by);
}

/// The nearest point with `‖f_t‖ ≤ μ f_n + cohesion`, `f_n ≥ −tension`; law: μ, cohesion, tension (at most cohesion / μ).
fn onto_cone(f: &mut [f64; MOST], at: std::ops::Range<usize>, law: [f64; 3], slope: Option<&mut [[f64; MOST]; MOST]>) {
    let [mu, cohesion, tension] = law;
    let normal = f[0];
    let size = f[at.clone()].iter().map(|v| v * v).sum::<f64>().sqrt();
    let outside = size > mu * normal + cohesion;
    let on = if outside { (normal + mu * (size - cohesion)) / (1.0 + mu * mu) } else { normal };
    if on < -tension {
        f[0] = -tension;
        if let Some(slope) = slope {
            slope[0][0] = 0.0;
            onto_disc(f, at, (cohesion - mu * tension).max(0.0), Some(slope));
        } else {
            onto_disc(f, at, (cohesion - mu * tension).max(0.0), None);
        }
    } else if outside {
        let length = mu * on + cohesion;
        if let Some(slope) = slope {
            let share = 1.0 / (1.0 + mu * mu);
            slope[0][0] = share;
            for i in at.clone() {
                let e = f[i] / size;
                slope[0][i] = mu * share * e;
                slope[i][0] = mu * share * e;
                for j in at.clone() {
                    let ee = e * f[j] / size;
                    slope[i][j] = mu * mu * share * ee + length / size * (f64::from(u8::from(i == j)) - ee);
                }
            }
        }
        f[0] = on;
        f[at].iter_mut().for_each(|v| *v *= length / size);
    }
}
