//! `voussoir assess`

use super::{
    args::Assess,
    exit::Exit,
    question::{Question, Seen, verdict},
    simulate::{threads, watch},
    terminal::Terminal,
};
use std::ops::ControlFlow;
use voussoir::{
    analysis::assess,
    dynamics::SimulationSettings,
    report::{ResultFile, view::Film},
    sweep::WorstOf,
    verdict::Verdict,
};

pub fn run(args: &Assess, terminal: &Terminal) -> anyhow::Result<Exit> {
    let mut question = Question::open(&args.common)?.drawn(&args.pictures, args.tables.csv.as_deref())?;
    question.worst(&args.worst, WorstOf::Assess)?;
    let assessment = assess(&question.model, &question.control());
    let doubt = matches!(assessment.verdict, Verdict::Conditional | Verdict::Undecided);
    let mut film = question.report().map(|_| Film::fitting(question.model.assembly.blocks.len()));
    let settings = SimulationSettings { threads: threads(args.threads), every_step: film.is_some(), ..SimulationSettings::default() };
    let outcome = match args.simulate || (args.thorough && doubt) {
        true => Some(watch(&question, &settings, &mut film, &mut |_| ControlFlow::Continue(()))?),
        false => None,
    };
    let frames = film.map(Film::frames).unwrap_or_default();
    let file = question.answer_seen(terminal, &args.options(), Seen::Scene(frames), || {
        let file = ResultFile::assessment(&question.scene, &question.model, &assessment);
        match &outcome {
            Some(outcome) => file.with_simulation(&question.model, Some(&assessment), outcome),
            None => file,
        }
    })?;
    Ok(verdict(file.answer.verdict))
}
