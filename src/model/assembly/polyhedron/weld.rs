//! From the lists in the file to faces over distinct corners.

use super::{
    Mend, ShapeError,
    surface::{Face, Surface},
};
use base::tolerance;
use nalgebra::Vector3;
use std::collections::HashMap;

/// Below this, comparing all pairs is faster than a hash grid.
const FEW: usize = 32;

/// Most vertices, and most corners of all faces together: keeps numbers of corners within 32 bits
/// everywhere and memory within some GB.
const MOST: usize = 1 << 25;

/// Checks the numbers and indices, welds vertices closer than [`tolerance::WELD`] × size, drops
/// unused vertices and faces without extent.
///
/// Returns the surface in coordinates about its centre, and the corners in scene coordinates as the
/// file gave them.
pub(super) fn weld(
    vertices: Vec<Vector3<f64>>,
    faces: &[Vec<usize>],
    mends: &mut Vec<Mend>,
) -> Result<(Surface, Vec<Vector3<f64>>), ShapeError> {
    if let Some(vertex) = vertices.iter().position(|v| !v.iter().all(|x| x.is_finite())) {
        return Err(ShapeError::NotFinite { vertex });
    }
    let corners = faces.iter().map(Vec::len).sum::<usize>();
    if faces.is_empty() || vertices.len().max(corners) > MOST {
        return Err(ShapeError::Count { vertices: vertices.len(), faces: faces.len(), most: MOST });
    }
    let used = used(vertices.len(), faces)?;
    let (mut low, mut high) = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
    for (v, _) in vertices.iter().zip(&used).filter(|(_, used)| **used) {
        low = low.inf(v);
        high = high.sup(v);
    }
    let center = low + (high - low) / 2.0;
    let size = (high - low).norm();
    if !(tolerance::LEAST_SIZE..=tolerance::GREATEST_SIZE).contains(&size) {
        return Err(ShapeError::OutOfRange {
            size,
            least: tolerance::LEAST_SIZE,
            most: tolerance::GREATEST_SIZE,
        });
    }

    let welder = Welder::new(vertices, used, center, tolerance::WELD * size);
    if welder.welded > 0 {
        mends.push(Mend::Welded { vertices: welder.welded, farthest: welder.farthest });
    }
    let Welder { map, points, kept, .. } = welder;

    let mut dropped: Option<(usize, usize)> = None;
    let mut list = Vec::with_capacity(faces.len());
    for (source, face) in faces.iter().enumerate() {
        let mut corners: Vec<u32> = face.iter().map(|&v| map[v]).collect();
        tidy(&mut corners);
        if corners.len() >= 3 {
            list.push(Face { corners, source });
        } else {
            dropped = Some(dropped.map_or((1, source), |(n, first)| (n + 1, first)));
        }
    }
    if let Some((faces, first)) = dropped {
        mends.push(Mend::Dropped { faces, first });
    }
    Ok((Surface { points, center, size, faces: list }, kept))
}

/// Marks the vertices that faces use.
fn used(vertices: usize, faces: &[Vec<usize>]) -> Result<Vec<bool>, ShapeError> {
    let mut used = vec![false; vertices];
    for (face, corners) in faces.iter().enumerate() {
        for &index in corners {
            *used.get_mut(index).ok_or(ShapeError::NoSuchVertex { face, index, vertices })? = true;
        }
        // Three different ones, found without sorting: the first, one unlike it, one unlike both.
        let a = corners.first();
        let b = corners.iter().find(|&v| Some(v) != a);
        if !corners.iter().any(|v| Some(v) != a && Some(v) != b) {
            let distinct = usize::from(a.is_some()) + usize::from(b.is_some());
            return Err(ShapeError::TooFewCorners { face, distinct });
        }
    }
    Ok(used)
}

/// Removes repetitions (`a a`) and spikes (`a b a`), which bound nothing.
pub(super) fn tidy(corners: &mut Vec<u32>) {
    let spiked = |c: &[u32]| {
        let n = c.len();
        (0..n).any(|i| c[i] == c[(i + 1) % n] || c[i] == c[(i + 2) % n])
    };
    if corners.len() < 3 || !spiked(corners) {
        return;
    }
    let mut kept: Vec<u32> = Vec::with_capacity(corners.len());
    for &c in corners.iter() {
        if kept.last() == Some(&c) {
            continue;
        }
        if kept.len() >= 2 && kept[kept.len() - 2] == c {
            kept.pop();
            continue;
        }
        kept.push(c);
    }
    // The same across the seam.
    loop {
        let n = kept.len();
        if n >= 2 && kept[0] == kept[n - 1] {
            kept.pop();
        } else if n >= 3 && kept[1] == kept[n - 1] {
            kept.remove(0);
            kept.pop();
        } else if n >= 3 && kept[0] == kept[n - 2] {
            kept.truncate(n - 2);
        } else {
            break;
        }
    }
    *corners = kept;
}

struct Welder {
    /// Corner of each vertex; `u32::MAX` for unused ones.
    map: Vec<u32>,
    /// Corners about the centre.
    points: Vec<Vector3<f64>>,
    /// Corners as given.
    kept: Vec<Vector3<f64>>,
    welded: usize,
    farthest: f64,
}

impl Welder {
    fn new(
        vertices: Vec<Vector3<f64>>,
        used: Vec<bool>,
        center: Vector3<f64>,
        radius: f64,
    ) -> Self {
        let mut welder = Self {
            map: vec![u32::MAX; vertices.len()],
            points: Vec::with_capacity(vertices.len()),
            kept: Vec::with_capacity(vertices.len()),
            welded: 0,
            farthest: 0.0,
        };
        let mut grid = (vertices.len() > FEW).then(|| Grid::new(radius, vertices.len()));
        for (i, v) in vertices.into_iter().enumerate().filter(|&(i, _)| used[i]) {
            let p = v - center;
            // A vertex joins the first corner within reach, never a chain of them: a fine row of
            // vertices does not collapse.
            let found = match &grid {
                Some(grid) => grid.find(&p, &welder.points),
                None => {
                    welder.points.iter().position(|q| (q - p).norm() <= radius).map(|i| i as u32)
                }
            };
            if let Some(corner) = found {
                welder.welded += 1;
                welder.farthest = welder.farthest.max((welder.points[corner as usize] - p).norm());
                welder.map[i] = corner;
                continue;
            }
            let corner = welder.points.len() as u32;
            welder.map[i] = corner;
            welder.points.push(p);
            welder.kept.push(v);
            if let Some(grid) = &mut grid {
                grid.add(&p, corner);
            }
        }
        welder
    }
}

/// Corners by cell; cells are two radii wide, so that a ball touches at most eight.
struct Grid {
    radius: f64,
    /// Last corner put into a cell.
    heads: HashMap<[i64; 3], u32>,
    /// The corner put into the same cell before; `u32::MAX` for none.
    before: Vec<u32>,
}

impl Grid {
    fn new(radius: f64, capacity: usize) -> Self {
        Self {
            radius,
            heads: HashMap::with_capacity(capacity),
            before: Vec::with_capacity(capacity),
        }
    }

    fn cell(&self, p: &Vector3<f64>) -> [i64; 3] {
        [0, 1, 2].map(|k| (p[k] / (2.0 * self.radius)).floor() as i64)
    }

    fn add(&mut self, p: &Vector3<f64>, corner: u32) {
        let before = self.heads.insert(self.cell(p), corner).unwrap_or(u32::MAX);
        self.before.push(before);
    }

    /// The corner of least index within the radius.
    fn find(&self, p: &Vector3<f64>, points: &[Vector3<f64>]) -> Option<u32> {
        let cell = self.cell(p);
        // In each direction the ball reaches over the nearer wall only.
        let step = [0, 1, 2]
            .map(|k| if p[k] / (2.0 * self.radius) - (cell[k] as f64) < 0.5 { -1 } else { 1 });
        let mut found: Option<u32> = None;
        for corner in 0..8 {
            let key = [0, 1, 2].map(|k| cell[k] + if corner >> k & 1 == 1 { step[k] } else { 0 });
            let mut next = self.heads.get(&key).copied().unwrap_or(u32::MAX);
            while next != u32::MAX {
                if (points[next as usize] - p).norm() <= self.radius
                    && found.is_none_or(|f| next < f)
                {
                    found = Some(next);
                }
                next = self.before[next as usize];
            }
        }
        found
    }
}
