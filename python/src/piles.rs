//! Piles of shapes from arrays.

use crate::{arrays, error::Trouble, scene::Scene, wait};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use numpy::{
    PyArray1, PyReadonlyArray2, PyReadonlyArray3,
    ndarray::{ArrayView2, ArrayView3},
};
use pyo3::prelude::*;
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{
        Arc,
        atomic::{AtomicUsize, Ordering},
    },
};
use voussoir::{analysis::piles, assembly::Put, error::InputError, parallel};

/// Shapes made ready.
#[pyclass(module = "voussoir._core")]
pub struct Piles {
    ready: Arc<piles::Piles>,
    ids: Vec<String>,
}

/// Verdicts, lower and upper ends of margins, what decided, why piles have no answer, and what was
/// found about contacts.
type Columns<'py> = (
    Vec<&'static str>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
    Vec<&'static str>,
    Vec<(usize, String)>,
    Vec<(usize, Vec<String>)>,
);

#[pymethods]
impl Piles {
    /// Takes the blocks of a scene as shapes.
    #[new]
    fn new(py: Python, scene: &Scene) -> PyResult<Self> {
        let ready = scene.ready();
        let piles = piles::Piles::new(&ready.scene).map_err(|e| ready.located(e).raise(py))?;
        let ids = piles.shelf().shapes().iter().map(|b| b.id.clone()).collect();
        Ok(Self { ready: Arc::new(piles), ids })
    }

    /// Names of the shapes.
    fn ids(&self) -> Vec<String> {
        self.ids.clone()
    }

    /// Asks about piles: `which` and `masses` are `n × b`, `at` is `n × b × 3`, `turn` is
    /// `n × b × 4` (w, x, y, z); −1 is no block.
    #[pyo3(signature = (which, at, turn, masses, *, margin=false, threads=0, progress=None))]
    #[expect(clippy::too_many_arguments, reason = "one array for each thing that a block has")]
    fn ask<'py>(
        &self,
        py: Python<'py>,
        which: PyReadonlyArray2<i64>,
        at: PyReadonlyArray3<f64>,
        turn: Option<PyReadonlyArray3<f64>>,
        masses: Option<PyReadonlyArray2<f64>>,
        margin: bool,
        threads: i64,
        progress: Option<&Bound<PyAny>>,
    ) -> PyResult<Columns<'py>> {
        let threads = wait::threads(py, threads)?;
        let turn = turn.as_ref().map(|t| t.as_array());
        let masses = masses.as_ref().map(|m| m.as_array());
        let list = listed(which.as_array(), at.as_array(), turn, masses);
        let mut piles = (*self.ready).clone();
        piles.margin = margin;
        let told = wait::run(py, progress, move |watch| {
            piles.control.deadline = watch.deadline(None);
            let (done, total) = (AtomicUsize::new(0), list.len() as f64);
            let one = |put: &Vec<Put>| {
                if watch.is_cancelled() {
                    return None;
                }
                let answer = catch_unwind(AssertUnwindSafe(|| piles.ask(put)));
                let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                watch.tell(done as f64, total, || "piles".into());
                Some(answer)
            };
            parallel::map(threads, &list, one).map_err(Trouble::other)
        })?;
        let (mut errors, mut findings) = (Vec::new(), Vec::new());
        let (mut verdicts, mut by) = (Vec::new(), Vec::new());
        let (mut lower, mut upper) = (Vec::new(), Vec::new());
        for (i, answer) in told.into_iter().enumerate() {
            let answer = match answer {
                Some(Ok(Ok(answer))) => Ok(answer),
                Some(Ok(Err(e))) => Err(InputError::to_string(&e)),
                Some(Err(_)) => Err("the program failed on this pile (please report it)".into()),
                None => Err("cancelled".into()),
            };
            let margin = answer.as_ref().ok().and_then(|a| a.margin);
            lower.push(margin.map_or(f64::NAN, |m| m.lower));
            upper.push(margin.map_or(f64::NAN, |m| m.upper));
            match answer {
                Ok(answer) => {
                    if !answer.findings.is_empty() {
                        findings.push((i, answer.findings.into_iter().map(|f| f.text).collect()));
                    }
                    verdicts.push(answer.verdict.word());
                    by.push(answer.by.word());
                }
                Err(e) => {
                    verdicts.push("error");
                    by.push("");
                    errors.push((i, e));
                }
            }
        }
        let (lower, upper) = (arrays::numbers(py, lower), arrays::numbers(py, upper));
        Ok((verdicts, lower, upper, by, errors, findings))
    }
}

/// The blocks of every pile. The arrays have the same first two lengths.
fn listed(
    which: ArrayView2<i64>,
    at: ArrayView3<f64>,
    turn: Option<ArrayView3<f64>>,
    masses: Option<ArrayView2<f64>>,
) -> Vec<Vec<Put>> {
    let one = |i: usize, b: usize| -> Option<Put> {
        let shape = *which.get((i, b))?;
        if shape == -1 {
            return None;
        }
        // What is no shape is refused where it is put.
        let shape = usize::try_from(shape).unwrap_or(usize::MAX);
        let number = |k: usize| at.get((i, b, k)).copied().unwrap_or(f64::NAN);
        let turn = match &turn {
            None => UnitQuaternion::identity(),
            Some(turn) => {
                let q = |k: usize| turn.get((i, b, k)).copied().unwrap_or(f64::NAN);
                UnitQuaternion::from_quaternion(Quaternion::new(q(0), q(1), q(2), q(3)))
            }
        };
        let mass = masses.as_ref().and_then(|m| m.get((i, b))).copied();
        Some(Put { shape, at: Vector3::new(number(0), number(1), number(2)), turn, mass })
    };
    (0..which.nrows()).map(|i| (0..which.ncols()).filter_map(|b| one(i, b)).collect()).collect()
}
