//! `voussoir tilt`

use super::{
    args::Tilt,
    exit::Exit,
    question::{Question, requirement},
    terminal::Terminal,
};
use anyhow::Context;
use voussoir::{
    analysis::{Model, assess, tilt, tilt::directions, tilt::turned},
    report::ResultFile,
};

pub fn run(args: &Tilt, terminal: &Terminal) -> anyhow::Result<Exit> {
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
        let (assembly, _) = turned(&model.assembly, direction)?;
        answers.push((Model { assembly, interfaces: model.interfaces.clone(), timings: model.timings }, answer));
    }
    let dead = (!args.skip_dead).then(|| assess(&model.assembly, &model.interfaces, &question.control()));
    let packed = ResultFile::tilt(&question.scene, &answers).context("no direction to tilt towards")?;
    let file = question.answer(terminal, || match &dead {
        Some(dead) => packed.with_dead_load(model, dead),
        None => packed,
    })?;
    Ok(requirement(&file, args.require, |lambda| lambda.atan().to_degrees()))
}
