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
struct ContactColumns {
    /// Rows of the free blocks it touches, in row order; none for a support.
    blocks: [Range<usize>; 2],
    /// Where each block's part of `A` starts.
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
    /// The same where contacts remember how they came to be: rates count from there, and this is what
    /// each column wants without any ([`Response::memory`]).
    Since(&'a [f64]),
}

/// What contacts answer, and how that changes.
pub struct Answer<const N: usize> {
    /// Per column.
    pub forces: Vec<f64>,
    /// `g` per row.
    pub imbalance: Vec<f64>,
    /// `∂g/∂q`, lower triangle and upper one, entry by entry its mirror image.
    pub triangles: [Vec<f64>; N],
}

impl<'a> FrictionLimits<'a> {
    /// The same for the discs of one point.
    fn of(self, joint: &ContactColumns, point: &SlidingPoint) -> Self {
        match self {
            Self::Held(quantity, held) => {
                Self::Held(quantity, &held[joint.disc..joint.disc + point.discs.len()])
            }
            Self::Since(memory) => Self::Since(&memory[point.column..point.column + point.columns]),
            Self::Law => self,
        }
    }
}

/// Program C in the rates.
#[derive(Clone, Debug)]
pub struct Response {
    joints: Vec<ContactColumns>,
    /// The parts of `A`, joint by joint and block by block, a column of the point after the other.
    operator: Vec<[f64; MOST]>,
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
            let mut joint = ContactColumns { disc, ..ContactColumns::default() };
            for (side, block) in blocks.iter().enumerate() {
                joint.first[side] = size;
                if let Some(block) = block {
                    joint.blocks[side] = statics.free[*block].rows.clone();
                    size += p.columns;
                }
            }
            if let [Some(a), Some(b)] = *blocks {
                let place = neighbours[a].binary_search_by_key(&b, |(b, _)| *b).ok()?;
                joint.after = neighbours[a][place].1;
            }
            disc += p.discs.len();
            joints.push(joint);
        }
        let mut operator = vec![[0.0; MOST]; size];
        for ((&i, &j), &v) in matrix.i.iter().zip(&matrix.j).zip(&matrix.v) {
            let (joint, point) = (&joints[point_of[j]], &contacts.points[point_of[j]]);
            let side = usize::from(!joint.blocks[0].contains(&i));
            let rows = &joint.blocks[side];
            operator[joint.first[side] + j - point.column][i - rows.start] += v;
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
        let Answer { forces, imbalance, .. } = self.answer::<0>(contacts, epsilon, friction, q);
        (forces, imbalance)
    }

    /// What contacts want where they are after these rates, with these forces, having wanted `memory`
    /// before: what presses does so by how far the blocks have come in all, and friction holds on where
    /// it is.
    pub fn memory(
        &self,
        contacts: &Contacts,
        memory: &[f64],
        q: &[f64],
        forces: &[f64],
    ) -> Vec<f64> {
        let mut next = forces.to_vec();
        for (joint, point) in self.joints.iter().zip(&contacts.points) {
            let first = point.column;
            if point.discs.iter().any(|disc| disc.first == first) {
                next[first] -= point.rest;
                continue;
            }
            let all = contacts.compliance[first] * contacts.column_images[first];
            next[first] = memory[first];
            for (rows, part) in joint.blocks.iter().zip(joint.first) {
                for (part, q) in self.operator.get(part).into_iter().flatten().zip(&q[rows.clone()])
                {
                    next[first] -= part * q / all;
                }
            }
        }
        next
    }

    /// The same with `∂g/∂q`: nothing of it, its lower triangle in the order of [`Self::pattern`], or its
    /// upper one as well, which differs under Coulomb's law.
    pub fn answer<const N: usize>(
        &self,
        contacts: &Contacts,
        epsilon: f64,
        friction: FrictionLimits,
        q: &[f64],
    ) -> Answer<N> {
        // As many rows as a block in the plane has, or as any has.
        if self.joints.iter().flat_map(|joint| &joint.blocks).all(|rows| rows.len() <= 3) {
            self.answer_of::<3, N>(contacts, epsilon, friction, q)
        } else {
            self.answer_of::<MOST, N>(contacts, epsilon, friction, q)
        }
    }

    /// The same of blocks that have at most `R` rows: sizes known here take less than half the time.
    fn answer_of<const R: usize, const N: usize>(
        &self,
        contacts: &Contacts,
        epsilon: f64,
        friction: FrictionLimits,
        q: &[f64],
    ) -> Answer<N> {
        let mut forces = vec![0.0; contacts.compliance.len()];
        let mut imbalance: Vec<f64> = q
            .iter()
            .zip(&contacts.row_images)
            .zip(&contacts.statics.dead)
            .map(|((q, n), w)| epsilon * q / n - w)
            .collect();
        let size = if N == 0 { 0 } else { self.entries.len() };
        let mut triangles = std::array::from_fn(|_| vec![0.0; size]);
        for values in &mut triangles {
            for (start, n) in self.starts.iter().zip(&contacts.row_images) {
                values[*start] = epsilon / n;
            }
        }
        // Points between the same two blocks follow one another.
        let pairs = self.joints.chunk_by(|a, b| a.blocks == b.blocks);
        let mut points = contacts.points.iter();
        for joints in pairs {
            let Some(ContactColumns { blocks, after, .. }) = joints.first() else { continue };
            let rates: [[f64; R]; 2] = std::array::from_fn(|side| first(&q[blocks[side].clone()]));
            let mut given = [[0.0; R]; 2];
            let mut squares = [[[[0.0; R]; R]; 3]; N];
            for (joint, point) in joints.iter().zip(&mut points) {
                let (n, c) = (point.columns, contacts.compliance[point.column]);
                let all = c * contacts.column_images[point.column];
                let parts: [&[[f64; MOST]]; 2] = std::array::from_fn(|side| {
                    let count = if blocks[side].is_empty() { 0 } else { n };
                    &self.operator[joint.first[side]..joint.first[side] + count]
                });
                let mut f = wanted(parts, &rates, all);
                let mut slope = [[0.0; MOST]; MOST];
                let wants = (N > 0).then_some(&mut slope);
                answer(point, c, friction.of(joint, point), &mut f, wants);
                forces[point.column..point.column + n].copy_from_slice(&f[..n]);
                give(parts, &f, &mut given);
                if N == 0 {
                    continue;
                }
                slope.iter_mut().take(n).flat_map(|row| &mut row[..n]).for_each(|s| *s /= all);
                if slope.iter().take(n).flat_map(|row| &row[..n]).any(|s| *s != 0.0) {
                    add(parts, &slope, &mut squares);
                }
            }
            for (side, rows) in blocks.iter().enumerate() {
                take_off(&mut imbalance[rows.clone()], &given[side]);
            }
            for (values, squares) in triangles.iter_mut().zip(&squares) {
                for ([other, side], square) in PAIRS.iter().zip(squares) {
                    let (columns, rows) = (&blocks[*other], blocks[*side].len());
                    for (i, (column, sums)) in columns.clone().zip(square).enumerate() {
                        let own = self.starts[column];
                        let (start, from) = if other == side {
                            (own, i)
                        } else {
                            (own + columns.len() - i + after, 0)
                        };
                        let values = &mut values[start..start + rows - from];
                        values.iter_mut().zip(&sums[from..rows]).for_each(|(v, s)| *v += s);
                    }
                }
            }
        }
        Answer { forces, imbalance, triangles }
    }
}

/// Columns and rows of the parts of a matrix that two blocks have, each as a side of their joint.
const PAIRS: [[usize; 2]; 3] = [[0, 0], [0, 1], [1, 1]];

/// As many numbers, zeros where there are no more.
fn first<const R: usize>(list: &[f64]) -> [f64; R] {
    let mut first = [0.0; R];
    first.iter_mut().zip(list).for_each(|(to, v)| *to = *v);
    first
}

/// `−u / c` of a point with these parts of `A`, `c` the compliance of all its images.
fn wanted<const R: usize>(
    parts: [&[[f64; MOST]]; 2],
    rates: &[[f64; R]; 2],
    c: f64,
) -> [f64; MOST] {
    let mut wanted = [0.0; MOST];
    for (parts, rates) in parts.iter().zip(rates) {
        for (w, part) in wanted.iter_mut().zip(*parts) {
            *w -= (0..R).map(|i| part[i] * rates[i]).sum::<f64>() / c;
        }
    }
    wanted
}

/// Adds what forces of a point do to its blocks.
fn give<const R: usize>(parts: [&[[f64; MOST]]; 2], f: &[f64; MOST], given: &mut [[f64; R]; 2]) {
    for (parts, given) in parts.iter().zip(given) {
        for (part, f) in parts.iter().zip(f).filter(|(_, f)| **f != 0.0) {
            (0..R).for_each(|i| given[i] += part[i] * f);
        }
    }
}

fn take_off(rows: &mut [f64], given: &[f64]) {
    rows.iter_mut().zip(given).for_each(|(row, given)| *row -= given);
}

/// Adds `A D Aᵀ` of a point, and the second time `A Dᵀ Aᵀ`, by [`PAIRS`] and columns.
fn add<const R: usize, const N: usize>(
    parts: [&[[f64; MOST]]; 2],
    slope: &[[f64; MOST]; MOST],
    squares: &mut [[[[f64; R]; R]; 3]; N],
) {
    for (transposed, squares) in squares.iter_mut().enumerate() {
        // A D of either block, then its products with Aᵀ of this block and the one before it.
        for (side, parts_here) in parts.iter().enumerate() {
            let mut left = [[0.0; R]; MOST];
            for (j, left) in left.iter_mut().enumerate().take(parts_here.len()) {
                for (k, part) in parts_here.iter().enumerate() {
                    let by = if transposed == 0 { slope[k][j] } else { slope[j][k] };
                    (0..R).for_each(|i| left[i] += part[i] * by);
                }
            }
            for ([other, _], square) in
                PAIRS.iter().zip(&mut *squares).filter(|(p, _)| p[1] == side)
            {
                for (left, part) in left.iter().zip(parts[*other]) {
                    for (sums, by) in square.iter_mut().zip(part) {
                        (0..R).for_each(|i| sums[i] += left[i] * by);
                    }
                }
            }
        }
    }
}

/// Makes of what a point wants the nearest forces that it may have, and with `slope` how they change.
fn answer(
    point: &SlidingPoint,
    c: f64,
    friction: FrictionLimits,
    f: &mut [f64; MOST],
    mut slope: Option<&mut [[f64; MOST]; MOST]>,
) {
    if let FrictionLimits::Since(memory) = friction {
        f.iter_mut().zip(memory).for_each(|(f, m)| *f += m);
    }
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
        onto_cone(f, at, [disc.slope, disc.constant, tension], slope);
        return;
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
            FrictionLimits::Law | FrictionLimits::Since(_) => disc.limit(f[0]),
        };
        let at = disc.first - point.column..disc.first - point.column + disc.count;
        let cut = onto_disc(f, at.clone(), s, slope.as_deref_mut());
        if let (FrictionLimits::Law | FrictionLimits::Since(_), true, Some(slope)) =
            (friction, cut && s > 0.0 && disc.slope > 0.0, slope.as_deref_mut())
        {
            let normal = slope[0][0];
            for i in at {
                slope[i][0] = disc.slope * normal * f[i] / s;
            }
        }
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
