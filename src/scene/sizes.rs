//! How large the grains of a protocol are.

use base::error::{InputError, JsonPath};
use serde::{Deserialize, Serialize};

/// Most that radii may differ from the mean.
const WIDEST: f64 = 0.9;
/// Largest over smallest diameter of a curve. More: a grain of the one has thousands of neighbours
/// among the others, and takes steps that are too long for them.
const RANGE: f64 = 10.0;

/// A distribution of diameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Sizes {
    /// Radii spread evenly over the mean × (1 ± this).
    Even(f64),
    /// A grading curve: diameters, m, ascending, with the share of the mass that is finer, which
    /// begins with 0 and ends with 1. Between two of them the mass is spread evenly over the
    /// logarithm of the diameter, as the curve is drawn; two equal diameters are a class of that
    /// diameter.
    Curve(Vec<[f64; 2]>),
}

impl Sizes {
    /// A grading curve as a table of two columns, diameter in m and share finer (0 to 1, or up to
    /// 100 in per cent); a head and lines that begin with `#` are left out.
    ///
    /// # Errors
    /// A line is no pair of numbers, with its place; the curve is none ([`Sizes::check`]).
    pub fn read(name: &str, text: &str) -> Result<Self, InputError> {
        let mut curve: Vec<[f64; 2]> = Vec::new();
        for (k, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
            let line = line.trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let words = line.split([',', ';', '\t', ' ']).map(str::trim).filter(|w| !w.is_empty());
            let numbers: Result<Vec<f64>, _> = words.map(str::parse).collect();
            match numbers.as_deref() {
                Ok([diameter, finer]) => curve.push([*diameter, *finer]),
                // Names of the columns.
                Err(_) if curve.is_empty() => {}
                _ => {
                    let error = InputError::at(JsonPath::root(), "expected a diameter and a share");
                    return Err(InputError {
                        file: Some(name.into()),
                        position: Some((k + 1, 1)),
                        ..error.hint("a line such as `0.004, 0.35`: diameter in m, share of the mass that is finer")
                    });
                }
            }
        }
        if curve.iter().any(|c| c[1] > 1.0) {
            curve.iter_mut().for_each(|c| c[1] /= 100.0);
        }
        let sizes = Self::Curve(curve);
        sizes.check().map_err(|e| InputError { file: Some(name.into()), ..e })?;
        Ok(sizes)
    }

    /// Refuses what is no distribution.
    ///
    /// # Errors
    /// The spread is out of its range; the curve does not ascend from 0 to 1, or is too wide.
    pub fn check(&self) -> Result<(), InputError> {
        let refuse = |text: String, hint: &str| {
            Err(InputError::at(JsonPath::root().key("sizes"), text).hint(hint))
        };
        match self {
            Self::Even(s) if (0.0..=WIDEST).contains(s) => Ok(()),
            Self::Even(s) => refuse(
                format!("must be from 0 to {WIDEST}, got {s}"),
                "radii are the mean × (1 ± sizes); a grading curve is a file of two columns",
            ),
            Self::Curve(c) => {
                let hint = "diameter in m and share of the mass that is finer, both ascending, \
                            from share 0 to share 1";
                let (Some(first), Some(last)) = (c.first(), c.last()) else {
                    return refuse("the curve is empty".into(), hint);
                };
                if c.len() < 2 || c.iter().flatten().any(|v| !v.is_finite()) || first[0] <= 0.0 {
                    return refuse("needs two points, with finite diameters > 0".into(), hint);
                }
                if first[1] != 0.0 || last[1] != 1.0 {
                    let text =
                        format!("must go from 0 to 1, goes from {} to {}", first[1], last[1]);
                    return refuse(text, hint);
                }
                let falls = |w: &[[f64; 2]]| w[1][0] < w[0][0] || w[1][1] < w[0][1];
                if let Some(w) = c.windows(2).find(|w| falls(w)) {
                    return refuse(format!("{:?} comes after {:?}", w[1], w[0]), hint);
                }
                let range = last[0] / first[0];
                if range > RANGE {
                    let range = (range * 1e3).round() / 1e3;
                    return refuse(
                        format!(
                            "the largest grain is {range} times the smallest, at most {RANGE} are possible"
                        ),
                        "leave out the finest and the coarsest grains",
                    );
                }
                Ok(())
            }
        }
    }

    /// The median diameter by mass, m, of a curve (d₅₀).
    pub fn median(&self) -> Option<f64> {
        let Self::Curve(curve) = self else { return None };
        let w = curve.windows(2).find(|w| w[1][1] >= 0.5)?;
        let share = (0.5 - w[0][1]) / (w[1][1] - w[0][1]);
        Some(w[0][0] * (w[1][0] / w[0][0]).powf(share))
    }

    /// The greatest diameter over `d`.
    pub fn greatest(&self, d: f64) -> f64 {
        match self {
            Self::Even(s) => 1.0 + s,
            Self::Curve(c) => c.last().map_or(1.0, |c| c[0] / d),
        }
    }

    /// The mean volume of a grain over that of one of diameter `d`.
    pub fn mean_volume(&self, d: f64) -> f64 {
        match self {
            // The mean of (1 + s u)³ over u from -1 to 1.
            Self::Even(s) => 1.0 + s.powi(2),
            // All mass over all grains.
            Self::Curve(_) => 1.0 / self.classes(d).iter().map(|c| c.count).sum::<f64>(),
        }
    }

    /// The diameter of a grain over `d`, `u` from 0 to 1 its place among all by number.
    pub fn diameter(&self, d: f64, u: f64) -> f64 {
        if let Self::Even(s) = self {
            return 1.0 + s * (2.0 * u - 1.0);
        }
        let classes = self.classes(d);
        let mut left = u * classes.iter().map(|c| c.count).sum::<f64>();
        for class in &classes {
            if left <= class.count {
                return class.diameter(left / class.count);
            }
            left -= class.count;
        }
        self.greatest(d)
    }

    /// The classes between the points of a curve that hold any mass.
    fn classes(&self, d: f64) -> Vec<Class> {
        let Self::Curve(curve) = self else { return Vec::new() };
        let class = |w: &[[f64; 2]]| Class::new([w[0][0] / d, w[1][0] / d], w[1][1] - w[0][1]);
        curve.windows(2).filter(|w| w[1][1] > w[0][1]).map(class).collect()
    }
}

/// A class: mass m spread evenly over x = ln D from x₀ to x₁, so that the number of grains below D
/// is `m / (x₁ − x₀) ∫ e^(−3 x) dx = m (D₀⁻³ − D⁻³) / 3 (x₁ − x₀)` in volumes of a grain of unit
/// diameter.
struct Class {
    ends: [f64; 2],
    /// Number of grains a unit of mass of the whole.
    count: f64,
}

impl Class {
    fn new(ends: [f64; 2], mass: f64) -> Self {
        let [low, high] = ends.map(|e| e.powi(-3));
        let width = (ends[1] / ends[0]).ln();
        let count = if width > 0.0 { mass * (low - high) / (3.0 * width) } else { mass * low };
        Self { ends, count }
    }

    /// The diameter below which a share of its grains lies.
    fn diameter(&self, share: f64) -> f64 {
        let [low, high] = self.ends.map(|e| e.powi(-3));
        (low - share * (low - high)).powf(-1.0 / 3.0).clamp(self.ends[0], self.ends[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn curve(points: &[[f64; 2]]) -> Sizes {
        Sizes::Curve(points.to_vec())
    }

    /// Grains drawn by number have the masses of the curve again.
    #[test]
    fn what_is_drawn_has_the_curve_that_was_given() {
        let given = [[0.002, 0.0], [0.004, 0.3], [0.005, 0.3], [0.008, 0.9], [0.008, 1.0]];
        let sizes = curve(&given);
        let d = sizes.median().unwrap();
        let n = 400_000;
        let drawn: Vec<f64> =
            (0..n).map(|k| d * sizes.diameter(d, (k as f64 + 0.5) / n as f64)).collect();
        let mass = |below: f64| {
            drawn.iter().filter(|x| **x <= below).map(|x| x.powi(3)).sum::<f64>()
                / drawn.iter().map(|x| x.powi(3)).sum::<f64>()
        };
        for [at, finer] in [[0.002, 0.0], [0.004, 0.3], [0.005, 0.3], [d, 0.5], [0.00799999, 0.9]] {
            assert!((mass(at) - finer).abs() < 2e-4, "{at}: {} and not {finer}", mass(at));
        }
        let mean = drawn.iter().map(|x| (x / d).powi(3)).sum::<f64>() / n as f64;
        assert!((sizes.mean_volume(d) / mean - 1.0).abs() < 1e-4, "{mean}");
    }

    #[test]
    fn an_even_spread_is_what_it_was() {
        let even = Sizes::Even(0.2);
        assert_eq!((even.diameter(0.01, 0.0), even.diameter(0.01, 0.5)), (0.8, 1.0));
        assert!((even.mean_volume(0.01) - 1.04).abs() < 1e-12 && even.median().is_none());
    }

    #[test]
    fn curves_are_read_and_mistakes_are_named() {
        let read = Sizes::read("c.csv", "diameter,finer\n# sieves\n0.002,0\n0.004;40\n0.008 100\n");
        assert_eq!(read, Ok(curve(&[[0.002, 0.0], [0.004, 0.4], [0.008, 1.0]])));
        let said = |text: &str| Sizes::read("c.csv", text).unwrap_err().to_string();
        assert!(said("0.002,0\n0.004,x\n").starts_with("c.csv:2:1: expected a diameter"));
        assert!(said("0.002,0\n0.004,0.5\n").contains("goes from 0 to 0.5"));
        assert!(said("0.004,0\n0.002,1\n").contains("comes after"));
        assert!(said("0.001,0\n0.02,1\n").contains("20 times"));
        assert!(said("").contains("empty"));
        assert!(Sizes::Even(1.0).check().is_err() && Sizes::Even(f64::NAN).check().is_err());
    }
}
