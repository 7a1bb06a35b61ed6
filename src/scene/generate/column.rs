//! The column: equal boxes on a support.

use super::{check::TemplatePath, numbered, support};
use crate::{BlockSpec, Shape, template::Column};
use base::error::InputError;

pub fn blocks(column: &Column) -> Result<Vec<BlockSpec>, InputError> {
    let place = TemplatePath::template("column");
    place.size("size", column.size)?;
    place.count("blocks", column.blocks, 1)?;
    place.total("blocks", &[column.blocks])?;
    let [length, depth, height] = column.size;
    let base = BlockSpec {
        at: [0.0, 0.0, -height / 2.0],
        ..support("base", Shape::Cuboid { size: [2.0 * length, depth, height] })
    };
    let free = (0..column.blocks).map(|i| BlockSpec {
        at: [0.0, 0.0, height * (i as f64 + 0.5)],
        ..BlockSpec::new(numbered("b", i, column.blocks), Shape::Cuboid { size: column.size })
    });
    Ok(std::iter::once(base).chain(free).collect())
}
