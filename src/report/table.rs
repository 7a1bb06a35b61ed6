//! Answers as tables (CSV): a row for each joint and system of forces, a row for each block.

use super::{
    cells::Table,
    view::{Joint, View},
};
use crate::{interface::ContactKind, scene::Friction, verdict::mechanism::JointMotion as Kind};
use std::error::Error;

/// Joints: the two blocks, what touches what, the centre of pressure (m; the middle where nothing
/// presses), the unit normal from `a` into `b`, the area that touches (m²), μ, the system of
/// forces, the force on `b` (N), its normal and tangential part, the distance of the centre of
/// pressure from the middle (m), the shares of section and friction that are used, what the joint
/// does in the mechanism.
const JOINTS: [&str; 21] = [
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
    let mut writer = Table::new();
    writer.write_record(JOINTS)?;
    let motion = |k: usize| {
        let mark = view.motions.first().and_then(|m| m.marks.iter().find(|mark| mark.joint == k));
        mark.map_or("", |mark| word(mark.kind)).to_string()
    };
    for (k, joint) in view.joints.iter().enumerate() {
        if view.states.is_empty() {
            writer.write_record(
                head(view, joint, joint.center)
                    .into_iter()
                    .chain(std::iter::repeat_n(String::new(), 9))
                    .chain([motion(k)]),
            )?;
        }
        for state in &view.states {
            let resultant = state.resultants[k].as_ref();
            let mut row = head(view, joint, resultant.map_or(joint.center, |r| r.at));
            row.push(state.name.clone());
            match resultant {
                Some(r) => {
                    row.extend(
                        [
                            r.force.x,
                            r.force.y,
                            r.force.z,
                            r.normal,
                            r.shear,
                            r.eccentricity,
                            r.used,
                        ]
                        .map(|v| v.to_string()),
                    );
                    row.push(r.mobilised.map_or(String::new(), |m| m.to_string()));
                }
                None => row.extend(["0", "0", "0", "0", "0", "", "", ""].map(String::from)),
            }
            row.push(motion(k));
            writer.write_record(row)?;
        }
    }
    Ok(writer.end()?)
}

/// The columns that do not depend on the forces.
fn head(view: &View, joint: &Joint, at: nalgebra::Vector3<f64>) -> Vec<String> {
    let kind = match joint.kind {
        ContactKind::Face => "face",
        ContactKind::Edge => "edge",
        ContactKind::Point => "point",
        ContactKind::Given => "given",
    };
    let mut row =
        vec![view.bodies[joint.a].id.clone(), view.bodies[joint.b].id.clone(), kind.into()];
    row.extend(at.iter().chain(joint.normal.iter()).chain([&joint.area]).map(f64::to_string));
    row.push(match joint.law.friction {
        Friction::Coefficient(mu) => mu.to_string(),
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
    let mut writer = Table::new();
    writer.write_record(BLOCKS)?;
    for (i, body) in view.bodies.iter().enumerate() {
        let mut row = vec![
            body.id.clone(),
            body.support.to_string(),
            body.material.clone().unwrap_or_default(),
            body.mass.to_string(),
        ];
        row.extend(body.center.iter().map(f64::to_string));
        row.push(
            view.states.first().and_then(|s| s.used[i]).map_or(String::new(), |u| u.to_string()),
        );
        match view.motions.first() {
            Some(m) => row.extend(
                m.rates[i]
                    .velocity
                    .iter()
                    .chain(m.rates[i].spin.iter())
                    .map(|v| (v / m.reach).to_string()),
            ),
            None => row.extend(std::iter::repeat_n(String::new(), 6)),
        }
        writer.write_record(row)?;
    }
    Ok(writer.end()?)
}
