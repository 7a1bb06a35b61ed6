//! Blocks of a scene taken as shapes, of which any number is put anywhere: assemblies from numbers,
//! without a file between two of them.

use super::{Assembly, Block, Pose, Wrench};
use base::error::{InputError, JsonPath};
use nalgebra::{UnitQuaternion, Vector3};

/// The blocks of a scene, each of which can be put anywhere, as often as wanted.
#[derive(Clone, Debug)]
pub struct Shelf {
    shapes: Assembly,
}

/// A block from the shelf, and where it is put: a point x of the scene on the shelf comes to
/// `R x + at`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Put {
    /// Index of the block on the shelf.
    pub shape: usize,
    /// Where the origin of the scene comes, m.
    pub at: Vector3<f64>,
    /// How it turns about the origin of the scene.
    pub turn: UnitQuaternion<f64>,
    /// Its mass, kg; that of the shelf where none is given.
    pub mass: Option<f64>,
}

impl Shelf {
    /// Takes the blocks of an assembly as shapes.
    ///
    /// # Errors
    /// The assembly says something about single blocks that are there (loads, members, contacts or
    /// joints by name): a shape may be there twice or not at all.
    pub fn new(shapes: Assembly) -> Result<Self, InputError> {
        let refused = |what: &str, key: &str, hint: &str| {
            let text =
                format!("shapes cannot have {what}: each may be used several times or not at all");
            Err(InputError::at(JsonPath::root().key(key), text).hint(hint.to_string()))
        };
        let weighs = |i: usize| Wrench {
            force: shapes.gravity * shapes.blocks[i].mass,
            moment: Vector3::zeros(),
        };
        if (0..shapes.blocks.len()).any(|i| {
            !shapes.blocks[i].support
                && (shapes.dead[i] != weighs(i) || shapes.live[i] != Wrench::zero())
        }) {
            return refused(
                "loads",
                "loads",
                "remove them: own weight always acts, and a margin applies its own load",
            );
        }
        if !shapes.members.is_empty() {
            return refused("members", "members", "ask about this scene directly");
        }
        if !shapes.given.is_empty() {
            return refused(
                "interfaces given by hand",
                "interfaces",
                "remove them: contacts are detected",
            );
        }
        if !shapes.joints.by_blocks.is_empty() {
            return refused("joints by their names", "joints", "give joints by material");
        }
        Ok(Self { shapes })
    }

    /// The shapes.
    pub fn shapes(&self) -> &[Block] {
        &self.shapes.blocks
    }

    /// The blocks that are put, in this order, under their weight.
    ///
    /// # Errors
    /// A shape that is not on the shelf, a place that is none, a mass that is not positive.
    pub fn put(&self, list: &[Put]) -> Result<Assembly, InputError> {
        let mut blocks = Vec::with_capacity(list.len());
        let mut dead = Vec::with_capacity(list.len());
        for (i, put) in list.iter().enumerate() {
            let block =
                self.one(put).map_err(|e| e.under(&JsonPath::root().key("put").index(i)))?;
            let load =
                if block.support { Vector3::zeros() } else { self.shapes.gravity * block.mass };
            dead.push(Wrench { force: load, moment: Vector3::zeros() });
            blocks.push(block);
        }
        Ok(Assembly {
            name: self.shapes.name.clone(),
            gravity: self.shapes.gravity,
            live: vec![Wrench::zero(); blocks.len()],
            blocks,
            joints: self.shapes.joints.clone(),
            dead,
            dead_forces: Vec::new(),
            live_forces: Vec::new(),
            given: Vec::new(),
            members: Vec::new(),
            contact: self.shapes.contact.clone(),
            said: Vec::new(),
            findings: Vec::new(),
        })
    }

    fn one(&self, put: &Put) -> Result<Block, InputError> {
        let root = JsonPath::root();
        let Some(shape) = self.shapes.blocks.get(put.shape) else {
            let text = format!(
                "there is no shape {} among {} (counted from 0)",
                put.shape,
                self.shapes.blocks.len()
            );
            return Err(InputError::at(root.key("shape"), text).hint("name an existing shape"));
        };
        if !put.at.iter().chain(put.turn.coords.iter()).all(|x| x.is_finite()) {
            let text = "must be finite numbers, with a quaternion that is not zero";
            return Err(InputError::at(root.key("pose"), text)
                .hint("lengths in m; w, x, y, z of the quaternion"));
        }
        let shift = put.turn * shape.centroid + put.at - shape.centroid;
        let mut block = shape.at(&Pose { shift, turn: put.turn });
        if let Some(mass) = put.mass {
            if !(mass > 0.0 && mass.is_finite()) {
                let text = format!("must be > 0, got {mass}");
                return Err(InputError::at(root.key("mass"), text).hint("kg"));
            }
            // The radii of gyration stay; a support may have had no mass.
            if !block.support {
                block.inertia *= mass / block.mass;
            }
            block.mass = mass;
        }
        Ok(block)
    }
}
