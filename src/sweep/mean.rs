//! How well a mean is known.

use serde::{Deserialize, Serialize};
use statrs::distribution::{ContinuousCDF, StudentsT};

/// The share of cases in which an interval holds the value.
const CONFIDENCE: f64 = 0.95;

/// A mean with its standard error and its 95 % interval (Student's t).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mean {
    /// Standard error of the mean.
    pub error: f64,
    /// The interval that holds it in 95 of 100 cases.
    pub interval: [f64; 2],
}

impl Mean {
    /// Of a mean with this standard error, from so many degrees of freedom; nothing from none.
    pub fn new(mean: f64, error: f64, freedom: usize) -> Option<Self> {
        let student = StudentsT::new(0.0, 1.0, freedom as f64).ok()?;
        let half = student.inverse_cdf(0.5 + 0.5 * CONFIDENCE) * error;
        half.is_finite().then_some(Self { error, interval: [mean - half, mean + half] })
    }

    /// Of independent values; nothing of fewer than two.
    pub fn of(values: &[f64]) -> Option<Self> {
        let n = values.len() as f64;
        if values.len() < 2 {
            return None;
        }
        let mean = values.iter().sum::<f64>() / n;
        let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
        Self::new(mean, (squares / (n - 1.0) / n).sqrt(), values.len() - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_are_those_of_students_t() {
        // t of 0.975 with 4 degrees of freedom: 2.776 445.
        let mean = Mean::of(&[1.0, 2.0, 3.0, 4.0, 5.0]).unwrap();
        let error = (2.5_f64 / 5.0).sqrt();
        assert!((mean.error - error).abs() < 1e-12);
        assert!((mean.interval[1] - 3.0 - 2.776_445 * error).abs() < 1e-5, "{mean:?}");
        assert_eq!(Mean::of(&[1.0]), None);
        assert_eq!(Mean::new(1.0, 0.1, 0), None);
    }
}
