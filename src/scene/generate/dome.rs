//! The dome: rings of blocks between two spheres.
//!
//! A block lies between two meridian planes and two bed cones. Its corners are the points of both
//! spheres there. The corners of a bed joint, two on each sphere at the same angle from the axis,
//! form an isosceles trapezium; so do those of the intrados and of the extrados; those of a
//! meridian joint lie in the meridian plane. So all six faces are plane and neighbours share their
//! joints exactly.

use super::{
    angle::{cos_deg, sin_deg},
    check::TemplatePath,
    digits, support,
};
use crate::{
    BlockSpec, Shape,
    template::{Dome, Lantern},
};
use base::error::InputError;

pub fn blocks(dome: &Dome) -> Result<Vec<BlockSpec>, InputError> {
    let place = TemplatePath::template("dome");
    let (springing, step, top) = check(&place, dome)?;
    let (rings, segments) = (digits(dome.rings), digits(dome.segments));
    let mut blocks = Vec::new();
    for r in 0..dome.rings {
        let low = springing - r as f64 * step;
        // The last bed is the edge of the oculus, or the keystone's, to the last bit.
        let high = if r + 1 == dome.rings { top } else { springing - (r + 1) as f64 * step };
        for k in (0..dome.segments).filter(|&k| !is_open(dome, r, k)) {
            blocks.push(BlockSpec::new(
                format!("r{r:0rings$}_{k:0segments$}"),
                voussoir(dome, low, high, k),
            ));
        }
    }
    if dome.oculus_deg.is_none() {
        blocks.push(BlockSpec::new("keystone", keystone(dome, top)));
    }
    if let Some(lantern) = &dome.lantern {
        blocks.extend(drum(dome, lantern, top));
    }
    let foot = springing + step.min((180.0 - springing) / 2.0);
    for k in 0..dome.segments {
        blocks
            .push(support(format!("springer_{k:0segments$}"), voussoir(dome, foot, springing, k)));
    }
    Ok(blocks)
}

/// Angles from the axis, degrees: of the springing, of one ring, of the uppermost bed joint.
fn check(place: &TemplatePath, dome: &Dome) -> Result<(f64, f64, f64), InputError> {
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
    for (i, opening) in dome.openings.iter().enumerate() {
        let place = TemplatePath(place.0.key("openings").index(i));
        let [from, to] = opening.rings;
        if from > to || to >= dome.rings {
            return Err(place.error(
                "rings",
                format!(
                    "must be the first and the last of {} rings, got {from} and {to}",
                    dome.rings
                ),
                "from 0 at the springing",
            ));
        }
        if opening.segments.iter().any(|&k| k >= dome.segments) {
            return Err(place.error(
                "segments",
                format!(
                    "must be the first and the last of {} segments, got {:?}",
                    dome.segments, opening.segments
                ),
                "from 0",
            ));
        }
    }
    if let Some(lantern) = &dome.lantern {
        let place = TemplatePath(place.0.key("lantern"));
        place.length("height", lantern.height)?;
        place.length("cap", lantern.cap)?;
        if dome.oculus_deg.is_none_or(|o| o >= 90.0) {
            return Err(place.error(
                "height",
                "a lantern needs an oculus in the upper half of the sphere to stand on",
                "give oculus_deg, less than 90",
            ));
        }
    }
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

/// Whether a voussoir is left out.
fn is_open(dome: &Dome, ring: usize, segment: usize) -> bool {
    dome.openings.iter().any(|o| {
        let [from, to] = o.segments;
        let across = if from <= to {
            (from..=to).contains(&segment)
        } else {
            segment >= from || segment <= to
        };
        across && (o.rings[0]..=o.rings[1]).contains(&ring)
    })
}

/// The drum upon the bed joint at `edge`, and its slab. The faces of a block of the drum stand upright
/// over the sides of that joint; its foot is the joint itself.
fn drum(dome: &Dome, lantern: &Lantern, edge: f64) -> Vec<BlockSpec> {
    let [inner, outer] = radii(dome);
    let top = outer * cos_deg(edge) + lantern.height;
    let raised = |p: [f64; 3], z: f64| [p[0], p[1], z];
    let n = dome.segments;
    let width = digits(n);
    let mut blocks: Vec<BlockSpec> = (0..n)
        .map(|k| {
            let corners = [(inner, k), (inner, k + 1), (outer, k + 1), (outer, k)];
            let foot = corners.map(|(r, k)| point(dome, r, edge, k));
            let shape = Shape::Polyhedron {
                vertices: foot.into_iter().chain(foot.map(|p| raised(p, top))).collect(),
                // Foot, head, inner face, outer face, the two meridian joints.
                faces: [
                    [0, 1, 2, 3],
                    [7, 6, 5, 4],
                    [1, 0, 4, 5],
                    [3, 2, 6, 7],
                    [2, 1, 5, 6],
                    [0, 3, 7, 4],
                ]
                .map(Vec::from)
                .into(),
            };
            BlockSpec::new(format!("lantern_{k:0width$}"), shape)
        })
        .collect();
    let rim = |z: f64| (0..n).map(move |k| raised(point(dome, outer, edge, k), z));
    let sides = (0..n).map(|k| {
        let next = (k + 1) % n;
        vec![k, next, n + next, n + k]
    });
    let slab = Shape::Polyhedron {
        vertices: rim(top).chain(rim(top + lantern.cap)).collect(),
        faces: [(0..n).rev().collect(), (n..2 * n).collect()].into_iter().chain(sides).collect(),
    };
    blocks.push(BlockSpec::new("lantern_cap", slab));
    blocks
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
