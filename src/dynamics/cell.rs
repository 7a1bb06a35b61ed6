//! A convex cell: cutting it by planes, eroding it.

use base::plane::clip::inside;
use nalgebra::{Matrix3, Vector3};

/// Points closer to a plane than this × the cell's reach lie on it, and points this close are one.
/// Larger: thin pieces lose their thickness. Smaller: cuts through existing corners leave slivers.
const ON: f64 = 1e-9;

/// A corner moves by at most this many times the erosion: at a needle-sharp corner the faces are
/// left a little further out.
const SHARPEST: f64 = 30.0;

/// A convex polyhedron as the faces around it.
#[derive(Clone, Debug)]
pub(super) struct Cell {
    pub faces: Vec<Face>,
}

/// A face of a cell, counter-clockwise seen from outside.
#[derive(Clone, Debug)]
pub(super) struct Face {
    /// Outward unit normal.
    pub normal: Vector3<f64>,
    pub points: Vec<Vector3<f64>>,
    /// A cut inside the block: nothing outside it ever touches this face.
    pub inner: bool,
}

impl Face {
    /// A face around points, its normal by Newell's formula.
    pub fn around(points: Vec<Vector3<f64>>, inner: bool) -> Option<Self> {
        let first = *points.first()?;
        let area: Vector3<f64> =
            points.windows(2).map(|p| (p[0] - first).cross(&(p[1] - first))).sum();
        Some(Self { normal: area.try_normalize(0.0)?, points, inner })
    }

    pub fn middle(&self) -> Vector3<f64> {
        mean(&self.points)
    }
}

pub(super) fn mean(points: &[Vector3<f64>]) -> Vector3<f64> {
    points.iter().sum::<Vector3<f64>>() / points.len().max(1) as f64
}

impl Cell {
    /// A box between two corners.
    pub fn cuboid(low: Vector3<f64>, high: Vector3<f64>) -> Self {
        let corner = |k: usize| {
            Vector3::from_fn(|axis, _| if k >> axis & 1 == 1 { high[axis] } else { low[axis] })
        };
        let loops =
            [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        Self {
            faces: loops
                .iter()
                .filter_map(|l| Face::around(l.iter().map(|&k| corner(k)).collect(), false))
                .collect(),
        }
    }

    /// Largest distance of a corner from the origin: the scale of rounding.
    fn reach(&self) -> f64 {
        self.faces.iter().flat_map(|f| &f.points).map(|p| p.norm()).fold(0.0, f64::max)
    }

    /// The mean of the faces' middles, which lies inside.
    pub fn middle(&self) -> Vector3<f64> {
        mean(&self.faces.iter().map(Face::middle).collect::<Vec<_>>())
    }

    /// Cuts by the plane `normal · x = offset`: the part below and the part above. `inner` marks
    /// the cut.
    pub fn cut(
        &self,
        normal: Vector3<f64>,
        offset: f64,
        inner: bool,
    ) -> (Option<Self>, Option<Self>) {
        (self.below(normal, offset, inner), self.below(-normal, -offset, inner))
    }

    fn below(&self, normal: Vector3<f64>, offset: f64, inner: bool) -> Option<Self> {
        let on = ON * self.reach();
        let height = |p: &Vector3<f64>| normal.dot(p) - offset;
        let heights = || self.faces.iter().flat_map(|f| &f.points).map(height);
        if heights().all(|h| h >= -on) {
            return None;
        }
        if heights().all(|h| h <= on) {
            return Some(self.clone());
        }
        let mut faces = Vec::with_capacity(self.faces.len() + 1);
        let mut rim = Vec::new();
        for face in &self.faces {
            let points = inside(&face.points, |p| -height(p), on);
            rim.extend(points.iter().filter(|p| height(p).abs() <= on));
            if points.len() >= 3 && points.iter().any(|p| height(p) < -on) {
                faces.push(Face { points, ..face.clone() });
            }
        }
        let cap = around(rim, normal, 2.0 * on);
        if cap.len() >= 3 {
            faces.push(Face { normal, points: cap, inner });
        }
        (faces.len() >= 4).then_some(Self { faces })
    }

    /// Corners, each once, and the faces as loops of their indices.
    pub fn mesh(&self) -> (Vec<Vector3<f64>>, Vec<Vec<usize>>) {
        let weld = 4.0 * ON * self.reach();
        let mut corners: Vec<Vector3<f64>> = Vec::new();
        let mut index = |p: &Vector3<f64>| {
            corners.iter().position(|c| (c - p).norm() <= weld).unwrap_or_else(|| {
                corners.push(*p);
                corners.len() - 1
            })
        };
        let loops = self.faces.iter().map(|f| {
            let mut corners: Vec<usize> = f.points.iter().map(&mut index).collect();
            corners.dedup();
            if corners.len() > 1 && corners.first() == corners.last() {
                corners.pop();
            }
            corners
        });
        let loops: Vec<_> = loops.collect();
        (corners, loops)
    }

    /// The same cell with every face moved inward by `depth`.
    ///
    /// A corner moves to where its moved faces meet, in the sense of least squares where they are
    /// more than three.
    pub fn eroded(&self, depth: f64) -> (Vec<Vector3<f64>>, Vec<Vec<usize>>) {
        let (mut corners, loops) = self.mesh();
        let mut squares = vec![(Matrix3::zeros(), Vector3::zeros()); corners.len()];
        for (face, corners) in self.faces.iter().zip(&loops) {
            for &c in corners {
                squares[c].0 += face.normal * face.normal.transpose();
                squares[c].1 -= face.normal * depth;
            }
        }
        for (corner, (square, right)) in corners.iter_mut().zip(squares) {
            let way = square.try_inverse().map_or(right, |inverse| inverse * right);
            *corner += way.cap_magnitude(SHARPEST * depth);
        }
        (corners, loops)
    }
}

/// Points in a plane in order around its normal, each once.
fn around(points: Vec<Vector3<f64>>, normal: Vector3<f64>, weld: f64) -> Vec<Vector3<f64>> {
    let mut single: Vec<Vector3<f64>> = Vec::new();
    for p in points {
        if single.iter().all(|q| (p - q).norm() > weld) {
            single.push(p);
        }
    }
    let middle = mean(&single);
    let Some(axis) = single.iter().map(|p| p - middle).find_map(|d| d.try_normalize(weld)) else {
        return Vec::new();
    };
    let side = normal.cross(&axis);
    let angle = |p: &Vector3<f64>| side.dot(&(p - middle)).atan2(axis.dot(&(p - middle)));
    single.sort_by(|p, q| angle(p).total_cmp(&angle(q)));
    single
}
