//! `voussoir settle` and `voussoir push`

use super::{
    args::{Curve, Push, Settle},
    exit::Exit,
    output::Sink,
    question::Session,
    terminal::Terminal,
};
use voussoir::{
    analysis::{ControlPoint, PushOptions, Question, SettleOptions},
    proof::path::PathStatus,
    report::path,
};

pub fn settle(args: &Settle, terminal: &Terminal) -> anyhow::Result<Exit> {
    let question =
        Question::Settle(SettleOptions { moves: args.moves.clone(), at: args.at.clone() });
    let session = Session::open(&args.common)?;
    run(&session, &question, &args.curve, &args.options(), terminal)
}

pub fn push(args: &Push, terminal: &Terminal) -> anyhow::Result<Exit> {
    let (block, point) = args.control.clone();
    let question = Question::Push(PushOptions {
        control: ControlPoint { block, point },
        toward: args.toward,
        at: args.at.clone(),
    });
    let session = Session::open(&args.common)?;
    run(&session, &question, &args.curve, &args.options(), terminal)
}

fn run(
    session: &Session,
    question: &Question,
    curve: &Curve,
    own: &[String],
    terminal: &Terminal,
) -> anyhow::Result<Exit> {
    let open = |path: &Option<std::path::PathBuf>| {
        path.as_deref().map(|p| Sink::open(Some(p))).transpose()
    };
    let (csv, chart) = (open(&curve.csv)?, open(&curve.chart)?);
    let answer = session.ask(question)?;
    let file = session.answer(terminal, own, session.result(question, &answer)?)?;
    if let Some(csv) = csv {
        csv.write(&path::csv(&file)?)?;
    }
    if let Some(chart) = chart {
        chart.write(&path::chart(&file)?)?;
    }
    Ok(match file.answer.path().map(|a| a.status) {
        Some(PathStatus::Reached | PathStatus::Vanishes) => Exit::Yes,
        Some(PathStatus::Falls) => Exit::No,
        Some(PathStatus::Slides | PathStatus::Open) | None => Exit::Undecided,
    })
}
