//! What the readers of all formats hand over: blocks and interfaces in the coordinates of the file.

use super::{ImportOptions, Up};
use crate::{InterfaceSpec, Load, Material, Member, StageSpec};
use base::{
    error::{Finding, FindingCode},
    plane::Sets,
};
use std::collections::{BTreeMap, HashMap, HashSet};

/// The content of one file.
#[derive(Debug, Default)]
pub(super) struct Raw {
    /// File name without folder and extension.
    pub stem: String,
    /// The file as the user gave it.
    pub name: String,
    /// File name and format, for `source`.
    pub origin: String,
    /// Metres in a unit of the file, where it names one.
    pub unit: Option<f64>,
    /// The axis that points up, where the format says it.
    pub up: Option<Up>,
    /// Gravity, m/s², in the axes of the file.
    pub gravity: Option<[f64; 3]>,
    pub blocks: Vec<Solid>,
    pub grains: Vec<Grain>,
    pub planes: Vec<Ground>,
    pub interfaces: Vec<InterfaceSpec>,
    /// How many of them hold solved forces, which are not read.
    pub with_forces: usize,
    pub materials: BTreeMap<String, Material>,
    /// Surfaces of materials, by their names.
    pub surfaces: BTreeMap<String, Surface>,
    pub members: Vec<Member>,
    /// Live loads.
    pub loads: Vec<Load>,
    /// Dead loads.
    pub dead: Vec<Load>,
    /// Stages of construction.
    pub stages: Vec<StageSpec>,
    pub findings: Vec<Finding>,
}

/// A block as a mesh.
#[derive(Debug, Default)]
pub(super) struct Solid {
    pub id: String,
    pub vertices: Vec<[f64; 3]>,
    pub faces: Vec<Vec<usize>>,
    pub support: bool,
    pub material: Option<String>,
    pub heft: Heft,
    /// Where it begins in the file: a line, counted from 1.
    pub line: Option<usize>,
    /// The line of each face, where faces have lines.
    pub lines: Vec<usize>,
}

/// What a file says of the mass of a block.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Heft {
    /// kg/m³.
    pub density: Option<f64>,
    /// kg; goes before the density.
    pub mass: Option<f64>,
    /// Centre of mass, where it is not that of the shape, in the coordinates of the file.
    pub centroid: Option<[f64; 3]>,
}

/// How the friction of two surfaces makes that of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rule {
    /// The greater one, as MuJoCo does.
    Greater,
    /// The lesser one, as Gazebo does with ODE.
    Lesser,
}

/// The surface of a block, where files give friction to blocks and not to pairs of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Surface {
    /// Coefficient of friction.
    pub friction: f64,
    /// That of the higher priority decides alone (MuJoCo).
    pub priority: i64,
    /// Without friction against others that are (MuJoCo, `condim="1"`).
    pub is_smooth: bool,
    pub rule: Rule,
}

/// An unbounded plane that holds.
#[derive(Debug)]
pub(super) struct Ground {
    pub id: String,
    pub at: [f64; 3],
    /// Out of the ground.
    pub normal: [f64; 3],
    pub material: Option<String>,
    pub line: usize,
}

/// Spheres of one block: centres and radii.
#[derive(Debug, Default)]
pub(super) struct Grain {
    pub id: String,
    pub spheres: Vec<([f64; 3], f64)>,
    pub support: bool,
    pub material: Option<String>,
    pub heft: Heft,
    /// Where it begins in the file: a line, counted from 1.
    pub line: usize,
}

impl Raw {
    /// What its coordinates are multiplied by.
    pub fn scale(&self, options: &ImportOptions) -> f64 {
        options.scale.or(self.unit).unwrap_or(1.0)
    }

    /// The axis that is turned up.
    pub fn up(&self, options: &ImportOptions) -> Up {
        options.up.or(self.up).unwrap_or_default()
    }

    /// Whether it holds nothing that a scene is made of.
    pub fn is_empty(&self) -> bool {
        self.blocks.is_empty() && self.grains.is_empty() && self.planes.is_empty()
    }

    pub fn say(&mut self, code: FindingCode, text: impl Into<String>) {
        self.findings.push(Finding::new(code, text));
    }

    /// Makes the ids unique by numbers at their end; empty ids become `fallback`. Says how many
    /// were changed.
    pub fn name_apart(&mut self, fallback: &str) {
        let mut taken: HashSet<String> = self.blocks.iter().map(|b| b.id.clone()).collect();
        let mut seen = HashSet::new();
        let mut renamed = Vec::new();
        let mut next: BTreeMap<String, usize> = BTreeMap::new();
        for block in &mut self.blocks {
            let unnamed = block.id.is_empty();
            if !unnamed && seen.insert(block.id.clone()) {
                continue;
            }
            let base = if unnamed { fallback.to_string() } else { block.id.clone() };
            let number = next.entry(base.clone()).or_insert(if unnamed { 1 } else { 2 });
            let id = loop {
                let id = format!("{base}-{number}");
                *number += 1;
                if taken.insert(id.clone()) {
                    break id;
                }
            };
            renamed.push(format!("{:?} → {id:?}", block.id));
            block.id = id;
        }
        if !renamed.is_empty() {
            let text = format!("blocks without a name of their own, renamed: {}", tally(&renamed));
            self.say(FindingCode::Converted, text);
        }
    }

    /// Says which blocks consist of parts that share no corner.
    pub fn say_parts(&mut self) {
        let several: Vec<String> = self
            .blocks
            .iter()
            .filter_map(|b| {
                let parts = parts(&b.vertices, &b.faces).iter().copied().max().map_or(0, |m| m + 1);
                (parts > 1).then(|| format!("{:?} ({parts} parts)", b.id))
            })
            .collect();
        if !several.is_empty() {
            let text = format!(
                "blocks of several parts that share no corner, kept as one rigid block each: {}; if the parts are separate blocks, export them as separate objects",
                tally(&several)
            );
            self.say(FindingCode::Converted, text);
        }
    }
}

/// How many, and the first few of them: `12 (a, b, …)`.
pub(super) fn tally(names: &[String]) -> String {
    format!("{} ({})", names.len(), list(names))
}

/// The first few of many names.
pub(super) fn list(names: &[String]) -> String {
    const SHOWN: usize = 8;
    let mut text = names.iter().take(SHOWN).cloned().collect::<Vec<_>>().join(", ");
    if names.len() > SHOWN {
        text.push_str(&format!(", … ({} more)", names.len() - SHOWN));
    }
    text
}

/// A solid has at least so many faces.
pub(super) const LEAST_FACES: usize = 4;

/// Which connected part every face belongs to, numbered by first appearance: two faces are
/// connected when they share a corner's index, and where that leaves fewer than [`LEAST_FACES`] faces
/// when they share its place.
pub(super) fn parts(vertices: &[[f64; 3]], faces: &[Vec<usize>]) -> Vec<usize> {
    let mut sets = Sets::new(vertices.len());
    for face in faces {
        for pair in face.windows(2) {
            sets.join(pair[0], pair[1]);
        }
    }
    // Faces too few for a solid belong to what has corners where they have theirs: programs that
    // write corners once for every face.
    let mut count: HashMap<usize, usize> = HashMap::new();
    for corner in faces.iter().filter_map(|f| f.first()) {
        *count.entry(sets.find(*corner)).or_default() += 1;
    }
    let crumbs: HashSet<usize> =
        count.into_iter().filter(|&(_, n)| n < LEAST_FACES).map(|(part, _)| part).collect();
    if !crumbs.is_empty() {
        let mut places: HashMap<[u64; 3], Vec<usize>> = HashMap::new();
        for &corner in faces.iter().flatten() {
            let place = vertices[corner].map(|c| (c + 0.0).to_bits());
            places.entry(place).or_default().push(corner);
        }
        let mut broken = |c: &usize| crumbs.contains(&sets.find(*c));
        places.retain(|_, corners| corners.iter().any(&mut broken));
        for corners in places.values() {
            for &c in corners {
                sets.join(corners[0], c);
            }
        }
    }
    let mut number = BTreeMap::new();
    faces
        .iter()
        .map(|face| {
            let next = number.len();
            face.first().map_or(0, |&corner| *number.entry(sets.find(corner)).or_insert(next))
        })
        .collect()
}

/// A solid of the given faces that keeps only the corners they use, in their old order.
/// `lines` are those of the faces.
pub(super) fn compact(
    id: String,
    lines: Vec<usize>,
    all: &[[f64; 3]],
    mut faces: Vec<Vec<usize>>,
) -> Solid {
    let mut used: Vec<usize> = faces.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    for corner in faces.iter_mut().flatten() {
        // Every corner is in `used` by construction.
        *corner = used.partition_point(|&u| u < *corner);
    }
    let vertices = used.iter().map(|&i| all[i]).collect();
    Solid { id, vertices, faces, line: lines.first().copied(), lines, ..Solid::default() }
}
