//! Which way a scene lies: supports that face sideways or downwards, where gravity pulls, are a
//! mistake of axes.
//!
//! The sign is the mean direction in which supports push on what they carry: the sum of area ×
//! normal over their contacts. It points upwards, more or less, for everything that stands on
//! something, and nowhere for what is held between walls. Drawings with y up read with z up have it
//! level, along the axis that was meant; gravity turned over, or z that points down, has it
//! straight down.

use super::{Interface, Model};
use crate::assembly::{Action, Block, Member, Polyhedron, Solid};
use base::error::{Finding, FindingCode};
use nalgebra::Vector3;

/// Supports face sideways when their mean push has less than this upwards, of at most 1. Larger: a
/// block on a slope of 80° is reported. Smaller: structures on their side whose springings are not
/// quite level are not.
const LEVEL: f64 = 0.1;

/// They face one way when their mean push is at least this, of at most 1. Larger: the springings of
/// a wide arch, 45° apart from each other, are not seen. Smaller: blocks held between walls that
/// are not equally high are reported.
const ONE_WAY: f64 = 0.5;

/// They face along an axis when their mean push has this along it, of its length. Larger: meshes a
/// little off their axes are not seen. Smaller: what leans on a wall at an angle is reported; no
/// turn of axes would mend that.
const ALONG: f64 = 0.97;

/// They face downwards when their mean push has this downwards. Larger: springings of an arch that
/// hangs are not seen. Smaller: blocks wedged between posts that lean over them are reported.
const DOWN: f64 = 0.8;

/// Joints carry weight when their normals, by area, have more than this upwards in the mean.
/// Larger: walls of tall thin slabs are reported. Smaller: prisms that lie on their side are seen
/// only where they are drawn exactly.
const CARRIES: f64 = 0.02;

/// Faces within this × their block's size of the lowest point are in one plane. Larger: joints of
/// thin courses count. Smaller: drawings rounded to three digits have no footing.
const FOOTING: f64 = 1e-2;

/// Joints enough to tell that none of them carries weight. More: short columns on their side are
/// not seen. Fewer: a block squeezed between two walls is reported.
const FEW: usize = 4;

/// Whether the free blocks may stay where they are beside a wall: dead loads press them to supports
/// that push them this way so that friction can carry their weight, or a member holds or presses one.
fn is_held(model: &Model, push: &Vector3<f64>) -> bool {
    let Model { assembly, interfaces, .. } = model;
    let load = |i: usize| -(assembly.dead[i].force - assembly.self_weight(i).force).dot(push);
    let pressed = assembly.free().map(load).sum::<f64>() / push.norm();
    let weight: f64 = assembly.free().map(|i| assembly.weight(i)).sum();
    let held = |i: usize| assembly.blocks[i].support;
    let rubs = |f: &&Interface| held(f.a) != held(f.b);
    let carries = |f: &Interface| pressed > 0.0 && f.law.friction.mu() * pressed >= weight;
    // What is level and along the wall, as the tie of an arch that lies on its side, does neither.
    let across = |d: &Vector3<f64>| {
        [assembly.gravity, *push].iter().any(|w| d.dot(w).abs() > LEVEL * d.norm() * w.norm())
    };
    let holds = |m: &Member| match &m.action {
        Action::Line(anchors) => anchors.windows(2).any(|w| across(&(w[1].at - w[0].at))),
        Action::Push { direction, .. } => across(direction),
        Action::Shear { .. } | Action::Press { .. } => true,
    };
    interfaces.list.iter().filter(rubs).any(carries)
        || interfaces.members.iter().any(|m| !m.is_idle() && holds(m))
}

/// What looks like a mistake of axes.
pub fn mistake(model: &Model) -> Option<Finding> {
    let assembly = &model.assembly;
    let up = -assembly.gravity.normalize();
    let push = push(model)?;
    let text = if up.dot(&push) < -DOWN {
        let remedy = match assembly.gravity {
            g if g.z > 0.0 => "Gravity points upwards: write \"gravity\": [0, 0, -9.81]",
            _ => "If z points down in the drawing: import with --up -z, or turn gravity",
        };
        format!(
            "The free blocks hang below their supports, which push them in the direction of gravity, {}. {remedy}",
            direction(push)
        )
    } else if up.dot(&push).abs() < LEVEL
        && push.norm() > ONE_WAY
        && push.amax() > ALONG * push.norm()
        && !is_held(model, &push)
    {
        format!(
            "The supports push the free blocks sideways only, towards {}, but gravity pulls towards {}: everything lies on its side. \
             If {} points up in the drawing: import with --up {}, or give \"gravity\": {}",
            direction(push),
            direction(assembly.gravity),
            axis(push),
            axis(push),
            along(-push)
        )
    } else {
        return None;
    };
    Some(Finding::new(FindingCode::Axes, text))
}

/// What looks like a mistake of axes although supports do not tell: no joint is inclined so that it
/// could carry weight, or there is no footing below but one on another side.
pub fn on_its_side(model: &Model) -> Option<Finding> {
    let Model { assembly, interfaces, .. } = model;
    let up = -assembly.gravity.normalize();
    let weights = weights(interfaces.list.iter());
    let total: f64 = weights.iter().sum();
    let carried: f64 =
        interfaces.list.iter().zip(&weights).map(|(f, w)| w * f.frame.n.dot(&up).abs()).sum();
    let text = if interfaces.list.len() >= FEW && carried < CARRIES * total {
        "All joints are vertical: no block rests on another, so everything lies on its side. Drawings often have y up: import with --up y".into()
    } else {
        let other = footed(model, up)?;
        format!(
            "No block has a face to stand on below, towards {}, but {} blocks have one in a common plane towards {}: everything lies on its side. If {} points up in the drawing: import with --up {}",
            direction(-up),
            other.1,
            direction(-other.0),
            axis(other.0),
            axis(other.0)
        )
    };
    Some(Finding::new(FindingCode::Axes, text))
}

/// The way up for which several blocks have faces in one plane below, with their number, where the
/// given one has none: a dome or vault on its side. A free face on which nothing could stand, as
/// the top of a wall, is no better than none the other way round, so that only ways up whose
/// opposite has no such plane either count.
fn footed(model: &Model, up: Vector3<f64>) -> Option<(Vector3<f64>, usize)> {
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    let feet = |up: &Vector3<f64>| feet(model, up);
    if feet(&up) > 0 {
        return None;
    }
    let ways = axes.into_iter().flat_map(|a| [a, -a]).map(|way| (way, feet(&way), feet(&-way)));
    let mut footed = ways.filter(|&(_, below, above)| below >= FEW && above == 0);
    // Of two such ways neither is the one.
    footed.next().map(|way| (way.0, way.1)).filter(|_| footed.next().is_none())
}

/// How many blocks have a face that looks down and lies in the lowest plane of all.
fn feet(model: &Model, up: &Vector3<f64>) -> usize {
    let blocks = &model.assembly.blocks;
    let solids = || {
        blocks.iter().filter_map(|b| match &b.solid {
            Solid::Polyhedron(p) => Some((b, p)),
            Solid::Sphere { .. } | Solid::Clump { .. } => None,
        })
    };
    let lowest =
        solids().flat_map(|(_, p)| &p.vertices).map(|v| v.dot(up)).fold(f64::INFINITY, f64::min);
    let stands = |(b, p): &(&Block, &Polyhedron)| {
        p.facets
            .iter()
            .any(|f| f.normal.dot(up) < -ALONG && (f.offset + lowest).abs() <= FOOTING * b.size)
    };
    solids().filter(stands).count()
}

/// The mean direction in which supports push free blocks, of length 1 where all their contacts face
/// the same way.
fn push(model: &Model) -> Option<Vector3<f64>> {
    let held = |i: usize| model.assembly.blocks[i].support;
    let faces: Vec<&Interface> =
        model.interfaces.list.iter().filter(|f| held(f.a) != held(f.b)).collect();
    let weights = weights(faces.iter().copied());
    let total: f64 = weights.iter().sum();
    let sum: Vector3<f64> =
        faces.iter().zip(&weights).map(|(f, w)| f.frame.n * if held(f.a) { *w } else { -w }).sum();
    (total > 0.0).then(|| sum / total)
}

/// Areas; where nothing has an area, all contacts count the same.
fn weights<'a>(faces: impl Iterator<Item = &'a Interface>) -> Vec<f64> {
    let areas: Vec<f64> = faces.map(|f| f.area).collect();
    if areas.iter().sum::<f64>() > 0.0 { areas } else { vec![1.0; areas.len()] }
}

/// The nearest axis, as `--up` takes it.
fn axis(v: Vector3<f64>) -> &'static str {
    let k = v.iamax();
    [["x", "y", "z"], ["-x", "-y", "-z"]][usize::from(v[k] < 0.0)][k]
}

/// Earth's gravity along the nearest axis.
fn along(v: Vector3<f64>) -> String {
    let k = v.iamax();
    let g: [f64; 3] = std::array::from_fn(|i| if i == k { 9.81 * v[k].signum() } else { 0.0 });
    format!("{g:?}").replace(".0", "")
}

/// A direction in two digits.
fn direction(v: Vector3<f64>) -> String {
    // Minus zero is none.
    let v = v.normalize().map(|c| (c * 100.0).round() / 100.0 + 0.0);
    format!("({}, {}, {})", v.x, v.y, v.z)
}
