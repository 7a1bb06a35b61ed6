//! VTK files read back: by this test, and by VTK itself where `python3` has it.

use super::{all, arch, assessed, ball_on_box, limited, parsed};
use crate::ask::model;
use nalgebra::Vector3;
use roxmltree::Document;
use std::{ops::ControlFlow, process::Command};
use voussoir::{
    dynamics::{Fidelity, SimulationSettings, simulate},
    interface::Model,
    proof::saved,
    report::{
        view::{Film, View},
        vtk::{collection, moment, vtp},
    },
};

struct File<'a>(Document<'a>);

impl File<'_> {
    fn count(&self, what: &str) -> usize {
        all(self.0.root_element(), "Piece")
            .next()
            .unwrap()
            .attribute(what)
            .unwrap()
            .parse()
            .unwrap()
    }

    /// The numbers of an array whose name begins so, below an element.
    fn array(&self, below: &'static str, name: &str) -> Vec<f64> {
        let parent = all(self.0.root_element(), below).next().unwrap();
        let array = all(parent, "DataArray")
            .find(|a| a.attribute("Name") == Some(name))
            .unwrap_or_else(|| panic!("no {name}"));
        array.text().unwrap().split_whitespace().map(|w| w.parse().unwrap()).collect()
    }

    fn vectors(&self, below: &'static str, name: &str) -> Vec<Vector3<f64>> {
        self.array(below, name).chunks(3).map(Vector3::from_row_slice).collect()
    }

    /// Cells in the order of VTK: vertices, lines, polygons.
    fn cells(&self) -> Vec<Vec<usize>> {
        ["Verts", "Lines", "Polys"].into_iter().flat_map(|kind| self.kind(kind)).collect()
    }

    fn kind(&self, kind: &'static str) -> Vec<Vec<usize>> {
        let points: Vec<usize> =
            self.array(kind, "connectivity").into_iter().map(|v| v as usize).collect();
        let mut start = 0;
        let ends = self.array(kind, "offsets").into_iter().map(|v| v as usize);
        ends.map(|end| points[std::mem::replace(&mut start, end)..end].to_vec()).collect()
    }
}

/// Everything has the length that the head says, and points exist.
fn is_sound(file: &File, view: &View) {
    let (points, cells) = (file.count("NumberOfPoints"), file.cells());
    for (kind, count) in
        [("Verts", "NumberOfVerts"), ("Lines", "NumberOfLines"), ("Polys", "NumberOfPolys")]
    {
        assert_eq!(file.kind(kind).len(), file.count(count), "{kind}");
    }
    assert!(cells.iter().flatten().all(|&p| p < points) && cells.iter().all(|c| !c.is_empty()));
    for below in ["PointData", "CellData", "Points"] {
        for array in all(all(file.0.root_element(), below).next().unwrap(), "DataArray") {
            let of = array.attribute("NumberOfComponents").map_or(1, |n| n.parse().unwrap());
            let tuples = if below == "CellData" { cells.len() } else { points };
            let text = array.text().unwrap_or_default();
            assert_eq!(
                text.split_whitespace().count(),
                of * tuples,
                "{:?}",
                array.attribute("Name")
            );
            assert!(text.split_whitespace().all(|w| w.parse::<f64>().unwrap().is_finite()));
        }
    }
    let bytes: Vec<u8> =
        file.array("FieldData", "block_names").into_iter().map(|b| b as u8).collect();
    let names: Vec<String> = view.bodies.iter().map(|b| b.id.clone() + "\0").collect();
    assert_eq!(String::from_utf8(bytes).unwrap(), names.concat());
}

/// Faces of each block enclose its volume, outwards (theorem of Gauss); of balls nearly.
fn surfaces_are_closed(file: &File, m: &Model, density: f64) {
    let (at, parts, blocks) = (
        file.vectors("Points", "points"),
        file.array("CellData", "part"),
        file.array("CellData", "block"),
    );
    let mut volume = vec![0.0; m.assembly.blocks.len()];
    for (cell, (part, block)) in
        file.cells().iter().zip(parts.iter().zip(&blocks)).filter(|(_, (p, _))| **p < 2.0)
    {
        let (i, fan) = (*block as usize, cell.windows(2).skip(1));
        assert_eq!(*part == 1.0, m.assembly.blocks[i].support);
        volume[i] += fan.map(|w| at[cell[0]].dot(&at[w[0]].cross(&at[w[1]])) / 6.0).sum::<f64>();
    }
    for (block, volume) in m.assembly.blocks.iter().zip(volume) {
        let want = block.mass / density;
        assert!((volume - want).abs() < 0.03 * want, "{}: {volume}, {want}", block.id);
    }
}

/// Contact forces and weights cancel on every free block, from the file alone.
fn forces_balance(file: &File, view: &View, load: impl Fn(usize) -> Vector3<f64>) {
    let (parts, blocks, others) = (
        file.array("CellData", "part"),
        file.array("CellData", "block"),
        file.array("CellData", "other_block"),
    );
    let forces = file.vectors("PointData", "force");
    let mut sum: Vec<Vector3<f64>> = (0..view.bodies.len()).map(&load).collect();
    let mut count = 0;
    for (k, cell) in file.cells().iter().enumerate().filter(|(k, _)| parts[*k] == 3.0) {
        sum[blocks[k] as usize] += forces[cell[0]];
        sum[others[k] as usize] -= forces[cell[0]];
        count += 1;
    }
    assert_eq!(count, view.joints.iter().map(|j| j.points.len()).sum::<usize>());
    for (i, body) in view.bodies.iter().enumerate().filter(|(_, b)| !b.support) {
        assert!(sum[i].norm() < 1e-8 * load(i).norm(), "{}: {:?}", body.id, sum[i]);
    }
}

#[test]
fn forces_in_the_file_balance_every_block() {
    let (m, view) = limited(&arch(0.15, 1.0, serde_json::json!({})));
    let text = vtp(&view);
    let file = File(parsed(&text));
    is_sound(&file, &view);
    surfaces_are_closed(&file, &m, 1.0);
    let lambda = voussoir::analysis::limit(&m, &super::control()).value.unwrap();
    forces_balance(&file, &view, |i| m.assembly.dead[i].force + m.assembly.live[i].force * lambda);
    let way =
        file.vectors("PointData", "displacement").iter().map(|v| v.norm()).fold(0.0, f64::max);
    assert!(way > 0.01 * view.size() && way < 0.2 * view.size(), "{way}");
    // The line of thrust: one piece a voussoir.
    assert_eq!(file.array("CellData", "part").iter().filter(|p| **p == 4.0).count(), 16);
}

#[test]
fn balls_are_round_and_contacts_at_points_are_there() {
    let (m, view) = assessed(&ball_on_box());
    let text = vtp(&view);
    let file = File(parsed(&text));
    is_sound(&file, &view);
    surfaces_are_closed(&file, &m, 1.0);
    forces_balance(&file, &view, |i| m.assembly.dead[i].force);
    assert_eq!(file.array("CellData", "part").iter().filter(|p| **p == 2.0).count(), 2);
}

/// A script that reads one file reads the next: names are those of the kind of answer, whatever the
/// numbers in it.
#[test]
fn arrays_are_named_alike_in_every_file_and_say_what_they_are_beside() {
    let names = |thickness: f64| {
        let (_, view) = limited(&arch(thickness, 1.0, serde_json::json!({})));
        let text = vtp(&view);
        let file = File(parsed(&text));
        let names: Vec<String> = ["FieldData", "PointData", "CellData"]
            .into_iter()
            .flat_map(|below| {
                let parent = all(file.0.root_element(), below).next().unwrap();
                all(parent, "DataArray")
                    .map(|a| a.attribute("Name").unwrap().to_string())
                    .collect::<Vec<_>>()
            })
            .collect();
        let meaning: Vec<u8> =
            file.array("FieldData", "meaning").into_iter().map(|b| b as u8).collect();
        (names, String::from_utf8(meaning).unwrap(), file.array("FieldData", "load_factor")[0])
    };
    let ((first, said, factor), (second, _, other)) = (names(0.15), names(0.18));
    assert_eq!(first, second);
    assert!(
        first.iter().all(|n| n.chars().all(|c| c.is_ascii_lowercase() || c == '_')),
        "{first:?}"
    );
    for name in ["force", "normal_force", "used", "displacement", "load_factor", "block_names"] {
        assert!(first.iter().any(|n| n == name), "{name}: {first:?}");
    }
    assert!(factor > 0.0 && other > factor, "{factor}, {other}");
    assert!(said.contains("force: forces in equilibrium at λ = "), "{said}");
}

fn falling() -> (Model, View) {
    let scene = arch(0.09, 1.0, serde_json::json!({}));
    let m = model(&scene);
    let mut film = Film::new(8);
    let settings = SimulationSettings {
        fidelity: Some(Fidelity::Fast),
        every_step: true,
        keep_frames: false,
        ..SimulationSettings::default()
    };
    let outcome = simulate(&m, &settings, &mut |p| {
        p.moment.iter().for_each(|m| film.see(m));
        ControlFlow::Continue(())
    });
    let view = View::new(
        &m,
        &saved::simulated(&Default::default(), &scene, &m, None, &outcome.unwrap()).unwrap(),
        film.frames(),
    )
    .unwrap();
    (m, view)
}

#[test]
fn a_simulation_has_its_times() {
    let (m, view) = falling();
    assert!(view.film.len() > 2);
    let text = collection(&view, |k| format!("a & b/{k}.vtp"));
    let document = parsed(&text);
    let list: Vec<_> = all(document.root_element(), "DataSet").collect();
    let times: Vec<f64> =
        list.iter().map(|d| d.attribute("timestep").unwrap().parse().unwrap()).collect();
    assert_eq!(times, view.film.iter().map(|f| f.time).collect::<Vec<_>>());
    assert_eq!(list[1].attribute("file"), Some("a & b/1.vtp"));
    let mut speeds = Vec::new();
    for frame in &view.film {
        let text = moment(&view, frame);
        let file = File(parsed(&text));
        is_sound(&file, &view);
        surfaces_are_closed(&file, &m, 1.0);
        speeds.push(
            file.vectors("PointData", "velocity").iter().map(|v| v.norm()).fold(0.0, f64::max),
        );
    }
    assert!(speeds[0] == 0.0 && speeds[speeds.len() - 1] > 0.01, "{speeds:?}");
    let drawing = voussoir::report::drawing::svg(&view, Default::default());
    assert!(
        drawing.contains("after ") && drawing.contains("motion × "),
        "{}",
        &drawing[drawing.len() - 900..]
    );
}

/// What VTK itself makes of the files.
#[test]
fn vtk_reads_the_files() {
    let script = "import sys, vtk\nfor f in sys.argv[1:]:\n r = vtk.vtkXMLPolyDataReader(); r.SetFileName(f); r.Update(); o = r.GetOutput(); t = o.GetFieldData().GetAbstractArray(0).GetNumberOfValues()\n print(r.GetErrorCode(), o.GetNumberOfPoints(), o.GetNumberOfVerts(), o.GetNumberOfLines(), o.GetNumberOfPolys(), o.GetPointData().GetNumberOfArrays(), t)";
    let python = |args: &[&str]| {
        Command::new("python3").args(args).output().ok().filter(|o| o.status.success())
    };
    if python(&["-c", "import vtk"]).is_none() {
        crate::skipped("python3 has no module vtk");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let falling = falling().1;
    let last = moment(&falling, falling.film.last().unwrap());
    let [arch, ball] =
        [limited(&arch(0.15, 1.0, serde_json::json!({}))).1, assessed(&ball_on_box()).1];
    for (view, text) in [(&arch, vtp(&arch)), (&ball, vtp(&ball)), (&falling, last)] {
        let path = folder.path().join("view.vtp");
        std::fs::write(&path, &text).unwrap();
        let file = File(parsed(&text));
        let read = python(&["-c", script, path.to_str().unwrap()]).expect("VTK reads it");
        assert!(read.stderr.is_empty(), "{}", String::from_utf8_lossy(&read.stderr));
        let arrays =
            all(all(file.0.root_element(), "PointData").next().unwrap(), "DataArray").count();
        let counts = ["NumberOfPoints", "NumberOfVerts", "NumberOfLines", "NumberOfPolys"]
            .map(|what| file.count(what).to_string());
        assert_eq!(
            String::from_utf8(read.stdout).unwrap().trim(),
            format!("0 {} {arrays} {}", counts.join(" "), view.bodies.len())
        );
    }
}
