//! How far the joints are used: where the resultant passes them, how much of their friction and of
//! their compressive strength it takes.
//!
//! With the resultant of a joint of normal force N, shear T, eccentricity e, area A: e / t with t
//! twice the way from the centroid to the edge that the resultant is off to (the thickness, where the
//! joint is a rectangle); friction T / (c A + μ N), N being what is left of it beside the water in the joint; compression the least stress under which
//! the normal forces fit, over the strength: the greater of N / A and N² / (2 W Σ d f) over the edges
//! ([`edge_bounds`]), which on a rectangle bent about one axis is N / (A (1 − 2 e / t)).

use super::{Part, Section, percent, quantity};
use crate::view::{JointView, Resultant, View, ViewPart, ViewState};
use base::number::point;
use model::{
    interface::{Interface, Model},
    strength::crushing::{crushes, edge_bounds},
};
use nalgebra::Vector3;

/// Joints that are listed.
const MOST: usize = 12;

/// What a joint uses.
struct Use<'a> {
    joint: usize,
    at: &'a Resultant,
    /// Of the way to the edge, of the friction, of the strength; not a number where there is none.
    shares: [f64; 3],
}

impl Use<'_> {
    fn greatest(&self) -> f64 {
        self.shares.iter().copied().filter(|s| !s.is_nan()).fold(0.0, f64::max)
    }
}

/// Joints that a line of text names.
const FEW: usize = 3;
/// A joint that uses less is not weak.
const WEAK: f64 = 0.5;

/// The joints that are used most, in words: where, e / t, friction, compression. None where no forces
/// balance, or nothing is near its limit.
pub fn weak(model: &Model, view: &View) -> Vec<String> {
    let state = |part: ViewPart| view.states.iter().find(|s| s.part == part && s.balances);
    let Some(state) = state(ViewPart::Dry).or(state(ViewPart::Answer)) else { return Vec::new() };
    let all = uses(model, view, state);
    let line = |u: &Use| {
        let joint = &view.joints[u.joint];
        let [a, b] = [joint.a, joint.b].map(|i| view.bodies[i].id.as_str());
        let edge = (joint.area > 0.0).then(|| format!("e/t {:.3}", 0.5 * u.at.used));
        let named = |name: &str, share: f64| {
            share.is_finite().then(|| format!("{name} {}", percent(share)))
        };
        let [friction, crushing] =
            [named("friction", u.shares[1]), named("compression", u.shares[2])];
        let words: Vec<String> = [edge, friction, crushing].into_iter().flatten().collect();
        format!("{a} | {b}  at {}: {}", point(u.at.at.into()), words.join(", "))
    };
    let near = |u: &&Use| u.greatest() >= WEAK;
    all.iter().take(FEW).filter(near).map(line).collect()
}

/// What the joints use, the most used first.
fn uses<'a>(model: &Model, view: &View, state: &'a ViewState) -> Vec<Use<'a>> {
    let mut uses: Vec<Use> = state
        .resultants
        .iter()
        .enumerate()
        .filter_map(|(joint, at)| {
            let at = at.as_ref()?;
            Some(Use { joint, at, shares: shares(model, view, state, joint, at) })
        })
        .collect();
    uses.sort_by(|a, b| b.greatest().total_cmp(&a.greatest()).then(a.joint.cmp(&b.joint)));
    uses
}

/// The systems of forces that are told.
pub(super) fn told(view: &View) -> Vec<&ViewState> {
    let state = |part: ViewPart| view.states.iter().find(|s| s.part == part && s.balances);
    let ends: Vec<&ViewState> =
        [ViewPart::Least, ViewPart::Greatest].into_iter().filter_map(state).collect();
    if ends.is_empty() {
        state(ViewPart::Dry).or(state(ViewPart::Answer)).into_iter().collect()
    } else {
        ends
    }
}

/// A table for each system of forces that is told.
pub(super) fn sections(model: &Model, view: &View) -> Vec<Section> {
    let states = told(view);
    if states.is_empty() {
        return Vec::new();
    }
    let parts = states.into_iter().map(|s| table(model, view, s));
    vec![Section::new("Joints of greatest utilisation", parts.collect())]
}

/// Shear below this share of the normal force is rounding. More: what is there is not shown. Less:
/// forces of nothing are.
pub(super) const ROUNDING: f64 = 1e-9;

fn table(model: &Model, view: &View, state: &ViewState) -> Part {
    let uses = uses(model, view, state);
    let row = |u: &Use| {
        let joint = &view.joints[u.joint];
        let name = |i: usize| view.bodies[i].id.as_str();
        let shear = if u.at.shear > ROUNDING * u.at.normal { u.at.shear } else { 0.0 };
        vec![
            format!("{} | {}", name(joint.a), name(joint.b)),
            quantity(u.at.normal, "N"),
            quantity(shear, "N"),
            if joint.area > 0.0 { format!("{:.3}", 0.5 * u.at.used) } else { "–".into() },
            percent(u.shares[0]),
            percent(u.shares[1]),
            percent(u.shares[2]),
        ]
    };
    let rest = match uses.get(MOST) {
        Some(next) => format!(
            " The other {} in compression use at most {}.",
            uses.len() - MOST,
            percent(next.greatest())
        ),
        None => String::new(),
    };
    let note = format!(
        "For {}. e / t: eccentricity of the resultant over the thickness in that direction; at \
         0.5, the edge, the joint hinges. Friction: shear over the resistance of friction and \
         cohesion. Compression: least stress that can carry the forces, over the strength. \
         “–”: no such limit.{rest} In a statically indeterminate structure these forces are one \
         of many systems in equilibrium.",
        state.name
    );
    let columns = [
        "joint",
        "#normal force",
        "#shear",
        "#e / t",
        "#e / edge distance",
        "#friction",
        "#compression",
    ];
    Part::table(&columns, uses.iter().take(MOST).map(row).collect(), &note)
}

fn shares(model: &Model, view: &View, state: &ViewState, k: usize, at: &Resultant) -> [f64; 3] {
    let joint = &view.joints[k];
    let way = if joint.area > 0.0 { at.used } else { f64::NAN };
    [way, friction(joint, at), compression(model, joint, &state.forces[k], k, at)]
}

fn friction(joint: &JointView, at: &Resultant) -> f64 {
    let (law, mu) = (&joint.law, joint.law.friction.mu());
    if mu.is_infinite() {
        return f64::NAN;
    }
    let bears = law.cohesion * joint.area + mu * at.normal;
    if bears > 0.0 {
        at.shear / bears
    } else if at.shear > 0.0 {
        f64::INFINITY
    } else {
        f64::NAN
    }
}

fn compression(
    model: &Model,
    joint: &JointView,
    forces: &[Vector3<f64>],
    k: usize,
    at: &Resultant,
) -> f64 {
    // What is seen may be the scene with another number in it: then its faces are not at hand.
    let same =
        |f: &&Interface| (f.a, f.b, f.area, f.law) == (joint.a, joint.b, joint.area, joint.law);
    let Some(face) = model.interfaces.list.get(k).filter(same).filter(|f| crushes(f)) else {
        return f64::NAN;
    };
    let normal: Vec<f64> = forces.iter().map(|f| face.frame.n.dot(f)).collect();
    let edges = edge_bounds(face);
    let stress = edges
        .iter()
        .map(|(width, distances)| {
            let moment: f64 = distances.iter().zip(&normal).map(|(d, f)| d * f.max(0.0)).sum();
            at.normal.powi(2) / (2.0 * width * moment)
        })
        .fold(at.normal / face.area, f64::max);
    stress / face.law.compression
}
