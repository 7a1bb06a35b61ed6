//! Actions and their combinations, with partial factors on loads and on what resists.
//!
//! Every load belongs to an *action*: the one that it names, or else [`DEAD`] (weights, dead loads, fill)
//! or [`LIVE`] (live loads, the train). A combination multiplies each action by a factor and divides
//! strengths by others. The scene names the combination that is in force; with none, all values are
//! characteristic ones. Factors come with the combination, or from a preset that names its clause
//! ([`preset`](super::preset)); nothing else in the mechanics knows of codes.

use super::{Load, Scene, joint, preset, suggest};
use base::{
    error::{InputError, JsonPath},
    number::short,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use std::collections::{BTreeMap, BTreeSet};

/// The action of weights, fill and dead loads that name none.
pub const DEAD: &str = "dead";
/// The action of live loads and trains that name none.
pub const LIVE: &str = "live";

/// A combination of actions. Every action of the scene has a factor in it, by `factors` or by the preset,
/// or stands in `without`.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Combination {
    /// Its name.
    pub name: String,
    /// Where its factors come from; that of the preset where nothing is said.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub source: String,
    /// Factors of a code: a word of `voussoir schema presets`. Actions of weights, dead loads and fill
    /// are permanent, all others variable.
    pub preset: Option<String>,
    /// With a preset: permanent actions that are superimposed, where the code tells them from others.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub superimposed: Vec<String>,
    /// With a preset: permanent actions that act favourably.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub favourable: Vec<String>,
    /// With a preset: ψ by which accompanying variable actions are multiplied beside their factor, by
    /// action; an action named here is variable. Variable actions without a ψ lead.
    #[serde(
        default,
        deserialize_with = "joint::distinct_names",
        skip_serializing_if = "BTreeMap::is_empty"
    )]
    pub psi: BTreeMap<String, f64>,
    /// Partial factors on loads, by action.
    #[serde(
        default,
        deserialize_with = "joint::distinct_names",
        skip_serializing_if = "BTreeMap::is_empty"
    )]
    pub factors: BTreeMap<String, f64>,
    /// Actions that do not act.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub without: Vec<String>,
    /// Partial factors that strengths are divided by.
    #[serde(default, skip_serializing_if = "MaterialFactors::is_empty")]
    pub materials: MaterialFactors,
}

/// Partial factors that strengths are divided by; 1 where nothing is said.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MaterialFactors {
    /// On the coefficient of friction (tan φ).
    pub friction: Option<f64>,
    /// On the cohesion.
    pub cohesion: Option<f64>,
    /// On the tensile strength.
    pub tension: Option<f64>,
    /// On the compressive strength.
    pub compression: Option<f64>,
    /// On the strengths of members: ties, struts, strips, soil, …
    pub members: Option<f64>,
}

impl MaterialFactors {
    fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Its factors by key.
    pub fn list(&self) -> [(&'static str, Option<f64>); 5] {
        [
            ("friction", self.friction),
            ("cohesion", self.cohesion),
            ("tension", self.tension),
            ("compression", self.compression),
            ("members", self.members),
        ]
    }
}

/// The factors of a combination on a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Factors {
    /// On loads, by action; 0 for one that does not act.
    pub actions: BTreeMap<String, f64>,
    /// Divisors of strengths.
    pub materials: MaterialFactors,
    /// The clause, or where else they come from.
    pub source: String,
}

impl Factors {
    /// The factor of an action, `usual` where none is named.
    pub fn of(&self, action: Option<&str>, usual: &str) -> f64 {
        self.actions.get(action.unwrap_or(usual)).copied().unwrap_or(1.0)
    }

    /// The factor of the weight of blocks of a material.
    pub fn weight(&self, scene: &Scene, material: Option<&str>) -> f64 {
        let action = material.and_then(|m| scene.materials.get(m)?.action.as_deref());
        self.of(action, DEAD)
    }

    /// A load as it acts; nothing where it does not.
    pub fn load(&self, load: &Load, usual: &str) -> Option<Load> {
        let factor = self.of(load.action.as_deref(), usual);
        (factor != 0.0).then(|| load.times(factor))
    }

    /// In a line: actions with their factors, then divisors.
    pub fn words(&self) -> String {
        let acts = self.actions.iter().filter(|(_, f)| **f != 0.0);
        let loads = acts.map(|(action, f)| format!("{action} × {}", short(*f)));
        let absent = self.actions.iter().filter(|(_, f)| **f == 0.0);
        let absent = absent.map(|(action, _)| format!("without {action}"));
        let divided = self.materials.list().into_iter();
        let divided = divided.filter_map(|(key, f)| Some(format!("{key} / {}", short(f?))));
        loads.chain(absent).chain(divided).collect::<Vec<_>>().join(", ")
    }
}

impl Scene {
    /// The names of its actions: of weights, loads, fill and train.
    pub fn actions(&self) -> BTreeSet<&str> {
        let (permanent, variable) = self.actions_by_kind();
        permanent.into_iter().chain(variable).collect()
    }

    /// The actions of weights, dead loads and fill, and all others.
    fn actions_by_kind(&self) -> (BTreeSet<&str>, BTreeSet<&str>) {
        let materials = self.materials.values().filter_map(|m| m.action.as_deref());
        let dead = self.loads.dead.iter().map(|l| l.action.as_deref().unwrap_or(DEAD));
        let fill = self.templates.iter().filter_map(super::Template::fill_action);
        let permanent: BTreeSet<&str> =
            [DEAD].into_iter().chain(materials).chain(dead).chain(fill).collect();
        let live = self.loads.live.iter().map(|l| l.action.as_deref().unwrap_or(LIVE));
        let train = self.train.iter().map(|t| t.action.as_deref().unwrap_or(LIVE));
        let variable = live.chain(train).filter(|a| !permanent.contains(a)).collect();
        (permanent, variable)
    }

    /// The same scene in one of its combinations.
    ///
    /// # Errors
    /// It has none of this name.
    pub fn in_combination(&self, name: &str) -> Result<Self, InputError> {
        self.combination_called(name, &JsonPath::root().key("combination"))?;
        Ok(Self { combination: Some(name.to_string()), ..self.clone() })
    }

    fn combination_called(&self, name: &str, path: &JsonPath) -> Result<usize, InputError> {
        self.combinations.iter().position(|c| c.name == name).ok_or_else(|| {
            let error = InputError::at(path.clone(), format!("no combination is called {name:?}"));
            let names = self.combinations.iter().map(|c| c.name.as_str());
            InputError { hint: suggest(name, names), ..error }
        })
    }

    /// The factors of the combination that is in force; none at all where there is none.
    ///
    /// # Errors
    /// As [`Self::factors_in`], or there is no such combination.
    pub fn factors(&self) -> Result<Factors, InputError> {
        let Some(name) = &self.combination else { return Ok(Factors::default()) };
        self.factors_in(self.combination_called(name, &JsonPath::root().key("combination"))?)
    }

    /// The factors of one of its combinations, by its place in the list.
    ///
    /// # Errors
    /// It names no action of the scene, leaves one out, or has a factor that is not above zero.
    pub fn factors_in(&self, k: usize) -> Result<Factors, InputError> {
        let path = JsonPath::root().key("combinations").index(k);
        let Some(c) = self.combinations.get(k) else {
            return Err(InputError::at(path, "there is no such combination"));
        };
        let (permanent, variable) = self.actions_by_kind();
        let all: BTreeSet<&str> = permanent.union(&variable).copied().collect();
        let known = |action: &str, path: JsonPath| match all.contains(action) {
            true => Ok(()),
            false => {
                let list: Vec<&str> = all.iter().copied().collect();
                let hint = suggest(action, list.iter().copied())
                    .unwrap_or_else(|| format!("its actions are {}", list.join(", ")));
                let text = format!("the scene has no action {action:?}");
                Err(InputError::at(path, text).hint(hint))
            }
        };
        let above_zero = |value: f64, path: JsonPath, hint: &str| match value > 0.0
            && value.is_finite()
        {
            true => Ok(()),
            false => Err(InputError::at(path, format!("must be a finite number > 0, got {value}"))
                .hint(hint)),
        };
        let leave_out = "list an action that does not act under \"without\"";
        for (key, map) in [("factors", &c.factors), ("psi", &c.psi)] {
            for (action, value) in map {
                let here = path.key(key).key(action);
                known(action, here.clone())?;
                above_zero(*value, here, leave_out)?;
            }
        }
        for (key, value) in c.materials.list() {
            let here = path.key("materials").key(key);
            value.map_or(Ok(()), |v| above_zero(v, here, "strengths are divided by it"))?;
        }
        let lists = [
            ("without", &c.without),
            ("superimposed", &c.superimposed),
            ("favourable", &c.favourable),
        ];
        for (key, list) in lists {
            for (i, action) in list.iter().enumerate() {
                known(action, path.key(key).index(i))?;
            }
        }
        if let Some(i) = c.without.iter().position(|a| a == DEAD || c.factors.contains_key(a)) {
            let why = match c.without[i] == DEAD {
                true => "weights always act",
                false => "the action has a factor as well",
            };
            return Err(
                InputError::at(path.key("without").index(i), why).hint("remove one of them")
            );
        }
        let preset = match &c.preset {
            Some(word) => Some(preset::find(word, &path.key("preset"))?),
            None => {
                let idle = [
                    ("superimposed", c.superimposed.is_empty()),
                    ("favourable", c.favourable.is_empty()),
                    ("psi", c.psi.is_empty()),
                ];
                if let Some((key, _)) = idle.iter().find(|(_, empty)| !empty) {
                    let text = "has no effect without a preset";
                    return Err(InputError::at(path.key(*key), text)
                        .hint("give \"preset\", or write the factors out"));
                }
                None
            }
        };
        if let Some(i) = c.favourable.iter().position(|a| !permanent.contains(a.as_str())) {
            let text = "only permanent actions have a favourable factor";
            let path = path.key("favourable").index(i);
            return Err(InputError::at(path, text)
                .hint("list a variable action that acts favourably under \"without\""));
        }
        let mut actions = BTreeMap::new();
        for action in all {
            let is_in = |list: &[String]| list.iter().any(|a| a == action);
            let by_preset = preset.map(|p| match c.psi.get(action) {
                Some(psi) => p.variable[1] * psi,
                None if !permanent.contains(action) => p.variable[0],
                None => {
                    let pair = if is_in(&c.superimposed) { p.superimposed } else { p.permanent };
                    pair[usize::from(is_in(&c.favourable))]
                }
            });
            let absent = is_in(&c.without).then_some(0.0);
            let Some(factor) = absent.or(c.factors.get(action).copied()).or(by_preset) else {
                let text = format!("says nothing of the action {action:?}");
                return Err(InputError::at(path, text)
                    .hint(format!("give it a factor, \"factors\": {{ {action:?}: 1 }}, or list it under \"without\"")));
            };
            actions.insert(action.to_string(), factor);
        }
        let source = match preset {
            Some(p) if c.source.is_empty() => p.source.to_string(),
            _ => c.source.clone(),
        };
        Ok(Factors { actions, materials: c.materials.clone(), source })
    }
}
