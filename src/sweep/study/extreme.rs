//! Stiff and extreme scenes with closed forms: columns, walls pushed out of their plane, arches at
//! their least thickness.
//!
//! *Columns and walls*, λ × own weight sideways: in joint `j` with contact width `b_j` at height
//! `z_j`, weights `w_i` above it at heights `z_i`, `λ = min_j min(μ_j, (b_j / 2) Σ w / Σ w (z_i −
//! z_j))`: contacts form a chain, so statics alone decides. *Arches* of straight-chord voussoirs
//! stand from a critical thickness on that depends on neither density, depth, size nor (above 0.4)
//! friction; values by the five-hinge closed form (class of Makris & Alexakis 2013).

use crate::keep::Kept;
use analysis::{Control, Law, Outcome, assess, limit};
use base::{error::RowsError, tolerance};
use check::verdict::Verdict;
use cholesky::parallel;
use model::interface::prepare;
use scene::{Scene, read_str};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::{collections::BTreeMap, path::Path};

/// One scene of the grid.
#[derive(Clone, Debug)]
pub struct Cell {
    /// Column, wall or arch.
    pub family: &'static str,
    /// What is extreme about it.
    pub what: String,
    /// What is asked.
    pub ask: CellQuestion,
    scene: Value,
}

/// The question about a cell, with its answer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CellQuestion {
    /// The load factor.
    LoadFactor(f64),
    /// Does it stand, at this relative distance from the critical value?
    Stands(bool, f64),
}

/// What came out of a cell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CellAnswer {
    /// Column, wall or arch.
    pub family: String,
    /// What is extreme about it.
    pub what: String,
    /// The question and its answer.
    pub ask: CellQuestion,
    /// What became of it.
    pub grade: CellGrade,
    /// The load factor, relative error, and bracket width over the value (absolute where the answer
    /// is 0).
    pub value: Option<f64>,
    /// |value − truth| / truth.
    pub error: Option<f64>,
    /// Width of the bracket over the truth.
    pub bracket: Option<f64>,
    /// Whether the truth lies in the proved bracket (up to rounding of the closed form).
    pub inside: Option<bool>,
    /// Iterations of the engine.
    pub iterations: usize,
    /// Seconds.
    pub seconds: f64,
}

/// What an answer is worth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CellGrade {
    /// Right, and its certificate holds.
    Right,
    /// No answer.
    Undecided,
    /// A wrong verdict, a load factor outside its bracket, or a certificate that fails.
    Wrong,
}

/// Rounding of the closed forms and of coordinates, over the truth.
const ROUNDING: f64 = 1e-9;

/// A verdict is asked only where the scene is out of balance by more than this, in multiples of
/// gravity: below, [`tolerance::EQUILIBRIUM_ERROR`] makes no difference between standing and falling.
const TELLING: f64 = 100.0 * tolerance::EQUILIBRIUM_ERROR;

/// The grid: some thousand cells.
pub fn grid() -> Vec<Cell> {
    let mut cells = Vec::new();
    for mass in [1e-9, 1e-3, 1.0, 1e3, 1e9] {
        for size in [1e-3, 1.0, 1e3] {
            for slenderness in [0.01, 1.0, 100.0] {
                for friction in [1e-3, 0.7, 100.0, 1e6] {
                    for blocks in [2, 10] {
                        column(&mut cells, blocks, mass, size, slenderness, friction);
                    }
                }
            }
        }
    }
    for blocks in [100, 400] {
        column(&mut cells, blocks, 1.0, 1.0, 1.0, 0.7);
    }
    for mass in [1e-6, 1.0, 1e6] {
        for thickness in [0.01, 0.5, 20.0] {
            for friction in [1e-3, 0.6, 100.0, 1e6] {
                for (courses, blocks) in [(3, 3), (8, 4)] {
                    wall(&mut cells, courses, blocks, mass, thickness, friction);
                }
            }
        }
    }
    for (voussoirs, critical) in CRITICAL {
        for friction in [0.8, 1e6] {
            for depth in [1e-3, 1.0, 1e3] {
                for (radius, density) in [(1e-3, 1e6), (1.0, 1.0), (1e3, 1e-3)] {
                    arch(&mut cells, voussoirs, critical, friction, depth, radius, density);
                }
            }
        }
    }
    cells
}

/// Critical t/R of semicircular arches by number of voussoirs.
const CRITICAL: [(usize, f64); 2] = [(16, 0.10707620314306167), (27, 0.10672090355137132)];

fn around(
    cells: &mut Vec<Cell>,
    family: &'static str,
    what: &str,
    critical: f64,
    make: impl Fn(f64) -> Value,
) {
    for distance in [1e-2, 1e-4, 1e-6] {
        if distance * critical < TELLING {
            continue;
        }
        for (stands, factor) in [(true, 1.0 - distance), (false, 1.0 + distance)] {
            cells.push(Cell {
                family,
                what: what.into(),
                ask: CellQuestion::Stands(stands, distance),
                scene: make(critical * factor),
            });
        }
    }
}

/// Blocks on a fixed one, sizes and densities in geometric progression from bottom to top.
fn column(
    cells: &mut Vec<Cell>,
    blocks: usize,
    mass: f64,
    size: f64,
    slenderness: f64,
    friction: f64,
) {
    let what = format!(
        "{blocks} blocks, mass ratio {mass:.0e}, size ratio {size:.0e}, slenderness {slenderness}, friction {friction}"
    );
    let share = |k: usize| k as f64 / (blocks - 1) as f64;
    let width = |k: usize| size.powf(share(k));
    // Masses, not densities, are in the ratio: densities follow from the volumes.
    let weight = |k: usize| mass.powf(share(k));
    let (mut z, mut list) = (
        0.0,
        vec![
            json!({ "id": "base", "support": true, "at": [0, 0, -0.5], "shape": { "box": { "size": [width(0), width(0), 1.0] } } }),
        ],
    );
    let (mut heights, mut floors) = (Vec::new(), Vec::new());
    for k in 0..blocks {
        let (w, h) = (width(k), width(k) * slenderness);
        list.push(
            json!({ "id": format!("b{k}"), "mass": weight(k), "at": [0, 0, z + h / 2.0], "shape": { "box": { "size": [w, w, h] } } }),
        );
        floors.push(z);
        heights.push(z + h / 2.0);
        z += h;
    }
    let critical = (0..blocks)
        .map(|j| {
            let contact = if j == 0 { width(0) } else { width(j).min(width(j - 1)) };
            let above: f64 = (j..blocks).map(weight).sum();
            let moment: f64 = (j..blocks).map(|i| weight(i) * (heights[i] - floors[j])).sum();
            friction.min(0.5 * contact * above / moment)
        })
        .fold(f64::INFINITY, f64::min);
    let scene = |loads: Value| json!({ "format": "voussoir-scene/1", "gravity": [0, 0, -1], "joints": { "default": { "friction": friction } }, "blocks": list, "loads": loads });
    cells.push(Cell {
        family: "column",
        what: what.clone(),
        ask: CellQuestion::LoadFactor(critical),
        scene: scene(json!({ "live": [{ "weight": [1, 0, 0] }] })),
    });
    around(cells, "column", &what, critical, |v| {
        scene(json!({ "dead": [{ "weight": [v, 0, 0] }] }))
    });
}

/// A running-bond wall pushed out of its plane, course densities in geometric progression.
fn wall(
    cells: &mut Vec<Cell>,
    courses: usize,
    length: usize,
    mass: f64,
    thickness: f64,
    friction: f64,
) {
    let what = format!(
        "{courses} × {length} blocks, mass ratio {mass:.0e}, thickness {thickness}, friction {friction}"
    );
    let (b, h) = (1.0, 0.4);
    let density = |c: usize| mass.powf(c as f64 / (courses - 1) as f64);
    let mut list = vec![
        json!({ "id": "base", "support": true, "at": [0.5 * length as f64, 0, -0.5], "shape": { "box": { "size": [length as f64, thickness, 1.0] } } }),
    ];
    for c in 0..courses {
        let ends: Vec<f64> = if c % 2 == 0 {
            (0..=length).map(|k| k as f64 * b).collect()
        } else {
            std::iter::once(0.0)
                .chain((0..length).map(|k| (k as f64 + 0.5) * b))
                .chain([length as f64 * b])
                .collect()
        };
        for (k, pair) in ends.windows(2).enumerate() {
            list.push(
                json!({ "id": format!("c{c}_{k}"), "density": density(c), "at": [0.5 * (pair[0] + pair[1]), 0, (c as f64 + 0.5) * h],
                "shape": { "box": { "size": [pair[1] - pair[0], thickness, h] } } }),
            );
        }
    }
    let critical = (0..courses)
        .map(|j| {
            let above: f64 = (j..courses).map(density).sum();
            let moment: f64 =
                (j..courses).map(|i| density(i) * ((i as f64 + 0.5) - j as f64) * h).sum();
            friction.min(0.5 * thickness * above / moment)
        })
        .fold(f64::INFINITY, f64::min);
    let scene = |loads: Value| json!({ "format": "voussoir-scene/1", "gravity": [0, 0, -1], "joints": { "default": { "friction": friction } }, "blocks": list, "loads": loads });
    cells.push(Cell {
        family: "wall",
        what: what.clone(),
        ask: CellQuestion::LoadFactor(critical),
        scene: scene(json!({ "live": [{ "weight": [0, 1, 0] }] })),
    });
    around(cells, "wall", &what, critical, |v| scene(json!({ "dead": [{ "weight": [0, v, 0] }] })));
}

/// A semicircular arch either side of its critical thickness.
fn arch(
    cells: &mut Vec<Cell>,
    voussoirs: usize,
    critical: f64,
    friction: f64,
    depth: f64,
    radius: f64,
    density: f64,
) {
    let what = format!(
        "{voussoirs} voussoirs, depth / radius {depth:.0e}, radius {radius} m, density {density:.0e}, friction {friction}"
    );
    for distance in [1e-2, 1e-4, 1e-6] {
        for (stands, factor) in [(true, 1.0 + distance), (false, 1.0 - distance)] {
            let scene = json!({ "format": "voussoir-scene/1", "materials": { "m": { "density": density } }, "joints": { "default": { "friction": friction } },
                "templates": [{ "arch": { "radius": radius, "thickness": radius * critical * factor, "depth": depth * radius, "embrace_deg": 180, "voussoirs": voussoirs, "material": "m" } }] });
            cells.push(Cell {
                family: "arch",
                what: what.clone(),
                ask: CellQuestion::Stands(stands, distance),
                scene,
            });
        }
    }
}

/// The file in which the answers of a grid are kept, with the number of each cell.
///
/// # Errors
/// As [`Kept::open`].
pub fn keep(path: &Path, cells: &[Cell]) -> Result<Kept<(usize, CellAnswer)>, RowsError> {
    Kept::open(path, "voussoir-extreme/1", json!({ "cells": cells.len() }))
}

/// Asks every cell, on all threads, but for those that are kept already; each is kept as it ends,
/// where there is a file, and `each` hears of it.
///
/// # Errors
/// Threads cannot be started, or the file cannot be written.
pub fn run(
    cells: &[Cell],
    kept: Option<&Kept<(usize, CellAnswer)>>,
    each: impl Fn(&CellAnswer) + Sync,
) -> Result<Vec<CellAnswer>, RowsError> {
    let there: BTreeMap<usize, &CellAnswer> =
        kept.iter().flat_map(|k| &k.there).map(|(index, found)| (*index, found)).collect();
    let numbered: Vec<(usize, &Cell)> = cells.iter().enumerate().collect();
    let found = parallel::try_map(0, &numbered, |(index, cell)| {
        if let Some(&found) = there.get(index) {
            return Ok(found.clone());
        }
        let found = (*index, cell.ask());
        kept.map_or(Ok(()), |kept| kept.append(&found))?;
        each(&found.1);
        Ok(found.1)
    });
    found.map_err(|e| RowsError::Threads { threads: 0, cause: e.to_string() })?
}

impl Cell {
    /// The scene of the cell.
    ///
    /// # Errors
    /// The grid made a scene that cannot be read, which would be a mistake in the grid.
    pub fn scene(&self) -> Result<Scene, base::error::InputError> {
        read_str(&self.what, self.scene.to_string()).map(|(scene, _)| scene)
    }

    /// Asks its question and grades the answer.
    pub fn ask(&self) -> CellAnswer {
        let start = std::time::Instant::now();
        let mut found = CellAnswer {
            family: self.family.into(),
            what: self.what.clone(),
            ask: self.ask,
            grade: CellGrade::Wrong,
            value: None,
            error: None,
            bracket: None,
            inside: None,
            iterations: 0,
            seconds: 0.0,
        };
        let Ok(model) = self.scene().and_then(|s| prepare(&s)) else { return found };
        let model = &model;
        let control = Control { law: Law::Associative, ..Control::default() };
        match self.ask {
            CellQuestion::Stands(stands, _) => {
                let a = assess(model, &control);
                found.iterations = a.attempts.iter().map(|a| a.iterations).sum();
                found.grade = match a.verdict {
                    Verdict::Stable if stands => CellGrade::Right,
                    Verdict::Unstable if !stands => CellGrade::Right,
                    // What was said and could not be proved is wrong, even where it is true.
                    Verdict::Conditional | Verdict::Undecided if a.refused().is_none() => {
                        CellGrade::Undecided
                    }
                    _ => CellGrade::Wrong,
                };
            }
            CellQuestion::LoadFactor(truth) => {
                let l = limit(model, &control);
                found.iterations = l.attempts.iter().map(|a| a.iterations).sum();
                if let Some(value) = l.value {
                    let inside = l.bracket.lower <= truth * (1.0 + ROUNDING)
                        && truth * (1.0 - ROUNDING) <= l.bracket.upper;
                    found.value = Some(value);
                    found.error = Some((value - truth).abs() / truth);
                    found.bracket = Some(l.bracket.width() / truth).filter(|b| b.is_finite());
                    found.inside = Some(inside);
                }
                let inside = found.inside == Some(true);
                found.grade = match l.outcome {
                    Outcome::Found if inside => CellGrade::Right,
                    // Not proved: the result file gives no number either.
                    Outcome::Undecided if inside || l.refused().is_none() => CellGrade::Undecided,
                    _ => CellGrade::Wrong,
                };
            }
        }
        found.seconds = start.elapsed().as_secs_f64();
        found
    }
}

/// The sums over a grid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CellCount {
    /// Cells.
    pub cells: usize,
    /// Right ones.
    pub right: usize,
    /// Without an answer.
    pub undecided: usize,
    /// Wrong ones.
    pub wrong: usize,
    /// Load factors asked for.
    pub load_factors: usize,
    /// Of those, brackets no wider than 1e-6 of the value.
    pub narrow: usize,
    /// Greatest relative error of a load factor that is right.
    pub error: f64,
    /// Most iterations.
    pub iterations: usize,
    /// Seconds, all cells.
    pub seconds: f64,
}

/// Counts the cells of one family, or of all.
pub fn count(found: &[CellAnswer], family: Option<&str>) -> CellCount {
    let mut c = CellCount::default();
    for f in found.iter().filter(|f| family.is_none_or(|name| f.family == name)) {
        c.cells += 1;
        match f.grade {
            CellGrade::Right => c.right += 1,
            CellGrade::Undecided => c.undecided += 1,
            CellGrade::Wrong => c.wrong += 1,
        }
        if matches!(f.ask, CellQuestion::LoadFactor(_)) {
            c.load_factors += 1;
            c.narrow += usize::from(f.bracket.is_some_and(|b| b <= tolerance::LOAD_FACTOR_WIDTH));
            if f.grade == CellGrade::Right {
                c.error = c.error.max(f.error.unwrap_or(0.0));
            }
        }
        c.iterations = c.iterations.max(f.iterations);
        c.seconds += f.seconds;
    }
    c
}
