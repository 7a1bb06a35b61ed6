//! `voussoir limit`

use super::{
    args::Limit,
    exit::Exit,
    moving,
    question::{Session, requirement, unless_weaker},
    terminal::Terminal,
};
use anyhow::bail;
use voussoir::analysis::LimitOptions;

pub fn run(args: &Limit, terminal: &Terminal) -> anyhow::Result<Exit> {
    if args.moving {
        return moving::run(args, terminal);
    }
    if let Some(option) = moving::idle(args) {
        bail!("{option} requires --moving");
    }
    let mut session =
        Session::open(&args.common)?.drawn(&args.pictures, args.tables.csv.as_deref())?;
    let question = LimitOptions {
        law: session.law(),
        require: args.require,
        skip_dead: args.skip_dead,
        sensitivity: args.sensitivity,
    }
    .into();
    session.worst(&args.worst, &question)?;
    let file = session.result(&question, &session.ask(&question)?)?;
    let file = session.answer(terminal, file)?;
    let exit = requirement(&file);
    Ok(unless_weaker(&file, exit))
}
