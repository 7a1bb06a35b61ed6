//! `voussoir assess`

use super::{
    args::Assess,
    camera::Camera,
    exit::Exit,
    question::{Depicted, Session, unless_weaker, verdict},
    terminal::Terminal,
};
use std::ops::ControlFlow;
use voussoir::{
    analysis::{Answer, AssessOptions, SimulateOptions},
    proof::{ResultFile, saved},
    verdict::Verdict,
};

pub fn run(args: &Assess, terminal: &Terminal) -> anyhow::Result<Exit> {
    let mut session =
        Session::open(&args.common)?.drawn(&args.pictures, args.tables.csv.as_deref())?;
    let question = AssessOptions { law: session.law() }.into();
    session.worst(&args.worst, &question)?;
    let answer = session.ask(&question)?;
    let mut file = session.result(&question, &answer)?;
    let doubt = matches!(file.answer.verdict(), Some(Verdict::Conditional | Verdict::Undecided));
    let mut film = Vec::new();
    if let (true, Answer::Assess(assessment)) = (args.simulate || (args.thorough && doubt), &answer)
    {
        let options = SimulateOptions::default();
        let asked = options.clone().into();
        let mut camera = Camera::new(&session, args.threads, session.report().is_some());
        if let Answer::Simulate(outcome) =
            camera.ask(&session, &asked, &mut |_| ControlFlow::Continue(()))?
        {
            file = saved::with_simulation(&file, &options, &session.model, assessment, &outcome)
                .map_err(|e| session.refuse(e))?;
        }
        film = camera.frames();
    }
    let file: ResultFile = session.answer_seen(terminal, Depicted::Scene(film), file)?;
    Ok(unless_weaker(&file, verdict(file.answer.verdict())))
}
