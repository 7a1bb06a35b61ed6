//! `voussoir state`

use super::{
    args::{Law, State as Arguments},
    exit::Exit,
    question::{Session, verdict},
    terminal::Terminal,
    told::Told,
};
use anyhow::bail;
use voussoir::{
    analysis::{ControlPoint, StateOptions},
    elastic::PathEnd,
    proof::state::StateAnswer,
    verdict::Verdict,
};

pub fn run(args: &Arguments, terminal: &Terminal) -> anyhow::Result<Exit> {
    if args.common.law == Law::Associative {
        bail!(
            "--law associative: joints that yield slide by Coulomb's law, and the bound stands beside the path; leave it out"
        );
    }
    let session = Session::open(&args.common)?.drawn(&args.pictures, None)?;
    let told = Told::open(&args.csv, &args.chart)?;
    let control = args.control.clone().map(|(block, point)| ControlPoint { block, point });
    let question = StateOptions {
        quadrature: args.quadrature.into(),
        control,
        at: args.at.clone(),
        dead_only: args.dead_only,
        require: args.require,
    }
    .into();
    let answer = session.ask(&question)?;
    let file = session.result(&question, &answer)?;
    let file = session.answer(terminal, file)?;
    told.write(&file)?;
    Ok(file.answer.state().map_or(Exit::Undecided, |a| exit(a, args.require)))
}

/// Whether it stands, and the path reaches far enough.
fn exit(a: &StateAnswer, require: Option<f64>) -> Exit {
    match (a.load_factor, require) {
        _ if a.verdict != Verdict::Stable => verdict(Some(a.verdict)),
        (Some(l), Some(r)) if l.reached >= r || l.value.is_some_and(|v| v >= r) => Exit::Yes,
        (Some(l), Some(r)) if l.associative.upper.is_some_and(|u| u < r) => Exit::No,
        (Some(l), Some(_)) if l.value.is_some() => Exit::No,
        (_, Some(_)) => Exit::Undecided,
        (Some(l), None) if l.end == PathEnd::Open => Exit::Undecided,
        (_, None) => Exit::Yes,
    }
}
