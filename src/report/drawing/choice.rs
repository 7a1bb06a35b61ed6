//! Which forces and which motion stand on a drawing: those of the answer that is told first.

use super::body::{Displacement, Solid, posed};
use crate::view::{BlockView, Mark, View, ViewMotion, ViewPart, ViewPose, ViewShape, ViewState};
use base::{number::short, tolerance::MECHANISM_REST};
use nalgebra::Vector3;

/// The greatest way of a corner that is shown of a mechanism, over the size of the structure.
const WAY: f64 = 0.07;
/// The least: a pebble that turns must not hide how the wall moves.
const LEAST_WAY: f64 = 0.02;
/// The greatest turn that is shown, radians, as long as the way is not the least.
const TURN: f64 = 0.2;
/// Blocks that turn by less are moved to first order, so that hinges between them stay closed
/// exactly; they are 1 / cos θ too large, by 3 % at most. Blocks that turn by more are moved along
/// their screw.
const FIRST_ORDER: f64 = 0.25;
/// A block counts as moved in time beyond this × the size of the structure. Larger: slow slides
/// look like rest. Smaller: the engine's contacts, which give way by 1e-4 of a block, do.
const MOVED: f64 = 1e-4;

/// What is drawn.
pub struct Choice<'a> {
    /// One system of forces, or two that enclose all others.
    pub states: Vec<&'a ViewState>,
    /// How it moves.
    pub movement: Option<Movement>,
}

/// A motion at the size at which it is drawn.
pub struct Movement {
    /// What it is.
    pub name: String,
    /// Where each block goes.
    pub displacements: Vec<Displacement>,
    /// Whether it moves.
    pub moves: Vec<bool>,
    /// Joints that move.
    pub marks: Vec<Mark>,
    /// How fast, or how far, each block goes.
    speeds: Vec<Vector3<f64>>,
}

/// How far the fastest corner of a mechanism is shown to go, m.
pub fn sized(view: &View, motion: &ViewMotion) -> f64 {
    // Of balls nobody sees how they turn.
    let angular = view
        .bodies
        .iter()
        .zip(&motion.rates)
        .filter(|(b, _)| !matches!(b.shape, ViewShape::Sphere(_)));
    let spin = angular.map(|(_, r)| r.spin.norm()).fold(0.0, f64::max);
    let far = (WAY * view.size()).min(TURN * motion.reach / spin).max(LEAST_WAY * view.size());
    if motion.is_displacement { round(far / motion.reach) * motion.reach } else { far }
}

/// The next 1, 2 or 5 × a power of ten below.
fn round(by: f64) -> f64 {
    let ten = 10f64.powf(by.log10().floor());
    ten * [5.0, 2.0].into_iter().find(|k| k * ten <= by).unwrap_or(1.0)
}

impl<'a> Choice<'a> {
    /// What is drawn of a view.
    pub fn of(view: &'a View) -> Self {
        let state = |part: ViewPart| view.states.iter().find(|s| s.part == part);
        let ends: Vec<&ViewState> =
            [ViewPart::Least, ViewPart::Greatest].into_iter().filter_map(state).collect();
        let mut states = if ends.is_empty() {
            state(ViewPart::Dry).or(state(ViewPart::Answer)).into_iter().collect()
        } else {
            ends
        };
        let motion = |part: ViewPart| view.motions.iter().find(|m| m.part == part);
        let fails = motion(ViewPart::Dry).or(motion(ViewPart::Answer));
        // What comes closest balances nothing, and a motion without a load factor proves that
        // nothing does.
        if fails.is_some() && !states.iter().any(|s| s.balances) {
            states.clear();
        }
        let movement = match (view.shown(), fails) {
            (Some(_), _) => Movement::in_time(view),
            (None, Some(motion)) => Movement::mechanism(view, motion),
            (None, None) => None,
        };
        Self { states, movement }
    }
}

impl Movement {
    fn mechanism(view: &View, motion: &ViewMotion) -> Option<Self> {
        let far = sized(view, motion);
        let by = far / motion.reach;
        let way = |i: usize| {
            let rate = &motion.rates[i];
            if rate.spin.norm() * by <= FIRST_ORDER {
                Displacement { shift: rate.velocity * by, turn: rate.spin.cross_matrix() * by }
            } else {
                Displacement::rigid(&motion.pose(i, far))
            }
        };
        let displacements: Vec<Displacement> = (0..view.bodies.len()).map(way).collect();
        let moves = view
            .bodies
            .iter()
            .zip(&displacements)
            .map(|(b, w)| w.length(b.radius()) > MECHANISM_REST * far)
            .collect();
        let speeds = motion.rates.iter().map(|r| r.velocity).collect();
        Some(Self {
            name: if motion.is_displacement {
                format!("{} × {}", motion.name, short(by))
            } else {
                motion.name.clone()
            },
            displacements,
            moves,
            marks: motion.marks.clone(),
            speeds,
        })
    }

    fn in_time(view: &View) -> Option<Self> {
        // Stages come and go and do not move.
        let frame = view.shown().filter(|_| view.course.words.is_empty())?;
        let poses = || view.bodies.iter().zip(&frame.blocks);
        let displacements = |by: f64| -> Vec<Displacement> {
            let pose = |(b, p): (&BlockView, &dynamics::Pose)| ViewPose {
                shift: (p.center - b.center) * by,
                turn: p.turn.powf(by),
            };
            poses().map(|bp| Displacement::rigid(&pose(bp))).collect()
        };
        let once = displacements(1.0);
        let lengths: Vec<f64> = view
            .bodies
            .iter()
            .zip(&once)
            .map(|(b, w)| if b.support { 0.0 } else { w.length(b.radius()) })
            .collect();
        let greatest = lengths.iter().copied().fold(0.0, f64::max);
        // A block that has only begun to fall has hardly moved.
        let by = (WAY * view.size() / greatest).floor();
        let (displacements, times) = match by {
            by if greatest > MOVED * view.size() && by >= 2.0 => {
                (displacements(by), format!(", motion × {by}"))
            }
            _ => (once, String::new()),
        };
        let moves = lengths.iter().map(|l| *l > MOVED * view.size()).collect();
        let speeds = displacements.iter().map(|w| w.shift).collect();
        Some(Self {
            name: format!(
                "{}{}{times}",
                view.course.at(frame.time),
                view.course.label(frame, &view.film)
            ),
            displacements,
            moves,
            marks: Vec::new(),
            speeds,
        })
    }

    /// Bodies where they go.
    pub fn bodies<'a>(&self, view: &'a View) -> Vec<Solid<'a>> {
        view.bodies.iter().zip(&self.displacements).map(|(b, w)| posed(b, w)).collect()
    }

    /// Whether nothing moves along an axis.
    pub fn stays_across(&self, axis: &Vector3<f64>, near: f64) -> bool {
        let fastest = self.speeds.iter().map(|v| v.norm()).fold(0.0, f64::max);
        self.speeds.iter().all(|v| axis.dot(v).abs() <= near * fastest)
    }
}
