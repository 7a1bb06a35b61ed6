//! Verifying a claim from the scene, the forces and the rates: no program, no solver, no trust in
//! any saved number but the forces and the rates themselves.

mod balance;
mod load_factor;
mod motion;

pub use super::findings::Findings;
pub(super) use balance::balanced;
pub use balance::{cones, live_alone, natural_factor};
pub use load_factor::{dry_map, dry_width, ends, upper_bound, width};
pub use motion::moving;

use super::{
    Evidence, Verdict, certificate, in_every_way, thrust,
    thrust::{Extreme, MemberAt, Sought, ThrustAt},
};
use balance::live_alone_balances;
use load_factor::{dry, load_factor};
use model::interface::Model;
use motion::{falls, moves};
use serde::{Deserialize, Serialize};

/// What is claimed about a scene.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Claim {
    /// The forces balance the dead load inside the friction cones.
    Stable,
    /// The forces balance the dead load inside the friction cones, but the base forces, which need
    /// no self-stress, leave a motion that obeys Coulomb's law with them.
    Conditional,
    /// The mechanism gains power under the dead load: nothing balances it.
    Unstable,
    /// The forces balance the dead load and `lower` × the live load; the mechanism admits no more
    /// than `upper`.
    LoadFactor {
        /// Claimed load factor.
        value: f64,
        /// Claimed lower end.
        lower: f64,
        /// Claimed upper end.
        upper: f64,
    },
    /// The forces balance the dead load and `value` × the live load, and the mechanism, driven by
    /// the live load, obeys Coulomb's law with them: a load factor with dry friction (not the only
    /// one, perhaps).
    DryLoadFactor {
        /// Claimed load factor.
        value: f64,
    },
    /// The forces balance the live load alone (and other forces the scene at load factor
    /// `standing`).
    Unbounded {
        /// A load factor at which the scene stands.
        standing: f64,
    },
    /// The mechanism gains power under the dead load and none under the live load.
    Impossible,
    /// The forces balance the dead load and push a support with `value`; the mechanism that follows
    /// the support admits nothing beyond the bracket on the other side.
    Thrust {
        /// Where, and in which direction.
        at: ThrustAt,
        /// Least or greatest.
        extreme: Extreme,
        /// Claimed thrust, N.
        value: f64,
        /// Claimed lower end, N.
        lower: f64,
        /// Claimed upper end, N.
        upper: f64,
    },
    /// The forces balance the dead load with `value` in a member; the mechanism without the member
    /// admits nothing beyond the bracket on the other side.
    MemberForce {
        /// Index of the member.
        member: usize,
        /// Of a dowel: the direction of its shear.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        along: Option<[f64; 3]>,
        /// Least or greatest.
        extreme: Extreme,
        /// Claimed force, N.
        value: f64,
        /// Claimed lower end, N.
        lower: f64,
        /// Claimed upper end, N.
        upper: f64,
    },
    /// The forces balance without any load and stress a member (and other forces balance the dead
    /// load): its force has no end.
    EndlessMemberForce {
        /// Index of the member.
        member: usize,
        /// Of a dowel: the direction of its shear.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        along: Option<[f64; 3]>,
        /// Least or greatest.
        extreme: Extreme,
    },
    /// The forces balance without any load and push a support (and other forces balance the dead
    /// load): the thrust has no end.
    EndlessThrust {
        /// Where, and in which direction.
        at: ThrustAt,
        /// Least or greatest.
        extreme: Extreme,
    },
}

impl Claim {
    /// The verdict that it is; nothing where it is about a number.
    pub fn verdict(&self) -> Option<Verdict> {
        match self {
            Self::Stable => Some(Verdict::Stable),
            Self::Conditional => Some(Verdict::Conditional),
            Self::Unstable => Some(Verdict::Unstable),
            _ => None,
        }
    }
}

/// Verifies a claim. Forces count across flats; rates must close none of the ways in which a flat may
/// act.
pub fn verify(model: &Model, claim: &Claim, evidence: Evidence) -> Findings {
    let Some((wide, forces)) = in_every_way(model, evidence.forces) else {
        return of_normals(model, claim, evidence);
    };
    let base = evidence.base.and_then(|base| Some(in_every_way(model, base)?.1));
    of_normals(&wide, claim, Evidence { forces: &forces, base: base.as_ref(), ..evidence })
}

/// The same where every contact has one normal.
fn of_normals(model: &Model, claim: &Claim, evidence: Evidence) -> Findings {
    let Evidence { forces, base, rates } = evidence;
    let assembly = &model.assembly;
    let mut f = Findings::default();
    // How fast a mechanism moves says nothing, but for rates that belong to forces or to a support.
    let unit;
    let rates = match claim {
        Claim::Unstable | Claim::LoadFactor { .. } | Claim::Impossible => {
            unit = certificate::at_unit_speed(assembly, rates);
            &unit[..]
        }
        _ => rates,
    };
    match *claim {
        Claim::Stable => balanced(&mut f, "", model, forces, 0.0),
        Claim::Conditional => {
            balanced(&mut f, "", model, forces, 0.0);
            match base {
                Some(base) => moves(&mut f, model, base, rates),
                None => f.fails.push("the forces without the self-stress are missing".into()),
            }
        }
        Claim::Unstable => falls(&mut f, model, rates, false),
        Claim::LoadFactor { value, lower, upper } => {
            load_factor(&mut f, model, forces, rates, [value, lower, upper])
        }
        Claim::DryLoadFactor { value } => dry(&mut f, model, forces, rates, value),
        Claim::Unbounded { standing } => {
            match base {
                Some(base) => {
                    balanced(&mut f, "at a load factor at which it stands, ", model, base, standing)
                }
                None => f
                    .fails
                    .push("forces at a load factor at which the scene stands are missing".into()),
            }
            live_alone_balances(&mut f, model, forces);
        }
        Claim::Thrust { at, extreme, value, lower, upper } => {
            let at = Sought::Thrust(at);
            thrust::verify(&mut f, model, (forces, rates), (&at, extreme), [value, lower, upper]);
        }
        Claim::EndlessThrust { at, extreme } => {
            thrust::verify_endless(&mut f, model, forces, base, &at.into(), extreme)
        }
        Claim::MemberForce { member, along, extreme, value, lower, upper } => {
            let at = Sought::Member(MemberAt { member, along });
            thrust::verify(&mut f, model, (forces, rates), (&at, extreme), [value, lower, upper]);
        }
        Claim::EndlessMemberForce { member, along, extreme } => {
            let at = Sought::Member(MemberAt { member, along });
            thrust::verify_endless(&mut f, model, forces, base, &at, extreme)
        }
        Claim::Impossible => falls(&mut f, model, rates, true),
    }
    f
}
