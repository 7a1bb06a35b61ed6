//! `voussoir limit --moving`

use super::{
    args::Limit,
    exit::Exit,
    question::{Depicted, Session, requirement, unless_weaker},
    terminal::Terminal,
    told::Told,
};
use anyhow::bail;
use voussoir::{
    analysis::MovingOptions,
    report::{tell::at_an_end, view::positions},
    train::not_crossed,
};

pub fn run(args: &Limit, terminal: &Terminal) -> anyhow::Result<Exit> {
    if !args.worst.is_empty() {
        bail!(
            "--worst cannot be combined with --moving\nhint: sweep over the range with the question `moving`"
        );
    }
    if args.sensitivity {
        bail!("--sensitivity cannot be combined with --moving");
    }
    let told = Told::open(&args.positions, &args.chart)?;
    let session = Session::open(&args.common)?.drawn(&args.pictures, args.tables.csv.as_deref())?;
    let question = MovingOptions {
        law: session.law(),
        require: args.require,
        skip_dead: args.skip_dead,
        every_value: args.every_value,
    }
    .into();
    let answer = session.ask(&question)?;
    let file = session.result(&question, &answer)?;
    let film = if session.is_filmed() { positions(&session.model, &file) } else { Vec::new() };
    let file = session.answer_seen(terminal, Depicted::Scene(film), file)?;
    told.write(&file)?;
    let exit = match requirement(&file) {
        // What is worst where the path ends may be worse beyond, and so may a span that is left out.
        Exit::Yes if at_an_end(&file) || !not_crossed(&file.scene.input).is_empty() => {
            Exit::Undecided
        }
        exit => exit,
    };
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
