//! A polyhedron and its facets.

use super::mass::MassProperties;
use nalgebra::Vector3;

/// A closed polyhedron in scene coordinates, faces outward.
#[derive(Clone, Debug)]
pub struct Polyhedron {
    /// Corners, m.
    pub vertices: Vec<Vector3<f64>>,
    /// Maximal plane facets. Coplanar faces joined by an edge are one facet, so that nothing
    /// depends on how a face was triangulated.
    pub facets: Vec<Facet>,
    /// Whether the polyhedron is convex.
    pub convex: bool,
    /// Of the surface as given; joining facets straightens edges within tolerance and would lose
    /// digits.
    pub(in crate::assembly) mass: MassProperties,
}

/// A plane facet, possibly non-convex or with holes: a union of convex pieces that overlap at most
/// along edges.
#[derive(Clone, Debug)]
pub struct Facet {
    /// Outward unit normal.
    pub normal: Vector3<f64>,
    /// The plane is `normal · x = offset`, m.
    pub offset: f64,
    /// Convex pieces as loops of vertex indices, counter-clockwise seen from outside; one piece
    /// where the facet is convex.
    pub pieces: Vec<Vec<u32>>,
    /// Area, m².
    pub area: f64,
    /// Largest distance of a corner from the plane, m (0 for a plane face; larger for a warped
    /// quadrilateral).
    pub warp: f64,
}

/// Bodies of at most so many facets are tried as separators ([`Polyhedron::is_apart_from`]).
const FEW_FACETS: usize = 32;

impl Polyhedron {
    /// Whether a plane along one of this body's facets keeps another further than `distance` (m)
    /// away: then all of it is. Leaning slabs, whose boxes reach across many neighbours, are told
    /// apart by their large faces. Bodies of many small facets are not tried: it would cost more
    /// than it saves.
    pub fn is_apart_from(&self, other: &Self, distance: f64) -> bool {
        self.facets.len() <= FEW_FACETS
            && self.facets.iter().any(|facet| {
                let own = self
                    .vertices
                    .iter()
                    .map(|v| facet.normal.dot(v))
                    .fold(f64::NEG_INFINITY, f64::max);
                other.vertices.iter().all(|v| facet.normal.dot(v) > own + distance)
            })
    }

    /// Volume, centroid and inertia for unit density.
    pub fn mass_properties(&self) -> MassProperties {
        self.mass
    }

    /// The corners of a piece of a facet, in order.
    pub fn points<'a>(
        &'a self,
        piece: &'a [u32],
    ) -> impl ExactSizeIterator<Item = Vector3<f64>> + Clone + 'a {
        piece.iter().map(|&v| self.vertices[v as usize])
    }

    /// The corners of a facet, each once; in order around the normal where the facet is one piece.
    pub fn facet_vertices(&self, facet: &Facet) -> Vec<Vector3<f64>> {
        if let [piece] = facet.pieces.as_slice() {
            return self.points(piece).collect();
        }
        let mut corners: Vec<u32> = facet.pieces.concat();
        corners.sort_unstable();
        corners.dedup();
        self.points(&corners).collect()
    }
}
