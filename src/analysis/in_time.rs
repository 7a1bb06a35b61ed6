//! The door to the dynamics, where this build has any.

use super::{Answer, question::SimulateOptions};
use base::error::InputError;
use check::ground::ShakeOptions;
use model::interface::Model;
use scene::Scene;

use base::error::JsonPath;
use check::kinematic::{MassKind, quake};
use dynamics::{Burden, Fidelity, Progress, Shaken, Shaking, SimulationSettings};
use model::interface::prepare;
use nalgebra::Vector3;
use std::ops::ControlFlow;

/// What is asked of all blocks in time.
pub(super) enum Asked<'a> {
    /// What becomes of it under its loads.
    Simulate(&'a SimulateOptions),
    /// What the ground does to it.
    Shake(&'a ShakeOptions),
}

/// All blocks of a scene on ground that moved.
#[derive(Clone, Debug)]
pub struct ShakenScene {
    /// What was asked.
    pub options: ShakeOptions,
    /// Unit axes of the motion: the direction, to its left, up.
    pub axes: [Vector3<f64>; 3],
    /// What they did.
    pub shaken: Shaken,
}

/// How a simulation is shown while it runs; none of it changes an answer.
pub struct Watch<'a> {
    /// Threads of the engine.
    pub threads: usize,
    /// As [`SimulationSettings::frames`].
    pub frames: usize,
    /// As [`SimulationSettings::keep_frames`].
    pub keep_frames: bool,
    /// As [`SimulationSettings::every_step`].
    pub every_step: bool,
    /// Who watches.
    pub each: &'a mut dyn FnMut(&Progress) -> ControlFlow<()>,
}

/// What happens in time, shown to nobody.
pub(super) fn unwatched(asked: &Asked, scene: &Scene, model: &Model) -> Result<Answer, InputError> {
    let mut each = |_: &Progress| ControlFlow::Continue(());
    let watch =
        Watch { threads: 1, frames: 0, keep_frames: false, every_step: false, each: &mut each };
    watched(asked, scene, model, watch)
}

/// What happens in time, shown while it does.
pub(super) fn watched(
    asked: &Asked,
    scene: &Scene,
    model: &Model,
    watch: Watch,
) -> Result<Answer, InputError> {
    match asked {
        Asked::Simulate(options) => simulate(options, scene, model, watch),
        Asked::Shake(options) => shake(options, scene, model, watch),
    }
}

impl Watch<'_> {
    fn settings(
        &self,
        fidelity: Option<Fidelity>,
        seconds: Option<f64>,
        to_the_end: bool,
    ) -> SimulationSettings {
        SimulationSettings {
            fidelity,
            seconds,
            threads: self.threads,
            frames: self.frames,
            keep_frames: self.keep_frames,
            to_the_end,
            every_step: self.every_step,
        }
    }
}

fn simulate(
    options: &SimulateOptions,
    scene: &Scene,
    model: &Model,
    watch: Watch,
) -> Result<Answer, InputError> {
    // In the scene, whose live loads may act off the centre of mass and turn with their blocks.
    let loaded = match options.load_factor {
        Some(factor) if factor != 0.0 => {
            &prepare(&Scene { loads: scene.loads.fixed(factor), ..scene.clone() })?
        }
        _ => model,
    };
    let fidelity =
        if options.fast { Some(Fidelity::Fast) } else { options.fine.then_some(Fidelity::Fine) };
    let settings = watch.settings(fidelity, options.seconds, options.to_the_end);
    Ok(Answer::Simulate(Box::new(dynamics::simulate(loaded, &settings, watch.each)?)))
}

fn shake(
    options: &ShakeOptions,
    scene: &Scene,
    model: &Model,
    watch: Watch,
) -> Result<Answer, InputError> {
    let under = JsonPath::root().key("shake");
    let axes = options.axes(model.assembly.gravity).map_err(|e| e.under(&under))?;
    let motion = options.ground.motion().map_err(|e| e.under(&under.key("ground")))?;
    let burdens = burdens(scene, model, axes[0])?;
    let fidelity = if options.fast { Fidelity::Fast } else { Fidelity::Fine };
    let settings = watch.settings(Some(fidelity), options.seconds, options.to_the_end);
    let ground = Shaking { motion: &motion, axes: &axes, burdens: &burdens };
    let shaken = dynamics::shake(model, ground, &settings, watch.each)?;
    Ok(Answer::Shake(Box::new(ShakenScene { options: options.clone(), axes, shaken })))
}

/// The masses of loads, which go with their blocks as in `kinematic`.
///
/// # Errors
/// The direction is along gravity.
pub fn burdens(
    scene: &Scene,
    model: &Model,
    toward: Vector3<f64>,
) -> Result<Vec<Burden>, InputError> {
    let gravity = model.assembly.gravity.norm();
    let masses = quake(scene, model, toward)?.masses;
    let loads = masses.iter().filter(|m| m.kind != MassKind::Block);
    let burden = |m: &check::kinematic::Mass| Burden {
        block: m.block,
        arm: m.arm,
        mass: m.weight / gravity,
        rests: if m.kind == MassKind::Rests { m.weight } else { 0.0 },
    };
    Ok(loads.map(burden).collect())
}
