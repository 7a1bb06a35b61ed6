//! The evidence for one answer as a file holds it: forces and rates by name.

use crate::{
    terms::{Deciding, Found, is_reached},
    verdict::{
        Forces,
        claim::Claim,
        evidence::{BlockRate, ContactForces, MemberForce, read_forces, read_members},
    },
};
use model::interface::Model;
use serde::{Deserialize, Serialize};

/// The evidence for an answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// What is claimed; absent where the question stayed undecided.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub claim: Option<Claim>,
    /// Static side: forces per contact.
    pub forces: Vec<ContactForces>,
    /// The same for members: ties, struts, soil, …
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub members: Vec<MemberForce>,
    /// Unbounded: forces at a load factor at which the scene stands. Conditional: the forces
    /// without the pre-stress.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub base: Option<Vec<ContactForces>>,
    /// The same for members.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub base_members: Vec<MemberForce>,
    /// Kinematic side: rates per moving block.
    pub rates: Vec<BlockRate>,
    /// What the verification found when the answer was given. Not saved, for nobody could tell
    /// whether it was edited: `check` finds it anew.
    #[serde(default, skip_serializing)]
    pub verified: Vec<String>,
}

impl Certificate {
    /// Nothing is claimed.
    pub fn none() -> Self {
        Self {
            claim: None,
            forces: Vec::new(),
            members: Vec::new(),
            base: None,
            base_members: Vec::new(),
            rates: Vec::new(),
            verified: Vec::new(),
        }
    }

    /// The forces that it holds, of contacts and members, and those without the pre-stress or at
    /// another load factor.
    ///
    /// # Errors
    /// As [`read_forces`] and [`read_members`].
    pub fn read(&self, model: &Model) -> Result<(Forces, Option<Forces>), String> {
        let read = |contacts: &[ContactForces], members: &[MemberForce]| {
            let mut forces = read_forces(model, contacts)?;
            read_members(model, members, &mut forces)?;
            Ok::<Forces, String>(forces)
        };
        let base = self.base.as_ref().map(|base| read(base, &self.base_members)).transpose()?;
        if base.is_none() && !self.base_members.is_empty() {
            return Err("forces of members stand without those of the contacts".into());
        }
        Ok((read(&self.forces, &self.members)?, base))
    }
}

/// A load factor with dry friction (program D).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DryResult {
    /// How it was found.
    pub found: Found,
    /// The part of the scene that decides, where it has several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub part: Option<Deciding>,
    /// The value, where found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// The greatest load factor at which the state under dry friction was seen at rest, having
    /// rested from the dead load on. Computed, not proved.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rests_at: Option<f64>,
    /// The least load factor at which it was seen to move.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub moves_at: Option<f64>,
    /// How far forces and mechanism are from Coulomb's law.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub natural_map: Option<f64>,
    /// Convex programs solved for it.
    pub solves: usize,
    /// The evidence.
    pub certificate: Certificate,
}

impl DryResult {
    /// Whether the state was seen at rest just below the value.
    pub fn is_reached(&self) -> bool {
        self.rests_at.zip(self.value).is_some_and(|(rests_at, value)| is_reached(rests_at, value))
    }
}
