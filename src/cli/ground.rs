//! Scenes on ground that moves: what `kinematic` and `simulate` have in common.

use super::{
    args,
    args::Simulate,
    camera::Camera,
    claim,
    exit::Exit,
    output::Sink,
    question::{Depicted, Session},
    report,
    terminal::{self, Terminal},
};
use anyhow::bail;
use std::{ops::ControlFlow, path::Path};
use voussoir::{
    analysis::{Answer, Question, RockOptions, RockPoint, Rocking, ShakeOptions},
    dynamics::Frame,
    ground::{Formula, Given, Motion, Record, Recorded, Series},
    proof::shaken::ShakenWord,
    report::{
        ground::{Rocked, ShakenReport, Shaking, page_charts},
        json, page,
        text::{Layout, Page, TextOptions},
        view::View,
    },
    rocking::Fate,
};

/// So many times are kept for tables and charts where nothing is said.
const FRAMES: usize = 2000;

/// The motion that was asked for.
fn shaking(args: &args::Ground) -> anyhow::Result<Shaking> {
    let (source, record, motion) = given(args)?;
    let scale = args.scale.unwrap_or(1.0);
    Ok(Shaking { source, record, scale, motion: motion.scaled(scale), given: motion })
}

/// The motion as it is in its file or formula, with its name.
fn given(args: &args::Ground) -> anyhow::Result<(String, Option<Record>, Motion)> {
    Ok(match &args.pulse {
        Some((text, pulse)) => (text.clone(), None, pulse.motion()),
        None if args.ground.is_empty() => (String::new(), None, Motion::default()),
        None => {
            args.ground.iter().try_for_each(|p| claim::read(p))?;
            let paths: Vec<&Path> = args.ground.iter().map(|p| p.as_path()).collect();
            let record = Record::read(&paths, args.units)?;
            terminal::warnings(record.findings.iter());
            let motion = record.motion();
            (record.name.clone(), Some(record), motion)
        }
    })
}

/// What the mechanism of a scene does in time.
pub struct Rock<'a> {
    pub args: &'a args::Rocking,
    pub toward: Option<[f64; 3]>,
    pub control: Option<(String, [f64; 3])>,
    pub csv: Option<Sink>,
    pub svg: Option<Sink>,
}

/// Runs the mechanism of a scene in time.
pub fn rock(
    session: &Session,
    common: &args::Common,
    terminal: &Terminal,
    ask: Rock,
) -> anyhow::Result<Exit> {
    let shaking = shaking(&ask.args.ground)?;
    let from = ask.args.from.unwrap_or(0.0);
    let question = Question::Rock(RockOptions {
        toward: ask.toward.unwrap_or([1.0, 0.0, 0.0]),
        ground: Given {
            pulse: ask.args.ground.pulse.as_ref().map(|(_, pulse)| Formula::from(*pulse)),
            record: shaking.record.as_ref().map(|r| Recorded::Read(Series::of(r))),
            scale: shaking.scale,
        },
        control: ask.control.map(|(block, point)| RockPoint { block, point: Some(point) }),
        restitution: ask.args.restitution,
        from,
        seconds: ask.args.seconds,
        scan: ask.args.scan.map(|(from, to)| [from, to]),
        fate_only: false,
    });
    let answer = session.ask(&question)?;
    let Answer::Rock(rocking) = &answer else { bail!("the answer is not one to its question") };
    let Rocking { built, history, scan: found, .. } = &**rocking;
    if let Some(save) = session.save() {
        save.write(&json::text(&session.result(&question, &answer)?.to_value()?))?;
    }
    let blocks = &session.model.assembly.blocks;
    let ids: Vec<String> = blocks.iter().map(|b| b.id.clone()).collect();
    let rocked = Rocked {
        name: &session.scene.name,
        ids: &ids,
        built,
        shaking: &shaking,
        from,
        given_restitution: ask.args.restitution.is_some(),
        history,
        scan: found.as_ref(),
    };
    if let Some(csv) = &ask.csv {
        csv.write(&rocked.csv()?)?;
    }
    if let Some(svg) = &ask.svg {
        svg.write(&rocked.chart()?)?;
    }
    let text = |layout: Layout<'_>, options| rocked.text(layout, options);
    show(session, common, terminal, &text, &rocked.json())?;
    Ok(match history.fate {
        Fate::Overturns { .. } => Exit::No,
        Fate::Rests => Exit::Yes,
        Fate::Rocks => Exit::Undecided,
    })
}

/// Runs all blocks of a scene in time.
pub fn simulate(args: &Simulate, session: &Session, terminal: &Terminal) -> anyhow::Result<Exit> {
    if args.skip_verdict {
        bail!("--skip-verdict: on ground that moves no verdict is asked for");
    }
    let open = |path: &Option<std::path::PathBuf>| {
        path.as_deref().map(|p| Sink::open(Some(p))).transpose()
    };
    let (csv, chart) = (open(&args.csv)?, open(&args.chart)?);
    let Shaking { record, scale, motion, .. } = shaking(&args.ground)?;
    let question = Question::Shake(ShakeOptions {
        toward: args.toward.unwrap_or([1.0, 0.0, 0.0]),
        ground: Given {
            pulse: args.ground.pulse.as_ref().map(|(_, pulse)| Formula::from(*pulse)),
            record: record.as_ref().map(|r| Recorded::Read(Series::of(r))),
            scale,
        },
        fast: args.fast,
        seconds: args.seconds,
        to_the_end: args.to_the_end,
    });
    let told = csv.is_some() || chart.is_some() || session.report().is_some();
    let frames = args.frames.map_or(if told { FRAMES } else { 0 }, |n| n as usize);
    let mut camera = Camera::new(session, args.threads, session.is_filmed()).taking(frames, true);
    let mut keep = |_: &Frame| ControlFlow::Continue(());
    let mut answer = camera.ask(session, &question, &mut keep)?;
    let Answer::Shake(shaken) = &mut answer else { bail!("there is no simulation") };
    let report =
        ShakenReport { name: &session.scene.name, model: &session.model, motion: &motion, shaken };
    if let Some(csv) = &csv {
        csv.write(&report.csv()?)?;
    }
    if let Some(chart) = &chart {
        chart.write(&report.chart()?)?;
    }
    let charts = if session.report().is_some() { page_charts(&report) } else { Vec::new() };
    if args.frames.is_none() {
        // What was kept for tables and charts was not asked for in the result.
        shaken.shaken.frames.clear();
    }
    let mut file = session.result(&question, &answer)?;
    file.run.warnings.extend(record.into_iter().flat_map(|r| r.findings));
    let seen = Depicted::Charted(camera.frames(), charts);
    let file = session.answer_seen(terminal, &args.options(), seen, file)?;
    Ok(match file.answer.shaken().map(|a| a.fate) {
        Some(ShakenWord::Overturns) => Exit::No,
        Some(ShakenWord::Rests) => Exit::Yes,
        Some(ShakenWord::Moves) | None => Exit::Undecided,
    })
}

type Text<'a> = dyn Fn(Layout<'_>, TextOptions) -> Page + 'a;

fn show(
    session: &Session,
    common: &args::Common,
    terminal: &Terminal,
    text: &Text,
    answer: &serde_json::Value,
) -> anyhow::Result<()> {
    let layout = terminal.layout(&common.scene);
    if session.is_filmed() {
        let mut view = View::bare(&session.model);
        view.name.clone_from(&session.scene.name);
        if let Some(sink) = session.report() {
            let page = text(report::layout(layout), report::EVERYTHING);
            sink.write(&page::page(&page, &view, &[])?)?;
        }
        session.pictures().write(&view)?;
    }
    if common.json {
        terminal::print(&json::pretty(answer)?)?;
    } else if !session.is_printed() {
        let options = TextOptions { verbose: common.verbose, brief: common.quiet };
        terminal.page(&text(layout, options))?;
    }
    Ok(())
}
