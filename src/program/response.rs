//! What compliant contacts answer rates with: the state of [`coulomb`](super::coulomb) in the rates
//! of the blocks.
//!
//! *Law.* Each point has one compliance `c` for all its columns. With the rates `q = (A f + w) / ε`
//! of the blocks and `u = Aᵀ q` of its joint (each multiplied or divided by the number of its
//! images where a part stands for a symmetric scene), the forces of program C are therefore no
//! unknowns: `f = P_K(−u / c)`, the nearest point of its set `K` (limits held), or `f = P_K(−(u + r
//! n) / c)` with the friction cone as `K` (sliding rates `r` held). What remains is one equation a
//! block, `g(q) = ε q − A f(q) − w = 0`, the gradient of a convex function that is once
//! differentiable, and `∂g/∂q = ε + A D Aᵀ` with `D = P_K′ / c`, symmetric and positive definite
//! (Alart & Curnier 1991; Qi & Sun 1993 for Newton's method on it).

use super::coulomb::{Contacts, HeldQuantity, SlidingPoint};
use std::ops::Range;

/// Most columns of a point: a force and three couples.
const MOST: usize = 6;

/// A contact point and the blocks it acts on.
#[derive(Clone, Debug, Default)]
struct Joint {
    /// Rows of the free blocks it touches, in row order; none for a support.
    blocks: [Range<usize>; 2],
    /// Where each block's part of `A` starts: a column of the point after the other.
    first: [usize; 2],
    /// Where the rows of the second block follow in a column of the first, after its own.
    after: usize,
    /// First disc.
    disc: usize,
}

/// What limits the forces across a joint.
#[derive(Clone, Copy, Debug)]
pub enum FrictionLimits<'a> {
    /// What is held, one number a disc.
    Held(HeldQuantity, &'a [f64]),
    /// Coulomb's law: the normal force of the same rates.
    Law,
    /// The same with its corners rounded: gap × pressure is the square of this share of the load
    /// that presumably passes, instead of nothing, and friction turns from sticking to sliding over
    /// forces of that size. Points without friction have the mean load for theirs.
    Rounded(f64),
}

impl<'a> FrictionLimits<'a> {
    /// The same for the discs of one point.
    fn of(self, contacts: &Contacts, joint: &Joint, point: &SlidingPoint) -> Self {
        match self {
            Self::Held(quantity, held) => {
                Self::Held(quantity, &held[joint.disc..joint.disc + point.discs.len()])
            }
            Self::Rounded(by) if !point.discs.is_empty() => {
                Self::Rounded(by * contacts.passing[joint.disc])
            }
            Self::Law | Self::Rounded(_) => self,
        }
    }
}

/// Program C in the rates.
#[derive(Clone, Debug)]
pub struct Response {
    joints: Vec<Joint>,
    /// The parts of `A`, joint by joint.
    operator: Vec<f64>,
    /// Where each column of the lower triangle of `∂g/∂q` starts, and where the last ends.
    starts: Vec<usize>,
    /// Rows of its entries.
    entries: Vec<usize>,
}

impl Response {
    /// The equilibrium of contacts, point by point. `None` where forces of several points are
    /// bounded together (crushing), or a point acts on more than two blocks.
    pub fn new(contacts: &Contacts) -> Option<Self> {
        let (statics, matrix) = (&contacts.statics, &contacts.statics.matrix);
        if !statics.sections.is_empty() {
            return None;
        }
        let mut block_of = vec![0; matrix.rows];
        for (k, free) in statics.free.iter().enumerate() {
            if free.rows.len() > MOST {
                return None;
            }
            block_of.get_mut(free.rows.clone())?.fill(k);
        }
        let mut point_of = vec![0; matrix.columns];
        let mut touched = vec![[None; 2]; contacts.points.len()];
        for (k, p) in contacts.points.iter().enumerate() {
            if p.columns > MOST {
                return None;
            }
            point_of.get_mut(p.column..p.column + p.columns)?.fill(k);
        }
        for (&i, &j) in matrix.i.iter().zip(&matrix.j) {
            let (block, own) = (Some(block_of[i]), &mut touched[point_of[j]]);
            match own {
                [first, second] if *first == block || *second == block => {}
                [first @ None, _] => *first = block,
                [first, second @ None] => {
                    (*first, *second) = ((*first).min(block), (*first).max(block))
                }
                _ => return None,
            }
        }
        let mut neighbours = vec![Vec::new(); statics.free.len()];
        for blocks in &touched {
            if let [Some(a), Some(b)] = *blocks {
                neighbours[a].push((b, 0));
            }
        }
        for list in &mut neighbours {
            list.sort_unstable();
            list.dedup();
            let mut after = 0;
            for (b, offset) in list {
                *offset = after;
                after += statics.free[*b].rows.len();
            }
        }
        let (mut joints, mut size, mut disc) = (Vec::with_capacity(contacts.points.len()), 0, 0);
        for (p, blocks) in contacts.points.iter().zip(&touched) {
            let mut joint = Joint { disc, ..Joint::default() };
            for (side, block) in blocks.iter().enumerate() {
                joint.first[side] = size;
                if let Some(block) = block {
                    joint.blocks[side] = statics.free[*block].rows.clone();
                    size += p.columns * joint.blocks[side].len();
                }
            }
            if let [Some(a), Some(b)] = *blocks {
                let place = neighbours[a].binary_search_by_key(&b, |(b, _)| *b).ok()?;
                joint.after = neighbours[a][place].1;
            }
            disc += p.discs.len();
            joints.push(joint);
        }
        let mut operator = vec![0.0; size];
        for ((&i, &j), &v) in matrix.i.iter().zip(&matrix.j).zip(&matrix.v) {
            let (joint, point) = (&joints[point_of[j]], &contacts.points[point_of[j]]);
            let side = usize::from(!joint.blocks[0].contains(&i));
            let rows = &joint.blocks[side];
            operator[joint.first[side] + (j - point.column) * rows.len() + i - rows.start] += v;
        }
        let (mut starts, mut entries) = (vec![0], Vec::new());
        for (free, list) in statics.free.iter().zip(&neighbours) {
            for row in free.rows.clone() {
                entries.extend(row..free.rows.end);
                entries.extend(list.iter().flat_map(|(b, _)| statics.free[*b].rows.clone()));
                starts.push(entries.len());
            }
        }
        Some(Self { joints, operator, starts, entries })
    }

    /// The lower triangle of `∂g/∂q`: where each column starts, and the rows of its entries.
    pub fn pattern(&self) -> (&[usize], &[usize]) {
        (&self.starts, &self.entries)
    }

    /// Whether forces follow from rates in closed form: with sliding rates held, only where a point
    /// has one friction cone and no couples.
    pub fn is_explicit(contacts: &Contacts, quantity: HeldQuantity) -> bool {
        quantity == HeldQuantity::Limits || contacts.points.iter().all(|p| p.discs.len() < 2)
    }

    /// Forces per column and `g` per row at the rates `q`.
    pub fn forces(
        &self,
        contacts: &Contacts,
        epsilon: f64,
        friction: FrictionLimits,
        q: &[f64],
    ) -> (Vec<f64>, Vec<f64>) {
        let mut forces = vec![0.0; contacts.compliance.len()];
        let mut gradient: Vec<f64> = q
            .iter()
            .zip(&contacts.row_images)
            .zip(&contacts.statics.dead)
            .map(|((q, n), w)| epsilon * q / n - w)
            .collect();
        for (joint, point) in self.joints.iter().zip(&contacts.points) {
            let (n, c) = (point.columns, contacts.compliance[point.column]);
            let wanted = self.wanted(joint, n, c * contacts.column_images[point.column], q);
            let f = answer(point, c, friction.of(contacts, joint, point), &wanted, None);
            forces[point.column..point.column + n].copy_from_slice(&f[..n]);
            for (side, rows) in joint.blocks.iter().enumerate() {
                for (k, f) in f.iter().enumerate().take(n).filter(|(_, f)| **f != 0.0) {
                    for (g, a) in gradient[rows.clone()].iter_mut().zip(self.part(joint, side, k)) {
                        *g -= a * f;
                    }
                }
            }
        }
        (forces, gradient)
    }

    /// `∂g/∂q` at the rates `q`, its lower triangle in the order of [`Self::pattern`].
    pub fn derivative(
        &self,
        contacts: &Contacts,
        epsilon: f64,
        friction: FrictionLimits,
        q: &[f64],
    ) -> Vec<f64> {
        let [lower] = self.triangles(contacts, epsilon, friction, q);
        lower
    }

    /// The same and its upper triangle, entry by entry the mirror image, which differs under
    /// Coulomb's law.
    pub fn derivatives(
        &self,
        contacts: &Contacts,
        epsilon: f64,
        friction: FrictionLimits,
        q: &[f64],
    ) -> [Vec<f64>; 2] {
        self.triangles(contacts, epsilon, friction, q)
    }

    /// The lower triangle, and the second time the upper one.
    fn triangles<const N: usize>(
        &self,
        contacts: &Contacts,
        epsilon: f64,
        friction: FrictionLimits,
        q: &[f64],
    ) -> [Vec<f64>; N] {
        let mut values = vec![0.0; self.entries.len()];
        for (start, n) in self.starts.iter().zip(&contacts.row_images) {
            values[*start] = epsilon / n;
        }
        let mut triangles = std::array::from_fn(|_| values.clone());
        for (joint, point) in self.joints.iter().zip(&contacts.points) {
            let (n, c) = (point.columns, contacts.compliance[point.column]);
            let all = c * contacts.column_images[point.column];
            let wanted = self.wanted(joint, n, all, q);
            let mut slope = [[0.0; MOST]; MOST];
            answer(point, c, friction.of(contacts, joint, point), &wanted, Some(&mut slope));
            if slope.iter().flatten().all(|s| *s == 0.0) {
                continue;
            }
            slope.iter_mut().flatten().for_each(|s| *s /= all);
            for (k, values) in triangles.iter_mut().enumerate() {
                if k > 0 {
                    slope = std::array::from_fn(|i| slope.map(|row| row[i]));
                }
                // As many rows as a block in the plane has, or as any has: with sizes known here and
                // both triangles at once it takes less than half the time.
                if joint.blocks.iter().all(|rows| rows.len() <= 3) {
                    self.add::<3>(joint, n, &slope, values);
                } else {
                    self.add::<MOST>(joint, n, &slope, values);
                }
            }
        }
        triangles
    }

    /// Adds `A D Aᵀ` of a point of `n` columns whose blocks have at most `R` rows.
    fn add<const R: usize>(
        &self,
        joint: &Joint,
        n: usize,
        slope: &[[f64; MOST]; MOST],
        values: &mut [f64],
    ) {
        let mut parts = [[[0.0; R]; MOST]; 2];
        for (side, parts) in parts.iter_mut().enumerate() {
            for (k, part) in parts.iter_mut().enumerate().take(n) {
                let given = self.part(joint, side, k);
                part[..given.len()].copy_from_slice(given);
            }
        }
        for (side, rows) in joint.blocks.iter().enumerate() {
            // A D of one block, then its products with Aᵀ of this block and the one before it.
            let left: [[f64; R]; MOST] = std::array::from_fn(|j| {
                let mut left = [0.0; R];
                if j < n {
                    for (part, row) in parts[side].iter().zip(slope).take(n) {
                        left.iter_mut().zip(part).for_each(|(l, a)| *l += a * row[j]);
                    }
                }
                left
            });
            for (other, columns) in joint.blocks.iter().enumerate().take(side + 1) {
                for (i, column) in columns.clone().enumerate() {
                    let own = self.starts[column];
                    let (start, from) = if other == side {
                        (own, i)
                    } else {
                        (own + columns.len() - i + joint.after, 0)
                    };
                    let mut sum = [0.0; R];
                    for (left, part) in left.iter().zip(&parts[other]).take(n) {
                        sum.iter_mut().zip(left).for_each(|(s, l)| *s += l * part[i]);
                    }
                    let own = &mut values[start..start + rows.len() - from];
                    own.iter_mut().zip(&sum[from..rows.len()]).for_each(|(v, s)| *v += s);
                }
            }
        }
    }

    /// Column `k` of a point in the rows of one of its blocks.
    fn part(&self, joint: &Joint, side: usize, k: usize) -> &[f64] {
        let d = joint.blocks[side].len();
        &self.operator[joint.first[side] + k * d..joint.first[side] + (k + 1) * d]
    }

    /// `−u / c` of a point of `n` columns, `c` the compliance of all its images.
    fn wanted(&self, joint: &Joint, n: usize, c: f64, q: &[f64]) -> [f64; MOST] {
        let mut wanted = [0.0; MOST];
        for (side, rows) in joint.blocks.iter().enumerate() {
            for (k, w) in wanted.iter_mut().enumerate().take(n) {
                *w -= self
                    .part(joint, side, k)
                    .iter()
                    .zip(&q[rows.clone()])
                    .map(|(a, q)| a * q)
                    .sum::<f64>()
                    / c;
            }
        }
        wanted
    }
}

/// The forces of a point nearest to `wanted`, and with `slope` how they change with it
/// (`slope[i][j]`: column `i` with `wanted` `j`).
fn answer(
    point: &SlidingPoint,
    c: f64,
    friction: FrictionLimits,
    wanted: &[f64; MOST],
    mut slope: Option<&mut [[f64; MOST]; MOST]>,
) -> [f64; MOST] {
    let mut f = *wanted;
    f[0] += point.rest;
    if let Some(slope) = slope.as_deref_mut() {
        for (k, row) in slope.iter_mut().enumerate().take(point.columns) {
            row[k] = 1.0;
        }
    }
    if let (FrictionLimits::Held(HeldQuantity::SlidingRates, &[rate, ..]), Some(disc)) =
        (friction, point.discs.first().filter(|d| d.slope > 0.0))
    {
        // Tension beyond cohesion / μ does not count: the cone ends there.
        let tension = point.tension.min(disc.constant / disc.slope);
        f[0] -= rate / c;
        let at = disc.first - point.column..disc.first - point.column + disc.count;
        onto_cone(&mut f, at, [disc.slope, disc.constant, tension], slope);
        return f;
    }
    if let FrictionLimits::Rounded(by) = friction {
        rounded(point, by, &mut f, slope);
        return f;
    }
    if f[0] < -point.tension {
        f[0] = -point.tension;
        if let Some(slope) = slope.as_deref_mut() {
            slope[0][0] = 0.0;
        }
    }
    if f[0] > point.most {
        f[0] = point.most;
        if let Some(slope) = slope.as_deref_mut() {
            slope[0][0] = 0.0;
        }
    }
    for (k, disc) in point.discs.iter().enumerate() {
        let s = match friction {
            FrictionLimits::Held(HeldQuantity::Limits, held) => held.get(k).copied().unwrap_or(0.0),
            FrictionLimits::Held(HeldQuantity::SlidingRates, _) => disc.constant,
            FrictionLimits::Law | FrictionLimits::Rounded(_) => disc.limit(f[0]),
        };
        let at = disc.first - point.column..disc.first - point.column + disc.count;
        let cut = onto_disc(&mut f, at.clone(), s, slope.as_deref_mut());
        if let (FrictionLimits::Law, true, Some(slope)) =
            (friction, cut && s > 0.0 && disc.slope > 0.0, slope.as_deref_mut())
        {
            let normal = slope[0][0];
            for i in at {
                slope[i][0] = disc.slope * normal * f[i] / s;
            }
        }
    }
    f
}

/// Of two sides; in units of the loads nothing is so large or small that squares would not do, and
/// `hypot` takes a quarter of the time of all that is done here.
fn length(a: f64, b: f64) -> f64 {
    (a * a + b * b).sqrt()
}

/// The forces of a point where Coulomb's law has corners rounded by `by`, a force.
fn rounded(
    point: &SlidingPoint,
    by: f64,
    f: &mut [f64; MOST],
    mut slope: Option<&mut [[f64; MOST]; MOST]>,
) {
    let mut normal = 1.0;
    if point.tension.is_finite() {
        let above = f[0] + point.tension;
        let root = length(above, 2.0 * by);
        f[0] = 0.5 * (above + root) - point.tension;
        normal = 0.5 * (1.0 + above / root);
    }
    if f[0] > point.most {
        (f[0], normal) = (point.most, 0.0);
    }
    if let Some(slope) = slope.as_deref_mut() {
        slope[0][0] = normal;
    }
    for disc in &point.discs {
        let at = disc.first - point.column..disc.first - point.column + disc.count;
        let s = disc.limit(f[0]);
        let size = (f[at.clone()].iter().map(|v| v * v).sum::<f64>() + by * by).sqrt();
        let over = size - s;
        let root = length(over, 2.0 * by);
        // The greater of the two, rounded.
        let greater = 0.5 * (size + s + root);
        let (by_size, by_limit) = (0.5 * (1.0 + over / root), 0.5 * (1.0 - over / root));
        let share = s / greater;
        if let Some(slope) = slope.as_deref_mut() {
            for i in at.clone() {
                slope[i][0] = disc.slope * normal * f[i] * (1.0 - share * by_limit) / greater;
                for j in at.clone() {
                    slope[i][j] = share
                        * (f64::from(u8::from(i == j)) - by_size * f[i] / greater * f[j] / size);
                }
            }
        }
        f[at].iter_mut().for_each(|v| *v *= share);
    }
}

/// Cuts a part of `f` to the length `s`; says whether it was longer.
fn onto_disc(
    f: &mut [f64; MOST],
    at: std::ops::Range<usize>,
    s: f64,
    slope: Option<&mut [[f64; MOST]; MOST]>,
) -> bool {
    let size = f[at.clone()].iter().map(|v| v * v).sum::<f64>().sqrt();
    if size <= s {
        return false;
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
    true
}

/// The nearest point with `‖f_t‖ ≤ μ f_n + cohesion`, `f_n ≥ −tension`; law: μ, cohesion, tension
/// (at most cohesion / μ).
fn onto_cone(
    f: &mut [f64; MOST],
    at: std::ops::Range<usize>,
    law: [f64; 3],
    slope: Option<&mut [[f64; MOST]; MOST]>,
) {
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
                    slope[i][j] =
                        mu * mu * share * ee + length / size * (f64::from(u8::from(i == j)) - ee);
                }
            }
        }
        f[0] = on;
        f[at].iter_mut().for_each(|v| *v *= length / size);
    }
}
