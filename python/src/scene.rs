//! Scenes: what the library reads and what is built in code, with the model that was made of it.

use crate::error::Trouble;
use pyo3::{prelude::*, types::PyDict};
use pythonize::pythonize;
use serde::de::DeserializeOwned;
use std::{
    path::{Path, PathBuf},
    sync::{Arc, Mutex, PoisonError},
};
use voussoir::{
    deadline::clock,
    error::{Finding, InputError, JsonPath, Step},
    import::{Reach, read_meshes},
    interface::{Model, prepare_timed},
    limits,
    report::{Inspection, json},
    scene::{self, Shape, Source},
};

/// A scene.
#[pyclass(module = "voussoir._core")]
pub struct Scene {
    ready: Ready,
}

/// A scene on its way to a question, for any thread.
#[derive(Clone, Default)]
pub struct Ready {
    pub scene: Arc<scene::Scene>,
    /// Where it was read from, for the places of errors.
    pub source: Option<Arc<Source>>,
    /// What was said when its meshes were read.
    pub said: Arc<Vec<Finding>>,
    model: Arc<Mutex<Option<Arc<Model>>>>,
}

impl Ready {
    fn new(scene: scene::Scene, source: Option<Source>, said: Vec<Finding>) -> Self {
        Self {
            scene: Arc::new(scene),
            source: source.map(Arc::new),
            said: Arc::new(said),
            model: Arc::default(),
        }
    }

    /// Another scene made of this one, with what is to be said about it.
    pub fn changed(&self, scene: scene::Scene, said: Vec<Finding>) -> Self {
        Self { source: self.source.clone(), ..Self::new(scene, None, said) }
    }

    /// The scene resolved, with its contacts: made once, and kept for the next question.
    pub fn model(&self, is_over: &dyn Fn() -> bool) -> Result<Arc<Model>, Trouble> {
        let model = self.prepared(is_over)?;
        *self.model.lock().unwrap_or_else(PoisonError::into_inner) = Some(model.clone());
        Ok(model)
    }

    /// The same, not kept: where there are many scenes, each asked once.
    pub fn prepared(&self, is_over: &dyn Fn() -> bool) -> Result<Arc<Model>, Trouble> {
        if let Some(model) = &*self.model.lock().unwrap_or_else(PoisonError::into_inner) {
            return Ok(model.clone());
        }
        let mut model =
            prepare_timed(&self.scene, is_over, &clock).map_err(|e| match is_over() {
                true => Trouble::TimeIsUp(e.to_string()),
                false => self.located(e),
            })?;
        model.assembly.said = self.said.to_vec();
        let points = model.contact_points() as u64;
        limits::afford(
            &format!("solving for {points} contact points"),
            points,
            limits::PER_CONTACT_POINT,
        )?;
        Ok(Arc::new(model))
    }

    /// An error with its place in the file.
    pub fn located(&self, error: InputError) -> Trouble {
        match &self.source {
            Some(source) if !error.path.0.is_empty() => source.located(error).into(),
            _ => error.into(),
        }
    }
}

/// A value of Python as one of the library, by way of its JSON text: the reader of files says what is
/// wrong with it, and is compiled once.
pub fn value<T>(
    value: &Bound<PyAny>,
    read: impl FnOnce(String) -> Result<T, InputError>,
) -> PyResult<T> {
    let py = value.py();
    let text: String = py.import("voussoir._plain")?.call_method1("text", (value,))?.extract()?;
    read(text).map_err(|e| Trouble::from(e).raise(py))
}

/// What is wrong with a value whose text Python wrote: of all that it writes only NaN and infinity are
/// no JSON.
pub fn wrong(error: &serde_json::Error) -> String {
    if error.is_syntax() {
        return "must be a finite number".into();
    }
    let message = error.to_string();
    message.split(" at line ").next().unwrap_or_default().into()
}

/// A part of a scene, whose errors are told by its place in a scene.
fn part<T: DeserializeOwned>(item: &Bound<PyAny>, place: JsonPath) -> PyResult<T> {
    value(item, |text| {
        let mut reader = serde_json::Deserializer::from_str(&text);
        serde_path_to_error::deserialize(&mut reader)
            .map_err(|e| InputError::at(steps(place, e.path()), wrong(e.inner())))
    })
}

/// The same place for people.
pub fn steps(start: JsonPath, path: &serde_path_to_error::Path) -> JsonPath {
    use serde_path_to_error::Segment;
    path.iter().fold(start, |place, step| match step {
        Segment::Seq { index } => place.index(*index),
        Segment::Map { key } => place.key(key.as_str()),
        Segment::Enum { variant } => place.key(variant.as_str()),
        Segment::Unknown => place,
    })
}

fn place(keys: &[&str], index: usize) -> JsonPath {
    let keys = keys.iter().map(|k| Step::Key(k.to_string()));
    JsonPath(keys.chain([Step::Index(index)]).collect())
}

impl Scene {
    pub fn ready(&self) -> Ready {
        self.ready.clone()
    }

    pub fn of_scene(scene: scene::Scene) -> Self {
        Self { ready: Ready::new(scene, None, Vec::new()) }
    }

    /// The scene to be changed: what was made of it before is of another one.
    fn change(&mut self) -> &mut scene::Scene {
        self.ready.model = Arc::default();
        self.ready.source = None;
        Arc::make_mut(&mut self.ready.scene)
    }

    fn parsed(
        py: Python,
        name: String,
        text: String,
        folder: &Path,
        outside: bool,
    ) -> Result<Self, PyErr> {
        let reach = if outside { Reach::Anywhere } else { Reach::Folder };
        let read = || -> Result<Self, InputError> {
            let (mut scene, source) = scene::read_str(name, text)?;
            let said = read_meshes(&mut scene, folder, reach).map_err(|e| source.located(e))?;
            Ok(Self { ready: Ready::new(scene, Some(source), said) })
        };
        py.detach(read).map_err(|e| Trouble::from(e).raise(py))
    }
}

#[pymethods]
impl Scene {
    #[new]
    fn new() -> Self {
        Self { ready: Ready::default() }
    }

    /// Reads a file.
    #[staticmethod]
    fn read(py: Python, path: PathBuf, allow_outside: bool) -> PyResult<Self> {
        let read = || -> Result<(String, Vec<u8>), InputError> {
            let bytes = limits::read_file(&path, limits::PER_BYTE)?;
            Ok((path.display().to_string(), bytes))
        };
        let (name, bytes) = py.detach(read).map_err(|e| Trouble::from(e).raise(py))?;
        let text = match String::from_utf8(bytes) {
            Ok(text) => text,
            // The library says where it ends to be text.
            Err(e) => {
                let error = scene::read_bytes(name, e.into_bytes()).err();
                let error = error.map_or(Trouble::Other("not a text file".into()), Trouble::from);
                return Err(error.raise(py));
            }
        };
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::parsed(py, name, text, folder, allow_outside)
    }

    /// Reads text; meshes are looked for in `folder`.
    #[staticmethod]
    fn parse(
        py: Python,
        name: String,
        text: String,
        folder: PathBuf,
        allow_outside: bool,
    ) -> PyResult<Self> {
        Self::parsed(py, name, text, &folder, allow_outside)
    }

    /// Takes plain values.
    #[staticmethod]
    fn of(py: Python, data: &Bound<PyDict>, folder: PathBuf, outside: bool) -> PyResult<Self> {
        // It has no lines: its places are paths.
        let placeless = |e| InputError { file: None, position: None, ..e };
        let named = |text| scene::read_str("", text).map(|(s, _)| s).map_err(placeless);
        let mut scene: scene::Scene = value(data.as_any(), named)?;
        let reach = if outside { Reach::Anywhere } else { Reach::Folder };
        let said = read_meshes(&mut scene, &folder, reach);
        let said = said.map_err(|e| Trouble::from(e).raise(py))?;
        Ok(Self { ready: Ready::new(scene, None, said) })
    }

    /// Adds to a list of the scene.
    fn add(&mut self, list: &str, item: &Bound<PyAny>) -> PyResult<()> {
        macro_rules! push {
            ($place:expr, $($field:ident).+) => {{
                let item = part(item, place(&$place, self.ready.scene.$($field).+.len()))?;
                self.change().$($field).+.push(item);
            }};
        }
        match list {
            "blocks" => {
                push!(["blocks"], blocks);
                let scene = self.change();
                if matches!(scene.blocks.last(), Some(b) if matches!(b.shape, Shape::Mesh { .. })) {
                    // Code may read whatever it names.
                    match read_meshes(scene, Path::new(""), Reach::Anywhere) {
                        Ok(said) => Arc::make_mut(&mut self.ready.said).extend(said),
                        Err(e) => {
                            scene.blocks.pop();
                            return Err(Trouble::from(e).raise(item.py()));
                        }
                    }
                }
            }
            "templates" => push!(["templates"], templates),
            "interfaces" => push!(["interfaces"], interfaces),
            "members" => push!(["members"], members),
            "stages" => push!(["stages"], stages),
            "combinations" => push!(["combinations"], combinations),
            "overrides" => push!(["joints", "overrides"], joints.overrides),
            "dead" => push!(["loads", "dead"], loads.dead),
            "live" => push!(["loads", "live"], loads.live),
            "masses" => push!(["loads", "masses"], loads.masses),
            _ => return Err(Trouble::Other(format!("a scene has no list {list}")).raise(item.py())),
        }
        Ok(())
    }

    /// Sets a value of the scene.
    fn set(&mut self, key: &str, item: &Bound<PyAny>) -> PyResult<()> {
        let root = JsonPath::root().key(key);
        match key {
            "name" => self.change().name = part(item, root)?,
            "source" => self.change().source = part(item, root)?,
            "gravity" => self.change().gravity = part(item, root)?,
            "materials" => self.change().materials = part(item, root)?,
            "joint" => {
                let rule = part(item, JsonPath::root().key("joints").key("default"))?;
                self.change().joints.default = rule;
            }
            "contact" => self.change().contact = part(item, root)?,
            "record" => self.change().record = part(item, root)?,
            "require" => self.change().require = part(item, root)?,
            "site" => self.change().site = part(item, root)?,
            "train" => self.change().train = part(item, root)?,
            _ => return Err(Trouble::Other(format!("a scene has no {key}")).raise(item.py())),
        }
        Ok(())
    }

    /// The scene as plain values.
    fn plain<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(pythonize(py, &*self.ready.scene)?)
    }

    /// The scene as JSON text.
    fn json(&self, py: Python) -> PyResult<String> {
        json::pretty(&*self.ready.scene).map_err(|e| Trouble::other(e).raise(py))
    }

    /// A copy that changes by itself.
    fn copy(&self) -> Self {
        Self { ready: Ready { model: Arc::default(), ..self.ready.clone() } }
    }

    /// Its name.
    fn name(&self) -> &str {
        &self.ready.scene.name
    }

    /// Blocks and templates.
    fn counts(&self) -> (usize, usize) {
        (self.ready.scene.blocks.len(), self.ready.scene.templates.len())
    }

    /// The scene as it was resolved, with its contacts, as plain values.
    fn inspect<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let ready = self.ready();
        let model = crate::wait::run(py, None, move |w| ready.model(&|| w.is_cancelled()))?;
        Ok(pythonize(py, &Inspection::new(&model).with_train(&self.ready.scene))?)
    }

    /// What is to be known about it: code, text, whether the scene is likely another one than is
    /// meant, whether it is likely a mistake.
    fn findings(&self, py: Python) -> PyResult<Vec<(String, String, bool, bool)>> {
        let ready = self.ready();
        let model = crate::wait::run(py, None, move |w| ready.model(&|| w.is_cancelled()))?;
        Ok(model.findings().map(told).collect())
    }
}

/// A finding as plain values.
pub fn told(finding: &Finding) -> (String, String, bool, bool) {
    let code = serde_json::to_value(finding.code).ok();
    let code = code.and_then(|c| c.as_str().map(str::to_string)).unwrap_or_default();
    (code, finding.text.clone(), finding.code.is_implausible(), finding.code.is_mistake())
}
