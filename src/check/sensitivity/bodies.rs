//! Blocks that are held together as bodies, and least squares on equations of their rates, solved on
//! the normal equations with a small shift, which corrections take away again.

use super::lagrangian::Proof;
use crate::verdict::Rate;
use base::plane::Sets;
use cholesky::{Cholesky, Pattern};
use model::{
    assembly::{Assembly, Wrench},
    interface::{Interface, Model},
};
use nalgebra::{Vector3, Vector6};
use std::{cell::RefCell, collections::BTreeMap};

/// The shift of the diagonal, × the greatest of it. Larger: more corrections. Smaller: rounding makes
/// a singular matrix indefinite.
const SHIFT: f64 = 1e-9;
/// Corrections, each of which takes most of the shift's effect away.
const ROUNDS: usize = 5;
/// Points span a plane where twice the area of a triangle of them is this × the square of their
/// distances. Larger: short edges hold nothing. Smaller: points on a line hold everything.
const SPANS: f64 = 1e-3;

/// One equation: of each body the six factors of its rates, spins over a length.
pub(super) type Row = Vec<(usize, [f64; 6])>;

/// Bodies, and equations of their rates.
pub(super) struct Bodies {
    /// The body of each block; none of the ground.
    of: Vec<Option<usize>>,
    /// A block of each, whose rates are its own.
    leads: Vec<usize>,
    /// Where that is, m.
    points: Vec<Vector3<f64>>,
    /// What spins are multiplied by, m.
    length: f64,
    least: Option<Least>,
}

impl Bodies {
    /// Blocks of a model, of which these joints make one.
    pub fn new(model: &Model, joined: impl Iterator<Item = usize>) -> Self {
        let Model { assembly, interfaces, .. } = model;
        let count = assembly.blocks.len();
        // One more for the ground.
        let mut sets = Sets::new(count + 1);
        for (i, _) in assembly.blocks.iter().enumerate().filter(|(_, b)| b.support) {
            sets.join(i, count);
        }
        for face in joined.map(|k| &interfaces.list[k]) {
            sets.join(face.a, face.b);
        }
        let ground = sets.find(count);
        let mut place = BTreeMap::new();
        let mut leads = Vec::new();
        let of: Vec<Option<usize>> = (0..count)
            .map(|i| {
                let set = sets.find(i);
                (set != ground).then(|| {
                    *place.entry(set).or_insert_with(|| {
                        leads.push(i);
                        leads.len() - 1
                    })
                })
            })
            .collect();
        let size = |i: usize| assembly.blocks[i].size;
        let length = assembly.free().map(size).sum::<f64>() / assembly.free().count() as f64;
        let points = leads.iter().map(|&i| assembly.blocks[i].centroid).collect();
        Self { of, points, leads, length, least: None }
    }

    /// Whether both blocks belong to one body.
    pub fn are_one(&self, [a, b]: [Option<usize>; 2]) -> bool {
        a.and_then(|i| self.of[i]) == b.and_then(|i| self.of[i])
    }

    /// Takes over the equations.
    pub fn solved(&mut self, rows: Vec<Row>) {
        self.least = Least::new(rows, self.leads.len());
    }

    /// Zero for all rates.
    pub fn nothing(&self) -> Vec<f64> {
        vec![0.0; 6 * self.leads.len()]
    }

    /// `direction · (velocity of b − velocity of a)` at a point.
    pub fn row(
        &self,
        ends: [Option<usize>; 2],
        point: &Vector3<f64>,
        direction: &Vector3<f64>,
    ) -> Row {
        self.both(ends, point, direction, &Vector3::zeros())
    }

    /// The same plus `turn · (spin of b − spin of a)`.
    fn both(
        &self,
        ends: [Option<usize>; 2],
        point: &Vector3<f64>,
        direction: &Vector3<f64>,
        turn: &Vector3<f64>,
    ) -> Row {
        let mut row = Row::new();
        for (block, sign) in ends.into_iter().zip([-1.0, 1.0]) {
            let Some(body) = block.and_then(|i| self.of[i]) else { continue };
            let turn = ((point - self.points[body]).cross(direction) + turn) / self.length;
            let [d, t] = [direction * sign, turn * sign];
            row.push((body, [d.x, d.y, d.z, t.x, t.y, t.z]));
        }
        row
    }

    /// The middle of a joint, and the rates of its sides against each other there, spins by a length.
    fn twist(&self, proof: &Proof, face: &Interface) -> (Vector3<f64>, Vector6<f64>) {
        let middle = face.points.iter().sum::<Vector3<f64>>() / face.points.len() as f64;
        let at = |i: usize| crate::verdict::at(&proof.model.assembly, proof.rates, i, &middle);
        let velocity = at(face.b) - at(face.a);
        let spin = (proof.rates[face.b].spin - proof.rates[face.a].spin) * self.length;
        let [v, s] = [velocity, spin];
        (middle, Vector6::new(v.x, v.y, v.z, s.x, s.y, s.z))
    }

    /// What is one along the rates of a joint, and nothing across them.
    pub fn along(&self, proof: &Proof, face: &Interface) -> Row {
        let (middle, twist) = self.twist(proof, face);
        self.of_twist(face, &middle, &(twist / twist.norm_squared()))
    }

    /// That a joint moves as it does, faster or slower: one strength gives way along one motion.
    pub fn proportional(&self, proof: &Proof, face: &Interface) -> Vec<Row> {
        let (middle, twist) = self.twist(proof, face);
        let mut known = vec![twist.normalize()];
        let mut rows = Vec::new();
        while rows.len() < 5 {
            // What of the axes is left by those that are known: the longest.
            let left = (0..6).map(|k| {
                let axis = Vector6::ith(k, 1.0);
                known.iter().fold(axis, |left, d| left - d * d.dot(&left))
            });
            let Some(next) = left.max_by(|a, b| a.norm().total_cmp(&b.norm())) else { break };
            let next = next.normalize();
            rows.push(self.of_twist(face, &middle, &next));
            known.push(next);
        }
        rows
    }

    fn of_twist(&self, face: &Interface, middle: &Vector3<f64>, by: &Vector6<f64>) -> Row {
        let [direction, turn] = [by.fixed_rows::<3>(0), by.fixed_rows::<3>(3)];
        let turn: Vector3<f64> = turn * self.length;
        self.both([Some(face.a), Some(face.b)], middle, &direction.into_owned(), &turn)
    }

    /// A wrench on a block, as factors of the rates of its body.
    pub fn add(&self, into: &mut [f64], assembly: &Assembly, block: usize, w: &Wrench, by: f64) {
        let Some(body) = self.of[block] else { return };
        let arm = assembly.blocks[block].centroid - self.points[body];
        let moment = (w.moment + arm.cross(&w.force)) / self.length;
        for k in 0..3 {
            into[6 * body + k] += by * w.force[k];
            into[6 * body + 3 + k] += by * moment[k];
        }
    }

    /// Rates of the bodies.
    pub fn rates(&self, rates: &[Rate]) -> Vec<f64> {
        let mut all = Vec::with_capacity(6 * self.leads.len());
        for &lead in &self.leads {
            all.extend(rates[lead].velocity.iter());
            all.extend(rates[lead].spin.iter().map(|s| s * self.length));
        }
        all
    }

    /// What of `h` is no sum of equations.
    pub fn outside_rows(&self, h: &[f64]) -> Vec<f64> {
        self.least.as_ref().map_or_else(|| h.to_vec(), |least| least.outside_rows(h))
    }

    /// What of one number an equation follows from no rates.
    pub fn outside_columns(&self, mut g: Vec<f64>) -> Vec<f64> {
        let Some(least) = &self.least else { return g };
        g.resize(least.rows.len(), 0.0);
        least.outside_columns(&g)
    }
}

/// Whether points span a plane.
pub(super) fn spans(points: &[Vector3<f64>]) -> bool {
    let [first, rest @ ..] = points else { return false };
    let far = rest.iter().map(|p| p - first).max_by(|a, b| a.norm().total_cmp(&b.norm()));
    let Some(far) = far else { return false };
    rest.iter().any(|p| (p - first).cross(&far).norm() > SPANS * far.norm_squared())
}

/// Least squares by a matrix that is given by its rows.
struct Least {
    rows: Vec<Row>,
    shift: f64,
    unknowns: usize,
    factor: RefCell<Cholesky>,
}

impl Least {
    /// Nothing where there are no rows, or no memory.
    fn new(rows: Vec<Row>, blocks: usize) -> Option<Self> {
        let mut parts: BTreeMap<(usize, usize), [f64; 36]> = BTreeMap::new();
        for k in 0..blocks {
            parts.insert((k, k), [0.0; 36]);
        }
        for row in &rows {
            for (i, a) in row {
                for (j, b) in row.iter().filter(|(j, _)| j <= i) {
                    let part = parts.entry((*j, *i)).or_insert([0.0; 36]);
                    for (r, x) in a.iter().enumerate() {
                        b.iter().enumerate().for_each(|(c, y)| part[6 * c + r] += x * y);
                    }
                }
            }
        }
        let greatest = parts.iter().filter(|((j, i), _)| i == j);
        let greatest = greatest.flat_map(|(_, p)| (0..6).map(|k| p[7 * k])).fold(0.0, f64::max);
        if greatest == 0.0 {
            return None;
        }
        let shift = SHIFT * greatest;
        let (mut starts, mut list, mut values) = (vec![0], Vec::new(), Vec::new());
        for column in 0..blocks {
            for c in 0..6 {
                for ((_, i), part) in parts.range((column, 0)..(column + 1, 0)) {
                    for r in (0..6).filter(|r| *i > column || *r >= c) {
                        list.push(6 * i + r);
                        let more = if *i == column && r == c { shift } else { 0.0 };
                        values.push(part[6 * c + r] + more);
                    }
                }
                starts.push(list.len());
            }
        }
        let mut factor = Cholesky::new(Pattern { starts, rows: list })?;
        let unknowns = 6 * blocks;
        factor.factorize(&values).then(|| Self { rows, shift, unknowns, factor: factor.into() })
    }

    fn multiply(&self, x: &[f64]) -> Vec<f64> {
        let dot = |(k, a): &(usize, [f64; 6])| (0..6).map(|i| a[i] * x[6 * k + i]).sum::<f64>();
        self.rows.iter().map(|row| row.iter().map(dot).sum()).collect()
    }

    fn transposed(&self, y: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; self.unknowns];
        for (row, y) in self.rows.iter().zip(y) {
            for (k, a) in row {
                (0..6).for_each(|i| x[6 * k + i] += a[i] * y);
            }
        }
        x
    }

    /// What of `h` is no sum of rows.
    fn outside_rows(&self, h: &[f64]) -> Vec<f64> {
        let mut left = h.to_vec();
        for _ in 0..ROUNDS {
            let mut x = left.clone();
            self.factor.borrow_mut().solve(&mut x);
            // What is left of a step is the shift times it.
            left = x.into_iter().map(|x| self.shift * x).collect();
        }
        left
    }

    /// What of `g` is no sum of columns.
    fn outside_columns(&self, g: &[f64]) -> Vec<f64> {
        let mut left = g.to_vec();
        for _ in 0..ROUNDS {
            let mut y = self.transposed(&left);
            self.factor.borrow_mut().solve(&mut y);
            let part = self.multiply(&y);
            left.iter_mut().zip(part).for_each(|(l, p)| *l -= p);
        }
        left
    }
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub(super) fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}
