//! The arch: voussoirs between joints along a mid-line, springers or buttresses under them.

use super::{
    check::TemplatePath,
    midline::{Fields, JointLine, Midline, Xz, mirror},
    numbered, support,
};
use crate::{
    BlockSpec, Shape,
    template::{Arch, Buttresses, JointDirection, ThicknessAlong},
};
use base::error::InputError;

/// Chords of the extrados per voussoir where a ring is cut by vertical joints.
const CHORDS: usize = 4;
/// The same in the two outer voussoirs, whose extrados is the longest.
const CHORDS_AT_SPRINGING: usize = 8;

/// An arch in its plane.
pub struct Section {
    /// Voussoirs from left to right.
    pub voussoirs: Vec<Vec<Xz>>,
    /// The supports under the left and the right springing.
    pub springers: [Vec<Xz>; 2],
    /// The right springing joint.
    pub springing: JointLine,
}

pub fn blocks(arch: &Arch) -> Result<Vec<BlockSpec>, InputError> {
    let place = TemplatePath::template("arch");
    let along = arch.thickness_along.unwrap_or(match arch.joints {
        JointDirection::Radial => ThicknessAlong::Normal,
        JointDirection::Vertical => ThicknessAlong::Vertical,
    });
    let fields = Fields {
        profile: arch.profile,
        radius: arch.radius,
        embrace_deg: arch.embrace_deg,
        eccentricity: arch.eccentricity,
        span: arch.span,
        rise: arch.rise,
        intrados_span: arch.intrados_span,
        intrados_rise: arch.intrados_rise,
        thickness: arch.thickness,
        sheared: along == ThicknessAlong::Vertical,
    };
    place.length("depth", arch.depth)?;
    place.total("voussoirs", &[arch.voussoirs])?;
    let midline = check(&place, &fields, arch.voussoirs)?;
    let section = match (arch.joints, along) {
        (JointDirection::Radial, ThicknessAlong::Normal) => {
            radial(&place, &midline, arch.thickness, arch.voussoirs)?
        }
        (JointDirection::Radial, ThicknessAlong::Vertical) => {
            return Err(place.error(
                "thickness_along",
                "with radial joints the thickness is normal to the mid-line",
                "leave it out, or use joints: vertical",
            ));
        }
        (JointDirection::Vertical, along) => {
            if let Midline::Circular { half_deg, .. } = midline
                && half_deg > 90.0
            {
                return Err(place.error(
                    "joints",
                    format!(
                        "vertical joints need an arch of at most 180°, this one has {}°",
                        2.0 * half_deg
                    ),
                    "use radial joints",
                ));
            }
            match along {
                ThicknessAlong::Vertical => sheared(&midline, arch.thickness, arch.voussoirs),
                ThicknessAlong::Normal => {
                    ring_cut_vertically(&place, &midline, arch.thickness, arch.voussoirs)?
                }
            }
        }
    };
    let prism = |polygon| Shape::Prism { polygon, depth: arch.depth };
    let n = section.voussoirs.len();
    let mut blocks: Vec<_> = section
        .voussoirs
        .into_iter()
        .enumerate()
        .map(|(i, polygon)| BlockSpec::new(numbered("v", i, n), prism(polygon)))
        .collect();
    match &arch.buttresses {
        None => {
            let [left, right] = section.springers;
            blocks.push(support("springer_left", prism(left)));
            blocks.push(support("springer_right", prism(right)));
        }
        Some(buttresses) => {
            let [left, right, ground] =
                under(&place, buttresses, section.springing, arch.thickness)?;
            blocks.push(BlockSpec::new("buttress_left", prism(left)));
            blocks.push(BlockSpec::new("buttress_right", prism(right)));
            blocks.push(support("ground", prism(ground)));
        }
    }
    Ok(blocks)
}

/// The voussoirs and springers of an arch with radial joints; also the section of a barrel vault.
pub fn radial_section(
    place: &TemplatePath,
    fields: &Fields,
    voussoirs: usize,
) -> Result<Section, InputError> {
    let midline = check(place, fields, voussoirs)?;
    radial(place, &midline, fields.thickness, voussoirs)
}

/// The same cut into rings of equal thickness, from inside out; all together as thick as `fields`
/// says at the crown and `springing` at the springings, the intrados the same.
pub fn radial_rings(
    place: &TemplatePath,
    fields: &Fields,
    voussoirs: usize,
    rings: usize,
    springing: f64,
) -> Result<Vec<Section>, InputError> {
    let midline = check(place, fields, voussoirs)?;
    let crown = fields.thickness;
    let at = |r: usize, u: f64| {
        let thickness = crown + (springing - crown) * u;
        thickness * (r as f64 / rings as f64) - 0.5 * crown
    };
    (0..rings).map(|r| ring(place, &midline, |u| [at(r, u), at(r + 1, u)], voussoirs)).collect()
}

/// What holds for every direction of the joints.
fn check(place: &TemplatePath, fields: &Fields, voussoirs: usize) -> Result<Midline, InputError> {
    let thickness = fields.thickness;
    let midline = fields.resolve(place)?;
    place.length("thickness", thickness)?;
    match midline {
        Midline::Circular { radius, .. } if thickness >= 2.0 * radius => {
            return Err(place.error(
                "thickness",
                format!("must be < 2 × radius = {}, got {thickness}", 2.0 * radius),
                "half of it lies inside the mid-line; in m",
            ));
        }
        Midline::Pointed { radius, eccentricity } if thickness >= 2.0 * (radius - eccentricity) => {
            return Err(place.error(
                "thickness",
                format!(
                    "must be < 2 × (radius − eccentricity) = {}, got {thickness}",
                    2.0 * (radius - eccentricity)
                ),
                "the two halves would overlap at the springing; in m",
            ));
        }
        _ => {}
    }
    let least = match midline {
        // A voussoir of 180° or more has no area between its straight chords.
        Midline::Circular { half_deg, .. } => (half_deg / 90.0).floor() as usize + 1,
        Midline::Pointed { .. } | Midline::Elliptical { .. } | Midline::ThreeCentred { .. } => 2,
        Midline::Parabolic { .. } => 1,
    };
    place.count("voussoirs", voussoirs, least)?;
    if matches!(midline, Midline::Pointed { .. }) && !voussoirs.is_multiple_of(2) {
        return Err(place.error(
            "voussoirs",
            format!("a pointed arch has a vertical joint at the crown and needs an even number, got {voussoirs}"),
            format!("{} or {}", voussoirs - 1, voussoirs + 1),
        ));
    }
    Ok(midline)
}

/// Joints normal to the mid-line.
fn radial(
    place: &TemplatePath,
    midline: &Midline,
    thickness: f64,
    n: usize,
) -> Result<Section, InputError> {
    ring(place, midline, |_| [-thickness / 2.0, thickness / 2.0], n)
}

/// The same between two distances from the mid-line, outwards, at u from 0 (crown) to 1
/// (springing).
fn ring(
    place: &TemplatePath,
    midline: &Midline,
    between: impl Fn(f64) -> [f64; 2],
    n: usize,
) -> Result<Section, InputError> {
    let ends = between(1.0);
    let thickness = ends[1] - ends[0];
    let joints: Vec<JointLine> = (0..=n).map(|j| midline.joint_between(j, n, &between)).collect();
    unfolded(place, &joints, thickness)?;
    let springing = joints[n];
    let right = match *midline {
        Midline::Circular { half_deg, .. } => {
            // One more voussoir, or half of what is left of the circle.
            let angle = half_deg + (2.0 * half_deg / n as f64).min((180.0 - half_deg) / 2.0);
            continued(*midline, angle, ends, springing)
        }
        _ => beyond([joints[n - 1], springing], thickness),
    };
    Ok(Section {
        voussoirs: joints.windows(2).map(|p| quad(p[0], p[1])).collect(),
        springers: both(right),
        springing,
    })
}

/// A ring between joints of one's own, from left to right, at least two.
pub fn ring_between(place: &TemplatePath, joints: &[JointLine]) -> Result<Section, InputError> {
    let thickness = |[b, c]: JointLine| (c[0] - b[0]).hypot(c[1] - b[1]);
    let n = joints.len() - 1;
    unfolded(place, joints, joints.iter().map(|j| thickness(*j)).fold(0.0, f64::max))?;
    let [left, right] = [[joints[1], joints[0]].map(|j| j.map(mirror)), [joints[n - 1], joints[n]]]
        .map(|last| beyond(last, thickness(last[1])));
    Ok(Section {
        voussoirs: joints.windows(2).map(|p| quad(p[0], p[1])).collect(),
        springers: [reflect(&left), right],
        springing: joints[n],
    })
}

/// Refuses joints between which the intrados would run backwards, for the thickness reaches past the
/// centre of curvature.
fn unfolded(place: &TemplatePath, joints: &[JointLine], thickness: f64) -> Result<(), InputError> {
    for pair in joints.windows(2) {
        let [[a, d], [b, c]] = [pair[0], pair[1]];
        let chord = [b[0] + c[0] - a[0] - d[0], b[1] + c[1] - a[1] - d[1]];
        if (b[0] - a[0]) * chord[0] + (b[1] - a[1]) * chord[1] <= 0.0 {
            return Err(place.error(
                "thickness",
                format!("{thickness} reaches past the centre of curvature near x = {}: the intrados would fold back", (a[0] + b[0]) / 2.0),
                "make it thinner, or use joints: vertical",
            ));
        }
    }
    Ok(())
}

/// The support beyond the last of two joints, as long as the voussoir between them.
fn beyond([[a, d], [b, c]]: [JointLine; 2], thickness: f64) -> Vec<Xz> {
    let length = ((b[0] + c[0] - a[0] - d[0]) / 2.0).hypot((b[1] + c[1] - a[1] - d[1]) / 2.0);
    // The joint runs outwards; turned clockwise it points away from the arch.
    let out = [(c[0] - b[0]) / thickness, (c[1] - b[1]) / thickness];
    let back = |p: Xz| [p[0] + length * out[1], p[1] - length * out[0]];
    vec![b, back(b), back(c), c]
}

/// Joints vertical, intrados and extrados the mid-line moved down and up by half the thickness.
fn sheared(midline: &Midline, thickness: f64, n: usize) -> Section {
    let joints: Vec<JointLine> = (0..=n)
        .map(|j| {
            let [x, z] = midline.point_over(j, n);
            [[x, z - thickness / 2.0], [x, z + thickness / 2.0]]
        })
        .collect();
    let springing = joints[n];
    let width = 2.0 * midline.half_span() / n as f64;
    let [b, c] = springing;
    let right = vec![b, [b[0] + width, b[1]], [c[0] + width, c[1]], c];
    Section {
        voussoirs: joints.windows(2).map(|p| quad(p[0], p[1])).collect(),
        springers: both(right),
        springing,
    }
}

/// A circular ring of constant normal thickness cut by vertical joints.
fn ring_cut_vertically(
    place: &TemplatePath,
    midline: &Midline,
    thickness: f64,
    n: usize,
) -> Result<Section, InputError> {
    let &Midline::Circular { radius, half_deg } = midline else {
        return Err(place.error(
            "thickness_along",
            "vertical joints with the thickness normal to the mid-line are for circular arches only",
            "use thickness_along: vertical, or radial joints",
        ));
    };
    place.count("voussoirs", n, 2)?;
    let outer = radius + thickness / 2.0;
    let extrados = |x: f64| ((outer - x) * (outer + x)).sqrt();
    let springing = midline.radial_joint(n, n, thickness);
    // The joint between two voussoirs: from a corner of the intrados straight up.
    let joint = |j: usize| {
        let [intrados, _] = midline.radial_joint(j, n, thickness);
        [intrados, [intrados[0], extrados(intrados[0])]]
    };
    // A voussoir right of the crown, or the key: intrados chord, then the extrados from right to
    // left.
    let right = |i: usize| {
        let [a, d] = joint(i);
        if i + 1 == n {
            let (from, to) = ((d[0] / outer).asin(), half_deg.to_radians());
            let arc = (1..CHORDS_AT_SPRINGING).rev().map(|k| {
                let (sin, cos) =
                    (from + (to - from) * k as f64 / CHORDS_AT_SPRINGING as f64).sin_cos();
                [outer * sin, outer * cos]
            });
            return [a, springing[0], springing[1]]
                .into_iter()
                .chain(arc)
                .chain([d])
                .collect::<Vec<_>>();
        }
        let [b, c] = joint(i + 1);
        // The outer points are weighted the same from either side, so that the key is symmetric.
        let arc = (1..CHORDS).rev().map(|k| {
            let x = (a[0] * (CHORDS - k) as f64 + b[0] * k as f64) / CHORDS as f64;
            [x, extrados(x)]
        });
        [a, b, c].into_iter().chain(arc).chain([d]).collect()
    };
    let voussoirs = (0..n)
        .map(|i| if 2 * i + 1 >= n { right(i) } else { reflect(&right(n - 1 - i)) })
        .collect();
    let angle = half_deg + (2.0 * half_deg / n as f64).min((180.0 - half_deg) / 2.0);
    Ok(Section {
        voussoirs,
        springers: both(continued(*midline, angle, [-thickness / 2.0, thickness / 2.0], springing)),
        springing,
    })
}

/// The right springer of a circular arch: a voussoir from the springing to `angle` degrees from the
/// crown.
fn continued(midline: Midline, angle: f64, between: [f64; 2], [b, c]: JointLine) -> Vec<Xz> {
    let circle = match midline {
        Midline::Circular { radius, .. } => Midline::Circular { radius, half_deg: angle },
        other => other,
    };
    let [inner, outer] = circle.joint_between(1, 1, &|_| between);
    vec![b, inner, outer, c]
}

/// Buttresses under a horizontal springing, inner face flush with the intrados: left, right, and
/// the ground under both.
fn under(
    place: &TemplatePath,
    buttresses: &Buttresses,
    springing: JointLine,
    thickness: f64,
) -> Result<[Vec<Xz>; 3], InputError> {
    let inner_place = TemplatePath(place.0.key("buttresses"));
    inner_place.length("width", buttresses.width)?;
    inner_place.length("height", buttresses.height)?;
    let [[inner, top], [outer, outer_top]] = springing;
    if (top - outer_top).abs() > base::tolerance::GRID_SNAP * thickness || outer <= inner {
        return Err(InputError::at(inner_place.0, "buttresses need horizontal springing joints")
            .hint("use a semicircular (embrace_deg 180), pointed or elliptical arch; others stand on springers"));
    }
    let (foot, edge) = (top - buttresses.height, inner + buttresses.width);
    let right = vec![[inner, foot], [edge, foot], [edge, top], [inner, top]];
    let end = edge + buttresses.width;
    let bottom = foot - buttresses.width;
    Ok([reflect(&right), right, vec![[-end, bottom], [end, bottom], [end, foot], [-end, foot]]])
}

fn quad([a, d]: JointLine, [b, c]: JointLine) -> Vec<Xz> {
    vec![a, b, c, d]
}

fn both(right: Vec<Xz>) -> [Vec<Xz>; 2] {
    [reflect(&right), right]
}

/// The mirror image of a polygon, run through backwards so that it stays counter-clockwise.
fn reflect(polygon: &[Xz]) -> Vec<Xz> {
    polygon.iter().rev().map(|p| mirror(*p)).collect()
}
