//! The portal: an arch on two piers of boxes, with buttresses against them the section of a nave.

use super::{arch::radial_section, check::TemplatePath, midline::Fields, numbered, support};
use crate::{
    BlockSpec, Shape,
    template::{Pier, Portal},
};
use base::{error::InputError, tolerance::GRID_SNAP};

pub fn blocks(portal: &Portal) -> Result<Vec<BlockSpec>, InputError> {
    let place = TemplatePath::template("portal");
    place.length("depth", portal.depth)?;
    place.total("voussoirs", &[portal.voussoirs])?;
    let fields = Fields::of_intrados_alone(
        portal.profile,
        [portal.clear_span, portal.rise],
        portal.thickness,
    );
    let section = radial_section(&place, &fields, portal.voussoirs)?;
    let [inner, outer] = section.springing;
    if (inner[1] - outer[1]).abs() > GRID_SNAP * portal.thickness {
        return Err(place.error(
            "rise",
            "an arch on upright piers needs level springing joints",
            "a circular one rises half its span; lower ones are elliptical or three_centred",
        ));
    }
    let pier = &portal.pier;
    check(&TemplatePath(place.0.key("pier")), pier)?;
    if pier.width < portal.thickness * (1.0 - GRID_SNAP) {
        return Err(TemplatePath(place.0.key("pier")).error(
            "width",
            format!(
                "must be at least the thickness of the arch = {}, got {}",
                portal.thickness, pier.width
            ),
            "the arch stands on the whole of its springing joint",
        ));
    }
    if let Some(buttress) = &portal.buttress {
        let place = TemplatePath(place.0.key("buttress"));
        check(&place, buttress)?;
        if buttress.height > pier.height {
            return Err(place.error(
                "height",
                format!(
                    "must be at most that of the pier = {}, got {}",
                    pier.height, buttress.height
                ),
                "it stands against the pier from the ground up",
            ));
        }
    }
    let n = section.voussoirs.len();
    let prism = |polygon| Shape::Prism { polygon, depth: portal.depth };
    let voussoirs = section.voussoirs.into_iter().enumerate();
    let mut blocks: Vec<_> =
        voussoirs.map(|(i, polygon)| BlockSpec::new(numbered("v", i, n), prism(polygon))).collect();
    let foot = inner[1] - pier.height;
    for (word, sign) in [("left", -1.0), ("right", 1.0)] {
        let mut stack = |name: &str, pier: &Pier, from: f64| {
            let height = pier.height / pier.courses as f64;
            for k in 0..pier.courses {
                let shape = Shape::Cuboid { size: [pier.width, portal.depth, height] };
                let at = [sign * (from + 0.5 * pier.width), 0.0, foot + height * (k as f64 + 0.5)];
                let id = numbered(&format!("{name}_{word}_"), k, pier.courses);
                blocks.push(BlockSpec { at, ..BlockSpec::new(id, shape) });
            }
        };
        stack("pier", pier, inner[0]);
        let mut reach = pier.width;
        if let Some(buttress) = &portal.buttress {
            stack("buttress", buttress, inner[0] + pier.width);
            reach += buttress.width;
        }
        // As far beyond the outer face as the pier is wide, but not to the other one.
        let from = inner[0] - 0.5 * pier.width.min(inner[0]);
        let to = inner[0] + reach + pier.width;
        let shape = Shape::Cuboid { size: [to - from, portal.depth, 0.5 * pier.width] };
        let at = [sign * 0.5 * (from + to), 0.0, foot - 0.25 * pier.width];
        blocks.push(BlockSpec { at, ..support(format!("base_{word}"), shape) });
    }
    Ok(blocks)
}

fn check(place: &TemplatePath, pier: &Pier) -> Result<(), InputError> {
    place.length("width", pier.width)?;
    place.length("height", pier.height)?;
    place.count("courses", pier.courses, 1)?;
    place.total("courses", &[pier.courses])
}
