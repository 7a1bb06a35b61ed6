//! The bridge: rings between springers and piers, and what the fill does to every chord of their
//! extrados.

mod backing;
mod chord;
mod course;
mod fill;
mod plan;
mod pressure;
mod said;

pub use fill::{Spread, Surface, loads, soil};
pub use said::said;

use super::support;
use crate::{BlockSpec, Shape, template::Bridge};
use backing::Masonry;
use base::error::InputError;
use plan::{Plan, voussoir};

pub fn blocks(bridge: &Bridge) -> Result<Vec<BlockSpec>, InputError> {
    let plan = Plan::of(bridge)?;
    let masonry = Masonry::of(bridge, &plan)?;
    fill::check(bridge, &plan, masonry.as_ref())?;
    let prism = |polygon| Shape::Prism { polygon, depth: bridge.width };
    let mut blocks = Vec::new();
    for (s, span) in plan.spans.iter().enumerate() {
        for (r, ring) in span.rings.iter().enumerate() {
            let n = ring.voussoirs.len();
            let placed = ring.voussoirs.iter().enumerate();
            blocks.extend(placed.map(|(v, polygon)| {
                BlockSpec::new(voussoir(bridge, s, r, v, n), prism(span.placed(polygon)))
            }));
        }
    }
    for (k, pier) in plan.piers.iter().enumerate() {
        blocks.push(BlockSpec::new(format!("pier_{}", k + 1), prism(pier.body.clone())));
        blocks.push(support(format!("footing_{}", k + 1), prism(pier.footing.clone())));
    }
    let ends = [("left", plan.spans.first(), 0), ("right", plan.spans.last(), 1)];
    for (word, span, side) in ends {
        let Some(span) = span else { continue };
        let several = span.rings.len() > 1;
        for (r, ring) in span.rings.iter().enumerate() {
            let id = if several {
                format!("springer_{word}_{}", r + 1)
            } else {
                format!("springer_{word}")
            };
            blocks.push(support(id, prism(span.placed(&ring.springers[side]))));
        }
    }
    blocks.extend(masonry.iter().flat_map(|m| m.blocks(bridge.width)));
    Ok(blocks)
}
