//! A scene as a machine of one degree of freedom: the mechanisms that limit analysis proves towards
//! a direction and against it, each followed along its own linkage.
//!
//! The load factors are proved; that the scene goes on moving in these mechanisms is taken for
//! granted. For a single block, and for blocks that stand under a loose beam, there is no other
//! motion as long as nothing slides or jumps; elsewhere joints may close or open on the way, and the
//! machine is an idealisation ([`Exactness`]).

mod side;
mod table;
mod terms;

use super::answer::followable;
use crate::{Control, LoadFactor, Proved, limit};
use base::error::InputError;
use check::{
    kinematic::{Mass, MassKind, quake},
    rocking::Machine,
    terms::Law,
};
use model::{
    assembly::Assembly,
    interface::{self, Model},
};
use nalgebra::Vector3;
use scene::Scene;
use side::Side;
pub use terms::Exactness;
use terms::{Beside, found, refuse};

/// What a machine is asked for.
#[derive(Clone, Debug)]
pub struct MachineOptions {
    /// The direction of the mechanism, made horizontal.
    pub toward: Vector3<f64>,
    /// The block whose way is told, and the point of it; by default the centre of mass of the
    /// block that moves fastest.
    pub control: Option<(String, Option<Vector3<f64>>)>,
    /// What is left of the speed at every impact; by default what conserves momentum.
    pub restitution: Option<f64>,
}

/// A scene as a machine.
#[derive(Clone, Debug)]
pub struct Built {
    /// The machine.
    pub machine: Machine,
    /// The load factors towards the direction and against it, as multiples of gravity, each with
    /// the model it holds for.
    pub proofs: [(Model, Proved<LoadFactor>); 2],
    /// How far it is the scene.
    pub exactness: Exactness,
    /// The unit direction, horizontal.
    pub toward: Vector3<f64>,
    /// The unit directions of a motion of the ground: `toward`, the horizontal one to its left, up.
    pub axes: [Vector3<f64>; 3],
    /// Factors that conserve momentum.
    pub conserving: [f64; 2],
    /// The control point: its block, as in the scene, and where it is at the start, m.
    pub control: (usize, Vector3<f64>),
    /// The least thickness of that block, m.
    pub thickness: f64,
    /// What is said beside.
    pub notes: Vec<String>,
}

/// The scene as a machine.
///
/// # Errors
/// It does not stand, has no load factor, slides, or moves in more than one way; joints or blocks
/// that are not followed.
pub fn machine(
    scene: &Scene,
    model: &Model,
    options: &MachineOptions,
    control: &Control,
) -> Result<Built, InputError> {
    followable(model)?;
    if let Some(e) = options.restitution
        && !(0.0..=1.0).contains(&e)
    {
        return Err(refuse(format!("the restitution must be between 0 and 1, got {e}")));
    }
    let (toward, up) = directions(&model.assembly, options.toward)?;
    let axes = [toward, up.cross(&toward), up];
    let statics = Control { law: Law::Associative, ..*control };
    let quakes = [quake(scene, model, toward)?, quake(scene, model, -toward)?];
    let first = &quakes[0].model;
    let proof = limit(first, &statics);
    found(&proof, "towards the direction")?;
    // What does not move with it is another scene.
    let own = own_part(first, &proof);
    let gone: Vec<usize> = model.assembly.free().filter(|i| !own.contains(i)).collect();
    let kept: Vec<usize> = (0..model.assembly.blocks.len()).filter(|i| !gone.contains(i)).collect();
    let masses = beside(&quakes[0].masses, &kept, model.assembly.gravity.norm());
    let models = quakes.map(|q| q.model.without(&gone));
    let proofs = models.map(|m| {
        let proof = limit(&m, &statics);
        (m, proof)
    });
    let sides = [0, 1].map(|k| Side::new(&proofs[k].0, &masses, &proofs[k].1, k));
    let [one, other] = sides;
    let (one, other) = (one?, other?);
    let Some(one) = one else {
        return Err(refuse("there is no mechanism towards the direction".into())
            .hint("try the opposite direction"));
    };
    let sides = [Some(one), other];
    let chosen = chosen(model, options, &sides, &kept)?;
    let mut notes = Vec::new();
    let built: Vec<_> = sides
        .iter()
        .map(|side| side.as_ref().map(|s| s.law(&axes, chosen.local, &mut notes)).transpose())
        .collect::<Result<_, _>>()?;
    let conserving = side::restitution(&sides);
    let restitution = options.restitution.map_or(conserving, |e| [e; 2]);
    if sides[1].is_none() {
        notes.push(format!(
            "against the direction nothing moves: at every impact on what holds it, {}",
            options.restitution.map_or_else(
                || "it stops (--restitution lets it bounce)".into(),
                |e| format!("it bounces with {e} of its speed")
            )
        ));
    }
    let exactness = side::exactness(&sides, &built);
    let thickness = side::thickness(&model.assembly.blocks[chosen.block]);
    let senses: [Option<check::rocking::Sense>; 2] =
        std::array::from_fn(|k| built.get(k).and_then(|b| b.as_ref().map(|b| b.sense.clone())));
    Ok(Built {
        machine: Machine { senses, restitution },
        proofs,
        exactness,
        toward,
        axes,
        conserving,
        control: (chosen.block, chosen.point),
        thickness,
        notes,
    })
}

/// The control point: its block in the scene and in the part.
struct Chosen {
    block: usize,
    local: (usize, Vector3<f64>),
    point: Vector3<f64>,
}

fn chosen(
    model: &Model,
    options: &MachineOptions,
    sides: &[Option<Side>; 2],
    kept: &[usize],
) -> Result<Chosen, InputError> {
    let blocks = &model.assembly.blocks;
    let (block, point) = match &options.control {
        Some((id, point)) => {
            let block = model.assembly.find(id).filter(|&i| !blocks[i].support);
            let block =
                block.ok_or_else(|| refuse(format!("{id}: there is no such free block")))?;
            (block, *point)
        }
        None => {
            let fastest = sides[0].as_ref().map_or(0, Side::fastest);
            (kept.get(fastest).copied().unwrap_or_default(), None)
        }
    };
    let Some(own) = kept.iter().position(|&i| i == block) else {
        return Err(refuse(format!("{}: this block does not move", blocks[block].id))
            .hint("name a block of the mechanism as control"));
    };
    let point = point.unwrap_or(blocks[block].centroid);
    if (point - blocks[block].centroid).norm() > blocks[block].size {
        return Err(refuse(format!("the control point does not lie on {}", blocks[block].id)));
    }
    Ok(Chosen { block, local: (own, point), point })
}

/// The unit direction across gravity, and up.
fn directions(
    assembly: &Assembly,
    toward: Vector3<f64>,
) -> Result<(Vector3<f64>, Vector3<f64>), InputError> {
    let up = -assembly.gravity.try_normalize(0.0).ok_or_else(|| {
        refuse("without gravity nothing rocks".into()).hint("give the scene its gravity")
    })?;
    let across = toward - up * up.dot(&toward);
    if across.norm().is_nan() || across.norm() <= base::tolerance::ALONG * toward.norm() {
        return Err(refuse(format!(
            "the ground cannot move towards {:?}: it is parallel to gravity",
            toward.as_slice()
        ))
        .hint("give a direction across gravity, such as 1,0"));
    }
    Ok((across.normalize(), up))
}

/// Masses beside those of the blocks that are kept.
fn beside(masses: &[Mass], kept: &[usize], gravity: f64) -> Vec<Beside> {
    let others = masses.iter().filter(|m| m.kind != MassKind::Block);
    others
        .filter_map(|m| {
            let block = kept.iter().position(|&i| i == m.block)?;
            Some(Beside { block, arm: m.arm, mass: m.weight / gravity })
        })
        .collect()
}

/// Free blocks of the independent part that moves.
fn own_part(model: &Model, proof: &Proved<LoadFactor>) -> Vec<usize> {
    let speed = |i: usize| {
        let (r, b) = (&proof.rates[i], &model.assembly.blocks[i]);
        r.velocity.norm() + b.size * r.spin.norm()
    };
    let fastest = model.assembly.free().max_by(|&a, &b| speed(a).total_cmp(&speed(b)));
    let parts = interface::members(model);
    let part = parts.into_iter().find(|p| fastest.is_some_and(|i| p.free.contains(&i)));
    part.map_or_else(|| model.assembly.free().collect(), |p| p.free)
}
