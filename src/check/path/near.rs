//! Faces that do not touch at the start and may come to: joints without points.

use super::faces::{Faces, flat};
use base::plane::{clip, polygon, polygon::P2};
use model::{
    assembly::{Assembly, Block, Facet, Polyhedron, Solid},
    interface::{ContactFrame, ContactKind, Interface},
};
use nalgebra::Vector3;

/// Faces that are farther apart than this × the smaller block's size, along their normal or beside
/// each other, are none that come to touch: what does is found, and not followed. Farther: time.
const NEAR: f64 = 0.1;
/// Faces whose normals are farther from opposite than this cosine (18°) touch along edges.
const OPPOSITE: f64 = -0.95;

/// Faces that lie behind each other by more than this × how far away they are looked for have their
/// blocks between them, as the two outer faces of a thin slab and of its neighbour: they never meet.
/// Larger: what overlaps from the start is taken for a joint. Smaller: rounding.
const BEHIND: f64 = 1e-9;

/// Bounding box, m.
fn bounds(shape: &Polyhedron) -> [Vector3<f64>; 2] {
    let all = |f: fn(f64, f64) -> f64, from: f64| {
        shape.vertices.iter().fold(Vector3::repeat(from), |a, p| a.zip_map(p, f))
    };
    [all(f64::min, f64::INFINITY), all(f64::max, f64::NEG_INFINITY)]
}

/// Joints that may come to be, beside those that there are.
pub(super) fn joints(assembly: &Assembly, known: &[Interface]) -> Vec<(Interface, Faces)> {
    let mut boxes: Vec<(usize, &Block, &Polyhedron, [Vector3<f64>; 2])> = assembly
        .blocks
        .iter()
        .enumerate()
        .filter_map(|(i, block)| match &block.solid {
            Solid::Polyhedron(shape) => Some((i, block, shape, bounds(shape))),
            _ => None,
        })
        .collect();
    boxes.sort_by(|p, q| p.3[0].x.total_cmp(&q.3[0].x));
    let widest = boxes.iter().map(|b| NEAR * b.1.size).fold(0.0, f64::max);
    let mut found = Vec::new();
    for (k, one) in boxes.iter().enumerate() {
        for two in boxes[k + 1..].iter().take_while(|b| b.3[0].x <= one.3[1].x + widest) {
            let reach = NEAR * one.1.size.min(two.1.size);
            let apart = |axis: usize| {
                one.3[0][axis] > two.3[1][axis] + reach || two.3[0][axis] > one.3[1][axis] + reach
            };
            if (one.1.support && two.1.support) || (0..3).any(apart) {
                continue;
            }
            let (a, b) = if one.0 < two.0 { (one, two) } else { (two, one) };
            let Some(law) = assembly.joints.law(a.0, b.0, &assembly.blocks) else { continue };
            if !law.is_dry() {
                continue;
            }
            let of_pair: Vec<&Interface> = known
                .iter()
                .filter(|f| (f.a, f.b) == (a.0, b.0) || (f.b, f.a) == (a.0, b.0))
                .collect();
            for own in &a.2.facets {
                for other in &b.2.facets {
                    let Some(faces) = facing([a.2, b.2], [own, other], reach) else { continue };
                    let is_known = |f: &&Interface| {
                        let off = f
                            .points
                            .first()
                            .map_or(f64::INFINITY, |p| (own.normal.dot(p) - own.offset).abs());
                        f.frame.n.dot(&own.normal).abs() > -OPPOSITE && off <= reach
                    };
                    if of_pair.iter().any(is_known) {
                        continue;
                    }
                    let joint = Interface {
                        a: a.0,
                        b: b.0,
                        kind: ContactKind::Face,
                        frame: ContactFrame::around(own.normal),
                        points: Vec::new(),
                        area: 0.0,
                        patches: 1,
                        pieces: Vec::new(),
                        ways: Vec::new(),
                        gap: 0.0,
                        law,
                    };
                    found.push((joint, faces));
                }
            }
        }
    }
    found.sort_by_key(|(f, _)| (f.a, f.b));
    found
}

/// Two facets that lie opposite and near each other, with nothing of their blocks between them.
fn facing(shapes: [&Polyhedron; 2], facets: [&Facet; 2], reach: f64) -> Option<Faces> {
    let [own, other] = facets;
    if own.normal.dot(&other.normal) > OPPOSITE {
        return None;
    }
    let gap = |p: Vector3<f64>| own.normal.dot(&p) - own.offset;
    let corners = other.pieces.iter().flat_map(|piece| shapes[1].points(piece)).map(gap);
    if corners.map(f64::abs).fold(f64::INFINITY, f64::min) > reach {
        return None;
    }
    let frame = ContactFrame::around(own.normal);
    let middle = own.normal * own.offset;
    let [below, above] = [0, 1].map(|k| -> Vec<Vec<P2>> {
        facets[k].pieces.iter().map(|p| flat(shapes[k], p, &frame, &middle)).collect()
    });
    let pairs = || below.iter().flat_map(|p| above.iter().map(move |q| (p, q)));
    if !pairs().any(|(p, q)| polygon::touch(p, q, reach)) {
        return None;
    }
    let behind = -BEHIND * reach;
    let common: Vec<P2> = pairs().flat_map(|(p, q)| clip::clip(q, p, BEHIND * reach)).collect();
    let in_front = if common.is_empty() {
        // Beside each other: one of them has all of the other before it.
        let all = |k: usize| {
            let (from, of) = (facets[k], &facets[1 - k].pieces);
            let mut corners = of.iter().flat_map(|p| shapes[1 - k].points(p));
            corners.all(|p| from.normal.dot(&p) - from.offset >= behind)
        };
        all(0) || all(1)
    } else {
        let slope = -own.normal.dot(&other.normal);
        let height = |p: &P2| {
            let at = middle + frame.t1 * p.x + frame.t2 * p.y;
            (other.normal.dot(&at) - other.offset) / slope
        };
        common.iter().all(|p| height(p) >= behind)
    };
    in_front.then(|| Faces::between(shapes, facets))
}
