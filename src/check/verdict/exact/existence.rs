//! Do forces near the given ones balance exactly?
//!
//! *Claim.* Given forces leave the blocks a little, `r`, for they are doubles. Let `m_i` be how far
//! force `i` can change inside its cone and `S = Σ D_i B_i B_iᵀ` with `B_i` what a change of force
//! `i` does to the blocks and `D_i ≥ 0` (zero where `m_i` is). If `S` is positive definite, `d_i =
//! −D_i B_iᵀ S⁻¹ r` balances what is left: `Σ B_i d_i = −r`, and `‖d_i‖ ≤ D_i ‖B_i‖ ‖r‖ /
//! λ_min(S)`. Where that is at most `m_i`, the forces `f_i + d_i` lie in their cones and balance:
//! they exist, and the scene stands.
//!
//! *Method.* Most of the change is computed, with doubles that are then added without rounding; the
//! bound covers only what that leaves, some 1e-28 of the loads. The lower bound of the smallest
//! eigenvalue is the shift with which one Cholesky factorisation in doubles still ends, less what
//! rounding may have done to it: `(n + 1) ε tr S` for the factorisation (Rump, BIT 46, 2006, from
//! Demmel 1989), as much again for the sums that make the entries. Forces with room in all
//! directions count with all three; without friction, along the normal. The existence of a solution
//! near an approximate one: Jansson, Chaykin & Keil, SIAM J. Numer. Anal. 46, 2007.

use super::balance::{Balance, ENLARGED, Pair, REDUCED, Room, exactly, multiple, room};
use crate::verdict::{
    Forces, certificate,
    joint::Strength,
    member::{self, Bounds},
};
use base::tolerance;
use cholesky::{Cholesky, Pattern};
use model::{
    assembly::Member,
    interface::{Interfaces, Members, Model, members},
    strength::crushing::crushes,
};
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use std::collections::{BTreeMap, HashMap};

type Vector6 = SVector<f64, 6>;
type Matrix6 = SMatrix<f64, 6, 6>;

/// How the room of a force counts in `S`: `m^p`. The first suits forces of very different sizes,
/// the last load factors, where much of the room is as small as the distance from the limit.
const POWERS: [f64; 3] = [1.0, 0.5, 0.0];

/// Rounds of correction. Each leaves some 1e-10 of what was there; the second ends at the rounding
/// of the sums.
const ROUNDS: usize = 3;

/// The share of its room that the computed change of a force may use; the rest is for the bound.
const USED: f64 = 0.5;

/// Parts of more free blocks are proved to rounding. More: factors of tens of thousands of rows,
/// which cost more than the answer itself.
pub const MOST_BLOCKS: usize = 1500;

/// A force that can change, and what it does.
struct Column {
    place: ForceAt,
    /// Rows of the blocks that it acts on, with the arm; first the one that it acts on with the
    /// opposite sign.
    blocks: [Option<(usize, Vector3<f64>)>; 2],
    room: f64,
    direction: Option<Vector3<f64>>,
}

/// Where a force stands.
#[derive(Clone, Copy)]
enum ForceAt {
    /// In a contact, at one of its points.
    Contact(usize, usize),
    /// In a member that acts at one point.
    Member(usize),
}

impl Column {
    /// Adds a change of it to a balance, without rounding.
    fn put(&self, interfaces: &Interfaces, change: &Vector3<f64>, balance: &mut Balance) {
        match self.place {
            ForceAt::Contact(k, point) => {
                let force: Pair = match self.direction {
                    Some(n) => multiple(n.dot(change) / n.norm_squared(), &n),
                    None => exactly(change),
                };
                let face = &interfaces.list[k];
                balance.add(face, &face.points[point], &force);
            }
            ForceAt::Member(m) => {
                let own = &interfaces.members[m];
                balance.add_member(own, &in_amounts(own, change));
            }
        }
    }

    /// `B_i` for one of its blocks.
    fn part(&self, side: usize) -> Option<(usize, SMatrix<f64, 6, 3>)> {
        let (row, arm) = self.blocks[side]?;
        let sign = if side == 0 { -1.0 } else { 1.0 };
        let mut b = SMatrix::<f64, 6, 3>::zeros();
        b.fixed_view_mut::<3, 3>(0, 0).copy_from(&(Matrix3::identity() * sign));
        b.fixed_view_mut::<3, 3>(3, 0).copy_from(&(arm.cross_matrix() * sign));
        Some((row, b))
    }

    /// What is left of a change of the force in the directions that it has.
    fn along(&self, change: Vector3<f64>) -> Vector3<f64> {
        self.direction.map_or(change, |n| n * n.dot(&change))
    }
}

/// Which blocks are held by forces that balance exactly, in their cones and near the given ones, at
/// load factor `lambda`: all of a part or none, each part by itself, so that what one is too large
/// or too poor for is no matter of another. Supports count as held.
pub fn covered(model: &Model, forces: &Forces, lambda: f64) -> Vec<bool> {
    let assembly = &model.assembly;
    let (rooms, mut balance) = rooms(model, forces, lambda);
    let mut covered = vec![true; assembly.blocks.len()];
    for part in members(model) {
        let held = has_room(&part, model.interfaces.list.len(), &rooms)
            && is_near(&part, model, forces, lambda, &balance, tolerance::NEAR_BALANCE)
            && exists_for(&part, model, &rooms, &mut balance);
        part.free.iter().for_each(|&i| covered[i] = held);
    }
    covered
}

/// Whether all free blocks are [`covered`].
pub fn exists(model: &Model, forces: &Forces, lambda: f64) -> bool {
    covered(model, forces, lambda).into_iter().all(|held| held)
}

/// The room of every force, and what all of them leave; no rooms in a contact where a force lies
/// outside its cone, nor where a joint can crush: its corners share one bound.
fn rooms<'a>(
    model: &'a Model,
    forces: &Forces,
    lambda: f64,
) -> (Vec<Option<Vec<Room>>>, Balance<'a>) {
    let interfaces = &model.interfaces;
    let mut balance = Balance::loads(model, lambda);
    let rooms = interfaces.list.iter().zip(forces).map(|(face, forces)| {
        let strength = Strength::of(face);
        let list: Vec<Room> =
            forces.iter().enumerate().map(|(k, f)| room(face, k, f, &strength)).collect();
        for ((point, r), f) in face.points.iter().zip(&list).zip(forces) {
            balance.add(face, point, &r.force);
            balance.add_couple(face, &f.moment);
        }
        let inside = !crushes(face) && list.iter().all(|r| r.margin >= 0.0);
        inside.then_some(list)
    });
    let mut rooms: Vec<Option<Vec<Room>>> = rooms.collect();
    for (own, forces) in interfaces.members.iter().zip(forces.iter().skip(interfaces.list.len())) {
        let amounts = member::amounts(forces);
        balance.add_member(own, &amounts);
        let room = member_room(own, &amounts);
        rooms.push((room.margin >= 0.0).then(|| vec![room]));
    }
    (rooms, balance)
}

/// The room of a member: of one amount along its direction, of the three of a finger in all
/// directions. One that acts at several points, or a shear, is taken as it is: its room is not used.
fn member_room(own: &Member, amounts: &Vector3<f64>) -> Room {
    let margin = Bounds::of(own).margin(amounts);
    let margin = if margin.is_nan() { f64::NEG_INFINITY } else { margin };
    let legs = member::legs(own);
    let directed = Bounds::of(own).axes() == 1;
    let usable = if directed { legs.len() == 1 } else { legs.len() == 3 };
    Room {
        force: [(0.0, 0.0); 3],
        margin: if usable || margin < 0.0 { margin * REDUCED } else { 0.0 },
        direction: (directed && usable).then(|| legs[0].direction),
    }
}

/// A change of the force of a member that acts at one point, as amounts.
fn in_amounts(own: &Member, change: &Vector3<f64>) -> Vector3<f64> {
    let mut amounts = Vector3::zeros();
    for leg in member::legs(own) {
        amounts[leg.axis] = leg.direction.dot(change) / leg.direction.norm_squared();
    }
    amounts
}

/// Forces near the given ones that leave no more than rounding, in their cones; `None` where there
/// is no room for them.
pub fn improved(model: &Model, forces: &Forces, lambda: f64) -> Option<Forces> {
    let interfaces = &model.interfaces;
    let (rooms, mut balance) = rooms(model, forces, lambda);
    let mut improved = forces.clone();
    for part in members(model) {
        if !has_room(&part, model.interfaces.list.len(), &rooms)
            || !is_near(&part, model, forces, lambda, &balance, tolerance::LOOSE_BALANCE)
        {
            return None;
        }
        let columns = columns(&part, model, &rooms);
        let changes = POWERS.into_iter().find_map(|power| {
            let mut stiffness = Stiffness::new(&columns, part.free.len(), power)?;
            let changes = stiffness.changes(&columns, &balance, &part)?;
            let fits =
                changes.iter().zip(&columns).all(|(change, c)| change.norm() <= USED * c.room);
            fits.then_some(changes)
        })?;
        for (column, change) in columns.iter().zip(changes) {
            match column.place {
                ForceAt::Contact(k, point) => {
                    let face = &interfaces.list[k];
                    balance.add(face, &face.points[point], &exactly(&change));
                    improved[k][point].force += change;
                }
                ForceAt::Member(m) => {
                    let own = &interfaces.members[m];
                    let change = in_amounts(own, &change);
                    balance.add_member(own, &change);
                    improved[interfaces.list.len() + m][0].force += change;
                }
            }
        }
    }
    Some(improved)
}

/// Whether a proof can be tried: a part of no more than [`MOST_BLOCKS`] whose joints have
/// [rooms]; the members' stand after those of the `joints`.
fn has_room(part: &Members, joints: usize, rooms: &[Option<Vec<Room>>]) -> bool {
    part.free.len() <= MOST_BLOCKS
        && part.contacts.iter().all(|&k| rooms[k].is_some())
        && part.members.iter().all(|&k| rooms[joints + k].is_some())
}

/// Whether no block is left with more than `most` of its loads, or of the forces on it: a light
/// block between heavy ones has forces that no doubles balance any better. Forces far larger
/// than all loads together hold nothing ([`COARSE_FORCE_CAP`](tolerance::COARSE_FORCE_CAP)): at
/// survey coordinates, without a limit to friction, the rounding of the coordinates alone would
/// bear what falls.
fn is_near(
    part: &Members,
    model: &Model,
    forces: &Forces,
    lambda: f64,
    balance: &Balance,
    most: f64,
) -> bool {
    let Model { assembly, interfaces, .. } = model;
    let own = |i: usize| {
        certificate::load_scale(assembly, i)
            .max(lambda.abs() * certificate::size(assembly, i, &assembly.live[i]))
    };
    let total: f64 = part.free.iter().map(|&i| own(i)).sum();
    let cap = if total > 0.0 { tolerance::COARSE_FORCE_CAP * total } else { f64::INFINITY };
    let mut greatest: HashMap<usize, f64> = HashMap::new();
    for &k in &part.contacts {
        let force = forces[k].iter().map(|f| f.force.norm()).fold(0.0, f64::max);
        if force > cap {
            return false;
        }
        for i in [interfaces.list[k].a, interfaces.list[k].b] {
            let known = greatest.entry(i).or_default();
            *known = known.max(force);
        }
    }
    for &m in &part.members {
        let force = member::amounts(&forces[interfaces.list.len() + m]).norm();
        if force > cap {
            return false;
        }
        for i in interfaces.members[m].action.ends().into_iter().flatten() {
            let known = greatest.entry(i).or_default();
            *known = known.max(force);
        }
    }
    part.free
        .iter()
        .all(|i| balance.size(*i) <= most * own(*i).max(greatest.get(i).copied().unwrap_or(0.0)))
}

fn exists_for(
    part: &Members,
    model: &Model,
    rooms: &[Option<Vec<Room>>],
    balance: &mut Balance,
) -> bool {
    let interfaces = &model.interfaces;
    let is_zero = |i: &usize| balance.left(*i).iter().all(|c| c.lower == 0.0 && c.upper == 0.0);
    if part.free.iter().all(is_zero) {
        return true;
    }
    let columns = columns(part, model, rooms);
    POWERS.into_iter().any(|power| {
        let mut balance = balance.clone();
        Stiffness::new(&columns, part.free.len(), power)
            .is_some_and(|mut s| s.covers(&columns, interfaces, &mut balance, part))
    })
}

/// The forces that have room.
fn columns(part: &Members, model: &Model, rooms: &[Option<Vec<Room>>]) -> Vec<Column> {
    let Model { assembly, interfaces, .. } = model;
    let row_of: HashMap<usize, usize> =
        part.free.iter().enumerate().map(|(row, &i)| (i, row)).collect();
    let mut list = Vec::new();
    for &k in &part.contacts {
        let face = &interfaces.list[k];
        for (p, (point, r)) in face
            .points
            .iter()
            .zip(rooms[k].iter().flatten())
            .enumerate()
            .filter(|(_, (_, r))| r.margin > 0.0)
        {
            let blocks = [face.a, face.b]
                .map(|i| Some((*row_of.get(&i)?, point - assembly.blocks[i].centroid)));
            list.push(Column {
                place: ForceAt::Contact(k, p),
                blocks,
                room: r.margin,
                direction: r.direction,
            });
        }
    }
    for &m in &part.members {
        let own = &interfaces.members[m];
        let Some([room]) = rooms[interfaces.list.len() + m].as_deref() else { continue };
        let Some(leg) = member::legs(own).into_iter().next().filter(|_| room.margin > 0.0) else {
            continue;
        };
        let blocks = [leg.a, leg.b].map(|i| {
            let i = i?;
            Some((*row_of.get(&i)?, leg.at - assembly.blocks[i].centroid))
        });
        list.push(Column {
            place: ForceAt::Member(m),
            blocks,
            room: room.margin,
            direction: room.direction,
        });
    }
    list
}

/// `T S T` with its factors and a lower bound of its smallest eigenvalue.
struct Stiffness {
    /// Powers of two that bring the diagonal of `S` near one.
    scale: Vec<Vector6>,
    /// `D_i`.
    weights: Vec<f64>,
    factors: Cholesky,
    least: f64,
}

impl Stiffness {
    fn new(columns: &[Column], blocks: usize, power: f64) -> Option<Self> {
        let most = columns.iter().map(|c| c.room).fold(0.0, f64::max);
        let weights: Vec<f64> = columns.iter().map(|c| (c.room / most).powf(power)).collect();
        let mut diagonal = vec![Matrix6::zeros(); blocks];
        let mut beside: BTreeMap<(usize, usize), Matrix6> = Default::default();
        // The diagonal as it were if nothing cancelled in a product: what rounding is measured by.
        let mut absolute = vec![Vector6::zeros(); blocks];
        let mut terms = vec![0_usize; blocks];
        for (column, weight) in columns.iter().zip(&weights) {
            let sides = [column.part(0), column.part(1)];
            let weigh = |b: &SMatrix<f64, 6, 3>| {
                column.direction.map_or(b * *weight, |n| b * (n * n.transpose()) * *weight)
            };
            for (row, b) in sides.into_iter().flatten() {
                diagonal[row] += weigh(&b) * b.transpose();
                absolute[row] += Vector6::from_fn(|k, _| match column.direction {
                    Some(n) => {
                        weight
                            * b.row(k)
                                .iter()
                                .zip(&n)
                                .map(|(b, n)| (b * n).abs())
                                .sum::<f64>()
                                .powi(2)
                    }
                    None => weight * b.row(k).norm_squared(),
                });
                terms[row] += 1;
            }
            if let [Some((r, b)), Some((s, c))] = sides {
                let (low, high, entry) = if r < s {
                    (r, s, weigh(&c) * b.transpose())
                } else {
                    (s, r, weigh(&b) * c.transpose())
                };
                *beside.entry((low, high)).or_default() += entry;
            }
        }
        let scale: Vec<Vector6> = diagonal
            .iter()
            .map(|d| {
                Vector6::from_fn(|k, _| {
                    if d[(k, k)] > 0.0 { (-0.5 * d[(k, k)].log2()).round().exp2() } else { 0.0 }
                })
            })
            .collect();
        if scale.iter().flatten().any(|t| *t == 0.0 || !t.is_finite()) {
            return None;
        }
        let n = 6 * blocks;
        let trace: f64 = absolute.iter().zip(&scale).map(|(a, t)| a.dot(&t.component_mul(t))).sum();
        let rounding =
            f64::EPSILON * trace * (n + 4 * terms.iter().max().unwrap_or(&0) + 32) as f64;
        // The shift is four times what rounding may have done, and three of the four are left as
        // the bound.
        let shift = 4.0 * rounding;
        let (pattern, values) = lower_triangle(&diagonal, &beside, &scale, shift);
        let mut factors = Cholesky::new(pattern)?;
        factors.factorize(&values).then_some(Self {
            scale,
            weights,
            factors,
            least: 3.0 * rounding,
        })
    }

    /// Corrects what is left, and says whether the change of each force and the bound on the rest
    /// stay inside its room.
    fn covers(
        &mut self,
        columns: &[Column],
        interfaces: &Interfaces,
        balance: &mut Balance,
        part: &Members,
    ) -> bool {
        let mut sizes = vec![0.0_f64; columns.len()];
        for round in 0..=ROUNDS {
            let left: Vec<[f64; 6]> =
                part.free.iter().map(|&i| balance.left(i).map(|c| c.magnitude())).collect();
            let scaled = |row: usize| Vector6::from_fn(|k, _| left[row][k] * self.scale[row][k]);
            let size = (0..left.len()).map(|row| scaled(row).norm_squared()).sum::<f64>().sqrt()
                * ENLARGED;
            let by = size / (self.least * REDUCED) * ENLARGED;
            let fits = columns.iter().zip(&self.weights).zip(&sizes).all(|((c, weight), used)| {
                let reach: f64 = [0, 1]
                    .iter()
                    .filter_map(|&side| c.part(side))
                    .map(|(row, b)| self.scaled(row, &b).norm_squared())
                    .sum();
                let length = c.direction.map_or(1.0, |n| n.norm_squared());
                used + weight * reach.sqrt() * length * by * ENLARGED <= c.room
            });
            if fits {
                return true;
            }
            if round == ROUNDS || !size.is_finite() {
                break;
            }
            let Some(changes) = self.changes(columns, balance, part) else { break };
            for (at, (column, change)) in columns.iter().zip(changes).enumerate() {
                sizes[at] += change.norm() * ENLARGED;
                if sizes[at] > USED * column.room {
                    return false;
                }
                column.put(interfaces, &change, balance);
            }
        }
        false
    }

    /// `−D_i B_iᵀ S⁻¹ r`, computed in doubles; `None` where they are not finite.
    fn changes(
        &mut self,
        columns: &[Column],
        balance: &Balance,
        part: &Members,
    ) -> Option<Vec<Vector3<f64>>> {
        let mut y = Vec::with_capacity(6 * part.free.len());
        for (&i, scale) in part.free.iter().zip(&self.scale) {
            y.extend(balance.left(i).iter().zip(scale).map(|(left, t)| left.middle() * t));
        }
        self.factors.solve(&mut y);
        let list = columns.iter().zip(&self.weights).map(|(column, weight)| {
            let mut toward = Vector3::zeros();
            for (row, b) in [0, 1].iter().filter_map(|&side| column.part(side)) {
                toward +=
                    b.transpose() * Vector6::from_fn(|k, _| y[6 * row + k] * self.scale[row][k]);
            }
            let change = column.along(toward) * -weight;
            change.iter().all(|c| c.is_finite()).then_some(change)
        });
        list.collect()
    }

    /// `T B_i` for one block.
    fn scaled(&self, row: usize, b: &SMatrix<f64, 6, 3>) -> SMatrix<f64, 6, 3> {
        let mut scaled = *b;
        for (k, mut r) in scaled.row_iter_mut().enumerate() {
            r *= self.scale[row][k];
        }
        scaled
    }
}

/// The lower triangle of `T S T − shift`, column by column.
fn lower_triangle(
    diagonal: &[Matrix6],
    beside: &BTreeMap<(usize, usize), Matrix6>,
    scale: &[Vector6],
    shift: f64,
) -> (Pattern, Vec<f64>) {
    let mut below: Vec<Vec<(usize, &Matrix6)>> = vec![Vec::new(); diagonal.len()];
    beside.iter().for_each(|((low, high), entry)| below[*low].push((*high, entry)));
    let (mut pattern, mut values) = (Pattern { starts: vec![0], rows: Vec::new() }, Vec::new());
    for (block, own) in diagonal.iter().enumerate() {
        for column in 0..6 {
            for row in column..6 {
                pattern.rows.push(6 * block + row);
                let value = own[(row, column)] * scale[block][row] * scale[block][column];
                values.push(if row == column { value - shift } else { value });
            }
            for (other, entry) in &below[block] {
                for row in 0..6 {
                    pattern.rows.push(6 * other + row);
                    values.push(entry[(row, column)] * scale[*other][row] * scale[block][column]);
                }
            }
            pattern.starts.push(pattern.rows.len());
        }
    }
    (pattern, values)
}
