//! `voussoir repose`: how steep may a packing be?

use super::{
    args::{Asked, Repose},
    exit::Exit,
    heap,
    output::Sink,
    question::Question,
    report,
    terminal::{self, Terminal},
};
use anyhow::{Context, bail};
use std::time::Instant;
use voussoir::{
    analysis::{Model, assess, fabric, prepare, stability, stability::held, tilt::directions},
    error::InputError,
    report::{
        contacts, json,
        packing::PackingFile,
        page,
        text::{self, TextOptions},
        view::View,
    },
    verdict::Forces,
};

/// What --question repose takes in place of a scene.
const PROTOCOLS: [&str; 4] = ["drain", "funnel", "cylinder", "tilt"];

pub fn run(args: &Repose, terminal: &Terminal) -> anyhow::Result<Exit> {
    if args.question == Asked::Repose {
        return heap::run(args, terminal);
    }
    if let Some(word) = args.common.scene.to_str().filter(|w| PROTOCOLS.contains(w) && !args.common.scene.exists()) {
        bail!(
            InputError::at(Default::default(), format!("`{word}` is a protocol that makes a heap, and there is no scene of that name"))
                .hint(format!("ask for the slope of heaps with `voussoir repose {word} --question repose`"))
        );
    }
    if let Some((key, _)) = args.set.first() {
        bail!("{key}=…: only the protocols of --question repose take values");
    }
    if args.keep.is_some() || args.heaps.is_some() || args.skip_margin {
        bail!("--keep, --heaps and --skip-margin are about heaps in time: they go with --question repose");
    }
    let csv = args.csv.as_deref().map(|p| Sink::open(Some(p))).transpose()?;
    let question = Question::open(&args.common)?.drawn(&args.pictures, None)?;
    let name = question.scene.name.clone();
    let start = Instant::now();
    let (scene, model, loose) = held(&question.scene, question.model.clone()).map_err(|e| question.refuse(e))?;
    let toward = if args.toward.is_empty() {
        directions(model.assembly.gravity, args.all.into())
    } else {
        args.toward.iter().map(|&d| d.into()).collect()
    };
    let mut answers = Vec::with_capacity(toward.len());
    for direction in toward {
        answers.push(stability(&scene, &model, direction, args.moving_mass, &question.control()).map_err(|e| question.refuse(e))?);
    }
    let forces = (args.fabric || csv.is_some()).then(|| level(&question, &model));
    let solve = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let (mut file, proof) = PackingFile::new(&model, &name, args.moving_mass, answers, &loose).context("no direction to tilt towards")?;
    (file.timings.solve, file.timings.check) = (solve, start.elapsed().as_secs_f64());
    if let Some(forces) = &forces {
        file.fabric = args.fabric.then(|| fabric(&model.assembly, &model.interfaces, forces));
        if let Some(csv) = &csv {
            let table = contacts::csv(&model.assembly, &model.interfaces, forces).map_err(|e| anyhow::anyhow!("{e}"))?;
            csv.write(&table)?;
        }
    }
    if let Some(save) = question.save() {
        save.write(&json::pretty(&proof)?)?;
    }
    let layout = terminal.layout(&args.common.scene);
    // The round with the answer: grains that fell earlier are gone.
    let seen = question.is_filmed().then(|| anyhow::Ok(View::new(&prepare(&proof.scene.input)?, &proof, Vec::new())?)).transpose()?;
    if let Some(view) = &seen {
        question.pictures().write(view)?;
    }
    if let (Some(report), Some(view)) = (question.report(), &seen) {
        let words = text::packing(&file, report::EVERYTHING, report::layout(layout));
        report.write(&page::page(&words, view, page::attempts(&proof).as_slice())?)?;
    }
    if args.common.json {
        terminal::print(&json::pretty(&file)?)?;
    } else if !question.is_printed() {
        let options = TextOptions { verbose: args.common.verbose, brief: args.common.quiet };
        terminal.page(&text::packing(&file, options, layout))?;
    }
    let open = !file.directions.iter().all(|d| d.governing().is_finite());
    Ok(if open { Exit::Undecided } else { Exit::Yes })
}

/// Forces of the packing when level: those that the weights produce where dry friction was computed, else some that balance.
fn level(question: &Question, model: &Model) -> Forces {
    let answer = assess(&model.assembly, &model.interfaces, &question.control());
    answer.state.map_or(answer.forces, |s| s.forces)
}
