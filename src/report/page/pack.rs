//! The view as arrays that a browser reads without parsing: little-endian numbers in base64, each
//! array with its kind before it (`f32:…`).
//!
//! Lengths are in units of the size of the view about its middle and forces in units of the
//! greatest one, so that single precision has seven digits of each whatever the units of the scene.

use crate::{
    drawing,
    view::{Course, View, ViewLoad, ViewMotion, ViewShape, ViewState},
};
use check::verdict::mechanism::JointMotion as Kind;
use data_encoding::BASE64;
use model::interface::ContactKind;
use nalgebra::Vector3;
use serde_json::{Value, json};

/// An array of single-precision numbers.
fn singles(values: impl IntoIterator<Item = f64>) -> String {
    let bytes: Vec<u8> = values.into_iter().flat_map(|v| (v as f32).to_le_bytes()).collect();
    format!("f32:{}", BASE64.encode(&bytes))
}

/// An array of whole numbers, in two bytes each where they fit.
fn wholes(values: impl IntoIterator<Item = usize>) -> String {
    let values: Vec<usize> = values.into_iter().collect();
    if values.iter().all(|v| u16::try_from(*v).is_ok()) {
        let bytes: Vec<u8> = values.into_iter().flat_map(|v| (v as u16).to_le_bytes()).collect();
        return format!("u16:{}", BASE64.encode(&bytes));
    }
    let bytes: Vec<u8> = values.into_iter().flat_map(|v| (v as u32).to_le_bytes()).collect();
    format!("u32:{}", BASE64.encode(&bytes))
}

/// An array of numbers between −1 and 1 in two bytes each.
fn shares(values: impl IntoIterator<Item = f64>) -> String {
    let bytes: Vec<u8> =
        values.into_iter().flat_map(|v| ((v * 32767.0).round() as i16).to_le_bytes()).collect();
    format!("i16:{}", BASE64.encode(&bytes))
}

/// Where each of several lists begins in their concatenation, and where the last one ends.
fn starts(lengths: impl IntoIterator<Item = usize>) -> String {
    let sums = lengths.into_iter().scan(0, |sum, n| {
        *sum += n;
        Some(*sum)
    });
    wholes(std::iter::once(0).chain(sums))
}

fn flat<'a>(points: impl IntoIterator<Item = &'a Vector3<f64>>) -> impl Iterator<Item = f64> {
    points.into_iter().flat_map(|p| [p.x, p.y, p.z])
}

/// Units of a view.
struct Units {
    length: f64,
    middle: Vector3<f64>,
    force: f64,
}

impl Units {
    fn points<'a>(&self, points: impl IntoIterator<Item = &'a Vector3<f64>>) -> String {
        let list: Vec<Vector3<f64>> =
            points.into_iter().map(|p| (p - self.middle) / self.length).collect();
        singles(flat(&list))
    }

    fn forces<'a>(&self, forces: impl IntoIterator<Item = &'a Vector3<f64>>) -> String {
        singles(flat(forces).map(|f| f / self.force))
    }
}

/// Everything that the page draws.
pub(super) fn view(view: &View) -> Value {
    let greatest = view
        .states
        .iter()
        .flat_map(|s| s.resultants.iter().flatten())
        .map(|r| r.force.norm())
        .fold(0.0, f64::max);
    let units = Units {
        length: view.size(),
        middle: view.middle(),
        force: if greatest.is_finite() && greatest > 0.0 { greatest } else { 1.0 },
    };
    let plane = drawing::plane(view);
    let front = plane.unwrap_or(view.front);
    // Roughly where one stands at first.
    let corner = if plane.is_some() {
        front
    } else {
        (front + view.up.cross(&front) * 0.4 + view.up * 0.3).normalize()
    };
    json!({
        "name": view.name,
        "length": units.length,
        "middle": view.middle().as_slice(),
        "force": units.force,
        "up": view.up.as_slice(),
        "caption": view.caption,
        "front": front.as_slice(),
        "plane": plane.is_some(),
        "supports": if view.hides_supports { "hidden" } else if view.walled(&corner) { "glass" } else { "shown" },
        "extent": ((view.high - view.low) / units.length).as_slice(),
        "bodies": bodies(view, &units),
        "joints": joints(view, &units),
        "members": members(view, &units),
        "slope": view.slope.as_ref().map(|s| json!({
            "surface": units.points(&s.surface),
            "line": units.points(&s.line),
            "angle": s.angle_deg,
        })),
        "loads": loads(&view.loads, &units),
        "pressures": pressures(view, &units),
        "states": view.states.iter().map(|s| state(s, view.joints.len(), &units)).collect::<Vec<_>>(),
        "motions": view.motions.iter().map(|m| motion(m, &units)).collect::<Vec<_>>(),
        "film": film(view, &units),
        "values": view.values.as_ref().map(|v| json!({
            "name": v.name,
            "ends": v.ends,
            "of": singles(v.of.iter().map(|v| v.unwrap_or(f64::NAN))),
        })),
    })
}

fn bodies(view: &View, units: &Units) -> Value {
    let mut materials: Vec<&str> =
        view.bodies.iter().filter_map(|b| b.material.as_deref()).collect();
    materials.sort_unstable();
    materials.dedup();
    let material = |b: &crate::view::BlockView| {
        b.material.as_deref().and_then(|m| materials.binary_search(&m).ok()).map_or(0, |k| k + 1)
    };
    let surfaces: Vec<_> = view
        .bodies
        .iter()
        .map(|b| match &b.shape {
            ViewShape::Surface(s) => Some(s),
            ViewShape::Sphere(_) => None,
        })
        .collect();
    let there = || surfaces.iter().flatten();
    json!({
        "ids": view.bodies.iter().map(|b| b.id.as_str()).collect::<Vec<_>>(),
        "materials": materials,
        "material": wholes(view.bodies.iter().map(material)),
        "support": wholes(view.bodies.iter().map(|b| usize::from(b.support))),
        "mass": view.bodies.iter().map(|b| b.mass).collect::<Vec<_>>(),
        "center": units.points(view.bodies.iter().map(|b| &b.center)),
        "radius": singles(view.bodies.iter().map(|b| match b.shape { ViewShape::Sphere(r) => r / units.length, ViewShape::Surface(_) => 0.0 })),
        "cornerStart": starts(surfaces.iter().map(|s| s.map_or(0, |s| s.corners.len()))),
        "corners": units.points(there().flat_map(|s| &s.corners)),
        // Each piece is its number of corners, then the corners.
        "pieceStart": starts(surfaces.iter().map(|s| s.map_or(0, |s| s.pieces.iter().map(|p| p.len() + 1).sum()))),
        "pieces": wholes(there().flat_map(|s| &s.pieces).flat_map(|p| std::iter::once(p.len()).chain(p.iter().map(|&i| i as usize)))),
        "edgeStart": starts(surfaces.iter().map(|s| s.map_or(0, |s| 2 * s.edges.len()))),
        "edges": wholes(there().flat_map(|s| &s.edges).flatten().map(|&i| i as usize)),
    })
}

fn loads(list: &[ViewLoad], units: &Units) -> Value {
    json!({
        "body": wholes(list.iter().map(|l| l.body)),
        "at": units.points(list.iter().map(|l| &l.at)),
        "newton": list.iter().flat_map(|l| l.force.iter().copied().collect::<Vec<_>>()).collect::<Vec<f64>>(),
        "live": wholes(list.iter().map(|l| usize::from(l.live))),
    })
}

fn joints(view: &View, units: &Units) -> Value {
    let kind = |k: ContactKind| match k {
        ContactKind::Face => 0,
        ContactKind::Edge => 1,
        ContactKind::Point => 2,
        ContactKind::Given => 3,
    };
    let mut laws: Vec<String> = Vec::new();
    let law: Vec<usize> = view
        .joints
        .iter()
        .map(|j| {
            let words = law(&j.law);
            laws.iter().rposition(|l| *l == words).unwrap_or_else(|| {
                laws.push(words);
                laws.len() - 1
            })
        })
        .collect();
    json!({
        "a": wholes(view.joints.iter().map(|j| j.a)),
        "b": wholes(view.joints.iter().map(|j| j.b)),
        "kind": wholes(view.joints.iter().map(|j| kind(j.kind))),
        "normal": singles(flat(view.joints.iter().map(|j| &j.normal))),
        "center": units.points(view.joints.iter().map(|j| &j.center)),
        "area": singles(view.joints.iter().map(|j| j.area / units.length.powi(2))),
        "laws": laws,
        "law": wholes(law),
        "pointStart": starts(view.joints.iter().map(|j| j.points.len())),
        "points": units.points(view.joints.iter().flat_map(|j| &j.points)),
    })
}

fn members(view: &View, units: &Units) -> Value {
    let list = || view.members.iter();
    let none = view.bodies.len();
    json!({
        "ids": list().map(|m| m.id.as_str()).collect::<Vec<_>>(),
        "kinds": list().map(|m| m.kind.word()).collect::<Vec<_>>(),
        "start": starts(list().map(|m| m.points.len())),
        "points": units.points(list().flat_map(|m| &m.points)),
        // One more than the last block: the ground.
        "bodies": wholes(list().flat_map(|m| {
            (0..m.points.len()).map(move |k| m.bodies.get(k).copied().flatten().unwrap_or(none))
        })),
        // Not a number: no direction.
        "direction": singles(list().flat_map(|m| {
            let d = m.direction.unwrap_or_else(|| Vector3::repeat(f64::NAN));
            [d.x, d.y, d.z]
        })),
        "newton": list().map(|m| m.force).collect::<Vec<_>>(),
        "strength": list().map(|m| Some(m.strength).filter(|s| s.is_finite())).collect::<Vec<_>>(),
        "slack": list().map(|m| m.slack).collect::<Vec<_>>(),
    })
}

/// How a joint resists, in words.
fn law(law: &model::assembly::JointLaw) -> String {
    use base::number::short;
    let mu = law.friction.mu();
    let mut words =
        vec![if mu.is_finite() { format!("friction {}", short(mu)) } else { "no sliding".into() }];
    for (name, value, unit) in [
        ("cohesion", law.cohesion, "Pa"),
        ("tensile strength", law.tension, "Pa"),
        ("compressive strength", law.compression, "Pa"),
        ("pore pressure", law.pore_pressure, "Pa"),
        ("rolling arm", law.rolling_arm, "m"),
    ] {
        if value != 0.0 && value.is_finite() {
            words.push(format!("{name} {} {unit}", short(value)));
        }
    }
    words.join(", ")
}

/// Resultants are the sums of the forces, which the page adds up. A share of the section that is
/// not a number: nothing presses.
fn state(s: &ViewState, joints: usize, units: &Units) -> Value {
    let of = |f: &dyn Fn(&crate::view::Resultant) -> f64| {
        singles(s.resultants.iter().map(|r| r.as_ref().map_or(f64::NAN, f)))
    };
    let at: Vec<Vector3<f64>> =
        s.resultants.iter().map(|r| r.map_or(units.middle, |r| r.at)).collect();
    json!({
        "name": s.name,
        "live": s.live,
        "forces": units.forces(s.forces.iter().flatten()),
        "at": units.points(&at),
        "used": of(&|r| r.used),
        "mobilised": of(&|r| r.mobilised.unwrap_or(f64::NAN)),
        "kern": wholes(s.resultants.iter().map(|r| usize::from(r.is_some_and(|r| r.in_kern)))),
        "bodyUsed": singles(s.used.iter().map(|u| u.unwrap_or(f64::NAN))),
        "lineBody": wholes(s.line.iter().map(|l| l.body)),
        "lineJoint": wholes(s.line.iter().map(|l| l.joint)),
        // One more than the last joint: the centre of mass.
        "lineOther": wholes(s.line.iter().map(|l| l.other.unwrap_or(joints))),
    })
}

/// Pressed parts of elastic joints: shares of the greatest pressure at their corners.
fn pressures(view: &View, units: &Units) -> Value {
    let list = || view.pressures.iter();
    let greatest = list().flat_map(|p| &p.pressure).copied().fold(0.0, f64::max);
    if greatest <= 0.0 {
        return Value::Null;
    }
    json!({
        "greatest": greatest,
        "joint": wholes(list().map(|p| p.joint)),
        "start": starts(list().map(|p| p.points.len())),
        "points": units.points(list().flat_map(|p| &p.points)),
        "share": singles(list().flat_map(|p| p.pressure.iter().map(move |v| v / greatest))),
    })
}

/// Rates per unit of the way of the fastest corner, both in units of length; of displacements that way
/// as it is.
fn motion(m: &ViewMotion, units: &Units) -> Value {
    let kind = |k: Kind| match k {
        Kind::Hinge => "hinge",
        Kind::Slide => "slides",
        Kind::HingeAndSlide => "slides and rotates",
        Kind::Part => "separates",
        Kind::Crush => "crushes",
    };
    json!({
        "name": if m.is_displacement { format!("{}, magnified", m.name) } else { m.name.clone() },
        "real": m.is_displacement.then_some(m.reach / units.length),
        "velocity": singles(m.rates.iter().flat_map(|r| (r.velocity / m.reach).iter().copied().collect::<Vec<_>>())),
        "spin": singles(m.rates.iter().flat_map(|r| (r.spin * (units.length / m.reach)).iter().copied().collect::<Vec<_>>())),
        "markJoint": wholes(m.marks.iter().map(|k| k.joint)),
        "markKind": m.marks.iter().map(|k| kind(k.kind)).collect::<Vec<_>>(),
        "markAt": units.points(m.marks.iter().map(|k| &k.at)),
    })
}

/// Shifts and rotation vectors from the start, each over the greatest of all.
fn film(view: &View, units: &Units) -> Value {
    if view.film.len() < 2 {
        return Value::Null;
    }
    let shift: Vec<Vector3<f64>> = view
        .film
        .iter()
        .flat_map(|f| {
            f.blocks.iter().zip(&view.bodies).map(|(p, b)| (p.center - b.center) / units.length)
        })
        .collect();
    let turn: Vec<Vector3<f64>> =
        view.film.iter().flat_map(|f| f.blocks.iter().map(|p| p.turn.scaled_axis())).collect();
    let greatest = |list: &[Vector3<f64>]| {
        list.iter()
            .map(|v| v.amax())
            .filter(|m| m.is_finite())
            .fold(f64::MIN_POSITIVE.sqrt(), f64::max)
    };
    let (far, wide) = (greatest(&shift), greatest(&turn));
    json!({
        "times": view.film.iter().map(|f| f.time).collect::<Vec<_>>(),
        "energy": view.film.iter().map(|f| f.energy).collect::<Vec<_>>(),
        "name": match view.film.last() {
            Some(f) if view.course == Course::default() => {
                format!("{}, {} steps", view.course.name, format!("{:?}", f.fidelity).to_lowercase())
            }
            _ => view.course.name.clone(),
        },
        "quantity": view.course.quantity,
        "unit": view.course.unit,
        "way": view.course.way,
        "opens": view.course.opens.map_or(1.0, |k| k as f64 / (view.film.len() - 1) as f64),
        "words": view.course.words,
        "labels": view.course.labels,
        "loads": view.course.loads.iter().map(|list| loads(list, units)).collect::<Vec<_>>(),
        "hidden": wholes(view.course.hidden.iter().flatten().map(|h| usize::from(*h))),
        "far": far,
        "wide": wide,
        "shift": shares(flat(&shift).map(|v| v / far)),
        "turn": shares(flat(&turn).map(|v| v / wide)),
    })
}
