//! The shapes of grains. Whatever its shape, a grain of radius R has the volume of the sphere of
//! radius R.
//!
//! * *Clump*: two equal spheres of radius ρ, centres `2 ρ (e − 1)` apart, so that length over width
//!   is the elongation e. Sphere, sphere less lens: `V = π ρ³ (8/3 − 2/3 (1 + e) (2 − e)²)`.
//! * *Hull*: the convex hull of points at random, and not too close to each other, on an ellipsoid
//!   with the axes `1 : m : e`, m between 1 and e at random.
//!
//! Clumps and hulls lie turned at random, evenly over all orientations (Shoemake 1992).
//!
//! * K. Shoemake, *Uniform random rotations*, Graphics Gems III, 1992.

use super::{hull::hull, random::Random};
use crate::{Ball, GrainKind, Protocol, Rotation, Shape};
use std::f64::consts::{PI, TAU};

/// Tries for a point of a hull.
const TRIES: usize = 200;
/// Least distance of two points on the sphere before it is stretched, over that of as many points
/// spread evenly. Larger: hulls look alike. Smaller: needles among the faces.
const APART: f64 = 0.5;

/// A shape of unit radius with an orientation.
pub struct Grain {
    shape: Shape,
    rotation: Option<Rotation>,
    /// The farthest point from the middle, over the radius of the sphere of the same volume.
    pub reach: f64,
}

impl Grain {
    /// A grain of this kind.
    pub fn new(protocol: &Protocol, random: &mut Random) -> Self {
        let e = protocol.elongation;
        match protocol.grain {
            GrainKind::Sphere => {
                Self { shape: Shape::Sphere { radius: 1.0 }, rotation: None, reach: 1.0 }
            }
            GrainKind::Clump => {
                let volume = 8.0 / 3.0 - 2.0 / 3.0 * (1.0 + e) * (2.0 - e).powi(2);
                let radius = (4.0 / 3.0 / volume).cbrt();
                let spheres = [-1.0, 1.0]
                    .map(|side| Ball { at: [0.0, 0.0, side * radius * (e - 1.0)], radius })
                    .to_vec();
                Self {
                    shape: Shape::Clump { spheres },
                    rotation: Some(turn(random)),
                    reach: radius * e,
                }
            }
            GrainKind::Hull => {
                let axes = [1.0, random.between(1.0, e), e];
                // Four points in a plane have no hull; other ones have.
                let hull = std::iter::repeat_with(|| hull(&points(protocol.corners, axes, random)))
                    .take(TRIES)
                    .flatten()
                    .next();
                let rotation = Some(turn(random));
                let Some(hull) = hull else {
                    return Self {
                        shape: Shape::Sphere { radius: 1.0 },
                        rotation: None,
                        reach: 1.0,
                    };
                };
                let scale = (4.0 / 3.0 * PI / hull.volume).cbrt();
                let vertices: Vec<[f64; 3]> =
                    hull.vertices.iter().map(|v| v.map(|c| c * scale)).collect();
                let reach = vertices
                    .iter()
                    .map(|v| v.iter().map(|c| c * c).sum::<f64>().sqrt())
                    .fold(0.0, f64::max);
                Self { shape: Shape::Polyhedron { vertices, faces: hull.faces }, rotation, reach }
            }
        }
    }

    /// The shape at this radius, and how it lies.
    pub fn of_radius(&self, radius: f64) -> (Shape, Option<Rotation>) {
        let scaled = |p: &[f64; 3]| p.map(|c| c * radius);
        let shape = match &self.shape {
            Shape::Clump { spheres } => Shape::Clump {
                spheres: spheres
                    .iter()
                    .map(|b| Ball { at: scaled(&b.at), radius: b.radius * radius })
                    .collect(),
            },
            Shape::Polyhedron { vertices, faces } => Shape::Polyhedron {
                vertices: vertices.iter().map(scaled).collect(),
                faces: faces.clone(),
            },
            _ => Shape::Sphere { radius },
        };
        (shape, self.rotation.clone())
    }
}

/// Points on an ellipsoid.
fn points(count: usize, axes: [f64; 3], random: &mut Random) -> Vec<[f64; 3]> {
    let apart = APART * (4.0 * PI / count as f64).sqrt();
    let mut list: Vec<[f64; 3]> = Vec::with_capacity(count);
    for _ in 0..count {
        let far = |p: &[f64; 3]| {
            list.iter().all(|q| (0..3).map(|k| (p[k] - q[k]).powi(2)).sum::<f64>() >= apart * apart)
        };
        let mut point = direction(random);
        for _ in 0..TRIES {
            if far(&point) {
                break;
            }
            point = direction(random);
        }
        list.push(point);
    }
    list.iter().map(|p| [p[0] * axes[0], p[1] * axes[1], p[2] * axes[2]]).collect()
}

/// A point on the unit sphere.
fn direction(random: &mut Random) -> [f64; 3] {
    let (z, angle) = (random.between(-1.0, 1.0), random.between(0.0, TAU));
    let r = (1.0 - z * z).max(0.0).sqrt();
    [r * angle.cos(), r * angle.sin(), z]
}

/// A rotation.
fn turn(random: &mut Random) -> Rotation {
    let (u, a, b) = (random.unit(), random.between(0.0, TAU), random.between(0.0, TAU));
    let (s, c) = ((1.0 - u).sqrt(), u.sqrt());
    let [x, y, z, w] = [s * a.sin(), s * a.cos(), c * b.sin(), c * b.cos()];
    let length = (x * x + y * y + z * z).sqrt();
    let axis = if length > 0.0 { [x, y, z] } else { [0.0, 0.0, 1.0] };
    Rotation { axis, angle: 2.0 * length.atan2(w).to_degrees() }
}
