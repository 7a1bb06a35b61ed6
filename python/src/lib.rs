//! What Python's package `voussoir` is made of: scenes, the one door to every question, answers,
//! and the command. Names, types and words for people are the package's, in `package/voussoir`.

mod answer;
mod arrays;
mod ask;
mod command;
mod error;
#[path = "../../src/memory.rs"]
mod memory;
mod scene;
mod wait;

use pyo3::prelude::*;

#[global_allocator]
static MEMORY: memory::Counted = memory::Counted;

/// The compiled part of `voussoir`.
#[pymodule]
fn _core(module: &Bound<PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<scene::Scene>()?;
    module.add_class::<answer::Answer>()?;
    module.add_function(wrap_pyfunction!(ask::ask, module)?)?;
    module.add_function(wrap_pyfunction!(command::command, module)?)?;
    Ok(())
}
