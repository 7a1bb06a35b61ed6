//! `voussoir kinematic`

use super::{
    args::Kinematic as Arguments,
    exit::Exit,
    output::Sink,
    question::{Session, requirement, unless_weaker},
    terminal::Terminal,
};
use voussoir::{
    analysis::{ControlPoint, KinematicOptions, Question},
    report::kinematic,
};

pub fn run(args: &Arguments, terminal: &Terminal) -> anyhow::Result<Exit> {
    let session = Session::open(&args.common)?;
    let open = |path: &Option<std::path::PathBuf>| {
        path.as_deref().map(|p| Sink::open(Some(p))).transpose()
    };
    let (csv, svg) = (open(&args.csv)?, open(&args.svg)?);
    let question = Question::Kinematic(KinematicOptions {
        law: session.law(),
        require: args.require,
        toward: args.toward.clone(),
        all: args.toward.is_empty().then_some(args.all),
        control: args.control.clone().map(|(block, point)| ControlPoint { block, point }),
        fc: args.fc,
        at: args.at.clone(),
        linear: args.linear,
        skip_dead: args.skip_dead,
    });
    let answer = session.ask(&question)?;
    let file = session.answer(terminal, &args.options(), session.result(&question, &answer)?)?;
    if let Some(csv) = csv {
        csv.write(&kinematic::csv(&file)?)?;
    }
    if let Some(svg) = svg {
        svg.write(&kinematic::chart(&file)?)?;
    }
    let exit = requirement(&file, question.require(), |alpha| alpha);
    // A site asks whether it is enough.
    let ratio = file.answer.kinematic().and_then(|a| Some(a.numbers.demand.as_ref()?.ratio));
    let exit = match ratio {
        Some(ratio) if ratio < 1.0 && exit == Exit::Yes => Exit::No,
        _ => exit,
    };
    Ok(unless_weaker(&file, exit))
}
