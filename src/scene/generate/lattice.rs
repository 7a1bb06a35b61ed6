//! Piles of equal spheres: face-centred cubic, square and triangular. Neighbours touch: centres are
//! two radii apart.

use super::{check::TemplatePath, numbered, support};
use crate::{
    BlockSpec, Shape,
    template::{Lattice, Packing},
};
use base::error::InputError;

pub fn blocks(lattice: &Lattice) -> Result<Vec<BlockSpec>, InputError> {
    let place = TemplatePath::template("lattice");
    place.length("radius", lattice.radius)?;
    place.count("layers", lattice.layers, 1)?;
    let layers = if lattice.packing == Packing::Bed { 1 } else { lattice.layers };
    place.total("layers", &[layers, layers])?;
    let side = lattice.side.unwrap_or(layers + 1);
    if side <= layers {
        let text = format!(
            "{layers} layers need more than {layers} spheres along a side of the bed, got {side}"
        );
        return Err(place.error(
            "side",
            text,
            "each layer is one sphere shorter than the one below",
        ));
    }
    let counts: Vec<usize> =
        (0..=layers).map(|level| layer_count(lattice.packing, side - level)).collect();
    let free =
        counts[1..].iter().try_fold(0_usize, |sum, n| sum.checked_add(*n)).unwrap_or(usize::MAX);
    place.total("side", &[free.saturating_add(counts[0])])?;
    let shape = || Shape::Sphere { radius: lattice.radius };
    let scaled = |p: [f64; 3]| p.map(|c| c * lattice.radius);
    let mut blocks = Vec::with_capacity(free + counts[0]);
    let bed = layer(lattice.packing, side, 0).into_iter().enumerate();
    blocks.extend(bed.map(|(i, at)| BlockSpec {
        at: scaled(at),
        ..support(numbered("bed", i, counts[0]), shape())
    }));
    let grains =
        (1..=layers).flat_map(|level| layer(lattice.packing, side - level, level)).enumerate();
    blocks.extend(grains.map(|(i, at)| BlockSpec {
        at: scaled(at),
        ..BlockSpec::new(numbered("g", i, free), shape())
    }));
    Ok(blocks)
}

fn layer_count(packing: Packing, side: usize) -> usize {
    let square = side.saturating_mul(side);
    match packing {
        Packing::Fcc => (square / 2).saturating_add(side.div_ceil(2)),
        Packing::Square | Packing::Bed => square,
        Packing::Triangular => side,
    }
}

/// Centres of one layer for spheres of radius 1.
fn layer(packing: Packing, side: usize, level: usize) -> Vec<[f64; 3]> {
    let h = level as f64;
    let (third, tall) = (1.0 / 3f64.sqrt(), (8.0f64 / 3.0).sqrt());
    match packing {
        // Along (2, 0, 0) and (1, √3, 0), raised by (1, 1/√3, √(8/3)).
        Packing::Fcc => (0..side)
            .flat_map(|i| (0..side - i).map(move |j| (i as f64, j as f64)))
            .map(|(i, j)| [2.0 * i + j + h, 3f64.sqrt() * j + third * h, tall * h])
            .collect(),
        Packing::Square | Packing::Bed => (0..side)
            .flat_map(|i| (0..side).map(move |j| (i as f64, j as f64)))
            .map(|(i, j)| [2.0 * i + h, 2.0 * j + h, std::f64::consts::SQRT_2 * h])
            .collect(),
        Packing::Triangular => {
            (0..side).map(|i| [2.0 * i as f64 + h, 0.0, 3f64.sqrt() * h]).collect()
        }
    }
}
