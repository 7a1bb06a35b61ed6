//! A closed polyhedron: facets, volume, centroid, inertia.

use nalgebra::Vector3;

/// A closed polyhedron in scene coordinates, faces outward.
#[derive(Clone, Debug)]
pub struct Polyhedron {
    /// Corners, m.
    pub vertices: Vec<Vector3<f64>>,
    /// Maximal plane facets. Coplanar faces joined by an edge are one facet, so that nothing depends on how a face was triangulated.
    pub facets: Vec<Facet>,
    /// Whether the polyhedron is convex.
    pub convex: bool,
}

/// A plane facet, possibly non-convex or with holes: a union of convex pieces that overlap at most along edges.
#[derive(Clone, Debug)]
pub struct Facet {
    /// Outward unit normal.
    pub normal: Vector3<f64>,
    /// The plane is `normal · x = offset`, m.
    pub offset: f64,
    /// Convex pieces as loops of vertex indices, counter-clockwise seen from outside; one piece where the facet is convex.
    pub pieces: Vec<Vec<u32>>,
    /// Area, m².
    pub area: f64,
    /// Largest distance of a corner from the plane, m (0 for a plane face; larger for a warped quadrilateral).
    pub warp: f64,
}
