//! From faces to facets: coplanar faces joined by an edge are one facet, whatever the way they were
//! cut up.

use super::{
    Facet, MassProperties, Mend, Polyhedron, ShapeError,
    outline::{Outline, outline},
    plane::Frame,
    surface::{HalfEdge, Surface, edges},
};
use base::tolerance;
use nalgebra::Vector3;

/// A facet on its way.
pub(super) struct Region {
    /// The faces it consists of, the largest first.
    pub faces: Vec<u32>,
    /// Unit normal.
    pub normal: Vector3<f64>,
    /// Plane in coordinates about the centre of the bounding box.
    pub offset: f64,
    pub area: f64,
    pub warp: f64,
    /// Edges that bound it, the region on their left.
    pub boundary: Vec<(u32, u32)>,
    /// Convex pieces.
    pub pieces: Vec<Vec<u32>>,
}

/// Joins faces to facets.
///
/// A facet grows from its largest face over edges to faces all of whose corners lie within
/// [`tolerance::COPLANAR`] × size of one common plane: first the plane of that face, then the
/// area-weighted plane of what was found. As the plane does not follow the growth, a fine curved
/// surface keeps its faces.
pub(super) fn regions(
    surface: &Surface,
    half_edges: &[HalfEdge],
    mends: &mut Vec<Mend>,
) -> Vec<Region> {
    let reach = tolerance::COPLANAR * surface.size;
    let growth = Growth::new(surface, half_edges, reach);
    growth.report_warped(mends);

    let mut order: Vec<u32> = (0..surface.faces.len() as u32).collect();
    order.sort_by(|&a, &b| {
        growth.areas[b as usize].norm_squared().total_cmp(&growth.areas[a as usize].norm_squared())
    });
    let mut taken = vec![false; surface.faces.len()];
    let mut regions = Vec::with_capacity(surface.faces.len());
    for seed in order {
        if taken[seed as usize] || growth.areas[seed as usize].norm_squared() == 0.0 {
            continue;
        }
        let mut faces = growth.grow(seed, growth.plane(&[seed]), &mut taken);
        if faces.len() > 1 {
            let plane = growth.plane(&faces);
            for &f in &faces {
                taken[f as usize] = false;
            }
            faces = growth.grow(seed, plane, &mut taken);
        }
        regions.extend(growth.region(faces));
    }
    regions.sort_by_key(|r| r.faces.iter().min().copied());
    regions
}

/// A plane `normal · x = offset` and the largest distance of the points it was laid through.
#[derive(Clone, Copy)]
struct Plane {
    normal: Vector3<f64>,
    offset: f64,
    warp: f64,
    area: f64,
}

struct Growth<'a> {
    surface: &'a Surface,
    reach: f64,
    /// Area vector of each face.
    areas: Vec<Vector3<f64>>,
    /// Faces across edges: those of face `f` are `neighbours[starts[f]..starts[f + 1]]`.
    starts: Vec<u32>,
    neighbours: Vec<u32>,
}

impl<'a> Growth<'a> {
    fn new(surface: &'a Surface, list: &[HalfEdge], reach: f64) -> Self {
        let areas: Vec<_> = surface.faces.iter().map(|f| surface.area_vector(f)).collect();
        let pairs = || {
            edges(list).filter_map(|edge| match edge {
                [a, b] if a.face != b.face => Some((a.face as usize, b.face as usize)),
                _ => None,
            })
        };
        let mut starts = vec![0u32; areas.len() + 1];
        for (a, b) in pairs() {
            starts[a + 1] += 1;
            starts[b + 1] += 1;
        }
        for f in 0..areas.len() {
            starts[f + 1] += starts[f];
        }
        let mut next = starts.clone();
        let mut neighbours = vec![0u32; starts[areas.len()] as usize];
        for (a, b) in pairs() {
            for (from, to) in [(a, b), (b, a)] {
                neighbours[next[from] as usize] = to as u32;
                next[from] += 1;
            }
        }
        Self { surface, reach, areas, starts, neighbours }
    }

    fn corners<'f>(&'f self, faces: &'f [u32]) -> impl Iterator<Item = Vector3<f64>> + 'f {
        faces
            .iter()
            .flat_map(|&f| &self.surface.faces[f as usize].corners)
            .map(|&c| self.surface.point(c))
    }

    /// The area-weighted plane through faces, midway between their outermost corners: it does not
    /// depend on how the faces are cut up.
    fn plane(&self, faces: &[u32]) -> Plane {
        let sum: Vector3<f64> = faces.iter().map(|&f| self.areas[f as usize]).sum();
        let area = sum.norm();
        let normal = sum / area;
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for p in self.corners(faces) {
            let d = normal.dot(&p);
            low = low.min(d);
            high = high.max(d);
        }
        Plane { normal, offset: low + (high - low) / 2.0, warp: (high - low) / 2.0, area }
    }

    /// The faces connected with `seed` within reach of a plane.
    fn grow(&self, seed: u32, plane: Plane, taken: &mut [bool]) -> Vec<u32> {
        let mut faces = vec![seed];
        taken[seed as usize] = true;
        let mut next = 0;
        while next < faces.len() {
            let f = faces[next] as usize;
            next += 1;
            for &g in &self.neighbours[self.starts[f] as usize..self.starts[f + 1] as usize] {
                if !taken[g as usize] && self.fits(g, &plane) {
                    taken[g as usize] = true;
                    faces.push(g);
                }
            }
        }
        faces
    }

    fn fits(&self, face: u32, plane: &Plane) -> bool {
        let corners = std::slice::from_ref(&face);
        if self.corners(corners).any(|p| (plane.normal.dot(&p) - plane.offset).abs() > self.reach) {
            return false;
        }
        // A face folded back does not belong to the facet, but the direction of a needle means
        // nothing.
        let area = self.areas[face as usize];
        plane.normal.dot(&area) > 0.5 * area.norm() || self.is_needle(corners, area.norm())
    }

    /// Whether faces are thinner than the tolerance.
    fn is_needle(&self, faces: &[u32], area: f64) -> bool {
        let longest = faces
            .iter()
            .flat_map(|&f| self.surface.faces[f as usize].edges())
            .map(|(a, b)| (self.surface.point(b) - self.surface.point(a)).norm())
            .fold(0.0, f64::max);
        area <= self.reach * longest
    }

    fn report_warped(&self, mends: &mut Vec<Mend>) {
        let mut worst = (0, 0.0, 0);
        for (f, face) in
            self.surface.faces.iter().enumerate().filter(|(_, face)| face.corners.len() > 3)
        {
            if self.areas[f].norm_squared() == 0.0 {
                continue;
            }
            let warp = self.plane(&[f as u32]).warp;
            if warp > self.reach {
                worst = if warp > worst.1 {
                    (worst.0 + 1, warp, face.source)
                } else {
                    (worst.0 + 1, worst.1, worst.2)
                };
            }
        }
        if worst.0 > 0 {
            mends.push(Mend::Warped { faces: worst.0, face: worst.2, warp: worst.1 });
        }
    }

    /// The facet over `faces`; none where they are thinner than the tolerance, and nothing can rest
    /// on them.
    fn region(&self, faces: Vec<u32>) -> Option<Region> {
        let plane = self.plane(&faces);
        if self.is_needle(&faces, plane.area) {
            return None;
        }
        let frame = Frame::around(&plane.normal);
        let Outline { boundary, pieces } =
            outline(self.surface, &faces, &frame, plane.area, self.reach);
        Some(Region {
            faces,
            normal: plane.normal,
            offset: plane.offset,
            area: plane.area,
            warp: plane.warp,
            boundary,
            pieces,
        })
    }
}

/// Refuses what is thinner than [`tolerance::FLAT`] × size.
pub(super) fn refuse_flat(
    surface: &Surface,
    regions: &[Region],
    volume: f64,
) -> Result<(), ShapeError> {
    let largest = regions.iter().map(|r| r.area).fold(0.0, f64::max);
    let thickness = if largest > 0.0 { volume / largest } else { 0.0 };
    if thickness > tolerance::FLAT * surface.size {
        Ok(())
    } else {
        Err(ShapeError::Flat { thickness, size: surface.size })
    }
}

/// The polyhedron over `regions`, with the corners that they use, as given in the file.
pub(super) fn assemble(
    surface: &Surface,
    vertices: Vec<Vector3<f64>>,
    regions: Vec<Region>,
    convex: bool,
    mass: MassProperties,
) -> Polyhedron {
    let mut number = vec![u32::MAX; vertices.len()];
    for &corner in regions.iter().flat_map(|r| &r.pieces).flatten() {
        number[corner as usize] = 0;
    }
    let mut kept = Vec::with_capacity(vertices.len());
    for (n, vertex) in number.iter_mut().zip(&vertices).filter(|(n, _)| **n == 0) {
        *n = kept.len() as u32;
        kept.push(*vertex);
    }
    let facets = regions
        .into_iter()
        .map(|r| {
            let mut pieces = r.pieces;
            for corner in pieces.iter_mut().flatten() {
                *corner = number[*corner as usize];
            }
            Facet {
                normal: r.normal,
                offset: r.offset + r.normal.dot(&surface.center),
                pieces,
                area: r.area,
                warp: r.warp,
            }
        })
        .collect();
    Polyhedron { vertices: kept, facets, convex, mass }
}
