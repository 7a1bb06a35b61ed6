//! The dome: rings of blocks between two spheres.
//!
//! A block lies between two meridian planes and two bed cones. Its corners are the points of both
//! spheres there. The corners of a bed joint, two on each sphere at the same angle from the axis,
//! form an isosceles trapezium; so do those of the intrados and of the extrados; those of a
//! meridian joint lie in the meridian plane. So all six faces are plane and neighbours share their
//! joints exactly.

use super::{
    angle::{cos_deg, sin_deg},
    check::Place,
    digits, support,
};
use crate::{
    error::InputError,
    scene::{BlockSpec, Shape, template::Dome},
};

pub fn blocks(dome: &Dome) -> Result<Vec<BlockSpec>, InputError> {
    let place = Place::template("dome");
    let (springing, step, top) = check(&place, dome)?;
    let (rings, segments) = (digits(dome.rings), digits(dome.segments));
    let mut blocks = Vec::new();
    for r in 0..dome.rings {
        let low = springing - r as f64 * step;
        // The last bed is the edge of the oculus, or the keystone's, to the last bit.
        let high = if r + 1 == dome.rings { top } else { springing - (r + 1) as f64 * step };
        for k in 0..dome.segments {
            blocks.push(BlockSpec::new(
                format!("r{r:0rings$}_{k:0segments$}"),
                voussoir(dome, low, high, k),
            ));
        }
    }
    if dome.oculus_deg.is_none() {
        blocks.push(BlockSpec::new("keystone", keystone(dome, top)));
    }
    let foot = springing + step.min((180.0 - springing) / 2.0);
    for k in 0..dome.segments {
        blocks
            .push(support(format!("springer_{k:0segments$}"), voussoir(dome, foot, springing, k)));
    }
    Ok(blocks)
}

/// Angles from the axis, degrees: of the springing, of one ring, of the uppermost bed joint.
fn check(place: &Place, dome: &Dome) -> Result<(f64, f64, f64), InputError> {
    place.length("radius", dome.radius)?;
    place.length("thickness", dome.thickness)?;
    if dome.thickness >= 2.0 * dome.radius {
        return Err(place.error(
            "thickness",
            format!("must be < 2 × radius = {}, got {}", 2.0 * dome.radius, dome.thickness),
            "half of it lies inside the mid-surface; in m",
        ));
    }
    place.count("rings", dome.rings, 1)?;
    place.count("segments", dome.segments, 3)?;
    place.total("segments", &[dome.rings.saturating_add(1), dome.segments])?;
    let springing = dome.springing_deg.unwrap_or(90.0);
    if !(springing > 0.0 && springing < 180.0) {
        return Err(place.error(
            "springing_deg",
            format!("must lie between 0 and 180, got {springing}"),
            "the angle between the axis and the lowest joint; 90 is a hemisphere",
        ));
    }
    match dome.oculus_deg {
        Some(oculus) if oculus > 0.0 && oculus < springing => {
            Ok((springing, (springing - oculus) / dome.rings as f64, oculus))
        }
        Some(oculus) => Err(place.error(
            "oculus_deg",
            format!("must lie between 0 and the springing at {springing}, got {oculus}"),
            "the angle between the axis and the edge of the oculus; leave it out for a closed dome",
        )),
        None => {
            let step = springing / (dome.rings as f64 + 0.5);
            Ok((springing, step, step / 2.0))
        }
    }
}

/// The point of a sphere at an angle from the axis and on meridian `k`; the meridians are symmetric
/// about y = 0.
fn point(dome: &Dome, radius: f64, polar: f64, k: usize) -> [f64; 3] {
    let (k, n) = (k % dome.segments, dome.segments);
    let azimuth = if 2 * k > n {
        -(360.0 * ((n - k) as f64 / n as f64))
    } else {
        360.0 * (k as f64 / n as f64)
    };
    let r = radius * sin_deg(polar);
    [r * cos_deg(azimuth), r * sin_deg(azimuth), radius * cos_deg(polar)]
}

fn radii(dome: &Dome) -> [f64; 2] {
    [dome.radius - dome.thickness / 2.0, dome.radius + dome.thickness / 2.0]
}

/// The block between two bed joints and the meridians k and k + 1.
fn voussoir(dome: &Dome, low: f64, high: f64, k: usize) -> Shape {
    let corners = |r| {
        [
            point(dome, r, low, k),
            point(dome, r, low, k + 1),
            point(dome, r, high, k + 1),
            point(dome, r, high, k),
        ]
    };
    Shape::Polyhedron {
        vertices: radii(dome).into_iter().flat_map(corners).collect(),
        // Intrados, extrados, lower bed, upper bed, the two meridian joints.
        faces: [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [7, 6, 2, 3], [4, 7, 3, 0], [5, 1, 2, 6]]
            .map(Vec::from)
            .into(),
    }
}

/// The block that closes the dome above the bed joint at `edge`: a polygonal plug with plane top
/// and bottom.
fn keystone(dome: &Dome, edge: f64) -> Shape {
    let n = dome.segments;
    let sides = (0..n).map(|k| {
        let next = (k + 1) % n;
        vec![n + next, n + k, k, next]
    });
    Shape::Polyhedron {
        vertices: radii(dome)
            .into_iter()
            .flat_map(|r| (0..n).map(move |k| point(dome, r, edge, k)))
            .collect(),
        faces: [(0..n).rev().collect(), (n..2 * n).collect()].into_iter().chain(sides).collect(),
    }
}
