//! The thrust on a support is the sum over the parts that touch it; a member belongs to one part.

use super::{left_out, put_rates, scene_forces};
use crate::{
    Bracket, Control, Outcome,
    critical_value::Flip,
    geometric::{self, Geometric},
    thrust::{ThrustEnd, of_part},
};
use check::verdict::{
    Forces, Rate,
    thrust::{Extreme, MemberAt, Sought, ThrustAt},
};
use model::interface::{self, Model, Part};

/// The least or greatest thrust of a scene that stands; `standing` are forces that balance its
/// loads.
pub fn thrust(
    scene: &Model,
    at: &Sought,
    extreme: Extreme,
    standing: &Forces,
    control: &Control,
) -> ThrustEnd {
    let Model { assembly, interfaces, .. } = scene;
    let parts = interface::parts(scene);
    let own = |p: &Part| match *at {
        Sought::Thrust(at) => {
            p.find(at.support).map(|support| Sought::Thrust(ThrustAt { support, ..at }))
        }
        Sought::Member(at) => {
            p.find_member(at.member).map(|member| Sought::Member(MemberAt { member, ..at }))
        }
    };
    let touching: Vec<(&Part, Sought)> =
        parts.iter().filter_map(|p| own(p).map(|at| (p, at))).collect();
    if touching.is_empty() {
        return of_part(scene, at, extreme, standing, control);
    }
    let ask = |(part, at): &(&Part, Sought)| {
        of_part(&part.model, at, extreme, &part.take_forces(standing), control)
    };
    let ends: Vec<ThrustEnd> = touching.iter().map(ask).collect();
    let any = |outcome: Outcome| ends.iter().any(|e| e.outcome == outcome);
    // One that has no end leaves the sum without, whatever the others are.
    let outcome = [Outcome::Unbounded, Outcome::Undecided]
        .into_iter()
        .find(|&o| any(o))
        .unwrap_or(Outcome::Found);
    let pushed = || touching.iter().map(|t| t.0).zip(&ends);
    let sum = |number: fn(&ThrustEnd) -> f64| -> f64 {
        pushed().map(|(p, e)| number(e) * p.units.force).sum()
    };
    let value = || pushed().map(|(p, e)| e.value.map(|v| v * p.units.force)).sum::<Option<f64>>();
    let mut rates = vec![Rate::zero(); assembly.blocks.len()];
    pushed().for_each(|(part, e)| put_rates(part, &e.rates, 1.0, &mut rates));
    let forces = if outcome == Outcome::Unbounded {
        scene_forces(
            interfaces,
            pushed().filter(|(_, e)| e.outcome == outcome).map(|(p, e)| (p, &e.forces)),
        )
    } else {
        let mut forces = standing.clone();
        pushed()
            .filter(|(_, e)| e.outcome != Outcome::Unbounded)
            .for_each(|(p, e)| p.put_forces(&e.forces, &mut forces));
        forces
    };
    let bracket = match outcome {
        Outcome::Unbounded => {
            let end = -extreme.sigma() * f64::INFINITY;
            Bracket { lower: end, upper: end }
        }
        _ => Bracket { lower: sum(|e| e.bracket.lower), upper: sum(|e| e.bracket.upper) },
    };
    let mut left_out = left_out(interfaces, ends.iter().map(|e| &e.left_out[..]), ends.len());
    let apart = parts.len() - touching.len();
    if apart > 0 {
        left_out.push(format!(
            "{apart} of {} independent parts: they do not touch the {}",
            parts.len(),
            if matches!(at, Sought::Thrust(_)) { "support" } else { "member" }
        ));
    }
    let attempts = pushed().flat_map(|(part, e)| {
        let end = |v: f64| v * part.units.force;
        e.attempts.iter().map(move |a| super::Attempt {
            lower: end(a.lower),
            upper: end(a.upper),
            ..a.clone()
        })
    });
    ThrustEnd {
        at: *at,
        extreme,
        outcome,
        value: if outcome == Outcome::Unbounded { None } else { value() },
        bracket,
        forces,
        base: (outcome == Outcome::Unbounded).then(|| standing.clone()),
        rates,
        attempts: attempts.collect(),
        left_out,
    }
}

/// The geometric safety factor of a scene that stands: the least of those of its parts, with
/// verdicts on the whole scene.
pub fn geometric_factor(scene: &Model, control: &Control) -> Geometric {
    let parts = interface::parts(scene);
    if parts.len() <= 1 {
        return geometric::of_part(scene, control);
    }
    let mut worst: Option<Flip> = None;
    for part in &parts {
        match geometric::of_part(&part.model, control) {
            Geometric::Found(flip) if worst.as_ref().is_none_or(|w| flip.value > w.value) => {
                worst = Some(*flip)
            }
            Geometric::Found(_) | Geometric::Beyond(_) => {}
            Geometric::Open(why) => return Geometric::Open(why),
        }
    }
    geometric::on_scene(scene, worst, control)
}
