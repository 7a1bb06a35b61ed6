//! Load factors: the bound, and the value with dry friction.

use super::{Derivation, deciding};
use crate::{
    proof::{
        answer::LoadFactorAnswer,
        certificate::{DryResult, Proven},
        evidence::{DryEvidence, FactorEvidence},
    },
    terms::{Bound, Deciding, Law, Outcome},
    verdict::{
        Verdict,
        claim::{self, Claim, Findings},
        exact::Grade,
    },
};
use base::error::InputError;
use model::interface::Model;

/// The model at a load factor or tilt, as joints with strengths are there.
pub(in crate::proof) type At<'a> = &'a dyn Fn(f64) -> Result<Model, InputError>;

/// A load factor.
pub(in crate::proof) struct Factor {
    /// The one to use, with the bound beside it.
    pub answer: LoadFactorAnswer,
    /// With dry friction.
    pub dry: Option<DryResult>,
    /// The part that decides the bound, where there are several.
    pub part: Option<Deciding>,
    /// How exactly the bound is proved.
    pub proof: Option<Grade>,
    /// What proves the bound.
    pub proven: Option<Proven>,
}

impl FactorEvidence {
    /// The value of the bound, as it is claimed.
    pub(in crate::proof) fn value(&self) -> Option<f64> {
        match self.bound.claim {
            Some(Claim::LoadFactor { value, .. }) => Some(value),
            _ => None,
        }
    }
}

impl Derivation<'_> {
    /// A load factor of a model, `at` other load factors where joints are others there; `dead` is
    /// the verdict without the load.
    pub(in crate::proof) fn factor(
        &mut self,
        title: &str,
        model: &Model,
        at: At,
        (e, law): (&FactorEvidence, Law),
        dead: Option<Verdict>,
    ) -> Factor {
        let mut f = Findings::default();
        let proven = e.bound.prove(&mut f, model, self.known());
        let claim = proven.as_ref().and_then(|p| p.claim);
        let none = |status| Bound { status, value: None, lower: None, upper: None };
        let bound = match claim {
            Some(Claim::LoadFactor { value, lower, upper }) => Bound {
                status: Outcome::Found,
                value: Some(value),
                lower: Some(lower),
                upper: Some(upper),
            },
            Some(Claim::Unbounded { .. }) => none(Outcome::Unbounded),
            Some(Claim::Impossible) => none(Outcome::Impossible),
            Some(_) => {
                f.fails.push("the proved claim is not a load factor".into());
                none(Outcome::Undecided)
            }
            None => {
                f.holds.push("undecided: nothing is claimed".into());
                let ends =
                    proven.as_ref().map(|p| claim::ends(model, &p.forces, &p.rates, e.between));
                let [lower, upper] = ends.unwrap_or_default();
                Bound { lower, upper, ..none(Outcome::Undecided) }
            }
        };
        let moves = proven.as_ref().filter(|p| !matches!(p.claim, Some(Claim::Unbounded { .. })));
        let part = moves.and_then(|p| deciding(model, &p.rates));
        self.part(title, f);
        // Asked, and nothing is known of it.
        let missing = DryEvidence::undecided();
        let leaves_something = matches!(bound.status, Outcome::Found | Outcome::Unbounded);
        let missing = Some(&missing).filter(|_| law == Law::Coulomb && leaves_something);
        let dry = e.dry.as_ref().or(missing).map(|dry| {
            let title = match title {
                "answer" => "dry friction".to_string(),
                title => format!("{title}, dry friction"),
            };
            self.dry_friction(&title, at, (bound, &e.bound), dry, dead)
        });
        if dry.is_some() && law == Law::Associative {
            self.part(title, super::failure("dry friction was not asked for"));
        }
        Factor {
            answer: LoadFactorAnswer::new(bound, dry.as_ref()),
            dry,
            part,
            proof: proven.as_ref().and_then(|p| p.grade),
            proven,
        }
    }
}
