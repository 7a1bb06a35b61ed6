//! The angle of repose: the slope that a heap leaves behind which flowed and came to rest.
//!
//! A heap is made by a [`Protocol`] in the dynamics. Its free surface is the highest grain of every
//! cell; the cells at wall and toe are dropped and a straight line is fitted along each of
//! several paths (strips from the wall to the edge, or sectors from the middle) and through their
//! mean. Whether that line is an angle of repose or an artefact is judged in [`judge`]. The heap at
//! rest is then a scene like any other, and its static margin, the tilt that it
//! still bears, is asked for as a cross-check by a method that shares nothing with the dynamics but
//! the places of the grains.

mod cell;
pub mod confirm;
pub mod judge;
pub mod seen;
mod surface;

pub use surface::Slope;

use super::{
    Control, Outcome, Tilt,
    stability::{held, without},
    tilt,
};
use base::{
    error::{Finding, FindingCode, InputError},
    tolerance::GRAIN_GAP,
};
use cell::Sheared;
use confirm::Confirmed;
use dynamics::granular::{Course, Disturbance, Flow, Moment, Poses, flow};
use model::{assembly, interface::prepare};
use nalgebra::{Unit, UnitQuaternion, Vector3};
use scene::{
    BlockSpec, Protocol, ProtocolKind, Rotation, Scene,
    generate::{Deposit, deposit, filled},
};
use seen::{Recorder, SHEARED, Seen};
use serde::{Deserialize, Serialize};
use solve::clock::Instant;
use std::{collections::BTreeMap, ops::ControlFlow};

/// A stage may take so many √(d/g) to come to rest.
const HORIZON: f64 = 400.0;

/// A drum turns by so much while it is measured, degrees.
const DRUM_TURNS: f64 = 270.0;

/// √(d/g) between two layers that are poured from 3 d, in which a grain falls so far; from elsewhere
/// by the root of the height. Less: each would begin above one that still falls, higher and higher.
const POUR: f64 = 2.5;
/// Rounds in which grains that nothing balances are left out. More: a heap that really falls is
/// taken apart.
const UNBALANCED: usize = 4;

/// The free surface of a heap as its slope was read from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    /// The mean of the highest grains, step by step down the slope, m.
    pub surface: Vec<Vector3<f64>>,
    /// The ends of the straight line through it, m.
    pub line: [Vector3<f64>; 2],
    /// The slope of that line.
    pub slope: Slope,
}

/// A heap and its slope.
#[derive(Clone, Debug, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Heap {
    /// Its seed.
    pub seed: u64,
    /// The heap as it lies, an explicit scene.
    pub scene: Scene,
    /// Whether it came to rest. Where it did not, nothing below means anything.
    pub rested: bool,
    /// Mean kinetic energy of a grain at the end over m g d.
    pub energy: f64,
    /// Time simulated over √(d/g).
    pub time: f64,
    /// Seconds that the simulation took.
    pub seconds: f64,
    /// Free grains that stayed, and those that fell over the edge.
    pub grains: [usize; 2],
    /// The slope through the mean surface; `None` where it is no angle of repose.
    pub slope: Option<Slope>,
    /// The slopes of strips or sectors; none where the mean has none.
    pub parts: Vec<Slope>,
    /// Why there is no slope.
    #[serde(default)]
    pub refused: Option<Refused>,
    /// Tilt: the angle at which the bed began to flow, degrees.
    pub avalanche_deg: Option<f64>,
    /// What statics says of it, where that was asked.
    #[serde(default)]
    pub statics: Option<Confirmed>,
    /// What a protocol shows that leaves no slope.
    #[serde(default)]
    pub seen: Option<Seen>,
    /// Why there is something to doubt.
    pub findings: Vec<Finding>,
}

/// Why a heap has no angle of repose.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
pub struct Refused {
    /// One sentence each.
    pub reasons: Vec<String>,
    /// Cells of the mean surface between wall and toe; 0 where they are fewer than three.
    pub cells: usize,
    /// Coefficient of determination of the line through them.
    pub r_squared: Option<f64>,
}

/// The static margin of a heap.
#[derive(Clone, Debug)]
pub struct Margin {
    /// The heap without grains that nothing holds.
    pub scene: Scene,
    /// The tilt downhill that it still bears, at most.
    pub tilt: Tilt,
    /// Grains that nothing held.
    pub loose: usize,
    /// Grains that no admissible forces balance as they lie, left out: they still creep, too slowly
    /// for the dynamics to call it motion.
    pub unbalanced: usize,
    /// Seconds: contacts, limit.
    pub seconds: [f64; 2],
}

/// Makes a heap and measures it.
///
/// # Errors
/// A value of the protocol is out of its range.
pub fn heap(
    protocol: &Protocol,
    seed: u64,
    watch: &mut dyn FnMut(&Flow) -> ControlFlow<()>,
) -> Result<Heap, InputError> {
    grown(protocol, seed, &Growing::default(), watch)
}

/// How a heap is made, beside what its protocol says.
#[derive(Clone, Copy, Debug, Default)]
pub struct Growing<'a> {
    /// Grains of one's own, which begin where they lie.
    pub own: Option<&'a [BlockSpec]>,
    /// A word of statics: a heap at rest is asked whether forces exist that hold it as it lies, and
    /// where there are none it settles on with finer steps.
    pub statics: Option<&'a Control>,
    /// Threads of the engine; 0 is one. The heap is the same on any number of them.
    pub threads: usize,
}

/// The same, made so.
///
/// # Errors
/// As [`heap`]; a grain lies outside what holds it.
pub fn grown(
    protocol: &Protocol,
    seed: u64,
    growing: &Growing,
    watch: &mut dyn FnMut(&Flow) -> ControlFlow<()>,
) -> Result<Heap, InputError> {
    let Growing { own, statics, threads } = *growing;
    let deposit = match own {
        Some(own) => filled(protocol, own, seed)?,
        None => deposit(protocol, seed)?,
    };
    let Deposit { scene, gates, lid, layers, lost, cell } = deposit;
    let assembly = assembly::resolve(&scene)?;
    let index: BTreeMap<&str, usize> =
        assembly.blocks.iter().enumerate().map(|(i, b)| (b.id.as_str(), i)).collect();
    if let Some(edges) = cell {
        let begin = Instant::now();
        let Sheared { flown, poses, flow } =
            cell::sheared(protocol, &assembly, edges, threads, watch)?;
        let mut heap = Heap {
            seed,
            scene: settled(&scene, &assembly, &poses, &index, protocol.diameter),
            rested: flown.is_some(),
            energy: flow.energy,
            time: flow.time,
            seconds: begin.elapsed().as_secs_f64(),
            grains: [assembly.free().count(), 0],
            slope: None,
            parts: Vec::new(),
            avalanche_deg: None,
            seen: flown.map(|flown| Seen::Cell(Box::new(flown))),
            statics: None,
            refused: None,
            findings: Vec::new(),
        };
        heap.measure(protocol)?;
        return Ok(heap);
    }
    let find = |ids: &[String]| {
        ids.iter().filter_map(|id| index.get(id.as_str()).copied()).collect::<Vec<_>>()
    };
    let d = protocol.diameter;
    let g = assembly.gravity.norm();
    let natural = (d / g).sqrt();
    let (rate, speed) = (protocol.rate().to_radians() / natural, protocol.rate() * (g * d).sqrt());
    let gates = find(&gates);
    let lid = lid.and_then(|id| index.get(id.as_str()).copied());
    let mut recorder = Recorder::new(protocol, &assembly, &gates, lid);
    let stages = match protocol.kind {
        ProtocolKind::Drain | ProtocolKind::Hopper => {
            vec![Disturbance::Settle, Disturbance::Remove(gates)]
        }
        ProtocolKind::Funnel => {
            let layers = layers.iter().map(|l| find(l)).collect();
            let every = POUR * (protocol.drop / 3.0).sqrt() * natural;
            vec![Disturbance::Pour(layers, every, protocol.drop * d)]
        }
        ProtocolKind::Cylinder => {
            let height = 3.0 * d * (protocol.grains as f64).cbrt();
            vec![Disturbance::Settle, Disturbance::Lift(gates, speed, height)]
        }
        // Towards the gate, which goes as soon as the bed has settled.
        ProtocolKind::Tilt => {
            vec![Disturbance::Settle, Disturbance::Turn(Unit::new_unchecked(-Vector3::y()), rate)]
        }
        ProtocolKind::Drum => {
            let (axis, most) = (Vector3::y_axis(), DRUM_TURNS.to_radians());
            vec![Disturbance::Settle, Disturbance::Spin(axis, rate, most)]
        }
        ProtocolKind::Shear => {
            let way = SHEARED * protocol.size()[0] * d;
            vec![Disturbance::Settle, Disturbance::Shear(gates, speed, way)]
        }
        ProtocolKind::Cell => Vec::new(),
    };
    let finer =
        if protocol.kind == ProtocolKind::Shear { (1.0 + protocol.pressure).sqrt() } else { 1.0 };
    let course = Course {
        stages,
        diameter: d,
        horizon: HORIZON,
        lost,
        restitution: protocol.restitution,
        lid,
        finer,
        settled: protocol.kind.leaves_a_slope(),
        threads,
    };
    let mut look = |moment: &Moment| {
        recorder.look(moment);
        if recorder.is_complete() { ControlFlow::Break(()) } else { watch(&moment.flow) }
    };
    let lies = |poses: &Poses| settled(&scene, &assembly, poses, &index, d);
    let mut creeping = None;
    let rest = flow(&assembly, &course, &mut look, &mut |poses: &Poses| {
        creeping = statics.and_then(|control| confirm::creeping(&lies(poses), control));
        creeping.as_ref().is_none_or(Vec::is_empty)
    })?;
    let mut lies = lies(&rest.poses);
    lies.gravity = rest.gravity.into();
    // Turned, as the last look at it was not.
    if rest.turned.is_some() && rest.rested {
        creeping = statics.and_then(|control| confirm::creeping(&lies, control));
    }
    let free = assembly.free().filter(|i| Some(*i) != lid).count();
    let mut heap = Heap {
        seed,
        scene: lies,
        rested: rest.rested || recorder.is_complete(),
        energy: rest.energy,
        time: rest.time / natural,
        seconds: rest.seconds,
        grains: [free - rest.gone, rest.gone],
        slope: None,
        parts: Vec::new(),
        avalanche_deg: rest.turned.map(f64::to_degrees),
        seen: recorder.seen(),
        statics: creeping.filter(|_| rest.rested).map(|creeping| Confirmed {
            rounds: rest.rounds,
            admissible: creeping.is_empty(),
            creeping,
        }),
        refused: None,
        findings: Vec::new(),
    };
    heap.measure(protocol)?;
    Ok(heap)
}

/// The surface of a heap that lies still and lost no grain that it should not; `None` where it has
/// no angle of repose.
pub fn profile(protocol: &Protocol, heap: &assembly::Assembly) -> Option<Profile> {
    let reading = surface::of(protocol, heap);
    let slope = reading.mean.as_ref()?.slope;
    let sound = judge::refuse(protocol, &reading, 0).is_empty();
    sound.then_some(Profile { surface: reading.surface, line: reading.line, slope })
}

impl Heap {
    /// Reads the surface again from the scene, and says what there is to say of it: what a heap
    /// that was kept is worth does not depend on the version that kept it.
    ///
    /// # Errors
    /// The scene cannot be resolved.
    pub fn measure(&mut self, protocol: &Protocol) -> Result<(), InputError> {
        if !protocol.kind.leaves_a_slope() {
            let mut reasons = match &self.seen {
                Some(seen) => seen.doubts(),
                None if protocol.kind == ProtocolKind::Hopper => {
                    let [stayed, gone] = self.grains;
                    vec![format!(
                        "too few grains flowed out to measure, {gone} of {}: the orifice is clogged or too small",
                        stayed + gone
                    )]
                }
                None => vec!["nothing was measured: the run ended before the measurement".into()],
            };
            if !self.rested {
                reasons.insert(0, "stopped before its end".into());
            }
            let say = |text: &String| Finding::new(FindingCode::Numerics, text.clone());
            self.findings = reasons.iter().map(say).collect();
            self.refused =
                (!reasons.is_empty()).then_some(Refused { reasons, cells: 0, r_squared: None });
            return Ok(());
        }
        let reading = surface::of(protocol, &assembly::resolve(&self.scene)?);
        let mut reasons = judge::refuse(protocol, &reading, self.grains[1]);
        if !self.rested {
            let (energy, time) = (self.energy, self.time);
            let moves = format!(
                "the heap still moves: {energy:.1e} m g d per grain after {time:.0} √(d/g)"
            );
            reasons.insert(0, moves);
        }
        let fit = reading.mean.as_ref().map(|f| f.slope);
        let say = |text: &String| Finding::new(FindingCode::Numerics, text.clone());
        self.findings = reasons.iter().map(say).collect();
        let creep = self.statics.iter().filter_map(Confirmed::says);
        self.findings.extend(creep.map(|text| say(&text)));
        self.slope = fit.filter(|_| reasons.is_empty());
        self.parts = match self.slope {
            Some(_) => reading.parts.iter().map(|f| f.slope).collect(),
            None => Vec::new(),
        };
        self.refused = (!reasons.is_empty()).then(|| Refused {
            reasons,
            cells: fit.map_or(0, |f| f.cells),
            r_squared: fit.map(|f| f.r_squared),
        });
        Ok(())
    }
}

/// Supports that moved by more than this × d were pushed. Smaller: rounding. Larger: a box that was
/// hardly sheared lies where it was.
const MOVED: f64 = 1e-6;

/// The heap as a scene: what stayed, where it lies.
fn settled(
    scene: &Scene,
    assembly: &assembly::Assembly,
    poses: &Poses,
    index: &BTreeMap<&str, usize>,
    d: f64,
) -> Scene {
    let mut heap = scene.clone();
    heap.contact.gap = GRAIN_GAP;
    heap.blocks.retain_mut(|block| {
        let Some(&i) = index.get(block.id.as_str()) else { return false };
        let Some((center, turn)) = poses.get(i).copied().flatten() else { return false };
        // Supports that were pushed lie elsewhere, too.
        let moved = (center - assembly.blocks[i].centroid).norm() > MOVED * d;
        if !block.support || moved {
            lay(block, &assembly.blocks[i], center, turn);
        }
        true
    });
    heap
}

/// Moves a block: the frame x ↦ R x + t turns about the centre of mass.
fn lay(
    spec: &mut BlockSpec,
    block: &assembly::Block,
    center: Vector3<f64>,
    turn: UnitQuaternion<f64>,
) {
    if matches!(block.solid, assembly::Solid::Sphere { .. }) {
        // A sphere looks the same however it has turned.
        spec.at = center.into();
        return;
    }
    let before = spec
        .rotation_deg
        .as_ref()
        .and_then(|r| Unit::try_new(Vector3::from(r.axis), 0.0).map(|axis| (axis, r.angle)));
    let before = before.map_or(UnitQuaternion::identity(), |(axis, angle)| {
        UnitQuaternion::from_axis_angle(&axis, angle.to_radians())
    });
    spec.at = (center + turn * (Vector3::from(spec.at) - block.centroid)).into();
    spec.rotation_deg = (turn * before).axis_angle().map(|(axis, angle)| Rotation {
        axis: axis.into_inner().into(),
        angle: angle.to_degrees(),
    });
}

/// The tilt downhill that a heap at rest still bears. In the open it is asked for along x.
///
/// # Errors
/// The heap cannot be prepared.
pub fn margin(heap: &Heap, control: &Control) -> Result<Margin, InputError> {
    let start = Instant::now();
    let (mut model, loose) = held(&prepare(&heap.scene)?);
    let contacts = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let down = Vector3::x();
    let (mut gone, mut unbalanced) = (loose.clone(), 0);
    let mut tilt = tilt(&model, down, control)?;
    for _ in 0..UNBALANCED {
        let moving: Vec<usize> =
            tilt.load_factor.mechanism.iter().flat_map(|m| m.moving.iter().copied()).collect();
        if tilt.load_factor.outcome != Outcome::Impossible || moving.is_empty() {
            break;
        }
        let (rest, more) = held(&model.without(&moving));
        if rest.assembly.free().next().is_none() {
            break;
        }
        unbalanced += moving.len() + more.len();
        gone.extend(model.ids(&moving).into_iter().chain(more));
        model = rest;
        tilt = self::tilt(&model, down, control)?;
    }
    let scene = without(&heap.scene, &gone)?;
    Ok(Margin {
        scene,
        tilt,
        loose: loose.len(),
        unbalanced,
        seconds: [contacts, start.elapsed().as_secs_f64()],
    })
}

impl Margin {
    /// Degrees, where found; negative where the heap as it lies has no admissible forces.
    pub fn degrees(&self) -> Option<f64> {
        self.tilt.angle_deg().filter(|_| self.tilt.load_factor.outcome == Outcome::Found)
    }
}

#[cfg(test)]
mod tests;
