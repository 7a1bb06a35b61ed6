//! Numbers that are known to lie between two doubles, and sums that keep what rounding drops.
//!
//! *Law.* Every operation encloses the exact result for all exact operands inside its own (Moore
//! 1966). The rounding of a sum or product of two doubles is itself a double (Knuth 1969; Dekker
//! 1971): where it is zero the end stays where it is, so that zeros and other exact numbers stay
//! exact, and elsewhere the end moves to the next double outwards.
//!
//! Crates for intervals set the processor's rounding mode and have to be built for one processor;
//! these few operations need neither.

use std::ops::{Add, AddAssign, Mul, Neg, Sub};

/// All real numbers from `lower` to `upper`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Lower end.
    pub lower: f64,
    /// Upper end.
    pub upper: f64,
}

/// Products at least this large have a rounding that is a double; below lies the range where it
/// underflows.
const EXACT_PRODUCT: f64 = 1e-270;

/// `a + b` rounded, and what rounding dropped (NaN where it overflowed).
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let of_b = s - a;
    (s, (a - (s - of_b)) + (b - of_b))
}

/// `a b` rounded, and what rounding dropped; NaN where that is not known to be a double.
pub fn two_product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    if a == 0.0 || b == 0.0 {
        return (0.0, 0.0);
    }
    (p, if p.abs() >= EXACT_PRODUCT { a.mul_add(b, -p) } else { f64::NAN })
}

/// The end of an interval from a rounded number and what rounding dropped.
fn down((value, dropped): (f64, f64)) -> f64 {
    if dropped >= 0.0 { value } else { value.next_down() }
}

fn up((value, dropped): (f64, f64)) -> f64 {
    if dropped <= 0.0 { value } else { value.next_up() }
}

impl Interval {
    /// Zero.
    pub const ZERO: Self = Self { lower: 0.0, upper: 0.0 };

    /// A double, exactly.
    pub const fn exactly(x: f64) -> Self {
        Self { lower: x, upper: x }
    }

    /// The greatest distance of a number inside from zero; infinite where nothing is known.
    pub fn magnitude(self) -> f64 {
        let size = self.lower.abs().max(self.upper.abs());
        if self.lower.is_nan() || self.upper.is_nan() { f64::INFINITY } else { size }
    }

    /// A double inside, near the middle.
    pub fn middle(self) -> f64 {
        self.lower + 0.5 * (self.upper - self.lower)
    }

    /// The square, which is never negative.
    pub fn square(self) -> Self {
        let (a, b) = (self.lower.abs(), self.upper.abs());
        let (least, most) = if self.lower <= 0.0 && self.upper >= 0.0 {
            (0.0, a.max(b))
        } else {
            (a.min(b), a.max(b))
        };
        Self { lower: down(two_product(least, least)).max(0.0), upper: up(two_product(most, most)) }
    }

    /// The square root of what is not negative.
    pub fn sqrt(self) -> Self {
        // The root is rounded to the nearest double: its neighbours enclose it.
        let root = |x: f64, out: fn(f64) -> f64| if x <= 0.0 { 0.0 } else { out(x.sqrt()) };
        Self {
            lower: root(self.lower, f64::next_down).max(0.0),
            upper: if self.upper.is_nan() { f64::NAN } else { root(self.upper, f64::next_up) },
        }
    }

    /// The quotient; `by` must not hold zero (everything otherwise).
    pub fn over(self, by: Self) -> Self {
        if !(by.lower > 0.0 || by.upper < 0.0) {
            return Self { lower: f64::NEG_INFINITY, upper: f64::INFINITY };
        }
        let ends = [
            self.lower / by.lower,
            self.lower / by.upper,
            self.upper / by.lower,
            self.upper / by.upper,
        ];
        if ends.iter().any(|e| e.is_nan()) {
            return Self { lower: f64::NEG_INFINITY, upper: f64::INFINITY };
        }
        let (least, most) =
            ends.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &e| (a.min(e), b.max(e)));
        Self { lower: least.next_down(), upper: most.next_up() }
    }

    /// What is above zero of it.
    pub fn positive(self) -> Self {
        Self {
            lower: self.lower.max(0.0),
            upper: if self.upper.is_nan() { f64::NAN } else { self.upper.max(0.0) },
        }
    }

    /// The one that is greater, end by end.
    pub fn max(self, other: Self) -> Self {
        let nan = self.upper.is_nan() || other.upper.is_nan();
        Self {
            lower: self.lower.max(other.lower),
            upper: if nan { f64::NAN } else { self.upper.max(other.upper) },
        }
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self {
            lower: down(two_sum(self.lower, other.lower)),
            upper: up(two_sum(self.upper, other.upper)),
        }
    }
}

impl AddAssign for Interval {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self { lower: -self.upper, upper: -self.lower }
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let pairs = [
            (self.lower, other.lower),
            (self.lower, other.upper),
            (self.upper, other.lower),
            (self.upper, other.upper),
        ];
        let mut all = Self { lower: f64::INFINITY, upper: f64::NEG_INFINITY };
        for (a, b) in pairs {
            let product = two_product(a, b);
            // A NaN (of an infinite end) is nowhere, and stays.
            if product.0.is_nan() {
                return Self { lower: f64::NEG_INFINITY, upper: f64::INFINITY };
            }
            // What underflows keeps its sign.
            let is_positive = (a < 0.0) == (b < 0.0);
            let (low, high) = (down(product), up(product));
            all.lower = all.lower.min(if is_positive { low.max(0.0) } else { low });
            all.upper = all.upper.max(if is_positive { high } else { high.min(0.0) });
        }
        all
    }
}

/// A sum of doubles and of products of two doubles, of which rounding takes next to nothing: what
/// each addition drops is added up beside it, as an interval. The width of the result is the
/// rounding of the roundings.
#[derive(Clone, Copy, Debug)]
pub struct Sum {
    value: f64,
    dropped: Interval,
}

impl Sum {
    /// Nothing.
    pub const ZERO: Self = Self { value: 0.0, dropped: Interval::ZERO };

    /// Adds a double.
    pub fn add(&mut self, x: f64) {
        let (value, dropped) = two_sum(self.value, x);
        self.value = value;
        if dropped != 0.0 {
            self.dropped += Interval::exactly(dropped);
        }
    }

    /// Adds the product of two doubles.
    pub fn add_product(&mut self, a: f64, b: f64) {
        let (product, dropped) = two_product(a, b);
        self.add(product);
        if dropped.is_nan() {
            self.dropped += Interval { lower: -f64::MIN_POSITIVE, upper: f64::MIN_POSITIVE };
        } else if dropped != 0.0 {
            self.dropped += Interval::exactly(dropped);
        }
    }

    /// Adds the product of a double and of a pair of doubles that stand for their sum.
    pub fn add_scaled(&mut self, by: f64, (x, rest): (f64, f64)) {
        self.add_product(by, x);
        if rest != 0.0 {
            self.add_product(by, rest);
        }
    }

    /// The sum.
    pub fn total(self) -> Interval {
        Interval::exactly(self.value) + self.dropped
    }
}

/// `a − b` exactly, as two doubles.
pub fn difference(a: f64, b: f64) -> (f64, f64) {
    two_sum(a, -b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// An integer with few enough bits that sums and products of three are exact in 128 bits, over
    /// a power of two.
    fn fixed(x: i32) -> f64 {
        f64::from(x) / 1024.0
    }

    proptest! {
        #[test]
        fn ends_enclose_what_is_exact(a in -1e6..1e6f64, b in -1e6..1e6f64) {
            let (x, y) = (Interval::exactly(a), Interval::exactly(b));
            let (s, e) = two_sum(a, b);
            let sum = x + y;
            // s + e is the sum: the ends lie on both sides of it, at most one double apart.
            prop_assert!(sum.lower - s <= e && e <= sum.upper - s && sum.upper <= sum.lower.next_up());
            let (p, e) = two_product(a, b);
            let product = x * y;
            prop_assert!(product.lower - p <= e && e <= product.upper - p && product.upper <= product.lower.next_up());
            let root = (x * x).sqrt();
            prop_assert!(root.lower <= a.abs() && a.abs() <= root.upper);
            if b != 0.0 {
                let back = x.over(y) * y;
                prop_assert!(back.lower <= a && a <= back.upper);
            }
            prop_assert!(x.square().lower >= 0.0 && x.square().upper <= (x * x).upper);
        }

        #[test]
        fn numbers_without_rounding_stay_exact(a in -1000..1000i32, b in -1000..1000i32, c in -1000..1000i32) {
            let (x, y, z) = (Interval::exactly(fixed(a)), Interval::exactly(fixed(b)), Interval::exactly(fixed(c)));
            let all = x * y + z - x;
            prop_assert_eq!(all, Interval::exactly(fixed(a) * fixed(b) + fixed(c) - fixed(a)));
        }

        #[test]
        fn sums_keep_what_large_numbers_hide(list in prop::collection::vec(-1e3..1e3f64, 0..40)) {
            let mut sum = Sum::ZERO;
            for x in &list {
                sum.add(*x);
                sum.add_product(*x, 1e20);
            }
            for x in list.iter().rev() {
                sum.add_product(*x, -1e20);
                sum.add(-x);
            }
            let total = sum.total();
            // The rounding of the roundings.
            let size = 1e20 * list.iter().map(|x| x.abs()).sum::<f64>();
            prop_assert!(total.lower <= 0.0 && total.upper >= 0.0 && total.magnitude() <= 1e-27 * size, "{:?}", total);
        }
    }

    #[test]
    fn what_over_or_underflows_is_not_known() {
        let tiny = Interval::exactly(1e-170);
        assert!(tiny.square().upper > 0.0 && (tiny * tiny).lower >= 0.0);
        let huge = Interval::exactly(f64::MAX) + Interval::exactly(f64::MAX);
        assert_eq!(huge.magnitude(), f64::INFINITY);
        assert_eq!((huge - huge).magnitude(), f64::INFINITY);
        let mut sum = Sum::ZERO;
        sum.add_product(f64::MAX, 2.0);
        sum.add_product(f64::MAX, -2.0);
        assert_eq!(sum.total().magnitude(), f64::INFINITY);
        assert_eq!(
            Interval::exactly(1.0).over(Interval { lower: -1.0, upper: 1.0 }).magnitude(),
            f64::INFINITY
        );
    }
}
