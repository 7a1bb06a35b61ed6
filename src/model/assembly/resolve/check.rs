//! Checks of single numbers, each with its place and its remedy.

use base::error::{InputError, JsonPath};
use nalgebra::Vector3;
use scene::ContactSpec;

/// A finite number.
pub(super) fn finite(value: f64, path: &JsonPath) -> Result<f64, InputError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(InputError::at(path.clone(), format!("must be a finite number, got {value}")))
    }
}

/// A finite number greater than zero; `unit` is the remedy.
pub(super) fn positive(value: f64, path: &JsonPath, unit: &str) -> Result<f64, InputError> {
    finite(value, path)?;
    if value > 0.0 {
        Ok(value)
    } else {
        Err(InputError::at(path.clone(), format!("must be > 0, got {value}")).hint(unit))
    }
}

/// Three finite numbers.
pub(super) fn vector(value: [f64; 3], path: &JsonPath) -> Result<Vector3<f64>, InputError> {
    for (k, x) in value.iter().enumerate() {
        if !x.is_finite() {
            finite(*x, &path.index(k))?;
        }
    }
    Ok(value.into())
}

/// A direction: three finite numbers, not all zero, scaled to length 1.
pub(super) fn direction(value: [f64; 3], path: &JsonPath) -> Result<Vector3<f64>, InputError> {
    let value = vector(value, path)?;
    // Dividing by the largest component first keeps the norm from overflowing or vanishing.
    let largest = value.amax();
    if largest == 0.0 {
        return Err(
            InputError::at(path.clone(), "must not be zero").hint("a direction, of any length")
        );
    }
    Ok((value / largest).normalize())
}

/// The contact tolerances.
pub(super) fn contact(spec: &ContactSpec, path: &JsonPath) -> Result<(), InputError> {
    let range = |key: &str, value: f64, good: bool, range: &str, hint: &str| {
        if good {
            Ok(())
        } else {
            Err(InputError::at(path.key(key), format!("must be {range}, got {value}")).hint(hint))
        }
    };
    let ContactSpec { gap, angle_deg, min_area } = *spec;
    range(
        "gap",
        gap,
        gap > 0.0 && gap < 0.5,
        "> 0 and < 0.5",
        "a fraction of the size of the smaller block; the default is 1e-4",
    )?;
    range(
        "angle_deg",
        angle_deg,
        angle_deg > 0.0 && angle_deg < 45.0,
        "> 0 and < 45",
        "degrees; the default is 1",
    )?;
    range(
        "min_area",
        min_area,
        (0.0..1.0).contains(&min_area),
        ">= 0 and < 1",
        "a fraction of the smaller block's size squared; the default is 1e-9",
    )
}
