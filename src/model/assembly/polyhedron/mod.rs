//! A closed polyhedron: facets, volume, centroid, inertia.
//!
//! [`Polyhedron::from_faces`] takes what a file gives and either mends it, saying how ([`Mend`]),
//! or refuses it, saying where and why ([`ShapeError`]). The stages, one file each: weld corners,
//! split edges, orient faces, join coplanar faces to facets, weigh, test for overlap. All of them
//! work in coordinates about the centre of the bounding box, so that a block far from the origin
//! loses no digits.

mod back;
mod check;
mod convex;
mod double;
mod facets;
mod mass;
mod message;
mod orient;
mod outline;
mod overlap;
mod plane;
mod shape;
mod split;
mod surface;
mod weld;

pub use mass::MassProperties;
pub use message::{Mend, ShapeError};
pub use shape::{Facet, Polyhedron};

use nalgebra::Vector3;

impl Polyhedron {
    /// A polyhedron from corners (m) and faces, each a loop of vertex indices, ideally
    /// counter-clockwise seen from outside.
    ///
    /// Faces need not be convex, triangulated or plane; a face with a hole may come in parts or as
    /// one loop with a bridge to the hole. What was mended on the way is returned beside the
    /// polyhedron.
    ///
    /// # Errors
    /// A surface that encloses no definite volume: open, flat, one-sided, cutting through itself,
    /// or with unusable numbers.
    pub fn from_faces(
        vertices: Vec<Vector3<f64>>,
        faces: &[Vec<usize>],
    ) -> Result<(Self, Vec<Mend>), ShapeError> {
        let mut mends = Vec::new();
        let (mut surface, vertices) = weld::weld(vertices, faces, &mut mends)?;
        check::refuse_plane(&surface)?;
        let edges = split::split_edges(&mut surface, &mut mends);
        let edges = double::take_once(&mut surface, edges, &mut mends);
        check::refuse_crossed(&surface)?;
        check::refuse_folded(&surface)?;
        let shells = orient::orient(&mut surface, &edges, &mut mends)?;
        let mass = mass::mass_properties(&surface);
        let regions = facets::regions(&surface, &edges, &mut mends);
        facets::refuse_flat(&surface, &regions, mass.volume)?;
        let convex = shells == 1 && convex::is_convex(&surface, &regions);
        if !convex {
            overlap::refuse_overlap(&surface, &regions)?;
        }
        let solid = facets::assemble(&surface, vertices, regions, convex, mass);
        // Last, for it names no place.
        mass::refuse_impossible(&surface, &solid.mass, &solid.vertices)?;
        Ok((solid, mends))
    }
}

#[cfg(test)]
mod tests;
