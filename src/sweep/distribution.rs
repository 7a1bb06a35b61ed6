//! Probability → value: the inverse distribution functions of what a plan can ask for.

use super::plan::Vary;
use base::{
    error::{InputError, JsonPath},
    tolerance,
};
use statrs::distribution::{ContinuousCDF, Normal};

/// What one number takes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    kind: Kind,
    /// Values on a grid.
    pub count: usize,
    round: bool,
}

#[derive(Clone, Debug, PartialEq)]
enum Kind {
    Interval {
        from: f64,
        to: f64,
    },
    Values(Vec<f64>),
    /// `mean + sd z`, or its exponential, with `z` standard normal between two ends.
    Gauss {
        mean: f64,
        sd: f64,
        low: f64,
        high: f64,
        exponential: bool,
        min: f64,
        max: f64,
    },
}

impl Axis {
    /// Checks what a plan says about one number; paths of errors are relative to it.
    pub fn new(vary: &Vary, grid: bool) -> Result<Self, InputError> {
        let at = |key: &str, message: String| InputError::at(JsonPath::root().key(key), message);
        let kinds = [
            ("from", vary.from.is_some() || vary.to.is_some()),
            ("values", vary.values.is_some()),
            ("normal", vary.normal.is_some()),
            ("lognormal", vary.lognormal.is_some()),
        ];
        let given: Vec<&str> = kinds.iter().filter(|k| k.1).map(|k| k.0).collect();
        let [what] = given[..] else {
            let message = if given.is_empty() {
                "no values are given".into()
            } else {
                format!("{} cannot be combined", given.join(" and "))
            };
            return Err(InputError::at(JsonPath::root(), message)
                .hint("give \"from\" and \"to\", or \"values\", or \"normal\", or \"lognormal\""));
        };
        let truncates = vary.normal.is_some() || vary.lognormal.is_some();
        for (key, given) in [("min", vary.min), ("max", vary.max)] {
            if given.is_some() && !truncates {
                return Err(at(
                    key,
                    format!("applies to normal and lognormal distributions, not to {what:?}"),
                )
                .hint("remove it"));
            }
        }
        let (kind, values) = match (vary.from, vary.to, &vary.values) {
            (_, _, Some(values)) if values.is_empty() => {
                return Err(
                    at("values", "the list is empty".into()).hint("give at least one value")
                );
            }
            (_, _, Some(_)) if vary.round && vary.words().is_some() => {
                return Err(at("round", "words are not rounded".into()).hint("remove it"));
            }
            (_, _, Some(values)) => {
                let places = values.iter().map(|v| vary.coordinate(v)).collect();
                (Kind::Values(places), Some(values.len()))
            }
            (Some(from), Some(to), _) if vary.round && from.ceil() > to.floor() => {
                return Err(at("to", format!("there is no whole number from {from} to {to}"))
                    .hint("widen the range, or remove \"round\""));
            }
            (Some(from), Some(to), _) if from < to => (Kind::Interval { from, to }, None),
            (Some(from), Some(to), _) => {
                return Err(at("to", format!("the range from {from} to {to} is empty"))
                    .hint("\"to\" must be greater than \"from\""));
            }
            (Some(_), None, _) => {
                return Err(
                    InputError::at(JsonPath::root(), "\"to\" is missing").hint("add \"to\": …")
                );
            }
            (None, Some(_), _) => {
                return Err(
                    InputError::at(JsonPath::root(), "\"from\" is missing").hint("add \"from\": …")
                );
            }
            (None, None, None) => (gauss(vary)?, None),
        };
        let count = match (values, vary.count, grid) {
            (Some(_), Some(_), _) => {
                return Err(
                    at("count", "cannot be combined with \"values\"".into()).hint("remove it")
                );
            }
            (Some(n), None, _) => n,
            (None, Some(_), false) => {
                return Err(at("count", "applies to a grid only".into())
                    .hint("\"sampling\" gives the number of rows"));
            }
            (None, None, false) => 0,
            (None, Some(n), true) if n >= 2 => n,
            (None, Some(n), true) => {
                return Err(at("count", format!("must be at least 2, got {n}"))
                    .hint("put a single value into the scene"));
            }
            (None, None, true) => {
                return Err(InputError::at(JsonPath::root(), "a grid needs the number of values")
                    .hint("add \"count\": 10, or another \"sampling\""));
            }
        };
        Ok(Self { kind, count, round: vary.round })
    }

    /// The value with probability `u`, 0 < u < 1, below it.
    pub fn quantile(&self, u: f64) -> f64 {
        let value = match &self.kind {
            Kind::Interval { from, to } if self.round => {
                (from.ceil() + u * (to.floor() - from.ceil() + 1.0)).floor().min(to.floor())
            }
            Kind::Interval { from, to } => from + u * (to - from),
            Kind::Values(values) => {
                values[((u * values.len() as f64) as usize).min(values.len() - 1)]
            }
            Kind::Gauss { mean, sd, low, high, exponential, min, max } => {
                let value = mean + sd * truncated(u, *low, *high);
                (if *exponential { value.exp() } else { value }).clamp(*min, *max)
            }
        };
        self.rounded(value)
    }

    /// The `k`-th value on a grid.
    pub fn level(&self, k: usize) -> f64 {
        match &self.kind {
            // Exactly its end.
            Kind::Interval { to, .. } if k + 1 >= self.count => self.rounded(*to),
            Kind::Interval { from, to } => {
                self.rounded(from + (to - from) * k as f64 / (self.count - 1) as f64)
            }
            Kind::Values(values) => self.rounded(values[k.min(values.len() - 1)]),
            Kind::Gauss { .. } => self.quantile((k as f64 + 0.5) / self.count as f64),
        }
    }

    /// Whether it takes whole numbers only.
    pub fn is_whole(&self) -> bool {
        let whole = |v: f64| v.fract() == 0.0;
        self.round
            || match &self.kind {
                Kind::Values(values) => values.iter().all(|v| whole(*v)),
                Kind::Interval { .. } => {
                    self.count >= 2 && (0..self.count).all(|k| whole(self.level(k)))
                }
                Kind::Gauss { .. } => false,
            }
    }

    fn rounded(&self, value: f64) -> f64 {
        // A negative zero would be another number in a table.
        (if self.round { value.round() } else { value }) + 0.0
    }
}

fn gauss(vary: &Vary) -> Result<Kind, InputError> {
    let exponential = vary.lognormal.is_some();
    let key = if exponential { "lognormal" } else { "normal" };
    let (mean, sd) = vary
        .lognormal
        .map(|l| (l.mean, l.sd))
        .or(vary.normal.map(|n| (n.mean, n.sd)))
        .unwrap_or((f64::NAN, f64::NAN));
    let path = JsonPath::root().key(key);
    if !(sd > 0.0 && sd.is_finite()) {
        return Err(InputError::at(path.key("sd"), format!("must be > 0, got {sd}"))
            .hint("put a number that does not vary into the scene"));
    }
    if exponential && mean <= 0.0 {
        return Err(InputError::at(path.key("mean"), format!("must be > 0, got {mean}"))
            .hint("give the mean of the value itself, not of its logarithm"));
    }
    let (min, max) = (vary.min.unwrap_or(f64::NEG_INFINITY), vary.max.unwrap_or(f64::INFINITY));
    if min >= max {
        return Err(InputError::at(
            JsonPath::root().key("max"),
            format!("the range from {min} to {max} is empty"),
        )
        .hint("\"max\" must be greater than \"min\""));
    }
    let (mean, sd) = if exponential {
        // Of the logarithm: σ² = ln(1 + (sd / mean)²), μ = ln mean − σ² / 2.
        let variance = (sd / mean).powi(2).ln_1p();
        (mean.ln() - variance / 2.0, variance.sqrt())
    } else {
        (mean, sd)
    };
    let standard = |end: f64| match exponential {
        true if end <= 0.0 => f64::NEG_INFINITY,
        true => (end.ln() - mean) / sd,
        false => (end - mean) / sd,
    };
    let (low, high) = (standard(min), standard(max));
    let kept = if low > 0.0 { below(-low) - below(-high) } else { below(high) - below(low) };
    if kept.is_nan() || kept < tolerance::TRUNCATION_KEEPS {
        let message = format!("only {kept:.1e} of the distribution lies between {min} and {max}");
        return Err(InputError::at(JsonPath::root(), message)
            .hint("the limits are far from the mean: check both"));
    }
    Ok(Kind::Gauss { mean, sd, low, high, exponential, min, max })
}

/// Standard normal distribution function.
fn below(z: f64) -> f64 {
    if z == f64::INFINITY {
        1.0
    } else if z == f64::NEG_INFINITY {
        0.0
    } else {
        Normal::standard().cdf(z)
    }
}

/// Quantile of the standard normal distribution between two ends. Above the mean it is mirrored,
/// where probabilities keep their digits.
fn truncated(u: f64, low: f64, high: f64) -> f64 {
    if low > 0.0 {
        return -truncated(1.0 - u, -high, -low);
    }
    let (a, b) = (below(low), below(high));
    Normal::standard().inverse_cdf(a + u * (b - a)).clamp(low, high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Lognormal, Normal};

    fn axis(vary: Vary, grid: bool) -> Axis {
        Axis::new(&vary, grid).unwrap()
    }

    fn close(a: f64, b: f64) {
        assert!((a - b).abs() <= 1e-9 * b.abs().max(1.0), "{a} {b}");
    }

    #[test]
    fn quantiles_are_those_of_the_tables() {
        let normal =
            axis(Vary { normal: Some(Normal { mean: 10.0, sd: 2.0 }), ..Vary::default() }, false);
        close(normal.quantile(0.5), 10.0);
        close(normal.quantile(0.975), 10.0 + 2.0 * 1.959_963_984_540_054);
        close(normal.quantile(1e-6), 10.0 - 2.0 * 4.753_424_308_822_899);
        let lognormal = axis(
            Vary { lognormal: Some(Lognormal { mean: 3.0, sd: 3.0 }), ..Vary::default() },
            false,
        );
        close(lognormal.quantile(0.5), 3.0 / 2f64.sqrt());
        let mean =
            (0..100_000).map(|k| lognormal.quantile((f64::from(k) + 0.5) / 1e5)).sum::<f64>() / 1e5;
        assert!((mean - 3.0).abs() < 2e-3, "{mean}");
    }

    #[test]
    fn truncation_keeps_the_shape_of_what_is_left() {
        let half = axis(
            Vary { normal: Some(Normal { mean: 0.0, sd: 1.0 }), min: Some(0.0), ..Vary::default() },
            false,
        );
        close(half.quantile(0.5), 0.674_489_750_196_081_7);
        let tail = axis(
            Vary {
                normal: Some(Normal { mean: 0.0, sd: 1.0 }),
                min: Some(5.0),
                max: Some(5.5),
                ..Vary::default()
            },
            false,
        );
        let values: Vec<f64> =
            (0..50).map(|k| tail.quantile((f64::from(k) + 0.5) / 50.0)).collect();
        assert!(
            values.windows(2).all(|w| w[0] < w[1]) && values[0] > 5.0 && values[49] < 5.5,
            "{values:?}"
        );
    }

    #[test]
    fn grids_hit_both_ends_and_rounding_gives_every_count_its_share() {
        let grid =
            axis(Vary { from: Some(0.1), to: Some(0.7), count: Some(4), ..Vary::default() }, true);
        assert_eq!((grid.level(0), grid.level(3)), (0.1, 0.7));
        let whole =
            axis(Vary { from: Some(2.0), to: Some(5.0), round: true, ..Vary::default() }, false);
        let mut counts = [0; 8];
        (0..1000).for_each(|k| counts[whole.quantile((f64::from(k) + 0.5) / 1000.0) as usize] += 1);
        assert_eq!(counts, [0, 0, 250, 250, 250, 250, 0, 0]);
    }

    #[test]
    fn what_has_no_meaning_is_refused() {
        let v = Vary::default;
        let bad = [
            (v(), true),
            (Vary { from: Some(1.0), to: Some(1.0), count: Some(3), ..v() }, true),
            (Vary { from: Some(2.0), to: Some(1.0), count: Some(3), ..v() }, true),
            (Vary { from: Some(1.0), count: Some(3), ..v() }, true),
            (Vary { from: Some(0.2), to: Some(0.8), round: true, ..v() }, false),
            (Vary { to: Some(1.0), count: Some(3), ..v() }, true),
            (Vary { from: Some(0.0), to: Some(1.0), ..v() }, true),
            (Vary { from: Some(0.0), to: Some(1.0), count: Some(1), ..v() }, true),
            (Vary { from: Some(0.0), to: Some(1.0), count: Some(3), ..v() }, false),
            (Vary { from: Some(0.0), to: Some(1.0), min: Some(0.5), ..v() }, false),
            (Vary { values: Some(vec![]), ..v() }, true),
            (Vary { values: Some(vec![1.0.into()]), count: Some(1), ..v() }, true),
            (Vary { values: Some(vec!["a".into()]), round: true, ..v() }, true),
            (Vary { values: Some(vec![1.0.into()]), from: Some(0.0), to: Some(1.0), ..v() }, false),
            (Vary { normal: Some(Normal { mean: 0.0, sd: 0.0 }), ..v() }, false),
            (Vary { lognormal: Some(Lognormal { mean: 0.0, sd: 1.0 }), ..v() }, false),
            (
                Vary {
                    normal: Some(Normal { mean: 0.0, sd: 1.0 }),
                    min: Some(1.0),
                    max: Some(1.0),
                    ..v()
                },
                false,
            ),
            (Vary { normal: Some(Normal { mean: 0.0, sd: 1.0 }), min: Some(50.0), ..v() }, false),
        ];
        for (vary, grid) in bad {
            assert!(Axis::new(&vary, grid).is_err(), "{vary:?}");
        }
    }
}
