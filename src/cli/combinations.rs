//! `voussoir combinations`

use super::{
    args::Combinations as Arguments,
    exit::Exit,
    question::{Depicted, Session, requirement, unless_weaker},
    terminal::Terminal,
    told::Told,
};
use anyhow::bail;
use voussoir::{
    analysis::{Answer, CombinationsOptions},
    report::view::View,
};

pub fn run(args: &Arguments, terminal: &Terminal) -> anyhow::Result<Exit> {
    if args.common.combination.is_some() {
        bail!("--combination has no effect here; use --only to ask in one combination");
    }
    let told = Told::open(&args.csv, &None)?;
    let session = Session::open(&args.common)?.drawn(&args.pictures, None)?;
    let ask = args.nested.question(args.ask, &session)?;
    let question = CombinationsOptions { ask: Box::new(ask), only: args.only.clone() }.into();
    let answer = session.ask(&question)?;
    let file = session.result(&question, &answer)?;
    let seen = match (&answer, session.is_filmed()) {
        (Answer::Combinations(c), true) => match c.worst() {
            Some(worst) => {
                Depicted::Other(Box::new(View::new(&worst.model, &worst.file, Vec::new())?))
            }
            None => Depicted::Scene(Vec::new()),
        },
        _ => Depicted::Scene(Vec::new()),
    };
    let file = session.answer_seen(terminal, seen, file)?;
    told.write(&file)?;
    let exit = requirement(&file);
    Ok(unless_weaker(&file, exit))
}
