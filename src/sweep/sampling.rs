//! Row → parameters, a function of (plan, row) alone.
//!
//! Random numbers are those of PCG XSL RR 128/64 (O'Neill 2014), started from the plan's seed. Its
//! jump-ahead gives row *i* its own stretch of the one stream, so that no row depends on which
//! others were drawn.

use super::{distribution::Axis, plan::Sampling};
use rand_pcg::{
    Pcg64,
    rand_core::{Rng, SeedableRng},
};

/// Sobol points are defined up to this many rows and numbers (Burley 2020, as tabulated by the
/// crate `sobol_burley`).
pub(super) const SOBOL: (usize, usize) = (1 << 16, 256);

/// Parameters of every row.
#[derive(Clone, Debug)]
pub(super) struct Sampler {
    axes: Vec<Axis>,
    scheme: Scheme,
    seed: u64,
    /// Rows in all.
    pub rows: usize,
}

#[derive(Clone, Debug)]
enum Scheme {
    Grid,
    /// One permutation of the slices per axis.
    LatinHypercube(Vec<Vec<u32>>),
    Sobol,
    Random,
}

impl Sampler {
    /// `rows` is the product of the counts for a grid, else the number of samples.
    pub fn new(axes: Vec<Axis>, sampling: &Sampling, seed: u64, rows: usize) -> Self {
        let scheme = match sampling {
            Sampling::Grid {} => Scheme::Grid,
            Sampling::LatinHypercube { .. } => {
                let mut stream = Pcg64::seed_from_u64(seed);
                Scheme::LatinHypercube(
                    axes.iter().map(|_| permutation(rows, &mut stream)).collect(),
                )
            }
            Sampling::Sobol { .. } => Scheme::Sobol,
            Sampling::Random { .. } => Scheme::Random,
        };
        Self { axes, scheme, seed, rows }
    }

    /// The numbers of a row, in the order of `vary`.
    pub fn parameters(&self, row: usize) -> Vec<f64> {
        match &self.scheme {
            Scheme::Grid => {
                let mut rest = row;
                let mut values: Vec<f64> = self
                    .axes
                    .iter()
                    .rev()
                    .map(|axis| {
                        let k = rest % axis.count.max(1);
                        rest /= axis.count.max(1);
                        axis.level(k)
                    })
                    .collect();
                values.reverse();
                values
            }
            Scheme::LatinHypercube(slices) => {
                // Far behind the permutations in the same stream.
                let mut stream = self.stream(row, 1 << 64);
                let inside = |(axis, slices): (&Axis, &Vec<u32>)| {
                    let slice = slices.get(row).copied().unwrap_or(0);
                    axis.quantile(open_unit(
                        (f64::from(slice) + unit(&mut stream)) / self.rows as f64,
                    ))
                };
                self.axes.iter().zip(slices).map(inside).collect()
            }
            Scheme::Sobol => {
                let seed = (self.seed ^ (self.seed >> 32)) as u32;
                let point = |axis: usize| {
                    f64::from(sobol_burley::sample(row as u32, axis as u32, seed)) + HALF_CELL
                };
                self.axes
                    .iter()
                    .enumerate()
                    .map(|(i, axis)| axis.quantile(open_unit(point(i))))
                    .collect()
            }
            Scheme::Random => {
                let mut stream = self.stream(row, 0);
                self.axes.iter().map(|axis| axis.quantile(unit(&mut stream))).collect()
            }
        }
    }

    fn stream(&self, row: usize, offset: u128) -> Pcg64 {
        let mut stream = Pcg64::seed_from_u64(self.seed);
        stream.advance(offset + row as u128 * self.axes.len() as u128);
        stream
    }
}

/// Sobol points are single precision, multiples of 2⁻²⁴: half a step keeps them off 0.
const HALF_CELL: f64 = 1.0 / 33_554_432.0;

/// Uniform in the open interval (0, 1): the middle of one of 2⁵³ cells.
fn unit(stream: &mut Pcg64) -> f64 {
    ((stream.next_u64() >> 11) as f64 + 0.5) / 9_007_199_254_740_992.0
}

/// Off 0 and 1, where quantiles may be infinite.
fn open_unit(u: f64) -> f64 {
    u.clamp(f64::EPSILON / 4.0, 1.0 - f64::EPSILON / 2.0)
}

/// A random order of 0 … n − 1 (Fisher & Yates; Lemire's multiply-shift, whose bias is below n /
/// 2⁶⁴).
fn permutation(n: usize, stream: &mut Pcg64) -> Vec<u32> {
    let mut order: Vec<u32> = (0..n as u32).collect();
    for k in (1..n).rev() {
        let j = (u128::from(stream.next_u64()) * (k as u128 + 1)) >> 64;
        order.swap(k, j as usize);
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Vary;

    fn unit_square(sampling: &Sampling, seed: u64, rows: usize) -> Vec<Vec<f64>> {
        let axis = || {
            Axis::new(&Vary { from: Some(0.0), to: Some(1.0), ..Vary::default() }, false).unwrap()
        };
        let sampler = Sampler::new(vec![axis(), axis()], sampling, seed, rows);
        // Backwards: a row does not depend on those before.
        (0..rows).rev().map(|row| sampler.parameters(row)).rev().collect()
    }

    #[test]
    fn a_latin_hypercube_takes_every_slice_once() {
        let rows = unit_square(&Sampling::LatinHypercube { samples: 100 }, 7, 100);
        for axis in 0..2 {
            let mut slices: Vec<usize> = rows.iter().map(|r| (r[axis] * 100.0) as usize).collect();
            slices.sort_unstable();
            assert_eq!(slices, (0..100).collect::<Vec<_>>());
        }
    }

    #[test]
    fn sobol_points_fill_the_square_more_evenly_than_chance() {
        let cells = |rows: &[Vec<f64>]| {
            let mut counts = [0_i32; 64];
            rows.iter()
                .for_each(|r| counts[(r[0] * 8.0) as usize * 8 + (r[1] * 8.0) as usize] += 1);
            counts.iter().map(|c| (c - 4).abs()).max().unwrap()
        };
        assert_eq!(cells(&unit_square(&Sampling::Sobol { samples: 256 }, 3, 256)), 0);
        assert!(cells(&unit_square(&Sampling::Random { samples: 256 }, 3, 256)) > 2);
    }

    #[test]
    fn seeds_differ_and_the_stream_is_the_named_one() {
        for sampling in [
            Sampling::Random { samples: 50 },
            Sampling::LatinHypercube { samples: 50 },
            Sampling::Sobol { samples: 50 },
        ] {
            let (one, again, other) = (
                unit_square(&sampling, 1, 50),
                unit_square(&sampling, 1, 50),
                unit_square(&sampling, 2, 50),
            );
            assert_eq!(one, again);
            assert_ne!(one, other);
            assert!(one.iter().flatten().all(|u| *u > 0.0 && *u < 1.0));
        }
        let mut stream = Pcg64::seed_from_u64(1);
        let drawn: Vec<f64> = (0..100).map(|_| unit(&mut stream)).collect();
        assert_eq!(unit_square(&Sampling::Random { samples: 50 }, 1, 50).concat(), drawn);
    }

    #[test]
    fn the_last_number_of_a_grid_changes_fastest() {
        let axis = |values: &[f64]| {
            Axis::new(
                &Vary {
                    values: Some(values.iter().map(|v| (*v).into()).collect()),
                    ..Vary::default()
                },
                true,
            )
            .unwrap()
        };
        let sampler =
            Sampler::new(vec![axis(&[1.0, 2.0]), axis(&[3.0, 4.0, 5.0])], &Sampling::Grid {}, 0, 6);
        let rows: Vec<Vec<f64>> = (0..6).map(|r| sampler.parameters(r)).collect();
        assert_eq!(
            rows,
            [[1.0, 3.0], [1.0, 4.0], [1.0, 5.0], [2.0, 3.0], [2.0, 4.0], [2.0, 5.0]]
                .map(|r| r.to_vec())
        );
    }
}
