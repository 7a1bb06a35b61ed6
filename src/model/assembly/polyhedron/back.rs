//! A held face needs no volume: a support drawn as a face or an open sheet (ground, wall, terrain)
//! gets a body behind it.

use super::{Mend, Polyhedron, ShapeError};
use nalgebra::Vector3;
use std::collections::HashMap;

/// How thick the body is, × the size of the sheet. Blocks touch the sheet alone; larger or smaller
/// changes no contact.
const THICKNESS: f64 = 0.1;

impl Polyhedron {
    /// The polyhedron of a support, as [`from_faces`](Self::from_faces); where its surface is flat or
    /// open, that with a body on the side away from `free`, where the free blocks are.
    ///
    /// # Errors
    /// As [`from_faces`](Self::from_faces).
    pub fn of_support(
        vertices: Vec<Vector3<f64>>,
        faces: &[Vec<usize>],
        free: Vector3<f64>,
    ) -> Result<(Self, Vec<Mend>), ShapeError> {
        let own = Self::from_faces(vertices.clone(), faces);
        let Err(error @ (ShapeError::Flat { .. } | ShapeError::Open { .. })) = own else {
            return own;
        };
        let Some((vertices, faces, thickness)) = backed(vertices, faces, free) else {
            return Err(error);
        };
        let (polyhedron, mut mends) = Self::from_faces(vertices, &faces).map_err(|_| error)?;
        mends.push(Mend::Backed { thickness });
        Ok((polyhedron, mends))
    }
}

/// Corners and faces of a sheet with its body, and how thick that is, m.
type Backed = (Vec<Vector3<f64>>, Vec<Vec<usize>>, f64);

/// The sheet, its copy behind it, and the strip between their rims.
fn backed(vertices: Vec<Vector3<f64>>, faces: &[Vec<usize>], free: Vector3<f64>) -> Option<Backed> {
    // Corners in one place are one: sheets often come as faces on their own.
    let mut places: HashMap<[u64; 3], usize> = HashMap::new();
    let own: Vec<usize> = vertices
        .iter()
        .enumerate()
        .map(|(i, v)| *places.entry([v.x, v.y, v.z].map(|c| (c + 0.0).to_bits())).or_insert(i))
        .collect();
    let mut faces: Vec<Vec<usize>> =
        faces.iter().map(|f| f.iter().map(|&i| own[i]).collect()).collect();
    let count = vertices.len();
    let middle = vertices.iter().sum::<Vector3<f64>>() / count as f64;
    let area: Vector3<f64> = faces
        .iter()
        .flat_map(|f| f.iter().zip(f.iter().cycle().skip(1)))
        .map(|(&i, &j)| (vertices[i] - middle).cross(&(vertices[j] - middle)))
        .sum();
    let (low, high) = vertices.iter().fold((middle, middle), |(l, h), v| (l.inf(v), h.sup(v)));
    let size = (high - low).norm();
    let mut out = area.try_normalize(1e-6 * size * size)?;
    if out.dot(&(free - middle)) < 0.0 {
        out = -out;
        faces.iter_mut().for_each(|f| f.reverse());
    }
    let mut rim: HashMap<(usize, usize), bool> = HashMap::new();
    for (&i, &j) in faces.iter().flat_map(|f| f.iter().zip(f.iter().cycle().skip(1))) {
        rim.insert((i, j), !rim.contains_key(&(j, i)));
        if let Some(twin) = rim.get_mut(&(j, i)) {
            *twin = false;
        }
    }
    let mut strip: Vec<(usize, usize)> =
        rim.into_iter().filter(|(_, open)| *open).map(|(side, _)| side).collect();
    strip.sort_unstable();
    let behind = |f: &Vec<usize>| f.iter().rev().map(|&i| i + count).collect();
    let back: Vec<Vec<usize>> = faces.iter().map(behind).collect();
    faces.extend(back);
    faces.extend(strip.into_iter().map(|(i, j)| vec![j, i, i + count, j + count]));
    let thickness = THICKNESS * size;
    let copies = vertices.iter().map(|v| v - out * thickness).collect::<Vec<_>>();
    Some(([vertices, copies].concat(), faces, thickness))
}
