//! `voussoir simulate`

use super::{
    args::Simulate,
    claim,
    exit::Exit,
    progress::Bar,
    question::{Question, Seen},
    report,
    terminal::Terminal,
};
use anyhow::Context;
use std::{fs::File, ops::ControlFlow};
use voussoir::{
    analysis::assess,
    dynamics::{Fate, Fidelity, SimulationOutcome, SimulationSettings, simulate},
    report::{ResultFile, trajectory::TrajectoryWriter, view::Film},
};

/// So many times are written to --csv where nothing is said.
const FRAMES: usize = 100;

pub fn run(args: &Simulate, terminal: &Terminal) -> anyhow::Result<Exit> {
    let written = |path: &std::path::PathBuf| format!("{}: cannot be written", path.display());
    let question = Question::open_changed(&args.common, |mut scene| {
        if args.load_factor != 0.0 {
            scene.loads = scene.loads.fixed(args.load_factor);
        }
        scene
    })?
    .filmed(&args.pictures)?;
    // Created before the work, and filled as it goes.
    let mut csv = match &args.csv {
        Some(path) => {
            claim::written(path)?;
            Some(TrajectoryWriter::new(File::create(path).with_context(|| written(path))?).with_context(|| written(path))?)
        }
        None => None,
    };
    let settings = SimulationSettings {
        fidelity: if args.fast { Some(Fidelity::Fast) } else { args.fine.then_some(Fidelity::Fine) },
        seconds: args.seconds,
        threads: threads(args.threads),
        frames: args.frames.map_or(if csv.is_some() { FRAMES } else { 0 }, |n| n as usize),
        keep_frames: args.frames.is_some(),
        to_the_end: args.to_the_end,
        every_step: question.is_filmed(),
    };
    let mut film = question.is_filmed().then(|| Film::fitting(question.model.assembly.blocks.len()));
    let mut failure = None;
    let mut keep = |frame: &_| match csv.as_mut().map(|csv| csv.frame(&question.model.assembly, frame)) {
        Some(Err(e)) => {
            failure = Some(e);
            ControlFlow::Break(())
        }
        _ => ControlFlow::Continue(()),
    };
    let outcome = watch(&question, &settings, &mut film, &mut keep)?;
    if let (Some(e), Some(path)) = (failure, &args.csv) {
        return Err(e).with_context(|| written(path));
    }
    let model = &question.model;
    let verdict = (!args.skip_verdict).then(|| assess(model, &question.control()));
    let pack = || ResultFile::simulated(&question.scene, model, verdict.as_ref(), &outcome);
    let file = question.answer_seen(terminal, &args.options(), Seen::Scene(film.map(Film::frames).unwrap_or_default()), pack)?;
    Ok(match file.answer.fate {
        Some(Fate::Stands) => Exit::Yes,
        Some(Fate::Falls) => Exit::No,
        Some(Fate::Undecided) | None => Exit::Undecided,
    })
}

/// Simulates under a bar until the time limit, and films it where there is a film.
pub fn watch(
    question: &Question,
    settings: &SimulationSettings,
    film: &mut Option<Film>,
    keep: &mut dyn FnMut(&voussoir::dynamics::Frame) -> ControlFlow<()>,
) -> anyhow::Result<SimulationOutcome> {
    let bar = Bar::new(question.shows_progress());
    let model = &question.model;
    simulate(model, settings, &mut |progress| {
        bar.show(progress);
        report::see(film, progress.moment);
        if question.control().seconds <= 0.0 {
            return ControlFlow::Break(());
        }
        progress.frame.map_or(ControlFlow::Continue(()), &mut *keep)
    })
    .map_err(|e| question.refuse(e))
}

/// The number of threads asked for.
pub fn threads(asked: u16) -> usize {
    match asked {
        0 => std::thread::available_parallelism().map_or(1, |n| n.get()),
        n => n.into(),
    }
}
