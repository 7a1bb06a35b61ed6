//! Results of `combinations`: a question answered in every combination of actions, each from its own
//! scene; the worst governs.

use super::{
    answer::{Answer, Nested},
    derive::{Derivation, failure},
    evidence::NestedEvidence,
    told::Told,
};
use crate::{question::CombinationsOptions, verdict::exact::Grade};
use model::assembly::resolve_blocks;
use scene::{MaterialFactors, Scene};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use std::{collections::BTreeMap, sync::Arc};

/// Of `combinations`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CombinationsEvidence {
    /// One a combination, in the order of the scene.
    pub list: Vec<NestedEvidence>,
}

/// The answers in every combination.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct CombinationsAnswer {
    /// The name of the one that governs.
    pub governing: String,
    /// Each, in the order of the scene.
    pub list: Vec<InCombination>,
    /// How exactly they are proved, the weakest of all; absent where one is undecided.
    pub proof: Option<Grade>,
}

/// The answer in one combination.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct InCombination {
    /// Its name.
    pub name: String,
    /// Where its factors come from.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub source: String,
    /// Factors on loads, by action; 0 for one that does not act.
    pub factors: BTreeMap<String, f64>,
    /// What strengths are divided by.
    pub materials: MaterialFactors,
    /// Its answer.
    #[serde(flatten)]
    pub own: Nested,
}

impl CombinationsAnswer {
    /// The one that governs.
    pub fn worst(&self) -> Option<&InCombination> {
        self.list.iter().find(|c| c.name == self.governing)
    }

    /// The worst first.
    pub fn ordered(&self) -> Vec<&InCombination> {
        let mut list: Vec<&InCombination> = self.list.iter().collect();
        let by = |c: &InCombination| c.own.height();
        list.sort_by(|a, b| by(a).0.cmp(&by(b).0).then(by(a).1.total_cmp(&by(b).1)));
        list
    }

    /// Whether what is asked holds in all of them; `None` where that is open.
    pub fn holds(&self) -> Option<bool> {
        let all = || self.list.iter().map(|c| c.own.holds());
        match all().any(|h| h == Some(false)) {
            true => Some(false),
            false => all().all(|h| h == Some(true)).then_some(true),
        }
    }
}

/// The places of the combinations that are asked.
///
/// # Errors
/// The scene has none, or none of a name.
pub fn asked(
    o: &CombinationsOptions,
    scene: &Scene,
) -> Result<Vec<usize>, base::error::InputError> {
    if scene.combinations.is_empty() {
        let path = base::error::JsonPath::root().key("combinations");
        return Err(base::error::InputError::at(path, "the scene has no combinations").hint(
            "add \"combinations\": [ { \"name\": \"STR\", \"factors\": { \"dead\": 1.35, \"live\": 1.5 } } ], or a \"preset\" of `voussoir schema presets`",
        ));
    }
    for name in &o.only {
        scene.in_combination(name)?;
    }
    let wanted = |k: &usize| o.only.is_empty() || o.only.contains(&scene.combinations[*k].name);
    Ok((0..scene.combinations.len()).filter(wanted).collect())
}

/// Every combination is put into force anew, and its answer derived there.
pub(super) fn derive(
    d: &mut Derivation,
    o: &CombinationsOptions,
    e: &CombinationsEvidence,
) -> Result<Told, String> {
    let (scene, model) = (d.scene, d.model);
    let places = asked(o, scene).map_err(|e| e.to_string())?;
    if places.len() != e.list.len() {
        let text = format!(
            "{} combinations are asked, evidence is there for {}",
            places.len(),
            e.list.len()
        );
        d.part("combinations", failure(text));
    }
    let question = o.question(scene);
    let blocks = resolve_blocks(scene).map_err(|e| e.to_string())?;
    let mut list = Vec::new();
    for (&k, own) in places.iter().zip(&e.list) {
        let name = &scene.combinations[k].name;
        let make = || -> Result<_, base::error::InputError> {
            let there = scene.in_combination(name)?;
            let model = model.of_blocks(&there, blocks.clone())?;
            Ok((there.factors()?, there, model))
        };
        let (factors, there, model) = make().map_err(|e| format!("{name}: {e}"))?;
        let own = d.nested(name, &question, (&there, &model), own)?;
        let scene::Factors { actions, materials, source } = factors;
        list.push(InCombination { name: name.clone(), source, factors: actions, materials, own });
    }
    let grades = list.iter().map(|c| c.own.answer.proof());
    let proof = grades.reduce(|a, b| Some(a?.and(b?))).flatten();
    let mut answer = CombinationsAnswer { governing: String::new(), list, proof };
    answer.governing =
        answer.ordered().first().map(|c| c.name.clone()).ok_or("no combination is given")?;
    d.check.claimed = answer.list.iter().any(|c| c.own.answer.proof().is_some());
    Ok(Told::new(model, Answer::Combinations(Box::new(answer)), &Arc::default()))
}
