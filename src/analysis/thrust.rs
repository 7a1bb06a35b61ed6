//! The least and the greatest thrust on a support, and how far the line of thrust stays inside.
//!
//! The *thrust* is the horizontal component, along a direction, of the force that the blocks exert
//! on a support. Where it has no end (blocks wedged between supports), that is an answer of its
//! own. Beside it stands the geometric safety factor ([`geometric`](super::geometric)).

use super::{
    Assessment, Control, Proved, assess,
    geometric::{Geometric, geometric_factor},
    ladder::{Candidate, Rung, run},
    parts,
    proved::is_proved,
};
use base::{
    error::{InputError, JsonPath},
    tolerance,
};
use check::{
    terms::{Attempt, Bracket, Law, Outcome},
    verdict::{
        Forces, Rate, Verdict, certificate, no_forces,
        section::centroid,
        thrust::{Extreme, MemberAt, Sought, ThrustAt, width},
    },
};
use model::{
    assembly::Action,
    interface::{Interfaces, Model},
    strength::laws::unlimited,
};
use nalgebra::Vector3;
use solve::{
    EngineSettings,
    deadline::Deadline,
    program::{self, Statics, StaticsOptions},
};

/// One end of the range of thrusts.
#[derive(Clone, Debug)]
pub struct ThrustEnd {
    /// The thrust on a support, or the force in a member.
    pub at: Sought,
    /// Which one.
    pub extreme: Extreme,
    /// What became of it ([`Outcome::Impossible`] does not occur).
    pub outcome: Outcome,
    /// The thrust of the forces, N, where there is one.
    pub value: Option<f64>,
    /// Its bracket, N.
    pub bracket: Bracket,
    /// Found: forces at `value`. Unbounded: forces that push without any load.
    pub forces: Forces,
    /// Unbounded: forces that balance the loads.
    pub base: Option<Forces>,
    /// Rates of the blocks as the support moves out (least) or in (greatest) at unit rate.
    pub rates: Vec<Rate>,
    /// What was tried.
    pub attempts: Vec<Attempt>,
    /// What the scene did not need.
    pub left_out: Vec<String>,
}

/// Best first, in forces. Beside each rung: for how many of 233 random scenes (`trials soak 500`)
/// it was the last that was tried, and which of them stay open without it. Of 34 structures and 38
/// reference cases none went further than the first.
const LADDER: [Rung; 5] = [
    // 224. Without it none: later ones decide those.
    Rung::FORCES,
    // 2. Without it none.
    Rung { unit: 4.0, tolerance: 1e-12, engine: EngineSettings::clarabel(1e-9), ..Rung::FORCES },
    // 3. Without it none.
    Rung { unit: 0.25, tolerance: 1e-12, ..Rung::FORCES },
    // 4. Without it those 4.
    Rung { local: false, engine: EngineSettings::clarabel(1e-7), ..Rung::FORCES },
    // None came so far.
    Rung {
        tolerance: 1e-10,
        engine: EngineSettings::Clarabel { regularization: 1e-8, equilibrate: false },
        ..Rung::FORCES
    },
];

/// Where a thrust is asked for: on this support, or the first that touches a free block; in the
/// part of this direction across gravity, or outwards.
///
/// # Errors
/// There is no such support, it touches no free block, or no direction follows.
pub fn place(
    model: &Model,
    support: Option<&str>,
    direction: Option<[f64; 3]>,
) -> Result<ThrustAt, InputError> {
    let error = |text: String| InputError::at(JsonPath::root(), text);
    let blocks = &model.assembly.blocks;
    let supports = || {
        blocks
            .iter()
            .filter(|b| b.support)
            .map(|b| b.id.as_str())
            .take(8)
            .collect::<Vec<_>>()
            .join(", ")
    };
    let support = match support {
        Some(id) => match model.assembly.find(id) {
            Some(index) if blocks[index].support => index,
            Some(_) => {
                return Err(error(format!("support {id}: this block is not a support"))
                    .hint(format!("supports are {}", supports())));
            }
            None => {
                return Err(error(format!("support {id}: there is no such block"))
                    .hint(format!("supports are {}", supports())));
            }
        },
        None => bearing_supports(model)
            .first()
            .copied()
            .ok_or_else(|| error("no support touches a free block: there is no thrust".into()))?,
    };
    let id = &blocks[support].id;
    if !touches(model, support) {
        let text = format!("support {id} touches no free block: there is no thrust on it");
        return Err(error(text).hint("`voussoir check` lists near misses"));
    }
    let direction = match direction {
        Some(d) => {
            level(&model.assembly.gravity, d.into(), Vector3::from(d).norm()).ok_or_else(|| {
                error(format!("direction {d:?} is parallel to gravity"))
                    .hint("give one across gravity, such as 1,0,0")
            })?
        }
        None => outwards(model, support).ok_or_else(|| {
            error(format!(
                "support {id} lies straight below the blocks: it has no outward direction"
            ))
            .hint("give a direction, such as 1,0,0")
        })?,
    };
    Ok(ThrustAt { support, direction: direction.into() })
}

/// The member that is asked about; of a dowel the shear on the second block in the part of this
/// direction across the normal of its joint, of a plane scene without one in the plane.
///
/// # Errors
/// There is no member of this name, a direction is missing, or it means nothing.
pub fn member(model: &Model, id: &str, direction: Option<[f64; 3]>) -> Result<Sought, InputError> {
    let members = &model.interfaces.members;
    let error = |text: String| InputError::at(JsonPath::root(), text);
    let Some(index) = members.iter().position(|m| m.id == id) else {
        let names = members.iter().map(|m| m.id.as_str()).take(8).collect::<Vec<_>>().join(", ");
        let hint = if members.is_empty() {
            "the scene has no members".into()
        } else {
            format!("members are {names}")
        };
        return Err(error(format!("member {id}: there is no such member")).hint(hint));
    };
    let Action::Shear { normal, .. } = &members[index].action else {
        return match direction {
            Some(_) => Err(error(format!("member {id}: its force already has a direction"))
                .hint("give a direction only for thrusts on supports and for dowels")),
            None => Ok(Sought::Member(MemberAt { member: index, along: None })),
        };
    };
    let along = match direction.map(Vector3::from) {
        Some(d) => level(normal, d, d.norm()).ok_or_else(|| {
            let d: [f64; 3] = d.into();
            error(format!("direction {d:?} is parallel to the normal of {id}'s joint"))
                .hint("a dowel takes shear: give a direction in the joint")
        })?,
        None => {
            let plane = Statics::new(model, StaticsOptions::default()).plane;
            let across = plane.and_then(|p| level(normal, p.axis.cross(normal), 1.0));
            across.ok_or_else(|| {
                error(format!("member {id}: the force of a dowel needs a direction"))
                    .hint("give one in the joint, such as --direction 1,0,0")
            })?
        }
    };
    Ok(Sought::Member(MemberAt { member: index, along: Some(along.into()) }))
}

/// Whether a support touches a free block.
fn touches(model: &Model, support: usize) -> bool {
    let free = |i: usize| !model.assembly.blocks[i].support;
    model
        .interfaces
        .list
        .iter()
        .any(|f| (f.a == support && free(f.b)) || (f.b == support && free(f.a)))
}

/// The supports that touch a free block; where none is named, the first of them is asked about.
pub fn bearing_supports(model: &Model) -> Vec<usize> {
    let blocks = &model.assembly.blocks;
    (0..blocks.len()).filter(|&s| blocks[s].support && touches(model, s)).collect()
}

/// The horizontal direction from the free blocks' centre of mass to where a support touches them:
/// outwards. `None` where it is straight below, or touches nothing.
pub fn outwards(model: &Model, support: usize) -> Option<Vector3<f64>> {
    let assembly = &model.assembly;
    let mass: f64 = assembly.free().map(|i| assembly.blocks[i].mass).sum();
    let middle = assembly
        .free()
        .map(|i| assembly.blocks[i].centroid * assembly.blocks[i].mass)
        .sum::<Vector3<f64>>()
        / mass;
    let touching: Vec<Vector3<f64>> = model
        .interfaces
        .list
        .iter()
        .filter(|f| f.a == support || f.b == support)
        .map(centroid)
        .collect();
    let contact = touching.iter().sum::<Vector3<f64>>() / touching.len().max(1) as f64;
    let size = touching.iter().map(|p| (p - middle).norm()).fold(0.0, f64::max);
    if touching.is_empty() {
        return None;
    }
    level(&assembly.gravity, contact - middle, size)
}

/// The part of a direction across gravity, as a unit vector; `None` where it is small beside
/// `size`. What is rounding becomes zero.
pub fn level(gravity: &Vector3<f64>, direction: Vector3<f64>, size: f64) -> Option<Vector3<f64>> {
    let down = gravity.normalize();
    let across = direction - down * down.dot(&direction);
    if across.norm().is_nan() || across.norm() <= tolerance::ACROSS * size {
        return None;
    }
    let unit = across.normalize();
    Some(unit.map(|c| if c.abs() < tolerance::ALONG { 0.0 } else { c }).normalize())
}

/// The least or greatest thrust of a scene that stands, summed over its parts, or the force in a
/// member; `standing` are forces that balance its loads.
pub fn thrust(
    model: &Model,
    at: impl Into<Sought>,
    extreme: Extreme,
    standing: &Forces,
    control: &Control,
) -> Proved<ThrustEnd> {
    Proved::new(model, parts::thrust::thrust(model, &at.into(), extreme, standing, control))
}

/// The same for one part.
pub(super) fn of_part(
    model: &Model,
    at: &Sought,
    extreme: Extreme,
    standing: &Forces,
    control: &Control,
) -> ThrustEnd {
    let ask =
        |model: &Model, standing: &Forces| with_normals(model, at, extreme, standing, control);
    let flat = ask(model, standing);
    let Some(wide) = model.every_way().filter(|_| !is_proved(model, &flat)) else { return flat };
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
    match is_proved(model, &both) {
        true => both,
        false => ThrustEnd { outcome: Outcome::Undecided, value: None, ..both },
    }
}

/// The same where every contact has one normal.
fn with_normals(
    model: &Model,
    at: &Sought,
    extreme: Extreme,
    standing: &Forces,
    control: &Control,
) -> ThrustEnd {
    let assembly = &model.assembly;
    let build = |keep_all: bool| {
        Statics::new(model, StaticsOptions { keep_all, ..StaticsOptions::default() })
    };
    let mut base = build(control.keep_all);
    // A plane scene knows no force out of its plane.
    let direction = match at {
        Sought::Thrust(at) => Some(at.direction),
        Sought::Member(at) => at.along,
    };
    if let (Some(plane), Some(direction)) = (base.plane, direction)
        && plane.axis.dot(&Vector3::from(direction)).abs() > tolerance::ALONG
    {
        base = build(true);
    }
    let mut answer = ThrustEnd {
        at: *at,
        extreme,
        outcome: Outcome::Undecided,
        value: None,
        bracket: Bracket::UNKNOWN,
        forces: standing.clone(),
        base: None,
        rates: vec![Rate::zero(); assembly.blocks.len()],
        attempts: Vec::new(),
        left_out: base.left_out.clone(),
    };
    let total: f64 = assembly.free().map(|i| certificate::load_scale(assembly, i)).sum();
    let problem = Problem { model, at, extreme, total };
    for (index, step) in LADDER.into_iter().enumerate() {
        if control.deadline.is_over() {
            break;
        }
        problem.climb(&mut base, step, control.deadline, &mut answer);
        if answer.value.is_some_and(|v| answer.bracket.width() <= width(assembly, v)) {
            answer.outcome = Outcome::Found;
            break;
        }
        if index == 0
            && problem.has_no_end(
                step,
                control.deadline,
                control.keep_all || base.plane.is_none(),
                &mut answer,
            )
        {
            answer.outcome = Outcome::Unbounded;
            answer.value = None;
            let end = -extreme.sigma() * f64::INFINITY;
            answer.bracket = Bracket { lower: end, upper: end };
            answer.base = Some(standing.clone());
            break;
        }
    }
    answer
}

struct Problem<'a> {
    model: &'a Model,
    at: &'a Sought,
    extreme: Extreme,
    /// Total load of the free blocks, N: the unit of the objective.
    total: f64,
}

impl Problem<'_> {
    fn objective(&self, statics: &Statics, interfaces: &Interfaces) -> Vec<f64> {
        let by = self.extreme.sigma() / self.total;
        let columns = match self.at {
            Sought::Thrust(at) => {
                program::thrust_columns(statics, interfaces, at.support, at.direction.into())
            }
            Sought::Member(at) => {
                let shares = at.shares(&interfaces.members[at.member]);
                program::member_columns(statics, at.member, &shares)
            }
        };
        columns.into_iter().map(|c| c * by).collect()
    }

    /// One attempt; tightens the bracket in `answer`. Bounds on crushing that it finds stay in
    /// `base`.
    fn climb(&self, base: &mut Statics, step: Rung, deadline: Deadline, answer: &mut ThrustEnd) {
        let model = self.model;
        let interfaces = &model.interfaces;
        let mut statics = base.clone();
        statics.rescale(step.unit, step.local);
        let settings = step.settings(deadline);
        let build =
            |statics: &Statics| program::thrust(statics, &self.objective(statics, interfaces));
        let mut done = run(model, &mut statics, build, &settings, None);
        let mut ends = [f64::NEG_INFINITY, f64::INFINITY];
        if let Some(Candidate { forces, rates, .. }) = done.candidate.take() {
            // Rates come per unit of the objective.
            let rates: Vec<Rate> = rates
                .into_iter()
                .map(|r| Rate { velocity: r.velocity * self.total, spin: r.spin * self.total })
                .collect();
            let p = self.at.bracket(model, self.extreme, &forces, &rates);
            let balanced = p.statics.equilibrium_error <= tolerance::LOOSE_BALANCE
                && p.statics.is_within_strength();
            let (bound, reached) = if self.extreme == Extreme::Least { (0, 1) } else { (1, 0) };
            if p.is_admissible(self.total) {
                ends[bound] = [p.lower, p.upper][bound];
            }
            if balanced {
                ends[reached] = [p.lower, p.upper][reached];
            }
            let b = &mut answer.bracket;
            let better = [ends[0] > b.lower, ends[1] < b.upper];
            if better[0] {
                b.lower = ends[0];
            }
            if better[1] {
                b.upper = ends[1];
            }
            if better[reached] {
                (answer.value, answer.forces) = (Some(p.value), forces);
            }
            if better[bound] {
                answer.rates = rates;
            }
        }
        let name = match (self.at, self.extreme) {
            (Sought::Thrust(_), Extreme::Least) => "least thrust in forces",
            (Sought::Thrust(_), Extreme::Greatest) => "greatest thrust in forces",
            (Sought::Member(_), Extreme::Least) => "least force in a member in forces",
            (Sought::Member(_), Extreme::Greatest) => "greatest force in a member in forces",
        };
        answer.attempts.push(done.attempt(
            name.into(),
            statics.unit / self.total,
            &step,
            None,
            ends,
        ));
        base.sections = statics.sections;
    }

    /// Whether forces that need no load push without end; then they are the forces of `answer`.
    fn has_no_end(
        &self,
        step: Rung,
        deadline: Deadline,
        keep_all: bool,
        answer: &mut ThrustEnd,
    ) -> bool {
        let joints = self.model.interfaces.list.len();
        let (unlimited, kept) = unlimited(&self.model.interfaces);
        let at = match *self.at {
            Sought::Thrust(at) => Sought::Thrust(at),
            // What yields has an end; the others have new places.
            Sought::Member(at) => match kept.iter().position(|&k| k == joints + at.member) {
                Some(place) => {
                    Sought::Member(MemberAt { member: place - unlimited.list.len(), ..at })
                }
                None => return false,
            },
        };
        let own = Problem { at: &at, ..*self };
        let unlimited = self.model.with_interfaces(unlimited);
        let mut statics =
            Statics::new(&unlimited, StaticsOptions { keep_all, ..StaticsOptions::default() });
        statics.rescale(step.unit, step.local);
        let settings = step.settings(deadline);
        let build = |statics: &Statics| {
            program::endless_thrust(statics, &own.objective(statics, &unlimited.interfaces))
        };
        let mut done = run(&unlimited, &mut statics, build, &settings, None);
        let mut ends = [f64::NEG_INFINITY, f64::INFINITY];
        let mut endless = false;
        if let Some(Candidate { forces, .. }) = done.candidate.take() {
            let bare = Model::new(
                check::verdict::thrust::unloaded(&self.model.assembly),
                unlimited.interfaces,
            );
            let s = certificate::statics(&bare, &forces, 0.0);
            endless = s.balanced
                && -self.extreme.sigma() * at.value(&bare.interfaces, &forces) >= 0.5 * self.total;
            if endless {
                ends = [-self.extreme.sigma() * f64::INFINITY; 2];
                answer.forces = no_forces(&self.model.interfaces);
                kept.into_iter().zip(forces).for_each(|(k, forces)| answer.forces[k] = forces);
            }
        }
        answer.attempts.push(done.attempt(
            "thrust without end".into(),
            statics.unit / self.total,
            &step,
            None,
            ends,
        ));
        endless
    }
}

/// Which ends of the range are asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// The least thrust alone.
    Least,
    /// The greatest alone.
    Greatest,
    /// Both, and the geometric safety factor.
    Both,
}

/// The answer about the thrust on a support.
#[derive(Clone, Debug)]
pub struct Thrust {
    /// The thrust on a support, or the force in a member.
    pub at: Sought,
    /// Whether it stands at all.
    pub standing: Proved<Assessment>,
    /// Least and greatest, as far as they were asked; none where no forces balance the loads, or
    /// that is undecided.
    pub ends: Vec<Proved<ThrustEnd>>,
    /// The geometric safety factor.
    pub factor: Option<Geometric<Proved<Assessment>>>,
}

/// Least and greatest thrust and the geometric safety factor.
pub fn answer(model: &Model, at: impl Into<Sought>, ends: Ends, control: &Control) -> Thrust {
    let at = at.into();
    // Each question may take as much of the time as those after it.
    let share = |of: f64| Control { deadline: control.deadline.share(1.0 / of), ..*control };
    // Where time is short both ends are worth more than whether the loads produce the forces.
    let statics_first = control.deadline.is_timed() && control.law == Law::Coulomb;
    let law = if statics_first { Law::Associative } else { control.law };
    let first = assess(model, &Control { law, ..*control });
    // Whether the loads produce them or not: there are forces.
    let balanced = certificate::statics(model, &first.forces, 0.0).balanced;
    let admissible = balanced && first.verdict != Verdict::Unstable;
    let end = |extreme, of| thrust(model, at, extreme, &first.forces, &share(of));
    let found = match ends {
        _ if !admissible => Vec::new(),
        Ends::Least => vec![end(Extreme::Least, 1.0)],
        Ends::Greatest => vec![end(Extreme::Greatest, 1.0)],
        Ends::Both => vec![end(Extreme::Least, 3.0), end(Extreme::Greatest, 2.0)],
    };
    let whole = ends == Ends::Both && matches!(at, Sought::Thrust(_));
    let factor = (admissible && whole).then(|| geometric_factor(model, &share(1.0)));
    let standing = if statics_first && admissible { assess(model, control) } else { first };
    Thrust { at, standing, ends: found, factor }
}
