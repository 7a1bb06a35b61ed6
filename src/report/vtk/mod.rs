//! Answers for ParaView and everything else that is built on VTK: one file of XML PolyData (`.vtp`)
//! with blocks, joints, contact forces, lines of thrust and mechanisms.
//!
//! Cells of all kinds stand in one file and are told apart by the cell array `part` ([`VtkPart`]);
//! `block`, `other_block` and `joint` are indices in scene order (−1: none), the names of blocks
//! stand in the field data. Arrays that belong to a system of forces or a mechanism end with what
//! that is to the answer ([`ViewPart::suffix`]), so that they are named alike in every file of a
//! question: `force`, N, on the points of contact forces; `load`, N, on the places of loads (live
//! ones not yet multiplied by λ); `member_force`, N, on members, where the scene has any; `normal_force`, N, and `used`, the share of the section or of the
//! friction, on joints and blocks; `displacement`, m, on the points of blocks, to first order and as
//! far as it is seen well. What each of them is in words stands in the field data `meaning`, and
//! the number of the answer it belongs to in `load_factor`, `tilt_deg` or `thrust`. A simulation is a collection (`.pvd`) of
//! such files, one a time, that hold the blocks alone with their velocity: readers of VTK 9 add up
//! the cells of all times that stand in one file.
//!
//! W. Schroeder, K. Martin, B. Lorensen, *The Visualization Toolkit*, 4th ed., Kitware 2006; file
//! formats of VTK, <https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html>.

mod ball;
pub mod grains;
mod mesh;
mod part;
mod xml;

pub(super) use ball::ball;

use super::{
    drawing::sized,
    view::{View, ViewPart},
};
use base::plain::markup;
use dynamics::Frame;
use mesh::Mesh;
use nalgebra::Vector3;
pub use part::VtkPart;
use xml::Xml;

/// The file of an answer.
pub fn vtp(view: &View) -> String {
    document(view, &Mesh::of(view), None)
}

/// The file of one moment of a film: the blocks alone.
pub fn moment(view: &View, frame: &Frame) -> String {
    document(view, &Mesh::blocks_of(view), Some(frame))
}

/// The collection of a film, whose files are `named`.
pub fn collection(view: &View, named: impl Fn(usize) -> String) -> String {
    let mut xml = Xml::new("Collection");
    for (k, frame) in view.film.iter().enumerate() {
        xml.open(
            "DataSet",
            &format!(" timestep=\"{}\" file=\"{}\"", frame.time, markup(&named(k))),
        );
        xml.close("DataSet");
    }
    xml.end("Collection")
}

fn document(view: &View, mesh: &Mesh, frame: Option<&Frame>) -> String {
    let mut xml = Xml::new("PolyData");
    xml.open("FieldData", "");
    xml.strings("block_names", view.bodies.iter().map(|b| b.id.as_str()));
    if frame.is_none() {
        meanings(&mut xml, view);
    }
    xml.close("FieldData");
    let [verts, lines, polys] = [&mesh.verts, &mesh.lines, &mesh.polys].map(Vec::len);
    xml.open(
        "Piece",
        &format!(
            " NumberOfPoints=\"{}\" NumberOfVerts=\"{verts}\" NumberOfLines=\"{lines}\" NumberOfStrips=\"0\" NumberOfPolys=\"{polys}\"",
            mesh.points.len()
        ),
    );
    match frame {
        Some(frame) => velocities(&mut xml, view, mesh, frame),
        None => point_data(&mut xml, view, mesh),
    }
    cell_data(&mut xml, view, mesh, frame.is_none());
    xml.open("Points", "");
    xml.vectors("points", mesh.points.iter().map(|p| place(view, p, frame)));
    xml.close("Points");
    for (name, cells) in [("Verts", &mesh.verts), ("Lines", &mesh.lines), ("Polys", &mesh.polys)] {
        xml.open(name, "");
        xml.integers(
            "connectivity",
            cells.iter().flat_map(|c| c.points.iter().map(|&p| i64::from(p))),
        );
        let mut end = 0;
        let ends = cells.iter().map(|c| {
            end += c.points.len() as i64;
            end
        });
        xml.integers("offsets", ends);
        xml.close(name);
    }
    xml.close("Piece");
    xml.end("PolyData")
}

/// Where a point is.
fn place(view: &View, p: &mesh::MeshPoint, frame: Option<&Frame>) -> Vector3<f64> {
    match (p.block, frame) {
        (Some(i), Some(frame)) => {
            frame.blocks[i].center + frame.blocks[i].turn * (p.at - view.bodies[i].center)
        }
        _ => p.at,
    }
}

fn velocities(xml: &mut Xml, view: &View, mesh: &Mesh, frame: &Frame) {
    xml.open("PointData", "");
    let velocity = |p: &mesh::MeshPoint| match p.block {
        Some(i) => {
            frame.blocks[i].velocity
                + frame.blocks[i]
                    .spin
                    .cross(&(place(view, p, Some(frame)) - frame.blocks[i].center))
        }
        None => Vector3::zeros(),
    };
    xml.vectors("velocity", mesh.points.iter().map(velocity));
    xml.close("PointData");
}

fn point_data(xml: &mut Xml, view: &View, mesh: &Mesh) {
    xml.open("PointData", "");
    for state in &view.states {
        let force = |p: &mesh::MeshPoint| match p.contact {
            Some((joint, corner)) => state.forces[joint][corner],
            None => Vector3::zeros(),
        };
        xml.vectors(&named("force", state.part), mesh.points.iter().map(force));
    }
    if !view.loads.is_empty() {
        let load = |p: &mesh::MeshPoint| p.load.map_or(Vector3::zeros(), |k| view.loads[k].force);
        xml.vectors("load", mesh.points.iter().map(load));
    }
    for motion in &view.motions {
        let by = if motion.is_displacement { 1.0 } else { sized(view, motion) / motion.reach };
        let way = |p: &mesh::MeshPoint| match p.block {
            Some(i) => {
                (motion.rates[i].velocity
                    + motion.rates[i].spin.cross(&(p.at - view.bodies[i].center)))
                    * by
            }
            None => Vector3::zeros(),
        };
        xml.vectors(&named("displacement", motion.part), mesh.points.iter().map(way));
    }
    xml.close("PointData");
}

fn cell_data(xml: &mut Xml, view: &View, mesh: &Mesh, statics: bool) {
    let cells = || mesh.verts.iter().chain(&mesh.lines).chain(&mesh.polys);
    let index = |i: Option<usize>| i.map_or(-1, |i| i as i64);
    xml.open("CellData", "");
    xml.integers("part", cells().map(|c| c.part as i64));
    xml.integers("block", cells().map(|c| index(c.block)));
    xml.integers("other_block", cells().map(|c| index(c.other)));
    xml.integers("joint", cells().map(|c| index(c.joint)));
    if statics && !view.members.is_empty() {
        let force = |c: &mesh::Cell| c.member.and_then(|m| view.members[m].force).unwrap_or(0.0);
        xml.numbers("member_force", cells().map(force));
    }
    if statics {
        for (k, state) in view.states.iter().enumerate() {
            let at = |c: &mesh::Cell| c.joint.and_then(|j| state.resultants[j]);
            let normal = |c: &mesh::Cell| match c.segment {
                Some((owner, force)) if owner == k => force,
                Some(_) => 0.0,
                None => at(c).map_or(0.0, |r| r.normal),
            };
            xml.numbers(&named("normal_force", state.part), cells().map(normal));
            let used = |c: &mesh::Cell| match (c.joint, c.block) {
                (Some(_), _) => at(c).map_or(0.0, |r| r.share()),
                (None, Some(i)) => state.used[i].unwrap_or(0.0),
                (None, None) => 0.0,
            };
            xml.numbers(&named("used", state.part), cells().map(used));
        }
    }
    xml.close("CellData");
}

/// The name of an array that belongs to a system of forces or a mechanism.
fn named(what: &str, part: ViewPart) -> String {
    format!("{what}{}", part.suffix())
}

/// What the arrays are in words, and the numbers that they belong to.
fn meanings(xml: &mut Xml, view: &View) {
    let forces = view.states.iter().map(|s| format!("{}: {}", named("force", s.part), s.name));
    let motions =
        view.motions.iter().map(|m| format!("{}: {}", named("displacement", m.part), m.name));
    let meanings: Vec<String> = forces.chain(motions).collect();
    xml.strings("meaning", meanings.iter().map(String::as_str));
    for state in &view.states {
        if let Some((what, value)) = state.value {
            xml.field(&named(what, state.part), value);
        }
    }
}
