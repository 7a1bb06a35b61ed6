//! Members: forces of known direction and unknown, bounded size, beside those of the contacts.
//!
//! A member acts on the blocks that it joins by *legs*: a leg is a force on one block, along a
//! fixed direction through a fixed point, and its opposite on another block or on the ground. Its
//! *amounts* are what is unknown: one tension for a line or a push, two components of a shear, three
//! of a contact with a finger.

use base::error::JsonPath;
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a member is called.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MemberKind {
    /// Only pulls.
    Tie,
    /// Only pushes.
    Strut,
    /// Pulls and pushes.
    Bar,
    /// Pulls along several points.
    Tendon,
    /// One joint of a bonded strip.
    Strip,
    /// Shear across a joint.
    Dowel,
    /// Soil behind a face.
    Soil,
    /// A finger.
    Grip,
    /// The friction of a toothed corner.
    Toothing,
}

impl MemberKind {
    /// As scene files call it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Tie => "tie",
            Self::Strut => "strut",
            Self::Bar => "bar",
            Self::Tendon => "tendon",
            Self::Strip => "strip",
            Self::Dowel => "dowel",
            Self::Soil => "soil",
            Self::Grip => "grip",
            Self::Toothing => "toothing",
        }
    }
}

/// Where a line ends or is deviated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anchor {
    /// The block; the ground where there is none.
    pub block: Option<usize>,
    /// Where, m.
    pub at: Vector3<f64>,
}

/// How a member acts.
#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// One force along the straight pieces between these points; tension > 0.
    Line(Vec<Anchor>),
    /// A force along `direction` on one block at a point, its opposite on another or on the ground.
    Push {
        /// The block that is pushed.
        on: usize,
        /// What pushes.
        from: Option<usize>,
        /// Where, m.
        at: Vector3<f64>,
        /// Unit direction of the force on `on`.
        direction: Vector3<f64>,
    },
    /// A force across `normal` on the second block at a point, its opposite on the first.
    Shear {
        /// The blocks.
        blocks: [usize; 2],
        /// Where, m.
        at: Vector3<f64>,
        /// Unit normal of the joint.
        normal: Vector3<f64>,
    },
    /// A contact with something that does not move: a force in the cone about `normal`.
    Press {
        /// The block that is pressed.
        on: usize,
        /// Where, m.
        at: Vector3<f64>,
        /// Unit direction of the normal force on the block.
        normal: Vector3<f64>,
        /// Coefficient of friction.
        friction: f64,
    },
}

impl Action {
    /// The blocks that it acts on; `None` is the ground.
    pub fn ends(&self) -> Vec<Option<usize>> {
        match self {
            Self::Line(anchors) => anchors.iter().map(|a| a.block).collect(),
            Self::Push { on, from, .. } => vec![*from, Some(*on)],
            Self::Shear { blocks, .. } => blocks.iter().map(|&b| Some(b)).collect(),
            Self::Press { on, .. } => vec![None, Some(*on)],
        }
    }

    /// Its blocks and points replaced.
    fn mapped(
        &self,
        block: impl Fn(usize) -> usize,
        place: impl Fn(&Vector3<f64>) -> Vector3<f64>,
    ) -> Self {
        match self {
            Self::Line(anchors) => {
                let mapped =
                    anchors.iter().map(|a| Anchor { block: a.block.map(&block), at: place(&a.at) });
                Self::Line(mapped.collect())
            }
            Self::Push { on, from, at, direction } => Self::Push {
                on: block(*on),
                from: from.map(&block),
                at: place(at),
                direction: *direction,
            },
            Self::Shear { blocks, at, normal } => {
                Self::Shear { blocks: blocks.map(&block), at: place(at), normal: *normal }
            }
            Self::Press { on, at, normal, friction } => {
                Self::Press { on: block(*on), at: place(at), normal: *normal, friction: *friction }
            }
        }
    }

    /// The points that it acts at, m.
    pub fn points(&self) -> Vec<Vector3<f64>> {
        match self {
            Self::Line(anchors) => anchors.iter().map(|a| a.at).collect(),
            Self::Push { at, .. } | Self::Shear { at, .. } | Self::Press { at, .. } => vec![*at],
        }
    }
}

/// A member with its bounds.
#[derive(Clone, Debug, PartialEq)]
pub struct Member {
    /// Its name; that of a strip with the number of the joint.
    pub id: String,
    /// Where it stands in the scene file.
    pub path: JsonPath,
    /// What it is called.
    pub kind: MemberKind,
    /// How it acts.
    pub action: Action,
    /// Least amount, N: of a line or a push; 0 otherwise. May be −∞.
    pub least: f64,
    /// Greatest amount, N: of a line or a push, of the size of a shear, of the normal force of a
    /// finger. May be ∞.
    pub greatest: f64,
    /// The amount that it has before the loads act, N (lines only).
    pub prestress: f64,
    /// Stiffness, N/m, where it is known.
    pub stiffness: Option<f64>,
}

impl Member {
    /// Whether it takes any force without yielding, in the directions in which it takes any.
    pub fn is_endless(&self) -> bool {
        self.greatest == f64::INFINITY && (self.least == 0.0 || self.least == f64::NEG_INFINITY)
            || (self.least == f64::NEG_INFINITY && self.greatest == 0.0)
    }

    /// Whether it can take no force at all.
    pub fn is_idle(&self) -> bool {
        self.least == 0.0 && self.greatest == 0.0
    }

    /// The same between blocks with other numbers.
    #[must_use]
    pub fn renumbered(&self, number: &[usize]) -> Self {
        Self { action: self.action.mapped(|i| number[i], |p| *p), ..self.clone() }
    }

    /// The same with its points elsewhere.
    #[must_use]
    pub fn placed(&self, place: impl Fn(&Vector3<f64>) -> Vector3<f64>) -> Self {
        Self { action: self.action.mapped(|i| i, place), ..self.clone() }
    }

    /// The same with all forces multiplied.
    #[must_use]
    pub fn times(&self, by: f64) -> Self {
        Self {
            least: self.least * by,
            greatest: self.greatest * by,
            prestress: self.prestress * by,
            stiffness: self.stiffness.map(|k| k * by),
            ..self.clone()
        }
    }
}

/// A member of a scene before contacts are known.
#[derive(Clone, Debug, PartialEq)]
pub enum MemberPlan {
    /// All is known.
    Whole(Member),
    /// A strip: what it does depends on the joints between its blocks.
    Strip(StripPlan),
    /// A dowel across a joint whose normal nobody gave.
    Dowel(DowelPlan),
}

impl MemberPlan {
    /// The same with its strength divided by a partial factor; what it was stressed with stays, as
    /// far as it is carried.
    #[must_use]
    pub fn divided(&self, by: Option<f64>) -> Self {
        let by = by.unwrap_or(1.0);
        match self.clone() {
            Self::Whole(m) => {
                let (least, greatest) = (m.least / by, m.greatest / by);
                let prestress = m.prestress.clamp(least, greatest);
                Self::Whole(Member { least, greatest, prestress, ..m })
            }
            Self::Strip(s) => Self::Strip(StripPlan { strength: s.strength / by, ..s }),
            Self::Dowel(d) => Self::Dowel(DowelPlan { strength: d.strength / by, ..d }),
        }
    }
}

/// A strip before the joints between its blocks are known.
#[derive(Clone, Debug, PartialEq)]
pub struct StripPlan {
    /// Its name.
    pub id: String,
    /// Where it stands in the scene file.
    pub path: JsonPath,
    /// The blocks in order, each with its face; supports may have none that is known.
    pub run: Vec<(usize, Option<BlockFace>)>,
    /// Greatest tension at a joint, N.
    pub strength: f64,
    /// Nothing is carried nearer than this to a free end, m.
    pub development: f64,
}

/// A dowel before its joint is known.
#[derive(Clone, Debug, PartialEq)]
pub struct DowelPlan {
    /// Its name.
    pub id: String,
    /// Where it stands in the scene file.
    pub path: JsonPath,
    /// The blocks.
    pub blocks: [usize; 2],
    /// Where it crosses the joint, m.
    pub at: Vector3<f64>,
    /// Greatest shear, N.
    pub strength: f64,
}

/// A face of a block: one facet, or several that look nearly the same way.
#[derive(Clone, Debug, PartialEq)]
pub struct BlockFace {
    /// Outward unit normal, the mean of the facets.
    pub normal: Vector3<f64>,
    /// Centroid, m.
    pub centroid: Vector3<f64>,
    /// Normal and area, m², of each facet.
    pub facets: Vec<(Vector3<f64>, f64)>,
    /// Its corners, m.
    pub corners: Vec<Vector3<f64>>,
}
