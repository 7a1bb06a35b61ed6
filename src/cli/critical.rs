//! `voussoir critical`

use super::{
    args::Critical as Arguments,
    exit::Exit,
    question::{Depicted, Session, requirement, unless_weaker},
    terminal::Terminal,
};
use anyhow::bail;
use voussoir::{
    analysis::{Answer, Critical, CriticalOptions, MeetOptions},
    number::fixed,
    proof::{critical::CriticalResult, saved},
    report::view::View,
    verdict::Verdict,
};

/// Decimals of the value that the picture is of: flips are known to 1e-9.
const DIGITS: usize = 10;

/// More steps than this are taken for a mistake.
const MOST: f64 = 100_000.0;

pub fn run(args: &Arguments, terminal: &Terminal) -> anyhow::Result<Exit> {
    let [from, to] = args.between[..] else {
        bail!("--between takes two numbers: --between 0.05 0.2")
    };
    if from == to {
        bail!("--between {from} {to}: the range is empty; give two different values");
    }
    let scan = match args.step.map(|step| ((to - from) / step).abs().ceil() + 1.0) {
        None => args.scan.map(|n| n as usize),
        Some(count) if count <= MOST => Some(count as usize),
        Some(count) => bail!(
            "--step {}: the range has {count:.0} steps, more than the limit of {MOST}; use a larger step",
            args.step.unwrap_or(0.0)
        ),
    };
    let session = Session::open(&args.common)?;
    if let Some(ask) = args.ask {
        let ask = Box::new(args.nested.question(Some(ask), &session)?);
        let question =
            MeetOptions { ask, vary: args.vary.clone(), between: [from, to], scan }.into();
        let file =
            session.answer(terminal, session.result(&question, &session.ask(&question)?)?)?;
        return Ok(unless_weaker(&file, requirement(&file)));
    }
    if let Some(option) = args.nested.idle() {
        bail!("{option} requires --ask");
    }
    let question =
        CriticalOptions { law: session.law(), vary: args.vary.clone(), between: [from, to], scan }
            .into();
    let answer = session.ask(&question)?;
    let seen = match (&answer, session.report()) {
        (Answer::Critical(flips), Some(_)) => picture(&session, flips)?,
        _ => Depicted::Scene(Vec::new()),
    };
    let file = session.answer_seen(terminal, seen, session.result(&question, &answer)?)?;
    let exit = match file.answer.critical() {
        Some(values) if !values.is_empty() => Exit::Yes,
        _ if file.critical.as_ref().and_then(CriticalResult::exhausted).is_some() => Exit::No,
        _ => Exit::Undecided,
    };
    Ok(unless_weaker(&file, exit))
}

/// The scene beside the first flip, on the side where it falls; as it is where there is none.
fn picture(session: &Session, answer: &Critical) -> anyhow::Result<Depicted> {
    let sides = answer.changes.iter().flat_map(|c| [&c.below, &c.above]);
    let Some(side) = sides.into_iter().find(|s| s.assessment.verdict == Verdict::Unstable) else {
        return Ok(Depicted::Scene(Vec::new()));
    };
    let file = saved::assessment(&session.scene, &side.model, &side.assessment)
        .map_err(|e| session.refuse(e))?;
    let mut view = View::new(&side.model, &file, Vec::new())?;
    view.caption = format!("falls with {} at {}", answer.range.pointer, fixed(side.value, DIGITS));
    Ok(Depicted::Other(Box::new(view)))
}
