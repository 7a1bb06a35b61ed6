//! `voussoir limit`

use super::{
    again::{skip_dead, worst},
    args::Limit,
    exit::Exit,
    question::{Question, requirement},
    terminal::Terminal,
};
use voussoir::{
    analysis::{Law, Outcome, assess, coulomb, limit},
    assembly::Wrench,
    error::{InputError, JsonPath},
    report::ResultFile,
    sweep::WorstOf,
};

pub fn run(args: &Limit, terminal: &Terminal) -> anyhow::Result<Exit> {
    let mut question = Question::open(&args.common)?.drawn(&args.pictures, args.tables.csv.as_deref())?;
    no_live_load(&question)?;
    question.worst(&args.worst, WorstOf::Limit)?;
    let model = &question.model;
    let answer = limit(model, &question.control());
    // Where the answer itself says that λ = 0 is too much, there is nothing left to ask.
    let settled = answer.outcome == Outcome::Impossible || (answer.outcome == Outcome::Found && answer.bracket.upper < 0.0);
    let dead = (!settled && !args.skip_dead).then(|| assess(model, &question.control()));
    let ask_dry = question.control().law == Law::Coulomb && matches!(answer.outcome, Outcome::Found | Outcome::Unbounded);
    let level = dead.as_ref().map(|d| d.verdict);
    let dry = ask_dry.then(|| coulomb::load_factor_from(model, &answer, level, &question.control()));
    let file = question.answer(terminal, &[skip_dead(args.skip_dead), worst(&args.worst)].concat(), || {
        let file = ResultFile::load_factor(&question.scene, &question.model, &answer);
        let file = match &dry {
            Some(dry) => file.with_dry(&question.model, dry),
            None => file,
        };
        match &dead {
            Some(dead) => file.with_dead_load(&question.model, dead),
            None => file,
        }
    })?;
    Ok(requirement(&file, args.require, |lambda| lambda))
}

/// Refuses a scene without a live load.
fn no_live_load(question: &Question) -> anyhow::Result<()> {
    if question.model.assembly.live.iter().all(|w| *w == Wrench::zero()) {
        let error = InputError::at(JsonPath::root().key("loads").key("live"), "there is no live load on a free block to ask about").hint(
            "add \"loads\": { \"live\": [ { \"weight\": [1, 0, 0] } ] } (the weight of every block, sideways), or ask `voussoir tilt`",
        );
        return Err(question.refuse(error));
    }
    Ok(())
}
