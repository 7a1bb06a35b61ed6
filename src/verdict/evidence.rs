//! Evidence in a form that can be saved and read back: names instead of indices.

use super::{Forces, Rate};
use crate::{assembly::Assembly, interface::Interfaces, tolerance};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// The forces in one contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ContactForces {
    /// The two blocks; forces act on the second.
    pub between: [String; 2],
    /// Contact points, m.
    pub points: Vec<[f64; 3]>,
    /// Force on the second block at each point, N.
    pub forces: Vec<[f64; 3]>,
}

/// The motion of one block; blocks at rest are left out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BlockRate {
    /// The block.
    pub block: String,
    /// Velocity of its centre of mass (arbitrary common scale).
    pub velocity: [f64; 3],
    /// Spin.
    pub spin: [f64; 3],
}

/// Forces as evidence.
pub fn write_forces(assembly: &Assembly, interfaces: &Interfaces, forces: &Forces) -> Vec<ContactForces> {
    interfaces
        .list
        .iter()
        .zip(forces)
        .map(|(face, forces)| ContactForces {
            between: [assembly.blocks[face.a].id.clone(), assembly.blocks[face.b].id.clone()],
            points: face.points.iter().map(|&p| p.into()).collect(),
            forces: forces.iter().map(|&f| f.into()).collect(),
        })
        .collect()
}

/// Rates as evidence.
pub fn write_rates(assembly: &Assembly, rates: &[Rate]) -> Vec<BlockRate> {
    (0..rates.len())
        .filter(|&i| rates[i] != Rate::zero())
        .map(|i| BlockRate { block: assembly.blocks[i].id.clone(), velocity: rates[i].velocity.into(), spin: rates[i].spin.into() })
        .collect()
}

/// Fits saved forces to the interfaces of the scene.
///
/// # Errors
/// A contact that the scene does not have, or has at other points; numbers that are not finite.
pub fn read_forces(assembly: &Assembly, interfaces: &Interfaces, saved: &[ContactForces]) -> Result<Forces, String> {
    let mut forces: Forces = interfaces.list.iter().map(|f| vec![Vector3::zeros(); f.points.len()]).collect();
    let mut by_pair: std::collections::HashMap<(&str, &str), Vec<usize>> = Default::default();
    for (k, face) in interfaces.list.iter().enumerate() {
        by_pair.entry((&assembly.blocks[face.a].id, &assembly.blocks[face.b].id)).or_default().push(k);
    }
    for contact in saved {
        let [a, b] = &contact.between;
        if contact.points.len() != contact.forces.len() {
            return Err(format!("contact {a} | {b}: {} points but {} forces", contact.points.len(), contact.forces.len()));
        }
        for (point, force) in contact.points.iter().zip(&contact.forces) {
            let (point, force) = (Vector3::from(*point), Vector3::from(*force));
            if !force.iter().chain(&point).all(|v| v.is_finite()) {
                return Err(format!("contact {a} | {b}: a number is not finite"));
            }
            if force == Vector3::zeros() {
                continue;
            }
            let place = by_pair.get(&(a.as_str(), b.as_str())).into_iter().flatten().find_map(|&k| {
                let face = &interfaces.list[k];
                let size = assembly.blocks[face.a].size.min(assembly.blocks[face.b].size);
                let near = |p: &Vector3<f64>| (p - point).norm() <= tolerance::WELD * size;
                face.points.iter().position(near).map(|p| (k, p))
            });
            match place {
                // Two interfaces of a pair may share a corner; the one whose cone holds the force is tried by the checks.
                Some((k, p)) if forces[k][p] == Vector3::zeros() => forces[k][p] = force,
                Some((k, p)) => forces[k][p] += force,
                None => return Err(format!("contact {a} | {b}: the scene has no contact point at {:?}", point.as_slice())),
            }
        }
    }
    Ok(forces)
}

/// Fits saved rates to the blocks of the scene.
///
/// # Errors
/// A block that the scene does not have, or that is a support; numbers that are not finite.
pub fn read_rates(assembly: &Assembly, saved: &[BlockRate]) -> Result<Vec<Rate>, String> {
    let mut rates = vec![Rate::zero(); assembly.blocks.len()];
    let index: std::collections::HashMap<&str, usize> = assembly.blocks.iter().enumerate().map(|(i, b)| (b.id.as_str(), i)).collect();
    for saved in saved {
        let Some(&i) = index.get(saved.block.as_str()) else { return Err(format!("the scene has no block {}", saved.block)) };
        if assembly.blocks[i].support {
            return Err(format!("block {} is a support and cannot move", saved.block));
        }
        rates[i] = Rate { velocity: saved.velocity.into(), spin: saved.spin.into() };
        if !rates[i].velocity.iter().chain(&rates[i].spin).all(|v| v.is_finite()) {
            return Err(format!("block {}: a number is not finite", saved.block));
        }
    }
    Ok(rates)
}
