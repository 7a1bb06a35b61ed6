//! Time limits that hold: the engine looks at the clock between iterations only, and setting up or
//! factoring a large program can take minutes. Under a time limit it runs on a thread of its own,
//! which is left to itself when it does not answer in time; what was found before is not lost then.

use super::{Passed, Settings, Solution, Status, engine};
use crate::{deadline::Deadline, program::ConicProgram};
use std::{
    sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel},
    time::Duration,
};

/// How long the engine is waited for once its time is past, as a share of it and in seconds.
/// Longer: the limit means less. Shorter: the last iterate, which may close a bracket, is lost with
/// the iteration under way.
const PATIENCE: f64 = 0.05;
const LEAST_PATIENCE: f64 = 0.1;
/// Seconds between two looks whether it was cancelled.
const STEP: f64 = 0.05;

/// Solves a program.
pub fn solve(program: &ConicProgram, settings: &Settings) -> Solution {
    solve_near(program, settings, None)
}

/// The same from near a point that a program alike passed, if there is one.
pub fn solve_near(program: &ConicProgram, settings: &Settings, passed: Option<Passed>) -> Solution {
    let Some(mut session) = Session::new(program, settings) else { return none(Status::Refused) };
    if let Some(passed) = passed {
        session.begin_near(passed);
    }
    session.solve()
}

/// A program that is solved several times with changed right-hand sides and objectives: ordering
/// and set-up are kept. The seconds of its settings are those of all solves together.
pub struct Session(Runner);

/// Where the engine runs.
enum Runner {
    Inline(Box<engine::Session>),
    Threaded { orders: Sender<Order>, answers: Receiver<Answer>, deadline: Deadline },
}

enum Order {
    Rhs(Vec<f64>),
    Objective(Vec<f64>),
    BeginNear(Passed),
    Solve,
}

enum Answer {
    Done(bool),
    Solved(Solution),
}

impl Session {
    /// Sets a program up; `None` where the engine refuses it.
    pub fn new(program: &ConicProgram, settings: &Settings) -> Option<Self> {
        let own =
            || engine::Session::new(program, settings).map(|s| Self(Runner::Inline(Box::new(s))));
        // WebAssembly has no threads: there a deadline is heard between iterations.
        if !settings.deadline.is_set() || cfg!(target_arch = "wasm32") {
            return own();
        }
        let (orders, inbox) = channel();
        let (outbox, answers) = channel();
        let (program, own) = (program.clone(), *settings);
        let spawned = std::thread::Builder::new()
            .name("engine".into())
            .spawn(move || serve(&program, &own, &inbox, &outbox));
        match spawned {
            Ok(_) => Some(Self(Runner::Threaded { orders, answers, deadline: settings.deadline })),
            Err(_) => None,
        }
    }

    /// Changes the right-hand side; false where the engine refuses it.
    pub fn set_rhs(&mut self, rhs: &[f64]) -> bool {
        match &mut self.0 {
            Runner::Inline(session) => session.set_rhs(rhs),
            Runner::Threaded { .. } => {
                matches!(self.ask(Order::Rhs(rhs.to_vec())), Some(Answer::Done(true)))
            }
        }
    }

    /// Changes the objective; false where the engine refuses it.
    pub fn set_objective(&mut self, objective: &[f64]) -> bool {
        match &mut self.0 {
            Runner::Inline(session) => session.set_objective(objective),
            Runner::Threaded { .. } => {
                matches!(self.ask(Order::Objective(objective.to_vec())), Some(Answer::Done(true)))
            }
        }
    }

    /// Lets the next solve begin near a point that a program alike passed; false where the engine has no
    /// use for it.
    pub fn begin_near(&mut self, passed: Passed) -> bool {
        match &mut self.0 {
            Runner::Inline(session) => session.begin_near(&passed),
            Runner::Threaded { .. } => {
                matches!(self.ask(Order::BeginNear(passed)), Some(Answer::Done(true)))
            }
        }
    }

    /// Solves the program as it stands.
    pub fn solve(&mut self) -> Solution {
        match &mut self.0 {
            Runner::Inline(session) => session.solve(),
            Runner::Threaded { .. } => match self.ask(Order::Solve) {
                Some(Answer::Solved(solution)) => solution,
                _ => none(Status::Limit),
            },
        }
    }

    /// The answer to an order; `None` where it does not come in time.
    fn ask(&self, order: Order) -> Option<Answer> {
        let Runner::Threaded { orders, answers, deadline } = &self.0 else { return None };
        orders.send(order).ok()?;
        // In steps, to hear that it is cancelled.
        loop {
            let left = deadline.left();
            let patience = left * PATIENCE + LEAST_PATIENCE;
            match answers.recv_timeout(Duration::from_secs_f64((left + patience).min(STEP))) {
                Ok(answer) => return Some(answer),
                Err(RecvTimeoutError::Disconnected) => return None,
                Err(RecvTimeoutError::Timeout) if deadline.is_over() => {
                    return answers.recv_timeout(Duration::from_secs_f64(LEAST_PATIENCE)).ok();
                }
                Err(RecvTimeoutError::Timeout) => {}
            }
        }
    }
}

/// The engine's side; it ends with the session, or after the order under way.
fn serve(
    program: &ConicProgram,
    settings: &Settings,
    inbox: &Receiver<Order>,
    outbox: &Sender<Answer>,
) {
    let mut session = engine::Session::new(program, settings);
    while let Ok(order) = inbox.recv() {
        let answer = match (order, &mut session) {
            (Order::Solve, Some(session)) => Answer::Solved(session.solve()),
            (Order::Rhs(rhs), Some(session)) => Answer::Done(session.set_rhs(&rhs)),
            (Order::Objective(objective), Some(session)) => {
                Answer::Done(session.set_objective(&objective))
            }
            (Order::BeginNear(passed), Some(session)) => Answer::Done(session.begin_near(&passed)),
            (Order::Solve, None) => Answer::Solved(none(Status::Refused)),
            (Order::Rhs(_) | Order::Objective(_) | Order::BeginNear(_), None) => {
                Answer::Done(false)
            }
        };
        if outbox.send(answer).is_err() {
            return;
        }
    }
}

fn none(status: Status) -> Solution {
    Solution { x: Vec::new(), z: Vec::new(), status, trace: Vec::new(), seconds: 0.0, passed: None }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::{Cone, ConicProgram, Sparse};
    use std::time::Instant;

    /// min x subject to x ≥ 2.
    fn program() -> ConicProgram {
        let mut matrix = Sparse::zeros(1, 1);
        matrix.push(0, 0, -1.0);
        ConicProgram {
            quadratic: Vec::new(),
            objective: vec![1.0],
            matrix,
            rhs: vec![-2.0],
            cones: vec![Cone::NonNegative(1)],
        }
    }

    #[test]
    fn answers_are_the_same_with_and_without_a_time_limit() {
        let solve = |deadline: Deadline| {
            let mut session =
                Session::new(&program(), &Settings { deadline, ..Settings::default() }).unwrap();
            let first = session.solve();
            assert!(session.set_rhs(&[-3.0]) && session.set_objective(&[2.0]));
            [first, session.solve()].map(|s| (s.status, s.x[0].to_bits(), s.z[0].to_bits()))
        };
        assert_eq!(solve(Deadline::NEVER), solve(Deadline::within(1e3)));
        assert!((f64::from_bits(solve(Deadline::within(1e3))[1].1) - 3.0).abs() < 1e-8);
    }

    #[test]
    fn without_time_there_is_no_answer_and_no_waiting() {
        let start = Instant::now();
        let mut session = Session::new(
            &program(),
            &Settings { deadline: Deadline::within(0.0), ..Settings::default() },
        )
        .unwrap();
        for _ in 0..3 {
            let solution = session.solve();
            assert!(
                matches!(solution.status, Status::Limit | Status::Solved),
                "{:?}",
                solution.status
            );
        }
        assert!(start.elapsed().as_secs() < 60);
    }
}
