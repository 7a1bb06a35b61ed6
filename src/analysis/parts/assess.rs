//! Does every part stand?

use super::{each, left_out, put_rates, scene_forces, scene_rates};
use crate::{
    Assessment, Control,
    assess::{falls_freely, of_part},
    coulomb::{DryState, StateMotion, state},
};
use check::{
    terms::Deciding,
    verdict::{Rate, Verdict, mechanism},
};
use model::interface::{self, Model, Part, is_forest};

/// Decides whether an assembly stands under its dead load, part by part.
pub fn assess(model: &Model, control: &Control) -> Assessment {
    assess_by(model, control, &|part, control| of_part(&part.model, control))
}

/// The same with parts answered by `solve`.
pub fn assess_by(
    model: &Model,
    control: &Control,
    solve: &(dyn Fn(&Part, &Control) -> Assessment + Sync),
) -> Assessment {
    let parts = interface::parts(model);
    if parts.is_empty() {
        return of_part(model, control);
    }
    if let Some(answer) = fall_freely(model, &parts) {
        return answer;
    }
    let all: Vec<usize> = (0..parts.len()).collect();
    let answers = each(&parts, &all, control, |k, control| solve(&parts[k], control));
    merged(model, &parts, &answers)
}

/// What the state under dry friction does: it rests where that of every part does. A part whose
/// contacts form no closed chain has none of its own: statics alone fixes its forces, if there are any.
pub fn motion(model: &Model, control: &Control) -> StateMotion {
    let parts = interface::parts(model);
    let all: Vec<usize> = (0..parts.len()).collect();
    let own = each(&parts, &all, control, |k, control| {
        let part = &parts[k].model;
        match is_forest(part) {
            true if of_part(part, control).verdict == Verdict::Unstable => StateMotion::Moves,
            true => StateMotion::Rests,
            false => state(part, control).motion,
        }
    });
    let is = |motion| own.contains(&motion);
    [StateMotion::Moves, StateMotion::Undecided]
        .into_iter()
        .find(|&m| is(m))
        .unwrap_or(StateMotion::Rests)
}

/// Parts that touch nothing that is held fall with 1 g, which nothing else exceeds: the others are
/// not asked.
fn fall_freely(model: &Model, parts: &[Part]) -> Option<Assessment> {
    let Model { assembly, interfaces, .. } = model;
    let loose = |part: &&Part| part.model.assembly.blocks.iter().all(|b| !b.support);
    let falls = |part: &Part| falls_freely(&part.model);
    let answers: Vec<(usize, Assessment)> = parts
        .iter()
        .enumerate()
        .filter(|(_, p)| loose(p))
        .filter_map(|(k, p)| falls(p).map(|a| (k, a)))
        .collect();
    let &(decides, ref first) = answers.first()?;
    let mut rates = vec![Rate::zero(); assembly.blocks.len()];
    answers.iter().for_each(|(k, a)| put_rates(&parts[*k], &a.rates, 1.0, &mut rates));
    let floating: Vec<Vec<usize>> = parts.iter().filter(loose).map(|p| p.blocks.clone()).collect();
    let count: usize = floating.iter().map(Vec::len).sum();
    Some(Assessment {
        equilibrium_error: first.equilibrium_error,
        part: Deciding::new(parts, decides),
        forces: scene_forces(interfaces, []),
        mechanism: Some(mechanism::read(model, &rates)),
        rates,
        floating,
        left_out: vec![format!(
            "the whole program: {count} free blocks have no contact path to a support"
        )],
        ..first.clone()
    })
}

/// How bad a verdict is for the scene.
fn rank(verdict: Verdict) -> usize {
    match verdict {
        Verdict::Stable => 0,
        Verdict::Conditional => 1,
        Verdict::Undecided => 2,
        Verdict::Unstable => 3,
    }
}

/// The part that decides: the worst verdict, then the greatest equilibrium error, then the first.
fn worst(answers: &[Assessment]) -> usize {
    let measure = |a: &Assessment| match a.verdict {
        Verdict::Unstable => a.equilibrium_error.lower,
        // What dry friction leaves is what tells them apart.
        Verdict::Conditional => {
            a.state.as_ref().and_then(|s| s.steps.last()).map_or(0.0, |s| s.acceleration)
        }
        Verdict::Stable | Verdict::Undecided => a.equilibrium_error.upper,
    };
    let key = |a: &Assessment| (rank(a.verdict), measure(a));
    (1..answers.len())
        .fold(0, |best, k| if key(&answers[k]) > key(&answers[best]) { k } else { best })
}

fn merged(model: &Model, parts: &[Part], answers: &[Assessment]) -> Assessment {
    let Model { assembly, interfaces, .. } = model;
    let decides = worst(answers);
    let (part, worst) = (&parts[decides], &answers[decides]);
    let forces = || parts.iter().zip(answers.iter().map(|a| &a.forces));
    let rates = scene_rates(assembly, part, &worst.rates);
    // Where the part that decides needed none, the one that was slowest to come to rest.
    let slowest = || {
        let last = |a: &Assessment| {
            a.state
                .as_ref()
                .and_then(|s| s.steps.last())
                .map_or(f64::NEG_INFINITY, |s| s.acceleration)
        };
        (0..answers.len())
            .filter(|&k| answers[k].state.is_some())
            .max_by(|&j, &k| last(&answers[j]).total_cmp(&last(&answers[k])))
    };
    let stateful = worst
        .state
        .is_some()
        .then_some(decides)
        .or_else(|| slowest().filter(|_| worst.verdict == Verdict::Stable));
    // Where a part moves, the others hold still: they are in balance exactly, not up to their
    // compliance.
    let settled = |k: usize| Some(k) == stateful || worst.verdict == Verdict::Stable;
    let state = stateful.and_then(|k| {
        let own = |k: usize| {
            answers[k]
                .state
                .as_ref()
                .filter(|s| settled(k) && !s.forces.is_empty())
                .map_or(&answers[k].forces, |s| &s.forces)
        };
        let state = answers[k].state.as_ref()?;
        let all =
            || scene_forces(interfaces, parts.iter().enumerate().map(|(k, part)| (part, own(k))));
        Some(DryState {
            forces: if state.forces.is_empty() { Vec::new() } else { all() },
            ..state.clone()
        })
    });
    let floating = |(part, a): (&Part, &Assessment)| -> Vec<Vec<usize>> {
        a.floating.iter().map(|group| group.iter().map(|&i| part.blocks[i]).collect()).collect()
    };
    Assessment {
        verdict: worst.verdict,
        equilibrium_error: worst.equilibrium_error,
        threshold: worst.threshold,
        // Where all stand, none decides.
        part: Deciding::new(parts, decides).filter(|_| worst.verdict != Verdict::Stable),
        forces: scene_forces(interfaces, forces()),
        load_factor: worst.load_factor,
        mechanism: worst.mechanism.as_ref().map(|_| mechanism::read(model, &rates)),
        rates,
        state,
        floating: parts.iter().zip(answers).flat_map(floating).collect(),
        attempts: answers.iter().flat_map(|a| a.attempts.iter().cloned()).collect(),
        left_out: left_out(interfaces, answers.iter().map(|a| &a.left_out[..]), parts.len()),
    }
}
