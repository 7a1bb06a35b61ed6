//! Cones of a program and their Nesterov–Todd scaling.
//!
//! For `s` and `z` inside a cone there is one symmetric `W` of the cone's own group with `W z = W⁻¹
//! s = λ` (Nesterov & Todd 1997). Of a ray it is `√(s / z)`; of a second-order cone `η (w̄, with
//! w̄ᵀ J w̄ = 1, J = diag(1, −1, …))`, as in Vandenberghe 2010.

/// A cone on consecutive rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct ConeAt {
    /// Its first row.
    pub first: usize,
    /// How many rows.
    pub size: usize,
    /// Whether it is a second-order cone; otherwise so many rays.
    pub round: bool,
}

impl ConeAt {
    fn rows(&self) -> std::ops::Range<usize> {
        self.first..self.first + self.size
    }

    /// Whether its rows `v` lie inside.
    fn holds(&self, v: &[f64]) -> bool {
        if self.round { v[0] > 0.0 && det(v) > 0.0 } else { v.iter().all(|v| *v > 0.0) }
    }
}

/// Cones with the scaling of one pair (s, z).
#[derive(Clone, Debug)]
pub(super) struct Cones {
    /// In row order, without gaps; neighbouring rays together.
    list: Vec<ConeAt>,
    /// `√(s / z)` of a ray; `w̄` of a second-order cone.
    scale: Vec<f64>,
    /// `η` at the first row of a second-order cone.
    eta: Vec<f64>,
    /// `λ`.
    pub lambda: Vec<f64>,
}

impl Cones {
    /// With the scaling that does nothing.
    pub fn new(cones: &[ConeAt]) -> Self {
        let rows = cones.last().map_or(0, |c| c.first + c.size);
        let mut list: Vec<ConeAt> = Vec::new();
        for cone in cones {
            match list.last_mut() {
                Some(last) if !(last.round || cone.round) => last.size += cone.size,
                _ => list.push(*cone),
            }
        }
        let mut this =
            Self { list, scale: vec![1.0; rows], eta: vec![1.0; rows], lambda: vec![0.0; rows] };
        this.reset();
        this
    }

    /// The scaling that does nothing.
    pub fn reset(&mut self) {
        for cone in &self.list {
            self.scale[cone.rows()].fill(if cone.round { 0.0 } else { 1.0 });
            if cone.round {
                self.scale[cone.first] = 1.0;
            }
        }
        self.eta.fill(1.0);
    }

    /// Number of complementary pairs.
    pub fn degree(&self) -> usize {
        self.list.iter().map(|c| if c.round { 1 } else { c.size }).sum()
    }

    /// Takes the scaling of `s` and `z`; false where one of them is not inside.
    pub fn scale(&mut self, s: &[f64], z: &[f64]) -> bool {
        for cone in &self.list {
            let (s, z) = (&s[cone.rows()], &z[cone.rows()]);
            if !(cone.holds(s) && cone.holds(z)) {
                return false;
            }
            let lambda = &mut self.lambda[cone.rows()];
            let w = &mut self.scale[cone.rows()];
            if cone.round {
                let (rs, rz) = (det(s).sqrt(), det(z).sqrt());
                let dot: f64 = s.iter().zip(z).map(|(a, b)| a * b).sum::<f64>() / (rs * rz);
                let gamma = (0.5 * (1.0 + dot)).sqrt();
                let eta = (rs / rz).sqrt();
                for k in 0..cone.size {
                    let sign = if k == 0 { 1.0 } else { -1.0 };
                    w[k] = (s[k] / rs + sign * z[k] / rz) / (2.0 * gamma);
                }
                // Exactly on the hyperboloid again.
                w[0] = (1.0 + w[1..].iter().map(|v| v * v).sum::<f64>()).sqrt();
                self.eta[cone.first] = eta;
                apply(w, eta, z, lambda);
            } else {
                for ((w, l), (s, z)) in w.iter_mut().zip(lambda).zip(s.iter().zip(z)) {
                    *w = (s / z).sqrt();
                    *l = (s * z).sqrt();
                }
            }
        }
        true
    }

    /// `W v` in place.
    pub fn times(&self, v: &mut [f64]) {
        self.each(v, apply, |w| w);
    }

    /// `W⁻¹ v` in place.
    pub fn over(&self, v: &mut [f64]) {
        self.each(v, undo, |w| 1.0 / w);
    }

    fn each(
        &self,
        v: &mut [f64],
        round: impl Fn(&[f64], f64, &[f64], &mut [f64]),
        ray: impl Fn(f64) -> f64,
    ) {
        let mut from = Vec::new();
        for cone in &self.list {
            let to = &mut v[cone.rows()];
            let w = &self.scale[cone.rows()];
            if cone.round {
                from.clear();
                from.extend_from_slice(to);
                round(w, self.eta[cone.first], &from, to);
            } else {
                to.iter_mut().zip(w).for_each(|(v, w)| *v *= ray(*w));
            }
        }
    }

    /// Greatest eigenvalue of `W⁻²` of one cone.
    pub fn stiffness(&self, cone: &ConeAt) -> f64 {
        let w = &self.scale[cone.rows()];
        if !cone.round {
            return w.iter().fold(0.0, |most, w| f64::max(most, 1.0 / (w * w)));
        }
        ((w[0] + norm(&w[1..])) / self.eta[cone.first]).powi(2)
    }

    /// The scaling of one cone as a matrix, `W` or its inverse: column `k` into `to`.
    pub fn column(&self, cone: &ConeAt, k: usize, inverse: bool, to: &mut [f64]) {
        let w = &self.scale[cone.rows()];
        if !cone.round {
            to.fill(0.0);
            to[k] = if inverse { 1.0 / w[k] } else { w[k] };
            return;
        }
        let mut unit = [0.0; MOST_ROWS];
        unit[k] = 1.0;
        let unit = &unit[..cone.size];
        if inverse {
            undo(w, self.eta[cone.first], unit, to)
        } else {
            apply(w, self.eta[cone.first], unit, to)
        }
    }

    /// Jordan product `u ∘ v`, into `v`.
    pub fn product(&self, u: &[f64], v: &mut [f64]) {
        for cone in &self.list {
            let (u, v) = (&u[cone.rows()], &mut v[cone.rows()]);
            if cone.round {
                let dot = u.iter().zip(v.iter()).map(|(a, b)| a * b).sum();
                let v0 = v[0];
                for k in 1..cone.size {
                    v[k] = u[0] * v[k] + v0 * u[k];
                }
                v[0] = dot;
            } else {
                v.iter_mut().zip(u).for_each(|(v, u)| *v *= u);
            }
        }
    }

    /// The `v` with `λ ∘ v = d`, in place.
    pub fn divide(&self, d: &mut [f64]) {
        for cone in &self.list {
            let (l, d) = (&self.lambda[cone.rows()], &mut d[cone.rows()]);
            if cone.round {
                let dot: f64 = l[1..].iter().zip(&d[1..]).map(|(a, b)| a * b).sum();
                d[0] = (l[0] * d[0] - dot) / det(l);
                let d0 = d[0];
                for k in 1..cone.size {
                    d[k] = (d[k] - d0 * l[k]) / l[0];
                }
            } else {
                d.iter_mut().zip(l).for_each(|(d, l)| *d /= l);
            }
        }
    }

    /// What brings products to between `low` and `high`, but no farther than `high`; into `v`
    /// (Gondzio 1996, by eigenvalues).
    pub fn towards(&self, low: f64, high: f64, v: &mut [f64]) {
        let lack = |v: f64| (v.clamp(low, high) - v).max(-high);
        for cone in &self.list {
            let v = &mut v[cone.rows()];
            if cone.round {
                let t = norm(&v[1..]);
                let (more, less) = (lack(v[0] + t), lack(v[0] - t));
                let by = if t > 0.0 { 0.5 * (more - less) / t } else { 0.0 };
                v[0] = 0.5 * (more + less);
                v[1..].iter_mut().for_each(|v| *v *= by);
            } else {
                v.iter_mut().for_each(|v| *v = lack(*v));
            }
        }
    }

    /// Adds `t` × the unit of every cone.
    pub fn add_unit(&self, v: &mut [f64], t: f64) {
        for cone in &self.list {
            if cone.round {
                v[cone.first] += t;
            } else {
                v[cone.rows()].iter_mut().for_each(|v| *v += t);
            }
        }
    }

    /// Moves every cone that is less than `margin` × its unit inside as far in as that.
    pub fn inward(&self, v: &mut [f64], margin: f64) {
        for cone in &self.list {
            let v = &mut v[cone.rows()];
            if cone.round {
                v[0] = v[0].max(norm(&v[1..]) + margin);
            } else {
                v.iter_mut().for_each(|v| *v = v.max(margin));
            }
        }
    }

    /// As much of `step` from `v` along `d` as does not round to outside: what a step all but empties
    /// may.
    pub fn kept_inside(&self, v: &[f64], d: &[f64], step: f64) -> f64 {
        let mut step = step;
        for _ in 0..MOST_SHORTER {
            let end: Vec<f64> = v.iter().zip(d).map(|(v, d)| v + step * d).collect();
            if self.list.iter().all(|cone| cone.holds(&end[cone.rows()])) {
                break;
            }
            step *= SHORTER;
        }
        step
    }

    /// The greatest step along `d` from `v` inside.
    pub fn step(&self, v: &[f64], d: &[f64]) -> f64 {
        let mut least = f64::INFINITY;
        for cone in &self.list {
            let (v, d) = (&v[cone.rows()], &d[cone.rows()]);
            least = least.min(if cone.round { step_round(v, d) } else { step_rays(v, d) });
        }
        least
    }
}

/// A step that rounds to outside is made this much shorter, so many times at most. Nearer to 1: it
/// rounds to outside again. Farther: residuals outlive the step.
const SHORTER: f64 = 0.99;
const MOST_SHORTER: usize = 10;

/// Rows of a second-order cone that is handled: those of a block in space, and its bound.
pub(super) const MOST_ROWS: usize = 8;

fn norm(v: &[f64]) -> f64 {
    v.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// `v₀² − ‖v₁‖²` without cancellation of squares.
fn det(v: &[f64]) -> f64 {
    let t = norm(&v[1..]);
    (v[0] - t) * (v[0] + t)
}

fn apply(w: &[f64], eta: f64, v: &[f64], to: &mut [f64]) {
    let dot: f64 = w[1..].iter().zip(&v[1..]).map(|(a, b)| a * b).sum();
    let t = v[0] + dot / (1.0 + w[0]);
    to[0] = eta * (w[0] * v[0] + dot);
    for k in 1..v.len() {
        to[k] = eta * (v[k] + t * w[k]);
    }
}

fn undo(w: &[f64], eta: f64, v: &[f64], to: &mut [f64]) {
    let dot: f64 = w[1..].iter().zip(&v[1..]).map(|(a, b)| a * b).sum();
    let t = dot / (1.0 + w[0]) - v[0];
    to[0] = (w[0] * v[0] - dot) / eta;
    for k in 1..v.len() {
        to[k] = (v[k] + t * w[k]) / eta;
    }
}

/// The least `−v / d` that is positive, by the greatest `−d / v`, so many at a time.
fn step_rays(v: &[f64], d: &[f64]) -> f64 {
    const AT_A_TIME: usize = 8;
    let greater = |most: f64, v: f64, d: f64| {
        let share = -d / v;
        if share > most { share } else { most }
    };
    let ((v, last_v), (d, last_d)) = (v.as_chunks::<AT_A_TIME>(), d.as_chunks::<AT_A_TIME>());
    let mut most = [0.0; AT_A_TIME];
    for (v, d) in v.iter().zip(d) {
        for (most, (v, d)) in most.iter_mut().zip(v.iter().zip(d)) {
            *most = greater(*most, *v, *d);
        }
    }
    let most = last_v
        .iter()
        .zip(last_d)
        .fold(most.into_iter().fold(0.0, f64::max), |most, (v, d)| greater(most, *v, *d));
    1.0 / most
}

/// The first positive root of `det(v + α d)`.
fn step_round(v: &[f64], d: &[f64]) -> f64 {
    let a = det(d);
    let c = det(v).max(0.0);
    let b = v[0] * d[0] - v[1..].iter().zip(&d[1..]).map(|(a, b)| a * b).sum::<f64>();
    let disc = b * b - a * c;
    if disc < 0.0 {
        return f64::INFINITY;
    }
    if b <= 0.0 {
        let q = disc.sqrt() - b;
        return if q > 0.0 { c / q } else { f64::INFINITY };
    }
    if a < 0.0 { (b + disc.sqrt()) / -a } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cones() -> Cones {
        let ray = |first| ConeAt { first, size: 1, round: false };
        Cones::new(&[ray(0), ray(1), ConeAt { first: 2, size: 3, round: true }])
    }

    const S: [f64; 5] = [2.0, 3.0, 5.0, 3.0, -1.0];
    const Z: [f64; 5] = [0.5, 7.0, 1.0, 0.2, 0.9];

    #[test]
    fn the_scaling_takes_both_sides_to_one_point() {
        let mut c = cones();
        assert!(c.scale(&S, &Z));
        let (mut a, mut b) = (S, Z);
        c.over(&mut a);
        c.times(&mut b);
        for k in 0..5 {
            assert!((a[k] - b[k]).abs() < 1e-13 && (a[k] - c.lambda[k]).abs() < 1e-13);
        }
        let mut back = b;
        c.over(&mut back);
        assert!(back.iter().zip(&Z).all(|(a, b)| (a - b).abs() < 1e-13));
        let mut d = S;
        c.divide(&mut d);
        c.product(&c.lambda.clone(), &mut d);
        assert!(d.iter().zip(&S).all(|(a, b)| (a - b).abs() < 1e-13));
    }

    #[test]
    fn the_stiffness_is_the_greatest_eigenvalue() {
        let mut c = cones();
        assert!(c.scale(&S, &Z));
        let round = c.list[1];
        // Its eigenvectors lie on the boundary of the cone, in the plane of its axis and w̄.
        let w = &c.scale[round.rows()];
        let t = norm(&w[1..]);
        let mut v = [0.0, 0.0, 1.0, -w[1] / t, -w[2] / t];
        let before = v;
        c.over(&mut v);
        c.over(&mut v);
        let most = c.stiffness(&round);
        assert!(v[2..].iter().zip(&before[2..]).all(|(v, b)| (v - most * b).abs() < 1e-12 * most));
        let rays = c.stiffness(&c.list[0]);
        assert!((rays - Z[1] / S[1]).abs() < 1e-14 * rays, "{rays}");
    }

    #[test]
    fn a_full_step_ends_on_the_boundary() {
        let c = cones();
        for d in [
            [-1.0, -1.0, -2.0, 1.0, 0.5],
            [0.0, 0.0, 1.0, 4.0, 0.0],
            [1.0, 1.0, -6.0, 0.0, 0.0],
            [0.0, 0.0, -1.0, -1.0, 0.0],
        ] {
            let t = c.step(&S, &d);
            let end: Vec<f64> = S.iter().zip(&d).map(|(s, d)| s + t * d).collect();
            let ends = end[0].min(end[1]).min(end[2] - norm(&end[3..]));
            assert!(ends.abs() < 1e-12, "{d:?} {t} {end:?}");
        }
        assert_eq!(c.step(&S, &[1.0, 0.0, 2.0, 1.0, 0.0]), f64::INFINITY);
    }

    #[test]
    fn points_outside_have_no_scaling() {
        let mut c = cones();
        assert!(
            !c.scale(&[1.0, -1.0, 5.0, 0.0, 0.0], &Z) && !c.scale(&[1.0, 1.0, 5.0, 4.0, 3.0], &Z)
        );
        // As far from the axis as a point inside, and behind the tip.
        assert!(!c.scale(&[1.0, 1.0, -5.0, 3.0, 1.0], &Z) && !c.scale(&S, &Z.map(|z| -z)));
    }

    #[test]
    fn what_a_step_empties_stays_inside() {
        let mut c = cones();
        for step in [1.0, 1.0 + f64::EPSILON] {
            let (mut v, d) = (S, S.map(|s| -s));
            let far = c.kept_inside(&v, &d, step);
            v.iter_mut().zip(d).for_each(|(v, d)| *v += far * d);
            assert!(far < 1.0 && far > 0.98 && c.scale(&v, &Z), "{step}: {far} {v:?}");
        }
        assert_eq!(c.kept_inside(&S, &S, 0.5), 0.5);
    }

    #[test]
    fn what_lies_outside_is_moved_in_and_nothing_else() {
        let mut v = [-3.0, 2.0, -1.0, 3.0, 4.0];
        cones().inward(&mut v, 0.5);
        assert_eq!(v, [0.5, 2.0, 5.5, 3.0, 4.0]);
        cones().inward(&mut v, 0.25);
        assert_eq!(v, [0.5, 2.0, 5.5, 3.0, 4.0]);
    }
}
