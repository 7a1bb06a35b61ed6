//! Other load factors, with forces that balance there where that can be had, and the mechanism
//! whole, in part or scaled away.

use super::{
    draft::{Draft, Forgery},
    honest::Honest,
};
use crate::random::Random;
use analysis::Limited;
use check::verdict::{Forces, Rate, Verdict};
use model::assembly::Wrench;
use serde_json::{Value, json};

/// Shares of a load factor that are claimed in its place.
const LESS: [f64; 4] = [0.0, 0.5, 0.99, 0.9995];
const MORE: [f64; 4] = [1.001, 1.5, 1e6, 1e200];

/// Load factors below this are none: anything near them is true as well as anything else.
const NONE: f64 = 1e-5;

/// Where the evidence for the bound has a part, and that for the value with dry friction.
fn at(part: &str) -> String {
    format!("/evidence/limit/factor/bound/{part}")
}

fn dry_at(part: &str) -> String {
    format!("/evidence/limit/factor/dry/{part}")
}

/// False load factors.
pub(super) fn forge(honest: &Honest, random: &mut Random) -> Vec<Forgery> {
    let Some(Limited { bound, dry, .. }) = &honest.limit else { return Vec::new() };
    let mut made: Vec<Option<Forgery>> = Vec::new();
    let dead = matches!(honest.standing.verdict, Verdict::Stable | Verdict::Conditional)
        .then_some(&honest.standing.forces);
    if let Some(factor) = bound.found().filter(|v| v.abs() > NONE) {
        for share in LESS.into_iter().chain(MORE) {
            let value = share * factor;
            // Admissible forces balance on the way from the dead load to the bound.
            let forces = match dead {
                Some(dead) if share < 1.0 => between(dead, &bound.forces, share),
                _ => bound.forces.clone(),
            };
            for (what, rates) in motions(honest, &bound.rates, random) {
                let draft = narrow(honest, value).forces(honest, &at("forces"), &forces).rates(
                    honest,
                    &at("rates"),
                    &rates,
                );
                let draft = draft.without("/evidence/limit/factor/dry");
                made.push(draft.done(
                    honest,
                    "load factor",
                    format!("{share} × the bound, {what}"),
                ));
            }
        }
        made.extend(brackets(honest, factor));
        made.extend(ends(honest, dead, factor));
    }
    let dry = dry.as_ref().and_then(|d| Some((d, d.value.filter(|v| v.abs() > NONE)?)));
    if let Some((dry, factor)) = dry {
        for share in LESS.into_iter().chain(MORE) {
            let value = share * factor;
            let forces = match dead {
                Some(dead) if share < 1.0 => between(dead, &dry.forces, share),
                _ => dry.forces.clone(),
            };
            let claimed = Draft::of(honest).set(&dry_at("value"), value).set(
                &dry_at("certificate/claim"),
                json!({ "dry_load_factor": { "value": value } }),
            );
            made.push(claimed.clone().done(
                honest,
                "dry load factor",
                format!("{share} × the value, its own evidence"),
            ));
            for (what, rates) in motions(honest, &dry.rates, random) {
                let draft = claimed
                    .clone()
                    .forces(honest, &dry_at("certificate/forces"), &forces)
                    .rates(honest, &dry_at("certificate/rates"), &rates);
                made.push(draft.done(
                    honest,
                    "dry load factor",
                    format!("{share} × the value, {what}"),
                ));
            }
        }
    }
    made.into_iter().flatten().collect()
}

/// The claim says one value in a bracket without width.
fn narrow(honest: &Honest, value: f64) -> Draft {
    bracket(honest, value, value, value)
}

fn bracket(honest: &Honest, value: f64, lower: f64, upper: f64) -> Draft {
    let claim = json!({ "load_factor": { "value": value, "lower": lower, "upper": upper } });
    Draft::of(honest).set(&at("claim"), claim)
}

/// Wider and shifted brackets around the true value and beside it.
fn brackets(honest: &Honest, value: f64) -> Vec<Option<Forgery>> {
    let size = value.abs();
    let wide = [(0.5, 1.0), (1.0, 2.0), (0.9, 1.1), (-10.0, 10.0), (0.999, 1.0), (1.0, 1.001)];
    let wide = wide.into_iter().map(|(low, high)| {
        let (lower, upper) = (value + (low - 1.0) * size, value + (high - 1.0) * size);
        bracket(honest, value, lower, upper).done(
            honest,
            "bracket",
            format!("from {lower} to {upper} around {value}"),
        )
    });
    let shifted = [0.99, 1.01, -1.0]
        .into_iter()
        .map(|by| narrow(honest, by * value).done(honest, "bracket", format!("{by} × the value")));
    wide.chain(shifted).collect()
}

/// That the load has no limit, or that nothing helps.
fn ends(honest: &Honest, dead: Option<&Forces>, value: f64) -> Vec<Option<Forgery>> {
    let bound = honest.limit.as_ref().map(|l| &l.bound.forces);
    let mut made = Vec::new();
    let with = |claim: Value| {
        Draft::of(honest).set(&at("claim"), claim).without("/evidence/limit/factor/dry")
    };
    made.push(with(json!("impossible")).done(
        honest,
        "status",
        format!("impossible instead of {value}"),
    ));
    if let (Some(dead), Some(bound)) = (dead, bound) {
        for by in [1.0, 1e12, 1e24, 1e200] {
            let forces: Forces =
                bound.iter().map(|list| list.iter().map(|&w| w * by).collect()).collect();
            let draft = with(json!({ "unbounded": { "standing": 0.0 } }));
            let draft =
                draft.forces(honest, &at("base"), dead).forces(honest, &at("forces"), &forces);
            made.push(draft.done(
                honest,
                "status",
                format!("without limit instead of {value}, forces × {by:e}"),
            ));
        }
    }
    made
}

/// A mechanism whole, scaled, and with blocks held.
fn motions(honest: &Honest, rates: &[Rate], random: &mut Random) -> Vec<(&'static str, Vec<Rate>)> {
    let scaled = |by: f64| {
        rates
            .iter()
            .map(|r| Rate { velocity: r.velocity * by, spin: r.spin * by })
            .collect::<Vec<_>>()
    };
    let moving: Vec<usize> =
        honest.model.assembly.free().filter(|&i| rates[i] != Rate::zero()).collect();
    let mut list = vec![
        ("the mechanism", rates.to_vec()),
        ("the mechanism × 1e-170", scaled(1e-170)),
        ("the mechanism × 1e200", scaled(1e200)),
    ];
    if moving.len() > 1 {
        let one = moving[random.count(0, moving.len() - 1)];
        let mut held = rates.to_vec();
        held[one] = Rate::zero();
        list.push(("the mechanism with one block held", held));
        let mut alone = vec![Rate::zero(); rates.len()];
        alone[one] = rates[one];
        list.push(("one block of the mechanism alone", alone));
    }
    list
}

/// Forces on the way from one set to another.
fn between(from: &Forces, to: &Forces, share: f64) -> Forces {
    let mix = |(a, b): (&Wrench, &Wrench)| {
        let mut sum = *a * (1.0 - share);
        sum += *b * share;
        sum
    };
    from.iter().zip(to).map(|(a, b)| a.iter().zip(b).map(mix).collect()).collect()
}
