//! Evidence in a form that can be saved and read back: names instead of indices.

use super::{
    Forces, Rate,
    member::{self, Bounds},
};
use base::tolerance;
use model::{
    assembly::{Assembly, Wrench},
    interface::Model,
};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

/// The forces in one contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContactForces {
    /// The two blocks; forces act on the second.
    pub between: [String; 2],
    /// Contact points, m.
    pub points: Vec<[f64; 3]>,
    /// Force on the second block at each point, N.
    pub forces: Vec<[f64; 3]>,
    /// Couple on the second block at each point, N·m; empty where there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub couples: Vec<[f64; 3]>,
}

/// The force of one member.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MemberForce {
    /// Its name; that of a strip with the number of the joint.
    pub member: String,
    /// Its amounts, N: one for a tie, strut, bar or tendon (tension > 0), a joint of a strip, soil
    /// or a toothed corner; two in the plane of the joint for a dowel; three for a finger, of which
    /// the first is normal.
    pub force: Vec<f64>,
}

/// The motion of one block; blocks at rest are left out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
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
pub fn write_forces(model: &Model, forces: &Forces) -> Vec<ContactForces> {
    let Model { assembly, interfaces, .. } = model;
    interfaces
        .list
        .iter()
        .zip(forces)
        .map(|(face, forces)| ContactForces {
            between: [assembly.blocks[face.a].id.clone(), assembly.blocks[face.b].id.clone()],
            points: face.points.iter().map(|&p| p.into()).collect(),
            forces: forces.iter().map(|f| f.force.into()).collect(),
            couples: if forces.iter().all(|f| f.moment == Vector3::zeros()) {
                Vec::new()
            } else {
                forces.iter().map(|f| f.moment.into()).collect()
            },
        })
        .collect()
}

/// Forces of members as evidence; those that carry nothing are left out.
pub fn write_members(model: &Model, forces: &Forces) -> Vec<MemberForce> {
    let Model { interfaces, .. } = model;
    let own = interfaces.members.iter().zip(forces.iter().skip(interfaces.list.len()));
    own.map(|(member, forces)| {
        let amounts = member::amounts(forces);
        let axes = Bounds::of(member).axes();
        MemberForce { member: member.id.clone(), force: (0..axes).map(|k| amounts[k]).collect() }
    })
    .filter(|f| f.force.iter().any(|v| *v != 0.0))
    .collect()
}

/// Fits saved forces of members to those of the scene.
///
/// # Errors
/// A member that the scene does not have, or has with other amounts, or twice in the result;
/// numbers that are not finite.
pub fn read_members(
    model: &Model,
    saved: &[MemberForce],
    forces: &mut Forces,
) -> Result<(), String> {
    let Model { interfaces, .. } = model;
    let mut index: std::collections::HashMap<&str, usize> =
        interfaces.members.iter().enumerate().map(|(m, own)| (own.id.as_str(), m)).collect();
    for saved in saved {
        let Some(m) = index.remove(saved.member.as_str()) else {
            return Err(format!(
                "member {}: not in the scene, or twice in the result",
                saved.member
            ));
        };
        let axes = Bounds::of(&interfaces.members[m]).axes();
        if saved.force.len() != axes {
            let got = saved.force.len();
            return Err(format!("member {}: {got} numbers given, {axes} needed", saved.member));
        }
        if !saved.force.iter().all(|v| v.is_finite()) {
            return Err(format!("member {}: a number is not finite", saved.member));
        }
        let force = Vector3::from_fn(|k, _| saved.force.get(k).copied().unwrap_or(0.0));
        forces[interfaces.list.len() + m] = vec![Wrench { force, moment: Vector3::zeros() }];
    }
    Ok(())
}

/// Rates as evidence.
pub fn write_rates(assembly: &Assembly, rates: &[Rate]) -> Vec<BlockRate> {
    (0..rates.len())
        .filter(|&i| rates[i] != Rate::zero())
        .map(|i| BlockRate {
            block: assembly.blocks[i].id.clone(),
            velocity: rates[i].velocity.into(),
            spin: rates[i].spin.into(),
        })
        .collect()
}

/// Fits saved forces to the interfaces of the scene.
///
/// # Errors
/// A contact that the scene does not have, or has at other points; numbers that are not finite.
pub fn read_forces(model: &Model, saved: &[ContactForces]) -> Result<Forces, String> {
    let Model { assembly, interfaces, .. } = model;
    let mut forces = super::no_forces(interfaces);
    let mut by_pair: std::collections::HashMap<(&str, &str), Vec<Option<usize>>> =
        Default::default();
    for (k, face) in interfaces.list.iter().enumerate() {
        by_pair
            .entry((&assembly.blocks[face.a].id, &assembly.blocks[face.b].id))
            .or_default()
            .push(Some(k));
    }
    for contact in saved {
        let [a, b] = &contact.between;
        if contact.points.len() != contact.forces.len() {
            return Err(format!(
                "contact {a} | {b}: {} points but {} forces",
                contact.points.len(),
                contact.forces.len()
            ));
        }
        if !contact.couples.is_empty() && contact.couples.len() != contact.forces.len() {
            return Err(format!(
                "contact {a} | {b}: {} forces but {} couples",
                contact.forces.len(),
                contact.couples.len()
            ));
        }
        let numbers =
            contact.points.iter().chain(&contact.forces).chain(&contact.couples).flatten();
        if !numbers.clone().all(|v| v.is_finite()) {
            return Err(format!("contact {a} | {b}: a number is not finite"));
        }
        if contact.forces.iter().chain(&contact.couples).flatten().all(|v| *v == 0.0) {
            continue;
        }
        // The whole contact has to fit: two interfaces of a pair may share corners.
        let candidates = by_pair.get_mut(&(a.as_str(), b.as_str())).into_iter().flatten();
        let fit =
            candidates.filter_map(|k| Some((places(model, (*k)?, &contact.points)?, k))).next();
        let Some((places, slot)) = fit else {
            return Err(format!("contact {a} | {b}: not in the scene, or twice in the result"));
        };
        if let Some(k) = slot.take() {
            for (saved, place) in places.into_iter().enumerate() {
                let moment =
                    contact.couples.get(saved).map_or_else(Vector3::zeros, |&m| Vector3::from(m));
                forces[k][place] = Wrench { force: Vector3::from(contact.forces[saved]), moment };
            }
        }
    }
    Ok(forces)
}

/// Where each saved point stands among the points of an interface; `None` unless they are the same
/// points.
fn places(model: &Model, k: usize, saved: &[[f64; 3]]) -> Option<Vec<usize>> {
    let Model { assembly, interfaces, .. } = model;
    let face = &interfaces.list[k];
    let size = assembly.blocks[face.a].size.min(assembly.blocks[face.b].size);
    let mut free = vec![true; face.points.len()];
    if saved.len() != free.len() {
        return None;
    }
    saved
        .iter()
        .map(|p| {
            let near = |q: &Vector3<f64>| (q - Vector3::from(*p)).norm() <= tolerance::WELD * size;
            let place = (0..free.len()).find(|&i| free[i] && near(&face.points[i]))?;
            free[place] = false;
            Some(place)
        })
        .collect()
}

/// Fits saved rates to the blocks of the scene.
///
/// # Errors
/// A block that the scene does not have, or that is a support; numbers that are not finite.
pub fn read_rates(assembly: &Assembly, saved: &[BlockRate]) -> Result<Vec<Rate>, String> {
    let mut rates = vec![Rate::zero(); assembly.blocks.len()];
    let index: std::collections::HashMap<&str, usize> =
        assembly.blocks.iter().enumerate().map(|(i, b)| (b.id.as_str(), i)).collect();
    for saved in saved {
        let Some(&i) = index.get(saved.block.as_str()) else {
            return Err(format!("the scene has no block {}", saved.block));
        };
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
