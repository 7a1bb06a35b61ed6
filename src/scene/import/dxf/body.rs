//! Bodies in space: loose faces (3DFACE) and polyface meshes.

use super::{
    super::raw::{Solid, compact, parts},
    entity::Entity,
    place::Place,
};
use base::error::InputError;
use std::collections::{HashMap, HashSet};

/// Faces of one layer in the order of the file.
#[derive(Default)]
pub(super) struct Faces {
    vertices: Vec<[f64; 3]>,
    at: HashMap<[u64; 3], usize>,
    faces: Vec<Vec<usize>>,
    lines: Vec<Option<usize>>,
    /// Edges of the body at the end where an odd number of its faces meet.
    odd: HashSet<[usize; 2]>,
    /// Where bodies end among the faces.
    ends: Vec<usize>,
}

impl Faces {
    pub fn add(&mut self, entity: &Entity, place: &Place) -> Result<(), InputError> {
        let mut face: Vec<usize> = Vec::with_capacity(4);
        for code in 10..14 {
            // Of a triangle the last corner comes twice, or is not there.
            if code == 13 && entity.pair(code).is_none() {
                continue;
            }
            let corner = place.of(entity.point(code)?);
            let next = self.vertices.len();
            let at = *self.at.entry(corner.map(|c| (c + 0.0).to_bits())).or_insert(next);
            if at == next {
                self.vertices.push(corner);
            }
            if !face.contains(&at) {
                face.push(at);
            }
        }
        if face.len() < 3 {
            return Ok(());
        }
        if place.mirrors() {
            face.reverse();
        }
        for (k, &a) in face.iter().enumerate() {
            let b = face[(k + 1) % face.len()];
            let edge = [a.min(b), a.max(b)];
            if !self.odd.remove(&edge) {
                self.odd.insert(edge);
            }
        }
        self.faces.push(face);
        self.lines.push(entity.kind.line);
        // A body is whole where every edge has its two faces: bodies that touch stay apart.
        if self.odd.is_empty() {
            self.ends.push(self.faces.len());
        }
        Ok(())
    }

    /// The bodies, each with its first line; faces at the end that do not close are joined where they
    /// share corners.
    pub fn bodies(self) -> Vec<(Option<usize>, Solid)> {
        let mut bodies = Vec::new();
        let mut body = |which: &[usize]| {
            let faces = which.iter().map(|&f| self.faces[f].clone()).collect();
            let lines: Vec<usize> = which.iter().filter_map(|&f| self.lines[f]).collect();
            let first = lines.first().copied();
            bodies.push((first, compact(String::new(), lines, &self.vertices, faces)));
        };
        let mut begin = 0;
        for &end in &self.ends {
            body(&(begin..end).collect::<Vec<_>>());
            begin = end;
        }
        let rest = &self.faces[begin..];
        let of = parts(&self.vertices, rest);
        for part in 0..of.iter().max().map_or(0, |m| m + 1) {
            let which: Vec<usize> =
                (0..rest.len()).filter(|&k| of[k] == part).map(|k| begin + k).collect();
            body(&which);
        }
        bodies
    }
}

/// Flags of a VERTEX of a polyface mesh: a corner has both, a face only the second.
const CORNER: i64 = 64;
const OF_POLYFACE: i64 = 128;

/// The body of a polyface mesh.
pub(super) fn polyface(entity: &Entity, place: &Place) -> Result<Solid, InputError> {
    let mut solid = Solid { line: entity.kind.line, ..Solid::default() };
    let vertices = entity.body[entity.head().len()..].chunk_by(|_, next| next.code != 0);
    for (kind, body) in vertices.filter_map(|v| v.split_first()) {
        let vertex = Entity { kind, body };
        let flags = vertex.flags();
        if flags & CORNER != 0 {
            solid.vertices.push(place.of(vertex.point(10)?));
        } else if flags & OF_POLYFACE != 0 {
            let mut face = Vec::with_capacity(4);
            for pair in (71..75).filter_map(|code| vertex.pair(code)) {
                // A negative number is the corner before an edge that is not drawn.
                let number = pair.number()?.abs() as usize;
                if number == 0 {
                    continue;
                }
                if number > solid.vertices.len() {
                    let message = format!("corner {number} of a face, of {}", solid.vertices.len());
                    return Err(pair.error(message).hint("the file may be damaged here"));
                }
                if !face.contains(&(number - 1)) {
                    face.push(number - 1);
                }
            }
            if face.len() >= 3 {
                if place.mirrors() {
                    face.reverse();
                }
                solid.faces.push(face);
                solid.lines.extend(vertex.kind.line);
            }
        }
    }
    Ok(solid)
}
