//! Numbers with their slopes: a law of contact is written once, for plain numbers and for numbers
//! that carry their derivatives by the six relative displacements of a joint (forward mode;
//! Griewank & Walther 2008), so that the tangent of a law is that of the law itself.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// What a law of contact computes with.
pub trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// A constant.
    fn of(value: f64) -> Self;
    /// The number without slopes.
    fn value(self) -> f64;
    /// The square root; at zero without a slope.
    fn sqrt(self) -> Self;
    /// A function of it that has this value and this slope there.
    #[must_use]
    fn mapped(self, value: f64, slope: f64) -> Self;

    /// The same number without slopes.
    #[must_use]
    fn held(self) -> Self {
        Self::of(self.value())
    }

    /// A multiple.
    #[must_use]
    fn times(self, by: f64) -> Self {
        self * Self::of(by)
    }
}

impl Number for f64 {
    fn of(value: f64) -> Self {
        value
    }
    fn value(self) -> f64 {
        self
    }
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    fn mapped(self, value: f64, _: f64) -> Self {
        value
    }
}

/// A number and its slopes by the six relative displacements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dual {
    /// The number.
    pub value: f64,
    /// Its slopes.
    pub slopes: [f64; 6],
}

impl Dual {
    /// The six relative displacements as what everything depends on.
    pub fn variables(at: &[f64; 6]) -> [Self; 6] {
        std::array::from_fn(|i| {
            let mut slopes = [0.0; 6];
            slopes[i] = 1.0;
            Self { value: at[i], slopes }
        })
    }

    fn with(value: f64, slope: impl Fn(usize) -> f64) -> Self {
        Self { value, slopes: std::array::from_fn(slope) }
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self::with(self.value + b.value, |i| self.slopes[i] + b.slopes[i])
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self::with(self.value - b.value, |i| self.slopes[i] - b.slopes[i])
    }
}

/// The product rule.
fn product(a: Dual, b: Dual) -> Dual {
    Dual::with(a.value * b.value, |i| a.slopes[i] * b.value + a.value * b.slopes[i])
}

/// The quotient rule.
fn quotient(a: Dual, b: Dual) -> Dual {
    let value = a.value / b.value;
    Dual::with(value, |i| (a.slopes[i] - value * b.slopes[i]) / b.value)
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        product(self, b)
    }
}

impl Div for Dual {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        quotient(self, b)
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Self::with(-self.value, |i| -self.slopes[i])
    }
}

impl Number for Dual {
    fn of(value: f64) -> Self {
        Self { value, slopes: [0.0; 6] }
    }
    fn value(self) -> f64 {
        self.value
    }
    fn mapped(self, value: f64, slope: f64) -> Self {
        Self { value, slopes: self.slopes.map(|s| s * slope) }
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        if root == 0.0 {
            return Self::of(0.0);
        }
        Self::with(root, |i| self.slopes[i] / (2.0 * root))
    }
    fn times(self, by: f64) -> Self {
        Self::with(self.value * by, |i| self.slopes[i] * by)
    }
}
