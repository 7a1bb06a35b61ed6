//! Surfaces whose slope is known, and those that have none.

use super::{Slope, judge::refuse, surface::read};
use nalgebra::Vector3;
use scene::{Protocol, ProtocolKind};

/// Tops of grains half a diameter apart in the box of 2,000 grains, at heights in d by place in d.
fn boxed(protocol: &Protocol, height: impl Fn(f64, f64) -> f64) -> Vec<(Vector3<f64>, f64)> {
    let (d, [length, width]) = (protocol.diameter, protocol.size());
    let (n, m) = ((2.0 * length) as usize, (2.0 * width) as usize);
    (0..n)
        .flat_map(|i| (0..m).map(move |j| (i, j)))
        .map(|(i, j)| {
            let x = (i as f64 + 0.5) * length / n as f64;
            let y = ((j as f64 + 0.5) / m as f64 - 0.5) * width;
            (Vector3::new(x * d, y * d, (height(x, y) - 0.5) * d), 0.5 * d)
        })
        .collect()
}

/// The same for a heap in the open of that radius, at heights by radius and angle.
fn round(d: f64, radius: f64, height: impl Fn(f64, f64) -> f64) -> Vec<(Vector3<f64>, f64)> {
    // Around every ring the same angles, so that the middle is the middle.
    (0..(4.0 * radius) as usize)
        .flat_map(|i| (0..64).map(move |j| (i, j)))
        .map(|(i, j)| {
            let (r, a) = ((i as f64 + 0.5) * 0.25, (j as f64 + 0.5) / 64.0 * std::f64::consts::TAU);
            let z = height(r, a).max(0.5) - 0.5;
            (Vector3::new(r * a.cos() * d, r * a.sin() * d, z * d), 0.5 * d)
        })
        .collect()
}

fn drain() -> Protocol {
    Protocol::default()
}

fn funnel() -> Protocol {
    Protocol { kind: ProtocolKind::Funnel, ..Protocol::default() }
}

/// The slope, or the reasons why there is none.
fn slope(protocol: &Protocol, spots: &[(Vector3<f64>, f64)], turned: f64) -> Result<Slope, String> {
    let reading = read(protocol, spots, turned);
    let reasons = refuse(protocol, &reading, 0);
    reading.mean.map(|f| f.slope).filter(|_| reasons.is_empty()).ok_or(reasons.join("; "))
}

fn tan(degrees: f64) -> f64 {
    degrees.to_radians().tan()
}

#[test]
fn a_wedge_and_a_cone_give_their_angle_in_every_unit() {
    for diameter in [1e-5, 0.01, 300.0] {
        for angle in [8.0, 20.0, 30.0] {
            let p = Protocol { diameter, ..drain() };
            let wedge = boxed(&p, |x, _| 1.2 + tan(angle) * (16.0 - x));
            let found = slope(&p, &wedge, 0.0).expect("a slope");
            assert!((found.angle_deg - angle).abs() < 1e-9, "{angle}: {found:?}");
            assert!(found.r_squared > 1.0 - 1e-12 && found.cells >= 8, "{found:?}");
            let p = Protocol { diameter, ..funnel() };
            let cone = round(diameter, 16.0, |r, _| 1.2 + tan(angle) * (16.0 - r));
            let found = slope(&p, &cone, 0.0).expect("a slope");
            assert!((found.angle_deg - angle).abs() < 1e-9, "{angle}: {found:?}");
        }
    }
}

/// A bed that has been turned counts as gravity sees it.
#[test]
fn a_turned_bed_has_the_slope_that_gravity_sees() {
    let p = Protocol { kind: ProtocolKind::Tilt, ..Protocol::default() };
    let turned = 20f64.to_radians();
    let bed = boxed(&p, |x, _| 4.0 + tan(5.0) * (16.0 - x));
    let reading = read(&p, &bed, turned);
    let fit = reading.mean.expect("a line");
    assert!((fit.slope.angle_deg - 25.0).abs() < 1e-9, "{:?}", fit.slope);
    // Its line lies on the tops, against the bed.
    let top = |x: f64| 4.0 + tan(5.0) * (16.0 - x);
    let d = p.diameter;
    assert!(reading.line.iter().all(|q| (q.z / d - top(q.x / d)).abs() < 1e-9 && q.y == 0.0));
    assert!(slope(&p, &bed, turned).is_ok());
    // Level to gravity: no slope, however the bed lies.
    let level = boxed(&p, |x, _| 4.0 - tan(20.0) * (16.0 - x) + 8.0);
    let said = slope(&p, &level, turned).expect_err("level");
    assert!(said.contains("level"), "{said}");
}

#[test]
fn what_is_no_slope_is_refused_with_its_reason() {
    let p = drain();
    let refused = |protocol: &Protocol, spots: &[(Vector3<f64>, f64)], want: &str| {
        let said = slope(protocol, spots, 0.0).expect_err(want);
        assert!(said.contains(want), "{want}: {said}");
    };
    refused(&p, &[], "fewer than 3 cells");
    refused(&p, &boxed(&p, |_, _| 5.0), "level apart from its grains");
    refused(&p, &boxed(&p, |x, _| 2.0 + 0.03 * (16.0 - x)), "level apart from its grains");
    // Rising towards the edge.
    refused(&p, &boxed(&p, |x, _| 2.0 + 0.3 * x), "level apart from its grains");
    // Too short: the box of 500 grains.
    let few = Protocol { grains: 500, ..drain() };
    refused(&few, &boxed(&few, |x, _| 1.2 + 0.4 * (10.0 - x)), "cells of the surface");
    // A level crest that never flowed, and a cone without its top.
    let crest = |x: f64, _| 1.5 + 0.6 * (16.0 - x.max(8.0));
    refused(&p, &boxed(&p, crest), "lower half");
    let frustum = |r: f64, _| 1.2 + 0.6 * (16.0 - r.max(8.0));
    refused(&funnel(), &round(0.01, 16.0, frustum), "lower half");
    // Half the heights do not lie on the line.
    refused(&p, &boxed(&p, |x, _| 4.0 + 0.2 * (16.0 - x) + 2.0 * (x * 1.4).sin()), "R²");
    // The line meets the back wall above what was filled in.
    refused(&p, &boxed(&p, |x, _| 1.2 + tan(36.0) * (16.0 - x)), "cut by the wall");
    // Steeper on one side than on the other, across the box and around the middle.
    let sides = |x: f64, y: f64| 1.5 + (0.36 + 0.025 * y) * (16.0 - x);
    refused(&p, &boxed(&p, sides), "strips differ");
    let around = |r: f64, a: f64| 1.2 + (0.45 + 0.2 * a.cos()) * (16.0 - r);
    refused(&funnel(), &round(0.01, 16.0, around), "sectors differ");
}

/// A heap in the open over whose floor's edge grains fell is cut by that edge.
#[test]
fn grains_over_the_edge_of_an_open_floor_cut_the_slope() {
    let cone = round(0.01, 16.0, |r, _| 1.2 + 0.45 * (16.0 - r));
    let reading = read(&funnel(), &cone, 0.0);
    assert!(refuse(&funnel(), &reading, 0).is_empty());
    assert!(refuse(&funnel(), &reading, 3).iter().any(|r| r.contains("edge of the floor")));
    // Over the edge of a drain they are meant to fall.
    let wedge = boxed(&drain(), |x, _| 1.2 + 0.45 * (16.0 - x));
    assert!(refuse(&drain(), &read(&drain(), &wedge, 0.0), 900).is_empty());
}

/// The box follows the number of grains, and what is given stands.
#[test]
fn boxes_of_all_numbers_of_grains_are_alike() {
    assert_eq!(Protocol::default().size(), [16.0, 10.0]);
    let of = |grains: usize| Protocol { grains, ..drain() }.size();
    assert_eq!(of(16_000).map(|s| (s * 1e9).round() / 1e9), [32.0, 20.0]);
    assert_eq!(of(10), [4.0, 4.0]);
    assert_eq!(Protocol { size: Some([7.0, 5.0]), ..drain() }.size(), [7.0, 5.0]);
}
