//! `voussoir tilt`

use super::{
    args::Tilt as Arguments,
    exit::Exit,
    question::{Session, requirement, unless_weaker},
    terminal::Terminal,
};
use voussoir::analysis::TiltOptions;

pub fn run(args: &Arguments, terminal: &Terminal) -> anyhow::Result<Exit> {
    let session = Session::open(&args.common)?.drawn(&args.pictures, args.tables.csv.as_deref())?;
    let question = TiltOptions {
        law: session.law(),
        require: args.require,
        toward: args.toward.clone(),
        all: args.toward.is_empty().then_some(args.all),
        skip_dead: args.skip_dead,
        sensitivity: args.sensitivity,
    }
    .into();
    let file = session.result(&question, &session.ask(&question)?)?;
    let file = session.answer(terminal, file)?;
    let exit = requirement(&file);
    Ok(unless_weaker(&file, exit))
}
