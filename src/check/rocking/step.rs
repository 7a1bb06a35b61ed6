//! One step in time, by the pair of orders five and four of Dormand & Prince (J. Comput. Appl. Math.
//! 6, 1980, 19–26).

use super::law::Law;
use crate::ground::Piece;

/// Coordinate and speed.
pub(super) type Phase = [f64; 2];

/// What is integrated: a law under a piece of the ground's motion.
#[derive(Clone, Copy)]
pub(super) struct Under<'a> {
    pub law: &'a Law,
    pub piece: &'a Piece,
}

const A: [[f64; 6]; 6] = [
    [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0, 0.0, 0.0],
    [9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0, 0.0],
    [35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
];
const C: [f64; 6] = [1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0];
const E: [f64; 7] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339_200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];

fn each(of: impl Fn(usize) -> f64) -> Phase {
    [of(0), of(1)]
}

impl Under<'_> {
    /// The rates of a state at a time from the start of the piece.
    pub fn rates(&self, t: f64, [q, u]: Phase) -> Phase {
        [u, self.law.acceleration(q, u, &self.piece.at(t))]
    }

    /// The state a step later, and the error that it is estimated to have.
    pub fn step(&self, t: f64, y: Phase, h: f64) -> (Phase, Phase) {
        // Written out: sums over tables take three times as long.
        let k1 = self.rates(t, y);
        let at = |sum: [f64; 2]| [y[0] + h * sum[0], y[1] + h * sum[1]];
        let go = |stage: usize, y: Phase| self.rates(t + C[stage] * h, y);
        let a = &A;
        let k2 = go(0, at(each(|i| a[0][0] * k1[i])));
        let k3 = go(1, at(each(|i| a[1][0] * k1[i] + a[1][1] * k2[i])));
        let k4 = go(2, at(each(|i| a[2][0] * k1[i] + a[2][1] * k2[i] + a[2][2] * k3[i])));
        let k5 = go(
            3,
            at(each(|i| a[3][0] * k1[i] + a[3][1] * k2[i] + a[3][2] * k3[i] + a[3][3] * k4[i])),
        );
        let sum = |i: usize| {
            a[4][0] * k1[i] + a[4][1] * k2[i] + a[4][2] * k3[i] + a[4][3] * k4[i] + a[4][4] * k5[i]
        };
        let k6 = go(4, at(each(sum)));
        let sum = |i: usize| {
            a[5][0] * k1[i] + a[5][2] * k3[i] + a[5][3] * k4[i] + a[5][4] * k5[i] + a[5][5] * k6[i]
        };
        let next = at(each(sum));
        let k7 = go(5, next);
        let error = |i: usize| {
            E[0] * k1[i] + E[2] * k3[i] + E[3] * k4[i] + E[4] * k5[i] + E[5] * k6[i] + E[6] * k7[i]
        };
        (next, each(|i| h * error(i)))
    }

    /// The part of a step of length `h` after which `of` the state and its time is zero: from above
    /// at the start to below at the end (Newton's method with the slope that `of` gives as well,
    /// kept inside its bracket). Steps are taken anew from the start, so that what is found is as
    /// exact as a step.
    pub fn crossing(&self, t: f64, y: Phase, h: f64, of: impl Fn(f64, Phase) -> [f64; 2]) -> f64 {
        let (mut low, mut high) = (0.0, h);
        let mut x = h;
        let [mut f, mut slope] = of(h, self.step(t, y, h).0);
        for _ in 0..100 {
            let newton = x - f / slope;
            let next = if low < newton && newton < high { newton } else { 0.5 * (low + high) };
            if f == 0.0
                || (next - x).abs() <= 2.0 * f64::EPSILON * high
                || next <= low
                || next >= high
            {
                break;
            }
            x = next;
            [f, slope] = of(x, self.step(t, y, x).0);
            if f > 0.0 { low = x } else { high = x }
        }
        x
    }
}
