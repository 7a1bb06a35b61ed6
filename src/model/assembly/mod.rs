//! A [`Scene`](scene::Scene) resolved once and completely: SI units, scene coordinates,
//! closed outward shapes, positive masses, every default applied, every name resolved.

mod clump;
mod distance;
mod face;
mod gyration;
mod joint;
mod member;
mod plausible;
mod polyhedron;
mod pose;
mod resolve;
mod shelf;
mod stage;

pub use gyration::Gyration;
pub use joint::{JointLaw, JointRules};
pub use member::{Action, Anchor, BlockFace, DowelPlan, Member, MemberKind, MemberPlan, StripPlan};
pub use polyhedron::{Facet, MassProperties, Mend, Polyhedron, ShapeError};
pub use pose::Pose;
pub use resolve::{
    Blocks, asked_stages, named_blocks, resolve, resolve_blocks, resolve_until, resolve_with,
    stages, with_loads,
};
pub use shelf::{Put, Shelf};
pub use stage::{AskedStages, Placed, Stage};

use base::error::{Finding, JsonPath};
use nalgebra::{Matrix3, Vector3};
use scene::{ContactSpec, MaterialFactors};

/// Everything the mechanics needs to know.
#[derive(Clone, Debug)]
pub struct Assembly {
    /// A name for people.
    pub name: String,
    /// Gravity, m/s².
    pub gravity: Vector3<f64>,
    /// Supports and free blocks in scene order (explicit blocks first, then templates).
    pub blocks: Vec<Block>,
    /// How the joint between two blocks resists.
    pub joints: JointRules,
    /// Dead load per block, own weight included; zero on supports.
    pub dead: Vec<Wrench>,
    /// Live load per block (multiplied by λ); zero on supports.
    pub live: Vec<Wrench>,
    /// The dead forces that act off the centre of mass; contained in `dead`. Their heights matter
    /// when gravity turns.
    pub dead_forces: Vec<AppliedForce>,
    /// The live forces that act off the centre of mass; contained in `live`.
    pub live_forces: Vec<AppliedForce>,
    /// Interfaces given by hand.
    pub given: Vec<GivenInterface>,
    /// Ties, struts, tendons, strips, dowels, soil and grips, before contacts are known.
    pub members: Vec<MemberPlan>,
    /// Contact tolerances.
    pub contact: ContactSpec,
    /// What was said before: as files were read, of which scene of several it is.
    pub said: Vec<Finding>,
    /// What was mended or assumed on the way.
    pub findings: Vec<Finding>,
}

/// A rigid block.
#[derive(Clone, Debug)]
pub struct Block {
    /// Unique name.
    pub id: String,
    /// Where the block stands in the scene file (`blocks[3]`, `templates[0]`).
    pub path: JsonPath,
    /// Held in place.
    pub support: bool,
    /// Name of its material, if any.
    pub material: Option<String>,
    /// How its material yields where it touches at points, where that is known.
    pub elastic: Option<Elastic>,
    /// Mass, kg; with the factor of its weight.
    pub mass: f64,
    /// Partial factor on its weight by the combination in force; 1 where there is none.
    pub factor: f64,
    /// Centre of mass, m.
    pub centroid: Vector3<f64>,
    /// Inertia about the centre of mass, kg·m².
    pub inertia: Matrix3<f64>,
    /// Its radii of gyration: what moments and spins are measured by.
    pub gyration: Gyration,
    /// Geometry in scene coordinates.
    pub solid: Solid,
    /// Bounding-box diagonal, m; the length scale of every tolerance about this block.
    pub size: f64,
}

/// An isotropic elastic material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elastic {
    /// Young's modulus, Pa.
    pub young: f64,
    /// Poisson's ratio.
    pub poisson: f64,
}

impl Elastic {
    /// Shear modulus, Pa.
    pub fn shear(&self) -> f64 {
        self.young / (2.0 * (1.0 + self.poisson))
    }
}

/// The geometry of a block in scene coordinates.
#[derive(Clone, Debug)]
pub enum Solid {
    /// A closed polyhedron.
    Polyhedron(Polyhedron),
    /// A sphere.
    Sphere {
        /// Centre, m.
        center: Vector3<f64>,
        /// Radius, m.
        radius: f64,
    },
    /// Spheres rigidly joined.
    Clump {
        /// Centres and radii, m.
        balls: Vec<(Vector3<f64>, f64)>,
        /// Volume of their union, m³.
        volume: f64,
    },
}

impl Solid {
    /// Volume, m³.
    pub fn volume(&self) -> f64 {
        match self {
            Self::Sphere { radius, .. } => 4.0 / 3.0 * std::f64::consts::PI * radius.powi(3),
            Self::Clump { volume, .. } => *volume,
            Self::Polyhedron(p) => p.mass_properties().volume,
        }
    }

    /// The box around it, m: least and greatest coordinates.
    pub fn extent(&self) -> (Vector3<f64>, Vector3<f64>) {
        let ball = |(c, r): &(Vector3<f64>, f64)| (c.add_scalar(-r), c.add_scalar(*r));
        let boxes: Vec<_> = match self {
            Self::Sphere { center, radius } => vec![ball(&(*center, *radius))],
            Self::Clump { balls, .. } => balls.iter().map(ball).collect(),
            Self::Polyhedron(p) => p.vertices.iter().map(|v| (*v, *v)).collect(),
        };
        let none = Vector3::repeat(f64::INFINITY);
        boxes.into_iter().fold((none, -none), |(l, h), (low, high)| (l.inf(&low), h.sup(&high)))
    }

    /// Whether the surface is made of spheres alone, so that whatever touches it touches it at
    /// points.
    pub fn is_round(&self) -> bool {
        !matches!(self, Self::Polyhedron(_))
    }
}

/// A force acting off a block's centre of mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AppliedForce {
    /// Index of the block.
    pub block: usize,
    /// Force, N.
    pub force: Vector3<f64>,
    /// From the centre of mass to where it acts, m.
    pub arm: Vector3<f64>,
}

/// A force and a moment about a stated point: the centre of mass for loads on a block, the contact
/// point for contact forces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench {
    /// Force, N.
    pub force: Vector3<f64>,
    /// Moment about that point, N·m.
    pub moment: Vector3<f64>,
}

impl Wrench {
    /// No load.
    pub fn zero() -> Self {
        Self { force: Vector3::zeros(), moment: Vector3::zeros() }
    }
}

impl std::ops::Mul<f64> for Wrench {
    type Output = Self;
    fn mul(self, by: f64) -> Self {
        Self { force: self.force * by, moment: self.moment * by }
    }
}

impl std::ops::AddAssign for Wrench {
    fn add_assign(&mut self, other: Self) {
        self.force += other.force;
        self.moment += other.moment;
    }
}

/// An interface given by hand, its names resolved.
#[derive(Clone, Debug)]
pub struct GivenInterface {
    /// Index of the first block.
    pub a: usize,
    /// Index of the second block.
    pub b: usize,
    /// Corners, m.
    pub points: Vec<Vector3<f64>>,
    /// Unit normal from `a` into `b`.
    pub normal: Vector3<f64>,
    /// How it resists, joint rules already applied.
    pub law: JointLaw,
}

impl Assembly {
    /// The assembly with `lambda` times its live load among its dead loads, and no live load.
    pub fn at_load_factor(&self, lambda: f64) -> Self {
        let mut loaded = self.clone();
        for (dead, live) in loaded.dead.iter_mut().zip(&mut loaded.live) {
            *dead += *live * lambda;
            *live = Wrench::zero();
        }
        let forces = std::mem::take(&mut loaded.live_forces)
            .into_iter()
            .map(|f| AppliedForce { force: f.force * lambda, ..f });
        loaded.dead_forces.extend(forces.filter(|f| f.force != Vector3::zeros()));
        loaded
    }

    /// Divides the strengths of its joints by partial factors.
    fn divide_joints(&mut self, by: &MaterialFactors) {
        let rules = &mut self.joints;
        let ruled = rules.default.iter_mut().chain(rules.by_blocks.values_mut());
        let ruled = ruled.chain(rules.by_material.iter_mut().map(|(_, law)| law));
        for law in ruled.chain(self.given.iter_mut().map(|g| &mut g.law)) {
            *law = law.divided(by);
        }
    }

    /// Indices of the free blocks.
    pub fn free(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.blocks.len()).filter(|&i| !self.blocks[i].support)
    }

    /// The weight of a block, N: its mass times the strength of gravity.
    pub fn weight(&self, block: usize) -> f64 {
        self.blocks[block].mass * self.gravity.norm()
    }

    /// The mass of a block without any partial factor, kg.
    pub fn characteristic_mass(&self, block: usize) -> f64 {
        self.blocks[block].mass / self.blocks[block].factor
    }

    /// The weight of a block as a load about its centre of mass; zero on supports. `dead` minus
    /// this is what loads add.
    pub fn self_weight(&self, block: usize) -> Wrench {
        let Block { mass, support, .. } = self.blocks[block];
        if support {
            Wrench::zero()
        } else {
            Wrench { force: self.gravity * mass, moment: Vector3::zeros() }
        }
    }

    /// Index of a block by name.
    pub fn find(&self, id: &str) -> Option<usize> {
        self.blocks.iter().position(|b| b.id == id)
    }
}
