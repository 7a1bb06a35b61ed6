//! Members in a program: columns with bounds beside those of the contact points.

use super::{Cone, ConicProgram, Disc, StaticsOptions, planar::Plane, symmetry::MemberOrbit};
use model::{
    assembly::{Action, Member, Wrench},
    interface::{ContactFrame, Model},
};
use nalgebra::Vector3;

/// What a member does to one block: force, N, and moment about the block's centre of mass, N·m.
pub type Effect = (usize, Wrench);

/// A member and its columns.
#[derive(Clone, Debug)]
pub struct MemberColumns {
    /// Index of the member.
    pub member: usize,
    /// The members that it stands for, itself among them.
    pub(super) images: MemberOrbit,
    /// First column.
    pub column: usize,
    /// Per column what a unit of it does to each block.
    pub basis: Vec<Vec<Effect>>,
    /// Per column which amount of the member it is, and with which sign.
    pub amounts: Vec<(usize, f64)>,
    /// The set that the columns lie in, N.
    pub set: MemberSet,
    /// Force unit of the columns, N.
    pub unit: f64,
    /// Load that presumably passes here, N.
    pub(super) presumed: f64,
    /// The amount, N, at which a compliant member is at ease.
    pub rest: f64,
    /// Stiffness beside that of the others whose stiffness is known, mean 1; nothing where its own
    /// is not.
    pub stiffness: Option<f64>,
}

/// The set that the columns of a member lie in, N.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MemberSet {
    /// One column between two bounds; either may be infinite.
    Range(f64, f64),
    /// All columns together no larger than this.
    Disc(f64),
    /// The first between zero and the greatest, the others together at most μ times that.
    Cone {
        /// Coefficient of friction.
        mu: f64,
        /// The greatest normal force, N.
        most: f64,
    },
}

/// What a finger applies where its force is given: to which block, as a dead load.
pub type Applied = Vec<Effect>;

/// The columns of all members that can take a force, from column `first` on; and what is applied
/// and no column. With [`StaticsOptions::split`] the normal force of a finger is its strength. In a
/// part of a symmetric scene only members that stand for others or for themselves have columns.
pub(super) fn columns(
    model: &Model,
    plane: Option<Plane>,
    options: StaticsOptions,
    orbits: Option<Vec<MemberOrbit>>,
    first: usize,
) -> (Vec<MemberColumns>, Applied) {
    let members = &model.interfaces.members;
    let (mut list, mut applied, mut column) = (Vec::new(), Vec::new(), first);
    let known: Vec<f64> = members.iter().filter_map(|m| m.stiffness).collect();
    let mean = known.iter().sum::<f64>() / known.len().max(1) as f64;
    let orbits = orbits.unwrap_or_else(|| (0..members.len()).map(|m| vec![m]).collect());
    let kept = members.iter().zip(orbits).enumerate();
    for (index, (member, images)) in kept.filter(|(_, (m, all))| !m.is_idle() && !all.is_empty()) {
        let across = |v: &Vector3<f64>| plane.is_some_and(|p| p.axis.dot(v).abs() > 0.5);
        let effect = |axes: &[(usize, f64)]| -> Vec<Vec<Effect>> {
            axes.iter().map(|&(axis, sign)| effects(model, member, axis, sign)).collect()
        };
        let (amounts, set) = match &member.action {
            Action::Line(_) | Action::Push { .. } => {
                // Where only the lower bound is infinite the column counts the other way.
                let turned = member.least == f64::NEG_INFINITY && member.greatest.is_finite();
                let (sign, least, greatest) = if turned {
                    (-1.0, -member.greatest, f64::INFINITY)
                } else {
                    (1.0, member.least, member.greatest)
                };
                (vec![(0, sign)], MemberSet::Range(least, greatest))
            }
            Action::Shear { normal, .. } => {
                let frame = ContactFrame::around(*normal);
                let tangents = [(0, frame.t1), (1, frame.t2)];
                let kept = tangents.iter().filter(|(_, t)| !across(t)).map(|&(k, _)| (k, 1.0));
                (kept.collect(), MemberSet::Disc(member.greatest))
            }
            Action::Press { normal, friction, .. } => {
                let frame = ContactFrame::around(*normal);
                let tangents = [(1, frame.t1), (2, frame.t2)];
                let tangents: Vec<(usize, f64)> =
                    tangents.iter().filter(|(_, t)| !across(t)).map(|&(k, _)| (k, 1.0)).collect();
                let set = MemberSet::Cone { mu: *friction, most: member.greatest };
                if options.split {
                    let normal = effects(model, member, 0, 1.0);
                    applied.extend(normal.into_iter().map(|(i, w)| (i, w * member.greatest)));
                    (tangents, MemberSet::Disc(friction * member.greatest))
                } else {
                    ([(0, 1.0)].into_iter().chain(tangents).collect(), set)
                }
            }
        };
        if amounts.is_empty() || set == MemberSet::Disc(0.0) {
            continue;
        }
        let sign = amounts[0].1;
        let columns = MemberColumns {
            member: index,
            images,
            column,
            basis: effect(&amounts),
            set,
            unit: 1.0,
            presumed: 0.0,
            rest: sign * member.prestress,
            stiffness: member.stiffness.map(|k| k / mean),
            amounts,
        };
        column += columns.amounts.len();
        list.push(columns);
    }
    (list, applied)
}

/// Whether a member acts by one amount, which no isometry turns.
pub(super) fn is_scalar(member: &Member) -> bool {
    matches!(member.action, Action::Line(_) | Action::Push { .. })
}

/// What one amount of a member does, as wrenches about the centres of mass.
fn effects(model: &Model, member: &Member, axis: usize, sign: f64) -> Vec<Effect> {
    let blocks = &model.assembly.blocks;
    let mut list: Vec<Effect> = Vec::new();
    let mut act = |block: Option<usize>, at: &Vector3<f64>, force: Vector3<f64>| {
        let Some(block) = block.filter(|&i| !blocks[i].support) else { return };
        let wrench = Wrench { force, moment: (at - blocks[block].centroid).cross(&force) };
        match list.iter_mut().find(|(i, _)| *i == block) {
            Some((_, sum)) => *sum += wrench,
            None => list.push((block, wrench)),
        }
    };
    match &member.action {
        // Tension pulls each point towards its neighbours along the line.
        Action::Line(anchors) => {
            for (k, anchor) in anchors.iter().enumerate() {
                let before = k.checked_sub(1).and_then(|k| anchors.get(k));
                for other in before.into_iter().chain(anchors.get(k + 1)) {
                    let towards = (other.at - anchor.at).normalize();
                    act(anchor.block, &anchor.at, towards * sign);
                }
            }
        }
        Action::Push { on, from, at, direction } => {
            act(Some(*on), at, direction * sign);
            act(*from, at, -direction * sign);
        }
        Action::Shear { blocks: [a, b], at, normal } => {
            let frame = ContactFrame::around(*normal);
            let t = if axis == 0 { frame.t1 } else { frame.t2 };
            act(Some(*b), at, t * sign);
            act(Some(*a), at, -t * sign);
        }
        Action::Press { on, at, normal, .. } => {
            let frame = ContactFrame::around(*normal);
            let direction = [*normal, frame.t1, frame.t2][axis];
            act(Some(*on), at, direction * sign);
        }
    }
    list
}

impl MemberColumns {
    /// Its rows in a program in forces, which start at variable `column`.
    pub(super) fn rows(&self, p: &mut ConicProgram, column: usize) {
        let own = column + self.column;
        match self.set {
            MemberSet::Range(least, greatest) => {
                bound(p, own, -1.0, -least / self.unit);
                bound(p, own, 1.0, greatest / self.unit);
            }
            MemberSet::Disc(most) if most.is_infinite() => {}
            MemberSet::Disc(most) => self.disc(own, 0, 0.0, most).cone(p),
            MemberSet::Cone { mu, most } => {
                bound(p, own, -1.0, 0.0);
                bound(p, own, 1.0, most / self.unit);
                if self.amounts.len() > 1 {
                    self.disc(own, 1, mu, 0.0).cone(p);
                }
            }
        }
    }

    /// The force of one unit of its first column on a support, N; nothing where it does not end
    /// there. Only lines and pushes do.
    pub(super) fn on(&self, member: &Member, support: usize) -> Option<Vector3<f64>> {
        let sign = self.amounts[0].1;
        let force = match &member.action {
            Action::Line(anchors) => {
                let ends =
                    anchors.windows(2).flat_map(|pair| [(pair[0], pair[1]), (pair[1], pair[0])]);
                let own = ends.filter(|(end, _)| end.block == Some(support));
                own.map(|(end, other)| (other.at - end.at).normalize()).sum::<Vector3<f64>>()
            }
            Action::Push { on, direction, .. } if *on == support => *direction,
            Action::Push { from: Some(from), direction, .. } if *from == support => -direction,
            _ => return None,
        };
        Some(force * sign)
    }

    /// The limit of all columns from `from` on.
    pub(super) fn disc(&self, own: usize, from: usize, slope: f64, constant: f64) -> Disc {
        Disc {
            normal: own,
            first: own + from,
            count: self.amounts.len() - from,
            slope,
            constant: constant / self.unit,
        }
    }

    /// Brings columns into the set.
    pub(super) fn admit(&self, x: &mut [f64]) {
        let shorten = |part: &mut [f64], limit: f64| {
            let size = part.iter().map(|v| v * v).sum::<f64>().sqrt();
            if size > limit {
                part.iter_mut().for_each(|v| *v *= limit / size);
            }
        };
        match self.set {
            MemberSet::Range(least, greatest) => {
                x[0] = x[0].max(least / self.unit).min(greatest / self.unit)
            }
            MemberSet::Disc(most) => shorten(x, most / self.unit),
            MemberSet::Cone { mu, most } => {
                x[0] = x[0].max(0.0).min(most / self.unit);
                let limit = mu * x[0];
                shorten(&mut x[1..], limit);
            }
        }
    }
}

/// `sign × x ≤ most`, where there is an end to it; large ones in their own size.
fn bound(p: &mut ConicProgram, column: usize, sign: f64, most: f64) {
    if most == f64::INFINITY {
        return;
    }
    let by = 1.0 / most.abs().max(1.0);
    let row = p.cone(Cone::NonNegative(1));
    p.matrix.push(row, column, sign * by);
    p.rhs[row] = most * by;
}
