//! Lines of known stiffness: ties, struts, bars and tendons.
//!
//! *Law.* The tension is `T = T₀ + k (δ − δ₀)` with the prestress `T₀` and the lengthening `δ` of the
//! whole line, cut at its bounds. At a strength it yields: it stays longer, or shorter, by `δ₀`. What
//! only pulls goes slack at zero and forgets nothing; likewise what only pushes.
//!
//! A line acts on each free block by the wrench of a unit tension about its centre of mass; the
//! lengthening is the power of these wrenches, with the other sign.

use super::law::AT_LIMIT;
use crate::verdict::{Rate, member::legs};
use base::error::InputError;
use model::assembly::{Action, Assembly, Member, Wrench};
use nalgebra::{Vector3, Vector6};
use std::collections::BTreeMap;

/// A line that yields.
#[derive(Clone, Debug)]
pub struct Line {
    /// The free blocks that it acts on, each with the wrench of a unit tension.
    pub on: Vec<(usize, Vector6<f64>)>,
    /// N/m.
    pub stiffness: f64,
    /// Least and greatest tension, N; may be infinite.
    pub bounds: [f64; 2],
    /// Tension before anything moves, N.
    pub prestress: f64,
}

/// How a line carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carries {
    /// Nothing.
    Slack,
    /// Less than its strength.
    Holds,
    /// As much as it can.
    Yields,
}

/// What a line does at given displacements.
#[derive(Clone, Copy, Debug)]
pub struct Pull {
    /// N; pressure below zero.
    pub tension: f64,
    /// N/m: nothing where it is slack or yields.
    pub slope: f64,
    /// How much longer it is for good, m.
    pub ease: f64,
    /// How it carries.
    pub carries: Carries,
}

/// Tensions below this share of what the ways of its ends make, each by itself, are rounding. More:
/// what carries little is slack. Less: rounding tightens what is slack.
const ROUNDING: f64 = 1e-12;

impl Line {
    /// That of a member.
    ///
    /// # Errors
    /// It is none, or its stiffness is not known.
    pub fn new(assembly: &Assembly, member: &Member) -> Result<Self, InputError> {
        let (id, kind) = (&member.id, member.kind.word());
        if !matches!(member.action, Action::Line(_)) {
            let text = format!(
                "member {id:?} is a {kind}: the state with elastic joints handles ties, struts, bars and tendons only"
            );
            return Err(InputError::at(member.path.clone(), text)
                .hint("leave it out, replace it by a strut, or ask `assess`"));
        }
        let Some(stiffness) = member.stiffness else {
            let text = format!("{kind} {id:?} has no stiffness");
            return Err(InputError::at(member.path.key("stiffness"), text).hint(
                "add \"stiffness\": EA / l in N/m (a rod of 1 cm² of steel, 5 m long: 4.2e6)",
            ));
        };
        let mut on: BTreeMap<usize, Vector6<f64>> = BTreeMap::new();
        for leg in legs(member) {
            for (block, sign) in [(leg.a, -1.0), (leg.b, 1.0)] {
                let Some(i) = block.filter(|&i| !assembly.blocks[i].support) else { continue };
                let force = leg.direction * sign;
                let moment = (leg.at - assembly.blocks[i].centroid).cross(&force);
                let all = on.entry(i).or_insert_with(Vector6::zeros);
                *all += Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
            }
        }
        Ok(Self {
            on: on.into_iter().collect(),
            stiffness,
            bounds: [member.least, member.greatest],
            prestress: member.prestress,
        })
    }

    /// How much longer it is, m, and the sum of what the ways of its blocks make of it.
    fn longer(&self, displaced: &[Rate]) -> [f64; 2] {
        let ways = self.on.iter().map(|(i, wrench)| wrench.dot(&six(&displaced[*i])));
        ways.fold([0.0; 2], |[longer, all], way| [longer - way, all + way.abs()])
    }

    /// Its tension if it had no bounds, N.
    pub fn held(&self, displaced: &[Rate]) -> f64 {
        self.prestress + self.stiffness * self.longer(displaced)[0]
    }

    /// What it does at these displacements, after it yielded by `ease`.
    pub fn pull(&self, ease: f64, displaced: &[Rate]) -> Pull {
        let [longer, ways] = self.longer(displaced);
        let tried = self.prestress + self.stiffness * (longer - ease);
        let tension = tried.clamp(self.bounds[0], self.bounds[1]);
        let free = tension == tried;
        let slack = ROUNDING * (self.prestress.abs() + self.stiffness * ways);
        let most = if tension < 0.0 { -self.bounds[0] } else { self.bounds[1] };
        let carries = if tension.abs() <= slack {
            Carries::Slack
        } else if tension.abs() >= AT_LIMIT * most {
            Carries::Yields
        } else {
            Carries::Holds
        };
        Pull {
            tension,
            slope: if free { self.stiffness } else { 0.0 },
            ease: match free || tension == 0.0 {
                true => ease,
                false => longer - (tension - self.prestress) / self.stiffness,
            },
            carries,
        }
    }
}

/// A displacement as six numbers, conjugate to a wrench.
fn six(q: &Rate) -> Vector6<f64> {
    let (v, w): (Vector3<f64>, Vector3<f64>) = (q.velocity, q.spin);
    Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z)
}

/// The force of a line among forces: its one amount.
pub fn amount(tension: f64) -> Vec<Wrench> {
    vec![Wrench { force: Vector3::new(tension, 0.0, 0.0), moment: Vector3::zeros() }]
}
