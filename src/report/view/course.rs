//! Paths of `settle` and `push` as films: one frame a point of the curve.

use super::ViewLoad;
use base::number::{seconds, short};
use check::{
    path::saved::read_poses,
    proof::{
        path::{DrivenBy, PathResult},
        result::ResultFile,
    },
};
use dynamics::{Fidelity, Frame, Pose};
use model::interface::Model;
use nalgebra::Vector3;

/// What a film goes along.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// What it shows.
    pub name: String,
    /// What the frames are numbered by.
    pub quantity: &'static str,
    /// The unit of that; may be empty.
    pub unit: &'static str,
    /// How far blocks have come in it, in words.
    pub way: &'static str,
    /// The frame that the answer is about, which is shown first; the last where none is said.
    pub opens: Option<usize>,
    /// What stands beside the number of each frame: the answer there. Empty where there is none.
    pub labels: Vec<String>,
    /// The loads of each frame, where they move; else empty.
    pub loads: Vec<Vec<ViewLoad>>,
    /// Of stages: what each frame is; else empty.
    pub words: Vec<String>,
    /// Of stages: blocks that are not there, frame by frame; else empty.
    pub hidden: Vec<Vec<bool>>,
}

/// What the frames of a simulation are numbered by.
const TIME: &str = "Time";

impl Default for Course {
    fn default() -> Self {
        Self {
            name: "simulation".into(),
            quantity: TIME,
            unit: "s",
            way: "displacement in the simulation",
            opens: None,
            labels: Vec::new(),
            loads: Vec::new(),
            words: Vec::new(),
            hidden: Vec::new(),
        }
    }
}

impl Course {
    /// A frame in words, by its number.
    pub fn at(&self, value: f64) -> String {
        match (self.quantity, self.unit) {
            (TIME, _) => format!("after {}", seconds(value)),
            (what, "") => format!("{what} {}", short(value)),
            (what, unit) => format!("{what} {} {unit}", short(value)),
        }
    }

    /// The answer at a frame, to stand behind its number.
    pub fn label(&self, frame: &Frame, film: &[Frame]) -> String {
        let found = film.iter().position(|f| f.time == frame.time);
        match found.and_then(|k| self.labels.get(k)).filter(|l| !l.is_empty()) {
            Some(label) => format!(", {label}"),
            None => String::new(),
        }
    }

    /// That of a path.
    pub fn of(path: &PathResult) -> Self {
        let (quantity, unit) = match path.driven_by {
            DrivenBy::Supports(_) => ("Share of the imposed movement", ""),
            DrivenBy::Control { .. } => ("Displacement of the control point", "m"),
        };
        Self {
            name: "path, point by point".into(),
            quantity,
            unit,
            way: "displacement along the path",
            ..Self::default()
        }
    }
}

/// The points of a path as frames, the one where it falls at the end; none where there is no path,
/// or its poses are not those of the scene.
pub fn frames(model: &Model, file: &ResultFile) -> Vec<Frame> {
    let Some(path) = &file.path else { return Vec::new() };
    let blocks = &model.assembly.blocks;
    let frame = |p: &check::proof::path::PathPoint| {
        let poses = read_poses(&model.assembly, &p.poses).ok()?;
        let pose = |(pose, b): (&model::assembly::Pose, &model::assembly::Block)| Pose {
            center: b.centroid + pose.shift,
            turn: pose.turn,
            velocity: Vector3::zeros(),
            spin: Vector3::zeros(),
        };
        Some(Frame {
            time: p.value,
            fidelity: Fidelity::Fine,
            relative: 0.0,
            energy: 0.0,
            blocks: poses.iter().zip(blocks).map(pose).collect(),
        })
    };
    let points = path.points.iter().chain(path.ends.last());
    points.map(frame).collect::<Option<_>>().unwrap_or_default()
}
