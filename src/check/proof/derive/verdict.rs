//! Verdicts.

use super::{Derivation, computed, deciding};
use crate::{
    proof::{
        answer::{Answer, VerdictAnswer},
        certificate::Proven,
        evidence::Standing,
        told::Direction,
    },
    terms::{Bracket, Law, StateMotion},
    verdict::{
        Verdict, certificate,
        claim::{self, Claim, Findings},
        in_every_way,
    },
};
use base::tolerance;
use model::interface::{self, Model, Part, is_forest};

impl Derivation<'_> {
    /// Does it stand?
    pub(in crate::proof) fn verdict(
        &self,
        f: &mut Findings,
        model: &Model,
        e: &Standing,
    ) -> (VerdictAnswer, Option<Proven>) {
        let proven = e.certificate.prove(f, model, self.known());
        let claim = proven.as_ref().and_then(|p| p.claim);
        if claim.is_some_and(|c| c.verdict().is_none()) {
            f.fails.push("the proved claim is not a verdict".into());
        }
        let verdict = claim.and_then(|c| c.verdict()).unwrap_or(Verdict::Undecided);
        if claim.is_none() {
            f.holds.push("undecided: nothing is claimed".into());
        }
        if let (Some(StateMotion::Moves), false) = (e.state, verdict == Verdict::Conditional) {
            f.computed = true;
            if self.asks_again() && f.fails.is_empty() {
                let moves = self.again.motion(model).map(|motion| motion == StateMotion::Moves);
                computed(f, moves, "with dry friction the blocks move".into());
            }
        }
        let law = (verdict == Verdict::Stable).then(|| self.rests(f, model, e.state));
        let part = proven.as_ref().filter(|_| verdict != Verdict::Stable);
        let answer = VerdictAnswer {
            verdict,
            law,
            equilibrium_error: proven
                .as_ref()
                .map_or(Bracket { lower: 0.0, upper: f64::INFINITY }, |p| {
                    equilibrium_error(model, p, verdict)
                }),
            part: part.and_then(|p| deciding(model, &p.rates)),
            proof: proven.as_ref().and_then(|p| p.grade),
        };
        (answer, proven)
    }

    /// Of what stands: for which law of sliding. That the loads produce such forces by themselves is
    /// a state, computed and not proved, but where statics alone fixes them.
    fn rests(&self, f: &mut Findings, model: &Model, state: Option<StateMotion>) -> Law {
        if is_forest(model) {
            f.holds
                .push("contacts form no closed chain: statics alone determines the forces".into());
            return Law::Coulomb;
        }
        if state != Some(StateMotion::Rests) {
            f.holds.push(
                "whether the loads produce such forces was not asked: they may need a self-stress"
                    .into(),
            );
            return Law::Associative;
        }
        f.computed = true;
        if self.asks_again() && f.fails.is_empty() {
            let text = "with slightly elastic joints the blocks come to rest under the loads";
            let rests = self.again.motion(model).map(|motion| motion == StateMotion::Rests);
            computed(f, rests, text.into());
        }
        Law::Coulomb
    }

    /// Whether a scene stands under its dead load alone, where that was asked.
    pub(in crate::proof) fn dead(
        &mut self,
        model: &Model,
        e: Option<&Standing>,
    ) -> Option<Direction> {
        let e = e?;
        let mut f = Findings::default();
        let (answer, _) = self.verdict(&mut f, model, e);
        self.part("dead load alone", f);
        let answer = Answer::Verdict(answer);
        Some(Direction { answer, certificate: e.certificate.clone(), dry: None })
    }
}

/// The bracket of the least equilibrium error that forces and rates give, g: part by part, in units in which
/// nothing over- or underflows.
fn equilibrium_error(model: &Model, proven: &Proven, verdict: Verdict) -> Bracket {
    let Proven { claim, forces, rates, .. } = proven;
    let parts = interface::parts(model);
    // Forces outside their cones bound nothing.
    let left = |part: &Part| {
        let left = certificate::statics(&part.model, &part.take_forces(forces), 0.0);
        let admissible = claim.is_some() || left.cone_excess <= tolerance::CONE;
        if admissible { left.equilibrium_error } else { f64::INFINITY }
    };
    let upper = parts.iter().map(left).fold(0.0, f64::max);
    // Rates bound nothing from below unless they are a mechanism.
    if verdict != Verdict::Undecided && *claim != Some(Claim::Unstable) {
        return Bracket { lower: 0.0, upper };
    }
    let rates = &certificate::at_unit_speed(&model.assembly, rates)[..];
    let wide = in_every_way(model, forces);
    let (model, forces) = wide.as_ref().map_or((model, forces), |(model, forces)| (model, forces));
    let k = match claim::moving(model, forces, rates) {
        Some((part, own, rates)) => certificate::kinematics(&part.model, &rates, &own),
        None => certificate::kinematics(model, rates, forces),
    };
    let slack = if verdict == Verdict::Undecided { k.slack } else { 0.0 };
    let lower = if k.norm > 0.0 { ((k.gain() - slack) / k.norm).max(0.0) } else { 0.0 };
    Bracket { lower, upper }
}
