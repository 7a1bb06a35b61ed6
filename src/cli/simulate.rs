//! `voussoir simulate`

use super::{
    args::Simulate,
    camera::Camera,
    exit::Exit,
    ground,
    output::Growing,
    question::{Depicted, Session},
    terminal::Terminal,
};
use anyhow::{Context, bail};
use std::ops::ControlFlow;
use voussoir::{
    analysis::{Answer, AssessOptions, SimulateOptions, doubt},
    dynamics::{Fate, Frame},
    proof::saved,
    report::trajectory::TrajectoryWriter,
    verdict::Verdict,
};

/// So many times are written to --csv where nothing is said.
const FRAMES: usize = 100;

pub fn run(args: &Simulate, terminal: &Terminal) -> anyhow::Result<Exit> {
    let written = |path: &std::path::PathBuf| format!("{}: cannot be written", path.display());
    let session = Session::open_changed(&args.common, |mut scene| {
        if args.load_factor != 0.0 {
            scene.loads = scene.loads.fixed(args.load_factor);
        }
        scene
    })?
    .filmed(&args.pictures)?;
    if args.ground.moves() {
        return ground::simulate(args, &session, terminal);
    }
    for (given, option) in [
        (args.ground.scale.is_some(), "--scale"),
        (args.toward.is_some(), "--toward"),
        (args.chart.is_some(), "--chart"),
    ] {
        if given {
            bail!("{option} requires --ground or --pulse");
        }
    }
    // Created before the work, and filled as it goes.
    let mut csv = match &args.csv {
        Some(path) => {
            Some(TrajectoryWriter::new(Growing::open(path)?).with_context(|| written(path))?)
        }
        None => None,
    };
    let frames = args.frames.map_or(if csv.is_some() { FRAMES } else { 0 }, |n| n as usize);
    let mut camera = Camera::new(&session, args.threads, session.is_filmed())
        .taking(frames, args.frames.is_some());
    let mut failure = None;
    let mut keep =
        |frame: &Frame| match csv.as_mut().map(|csv| csv.frame(&session.model.assembly, frame)) {
            Some(Err(e)) => {
                failure = Some(e);
                ControlFlow::Break(())
            }
            _ => ControlFlow::Continue(()),
        };
    let options = SimulateOptions {
        fast: args.fast,
        fine: args.fine,
        seconds: args.seconds,
        to_the_end: args.to_the_end,
        load_factor: None,
    };
    let answer = camera.ask(&session, &options.clone().into(), &mut keep)?;
    let film = camera.frames();
    if let (Some(e), Some(path)) = (failure, &args.csv) {
        return Err(e).with_context(|| written(path));
    }
    let Answer::Simulate(outcome) = &answer else { bail!("there is no simulation") };
    let law = session.law();
    let verdict =
        (!args.skip_verdict).then(|| session.ask(&AssessOptions { law }.into())).transpose()?;
    let assessment = match &verdict {
        Some(Answer::Assess(a)) => Some(a),
        _ => None,
    };
    let mut file = saved::simulated(&options, &session.scene, &session.model, assessment, outcome)
        .map_err(|e| session.refuse(e))?;
    file.run.doubt = doubt(&answer, &session.model, &session.control());
    let file = session.answer_seen(terminal, Depicted::Scene(film), file)?;
    // What is proved to fall does not stand because it was seen to.
    let falls = matches!(file.answer.verdict(), Some(Verdict::Unstable | Verdict::Conditional));
    Ok(match file.answer.fate() {
        Some(Fate::Falls) => Exit::No,
        _ if falls => Exit::No,
        Some(Fate::Stands) => Exit::Yes,
        Some(Fate::Undecided) | None => Exit::Undecided,
    })
}
