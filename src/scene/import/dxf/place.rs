//! Where inserted blocks stand.

/// An affine map: rows of a matrix, the shift last.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place([[f64; 4]; 3]);

impl Default for Place {
    fn default() -> Self {
        Self::scaled([1.0; 3])
    }
}

impl Place {
    pub fn scaled([x, y, z]: [f64; 3]) -> Self {
        Self([[x, 0.0, 0.0, 0.0], [0.0, y, 0.0, 0.0], [0.0, 0.0, z, 0.0]])
    }

    pub fn moved([x, y, z]: [f64; 3]) -> Self {
        Self([[1.0, 0.0, 0.0, x], [0.0, 1.0, 0.0, y], [0.0, 0.0, 1.0, z]])
    }

    /// About z, degrees. Quarter turns are exact, so that blocks that meet still do.
    pub fn turned(angle: f64) -> Self {
        let (s, c) = match angle.rem_euclid(360.0) {
            0.0 => (0.0, 1.0),
            90.0 => (1.0, 0.0),
            180.0 => (0.0, -1.0),
            270.0 => (-1.0, 0.0),
            other => other.to_radians().sin_cos(),
        };
        Self([[c, -s, 0.0, 0.0], [s, c, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]])
    }

    /// First `inner`, then this.
    pub fn then(&self, inner: &Self) -> Self {
        let (a, b) = (&self.0, &inner.0);
        Self(std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let sum: f64 = (0..3).map(|k| a[i][k] * b[k][j]).sum();
                if j == 3 { sum + a[i][3] } else { sum }
            })
        }))
    }

    pub fn of(&self, p: [f64; 3]) -> [f64; 3] {
        self.0.map(|[x, y, z, shift]| x * p[0] + y * p[1] + z * p[2] + shift)
    }

    /// Whether it mirrors.
    pub fn mirrors(&self) -> bool {
        let [a, b, c] = &self.0;
        let det = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0]);
        det < 0.0
    }
}
