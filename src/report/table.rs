//! Answers as tables (CSV): a row for each joint and system of forces, a row for each block.

use super::{
    cells::{Cell, Table, row},
    view::{JointView, Mark, View},
};
use check::verdict::mechanism::JointMotion as Kind;
use model::interface::ContactKind;
use scene::Friction;
use std::error::Error;

/// Joints: the two blocks, what touches what, the centre of pressure (m; the middle where nothing
/// presses), the unit normal from `a` into `b`, the area that touches (m²), μ, the system of
/// forces, the force on `b` (N), its normal and tangential part, the distance of the centre of
/// pressure from the middle (m), the shares of section and friction that are used, what the joint
/// does in the mechanism, and where (m): the place that the text names.
const JOINTS: [&str; 24] = [
    "a",
    "b",
    "contact",
    "x",
    "y",
    "z",
    "nx",
    "ny",
    "nz",
    "area",
    "friction",
    "forces",
    "fx",
    "fy",
    "fz",
    "normal_force",
    "shear_force",
    "eccentricity",
    "section_used",
    "friction_used",
    "motion",
    "motion_x",
    "motion_y",
    "motion_z",
];

/// Blocks: name, whether it is a support, material, mass (kg), centre of mass (m), the share that
/// its joints use of section or friction in the first system of forces, and its rate in the first
/// mechanism (velocity of the centre of mass and spin, on a scale on which the fastest corner moves
/// at 1).
const BLOCKS: [&str; 14] = [
    "block", "support", "material", "mass", "x", "y", "z", "used", "vx", "vy", "vz", "wx", "wy",
    "wz",
];

/// Members: name, kind, force (N; empty where no answer has one), greatest force (N), whether it is
/// slack, first and last point (m).
const MEMBERS: [&str; 11] =
    ["member", "kind", "force", "strength", "slack", "x", "y", "z", "x2", "y2", "z2"];

/// The table of members.
///
/// # Errors
/// The table cannot be written.
pub fn members(view: &View) -> Result<String, Box<dyn Error + Send + Sync>> {
    let mut writer = Table::new();
    writer.write_record(MEMBERS)?;
    for m in &view.members {
        let mut row = vec![
            m.id.clone(),
            m.kind.word().to_string(),
            m.force.map_or(String::new(), |f| f.to_string()),
            m.strength.to_string(),
            m.slack.to_string(),
        ];
        for p in [m.points.first(), m.points.last()] {
            row.extend((0..3).map(|k| p.map_or(String::new(), |p| p[k].to_string())));
        }
        writer.write_record(row)?;
    }
    Ok(writer.end()?)
}

/// The table of joints.
///
/// # Errors
/// The table cannot be written.
pub fn joints(view: &View) -> Result<String, Box<dyn Error + Send + Sync>> {
    let mut writer = Table::with_head(JOINTS)?;
    for (k, joint) in view.joints.iter().enumerate() {
        if view.states.is_empty() {
            let mut row = head(view, joint, joint.center);
            row.extend(std::iter::repeat_with(|| Cell::Nothing).take(9));
            row.extend(motion(view, k));
            writer.write_record(row)?;
        }
        for state in &view.states {
            let resultant = state.resultants[k].as_ref();
            let mut row = head(view, joint, resultant.map_or(joint.center, |r| r.at));
            row.push(state.name.as_str().into());
            match resultant {
                Some(r) => {
                    row.extend(r.force.iter().map(|&v| v.into()));
                    row.extend([r.normal, r.shear, r.eccentricity, r.used].map(Cell::from));
                    row.push(r.mobilised.into());
                }
                None => {
                    row.extend([0.0; 5].map(Cell::from));
                    row.extend([None; 3].map(Cell::from));
                }
            }
            row.extend(motion(view, k));
            writer.write_record(row)?;
        }
    }
    Ok(writer.end()?)
}

/// What a joint does in the mechanism, and where.
fn motion(view: &View, joint: usize) -> [Cell; 4] {
    let mark = view.motions.first().and_then(|m| m.marks.iter().find(|mark| mark.joint == joint));
    match mark {
        Some(Mark { kind, at, .. }) => row![word(*kind), at.x, at.y, at.z],
        None => row!["", None, None, None],
    }
}

/// The columns that do not depend on the forces.
fn head(view: &View, joint: &JointView, at: nalgebra::Vector3<f64>) -> Vec<Cell> {
    let kind = match joint.kind {
        ContactKind::Face => "face",
        ContactKind::Edge => "edge",
        ContactKind::Point => "point",
        ContactKind::Given => "given",
    };
    let mut row: Vec<Cell> =
        row![view.bodies[joint.a].id.as_str(), view.bodies[joint.b].id.as_str(), kind].into();
    row.extend(at.iter().chain(joint.normal.iter()).chain([&joint.area]).map(|&v| v.into()));
    row.push(match joint.law.friction {
        Friction::Coefficient(mu) => mu.into(),
        Friction::Infinite => "infinite".into(),
    });
    row
}

fn word(kind: Kind) -> &'static str {
    match kind {
        Kind::Hinge => "hinge",
        Kind::Slide => "slide",
        Kind::HingeAndSlide => "hinge_and_slide",
        Kind::Part => "part",
        Kind::Crush => "crush",
    }
}

/// The table of blocks.
///
/// # Errors
/// The table cannot be written.
pub fn blocks(view: &View) -> Result<String, Box<dyn Error + Send + Sync>> {
    let mut writer = Table::with_head(BLOCKS)?;
    for (i, body) in view.bodies.iter().enumerate() {
        let mut row: Vec<Cell> = row![
            body.id.as_str(),
            body.support.to_string(),
            body.material.clone().unwrap_or_default(),
            body.mass,
        ]
        .into();
        row.extend(body.center.iter().map(|&v| v.into()));
        row.push(view.states.first().and_then(|s| s.used[i]).into());
        match view.motions.first() {
            Some(m) => row.extend(
                m.rates[i]
                    .velocity
                    .iter()
                    .chain(m.rates[i].spin.iter())
                    .map(|v| (v / m.reach).into()),
            ),
            None => row.extend([None; 6].map(Cell::from)),
        }
        writer.write_record(row)?;
    }
    Ok(writer.end()?)
}
