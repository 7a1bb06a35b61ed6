//! `voussoir critical`

use super::{args::Critical, exit::Exit, question::Question, terminal::Terminal};
use anyhow::bail;
use voussoir::{
    analysis::{critical, critical::Range},
    report::{ResultFile, critical::exhausted},
};

/// More steps than this are taken for a slip.
const MOST: f64 = 100_000.0;

pub fn run(args: &Critical, terminal: &Terminal) -> anyhow::Result<Exit> {
    let [from, to] = args.between[..] else { bail!("--between takes two numbers: --between 0.05 0.2") };
    if from == to {
        bail!("--between {from} {to}: the range is empty");
    }
    let scan = match args.step.map(|step| ((to - from) / step).abs().ceil() + 1.0) {
        None => args.scan.map(|n| n as usize),
        Some(count) if count <= MOST => Some(count as usize),
        Some(count) => bail!("--step {}: the range would take {count:.0} steps, at most {MOST} are taken", args.step.unwrap_or(0.0)),
    };
    let question = Question::open(&args.common)?;
    let range = Range { pointer: args.vary.clone(), from, to, scan };
    let answer = critical(&question.scene, &range, &question.control()).map_err(|e| question.refuse(e))?;
    let file = question.answer(terminal, &args.options(), || ResultFile::critical(&question.scene, &question.model, &answer))?;
    Ok(match &file.answer.critical {
        Some(values) if !values.is_empty() => Exit::Yes,
        _ if exhausted(&file).is_some() => Exit::No,
        _ => Exit::Undecided,
    })
}
