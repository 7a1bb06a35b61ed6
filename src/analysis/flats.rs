//! Scenes in which edges or corners meet edges or corners, where several normals keep blocks apart.
//!
//! Which of the normals acts is decided by motions too small to be seen, so that the forces a touch
//! may carry form no cone, and two programs enclose the truth: with a small flat across the middle
//! of the normals (forces in it are admissible) and with a contact in every way at once (a motion
//! that closes none of them is possible). First the scene is asked without such touches: what stands
//! without them stands, and a motion that closes none is one. What is proved of either is checked
//! on the scene with all of them ([`Proved`](super::Proved)).

use check::verdict::{Forces, no_forces};
use model::interface::Model;

/// Forces of the scene without flats as those of the scene with them, which carry nothing.
pub(super) fn beside_flats(model: &Model, forces: &Forces) -> Forces {
    if forces.is_empty() {
        return Forces::new();
    }
    let list = &model.interfaces.list;
    let mut all = no_forces(&model.interfaces);
    let firm = (0..all.len()).filter(|&k| list.get(k).is_none_or(|f| f.ways.is_empty()));
    firm.zip(forces).for_each(|(k, own)| all[k].clone_from(own));
    all
}
