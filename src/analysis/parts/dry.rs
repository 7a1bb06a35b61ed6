//! The load factor with dry friction of a scene is the least of those of its parts, where all the
//! others come to rest there.

use super::{
    each,
    limit::{SAME, under},
    scene_forces, scene_rates,
};
use crate::{
    Control, Law, LoadFactor, Outcome, Proved,
    assess::of_part as assess_part,
    coulomb::{self, DryLoadFactor, Found},
    limit::of_part as limit_part,
};
use check::{
    terms::{Deciding, StateMotion},
    verdict::{Forces, Verdict, no_forces},
};
use model::interface::{self, Model, Part};

/// The load factor with dry friction, up to which every part comes to rest; `associative` is the
/// answer of [`limit`](crate::limit()) for the same model.
pub fn load_factor(
    model: &Model,
    associative: &LoadFactor,
    control: &Control,
) -> Proved<DryLoadFactor> {
    load_factor_from(model, associative, None, control)
}

/// The same where the verdict under the dead load alone is known.
pub fn load_factor_from(
    model: &Model,
    associative: &LoadFactor,
    dead: Option<Verdict>,
    control: &Control,
) -> Proved<DryLoadFactor> {
    Proved::new(model, unproved(model, associative, dead, control))
}

/// The same without the check.
pub fn unproved(
    model: &Model,
    associative: &LoadFactor,
    dead: Option<Verdict>,
    control: &Control,
) -> DryLoadFactor {
    let solve = |part: &Part, bound: Option<&LoadFactor>, control: &Control| {
        let dead = dead_of(part, dead, control);
        match bound {
            Some(bound) => coulomb::of_part(&part.model, bound, dead, control),
            None => {
                let bound = limit_part(&part.model, control);
                coulomb::of_part(&part.model, &bound, dead, control)
            }
        }
    };
    load_factor_by(model, associative, control, (solve, under))
}

/// What is known of a part under the dead load where `dead` is the verdict of the scene: where all
/// stands, every part does; where it falls, one of them does, and each is asked whether it is the
/// one; any other verdict is that of one of them.
pub(crate) fn dead_of(part: &Part, dead: Option<Verdict>, control: &Control) -> Option<Verdict> {
    match dead? {
        Verdict::Unstable => {
            let control = Control { law: Law::Associative, ..*control };
            let own = assess_part(&part.model, &control).verdict;
            Some(own).filter(|&own| own == Verdict::Unstable)
        }
        verdict => Some(verdict).filter(|&v| v == Verdict::Stable),
    }
}

/// The same with ways of one's own: what is asked of a part that the live load acts on (given its
/// own associative answer, where that is known), in its own units, and a part by itself when the
/// scene has this load factor.
pub fn load_factor_by<S, A>(
    model: &Model,
    associative: &LoadFactor,
    control: &Control,
    (solve, at): (S, A),
) -> DryLoadFactor
where
    S: Fn(&Part, Option<&LoadFactor>, &Control) -> DryLoadFactor + Sync,
    A: Fn(&Part, f64) -> Model + Sync,
{
    let parts = interface::parts(model);
    if associative.outcome == Outcome::Impossible
        || control.deadline.is_over()
        || !parts.iter().any(Part::is_driven)
    {
        return coulomb::complementary(model, associative, control);
    }
    let known = |k: usize| {
        associative
            .parts
            .get(k)
            .filter(|_| associative.parts.len() == parts.len())
            .and_then(Option::as_ref)
    };
    let driven: Vec<usize> = (0..parts.len()).filter(|&k| parts[k].is_driven()).collect();
    let answers = each(&parts, &driven, control, |k, control| solve(&parts[k], known(k), control));
    let mut own: Vec<Option<DryLoadFactor>> = parts.iter().map(|_| None).collect();
    driven.iter().zip(answers).for_each(|(&k, a)| own[k] = Some(a));
    let scene = Scene { model, parts: &parts, own: &own };
    scene.answer(control, &at)
}

/// Whether in every part that it acts on the live load alone produces the forces that balance it,
/// so that no multiple of it moves anything.
pub fn rests_alone(model: &Model, control: &Control) -> bool {
    let parts = interface::parts(model);
    let driven: Vec<usize> = (0..parts.len()).filter(|&k| parts[k].is_driven()).collect();
    let rests = each(&parts, &driven, control, |k, control| {
        coulomb::part_rests_alone(&parts[k].model, control)
    });
    !rests.is_empty() && !rests.contains(&false)
}

struct Scene<'a> {
    model: &'a Model,
    parts: &'a [Part],
    /// The answers of the parts that the live load acts on.
    own: &'a [Option<DryLoadFactor>],
}

impl Scene<'_> {
    /// The value of a part, as one of the scene.
    fn value(&self, k: usize) -> Option<f64> {
        let own = self.own[k].as_ref().filter(|a| !open(a.found))?;
        own.value.map(|v| self.parts[k].units.load_factor(v))
    }

    fn answer(
        &self,
        control: &Control,
        at: &(impl Fn(&Part, f64) -> Model + Sync),
    ) -> DryLoadFactor {
        let n = self.parts.len();
        let driven: Vec<(usize, &DryLoadFactor)> =
            self.own.iter().enumerate().filter_map(|(k, a)| Some((k, a.as_ref()?))).collect();
        let values = (0..n).filter_map(|k| self.value(k).map(|v| (k, v)));
        let least = values.reduce(|a, b| if b.1 < a.1 { b } else { a });
        // Without any value: a part that is open, else any of those that have no limit.
        let is_open = |(_, a): &&(usize, &DryLoadFactor)| open(a.found);
        let never_rests = driven.iter().find(|(_, a)| a.found == Found::NotAtRest);
        let &(decides, own) = match (never_rests, least) {
            (Some(_), _) => never_rests,
            (None, Some((k, _))) => driven.iter().find(|d| d.0 == k),
            (None, None) => driven.iter().find(is_open),
        }
        .unwrap_or(&driven[0]);
        let lambda = least.map(|l| l.1);
        let all: Vec<usize> = (0..n).collect();
        let beside = each(self.parts, &all, control, |k, control| {
            self.beside(k, decides, lambda, control, at)
        });
        let refused = (0..n).find(|&k| k != decides && !beside[k].1);
        let found = match refused {
            _ if own.found == Found::NotAtRest => Found::NotAtRest,
            Some(k) if self.own[k].is_none() && beside[k].2 => Found::NotAtRest,
            Some(_) => Found::Undecided,
            None => own.found,
        };
        let scene = |v: f64| self.parts[decides].units.load_factor(v);
        DryLoadFactor {
            found,
            part: Deciding::new(
                self.parts,
                refused.filter(|_| found != own.found).unwrap_or(decides),
            ),
            value: lambda.filter(|_| !open(found)),
            rests_at: own.rests_at.filter(|_| refused.is_none()).map(scene),
            moves_at: own.moves_at.map(scene),
            natural_map: own.natural_map,
            natural_map_in_loads: own.natural_map_in_loads,
            solves: self.own.iter().flatten().map(|a| a.solves).sum(),
            forces: scene_forces(
                &self.model.interfaces,
                self.parts.iter().zip(beside.iter().map(|b| &b.0)),
            ),
            rates: scene_rates(&self.model.assembly, &self.parts[decides], &own.rates),
        }
    }

    /// The forces of part `k` where the scene has the load factor `lambda`, whether it bears that,
    /// and whether it is known not to rest. What has a value of its own bears all that is less, and
    /// so does what has no limit; of the others the state under dry friction has to come to rest.
    fn beside(
        &self,
        k: usize,
        decides: usize,
        lambda: Option<f64>,
        control: &Control,
        at: &impl Fn(&Part, f64) -> Model,
    ) -> (Forces, bool, bool) {
        let part = &self.parts[k];
        let found = self.own[k].as_ref().map(|a| a.found);
        let own = |bears: bool| {
            (
                self.own[k]
                    .as_ref()
                    .map_or_else(|| no_forces(&part.model.interfaces), |a| a.forces.clone()),
                bears,
                false,
            )
        };
        let close =
            self.value(k).zip(lambda).is_some_and(|(v, lambda)| v - lambda <= SAME * lambda.abs());
        if k == decides || close {
            return own(!found.is_some_and(open));
        }
        if lambda.is_none() && found.is_some() {
            return own(found == Some(Found::Unlimited));
        }
        let lambda = lambda.unwrap_or(0.0);
        let law = if found.is_none_or(open) { Law::Coulomb } else { Law::Associative };
        let a = assess_part(&at(part, lambda), &Control { law, ..*control });
        let verdict = a.verdict;
        // A finger presses with all of its strength in those that the loads produce.
        let has_members = !part.model.interfaces.members.is_empty();
        let forces = match a.state.filter(|s| has_members && s.motion == StateMotion::Rests) {
            Some(state) => state.forces,
            None => a.forces,
        };
        (
            forces,
            verdict == Verdict::Stable,
            matches!(verdict, Verdict::Conditional | Verdict::Unstable),
        )
    }
}

/// Without a value.
fn open(found: Found) -> bool {
    matches!(found, Found::Undecided | Found::NotAtRest)
}
