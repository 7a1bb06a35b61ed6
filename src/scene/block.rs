//! Blocks as the file gives them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;

/// One rigid block.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BlockSpec {
    /// Unique name.
    pub id: String,
    /// Geometry in the block's own frame.
    pub shape: Shape,
    /// Where the origin of the block's frame lies, m.
    #[serde(default, skip_serializing_if = "is_origin")]
    pub at: [f64; 3],
    /// Rotation of the block about the origin of its frame, applied before `at`.
    pub rotation_deg: Option<Rotation>,
    /// Whether the block is held in place.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub support: bool,
    /// Name of a material.
    pub material: Option<String>,
    /// Density, kg/m³; overrides the material's.
    pub density: Option<f64>,
    /// Mass, kg; overrides density × volume.
    pub mass: Option<f64>,
    /// Centre of mass in the block's own frame, m; overrides the centroid of the shape.
    pub centroid: Option<[f64; 3]>,
}

/// Turn by `angle` degrees about `axis` (right-handed; the axis need not be of unit length).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rotation {
    /// Direction of the axis.
    pub axis: [f64; 3],
    /// Angle, degrees.
    pub angle: f64,
}

/// The shape of a block in its own frame, m.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Shape {
    /// A box centred on the origin.
    #[serde(rename = "box")]
    Cuboid {
        /// Full lengths along x, y, z.
        size: [f64; 3],
    },
    /// A closed polyhedron, convex or not.
    Polyhedron {
        /// Corners.
        vertices: Vec<[f64; 3]>,
        /// Faces as loops of vertex indices, counter-clockwise seen from outside.
        faces: Vec<Vec<usize>>,
    },
    /// A closed polyhedron, convex or not, in a file of its own: OBJ, PLY or STL with one mesh.
    Mesh {
        /// The file, by its path from the folder of the scene, which it may not leave.
        path: String,
        /// Multiplies the coordinates of the file: 0.001 for a file in millimetres.
        #[serde(default = "one", skip_serializing_if = "is_one")]
        scale: f64,
        /// Corners as the file has them. Results hold what was read, and so need no file; where it
        /// is given, no file is read.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        vertices: Vec<[f64; 3]>,
        /// Faces as the file has them, which go with `vertices`.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        faces: Vec<Vec<usize>>,
    },
    /// A polygon in the x–z plane, extruded along y and centred on y = 0.
    Prism {
        /// Corners (x, z) in order, either way round; need not be convex.
        polygon: Vec<[f64; 2]>,
        /// Length along y.
        depth: f64,
    },
    /// A sphere centred on the origin.
    Sphere {
        /// Radius.
        radius: f64,
    },
    /// Spheres rigidly joined, apart, touching or overlapping; where they overlap there is mass
    /// once.
    Clump {
        /// The spheres.
        spheres: Vec<Ball>,
    },
    /// An unbounded plane through the origin, solid behind it: ground or wall. Supports only. It is
    /// made a slab that reaches three times as far as the other blocks.
    Plane {
        /// Direction out of the ground, of any length; [0, 0, 1] where none is given.
        #[serde(default = "up", skip_serializing_if = "is_up")]
        normal: [f64; 3],
    },
}

/// A sphere of a clump.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Ball {
    /// Centre in the block's own frame, m.
    pub at: [f64; 3],
    /// Radius, m.
    pub radius: f64,
}

impl BlockSpec {
    /// A free block of the given shape at the origin, everything else by default.
    pub fn new(id: impl Into<String>, shape: Shape) -> Self {
        Self {
            id: id.into(),
            shape,
            at: [0.0; 3],
            rotation_deg: None,
            support: false,
            material: None,
            density: None,
            mass: None,
            centroid: None,
        }
    }
}

fn one() -> f64 {
    1.0
}

fn is_one(scale: &f64) -> bool {
    *scale == 1.0
}

fn up() -> [f64; 3] {
    [0.0, 0.0, 1.0]
}

fn is_up(normal: &[f64; 3]) -> bool {
    *normal == up()
}

fn is_origin(at: &[f64; 3]) -> bool {
    *at == [0.0; 3]
}
