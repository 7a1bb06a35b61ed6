//! One run of a program, and the ladder of attempts.
//!
//! An attempt's worth is its bracket, recomputed from the scene; the engine's word is recorded and
//! never decides.

use crate::watch::{Watched, Watcher};
use check::{
    terms::{Attempt, Law},
    verdict::{Forces, Rate, certificate},
};
use model::interface::Model;
use solve::{
    EngineSettings, Passed, Settings, Solution,
    deadline::Deadline,
    program::{ConicProgram, Positions, Statics, Unknowns},
};

/// What the caller may change about a question.
#[derive(Clone, Copy, Debug)]
pub struct Control {
    /// How joints slide.
    pub law: Law,
    /// Leave nothing out, for comparison.
    pub keep_all: bool,
    /// When to stop trying and return the best bracket so far.
    pub deadline: Deadline,
    /// Who hears how far the work is.
    pub watcher: Watcher,
}

impl Control {
    /// Says what is known already.
    pub(crate) fn known(&self, text: impl FnOnce() -> String) {
        if let Some(hear) = self.watcher {
            hear(Watched::Known(text()));
        }
    }

    /// Says what is being done.
    pub(crate) fn doing(&self, text: impl FnOnce() -> String) {
        if let Some(hear) = self.watcher {
            hear(Watched::Doing(text()));
        }
    }
}

impl Default for Control {
    fn default() -> Self {
        Self { law: Law::Coulomb, keep_all: false, deadline: Deadline::NEVER, watcher: None }
    }
}

/// Steps that the part of a symmetric scene is tried with; then the whole is, from the first step
/// on, for what the parts leave off balance for not being quite alike would decide. Fewer:
/// symmetric scenes near their limit cost twice. More: time lost on those that are symmetric in
/// eleven digits only.
const ON_THE_PART: usize = 2;

/// The steps of a ladder in order, each with whether it takes the scene as [`Statics`] first gave
/// it (a part, where there is symmetry) or whole.
pub(super) fn steps(ladder: &[Rung], is_part: bool) -> impl Iterator<Item = (bool, Rung)> {
    let part = if is_part { &ladder[..ladder.len().min(ON_THE_PART)] } else { &[] };
    part.iter().map(|step| (false, *step)).chain(ladder.iter().map(move |step| (is_part, *step)))
}

/// One step of a ladder: how the program is written and scaled, and what solves it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rung {
    pub unknowns: Unknowns,
    /// Factor on the force unit.
    pub unit: f64,
    /// Whether small blocks get units of their own.
    pub local: bool,
    /// Whether all blocks are measured by the greatest load ([`Statics::even`]), for scenes of very
    /// unequal masses.
    pub even: bool,
    /// The engine's tolerance.
    pub tolerance: f64,
    pub engine: EngineSettings,
}

/// Force columns from which a program is large. More: walls of a thousand blocks take several times
/// as long. Fewer: nothing is gained, and the ladders, measured on small scenes, begin elsewhere.
const LARGE: usize = 4000;

/// Whether a program is large.
pub(crate) fn is_large(statics: &Statics) -> bool {
    statics.matrix.columns >= LARGE
}

/// Whether two programs about a scene are solved side by side: where they are large, each leaves
/// threads idle, and where time is short the first is worth more than half of both.
pub(super) fn side_by_side(model: &Model, control: &Control) -> bool {
    3 * model.contact_points() >= LARGE && !control.deadline.is_timed()
}

impl Rung {
    /// The usual one in forces; what a ladder names differs from it.
    pub const FORCES: Self = Self {
        unknowns: Unknowns::Forces,
        unit: 1.0,
        local: true,
        even: false,
        tolerance: 1e-11,
        engine: EngineSettings::clarabel(1e-8),
    };
    /// The same in rates.
    pub const RATES: Self = Self { unknowns: Unknowns::Rates, ..Self::FORCES };
    /// For large programs, on the stiffness matrix of the blocks.
    pub const INTERIOR: Self = Self { engine: EngineSettings::Interior, ..Self::FORCES };

    /// The equilibrium as this step takes it.
    pub fn scaled(&self, statics: &Statics) -> Statics {
        let mut statics = statics.clone();
        statics.rescale(self.unit, self.local);
        if self.even {
            statics.even();
        }
        statics
    }

    /// The settings of its solves.
    pub fn settings(&self, deadline: Deadline) -> Settings {
        Settings { engine: self.engine, tolerance: self.tolerance, deadline, ..Settings::default() }
    }
}

/// Forces and rates of a solved program in our signs and units.
pub(super) struct Candidate {
    pub solution: Solution,
    pub forces: Forces,
    pub rates: Vec<Rate>,
}

/// Runs of one rung after the bounds on crushing that the last forces broke were added. Fewer:
/// thick joints near their strength stay undecided. More: time lost where the engine itself no
/// longer resolves the bounds.
const MOST_ROUNDS: usize = 30;

/// What a rung gave.
pub(super) struct Run {
    /// Forces and rates in our signs and units; `None` where the engine left no finite numbers.
    pub candidate: Option<Candidate>,
    pub solution: Solution,
    /// Where a program alike may begin.
    pub passed: Option<Passed>,
    /// Unknowns and rows of the last program.
    pub size: [usize; 2],
}

impl Run {
    /// The record of this run of a rung, with the ends that were recomputed from it.
    pub fn attempt(
        &self,
        program: String,
        force_unit: f64,
        step: &Rung,
        engine_value: Option<f64>,
        [lower, upper]: [f64; 2],
    ) -> Attempt {
        Attempt {
            program,
            force_unit,
            engine: step.engine.engine(),
            tolerance: step.tolerance,
            regularization: step.engine.regularization(),
            engine_status: self.solution.status,
            iterations: self.solution.trace.len(),
            size: self.size,
            seconds: self.solution.seconds,
            engine_value,
            lower,
            upper,
        }
    }
}

/// Solves the program that `build` makes, again and again with the bounds on crushing that its
/// forces break, which stay in `statics`; the first time near what a program alike passed.
pub(super) fn run(
    model: &Model,
    statics: &mut Statics,
    build: impl Fn(&Statics) -> (ConicProgram, Positions),
    settings: &Settings,
    near: Option<Passed>,
) -> Run {
    let Model { assembly, interfaces, .. } = model;
    let (mut rounds, mut near) = (0, near);
    loop {
        rounds += 1;
        let (program, layout) = build(statics);
        let mut solution = solve::solve_near(&program, settings, near.take());
        let passed = solution.passed.take();
        let size = [program.matrix.columns, program.matrix.rows];
        if !solution.is_finite() {
            return Run { candidate: None, solution, passed, size };
        }
        let forces = statics.forces(interfaces, layout.forces(&solution.x, &solution.z));
        let broken = certificate::crushed(interfaces, &forces);
        if !broken.is_empty() && rounds < MOST_ROUNDS && !settings.deadline.is_over() {
            statics.bound(&broken);
            continue;
        }
        let rates = statics
            .rates(assembly.blocks.len(), layout.rates(&solution.x, &solution.z))
            .into_iter()
            .map(|(velocity, spin)| Rate { velocity, spin })
            .collect();
        return Run {
            candidate: Some(Candidate { solution: solution.clone(), forces, rates }),
            solution,
            passed,
            size,
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use solve::Status;

    fn record(step: &Rung) -> serde_json::Value {
        let solution = Solution {
            x: Vec::new(),
            z: Vec::new(),
            status: Status::Solved,
            trace: Vec::new(),
            seconds: 0.5,
            passed: None,
        };
        let run = Run { candidate: None, solution, passed: None, size: [3, 4] };
        serde_json::to_value(run.attempt(
            "least equilibrium error in forces".into(),
            1.0,
            step,
            None,
            [0.0, 1.0],
        ))
        .unwrap()
    }

    #[test]
    fn a_record_names_the_settings_that_its_engine_has() {
        let [usual, interior] = [Rung::FORCES, Rung::INTERIOR].map(|step| record(&step));
        assert_eq!((usual.get("engine"), &usual["regularization"]), (None, &1e-8.into()));
        assert_eq!(
            (&interior["engine"], interior.get("regularization")),
            (&"interior".into(), None)
        );
        // Result files of before have a number there.
        let mut old = interior.clone();
        old["regularization"] = 0.0.into();
        for record in [usual, interior, old] {
            let read: Attempt = serde_json::from_value(record.clone()).unwrap();
            assert_eq!(serde_json::to_value(&read).unwrap(), record);
        }
    }
}
