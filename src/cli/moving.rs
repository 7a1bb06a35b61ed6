//! `voussoir limit --moving`

use super::{
    again::skip_dead,
    args::Limit,
    exit::Exit,
    output::Sink,
    question::{Depicted, Session, requirement, unless_weaker},
    terminal::Terminal,
};
use anyhow::bail;
use voussoir::{
    analysis::{MovingOptions, Question},
    report::{moving, view::positions},
};

pub fn run(args: &Limit, terminal: &Terminal) -> anyhow::Result<Exit> {
    if !args.worst.is_empty() {
        bail!(
            "--worst and --moving are two searches: sweep over the range with the question moving"
        );
    }
    let open = |path: &Option<std::path::PathBuf>| {
        path.as_deref().map(|p| Sink::open(Some(p))).transpose()
    };
    let (csv, chart) = (open(&args.positions)?, open(&args.chart)?);
    let session = Session::open(&args.common)?.drawn(&args.pictures, args.tables.csv.as_deref())?;
    let question = Question::Moving(MovingOptions {
        law: session.law(),
        require: args.require,
        skip_dead: args.skip_dead,
        every_value: args.every_value,
    });
    let answer = session.ask(&question)?;
    let file = session.result(&question, &answer)?;
    let film = if session.is_filmed() { positions(&session.model, &file) } else { Vec::new() };
    let every = args.every_value.then(|| "--every-value".to_string());
    let own = [vec!["--moving".to_string()], Vec::from_iter(every), skip_dead(args.skip_dead)];
    let own = own.concat();
    let file = session.answer_seen(terminal, &own, Depicted::Scene(film), file)?;
    if let Some(csv) = csv {
        csv.write(&moving::csv(&file)?)?;
    }
    if let Some(chart) = chart {
        chart.write(&moving::chart(&file)?)?;
    }
    let exit = requirement(&file, question.require(), |lambda| lambda);
    Ok(unless_weaker(&file, exit))
}

/// The first option that says nothing without `--moving`.
pub fn idle(args: &Limit) -> Option<&'static str> {
    let given = [
        (args.chart.is_some(), "--chart"),
        (args.positions.is_some(), "--positions"),
        (args.every_value, "--every-value"),
    ];
    given.into_iter().find_map(|(given, name)| given.then_some(name))
}
