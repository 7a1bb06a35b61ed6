//! The opposite of a proved verdict, with evidence made for it.

use super::{
    draft::{Draft, Forgery},
    honest::Honest,
};
use crate::random::Random;
use check::verdict::{Forces, Rate, Verdict, law, no_forces};
use model::{
    assembly::Wrench,
    interface::{Interfaces, Model},
};
use nalgebra::Vector3;
use scene::Friction;

/// Factors on rates: squares of the small ones are zero, of the large ones infinite.
const SCALES: [f64; 6] = [1.0, 1e-170, 1e-300, 1e-9, 1e170, 1e300];
/// Squeezes in multiples of the total load: what is added to them disappears in their rounding.
const SQUEEZES: [f64; 6] = [1e8, 1e16, 1e24, 1e150, 1e180, 1e290];

/// Every other verdict with every evidence.
pub(super) fn forge(honest: &Honest, random: &mut Random) -> Vec<Forgery> {
    if honest.name != "assess" {
        return Vec::new();
    }
    let made: Vec<Option<Forgery>> = match honest.standing.verdict {
        Verdict::Stable => [falls(honest, random), needs_a_pre_stress(honest, random)]
            .into_iter()
            .flatten()
            .collect(),
        Verdict::Conditional => falls(honest, random),
        Verdict::Unstable => [stands(honest, random), needs_a_pre_stress(honest, random)]
            .into_iter()
            .flatten()
            .collect(),
        Verdict::Undecided => Vec::new(),
    };
    made.into_iter().flatten().collect()
}

/// Where the evidence for the verdict has a part.
fn at(part: &str) -> String {
    format!("/evidence/assess/standing/certificate/{part}")
}

fn claim(honest: &Honest, verdict: &str) -> Draft {
    Draft::of(honest).set(&at("claim"), verdict).without(&at("base"))
}

/// That it falls, by rates that are none or whose squares are none.
fn falls(honest: &Honest, random: &mut Random) -> Vec<Option<Forgery>> {
    let assembly = &honest.model.assembly;
    let still = vec![Rate::zero(); assembly.blocks.len()];
    let free: Vec<usize> = assembly.free().collect();
    let down = assembly.gravity.normalize();
    let mut motions: Vec<(&str, Vec<Rate>)> = Vec::new();
    let of = |blocks: &[usize], rate: Rate| {
        let mut rates = still.clone();
        blocks.iter().for_each(|&i| rates[i] = rate);
        rates
    };
    let velocity = |velocity: Vector3<f64>| Rate { velocity, spin: Vector3::zeros() };
    motions.push(("all fall", of(&free, velocity(down))));
    let one = [free[random.count(0, free.len() - 1)]];
    motions.push(("one falls", of(&one, velocity(down))));
    let aside = random.vector().cross(&down);
    motions.push(("all slide", of(&free, velocity(aside + 0.1 * down))));
    motions.push(("one slides", of(&one, velocity(aside + 1e-3 * down))));
    motions.push(("one turns", of(&one, Rate { velocity: down * 1e-3, spin: random.vector() })));
    let mut noise = still.clone();
    free.iter()
        .for_each(|&i| noise[i] = Rate { velocity: random.vector() + down, spin: random.vector() });
    motions.push(("noise", noise));
    // Along the contacts of one block: it closes none of them, and friction is all that holds it.
    if let Some(face) = honest.model.interfaces.list.iter().find(|f| f.a == one[0] || f.b == one[0])
    {
        let n = face.frame.n;
        let along = down - n * n.dot(&down);
        motions.push(("one slides along a joint", of(&one, velocity(along))));
    }
    let none = no_forces(&honest.model.interfaces);
    let mut made = Vec::new();
    for (what, rates) in motions {
        for scale in SCALES {
            let rates: Vec<Rate> = rates
                .iter()
                .map(|r| Rate { velocity: r.velocity * scale, spin: r.spin * scale })
                .collect();
            let draft = claim(honest, "unstable").forces(honest, &at("forces"), &none).rates(
                honest,
                &at("rates"),
                &rates,
            );
            made.push(draft.done(honest, "falls", format!("{what}, × {scale:e}")));
        }
    }
    made
}

/// That it stands, by forces in whose rounding the loads disappear, or that pull.
fn stands(honest: &Honest, random: &mut Random) -> Vec<Option<Forgery>> {
    let model = &honest.model;
    let Model { assembly, interfaces, .. } = model;
    let total: f64 = assembly.free().map(|i| assembly.dead[i].force.norm()).sum();
    let best = &honest.standing.forces;
    let mut all: Vec<(String, Forces)> = vec![
        ("no forces".into(), no_forces(interfaces)),
        ("the best there are".into(), best.clone()),
    ];
    for by in SQUEEZES {
        let size = by * total;
        all.push((format!("squeezed by {by:e}"), squeezed(model, best, |n| n * size)));
        all.push((format!("pulled by {by:e}"), squeezed(model, best, |n| n * -size)));
        let aside = random.vector();
        all.push((format!("sheared by {by:e}"), squeezed(model, best, |n| n.cross(&aside) * size)));
        all.push((format!("× {by:e}"), scaled(best, by)));
        all.push((format!("pairs of {by:e} within each joint"), paired(interfaces, best, size)));
        all.push((
            format!("pairs of {by:e} along the normals"),
            tilted_pairs(interfaces, best, size),
        ));
    }
    all.into_iter()
        .map(|(what, forces)| {
            let draft = claim(honest, "stable").forces(honest, &at("forces"), &forces);
            draft.set(&at("rates"), serde_json::json!([])).done(honest, "stands", what)
        })
        .collect()
}

/// That it stands only with self-stress: forces without one that leave a motion, which is claimed
/// as well.
fn needs_a_pre_stress(honest: &Honest, random: &mut Random) -> Vec<Option<Forgery>> {
    let model = &honest.model;
    let interfaces = &model.interfaces;
    let good = &honest.standing.forces;
    let mut bases: Vec<(String, Forces)> = vec![
        ("no forces".into(), no_forces(interfaces)),
        ("the forces themselves".into(), good.clone()),
    ];
    for _ in 0..4.min(interfaces.list.len()) {
        // One joint at its friction limit, or without forces.
        let k = random.count(0, interfaces.list.len() - 1);
        let face = &interfaces.list[k];
        let aside = random.vector();
        let along = (aside - face.frame.n * face.frame.n.dot(&aside)).normalize();
        let mu = match face.law.friction {
            Friction::Coefficient(mu) => mu,
            Friction::Infinite => 1.0,
        };
        let mut slid = good.clone();
        slid[k].iter_mut().for_each(|w| w.force += along * (mu * w.force.norm()));
        bases.push(("one joint at its friction limit".into(), slid));
        let mut open = good.clone();
        open[k].iter_mut().for_each(|w| *w = Wrench::zero());
        bases.push(("one joint without forces".into(), open));
        let mut faint = good.clone();
        faint[k].iter_mut().for_each(|w| w.force *= 0.5);
        bases.push(("one joint with half of its forces".into(), faint));
    }
    bases
        .into_iter()
        .map(|(what, base)| {
            let rates = law::motion(model, &base).rates;
            let draft = claim(honest, "conditional").forces(honest, &at("forces"), good);
            let draft =
                draft.forces(honest, &at("base"), &base).rates(honest, &at("rates"), &rates);
            draft.done(honest, "needs self-stress", what)
        })
        .collect()
}

/// Forces with one added at every point, alternately one way and the other between the contacts of
/// each block, as far as they come in pairs.
fn squeezed(
    model: &Model,
    forces: &Forces,
    force: impl Fn(Vector3<f64>) -> Vector3<f64>,
) -> Forces {
    let Model { assembly, interfaces, .. } = model;
    let mut forces = forces.clone();
    for i in assembly.free() {
        let own: Vec<usize> = (0..interfaces.list.len())
            .filter(|&k| interfaces.list[k].a == i || interfaces.list[k].b == i)
            .collect();
        // Into the block, on both of a pair of opposite contacts.
        let inward = |k: usize| {
            if interfaces.list[k].b == i {
                interfaces.list[k].frame.n
            } else {
                -interfaces.list[k].frame.n
            }
        };
        let opposite = |&(a, b): &(usize, usize)| inward(a).dot(&inward(b)) < -0.999;
        let pairs =
            own.iter().flat_map(|&a| own.iter().map(move |&b| (a, b))).filter(|(a, b)| a < b);
        let Some((a, b)) = pairs.clone().find(opposite).or_else(|| pairs.clone().next()) else {
            continue;
        };
        let on_block = force(inward(a));
        for (k, on_block) in [(a, on_block), (b, -on_block)] {
            let sign = if interfaces.list[k].b == i { 1.0 } else { -1.0 };
            forces[k].iter_mut().for_each(|w| w.force += on_block * sign);
        }
    }
    forces
}

fn scaled(forces: &Forces, by: f64) -> Forces {
    forces.iter().map(|list| list.iter().map(|&w| w * by).collect()).collect()
}

/// Forces with a pair added within each joint that balances exactly: along the line between two of
/// its points.
fn paired(interfaces: &Interfaces, forces: &Forces, size: f64) -> Forces {
    let mut forces = forces.clone();
    for (face, list) in interfaces.list.iter().zip(&mut forces) {
        if let [p, q, ..] = face.points[..] {
            let along = (q - p).normalize() * size;
            list[0].force += along;
            list[1].force -= along;
        }
    }
    forces
}

/// Forces with pulls and pushes on opposite corners of each joint, which balance where these form a
/// parallelogram.
fn tilted_pairs(interfaces: &Interfaces, forces: &Forces, size: f64) -> Forces {
    let mut forces = forces.clone();
    for (face, list) in
        interfaces.list.iter().zip(&mut forces).filter(|(face, _)| face.points.len() == 4)
    {
        for (place, wrench) in list.iter_mut().enumerate() {
            wrench.force += face.frame.n * if place % 2 == 0 { size } else { -size };
        }
    }
    forces
}
