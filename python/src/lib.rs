//! What Python's package `voussoir` is made of: scenes, the one door to every question, answers,
//! and the command. Names, types and words for people are the package's, in `package/voussoir`.

mod answer;
mod arrays;
mod ask;
mod batch;
mod command;
mod error;
mod heap;
mod import;
#[path = "../../src/memory.rs"]
mod memory;
mod piles;
mod scene;
mod sweep;
mod wait;

use pyo3::prelude::*;

#[global_allocator]
static MEMORY: memory::Counted = memory::Counted;

/// The compiled part of `voussoir`.
#[pymodule]
fn _core(module: &Bound<PyModule>) -> PyResult<()> {
    memory::heed_threads();
    voussoir::parallel::heed_environment();
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<scene::Scene>()?;
    module.add_class::<answer::Answer>()?;
    module.add_class::<sweep::Rows>()?;
    module.add_class::<heap::Heaps>()?;
    module.add_class::<piles::Piles>()?;
    module.add_function(wrap_pyfunction!(ask::ask, module)?)?;
    module.add_function(wrap_pyfunction!(ask::is_result, module)?)?;
    module.add_function(wrap_pyfunction!(answer::check_saved, module)?)?;
    module.add_function(wrap_pyfunction!(batch::ask_many, module)?)?;
    module.add_function(wrap_pyfunction!(sweep::sweep_file, module)?)?;
    module.add_function(wrap_pyfunction!(sweep::sweep_scene, module)?)?;
    module.add_function(wrap_pyfunction!(heap::heaps, module)?)?;
    module.add_function(wrap_pyfunction!(import::import_scene, module)?)?;
    module.add_function(wrap_pyfunction!(command::command, module)?)?;
    Ok(())
}
