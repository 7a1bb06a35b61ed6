//! A block made ready for detection: boxes around it and its facets, and, where asked for, its
//! edges and corners.

use super::{plane::Plane, polygon};
use crate::assembly::{Block, Facet, Polyhedron, Solid};
use base::tolerance::{COPLANAR, GREATEST_TWIST};
use nalgebra::Vector3;
use std::{
    cell::OnceCell,
    collections::{BTreeSet, HashMap, HashSet},
    f64::consts::PI,
};

/// An axis-aligned box, m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub lo: Vector3<f64>,
    pub hi: Vector3<f64>,
}

impl Bounds {
    /// The box around points.
    pub fn around<'a>(points: impl IntoIterator<Item = &'a Vector3<f64>>) -> Self {
        let empty =
            Self { lo: Vector3::repeat(f64::INFINITY), hi: Vector3::repeat(f64::NEG_INFINITY) };
        points.into_iter().fold(empty, |b, p| Self { lo: b.lo.inf(p), hi: b.hi.sup(p) })
    }

    /// This box grown by `slack` on every side.
    pub fn loosened(&self, slack: f64) -> Self {
        Self { lo: self.lo.add_scalar(-slack), hi: self.hi.add_scalar(slack) }
    }

    /// What two boxes have in common; inverted (`lo > hi`) where nothing.
    pub fn common(&self, other: &Self) -> Self {
        Self { lo: self.lo.sup(&other.lo), hi: self.hi.inf(&other.hi) }
    }

    /// Whether two boxes meet.
    pub fn meets(&self, other: &Self) -> bool {
        let common = self.common(other);
        (0..3).all(|k| common.lo[k] <= common.hi[k])
    }

    /// Distance between two boxes, m; 0 where they meet.
    pub fn distance(&self, other: &Self) -> f64 {
        let common = self.common(other);
        (common.lo - common.hi).map(|d| d.max(0.0)).norm()
    }

    /// The greatest absolute coordinate.
    pub fn reach(&self) -> f64 {
        self.lo.amax().max(self.hi.amax())
    }
}

/// A block with its boxes.
pub(super) struct BoundedBlock<'a> {
    pub block: &'a Block,
    pub bounds: Bounds,
    pub shape: Form<'a>,
}

/// The shape of a [`BoundedBlock`].
pub(super) enum Form<'a> {
    Polyhedron(Solidity<'a>),
    /// One sphere, or several rigidly joined: centres and radii.
    Balls(Vec<(Vector3<f64>, f64)>),
}

/// A polyhedron with a box around each facet.
pub(super) struct Solidity<'a> {
    pub polyhedron: &'a Polyhedron,
    pub facet_bounds: Vec<Bounds>,
    /// How far a part of each facet may lean from its mean plane, radians: twice the warp over the
    /// width.
    pub facet_twist: Vec<f64>,
    topology: OnceCell<Topology>,
}

/// Edges, corners and facet rims; built on first use, since most pairs meet face to face and never
/// ask.
pub(super) struct Topology {
    pub edges: Vec<Edge>,
    pub corners: Vec<Corner>,
    /// Per facet, the sides of its pieces that are no side of another piece of the same facet.
    pub rims: Vec<Vec<[u32; 2]>>,
}

/// An edge between two facets.
pub(super) struct Edge {
    pub ends: [u32; 2],
    /// The two facets.
    pub facets: [usize; 2],
    /// Unit directions from the edge into its two facets, perpendicular to the edge.
    pub into: [Vector3<f64>; 2],
    /// Whether the solid takes up less than half of the space around the edge.
    pub convex: bool,
}

/// A corner.
#[derive(Clone, Default)]
pub(super) struct Corner {
    /// Unit directions along all sides of facet pieces that leave the corner.
    pub along: Vec<Vector3<f64>>,
    /// Outward pseudo-normal, facet normals weighted by their angles at the corner (Bærentzen &
    /// Aanæs 2005); not of unit length.
    pub outward: Vector3<f64>,
}

impl<'a> BoundedBlock<'a> {
    /// Makes a block ready.
    pub fn new(block: &'a Block) -> Self {
        match &block.solid {
            Solid::Polyhedron(polyhedron) => Self {
                block,
                bounds: Bounds::around(&polyhedron.vertices),
                shape: Form::Polyhedron(Solidity {
                    polyhedron,
                    facet_bounds: polyhedron
                        .facets
                        .iter()
                        .map(|f| {
                            Bounds::around(
                                f.pieces
                                    .iter()
                                    .flatten()
                                    .map(|&v| &polyhedron.vertices[v as usize]),
                            )
                        })
                        .collect(),
                    facet_twist: polyhedron.facets.iter().map(|f| twist(polyhedron, f)).collect(),
                    topology: OnceCell::new(),
                }),
            },
            Solid::Sphere { center, radius } => Self::of_balls(block, vec![(*center, *radius)]),
            Solid::Clump { balls, .. } => Self::of_balls(block, balls.clone()),
        }
    }
}

impl<'a> BoundedBlock<'a> {
    fn of_balls(block: &'a Block, balls: Vec<(Vector3<f64>, f64)>) -> Self {
        let one = |(c, r): &(Vector3<f64>, f64)| Bounds { lo: *c, hi: *c }.loosened(*r);
        let all = |a: Bounds, b: Bounds| Bounds { lo: a.lo.inf(&b.lo), hi: a.hi.sup(&b.hi) };
        let bounds = balls
            .iter()
            .map(one)
            .reduce(all)
            .unwrap_or(Bounds { lo: block.centroid, hi: block.centroid });
        Self { block, bounds, shape: Form::Balls(balls) }
    }
}

impl Solidity<'_> {
    /// Facets whose boxes meet `window`.
    pub fn facets_in(&self, window: &Bounds) -> impl Iterator<Item = (usize, &Facet)> {
        self.polyhedron
            .facets
            .iter()
            .enumerate()
            .filter(move |&(i, _)| self.facet_bounds[i].meets(window))
    }

    /// Position of a vertex.
    pub fn at(&self, vertex: u32) -> Vector3<f64> {
        self.polyhedron.vertices[vertex as usize]
    }

    /// The ends of an edge or rim segment.
    pub fn ends(&self, segment: [u32; 2]) -> [Vector3<f64>; 2] {
        segment.map(|v| self.at(v))
    }

    /// Edges whose boxes meet `window`.
    pub fn edges_in(&self, window: &Bounds) -> impl Iterator<Item = &Edge> {
        self.topology()
            .edges
            .iter()
            .filter(move |e| Bounds::around(&self.ends(e.ends)).meets(window))
    }

    /// Edges, corners and rims.
    pub fn topology(&self) -> &Topology {
        self.topology.get_or_init(|| Topology::of(self.polyhedron))
    }
}

impl Topology {
    fn of(polyhedron: &Polyhedron) -> Self {
        let at = |v: u32| polyhedron.vertices[v as usize];
        let mut corners = vec![Corner::default(); polyhedron.vertices.len()];
        let mut sides = Vec::new();
        for (i, facet) in polyhedron.facets.iter().enumerate() {
            for piece in &facet.pieces {
                for k in 0..piece.len() {
                    let (here, ahead, behind) = (
                        piece[k],
                        piece[(k + 1) % piece.len()],
                        piece[(k + piece.len() - 1) % piece.len()],
                    );
                    let (next, previous) =
                        (unit(at(ahead) - at(here)), unit(at(behind) - at(here)));
                    let corner = &mut corners[here as usize];
                    corner.along.extend([next, previous]);
                    corner.outward +=
                        facet.normal * previous.cross(&next).norm().atan2(previous.dot(&next));
                    sides.push(Side { ends: [here, ahead], facet: i });
                }
            }
        }
        split(polyhedron, &mut sides, &mut corners);
        let facet_of: HashMap<[u32; 2], usize> = sides.iter().map(|s| (s.ends, s.facet)).collect();
        let mut edges = Vec::new();
        let mut rims = vec![Vec::new(); polyhedron.facets.len()];
        for &Side { ends: [p, q], facet: i } in &sides {
            let twin = facet_of.get(&[q, p]).copied();
            if twin == Some(i) {
                continue;
            }
            rims[i].push([p, q]);
            // Each edge once, from the side where its ends ascend.
            if let Some(j) = twin
                && p < q
            {
                let (one, other) = (&polyhedron.facets[i].normal, &polyhedron.facets[j].normal);
                let along = at(q) - at(p);
                // A facet lies to the left of its sides, seen from outside.
                let into = [unit(one.cross(&along)), -unit(other.cross(&along))];
                edges.push(Edge {
                    ends: [p, q],
                    facets: [i, j],
                    convex: into[0].dot(other) < 0.0,
                    into,
                });
            }
        }
        Self { edges, corners, rims }
    }
}

/// A side of a facet piece, the piece on its left.
#[derive(Clone, Copy)]
struct Side {
    ends: [u32; 2],
    facet: usize,
}

/// Splits sides at corners that lie on them. A corner where two facets meet the straight side of a
/// third is no corner of the third: its side has to be cut there to find its neighbours.
fn split(polyhedron: &Polyhedron, sides: &mut Vec<Side>, corners: &mut [Corner]) {
    let at = |v: u32| polyhedron.vertices[v as usize];
    let bounds = Bounds::around(&polyhedron.vertices);
    // Corners this close to a straight side were taken out of it when facets were joined.
    let tol = 2.0 * COPLANAR * (bounds.hi - bounds.lo).norm();
    let known: HashSet<[u32; 2]> = sides.iter().map(|s| s.ends).collect();
    let (whole, single): (Vec<Side>, Vec<Side>) =
        sides.iter().partition(|s| known.contains(&[s.ends[1], s.ends[0]]));
    let loose: BTreeSet<u32> = single.iter().flat_map(|s| s.ends).collect();
    *sides = whole;
    for Side { ends: [p, q], facet } in single {
        let (start, along) = (at(p), unit(at(q) - at(p)));
        let length = (at(q) - at(p)).norm();
        let mut cuts: Vec<(f64, u32)> = loose
            .iter()
            .map(|&v| ((at(v) - start).dot(&along), v))
            .filter(|&(t, v)| {
                t > tol && t < length - tol && (at(v) - start - along * t).norm() <= tol
            })
            .collect();
        cuts.sort_by(|x, y| x.0.total_cmp(&y.0));
        let mut from = p;
        for (_, v) in cuts {
            let normal = polyhedron.facets[facet].normal;
            corners[v as usize].along.push(unit(normal.cross(&along)));
            corners[v as usize].outward += normal * PI;
            sides.push(Side { ends: [from, v], facet });
            from = v;
        }
        sides.push(Side { ends: [from, q], facet });
    }
}

/// How far a part of a facet may lean from its mean plane: from warp below to warp above it over
/// its least width, radians.
fn twist(polyhedron: &Polyhedron, facet: &Facet) -> f64 {
    if facet.warp == 0.0 {
        return 0.0;
    }
    let corners = || facet.pieces.iter().flatten().map(|&v| polyhedron.vertices[v as usize]);
    let plane = Plane::new(corners().next().unwrap_or_default(), facet.normal);
    let width =
        polygon::width(&polygon::hull(&corners().map(|x| plane.flat(x)).collect::<Vec<_>>(), 0.0));
    (2.0 * facet.warp / width).min(GREATEST_TWIST)
}

/// The direction of `v`; zero where it has none.
pub(super) fn unit(v: Vector3<f64>) -> Vector3<f64> {
    v.try_normalize(0.0).unwrap_or_default()
}
