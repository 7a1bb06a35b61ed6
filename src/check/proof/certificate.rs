//! The evidence for one claim about one model as a file holds it: forces and rates by name.

use crate::{
    terms::{Deciding, Found, is_reached},
    verdict::{
        Evidence, Forces, Rate,
        claim::{self, Claim, Findings},
        evidence::{
            BlockRate, ContactForces, MemberForce, read_forces, read_members, read_rates,
            write_forces, write_members, write_rates,
        },
        exact::Grade,
    },
};
use model::interface::Model;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use std::sync::{Arc, PoisonError, RwLock};

/// The evidence for a claim.
#[skip_serializing_none]
#[derive(Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// What it proves; absent where it proves nothing.
    pub claim: Option<Claim>,
    /// Static side: forces per contact.
    pub forces: Vec<ContactForces>,
    /// The same for members: ties, struts, soil, …
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub members: Vec<MemberForce>,
    /// Unbounded: forces at a load factor at which the scene stands. Conditional: the forces
    /// without the self-stress.
    pub base: Option<Vec<ContactForces>>,
    /// The same for members.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub base_members: Vec<MemberForce>,
    /// Kinematic side: rates per moving block.
    pub rates: Vec<BlockRate>,
    /// What its last check on a scene found. Never read from a file, and taken for true by nobody but
    /// who made it this moment.
    #[serde(skip)]
    checked: RwLock<Option<Findings>>,
}

impl PartialEq for Certificate {
    /// Whether the evidence is the same, whatever was found of it.
    fn eq(&self, other: &Self) -> bool {
        (&self.claim, &self.forces, &self.members, &self.base, &self.base_members, &self.rates)
            == (
                &other.claim,
                &other.forces,
                &other.members,
                &other.base,
                &other.base_members,
                &other.rates,
            )
    }
}

/// Evidence read on the model that it is about, with what it proves there.
#[derive(Clone, Debug)]
pub struct Proven {
    /// What is proved; nothing where nothing is claimed, or the check refuses it.
    pub claim: Option<Claim>,
    /// The forces.
    pub forces: Forces,
    /// Those without the self-stress, or at another load factor.
    pub base: Option<Forces>,
    /// The rates of all blocks.
    pub rates: Vec<Rate>,
    /// How exactly the claim is proved.
    pub grade: Option<Grade>,
}

impl Certificate {
    /// Evidence with the check that was made of its claim on its own model.
    pub fn new(
        model: &Model,
        claim: Option<Claim>,
        evidence: Evidence<'_>,
        findings: &Findings,
    ) -> Arc<Self> {
        let Evidence { forces, base, rates } = evidence;
        Arc::new(Self {
            claim,
            forces: write_forces(model, forces),
            members: write_members(model, forces),
            base: base.map(|f| write_forces(model, f)),
            base_members: base.map_or_else(Vec::new, |f| write_members(model, f)),
            rates: write_rates(&model.assembly, rates),
            checked: RwLock::new(claim.map(|_| findings.clone())),
        })
    }

    /// Whether nothing is in it.
    pub fn is_empty(&self) -> bool {
        self.claim.is_none()
            && self.forces.is_empty()
            && self.members.is_empty()
            && self.base.is_none()
            && self.base_members.is_empty()
            && self.rates.is_empty()
    }

    /// What the last check of its claim found, a line each; nothing before one was made.
    pub fn verified(&self) -> Vec<String> {
        let checked = self.checked.read().unwrap_or_else(PoisonError::into_inner);
        checked.as_ref().map(|f| f.holds.clone()).unwrap_or_default()
    }

    /// The forces that it holds, of contacts and members, and those without the self-stress or at
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
            return Err("member forces are given without contact forces".into());
        }
        Ok((read(&self.forces, &self.members)?, base))
    }

    /// Reads it on its model and proves its claim there, adding what holds and what fails to `f`.
    /// Evidence that does not fit the model is nothing. `known`: its claim was checked on this model
    /// this moment, by who made it.
    pub fn prove(&self, f: &mut Findings, model: &Model, known: bool) -> Option<Proven> {
        let read = || -> Result<_, String> {
            let (forces, base) = self.read(model)?;
            Ok((forces, base, read_rates(&model.assembly, &self.rates)?))
        };
        let (forces, base, rates) = match read() {
            Ok(read) => read,
            Err(e) => {
                f.fails.push(e);
                return None;
            }
        };
        let mut proven = Proven { claim: None, forces, base, rates, grade: None };
        if let Some(own) = &self.claim {
            let kept = || self.checked.read().unwrap_or_else(PoisonError::into_inner).clone();
            let found = match known.then(kept).flatten() {
                Some(found) => found,
                None => {
                    let Proven { forces, base, rates, .. } = &proven;
                    let evidence = Evidence { forces, base: base.as_ref(), rates };
                    let found = claim::verify(model, own, evidence);
                    let mut checked = self.checked.write().unwrap_or_else(PoisonError::into_inner);
                    *checked = Some(found.clone());
                    found
                }
            };
            proven.claim = self.claim.filter(|_| found.proved());
            proven.grade = proven.claim.map(|_| found.grade);
            f.and(&found);
        }
        Some(proven)
    }
}

/// A load factor with dry friction (program D).
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct DryResult {
    /// How it was found.
    pub found: Found,
    /// The part of the scene that moves, where it has several.
    pub part: Option<Deciding>,
    /// The value, where found.
    pub value: Option<f64>,
    /// The greatest load factor at which the state under dry friction was seen at rest, having
    /// rested from the dead load on. Computed, not proved.
    pub rests_at: Option<f64>,
    /// The least load factor at which it was seen to move.
    pub moves_at: Option<f64>,
    /// How far forces and mechanism are from Coulomb's law.
    pub natural_map: Option<f64>,
    /// The evidence.
    #[serde(skip)]
    pub certificate: Arc<Certificate>,
}

impl DryResult {
    /// Whether the state was seen at rest just below the value.
    pub fn is_reached(&self) -> bool {
        self.rests_at.zip(self.value).is_some_and(|(rests_at, value)| is_reached(rests_at, value))
    }
}
