//! Scenes on ground that moves: what `kinematic` and `simulate` have in common.

use super::{
    args,
    args::Simulate,
    camera::Camera,
    claim,
    exit::Exit,
    question::{Depicted, Session},
    terminal::{self, Terminal},
    told::Told,
};
use anyhow::bail;
use std::{ops::ControlFlow, path::Path};
use voussoir::{
    analysis::{Answer, RockOptions, RockPoint, Rocking, ShakeOptions},
    dynamics::Frame,
    ground::{Formula, Given, Motion, Record, Recorded, Series},
    proof::shaken::ShakenWord,
    report::ground::{Rocked, ShakenReport},
    rocking::Fate,
};

/// So many times are kept for tables and charts where nothing is said.
const FRAMES: usize = 2000;

/// What was asked for: the motion as it is given, the file that it is read from, the motion itself.
struct Shaking {
    given: Given,
    record: Option<Record>,
    motion: Motion,
}

fn shaking(args: &args::Ground) -> anyhow::Result<Shaking> {
    let (record, motion) = given(args)?;
    let scale = args.scale.unwrap_or(1.0);
    let given = Given {
        pulse: args.pulse.as_ref().map(|(_, pulse)| Formula::from(*pulse)),
        record: record.as_ref().map(|r| Recorded::Read(Series::of(r))),
        scale,
    };
    Ok(Shaking { given, record, motion: motion.scaled(scale) })
}

/// The motion as it is in its file or formula.
fn given(args: &args::Ground) -> anyhow::Result<(Option<Record>, Motion)> {
    Ok(match &args.pulse {
        Some((_, pulse)) => (None, pulse.motion()),
        None if args.ground.is_empty() => (None, Motion::default()),
        None => {
            args.ground.iter().try_for_each(|p| claim::read(p))?;
            let paths: Vec<&Path> = args.ground.iter().map(|p| p.as_path()).collect();
            let record = Record::read(&paths, args.units)?;
            terminal::warnings(record.findings.iter());
            let motion = record.motion();
            (Some(record), motion)
        }
    })
}

/// What the mechanism of a scene does in time.
pub struct Rock<'a> {
    pub args: &'a args::Rocking,
    pub toward: Option<[f64; 3]>,
    pub control: Option<(String, [f64; 3])>,
    pub told: Told,
}

/// Runs the mechanism of a scene in time.
pub fn rock(session: &Session, terminal: &Terminal, ask: Rock) -> anyhow::Result<Exit> {
    let Shaking { given, record, motion } = shaking(&ask.args.ground)?;
    let question = RockOptions {
        toward: ask.toward.unwrap_or([1.0, 0.0, 0.0]),
        ground: given,
        control: ask.control.map(|(block, point)| RockPoint { block, point: Some(point) }),
        restitution: ask.args.restitution,
        from: ask.args.from.unwrap_or(0.0),
        seconds: ask.args.seconds,
        scan: ask.args.scan.map(|(from, to)| [from, to]),
        fate_only: false,
    }
    .into();
    let answer = session.ask(&question)?;
    let Answer::Rock(rocking) = &answer else { bail!("the answer is not one to its question") };
    let Rocking { built, history, .. } = &**rocking;
    let rocked = Rocked { name: &session.scene.name, built, motion: &motion, history };
    ask.told.write_own(rocked.name, || rocked.csv(), || rocked.charts())?;
    let mut file = session.result(&question, &answer)?;
    file.run.warnings.extend(record.into_iter().flat_map(|r| r.findings));
    session.answer_seen(terminal, Depicted::Charted(Vec::new(), rocked.charts()), file)?;
    Ok(match history.fate {
        Fate::Overturns { .. } => Exit::No,
        Fate::Rests => Exit::Yes,
        Fate::Rocks => Exit::Undecided,
    })
}

/// Runs all blocks of a scene in time.
pub fn simulate(args: &Simulate, session: &Session, terminal: &Terminal) -> anyhow::Result<Exit> {
    if args.skip_verdict {
        bail!("--skip-verdict does not apply to moving ground, which has no verdict; omit it");
    }
    let told = Told::open(&args.csv, &args.chart)?;
    let Shaking { given, record, motion } = shaking(&args.ground)?;
    let question = ShakeOptions {
        toward: args.toward.unwrap_or([1.0, 0.0, 0.0]),
        ground: given,
        fast: args.fast,
        seconds: args.seconds,
        to_the_end: args.to_the_end,
    }
    .into();
    let wanted = told.is_wanted() || session.report().is_some();
    let frames = args.frames.map_or(if wanted { FRAMES } else { 0 }, |n| n as usize);
    let mut camera = Camera::new(session, args.threads, session.is_filmed()).taking(frames, true);
    let mut keep = |_: &Frame| ControlFlow::Continue(());
    let mut answer = camera.ask(session, &question, &mut keep)?;
    let Answer::Shake(shaken) = &mut answer else { bail!("there is no simulation") };
    let report =
        ShakenReport { name: &session.scene.name, model: &session.model, motion: &motion, shaken };
    told.write_own(report.name, || report.csv(), || report.charts())?;
    let charts = if session.report().is_some() { report.charts() } else { Vec::new() };
    if args.frames.is_none() {
        // What was kept for tables and charts was not asked for in the result.
        shaken.shaken.frames.clear();
    }
    let mut file = session.result(&question, &answer)?;
    file.run.warnings.extend(record.into_iter().flat_map(|r| r.findings));
    let seen = Depicted::Charted(camera.frames(), charts);
    let file = session.answer_seen(terminal, seen, file)?;
    Ok(match file.answer.shaken().map(|a| a.fate) {
        Some(ShakenWord::Overturns) => Exit::No,
        Some(ShakenWord::Rests) => Exit::Yes,
        Some(ShakenWord::Moves) | None => Exit::Undecided,
    })
}
