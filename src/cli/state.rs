//! `voussoir state`

use super::{
    args::{Law, State as Arguments},
    exit::Exit,
    question::{Session, requirement},
    terminal::Terminal,
    told::Told,
};
use anyhow::bail;
use voussoir::analysis::{ControlPoint, StateOptions};

pub fn run(args: &Arguments, terminal: &Terminal) -> anyhow::Result<Exit> {
    if args.common.law == Law::Associative {
        bail!(
            "--law associative does not apply: elastic joints slide by Coulomb's law, and the bound is reported beside the path\nhint: omit --law"
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
    Ok(requirement(&file))
}
