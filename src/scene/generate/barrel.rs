//! The barrel vault: the section of an arch drawn out along y, every other strip moved by half a
//! block.

use super::{arch::radial_section, check::TemplatePath, digits, midline::Fields, support};
use crate::{BlockSpec, Shape, template::Barrel};
use base::error::InputError;

pub fn blocks(barrel: &Barrel) -> Result<Vec<BlockSpec>, InputError> {
    let place = TemplatePath::template("barrel");
    place.length("depth", barrel.depth)?;
    place.count("courses", barrel.courses, 1)?;
    place.total("voussoirs", &[barrel.voussoirs, barrel.courses.saturating_add(1)])?;
    let fields = Fields {
        profile: barrel.profile,
        radius: barrel.radius,
        embrace_deg: barrel.embrace_deg,
        eccentricity: barrel.eccentricity,
        span: barrel.span,
        rise: barrel.rise,
        intrados_span: barrel.intrados_span,
        intrados_rise: barrel.intrados_rise,
        thickness: barrel.thickness,
        sheared: false,
    };
    let section = radial_section(&place, &fields, barrel.voussoirs)?;
    let (across, along) = (digits(barrel.voussoirs), digits(barrel.courses + 1));
    let mut blocks = Vec::new();
    for (i, polygon) in section.voussoirs.iter().enumerate() {
        for (k, ends) in cuts(barrel.courses, i % 2 == 1).windows(2).enumerate() {
            // Ends in half blocks from the middle of the vault.
            let half = barrel.depth / (2 * barrel.courses) as f64;
            let shape =
                Shape::Prism { polygon: polygon.clone(), depth: (ends[1] - ends[0]) * half };
            blocks.push(BlockSpec {
                at: [0.0, (ends[0] + ends[1]) / 2.0 * half, 0.0],
                ..BlockSpec::new(format!("v{i:0across$}_{k:0along$}"), shape)
            });
        }
    }
    let [left, right] = section.springers;
    blocks.push(support("springer_left", Shape::Prism { polygon: left, depth: barrel.depth }));
    blocks.push(support("springer_right", Shape::Prism { polygon: right, depth: barrel.depth }));
    Ok(blocks)
}

/// Where a strip is cut along y, in half blocks from its middle.
fn cuts(courses: usize, moved: bool) -> Vec<f64> {
    let end = courses as f64;
    if moved {
        let inner = (0..courses).map(|k| (2 * k + 1) as f64 - end);
        std::iter::once(-end).chain(inner).chain([end]).collect()
    } else {
        (0..=courses).map(|k| (2 * k) as f64 - end).collect()
    }
}
