//! Scenes that are mirror images of themselves about a plane need only that plane.
//!
//! If blocks, contacts and loads are mirrored about the plane `axis · x = offset`, any admissible
//! forces averaged with their mirror image are admissible again (cones are convex) and have no
//! resultant across the plane; dropping the components along `axis` keeps them inside the friction
//! cone. Three unknown rates a block remain, each interface is a segment with two ends, and the
//! friction cone is two rays: a linear program instead of a second-order one, with exactly the same
//! answer. Rates in the plane are admissible in space as they stand. Members have to lie in the
//! mirror plane.

use base::tolerance;
use model::{
    assembly::{Action, Member, Wrench},
    interface::{ContactFrame, Model},
};
use nalgebra::Vector3;

/// A mirror plane of the scene, with axes in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Unit normal of the plane.
    pub axis: Vector3<f64>,
    /// `axis · x` on the plane, m.
    pub offset: f64,
    /// First axis in the plane.
    pub e1: Vector3<f64>,
    /// Second axis in the plane; `(e1, e2, axis)` is right-handed.
    pub e2: Vector3<f64>,
}

/// The mirror plane of a scene with its dead and live loads, if it has one with all contact normals
/// in it.
pub fn find(model: &Model, loads: &[&[model::assembly::Wrench]]) -> Option<Plane> {
    candidates(model, loads).into_iter().find_map(|axis| mirrored(model, loads, axis))
}

/// Directions that may be normal to the mirror plane, most likely first.
fn candidates(model: &Model, loads: &[&[model::assembly::Wrench]]) -> Vec<Vector3<f64>> {
    let Model { assembly, interfaces, .. } = model;
    let mut list = Vec::new();
    let mut add = |v: Vector3<f64>| {
        if v.norm() > tolerance::SPANS {
            list.push(v.normalize());
        }
    };
    let down = assembly.gravity.normalize();
    if let Some(first) = interfaces.list.first() {
        for face in &interfaces.list {
            let cross = first.frame.n.cross(&face.frame.n);
            if cross.norm() > tolerance::SPANS {
                add(cross);
                break;
            }
        }
    }
    for force in loads.iter().flat_map(|l| l.iter()).map(|w| w.force).filter(|f| f.norm() > 0.0) {
        let cross = down.cross(&force.normalize());
        if cross.norm() > tolerance::SPANS {
            add(cross);
            break;
        }
    }
    if let Some(face) = interfaces.list.iter().find(|f| f.points.len() > 2) {
        for k in 0..face.points.len().min(4) {
            let edge = face.points[(k + 1) % face.points.len()] - face.points[k];
            add(edge / edge.norm());
        }
    }
    list.extend([Vector3::y(), Vector3::x(), Vector3::z()]);
    list
}

/// Distance within which `x` counts as zero for a block or interface of the given size.
fn near(x: f64, size: f64) -> bool {
    x.abs() <= tolerance::MIRROR * size
}

fn mirrored(
    model: &Model,
    loads: &[&[model::assembly::Wrench]],
    axis: Vector3<f64>,
) -> Option<Plane> {
    let Model { assembly, interfaces, .. } = model;
    let first = assembly.free().next()?;
    let offset = axis.dot(&assembly.blocks[first].centroid);
    let in_plane = |v: &Vector3<f64>| axis.dot(v).abs() <= tolerance::MIRROR * v.norm();
    if !in_plane(&assembly.gravity) {
        return None;
    }
    for i in assembly.free() {
        let block = &assembly.blocks[i];
        if !near(axis.dot(&block.centroid) - offset, block.size) {
            return None;
        }
        for load in loads {
            let Wrench { force, moment } = &load[i];
            let across = moment - axis * axis.dot(moment);
            if !in_plane(force)
                || across.norm() > tolerance::MIRROR * (moment.norm() + force.norm() * block.size)
            {
                return None;
            }
        }
    }
    for face in &interfaces.list {
        let size = assembly.blocks[face.a].size.min(assembly.blocks[face.b].size);
        if axis.dot(&face.frame.n).abs() > tolerance::MIRROR
            || !points_mirrored(&face.points, axis, offset, size)
        {
            return None;
        }
    }
    if !interfaces.members.iter().all(|m| lies_in(model, m, &axis, offset)) {
        return None;
    }
    let down = assembly.gravity.normalize();
    let e2 = -(down - axis * axis.dot(&down)).normalize();
    Some(Plane { axis, offset, e1: e2.cross(&axis), e2 })
}

fn points_mirrored(points: &[Vector3<f64>], axis: Vector3<f64>, offset: f64, size: f64) -> bool {
    points.iter().all(|p| mirror_of(points, *p, axis, offset, size).is_some())
}

/// Index of the mirror image of `p` among `points`.
pub(super) fn mirror_of(
    points: &[Vector3<f64>],
    p: Vector3<f64>,
    axis: Vector3<f64>,
    offset: f64,
    size: f64,
) -> Option<usize> {
    let image = p - axis * (2.0 * (axis.dot(&p) - offset));
    points.iter().position(|q| near((q - image).norm(), size))
}

/// Whether a member is its own image about a plane, and acts in it.
fn lies_in(model: &Model, member: &Member, axis: &Vector3<f64>, offset: f64) -> bool {
    let blocks = &model.assembly.blocks;
    let size = member
        .action
        .ends()
        .into_iter()
        .flatten()
        .map(|i| blocks[i].size)
        .fold(f64::INFINITY, f64::min);
    let on = |p: &Vector3<f64>| (axis.dot(p) - offset).abs() <= tolerance::MIRROR * size;
    // Of the two tangents of a frame one has to lie in the plane and the other across.
    let framed = |n: &Vector3<f64>| {
        let frame = ContactFrame::around(*n);
        let along = |t: &Vector3<f64>| axis.dot(t).abs();
        let (one, other) = (along(&frame.t1), along(&frame.t2));
        one.min(other) <= tolerance::MIRROR && along(n) <= tolerance::MIRROR
    };
    member.action.points().iter().all(on)
        && match &member.action {
            Action::Line(_) => true,
            Action::Push { direction, .. } => axis.dot(direction).abs() <= tolerance::MIRROR,
            Action::Shear { normal, .. } | Action::Press { normal, .. } => framed(normal),
        }
}
