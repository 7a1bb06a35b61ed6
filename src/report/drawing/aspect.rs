//! From where a structure is seen.

use super::choice::Movement;
use crate::view::View;
use nalgebra::Vector3;
use std::str::FromStr;

/// From where.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Aspect {
    /// Plane scenes along the normal of their plane, others from a corner above.
    #[default]
    Auto,
    /// From −y: x to the right, z up.
    Front,
    /// From +y.
    Back,
    /// From −x.
    Left,
    /// From +x: y to the right.
    Right,
    /// From above: x to the right, y up.
    Top,
    /// From a corner above.
    Corner,
    /// From this direction.
    From(Vector3<f64>),
}

impl FromStr for Aspect {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Option<Vec<f64>> = text
            .split(',')
            .map(|t| t.trim().parse().ok().filter(|v: &f64| v.is_finite()))
            .collect();
        match (text, numbers.as_deref()) {
            ("auto", _) => Ok(Self::Auto),
            ("front", _) => Ok(Self::Front),
            ("back", _) => Ok(Self::Back),
            ("left", _) => Ok(Self::Left),
            ("right", _) => Ok(Self::Right),
            ("top", _) => Ok(Self::Top),
            ("corner", _) => Ok(Self::Corner),
            (_, Some(&[x, y, z])) if x != 0.0 || y != 0.0 || z != 0.0 => {
                Ok(Self::From(Vector3::new(x, y, z)))
            }
            _ => Err(
                "expected auto, front, back, left, right, top, corner or a direction such as 1,-2,0.5"
                    .into(),
            ),
        }
    }
}

/// What is seen to the right, upwards, and towards the eye: right-handed unit vectors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes {
    /// To the right.
    pub right: Vector3<f64>,
    /// Upwards.
    pub up: Vector3<f64>,
    /// Towards the eye.
    pub eye: Vector3<f64>,
    /// Whether the eye looks along the ground.
    pub level: bool,
}

/// Directions this close (as a sine) count as one when a view is chosen. A choice, not a claim:
/// larger or smaller, another view is taken.
const NEAR: f64 = 1e-3;

impl Aspect {
    /// The axes for a view; `movement` is what is to be seen of its motion.
    pub fn axes(self, view: &View, movement: Option<&Movement>) -> Axes {
        let up = view.ground;
        let across = |v: Vector3<f64>| v - up * up.dot(&v);
        // x and y of the scene as far as they lie across gravity.
        let x = [Vector3::x(), -Vector3::z(), Vector3::y()]
            .map(across)
            .into_iter()
            .find(|v| v.norm() > 0.5)
            .unwrap_or(Vector3::x());
        let x = x.normalize();
        let y = up.cross(&x);
        let eye = match self {
            // The slope of a heap is seen from the side.
            Self::Auto if view.slope.is_some() => -y,
            Self::Auto => match plane(view, movement, up, [y, x]) {
                Some(axis) if axis.cross(&up).sum() > 0.0 => -axis,
                Some(axis) => axis,
                None => x * 0.5 - y * 0.75 + up * 0.45,
            },
            Self::Front => -y,
            Self::Back => y,
            Self::Left => -x,
            Self::Right => x,
            Self::Top => up,
            Self::Corner => x * 0.5 - y * 0.75 + up * 0.45,
            Self::From(eye) => eye,
        };
        // From straight above or below, x points to the right.
        let eye = eye.normalize();
        let right = up.cross(&eye);
        let right = if right.norm() > NEAR { right.normalize() } else { x };
        Axes { right, up: eye.cross(&right), eye, level: eye.dot(&up).abs() < NEAR }
    }
}

/// The normal of the vertical plane in which everything happens, if there is one.
fn plane(
    view: &View,
    movement: Option<&Movement>,
    up: Vector3<f64>,
    sides: [Vector3<f64>; 2],
) -> Option<Vector3<f64>> {
    let turned = view
        .joints
        .iter()
        .map(|f| up.cross(&f.normal))
        .find(|v| v.norm() > 0.1)
        .map(|v| v.normalize());
    let free = || view.bodies.iter().filter(|b| !b.support);
    let flat = |axis: &Vector3<f64>| {
        let first = free().next().map_or(0.0, |b| axis.dot(&b.center));
        let small = |v: &Vector3<f64>| axis.dot(v).abs() <= NEAR * v.norm();
        small(&view.up)
            && view.joints.iter().all(|f| small(&f.normal))
            && view.loads.iter().all(|l| small(&l.force))
            && free().all(|b| (axis.dot(&b.center) - first).abs() <= NEAR * b.radius())
            && movement.is_none_or(|m| m.stays_across(axis, NEAR))
    };
    turned.into_iter().chain(sides).find(flat)
}
