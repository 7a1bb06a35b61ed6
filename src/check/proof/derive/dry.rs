//! Load factors with dry friction: forces and a mechanism that obey Coulomb's law are a proof; that
//! states under dry friction come to rest, or move, is computed, and computed again.

use super::{At, Derivation, computed, deciding, failure, require};
use crate::{
    proof::{
        certificate::{Certificate, DryResult},
        evidence::DryEvidence,
    },
    terms::{Bound, Found, Outcome, StateMotion, resolution},
    verdict::{
        Verdict,
        claim::{self, Claim, Findings},
        law,
    },
};
use base::{error::InputError, tolerance};
use model::interface::Model;

impl Derivation<'_> {
    /// A load factor with dry friction: its evidence where it claims something, and what its states
    /// do, beside the bound and its evidence.
    pub(super) fn dry_friction(
        &mut self,
        title: &str,
        at: At,
        (bound, evidence): (Bound, &Certificate),
        e: &DryEvidence,
        dead: Option<Verdict>,
    ) -> DryResult {
        let mut told = DryResult {
            found: e.found,
            part: None,
            value: e.value,
            rests_at: e.rests_at,
            moves_at: e.moves_at,
            natural_map: None,
            certificate: e.certificate.clone(),
        };
        let mut f = proof(&mut told, (at, self.known()), (bound, evidence), e);
        let status = bound.status;
        if e.found == Found::RestsBelow {
            let zero = at(0.0).map_or(0.0, |model: Model| {
                tolerance::LOAD_FACTOR_FLOOR * claim::natural_factor(&model.assembly)
            });
            let near =
                |b: f64| e.value.is_some_and(|v| v >= (1.0 - tolerance::REST_WITHIN) * b - zero);
            let above = e.moves_at.or(bound.value);
            require(
                &mut f,
                above.is_some_and(near),
                "the value lies just below the load factor at which the blocks move, or just below the bound",
            );
        }
        require(
            &mut f,
            e.found != Found::Unlimited || status == Outcome::Unbounded,
            "where the value has no limit, neither has the bound",
        );
        // No value passes the bound.
        let within = |v: f64| bound.upper.is_none_or(|u| v <= u + 1e-9 * u.abs());
        require(
            &mut f,
            [e.value, e.rests_at].into_iter().flatten().all(within),
            "the value does not exceed the bound",
        );
        if f.fails.is_empty() && e.found == Found::Undecided {
            f.holds.push("undecided: nothing is claimed".into());
        }
        // What the evidence for the bound, or that of the dead load beside it, says of the dead load
        // is not to be computed again.
        let is_negative = bound.upper.is_some_and(|u| u < 0.0);
        let falls = e.found == Found::NotAtRest && (is_negative || dead == Some(Verdict::Unstable));
        if falls && is_negative {
            f.holds.push("the bound is below zero: it falls under the dead load alone".into());
        } else if falls {
            f.holds.push(
                "it falls under the dead load alone, as the evidence for that load proves".into(),
            );
        }
        if falls {
            told.rests_at = None;
            told.moves_at = e.moves_at.filter(|m| *m == 0.0);
        }
        if f.fails.is_empty() && !falls {
            let order = [e.rests_at, e.value, e.moves_at].into_iter().flatten();
            let rising = order.collect::<Vec<f64>>().windows(2).all(|w| w[0] <= w[1]);
            require(
                &mut f,
                rising,
                "the blocks come to rest at or below the value, and move at or above it",
            );
            if rising
                && self.asks_again()
                && let Err(e) = self.spoken_of(&mut f, at, e)
            {
                f.fails.push(e.to_string());
            }
        }
        self.part(title, f);
        told
    }

    /// The states that are spoken of.
    fn spoken_of(&self, f: &mut Findings, at: At, dry: &DryEvidence) -> Result<(), InputError> {
        let motion = |lambda: f64| -> Result<Option<StateMotion>, InputError> {
            Ok(self.again.motion(&at(lambda)?.at_load_factor(lambda)))
        };
        let ask = |f: &mut Findings,
                   lambda: f64,
                   wanted: StateMotion,
                   text: String|
         -> Result<(), InputError> {
            computed(f, motion(lambda)?.map(|motion| motion == wanted), text);
            Ok(())
        };
        if let Some(lambda) = dry.rests_at {
            ask(
                f,
                lambda,
                StateMotion::Rests,
                format!("with dry friction the blocks come to rest at {lambda}"),
            )?;
        }
        if let Some(lambda) = dry.moves_at {
            ask(
                f,
                lambda,
                StateMotion::Moves,
                format!("with dry friction the blocks move at {lambda}"),
            )?;
        }
        match (dry.found, dry.value, dry.moves_at) {
            (Found::NotAtRest, ..) if dry.moves_at != Some(0.0) => {
                ask(
                    f,
                    0.0,
                    StateMotion::Moves,
                    "with dry friction the blocks move under the dead load".into(),
                )?;
            }
            (Found::Unlimited, ..) => {
                computed(
                    f,
                    self.again.rests_alone(&at(0.0)?),
                    "the live load alone produces the forces that balance it: there is no limit"
                        .into(),
                );
            }
            (Found::Rests, Some(value), moves_at) => {
                let next =
                    value + resolution(&at(value)?.assembly) * moves_at.unwrap_or(value).abs();
                let known = moves_at.is_some_and(|m| m > value);
                let moves = match moves_at.is_none_or(|m| next < m) {
                    true => motion(next)?.map(|motion| motion != StateMotion::Rests),
                    false => Some(true),
                };
                computed(
                    f,
                    moves.map(|moves| known && moves),
                    format!("at {next} the blocks no longer come to rest"),
                );
            }
            _ => {}
        }
        Ok(())
    }
}

/// What its evidence claims, which fits how it was found.
fn proof(
    told: &mut DryResult,
    (at, known): (At, bool),
    (bound, evidence): (Bound, &Certificate),
    e: &DryEvidence,
) -> Findings {
    match (&e.certificate.claim, e.value) {
        (None, None)
            if matches!(e.found, Found::Undecided | Found::Unlimited | Found::NotAtRest) =>
        {
            Findings::default()
        }
        (None, None) if e.found == Found::AtLeast && e.rests_at.is_some() => Findings::default(),
        (None, Some(_))
            if matches!(e.found, Found::Rests | Found::RestsBelow) && e.rests_at == e.value =>
        {
            Findings::default()
        }
        (Some(Claim::DryLoadFactor { value }), Some(said))
            if *value == said && matches!(e.found, Found::NothingSlides | Found::FixedPoint) =>
        {
            let model = match at(said) {
                Ok(model) => model,
                Err(e) => return failure(e.to_string()),
            };
            let mut f = Findings::default();
            if let Some(proven) = e.certificate.prove(&mut f, &model, known) {
                told.natural_map = law::natural_map(&model, &proven.forces, &proven.rates)
                    .filter(|map| map.is_finite());
                told.part = deciding(&model, &proven.rates);
            }
            let is_bound = bound.value == Some(said) && evidence.rates == e.certificate.rates;
            let words = match e.found {
                Found::NothingSlides => "the value is the bound: nothing slides in its mechanism",
                _ => "the value differs from the bound and has its own evidence",
            };
            require(&mut f, is_bound == (e.found == Found::NothingSlides), words);
            f
        }
        _ => {
            failure("the load factor with dry friction differs from the one its certificate claims")
        }
    }
}
