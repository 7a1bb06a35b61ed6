//! The mechanism of a scene on ground that moves. What sets it moving is proved; the history is
//! integrated.

use super::follow::machine::{Built, MachineOptions};
use base::error::{InputError, JsonPath};
use check::{
    ground::Motion,
    rocking::{History, RockOptions, RunSettings, Scan, Search, run, scan},
};
use std::sync::Arc;

/// The answer of `rock`.
#[derive(Clone, Debug)]
pub struct Rocking {
    /// What was asked.
    pub options: RockOptions,
    /// The motion of the ground, scaled.
    pub motion: Motion,
    /// The mechanism, with the load factors that prove it.
    pub built: Arc<Built>,
    /// What it did.
    pub history: History,
    /// At which scales it overturns, where that was asked.
    pub scan: Option<Scan>,
}

/// Scales of a scan.
const SCALES: usize = 200;
/// How near flips are narrowed, over the scale.
const WIDTH: f64 = 1e-9;

/// Runs the mechanism of a scene, as `machine` makes it.
pub(super) fn rock(
    options: &RockOptions,
    machine: &dyn Fn(&MachineOptions) -> Result<Arc<Built>, InputError>,
) -> Result<Rocking, InputError> {
    let asked = MachineOptions {
        toward: options.toward.into(),
        control: options
            .control
            .as_ref()
            .map(|c| (c.block.clone(), c.point.map(|point| point.into()))),
        restitution: options.restitution,
    };
    let built = machine(&asked)?;
    let under = JsonPath::root().key("rock").key("ground");
    let given = options.ground.unscaled().map_err(|e| e.under(&under))?;
    let motion = given.scaled(options.ground.scale);
    let settings = RunSettings {
        from: options.from,
        until: options.seconds,
        fate_only: options.fate_only,
        keep: !options.fate_only,
        ..RunSettings::default()
    };
    let history = run(&built.machine, &motion, &settings);
    let scan = options.scan.map(|[from, to]| {
        let search = Search { from, to, steps: SCALES, width: WIDTH };
        scan(&built.machine, &given, &settings, &search)
    });
    Ok(Rocking { options: options.clone(), motion, built, history, scan })
}
