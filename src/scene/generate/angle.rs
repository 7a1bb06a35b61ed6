//! Sine and cosine of degrees, exact at multiples of 90° and exactly symmetric.
//!
//! With radians cos(π/2) is 6e-17 and the springings of a semicircle would not lie on one plane.

/// sin of an angle in degrees, |angle| ≤ 180.
pub fn sin_deg(angle: f64) -> f64 {
    let a = angle.abs();
    let a = if a > 90.0 { 180.0 - a } else { a };
    let sine = if a <= 45.0 { a.to_radians().sin() } else { (90.0 - a).to_radians().cos() };
    sine.copysign(angle)
}

/// cos of an angle in degrees, |angle| ≤ 180.
pub fn cos_deg(angle: f64) -> f64 {
    sin_deg(90.0 - angle.abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quadrants_are_exact_and_the_rest_agrees_with_radians() {
        assert_eq!(
            (cos_deg(90.0), cos_deg(-90.0), sin_deg(180.0), sin_deg(90.0), cos_deg(180.0)),
            (0.0, 0.0, 0.0, 1.0, -1.0)
        );
        for k in -1800..=1800 {
            let a = f64::from(k) / 10.0;
            assert!((sin_deg(a) - a.to_radians().sin()).abs() < 4e-16, "sin {a}");
            assert!((cos_deg(a) - a.to_radians().cos()).abs() < 4e-16, "cos {a}");
            assert_eq!(sin_deg(a), -sin_deg(-a));
            assert_eq!(cos_deg(a), cos_deg(-a));
        }
    }
}
