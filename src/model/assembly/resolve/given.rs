//! Interfaces given by hand → [`GivenInterface`]: plane, in hull order around the normal, with a
//! normal and a friction.
//!
//! For rigid blocks with dry friction a force at an inner point of a contact is a convex
//! combination of forces at the corners of its hull (each share of the same direction, so each in
//! the friction cone): points inside the hull are left out, and that is said.

use super::{Names, check, joints, shape::diagonal};
use crate::assembly::{Assembly, Block, GivenInterface, JointLaw, Solid};
use base::{
    error::{Finding, FindingCode, InputError, JsonPath},
    plane::polygon,
    tolerance::{COPLANAR, GIVEN_APART, WELD},
};
use nalgebra::{Vector2, Vector3};
use scene::{InterfaceSpec, Scene};

type Corner = Vector3<f64>;

/// The given interfaces and what was mended in them.
pub(super) fn resolve(
    scene: &Scene,
    assembly: &Assembly,
    names: &Names,
) -> Result<(Vec<GivenInterface>, Vec<Finding>), InputError> {
    let path = JsonPath::root().key("interfaces");
    let mut notes = Notes::default();
    let given = scene
        .interfaces
        .iter()
        .enumerate()
        .map(|(i, spec)| one(spec, assembly, names, &path.index(i), &mut notes));
    let given = given.collect::<Result<Vec<_>, _>>()?;
    Ok((given, notes.findings()))
}

fn one(
    spec: &InterfaceSpec,
    assembly: &Assembly,
    names: &Names,
    path: &JsonPath,
    notes: &mut Notes,
) -> Result<GivenInterface, InputError> {
    let (a, b) = names.pair(&spec.between, &path.key("between"))?;
    let (one, two) = (&assembly.blocks[a], &assembly.blocks[b]);
    if one.support && two.support {
        return Err(InputError::at(
            path.key("between"),
            format!("{:?} and {:?} are both supports: nothing moves between them", one.id, two.id),
        )
        .hint("remove the interface"));
    }
    let law = match (
        joints::friction(spec.friction, None, path)?,
        assembly.joints.law(a, b, &assembly.blocks),
    ) {
        (Some(friction), Some(law)) => JointLaw { friction, ..law },
        (Some(friction), None) => JointLaw::dry(friction),
        (None, Some(law)) => law,
        (None, None) => {
            return Err(InputError::at(
                path.clone(),
                "no friction is given here or by the joint rules",
            )
            .hint("add \"friction\""));
        }
    };

    let at = path.key("points");
    let points = spec
        .points
        .iter()
        .enumerate()
        .map(|(k, &p)| check::vector(p, &at.index(k)))
        .collect::<Result<Vec<_>, _>>()?;
    let normal = spec.normal.map(|n| check::direction(n, &path.key("normal"))).transpose()?;
    if points.is_empty() {
        if spec.friction.is_some() {
            return Err(InputError::at(
                path.key("friction"),
                "a normal alone cannot have friction",
            )
            .hint("give the points as well, or a joint override for the pair"));
        }
        let normal = normal.ok_or_else(|| {
            InputError::at(path.clone(), "an interface needs at least one point, or a normal").hint(
                "\"normal\" alone names the direction across which edges or corners of the two meet",
            )
        })?;
        return Ok(GivenInterface { a, b, points, normal, law });
    }
    let extent = diagonal(&points);
    if !(extent * extent).is_finite() {
        return Err(
            InputError::at(at, "the points are too far apart to compute").hint("lengths are in m")
        );
    }
    let points = distinct(points, WELD * extent, path, notes);

    let slack = assembly.contact.angle_deg.to_radians().sin();
    let (points, normal) = match spread(&points, WELD * extent) {
        Spread::Point => {
            (points, normal.ok_or_else(|| no_normal(path, "one point does not define a normal"))?)
        }
        Spread::Line(from, to) => {
            if points.len() > 2 {
                notes.add(Note::Inner, path, (points.len() - 2) as f64);
            }
            let normal = normal
                .ok_or_else(|| no_normal(path, "points on one line do not define a normal"))?;
            let along = (points[to] - points[from]).normalize();
            let slope = normal.dot(&along);
            if slope.abs() > slack {
                return Err(off_plane(path, slope, "is not at right angles to the edge"));
            }
            (vec![points[from], points[to]], (normal - along * slope).normalize())
        }
        Spread::Plane(raw) => {
            let size = one.size.min(two.size);
            let (mut points, plane) = polygon(&points, raw, extent, path, notes);
            let off = off_mean_plane(&points, plane);
            let deviation = off.iter().fold(0.0f64, |m, d| m.max(d.abs()));
            if deviation > assembly.contact.gap * size {
                return Err(InputError::at(at, format!("the points are not in one plane: they lie up to {deviation:.3e} m off it")).hint(
                    format!(
                        "at most {:.3e} m is taken as plane (contact.gap × block size); split the interface",
                        assembly.contact.gap * size
                    ),
                ));
            }
            if deviation > COPLANAR * size {
                notes.add(Note::Warped, path, deviation);
                points.iter_mut().zip(off).for_each(|(p, d)| *p -= plane * d);
            }
            let plane = match normal {
                None => away(plane, one, two, path)?,
                Some(n) => {
                    let sine = n.cross(&plane).norm();
                    if sine > slack {
                        return Err(off_plane(
                            path,
                            sine,
                            "is not at right angles to the plane of the points",
                        ));
                    }
                    plane * n.dot(&plane).signum()
                }
            };
            // The hull turns about the normal it was made with.
            if plane.dot(&raw) < 0.0 {
                points.reverse();
            }
            (points, plane)
        }
    };
    if spec.normal.is_some() {
        let between = two.centroid - one.centroid;
        if normal.dot(&between) < 0.0 {
            notes.add(Note::Against, path, normal.dot(&between));
        }
    }
    for block in [one, two] {
        let apart = points.iter().map(|p| outside(p, block)).fold(0.0, f64::max);
        if apart > GIVEN_APART * block.size {
            notes.add(Note::Apart, path, apart);
            break;
        }
    }
    Ok(GivenInterface { a, b, points, normal, law })
}

fn no_normal(path: &JsonPath, why: &str) -> InputError {
    InputError::at(path.clone(), format!("the normal is missing: {why}"))
        .hint("add \"normal\": [x, y, z], from the first block into the second")
}

fn off_plane(path: &JsonPath, sine: f64, what: &str) -> InputError {
    let angle = sine.abs().min(1.0).asin().to_degrees();
    InputError::at(path.key("normal"), format!("the normal {what}: {angle:.3}° off"))
        .hint("correct it; where three or more points span a plane it may be left out")
}

/// Points further than `near` from every earlier one.
fn distinct(points: Vec<Corner>, near: f64, path: &JsonPath, notes: &mut Notes) -> Vec<Corner> {
    let before = points.len();
    // Sorted along the longest axis, only neighbours within `near` have to be looked at.
    let (low, high) = points.iter().fold((points[0], points[0]), |(l, h), p| (l.inf(p), h.sup(p)));
    let axis = (high - low).imax();
    let mut order: Vec<usize> = (0..before).collect();
    order.sort_by(|&i, &j| points[i][axis].total_cmp(&points[j][axis]).then(i.cmp(&j)));
    let mut repeated = vec![false; before];
    for (k, &i) in order.iter().enumerate() {
        if repeated[i] {
            continue;
        }
        for &j in order[k + 1..].iter().take_while(|&&j| points[j][axis] - points[i][axis] <= near)
        {
            repeated[j] |= (points[j] - points[i]).norm() <= near;
        }
    }
    let kept: Vec<Corner> =
        points.into_iter().zip(repeated).filter(|(_, r)| !r).map(|(p, _)| p).collect();
    if kept.len() < before {
        notes.add(Note::Repeated, path, (before - kept.len()) as f64);
    }
    kept
}

/// What some points span.
enum Spread {
    Point,
    /// The two ends.
    Line(usize, usize),
    /// A unit normal of the plane of the widest triangle found.
    Plane(Corner),
}

fn spread(points: &[Corner], near: f64) -> Spread {
    let farthest = |measure: &dyn Fn(&Corner) -> f64| {
        (0..points.len())
            .map(|i| (i, measure(&points[i])))
            .max_by(|x, y| x.1.total_cmp(&y.1))
            .unwrap_or((0, 0.0))
    };
    let (from, _) = farthest(&|p| (p - points[0]).norm());
    let (to, length) = farthest(&|p| (p - points[from]).norm());
    if length <= near {
        return Spread::Point;
    }
    let along = (points[to] - points[from]) / length;
    let (third, width) = farthest(&|p| (p - points[from]).cross(&along).norm());
    if width <= near {
        return Spread::Line(from, to);
    }
    Spread::Plane(along.cross(&(points[third] - points[from])).normalize())
}

/// The convex hull of points that span a plane, counter-clockwise about `raw`, and its unit normal
/// on the same side.
fn polygon(
    points: &[Corner],
    raw: Corner,
    extent: f64,
    path: &JsonPath,
    notes: &mut Notes,
) -> (Vec<Corner>, Corner) {
    let axis = Vector3::ith(raw.iamin(), 1.0);
    let u = (axis - raw * raw.dot(&axis)).normalize();
    let v = raw.cross(&u);
    let flat: Vec<Vector2<f64>> =
        points.iter().map(|p| p - points[0]).map(|d| Vector2::new(u.dot(&d), v.dot(&d))).collect();
    let hull = polygon::corners(&flat);

    let mut corner = vec![false; flat.len()];
    hull.iter().for_each(|&i| corner[i] = true);
    let inner = (0..flat.len())
        .filter(|&i| !corner[i])
        .filter(|&i| depth(&flat, &hull, i) > WELD * extent)
        .count();
    if inner > 0 {
        notes.add(Note::Inner, path, inner as f64);
    }
    let n = hull.len();
    let falls = (0..n).filter(|&k| hull[k] > hull[(k + 1) % n]).count();
    // Once round the outline the numbers fall once (or, clockwise, rise once).
    if falls != 1 && falls != n - 1 {
        notes.add(Note::Reordered, path, n as f64);
    }
    let corners: Vec<Corner> = hull.iter().map(|&i| points[i]).collect();
    // Newell: twice the vector area, about the first corner.
    let area: Corner =
        corners.windows(2).map(|w| (w[0] - corners[0]).cross(&(w[1] - corners[0]))).sum();
    (corners, area.normalize())
}

/// How deep a point lies inside a hull.
fn depth(points: &[Vector2<f64>], hull: &[usize], i: usize) -> f64 {
    let sides = (0..hull.len()).map(|k| {
        let (p, q) = (points[hull[k]], points[hull[(k + 1) % hull.len()]]);
        polygon::cross(p, q, points[i]) / (q - p).norm()
    });
    sides.fold(f64::INFINITY, f64::min)
}

/// The signed distances of the points from their mean plane.
fn off_mean_plane(points: &[Corner], normal: Corner) -> Vec<f64> {
    let heights: Vec<f64> = points.iter().map(|p| normal.dot(&(p - points[0]))).collect();
    let mean = heights.iter().sum::<f64>() / heights.len() as f64;
    heights.into_iter().map(|h| h - mean).collect()
}

/// The normal turned from the first block's centre towards the second's.
fn away(normal: Corner, one: &Block, two: &Block, path: &JsonPath) -> Result<Corner, InputError> {
    let between = two.centroid - one.centroid;
    let height = normal.dot(&between);
    // Closer to the plane than this the sign is a matter of rounding.
    if height.abs() <= COPLANAR * (one.size + two.size) {
        return Err(InputError::at(
            path.clone(),
            "the normal is missing: the centres of the two blocks do not show which side is which",
        )
        .hint("add \"normal\": [x, y, z], from the first block into the second"));
    }
    Ok(normal * height.signum())
}

/// Distance of a point from the bounding box of a block.
fn outside(point: &Corner, block: &Block) -> f64 {
    match &block.solid {
        Solid::Sphere { center, radius } => ((point - center).norm() - radius).max(0.0),
        Solid::Clump { balls, .. } => {
            balls.iter().map(|(c, r)| (point - c).norm() - r).fold(f64::INFINITY, f64::min).max(0.0)
        }
        Solid::Polyhedron(p) => {
            let first = p.vertices.first().copied().unwrap_or_default();
            let (low, high) =
                p.vertices.iter().fold((first, first), |(l, h), v| (l.inf(v), h.sup(v)));
            (point - point.sup(&low).inf(&high)).norm()
        }
    }
}

/// What there is to say about given interfaces, one finding per kind.
#[derive(Default)]
struct Notes(Vec<(Note, JsonPath, f64)>);

#[derive(Clone, Copy, PartialEq)]
enum Note {
    Repeated,
    Reordered,
    Inner,
    Warped,
    Against,
    Apart,
}

impl Notes {
    fn add(&mut self, note: Note, path: &JsonPath, value: f64) {
        self.0.push((note, path.clone(), value));
    }

    fn findings(self) -> Vec<Finding> {
        let kinds = [
            Note::Repeated,
            Note::Reordered,
            Note::Inner,
            Note::Warped,
            Note::Against,
            Note::Apart,
        ];
        kinds.into_iter().filter_map(|kind| self.finding(kind)).collect()
    }

    fn finding(&self, kind: Note) -> Option<Finding> {
        let hits = || self.0.iter().filter(|(k, ..)| *k == kind);
        let (_, path, _) = hits().next()?;
        let count = hits().count();
        let worst = hits().map(|(.., v)| v.abs()).fold(0.0, f64::max);
        let total: f64 = hits().map(|(.., v)| v).sum();
        let place =
            if count > 1 { format!("{path} and {} more", count - 1) } else { path.to_string() };
        let (code, text) = match kind {
            Note::Repeated => (FindingCode::Mended, format!("{total} repeated points were left out.")),
            Note::Reordered => {
                (FindingCode::Mended, "the points were not in order around the contact; they were put in order around their hull.".into())
            }
            Note::Inner => (
                FindingCode::Mended,
                format!("{total} points inside the convex hull were left out (forces there are combinations of forces at its corners)."),
            ),
            Note::Warped => (FindingCode::Warped, format!("the points lie up to {worst:.3e} m off their plane; they were moved onto it.")),
            Note::Against => (
                FindingCode::Orientation,
                format!(
                    "the given normal points from the second block's centre towards the first's (by {worst:.3e} m). Is the order of the two blocks right?"
                ),
            ),
            Note::Apart => (
                FindingCode::Units,
                format!("points lie up to {worst:.3e} m outside a block that they belong to. Are they in m, in scene coordinates?"),
            ),
        };
        Some(Finding::new(code, format!("Given interface {place}: {text}")))
    }
}
