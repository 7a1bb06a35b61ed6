//! Scenes in which edges or corners meet edges or corners, where several normals keep blocks apart.
//!
//! Which of the normals acts is decided by motions too small to be seen, so that the forces a touch
//! may carry form no cone, and two programs enclose the truth: with a small flat across the middle
//! of the normals (forces in it are admissible) and with a contact in every way at once (a motion
//! that closes none of them is possible). First the scene is asked without such touches: what stands
//! without them stands, and a motion that closes none is one. What is proved of either is checked
//! on the scene with all of them ([`Proved`](super::Proved)).

use super::{Assessment, Bracket, Claims, Control, Law, LoadFactor, Outcome, thrust::ThrustEnd};
use check::verdict::{Forces, Verdict, claim, no_forces, thrust::Extreme};
use model::interface::Model;

/// Whether an answer is proved of a scene with all its touches.
fn holds(model: &Model, answer: &impl Claims) -> bool {
    answer.claim().is_some_and(|c| claim::verify(model, &c, answer.evidence()).proved())
}

/// Forces of the scene without flats as those of the scene with them, which carry nothing.
fn beside_flats(model: &Model, forces: &Forces) -> Forces {
    if forces.is_empty() {
        return Forces::new();
    }
    let list = &model.interfaces.list;
    let mut all = no_forces(&model.interfaces);
    let firm = (0..all.len()).filter(|&k| list.get(k).is_none_or(|f| f.ways.is_empty()));
    firm.zip(forces).for_each(|(k, own)| all[k].clone_from(own));
    all
}

/// Does it stand? `ask` answers it of contacts with one normal each.
pub(super) fn assess(
    model: &Model,
    control: &Control,
    ask: &dyn Fn(&Model, &Control) -> Assessment,
) -> Assessment {
    let (Some(less), Some(wide)) = (model.without_flats(), model.every_way()) else {
        return ask(model, control);
    };
    let mut bare = ask(&less, control);
    bare.forces = beside_flats(model, &bare.forces);
    if let Some(state) = &mut bare.state {
        state.forces = beside_flats(model, &state.forces);
    }
    let settles = |a: &Assessment| match a.verdict {
        Verdict::Stable => true,
        Verdict::Unstable => holds(model, a),
        Verdict::Conditional | Verdict::Undecided => false,
    };
    if settles(&bare) {
        return bare;
    }
    let flat = ask(model, control);
    if flat.verdict != Verdict::Unstable || settles(&flat) {
        return flat;
    }
    let every = ask(&wide, &Control { law: Law::Associative, ..*control });
    let Assessment { rates, mechanism, unbalance, .. } = every;
    match every.verdict {
        Verdict::Unstable => Assessment { rates, mechanism, unbalance, ..flat },
        _ => Assessment {
            verdict: Verdict::Undecided,
            unbalance: Bracket { lower: 0.0, ..flat.unbalance },
            mechanism: None,
            ..flat
        },
    }
}

/// The greatest load factor; `ask` answers it of contacts with one normal each.
pub(super) fn limit(
    model: &Model,
    control: &Control,
    ask: &mut dyn FnMut(&Model, &Control) -> LoadFactor,
) -> LoadFactor {
    let (Some(less), Some(wide)) = (model.without_flats(), model.every_way()) else {
        return ask(model, control);
    };
    let mut bare = ask(&less, control);
    bare.forces = beside_flats(model, &bare.forces);
    bare.base = bare.base.map(|(at, forces)| (at, beside_flats(model, &forces)));
    if holds(model, &bare) {
        return bare;
    }
    let flat = ask(model, control);
    if holds(model, &flat) {
        return flat;
    }
    let every = ask(&wide, control);
    let lower = match flat.outcome {
        Outcome::Impossible => f64::NEG_INFINITY,
        _ => flat.bracket.lower,
    };
    let both = LoadFactor {
        outcome: match every.outcome {
            Outcome::Impossible => Outcome::Impossible,
            _ => Outcome::Found,
        },
        bracket: Bracket { lower, upper: every.bracket.upper },
        rates: every.rates,
        mechanism: every.mechanism,
        ..flat
    };
    match holds(model, &both) {
        true => both,
        false => LoadFactor { outcome: Outcome::Undecided, mechanism: None, ..both },
    }
}

/// An end of a thrust; `ask` answers it of contacts with one normal each.
pub(super) fn thrust(
    model: &Model,
    standing: &Forces,
    ask: &dyn Fn(&Model, &Forces) -> ThrustEnd,
) -> ThrustEnd {
    let flat = ask(model, standing);
    let Some(wide) = model.every_way().filter(|_| !holds(model, &flat)) else { return flat };
    let mut more = no_forces(&wide.interfaces);
    let extra = wide.interfaces.list.len() - model.interfaces.list.len();
    for (k, own) in standing.iter().enumerate() {
        let at = if k < model.interfaces.list.len() { k } else { k + extra };
        more[at].clone_from(own);
    }
    let every = ask(&wide, &more);
    // The forces are those across the flats, the bound is that of all ways.
    let bracket = match flat.extreme {
        Extreme::Least => Bracket { lower: every.bracket.lower, upper: flat.bracket.upper },
        Extreme::Greatest => Bracket { lower: flat.bracket.lower, upper: every.bracket.upper },
    };
    let both = ThrustEnd { outcome: Outcome::Found, bracket, rates: every.rates, ..flat };
    match holds(model, &both) {
        true => both,
        false => ThrustEnd { outcome: Outcome::Undecided, value: None, ..both },
    }
}
