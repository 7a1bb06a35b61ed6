//! Blocks as surfaces.

use model::assembly::{Polyhedron, Solid};
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet};

/// The shape of a block, where it is in the scene.
#[derive(Clone, Debug)]
pub enum ViewShape {
    /// A closed surface of plane pieces.
    Surface(Surface),
    /// A sphere about the centre of mass, by its radius, m.
    Sphere(f64),
}

/// A closed surface of plane convex pieces.
#[derive(Clone, Debug, Default)]
pub struct Surface {
    /// Corners, m.
    pub corners: Vec<Vector3<f64>>,
    /// Pieces as loops of corners, counter-clockwise seen from outside.
    pub pieces: Vec<Vec<u32>>,
    /// Edges where the surface bends, each once.
    pub edges: Vec<[u32; 2]>,
    /// Centres and radii of the spheres that it stands for, m: of clumps.
    pub balls: Vec<(Vector3<f64>, f64)>,
}

impl ViewShape {
    /// The surface of a solid.
    pub fn of(solid: &Solid) -> Self {
        match solid {
            Solid::Sphere { radius, .. } => Self::Sphere(*radius),
            Solid::Polyhedron(p) => Self::Surface(Surface {
                corners: p.vertices.clone(),
                pieces: p.facets.iter().flat_map(|f| f.pieces.iter().cloned()).collect(),
                edges: edges(p),
                balls: Vec::new(),
            }),
            Solid::Clump { balls, .. } => {
                Self::Surface(balls.iter().fold(Surface::default(), |mut all, (center, radius)| {
                    all.add_ball(center, *radius);
                    all.balls.push((*center, *radius));
                    all
                }))
            }
        }
    }
}

/// Rings and meridians of a ball that is drawn as a surface.
const BALL: [u32; 2] = [8, 16];

impl Surface {
    /// A ball as plane pieces, without edges; balls that overlap are drawn one into the other.
    fn add_ball(&mut self, center: &Vector3<f64>, radius: f64) {
        use std::f64::consts::{PI, TAU};
        let [rings, around] = BALL;
        let first = self.corners.len() as u32;
        let at = |ring: u32, k: u32| first + 1 + (ring - 1) * around + k % around;
        let last = first + 1 + (rings - 1) * around;
        self.corners.push(center + Vector3::z() * radius);
        for ring in 1..rings {
            let (down, up) = (PI * f64::from(ring) / f64::from(rings)).sin_cos();
            for k in 0..around {
                let (y, x) = (TAU * f64::from(k) / f64::from(around)).sin_cos();
                self.corners.push(center + Vector3::new(x * down, y * down, up) * radius);
            }
        }
        self.corners.push(center - Vector3::z() * radius);
        for k in 0..around {
            self.pieces.push(vec![first, at(1, k), at(1, k + 1)]);
            for ring in 1..rings - 1 {
                self.pieces.push(vec![
                    at(ring, k),
                    at(ring + 1, k),
                    at(ring + 1, k + 1),
                    at(ring, k + 1),
                ]);
            }
            self.pieces.push(vec![last, at(rings - 1, k + 1), at(rings - 1, k)]);
        }
    }
}

/// Edges between facets: those that a facet has once. Cuts that divide a facet into pieces are no
/// edges.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Volume by the divergence theorem: that of a ball, from outside, and a little less.
    #[test]
    fn balls_of_a_clump_are_closed_and_face_outwards() {
        let balls = vec![(Vector3::new(1.0, 2.0, 3.0), 0.5), (Vector3::new(1.6, 2.0, 3.0), 0.4)];
        let ViewShape::Surface(s) =
            ViewShape::of(&Solid::Clump { balls: balls.clone(), volume: 1.0 })
        else {
            panic!()
        };
        let p = |i: u32| s.corners[i as usize];
        let volume: f64 = s
            .pieces
            .iter()
            .flat_map(|f| (2..f.len()).map(|k| p(f[0]).dot(&p(f[k - 1]).cross(&p(f[k]))) / 6.0))
            .sum();
        let round: f64 =
            balls.iter().map(|(_, r)| 4.0 / 3.0 * std::f64::consts::PI * r.powi(3)).sum();
        assert!(volume < round && volume > 0.9 * round, "{volume} {round}");
    }
}
