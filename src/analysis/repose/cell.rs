//! Homogeneous shear in a periodic cell: grains without walls and without gravity.
//!
//! Loose grains are compressed from all sides until they rest under the pressure P; then the cell is
//! sheared at a constant inertial number I = d γ̇ √(ρ/P), and its height follows so that the stress
//! across the planes of shear stays P. After a strain of one the flow is steady; means are over the
//! strain that follows, their errors by stretches of it.
//!
//! Grains are soft spheres of the stiffness number κ = (E / (1 − ν²) P)^{2/3} (Agnolin & Roux 2007).
//! Beside the result stands what has been published:
//!
//! * without friction, in slow flow, an angle of 5.76° ± 0.22°: P.-E. Peyneau, J.-N. Roux,
//!   *Frictionless bead packs have macroscopic friction, but no dilatancy*, Physical Review E 78
//!   (2008) 011307;
//! * with friction, μ(I) = μ_s + (μ_2 − μ_s) / (I₀/I + 1) of glass beads: P. Jop, Y. Forterre,
//!   O. Pouliquen, *A constitutive law for dense granular flows*, Nature 441 (2006) 727.
//!
//! And: I. Agnolin, J.-N. Roux, *Internal states of model isotropic granular packings*, Physical Review
//! E 76 (2007) 061302; F. da Cruz, S. Emam, M. Prochnow, J.-N. Roux, F. Chevoir, *Rheophysics of dense
//! granular materials*, Physical Review E 72 (2005) 021309.

use super::seen::{Compressed, Flown, Published, steady};
use base::{error::InputError, tolerance::GRAIN_REST_ENERGY};
use dynamics::granular::{Flow, Poses};
use model::assembly::{Assembly, Solid};
use nalgebra::{UnitQuaternion, Vector3};
use scene::Protocol;
use spheres::{Cell, Drive, Grain, Law, Material, World, law::Friction, world::Setup};
use std::{f64::consts::PI, ops::ControlFlow};

/// Poisson's ratio of the grains.
const POISSON: f64 = 0.3;
/// Steps in the period of two grains pressed together by P d². Fewer: the dashpots of a grain that several
/// others touch overshoot, grains tremble, and what trembles slips: internal friction is too low, the more so
/// the slower the shear (docs/lab/spheres.md). More: time.
const STEPS: f64 = 40.0;
/// Compression ends when all stresses are within this of P, relative. Less: waves decide. More: the
/// cell has not come to its pressure.
const PRESSED: f64 = 0.01;
/// So long compression may take, d √(ρ/P).
const HORIZON: f64 = 2000.0;
/// Looks in a strain of one. More: time. Fewer: no course to draw.
const LOOKS: f64 = 200.0;
/// Shear strain until the flow is steady, and over which it is observed.
const STRAINS: [f64; 2] = [1.0, 4.0];
/// Looks over which the peak is read. Fewer: noise. More: a peak is cut.
const PEAK: usize = 10;
/// μ_s, μ_2 and I₀ of glass beads (Jop, Forterre & Pouliquen 2006).
const GLASS: [f64; 3] = [0.382, 0.643, 0.279];
/// Angle of grains without friction, degrees, and how well it is known (Peyneau & Roux 2008).
const FRICTIONLESS: [f64; 2] = [5.76, 0.22];

/// What became of a cell.
pub(super) struct Sheared {
    /// Nothing where it was stopped, or never came to rest.
    pub flown: Option<Flown>,
    /// Where the grains are.
    pub poses: Poses,
    /// As far as it came.
    pub flow: Flow,
}

/// Compresses and shears a cell of these edges, m.
pub(super) fn sheared(
    protocol: &Protocol,
    assembly: &Assembly,
    edges: [f64; 3],
    threads: usize,
    watch: &mut dyn FnMut(&Flow) -> ControlFlow<()>,
) -> Result<Sheared, InputError> {
    let mut run = Run::new(protocol, assembly, edges, threads)?;
    let flown = run.observe(watch)?;
    let still = UnitQuaternion::identity();
    let mut poses: Poses = assembly.blocks.iter().map(|b| Some((b.centroid, still))).collect();
    for (i, place) in assembly.free().zip(run.world.places()) {
        poses[i] = Some((*place, still));
    }
    Ok(Sheared { flown, poses, flow: run.flow(1) })
}

/// A cell on its way.
struct Run<'a> {
    protocol: &'a Protocol,
    world: World,
    /// P, Pa.
    pressure: f64,
    /// d √(ρ/P) and √(d/g), s.
    unit: f64,
    natural: f64,
    impedance: f64,
    /// Length of a step, s, and how many there have been.
    dt: f64,
    steps: usize,
    /// Volume of all grains, m³.
    solid: f64,
    /// m g d, J.
    energy: f64,
    restitution: f64,
}

impl<'a> Run<'a> {
    fn new(
        protocol: &'a Protocol,
        assembly: &Assembly,
        edges: [f64; 3],
        threads: usize,
    ) -> Result<Self, InputError> {
        let Protocol { diameter: d, density, stiffness, .. } = *protocol;
        let g = assembly.gravity.norm();
        let pressure = protocol.pressure * density * g * d;
        let young = stiffness.powf(1.5) * pressure * (1.0 - POISSON * POISSON);
        let material = Material { young, poisson: POISSON, restitution: protocol.restitution };
        let law = Law::new(&material);
        let grains: Vec<Grain> = assembly
            .free()
            .filter_map(|i| {
                let block = &assembly.blocks[i];
                let Solid::Sphere { radius, .. } = block.solid else { return None };
                Some(Grain {
                    at: block.centroid,
                    radius,
                    mass: block.mass,
                    velocity: Vector3::zeros(),
                    spin: Vector3::zeros(),
                })
            })
            .collect();
        let ends =
            |f: fn(f64, f64) -> f64, from| grains.iter().map(|g| 2.0 * g.radius).fold(from, f);
        let (least, greatest) = (ends(f64::min, f64::INFINITY), ends(f64::max, 0.0));
        let lightest = density * PI / 6.0 * least.powi(3);
        let dt = law.period(least, lightest, pressure * greatest * greatest) / STEPS;
        let solid = grains.iter().map(|g| 4.0 / 3.0 * PI * g.radius.powi(3)).sum();
        let friction = Friction { coefficient: protocol.friction, arm: protocol.rolling_arm * d };
        let setup = Setup {
            grains,
            walls: Vec::new(),
            cell: Cell::new(edges, [true; 3]),
            law,
            friction,
            gravity: Vector3::zeros(),
            step: dt,
            threads,
        };
        let unit = d * (density / pressure).sqrt();
        let refuse = |e: &dyn std::fmt::Display| {
            InputError::at(Default::default(), format!("the grains cannot be set up: {e}"))
                .hint("use more grains, or fewer threads")
        };
        Ok(Self {
            protocol,
            world: World::new(setup).map_err(|e| refuse(&e))?,
            pressure,
            unit,
            natural: (d / g).sqrt(),
            // Bulk moduli of packings are of the order of κ P.
            impedance: (density * stiffness * pressure).sqrt(),
            dt,
            steps: 0,
            solid,
            energy: density * PI / 6.0 * d.powi(3) * g * d,
            restitution: law.restitution,
        })
    }

    fn advance(&mut self, steps: usize) -> Result<(), InputError> {
        self.steps += steps;
        self.world.run(steps).map_err(|narrow| {
            InputError::at(Default::default(), narrow.to_string()).hint("use more grains")
        })
    }

    fn flow(&self, stage: usize) -> Flow {
        let n = self.world.places().len() as f64;
        Flow {
            stage,
            time: self.steps as f64 * self.dt / self.natural,
            energy: self.world.energy() / n / self.energy,
        }
    }

    /// Both stages; nothing where they were stopped or never came to rest.
    fn observe(
        &mut self,
        watch: &mut dyn FnMut(&Flow) -> ControlFlow<()>,
    ) -> Result<Option<Flown>, InputError> {
        let Some(compressed) = self.compress(watch)? else { return Ok(None) };
        self.shear(compressed, watch)
    }

    fn compress(
        &mut self,
        watch: &mut dyn FnMut(&Flow) -> ControlFlow<()>,
    ) -> Result<Option<Compressed>, InputError> {
        let p = self.pressure;
        self.world.drive(Drive { pressure: [Some(p); 3], impedance: self.impedance, shear: 0.0 });
        let every = (self.unit / self.dt).ceil() as usize;
        let d3 = self.protocol.diameter.powi(3);
        for _ in 0..HORIZON as usize {
            self.advance(every)?;
            if watch(&self.flow(0)).is_break() {
                return Ok(None);
            }
            let stress = self.world.stress();
            let pressed = (0..3).all(|k| (stress[(k, k)] - p).abs() < PRESSED * p);
            let rest = GRAIN_REST_ENERGY * p * d3 * self.world.places().len() as f64;
            if pressed && self.world.energy() < rest {
                let [coordination, backbone] = self.coordination();
                let solid_fraction = self.solid / self.world.cell().volume();
                return Ok(Some(Compressed { solid_fraction, coordination, backbone }));
            }
        }
        Ok(None)
    }

    fn shear(
        &mut self,
        compressed: Compressed,
        watch: &mut dyn FnMut(&Flow) -> ControlFlow<()>,
    ) -> Result<Option<Flown>, InputError> {
        let inertial_number = self.protocol.rate();
        let shear = inertial_number / self.unit;
        let pressure = [None, None, Some(self.pressure)];
        self.world.drive(Drive { pressure, impedance: self.impedance, shear });
        let every = ((1.0 / LOOKS / shear / self.dt).round() as usize).max(1);
        let looks = ((STRAINS[0] + STRAINS[1]) * LOOKS) as usize;
        let (mut rows, mut contacts, mut normal) = (Vec::new(), Vec::new(), Vec::new());
        let mut overlap = 0.0_f64;
        for look in 1..=looks {
            self.advance(every)?;
            if watch(&self.flow(1)).is_break() {
                return Ok(None);
            }
            let stress = self.world.stress();
            let strain = (look * every) as f64 * self.dt * shear;
            let fraction = self.solid / self.world.cell().volume();
            rows.push([strain, -stress[(0, 2)] / stress[(2, 2)], fraction]);
            normal.push(stress[(2, 2)]);
            contacts.push(self.coordination()[0]);
            overlap = overlap.max(self.world.overlap());
        }
        let late = (STRAINS[0] * LOOKS) as usize;
        let column = |k: usize| rows[late..].iter().map(|r| r[k]).collect::<Vec<f64>>();
        let means = rows.windows(PEAK).map(|w| w.iter().map(|r| r[1]).sum::<f64>() / PEAK as f64);
        let peak = means.fold(f64::NEG_INFINITY, f64::max);
        let (Some(friction), Some(solid_fraction), Some(coordination)) =
            (steady(&column(1)), steady(&column(2)), steady(&contacts[late..]))
        else {
            return Ok(None);
        };
        Ok(Some(Flown {
            compressed,
            inertial_number,
            friction,
            solid_fraction,
            coordination,
            peak,
            published: published(self.protocol.friction, inertial_number),
            restitution: self.restitution,
            overlap: overlap / self.protocol.diameter,
            steps: self.world.steps_in_shortest_period(),
            normal_stress: normal[late..].iter().sum::<f64>() / normal[late..].len() as f64,
            course: rows,
        }))
    }

    /// Contacts a grain, and the same without grains that fewer than so many contacts cannot hold:
    /// two with friction, four without.
    fn coordination(&self) -> [f64; 2] {
        let n = self.world.places().len();
        let least = if self.protocol.friction > 0.0 { 2 } else { 4 };
        let mut left: Vec<[usize; 2]> =
            self.world.contacts().map(|c| [c.first, c.second]).collect();
        let all = 2.0 * left.len() as f64 / n as f64;
        let mut count = vec![0; n];
        left.iter().flatten().for_each(|i| count[*i] += 1);
        loop {
            let before = left.len();
            left.retain(|pair| {
                let stays = pair.iter().all(|i| count[*i] >= least);
                if !stays {
                    pair.iter().for_each(|i| count[*i] -= 1);
                }
                stays
            });
            if left.len() == before {
                break;
            }
        }
        let bearing = count.iter().filter(|c| **c > 0).count().max(1);
        [all, 2.0 * left.len() as f64 / bearing as f64]
    }
}

/// What stands beside it.
fn published(friction: f64, inertial_number: f64) -> Published {
    if friction == 0.0 {
        let [angle, error] = FRICTIONLESS;
        let source =
            format!("slow flow without friction, {angle}° ± {error}° (Peyneau & Roux 2008)");
        return Published { friction: angle.to_radians().tan(), source };
    }
    let [slow, fast, at] = GLASS;
    Published {
        friction: slow + (fast - slow) / (at / inertial_number + 1.0),
        source: "μ(I) of glass beads (Jop, Forterre & Pouliquen 2006)".into(),
    }
}
