//! The wall of two leaves: two walls in running bond side by side, tied by courses of through stones.

use super::{check::TemplatePath, digits, support, wall::cut};
use crate::{BlockSpec, Shape, template::Leaves};
use base::error::InputError;

pub fn blocks(wall: &Leaves) -> Result<Vec<BlockSpec>, InputError> {
    let place = TemplatePath::template("leaves");
    place.size("size", wall.size)?;
    place.length("hollow", wall.hollow)?;
    place.count("courses", wall.courses, 1)?;
    place.count("blocks", wall.blocks, 1)?;
    place.total("courses", &[2, wall.courses, wall.blocks.saturating_add(1)])?;
    if let Some(every) = wall.through_every {
        place.count("through_every", every, 1)?;
    }
    let [length, depth, height] = wall.size;
    let whole = 2.0 * depth + wall.hollow;
    let (courses, pieces) = (digits(wall.courses), digits(wall.blocks + 1));
    let off = 0.5 * (depth + wall.hollow);
    let mut blocks = Vec::new();
    for c in 0..wall.courses {
        let through = wall.through_every.is_some_and(|n| (c + 1).is_multiple_of(n));
        let leaves = [("f", -off, depth), ("b", off, depth)];
        let leaves = if through { &[("t", 0.0, whole)][..] } else { &leaves[..] };
        let z = height * (c as f64 + 0.5);
        for &(letter, y, depth) in leaves {
            for (k, x) in cut(&(0.0..wall.blocks as f64), c % 2 == 1, &[]).iter().enumerate() {
                let size = [(x.end - x.start) * length, depth, height];
                let at = [0.5 * (x.start + x.end) * length, y, z];
                let id = format!("{letter}{c:0courses$}_{k:0pieces$}");
                blocks.push(BlockSpec { at, ..BlockSpec::new(id, Shape::Cuboid { size }) });
            }
        }
    }
    let total = wall.blocks as f64 * length;
    let slab = Shape::Cuboid { size: [total, whole, height] };
    let at = [0.5 * total, 0.0, -0.5 * height];
    blocks.push(BlockSpec { at, ..support("base", slab) });
    Ok(blocks)
}
