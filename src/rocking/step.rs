//! One step in time, by the pair of orders five and four of Dormand & Prince (J. Comput. Appl. Math.
//! 6, 1980, 19–26).

use super::law::Law;
use crate::ground::Piece;

/// Coordinate and speed.
pub(super) type State = [f64; 2];

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

impl Under<'_> {
    /// The rates of a state at a time from the start of the piece.
    pub fn rates(&self, t: f64, [q, u]: State) -> State {
        [u, self.law.acceleration(q, u, &self.piece.at(t))]
    }

    /// The state a step later, and the error that it is estimated to have.
    pub fn step(&self, t: f64, y: State, h: f64) -> (State, State) {
        let mut k = [[0.0; 2]; 7];
        k[0] = self.rates(t, y);
        let mut next = y;
        for (stage, row) in A.iter().enumerate() {
            next = std::array::from_fn(|i| {
                y[i] + h * (0..=stage).map(|j| row[j] * k[j][i]).sum::<f64>()
            });
            k[stage + 1] = self.rates(t + C[stage] * h, next);
        }
        let error = std::array::from_fn(|i| h * (0..7).map(|j| E[j] * k[j][i]).sum::<f64>());
        (next, error)
    }

    /// The part of a step of length `h` after which `of` the state and its time is zero: from above
    /// at the start to below at the end (Newton's method with the slope that `of` gives as well,
    /// kept inside its bracket). Steps are taken anew from the start, so that what is found is as
    /// exact as a step.
    pub fn crossing(&self, t: f64, y: State, h: f64, of: impl Fn(f64, State) -> [f64; 2]) -> f64 {
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
