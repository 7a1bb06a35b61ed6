//! Directions in which a scene is tilted, or shaken.

use base::error::{InputError, JsonPath};
use nalgebra::Vector3;
use serde::{Deserialize, Deserializer};

/// Directions of a tilt where nothing is said.
pub const DIRECTIONS: u16 = 8;
/// Most directions of a tilt: every tenth of a degree.
const MOST_DIRECTIONS: u16 = 3600;

/// A direction as people write it: two coordinates or three.
#[derive(Deserialize)]
#[serde(untagged, expecting = "expected a direction such as [0, -1] or [1, 0, 0]")]
enum Written {
    Plane([f64; 2]),
    Space([f64; 3]),
}

impl From<Written> for [f64; 3] {
    fn from(written: Written) -> Self {
        match written {
            Written::Plane([x, y]) => [x, y, 0.0],
            Written::Space(all) => all,
        }
    }
}

/// One direction of two or three coordinates.
///
/// # Errors
/// It is none.
pub(super) fn one<'de, D: Deserializer<'de>>(from: D) -> Result<[f64; 3], D::Error> {
    Written::deserialize(from).map(Into::into)
}

/// A direction or a list of them.
///
/// # Errors
/// It is neither.
pub(super) fn several<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<[f64; 3]>, D::Error> {
    #[derive(Deserialize)]
    #[serde(
        untagged,
        expecting = "expected directions such as [[0, -1]] or [[1, 0, 0], [0, 1, 0]]"
    )]
    enum Given {
        One(Written),
        Several(Vec<Written>),
    }
    Ok(match Given::deserialize(from)? {
        Given::One(one) => vec![one.into()],
        Given::Several(list) => list.into_iter().map(Into::into).collect(),
    })
}

/// Refuses directions that are given and counted, or too many.
pub(super) fn check_directions(
    path: &JsonPath,
    toward: &[[f64; 3]],
    all: Option<u16>,
) -> Result<(), InputError> {
    match (all, toward.is_empty()) {
        (Some(_), false) => {
            Err(InputError::at(path.key("all"), "\"toward\" and \"all\" are both given")
                .hint("keep one of them"))
        }
        (Some(n), true) if !(1..=MOST_DIRECTIONS).contains(&n) => Err(InputError::at(
            path.key("all"),
            format!("must be from 1 to {MOST_DIRECTIONS}, got {n}"),
        )),
        _ => Ok(()),
    }
}

/// The directions that are asked about: those given, or as many as are said evenly spread.
pub fn directions(
    gravity: Vector3<f64>,
    toward: &[[f64; 3]],
    all: Option<u16>,
) -> Vec<Vector3<f64>> {
    if toward.is_empty() {
        return spread(gravity, all.unwrap_or(DIRECTIONS).into());
    }
    toward.iter().map(|&d| d.into()).collect()
}

/// `count` directions across gravity, evenly spread, the first along x (or along y, where gravity
/// is along x).
pub fn spread(gravity: Vector3<f64>, count: usize) -> Vec<Vector3<f64>> {
    let down = gravity.normalize();
    let across = |axis: Vector3<f64>| axis - down * down.dot(&axis);
    let e1 = [Vector3::x(), Vector3::y()]
        .map(across)
        .into_iter()
        .find(|v| v.norm() > 0.5)
        .unwrap_or_else(|| across(Vector3::z()))
        .normalize();
    let e2 = e1.cross(&down);
    // Exact along the axes: what is 1e-16 there is rounding of the cosine.
    let clean = |c: f64| if c.abs() < 1e-15 { 0.0 } else { c };
    (0..count)
        .map(|k| {
            let (sin, cos) = (std::f64::consts::TAU * k as f64 / count as f64).sin_cos();
            (e1 * clean(cos) + e2 * clean(sin)).map(clean)
        })
        .collect()
}
