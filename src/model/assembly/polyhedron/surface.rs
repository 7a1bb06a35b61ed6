//! A surface on its way from the file to a [`Polyhedron`](super::Polyhedron).

use nalgebra::Vector3;

/// Faces over welded corners.
pub(super) struct Surface {
    /// Corners relative to the centre of the bounding box, m.
    pub points: Vec<Vector3<f64>>,
    /// The centre of the bounding box, m.
    pub center: Vector3<f64>,
    /// Diagonal of the bounding box, m.
    pub size: f64,
    /// The faces.
    pub faces: Vec<Face>,
}

/// A face: a loop of corners.
pub(super) struct Face {
    /// Indices of the corners in order.
    pub corners: Vec<u32>,
    /// Index of the face in the file, for messages.
    pub source: usize,
}

/// One side of an edge, as a face runs along it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct HalfEdge {
    /// The smaller index of the two corners.
    pub low: u32,
    /// The larger one.
    pub high: u32,
    /// Index of the face.
    pub face: u32,
    /// Whether the face runs from `low` to `high`.
    pub forward: bool,
}

impl Surface {
    pub fn point(&self, corner: u32) -> Vector3<f64> {
        self.points[corner as usize]
    }

    /// A corner in scene coordinates, for messages.
    pub fn place(&self, corner: u32) -> [f64; 3] {
        (self.point(corner) + self.center).into()
    }

    /// All half-edges, those of one edge next to each other.
    pub fn half_edges(&self) -> Vec<HalfEdge> {
        let mut list = Vec::with_capacity(self.faces.iter().map(|f| f.corners.len()).sum());
        for (face, f) in self.faces.iter().enumerate() {
            for (from, to) in f.edges() {
                list.push(HalfEdge {
                    low: from.min(to),
                    high: from.max(to),
                    face: face as u32,
                    forward: from < to,
                });
            }
        }
        list.sort_unstable();
        list
    }

    /// Newell's area vector (Sutherland, Sproull & Schumacker 1974): normal × area of the face, for
    /// a warped one of its shadow on the plane where the shadow is largest.
    pub fn area_vector(&self, face: &Face) -> Vector3<f64> {
        let origin = self.point(face.corners[0]);
        let mut sum = Vector3::zeros();
        for pair in face.corners[1..].windows(2) {
            sum += (self.point(pair[0]) - origin).cross(&(self.point(pair[1]) - origin));
        }
        sum / 2.0
    }

    /// Calls `visit` with the corners of triangles that fill the face.
    ///
    /// A face with more than three corners is fanned about the mean of its corners: signed, so
    /// exact for any plane polygon, and for a warped one the same whichever way round and from
    /// whichever corner the loop is written, so that neighbours sharing it agree.
    pub fn fan(
        &self,
        face: &Face,
        mut visit: impl FnMut(Vector3<f64>, Vector3<f64>, Vector3<f64>),
    ) {
        if let [a, b, c] = face.corners[..] {
            return visit(self.point(a), self.point(b), self.point(c));
        }
        let mean = face.corners.iter().map(|&c| self.point(c)).sum::<Vector3<f64>>()
            / face.corners.len() as f64;
        for (from, to) in face.edges() {
            visit(mean, self.point(from), self.point(to));
        }
    }
}

impl Face {
    /// The edges in order, the closing one last.
    pub fn edges(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        let n = self.corners.len();
        (0..n).map(move |i| (self.corners[i], self.corners[if i + 1 == n { 0 } else { i + 1 }]))
    }
}

/// The edges in a sorted list of half-edges, each with all the faces along it.
pub(super) fn edges(list: &[HalfEdge]) -> impl Iterator<Item = &[HalfEdge]> {
    list.chunk_by(|a, b| (a.low, a.high) == (b.low, b.high))
}
