//! The adapter to clarabel, the only file that names it.

use super::{Iteration, Settings, Solution, Status};
use crate::program::{Cone, ConicProgram};
use clarabel::{
    algebra::CscMatrix,
    solver::{DefaultInfo, DefaultSettings, DefaultSolver, IPSolver, SolverStatus, SupportedConeT},
};
use std::{
    sync::{Arc, Mutex},
    time::Instant,
};

/// Solves a program with clarabel's interior-point method (Goulart & Chen 2024).
pub fn solve(program: &ConicProgram, settings: &Settings) -> Solution {
    let start = Instant::now();
    let m = &program.matrix;
    let matrix = CscMatrix::new_from_triplets(m.rows, m.columns, m.i.clone(), m.j.clone(), m.v.clone());
    let quadratic = CscMatrix::zeros((m.columns, m.columns));
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
        verbose: false,
        max_iter: settings.iterations,
        time_limit: settings.seconds,
        tol_gap_abs: settings.tolerance,
        tol_gap_rel: settings.tolerance,
        tol_feas: settings.tolerance,
        static_regularization_constant: settings.regularization,
        equilibrate_enable: settings.equilibrate,
        max_threads: 1,
        presolve_enable: false,
        ..DefaultSettings::default()
    };
    let refused = || Solution { x: Vec::new(), z: Vec::new(), status: Status::Refused, trace: Vec::new(), seconds: 0.0 };
    let Ok(mut solver) = DefaultSolver::new(&quadratic, &program.objective, &matrix, &program.rhs, &cones, engine_settings) else {
        return refused();
    };
    let trace = Arc::new(Mutex::new(Vec::new()));
    let recorder = Arc::clone(&trace);
    solver.set_termination_callback(move |info: &DefaultInfo<f64>| {
        if let Ok(mut trace) = recorder.lock() {
            trace.push(Iteration {
                seconds: start.elapsed().as_secs_f64(),
                primal: info.cost_primal,
                dual: info.cost_dual,
                primal_residual: info.res_primal,
                dual_residual: info.res_dual,
            });
        }
        false
    });
    solver.solve();
    let status = match solver.solution.status {
        SolverStatus::Solved => Status::Solved,
        SolverStatus::AlmostSolved => Status::AlmostSolved,
        SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => Status::PrimalInfeasible,
        SolverStatus::DualInfeasible | SolverStatus::AlmostDualInfeasible => Status::DualInfeasible,
        SolverStatus::MaxIterations | SolverStatus::MaxTime | SolverStatus::CallbackTerminated => Status::Limit,
        SolverStatus::Unsolved | SolverStatus::NumericalError | SolverStatus::InsufficientProgress => Status::Stalled,
    };
    let (x, z) = (std::mem::take(&mut solver.solution.x), std::mem::take(&mut solver.solution.z));
    let trace = trace.lock().map(|mut t| std::mem::take(&mut *t)).unwrap_or_default();
    Solution { x, z, status, trace, seconds: start.elapsed().as_secs_f64() }
}
