//! Materials and joints as the file gives them.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use serde_with::skip_serializing_none;
use std::{
    borrow::Cow,
    collections::{BTreeMap, btree_map::Entry},
    fmt,
    marker::PhantomData,
};

/// What blocks are made of.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Density, kg/m³.
    pub density: f64,
    /// Young's modulus, Pa, of what touches at points: spheres by Hertz. `state` alone asks for it;
    /// rigid where it is left out.
    pub young: Option<f64>,
    /// Poisson's ratio, above −1 and at most 0.5; given with `young`.
    pub poisson: Option<f64>,
    /// The action that the weight of its blocks belongs to in combinations; `dead` where absent.
    pub action: Option<String>,
}

impl Material {
    /// A material of which nothing but its density is known, kg/m³.
    pub fn of_density(density: f64) -> Self {
        Self { density, young: None, poisson: None, action: None }
    }
}

/// How joints resist: one rule for all, and exceptions.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Joints {
    /// The rule for every joint without an exception.
    #[serde(default, skip_serializing_if = "JointSpec::is_empty")]
    pub default: JointSpec,
    /// Exceptions; one for two blocks beats one for two materials, and among several of the same
    /// kind the last one wins.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub overrides: Vec<JointOverride>,
}

/// The resistance of a joint.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointSpec {
    /// Coefficient of friction μ ≥ 0, or `"infinite"` (no sliding).
    pub friction: Option<Friction>,
    /// Friction angle in degrees, 0 ≤ φ < 90, in place of `friction`.
    pub friction_angle_deg: Option<f64>,
    /// Cohesion, Pa: shear resistance without any pressure. Default 0.
    pub cohesion: Option<f64>,
    /// Tensile strength, Pa. Default 0. Beyond cohesion / friction it has no effect.
    pub tension: Option<f64>,
    /// Compressive strength, Pa; crushing is excluded where it is left out.
    pub compression: Option<f64>,
    /// Pressure of the water in the joint, Pa. Default 0.
    pub pore_pressure: Option<f64>,
    /// Rolling arm, m, of contacts at points and edges. Default 0.
    pub rolling_arm: Option<f64>,
    /// Pressure by which the joint closes one metre, Pa/m. `state` alone asks for it; the joint is
    /// rigid for all other questions.
    pub normal_stiffness: Option<f64>,
    /// Shear stress by which its sides move one metre along it before it slides, Pa/m. The normal
    /// stiffness where it is left out.
    pub shear_stiffness: Option<f64>,
}

/// An exception: the joints between two materials, or between two blocks. What it leaves out is as
/// in the default.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointOverride {
    /// Two material names, in either order.
    pub between: Option<[String; 2]>,
    /// Two block ids, in either order.
    pub blocks: Option<[String; 2]>,
    /// Coefficient of friction μ ≥ 0, or `"infinite"` (no sliding).
    pub friction: Option<Friction>,
    /// Friction angle in degrees, in place of `friction`.
    pub friction_angle_deg: Option<f64>,
    /// Cohesion, Pa: shear resistance without any pressure.
    pub cohesion: Option<f64>,
    /// Tensile strength, Pa. Beyond cohesion / friction it has no effect.
    pub tension: Option<f64>,
    /// Compressive strength, Pa.
    pub compression: Option<f64>,
    /// Pressure of the water in the joint, Pa.
    pub pore_pressure: Option<f64>,
    /// Rolling arm, m, of contacts at points and edges.
    pub rolling_arm: Option<f64>,
    /// Pressure by which the joint closes one metre, Pa/m.
    pub normal_stiffness: Option<f64>,
    /// Shear stress by which its sides move one metre along it before it slides, Pa/m.
    pub shear_stiffness: Option<f64>,
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
    /// Whether it says nothing.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

impl JointOverride {
    /// What it says about the joint, without where.
    pub fn spec(&self) -> JointSpec {
        JointSpec {
            friction: self.friction,
            friction_angle_deg: self.friction_angle_deg,
            cohesion: self.cohesion,
            tension: self.tension,
            compression: self.compression,
            pore_pressure: self.pore_pressure,
            rolling_arm: self.rolling_arm,
            normal_stiffness: self.normal_stiffness,
            shear_stiffness: self.shear_stiffness,
        }
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
                if text == "infinite" {
                    Ok(Friction::Infinite)
                } else {
                    Err(E::invalid_value(de::Unexpected::Str(text), &self))
                }
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

/// The error about a name that a map holds twice.
pub(super) const GIVEN_TWICE: &str = "the name is given twice";

/// Reads a map and refuses a name that is given twice (serde's own maps keep the last and say
/// nothing).
pub(super) fn distinct_names<'de, D: Deserializer<'de>, V: Deserialize<'de>>(
    deserializer: D,
) -> Result<BTreeMap<String, V>, D::Error> {
    /// Stands for the value of a repeated key, so that the error lies at that key.
    struct Twice;
    impl<'de> de::DeserializeSeed<'de> for Twice {
        type Value = ();
        fn deserialize<D: Deserializer<'de>>(self, _: D) -> Result<(), D::Error> {
            Err(de::Error::custom(GIVEN_TWICE))
        }
    }
    struct Visitor<V>(PhantomData<V>);
    impl<'de, V: Deserialize<'de>> de::Visitor<'de> for Visitor<V> {
        type Value = BTreeMap<String, V>;
        fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
            f.write_str("a map")
        }
        fn visit_map<A: de::MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
            let mut named = BTreeMap::new();
            while let Some(name) = map.next_key::<String>()? {
                match named.entry(name) {
                    Entry::Vacant(free) => {
                        free.insert(map.next_value()?);
                    }
                    Entry::Occupied(_) => map.next_value_seed(Twice)?,
                }
            }
            Ok(named)
        }
    }
    deserializer.deserialize_map(Visitor(PhantomData))
}
