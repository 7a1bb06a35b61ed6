//! A lognormal fragility curve by maximum likelihood.
//!
//! Law: of structures under an intensity s the share `Φ((ln s − ln θ) / β)` fails. Of rows that fail
//! or stand, θ and β maximise the likelihood of a probit in ln s (Baker, Earthquake Spectra 31, 2015,
//! 579–599), found by Fisher scoring; of rows whose capacity itself is known they are mean and
//! standard deviation of its logarithm. The band is that of the fitted curve, from the covariance of
//! both numbers (inverse of the Fisher information, delta method). Rows count as independent.

use serde::Serialize;
use statrs::distribution::{Continuous, ContinuousCDF, Normal};

/// A lognormal curve.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LognormalFit {
    /// θ: where half fail.
    pub median: f64,
    /// Its 95 % interval.
    pub median_95: [f64; 2],
    /// β: standard deviation of the logarithm.
    pub dispersion: f64,
    /// The curve: the intensity; lower end of the 95 % band, the share, upper end.
    pub curve: Vec<(f64, [f64; 3])>,
}

/// 97.5 % quantile of the standard normal distribution.
const Z95: f64 = 1.959_963_984_540_054;
/// Points of the curve.
const POINTS: usize = 61;
/// Most steps; it takes about six.
const STEPS: usize = 200;
/// A step that changes neither number by more than this, in standard deviations of ln s, is the
/// last. Larger: fewer digits than are printed. Smaller: rounding.
const STILL: f64 = 1e-12;

/// A likelihood that is less by this share of it is as good. Larger: steps that lead away from the
/// greatest. Smaller: near the greatest, steps are halved for the rounding of its sum without end.
const ROUNDING: f64 = 1e-12;

/// Linear predictor `a + b y` with the covariance of `a` and `b`.
struct Line {
    a: f64,
    b: f64,
    var: [f64; 3],
}

impl LognormalFit {
    /// The curve of rows that failed or stood under intensities.
    ///
    /// # Errors
    /// There is none, and why.
    pub fn of_fates(rows: &[(f64, bool)]) -> Result<Self, String> {
        positive(rows.iter().map(|r| r.0))?;
        let logs: Vec<(f64, bool)> = rows.iter().map(|r| (r.0.ln(), r.1)).collect();
        let ends = |fails: bool| {
            let own = logs.iter().filter(|r| r.1 == fails).map(|r| r.0);
            own.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), y| (l.min(y), h.max(y)))
        };
        let (failed, stood) = (ends(true), ends(false));
        if failed.0 > failed.1 || stood.0 > stood.1 {
            return Err("all rows fail or none does".into());
        }
        if failed.0 >= stood.1 || stood.0 >= failed.1 {
            return Err("intensities that fail and that are survived do not overlap: the share is a step of unknown dispersion".into());
        }
        let mean = logs.iter().map(|r| r.0).sum::<f64>() / logs.len() as f64;
        let spread = logs.iter().map(|r| (r.0 - mean).powi(2)).sum::<f64>() / logs.len() as f64;
        let spread = spread.sqrt();
        let unit: Vec<(f64, bool)> = logs.iter().map(|r| ((r.0 - mean) / spread, r.1)).collect();
        let line = probit(&unit).ok_or("the likelihood has no maximum")?;
        if line.b <= 0.0 {
            return Err("fewer rows fail as the intensity grows".into());
        }
        Ok(Self::along(&line, (mean, spread), (logs_ends(&logs), logs.len())))
    }

    /// The curve of capacities.
    ///
    /// # Errors
    /// There is none, and why.
    pub fn of_capacities(all: &[f64]) -> Result<Self, String> {
        positive(all.iter().copied())?;
        let n = all.len() as f64;
        let mean = all.iter().map(|v| v.ln()).sum::<f64>() / n;
        let spread = (all.iter().map(|v| (v.ln() - mean).powi(2)).sum::<f64>() / n).sqrt();
        if all.len() < 2 || spread <= 0.0 {
            return Err("all capacities are the same".into());
        }
        // η = (y − μ) / β: its variance is (1 + η² / 2) / n.
        let line = Line { a: 0.0, b: 1.0, var: [1.0 / n, 0.0, 0.5 / n] };
        let logs: Vec<(f64, bool)> = all.iter().map(|v| (v.ln(), true)).collect();
        Ok(Self::along(&line, (mean, spread), (logs_ends(&logs), all.len())))
    }

    /// The curve of a line in (y − mean) / spread.
    fn along(line: &Line, (mean, spread): (f64, f64), (ends, _): ((f64, f64), usize)) -> Self {
        let middle = -line.a / line.b;
        let at = |x: f64| (mean + spread * x).exp();
        let [aa, ab, bb] = line.var;
        // Delta method on −a / b.
        let of_middle = (aa + 2.0 * middle * ab + middle * middle * bb).max(0.0).sqrt() / line.b;
        let normal = Normal::standard();
        let curve = (0..POINTS).map(|k| {
            let y = ends.0 + (ends.1 - ends.0) * k as f64 / (POINTS - 1) as f64;
            let x = (y - mean) / spread;
            let eta = line.a + line.b * x;
            let half = Z95 * (aa + 2.0 * x * ab + x * x * bb).max(0.0).sqrt();
            (y.exp(), [eta - half, eta, eta + half].map(|e| normal.cdf(e)))
        });
        Self {
            median: at(middle),
            median_95: [at(middle - Z95 * of_middle), at(middle + Z95 * of_middle)],
            dispersion: spread / line.b,
            curve: curve.collect(),
        }
    }
}

fn positive(mut all: impl Iterator<Item = f64>) -> Result<(), String> {
    match all.all(|v| v > 0.0 && v.is_finite()) {
        true => Ok(()),
        false => Err("not all intensities are finite and above zero".into()),
    }
}

fn logs_ends(logs: &[(f64, bool)]) -> (f64, f64) {
    logs.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), r| (l.min(r.0), h.max(r.0)))
}

/// Fisher scoring from a curve that tells nothing, with steps halved until the likelihood grows.
fn probit(rows: &[(f64, bool)]) -> Option<Line> {
    let normal = Normal::standard();
    // Of the tail that is asked for, so that small shares keep their digits.
    let share = |eta: f64, fails: bool| normal.cdf(if fails { eta } else { -eta }).max(1e-300);
    let likelihood =
        |a: f64, b: f64| rows.iter().map(|&(x, fails)| share(a + b * x, fails).ln()).sum::<f64>();
    let (mut a, mut b) = (0.0, 0.0);
    let mut here = likelihood(a, b);
    for _ in 0..STEPS {
        let (mut score, mut information) = ([0.0; 2], [0.0; 3]);
        for &(x, fails) in rows {
            let eta = a + b * x;
            let (density, p, q) = (normal.pdf(eta), share(eta, true), share(eta, false));
            let pull = if fails { density / p } else { -density / q };
            let weight = density / p * (density / q);
            score = [score[0] + pull, score[1] + pull * x];
            let [i, j, k] = information;
            information = [i + weight, j + weight * x, k + weight * x * x];
        }
        let [i, j, k] = information;
        let det = i * k - j * j;
        if !(det > 0.0 && det.is_finite()) {
            return None;
        }
        let step = [(k * score[0] - j * score[1]) / det, (i * score[1] - j * score[0]) / det];
        let mut part = 1.0;
        let next = loop {
            let next = likelihood(a + part * step[0], b + part * step[1]);
            if next >= here - ROUNDING * here.abs() || part < 1e-9 {
                break next;
            }
            part *= 0.5;
        };
        (a, b, here) = (a + part * step[0], b + part * step[1], next);
        if step[0].abs().max(step[1].abs()) <= STILL * (1.0 + a.abs() + b.abs()) || part < 1e-9 {
            return Some(Line { a, b, var: [k / det, -j / det, i / det] });
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mortality of beetles under carbon disulphide (Bliss, Ann. Appl. Biol. 22, 1935, 134–167), by
    /// the logarithm to base 10 of the dose; probit fit as in Dobson, Generalized Linear Models.
    #[test]
    fn published_probit_fit() {
        let doses = [1.6907, 1.7242, 1.7552, 1.7842, 1.8113, 1.8369, 1.8610, 1.8839];
        let of = [59, 60, 62, 56, 63, 59, 62, 60];
        let dead = [6, 13, 18, 28, 52, 53, 61, 60];
        let mut rows = Vec::new();
        for k in 0..8 {
            rows.extend((0..of[k]).map(|i| (10f64.powf(doses[k]), i < dead[k])));
        }
        let fit = LognormalFit::of_fates(&rows).unwrap();
        let slope = 10f64.ln() / fit.dispersion;
        let intercept = -fit.median.log10() * slope;
        assert!((slope - 19.728).abs() < 2e-3, "{slope}");
        assert!((intercept + 34.935).abs() < 4e-3, "{intercept}");
        let [low, high] = fit.median_95;
        assert!(low < fit.median && fit.median < high);
        assert!(fit.curve.windows(2).all(|w| w[0].1[1] < w[1].1[1]));
        assert!(fit.curve.iter().all(|(_, [l, m, h])| l < m && m < h));
    }

    #[test]
    fn capacities_and_what_has_no_curve() {
        let fit = LognormalFit::of_capacities(&[1.0, 4.0]).unwrap();
        assert!((fit.median - 2.0).abs() < 1e-12);
        assert!((fit.dispersion - 2f64.ln()).abs() < 1e-12);
        for (rows, word) in [
            (&[(1.0, false), (2.0, false)][..], "none"),
            (&[(1.0, false), (2.0, true)][..], "step"),
            (&[(1.0, false), (2.0, true), (2.0, false)][..], "step"),
            (&[(0.0, false), (2.0, true)][..], "above zero"),
            (&[(1.0, true), (2.0, false), (3.0, true), (4.0, false)][..], "fewer rows fail"),
        ] {
            let why = LognormalFit::of_fates(rows).unwrap_err();
            assert!(why.contains(word), "{why}");
        }
        assert!(LognormalFit::of_capacities(&[1.0, 1.0]).is_err());
    }

    #[test]
    fn units_do_not_matter() {
        let rows: Vec<(f64, bool)> = (1..40).map(|k| (f64::from(k), (k * 7) % 40 < k)).collect();
        let fit = LognormalFit::of_fates(&rows).unwrap();
        let more: Vec<_> = rows.iter().map(|r| (1e3 * r.0, r.1)).collect();
        let other = LognormalFit::of_fates(&more).unwrap();
        assert!((other.median / fit.median / 1e3 - 1.0).abs() < 1e-9);
        assert!((other.dispersion / fit.dispersion - 1.0).abs() < 1e-9);
    }
}
