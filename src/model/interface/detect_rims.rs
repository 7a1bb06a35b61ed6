//! What meets at rims, once it is known where faces lie on faces; near misses of edges and corners; the
//! normals that a scene names.

use super::{
    ContactFrame, ContactKind,
    body::{BoundedBlock, Form},
    faces::Closing,
    features::{self, Touch},
    limits::Limits,
    meeting::{Contact, Near, Pair, of_touch},
    plane::Plane,
    polygon, rims,
};
use crate::assembly::{Assembly, GivenInterface};
use base::error::{InputError, JsonPath};
use nalgebra::Vector3;
use std::collections::{HashMap, HashSet};

/// How far a named normal may lie outside those that are possible: written with three digits.
const NAMED: f64 = 1e-3;

/// Adds to every pair what meets at rims.
pub(super) fn meet(pairs: &mut [Pair], bodies: &[BoundedBlock]) {
    let covers = Covers::of(pairs);
    pairs.iter_mut().filter(|p| p.meeting.rims).for_each(|pair| pair.meet_at_rims(bodies, &covers));
}

/// Gives touches with several normals the ones that the scene names.
///
/// # Errors
/// A normal for a pair that has no such touch, or one that is not possible there.
pub(super) fn name_normals(
    pairs: &mut [Pair],
    normals: &[&GivenInterface],
    assembly: &Assembly,
) -> Result<(), InputError> {
    for g in normals {
        let refuse = |why: &str, hint: &str| {
            let [a, b] = [g.a, g.b].map(|i| &assembly.blocks[i].id);
            let text = format!("the normal of the interface between {a:?} and {b:?} {why}");
            InputError::at(JsonPath::root().key("interfaces"), text).hint(hint)
        };
        let (of, sign) = if g.a < g.b { ((g.a, g.b), 1.0) } else { ((g.b, g.a), -1.0) };
        let pair = pairs.iter_mut().find(|p| (p.a, p.b) == of);
        let contacts = pair.into_iter().flat_map(|p| &mut p.meeting.contacts);
        let mut open = contacts.filter(|c| !c.ways.is_empty()).peekable();
        if open.peek().is_none() {
            return Err(refuse(
                "has no effect: no edges or corners of the two meet with several normals",
                "remove it, or give the points of the contact as well",
            ));
        }
        for contact in open {
            let n = g.normal * sign;
            if !rims::is_among(&n, &contact.ways, NAMED) {
                return Err(refuse(
                    "pushes one of them into the other where they meet",
                    "it points from the first block into the second",
                ));
            }
            contact.ways.clear();
            contact.frame = match contact.points[..] {
                [p, q] => {
                    let along = (q - p).normalize();
                    ContactFrame::along((n - along * n.dot(&along)).normalize(), along)
                }
                _ => ContactFrame::around(n),
            };
        }
    }
    Ok(())
}

impl Contact {
    /// Whether a touch at `p` along one of `ways` is this one.
    fn is_at(&self, p: Vector3<f64>, ways: &[Vector3<f64>], limits: &Limits) -> bool {
        let here = match self.kind {
            ContactKind::Face => self.holds(p, limits),
            _ => {
                let [q, r] = [self.points[0], self.points[self.points.len() - 1]];
                features::distance_to_segment(p, q, r) <= 2.0 * limits.gap
            }
        };
        here && rims::is_among(&self.frame.n, ways, 2.0 * limits.chord)
    }

    /// Whether `p` lies on this face contact, as far as its faces are plane.
    fn holds(&self, p: Vector3<f64>, limits: &Limits) -> bool {
        let plane = Plane { origin: self.points[0], frame: self.frame };
        let reach = limits.gap.max(-self.gap.least).max(self.gap.greatest);
        let inside = |polygon: &Vec<Vector3<f64>>| {
            let flat: Vec<_> = polygon.iter().map(|&x| plane.flat(x)).collect();
            polygon::contains(&flat, plane.flat(p), reach)
        };
        let whole = std::slice::from_ref(&self.points);
        let pieces = if self.pieces.is_empty() { whole } else { &self.pieces[..] };
        plane.height(p).abs() <= reach && pieces.iter().any(inside)
    }
}

/// What lies against the faces of each block whose rims may meet others: the other block, which way
/// the normal points, and the contact.
struct Covers(HashMap<usize, Vec<(usize, f64, Contact)>>);

impl Covers {
    fn of(pairs: &[Pair]) -> Self {
        let asked: HashSet<usize> =
            pairs.iter().filter(|p| p.meeting.rims).flat_map(|p| [p.a, p.b]).collect();
        let mut covers: HashMap<_, Vec<_>> = HashMap::new();
        for pair in pairs {
            for (own, other, out) in [(pair.a, pair.b, 1.0), (pair.b, pair.a, -1.0)] {
                let faces = pair.meeting.contacts.iter().filter(|c| c.kind == ContactKind::Face);
                if asked.contains(&own) {
                    let against = faces.map(|c| (other, out, c.clone()));
                    covers.entry(own).or_default().extend(against);
                }
            }
        }
        Self(covers)
    }

    /// Whether a block other than `b` lies against the face of `a` with this normal, at a point.
    fn any(&self, [a, b]: [usize; 2], n: &Vector3<f64>, at: Vector3<f64>, limits: &Limits) -> bool {
        self.0.get(&a).into_iter().flatten().any(|(other, out, contact)| {
            *other != b && contact.frame.n.dot(n) * out > 0.9 && contact.holds(at, limits)
        })
    }
}

impl Pair {
    fn meet_at_rims(&mut self, bodies: &[BoundedBlock], covers: &Covers) {
        let (a, b, limits) = (&bodies[self.a], &bodies[self.b], &self.limits);
        let (Form::Polyhedron(p), Form::Polyhedron(q)) = (&a.shape, &b.shape) else { return };
        let common = |slack: f64| a.bounds.loosened(slack).common(&b.bounds.loosened(slack));
        let (of_a, of_b) = ([self.a, self.b], [self.b, self.a]);
        let covered = |limits: &Limits| {
            let limits = *limits;
            [of_a, of_b].map(|of| move |n: &Vector3<f64>, at| covers.any(of, n, at, &limits))
        };
        let meeting = &mut self.meeting;
        if a.bounds.distance(&b.bounds) <= limits.gap {
            let known = |p, ways: &[_]| meeting.contacts.iter().any(|c| c.is_at(p, ways, limits));
            let rims = rims::meet([p, q], &common(limits.gap), limits, &covered(limits), &known);
            meeting.idle = rims.idle && meeting.contacts.is_empty() && rims.touches.is_empty();
            meeting.contacts.extend(rims.touches.into_iter().map(|t| of_touch(t, 1.0)));
        }
        if !meeting.contacts.is_empty() || meeting.near.is_some() || meeting.idle {
            return;
        }
        // What would touch if more were closed.
        let far = Limits { gap: limits.near, ..*limits };
        let window = common(far.gap);
        let mut near = features::touches(p, q, &window, &far, &|_, _| false);
        near.extend(rims::meet([p, q], &window, &far, &covered(&far), &|_, _| false).touches);
        let gap = |t: &Touch| t.gap.greatest.max(-t.gap.least);
        let nearest = near.iter().map(gap).fold(f64::INFINITY, f64::min);
        meeting.near = nearest.is_finite().then_some(Near {
            gap: nearest,
            closing: Closing { gap: nearest, lean: 0.0 },
            plane: None,
        });
    }
}
