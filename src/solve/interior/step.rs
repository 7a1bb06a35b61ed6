//! One step of both sides: what moves, and how far.

use super::{cones::Cones, newton::Iterate, structure::Structure};

/// What a step leaves of the way to the boundary, at most and at least. Less at most: the next steps
/// are short. Less at least: products at the level of rounding. More: more steps; with 5e-3 for both
/// seven packings take 80 iterations in place of 71, a wall pushed out of its plane 7 in place of 6.
const LEFT_AT_MOST: f64 = 5e-3;
const LEFT_AT_LEAST: f64 = 1e-4;

/// How far a step goes that aims at `sigma` of the products: where they all but vanish, the way to
/// the boundary is the way to the solution.
pub(super) fn share_of_the_way(sigma: f64) -> f64 {
    1.0 - sigma.clamp(LEFT_AT_LEAST, LEFT_AT_MOST)
}

/// `to += by · d`.
pub(super) fn add(to: &mut [f64], by: f64, d: &[f64]) {
    to.iter_mut().zip(d).for_each(|(t, d)| *t += by * d);
}

/// `ds = −r_z − G dx`.
pub(super) fn slack(st: &Structure, d: &Iterate, r: &Iterate) -> Vec<f64> {
    let mut ds: Vec<f64> = r.z.iter().map(|v| -v).collect();
    st.g.add(-1.0, &d.x, &mut ds);
    st.g_border.add(-1.0, &d.t, &mut ds);
    ds
}

/// How far both sides may go; equally far where a quadratic part ties them together.
pub(super) fn steps(
    cones: &Cones,
    st: &Structure,
    (s, ds): (&[f64], &[f64]),
    (z, dz): (&[f64], &[f64]),
    share: f64,
) -> (f64, f64) {
    let (ap, ad) = ((share * cones.step(s, ds)).min(1.0), (share * cones.step(z, dz)).min(1.0));
    tied(st, (ap, ad))
}

/// As much of both steps as does not round to outside.
pub(super) fn kept_inside(
    cones: &Cones,
    st: &Structure,
    (s, ds): (&[f64], &[f64]),
    (z, dz): (&[f64], &[f64]),
    (ap, ad): (f64, f64),
) -> (f64, f64) {
    tied(st, (cones.kept_inside(s, ds, ap), cones.kept_inside(z, dz, ad)))
}

fn tied(st: &Structure, (ap, ad): (f64, f64)) -> (f64, f64) {
    if st.quadratic.is_empty() { (ap, ad) } else { (ap.min(ad), ap.min(ad)) }
}
