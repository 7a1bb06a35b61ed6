//! Blocks that stand in unstable balance.

use super::{Interface, Model};
use base::tolerance::CONTACT_WELD;
use nalgebra::Vector3;

/// Edges whose ends are nearer to one line than this × the block's size lie on it: rounding of scenes
/// that were moved and turned. Larger: bearings as narrow as that are edges.
const ON_A_LINE: f64 = 1e3 * CONTACT_WELD;

/// Free blocks that touch others at one point alone, or along edges on one line, below their centre of
/// mass: they turn about it freely, and stand only where their load passes it exactly. A joint with a
/// rolling arm, and any member, holds its block.
pub fn in_balance(model: &Model) -> Vec<usize> {
    let Model { assembly, interfaces, .. } = model;
    let mut contacts: Vec<Vec<&Interface>> = vec![Vec::new(); assembly.blocks.len()];
    interfaces.list.iter().for_each(|f| [f.a, f.b].iter().for_each(|&i| contacts[i].push(f)));
    let mut held: Vec<bool> = assembly.blocks.iter().map(|b| b.support).collect();
    let ends = interfaces.members.iter().flat_map(|m| m.action.ends());
    ends.flatten().for_each(|i| held[i] = true);
    let up = -assembly.gravity;
    let tips = |i: usize| {
        let block = &assembly.blocks[i];
        let Some(points) = contacts[i].first().map(|f| &f.points) else { return false };
        let middle = match points[..] {
            [p] if contacts[i].len() == 1 => p,
            [p, q] => {
                let along = (q - p).normalize();
                let off = |x: &Vector3<f64>| (x - p).cross(&along).norm();
                let near = |f: &Interface| {
                    f.points.len() == 2 && f.points.iter().all(|x| off(x) <= ON_A_LINE * block.size)
                };
                if !contacts[i].iter().all(|f| near(f)) {
                    return false;
                }
                (p + q) / 2.0
            }
            _ => return false,
        };
        contacts[i].iter().all(|f| f.law.rolling_arm == 0.0)
            && (block.centroid - middle).dot(&up) > 0.0
    };
    (0..contacts.len()).filter(|&i| !held[i] && tips(i)).collect()
}
