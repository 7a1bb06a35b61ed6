//! Heaps of grains that flow and come to rest.

use crate::{
    error::Trouble,
    scene::{Scene, value, wrong},
    wait::{self, Watch},
};
use pyo3::{prelude::*, types::PyDict};
use pythonize::pythonize;
use std::ops::ControlFlow;
use voussoir::{
    analysis::{
        Control, Law,
        repose::{Growing, Heap, grown, margin},
    },
    error::{InputError, JsonPath},
    parallel,
    report::{
        heaps::{HeapResult, MarginResult, ReposeFile},
        json,
        text::{self, Layout, TextOptions},
    },
    scene::Protocol,
};

/// Heaps of one protocol, one a seed.
#[pyclass(module = "voussoir._core", frozen)]
pub struct Heaps {
    file: ReposeFile,
    heaps: Vec<Heap>,
}

/// Makes heaps and measures their slopes; `protocol` is what the command takes, as plain values.
#[pyfunction]
#[pyo3(signature = (protocol, seeds, *, skip_margin=false, keep_all=false, threads=0, progress=None))]
pub fn heaps(
    py: Python,
    protocol: &Bound<PyDict>,
    seeds: Vec<u64>,
    skip_margin: bool,
    keep_all: bool,
    threads: i64,
    progress: Option<&Bound<PyAny>>,
) -> PyResult<Heaps> {
    let threads = wait::threads(py, threads)?;
    let protocol: Protocol = value(protocol.as_any(), |text| {
        serde_json::from_str(&text).map_err(|e| {
            InputError::at(JsonPath::root().key("protocol"), wrong(&e)).hint(
                "the protocols are drain, funnel, cylinder, tilt, drum, hopper, shear and cell, with the values grain, elongation, corners, grains, diameter, sizes, friction, wall_friction, rolling_arm, restitution, density, size, rate, pressure, stiffness, drop, floor",
            )
        })
    })?;
    wait::run(py, progress, move |watch| {
        let inside = parallel::inside(threads, seeds.len());
        let one = |seed: &u64| made(&protocol, *seed, skip_margin, keep_all, inside, watch);
        let done = parallel::try_map(threads, &seeds, one).map_err(Trouble::other)??;
        let (results, heaps): (Vec<_>, Vec<_>) = done.into_iter().unzip();
        Ok(Heaps { file: ReposeFile::new(&protocol, results), heaps })
    })
}

fn made(
    protocol: &Protocol,
    seed: u64,
    skip_margin: bool,
    keep_all: bool,
    threads: usize,
    watch: &Watch,
) -> Result<(HeapResult, Heap), Trouble> {
    let control = Control {
        law: Law::Associative,
        keep_all,
        deadline: watch.deadline(None),
        ..Control::default()
    };
    let statics = (!skip_margin).then_some(&control);
    let heap = grown(protocol, seed, &Growing { own: None, statics, threads }, &mut |flow| {
        watch.tell(flow.time, 0.0, || {
            format!(
                "seed {seed}, stage {}: {:.0} √(d/g), {:.1e} m g d per grain",
                flow.stage + 1,
                flow.time,
                flow.energy
            )
        });
        if watch.is_cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })?;
    let asked = heap.rested && !skip_margin && protocol.kind.leaves_a_slope();
    let margin = asked.then(|| margin(&heap, &control)).transpose()?;
    Ok((HeapResult::new(&heap, margin.as_ref().map(MarginResult::from)), heap))
}

#[pymethods]
impl Heaps {
    /// What [`restored`](Self::restored) makes the same heaps of.
    fn state(&self, py: Python) -> PyResult<String> {
        let state = serde_json::to_string(&(&self.file, &self.heaps));
        state.map_err(|e| Trouble::other(e).raise(py))
    }

    /// Heaps of their state.
    #[staticmethod]
    fn restored(py: Python, state: &str) -> PyResult<Self> {
        let read: Result<(ReposeFile, Vec<Heap>), _> = serde_json::from_str(state);
        let (file, heaps) = read.map_err(|e| Trouble::other(e).raise(py))?;
        Ok(Self { file, heaps })
    }

    /// All of it as plain values.
    fn plain<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(pythonize(py, &self.file)?)
    }

    /// The same as the command prints it with `--json`.
    fn json(&self, py: Python) -> PyResult<String> {
        json::pretty(&self.file).map_err(|e| Trouble::other(e).raise(py))
    }

    /// The same in words.
    #[pyo3(signature = (brief=false))]
    fn text(&self, brief: bool) -> String {
        let options = TextOptions { verbose: false, brief };
        text::heaps(&self.file, options, Layout::default()).to_string()
    }

    /// The heaps as they lie, a scene each.
    fn scenes(&self) -> Vec<Scene> {
        self.heaps.iter().map(|h| Scene::of_scene(h.scene.clone())).collect()
    }
}
