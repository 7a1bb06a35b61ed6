//! Grains as other programs read them: a table (CSV), points (VTK), a dump of LIGGGHTS or LAMMPS.
//!
//! One row a sphere; the spheres of a clump are rows with the same number of a grain. A grain with
//! faces stands there as the sphere of its volume, which [`Row::shape`] says. Walls are left out.
//! `voussoir import` and `repose --start` read tables and dumps back.
//!
//! * LIGGGHTS 3.8 and LAMMPS, command `dump custom`: a head of items, then one line a particle with
//!   the columns that its head names.

use super::{
    cells::{Cell, Table},
    vtk,
};
use base::error::{InputError, JsonPath};
use model::assembly::{self, Solid};
use nalgebra::Vector3;
use scene::Scene;
use std::{fmt::Write, path::Path};

/// What is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GrainFormat {
    /// A table.
    #[default]
    Csv,
    /// Points for ParaView.
    Vtk,
    /// A dump of LIGGGHTS.
    Dump,
}

impl GrainFormat {
    /// By the ending of the file; a table where it says nothing.
    pub fn of(path: Option<&Path>) -> Self {
        let ending = path.and_then(|p| p.extension()).map(|e| e.to_ascii_lowercase());
        match ending.as_deref().and_then(|e| e.to_str()) {
            Some("vtp") => Self::Vtk,
            Some("dump" | "liggghts" | "lammpstrj") => Self::Dump,
            _ => Self::Csv,
        }
    }

    /// The usual ending.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Vtk => "vtp",
            Self::Dump => "dump",
        }
    }
}

/// A sphere.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Name of the grain.
    pub id: String,
    /// Number of the grain, from 1.
    pub grain: usize,
    /// m.
    pub center: Vector3<f64>,
    /// m.
    pub radius: f64,
    /// Of the whole grain, kg.
    pub mass: f64,
    /// Whether it is held in place.
    pub fixed: bool,
    /// `sphere`, `clump` or `hull`.
    pub shape: &'static str,
}

/// The grains of a scene, in its order.
///
/// # Errors
/// The scene cannot be resolved.
pub fn rows(scene: &Scene) -> Result<Vec<Row>, InputError> {
    let assembly = assembly::resolve(scene)?;
    let mut rows = Vec::new();
    let mut grain = 0;
    for block in &assembly.blocks {
        let (shape, spheres) = match &block.solid {
            Solid::Sphere { center, radius } => ("sphere", vec![(*center, *radius)]),
            Solid::Clump { balls, .. } => ("clump", balls.clone()),
            // A wall.
            Solid::Polyhedron(_) if block.support => continue,
            Solid::Polyhedron(solid) => {
                let volume = solid.mass_properties().volume;
                let radius = (volume / (4.0 / 3.0 * std::f64::consts::PI)).cbrt();
                ("hull", vec![(block.centroid, radius)])
            }
        };
        grain += 1;
        rows.extend(spheres.into_iter().map(|(center, radius)| Row {
            id: block.id.clone(),
            grain,
            center,
            radius,
            mass: block.mass,
            fixed: block.support,
            shape,
        }));
    }
    if rows.is_empty() {
        let text = "there is no grain: every block is a support with faces";
        return Err(InputError::at(JsonPath::root(), text)
            .hint("grains are spheres, clumps, and free blocks"));
    }
    Ok(rows)
}

/// The file.
///
/// # Errors
/// The scene cannot be resolved, or has no grains.
pub fn written(scene: &Scene, format: GrainFormat) -> Result<String, InputError> {
    let rows = rows(scene)?;
    match format {
        GrainFormat::Csv => csv(&rows).map_err(|e| InputError::at(JsonPath::root(), e.to_string())),
        GrainFormat::Vtk => Ok(vtk::grains::vtp(&rows)),
        GrainFormat::Dump => Ok(dump(&rows)),
    }
}

fn csv(rows: &[Row]) -> Result<String, csv::Error> {
    let head = ["id", "grain", "x", "y", "z", "radius", "mass", "fixed", "shape"];
    let mut table = Table::with_head(head)?;
    for row in rows {
        let [x, y, z]: [f64; 3] = row.center.into();
        let mut cells: Vec<Cell> = vec![row.id.as_str().into(), row.grain.into()];
        cells.extend([x, y, z, row.radius, row.mass].map(Cell::from));
        cells.extend([usize::from(row.fixed).into(), row.shape.into()]);
        table.write_record(cells)?;
    }
    table.end()
}

/// Free spheres are of type 1, fixed ones of type 2; `mol` is the grain that a sphere belongs to.
fn dump(rows: &[Row]) -> String {
    let mut text = format!("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{}\n", rows.len());
    text.push_str("ITEM: BOX BOUNDS ff ff ff\n");
    for k in 0..3 {
        let low = rows.iter().map(|r| r.center[k] - r.radius).fold(f64::INFINITY, f64::min);
        let high = rows.iter().map(|r| r.center[k] + r.radius).fold(f64::NEG_INFINITY, f64::max);
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{low} {high}");
    }
    text.push_str("ITEM: ATOMS id type mol x y z radius mass\n");
    for (k, r) in rows.iter().enumerate() {
        let kind = 1 + u8::from(r.fixed);
        let [x, y, z]: [f64; 3] = r.center.into();
        let _ = writeln!(text, "{} {kind} {} {x} {y} {z} {} {}", k + 1, r.grain, r.radius, r.mass);
    }
    text
}
