//! What is said to a page, as JSON.

use super::{desk::Job, error, follow::File, knobs};
use crate::{
    analysis::{Answer, Control, Law, Question},
    deadline::Deadline,
    error::InputError,
    interface::Model,
    proof::{saved, work::Work},
    question::QuestionKind as Kind,
    report::{
        page, tell,
        text::{self, Asked, Layout, TextOptions},
        view::{View, frames},
    },
    scene::{Scene, Source},
};
use serde_json::{Value, json};
use std::time::Instant;

/// A page says everything; what is long is folded there.
const EVERYTHING: TextOptions = TextOptions { verbose: true, brief: false };

/// That a question is being asked.
pub fn asking(job: &Job, law: Option<Law>) -> String {
    json!({ "revision": job.revision, "epoch": job.epoch, "asking": law.map_or("", word) })
        .to_string()
}

/// That all is answered.
pub fn done(job: &Job, seconds: f64) -> String {
    json!({ "revision": job.revision, "epoch": job.epoch, "seconds": seconds }).to_string()
}

/// An error.
pub fn refused(job: &Job, why: &InputError, text: &str) -> String {
    json!({ "revision": job.revision, "epoch": job.epoch, "error": error::value(why, text) })
        .to_string()
}

/// What may be varied and asked about.
pub fn scene(job: &Job, scene: &Value, model: &Model) -> String {
    let blocks = &model.assembly.blocks;
    let supports: Vec<&str> = blocks.iter().filter(|b| b.support).map(|b| b.id.as_str()).collect();
    json!({
        "epoch": job.epoch, "knobs": knobs::knobs(scene), "loads": knobs::loads(scene),
        "supports": supports,
    })
    .to_string()
}

/// The word for a law of sliding.
fn word(law: Law) -> &'static str {
    match law {
        Law::Associative => "associative",
        Law::Coulomb => "coulomb",
    }
}

/// A scene with its model, that a job asks about.
pub struct Ready<'a> {
    /// The file.
    pub file: &'a File,
    /// The scene.
    pub scene: &'a Scene,
    /// Its model.
    pub model: &'a Model,
    /// When the job began.
    pub start: Instant,
}

/// What was found about one question under one law of sliding in so many seconds; nothing where it
/// was cancelled.
///
/// # Errors
/// It cannot be written down or drawn.
pub fn answer(
    job: &Job,
    ready: &Ready,
    (question, law): (&Question, Option<Law>),
    (found, seconds): (&Answer, f64),
    deadline: Deadline,
) -> Result<Option<String>, InputError> {
    let (scene, model) = (ready.scene, ready.model);
    let control = Control { deadline, ..Control::default() };
    let packed = saved::of_question(question, scene, model, found, &control);
    if deadline.is_over() {
        return Ok(None);
    }
    let refuse = |why: String| InputError::at(crate::error::JsonPath::root(), why);
    let mut result = packed?;
    result.run.timings.solve = (seconds - result.run.timings.check).max(0.0);
    result.run.work = Some(Work::of(&result, model));
    let path = result.question.kind() == Kind::Settle;
    let film = if path { frames(model, &result) } else { Vec::new() };
    let view = View::new(model, &result, film).map_err(|e| refuse(e.to_string()))?;
    let name = ready.file.name();
    let unnamed = ready.file.path.file_name().and_then(|n| n.to_str()).unwrap_or("");
    let layout = Layout { unnamed, width: usize::MAX };
    let mut words = text::render(
        &result,
        Asked { scene: &name, options: "", ..Default::default() },
        EVERYTHING,
        layout,
    );
    // Commands ask about the file, which may say something else.
    words.drop_row("next");
    let charts = tell::charts(&result);
    let about = json!({
        "revision": job.revision, "epoch": job.epoch, "question": question.word(),
        "law": law.map_or("", word), "seconds": ready.start.elapsed().as_secs_f64(),
        "edited": !job.edits.is_empty(),
    });
    page::piece(about, &words, &view, &charts).map(Some).map_err(|e| refuse(e.to_string()))
}

/// The text of a job's file, as far as it is text.
pub fn source(file: &File, bytes: &[u8]) -> Source {
    Source::new(file.name(), String::from_utf8_lossy(bytes).into_owned())
}
