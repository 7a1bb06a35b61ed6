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
        Law, Outcome, assess, tilt,
        tilt::{directions, tilted},
    },
    report::{Leaning, ResultFile},
};

pub fn run(args: &Arguments, terminal: &Terminal) -> anyhow::Result<Exit> {
    let question = Question::open(&args.common)?.drawn(&args.pictures, args.tables.csv.as_deref())?;
    let model = &question.model;
    let toward = if args.toward.is_empty() {
        directions(model.assembly.gravity, args.all.into())
    } else {
        args.toward.iter().map(|&d| d.into()).collect()
    };
    let dead = (!args.skip_dead).then(|| assess(model, &question.control()));
    let level = dead.as_ref().map(|d| d.verdict);
    let mut answers = Vec::with_capacity(toward.len());
    for direction in toward {
        let tilt = tilt(model, direction, &question.control())?;
        let turned = tilted(model, direction, tilt.load_factor.value)?;
        let bounded = matches!(tilt.load_factor.outcome, Outcome::Found | Outcome::Unbounded);
        let dry = if bounded && question.control().law == Law::Coulomb {
            let dry = tilt::dry(model, &tilt, level, &question.control())?;
            Some((tilted(model, direction, dry.value)?, dry))
        } else {
            None
        };
        answers.push(Leaning { model: turned, tilt, dry });
    }
    let packed = ResultFile::tilt(&question.scene, &answers).context("no direction to tilt towards")?;
    let file = question.answer(terminal, &args.options(), || match &dead {
        Some(dead) => packed.with_dead_load(model, dead),
        None => packed,
    })?;
    Ok(requirement(&file, args.require, |lambda| lambda.atan().to_degrees()))
}
