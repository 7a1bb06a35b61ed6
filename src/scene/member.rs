//! Members as the file gives them: ties, struts, bars, tendons, strips, dowels, soil, grips and
//! toothed corners. Each is a force of known direction and unknown, bounded size.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use serde_with::skip_serializing_none;
use std::{borrow::Cow, fmt};

/// A member: a name and exactly one kind.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Member {
    /// Unique name.
    pub id: String,
    /// A rod, cable or chain that only pulls.
    pub tie: Option<Line>,
    /// A rod that only pushes.
    pub strut: Option<Line>,
    /// A rod that pulls and pushes.
    pub bar: Option<Bar>,
    /// A cable over deviators: one tension along several points, without friction at them.
    pub tendon: Option<Tendon>,
    /// A strip bonded to one face of a run of blocks.
    pub strip: Option<Strip>,
    /// A dowel or key across a joint: shear at a point.
    pub dowel: Option<Dowel>,
    /// Soil behind a face: pressure up to the passive one.
    pub soil: Option<Soil>,
    /// A finger that presses on a point with a force of its own choice, up to its strength.
    pub grip: Option<Grip>,
    /// The friction of a toothed corner.
    pub toothing: Option<Toothing>,
}

/// Where a member ends: at a point of a block, or of the ground.
#[skip_serializing_none]
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct End {
    /// The block.
    pub block: Option<String>,
    /// Where on the block, in scene coordinates, m.
    pub at: Option<[f64; 3]>,
    /// An arm of no weight carries the force from the block to `at`, however far off that lies.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub arm: bool,
    /// A point that does not move, in place of `block` and `at`, m.
    pub ground: Option<[f64; 3]>,
}

/// A tie or a strut.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// Its two ends.
    pub between: [End; 2],
    /// Greatest force, N, or `"infinite"`.
    pub strength: Strength,
    /// Force that it was given before the loads, N (tension in a tie, compression in a strut).
    #[serde(default, skip_serializing_if = "super::template::is_zero")]
    pub prestress: f64,
    /// Stiffness EA / l, N/m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<f64>,
}

/// A bar.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Bar {
    /// Its two ends.
    pub between: [End; 2],
    /// Greatest tension, N, or `"infinite"`.
    pub tension: Strength,
    /// Greatest compression, N, or `"infinite"`.
    pub compression: Strength,
    /// Force that it was given before the loads, N; tension > 0.
    #[serde(default, skip_serializing_if = "super::template::is_zero")]
    pub prestress: f64,
    /// Stiffness EA / l, N/m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<f64>,
}

/// A tendon.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Tendon {
    /// Its ends and, between them, the points where it is deviated, in order.
    pub through: Vec<End>,
    /// Greatest tension, N, or `"infinite"`.
    pub strength: Strength,
    /// Tension that it was given before the loads, N.
    #[serde(default, skip_serializing_if = "super::template::is_zero")]
    pub prestress: f64,
    /// Stiffness EA / l of its whole length, N/m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<f64>,
}

/// A bonded strip: at every joint between neighbours of the run, a tension at the joint's edge on
/// that face, normal to the joint.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Strip {
    /// The blocks that it is bonded to, in order.
    pub blocks: Vec<String>,
    /// The face that it is bonded to.
    pub face: Face,
    /// Width, m.
    pub width: f64,
    /// Greatest tension of the fibres per width, N/m, or `"infinite"`.
    pub strength: Strength,
    /// Tension per width at which it comes off, N/m; not decisive where absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub debonding: Option<f64>,
    /// Nothing is carried at joints nearer than this to a free end of the strip, m.
    #[serde(default, skip_serializing_if = "super::template::is_zero")]
    pub development: f64,
}

/// A dowel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Dowel {
    /// The two blocks.
    pub blocks: [String; 2],
    /// Where it crosses the joint, m.
    pub at: [f64; 3],
    /// Normal of the joint; that of the contact of the two blocks nearest to `at` where absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub normal: Option<[f64; 3]>,
    /// Greatest shear force, N, or `"infinite"`.
    pub strength: Strength,
}

/// Soil behind a face.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Soil {
    /// The block that it presses on.
    pub block: String,
    /// The face that it presses on.
    pub face: Face,
    /// Direction in which it presses.
    pub direction: [f64; 3],
    /// Height z of the soil's surface, m.
    pub surface: f64,
    /// Weight of the soil per volume, N/m³.
    pub unit_weight: f64,
    /// Coefficient of passive pressure.
    pub k: f64,
}

/// A grip: one finger, or several that all press with the same force.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Grip {
    /// The block that is gripped.
    pub block: String,
    /// Where the finger touches it, m.
    pub at: Option<[f64; 3]>,
    /// Direction in which the finger presses, into the block.
    pub normal: Option<[f64; 3]>,
    /// Several fingers, in place of `at` and `normal`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fingers: Vec<Finger>,
    /// An arm of no weight carries the force from where a finger touches to the block.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub arm: bool,
    /// Coefficient of friction between fingers and block.
    pub friction: f64,
    /// Greatest normal force of each finger, N. The fingers apply it.
    pub strength: Strength,
}

/// One of several fingers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Finger {
    /// Where it touches the block, m.
    pub at: [f64; 3],
    /// Direction in which it presses, into the block.
    pub normal: [f64; 3],
}

impl Grip {
    /// Where its fingers touch, and the directions in which they press.
    pub fn all(&self) -> Vec<Finger> {
        let one = self.at.zip(self.normal).map(|(at, normal)| Finger { at, normal });
        one.into_iter().chain(self.fingers.iter().copied()).collect()
    }
}

/// The friction of a toothed corner (Circolare 7/2019, eq. C8.7.1.2): `F = 0.4 n (n + 1) Φ μ l² t w`
/// with `Φ = block_height / overlap`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Toothing {
    /// The block that is held: the wall.
    pub block: String,
    /// Number of toothed courses n.
    pub courses: usize,
    /// Height of a course, m.
    pub block_height: f64,
    /// Overlap l of the stones, m.
    pub overlap: f64,
    /// Coefficient of friction μ between the stones.
    pub friction: f64,
    /// Thickness t of the wall, m.
    pub thickness: f64,
    /// Weight w of the masonry per volume, N/m³.
    pub unit_weight: f64,
    /// Height z at which it acts, m.
    pub height: f64,
    /// Direction in which it pulls the block.
    pub direction: [f64; 3],
}

/// The greatest force of a member.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Strength {
    /// N (N/m for a strip).
    Finite(f64),
    /// It never yields.
    Infinite,
}

impl Strength {
    /// The number; infinity where it never yields.
    pub fn value(self) -> f64 {
        match self {
            Self::Finite(value) => value,
            Self::Infinite => f64::INFINITY,
        }
    }
}

/// A face of a block.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(
    untagged,
    expecting = "expected a face: \"extrados\" or \"intrados\" of an arch or barrel, \"+x\" … \"-z\", { \"near\": [x, y, z] }, or the index of a face"
)]
pub enum Face {
    /// By name.
    Named(NamedFace),
    /// The one nearest to a point.
    Near(Near),
    /// By its number in the block's list of faces.
    Index(usize),
}

/// The face nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Near {
    /// The point, m.
    pub near: [f64; 3],
}

/// Faces with a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum NamedFace {
    /// The outer face of a voussoir of an `arch` or `barrel` template.
    Extrados,
    /// Its inner face.
    Intrados,
    /// The face that looks most along +x.
    #[serde(rename = "+x")]
    PlusX,
    /// The face that looks most along −x.
    #[serde(rename = "-x")]
    MinusX,
    /// The face that looks most along +y.
    #[serde(rename = "+y")]
    PlusY,
    /// The face that looks most along −y.
    #[serde(rename = "-y")]
    MinusY,
    /// The face that looks most along +z.
    #[serde(rename = "+z")]
    PlusZ,
    /// The face that looks most along −z.
    #[serde(rename = "-z")]
    MinusZ,
}

impl Serialize for Strength {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Finite(value) => serializer.serialize_f64(*value),
            Self::Infinite => serializer.serialize_str("infinite"),
        }
    }
}

impl<'de> Deserialize<'de> for Strength {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Visitor;
        impl de::Visitor<'_> for Visitor {
            type Value = Strength;
            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("a strength (a number >= 0) or \"infinite\"")
            }
            fn visit_f64<E: de::Error>(self, value: f64) -> Result<Strength, E> {
                Ok(Strength::Finite(value))
            }
            fn visit_u64<E: de::Error>(self, value: u64) -> Result<Strength, E> {
                Ok(Strength::Finite(value as f64))
            }
            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Strength, E> {
                Ok(Strength::Finite(value as f64))
            }
            fn visit_str<E: de::Error>(self, text: &str) -> Result<Strength, E> {
                if text == "infinite" {
                    Ok(Strength::Infinite)
                } else {
                    Err(E::invalid_value(de::Unexpected::Str(text), &self))
                }
            }
        }
        deserializer.deserialize_any(Visitor)
    }
}

impl JsonSchema for Strength {
    fn schema_name() -> Cow<'static, str> {
        "Strength".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "Greatest force, N (N/m for a strip), or \"infinite\".",
            "oneOf": [{ "type": "number", "minimum": 0 }, { "const": "infinite" }]
        })
    }
}
