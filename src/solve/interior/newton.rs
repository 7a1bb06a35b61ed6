//! Newton's step of the interior-point method, by way of the reduced system.
//!
//! `P dx + Eᵀ dy + Gᵀ dz = a_x`, `E dx = a_y`, `G dx − W² dz = a_z`, with the variables of the
//! border `t` apart; `P` has the proximal term of [`Reduced`] on its diagonal. With `K = P + Gᵀ W⁻²
//! G`, `M = Gᵀ W⁻² G_t` and `N = E_t − E K⁻¹ M` it is `S dy − N dt = E K⁻¹ b − a_y`, `Nᵀ dy + Q dt =
//! b_t − Mᵀ K⁻¹ b`.

use super::{cones::Cones, reduced::Reduced, structure::Structure};

/// A point, a direction or a residual: of variables, border, equalities and cone rows.
#[derive(Clone, Debug)]
pub(super) struct Iterate {
    pub x: Vec<f64>,
    pub t: Vec<f64>,
    pub y: Vec<f64>,
    pub z: Vec<f64>,
}

impl Iterate {
    pub fn zero(s: &Structure) -> Self {
        Self {
            x: vec![0.0; s.variables.len()],
            t: vec![0.0; s.border.len()],
            y: vec![0.0; s.equalities.len()],
            z: vec![0.0; s.cone_rows.len()],
        }
    }
}

/// Corrections of one solve. Fewer: late steps leave the equilibrium. More: time, once rounding is
/// reached.
const MOST_CORRECTIONS: usize = 4;

/// A direction is exact when its equations hold to this × what they lacked at first. Larger:
/// residuals outlive the gap. Smaller: corrections at the level of rounding.
pub(super) const EXACT: f64 = 1e-11;

/// The same for a direction that only tells how far one could go.
pub(super) const ROUGH: f64 = 1e-3;

/// A contact whose `W⁻²` has an eigenvalue above this takes its rates from its blocks, any other from
/// its forces. Larger: the rates keep the rounding of forces times so much. Smaller: forces keep that
/// of rates.
const STIFF: f64 = 1.0;

/// The factored system of one scaling.
pub(super) struct Newton<'a> {
    pub structure: &'a Structure,
    pub reduced: &'a mut Reduced,
    pub cones: &'a Cones,
    /// `M`, one column per variable of the border.
    m: Vec<Vec<f64>>,
    /// `N`.
    n: Vec<Vec<f64>>,
    /// `S⁻¹ N`.
    s_n: Vec<Vec<f64>>,
    /// `G_t` as it is, `E_t` as it is.
    g_border: Vec<Vec<f64>>,
    e_border: Vec<Vec<f64>>,
    /// `P_t + G_tᵀ W⁻² G_t`, and what is left of it, `Q + Nᵀ S⁻¹ N`.
    k_border: Vec<Vec<f64>>,
    schur: Vec<Vec<f64>>,
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn greatest(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |m, v| m.max(v.abs()))
}

impl<'a> Newton<'a> {
    /// Factors the system; `None` where that fails.
    pub fn new(
        structure: &'a Structure,
        reduced: &'a mut Reduced,
        cones: &'a Cones,
    ) -> Option<Self> {
        if !reduced.factor(structure, cones) {
            return None;
        }
        let count = structure.border.len();
        let mut this = Self {
            structure,
            reduced,
            cones,
            m: vec![],
            n: vec![],
            s_n: vec![],
            g_border: vec![],
            e_border: vec![],
            k_border: vec![],
            schur: vec![],
        };
        for k in 0..count {
            let mut g = vec![0.0; structure.cone_rows.len()];
            structure.g_border.of(k).for_each(|(i, v)| g[i] += v);
            let mut e = vec![0.0; structure.equalities.len()];
            structure.e_border.of(k).for_each(|(i, v)| e[i] += v);
            let mut m = vec![0.0; structure.variables.len()];
            let mut n = e.clone();
            if structure.g_border.start[k + 1] > structure.g_border.start[k] {
                structure.g.add_transposed(1.0, &this.stiff(&g), &mut m);
                let mut flexed = m.clone();
                this.reduced.flex(structure, &mut flexed);
                structure.e.add(-1.0, &flexed, &mut n);
            }
            let mut s_n = n.clone();
            this.reduced.solve(&mut s_n);
            this.g_border.push(g);
            this.e_border.push(e);
            this.m.push(m);
            this.n.push(n);
            this.s_n.push(s_n);
        }
        for i in 0..count {
            let stiff = this.stiff(&this.g_border[i]);
            let mut flexed = this.m[i].clone();
            this.reduced.flex(structure, &mut flexed);
            let own: Vec<f64> = (0..count).map(|j| dot(&stiff, &this.g_border[j])).collect();
            this.schur.push(
                (0..count)
                    .map(|j| own[j] - dot(&flexed, &this.m[j]) + dot(&this.s_n[i], &this.n[j]))
                    .collect(),
            );
            this.k_border.push(own);
        }
        Some(this)
    }

    /// `W⁻² v`.
    fn stiff(&self, v: &[f64]) -> Vec<f64> {
        let mut v = v.to_vec();
        self.cones.over(&mut v);
        self.cones.over(&mut v);
        v
    }

    /// Solves for one right-hand side, to `exact` × what its equations lack at first; where
    /// `enough` is given, all equations hold to that if rounding allows.
    pub fn solve(&mut self, a: &Iterate, exact: f64, enough: f64) -> Iterate {
        let mut d = self.once(a, exact, enough);
        if enough == 0.0 {
            return d;
        }
        let lack = |r: &Iterate| greatest(&r.x).max(greatest(&r.t));
        let mut rest = self.lacking(a, &d);
        for _ in 0..MOST_CORRECTIONS {
            let before = lack(&rest);
            if before.is_nan() || before <= enough {
                break;
            }
            let more = self.once(&rest, exact, enough);
            let mut better = d.clone();
            for (to, by) in [
                (&mut better.x, &more.x),
                (&mut better.t, &more.t),
                (&mut better.y, &more.y),
                (&mut better.z, &more.z),
            ] {
                to.iter_mut().zip(by).for_each(|(t, b)| *t += b);
            }
            let now = self.lacking(a, &better);
            if lack(&now).is_nan() || lack(&now) > 0.5 * before {
                break;
            }
            (d, rest) = (better, now);
        }
        d
    }

    /// What a direction lacks of each equation.
    fn lacking(&self, a: &Iterate, d: &Iterate) -> Iterate {
        let s = self.structure;
        let mut r = a.clone();
        for ((r, x), q) in r.x.iter_mut().zip(&d.x).zip(&s.quadratic) {
            *r -= q * x;
        }
        let held = self.reduced.proximal;
        if held > 0.0 {
            r.x.iter_mut().zip(&d.x).for_each(|(r, x)| *r -= held * x);
        }
        s.e.add_transposed(-1.0, &d.y, &mut r.x);
        s.g.add_transposed(-1.0, &d.z, &mut r.x);
        s.e_border.add_transposed(-1.0, &d.y, &mut r.t);
        s.g_border.add_transposed(-1.0, &d.z, &mut r.t);
        s.e.add(-1.0, &d.x, &mut r.y);
        s.e_border.add(-1.0, &d.t, &mut r.y);
        s.g.add(-1.0, &d.x, &mut r.z);
        s.g_border.add(-1.0, &d.t, &mut r.z);
        let mut w = d.z.clone();
        self.cones.times(&mut w);
        self.cones.times(&mut w);
        r.z.iter_mut().zip(&w).for_each(|(r, w)| *r += w);
        r
    }

    /// By the reduced system, corrected until equalities and border hold: rounding of `W⁻²` may be
    /// left in the others.
    fn once(&mut self, a: &Iterate, exact: f64, enough: f64) -> Iterate {
        let s = self.structure;
        // Right-hand sides without the cone rows.
        let stiff = self.stiff(&a.z);
        let mut b = a.x.clone();
        s.g.add_transposed(1.0, &stiff, &mut b);
        let mut bt = a.t.clone();
        s.g_border.add_transposed(1.0, &stiff, &mut bt);
        let mut d = Iterate::zero(s);
        d.x.copy_from_slice(&b);
        self.reduced.flex(s, &mut d.x);
        let (mut rest, mut rest_t) = self.rest(a, &bt, &d);
        let scale = greatest(&rest).max(greatest(&rest_t));
        let enough = (exact * scale).min(if enough > 0.0 { enough } else { f64::INFINITY });
        self.correct(&rest, &rest_t, &mut d);
        (rest, rest_t) = self.rest(a, &bt, &d);
        let mut error = greatest(&rest).max(greatest(&rest_t));
        for _ in 0..MOST_CORRECTIONS {
            if error <= enough {
                break;
            }
            let mut better = d.clone();
            self.correct(&rest, &rest_t, &mut better);
            let (r, rt) = self.rest(a, &bt, &better);
            let now = greatest(&r).max(greatest(&rt));
            if now.is_nan() || now >= error {
                break;
            }
            let slow = now > 0.5 * error;
            (d, rest, rest_t, error) = (better, r, rt, now);
            if slow {
                break;
            }
        }
        // dz = W⁻² (G dx + G_t dt − a_z).
        for (z, a) in d.z.iter_mut().zip(&a.z) {
            *z = -a;
        }
        s.g.add(1.0, &d.x, &mut d.z);
        s.g_border.add(1.0, &d.t, &mut d.z);
        d.z = self.stiff(&d.z);
        self.rates_of_stiff(a, &mut d);
        d
    }

    /// `dz = P dx + Eᵀ dy − a_x` instead, where a contact is stiffer than [`STIFF`] and each of its
    /// variables has its own cone row, `Gᵀ dz = −dz`: there `W⁻²` multiplies the rounding of `G dx`,
    /// and the rates of the blocks would no longer fit those of the contacts.
    fn rates_of_stiff(&self, a: &Iterate, d: &mut Iterate) {
        let s = self.structure;
        let mut own: Vec<f64> =
            d.x.iter().zip(&a.x).map(|(x, a)| self.reduced.proximal * x - a).collect();
        s.e.add_transposed(1.0, &d.y, &mut own);
        for block in s.blocks.iter().filter(|b| b.plain) {
            let cone = &s.cones[block.cones[0]];
            if self.cones.stiffness(cone) > STIFF {
                d.z[cone.first..cone.first + cone.size]
                    .copy_from_slice(&own[block.variables.clone()]);
            }
        }
    }

    /// What equalities and border rows still lack.
    fn rest(&self, a: &Iterate, bt: &[f64], d: &Iterate) -> (Vec<f64>, Vec<f64>) {
        let s = self.structure;
        let mut r = a.y.clone();
        s.e.add(-1.0, &d.x, &mut r);
        s.e_border.add(-1.0, &d.t, &mut r);
        let rt = (0..bt.len())
            .map(|k| {
                bt[k]
                    - dot(&self.m[k], &d.x)
                    - dot(&self.k_border[k], &d.t)
                    - dot(&self.e_border[k], &d.y)
            })
            .collect();
        (r, rt)
    }

    /// Adds the step that makes up for `r` and `rt`.
    fn correct(&mut self, r: &[f64], rt: &[f64], d: &mut Iterate) {
        let s = self.structure;
        // p = −r, q = rt.
        let mut dy: Vec<f64> = r.iter().map(|v| -v).collect();
        self.reduced.solve(&mut dy);
        let q: Vec<f64> = rt.iter().zip(&self.n).map(|(q, n)| q - dot(n, &dy)).collect();
        let dt = small(&self.schur, &q);
        for (dt, s_n) in dt.iter().zip(&self.s_n) {
            dy.iter_mut().zip(s_n).for_each(|(y, n)| *y += n * dt);
        }
        let mut dx = vec![0.0; d.x.len()];
        s.e.add_transposed(1.0, &dy, &mut dx);
        for (dt, m) in dt.iter().zip(&self.m) {
            dx.iter_mut().zip(m).for_each(|(x, m)| *x += m * dt);
        }
        self.reduced.flex(s, &mut dx);
        d.x.iter_mut().zip(&dx).for_each(|(d, x)| *d -= x);
        d.y.iter_mut().zip(&dy).for_each(|(d, y)| *d += y);
        d.t.iter_mut().zip(&dt).for_each(|(d, t)| *d += t);
    }
}

/// A small symmetric system by elimination with diagonal pivots; a pivot of zero leaves its unknown
/// at zero.
fn small(matrix: &[Vec<f64>], rhs: &[f64]) -> Vec<f64> {
    let (mut a, mut b, n) = (matrix.to_vec(), rhs.to_vec(), rhs.len());
    for k in 0..n {
        let pivot = a[k].clone();
        for i in k + 1..n {
            let f = if pivot[k] == 0.0 { 0.0 } else { a[i][k] / pivot[k] };
            a[i].iter_mut().zip(&pivot).for_each(|(a, p)| *a -= f * p);
            b[i] -= f * b[k];
        }
    }
    for k in (0..n).rev() {
        let sum: f64 = (k + 1..n).map(|j| a[k][j] * b[j]).sum();
        b[k] = if a[k][k] == 0.0 { 0.0 } else { (b[k] - sum) / a[k][k] };
    }
    b
}
