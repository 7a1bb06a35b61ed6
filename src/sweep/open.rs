//! Plan file → [`Sweep`]: everything that can be wrong before the first row is refused here, with
//! its place in the plan.

use super::{
    Header, Parameter, Plan, Sampling, Shard,
    distribution::Axis,
    pointer::Pointer,
    records,
    sampling::{SOBOL, Sampler},
};
use analysis::{Question, model_cache::Keys};
use base::{
    error::{Finding, InputError, JsonPath},
    limits,
};
use model::assembly::{self, Wrench};
use scene::{
    Kind, Scene, Shape, Source, Touches,
    import::{Reach, read_meshes},
};
use serde_json::Value;
use std::path::Path;

/// A plan may have this many rows. More would not fit into the memory of the summary; shards of a
/// plan count together.
pub const MOST_ROWS: usize = 2_000_000;

const PLAN: Kind = Kind { noun: "plan", format: "voussoir-sweep/1", otherwise: "" };

/// A plan that can be run.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// The plan as read.
    pub plan: Plan,
    /// The scene as the file says it, with the meshes it names; every row changes a few numbers of
    /// it.
    pub scene: Value,
    /// What was said when the meshes of the scene were read.
    pub findings: Vec<Finding>,
    pointers: Vec<Pointer>,
    /// Those that lead into the question.
    asks: Vec<bool>,
    touches: Vec<Touches>,
    sampler: Sampler,
}

/// Reads a plan and the scene it names.
///
/// # Errors
/// The plan or its scene cannot be read, or the plan asks for something that has no meaning.
pub fn open(path: &Path) -> Result<Sweep, InputError> {
    let bytes = limits::read_file(path, limits::PER_BYTE)?;
    open_bytes(
        path.display().to_string(),
        bytes,
        path.parent().unwrap_or(Path::new("")),
        Reach::Folder,
    )
}

/// Reads a plan from the bytes of a file, without the scene it names.
///
/// # Errors
/// The bytes are not UTF-8, not JSON, or not a plan.
pub fn read_plan(name: impl Into<String>, bytes: Vec<u8>) -> Result<(Plan, Source), InputError> {
    scene::read_as(&PLAN, scene::text(name, bytes)?)
}

/// Reads a plan from the bytes of a file; its scene is looked for in `folder`. The meshes that the
/// scene names become part of it, so that rows need no file.
///
/// # Errors
/// As [`open`].
pub fn open_bytes(
    name: impl Into<String>,
    bytes: Vec<u8>,
    folder: &Path,
    reach: Reach,
) -> Result<Sweep, InputError> {
    let (mut plan, source) = read_plan(name, bytes)?;
    let refuse = |e: InputError| source.located(e);
    records::read(&mut plan, folder).map_err(refuse)?;
    let key = JsonPath::root().key("scene");
    let path = folder.join(&plan.scene);
    let bytes = limits::read_file(&path, limits::PER_BYTE).map_err(|e| {
        let error = InputError::at(key, format!("the scene {}: {}", path.display(), e.message));
        refuse(error.hint("the path is relative to the folder of the plan"))
    })?;
    let (mut scene, scene_source) = scene::read_bytes(path.display().to_string(), bytes)?;
    let mut value: Value = serde_json::from_str(&scene_source.text).map_err(|e| InputError {
        file: Some(scene_source.name.clone()),
        ..InputError::at(JsonPath::root(), e.to_string())
    })?;
    let findings = read_meshes(&mut scene, path.parent().unwrap_or(Path::new("")), reach)
        .map_err(|e| scene_source.located(e))?;
    for (block, written) in scene
        .blocks
        .iter()
        .zip(value.get_mut("blocks").and_then(Value::as_array_mut).into_iter().flatten())
    {
        if let (Shape::Mesh { .. }, Some(written)) = (&block.shape, written.as_object_mut()) {
            let shape = serde_json::to_value(&block.shape)
                .map_err(|e| InputError::at(JsonPath::root(), e.to_string()))?;
            written.insert("shape".into(), shape);
        }
    }
    Ok(Sweep { findings, ..Sweep::new(plan, value).map_err(refuse)? })
}

impl Sweep {
    /// Checks a plan against its scene.
    ///
    /// # Errors
    /// Something in the plan has no meaning; paths are relative to the plan.
    pub fn new(plan: Plan, scene: Value) -> Result<Self, InputError> {
        let root = JsonPath::root();
        let grid = matches!(plan.sampling, Sampling::Grid {});
        if plan.vary.is_empty() {
            return Err(InputError::at(root.key("vary"), "nothing varies")
                .hint("add { \"pointer\": …, \"from\": …, \"to\": …, \"count\": … }"));
        }
        plan.question
            .check()
            .and_then(|()| plan.question.check_for_one_number())
            .map_err(|e| e.under(&root.key("question")))?;
        let question = serde_json::to_value(&plan.question)
            .map_err(|e| InputError::at(root.key("question"), e.to_string()))?;
        let (mut pointers, mut axes, mut asks) = (Vec::new(), Vec::new(), Vec::new());
        for (k, vary) in plan.vary.iter().enumerate() {
            let path = root.key("vary").index(k);
            let axis = Axis::new(vary, grid).map_err(|e| e.under(&path))?;
            let at_values = path.key("values");
            let path = path.key("pointer");
            let own = vary.pointer.strip_prefix("/question").filter(|rest| rest.starts_with('/'));
            let (place, text) = match own {
                Some(rest) => (Target::Question(&plan, &question), rest),
                None => (Target::Scene(&scene), vary.pointer.as_str()),
            };
            let pointer = match vary.words() {
                None => Pointer::find(text, place.value()),
                Some(_) => Pointer::find_word(text, place.value()),
            }
            .map_err(|e| e.under(&path))?;
            match vary.words() {
                None => fits(&pointer, &axis, place).map_err(|e| e.under(&path))?,
                Some(words) => {
                    words_fit(&pointer, words, place).map_err(|e| e.under(&at_values))?
                }
            }
            asks.push(own.is_some());
            if pointers.contains(&pointer) {
                return Err(InputError::at(path, format!("{:?} varies twice", vary.pointer))
                    .hint("keep one of them"));
            }
            pointers.push(pointer);
            axes.push(axis);
        }
        let rows = rows(&plan, &axes)?;
        let touches = pointers.iter().zip(&asks).map(|(p, &asks)| match asks {
            true => Touches::Loads,
            false => p.touches(&scene),
        });
        let touches = touches.collect();
        let sampler = Sampler::new(axes, &plan.sampling, plan.seed, rows);
        let sweep = Self { plan, scene, findings: Vec::new(), pointers, asks, touches, sampler };
        sweep.words_mean_something()?;
        sweep.asks_about_something()?;
        sweep.question_with(&sweep.parameters(0)).map_err(|e| e.under(&root.key("question")))?;
        Ok(sweep)
    }

    /// Rows of all shards.
    pub fn rows(&self) -> usize {
        self.sampler.rows
    }

    /// What the numbers and words are called, in their order.
    pub fn labels(&self) -> Vec<&str> {
        self.plan.vary.iter().map(super::Vary::label).collect()
    }

    /// The numbers and words of a row.
    pub fn parameters(&self, row: usize) -> Vec<Parameter> {
        let places = self.sampler.parameters(row);
        self.plan.vary.iter().zip(places).map(|(vary, place)| vary.at(place)).collect()
    }

    /// The scene with these numbers and words.
    ///
    /// # Errors
    /// The scene does not take one of them.
    pub fn scene_with(&self, parameters: &[Parameter]) -> Result<Scene, InputError> {
        let mut value = self.scene.clone();
        for (k, parameter) in parameters.iter().enumerate().filter(|(k, _)| !self.asks[*k]) {
            self.pointers[k].set(&mut value, parameter);
        }
        read(value)
    }

    /// The question with these numbers and words, and with the record it names.
    ///
    /// # Errors
    /// The question does not take one of them; paths are relative to the question.
    pub fn question_with(&self, parameters: &[Parameter]) -> Result<Question, InputError> {
        let question = match self.asks.contains(&true) {
            false => self.plan.question.clone(),
            true => {
                let refuse = |e: serde_json::Error| InputError::at(JsonPath::root(), e.to_string());
                let mut value = serde_json::to_value(&self.plan.question).map_err(refuse)?;
                for (k, parameter) in parameters.iter().enumerate().filter(|(k, _)| self.asks[*k]) {
                    self.pointers[k].set(&mut value, parameter);
                }
                question_of(value)?
            }
        };
        records::with_record(&self.plan, question)
    }

    /// What scenes with these numbers have in common with others.
    pub fn keys(&self, parameters: &[Parameter]) -> Keys {
        let bits = |touches: Touches| {
            let all = self.touches.iter().zip(&self.asks).zip(&self.plan.vary).zip(parameters);
            let changed = all.filter(|(((t, asks), _), _)| **t == touches && !**asks);
            changed.map(|((_, vary), value)| vary.coordinate(value).to_bits()).collect()
        };
        let [shapes, masses, others] = [Touches::Shapes, Touches::Masses, Touches::Loads].map(bits);
        Keys { shapes, masses, others }
    }

    /// The first line of a file of rows.
    pub fn header(&self, shard: Shard) -> Header {
        Header::new(self, shard)
    }

    /// A name that no block has would fail in every row alike. It may be one that a row with other
    /// shapes has, and where the scene of the file is none by itself nothing is told.
    fn words_mean_something(&self) -> Result<(), InputError> {
        let resolves = |scene: &Value| read(scene.clone()).and_then(|s| assembly::resolve(&s));
        let shapes = |k: usize| {
            (0..self.touches.len()).any(|j| j != k && self.touches[j] == Touches::Shapes)
        };
        for (k, vary) in self.plan.vary.iter().enumerate() {
            let Some(words) = vary.words().filter(|_| !shapes(k)) else { continue };
            if self.asks[k] {
                continue;
            }
            if resolves(&self.scene).is_err() {
                return Ok(());
            }
            for (i, word) in words.iter().enumerate() {
                let mut scene = self.scene.clone();
                self.pointers[k].set(&mut scene, word);
                let Err(e) = resolves(&scene) else { continue };
                let path = JsonPath::root().key("vary").index(k).key("values").index(i);
                let message = format!("with the value {word:?}: {}", where_and_what(&e));
                return Err(InputError { hint: e.hint, ..InputError::at(path, message) });
            }
        }
        Ok(())
    }

    /// `limit` without a live load would fail in every row alike.
    fn asks_about_something(&self) -> Result<(), InputError> {
        let Question::Limit(_) = self.plan.question else { return Ok(()) };
        let first =
            self.scene_with(&self.parameters(0)).and_then(|scene| assembly::resolve(&scene));
        match first {
            Ok(assembly) if assembly.live.iter().all(|w| *w == Wrench::zero()) => {
                let error = InputError::at(
                    JsonPath::root().key("question"),
                    "the scene of row 0 has no live load on a free block",
                );
                Err(error.hint("add \"loads\": { \"live\": [ { \"weight\": [1, 0, 0] } ] } to the scene, or ask \"tilt\""))
            }
            // Scenes that cannot be resolved are rows with their errors.
            _ => Ok(()),
        }
    }
}

fn read(value: Value) -> Result<Scene, InputError> {
    serde_path_to_error::deserialize(value).map_err(|e| {
        let path = e.path().to_string();
        InputError::at(JsonPath::root(), format!("{path}: {}", e.inner()))
    })
}

/// A question by its JSON.
fn question_of(value: Value) -> Result<Question, InputError> {
    let question: Question = serde_path_to_error::deserialize(value).map_err(|e| {
        let path = e.path().to_string();
        InputError::at(JsonPath::root(), format!("{path}: {}", e.inner()))
    })?;
    question.check().map(|()| question)
}

/// What numbers and words are put into.
#[derive(Clone, Copy)]
enum Target<'a> {
    Scene(&'a Value),
    Question(&'a Plan, &'a Value),
}

impl Target<'_> {
    fn value(&self) -> &Value {
        match self {
            Self::Scene(value) | Self::Question(_, value) => value,
        }
    }

    fn word(&self) -> &'static str {
        match self {
            Self::Scene(_) => "scene",
            Self::Question(..) => "question",
        }
    }

    /// Whether it takes this there.
    fn takes(&self, pointer: &Pointer, parameter: &Parameter) -> Result<(), InputError> {
        let mut value = self.value().clone();
        pointer.set(&mut value, parameter);
        match self {
            Self::Scene(_) => read(value).map(|_| ()),
            Self::Question(plan, _) => records::with_record(plan, question_of(value)?)?.check(),
        }
    }
}

/// A scene or question must be able to take numbers there; of what kind is tried out.
fn fits(pointer: &Pointer, axis: &Axis, place: Target) -> Result<(), InputError> {
    let scene = place.value();
    let with = |number: f64| place.takes(pointer, &number.into());
    if let Target::Question(..) = place {
        // A question checks its numbers: only those that come are tried.
        return with(axis.quantile(0.5)).map_err(|e| {
            let text = format!("the question has no such number: {}", where_and_what(&e));
            InputError { hint: e.hint, ..InputError::at(JsonPath::root(), text) }
        });
    }
    let old = pointer.get(scene).and_then(Value::as_f64);
    let first = old.unwrap_or_else(|| axis.quantile(0.5));
    if let Err(e) = with(first).and(with(first.floor() + 1.0)) {
        return Err(InputError::at(
            JsonPath::root(),
            format!("the scene has no such number: {}", e.message),
        )
        .hint("check the spelling against the scene format"));
    }
    if !axis.is_whole() && with(first.floor() + 0.5).is_err() {
        let message = format!(
            "{} of the scene is a count, but not all its values are whole numbers",
            pointer.path
        );
        return Err(InputError::at(JsonPath::root(), message).hint("add \"round\": true"));
    }
    Ok(())
}

/// An error of the scene, with its place there.
fn where_and_what(e: &InputError) -> String {
    if e.path.0.is_empty() { e.message.clone() } else { format!("{}: {}", e.path, e.message) }
}

/// As [`fits`], of words. Paths are relative to their list.
fn words_fit(pointer: &Pointer, words: &[Parameter], place: Target) -> Result<(), InputError> {
    for (k, word) in words.iter().enumerate() {
        place.takes(pointer, word).map_err(|e| {
            let what = place.word();
            InputError::at(
                JsonPath::root().index(k),
                format!("the {what} does not accept {word} at {}: {}", pointer.path, e.message),
            )
            .hint(format!("check the spelling against the {what} format"))
        })?;
    }
    Ok(())
}

fn rows(plan: &Plan, axes: &[Axis]) -> Result<usize, InputError> {
    let path = JsonPath::root().key("sampling");
    let (key, rows) = match plan.sampling {
        Sampling::Grid {} => {
            let all = axes.iter().try_fold(1_usize, |n, axis| n.checked_mul(axis.count));
            let rows = all.filter(|n| *n <= MOST_ROWS);
            return rows.ok_or_else(|| {
                InputError::at(
                    JsonPath::root().key("vary"),
                    format!("the grid has more than {MOST_ROWS} rows"),
                )
                .hint("use fewer values, or another \"sampling\"")
            });
        }
        Sampling::LatinHypercube { samples } => ("latin_hypercube", samples),
        Sampling::Sobol { samples } => ("sobol", samples),
        Sampling::Random { samples } => ("random", samples),
    };
    let path = path.key(key).key("samples");
    if key == "sobol" && (rows > SOBOL.0 || axes.len() > SOBOL.1) {
        let message = format!(
            "Sobol sampling takes at most {} rows and {} numbers, got {rows} and {}",
            SOBOL.0,
            SOBOL.1,
            axes.len()
        );
        return Err(InputError::at(path, message).hint("use \"latin_hypercube\" or \"random\""));
    }
    match rows {
        0 => Err(InputError::at(path, "must be at least 1, got 0")),
        n if n > MOST_ROWS => {
            Err(InputError::at(path, format!("must be at most {MOST_ROWS}, got {n}")))
        }
        n => Ok(n),
    }
}
