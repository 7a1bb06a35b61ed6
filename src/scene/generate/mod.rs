//! Templates → blocks. One file per template.
//!
//! Everything here is plain geometry in SI units. Arches, flat arches and stacks are symmetric or
//! stepped along x, with z up and the depth along y centred on y = 0. What is symmetric about x = 0
//! is so to the last bit: the right half is computed, the left half is its mirror image.

mod angle;
mod arch;
mod barrel;
mod bridge;
mod check;
mod column;
mod deposit;
mod dome;
mod flat_arch;
mod grain;
mod groin;
pub(crate) mod hull;
mod lattice;
mod leaves;
mod load;
mod member;
mod midline;
mod named;
mod portal;
mod random;
mod stack;
mod surveyed;
mod tower;
mod wall;

pub use bridge::Spread;
pub use deposit::{Deposit, bed_split, deposit, filled};
pub use load::{Road, loads, on_road, said};
pub use member::members;
pub use named::MAX_BLOCKS;
use named::{digits, numbered, support};

use crate::{BlockSpec, Shape, Template, template};
use base::error::{InputError, JsonPath};

/// The blocks of a template, in order.
///
/// # Errors
/// A parameter is out of its range, or does not go with the others; the path is relative to the
/// template (`arch.voussoirs`).
pub fn expand(template: &Template) -> Result<Vec<BlockSpec>, InputError> {
    let (mut blocks, prefix, at, material) = match template {
        Template::Arch(t) => (arch::blocks(t)?, &t.prefix, t.at, &t.material),
        Template::Barrel(t) => (barrel::blocks(t)?, &t.prefix, t.at, &t.material),
        Template::Bridge(t) => (bridge::blocks(t)?, &t.prefix, t.at, &t.material),
        Template::Column(t) => (column::blocks(t)?, &t.prefix, t.at, &t.material),
        Template::Dome(t) => (dome::blocks(t)?, &t.prefix, t.at, &t.material),
        Template::FlatArch(t) => (flat_arch::blocks(t)?, &t.prefix, t.at, &t.material),
        Template::Groin(t) => (groin::blocks(t)?, &t.prefix, t.at, &t.material),
        Template::Lattice(t) => (lattice::blocks(t)?, &t.prefix, t.at, &t.material),
        Template::Leaves(t) => (leaves::blocks(t)?, &t.prefix, t.at, &t.material),
        Template::Portal(t) => (portal::blocks(t)?, &t.prefix, t.at, &t.material),
        Template::Stack(t) => (stack::blocks(t)?, &t.prefix, t.at, &t.material),
        Template::Tower(t) => (tower::blocks(t)?, &t.prefix, t.at, &t.material),
        Template::Wall(t) => (wall::blocks(t)?, &t.prefix, t.at, &t.material),
    };
    blocks.retain(|b| template.has_supports() || !b.support);
    let root = JsonPath::root().key(template.name());
    if at.iter().any(|c| !c.is_finite()) {
        return Err(InputError::at(
            root.key("at"),
            format!("must be three finite numbers, got {at:?}"),
        ));
    }
    for block in &mut blocks {
        block.id.insert_str(0, prefix);
        block.at = std::array::from_fn(|k| block.at[k] + at[k]);
        // Backing has a material of its own.
        if block.material.is_none() {
            block.material.clone_from(material);
        }
        if !is_finite(block) {
            return Err(InputError::at(
                root,
                format!("block {:?} has coordinates beyond the range of numbers", block.id),
            )
            .hint("lengths are in m; use numbers of moderate size"));
        }
    }
    Ok(blocks)
}

/// The keys of all templates.
pub fn template_names() -> Vec<&'static str> {
    examples().iter().map(Template::name).collect()
}

/// A template with sensible values, as the scene file spells it: `{"column": {"blocks": 8, "size":
/// [1, 1, 0.5]}}`. Optional fields are left out, and may be added; a field set to `null` counts as
/// left out.
pub fn default_template(name: &str) -> Option<serde_json::Value> {
    examples().iter().find(|t| t.name() == name).and_then(|t| serde_json::to_value(t).ok())
}

/// Takes out of the values of a template what excludes the keys that somebody chose, unless that
/// was chosen as well: a span is no mistake because the template's own values have a radius.
pub fn make_room(values: &mut serde_json::Map<String, serde_json::Value>, chosen: &[(&str, &str)]) {
    let is_chosen = |key: &str| chosen.iter().any(|(k, _)| *k == key);
    let by_span = ["span", "rise", "intrados_span", "intrados_rise"].into_iter().any(is_chosen)
        || chosen.iter().any(|(key, value)| {
            *key == "profile" && ["elliptical", "parabolic", "three_centred"].contains(value)
        });
    for (own, excluded) in [("radius", by_span), ("shift", is_chosen("harmonic"))] {
        // A flat arch has a span of its own and no radius.
        if excluded && !is_chosen(own) {
            values.remove(own);
        }
    }
}

/// One template of each kind, of about the proportions of real ones; all of them stand with a
/// friction of 0.7.
pub fn examples() -> Vec<Template> {
    vec![
        Template::Arch(template::Arch {
            radius: Some(5.0),
            thickness: 0.8,
            depth: 1.0,
            voussoirs: 27,
            ..Default::default()
        }),
        Template::Barrel(template::Barrel {
            radius: Some(3.0),
            thickness: 0.45,
            depth: 6.0,
            voussoirs: 15,
            courses: 6,
            ..Default::default()
        }),
        Template::Bridge(template::Bridge {
            spans: vec![template::BridgeSpan {
                clear_span: 6.0,
                rise: 1.5,
                thickness: 0.4,
                rings: 1,
                voussoirs: 27,
                ..Default::default()
            }],
            width: 4.0,
            fill: Some(template::Fill {
                cover: 0.3,
                unit_weight: 18e3,
                friction_deg: Some(30.0),
                ..Default::default()
            }),
            ..Default::default()
        }),
        Template::Column(template::Column {
            blocks: 8,
            size: [1.0, 1.0, 0.5],
            ..Default::default()
        }),
        Template::Dome(template::Dome {
            radius: 5.0,
            thickness: 0.5,
            rings: 8,
            segments: 24,
            ..Default::default()
        }),
        Template::FlatArch(template::FlatArch {
            span: 3.0,
            height: 0.8,
            depth: 0.6,
            voussoirs: 9,
            center_depth: Some(3.0),
            ..Default::default()
        }),
        Template::Groin(template::Groin {
            clear_span: 4.0,
            rise: 2.0,
            thickness: 0.4,
            side: 5.0,
            voussoirs: 16,
            ..Default::default()
        }),
        Template::Lattice(template::Lattice { radius: 0.01, layers: 4, ..Default::default() }),
        Template::Leaves(template::Leaves {
            size: [0.6, 0.25, 0.25],
            hollow: 0.2,
            courses: 9,
            blocks: 6,
            through_every: Some(3),
            ..Default::default()
        }),
        Template::Portal(template::Portal {
            clear_span: 3.0,
            rise: 1.5,
            thickness: 0.4,
            depth: 1.0,
            voussoirs: 15,
            pier: template::Pier { width: 1.2, height: 3.0, courses: 6 },
            ..Default::default()
        }),
        Template::Stack(template::Stack {
            blocks: 10,
            size: [1.0, 1.0, 0.2],
            shift: Some(0.05),
            ..Default::default()
        }),
        Template::Tower(template::Tower {
            size: [4.0, 4.0],
            thickness: 0.8,
            course: 0.6,
            courses: 20,
            blocks: 2,
            ..Default::default()
        }),
        Template::Wall(template::Wall {
            size: [1.0, 0.5, 0.4],
            courses: 8,
            blocks: 10,
            ..Default::default()
        }),
    ]
}

fn is_finite(block: &BlockSpec) -> bool {
    let all = |c: &[f64]| c.iter().all(|x| x.is_finite());
    all(&block.at)
        && match &block.shape {
            Shape::Cuboid { size } => all(size),
            Shape::Polyhedron { vertices, .. } | Shape::Mesh { vertices, .. } => {
                vertices.iter().all(|v| all(v))
            }
            Shape::Prism { polygon, depth } => depth.is_finite() && polygon.iter().all(|p| all(p)),
            Shape::Sphere { radius } => radius.is_finite(),
            Shape::Plane { normal } => all(normal),
            Shape::Clump { spheres } => spheres.iter().all(|b| all(&b.at) && b.radius.is_finite()),
        }
}

#[cfg(test)]
mod tests;
