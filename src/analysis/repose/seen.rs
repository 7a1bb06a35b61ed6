//! What grains show while they flow: the dynamic angle of a drum, the discharge of a hopper, the
//! resistance of a shear box, the steady flow in a cell.
//!
//! * W. A. Beverloo, H. A. Leniger, J. van de Velde, *The flow of granular solids through orifices*,
//!   Chemical Engineering Science 15 (1961) 260: `W = 0.58 ρ √g (D − 1.4 d)^2.5`, ρ the density of
//!   the bulk.

use super::surface::{CELL, Fit};
use dynamics::granular::Moment;
use model::assembly::Assembly;
use nalgebra::Vector2;
use scene::{Protocol, ProtocolKind, generate::bed_split};
use serde::{Deserialize, Serialize};
use std::{collections::BTreeMap, f64::consts::PI};

/// A drum turns by so much before it is measured, degrees.
const DRUM_STARTS: f64 = 90.0;

/// A shear box is pushed by this share of its length. More: less than four fifths of the halves lie
/// over each other. Less: the residual resistance is not reached.
pub(super) const SHEARED: f64 = 0.2;

/// Fewest steps in the shortest period of a contact. Fewer: damping is not followed, grains tremble
/// (docs/lab/spheres.md). More: runs of stiff grains that are good enough are refused.
const FOLLOWED: f64 = 20.0;

/// Coefficient of Beverloo's correlation, and diameters by which the orifice is smaller for grains.
const BEVERLOO: [f64; 2] = [0.58, 1.4];
/// The discharge is steady between these shares of what was filled in. Less: grains still set off.
/// More: the bed is lower than the bin is wide.
const STEADY: [f64; 2] = [0.1, 0.5];
/// Stretches into which a steady course is divided to tell how well its mean is known.
const STRETCHES: usize = 6;
/// Steps of the way of a shear box.
const STEPS: usize = 40;
/// Share of the way, at its end, over which the resistance is residual.
const RESIDUAL: f64 = 0.4;
/// A mean is known where its standard error is less than this share of it. More: no figure to
/// compare with anything. Less: hundreds of grains never suffice.
const KNOWN: f64 = 0.05;

/// A mean over a steady course with its standard error, from stretches of it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Steady {
    /// The mean.
    pub mean: f64,
    /// Its standard error.
    pub error: f64,
}

/// What was seen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Seen {
    /// The surface of a drum that turns.
    Drum {
        /// Slope of the middle half of its surface, degrees.
        angle_deg: Steady,
        /// The same by the centre of mass of all grains, which lies below the middle of a plane
        /// surface.
        by_centre_deg: Steady,
        /// Standard deviation of the slope over the time, degrees: avalanches.
        wavers_deg: f64,
        /// ω² R / g.
        froude: f64,
        /// By the angle turned, degrees: the slope, degrees.
        course: Vec<[f64; 2]>,
    },
    /// What runs out of a bin.
    Hopper {
        /// kg/s.
        rate: Steady,
        /// Density of the bulk before it flowed, kg/m³.
        bulk_density: f64,
        /// Beverloo's rate for that density, kg/s.
        beverloo: f64,
        /// By time from the opening, s: what has run out, kg.
        course: Vec<[f64; 2]>,
    },
    /// A shear box.
    Shear {
        /// Greatest ratio of shear to normal force on the way.
        peak: f64,
        /// Way to the peak, m.
        peak_at: f64,
        /// Ratio at the end.
        residual: Steady,
        /// Steepest rise of the lid over the way, degrees (dilatancy).
        dilatancy_deg: f64,
        /// Rise of the lid, m.
        rise: f64,
        /// Mean normal stress on the plane between the halves, Pa.
        normal_stress: f64,
        /// By way, m: ratio of shear to normal force, and rise of the lid, m.
        course: Vec<[f64; 3]>,
    },
    /// A cell that is sheared at constant pressure.
    Cell(Box<Flown>),
}

/// Grains before a cell is sheared.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Compressed {
    /// Share of the volume that grains fill.
    pub solid_fraction: f64,
    /// Contacts a grain.
    pub coordination: f64,
    /// The same among grains that bear something.
    pub backbone: f64,
}

/// The flow in a cell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Flown {
    /// At rest under the pressure from all sides.
    pub compressed: Compressed,
    /// Inertial number d γ̇ √(ρ/P).
    pub inertial_number: f64,
    /// Ratio of shear to normal stress of the steady flow.
    pub friction: Steady,
    /// Share of the volume that grains fill in it.
    pub solid_fraction: Steady,
    /// Contacts a grain in it.
    pub coordination: Steady,
    /// Greatest ratio of the stresses on the way, over a fiftieth of the strain.
    pub peak: f64,
    /// What has been published beside it.
    pub published: Published,
    /// Restitution of the contacts: the least that dashpots bring about where less was asked for.
    pub restitution: f64,
    /// Greatest overlap of two grains, d.
    pub overlap: f64,
    /// Steps in the shortest period of a contact.
    pub steps: f64,
    /// Normal stress across the shear planes, Pa.
    pub normal_stress: f64,
    /// By shear strain: ratio of shear to normal stress, and solid fraction.
    pub course: Vec<[f64; 3]>,
}

/// A ratio of shear to normal stress that was published.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Published {
    /// The ratio.
    pub friction: f64,
    /// Of what, and by whom.
    pub source: String,
}

impl Seen {
    /// Its figures by name, with the unit where they have one; always the same ones of a kind.
    pub fn figures(&self) -> Vec<(&'static str, f64)> {
        match self {
            Self::Drum { angle_deg, by_centre_deg, froude, .. } => vec![
                ("dynamic_angle_deg", angle_deg.mean),
                ("by_centre_deg", by_centre_deg.mean),
                ("froude", *froude),
            ],
            Self::Hopper { rate, bulk_density, beverloo, .. } => vec![
                ("rate_kg_per_s", rate.mean),
                ("rate_over_beverloo", rate.mean / beverloo),
                ("bulk_density", *bulk_density),
            ],
            Self::Shear { peak, residual, dilatancy_deg, .. } => vec![
                ("residual_friction", residual.mean),
                ("peak_friction", *peak),
                ("dilatancy_deg", *dilatancy_deg),
            ],
            Self::Cell(flown) => vec![
                ("internal_friction", flown.friction.mean),
                ("solid_fraction", flown.solid_fraction.mean),
                ("coordination", flown.coordination.mean),
                (
                    "internal_friction_over_published",
                    flown.friction.mean / flown.published.friction,
                ),
            ],
        }
    }

    /// Why it is no figure to use; nothing where it is one.
    pub fn doubts(&self) -> Vec<String> {
        let unknown = |what: &str, s: &Steady| {
            (s.error > KNOWN * s.mean.abs() || !s.error.is_finite()).then(|| {
                format!(
                    "{what} is too uncertain: {:.3} ± {:.3} (standard error), at most {} % is accepted: use more grains or a slower rate",
                    s.mean,
                    s.error,
                    100.0 * KNOWN
                )
            })
        };
        match self {
            Self::Drum { angle_deg, .. } => {
                unknown("the slope of the surface", angle_deg).into_iter().collect()
            }
            Self::Hopper { rate, .. } => unknown("the discharge", rate).into_iter().collect(),
            Self::Shear { residual, .. } => {
                unknown("the residual resistance", residual).into_iter().collect()
            }
            Self::Cell(flown) => {
                let coarse = (flown.steps < FOLLOWED).then(|| {
                    format!(
                        "contacts are followed in {:.0} steps of their shortest period, at least {FOLLOWED} are accepted: use stiffer grains or a slower rate",
                        flown.steps
                    )
                });
                let known = unknown("the internal friction", &flown.friction);
                known.into_iter().chain(coarse).collect()
            }
        }
    }
}

/// Looks at grains as they flow.
pub(super) struct Recorder<'a> {
    protocol: &'a Protocol,
    assembly: &'a Assembly,
    /// The upper half of a shear box with its lid.
    pushed: Vec<usize>,
    lid: Option<usize>,
    /// Angles and times, ways and times, masses: row by row.
    rows: Vec<[f64; 3]>,
    /// Density of the bulk, height of the lid at the start, mean normal force.
    start: Option<f64>,
    normal: Vec<f64>,
}

impl<'a> Recorder<'a> {
    pub fn new(
        protocol: &'a Protocol,
        assembly: &'a Assembly,
        gates: &[usize],
        lid: Option<usize>,
    ) -> Self {
        let pushed = gates.iter().copied().chain(lid).collect();
        Self { protocol, assembly, pushed, lid, rows: Vec::new(), start: None, normal: Vec::new() }
    }

    /// The grains that are there.
    fn grains<'b>(&'b self, moment: &'b Moment) -> impl Iterator<Item = usize> + 'b {
        let there = |i: &usize| moment.there[*i] && Some(*i) != self.lid;
        self.assembly.free().filter(there)
    }

    /// One look at a moment of the second stage.
    pub fn look(&mut self, moment: &Moment) {
        if moment.flow.stage != 1 {
            return;
        }
        let d = self.protocol.diameter;
        match self.protocol.kind {
            ProtocolKind::Drum => {
                if moment.turned.to_degrees() < DRUM_STARTS {
                    return;
                }
                if let Some([slope, centre]) = self.surface(moment) {
                    self.rows.push([moment.turned.to_degrees(), slope, centre]);
                }
            }
            ProtocolKind::Hopper => {
                if self.start.is_none() {
                    self.start = Some(self.bulk(moment));
                }
                let mass = |i: usize| self.assembly.blocks[i].mass;
                let all: f64 = self.assembly.free().map(mass).sum();
                let left: f64 = self.grains(moment).map(mass).sum();
                let time = moment.flow.time * (d / self.assembly.gravity.norm()).sqrt();
                self.rows.push([time, all - left, all]);
            }
            ProtocolKind::Shear => {
                let Some(lid) = self.lid else { return };
                let height = (moment.center)(lid).z;
                let start = *self.start.get_or_insert(height);
                let split = bed_split(self.protocol) * d;
                let above: f64 = self
                    .grains(moment)
                    .filter(|&i| (moment.center)(i).z > split)
                    .map(|i| self.assembly.blocks[i].mass)
                    .sum();
                let normal =
                    (above + self.assembly.blocks[lid].mass) * self.assembly.gravity.norm();
                let shear = -(moment.force)(&self.pushed).x;
                self.normal.push(normal);
                self.rows.push([moment.way, shear / normal, height - start]);
            }
            _ => {}
        }
    }

    /// Slope of the surface of a drum as gravity sees it, by the middle half of the surface and by
    /// the centre of mass; degrees.
    fn surface(&self, moment: &Moment) -> Option<[f64; 2]> {
        let d = self.protocol.diameter;
        let [across, width] = self.protocol.size().map(|s| s * d);
        let radius = 0.5 * across;
        // Back from the turning frame: about y, from z to x.
        let (sin, cos) = moment.turned.sin_cos();
        let seen = |i: usize| {
            let p = (moment.center)(i);
            (Vector2::new(p.x * cos + p.z * sin, p.z * cos - p.x * sin), p.y)
        };
        let spots: Vec<(Vector2<f64>, f64, f64)> = self
            .grains(moment)
            .map(|i| {
                let (at, y) = seen(i);
                (at, y, self.assembly.blocks[i].mass)
            })
            .collect();
        let mass: f64 = spots.iter().map(|s| s.2).sum();
        let centre = spots.iter().map(|s| s.0 * s.2).sum::<Vector2<f64>>() / mass;
        let up = -centre.try_normalize(0.0)?;
        let down = Vector2::new(up.y, -up.x);
        let lies = (-down.y).asin();
        // By strip across and step along the surface: the highest grain.
        let strips = (width / (2.0 * d)).round().max(1.0);
        let mut cells: BTreeMap<(usize, i64), (f64, f64)> = BTreeMap::new();
        for (at, y, _) in &spots {
            let (along, high) = (at.dot(&down), at.dot(&up));
            let strip = ((y / width + 0.5) * strips).clamp(0.0, strips - 1.0) as usize;
            let step = (along / (CELL * d)).round() as i64;
            let cell = cells.entry((strip, step)).or_insert((along, f64::NEG_INFINITY));
            if high > cell.1 {
                *cell = (along, high);
            }
        }
        let middle: Vec<f64> =
            cells.iter().filter(|((_, step), _)| *step == 0).map(|(_, c)| c.1).collect();
        let level = middle.iter().sum::<f64>() / middle.len().max(1) as f64;
        let reach = 0.5 * (radius.powi(2) - level.powi(2)).max(0.0).sqrt();
        let inner: Vec<(f64, f64)> =
            cells.into_values().filter(|(along, _)| along.abs() <= reach).collect();
        let fit = Fit::through(&inner, lies)?;
        Some([fit.slope.angle_deg, lies.to_degrees()])
    }

    /// Density of the bulk in a bin: between two heights, away from the floor and the surface.
    fn bulk(&self, moment: &Moment) -> f64 {
        let (d, bin) = (self.protocol.diameter, self.protocol.size()[0]);
        let mut heights: Vec<f64> = self.grains(moment).map(|i| (moment.center)(i).z).collect();
        heights.sort_by(f64::total_cmp);
        let top = heights.get(heights.len() * 9 / 10).copied().unwrap_or_default();
        let low = (2.0 * d).min(0.2 * top);
        let inside = |i: &usize| (low..top).contains(&(moment.center)(*i).z);
        let mass: f64 =
            self.grains(moment).filter(inside).map(|i| self.assembly.blocks[i].mass).sum();
        mass / ((top - low) * PI * (0.5 * bin * d).powi(2))
    }

    /// Whether there is nothing more to see: a hopper is not waited for until its last grain lies.
    pub fn is_complete(&self) -> bool {
        self.protocol.kind == ProtocolKind::Hopper
            && self.rows.last().is_some_and(|r| r[1] > STEADY[1] * r[2])
    }

    /// What was seen; `None` where there is too little of it.
    pub fn seen(&self) -> Option<Seen> {
        let (p, g) = (self.protocol, self.assembly.gravity.norm());
        let d = p.diameter;
        match p.kind {
            ProtocolKind::Drum => {
                let column = |k: usize| self.rows.iter().map(|r| r[k]).collect::<Vec<_>>();
                let angle_deg = steady(&column(1))?;
                let n = self.rows.len() as f64;
                let rest: f64 = self.rows.iter().map(|r| (r[1] - angle_deg.mean).powi(2)).sum();
                let rate = p.rate().to_radians() / (d / g).sqrt();
                Some(Seen::Drum {
                    angle_deg,
                    by_centre_deg: steady(&column(2))?,
                    wavers_deg: (rest / n).sqrt(),
                    froude: rate * rate * 0.5 * p.size()[0] * d / g,
                    course: self.rows.iter().map(|r| [r[0], r[1]]).collect(),
                })
            }
            ProtocolKind::Hopper => {
                let steady_part: Vec<&[f64; 3]> = self
                    .rows
                    .iter()
                    .filter(|r| (STEADY[0]..=STEADY[1]).contains(&(r[1] / r[2])))
                    .collect();
                let n = steady_part.len() / STRETCHES;
                if n < 2 || !self.is_complete() {
                    return None;
                }
                let rates: Vec<f64> = steady_part
                    .chunks(n)
                    .filter(|c| c.len() == n)
                    .map(|c| (c[n - 1][1] - c[0][1]) / (c[n - 1][0] - c[0][0]))
                    .collect();
                let bulk_density = self.start?;
                let free = p.size()[1] - BEVERLOO[1];
                Some(Seen::Hopper {
                    rate: of_stretches(&rates)?,
                    bulk_density,
                    beverloo: BEVERLOO[0] * bulk_density * g.sqrt() * (free * d).powf(2.5),
                    course: self.rows.iter().map(|r| [r[0], r[1]]).collect(),
                })
            }
            ProtocolKind::Shear => {
                let way = SHEARED * p.size()[0] * d;
                let mut steps: BTreeMap<usize, Vec<&[f64; 3]>> = BTreeMap::new();
                for row in &self.rows {
                    let step = ((row[0] / way * STEPS as f64) as usize).min(STEPS - 1);
                    steps.entry(step).or_default().push(row);
                }
                let mean = |rows: &Vec<&[f64; 3]>| {
                    [0, 1, 2].map(|k| rows.iter().map(|r| r[k]).sum::<f64>() / rows.len() as f64)
                };
                let course: Vec<[f64; 3]> = steps.values().map(mean).collect();
                let peak = course.iter().copied().max_by(|a, b| a[1].total_cmp(&b[1]))?;
                let late: Vec<f64> =
                    course.iter().filter(|r| r[0] > (1.0 - RESIDUAL) * way).map(|r| r[1]).collect();
                let rises = course.windows(4).map(|w| (w[3][2] - w[0][2]) / (w[3][0] - w[0][0]));
                Some(Seen::Shear {
                    peak: peak[1],
                    peak_at: peak[0],
                    residual: steady(&late)?,
                    dilatancy_deg: rises.fold(0.0, f64::max).atan().to_degrees(),
                    rise: course.last()?[2],
                    normal_stress: self.normal.iter().sum::<f64>()
                        / self.normal.len() as f64
                        / (p.size()[0] * p.size()[1] * d * d),
                    course,
                })
            }
            _ => None,
        }
    }
}

/// Mean and standard error of a course by its stretches.
pub(super) fn steady(values: &[f64]) -> Option<Steady> {
    let n = values.len() / STRETCHES;
    if n == 0 {
        return None;
    }
    let means: Vec<f64> = values
        .chunks(n)
        .filter(|c| c.len() == n)
        .map(|c| c.iter().sum::<f64>() / n as f64)
        .collect();
    of_stretches(&means)
}

fn of_stretches(means: &[f64]) -> Option<Steady> {
    let n = means.len() as f64;
    if means.len() < 2 {
        return None;
    }
    let mean = means.iter().sum::<f64>() / n;
    let rest: f64 = means.iter().map(|m| (m - mean).powi(2)).sum();
    Some(Steady { mean, error: (rest / (n - 1.0) / n).sqrt() })
}
