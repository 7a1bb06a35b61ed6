//! `voussoir kinematic`

use super::{
    args::{Kinematic as Arguments, Requirement},
    exit::Exit,
    ground,
    question::{Session, requirement, unless_weaker},
    terminal::Terminal,
    told::Told,
};
use anyhow::bail;
use voussoir::analysis::{ControlPoint, KinematicOptions};

pub fn run(args: &Arguments, terminal: &Terminal) -> anyhow::Result<Exit> {
    let session = Session::open(&args.common)?;
    let told = Told::open(&args.csv, &args.svg)?;
    if args.rocking.asked() {
        return in_time(args, &session, terminal, told);
    }
    if let Some(option) = args.rocking.idle() {
        bail!("{option} requires --ground or --pulse");
    }
    let (require, site) = match args.require {
        None => (None, None),
        Some(Requirement::Value(v)) => (Some(v), None),
        Some(Requirement::Site(share)) => (None, Some(share)),
    };
    if site.is_some() && session.scene.site.is_none() {
        bail!("--require site: the scene has no \"site\"");
    }
    let question = KinematicOptions {
        law: session.law(),
        require,
        site,
        verify: args.verify.map(Into::into),
        toward: args.toward.clone(),
        all: args.toward.is_empty().then_some(args.all),
        control: args.control.clone().map(|(block, point)| ControlPoint { block, point }),
        fc: args.fc,
        at: args.at.clone(),
        linear: args.linear,
        skip_dead: args.skip_dead,
        sensitivity: args.sensitivity,
    }
    .into();
    let answer = session.ask(&question)?;
    let file = session.answer(terminal, session.result(&question, &answer)?)?;
    told.write(&file)?;
    let exit = requirement(&file);
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
        (args.sensitivity, "--sensitivity"),
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
