//! Answers for ParaView and everything else that is built on VTK: one file of XML PolyData (`.vtp`) with blocks, joints, contact forces,
//! lines of thrust and mechanisms.
//!
//! Cells of all kinds stand in one file and are told apart by the cell array `part` ([`Part`]). Arrays that belong to a system of forces or
//! a mechanism carry its name in parentheses: `force (…)`, N, on the points of contact forces; `normal force (…)`, N, and `used (…)`, the
//! share of the section or of the friction, on joints and blocks; `displacement (…)`, m, on the points of blocks, to first order and as far
//! as it is seen well. A simulation holds its blocks alone, at every time that was filmed.
//!
//! W. Schroeder, K. Martin, B. Lorensen, *The Visualization Toolkit*, 4th ed., Kitware 2006; file formats of VTK,
//! <https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html>.

mod ball;
mod mesh;
mod xml;

use super::{drawing::sized, view::View};
use mesh::Mesh;
use nalgebra::Vector3;
use xml::Xml;

/// What a cell is: the numbers of the array `part`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// A face of a free block.
    Block = 0,
    /// A face of a support.
    Support = 1,
    /// A joint.
    Joint = 2,
    /// A contact point, with the force on the second block.
    Force = 3,
    /// A piece of a line of thrust.
    Thrust = 4,
}

/// The file.
pub fn vtp(view: &View) -> String {
    let mesh = Mesh::of(view);
    let mut xml = Xml::new();
    if view.film.is_empty() {
        xml.open("PolyData", "");
    } else {
        let times: Vec<String> = view.film.iter().map(|f| f.time.to_string()).collect();
        xml.open("PolyData", &format!(" TimeValues=\"{}\"", times.join(" ")));
    }
    xml.open("FieldData", "");
    xml.strings("block names", view.bodies.iter().map(|b| b.id.as_str()));
    xml.close("FieldData");
    let [verts, lines, polys] = [&mesh.verts, &mesh.lines, &mesh.polys].map(Vec::len);
    xml.open(
        "Piece",
        &format!(
            " NumberOfPoints=\"{}\" NumberOfVerts=\"{verts}\" NumberOfLines=\"{lines}\" NumberOfStrips=\"0\" NumberOfPolys=\"{polys}\"",
            mesh.points.len()
        ),
    );
    point_data(&mut xml, view, &mesh);
    cell_data(&mut xml, view, &mesh);
    points(&mut xml, view, &mesh);
    for (name, cells) in [("Verts", &mesh.verts), ("Lines", &mesh.lines), ("Polys", &mesh.polys)] {
        xml.open(name, "");
        xml.integers("connectivity", cells.iter().flat_map(|c| c.points.iter().map(|&p| i64::from(p))));
        let mut end = 0;
        let ends = cells.iter().map(|c| {
            end += c.points.len() as i64;
            end
        });
        xml.integers("offsets", ends);
        xml.close(name);
    }
    xml.close("Piece");
    xml.close("PolyData");
    xml.end()
}

fn points(xml: &mut Xml, view: &View, mesh: &Mesh) {
    xml.open("Points", "");
    if view.film.is_empty() {
        xml.vectors("points", "", mesh.points.iter().map(|p| p.at));
    }
    for (k, frame) in view.film.iter().enumerate() {
        let at = mesh.points.iter().map(|p| match p.block {
            Some(i) => frame.blocks[i].center + frame.blocks[i].turn * (p.at - view.bodies[i].center),
            None => p.at,
        });
        xml.vectors("points", &format!(" TimeStep=\"{k}\""), at);
    }
    xml.close("Points");
}

fn point_data(xml: &mut Xml, view: &View, mesh: &Mesh) {
    xml.open("PointData", "");
    if view.film.is_empty() {
        for state in &view.states {
            let force = |p: &mesh::Point| match p.contact {
                Some((joint, corner)) => state.forces[joint][corner],
                None => Vector3::zeros(),
            };
            xml.vectors(&named("force", &state.name), "", mesh.points.iter().map(force));
        }
        for motion in &view.motions {
            let by = sized(view, motion) / motion.reach;
            let way = |p: &mesh::Point| match p.block {
                Some(i) => (motion.rates[i].velocity + motion.rates[i].spin.cross(&(p.at - view.bodies[i].center))) * by,
                None => Vector3::zeros(),
            };
            xml.vectors(&named("displacement", &motion.name), "", mesh.points.iter().map(way));
        }
    }
    xml.close("PointData");
}

fn cell_data(xml: &mut Xml, view: &View, mesh: &Mesh) {
    let cells = || mesh.verts.iter().chain(&mesh.lines).chain(&mesh.polys);
    let index = |i: Option<usize>| i.map_or(-1, |i| i as i64);
    xml.open("CellData", "");
    xml.integers("part", cells().map(|c| c.part as i64));
    xml.integers("block", cells().map(|c| index(c.block)));
    xml.integers("joint", cells().map(|c| index(c.joint)));
    if view.film.is_empty() {
        for (k, state) in view.states.iter().enumerate() {
            let at = |c: &mesh::Cell| c.joint.and_then(|j| state.resultants[j]);
            let normal = |c: &mesh::Cell| match c.segment {
                Some((owner, force)) if owner == k => force,
                Some(_) => 0.0,
                None => at(c).map_or(0.0, |r| r.normal),
            };
            xml.numbers(&named("normal force", &state.name), cells().map(normal));
            let used = |c: &mesh::Cell| match (c.joint, c.block) {
                (Some(_), _) => at(c).map_or(0.0, |r| r.share()),
                (None, Some(i)) => state.used[i].unwrap_or(0.0),
                (None, None) => 0.0,
            };
            xml.numbers(&named("used", &state.name), cells().map(used));
        }
    }
    xml.close("CellData");
}

/// The name of an array that belongs to a system of forces or a mechanism.
fn named(what: &str, name: &str) -> String {
    format!("{what} ({name})")
}

#[cfg(test)]
mod tests;
