//! A block as convex pieces whose outer faces have at most four corners.
//!
//! The contact engine takes at most four corners of a face and at most four points of a contact, so
//! that a drum on a twelve-cornered face rocks. Every block is therefore cut, exactly and never by
//! approximation:
//! * a block that is not convex by the planes of its own facets, until no facet runs through a
//!   piece (binary space partition; Thibault & Naylor 1987), of which those inside are kept;
//! * a piece with a face of more than four corners through corners of that face, or, where that
//!   does not end soon, into pyramids over quarters of its faces.
//!
//! * W. C. Thibault, B. F. Naylor, *Set operations on polyhedra using binary space partitioning
//!   trees*, SIGGRAPH 1987.

use super::cell::{Cell, Face, mean};
use base::plane::clip::inside;
use model::assembly::Polyhedron;
use nalgebra::{Unit, UnitQuaternion, Vector3};

/// Corners of a face that the engine sees.
const CORNERS: usize = 4;
/// More pieces than this from cutting through corners, and pyramids are taken instead.
const FEW: usize = 24;
/// A block that would fall into more pieces than this is not simulated.
pub(super) const MOST: usize = 4096;
/// A facet this close to a piece's faces (relative to the block) does not run through it.
const THROUGH: f64 = 1e-7;

/// The pieces of a polyhedron, in the frame `(x − origin) / unit`; `None` where they would be too
/// many.
pub(super) fn pieces(shape: &Polyhedron, origin: Vector3<f64>, unit: f64) -> Option<Vec<Cell>> {
    let place = |p: Vector3<f64>| (p - origin) / unit;
    let facets: Vec<Vec<Face>> = shape
        .facets
        .iter()
        .map(|f| {
            f.pieces
                .iter()
                .map(|p| Face {
                    normal: f.normal,
                    points: shape.points(p).map(place).collect(),
                    inner: false,
                })
                .collect()
        })
        .collect();
    let whole =
        if shape.convex { vec![Cell { faces: facets.concat() }] } else { solid_cells(&facets)? };
    let mut pieces = Vec::new();
    for cell in whole {
        pieces.extend(four_cornered(cell));
        if pieces.len() > MOST {
            return None;
        }
    }
    Some(pieces)
}

/// Half the sides of a box and how it lies, where the cell is one: boxes have a contact test of
/// their own.
pub(super) fn as_box(cell: &Cell) -> Option<(Vector3<f64>, UnitQuaternion<f64>, Vector3<f64>)> {
    let (corners, loops) = cell.mesh();
    if corners.len() != 8 || loops.len() != 6 || cell.faces.iter().any(|f| f.inner) {
        return None;
    }
    let x = cell.faces[0].normal;
    let y = cell.faces.iter().map(|f| f.normal).find(|n| n.dot(&x).abs() < 1e-12)?;
    let axes = [x, y, x.cross(&y)];
    let parallel = |n: &Vector3<f64>| axes.iter().any(|a| (a.dot(n).abs() - 1.0).abs() < 1e-12);
    if !cell.faces.iter().all(|f| parallel(&f.normal)) {
        return None;
    }
    let middle = mean(&corners);
    let half = Vector3::from_fn(|k, _| {
        corners.iter().map(|c| axes[k].dot(&(c - middle))).fold(0.0, f64::max)
    });
    let turn = UnitQuaternion::from_basis_unchecked(&axes);
    Some((half, Unit::new_normalize(turn.into_inner()), middle))
}

/// Cuts until outer faces have at most four corners.
fn four_cornered(cell: Cell) -> Vec<Cell> {
    let (mut open, mut done) = (vec![cell.clone()], Vec::new());
    while let Some(piece) = open.pop() {
        let Some(face) = piece.faces.iter().find(|f| !f.inner && f.points.len() > CORNERS) else {
            done.push(piece);
            continue;
        };
        let normal = (face.points[3] - face.points[0]).cross(&face.normal);
        let (Some(normal), true) = (normal.try_normalize(0.0), open.len() + done.len() < FEW)
        else {
            return pyramids(&cell);
        };
        match piece.cut(normal, normal.dot(&face.points[0]), true) {
            (Some(one), Some(other)) => open.extend([one, other]),
            _ => return pyramids(&cell),
        }
    }
    done
}

/// A pyramid from the middle of the cell over each quarter of its outer faces.
fn pyramids(cell: &Cell) -> Vec<Cell> {
    let apex = cell.middle();
    let mut list = Vec::new();
    for face in cell.faces.iter().filter(|f| !f.inner) {
        for base in quarters(&face.points) {
            let sides = (0..base.len()).filter_map(|i| {
                Face::around(vec![base[(i + 1) % base.len()], base[i], apex], true)
            });
            let mut faces: Vec<Face> = sides.collect();
            faces.push(Face { points: base, ..face.clone() });
            list.push(Cell { faces });
        }
    }
    list
}

/// A convex loop as loops of at most four corners.
fn quarters(points: &[Vector3<f64>]) -> Vec<Vec<Vector3<f64>>> {
    (1..points.len().saturating_sub(1))
        .step_by(2)
        .map(|i| std::iter::once(points[0]).chain(points[i..].iter().take(3).copied()).collect())
        .collect()
}

/// The convex cells that a non-convex surface bounds.
fn solid_cells(facets: &[Vec<Face>]) -> Option<Vec<Cell>> {
    let points = || facets.iter().flatten().flat_map(|f| &f.points);
    let low = points().copied().reduce(|a, b| a.inf(&b))?;
    let high = points().copied().reduce(|a, b| a.sup(&b))?;
    let size = (high - low).norm();
    let room = Vector3::repeat(0.1 * size);
    let mut open = vec![(Cell::cuboid(low - room, high + room), facets.to_vec())];
    let mut solid = Vec::new();
    while let Some((cell, own)) = open.pop() {
        // The largest facet first: it cuts the fewest others.
        let area = |facet: &Vec<Face>| {
            facet.iter().map(|f| (f.points[0] - f.middle()).norm_squared()).fold(0.0, f64::max)
        };
        let Some(largest) = (0..own.len()).max_by(|&i, &j| area(&own[i]).total_cmp(&area(&own[j])))
        else {
            if is_inside(&cell.middle(), facets) {
                solid.push(marked(cell, facets, size));
            }
            continue;
        };
        let (normal, offset) =
            (own[largest][0].normal, own[largest][0].normal.dot(&own[largest][0].points[0]));
        let (below, above) = cell.cut(normal, offset, false);
        let height = move |p: &Vector3<f64>| normal.dot(p) - offset;
        for (part, sign) in [(below, 1.0), (above, -1.0)] {
            let Some(part) = part else { continue };
            let side = |p: &Vector3<f64>| sign * height(p);
            let rest = own
                .iter()
                .enumerate()
                .filter(|(i, _)| *i != largest)
                .filter_map(|(_, facet)| through(facet, &side, THROUGH * size));
            open.push((part, rest.collect()));
        }
        if open.len() + solid.len() > MOST {
            return None;
        }
    }
    Some(solid)
}

/// What of a facet lies on the lower side of a plane and not in it.
fn through(facet: &[Face], height: &impl Fn(&Vector3<f64>) -> f64, on: f64) -> Option<Vec<Face>> {
    let parts: Vec<Face> = facet
        .iter()
        .map(|f| Face { points: inside(&f.points, |p| -height(p), 0.0), ..f.clone() })
        .filter(|f| f.points.len() >= 3 && f.points.iter().any(|p| height(p) < -on))
        .collect();
    (!parts.is_empty()).then_some(parts)
}

/// Marks the faces that lie inside the block as a whole.
fn marked(mut cell: Cell, facets: &[Vec<Face>], size: f64) -> Cell {
    for face in &mut cell.faces {
        let middle = face.middle();
        let out = face.normal * (1e-5 * size);
        let near = face.points.iter().map(|p| middle + (p - middle) * 0.9).chain([middle]);
        face.inner = near.into_iter().all(|p| is_inside(&(p + out), facets));
    }
    cell
}

/// Whether the surface winds around a point: the sum of its triangles' solid angles (Van Oosterom &
/// Strackee 1983) is 4π inside and 0 outside.
fn is_inside(point: &Vector3<f64>, facets: &[Vec<Face>]) -> bool {
    let mut angle = 0.0;
    for face in facets.iter().flatten() {
        let a = face.points[0] - point;
        for pair in face.points[1..].windows(2) {
            let (b, c) = (pair[0] - point, pair[1] - point);
            let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
            let below = la * lb * lc + a.dot(&b) * lc + a.dot(&c) * lb + b.dot(&c) * la;
            angle += 2.0 * a.dot(&b.cross(&c)).atan2(below);
        }
    }
    angle > std::f64::consts::TAU
}

#[cfg(test)]
mod tests;
