//! Verifying results of `kinematic`: α0 as a load factor, the points of the curve as scenes of
//! their own, and every other number by doing the arithmetic again.

use super::{Given, KinematicAnswer, Numbers};
use crate::{
    kinematic::{Quake, quake, without_members},
    proof::{
        answer::Answer,
        path::{self, DrivenBy, PathResult},
        recompute::Recompute,
        result::{Direction, QuestionKind, ResultFile},
        verify::{
            Verification, again, answer, failure, follows, mechanism_words, members, require,
        },
    },
    terms::{Found, Outcome},
    verdict::{Rate, claim::Findings, evidence::read_rates},
};
use base::tolerance;
use model::interface::Model;
use nalgebra::Vector3;
use scene::Scene;
use serde_json::Value;

/// Adds the parts of a result of `kinematic`.
pub(in crate::proof) fn verify(
    all: &mut Verification,
    file: &ResultFile,
    scene: &Scene,
    model: &Model,
    again: &dyn Recompute,
) {
    let main = Direction {
        answer: file.answer.clone(),
        certificate: file.certificate.clone(),
        dry: file.dry.clone(),
    };
    let list =
        if file.directions.is_empty() { std::slice::from_ref(&main) } else { &file.directions };
    if !file.directions.is_empty() {
        let mut f = Findings::default();
        let order: Vec<f64> = list.iter().map(governing).collect();
        require(
            &mut f,
            main == list[0] && order.windows(2).all(|w| w[0] <= w[1]),
            format!("the answer is the worst of {} directions, which are in order", list.len()),
        );
        all.part("answer", f);
    }
    for (index, direction) in list.iter().enumerate() {
        let Some(said) = direction.answer.kinematic() else {
            return all.part("answer", failure("the answer is not one to its question"));
        };
        let title = format!("earthquake towards {}", base::number::point(said.toward));
        let quake = match quake(scene, model, Vector3::from(said.toward)) {
            Ok(quake) => quake,
            Err(e) => return all.part(title, failure(e.to_string())),
        };
        let (mut f, rates) = answer(
            again,
            &quake.model,
            QuestionKind::Kinematic,
            &direction.answer,
            &direction.certificate,
            all.refuted(),
        );
        let along = (quake.toward - Vector3::from(said.toward)).norm() <= tolerance::ALONG;
        require(&mut f, along, "its direction is a unit one across gravity");
        follows(&mut f, &direction.answer, direction.dry.as_ref());
        if index == 0 {
            mechanism_words(&mut f, file, &quake.model, rates.as_deref());
            members(&mut f, file, &quake.model);
        }
        all.part(title.clone(), f);
        if let Some(dry) = &direction.dry {
            let findings = again::dry_friction(
                again,
                &|_| Ok(quake.model.clone()),
                (&direction.answer, &direction.certificate),
                dry,
                all.refuted(),
            );
            all.part(format!("{title}, dry friction"), findings);
        }
        let curve = (index == 0).then_some(file).and_then(|f| f.path.as_ref());
        let mut f = Findings::default();
        require(
            &mut f,
            curve.is_some() == said.curve.is_some() && (curve.is_none() || said.no_curve.is_none()),
            "a curve is spoken of where there is one",
        );
        require(&mut f, said.fc >= 1.0, "the factor of confidence is at least 1");
        let curve = said.curve.as_ref().zip(curve);
        let rates = mechanism(&quake, direction);
        let given = Given {
            scene,
            quake: &quake,
            rates: rates.as_deref(),
            alpha0: said.alpha0.value,
            fc: said.fc,
            control: said.control.as_ref(),
            curve,
        };
        arithmetic(&mut f, &said.numbers, &given.numbers());
        all.part(format!("{title}, numbers"), f);
        let driven = |path: &PathResult| {
            matches!((&path.driven_by, &said.control),
                (DrivenBy::Control { block, point, toward }, Some(c))
                    if *block == c.block && *point == c.point && *toward == said.toward)
        };
        if let Some((answer, path)) = curve {
            let mut f = Findings::default();
            require(
                &mut f,
                driven(path),
                "the curve is that of the control point and the direction",
            );
            let bare = without_members(&quake.model);
            let has = bare.interfaces.members.len() < quake.model.interfaces.members.len();
            require(
                &mut f,
                has == said.without_members,
                "whether it is without members is that of the scene",
            );
            all.part("curve", f);
            path::curve(all, answer, path, &bare, QuestionKind::Kinematic);
        }
        let tied = (index == 0).then_some(file).and_then(|f| f.path_with_members.as_ref());
        if tied.is_some() || said.curve_with_members.is_some() {
            let mut f = Findings::default();
            let both = tied.zip(said.curve_with_members.as_ref());
            let there = both.is_some_and(|(path, _)| driven(path))
                && !quake.model.interfaces.members.is_empty();
            require(&mut f, there, "the curve with members is that of the control point");
            all.part("curve with members", f);
            if let Some((path, answer)) = both {
                path::curve(all, answer, path, &quake.model, QuestionKind::Kinematic);
            }
        }
    }
    all.claimed = file.certificate.claim.is_some();
}

/// What orders directions: a0, and before all what has none.
fn governing(direction: &Direction) -> f64 {
    let a0 = direction.answer.kinematic().and_then(|k| k.numbers.a0);
    let free = direction.dry.is_none()
        && direction.answer.bound().is_some_and(|b| b.status == Outcome::Unbounded);
    a0.unwrap_or(if free { f64::INFINITY } else { f64::NEG_INFINITY })
}

/// The rates of the mechanism that goes with the load factor to use.
fn mechanism(quake: &Quake, direction: &Direction) -> Option<Vec<Rate>> {
    let bound = direction.answer.bound()?;
    let dry = direction.dry.as_ref().filter(|d| d.found == Found::FixedPoint && d.is_reached());
    let rates = dry.map_or(&direction.certificate.rates, |d| &d.certificate.rates);
    (bound.status == Outcome::Found)
        .then(|| read_rates(&quake.model.assembly, rates).ok())
        .flatten()
}

/// Every number is the one recomputed.
fn arithmetic(f: &mut Findings, said: &Numbers, here: &Numbers) {
    let json = |n: &Numbers| serde_json::to_value(n).unwrap_or_default();
    let off = differs(&json(said), &json(here), String::new());
    let text = match (&here.participation, here.a0) {
        (Some(p), Some(a0)) => format!(
            "recomputed from the mechanism: e* = {:.9}, M* = {:.6e} kg, a0 = {a0:.9} m/s²",
            p.e_star, p.mass
        ),
        _ => "recomputed: there is no mechanism to count masses of".into(),
    };
    match off {
        None => f.holds.push(text),
        Some(place) => f.fails.push(format!("{text}; the answer says otherwise at {place}")),
    }
    if let Some(c) = &here.capacity {
        f.holds.push(format!("recomputed from the curve: d0 = {:.9} m", c.d0));
    }
    if let Some(d) = &here.demand {
        f.holds.push(format!("recomputed from the site: {:.6} of what it demands", d.ratio));
    }
}

/// Where two values differ by more than what is saved of numbers.
pub(in crate::proof) fn differs(a: &Value, b: &Value, at: String) -> Option<String> {
    /// Beside numbers of the size of one, such as δ, smaller ones are rounding.
    const FLOOR: f64 = 1e-6;
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => {
            let (x, y) = (a.as_f64().unwrap_or(f64::NAN), b.as_f64().unwrap_or(f64::NAN));
            let near = (x - y).abs() <= tolerance::SAVED * x.abs().max(y.abs()).max(FLOOR);
            (!near).then_some(at)
        }
        (Value::Array(a), Value::Array(b)) if a.len() == b.len() => {
            a.iter().zip(b).enumerate().find_map(|(k, (a, b))| differs(a, b, format!("{at}/{k}")))
        }
        (Value::Object(a), Value::Object(b)) if a.len() == b.len() => {
            a.iter().find_map(|(k, a)| match b.get(k) {
                Some(b) => differs(a, b, format!("{at}/{k}")),
                None => Some(format!("{at}/{k}")),
            })
        }
        (a, b) => (a != b).then_some(at),
    }
}

impl Answer {
    /// What it says of an earthquake.
    pub fn kinematic(&self) -> Option<&KinematicAnswer> {
        match self {
            Self::Kinematic(a) => Some(a),
            _ => None,
        }
    }
}
