//! Templates → blocks. One file per template.

use crate::{
    error::InputError,
    scene::{BlockSpec, Shape, Template},
};

/// The blocks of a template, in order.
///
/// # Errors
/// A parameter is out of its range; the path is relative to the template (`column.blocks`).
pub fn expand(template: &Template) -> Result<Vec<BlockSpec>, InputError> {
    match template {
        Template::Column(c) => Ok((0..c.blocks)
            .map(|i| BlockSpec {
                at: [0.0, 0.0, c.size[2] * (i as f64 + 0.5)],
                ..BlockSpec::new(format!("b{i:02}"), Shape::Cuboid { size: c.size })
            })
            .collect()),
    }
}
