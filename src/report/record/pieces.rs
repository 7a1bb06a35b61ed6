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

/// The section about what the scene is made of.
pub(super) fn section(model: &Model) -> Section {
    let assembly = &model.assembly;
    let mut sums: BTreeMap<&str, Sum> = BTreeMap::new();
    for block in assembly.blocks.iter().filter(|b| !b.support) {
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
    let elastic = sums.values().any(|s| s.elastic.is_some());
    let row = |(name, s): (&&str, &Sum)| {
        let name = if name.is_empty() { "no name" } else { name };
        let density = if s.density[1] - s.density[0] <= 1e-9 * s.density[1] {
            short(s.density[0])
        } else {
            format!("{} to {}", short(s.density[0]), short(s.density[1]))
        };
        let mut cells =
            vec![name.into(), s.blocks.to_string(), density, short(s.volume), short(s.mass)];
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
