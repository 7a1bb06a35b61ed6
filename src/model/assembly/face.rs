//! Faces of a block by what they are called.

use super::{Block, Solid, member::BlockFace};
use nalgebra::Vector3;

/// Facets that look this much less along a direction than the best of them belong to the same face
/// (a difference of cosines). Larger: joints count. Smaller: an extrados of several chords falls
/// apart.
const ALIKE: f64 = 0.2;

impl Block {
    /// The face that looks most along a direction; of a curved side all its chords. `None` where
    /// the block has no plane faces.
    pub fn face_towards(&self, direction: &Vector3<f64>) -> Option<BlockFace> {
        let Solid::Polyhedron(p) = &self.solid else { return None };
        let along = |f: &super::Facet| f.normal.dot(direction);
        let most = p.facets.iter().map(along).fold(f64::NEG_INFINITY, f64::max);
        self.face_of(|f| along(f) >= most - ALIKE)
    }

    /// The face nearest to a point; `None` where the block has no plane faces.
    pub fn face_near(&self, point: &Vector3<f64>) -> Option<BlockFace> {
        let Solid::Polyhedron(p) = &self.solid else { return None };
        let distance = |f: &super::Facet| {
            let (centroid, _) = middle(&p.facet_vertices(f), &f.normal);
            // Of faces whose planes hold the point the one whose middle is nearest.
            let off = (f.normal.dot(point) - f.offset).abs();
            (if off <= 1e-9 * self.size { 0.0 } else { off }, (centroid - point).norm())
        };
        let nearest = p
            .facets
            .iter()
            .map(distance)
            .reduce(|a, b| if b.0 < a.0 || (b.0 == a.0 && b.1 < a.1) { b } else { a })?;
        self.face_of(|f| distance(f) == nearest)
    }

    fn face_of(&self, which: impl Fn(&super::Facet) -> bool) -> Option<BlockFace> {
        let Solid::Polyhedron(p) = &self.solid else { return None };
        let (mut normal, mut moment, mut area) = (Vector3::zeros(), Vector3::zeros(), 0.0);
        let (mut facets, mut corners) = (Vec::new(), Vec::new());
        for facet in p.facets.iter().filter(|f| which(f)) {
            let own = p.facet_vertices(facet);
            for piece in &facet.pieces {
                let (centroid, size) = middle(&p.points(piece).collect::<Vec<_>>(), &facet.normal);
                moment += centroid * size;
                area += size;
            }
            normal += facet.normal * facet.area;
            facets.push((facet.normal, facet.area));
            corners.extend(own);
        }
        (area > 0.0 && normal.norm() > 0.0).then(|| BlockFace {
            normal: normal.normalize(),
            centroid: moment / area,
            facets,
            corners,
        })
    }
}

/// Centroid and area of a convex loop around a normal.
fn middle(rim: &[Vector3<f64>], normal: &Vector3<f64>) -> (Vector3<f64>, f64) {
    let (mut area, mut moment) = (0.0, Vector3::zeros());
    for w in rim.windows(2).skip(1) {
        let own = 0.5 * normal.dot(&(w[0] - rim[0]).cross(&(w[1] - rim[0])));
        area += own;
        moment += (rim[0] + w[0] + w[1]) * (own / 3.0);
    }
    if area > 0.0 {
        (moment / area, area)
    } else {
        (rim.iter().sum::<Vector3<f64>>() / rim.len().max(1) as f64, 0.0)
    }
}
