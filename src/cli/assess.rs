//! `voussoir assess`

use super::{
    again::worst,
    args::Assess,
    exit::Exit,
    question::{Question, verdict},
    terminal::Terminal,
};
use voussoir::{analysis::assess, report::ResultFile, sweep::WorstOf};

pub fn run(args: &Assess, terminal: &Terminal) -> anyhow::Result<Exit> {
    let mut question = Question::open(&args.common)?;
    question.worst(&args.worst, WorstOf::Assess)?;
    let assessment = assess(&question.model.assembly, &question.model.interfaces, &question.control());
    let file = question.answer(terminal, &worst(&args.worst), || ResultFile::assessment(&question.scene, &question.model, &assessment))?;
    Ok(verdict(file.answer.verdict))
}
