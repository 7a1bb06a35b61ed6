//! Asks what is wanted: coarse first, then fine, and gives up as soon as something else is wanted.
//!
//! Where a verdict is asked and loads or joints alone have changed, what was found before is tried
//! first ([`Still`]): while a number is drawn along, most verdicts are proved by what proved those
//! beside them, before any program is solved.

use super::{
    desk::{Desk, Job, News},
    error,
    follow::File,
    knobs,
    reply::{self, Ready},
};
use crate::{
    analysis::{
        Answer, Control, KinematicOptions, Law, Question, ask,
        implied::Still,
        model_cache::{Keys, Reuse},
    },
    deadline::Deadline,
    error::{InputError, JsonPath},
    import::read_meshes,
    limits,
    scene::{Scene, read_bytes},
};
use serde_json::Value;
use std::{
    collections::hash_map::DefaultHasher,
    hash::{Hash, Hasher},
    panic::{AssertUnwindSafe, catch_unwind},
    time::Instant,
};

/// What lasts from one job to the next.
#[derive(Default)]
struct Known {
    /// The file as it was read when its numbers were last shown.
    shown: u64,
    /// The shapes that `still` is about.
    shapes: Vec<u64>,
    still: Still,
}

/// Asks for good.
pub fn run(file: &File, desk: &Desk) {
    let reuse = Reuse::default();
    let mut known = Known::default();
    loop {
        let job = desk.next();
        let deadline = Deadline::NEVER.or_when(desk.cancel());
        desk.say(job.revision, News::Status, reply::asking(&job, None));
        let asked = catch_unwind(AssertUnwindSafe(|| {
            answer(file, desk, &job, deadline, &reuse, &mut known)
        }));
        let error = match asked {
            Ok(Ok(())) => continue,
            Ok(Err(error)) => error,
            Err(_) => InputError::at(
                JsonPath::root(),
                "this question cannot be answered: the program failed (please report it)",
            ),
        };
        let bytes = job.file.as_ref().as_ref().map_or(&[][..], Vec::as_slice);
        let source = reply::source(file, bytes);
        let error = error::located(error, &source);
        desk.say(job.revision, News::Status, reply::refused(&job, &error, &source.text));
    }
}

fn answer(
    file: &File,
    desk: &Desk,
    job: &Job,
    deadline: Deadline,
    reuse: &Reuse,
    known: &mut Known,
) -> Result<(), InputError> {
    let start = Instant::now();
    let bytes = job.file.as_ref().as_ref().map_err(Clone::clone)?;
    let (scene, value) = scene(file, job, bytes)?;
    let keys = keys(job, &value);
    let model = reuse.prepare(&scene, &keys, &|| deadline.is_over())?;
    if known.shapes != keys.shapes {
        (known.shapes, known.still) = (keys.shapes, Still::default());
    }
    let points = model.contact_points() as u64;
    limits::afford("solving for the contact points", points, limits::PER_CONTACT_POINT)?;
    let said = known.shown == job.epoch
        || desk.say(job.revision, News::Scene, reply::scene(job, &value, &model));
    if said {
        known.shown = job.epoch;
    }
    let ready = Ready { file, scene: &scene, model: &model, start };
    for (question, law) in stages(&job.question) {
        let asked = (&question, law);
        let first = matches!(asked, (Question::Assess(_), Some(Law::Associative)));
        let begun = Instant::now();
        if let (true, Some(still)) = (first, known.still.verdict(&model)) {
            let still = (&Answer::Assess(still), begun.elapsed().as_secs_f64());
            if let Some(text) = reply::answer(job, &ready, asked, still, deadline)? {
                desk.say(job.revision, News::Answer, text);
            }
        }
        desk.say(job.revision, News::Status, reply::asking(job, law));
        let begun = Instant::now();
        let found = ask(&question, &scene, &model, &Control { deadline, ..Control::default() })?;
        let seconds = begun.elapsed().as_secs_f64();
        if let (true, Answer::Assess(a)) = (first, &found) {
            known.still.keep(&model, a);
        }
        let Some(text) = reply::answer(job, &ready, asked, (&found, seconds), deadline)? else {
            return Ok(());
        };
        desk.say(job.revision, News::Answer, text);
    }
    desk.say(job.revision, News::Status, reply::done(job, start.elapsed().as_secs_f64()));
    Ok(())
}

/// The scene of a job, and as a plain value.
fn scene(file: &File, job: &Job, bytes: &[u8]) -> Result<(Scene, Value), InputError> {
    let (mut scene, source) = read_bytes(file.name(), bytes.to_vec())?;
    let invalid = |e: serde_json::Error| InputError::at(JsonPath::root(), e.to_string());
    let mut value: Value = serde_json::from_str(&source.text).map_err(invalid)?;
    if !job.edits.is_empty() {
        knobs::change(&mut value, &job.edits)?;
        let text = serde_json::to_string(&value).map_err(invalid)?;
        scene = read_bytes(file.name(), text.into_bytes())
            .map_err(|e| InputError { position: None, ..e })?
            .0;
    }
    read_meshes(&mut scene, &file.folder, file.reach)?;
    Ok((scene, value))
}

/// What scenes of the same file share: joints, loads and gravity change neither blocks nor contacts,
/// unless interfaces are given by hand.
fn keys(job: &Job, scene: &Value) -> Keys {
    let given = scene.get("interfaces").is_some();
    let (mut shapes, mut others) = (DefaultHasher::new(), DefaultHasher::new());
    for (pointer, value) in &job.edits {
        let part = pointer.split('/').nth(1).unwrap_or_default();
        let loads = !given && matches!(part, "joints" | "loads" | "gravity");
        let hash = if loads { &mut others } else { &mut shapes };
        (pointer, value.to_string()).hash(hash);
    }
    Keys {
        shapes: vec![job.epoch, shapes.finish()],
        masses: Vec::new(),
        others: vec![others.finish()],
    }
}

/// A question under joints that open as they slide, then with dry friction, where it tells them
/// apart; of a mechanism under an earthquake its start before its curve.
fn stages(question: &Question) -> Vec<(Question, Option<Law>)> {
    let with = |law: Law| {
        let mut question = question.clone();
        *question.law_mut()? = law;
        Some((question, Some(law)))
    };
    let both: Vec<_> = [Law::Associative, Law::Coulomb].into_iter().filter_map(with).collect();
    let start = match question {
        Question::Kinematic(o) if !o.linear => {
            let o = KinematicOptions { law: Law::Associative, linear: true, ..o.clone() };
            Some((Question::Kinematic(o), Some(Law::Associative)))
        }
        _ => None,
    };
    match both.is_empty() {
        true => vec![(question.clone(), None)],
        false => start.into_iter().chain(both).collect(),
    }
}
