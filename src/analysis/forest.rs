//! Contacts without a closed chain: what each one carries follows from statics alone, and whether
//! it can is a matter of a polygon and a cone.
//!
//! Seen from the supports every block hangs on one contact, which carries all that lies behind it:
//! a force R through one point r of its plane. It stands where R presses (N > 0), r lies in the
//! hull of the contact (Heyman 1966, for arches) and `‖T‖ ≤ μ N`; the corners then share N in
//! proportion to the barycentric coordinates of r, and T in the same proportion. Nothing else can
//! be in equilibrium, so that what does not stand falls. A horizontal acceleration `a` (in g) moves
//! N, N r and T linearly in `a`: the least that any contact bears in its weakest direction is the
//! margin.

use base::tolerance::{COORDINATE_ROUNDING, FOREST_EDGE};
use check::{
    terms::Bracket,
    verdict::{Forces, no_forces},
};
use model::{
    assembly::Wrench,
    interface::{Interface, Model},
};
use nalgebra::{Matrix3, Vector3};
use scene::Friction;

/// What a contact carries.
struct Carried {
    /// Index of the contact.
    face: usize,
    /// The block that it carries, and all that hangs on that.
    block: usize,
    /// +1 where this is the second block of the contact, else −1.
    sign: f64,
    /// Normal, into the block.
    n: Vector3<f64>,
    /// Mean of the corners, m.
    origin: Vector3<f64>,
    /// What the contact exerts on the block, about `origin`.
    wrench: Wrench,
    /// Mass behind the contact, kg, and its first moment about `origin`, kg·m.
    mass: f64,
    moment: Vector3<f64>,
    /// Lengths below this are none, m.
    rounding: f64,
}

/// What all contacts of a scene without a closed chain carry, under its dead load.
pub struct Forest<'a> {
    model: &'a Model,
    carried: Vec<Carried>,
}

/// What becomes of such a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// Every contact can carry what it has to.
    Stands,
    /// What this block rests on cannot carry it and what rests on it.
    Falls(usize),
    /// So near to the edge of a contact or of its friction that rounding would decide.
    TooClose,
}

/// Directions by which the margin of an inclined contact is enclosed. Fewer: a wider bracket (its
/// width is 5e-3/n² of the margin for n × 64). More: time.
const DIRECTIONS: usize = 256;

impl<'a> Forest<'a> {
    /// Looks for chains from the supports. Nothing where contacts close one, where a block hangs
    /// on nothing, where joints know more than dry friction, or where members act.
    pub fn of(model: &'a Model) -> Option<Self> {
        let Model { assembly, interfaces, .. } = model;
        if !interfaces.members.is_empty() || interfaces.list.iter().any(|f| !f.law.is_dry()) {
            return None;
        }
        let blocks = &assembly.blocks;
        if interfaces.list.len() != blocks.iter().filter(|b| !b.support).count() {
            return None;
        }
        let order = from_the_supports(model)?;
        // Of each block and what hangs on it: load and first moment of the masses about its centre,
        // mass, and how far the longest chain reaches.
        let mut loads: Vec<(Wrench, Vector3<f64>, f64, f64)> = (0..blocks.len())
            .map(|i| (assembly.dead[i], Vector3::zeros(), blocks[i].mass, 0.0))
            .collect();
        let mut carried = Vec::with_capacity(order.len());
        // From the ends of the chains back to the supports.
        for &(face, block, on) in order.iter().rev() {
            let (load, moment, mass, span) = loads[block];
            let list = &interfaces.list[face];
            let sign = if list.b == block { 1.0 } else { -1.0 };
            let origin = list.points.iter().sum::<Vector3<f64>>() / list.points.len() as f64;
            let arm = blocks[block].centroid - origin;
            let wrench =
                Wrench { force: -load.force, moment: -load.moment - arm.cross(&load.force) };
            let reach = list.points.iter().map(|p| (p - origin).norm()).fold(0.0, f64::max);
            let far = origin.amax() + arm.norm() + span;
            carried.push(Carried {
                face,
                block,
                sign,
                n: list.frame.n * sign,
                origin,
                wrench,
                mass,
                moment: moment + arm * mass,
                rounding: FOREST_EDGE * reach + COORDINATE_ROUNDING * order.len() as f64 * far,
            });
            if !blocks[on].support {
                let arm = blocks[block].centroid - blocks[on].centroid;
                let under = &mut loads[on];
                under.0 +=
                    Wrench { force: load.force, moment: load.moment + arm.cross(&load.force) };
                under.1 += moment + arm * mass;
                under.2 += mass;
                under.3 = under.3.max(span + arm.norm());
            }
        }
        Some(Self { model, carried })
    }

    /// Whether it stands.
    pub fn fate(&self) -> Fate {
        let mut fate = Fate::Stands;
        for own in &self.carried {
            match own.stands(&self.model.interfaces.list[own.face]) {
                Some(true) => {}
                Some(false) => return Fate::Falls(own.block),
                None => fate = Fate::TooClose,
            }
        }
        fate
    }

    /// Forces that balance the dead load, where it stands.
    pub fn forces(&self) -> Option<Forces> {
        let list = &self.model.interfaces.list;
        let mut forces = no_forces(&self.model.interfaces);
        for own in &self.carried {
            let face = &list[own.face];
            let normal = own.n.dot(&own.wrench.force);
            let shares = shares(face, &own.n, &(own.origin + own.pressed_at(normal)))?;
            for (force, share) in forces[own.face].iter_mut().zip(shares) {
                force.force = own.wrench.force * (own.sign * share);
            }
        }
        Some(forces)
    }

    /// The greatest horizontal acceleration, in g, that it bears in every direction; of a scene
    /// that stands, under nothing but its weight.
    pub fn margin(&self) -> Bracket {
        let gravity = self.model.assembly.gravity;
        let g = gravity.norm();
        let up = -gravity / g;
        let mut least = Bracket { lower: f64::INFINITY, upper: f64::INFINITY };
        for own in &self.carried {
            let margin = own.margin(&self.model.interfaces.list[own.face], &up, g, least.lower);
            least.lower = least.lower.min(margin.lower);
            least.upper = least.upper.min(margin.upper);
        }
        least
    }
}

impl Carried {
    /// Where the resultant goes through the plane, from the origin, m.
    fn pressed_at(&self, normal: f64) -> Vector3<f64> {
        self.n.cross(&self.wrench.moment) / normal
    }

    /// Whether the contact can carry it; nothing where that is too close to say.
    fn stands(&self, face: &Interface) -> Option<bool> {
        let Self { n, wrench, rounding, .. } = self;
        let whole = wrench.force.norm();
        let normal = n.dot(&wrench.force);
        if normal.abs() <= FOREST_EDGE * whole {
            return None;
        }
        if normal < 0.0 {
            return Some(false);
        }
        let at = self.pressed_at(normal);
        let along = wrench.force - n * normal;
        let twist = n.dot(&(wrench.moment - at.cross(&along)));
        // A twist besides the force: friction shares it in a way of its own.
        if twist.abs() > rounding * whole {
            return None;
        }
        let inside = inside(face, n, &(self.origin + at));
        let slides = match face.law.friction {
            Friction::Infinite => f64::NEG_INFINITY,
            Friction::Coefficient(mu) => along.norm() - mu * normal,
        };
        let close = FOREST_EDGE * whole;
        if inside < -rounding || slides > close {
            return Some(false);
        }
        (inside > *rounding && (slides < -close || slides < 0.0 && along.norm() <= close))
            .then_some(true)
    }

    /// The least horizontal acceleration (in g) that tips or slides what it carries; `known` is a
    /// margin that another contact has already.
    fn margin(&self, face: &Interface, up: &Vector3<f64>, g: f64, known: f64) -> Bracket {
        let Self { n, wrench, mass, moment, .. } = self;
        let level = Matrix3::identity() - up * up.transpose();
        let weight = mass * g;
        let normal = n.dot(&wrench.force);
        let about = n.cross(&wrench.moment);
        // Force and moment of the contact are those at rest less the load of the acceleration.
        let pull = (level * n).norm() * weight;
        let mut least = if pull > 0.0 { normal / pull } else { f64::INFINITY };
        for (corner, inward) in edges(face, n) {
            let arm = corner - self.origin;
            let rest = inward.dot(&about) - inward.dot(&arm) * normal;
            let slope = (n * -inward.dot(moment) + inward * n.dot(moment)) * g
                + n * (inward.dot(&arm) * weight);
            let slope = (level * slope).norm();
            if slope > 0.0 {
                least = least.min(rest / slope);
            }
        }
        let Friction::Coefficient(mu) = face.law.friction else {
            return Bracket { lower: least, upper: least };
        };
        let along = wrench.force - n * normal;
        let spare = mu * normal - along.norm();
        // At least so much, whatever the direction; exactly that where the contact is level.
        let simple = spare / (weight + mu * pull);
        if pull <= f64::EPSILON * weight || simple >= least.min(known) {
            let lower = least.min(simple);
            let upper = if pull <= f64::EPSILON * weight { lower } else { least };
            return Bracket { lower, upper };
        }
        let slides = self.slides_at(mu, normal, &along, up, weight);
        Bracket { lower: least.min(slides.lower), upper: least.min(slides.upper) }
    }

    /// The same for sliding on an inclined contact. What it bears is convex: a polygon of points
    /// that it bears lies inside, and the nearest of these points bounds the least.
    fn slides_at(
        &self,
        mu: f64,
        normal: f64,
        along: &Vector3<f64>,
        up: &Vector3<f64>,
        weight: f64,
    ) -> Bracket {
        let frame = model::interface::ContactFrame::around(*up);
        let mut points = Vec::with_capacity(DIRECTIONS);
        for k in 0..DIRECTIONS {
            let angle = std::f64::consts::TAU * k as f64 / DIRECTIONS as f64;
            let toward = frame.t1 * angle.cos() + frame.t2 * angle.sin();
            let push = -toward * weight;
            let pressed = self.n.dot(&push);
            let shear = push - self.n * pressed;
            // ‖T + x t‖ = μ (N + x p): the least positive x.
            let a = shear.norm_squared() - (mu * pressed).powi(2);
            let b = along.dot(&shear) - mu * mu * normal * pressed;
            let c = along.norm_squared() - (mu * normal).powi(2);
            points.push(toward * least_root(a, b, c));
        }
        let upper = points.iter().map(|p| p.norm()).fold(f64::INFINITY, f64::min);
        let lower = (0..DIRECTIONS)
            .map(|k| distance(&points[k], &points[(k + 1) % DIRECTIONS]))
            .fold(upper, f64::min);
        Bracket { lower, upper }
    }
}

/// The least positive root of `a x² + 2 b x + c` with `c < 0`; a very large number where there is
/// none.
fn least_root(a: f64, b: f64, c: f64) -> f64 {
    let none = 1e9;
    let inner = b * b - a * c;
    if inner < 0.0 {
        return none;
    }
    // Without cancellation, for both signs of b.
    let root = inner.sqrt();
    let (one, two) = if b >= 0.0 {
        (-(b + root) / a, -c / (b + root))
    } else {
        ((root - b) / a, c / (root - b))
    };
    [one, two].into_iter().filter(|x| *x > 0.0).fold(none, f64::min)
}

/// How far the segment between two points is from the origin.
fn distance(p: &Vector3<f64>, q: &Vector3<f64>) -> f64 {
    let side = q - p;
    let length = side.norm_squared();
    let share = if length > 0.0 { (-p.dot(&side) / length).clamp(0.0, 1.0) } else { 0.0 };
    (p + side * share).norm()
}

/// The contacts in the order in which they are met from the supports: each with the block that it
/// carries and the one that carries that.
fn from_the_supports(model: &Model) -> Option<Vec<(usize, usize, usize)>> {
    let Model { assembly, interfaces, .. } = model;
    let count = assembly.blocks.len();
    let mut touch: Vec<Vec<(usize, usize)>> = vec![Vec::new(); count];
    for (k, face) in interfaces.list.iter().enumerate() {
        touch[face.a].push((k, face.b));
        touch[face.b].push((k, face.a));
    }
    let mut met: Vec<bool> = assembly.blocks.iter().map(|b| b.support).collect();
    let mut open: Vec<usize> = (0..count).filter(|&i| met[i]).collect();
    let mut order = Vec::with_capacity(interfaces.list.len());
    let mut used = vec![false; interfaces.list.len()];
    let mut next = 0;
    while let Some(&here) = open.get(next) {
        next += 1;
        for &(face, there) in &touch[here] {
            if std::mem::replace(&mut used[face], true) {
                continue;
            }
            if std::mem::replace(&mut met[there], true) {
                return None;
            }
            order.push((face, there, here));
            open.push(there);
        }
    }
    (open.len() == count).then_some(order)
}

/// The sides of a contact: a corner and the direction inward. One at two points or one has none.
fn edges<'a>(
    face: &'a Interface,
    n: &'a Vector3<f64>,
) -> impl Iterator<Item = (Vector3<f64>, Vector3<f64>)> + 'a {
    let count = face.points.len();
    let around = if face.frame.n.dot(n) > 0.0 { 1.0 } else { -1.0 };
    (0..count).filter(move |_| count >= 3).filter_map(move |k| {
        let (p, q) = (face.points[k], face.points[(k + 1) % count]);
        let inward = n.cross(&(q - p)) * around;
        let length = inward.norm();
        (length > 0.0).then(|| (p, inward / length))
    })
}

/// How far inside the hull of a contact a point of its plane lies, m; negative outside.
fn inside(face: &Interface, n: &Vector3<f64>, at: &Vector3<f64>) -> f64 {
    match face.points[..] {
        [] => f64::NEG_INFINITY,
        [p] => -(at - p).norm(),
        [p, q] => -distance(&(p - at), &(q - at)),
        _ => edges(face, n).map(|(p, inward)| inward.dot(&(at - p))).fold(f64::INFINITY, f64::min),
    }
}

/// Shares of the corners whose mean is a point of the plane: barycentric coordinates in the
/// triangle from the first corner that holds it.
fn shares(face: &Interface, n: &Vector3<f64>, at: &Vector3<f64>) -> Option<Vec<f64>> {
    let points = &face.points;
    let mut shares = vec![0.0; points.len()];
    if points.len() < 3 {
        return None;
    }
    let area = |p: &Vector3<f64>, q: &Vector3<f64>| n.dot(&(p - at).cross(&(q - at)));
    let of = |k: usize| {
        let own = [
            area(&points[k], &points[k + 1]),
            area(&points[k + 1], &points[0]),
            area(&points[0], &points[k]),
        ];
        let whole: f64 = own.iter().sum();
        own.map(|a| a / whole)
    };
    let least = |own: &[f64; 3]| own.iter().copied().fold(f64::INFINITY, f64::min);
    let (k, own) = (1..points.len() - 1)
        .map(|k| (k, of(k)))
        .filter(|(_, own)| own.iter().all(|x| x.is_finite()))
        .max_by(|(_, x), (_, y)| least(x).total_cmp(&least(y)))?;
    for (corner, share) in [0, k, k + 1].into_iter().zip(own) {
        shares[corner] = share.max(0.0);
    }
    Some(shares)
}
