use super::{
    crushing::{closing_volume, crushing, edge_bounds},
    section::Section,
    shares,
    shares::coordinates,
};
use crate::{
    assembly::JointLaw,
    interface::{ContactFrame, ContactKind, Interface},
};
use base::plane::polygon::P2;
use nalgebra::Vector3;
use proptest::prelude::*;
use scene::Friction;

fn face(points: &[[f64; 2]]) -> Interface {
    let points: Vec<Vector3<f64>> = points.iter().map(|p| Vector3::new(p[0], p[1], 2.0)).collect();
    let frame = ContactFrame::around(Vector3::z());
    let law = JointLaw::dry(Friction::Coefficient(0.5));
    let mut face = Interface {
        a: 0,
        b: 1,
        kind: ContactKind::Face,
        frame,
        points,
        area: 0.0,
        patches: 1,
        pieces: Vec::new(),
        ways: Vec::new(),
        gap: 0.0,
        law,
    };
    face.area = Section::new(&face).area_and_moment().0;
    face
}

fn centroid(section: &Section) -> P2 {
    let (area, moment) = section.area_and_moment();
    moment / area
}

fn rectangle(b: f64, t: f64) -> Interface {
    face(&[[0.0, 0.0], [b, 0.0], [b, t], [0.0, t]])
}

#[test]
fn shares_of_a_rectangle_are_quarters() {
    assert!(shares(&rectangle(2.0, 3.0)).iter().all(|a| (a - 1.5).abs() < 1e-14));
}

/// Products of so many small areas are below the least number.
#[test]
fn a_fine_half_disc_has_shares() {
    let arc = (0..=300)
        .map(|k| (f64::from(k) / 300.0 * std::f64::consts::PI).sin_cos())
        .map(|(s, c)| [0.01 * c, 0.01 * s]);
    let face = face(&arc.collect::<Vec<_>>());
    let sum: f64 = shares(&face).iter().sum();
    assert!((sum / face.area - 1.0).abs() < 1e-12, "{sum} of {}", face.area);
}

#[test]
fn a_rectangle_bent_about_one_axis_carries_the_block_at_its_edge() {
    let (b, t, sigma) = (0.5, 2.0, 3.0);
    let face = rectangle(b, t);
    // Resultant at y: the block is 2 y deep, N = 2 y b σ.
    for y in [0.05, 0.3, 0.9] {
        let n = 2.0 * y * b * sigma;
        let [low, high] = [n * (1.0 - y / t) / 2.0, n * y / t / 2.0];
        let forces = |by: f64| [low * by, low * by, high * by, high * by];
        assert!(crushing(&face, &forces(1.0 - 1e-9), sigma).0 < 1.0);
        let (used, cut) = crushing(&face, &forces(1.01), sigma);
        let cut = cut.unwrap();
        let at = |by: f64| {
            cut.weights.iter().zip(forces(by)).map(|(w, f)| w * f).sum::<f64>()
                / (sigma * cut.capacity)
        };
        assert!(used > 1.0 && at(1.01) > 1.0 && at(0.98) < 1.0, "{used}");
    }
}

#[test]
fn a_corner_carries_a_triangle() {
    // Resultant at (c, c) near the corner of a unit square: the triangle with legs 3 c has its
    // centroid there.
    let (face, sigma, c) = (rectangle(1.0, 1.0), 10.0, 0.1);
    let n = sigma * 4.5 * c * c;
    let at =
        |by: f64| [(1.0 - c) * (1.0 - c), c * (1.0 - c), c * c, c * (1.0 - c)].map(|w| w * n * by);
    assert!(crushing(&face, &at(1.0 - 1e-6), sigma).0 < 1.0);
    assert!((crushing(&face, &at(1.0), sigma).0 - 1.0).abs() < 1e-9);
    assert!(crushing(&face, &at(1.0 + 1e-6), sigma).0 > 1.0);
    // The strips along the edges alone would allow far more: 2 σ c.
    assert!(n < 0.25 * 2.0 * sigma * c);
}

#[test]
fn holes_do_not_carry() {
    let mut face = rectangle(3.0, 1.0);
    face.pieces = [0.0, 2.0]
        .map(|x| {
            [[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]]
                .map(|p| Vector3::new(p[0], p[1], 2.0))
                .to_vec()
        })
        .to_vec();
    face.area = 2.0;
    assert!((crushing(&face, &[0.5; 4], 1.0).0 - 1.0).abs() < 1e-9);
    assert!(crushing(&face, &[0.51; 4], 1.0).0 > 1.0);
}

/// Contacts that are convex polygons, 3 × 1 m about the origin.
fn polygon() -> impl Strategy<Value = Interface> {
    prop::collection::vec((0.5f64..1.0, 0.0f64..1.0), 3..8).prop_map(|rays| {
        let n = rays.len() as f64;
        // Corners on an ellipse at separate angles: always convex.
        let corner = |(k, (_, turn)): (usize, &(f64, f64))| {
            let angle = (k as f64 + 0.8 * turn) / n * std::f64::consts::TAU;
            [3.0 * angle.cos(), angle.sin()]
        };
        face(&rays.iter().enumerate().map(corner).collect::<Vec<_>>())
    })
}

/// A square of which one corner closes while the next but one opens, by how much does not matter:
/// the plane through three corners that leaves the fourth free, not the fit of all four, lifted.
#[test]
fn corners_that_open_on_their_own_cost_nothing() {
    let square = rectangle(1.0, 1.0);
    assert_eq!(closing_volume(&square, &[-1.0, -0.5, 0.0, -2.0]), 0.0);
    for (rates, want) in [
        // Affine: the plane itself.
        ([1.0, 1.0, 0.0, 0.0], 0.5),
        ([1.0, 0.0, -1.0, 0.0], 1.0 / 6.0),
        // The third corner is free.
        ([1.0, 0.0, -3.0, 0.0], 1.0 / 6.0),
    ] {
        let volume = closing_volume(&square, &rates);
        assert!((volume - want).abs() < 1e-9, "{rates:?}: {volume} {want}");
    }
}

proptest! {
    #[test]
    fn shares_have_the_area_and_its_first_moment(face in polygon()) {
        let shares = shares(&face);
        let section = Section::new(&face);
        let (area, first) = section.area_and_moment();
        let moment = section.corners.iter().zip(&shares).map(|(p, a)| p * *a).sum::<P2>();
        prop_assert!((shares.iter().sum::<f64>() - area).abs() < 1e-12);
        prop_assert!((moment - first).norm() < 1e-11);
        prop_assert!(shares.iter().all(|a| *a > 0.0));
    }

    /// Every pressure between 0 and σ passes, and none that passes breaks a bound along an edge.
    #[test]
    fn pressures_within_the_strength_pass(face in polygon(), angle in 0.0f64..6.3, offset in -1.0f64..1.0, level in 0.1f64..1.0) {
        let sigma = 2.0;
        let slope = P2::new(angle.cos(), angle.sin());
        let section = Section::new(&face);
        let value = offset - slope.dot(&centroid(&section));
        let resultant = section.pressed(value, slope);
        prop_assume!(resultant.0 > 1e-3);
        let total = sigma * level * resultant.0;
        let forces: Vec<f64> = coordinates(&section.corners, resultant.1 / resultant.0).iter().map(|w| w * total).collect();
        let used = crushing(&face, &forces, sigma).0;
        prop_assert!(used <= 1.0 + 1e-9, "used {used}");
        for (width, distances) in edge_bounds(&face) {
            let moment: f64 = distances.iter().zip(&forces).map(|(d, f)| d * f).sum();
            prop_assert!(total * total <= 2.0 * sigma * width * moment * (1.0 + 1e-9));
        }
    }

    /// No pressure gains more power on corners that close by themselves than what the joint gives
    /// way by, and no other affine function above their rates bounds it lower.
    #[test]
    fn what_closes_is_the_greatest_power_and_the_least_volume(
        face in polygon(),
        rates in prop::collection::vec(-1.0f64..1.0, 12),
        (angle, steep, offset) in (0.0f64..6.3, 0.0f64..4.0, -1.0f64..1.0),
    ) {
        let section = Section::new(&face);
        let rates = &rates[..section.corners.len()];
        let volume = closing_volume(&face, rates);
        let slope = P2::new(angle.cos(), angle.sin());
        let (area, moment) = section.pressed(offset - slope.dot(&centroid(&section)), slope);
        prop_assume!(area > 1e-6);
        let corners = coordinates(&section.corners, moment / area);
        let power: f64 = corners.iter().zip(rates).map(|(w, v)| w * area * v).sum();
        prop_assert!(power <= volume + 1e-9, "{power} {volume}");
        let slope = slope * steep;
        let above = section.corners.iter().zip(rates).map(|(p, v)| v - slope.dot(p));
        let value = above.fold(f64::NEG_INFINITY, f64::max);
        prop_assert!(volume <= section.positive(value, slope).1 * (1.0 + 1e-9) + 1e-15);
    }

    #[test]
    fn a_half_plane_at_full_strength_is_the_limit(face in polygon(), angle in 0.0f64..6.3, offset in -0.5f64..0.5) {
        let slope = P2::new(angle.cos(), angle.sin());
        let section = Section::new(&face);
        let value = offset - slope.dot(&centroid(&section));
        let resultant = section.pressed(value, slope);
        prop_assume!(resultant.0 > 1e-2 && resultant.0 < 0.99 * face.area);
        let forces: Vec<f64> = coordinates(&section.corners, resultant.1 / resultant.0).iter().map(|w| w * resultant.0).collect();
        prop_assert!((crushing(&face, &forces, 1.0).0 - 1.0).abs() < 1e-6);
        prop_assert!(crushing(&face, &forces, 0.999).0 > 1.0);
    }
}
