//! `voussoir assess`

use super::{
    args::Assess,
    exit::Exit,
    question::{Question, verdict},
    simulate::{threads, watch},
    terminal::Terminal,
};
use std::ops::ControlFlow;
use voussoir::{analysis::assess, dynamics::Settings, report::ResultFile, sweep::WorstOf, verdict::Verdict};

pub fn run(args: &Assess, terminal: &Terminal) -> anyhow::Result<Exit> {
    let mut question = Question::open(&args.common)?;
    question.worst(&args.worst, WorstOf::Assess)?;
    let assessment = assess(&question.model.assembly, &question.model.interfaces, &question.control());
    let doubt = matches!(assessment.verdict, Verdict::Conditional | Verdict::Undecided);
    let settings = Settings { threads: threads(args.threads), ..Settings::default() };
    let outcome = match args.simulate || (args.thorough && doubt) {
        true => Some(watch(&question, &settings, &mut |_| ControlFlow::Continue(()))?),
        false => None,
    };
    let file = question.answer(terminal, &args.options(), || {
        let file = ResultFile::assessment(&question.scene, &question.model, &assessment);
        match &outcome {
            Some(outcome) => file.with_simulation(&question.model, Some(&assessment), outcome),
            None => file,
        }
    })?;
    Ok(verdict(file.answer.verdict))
}
