//! Materials and joints as the file gives them.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::{borrow::Cow, fmt};

/// What blocks are made of.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Density, kg/m³.
    pub density: f64,
}

/// How joints resist: one rule for all, and exceptions.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Joints {
    /// The rule for every joint without an exception.
    #[serde(default, skip_serializing_if = "JointSpec::is_empty")]
    pub default: JointSpec,
    /// Exceptions; where several match a joint, the last one wins.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub overrides: Vec<JointOverride>,
}

/// The resistance of a joint.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointSpec {
    /// Coefficient of friction μ ≥ 0, or `"infinite"` (no sliding).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<Friction>,
    /// Friction angle in degrees, 0 ≤ φ < 90, in place of `friction`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction_angle_deg: Option<f64>,
}

/// An exception: the joints between two materials, or between two blocks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointOverride {
    /// Two material names, in either order.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub between: Option<[String; 2]>,
    /// Two block ids, in either order.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub blocks: Option<[String; 2]>,
    /// Coefficient of friction μ ≥ 0, or `"infinite"` (no sliding).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<Friction>,
    /// Friction angle in degrees, in place of `friction`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction_angle_deg: Option<f64>,
}

/// Dry friction in a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Friction {
    /// Coulomb friction with coefficient μ ≥ 0.
    Coefficient(f64),
    /// No sliding at all, however small the pressure.
    Infinite,
}

impl Friction {
    /// The coefficient; infinity where sliding is excluded.
    pub fn mu(self) -> f64 {
        match self {
            Friction::Coefficient(mu) => mu,
            Friction::Infinite => f64::INFINITY,
        }
    }
}

impl Joints {
    pub(super) fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

impl JointSpec {
    pub(super) fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

impl Serialize for Friction {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Friction::Coefficient(mu) => serializer.serialize_f64(*mu),
            Friction::Infinite => serializer.serialize_str("infinite"),
        }
    }
}

impl<'de> Deserialize<'de> for Friction {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl de::Visitor<'_> for Visitor {
            type Value = Friction;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a coefficient of friction (a number >= 0) or \"infinite\"")
            }
            fn visit_f64<E: de::Error>(self, mu: f64) -> Result<Friction, E> {
                Ok(Friction::Coefficient(mu))
            }
            fn visit_u64<E: de::Error>(self, mu: u64) -> Result<Friction, E> {
                Ok(Friction::Coefficient(mu as f64))
            }
            fn visit_i64<E: de::Error>(self, mu: i64) -> Result<Friction, E> {
                Ok(Friction::Coefficient(mu as f64))
            }
            fn visit_str<E: de::Error>(self, text: &str) -> Result<Friction, E> {
                if text == "infinite" { Ok(Friction::Infinite) } else { Err(E::invalid_value(de::Unexpected::Str(text), &self)) }
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}

impl JsonSchema for Friction {
    fn schema_name() -> Cow<'static, str> {
        "Friction".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "Coefficient of friction, or \"infinite\" (no sliding).",
            "oneOf": [{ "type": "number", "minimum": 0 }, { "const": "infinite" }]
        })
    }
}
