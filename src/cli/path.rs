//! `voussoir settle` and `voussoir push`

use super::{
    args::{Curve, Push, Settle},
    cracks,
    exit::Exit,
    input, kept,
    question::{Depicted, Session},
    terminal::Terminal,
    told::Told,
};
use anyhow::{Context, bail};
use voussoir::{
    analysis::{ControlPoint, PushOptions, Question, SettleOptions},
    path::saved::SavedPose,
    proof::{self, path::PathStatus},
    report::view::frames,
};

pub fn settle(args: &Settle, terminal: &Terminal) -> anyhow::Result<Exit> {
    if let Some(file) = &args.cracks {
        let session = Session::open(&args.common)?;
        return cracks::run(&session, file, args.common.json, args.common.quiet);
    }
    let session = Session::open(&args.common)?.filmed(&args.curve.pictures)?;
    let question = SettleOptions {
        moves: args.moves.clone(),
        at: args.at.clone(),
        from: begin(&session, &args.curve)?,
    }
    .into();
    run(&session, &question, &args.curve, terminal)
}

pub fn push(args: &Push, terminal: &Terminal) -> anyhow::Result<Exit> {
    let (block, point) = args.control.clone();
    let session = Session::open(&args.common)?.filmed(&args.curve.pictures)?;
    let question = PushOptions {
        control: ControlPoint { block, point },
        toward: args.toward,
        at: args.at.clone(),
        from: begin(&session, &args.curve)?,
    }
    .into();
    run(&session, &question, &args.curve, terminal)
}

/// The last pose of the result to begin at, where there is one: of a result that is verified against
/// the scene that is asked about.
fn begin(session: &Session, curve: &Curve) -> anyhow::Result<Vec<SavedPose>> {
    let Some(from) = &curve.from else { return Ok(Vec::new()) };
    let (name, text) = input::text(from)?;
    let saved = proof::read::read_str(name.clone(), text)?;
    let verified = proof::verify(&saved, &session.scene)?;
    if let Some((title, findings)) = verified.parts.iter().find(|(_, f)| !f.fails.is_empty()) {
        bail!(
            "{name} is refuted for this scene: {title}: {}\nhint: solve the current scene again with --save",
            findings.fails.join("; ")
        );
    }
    let path = verified.file.as_ref().and_then(|file| file.path.as_ref());
    let last = path.and_then(|path| {
        let proved = |p: &&proof::path::PathPoint| p.certificate.claim.is_some();
        path.points.iter().take_while(proved).last()
    });
    let last = last.filter(|p| !p.poses.is_empty());
    last.map(|p| p.poses.clone())
        .with_context(|| format!("{name} holds no proved pose of the displaced structure"))
}

fn run(
    session: &Session,
    question: &Question,
    curve: &Curve,
    terminal: &Terminal,
) -> anyhow::Result<Exit> {
    let told = Told::open(&curve.csv, &curve.chart)?;
    let file = match &curve.keep {
        Some(keep) => kept::ask(session, question, keep)?,
        None => session.result(question, &session.ask(question)?)?,
    };
    let film = if session.is_filmed() { frames(&session.model, &file) } else { Vec::new() };
    let file = session.answer_seen(terminal, Depicted::Scene(film), file)?;
    told.write(&file)?;
    let path = file.answer.path();
    Ok(match path.map(|a| a.status) {
        // Beyond a jump nothing is followed.
        Some(PathStatus::Reached) if path.is_some_and(|a| a.jumps_at.is_some()) => Exit::Undecided,
        Some(PathStatus::Reached | PathStatus::Vanishes) => Exit::Yes,
        Some(PathStatus::Falls) => Exit::No,
        Some(PathStatus::Slides | PathStatus::Open) | None => Exit::Undecided,
    })
}
