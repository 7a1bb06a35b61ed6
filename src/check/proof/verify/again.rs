//! What is computed and not proved is computed again: that states under dry friction come to rest,
//! or move.
//!
//! That admissible forces exist is proved from forces alone; that the loads produce such forces is
//! not: of that there is a state, not a theorem. Nothing that a file says about it is believed
//! either, so the state is asked again, once all else holds.

use super::{Recompute, failure, require};
use crate::{
    proof::{
        answer::Answer,
        certificate::{Certificate, DryResult},
    },
    terms::{Found, Law, Outcome, StateMotion, resolution},
    verdict::{
        Evidence, Verdict,
        claim::{self, Claim, Findings},
        evidence::read_rates,
    },
};
use base::{error::InputError, tolerance};
use model::interface::{Model, is_forest};

/// The model at a load factor or tilt, as joints with strengths are there.
pub(in crate::proof) type At<'a> = &'a dyn Fn(f64) -> Result<Model, InputError>;

/// Of what stands: the loads produce such forces by themselves, or that was not asked, which is
/// said.
pub(super) fn stands(again: &dyn Recompute, f: &mut Findings, model: &Model, law: Option<Law>) {
    if law == Some(Law::Associative) {
        return f.holds.push("whether the loads produce such forces by themselves was not asked: they may need a pre-stress".into());
    }
    if is_forest(model) {
        f.holds.push("contacts form no closed chain: the loads fix the forces".into());
    } else if f.fails.is_empty() {
        computed(
            f,
            again.motion(model).map(|motion| motion == StateMotion::Rests),
            "the loads produce such forces by themselves: with dry friction the blocks come to rest".into(),
        );
    }
}

/// A load factor with dry friction: its evidence where it claims something, and what its states do;
/// `bound` is the associative answer.
pub(in crate::proof) fn dry_friction(
    again: &dyn Recompute,
    at: At,
    bound: (&Answer, &Certificate),
    dry: &DryResult,
    refuted: bool,
) -> Findings {
    let mut f = match (&dry.certificate.claim, dry.value) {
        (None, None)
            if matches!(dry.found, Found::Undecided | Found::Unlimited | Found::NotAtRest) =>
        {
            Findings::default()
        }
        (None, None) if dry.found == Found::AtLeast && dry.rests_at.is_some() => {
            Findings::default()
        }
        (None, Some(_))
            if matches!(dry.found, Found::Rests | Found::RestsBelow)
                && dry.rests_at == dry.value =>
        {
            Findings::default()
        }
        (Some(claim @ Claim::DryLoadFactor { value }), Some(said))
            if *value == said && matches!(dry.found, Found::NothingSlides | Found::FixedPoint) =>
        {
            let is_bound = bound.0.bound().and_then(|b| b.value) == Some(said)
                && bound.1.rates == dry.certificate.rates;
            match at(said).map_err(|e| e.to_string()).and_then(|model| evidence(&model, claim, dry))
            {
                Ok(mut f) => {
                    require(
                        &mut f,
                        is_bound == (dry.found == Found::NothingSlides),
                        words(dry.found),
                    );
                    f
                }
                Err(e) => failure(e),
            }
        }
        _ => {
            return failure(
                "the load factor with dry friction is not the one its certificate claims",
            );
        }
    };
    let status = bound.0.bound().map(|b| b.status);
    if dry.found == Found::RestsBelow {
        let zero = at(0.0).map_or(0.0, |model| {
            tolerance::LOAD_FACTOR_FLOOR * claim::natural_factor(&model.assembly)
        });
        let near =
            |b: f64| dry.value.is_some_and(|v| v >= (1.0 - tolerance::REST_WITHIN) * b - zero);
        let above = dry.moves_at.or(bound.0.bound().and_then(|b| b.value));
        require(
            &mut f,
            above.is_some_and(near),
            "the value is little below where it moves, or the bound",
        );
    }
    require(
        &mut f,
        dry.found != Found::Unlimited || status == Some(Outcome::Unbounded),
        "where there is no limit, the bound has none",
    );
    if f.fails.is_empty() && dry.found == Found::Undecided {
        f.holds.push("undecided: nothing is claimed".into());
    }
    // What the evidence for the bound, or that of the dead load beside it, says of the dead load is
    // not to be computed again.
    let is_negative = bound.0.bound().and_then(|b| b.upper).is_some_and(|u| u < 0.0);
    let is_unheld = bound.0.verdict() == Some(Verdict::Unstable);
    let falls = dry.found == Found::NotAtRest && (is_negative || is_unheld);
    if falls && is_negative {
        f.holds.push("the bound is below zero: the dead load alone is not held".into());
    } else if falls {
        f.holds.push("the dead load alone is not held, as its own evidence says".into());
    }
    if f.fails.is_empty()
        && !refuted
        && !falls
        && let Err(e) = spoken_of(again, &mut f, at, dry)
    {
        f.fails.push(e.to_string());
    }
    f
}

/// Requires what was computed again, where that was possible.
pub(super) fn computed(f: &mut Findings, ok: Option<bool>, text: String) {
    f.computed = true;
    match ok {
        Some(ok) => require(f, ok, format!("{text} (computed again, not proved)")),
        None => f.unchecked.push(text),
    }
}

fn words(found: Found) -> &'static str {
    match found {
        Found::NothingSlides => "it is the bound itself: in its mechanism nothing slides",
        _ => "it is another one than the bound, with evidence of its own",
    }
}

/// Forces and a mechanism that obey Coulomb's law.
fn evidence(model: &Model, claim: &Claim, dry: &DryResult) -> Result<Findings, String> {
    let (forces, _) = dry.certificate.read(model)?;
    let rates = read_rates(&model.assembly, &dry.certificate.rates)?;
    Ok(claim::verify(model, claim, Evidence::new(&forces, &rates)))
}

/// The states that are spoken of.
fn spoken_of(
    again: &dyn Recompute,
    f: &mut Findings,
    at: At,
    dry: &DryResult,
) -> Result<(), InputError> {
    let motion = |lambda: f64| -> Result<Option<StateMotion>, InputError> {
        Ok(again.motion(&at(lambda)?.at_load_factor(lambda)))
    };
    let order = [dry.rests_at, dry.value, dry.moves_at].into_iter().flatten().collect::<Vec<f64>>();
    let rising = order.windows(2).all(|w| w[0] <= w[1]);
    require(f, rising, "it rests up to no more than the value, and moves from no less on");
    if !rising {
        return Ok(());
    }
    let ask = |f: &mut Findings,
               lambda: f64,
               wanted: StateMotion,
               text: String|
     -> Result<(), InputError> {
        computed(f, motion(lambda)?.map(|motion| motion == wanted), text);
        Ok(())
    };
    if let Some(lambda) = dry.rests_at {
        ask(f, lambda, StateMotion::Rests, format!("the state rests at {lambda}"))?;
    }
    if let Some(lambda) = dry.moves_at {
        ask(f, lambda, StateMotion::Moves, format!("the state moves at {lambda}"))?;
    }
    match (dry.found, dry.value, dry.moves_at) {
        (Found::NotAtRest, ..) if dry.moves_at != Some(0.0) => {
            ask(f, 0.0, StateMotion::Moves, "the state moves under the dead load".into())?;
        }
        (Found::Unlimited, ..) => {
            computed(
                f,
                again.rests_alone(&at(0.0)?),
                "the live load alone produces the forces that balance it: no limit".into(),
            );
        }
        (Found::Rests, Some(value), moves_at) => {
            let next = value + resolution(&at(value)?.assembly) * moves_at.unwrap_or(value).abs();
            let known = moves_at.is_some_and(|m| m > value);
            let moves = match moves_at.is_none_or(|m| next < m) {
                true => motion(next)?.map(|motion| motion != StateMotion::Rests),
                false => Some(true),
            };
            computed(f, moves.map(|moves| known && moves), format!("at {next} it rests no longer"));
        }
        _ => {}
    }
    Ok(())
}
