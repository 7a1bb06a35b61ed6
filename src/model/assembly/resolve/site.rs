//! The earthquakes of a site: numbers that mean something.

use super::check;
use base::error::{InputError, JsonPath};
use scene::site::{Building, Site, Spectrum};

/// Refuses what no spectrum can be made of.
pub(super) fn resolve(site: Option<&Site>, path: &JsonPath) -> Result<(), InputError> {
    let Some(site) = site else { return Ok(()) };
    spectrum(&site.slv, &path.key("slv"))?;
    if let Some(slc) = &site.slc {
        spectrum(slc, &path.key("slc"))?;
    }
    if let Some(q) = site.q.filter(|q| !(q.is_finite() && *q >= 1.0)) {
        return Err(InputError::at(path.key("q"), format!("must be at least 1, got {q}"))
            .hint("the behaviour factor of the linear check; the default is 2"));
    }
    damping(site.damping_percent, &path.key("damping_percent"))?;
    site.building.as_ref().map_or(Ok(()), |b| building(b, &path.key("building")))
}

fn spectrum(s: &Spectrum, path: &JsonPath) -> Result<(), InputError> {
    for (key, value, unit) in
        [("a_g", s.a_g, "m/s²"), ("f_0", s.f_0, "F0, 2.2 or more"), ("s", s.s, "S = S_S S_T")]
    {
        check::positive(value, &path.key(key), unit)?;
    }
    for (key, value) in
        [("t_c_star", s.t_c_star), ("c_c", s.c_c), ("t_c", s.t_c), ("t_b", s.t_b), ("t_d", s.t_d)]
    {
        value.map(|v| check::positive(v, &path.key(key), "s")).transpose()?;
    }
    match (s.t_c, s.t_c_star, s.c_c) {
        (Some(_), None, None) | (None, Some(_), Some(_)) => {}
        (None, _, _) => {
            return Err(InputError::at(path.clone(), "T_C is not given")
                .hint("give \"t_c\" in s, or \"t_c_star\" and \"c_c\" (NTC 2018, table 3.2.IV)"));
        }
        (Some(_), _, _) => {
            return Err(InputError::at(
                path.key("t_c"),
                "T_C is given twice: as \"t_c\" and by \"t_c_star\" or \"c_c\"",
            )
            .hint("keep one of them"));
        }
    }
    let t_c = s.t_c.or_else(|| Some(s.t_c_star? * s.c_c?)).unwrap_or(f64::NAN);
    if let Some(t_b) = s.t_b.filter(|t| *t >= t_c) {
        let text = format!("T_B = {t_b} s is not below T_C = {t_c} s");
        return Err(InputError::at(path.key("t_b"), text).hint("leave it out for T_C / 3"));
    }
    if let Some(t_d) = s.t_d.filter(|t| *t <= t_c) {
        let text = format!("T_D = {t_d} s is not above T_C = {t_c} s");
        return Err(InputError::at(path.key("t_d"), text).hint("leave it out for 4 a_g/g + 1.6"));
    }
    Ok(())
}

fn damping(percent: Option<f64>, path: &JsonPath) -> Result<(), InputError> {
    match percent.filter(|p| !(*p > 0.0 && *p < 100.0)) {
        Some(p) => Err(InputError::at(path.clone(), format!("must be > 0 and < 100, got {p}"))
            .hint("in percent of the critical damping; the default is 5")),
        None => Ok(()),
    }
}

fn building(b: &Building, path: &JsonPath) -> Result<(), InputError> {
    check::positive(b.t_1, &path.key("t_1"), "s")?;
    check::positive(b.height, &path.key("height"), "m")?;
    if b.storeys == 0 {
        return Err(InputError::at(path.key("storeys"), "must be at least 1")
            .hint("leave \"building\" out where the mechanism stands on the ground"));
    }
    if !(b.z >= 0.0 && b.z <= b.height) {
        let text = format!("must be from 0 to the height of the building, got {}", b.z);
        return Err(InputError::at(path.key("z"), text).hint("m above the foundation"));
    }
    damping(b.damping_percent, &path.key("damping_percent"))?;
    if let Some(a) = b.amplification.filter(|a| !(a.is_finite() && *a >= 1.0)) {
        return Err(InputError::at(
            path.key("amplification"),
            format!("must be at least 1, got {a}"),
        )
        .hint("how much a floor amplifies at its own period; with ξ = 5 % as a fraction 1.1 ξ^-0.5 is 4.92"));
    }
    Ok(())
}
