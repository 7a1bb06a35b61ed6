//! Asks what is wanted: coarse first, then fine, and gives up as soon as something else is wanted.

use super::{
    desk::{Desk, Job, News},
    error,
    follow::File,
    knobs,
    reply::{self, Ready},
};
use crate::{
    analysis::{
        Law, Question,
        reuse::{Keys, Reuse},
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

/// Asks for good.
pub fn run(file: &File, desk: &Desk) {
    let reuse = Reuse::default();
    let mut shown = 0;
    loop {
        let job = desk.next();
        let deadline = Deadline::NEVER.or_when(desk.cancel());
        desk.say(job.revision, News::Status, reply::asking(&job, None));
        let asked = catch_unwind(AssertUnwindSafe(|| {
            answer(file, desk, &job, deadline, &reuse, &mut shown)
        }));
        let error = match asked {
            Ok(Ok(())) => continue,
            Ok(Err(error)) => error,
            Err(_) => InputError::at(
                JsonPath::root(),
                "this question cannot be answered: a part of the program failed",
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
    shown: &mut u64,
) -> Result<(), InputError> {
    let start = Instant::now();
    let bytes = job.file.as_ref().as_ref().map_err(Clone::clone)?;
    let (scene, value) = scene(file, job, bytes)?;
    let model = reuse.prepare(&scene, &keys(job, &value), &|| deadline.is_over())?;
    let points = model.contact_points() as u64;
    limits::afford("solving for the contact points", points, limits::PER_CONTACT_POINT)?;
    if *shown != job.epoch && desk.say(job.revision, News::Scene, reply::scene(job, &value, &model))
    {
        *shown = job.epoch;
    }
    let ready = Ready { file, scene: &scene, model: &model, start };
    for (question, law) in stages(&job.question) {
        desk.say(job.revision, News::Status, reply::asking(job, law));
        let Some(text) = reply::answer(job, &ready, &question, law, deadline)? else {
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
/// apart.
fn stages(question: &Question) -> Vec<(Question, Option<Law>)> {
    let with = |law: Law| {
        let mut question = question.clone();
        match &mut question {
            Question::Assess(o) => o.law = law,
            Question::Limit(o) => o.law = law,
            Question::Tilt(o) => o.law = law,
            Question::Thrust(o) => o.law = law,
            Question::Kinematic(o) => o.law = law,
            _ => return None,
        }
        Some((question, Some(law)))
    };
    let both: Vec<_> = [Law::Associative, Law::Coulomb].into_iter().filter_map(with).collect();
    if both.is_empty() { vec![(question.clone(), None)] } else { both }
}
