//! The earthquakes of a site: whether their numbers are those of a place in Italy, in SI units.

use super::short;
use scene::{Scene, site::Spectrum};

/// Peak accelerations of rare earthquakes on rock, m/s²: from Sardinia (0.5) to Calabria (2.8 at
/// 475 years, 4.2 at 975), with room. Below, multiples of g are meant; above, cm/s².
const PEAK: std::ops::Range<f64> = 0.45..8.0;
/// F0 of NTC 2018 is at least 2.2, and nowhere as much as 4.
const AMPLIFICATION: std::ops::Range<f64> = 1.5..4.5;
/// S = S_S S_T lies between 0.9 and 1.8 × 1.4.
const SOIL: std::ops::RangeInclusive<f64> = 0.9..=2.52;

/// What looks like a mistake in the site.
pub(super) fn mistakes(scene: &Scene) -> Vec<String> {
    let Some(site) = &scene.site else { return Vec::new() };
    let slc = site.slc.iter().map(|s| ("slc", s));
    [("slv", &site.slv)].into_iter().chain(slc).flat_map(|(key, s)| spectrum(key, s)).collect()
}

fn spectrum(key: &str, s: &Spectrum) -> Vec<String> {
    let mut texts = Vec::new();
    if !PEAK.contains(&s.a_g) {
        let meant = if s.a_g < PEAK.start { "multiples of g" } else { "cm/s²" };
        texts.push(format!(
            "site.{key}.a_g is {} m/s². It looks like {meant}: accelerations are in m/s²",
            short(s.a_g)
        ));
    }
    if !AMPLIFICATION.contains(&s.f_0) {
        texts.push(format!(
            "site.{key}.f_0 is {}: F0 lies between 2.2 and 3.5 everywhere in Italy",
            short(s.f_0)
        ));
    }
    if !SOIL.contains(&s.s) {
        texts.push(format!("site.{key}.s is {}: S = S_S S_T is 0.9 to 2.52", short(s.s)));
    }
    texts
}
