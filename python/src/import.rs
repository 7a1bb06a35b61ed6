//! Files of other programs, read as the command reads them.

use crate::{error::Trouble, scene::Scene};
use pyo3::prelude::*;
use std::path::PathBuf;
use voussoir::{
    error::{InputError, JsonPath},
    import::{ImportOptions, Imported, Up, import_bytes, import_files},
    scene::Friction,
};

/// Makes a scene from files (`paths`), or from one that is in memory (`name`, `bytes`). Beside it
/// stand the findings on the way.
#[pyfunction]
#[pyo3(signature = (paths, *, name=None, data=None, supports=Vec::new(), support_below=None, support_files=Vec::new(), friction=None, density=None, scale=None, up=None, gap=None, angle_deg=None, stored_interfaces=true, depth=None, layers="{}"))]
#[allow(clippy::too_many_arguments, clippy::type_complexity)]
pub fn import_scene(
    py: Python,
    paths: Vec<PathBuf>,
    name: Option<String>,
    data: Option<Vec<u8>>,
    supports: Vec<String>,
    support_below: Option<f64>,
    support_files: Vec<PathBuf>,
    friction: Option<f64>,
    density: Option<f64>,
    scale: Option<f64>,
    up: Option<&str>,
    gap: Option<f64>,
    angle_deg: Option<f64>,
    stored_interfaces: bool,
    depth: Option<f64>,
    layers: &str,
) -> PyResult<(Scene, Vec<(String, String, bool, bool)>)> {
    let up = up.map(upwards).transpose().map_err(|e| Trouble::from(e).raise(py))?;
    let friction = friction.map(|mu| match mu == f64::INFINITY {
        true => Friction::Infinite,
        false => Friction::Coefficient(mu),
    });
    let layers = serde_json::from_str(layers).map_err(|e| {
        let refused = InputError::at(JsonPath::root(), format!("layers: {e}"));
        Trouble::from(refused).raise(py)
    })?;
    let options = ImportOptions {
        supports,
        support_below,
        support_files,
        friction,
        density,
        scale,
        up,
        gap,
        angle_deg,
        stored_interfaces,
        depth,
        layers,
        ..ImportOptions::default()
    };
    let read = || match &data {
        Some(bytes) => import_bytes(name.as_deref().unwrap_or("file"), bytes, &options),
        None => import_files(&paths, &options),
    };
    let Imported { scene, findings, mut unread, .. } =
        py.detach(read).map_err(|e| Trouble::from(e).raise(py))?;
    if let Some(first) = unread.drain(..).next() {
        return Err(Trouble::from(first).raise(py));
    }
    Ok((Scene::of_scene(scene), findings.iter().map(crate::scene::told).collect()))
}

fn upwards(word: &str) -> Result<Up, InputError> {
    Ok(match word {
        "x" => Up::X,
        "y" => Up::Y,
        "z" => Up::Z,
        "-x" => Up::MinusX,
        "-y" => Up::MinusY,
        "-z" => Up::MinusZ,
        _ => {
            let path = JsonPath::root().key("up");
            let error = InputError::at(path, format!("{word:?} is not an axis"));
            return Err(error.hint("use x, y, z, -x, -y or -z"));
        }
    })
}
