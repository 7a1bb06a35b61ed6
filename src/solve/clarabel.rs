//! The adapter to clarabel, the only file that names it.

use super::{Iteration, Settings, Solution, Status};
use crate::{
    clock::Instant,
    program::{Cone, ConicProgram},
};
use clarabel::{
    algebra::CscMatrix,
    solver::{DefaultInfo, DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT},
};
use std::sync::{Arc, Mutex};

/// A program that is solved several times with changed right-hand sides and objectives by
/// clarabel's interior-point method (Goulart & Chen 2024): ordering and set-up are kept.
pub struct Session {
    engine: DefaultSolver<f64>,
    trace: Arc<Mutex<Vec<Iteration>>>,
    start: Arc<Mutex<Instant>>,
}

impl Session {
    /// Sets a program up; `None` where the engine refuses it.
    pub fn new(
        program: &ConicProgram,
        settings: &Settings,
        regularization: f64,
        equilibrate: bool,
    ) -> Option<Self> {
        let start = Arc::new(Mutex::new(Instant::now()));
        // The engine counts the seconds of each solve anew: the callback knows better.
        let deadline = settings.deadline;
        let m = &program.matrix;
        let matrix =
            CscMatrix::new_from_triplets(m.rows, m.columns, m.i.clone(), m.j.clone(), m.v.clone());
        let n = m.columns;
        let quadratic = if program.quadratic.is_empty() {
            CscMatrix::zeros((n, n))
        } else {
            CscMatrix::new(n, n, (0..=n).collect(), (0..n).collect(), program.quadratic.clone())
        };
        let cones: Vec<SupportedConeT<f64>> = program
            .cones
            .iter()
            .map(|cone| match *cone {
                Cone::Zero(n) => SupportedConeT::ZeroConeT(n),
                Cone::NonNegative(n) => SupportedConeT::NonnegativeConeT(n),
                Cone::SecondOrder(n) => SupportedConeT::SecondOrderConeT(n),
            })
            .collect();
        let engine_settings = DefaultSettings {
            max_iter: settings.iterations,
            tol_gap_abs: settings.tolerance,
            tol_gap_rel: settings.tolerance,
            tol_feas: settings.tolerance,
            static_regularization_constant: regularization,
            equilibrate_enable: equilibrate,
            verbose: false,
            max_threads: 1,
            // By the fill of the factor: scalar where it is sparse (walls pushed in their plane,
            // arches), in dense blocks where it is not (heaps of grains: 4,495 spheres in 36 s
            // instead of more than 120 s).
            direct_solve_method: "auto".into(),
            presolve_enable: false,
            ..DefaultSettings::default()
        };
        let mut engine = DefaultSolver::new(
            &quadratic,
            &program.objective,
            &matrix,
            &program.rhs,
            &cones,
            engine_settings,
        )
        .ok()?;
        let trace = Arc::new(Mutex::new(Vec::new()));
        let (recorder, clock) = (Arc::clone(&trace), Arc::clone(&start));
        engine.set_termination_callback(move |info: &DefaultInfo<f64>| {
            if let (Ok(mut trace), Ok(start)) = (recorder.lock(), clock.lock()) {
                trace.push(Iteration {
                    seconds: start.elapsed().as_secs_f64(),
                    primal: info.cost_primal,
                    dual: info.cost_dual,
                    primal_residual: info.res_primal,
                    dual_residual: info.res_dual,
                });
            }
            deadline.is_over()
        });
        Some(Self { engine, trace, start })
    }

    /// Changes the right-hand side; false where the engine refuses it.
    pub fn set_rhs(&mut self, rhs: &[f64]) -> bool {
        self.engine.update_b(&rhs.to_vec()).is_ok()
    }

    /// Changes the objective; false where the engine refuses it.
    pub fn set_objective(&mut self, objective: &[f64]) -> bool {
        self.engine.update_q(&objective.to_vec()).is_ok()
    }

    /// Solves the program as it stands.
    pub fn solve(&mut self) -> Solution {
        self.engine.solve();
        let status = match self.engine.solution.status {
            SolverStatus::Solved => Status::Solved,
            SolverStatus::AlmostSolved => Status::AlmostSolved,
            SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => {
                Status::PrimalInfeasible
            }
            SolverStatus::DualInfeasible | SolverStatus::AlmostDualInfeasible => {
                Status::DualInfeasible
            }
            SolverStatus::MaxIterations
            | SolverStatus::MaxTime
            | SolverStatus::CallbackTerminated => Status::Limit,
            SolverStatus::Unsolved
            | SolverStatus::NumericalError
            | SolverStatus::InsufficientProgress => Status::Stalled,
        };
        let trace = self.trace.lock().map(|mut t| std::mem::take(&mut *t)).unwrap_or_default();
        // Counted from the end of the last solve: the first one includes the set-up.
        let seconds = self.start.lock().map_or(0.0, |mut s| {
            std::mem::replace(&mut *s, Instant::now()).elapsed().as_secs_f64()
        });
        Solution {
            x: self.engine.solution.x.clone(),
            z: self.engine.solution.z.clone(),
            status,
            trace,
            seconds,
            passed: None,
        }
    }
}
