//! What the layers of a drawing stand for.

use base::error::{InputError, JsonPath};
use serde::{Deserialize, Deserializer};
use serde_json::{Map, Value};
use std::str::FromStr;

/// What a layer stands for. As text: `ROLE[,KEY=VALUE]…`, like `block,density=2400`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LayerRule {
    /// What is drawn on it.
    pub role: Role,
    /// Density of its blocks, kg/m³.
    pub density: Option<f64>,
    /// Thickness of its blocks, m in the scene, in place of [`super::ImportOptions::depth`].
    pub depth: Option<f64>,
    /// Greatest force in each of its ties, N.
    pub strength: Option<f64>,
    /// Force at each of its points along x and y of the drawing, N.
    pub force: Option<[f64; 2]>,
}

/// What is drawn on a layer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// Outlines and bodies of blocks.
    #[default]
    Block,
    /// Outlines and bodies of blocks that are held.
    Support,
    /// Lines from block to block: ties.
    Tie,
    /// Points where live loads act.
    Load,
    /// Nothing that counts.
    Ignore,
}

/// The keys of a rule.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Keys {
    #[serde(default)]
    role: Role,
    density: Option<f64>,
    depth: Option<f64>,
    strength: Option<f64>,
    force: Option<[f64; 2]>,
}

impl FromStr for LayerRule {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut words = text.split(',');
        let role = words.next().unwrap_or_default();
        let mut keys = Map::from_iter([("role".into(), Value::from(role))]);
        for word in words {
            let (key, value) = word
                .split_once('=')
                .ok_or_else(|| format!("{word:?}: expected KEY=VALUE, like density=2400"))?;
            let number = |text: &str| -> Result<Value, String> {
                let number: f64 = text.parse().map_err(|_| format!("{key}: not a number"))?;
                Ok(number.into())
            };
            let value = match value.split_once(':') {
                Some((x, y)) => Value::from(vec![number(x)?, number(y)?]),
                None => number(value)?,
            };
            keys.insert(key.into(), value);
        }
        Self::of(Value::Object(keys))
    }
}

impl<'de> Deserialize<'de> for LayerRule {
    /// The text of a rule, or an object of its keys.
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let rule = match Value::deserialize(from)? {
            Value::String(text) => text.parse(),
            keys => Self::of(keys),
        };
        rule.map_err(serde::de::Error::custom)
    }
}

impl LayerRule {
    fn of(keys: Value) -> Result<Self, String> {
        let Keys { role, density, depth, strength, force } =
            serde_json::from_value(keys).map_err(|e| e.to_string())?;
        let rule = Self { role, density, depth, strength, force };
        rule.check().map_err(|(key, why)| format!("{key}: {why}"))?;
        Ok(rule)
    }

    /// Whether its blocks are read.
    pub(super) fn has_blocks(&self) -> bool {
        matches!(self.role, Role::Block | Role::Support)
    }

    fn check(&self) -> Result<(), (&'static str, &'static str)> {
        let positive =
            [("density", self.density), ("depth", self.depth), ("strength", self.strength)];
        for (key, value) in positive {
            if value.is_some_and(|v| !(v.is_finite() && v > 0.0)) {
                return Err((key, "must be finite and > 0"));
            }
        }
        if self.force.is_some_and(|f| f.iter().any(|v| !v.is_finite())) {
            return Err(("force", "must be finite"));
        }
        let blocks = self.density.is_some() || self.depth.is_some();
        match self.role {
            Role::Tie if self.strength.is_none() => {
                Err(("strength", "a tie needs its greatest force in N: `tie,strength=50000`"))
            }
            Role::Load if self.force.is_none() => {
                Err(("force", "a load needs its force in N along x and y: `load,force=0:-1000`"))
            }
            _ if blocks && !self.has_blocks() => {
                Err(("density, depth", "only of blocks and supports"))
            }
            _ if self.strength.is_some() && self.role != Role::Tie => {
                Err(("strength", "only of a tie"))
            }
            _ if self.force.is_some() && self.role != Role::Load => {
                Err(("force", "only of a load"))
            }
            _ => Ok(()),
        }
    }

    /// As [`Self::check`], of the layer of this name.
    pub(super) fn check_of(&self, layer: &str) -> Result<(), InputError> {
        self.check().map_err(|(key, why)| {
            InputError::at(JsonPath::root(), format!("layer {layer:?}: {key}: {why}"))
        })
    }
}
