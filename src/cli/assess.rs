//! `voussoir assess`

use super::{
    args::Assess,
    exit::Exit,
    question::{Question, verdict},
    terminal::Terminal,
};
use voussoir::{analysis::assess, report::ResultFile};

pub fn run(args: &Assess, terminal: &Terminal) -> anyhow::Result<Exit> {
    let question = Question::open(&args.common)?;
    let assessment = assess(&question.model.assembly, &question.model.interfaces, &question.control());
    let file = question.answer(terminal, &[], || ResultFile::assessment(&question.scene, &question.model, &assessment))?;
    Ok(verdict(file.answer.verdict))
}
