//! A question about a scene, asked as `voussoir ask` asks it.

use analysis::{Control, Question, ask as answer_to, saved};
use base::{
    error::{InputError, JsonPath},
    limits,
};
use check::proof::work::Work;
use model::interface::prepare;
use report::{
    page, tell,
    text::{Asked, Layout, TextOptions, render},
    view::{View, frames},
};
use serde::Deserialize;
use serde_json::{Value, json};

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
