//! Sweeps: a plan, its rows as columns, and what is made of them.

use crate::{
    arrays,
    error::Trouble,
    scene::{Scene, value},
    wait,
};
use numpy::PyArray1;
use pyo3::{prelude::*, types::PyDict};
use pythonize::pythonize;
use std::{
    path::{Path, PathBuf},
    sync::atomic::{AtomicUsize, Ordering},
};
use voussoir::{
    error::InputError,
    import::Reach,
    limits,
    report::{
        json, page,
        sweep::{self as report, Kind},
        text::Layout,
    },
    sweep::{self, Event, Header, Parameter, Plan, Row, RowAnswer, RunOptions, Summary, Sweep},
};

/// The rows of a sweep.
#[pyclass(module = "voussoir._core", frozen)]
pub struct Rows {
    header: Header,
    rows: Vec<Row>,
    summary: Summary,
}

/// Reads a plan from a file, and answers its rows into the file `output`.
#[pyfunction]
#[pyo3(signature = (plan, output, *, allow_outside=false, threads=0, restart=false, progress=None))]
pub fn sweep_file(
    py: Python,
    plan: PathBuf,
    output: PathBuf,
    allow_outside: bool,
    threads: i64,
    restart: bool,
    progress: Option<&Bound<PyAny>>,
) -> PyResult<Rows> {
    let open = || -> Result<Sweep, InputError> {
        let reach = if allow_outside { Reach::Anywhere } else { Reach::Folder };
        let folder = plan.parent().unwrap_or(Path::new(""));
        let bytes = limits::read_file(&plan, limits::PER_BYTE)?;
        sweep::open_bytes(plan.display().to_string(), bytes, folder, reach)
    };
    let sweep = py.detach(open).map_err(|e| Trouble::from(e).raise(py))?;
    run(py, sweep, output, threads, restart, progress)
}

/// Answers the rows of a plan of plain values, whose scene is another argument.
#[pyfunction]
#[pyo3(signature = (plan, scene, output, *, threads=0, restart=false, progress=None))]
pub fn sweep_scene(
    py: Python,
    plan: &Bound<PyAny>,
    scene: &Scene,
    output: PathBuf,
    threads: i64,
    restart: bool,
    progress: Option<&Bound<PyAny>>,
) -> PyResult<Rows> {
    let placeless = |e| InputError { file: None, position: None, ..e };
    let read = |text: String| {
        sweep::read_plan("", text.into_bytes()).map(|(plan, _)| plan).map_err(placeless)
    };
    let plan: Plan = value(plan, read)?;
    let scene = serde_json::to_value(&*scene.ready().scene);
    let scene = scene.map_err(|e| Trouble::other(e).raise(py))?;
    let sweep = Sweep::new(plan, scene).map_err(|e| Trouble::from(e).raise(py))?;
    run(py, sweep, output, threads, restart, progress)
}

fn run(
    py: Python,
    sweep: Sweep,
    output: PathBuf,
    threads: i64,
    restart: bool,
    progress: Option<&Bound<PyAny>>,
) -> PyResult<Rows> {
    let threads = wait::threads(py, threads)?;
    wait::run(py, progress, move |watch| {
        let (there, total) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let see = |event: Event| {
            let done = match event {
                Event::Begin { rows, there: done, .. } => {
                    total.store(rows, Ordering::Relaxed);
                    there.fetch_add(done, Ordering::Relaxed) + done
                }
                Event::Row(_) => there.fetch_add(1, Ordering::Relaxed) + 1,
            };
            let total = total.load(Ordering::Relaxed);
            watch.tell(done as f64, total as f64, || "rows".into());
        };
        let options =
            RunOptions { threads: (threads > 0).then_some(threads), restart, ..Default::default() };
        let done = sweep::run_until(&sweep, &output, &options, &see, watch.deadline(None));
        let done = done.map_err(Trouble::other)?;
        let summary = sweep::summarize(&done.header, &done.rows);
        Ok(Rows { header: done.header, rows: done.rows, summary })
    })
}

fn numbers<'py>(
    py: Python<'py>,
    rows: &[Row],
    number: impl Fn(&RowAnswer) -> Option<f64>,
) -> Bound<'py, PyArray1<f64>> {
    let numbers = rows.iter().map(|r| number(&r.answer).unwrap_or(f64::NAN));
    arrays::numbers(py, numbers.collect())
}

#[pymethods]
impl Rows {
    /// What [`restored`](Self::restored) makes the same rows of.
    fn state(&self, py: Python) -> PyResult<String> {
        let state = serde_json::to_string(&(&self.header, &self.rows));
        state.map_err(|e| Trouble::other(e).raise(py))
    }

    /// Rows of their state.
    #[staticmethod]
    fn restored(py: Python, state: &str) -> PyResult<Self> {
        let read: Result<(Header, Vec<Row>), _> = serde_json::from_str(state);
        let (header, rows) = read.map_err(|e| Trouble::other(e).raise(py))?;
        let summary = sweep::summarize(&header, &rows);
        Ok(Self { header, rows, summary })
    }

    /// Rows that are there.
    fn __len__(&self) -> usize {
        self.rows.len()
    }

    /// What varies: names, and the values of each, numbers as arrays and words as lists.
    fn parameters<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let columns = PyDict::new(py);
        for (k, vary) in self.header.plan.vary.iter().enumerate() {
            let name = vary.name.clone().unwrap_or_else(|| vary.pointer.clone());
            let values = || self.rows.iter().filter_map(|r| r.parameters.get(k));
            let number = |p: &Parameter| match p {
                Parameter::Number(v) => Some(*v),
                Parameter::Word(_) => None,
            };
            match values().map(number).collect::<Option<Vec<f64>>>() {
                Some(numbers) => columns.set_item(name, arrays::numbers(py, numbers))?,
                None => {
                    let words: Vec<String> = values()
                        .map(|p| match p {
                            Parameter::Number(v) => v.to_string(),
                            Parameter::Word(w) => w.clone(),
                        })
                        .collect();
                    columns.set_item(name, words)?;
                }
            }
        }
        Ok(columns)
    }

    /// What came out: `row`, `status`, `value`, `lower`, `upper`, `seconds`, `error`.
    fn answers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let columns = PyDict::new(py);
        let row: Vec<i64> = self.rows.iter().map(|r| r.row as i64).collect();
        columns.set_item("row", arrays::numbers(py, row))?;
        let status: Vec<_> = self.rows.iter().map(|r| r.answer.status.word()).collect();
        columns.set_item("status", status)?;
        columns.set_item("value", numbers(py, &self.rows, |a| a.value))?;
        columns.set_item("lower", numbers(py, &self.rows, |a| a.lower))?;
        columns.set_item("upper", numbers(py, &self.rows, |a| a.upper))?;
        let error: Vec<_> = self.rows.iter().map(|r| r.error.clone()).collect();
        columns.set_item("error", error)?;
        let seconds = self.rows.iter().map(|r| r.seconds).collect();
        columns.set_item("seconds", arrays::numbers(py, seconds))?;
        Ok(columns)
    }

    /// What the rows have in common, as plain values.
    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(pythonize(py, &self.summary)?)
    }

    /// The same as the command prints it with `--json`.
    fn json(&self, py: Python) -> PyResult<String> {
        let document = report::Document::new(&self.header, &self.summary);
        json::pretty(&document).map_err(|e| Trouble::other(e).raise(py))
    }

    /// The same in words.
    #[pyo3(signature = (brief=false))]
    fn text(&self, brief: bool) -> String {
        report::summary(&self.header, &self.summary, brief, Layout::default()).to_string()
    }

    /// The rows as a table with commas.
    fn csv(&self, py: Python) -> PyResult<String> {
        report::csv(&self.header, &self.rows).map_err(|e| Trouble::other(e).raise(py))
    }

    /// A chart: `line`, `heat`, `fragility`, or what suits the rows.
    #[pyo3(signature = (kind=None))]
    fn svg(&self, py: Python, kind: Option<&str>) -> PyResult<String> {
        let kind = match kind {
            None => Kind::suited(&self.header, &self.summary),
            Some("line") => Kind::Line,
            Some("heat") => Kind::Heat,
            Some("fragility") => Kind::Fragility,
            Some(other) => {
                let text =
                    format!("unknown chart {other}; the charts are line, heat and fragility");
                return Err(Trouble::Other(text).raise(py));
            }
        };
        kind.fits(&self.header.plan).map_err(|e| Trouble::other(e).raise(py))?;
        let chart = report::chart(&self.header, &self.rows, &self.summary, kind);
        chart.map_err(|e| Trouble::other(e).raise(py))
    }

    /// A page for a browser.
    fn page(&self, py: Python) -> PyResult<String> {
        let layout = Layout { width: usize::MAX, ..Layout::default() };
        let words = report::summary(&self.header, &self.summary, false, layout);
        page::sweep(&words, &self.header, &self.rows, &self.summary)
            .map_err(|e| Trouble::other(e).raise(py))
    }
}
