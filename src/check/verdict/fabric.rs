//! From contacts to averages: how a packing carries its load.
//!
//! Everything here is a sum over the contacts that carry force; the forces on block `b` of a
//! contact are pressed along the unit normal `n` from `a` into `b`.
//! * *Coordination number*: contacts per free grain, a contact between two free grains counted for
//!   both. A grain that nothing presses from above (it carries itself alone) is a rattler under
//!   gravity: it could be lifted off without any other grain noticing.
//! * *Fabric tensor* `F = ⟨n ⊗ n⟩` (Satake 1982), trace 1; anisotropy = its largest minus its least
//!   eigenvalue, 0 for equal numbers of contacts in all directions.
//! * *Mean stress* in the grains `σ = (1/V) Σ l ⊗ f` (Love–Weber), `l` from the centre of one grain
//!   to that of the other, or from a support's contact point to the centre, pressure positive, Pa,
//!   `V` the volume of the grains themselves: times the share of space that grains fill it is the
//!   stress of the packing.
//! * *Mobilised friction* `‖f_t‖ / (μ f_n)`: 1 where a contact is about to slide.
//!
//! M. Satake, *Fabric tensor in granular materials*, IUTAM Symposium on Deformation and Failure of
//! Granular Materials, Delft 1982.

use crate::verdict::Forces;
use base::tolerance;
use model::interface::{Interfaces, Model};
use nalgebra::{Matrix3, SymmetricEigen, Vector3};
use scene::Friction;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// Bins of the angle between contact normals and gravity, each of the same solid angle.
pub const ANGLE_BINS: usize = 9;
/// Bins of the normal force over its mean, each [`FORCE_BIN`] wide; the last one holds all that is
/// greater.
pub const FORCE_BINS: usize = 17;
/// Width of a bin of normal forces over their mean.
pub const FORCE_BIN: f64 = 0.25;

/// A contact that carries force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Index of the interface.
    pub interface: usize,
    /// Where the force acts, m.
    pub at: Vector3<f64>,
    /// Normal force, N, > 0.
    pub normal_force: f64,
    /// Tangential force, N.
    pub tangential_force: f64,
    /// Share of the friction that is used; `None` without friction or where friction has no limit.
    pub mobilised: Option<f64>,
}

/// Averages over a packing.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fabric {
    /// Free grains.
    pub grains: usize,
    /// Contacts, whatever they carry.
    pub touching: usize,
    /// Contacts per free grain, whatever they carry: the geometric coordination number.
    pub geometric_coordination: f64,
    /// Contacts that carry force.
    pub contacts: usize,
    /// Contacts that carry force per free grain.
    pub coordination: f64,
    /// Free grains that carry nothing but themselves.
    pub rattlers: usize,
    /// Contacts per free grain, rattlers and their contacts left out.
    pub coordination_without_rattlers: f64,
    /// Fabric tensor.
    pub tensor: [[f64; 3]; 3],
    /// Its largest minus its least eigenvalue.
    pub anisotropy: f64,
    /// Share of the contacts by the angle of their normal to gravity, from 0° to 90°, bins of equal
    /// solid angle.
    pub normals: [f64; ANGLE_BINS],
    /// Mean normal force, N.
    pub mean_force: f64,
    /// Greatest normal force over the mean.
    pub greatest_force: f64,
    /// Share of the contacts by normal force over the mean.
    pub forces: [f64; FORCE_BINS],
    /// Mean stress in the grains, pressure positive, Pa.
    pub stress: [[f64; 3]; 3],
    /// Volume of the free grains, m³.
    pub volume: f64,
    /// Mean share of the friction that is used, over the contacts with a limited friction above 0;
    /// absent where there are none.
    pub mobilised: Option<f64>,
    /// Share of these contacts that are about to slide.
    pub sliding: Option<f64>,
}

/// The contacts that carry force.
pub fn contacts(interfaces: &Interfaces, forces: &Forces) -> Vec<Contact> {
    let all: Vec<Contact> = interfaces
        .list
        .iter()
        .zip(forces)
        .enumerate()
        .filter_map(|(k, (face, forces))| {
            let n = face.frame.n;
            let total: Vector3<f64> = forces.iter().map(|w| w.force).sum();
            let normal_force = n.dot(&total);
            if normal_force.is_nan() || normal_force <= 0.0 {
                return None;
            }
            // The centre of pressure; equals the point for contacts of spheres.
            let weight = |w: &model::assembly::Wrench| n.dot(&w.force) / normal_force;
            let at = face.points.iter().zip(forces).map(|(p, w)| p * weight(w)).sum();
            let tangential_force = (total - n * normal_force).norm();
            let mobilised = match face.law.friction {
                Friction::Coefficient(mu) if mu > 0.0 => {
                    Some(tangential_force / (mu * normal_force))
                }
                _ => None,
            };
            Some(Contact { interface: k, at, normal_force, tangential_force, mobilised })
        })
        .collect();
    let mean = all.iter().map(|c| c.normal_force).sum::<f64>() / all.len().max(1) as f64;
    all.into_iter().filter(|c| c.normal_force > tolerance::UNLOADED * mean).collect()
}

/// Averages over a packing with these contact forces; nothing where no contact carries any.
pub fn fabric(model: &Model, forces: &Forces) -> Option<Fabric> {
    let Model { assembly, interfaces, .. } = model;
    let list = contacts(interfaces, forces);
    if list.is_empty() {
        return None;
    }
    let free = |i: usize| !assembly.blocks[i].support;
    let grains = assembly.free().count();
    let rattles = rattlers(model, forces, &list);
    let rattlers = (0..assembly.blocks.len()).filter(|&i| rattles[i]).count();
    let ends = |c: &Contact| [interfaces.list[c.interface].a, interfaces.list[c.interface].b];
    let degree = |list: &mut dyn Iterator<Item = &Contact>| {
        list.flat_map(ends).filter(|&i| free(i)).count() as f64
    };
    let per = |sum: f64, count: usize| if count > 0 { sum / count as f64 } else { 0.0 };
    let bearing = degree(&mut list.iter().filter(|c| ends(c).iter().all(|&i| !rattles[i])));

    let down = assembly.gravity.try_normalize(0.0).unwrap_or(-Vector3::z());
    let mean_force = per(list.iter().map(|c| c.normal_force).sum(), list.len());
    let share = per(1.0, list.len());
    let (mut tensor, mut stress) = (Matrix3::zeros(), Matrix3::zeros());
    let (mut normals, mut bins) = ([0.0; ANGLE_BINS], [0.0; FORCE_BINS]);
    for contact in &list {
        let face = &interfaces.list[contact.interface];
        let n = face.frame.n;
        tensor += n * n.transpose() * share;
        let steep = 1.0 - n.dot(&down).abs();
        normals[((steep * ANGLE_BINS as f64) as usize).min(ANGLE_BINS - 1)] += share;
        bins[((contact.normal_force / mean_force / FORCE_BIN) as usize).min(FORCE_BINS - 1)] +=
            share;
        let end = |i: usize| if free(i) { assembly.blocks[i].centroid } else { contact.at };
        let force: Vector3<f64> = forces[contact.interface].iter().map(|w| w.force).sum();
        stress += (end(face.b) - end(face.a)) * force.transpose();
    }
    let volume: f64 = assembly.free().map(|i| assembly.blocks[i].solid.volume()).sum();
    let eigen = SymmetricEigen::new(tensor).eigenvalues;
    let used: Vec<f64> = list.iter().filter_map(|c| c.mobilised).collect();
    let sliding = used.iter().filter(|m| **m >= 1.0 - tolerance::ABOUT_TO_SLIDE).count() as f64;
    let rows = |m: Matrix3<f64>| [0, 1, 2].map(|i| [0, 1, 2].map(|j| m[(i, j)]));
    let touch = interfaces.list.iter().flat_map(|f| [f.a, f.b]).filter(|&i| free(i)).count();
    Some(Fabric {
        grains,
        touching: interfaces.list.len(),
        geometric_coordination: per(touch as f64, grains),
        contacts: list.len(),
        coordination: per(degree(&mut list.iter()), grains),
        rattlers,
        coordination_without_rattlers: per(bearing, grains - rattlers),
        tensor: rows(tensor),
        anisotropy: eigen.max() - eigen.min(),
        normals,
        mean_force,
        greatest_force: if mean_force > 0.0 {
            list.iter().map(|c| c.normal_force).fold(0.0, f64::max) / mean_force
        } else {
            0.0
        },
        forces: bins,
        stress: rows(if volume > 0.0 { stress / volume } else { stress }),
        volume,
        mobilised: (!used.is_empty()).then(|| per(used.iter().sum(), used.len())),
        sliding: (!used.is_empty()).then(|| per(sliding, used.len())),
    })
}

/// Which free grains carry nothing but themselves: no contact pushes them along gravity.
fn rattlers(model: &Model, forces: &Forces, list: &[Contact]) -> Vec<bool> {
    let Model { assembly, interfaces, .. } = model;
    let down = assembly.gravity.try_normalize(0.0).unwrap_or(-Vector3::z());
    let mut rattles: Vec<bool> = assembly.blocks.iter().map(|b| !b.support).collect();
    for contact in list {
        let face = &interfaces.list[contact.interface];
        let pushed: f64 = forces[contact.interface].iter().map(|w| w.force.dot(&down)).sum();
        let (block, pushed) = if pushed > 0.0 { (face.b, pushed) } else { (face.a, -pushed) };
        if pushed > tolerance::UNLOADED * assembly.weight(block) {
            rattles[block] = false;
        }
    }
    rattles
}
