//! Proofs as the evidence for them.

use crate::{Assessment, Claims, LoadFactor, Outcome, Proved, coulomb::DryLoadFactor};
use check::proof::{
    certificate::Certificate,
    evidence::{DryEvidence, FactorEvidence, Standing},
};
use model::interface::Model;
use std::sync::Arc;

/// Packs a proof.
pub(super) fn certificate<T: Claims>(model: &Model, proved: &Proved<T>) -> Arc<Certificate> {
    Certificate::new(model, proved.claim(), proved.evidence(), proved.findings())
}

pub(crate) fn standing(model: &Model, a: &Proved<Assessment>) -> Standing {
    let state = a.state.as_ref().map(|s| s.motion);
    Standing { certificate: certificate(model, a), state }
}

pub(super) fn factor(
    model: &Model,
    l: &Proved<LoadFactor>,
    dry: Option<(&Model, &Proved<DryLoadFactor>)>,
) -> FactorEvidence {
    let finite = |v: f64| v.is_finite().then_some(v);
    let open = l.outcome == Outcome::Undecided;
    let between = if open { [l.bracket.lower, l.bracket.upper].map(finite) } else { [None; 2] };
    let dry = dry.map(|(model, d)| DryEvidence {
        found: d.found,
        value: d.value,
        rests_at: d.rests_at,
        moves_at: d.moves_at,
        certificate: certificate(model, d),
    });
    FactorEvidence { bound: certificate(model, l), between, dry }
}
