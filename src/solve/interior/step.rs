//! One step of both sides: what moves, and how far.

use super::{cones::Cones, newton::Point, structure::Structure};

/// How far a step goes towards the boundary. Nearer: the next steps are short. Farther: more steps.
pub(super) const TO_THE_BOUNDARY: f64 = 0.995;

/// `to += by · d`.
pub(super) fn add(to: &mut [f64], by: f64, d: &[f64]) {
    to.iter_mut().zip(d).for_each(|(t, d)| *t += by * d);
}

/// `ds = −r_z − G dx`.
pub(super) fn slack(st: &Structure, d: &Point, r: &Point) -> Vec<f64> {
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
    if st.quadratic.is_empty() { (ap, ad) } else { (ap.min(ad), ap.min(ad)) }
}
