//! Blocks as surfaces.

use crate::assembly::{Polyhedron, Solid};
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet};

/// The shape of a block, where it is in the scene.
#[derive(Clone, Debug)]
pub enum Shape {
    /// A closed surface of plane pieces.
    Surface(Surface),
    /// A sphere about the centre of mass, by its radius, m.
    Sphere(f64),
}

/// A closed surface of plane convex pieces.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Corners, m.
    pub corners: Vec<Vector3<f64>>,
    /// Pieces as loops of corners, counter-clockwise seen from outside.
    pub pieces: Vec<Vec<u32>>,
    /// Edges where the surface bends, each once.
    pub edges: Vec<[u32; 2]>,
}

impl Shape {
    /// The surface of a solid.
    pub fn of(solid: &Solid) -> Self {
        match solid {
            Solid::Sphere { radius, .. } => Self::Sphere(*radius),
            Solid::Polyhedron(p) => Self::Surface(Surface {
                corners: p.vertices.clone(),
                pieces: p.facets.iter().flat_map(|f| f.pieces.iter().cloned()).collect(),
                edges: edges(p),
            }),
        }
    }
}

/// Edges between facets: those that a facet has once. Cuts that divide a facet into pieces are no edges.
fn edges(p: &Polyhedron) -> Vec<[u32; 2]> {
    let mut all = BTreeSet::new();
    for facet in &p.facets {
        let mut own: BTreeMap<[u32; 2], usize> = BTreeMap::new();
        for piece in &facet.pieces {
            for (k, &i) in piece.iter().enumerate() {
                let j = piece[(k + 1) % piece.len()];
                *own.entry([i.min(j), i.max(j)]).or_default() += 1;
            }
        }
        all.extend(own.into_iter().filter(|(_, n)| *n == 1).map(|(edge, _)| edge));
    }
    all.into_iter().collect()
}
