//! The part of a scene that an answer is about.

use crate::{
    proof::{
        certificate::Proven,
        member::lines,
        told::{MechanismWords, Told},
    },
    terms::Deciding,
    verdict::{
        Rate, certificate,
        claim::{self, Claim, Findings},
        mechanism,
    },
};
use model::interface::{Model, parts};

/// The part in which anything moves, where the scene has several.
pub(in crate::proof) fn deciding(model: &Model, rates: &[Rate]) -> Option<Deciding> {
    let moves = |&i: &usize| rates.get(i).is_some_and(|q| *q != Rate::zero());
    let first = model.assembly.free().find(moves)?;
    let parts = parts(model);
    let index = parts.iter().position(|part| part.blocks.contains(&first))?;
    Deciding::new(&parts, index)
}

impl Told {
    /// Adds the mechanism and the forces in the members of what was proved.
    pub(in crate::proof) fn in_words(&mut self, model: &Model, proven: Option<&Proven>) {
        let Some(proven) = proven else { return };
        let proves = matches!(
            proven.claim,
            Some(
                Claim::Unstable | Claim::Conditional | Claim::Impossible | Claim::LoadFactor { .. }
            )
        );
        let moves = proves && proven.rates.iter().any(|q| *q != Rate::zero());
        self.mechanism =
            moves.then(|| MechanismWords::new(model, &mechanism::read(model, &proven.rates)));
        // Forces that prove nothing are told where they could be forces of the scene at all.
        if !model.interfaces.members.is_empty() {
            let mut f = Findings::default();
            claim::cones(&mut f, "", model, &certificate::statics(model, &proven.forces, 0.0));
            if f.fails.is_empty() {
                self.members = lines(model, &proven.forces);
            }
        }
    }
}
