//! A question about a scene, asked as `voussoir ask` asks it.

use analysis::{Control, Question, ask as answer_to, saved};
use base::{
    error::{InputError, JsonPath},
    limits,
};
use check::proof::work::Work;
use data_encoding::BASE64;
use model::interface::prepare;
use report::{
    imported::examine,
    page, tell,
    text::{Asked, Layout, TextOptions, render},
    view::{View, frames},
};
use scene::{
    Friction,
    import::{ImportOptions, LayerRule, import_bytes},
};
use serde::Deserialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// What is asked of what.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Request {
    /// Name of the scene in messages.
    name: String,
    /// The text of a scene file.
    scene: String,
    /// The question as it stands in a saved result.
    question: Question,
}

/// A file of another program, and what is said of it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Foreign {
    /// The file's name, which tells its format.
    name: String,
    /// Its bytes, in base64.
    data: String,
    /// Coefficient of friction of every joint.
    friction: Option<f64>,
    /// Thickness of what is drawn in a plane, m.
    depth: Option<f64>,
    /// Metres in a unit of the file, where it does not say.
    scale: Option<f64>,
    /// Gap that joints may have, relative to the smaller block's size.
    gap: Option<f64>,
    /// Blocks whose lowest corner lies below this height are held, m.
    support_below: Option<f64>,
    /// What layers stand for.
    #[serde(default)]
    layers: BTreeMap<String, LayerRule>,
}

/// Makes a scene of a file of another program: `{"name", "data", …}`. The reply has the `scene` and what is
/// `said` of it, or an `error`.
pub fn import(request: &[u8]) -> Value {
    imported(request).unwrap_or_else(|e| json!({ "error": e.to_string() }))
}

fn imported(request: &[u8]) -> Result<Value, InputError> {
    let root = |e: &dyn std::fmt::Display| InputError::at(JsonPath::root(), e.to_string());
    let Foreign { name, data, friction, depth, scale, gap, support_below, layers } =
        serde_json::from_slice(request).map_err(|e| root(&e))?;
    let bytes = BASE64.decode(data.as_bytes()).map_err(|e| root(&e))?;
    let friction = friction.map(Friction::Coefficient);
    let options = ImportOptions {
        friction,
        depth,
        scale,
        gap,
        support_below,
        layers,
        ..ImportOptions::default()
    };
    let imported = import_bytes(&name, &bytes, &options)?;
    let examined = examine(&imported, &options, &|| false);
    let notes = imported.findings.iter().chain(&examined.findings).map(|f| &f.text);
    let said: Vec<&String> =
        std::iter::once(&examined.summary).chain(notes).chain(&examined.broken).collect();
    Ok(json!({ "scene": imported.scene.to_value().map_err(|e| root(&e))?, "said": said }))
}

/// Answers a question about a scene: `{"name", "scene", "question"}`. The reply has the `result` that
/// `--save` would write, `text`, its words, and `html`, the page that `--report` would write; or an `error`.
pub fn ask(request: &[u8]) -> Value {
    answered(request).unwrap_or_else(|e| json!({ "error": e.to_string() }))
}

fn answered(request: &[u8]) -> Result<Value, InputError> {
    let root = |e: &dyn std::fmt::Display| InputError::at(JsonPath::root(), e.to_string());
    let Request { name, scene, question } =
        serde_json::from_slice(request).map_err(|e| root(&e))?;
    let (scene, source) = scene::read_bytes(name.as_str(), scene.into_bytes())?;
    let located = |e: InputError| match e.position.is_some() || e.path.0.is_empty() {
        true => e,
        false => source.located(e),
    };
    let model = prepare(&scene).map_err(located)?;
    let points = model.contact_points() as u64;
    limits::afford("solving for the contact points", points, limits::PER_CONTACT_POINT)?;
    let control = Control::default();
    let found = answer_to(&question, &scene, &model, &control).map_err(located)?;
    let mut file =
        saved::of_question(&question, &scene, &model, &found, &control).map_err(located)?;
    file.run.work = Some(Work::of(&file, &model));
    let view = View::new(&model, &file, frames(&model, &file)).map_err(|e| root(&e))?;
    let layout = Layout { unnamed: &name, width: usize::MAX };
    let options = TextOptions { verbose: true, brief: false };
    let asked = Asked { scene: &name, ..Asked::default() };
    let words = render(&file, asked, options, layout);
    let html = page::page(&words, &view, &tell::charts(&file)).map_err(|e| root(&e))?;
    Ok(json!({
        "result": file.to_value().map_err(|e| root(&e))?,
        "text": words.to_string(),
        "html": html,
    }))
}
