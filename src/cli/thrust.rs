//! `voussoir thrust`

use super::{
    args::Thrust,
    exit::Exit,
    question::{Session, requirement, unless_weaker, verdict},
    terminal::{self, Terminal},
};
use voussoir::analysis::{Outcome, ThrustOptions, thrust::bearing_supports};

pub fn run(args: &Thrust, terminal: &Terminal) -> anyhow::Result<Exit> {
    let session = Session::open(&args.common)?.drawn(&args.pictures, args.tables.csv.as_deref())?;
    let (law, support, direction) = (session.law(), args.support.clone(), args.direction);
    let question = ThrustOptions {
        law,
        support,
        direction,
        member: args.member.clone(),
        greatest: false,
        range: true,
        require: args.require,
    }
    .into();
    let supports = bearing_supports(&session.model);
    // The first line names it, too.
    let told = args.common.quiet || args.common.json;
    if !told && args.support.is_none() && args.member.is_none() && supports.len() > 1 {
        let names = session.model.ids(&supports);
        terminal::say(&format!(
            "note: no support is named: the thrust is that on {}; --support names another: {}",
            names[0],
            names[1..].iter().take(6).cloned().collect::<Vec<_>>().join(", ")
        ));
    }
    let answer = session.ask(&question)?;
    let file = session.answer(terminal, session.result(&question, &answer)?)?;
    let Some(found) = file.answer.thrust() else { return Ok(verdict(file.answer.verdict())) };
    if file.required.is_some() {
        let exit = requirement(&file);
        return Ok(unless_weaker(&file, exit));
    }
    let open = [found.least.status, found.greatest.status].contains(&Outcome::Undecided);
    Ok(unless_weaker(&file, if open { Exit::Undecided } else { Exit::Yes }))
}
