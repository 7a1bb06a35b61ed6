//! What there is to see of an answer: blocks as surfaces, where they touch, the forces, the lines
//! of thrust, the mechanisms and what happened in time. One plain value that pages and drawings
//! share, so that all of them show the same.
//!
//! Lengths in m, forces in N on the second block of a joint, in the coordinates of the scene.
//! Forces and rates are those of the certificates in the result, fitted to the scene again.

mod course;
mod film;
mod member;
mod motion;
mod pressure;
mod road;
mod slope;
mod stages;
mod state;
mod surface;
mod train;

pub use course::{Course, frames};
pub use film::Film;
pub use member::ViewMember;
pub use motion::{Mark, ViewMotion, ViewPose};
pub use pressure::ViewPressure;
pub use road::{ViewRoad, ViewWheel, WHEEL, of as roads};
pub use slope::ViewSlope;
pub use stages::ViewValues;
pub use state::{Resultant, Segment, ViewPart, ViewState};
pub use surface::{Surface, ViewShape};
pub use train::positions;

use base::number::short;
use check::kinematic::quake;
use check::proof::result::ResultFile;
use check::question::QuestionKind;
use check::verdict::section::centroid;
use dynamics::Frame;
use model::{
    assembly::{AppliedForce, JointLaw},
    interface::{ContactKind, Model},
};
use nalgebra::{Matrix3, Vector3};

/// A certificate that does not fit the scene it is shown with.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cannot be drawn: {0}")]
pub struct ViewError(pub String);

/// Everything that can be drawn.
#[derive(Clone, Debug)]
pub struct View {
    /// Name of the scene.
    pub name: String,
    /// Unit vector against gravity; of a tilt, as the ground is tipped when it falls.
    pub up: Vector3<f64>,
    /// What is seen, where that is not the scene as it is: tipped, or with another number in it.
    /// May be empty.
    pub caption: String,
    /// Unit vector against gravity as the scene has it.
    pub ground: Vector3<f64>,
    /// Gravity, m/s².
    pub gravity: f64,
    /// Unit vector across `up` from which one looks: across the greater extent.
    pub front: Vector3<f64>,
    /// The box to look at: that of the free blocks and of what supports them nearby, m.
    pub low: Vector3<f64>,
    /// Its upper corner.
    pub high: Vector3<f64>,
    /// Blocks in scene order.
    pub bodies: Vec<BlockView>,
    /// Joints in the order of the interfaces.
    pub joints: Vec<JointView>,
    /// Loads beside the blocks' own weight.
    pub loads: Vec<ViewLoad>,
    /// Ties, struts, soil and other members, with their forces in the answer.
    pub members: Vec<ViewMember>,
    /// Systems of contact forces; the first one goes with the answer.
    pub states: Vec<ViewState>,
    /// Pressure in elastic joints.
    pub pressures: Vec<ViewPressure>,
    /// Mechanisms, or displacements; the first one goes with the answer.
    pub motions: Vec<ViewMotion>,
    /// What happened in time, evenly spread, or on a path point by point.
    pub film: Vec<Frame>,
    /// What the film goes along.
    pub course: Course,
    /// Numbers of blocks that are shown by colour.
    pub values: Option<ViewValues>,
    /// The surface of a heap, with the line through it.
    pub slope: Option<ViewSlope>,
    /// Roads of bridges.
    pub roads: Vec<ViewRoad>,
    /// Whether supports are left out of pictures.
    pub hides_supports: bool,
    /// Drawings have dimensions.
    pub is_measured: bool,
}

/// A block.
#[derive(Clone, Debug)]
pub struct BlockView {
    /// Its name.
    pub id: String,
    /// Held in place.
    pub support: bool,
    /// Its material, where it has one.
    pub material: Option<String>,
    /// Mass, kg.
    pub mass: f64,
    /// Volume, m³.
    pub volume: f64,
    /// Centre of mass, m.
    pub center: Vector3<f64>,
    /// Inertia about it, kg·m².
    pub inertia: Matrix3<f64>,
    /// Its surface.
    pub shape: ViewShape,
}

/// Where two blocks touch.
#[derive(Clone, Debug)]
pub struct JointView {
    /// Index of the first block.
    pub a: usize,
    /// Index of the second block.
    pub b: usize,
    /// What touches what.
    pub kind: ContactKind,
    /// Unit normal from `a` into `b`.
    pub normal: Vector3<f64>,
    /// Contact points in order around the normal, m.
    pub points: Vec<Vector3<f64>>,
    /// Centroid of their hull, m.
    pub center: Vector3<f64>,
    /// Area that touches, m².
    pub area: f64,
    /// How it resists.
    pub law: JointLaw,
}

/// A load on a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewLoad {
    /// Index of the block.
    pub body: usize,
    /// Where it acts, m.
    pub at: Vector3<f64>,
    /// N.
    pub force: Vector3<f64>,
    /// Whether it is multiplied by λ.
    pub live: bool,
}

impl View {
    /// What there is to see of a result; `model` is that of its scene, `film` what was taken of its
    /// simulation.
    ///
    /// # Errors
    /// A certificate that does not belong to the scene.
    pub fn new(model: &Model, file: &ResultFile, film: Vec<Frame>) -> Result<Self, ViewError> {
        // What an earthquake pushes with, or a train presses with, is no load of the scene itself.
        let pushed = file
            .answer
            .kinematic()
            .and_then(|a| quake(&file.scene.input, model, Vector3::from(a.toward)).ok());
        let way =
            file.answer.moving().and_then(|_| model::train::Way::of(&file.scene.input, model));
        let moved = match (file.answer.moving(), &way) {
            (Some(a), Some(way)) => way.at(a.position()).map_err(|e| ViewError(e.to_string()))?,
            _ => None,
        };
        let model = pushed.as_ref().map_or(model, |q| &q.model);
        let model = moved.as_ref().map_or(model, |t| &t.model);
        let mut view = Self::bare(model);
        view.name.clone_from(&file.scene.name);
        if let Some(up) = tipped(view.up, file) {
            view.caption = format!("tilted by {}°", short(up.angle(&view.up).to_degrees()));
            view.up = up;
        }
        view.front = front(view.up, view.high - view.low);
        member::forces(&mut view.members, file);
        view.states = state::of(model, file).map_err(ViewError)?;
        view.motions = motion::of(model, file, &view.bodies).map_err(ViewError)?;
        if let Some(state) = file.answer.state() {
            view.pressures = pressure::of(model, state);
        }
        view.roads = road::of(&file.scene.input, model, file.answer.moving());
        view.film = film;
        if let Some(path) = &file.path {
            view.course = Course::of(path);
        }
        view.stage(model, file);
        view.removals(model, file);
        view.film.retain(|f| f.blocks.len() == view.bodies.len());
        if let Some(way) = &way {
            view.course = Course::train(file, way, &view.film);
        }
        Ok(view)
    }

    /// The frame that stands for a film where only one is drawn: the one it opens with.
    pub fn shown(&self) -> Option<&Frame> {
        self.course.opens.map_or(self.film.last(), |k| self.film.get(k))
    }

    /// Blocks, joints, loads and the forces of the answer.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn of_forces(model: &Model, file: &ResultFile) -> Result<Self, ViewError> {
        let states = state::of(model, file).map_err(ViewError)?;
        Ok(Self { states, ..Self::bare(model) })
    }

    /// Blocks, joints and loads alone.
    pub fn bare(model: &Model) -> Self {
        let assembly = &model.assembly;
        let bodies: Vec<BlockView> = assembly
            .blocks
            .iter()
            .map(|b| BlockView {
                id: b.id.clone(),
                support: b.support,
                material: b.material.clone(),
                mass: b.mass,
                volume: b.solid.volume(),
                center: b.centroid,
                inertia: b.inertia,
                shape: ViewShape::of(&b.solid),
            })
            .collect();
        let joints = model.interfaces.list.iter().map(|f| JointView {
            a: f.a,
            b: f.b,
            kind: f.kind,
            normal: f.frame.n,
            points: f.points.clone(),
            center: centroid(f),
            area: f.area,
            law: f.law,
        });
        let up = -assembly.gravity.normalize();
        let (low, high) = extent(&bodies);
        Self {
            name: assembly.name.clone(),
            up,
            caption: String::new(),
            ground: up,
            gravity: assembly.gravity.norm(),
            front: front(up, high - low),
            low,
            high,
            joints: joints.collect(),
            loads: loads(model),
            members: member::of(model),
            states: Vec::new(),
            pressures: Vec::new(),
            motions: Vec::new(),
            film: Vec::new(),
            course: Course::default(),
            values: None,
            slope: None,
            roads: Vec::new(),
            hides_supports: false,
            is_measured: false,
            bodies,
        }
    }

    /// The length by which drawings measure: the diagonal of the box to look at, m; 1 where there
    /// is nothing to see.
    pub fn size(&self) -> f64 {
        let size = (self.high - self.low).norm();
        if size.is_finite() && size > 0.0 { size } else { 1.0 }
    }

    /// The middle of that box, m.
    pub fn middle(&self) -> Vector3<f64> {
        (self.low + self.high) * 0.5
    }
}

/// The ground of a tilt as it is tipped when the answer says that it falls.
fn tipped(up: Vector3<f64>, file: &ResultFile) -> Option<Vector3<f64>> {
    match (file.question.kind(), file.answer.toward(), file.answer.bound().and_then(|b| b.value)) {
        (QuestionKind::Tilt, Some(toward), Some(tangent)) => {
            Some((up - Vector3::from(toward) * tangent).normalize())
        }
        _ => None,
    }
}

/// A support is shown as far as this × the extent of the free blocks; a ground slab as wide as one
/// likes would leave no room for them.
const AROUND: f64 = 0.15;

/// The box of the free blocks, grown towards supports that reach beyond it.
fn extent(bodies: &[BlockView]) -> (Vector3<f64>, Vector3<f64>) {
    let inf = Vector3::repeat(f64::INFINITY);
    let hull = |want: bool| {
        bodies
            .iter()
            .filter(|b| b.support == want)
            .map(BlockView::extent)
            .fold((inf, -inf), |(l, h), (bl, bh)| (l.inf(&bl), h.sup(&bh)))
    };
    let (free, held) = (hull(false), hull(true));
    if free.0.x > free.1.x {
        return if held.0.x > held.1.x { (Vector3::zeros(), Vector3::zeros()) } else { held };
    }
    let rim = Vector3::repeat(AROUND * (free.1 - free.0).norm());
    (free.0.inf(&held.0.sup(&(free.0 - rim))), free.1.sup(&held.1.inf(&(free.1 + rim))))
}

impl BlockView {
    /// Its bounding box.
    pub fn extent(&self) -> (Vector3<f64>, Vector3<f64>) {
        match &self.shape {
            ViewShape::Sphere(radius) => {
                (self.center.add_scalar(-radius), self.center.add_scalar(*radius))
            }
            ViewShape::Surface(s) => {
                let inf = Vector3::repeat(f64::INFINITY);
                s.corners.iter().fold((inf, -inf), |(l, h), p| (l.inf(p), h.sup(p)))
            }
        }
    }
}

/// The horizontal axis along which the scene is thinnest; −y where there is none, as one looks at
/// elevations.
fn front(up: Vector3<f64>, extent: Vector3<f64>) -> Vector3<f64> {
    let axes = [-Vector3::y(), Vector3::x(), -Vector3::z()];
    let level = axes.into_iter().filter(|a| a.dot(&up).abs() < 0.5);
    let thin = level
        .min_by(|a, b| a.dot(&extent).abs().total_cmp(&b.dot(&extent).abs()))
        .unwrap_or(axes[0]);
    (thin - up * up.dot(&thin)).normalize()
}

fn loads(model: &Model) -> Vec<ViewLoad> {
    let assembly = &model.assembly;
    let mut list = Vec::new();
    for (forces, live) in [(&assembly.dead_forces, false), (&assembly.live_forces, true)] {
        let at = |f: &AppliedForce| assembly.blocks[f.block].centroid + f.arm;
        // Each where it acts, however many there are on a block.
        list.extend(forces.iter().map(|f| ViewLoad {
            body: f.block,
            at: at(f),
            force: f.force,
            live,
        }));
        for i in assembly.free() {
            let elsewhere: Vec<f64> =
                forces.iter().filter(|f| f.block == i).map(|f| f.force.norm()).collect();
            let off: Vector3<f64> = forces.iter().filter(|f| f.block == i).map(|f| f.force).sum();
            let whole = if live {
                assembly.live[i].force
            } else {
                assembly.dead[i].force - assembly.self_weight(i).force
            };
            // Sums leave their rounding.
            let least = 1e-9
                * (elsewhere.iter().sum::<f64>() + if live { 0.0 } else { assembly.weight(i) });
            if (whole - off).norm() > least {
                list.push(ViewLoad {
                    body: i,
                    at: assembly.blocks[i].centroid,
                    force: whole - off,
                    live,
                });
            }
        }
    }
    list
}
