//! The flat arch: voussoirs between two horizontal lines, joints vertical or through one point
//! below.

use super::{check::TemplatePath, numbered, support};
use crate::{BlockSpec, Shape, template::FlatArch};
use base::error::InputError;

pub fn blocks(arch: &FlatArch) -> Result<Vec<BlockSpec>, InputError> {
    let place = TemplatePath::template("flat_arch");
    place.length("span", arch.span)?;
    place.length("height", arch.height)?;
    place.length("depth", arch.depth)?;
    place.count("voussoirs", arch.voussoirs, 1)?;
    place.total("voussoirs", &[arch.voussoirs])?;
    let slope = match arch.center_depth {
        None => 0.0,
        Some(c) if c.is_finite() && c > arch.height / 2.0 => arch.height / 2.0 / c,
        Some(c) => {
            return Err(place.error(
                "center_depth",
                format!("must be > height / 2 = {}, got {c}", arch.height / 2.0),
                "the joints meet in a point below the intrados; leave it out for vertical joints",
            ));
        }
    };
    let n = arch.voussoirs;
    // A joint that crosses mid-height at x meets the intrados at x (1 − slope) and the extrados at
    // x (1 + slope).
    let joint = |j: usize| {
        let x = arch.span / 2.0 * ((2.0 * j as f64 - n as f64) / n as f64);
        [[x * (1.0 - slope), 0.0], [x * (1.0 + slope), arch.height]]
    };
    let prism = |polygon| Shape::Prism { polygon, depth: arch.depth };
    let mut blocks: Vec<_> = (0..n)
        .map(|i| {
            let ([a, d], [b, c]) = (joint(i), joint(i + 1));
            BlockSpec::new(numbered("v", i, n), prism(vec![a, b, c, d]))
        })
        .collect();
    let ([a, d], [b, c]) = (joint(0), joint(n));
    let end = arch.span / 2.0 * (1.0 + slope) + arch.height;
    blocks.push(support("abutment_left", prism(vec![[-end, 0.0], a, d, [-end, arch.height]])));
    blocks.push(support("abutment_right", prism(vec![b, [end, 0.0], [end, arch.height], c])));
    Ok(blocks)
}
