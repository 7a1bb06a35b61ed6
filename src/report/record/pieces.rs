//! Blocks, materials and supports.

use super::{Part, Section, listed, quantity};
use base::number::{count, point, short};
use model::interface::Model;
use std::collections::BTreeMap;

/// Supports that are listed.
const SUPPORTS: usize = 12;

/// What a material sums up to: blocks, volume, mass, and the least and the greatest density.
struct Sum {
    blocks: usize,
    volume: f64,
    mass: f64,
    density: [f64; 2],
    /// Young's modulus (Pa) and Poisson's ratio, where it has them.
    elastic: Option<[f64; 2]>,
}

impl Sum {
    fn density(&self) -> String {
        match self.density[1] - self.density[0] <= 1e-9 * self.density[1] {
            true => short(self.density[0]),
            false => format!("{} to {}", short(self.density[0]), short(self.density[1])),
        }
    }
}

/// The materials of the free blocks by name.
fn sums(model: &Model) -> BTreeMap<&str, Sum> {
    let mut sums: BTreeMap<&str, Sum> = BTreeMap::new();
    for block in model.assembly.blocks.iter().filter(|b| !b.support) {
        let volume = block.solid.volume();
        let sum = sums.entry(block.material.as_deref().unwrap_or("")).or_insert(Sum {
            blocks: 0,
            volume: 0.0,
            mass: 0.0,
            density: [f64::INFINITY, 0.0],
            elastic: block.elastic.map(|e| [e.young, e.poisson]),
        });
        let density = block.mass / volume;
        (sum.blocks, sum.volume, sum.mass) =
            (sum.blocks + 1, sum.volume + volume, sum.mass + block.mass);
        sum.density = [sum.density[0].min(density), sum.density[1].max(density)];
    }
    sums
}

/// Materials that are named with their densities.
const MATERIALS: usize = 4;

/// The densities of the materials, in a few words.
pub(super) fn densities(model: &Model) -> String {
    let sums = sums(model);
    let words = |(name, s): (&&str, &Sum)| format!("{name} {} kg/m³", s.density());
    let mut list: Vec<String> = sums.iter().take(MATERIALS).map(words).collect();
    if sums.len() > MATERIALS {
        list.push(format!("… and {} more", count(sums.len() - MATERIALS, "material")));
    }
    list.join(", ").trim().into()
}

/// The section about what the scene is made of.
pub(super) fn section(model: &Model) -> Section {
    let assembly = &model.assembly;
    let sums = sums(model);
    let elastic = sums.values().any(|s| s.elastic.is_some());
    let row = |(name, s): (&&str, &Sum)| {
        let name = if name.is_empty() { "no name" } else { name };
        let mut cells =
            vec![name.into(), s.blocks.to_string(), s.density(), short(s.volume), short(s.mass)];
        if elastic {
            let none = || ["–".to_string(), "–".to_string()];
            cells.extend(s.elastic.map_or_else(none, |[e, nu]| [quantity(e, "Pa"), short(nu)]));
        }
        cells
    };
    let mut columns =
        vec!["material", "#free blocks", "#density, kg/m³", "#volume, m³", "#mass, kg"];
    if elastic {
        columns.extend(["#Young's modulus", "#Poisson's ratio"]);
    }
    let mass: f64 = sums.values().map(|s| s.mass).sum();
    let g = assembly.gravity.norm();
    let mut parts = vec![
        Part::Facts(vec![
            ["free blocks".into(), count(assembly.free().count(), "block")],
            ["their weight".into(), quantity(mass * g, "N")],
            [
                "gravity".into(),
                format!("{} m/s², along {}", short(g), point((assembly.gravity / g).into())),
            ],
        ]),
        Part::table(
            &columns,
            sums.iter().map(row).collect(),
            "Density is mass over volume, whether the scene gives it by material, by block or as a mass.",
        ),
    ];
    let supports: Vec<Vec<String>> = assembly
        .blocks
        .iter()
        .filter(|b| b.support)
        .map(|b| vec![b.id.clone(), point(b.centroid.into())])
        .collect();
    let note = "Supports are fixed, except where the question imposes a movement.";
    parts.push(Part::table(&["support", "centre, m"], listed(supports, SUPPORTS), note));
    Section::new("Blocks, materials, supports", parts)
}
