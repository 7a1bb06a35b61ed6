//! `voussoir kinematic`

use super::{
    args::Kinematic as Arguments,
    exit::Exit,
    ground,
    question::{Session, requirement, unless_weaker},
    terminal::Terminal,
    told::Told,
};
use anyhow::bail;
use voussoir::{
    analysis::{ControlPoint, KinematicOptions},
    proof::kinematic::Numbers,
};

pub fn run(args: &Arguments, terminal: &Terminal) -> anyhow::Result<Exit> {
    let session = Session::open(&args.common)?;
    let told = Told::open(&args.csv, &args.svg)?;
    if args.rocking.asked() {
        return in_time(args, &session, terminal, told);
    }
    if let Some(option) = args.rocking.idle() {
        bail!("{option} requires --ground or --pulse");
    }
    let question = KinematicOptions {
        law: session.law(),
        require: args.require,
        toward: args.toward.clone(),
        all: args.toward.is_empty().then_some(args.all),
        control: args.control.clone().map(|(block, point)| ControlPoint { block, point }),
        fc: args.fc,
        at: args.at.clone(),
        linear: args.linear,
        skip_dead: args.skip_dead,
    }
    .into();
    let answer = session.ask(&question)?;
    let file = session.answer(terminal, session.result(&question, &answer)?)?;
    told.write(&file)?;
    let exit = requirement(&file);
    // A site asks whether it is enough.
    let numbers = file.answer.kinematic().map(|a| &a.numbers);
    let ratio = numbers.and_then(|n| Some(n.demand.as_ref()?.ratio));
    let exit = match (ratio, numbers.and_then(Numbers::least_ratio)) {
        (Some(ratio), _) if ratio < 1.0 && exit == Exit::Yes => Exit::No,
        // Met only because a body is drawn as several blocks.
        (_, Some(least)) if least < 1.0 && exit == Exit::Yes => Exit::Undecided,
        _ => exit,
    };
    Ok(unless_weaker(&file, exit))
}

/// The mechanism of one direction, in time.
fn in_time(
    args: &Arguments,
    session: &Session,
    terminal: &Terminal,
    told: Told,
) -> anyhow::Result<Exit> {
    let without = [
        (args.fc.is_some(), "--fc"),
        (!args.at.is_empty(), "--at"),
        (args.linear, "--linear"),
        (args.require.is_some(), "--require"),
        (args.skip_dead, "--skip-dead"),
        (args.toward.len() > 1, "a second --toward"),
    ];
    if let Some((_, option)) = without.into_iter().find(|w| w.0) {
        bail!("{option} cannot be combined with --ground, --pulse or --from");
    }
    if let Some(option) = args.rocking.idle() {
        bail!("{option} requires --ground or --pulse");
    }
    let ask = ground::Rock {
        args: &args.rocking,
        toward: args.toward.first().copied(),
        control: args.control.clone(),
        told,
    };
    ground::rock(session, terminal, ask)
}
