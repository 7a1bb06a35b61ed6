//! The equations of a model in blocks of 6 × 6: what all joints together do to the free blocks.

use super::{
    joints::{ElasticJoint, JointKind, Joints},
    law::{Friction, Resultant, along, opens},
    member::Carries,
    state::ElasticState,
};
use crate::verdict::Rate;
use base::plane::Sets;
use cholesky::Pattern;
use model::{assembly::Wrench, interface::Model};
use nalgebra::{Matrix6, Vector6};
use std::collections::BTreeMap;

/// Where the blocks and joints of a model stand among its equations.
pub struct System<'a> {
    /// The model.
    pub model: &'a Model,
    /// Its joints.
    pub joints: &'a Joints,
    /// The free blocks in the order of their rows, six each.
    pub free: Vec<usize>,
    /// The lower triangle of the tangent.
    pub pattern: Pattern,
    /// Of all glued joints together, the diagonal: what residuals and steps are measured by.
    pub diagonal: Vec<f64>,
    row: Vec<Option<usize>>,
    /// Pairs of rows that a joint joins, the greater first, with their place.
    pairs: BTreeMap<(usize, usize), usize>,
    /// For each row the greater ones that it is joined with, and their places.
    below: Vec<Vec<(usize, usize)>>,
    /// The slopes of glued joints.
    glue: Vec<Matrix6<f64>>,
}

/// A tangent: blocks on the diagonal, and both blocks of each pair, the lower one first.
pub struct Tangent {
    own: Vec<Matrix6<f64>>,
    pairs: Vec<[Matrix6<f64>; 2]>,
}

impl<'a> System<'a> {
    /// That of a model.
    pub fn new(model: &'a Model, joints: &'a Joints) -> Self {
        let free: Vec<usize> = model.assembly.free().collect();
        let mut row = vec![None; model.assembly.blocks.len()];
        free.iter().enumerate().for_each(|(k, &i)| row[i] = Some(k));
        let mut pairs = BTreeMap::new();
        for group in joints.groups() {
            let rows: Vec<usize> = group.iter().filter_map(|&i| row[i]).collect();
            for (k, &a) in rows.iter().enumerate() {
                for &b in &rows[..k] {
                    let next = pairs.len();
                    pairs.entry((a.max(b), a.min(b))).or_insert(next);
                }
            }
        }
        let mut below = vec![Vec::new(); free.len()];
        for (&(lower, upper), &place) in &pairs {
            below[upper].push((lower, place));
        }
        let mut pattern = Pattern { starts: vec![0], rows: Vec::new() };
        for (k, below) in below.iter().enumerate() {
            for column in 0..6 {
                pattern.rows.extend((column..6).map(|r| 6 * k + r));
                for &(other, _) in below {
                    pattern.rows.extend((0..6).map(|r| 6 * other + r));
                }
                pattern.starts.push(pattern.rows.len());
            }
        }
        let glue = joints.list.iter().map(|joint| glued(model, joint)).collect();
        let mut all =
            Self { model, joints, free, pattern, diagonal: Vec::new(), row, pairs, below, glue };
        let tangent = all.assemble(|k| all.glue[k], |m| joints.lines[m].stiffness);
        let diagonal = tangent.own.iter().zip(&all.free).flat_map(|(m, &i)| {
            let size = model.assembly.blocks[i].size;
            // A block that nothing touches has some measure as well.
            let force = (m[(0, 0)] + m[(1, 1)] + m[(2, 2)]).max(f64::MIN_POSITIVE);
            let turn = (m[(3, 3)] + m[(4, 4)] + m[(5, 5)]).max(LEAST_TURN * force * size * size);
            [force, force, force, turn, turn, turn]
        });
        all.diagonal = diagonal.collect();
        all
    }

    /// What is left of the loads on the free blocks, and the sum of all that acts on them.
    pub fn left(
        &self,
        state: &ElasticState,
        loads: &[Wrench],
        displaced: &[Rate],
        glue: f64,
        friction: Friction,
    ) -> [Vec<f64>; 2] {
        let assembly = &self.model.assembly;
        let mut left: Vec<Vector6<f64>> = self.free.iter().map(|&i| six(&loads[i])).collect();
        let mut passing: Vec<Vector6<f64>> = left.iter().map(|v| v.abs()).collect();
        for (k, joint) in self.joints.list.iter().enumerate() {
            let motion = joint.motion(assembly, displaced);
            let mut force = Vector6::zeros();
            if glue < 1.0 {
                let all = joint.respond(&state.past[k], &motion, friction);
                let parts = all.force.iter().chain(&all.moment);
                parts.enumerate().for_each(|(i, v)| force[i] = v * (1.0 - glue));
            }
            if glue > 0.0 {
                force += self.glue[k] * Vector6::from(motion) * glue;
            }
            for block in [joint.a, joint.b] {
                if let Some(row) = self.row[block] {
                    let on = joint.lever(assembly, block).transpose() * force;
                    left[row] += on;
                    passing[row] += on.abs();
                }
            }
        }
        for (line, ease) in self.joints.lines.iter().zip(&state.eases) {
            // Glued, it neither yields nor goes slack.
            let pull = line.pull(*ease, displaced);
            let tension = pull.tension * (1.0 - glue) + line.held(displaced) * glue;
            for (i, wrench) in &line.on {
                if let Some(row) = self.row[*i] {
                    let on = wrench * tension;
                    left[row] += on;
                    passing[row] += on.abs();
                }
            }
        }
        [left, passing]
            .map(|list| list.iter().flat_map(|v| v.iter().copied().collect::<Vec<_>>()).collect())
    }

    /// For each free block, in the order of rows, the first row of the structure that it belongs to:
    /// of blocks that joints join.
    pub fn parts(&self) -> Vec<usize> {
        let mut sets = Sets::new(self.free.len());
        for &(lower, upper) in self.pairs.keys() {
            sets.join(lower, upper);
        }
        (0..self.free.len()).map(|k| sets.find(k)).collect()
    }

    /// Masses and inertias of the free blocks.
    pub fn masses(&self) -> Vec<Matrix6<f64>> {
        let of = |&i: &usize| {
            let block = &self.model.assembly.blocks[i];
            let mut m = Matrix6::zeros();
            m.fixed_view_mut::<3, 3>(0, 0).fill_diagonal(block.mass);
            m.fixed_view_mut::<3, 3>(3, 3).copy_from(&block.inertia);
            m
        };
        self.free.iter().map(of).collect()
    }

    /// The tangent of all joints at a displacement.
    pub fn tangent(
        &self,
        state: &ElasticState,
        displaced: &[Rate],
        glue: f64,
        friction: Friction,
    ) -> Tangent {
        let of_joint = |k: usize| {
            let joint = &self.joints.list[k];
            let motion = joint.motion(&self.model.assembly, displaced);
            let mut slopes = Matrix6::zeros();
            if glue < 1.0 {
                slopes += joint.tangent(&state.past[k], &motion, friction).1 * (1.0 - glue);
            }
            if glue > 0.0 {
                slopes += self.glue[k] * glue;
            }
            slopes
        };
        let of_line = |m: usize| {
            let line = &self.joints.lines[m];
            let pull = line.pull(state.eases[m], displaced);
            // What yields goes on yielding.
            let stays = friction == Friction::Stays && pull.carries == Carries::Yields;
            let slope = if stays { 0.0 } else { pull.slope };
            slope * (1.0 - glue) + line.stiffness * glue
        };
        self.assemble(of_joint, of_line)
    }

    /// Stiffness of the blocks (force per displacement, positive where it resists), by the slopes of
    /// the joints and of the members.
    fn assemble(
        &self,
        slopes: impl Fn(usize) -> Matrix6<f64>,
        of_line: impl Fn(usize) -> f64,
    ) -> Tangent {
        let assembly = &self.model.assembly;
        let mut tangent = Tangent {
            own: vec![Matrix6::zeros(); self.free.len()],
            pairs: vec![[Matrix6::zeros(); 2]; self.pairs.len()],
        };
        for (k, joint) in self.joints.list.iter().enumerate() {
            // The force is on the second block; levers carry the signs.
            let own = -slopes(k);
            let [one, two] = [joint.a, joint.b].map(|b| joint.lever(assembly, b));
            let rows = [self.row[joint.a], self.row[joint.b]];
            for (row, lever) in rows.iter().zip([&one, &two]) {
                if let Some(row) = row {
                    tangent.own[*row] += lever.transpose() * own * lever;
                }
            }
            if let [Some(a), Some(b)] = rows
                && let Some(&place) = self.pairs.get(&(a.max(b), a.min(b)))
            {
                let (lower, upper) = if a > b { (&one, &two) } else { (&two, &one) };
                tangent.pairs[place][0] += lower.transpose() * own * upper;
                tangent.pairs[place][1] += upper.transpose() * own * lower;
            }
        }
        for (m, line) in self.joints.lines.iter().enumerate() {
            let slope = of_line(m);
            let on: Vec<_> = line.on.iter().filter_map(|(i, w)| Some((self.row[*i]?, w))).collect();
            for (k, (a, v)) in on.iter().enumerate() {
                tangent.own[*a] += *v * v.transpose() * slope;
                for (b, w) in &on[..k] {
                    let Some(&place) = self.pairs.get(&(*a.max(b), *a.min(b))) else { continue };
                    let (lower, upper) = if a > b { (v, w) } else { (w, v) };
                    tangent.pairs[place][0] += *lower * upper.transpose() * slope;
                    tangent.pairs[place][1] += *upper * lower.transpose() * slope;
                }
            }
        }
        tangent
    }

    /// The values of the tangent on the pattern, and of its mirror image entry by entry, rows and
    /// columns divided by `unit`, with `shift` added on the diagonal.
    pub fn values(&self, tangent: &Tangent, unit: &[f64], shift: f64) -> [Vec<f64>; 2] {
        let mut lower = Vec::with_capacity(self.pattern.rows.len());
        let mut upper = Vec::with_capacity(self.pattern.rows.len());
        for (k, own) in tangent.own.iter().enumerate() {
            for c in 0..6 {
                let column = unit[6 * k + c];
                for r in c..6 {
                    let by = column * unit[6 * k + r];
                    let shift = if r == c { shift } else { 0.0 };
                    lower.push(own[(r, c)] / by + shift);
                    upper.push(own[(c, r)] / by + shift);
                }
                for &(other, place) in &self.below[k] {
                    let [low, up] = &tangent.pairs[place];
                    for r in 0..6 {
                        let by = column * unit[6 * other + r];
                        lower.push(low[(r, c)] / by);
                        upper.push(up[(c, r)] / by);
                    }
                }
            }
        }
        [lower, upper]
    }
}

/// A block turns at least so stiffly, in multiples of its stiffness against moving times its size
/// squared. Less: spheres that roll are measured by nothing. More: turns count less than they are.
const LEAST_TURN: f64 = 1e-6;

fn six(w: &Wrench) -> Vector6<f64> {
    let (f, m) = (w.force, w.moment);
    Vector6::new(f.x, f.y, f.z, m.x, m.y, m.z)
}

/// The slopes of a glued joint: all of it presses, pulls and holds against sliding. Of spheres as
/// stiff as under the heavier one's weight.
fn glued(model: &Model, joint: &ElasticJoint) -> Matrix6<f64> {
    let mut slopes = Matrix6::zeros();
    match &joint.kind {
        JointKind::Bed(bed) => {
            for (p, area) in bed.whole() {
                let at = [p.x, p.y];
                for k in 0..6 {
                    let mut unit = [0.0; 6];
                    unit[k] = 1.0;
                    let way = along(&unit, at);
                    let force = [
                        -bed.shear * area * way[0],
                        -bed.shear * area * way[1],
                        -bed.normal * area * opens(&unit, at),
                    ];
                    let mut all = Resultant::zero();
                    all.add(at, force);
                    for (i, v) in all.force.iter().chain(&all.moment).enumerate() {
                        slopes[(i, k)] += v;
                    }
                }
            }
        }
        JointKind::Grain(grain) => {
            let weight = [joint.a, joint.b]
                .iter()
                .filter(|&&i| !model.assembly.blocks[i].support)
                .map(|&i| model.assembly.weight(i).max(model.assembly.dead[i].force.norm()))
                .fold(f64::MIN_POSITIVE, f64::max);
            let contact = (grain.radius * grain.approach(weight)).sqrt();
            slopes[(0, 0)] = -8.0 * contact * grain.shear;
            slopes[(1, 1)] = slopes[(0, 0)];
            slopes[(2, 2)] = -2.0 * contact * grain.modulus;
        }
    }
    slopes
}
