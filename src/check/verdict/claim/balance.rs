//! Claims that stand: forces that balance, inside their cones.

use crate::verdict::{
    Forces, certificate,
    exact::{Grade, balance::EquilibriumError, existence},
    findings::Findings,
};
use base::tolerance;
use model::{
    assembly::{Assembly, Wrench},
    interface::Model,
    strength::laws::unlimited,
};

/// Forces that balance the live load alone: added to others as often as wanted, they leave the
/// scene standing.
pub(super) fn live_alone_balances(f: &mut Findings, model: &Model, forces: &Forces) {
    let Model { assembly, interfaces, .. } = model;
    f.require(
        assembly.free().any(|i| assembly.live[i] != Wrench::zero()),
        "there is a live load".into(),
    );
    // Forces in joints that limit them are not counted: nothing that has a limit wedges.
    let (unlimited, kept) = unlimited(interfaces);
    let counted = kept.iter().map(|&k| forces[k].clone()).collect();
    let mut alone = assembly.clone();
    for (dead, live) in alone.dead.iter_mut().zip(&mut alone.live) {
        *dead = std::mem::replace(live, Wrench::zero());
    }
    by_themselves(f, "under the live load alone, ", &Model::new(alone, unlimited), &counted);
}

/// The assembly with its live load, brought to the size of the dead load, in place of the dead
/// load; and that factor.
pub fn live_alone(assembly: &Assembly) -> (Assembly, f64) {
    let factor = natural_factor(assembly);
    let mut alone = assembly.clone();
    for (dead, live) in alone.dead.iter_mut().zip(&mut alone.live) {
        *dead = Wrench { force: live.force * factor, moment: live.moment * factor };
        *live = Wrench::zero();
    }
    (alone, factor)
}

/// `when` says which of several sets of forces is meant.
pub(in crate::verdict) fn balanced(
    f: &mut Findings,
    when: &str,
    model: &Model,
    forces: &Forces,
    lambda: f64,
) {
    let assembly = &model.assembly;
    let scale = |i: usize| {
        certificate::load_scale(assembly, i)
            .max(lambda.abs() * certificate::size(assembly, i, &assembly.live[i]))
    };
    balanced_against(f, when, model, forces, lambda, &scale);
}

/// Forces that balance without any load, or one that stands in the place of the dead load: each
/// block by its own load, by the contact forces on it where it has none.
pub(in crate::verdict) fn by_themselves(
    f: &mut Findings,
    when: &str,
    model: &Model,
    forces: &Forces,
) {
    let Model { assembly, interfaces, .. } = model;
    let mut greatest = vec![0.0_f64; assembly.blocks.len()];
    for (face, forces) in interfaces.list.iter().zip(forces) {
        let most = largest(std::slice::from_ref(forces));
        [face.a, face.b].into_iter().for_each(|i| greatest[i] = greatest[i].max(most));
    }
    let joints = interfaces.list.len();
    for (own, forces) in interfaces.members.iter().zip(forces.iter().skip(joints)) {
        let most = largest(std::slice::from_ref(forces));
        own.action.ends().into_iter().flatten().for_each(|i| greatest[i] = greatest[i].max(most));
    }
    let scale = |i: usize| match certificate::size(assembly, i, &assembly.dead[i]) {
        0.0 => greatest[i],
        own => own,
    };
    balanced_against(f, when, model, forces, 0.0, &scale);
}

/// Forces that balance at `lambda`, each block by its own `scale`, N.
pub(super) fn balanced_against(
    f: &mut Findings,
    when: &str,
    model: &Model,
    forces: &Forces,
    lambda: f64,
    scale: &dyn Fn(usize) -> f64,
) {
    let assembly = &model.assembly;
    let left = Left::of(model, forces, lambda, scale);
    held(f, when, assembly, &left);
    cones(f, when, model, &certificate::statics(model, forces, lambda));
}

/// What forces leave, over the scale of the block.
pub(super) struct Left {
    /// Where no forces that balance exactly are [covered](existence::covered) nearby; on any block
    /// where there are everywhere.
    pub(super) greatest: EquilibriumError,
    /// Whether there are everywhere.
    exists: bool,
}

impl Left {
    pub(super) fn of(
        model: &Model,
        forces: &Forces,
        lambda: f64,
        scale: &dyn Fn(usize) -> f64,
    ) -> Self {
        let covered = existence::covered(model, forces, lambda);
        let exists = covered.iter().all(|held| *held);
        let counted = |i: usize| if covered[i] && !exists { f64::INFINITY } else { scale(i) };
        Self { greatest: EquilibriumError::of(model, forces, lambda, &counted), exists }
    }

    /// Whether that proves that the blocks are held.
    pub(super) fn is_balanced(&self) -> bool {
        self.exists || self.greatest.greatest <= tolerance::EQUILIBRIUM_ERROR
    }
}

pub(super) fn held(f: &mut Findings, when: &str, assembly: &Assembly, left: &Left) {
    let (by, id) = (left.greatest.greatest, &assembly.blocks[left.greatest.block].id);
    if left.exists {
        let text = format!(
            "{when}exactly balanced forces exist inside the friction cones, within {by:.1e} g of those listed"
        );
        f.require_graded(true, Grade::Exact, text);
    } else {
        let allowed = tolerance::EQUILIBRIUM_ERROR;
        let text = format!(
            "{when}forces balance every free block: largest equilibrium error {by:.1e} g, on {id}, allowed {allowed:.1e}"
        );
        f.require_graded(left.is_balanced(), Grade::ToRounding(by), text);
    }
}

/// Requires every force inside its friction cone, and no joint pressed beyond its compressive strength.
pub fn cones(f: &mut Findings, when: &str, model: &Model, s: &certificate::Residuals) {
    f.require(
        s.cone_excess <= tolerance::CONE,
        format!(
            "{when}no joint exceeds its friction cone (largest excess {:.1e} of the force)",
            s.cone_excess
        ),
    );
    if s.crushing > 0.0 {
        let (used, joint) = (100.0 * s.crushing, joint(model, s.most_pressed));
        let text = format!(
            "{when}no joint exceeds its compressive strength (at most {used:.4} % of it, in {joint})"
        );
        f.require(s.is_within_strength(), text);
    }
}

/// The greatest contact force, N.
pub(super) fn largest(forces: &[Vec<Wrench>]) -> f64 {
    forces.iter().flatten().map(|v| v.force.norm()).fold(0.0, f64::max)
}

/// The two blocks of a joint.
fn joint(model: &Model, k: usize) -> String {
    let Model { assembly, interfaces, .. } = model;
    let face = &interfaces.list[k];
    format!("{} | {}", assembly.blocks[face.a].id, assembly.blocks[face.b].id)
}

/// Total dead over total live load: the size a load factor has when both weigh the same.
pub fn natural_factor(assembly: &Assembly) -> f64 {
    let sum = |loads: &[Wrench]| {
        assembly.free().map(|i| certificate::size(assembly, i, &loads[i])).sum::<f64>()
    };
    sum(&assembly.dead) / sum(&assembly.live)
}
