//! The stack: equal boxes, each shifted against the one below by a constant, or so that all joints
//! are equally near to tipping.

use super::{check::TemplatePath, numbered, support};
use crate::{BlockSpec, Shape, template::Stack};
use base::error::InputError;

pub fn blocks(stack: &Stack) -> Result<Vec<BlockSpec>, InputError> {
    let place = TemplatePath::template("stack");
    place.size("size", stack.size)?;
    place.count("blocks", stack.blocks, 1)?;
    place.total("blocks", &[stack.blocks])?;
    let [length, depth, height] = stack.size;
    let (base, left) = match (stack.shift, stack.harmonic) {
        (Some(shift), None) => {
            place.finite("shift", shift)?;
            // One block length of ground on either side of the lowest block.
            ([-length, 2.0 * length], (0..stack.blocks).map(|i| i as f64 * shift).collect())
        }
        (None, Some(scale)) => {
            place.finite("harmonic", scale)?;
            ([-2.0 * length, 0.0], harmonic(stack.blocks, length, scale))
        }
        (Some(_), Some(_)) => {
            return Err(place.error(
                "harmonic",
                "shift and harmonic exclude each other",
                "leave one of them out",
            ));
        }
        (None, None) => {
            return Err(place.error(
                "shift",
                "missing",
                "give shift (m per block) or harmonic (1 is the critical overhang)",
            ));
        }
    };
    let base = BlockSpec {
        at: [(base[0] + base[1]) / 2.0, 0.0, -height / 2.0],
        ..support("base", Shape::Cuboid { size: [base[1] - base[0], depth, height] })
    };
    let free = left.into_iter().enumerate().map(|(i, x): (usize, f64)| BlockSpec {
        at: [x + length / 2.0, 0.0, height * (i as f64 + 0.5)],
        ..BlockSpec::new(numbered("b", i, stack.blocks), Shape::Cuboid { size: stack.size })
    });
    Ok(std::iter::once(base).chain(free).collect())
}

/// Left ends of the blocks from the bottom up: the right end of block k, counted from the top, is
/// at scale × length × Σ_{j=k}^{n} 1/(2j).
fn harmonic(blocks: usize, length: f64, scale: f64) -> Vec<f64> {
    let mut sum = 0.0;
    (1..=blocks)
        .rev()
        .map(|j| {
            sum += 1.0 / (2.0 * j as f64);
            (scale * sum - 1.0) * length
        })
        .collect()
}
