//! Whether what was found for other loads or other joints still holds.
//!
//! Forces that balance a scene are admissible under any greater friction, and where loads change in
//! proportion those of two answers, mixed as the loads are, balance every scene between them, since
//! admissible forces are a convex set; a mechanism that gains power is one as long as it gains any.
//! So answers about a scene can prove another verdict long before a program is solved. What is tried
//! is checked as any answer is ([`Proved`]): a wrong guess costs its check, and is no answer.

use super::{Assessment, Proved, assess::from_forces};
use base::tolerance;
use check::verdict::{Forces, Verdict, certificate, mechanism};
use model::{assembly::Wrench, interface::Model};
use std::collections::VecDeque;

/// So many answers are kept of either verdict. More: mixtures of more pairs are looked at. Fewer: a
/// number that goes to and fro leaves the range between two that stand.
const KEPT: usize = 4;

/// Answers about scenes that have the same blocks and contacts.
#[derive(Default)]
pub struct Still {
    stand: VecDeque<(Vec<Wrench>, Forces)>,
    fall: VecDeque<Assessment>,
}

impl Still {
    /// Keeps an answer, and the loads that it is about.
    pub fn keep(&mut self, model: &Model, a: &Assessment) {
        match a.verdict {
            Verdict::Stable => {
                // Two answers about the same loads mix to nothing new.
                self.stand.retain(|(loads, _)| *loads != model.assembly.dead);
                self.stand.push_front((model.assembly.dead.clone(), a.forces.clone()));
                self.stand.truncate(KEPT);
            }
            Verdict::Unstable => {
                self.fall.push_front(a.clone());
                self.fall.truncate(KEPT);
            }
            Verdict::Conditional | Verdict::Undecided => {}
        }
    }

    /// A verdict of this scene under joints that open as they slide, proved by what was kept;
    /// nothing where that proves none.
    pub fn verdict(&self, model: &Model) -> Option<Proved<Assessment>> {
        let falls = self.fall.iter().filter_map(|a| falling(model, a));
        falls.chain(self.mixed(model)).map(|a| Proved::new(model, a)).find(|a| a.claim().is_some())
    }

    /// The forces of every answer alone, then of every two whose loads mix to those of this scene.
    fn mixed<'a>(&'a self, model: &'a Model) -> impl Iterator<Item = Assessment> + 'a {
        let all = self.stand.iter().filter(|(_, forces)| fits(model, forces));
        let pairs = all
            .clone()
            .enumerate()
            .flat_map(move |(k, one)| all.clone().take(k + 1).map(move |other| (one, other)));
        pairs.filter_map(|(one, other)| {
            let share = share(&model.assembly.dead, &one.0, &other.0)?;
            let mix = |a: &Wrench, b: &Wrench| between(a, b, share);
            let mixed = one.1.iter().zip(&other.1);
            let forces = mixed.map(|(a, b)| a.iter().zip(b).map(|(a, b)| mix(a, b)).collect());
            Some(standing(model, forces.collect()))
        })
    }
}

/// Whether forces are those of contacts and members as this model has them.
fn fits(model: &Model, forces: &Forces) -> bool {
    let contacts = model.interfaces.list.iter().map(|f| f.points.len());
    contacts.chain(model.interfaces.members.iter().map(|_| 1)).eq(forces.iter().map(Vec::len))
}

fn between(a: &Wrench, b: &Wrench, share: f64) -> Wrench {
    Wrench {
        force: a.force * share + b.force * (1.0 - share),
        moment: a.moment * share + b.moment * (1.0 - share),
    }
}

/// The share of the first loads in a mixture of both that is these loads; 1 where the first are
/// these, nothing where no mixture is.
fn share(wanted: &[Wrench], one: &[Wrench], other: &[Wrench]) -> Option<f64> {
    if wanted.len() != one.len() || wanted.len() != other.len() {
        return None;
    }
    let dot = |a: Wrench, b: Wrench| a.force.dot(&b.force) + a.moment.dot(&b.moment);
    let minus =
        |a: &Wrench, b: &Wrench| Wrench { force: a.force - b.force, moment: a.moment - b.moment };
    let (mut along, mut length) = (0.0, 0.0);
    for ((w, a), b) in wanted.iter().zip(one).zip(other) {
        let way = minus(a, b);
        along += dot(minus(w, b), way);
        length += dot(way, way);
    }
    let share = if length > 0.0 { along / length } else { 1.0 };
    let near = wanted.iter().zip(one).zip(other).all(|((w, a), b)| {
        let off = minus(w, &between(a, b, share));
        let size = dot(*w, *w).max(dot(*a, *a)).max(dot(*b, *b)).sqrt();
        dot(off, off).sqrt() <= tolerance::MIXED_LOADS * size
    });
    (share.is_finite() && near).then_some(share)
}

/// Forces as an answer that says no more than that they hold.
fn standing(model: &Model, forces: Forces) -> Assessment {
    let equilibrium_error = certificate::statics(model, &forces, 0.0).equilibrium_error;
    Assessment {
        verdict: Verdict::Stable,
        left_out: vec![
            "the program: forces found for other loads or joints are admissible here as well"
                .into(),
        ],
        ..from_forces(model, forces, [0.0, equilibrium_error])
    }
}

/// A mechanism as an answer.
fn falling(model: &Model, a: &Assessment) -> Option<Assessment> {
    if a.rates.len() != model.assembly.blocks.len() || !fits(model, &a.forces) {
        return None;
    }
    let k = certificate::kinematics(model, &a.rates, &a.forces);
    let statics = certificate::statics(model, &a.forces, 0.0);
    (k.norm > 0.0).then(|| Assessment {
        verdict: Verdict::Unstable,
        mechanism: Some(mechanism::read(model, &a.rates)),
        rates: a.rates.clone(),
        left_out: vec![
            "the program: a mechanism found for other loads or joints applies here as well".into(),
        ],
        ..from_forces(model, a.forces.clone(), [k.dead_power / k.norm, statics.equilibrium_error])
    })
}
