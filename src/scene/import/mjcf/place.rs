//! Where frames lie: the ways in which MJCF says so.

use super::attributes::Attributes;
use crate::import::{
    text::shorten,
    xml::{Xml, called},
};
use base::error::InputError;
use nalgebra::{
    Isometry3, Matrix3, Quaternion, Rotation3, Translation3, Unit, UnitQuaternion, Vector3,
};
use roxmltree::Node;

/// Attributes that say an orientation, of which one is used.
const TURNS: [&str; 5] = ["quat", "axisangle", "euler", "xyaxes", "zaxis"];

/// How angles are written.
#[derive(Clone, Debug)]
pub(super) struct Angles {
    /// Radians in a unit of the file.
    pub unit: f64,
    /// Axes of Euler angles, in small letters turning with the frame.
    pub sequence: [u8; 3],
}

impl Default for Angles {
    fn default() -> Self {
        Self { unit: std::f64::consts::PI / 180.0, sequence: *b"xyz" }
    }
}

/// The frame of an element in its parent's.
///
/// # Errors
/// Numbers that make no frame.
pub(super) fn frame(
    xml: &Xml,
    attributes: &Attributes,
    angles: &Angles,
) -> Result<Isometry3<f64>, InputError> {
    let at = attributes.numbers(xml, "pos", 3..=3)?.unwrap_or_else(|| vec![0.0; 3]);
    let turn = turn(xml, attributes, angles)?;
    Ok(Isometry3::from_parts(Translation3::new(at[0], at[1], at[2]), turn))
}

fn turn(
    xml: &Xml,
    attributes: &Attributes,
    angles: &Angles,
) -> Result<UnitQuaternion<f64>, InputError> {
    let Some((name, text)) = attributes.one_of(&TURNS) else {
        return Ok(UnitQuaternion::identity());
    };
    let node = attributes.node;
    let what = format!("{}: {name}", called(node));
    let no_direction = || {
        xml.error(node, format!("{what}: {:?} is no direction", shorten(text)))
            .hint("its length must be above zero")
    };
    let unit = |v: Vector3<f64>| Unit::try_new(v, 0.0).ok_or_else(no_direction);
    Ok(match name {
        "quat" => {
            let [w, x, y, z] = xml.exactly(node, &what, text)?;
            quaternion(w, x, y, z).ok_or_else(no_direction)?
        }
        "axisangle" => {
            let [x, y, z, angle] = xml.exactly(node, &what, text)?;
            UnitQuaternion::from_axis_angle(&unit(Vector3::new(x, y, z))?, angle * angles.unit)
        }
        "euler" => {
            let list: [f64; 3] = xml.exactly(node, &what, text)?;
            euler(list.map(|angle| angle * angles.unit), angles.sequence)
        }
        "xyaxes" => {
            let [a, b, c, d, e, f] = xml.exactly(node, &what, text)?;
            let x = unit(Vector3::new(a, b, c))?;
            let y = Vector3::new(d, e, f);
            let y = unit(y - x.into_inner() * x.dot(&y))?;
            let axes = Matrix3::from_columns(&[*x, *y, x.cross(&y)]);
            UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes))
        }
        _ => along(xml.exactly::<3>(node, &what, text)?.into()).ok_or_else(no_direction)?,
    })
}

/// A turn of any four numbers but zeros.
pub(super) fn quaternion(w: f64, x: f64, y: f64, z: f64) -> Option<UnitQuaternion<f64>> {
    UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 0.0)
}

/// Turns about axes, one after the other: small letters about axes that turn along, capitals about those
/// that stay.
fn euler(angles: [f64; 3], sequence: [u8; 3]) -> UnitQuaternion<f64> {
    let mut turn = UnitQuaternion::identity();
    for (axis, angle) in sequence.into_iter().zip(angles) {
        let about = match axis.to_ascii_lowercase() {
            b'x' => Vector3::x_axis(),
            b'y' => Vector3::y_axis(),
            _ => Vector3::z_axis(),
        };
        let next = UnitQuaternion::from_axis_angle(&about, angle);
        turn = if axis.is_ascii_lowercase() { turn * next } else { next * turn };
    }
    turn
}

/// The least turn that brings z along a direction; half a turn about x where it is −z.
pub(super) fn along(direction: Vector3<f64>) -> Option<UnitQuaternion<f64>> {
    let to = Unit::try_new(direction, 0.0)?;
    let half = || UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
    Some(UnitQuaternion::rotation_between_axis(&Vector3::z_axis(), &to).unwrap_or_else(half))
}

/// The axes of Euler angles.
///
/// # Errors
/// Three other letters than x, y and z.
pub(super) fn sequence(xml: &Xml, node: Node, text: &str) -> Result<[u8; 3], InputError> {
    let axes = |list: [u8; 3]| list.iter().all(|a| b"xyzXYZ".contains(a)).then_some(list);
    text.as_bytes().try_into().ok().and_then(axes).ok_or_else(|| {
        xml.error(node, format!("eulerseq: {:?} are no three axes", shorten(text)))
            .hint("three of x, y, z, X, Y, Z")
    })
}
