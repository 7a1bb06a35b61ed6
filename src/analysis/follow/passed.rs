//! Which poses of a capacity curve become points of it.

use super::point::{Path, Point};
use base::tolerance;
use model::assembly::Pose;

/// Load factors that were passed since the last point.
pub(super) struct Passed {
    /// The last point: parameter and load factor.
    from: (f64, f64),
    since: Vec<(f64, f64)>,
    /// The greatest load factor so far.
    greatest: f64,
}

/// A straight line between two points of the curve misses the load factors between them by no more
/// than this × the greatest one. Larger: charts have corners. Smaller: proofs of points that nobody
/// tells from their neighbours.
const BEND: f64 = 1e-3;
/// So many steps lie between two points at most. More: films jump.
const MOST: usize = 10;

/// Whether blocks have turned so far since the last point of a path that these poses have to be one,
/// for the two to be linked.
pub(super) fn turned_far(path: &Path, poses: &[Pose]) -> bool {
    let turn = |p: &Point| {
        let pairs = p.poses.iter().zip(poses);
        pairs.map(|(a, b)| a.turn.angle_to(&b.turn)).fold(0.0, f64::max)
    };
    path.points.last().is_some_and(|p| turn(p) > 0.5 * tolerance::LONGEST_TURN)
}

impl Passed {
    /// Nothing passed since this point.
    pub fn new(value: f64, load_factor: f64) -> Self {
        Self { from: (value, load_factor), since: Vec::new(), greatest: load_factor.abs() }
    }

    /// The next pose. True where one before it, the last that was passed, has to be a point: that is
    /// where the next line begins.
    pub fn go(&mut self, value: f64, load_factor: f64) -> bool {
        let (x, y) = self.from;
        let slope = (load_factor - y) / (value - x);
        let off = self.since.iter().map(|&(v, l)| (y + slope * (v - x) - l).abs());
        let bent = self.since.len() >= MOST || off.fold(0.0, f64::max) > BEND * self.greatest;
        if bent && let Some(last) = self.since.pop() {
            (self.from, self.since) = (last, Vec::new());
        }
        self.greatest = self.greatest.max(load_factor.abs());
        self.since.push((value, load_factor));
        bent
    }
}
