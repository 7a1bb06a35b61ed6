//! `voussoir tilt`

use super::{
    args::Tilt as Arguments,
    exit::Exit,
    question::{Question, requirement},
    terminal::Terminal,
};
use anyhow::Context;
use voussoir::{
    analysis::{
        Law, Outcome, Tilt, assess, tilt,
        tilt::{directions, tilted},
    },
    report::ResultFile,
};

pub fn run(args: &Arguments, terminal: &Terminal) -> anyhow::Result<Exit> {
    let question = Question::open(&args.common)?;
    let model = &question.model;
    let toward = if args.toward.is_empty() {
        directions(model.assembly.gravity, args.all.into())
    } else {
        args.toward.iter().map(|&d| d.into()).collect()
    };
    let mut answers = Vec::with_capacity(toward.len());
    for direction in toward {
        let answer = tilt(&model.assembly, &model.interfaces, direction, &question.control())?;
        answers.push((tilted(model, direction, answer.load_factor.value)?, answer));
    }
    let dead = (!args.skip_dead).then(|| assess(&model.assembly, &model.interfaces, &question.control()));
    let mut packed = ResultFile::tilt(&question.scene, &answers).context("no direction to tilt towards")?;
    let least = answers.iter().find(|(_, t)| Some(<[f64; 3]>::from(t.toward)) == packed.answer.toward);
    let bounded = |t: &Tilt| matches!(t.load_factor.outcome, Outcome::Found | Outcome::Unbounded);
    if let Some((turned, least)) = least.filter(|(_, t)| question.control().law == Law::Coulomb && bounded(t)) {
        let dry = tilt::dry(&turned.assembly, &model.interfaces, &least.load_factor, &question.control());
        packed = packed.with_dry(&tilted(model, least.toward, dry.value)?, &dry);
    }
    let file = question.answer(terminal, &args.options(), || match &dead {
        Some(dead) => packed.with_dead_load(model, dead),
        None => packed,
    })?;
    Ok(requirement(&file, args.require, |lambda| lambda.atan().to_degrees()))
}
