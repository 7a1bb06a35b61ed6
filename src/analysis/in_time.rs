//! The door to the dynamics, where this build has any.

use super::{Answer, question::SimulateOptions};
use crate::{error::InputError, interface::Model, scene::Scene};

#[cfg(feature = "dynamics")]
use crate::{
    dynamics::{self, Fidelity, Progress, SimulationSettings},
    interface::prepare,
};
#[cfg(feature = "dynamics")]
use std::ops::ControlFlow;

/// How a simulation is shown while it runs; none of it changes an answer.
#[cfg(feature = "dynamics")]
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
#[cfg(feature = "dynamics")]
pub(super) fn unwatched(
    options: &SimulateOptions,
    scene: &Scene,
    model: &Model,
) -> Result<Answer, InputError> {
    let mut each = |_: &Progress| ControlFlow::Continue(());
    let watch =
        Watch { threads: 1, frames: 0, keep_frames: false, every_step: false, each: &mut each };
    watched(options, scene, model, watch)
}

/// What happens in time, which nothing here can tell.
#[cfg(not(feature = "dynamics"))]
pub(super) fn unwatched(_: &SimulateOptions, _: &Scene, _: &Model) -> Result<Answer, InputError> {
    let error = InputError::at(Default::default(), "this build cannot simulate");
    Err(error.hint("build it with the feature `dynamics`"))
}

/// What happens in time, shown while it does.
#[cfg(feature = "dynamics")]
pub(super) fn watched(
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
    let settings = SimulationSettings {
        fidelity: if options.fast {
            Some(Fidelity::Fast)
        } else {
            options.fine.then_some(Fidelity::Fine)
        },
        seconds: options.seconds,
        threads: watch.threads,
        frames: watch.frames,
        keep_frames: watch.keep_frames,
        to_the_end: options.to_the_end,
        every_step: watch.every_step,
    };
    Ok(Answer::Simulate(Box::new(dynamics::simulate(loaded, &settings, watch.each)?)))
}
