//! What a joint carries beside friction, derived from its law and the pieces of its contact without
//! the numbers of the program.
//!
//! *Independent.* Area and first moment are integrals around the rims of the pieces, in space
//! (Green: `∫ dA = ½ ∮ n·(x × dx)`, `∫ x dA = ⅓ ∮ x n·(x × dx)`), where the program adds triangles
//! up in the plane of the joint. Water pushes with its pressure times the area at the centroid,
//! where the program has a force at each corner: `Σ a_k = A` and `Σ a_k p_k = ∫ x dA` make the two
//! one. The shares `a_k` come from areas of the polar dual of the hull about the centroid (Ju,
//! Schaefer, Warren & Desbrun 2005, "A geometric construction of coordinates for convex polyhedra
//! using polar duals"), where the program multiplies areas of triangles. Which tension and which
//! rolling arm count is read off the law here again.
//!
//! *Not independent.* Corners, pieces and normal of a contact are those that detection found. On
//! four corners and more the two sums leave `n − 3` numbers open: that the shares are Wachspress's
//! coordinates of the centroid, and not others as true of a uniform stress, is a choice that both
//! have to make alike. Crushing is no matter of shares but of pressures over the area: the bound is
//! one for the program and for the checker ([`crushing`](model::strength::crushing)).

use model::{
    assembly::Wrench,
    interface::Interface,
    strength::crushing::{crushes, crushing},
};
use nalgebra::Vector3;
use scene::Friction;

/// What the corners of a joint carry beside friction, N.
#[derive(Clone, Debug, Default)]
pub struct Strength {
    /// Cohesion and tension at each corner; empty where there are none.
    corners: Vec<[f64; 2]>,
}

impl Strength {
    /// The strength of an interface.
    pub fn of(face: &Interface) -> Self {
        let (cohesion, tension) = (face.law.cohesion, tension(face));
        if cohesion == 0.0 && tension == 0.0 {
            return Self::default();
        }
        Self { corners: shares(face).into_iter().map(|a| [cohesion * a, tension * a]).collect() }
    }

    /// Cohesion and tension of a corner, N.
    pub fn at(&self, corner: usize) -> [f64; 2] {
        self.corners.get(corner).copied().unwrap_or_default()
    }

    /// The use of the compressive strength, where there is one.
    pub fn crushing(&self, face: &Interface, forces: &[Wrench]) -> Option<f64> {
        let (normal, sigma) = self.pressed(face, forces)?;
        Some(crushing(face, &normal, sigma).0)
    }

    /// Normal forces from the tensile strength on, and the strength from there; where there is a
    /// compressive strength.
    pub fn pressed(&self, face: &Interface, forces: &[Wrench]) -> Option<(Vec<f64>, f64)> {
        if !crushes(face) {
            return None;
        }
        let normal = forces
            .iter()
            .enumerate()
            .map(|(k, f)| (face.frame.n.dot(&f.force) + self.at(k)[1]).max(0.0))
            .collect();
        Some((normal, face.law.compression + tension(face)))
    }
}

/// Tensile strength that counts, Pa: where normal forces pull with cohesion / μ, nothing is left
/// for shear.
pub fn tension(face: &Interface) -> f64 {
    match face.law.friction {
        Friction::Coefficient(mu) if mu > 0.0 && mu * face.law.tension > face.law.cohesion => {
            face.law.cohesion / mu
        }
        _ => face.law.tension,
    }
}

/// Rolling arm that counts, m: that of an edge or a point.
pub fn rolling_arm(face: &Interface) -> f64 {
    if face.points.len() > 2 { 0.0 } else { face.law.rolling_arm }
}

/// The push of the water in the joint on block `b`, N, N·m about the first contact point; its
/// opposite acts on `a`. `None` where there is no water.
pub fn water(face: &Interface) -> Option<Wrench> {
    if face.law.pore_pressure == 0.0 {
        return None;
    }
    let (area, centroid) = touching(face)?;
    let force = face.frame.n * (face.law.pore_pressure * area);
    Some(Wrench { force, moment: centroid.cross(&force) })
}

/// Share of the area at each corner, m²; zero where there is no area.
fn shares(face: &Interface) -> Vec<f64> {
    let (count, n) = (face.points.len(), face.frame.n);
    let Some((area, centroid)) = touching(face) else { return vec![0.0; count] };
    let rim: Vec<Vector3<f64>> =
        face.points.iter().map(|p| p - face.points[0] - centroid).collect();
    // Corners of the dual, turned by a right angle: along a side, as far out as the side is near.
    let dual: Vec<Vector3<f64>> = sides(&rim).map(|(p, q)| (q - p) / n.dot(&p.cross(&q))).collect();
    let sector = |k: usize| n.dot(&dual[(k + count - 1) % count].cross(&dual[k]));
    let whole: f64 = (0..count).map(sector).sum();
    (0..count).map(|k| area * (sector(k) / whole)).collect()
}

/// The area that touches, m², and the way from the first contact point to its centroid, m; `None`
/// where there is no area.
fn touching(face: &Interface) -> Option<(f64, Vector3<f64>)> {
    let origin = *face.points.first()?;
    let whole = std::slice::from_ref(&face.points);
    let (mut area, mut moment) = (0.0, Vector3::zeros());
    for piece in if face.pieces.is_empty() { whole } else { &face.pieces } {
        let rim: Vec<Vector3<f64>> = piece.iter().map(|p| p - origin).collect();
        let (mut own, mut first) = (0.0, Vector3::zeros());
        for (p, q) in sides(&rim) {
            let cross = face.frame.n.dot(&p.cross(&q));
            own += cross / 2.0;
            first += (p + q) * (cross / 6.0);
        }
        // Pieces run either way round.
        area += own.abs();
        moment += first * own.signum();
    }
    (face.area > 0.0 && area > 0.0).then(|| (area, moment / area))
}

/// The sides of a closed loop.
fn sides(rim: &[Vector3<f64>]) -> impl Iterator<Item = (Vector3<f64>, Vector3<f64>)> + '_ {
    rim.iter().zip(rim.iter().cycle().skip(1)).map(|(&p, &q)| (p, q))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::exact::balance::room;
    use model::{
        assembly::JointLaw,
        interface::{ContactFrame, ContactKind},
        strength,
    };
    use proptest::prelude::*;

    /// Contacts that are convex polygons, 3 × 1 m about the origin.
    fn polygon() -> impl Strategy<Value = Interface> {
        prop::collection::vec((0.5f64..1.0, 0.0f64..1.0), 3..8).prop_map(|rays| {
            let n = rays.len() as f64;
            // Corners on an ellipse at separate angles: always convex.
            let corner = |(k, (_, turn)): (usize, &(f64, f64))| {
                let angle = (k as f64 + 0.8 * turn) / n * std::f64::consts::TAU;
                Vector3::new(3.0 * angle.cos(), angle.sin(), 2.0)
            };
            let mut face = Interface {
                a: 0,
                b: 1,
                kind: ContactKind::Face,
                frame: ContactFrame::around(Vector3::z()),
                points: rays.iter().enumerate().map(corner).collect(),
                area: 0.0,
                patches: 1,
                pieces: Vec::new(),
                ways: Vec::new(),
                gap: 0.0,
                law: JointLaw::dry(Friction::Coefficient(0.5)),
            };
            face.area = 0.5 * sides(&face.points).map(|(p, q)| p.x * q.y - p.y * q.x).sum::<f64>();
            face
        })
    }

    /// Convex contacts, whole or with a part left out, the pieces wound either way.
    fn contact() -> impl Strategy<Value = Interface> {
        (polygon(), 0usize..20, any::<bool>()).prop_map(|(mut face, out, turned)| {
            let mut pieces: Vec<_> =
                face.points[1..].windows(2).map(|w| vec![face.points[0], w[0], w[1]]).collect();
            if out < pieces.len() && pieces.len() > 1 {
                pieces.remove(out);
                pieces.iter_mut().skip(1).filter(|_| turned).for_each(|piece| piece.reverse());
                face.pieces = pieces;
            }
            face.law.cohesion = 2.0;
            face.law.tension = 1.0;
            face.law.pore_pressure = 3.0;
            face
        })
    }

    fn moment(face: &Interface, shares: &[f64]) -> Vector3<f64> {
        face.points.iter().zip(shares).map(|(p, a)| (p - face.points[0]) * *a).sum()
    }

    proptest! {
        #[test]
        fn the_shares_of_the_program_are_found_again(face in contact()) {
            let (own, other) = (shares(&face), strength::shares(&face));
            for (a, b) in own.iter().zip(&other) {
                prop_assert!((a - b).abs() < 1e-10 && *a > 0.0, "{own:?} and {other:?}");
            }
        }

        #[test]
        fn shares_have_the_area_and_its_first_moment(face in contact()) {
            let (area, centroid) = touching(&face).unwrap();
            let shares = shares(&face);
            prop_assert!((shares.iter().sum::<f64>() - area).abs() < 1e-12);
            prop_assert!((moment(&face, &shares) - centroid * area).norm() < 1e-10);
        }

        /// One force at the centroid does what the program's forces at the corners do.
        #[test]
        fn the_water_of_the_program_is_found_again(face in contact()) {
            let Wrench { force, moment } = water(&face).unwrap();
            let corners = strength::uplift(&face);
            let about: Vector3<f64> = face.points.iter().zip(&corners).map(|(p, f)| (p - face.points[0]).cross(f)).sum();
            prop_assert!((force - corners.iter().sum::<Vector3<f64>>()).norm() < 1e-11);
            prop_assert!((moment - about).norm() < 1e-10);
        }

        /// Were the program to give a corner some of the share of another, forces that use it would
        /// be outside their cones here, and its water would push elsewhere.
        #[test]
        fn a_wrong_share_of_the_program_is_caught(face in contact(), from in 0usize..8, on in 1usize..7, part in 1e-6f64..1.0) {
            let count = face.points.len();
            let (from, to) = (from % count, (from + 1 + on % (count - 1)) % count);
            let strength = Strength::of(&face);
            let fits = |shares: &[f64]| shares.iter().enumerate().all(|(k, a)| {
                let pull = Wrench { force: face.frame.n * (-face.law.tension * a * (1.0 - 1e-9)), moment: Vector3::zeros() };
                room(&face, k, &pull, &strength).margin >= 0.0
            });
            let right = strength::shares(&face);
            let mut wrong = right.clone();
            wrong[to] += part * right[from];
            wrong[from] -= part * right[from];
            prop_assert!(fits(&right) && !fits(&wrong));
            let (area, centroid) = touching(&face).unwrap();
            let distance = (face.points[to] - face.points[from]).norm();
            prop_assert!((moment(&face, &wrong) - centroid * area).norm() > 0.9 * part * right[from] * distance);
        }

        #[test]
        fn tension_ends_where_shear_has_none(face in polygon(), mu in 0.0f64..2.0, cohesion in 0.0f64..2.0, most in 0.0f64..2.0) {
            for friction in [Friction::Coefficient(0.0), Friction::Coefficient(mu), Friction::Infinite] {
                let mut face = face.clone();
                (face.law.friction, face.law.cohesion, face.law.tension) = (friction, cohesion, most);
                prop_assert!((tension(&face) - strength::tension(&face)).abs() < 1e-15);
                let left = if let Friction::Coefficient(mu) = friction { cohesion - mu * tension(&face) } else { 0.0 };
                prop_assert!(tension(&face) <= most && left > -1e-15);
            }
        }
    }
}
