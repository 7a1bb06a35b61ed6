//! One question of many scenes, on threads, without any text in between.

use crate::{
    arrays, ask,
    error::Trouble,
    scene::{Ready, Scene},
    wait::{self, Watch},
};
use numpy::PyArray1;
use pyo3::prelude::*;
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    sync::atomic::{AtomicUsize, Ordering},
};
use voussoir::{
    analysis::{self, Control, Question},
    parallel,
    sweep::{RowAnswer, RowStatus},
};

/// One answer: its status, its value and its bracket, or why there is none.
struct Line {
    answer: RowAnswer,
    error: Option<String>,
}

/// Status words, values, lower and upper ends of one question, one a scene.
type Columns<'py> = (
    Vec<&'static str>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<f64>>,
    Vec<(usize, String)>,
);

/// Asks questions of scenes, as rows of sweeps are asked; one column a question. A scene that fails
/// is `error`, with its words in the last list.
#[pyfunction]
#[pyo3(signature = (scenes, questions, *, keep_all=false, threads=0, progress=None))]
pub fn ask_many<'py>(
    py: Python<'py>,
    scenes: Vec<PyRef<Scene>>,
    questions: Vec<Bound<PyAny>>,
    keep_all: bool,
    threads: i64,
    progress: Option<&Bound<PyAny>>,
) -> PyResult<Vec<Columns<'py>>> {
    let threads = wait::threads(py, threads)?;
    let ready: Vec<Ready> = scenes.iter().map(|s| s.ready()).collect();
    drop(scenes);
    let questions: Vec<Question> = questions.iter().map(ask::question).collect::<PyResult<_>>()?;
    let count = questions.len();
    let lines = wait::run(py, progress, move |watch| {
        let (done, total) = (AtomicUsize::new(0), ready.len() as f64);
        let control = Control { keep_all, ..Control::default() };
        let one = |ready: &Ready| {
            if watch.is_cancelled() {
                return Vec::new();
            }
            let lines = answers(ready, &questions, &control, watch);
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            watch.tell(done as f64, total, || "scenes".into());
            lines
        };
        parallel::map(threads, &ready, one).map_err(Trouble::other)
    })?;
    Ok((0..count).map(|k| columns(py, &lines, k)).collect())
}

/// The answers about one scene, which is prepared once. A mistake in the program costs this scene
/// alone.
fn answers(ready: &Ready, questions: &[Question], control: &Control, watch: &Watch) -> Vec<Line> {
    let failed = |e: &str| {
        let line = || Line { answer: RowAnswer::of(RowStatus::Error), error: Some(e.to_string()) };
        questions.iter().map(|_| line()).collect()
    };
    let asked = || -> Result<Vec<Line>, Trouble> {
        let model = ready.prepared(&|| watch.is_cancelled())?;
        let one = |question: &Question| {
            let question = question.for_one_number();
            match analysis::ask(&question, &ready.scene, &model, control) {
                Ok(answer) => Line { answer: RowAnswer::of_answer(&answer), error: None },
                Err(e) => {
                    let error = Some(e.to_string());
                    Line { answer: RowAnswer::of(RowStatus::Error), error }
                }
            }
        };
        Ok(questions.iter().map(one).collect())
    };
    match catch_unwind(AssertUnwindSafe(asked)) {
        Ok(Ok(lines)) => lines,
        Ok(Err(e)) => failed(&e.to_string()),
        Err(_) => failed("the program failed on this scene (please report it)"),
    }
}

fn columns<'py>(py: Python<'py>, lines: &[Vec<Line>], k: usize) -> Columns<'py> {
    let column = |number: fn(&RowAnswer) -> Option<f64>| {
        let numbers = lines.iter().map(|l| l.get(k).and_then(|l| number(&l.answer)));
        arrays::numbers(py, numbers.map(|n| n.unwrap_or(f64::NAN)).collect())
    };
    let errors = lines
        .iter()
        .enumerate()
        .filter_map(|(i, l)| l.get(k).and_then(|l| l.error.clone()).map(|e| (i, e)));
    (
        lines.iter().map(|l| l.get(k).map_or("error", |l| l.answer.status.word())).collect(),
        column(|a| a.value),
        column(|a| a.lower),
        column(|a| a.upper),
        errors.collect(),
    )
}
