//! The model of a stage of construction: blocks, contacts and members of the whole scene, found
//! once, without what is not there.

use super::{Interfaces, Model};
use crate::assembly::{Stage, Wrench, with_loads};
use base::error::InputError;
use scene::Scene;

/// The model of one stage; `whole` is that of all of `scene`.
///
/// What is held becomes a support: it carries no load of its own, and contacts and members between
/// what does not move go. Contacts that were left out of the whole scene are left out here.
///
/// # Errors
/// A load that is left does not resolve.
pub fn at_stage(scene: &Scene, whole: &Model, stage: &Stage) -> Result<Model, InputError> {
    let kept = match stage.without_loads.is_empty() {
        true => whole.without(&stage.absent()),
        false => {
            let assembly = with_loads(scene, &whole.assembly, &stage.without_loads)?;
            Model { assembly, ..whole.clone() }.without(&stage.absent())
        }
    };
    let Model { mut assembly, mut interfaces, timings } = kept;
    let held = stage.held.iter().zip(&stage.present).filter(|(_, there)| **there).map(|(h, _)| *h);
    for (i, held) in held.enumerate() {
        if held {
            assembly.blocks[i].support = true;
            (assembly.dead[i], assembly.live[i]) = (Wrench::zero(), Wrench::zero());
        }
    }
    let free: Vec<bool> = assembly.blocks.iter().map(|b| !b.support).collect();
    assembly.dead_forces.retain(|f| free[f.block]);
    assembly.live_forces.retain(|f| free[f.block]);
    interfaces.list.retain(|f| free[f.a] || free[f.b]);
    interfaces.members.retain(|m| {
        stage.has_member(&m.id) && m.action.ends().into_iter().flatten().any(|i| free[i])
    });
    // Said once of the whole scene.
    (assembly.findings, interfaces.findings) = (Vec::new(), Vec::new());
    let interfaces = Interfaces { left_out: None, ..interfaces };
    Ok(Model { timings, ..Model::new(assembly, interfaces) })
}
