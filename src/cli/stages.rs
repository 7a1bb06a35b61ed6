//! `voussoir stages`

use super::{
    args::Stages as Arguments,
    exit::Exit,
    question::{Depicted, Session, verdict},
    terminal::Terminal,
    told::Told,
};
use voussoir::{
    analysis::{Answer, StagesOptions},
    proof::{ResultFile, saved, stages::StagesAnswer},
    report::view::View,
    verdict::Verdict,
};

pub fn run(args: &Arguments, terminal: &Terminal) -> anyhow::Result<Exit> {
    let session = Session::open(&args.common)?.drawn(&args.pictures, None)?;
    let told = Told::open(&args.csv, &args.chart)?;
    let question = StagesOptions {
        law: session.law(),
        any_order: args.any_order,
        order: args.order.clone(),
        hands: args.hands,
        tries: args.tries.map(|n| n as usize),
        toward: args.toward.clone(),
        all: args.all,
        skip_margin: args.skip_margin,
        skip_held: args.skip_held,
    }
    .into();
    let answer = session.ask(&question)?;
    let file = session.result(&question, &answer)?;
    let seen = match worst(&session, &answer, &file) {
        Some((model, file)) if session.pictures().wanted() => {
            Depicted::Drawn(Box::new(View::new(model, &file, Vec::new())?))
        }
        _ => Depicted::Scene(Vec::new()),
    };
    let file = session.answer_seen(terminal, seen, file)?;
    told.write(&file)?;
    Ok(file.answer.stages().map_or(Exit::Undecided, exit))
}

/// The worst stage as a result of its own, for pictures.
fn worst<'a>(
    session: &Session,
    answer: &'a Answer,
    file: &ResultFile,
) -> Option<(&'a voussoir::interface::Model, ResultFile)> {
    let Answer::Stages(asked) = answer else { return None };
    let said = file.answer.stages()?;
    let stage = asked.stages.iter().find(|s| s.stage.name == said.worst)?;
    let mut own = saved::assessment(&session.scene, &stage.model, &stage.verdict).ok()?;
    own.scene.name = format!("{}: {}", file.scene.name, said.worst);
    Some((&stage.model, own))
}

/// Whether all stand.
fn exit(said: &StagesAnswer) -> Exit {
    if said.least_held.is_some() {
        return match (said.hands_do(), said.verdict) {
            (Some(false), _) => Exit::No,
            (Some(true), Verdict::Stable) => Exit::Yes,
            _ => Exit::Undecided,
        };
    }
    // A margin that is negative or was not found is no yes.
    match said.verdict {
        Verdict::Stable if !said.is_safe() => Exit::Undecided,
        known => verdict(Some(known)),
    }
}
