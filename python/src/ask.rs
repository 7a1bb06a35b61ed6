//! The one door: a question with its options, about a scene.

use crate::{
    answer::{Answer, Packed},
    error::Trouble,
    scene::{Ready, Scene, steps, value, wrong},
    wait::{self, Watch},
};
use pyo3::prelude::*;
use std::{ops::ControlFlow, path::PathBuf, sync::Arc, time::Instant};
use voussoir::{
    analysis::{
        self, Answer as Found, AssessOptions, Control, Law, Question, SimulateOptions, doubt,
    },
    dynamics::Progress,
    error::{Finding, FindingCode, InputError, JsonPath},
    interface::{Model, prepare},
    parallel,
    proof::{ResultFile, kept::KeptPath, saved, work::Work},
    report::view::Film,
    scene::Scene as Plain,
    sweep::{self, Between},
    verdict::Verdict,
};

/// The share of a time limit that programs may take, as for the command.
const PROGRAMS: f64 = 0.9;
/// Contacts are searched for so many seconds whatever the limit, as for the command.
const PATIENCE: f64 = 1.0;

/// How a question is asked, beside its own options.
#[derive(Clone, Debug, Default)]
pub struct Manner {
    pub keep_all: bool,
    pub time_limit: Option<f64>,
    pub worst: Vec<String>,
    /// When it is run in time beside the verdict.
    pub simulate: Beside,
    /// Threads and frames of a simulation; whether a film of it is kept.
    pub threads: usize,
    pub frames: usize,
    pub film: bool,
    /// Beside a simulation: the law of the verdict, where that is asked.
    pub verdict: Option<Law>,
    /// Of a path: the file that has its points as soon as they are proved.
    pub keep: Option<PathBuf>,
}

/// When `assess` runs the scene in time as well.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Beside {
    #[default]
    Never,
    /// Where the verdict is conditional or undecided.
    InDoubt,
    Always,
}

/// Asks a question of a scene. `question` is what result files and plans hold:
/// `{"limit": {"law": "coulomb"}}`.
#[pyfunction]
#[pyo3(signature = (scene, question, *, keep_all=false, time_limit=None, worst=Vec::new(), simulate="never", threads=1, frames=0, film=false, verdict=None, keep=None, progress=None))]
#[allow(clippy::too_many_arguments)]
pub fn ask(
    py: Python,
    scene: &Scene,
    question: &Bound<PyAny>,
    keep_all: bool,
    time_limit: Option<f64>,
    worst: Vec<String>,
    simulate: &str,
    threads: i64,
    frames: usize,
    film: bool,
    verdict: Option<&str>,
    keep: Option<PathBuf>,
    progress: Option<&Bound<PyAny>>,
) -> PyResult<Answer> {
    let question: Question = self::question(question)?;
    let unknown = |key: &str, word: &str| {
        let error = InputError::at(JsonPath::root().key(key), format!("unknown value {word:?}"));
        Trouble::from(error).raise(py)
    };
    if let Some(limit) = time_limit.filter(|limit| limit.is_nan() || *limit <= 0.0) {
        let path = JsonPath::root().key("time_limit");
        let error = InputError::at(path, format!("must be > 0, got {limit}"));
        return Err(Trouble::from(error.hint("seconds; None for no limit")).raise(py));
    }
    let simulate = match simulate {
        "always" => Beside::Always,
        "in doubt" => Beside::InDoubt,
        "never" => Beside::Never,
        word => return Err(unknown("simulate", word)),
    };
    let verdict = match verdict {
        None => None,
        Some("associative") => Some(Law::Associative),
        Some("coulomb") => Some(Law::Coulomb),
        Some(word) => return Err(unknown("law", word)),
    };
    let threads = wait::threads(py, threads)?;
    let manner =
        Manner { keep_all, time_limit, worst, simulate, threads, frames, film, verdict, keep };
    let ready = scene.ready();
    wait::run(py, progress, move |watch| answer(&ready, &question, &manner, watch))
}

/// Whether a text is that of a saved result.
#[pyfunction]
pub fn is_result(text: &str) -> bool {
    voussoir::proof::read::is_result(text)
}

/// A question of plain values.
pub fn question(plain: &Bound<PyAny>) -> PyResult<Question> {
    value(plain, |text| {
        let mut reader = serde_json::Deserializer::from_str(&text);
        serde_path_to_error::deserialize(&mut reader)
            .map_err(|e| InputError::at(steps(JsonPath::root(), e.path()), wrong(e.inner())))
    })
}

/// As the command answers: the same door, the same file, the same order.
fn answer(
    ready: &Ready,
    question: &Question,
    manner: &Manner,
    watch: &Watch,
) -> Result<Answer, Trouble> {
    let start = Instant::now();
    let deadline = watch.deadline(manner.time_limit.map(|limit| PROGRAMS * limit));
    let is_over =
        || watch.is_cancelled() || deadline.is_over() && start.elapsed().as_secs_f64() > PATIENCE;
    let mut ready = ready.clone();
    if let Question::Simulate(SimulateOptions { load_factor: Some(factor), .. }) = question
        && *factor != 0.0
    {
        // The verdict beside it is that of the loaded scene, too.
        let loads = ready.scene.loads.fixed(*factor);
        let said = ready.said.to_vec();
        ready = ready.changed(Plain { loads, ..(*ready.scene).clone() }, said);
    }
    let control = Control { keep_all: manner.keep_all, deadline, ..Control::default() };
    let mut model = ready.model(&is_over)?;
    if !manner.worst.is_empty() {
        (ready, model) = worst(&ready, &manner.worst, question, &control)?;
    }
    let session = Session { ready: &ready, model: &model, control: &control, manner, watch };
    let begin = Instant::now();
    let mut film = Vec::new();
    let file = match question {
        Question::Simulate(options) => {
            let options = SimulateOptions { load_factor: None, ..options.clone() };
            let outcome = session.in_time(Question::Simulate(options.clone()), &mut film)?;
            let verdict =
                manner.verdict.map(|law| session.ask(&Question::Assess(AssessOptions { law })));
            let verdict = verdict.transpose()?;
            let assessment = match &verdict {
                Some(Found::Assess(a)) => Some(a),
                _ => None,
            };
            let Found::Simulate(seen) = &outcome else { return Err(none()) };
            let made = saved::simulated(&options, &ready.scene, &model, assessment, seen);
            let mut file = made.map_err(|e| ready.located(e))?;
            file.run.doubt = doubt(&outcome, &model, &control);
            file
        }
        Question::Shake(_) => {
            let found = session.in_time(question.clone(), &mut film)?;
            saved::of(question, &ready.scene, &model, &found).map_err(|e| ready.located(e))?
        }
        Question::Repose(options) => {
            let found = session.ask(question)?;
            let Found::Repose(packing) = &found else { return Err(none()) };
            let made = saved::packing(&ready.scene, options.moving_mass, packing);
            let made = made.map_err(|e| ready.located(e))?;
            let (mut file, proof) = made.ok_or_else(none)?;
            file.timings.check = proof.run.timings.check;
            file.timings.solve = (begin.elapsed().as_secs_f64() - file.timings.check).max(0.0);
            file.doubt = doubt(&found, &model, &control);
            // The round with the answer: grains that fell earlier are gone.
            let own = prepare(&proof.scene.input).map_err(|e| ready.located(e))?;
            let packed = Packed { file, scene: ready.scene.clone() };
            return Ok(Answer::new(proof, Arc::new(own), Vec::new(), Some(packed)));
        }
        _ if manner.keep.is_some() => session.kept(question)?,
        _ => {
            let found = session.ask(question)?;
            let made = saved::of_question(question, &ready.scene, &model, &found, &control);
            let mut file = made.map_err(|e| ready.located(e))?;
            let doubt =
                matches!(file.answer.verdict(), Some(Verdict::Conditional | Verdict::Undecided));
            if let Found::Assess(assessment) = &found
                && (manner.simulate == Beside::Always
                    || (manner.simulate == Beside::InDoubt && doubt))
                && let options = SimulateOptions::default()
                && let Found::Simulate(outcome) =
                    session.in_time(Question::Simulate(options.clone()), &mut film)?
            {
                let with = saved::with_simulation(&file, &options, &model, assessment, &outcome);
                file = with.map_err(|e| ready.located(e))?;
            }
            file
        }
    };
    let mut file = file;
    if let Some(s) = &file.simulation {
        file.run.timings.simulate = s.runs.iter().map(|r| r.seconds).sum();
    }
    file.run.timings.solve =
        (begin.elapsed().as_secs_f64() - file.run.timings.simulate - file.run.timings.check)
            .max(0.0);
    file.run.work = Some(Work::of(&file, &model));
    Ok(Answer::new(file, model, film, None))
}

fn none() -> Trouble {
    Trouble::Other("there is no answer to save".into())
}

/// The worst case within ranges in the place of the scene.
fn worst(
    ready: &Ready,
    ranges: &[String],
    question: &Question,
    control: &Control,
) -> Result<(Ready, Arc<Model>), Trouble> {
    let ranges: Vec<Between> = ranges
        .iter()
        .map(|r| r.parse())
        .collect::<Result<_, String>>()
        .map_err(|e| InputError::at(JsonPath::root().key("worst"), e))?;
    let found = sweep::worst(&ready.scene, &ranges, question, control);
    let found = found.map_err(|e| ready.located(e))?;
    let notes = found
        .argument
        .into_iter()
        .map(|text| Finding::new(FindingCode::WorstCase, format!("worst case: {text}")));
    let said = notes.chain(ready.said.iter().cloned()).collect();
    let ready = ready.changed(found.scene, said);
    let model = ready.model(&|| control.deadline.is_over())?;
    Ok((ready, model))
}

struct Session<'a> {
    ready: &'a Ready,
    model: &'a Model,
    control: &'a Control,
    manner: &'a Manner,
    watch: &'a Watch,
}

impl Session<'_> {
    fn ask(&self, question: &Question) -> Result<Found, Trouble> {
        analysis::ask(question, &self.ready.scene, self.model, self.control)
            .map_err(|e| self.ready.located(e))
    }

    /// Of a path, from where the file has it.
    fn kept(&self, question: &Question) -> Result<ResultFile, Trouble> {
        let (scene, file) = (&self.ready.scene, self.manner.keep.as_deref().ok_or_else(none)?);
        let kept = KeptPath::open(file, question, scene, self.model).map_err(Trouble::other)?;
        let asked = kept.ask(question, scene, self.model, self.control);
        let (result, failed) = asked.map_err(|e| self.ready.located(e))?;
        // What was to be kept and is not would be missed after the next kill.
        failed.map_or(Ok(result), |e| Err(Trouble::other(e)))
    }

    fn in_time(
        &self,
        question: Question,
        frames: &mut Vec<voussoir::dynamics::Frame>,
    ) -> Result<Found, Trouble> {
        let Manner { threads, frames: wanted, film, .. } = *self.manner;
        let mut film = film.then(|| Film::fitting(self.model.assembly.blocks.len()));
        let every_step = film.is_some();
        let deadline = self.control.deadline;
        let mut each = |p: &Progress| {
            self.watch.tell(p.time, p.horizon, || {
                format!("displaced by {:.2} % of a block's thickness", 100.0 * p.relative)
            });
            if let (Some(film), Some(moment)) = (&mut film, p.moment) {
                film.see(moment);
            }
            if deadline.is_over() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let watch = analysis::Watch {
            threads: match threads {
                0 => parallel::processors(),
                n => parallel::most(n),
            },
            frames: wanted,
            keep_frames: true,
            every_step,
            each: &mut each,
        };
        let found =
            analysis::ask_watched(&question, &self.ready.scene, self.model, self.control, watch)
                .map_err(|e| self.ready.located(e));
        *frames = film.take().map(Film::frames).unwrap_or_default();
        found
    }
}
