//! Results of `thrust`: both ends of its range, the line of thrust at every section, the geometric
//! safety factor.

mod verify;

pub(super) use verify::verify;

use super::{certificate::Certificate, critical::Side};
use crate::{
    terms::Bound,
    verdict::section::{SectionForce, sections},
};
use base::tolerance;
use model::interface::Model;
use serde::{Deserialize, Serialize};

/// The range of the thrust on a support, or of the force in a member.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ThrustAnswer {
    /// The support.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub support: Option<String>,
    /// Unit direction of the thrust, or of the shear of a dowel.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub direction: Option<[f64; 3]>,
    /// The member whose force is meant, in place of a support.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub member: Option<String>,
    /// Its least value.
    pub least: Bound,
    /// Its greatest value.
    pub greatest: Bound,
    /// The geometric safety factor.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub geometric_factor: Option<Factor>,
}

/// A geometric safety factor.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Factor {
    /// The factor, where there is one; it is beyond `lower` otherwise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
    /// With sections shrunk by this it stands.
    pub lower: f64,
    /// With sections shrunk by this it falls.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub upper: Option<f64>,
}

/// The evidence, and the line of thrust.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ThrustResult {
    /// For the least thrust.
    pub least: Certificate,
    /// For the greatest.
    pub greatest: Certificate,
    /// Shrunk sections, with the verdict at each: `value` is the share of the section that is left.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub shrunk: Vec<Side>,
    /// Why there is no geometric safety factor.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub without_factor: Option<String>,
    /// The line of thrust, section by section.
    pub sections: Vec<ThrustSection>,
}

/// A section with the lines of thrust through it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ThrustSection {
    /// The two blocks.
    pub between: [String; 2],
    /// At the least thrust, where found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub least: Option<Line>,
    /// At the greatest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub greatest: Option<Line>,
}

/// The line of thrust at a section.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// Normal force, N; compression > 0.
    pub normal: f64,
    /// Shear force, N.
    pub shear: f64,
    /// Centre of pressure, m.
    pub at: [f64; 3],
    /// Its distance from the centroid, m.
    pub eccentricity: f64,
    /// Share of the section used: 1 at the edge.
    pub used: f64,
    /// Whether it lies in the kern: the whole section presses.
    pub in_kern: bool,
    /// Whether it lies inside the section.
    pub inside: bool,
}

impl From<&SectionForce> for Line {
    fn from(s: &SectionForce) -> Self {
        Self {
            normal: s.normal,
            shear: s.shear,
            at: s.at.into(),
            eccentricity: s.eccentricity.norm(),
            used: s.used,
            in_kern: s.in_kern,
            inside: s.used <= 1.0 + 1e-9,
        }
    }
}

/// The factor that shrunk sections prove: a value only where the two sides are near each other.
pub fn factor(shrunk: &[Side], value: Option<f64>) -> Option<Factor> {
    let proved = |s: &&Side| s.verdict().is_some();
    let (lower, upper) = (
        1.0 / shrunk.first().filter(proved)?.value,
        shrunk.get(1).filter(proved).map(|s| 1.0 / s.value),
    );
    let is_known = |v: &f64| {
        upper
            .is_some_and(|u| lower <= *v && *v <= u && u - lower <= tolerance::CRITICAL_BRACKET * u)
    };
    Some(Factor { value: value.filter(is_known), lower, upper })
}

/// The line of thrust for up to two sets of forces.
pub fn table(model: &Model, forces: [Option<&crate::verdict::Forces>; 2]) -> Vec<ThrustSection> {
    let [least, greatest] = forces.map(|f| f.map(|f| sections(&model.interfaces, f)));
    let line =
        |s: &Option<Vec<SectionForce>>, k: usize| s.as_ref().and_then(|s| s.get(k)).map(Line::from);
    let id = |i: usize| model.assembly.blocks[i].id.clone();
    let faces = model.interfaces.list.iter().enumerate();
    faces
        .map(|(k, f)| ThrustSection {
            between: [id(f.a), id(f.b)],
            least: line(&least, k),
            greatest: line(&greatest, k),
        })
        .collect()
}
