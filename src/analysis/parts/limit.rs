//! The load factor of a scene is the least of those of its parts.

use super::{each, left_out, put_rates, scene_attempts, scene_forces, scene_rates};
use crate::{
    Assessment, Attempt, Bracket, Control, Law, LoadFactor, Outcome,
    assess::of_part as assess_part,
    limit::{of_part as limit_part, of_part_near as limit_part_near},
    warm_start::Near,
};
use check::{
    terms::Deciding,
    verdict::{Forces, Rate, Verdict, certificate, mechanism, no_forces},
};
use model::{
    assembly::Wrench,
    interface::{self, Model, Part},
};

/// How parts are asked.
pub struct PartMethods<S, A> {
    /// The load factor of a part, in its own units.
    pub solve: S,
    /// A part by itself when the scene has this load factor, which is part of its dead load then.
    pub at: A,
}

/// A part under a load factor of the scene, its joints as they are.
pub fn under(part: &Part, lambda: f64) -> Model {
    part.model.at_load_factor(part.units.own_load_factor(lambda))
}

/// The greatest multiple of the live load under which every part has admissible contact forces; each
/// begins near what it passed under other loads.
pub(crate) fn limit(model: &Model, control: &Control, near: &Near) -> LoadFactor {
    let solve = |part: &Part, control: &Control| {
        near.part(part, |near| limit_part_near(&part.model, control, near))
    };
    limit_by(model, control, &PartMethods { solve, at: under })
}

/// The same with ways of one's own.
pub fn limit_by<S, A>(model: &Model, control: &Control, ways: &PartMethods<S, A>) -> LoadFactor
where
    S: Fn(&Part, &Control) -> LoadFactor + Sync,
    A: Fn(&Part, f64) -> Model + Sync,
{
    // The last of many directions may find the time already over: nothing is built for it.
    let parts = if !control.deadline.is_over() { interface::parts(model) } else { Vec::new() };
    if !parts.iter().any(Part::is_driven) {
        return limit_part(model, control);
    }
    let all: Vec<usize> = (0..parts.len()).collect();
    let statics = |control: &Control| Control { law: Law::Associative, ..*control };
    let asked = each(&parts, &all, control, |k, control| {
        let part = &parts[k];
        if part.is_driven() {
            Asked::Driven((ways.solve)(part, control))
        } else {
            Asked::Still(assess_part(&part.model, &statics(control)))
        }
    });
    let mut scene = Scene { model, parts: &parts, asked: &asked, more: Vec::new() };
    let mut answer = scene.answer(&statics(control), &ways.at);
    answer.parts = asked.into_iter().map(Asked::driven).collect();
    answer
}

/// The answer of one part, in its own units.
enum Asked {
    /// The live load acts on it.
    Driven(LoadFactor),
    /// None does: it stands or falls whatever the multiple.
    Still(Assessment),
}

impl Asked {
    fn driven(self) -> Option<LoadFactor> {
        if let Self::Driven(l) = self { Some(l) } else { None }
    }

    fn falls(&self) -> bool {
        match self {
            Self::Driven(l) => l.outcome == Outcome::Impossible,
            Self::Still(a) => a.verdict == Verdict::Unstable,
        }
    }

    fn rates(&self) -> &[Rate] {
        match self {
            Self::Driven(l) => &l.rates,
            Self::Still(a) => &a.rates,
        }
    }

    fn forces(&self) -> &Forces {
        match self {
            Self::Driven(l) => &l.forces,
            Self::Still(a) => &a.forces,
        }
    }
}

struct Scene<'a> {
    model: &'a Model,
    parts: &'a [Part],
    asked: &'a [Asked],
    /// What was tried beside.
    more: Vec<Attempt>,
}

/// Two load factors this close, relative to themselves, are one: the forces of the one serve for
/// the other.
pub const SAME: f64 = 1e-9;

impl Scene<'_> {
    fn answer(
        &mut self,
        control: &Control,
        at: &(impl Fn(&Part, f64) -> Model + Sync),
    ) -> LoadFactor {
        if self.asked.iter().any(Asked::falls) {
            return self.impossible();
        }
        let value = |k: usize| match &self.asked[k] {
            Asked::Driven(l) if l.outcome == Outcome::Found => {
                l.value.map(|v| self.parts[k].units.load_factor(v))
            }
            _ => None,
        };
        let least = (0..self.parts.len())
            .filter_map(|k| value(k).map(|v| (k, v)))
            .reduce(|a, b| if b.1 < a.1 { b } else { a });
        // A part that is still open decides, unless it is proved to bear more than another.
        let open = |k: usize| match &self.asked[k] {
            Asked::Still(a) => a.verdict != Verdict::Stable,
            Asked::Driven(l) => {
                let bears = self.parts[k].units.load_factor(l.bracket.lower);
                l.outcome == Outcome::Undecided
                    && least.is_none_or(|(_, v)| bears.is_nan() || bears <= v)
            }
        };
        if let Some(k) = (0..self.parts.len()).find(|&k| open(k)) {
            return self.undecided(k);
        }
        match least {
            Some((k, value)) => self.found(k, value, control, at),
            None => self.unbounded(),
        }
    }

    /// An answer that says nothing yet; `decides` is the part that it is about.
    fn start(&self, decides: usize) -> LoadFactor {
        let own = |a: &Asked| match a {
            Asked::Driven(l) => l.left_out.clone(),
            Asked::Still(a) => a.left_out.clone(),
        };
        let lines: Vec<Vec<String>> = self.asked.iter().map(own).collect();
        let attempts = self.parts.iter().zip(self.asked).flat_map(|(part, a)| match a {
            Asked::Driven(l) => scene_attempts(part, &l.attempts),
            Asked::Still(a) => a.attempts.clone(),
        });
        LoadFactor {
            outcome: Outcome::Undecided,
            value: None,
            bracket: Bracket::UNKNOWN,
            part: Deciding::new(self.parts, decides),
            forces: scene_forces(
                &self.model.interfaces,
                self.parts.iter().zip(self.asked.iter().map(Asked::forces)),
            ),
            base: None,
            rates: vec![Rate::zero(); self.model.assembly.blocks.len()],
            mechanism: None,
            attempts: attempts.collect(),
            left_out: left_out(
                &self.model.interfaces,
                lines.iter().map(|l| &l[..]),
                self.parts.len(),
            ),
            parts: Vec::new(),
        }
    }

    /// Every part that no multiple holds moves: each of them proves it.
    fn impossible(&self) -> LoadFactor {
        let falling: Vec<usize> =
            (0..self.parts.len()).filter(|&k| self.asked[k].falls()).collect();
        let mut answer = self.start(falling[0]);
        falling.iter().for_each(|&k| {
            put_rates(&self.parts[k], self.asked[k].rates(), 1.0, &mut answer.rates)
        });
        self.as_impossible(answer)
    }

    fn as_impossible(&self, answer: LoadFactor) -> LoadFactor {
        LoadFactor {
            outcome: Outcome::Impossible,
            value: None,
            bracket: Bracket { lower: f64::NEG_INFINITY, upper: f64::NEG_INFINITY },
            mechanism: Some(mechanism::read(self.model, &answer.rates)),
            ..answer
        }
    }

    fn undecided(&self, decides: usize) -> LoadFactor {
        let mut answer = self.start(decides);
        answer.bracket.lower = f64::INFINITY;
        for (part, asked) in self.parts.iter().zip(self.asked) {
            match asked {
                Asked::Driven(l) => {
                    let [lower, upper] =
                        [l.bracket.lower, l.bracket.upper].map(|v| part.units.load_factor(v));
                    answer.bracket.lower = answer.bracket.lower.min(lower);
                    if upper < answer.bracket.upper {
                        answer.bracket.upper = upper;
                        answer.rates = scene_rates(&self.model.assembly, part, &l.rates);
                    }
                }
                Asked::Still(a) if a.verdict != Verdict::Stable => {
                    answer.bracket.lower = f64::NEG_INFINITY
                }
                Asked::Still(_) => {}
            }
        }
        if let Asked::Driven(l) = &self.asked[decides] {
            answer.value = l.value.map(|v| self.parts[decides].units.load_factor(v));
        }
        answer
    }

    /// Where the live load wedges in every part that it acts on.
    fn unbounded(&self) -> LoadFactor {
        let mut answer = self.start(0);
        answer.part = None;
        let driven = || {
            self.parts.iter().zip(self.asked).filter_map(|(part, asked)| match asked {
                Asked::Driven(l) => Some((part, l)),
                Asked::Still(_) => None,
            })
        };
        let base = |part: &Part, l: &LoadFactor| {
            l.base.as_ref().map_or(f64::NEG_INFINITY, |b| part.units.load_factor(b.0))
        };
        // From there on all of them stand.
        let standing = driven().map(|(part, l)| base(part, l)).fold(f64::NEG_INFINITY, f64::max);
        (answer.forces, answer.outcome) = (no_forces(&self.model.interfaces), Outcome::Unbounded);
        answer.bracket = Bracket { lower: f64::INFINITY, upper: f64::INFINITY };
        let mut forces = answer.forces.clone();
        for (part, asked) in self.parts.iter().zip(self.asked) {
            let Asked::Driven(l) = asked else {
                part.put_forces(asked.forces(), &mut forces);
                continue;
            };
            let Some((own, base)) = &l.base else { continue };
            part.put_forces(
                &combined(base, &l.forces, part.units.own_load_factor(standing) - own),
                &mut forces,
            );
            // Those of the live load alone: per unit of the scene's load factor.
            part.put_forces(
                &combined(
                    &no_forces(&part.model.interfaces),
                    &l.forces,
                    part.units.own_load_factor(1.0),
                ),
                &mut answer.forces,
            );
        }
        answer.base = Some((standing, forces));
        answer
    }

    /// The least load factor is that of part `decides`: do the others stand there?
    fn found(
        &mut self,
        decides: usize,
        value: f64,
        control: &Control,
        at: &(impl Fn(&Part, f64) -> Model + Sync),
    ) -> LoadFactor {
        let mut answer = self.start(decides);
        let (part, Asked::Driven(own)) = (&self.parts[decides], &self.asked[decides]) else {
            return answer;
        };
        // Forces balance at the lower end; those of the others serve where theirs is the same to
        // the last digit.
        let standing_at = part.units.load_factor(own.bracket.lower);
        let bears_more = |k: usize| match &self.asked[k] {
            Asked::Driven(l) => {
                let theirs = self.parts[k].units.load_factor(l.bracket.lower);
                k != decides && (l.outcome != Outcome::Found || theirs != standing_at)
            }
            Asked::Still(_) => false,
        };
        let others: Vec<usize> = (0..self.parts.len()).filter(|&k| bears_more(k)).collect();
        let standing = each(self.parts, &others, control, |k, control| {
            assess_part(&at(&self.parts[k], standing_at), control)
        });
        for (&k, a) in others.iter().zip(&standing) {
            self.parts[k].put_forces(&a.forces, &mut answer.forces);
            self.more.extend(a.attempts.iter().cloned());
        }
        answer.attempts.append(&mut self.more);
        answer.rates = scene_rates(&self.model.assembly, part, &own.rates);
        for (&k, a) in others.iter().zip(&standing).filter(|(_, a)| a.verdict == Verdict::Unstable)
        {
            if let Some(rates) = self.opposed([(decides, &own.rates), (k, &a.rates)]) {
                answer.part = Deciding::new(self.parts, k);
                answer.rates = rates;
                return self.as_impossible(answer);
            }
        }
        let bracket = [own.bracket.lower, own.bracket.upper].map(|v| part.units.load_factor(v));
        answer.bracket = Bracket { lower: bracket[0], upper: bracket[1] };
        answer.value = Some(value);
        if let Some((&k, _)) =
            others.iter().zip(&standing).find(|(_, a)| a.verdict != Verdict::Stable)
        {
            // The mechanism bounds it; whether this part bears as much is not known.
            answer.part = Deciding::new(self.parts, k);
            answer.bracket.lower = f64::NEG_INFINITY;
            return answer;
        }
        answer.outcome = Outcome::Found;
        answer.mechanism = Some(mechanism::read(self.model, &answer.rates));
        self.say(&mut answer, others.len());
        answer
    }

    /// Two mechanisms, of which the live load drives one and holds back the other, each at the
    /// speed at which these powers cancel.
    fn opposed(&self, pair: [(usize, &Vec<Rate>); 2]) -> Option<Vec<Rate>> {
        let mut rates = vec![Rate::zero(); self.model.assembly.blocks.len()];
        let mut powers = [0.0; 2];
        for ((k, own), power) in pair.iter().zip(&mut powers) {
            let part = &self.parts[*k];
            *power = part
                .model
                .assembly
                .free()
                .map(|i| certificate::power(&part.model.assembly.live[i], &own[i]))
                .sum::<f64>()
                * part.units.live;
            put_rates(part, own, 1.0 / power.abs(), &mut rates);
        }
        (powers[0] > 0.0 && powers[1] < 0.0).then_some(rates)
    }

    /// Says which parts the load factor does not depend on.
    fn say(&self, answer: &mut LoadFactor, more: usize) {
        let n = self.parts.len();
        let still = self.asked.iter().filter(|a| matches!(a, Asked::Still(_))).count();
        if still > 0 {
            answer.left_out.push(format!(
                "{still} of {n} independent parts: no live load acts on them, and they stand"
            ));
        }
        if more > 0 {
            answer.left_out.push(format!("the load factors of {more} of {n} independent parts: they are greater, and these parts stand at the least one"));
        }
    }
}

/// `base + by × more`.
fn combined(base: &Forces, more: &Forces, by: f64) -> Forces {
    let sum = |(b, m): (&Wrench, &Wrench)| Wrench {
        force: b.force + m.force * by,
        moment: b.moment + m.moment * by,
    };
    base.iter().zip(more).map(|(b, m)| b.iter().zip(m).map(sum).collect()).collect()
}
