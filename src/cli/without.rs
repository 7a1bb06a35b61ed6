//! `voussoir without`

use super::{
    args::Without,
    exit::Exit,
    question::{Depicted, Session},
    terminal::Terminal,
    told::Told,
};
use voussoir::{analysis::WithoutOptions, proof::Answer, verdict::Verdict};

pub fn run(args: &Without, terminal: &Terminal) -> anyhow::Result<Exit> {
    let session = Session::open(&args.common)?.drawn(&args.pictures, None)?;
    let told = Told::open(&args.csv, &None)?;
    let question = WithoutOptions { law: session.law() }.into();
    let answer = session.ask(&question)?;
    let file = session.result(&question, &answer)?;
    let file = session.answer_seen(terminal, Depicted::Scene(Vec::new()), file)?;
    told.write(&file)?;
    Ok(match &file.answer {
        Answer::Without(a) if !a.removable.is_empty() => Exit::Yes,
        Answer::Without(a) if a.with(Verdict::Undecided).next().is_none() => Exit::No,
        _ => Exit::Undecided,
    })
}
