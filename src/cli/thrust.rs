//! `voussoir thrust`

use super::{
    args::Thrust,
    exit::Exit,
    question::{Question, verdict},
    terminal::Terminal,
};
use voussoir::{
    analysis::{
        Outcome,
        thrust::{answer, place},
    },
    report::ResultFile,
};

pub fn run(args: &Thrust, terminal: &Terminal) -> anyhow::Result<Exit> {
    let question = Question::open(&args.common)?.drawn(&args.pictures, args.tables.csv.as_deref())?;
    let at = place(&question.model, args.support.as_deref(), args.direction).map_err(|e| question.refuse(e))?;
    let thrust = answer(&question.model, at, &question.control());
    let file = question.answer(terminal, &args.options(), || ResultFile::thrust(&question.scene, &question.model, &thrust))?;
    let Some(found) = &file.answer.thrust else { return Ok(verdict(file.answer.verdict)) };
    let open = [found.least.status, found.greatest.status].contains(&Outcome::Undecided);
    Ok(if open { Exit::Undecided } else { Exit::Yes })
}
