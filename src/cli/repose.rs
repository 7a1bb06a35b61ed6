//! `voussoir repose`: how steep may a packing be?

use super::{
    args::{Asked, Repose},
    exit::Exit,
    heap,
    output::Sink,
    question::{Session, quoted},
    report,
    terminal::{self, Terminal},
};
use anyhow::{Context, bail};
use std::time::Instant;
use voussoir::{
    analysis::{Answer, AssessOptions, ReposeOptions, ask, doubt, fabric},
    error::InputError,
    interface::{Model, prepare},
    proof::{packing::PackingDirection, saved},
    report::{
        contacts,
        grains::{self, GrainFormat},
        json, page,
        record::Record,
        tell,
        text::{self, TextOptions},
        view::View,
    },
    verdict::{Forces, Verdict},
};

/// What --question repose takes in place of a scene.
const PROTOCOLS: [&str; 8] =
    ["drain", "funnel", "cylinder", "tilt", "drum", "hopper", "shear", "cell"];

pub fn run(args: &Repose, terminal: &Terminal) -> anyhow::Result<Exit> {
    if args.common.self_checking.is_some() {
        bail!(
            "pages of heaps cannot verify themselves: a heap is no single result; omit --self-checking and verify with `voussoir check`"
        );
    }
    if args.question == Asked::Repose {
        return heap::run(args, terminal);
    }
    if let Some(word) =
        args.common.scene.to_str().filter(|w| PROTOCOLS.contains(w) && !args.common.scene.exists())
    {
        bail!(
            InputError::at(
                Default::default(),
                format!("`{word}` is a protocol that makes heaps; no scene has this name")
            )
            .hint(format!(
                "ask for the slope of heaps with `voussoir repose {word} --question repose`"
            ))
        );
    }
    if let Some((key, _)) = args.set.first() {
        bail!("{key}=… requires --question repose: only protocols take values");
    }
    if args.keep.is_some() || args.heaps.is_some() || args.skip_margin || args.start.is_some() {
        bail!("--keep, --heaps, --start and --skip-margin require --question repose");
    }
    let csv = args.csv.as_deref().map(|p| Sink::open(Some(p))).transpose()?;
    let grains = args.grains.as_deref().map(|p| Sink::open(Some(p))).transpose()?;
    let session = Session::open(&args.common)?.drawn(&args.pictures, None)?;
    let question = ReposeOptions {
        law: session.law(),
        require: None,
        toward: args.toward.clone(),
        all: args.toward.is_empty().then_some(args.all),
        moving_mass: args.moving_mass,
    }
    .into();
    // As they lie, whatever the answer will be.
    if let Some(grains) = &grains {
        let format = GrainFormat::of(args.grains.as_deref());
        grains.write(&self::grains::written(&session.scene, format)?)?;
    }
    let start = Instant::now();
    let answer = session.ask(&question)?;
    let Answer::Repose(packing) = &answer else { bail!("there is no packing") };
    let model = &packing.model;
    let forces = (args.fabric || csv.is_some()).then(|| level(&session, model)).transpose()?;
    let solve = start.elapsed().as_secs_f64();
    let packed =
        saved::packing(&session.scene, args.moving_mass, packing).map_err(|e| session.refuse(e))?;
    let (mut file, proof) = packed.context("no direction to tilt towards")?;
    (file.timings.check, file.timings.solve) =
        (proof.run.timings.check, (solve - proof.run.timings.check).max(0.0));
    file.doubt = doubt(&answer, &session.model, &session.control());
    if let Some((forces, whose)) = &forces {
        file.fabric = fabric(model, forces).filter(|_| args.fabric);
        let none = "no contact carries a force: what was found does not balance the packing";
        let whose = if file.fabric.is_some() { whose } else { none };
        file.fabric_forces = args.fabric.then(|| whose.to_string());
        if let Some(csv) = &csv {
            let table = contacts::csv(model, forces).map_err(|e| anyhow::anyhow!("{e}"))?;
            csv.write(&table)?;
        }
    }
    if let Some(save) = session.save() {
        save.write(&json::text(&proof.to_value()?))?;
    }
    let layout = terminal.layout(&args.common.scene);
    // The round with the answer: grains that fell earlier are gone.
    let mut seen = session
        .is_filmed()
        .then(|| anyhow::Ok(View::new(&prepare(&proof.scene.input)?, &proof, Vec::new())?))
        .transpose()?;
    seen.iter_mut().for_each(|view| session.pictures().set(view));
    if let Some(view) = &seen {
        session.pictures().write(view)?;
    }
    if let (Some(report), Some(view)) = (session.report(), &seen) {
        let words = text::packing(&file, report::EVERYTHING, report::layout(layout));
        let command = format!("voussoir repose {}", quoted(&args.common.scene.to_string_lossy()));
        let origin = report::origin(&args.common.scene, session.text(), command);
        let model = prepare(&proof.scene.input)?;
        let record = Record::new(&proof, &model, view, session.pictures().aspect(), &origin);
        let charts = tell::attempts(&proof);
        report.write(&page::filed(&words, view, charts.as_slice(), &record)?)?;
    }
    if args.common.json {
        terminal::print(&json::pretty(&file)?)?;
    } else if !session.is_printed() {
        let options = TextOptions { verbose: args.common.verbose, brief: args.common.quiet };
        terminal.page(&text::packing(&file, options, layout))?;
    }
    let known = file.directions.iter().all(|d| d.governing().is_finite());
    Ok(match file.directions.iter().any(PackingDirection::falls) {
        true => Exit::No,
        false if known => Exit::Yes,
        false => Exit::Undecided,
    })
}

/// Forces of the packing when level, and whose they are: those that the weights produce where dry
/// friction was computed, else some that balance.
fn level(session: &Session, model: &Model) -> anyhow::Result<(Forces, &'static str)> {
    let question = AssessOptions { law: session.law() }.into();
    let answer =
        ask(&question, &session.scene, model, &session.control()).map_err(|e| session.refuse(e))?;
    let Answer::Assess(a) = answer else { bail!("there is no verdict") };
    Ok(match (&a.state, a.verdict) {
        (Some(state), _) => (
            state.forces.clone(),
            "those that the weights produce with dry friction (computed, not proved)",
        ),
        (None, Verdict::Stable | Verdict::Conditional) => (
            a.forces.clone(),
            "one of many systems that balance: others have another coordination and mobilisation",
        ),
        (None, _) => (Forces::new(), ""),
    })
}
