//! `voussoir repose --question repose`: heaps that flow and come to rest.

use super::{args::Repose, exit::Exit, output::Sink, pictures::Pictures, report, simulate::threads, terminal, terminal::Terminal};
use anyhow::{Context, bail};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use rayon::prelude::*;
use serde_json::Value;
use std::ops::ControlFlow;
use voussoir::{
    analysis::{
        Control, Law, prepare,
        repose::{Heap, Margin, heap, margin},
    },
    report::{
        Leaning, ResultFile,
        heaps::{HeapResult, ReposeFile},
        json, page,
        text::{self, Options},
        view::View,
    },
    scene::Protocol,
};

pub fn run(args: &Repose, terminal: &Terminal) -> anyhow::Result<Exit> {
    let protocol = protocol(args)?;
    let save = args.common.save.as_deref().map(|p| Sink::open(Some(p))).transpose()?;
    if args.csv.is_some() {
        bail!(
            "--csv writes the contact forces of a packing as it lies: keep the heaps with --heaps, and ask `voussoir repose` about one of them"
        );
    }
    let pictures = Pictures::open(&args.pictures, None)?;
    let report = args.common.report.as_deref().map(|p| Sink::open(Some(p))).transpose()?;
    let outputs: Vec<Option<Sink>> = (0..u64::from(args.seeds))
        .map(|k| {
            let path = |p: &std::path::PathBuf| p.with_extension(format!("{}.json", args.seed + k));
            args.heaps.as_ref().map(|p| Sink::open(Some(&path(p)))).transpose()
        })
        .collect::<anyhow::Result<_>>()?;
    let target = if args.common.quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    let bar = ProgressBar::with_draw_target(None, target);
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}") {
        bar.set_style(style);
    }
    let start = std::time::Instant::now();
    let left = || args.common.time_limit.map_or(f64::INFINITY, |limit| limit - start.elapsed().as_secs_f64());
    let one = |(k, output): (usize, &Option<Sink>)| -> anyhow::Result<(HeapResult, Option<View>)> {
        let seed = args.seed + k as u64;
        let heap = heap(&protocol, seed, &mut |flow| {
            bar.set_message(format!("seed {seed}, stage {}: {:.0} √(d/g), {:.1e} m g d a grain", flow.stage + 1, flow.time, flow.energy));
            bar.tick();
            if left() > 0.0 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        })?;
        // Kept at once: what follows may take long.
        if let Some(output) = output {
            output.write(&json::pretty(&heap.scene)?)?;
        }
        let control = Control { law: Law::Associative, keep_all: args.common.keep_all, seconds: left().max(0.0) };
        let margin = (heap.rested && !args.skip_margin).then(|| margin(&heap, &control)).transpose()?;
        // Page and pictures show the first heap.
        let view = (k == 0 && (report.is_some() || pictures.wanted())).then(|| picture(&heap, margin.as_ref())).transpose()?;
        Ok((HeapResult::new(&heap, margin.as_ref()), view))
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads(args.threads)).build().context("no threads")?;
    let heaps: Vec<(HeapResult, Option<View>)> = pool.install(|| outputs.par_iter().enumerate().map(one).collect::<anyhow::Result<_>>())?;
    bar.finish_and_clear();
    let (heaps, views): (Vec<_>, Vec<_>) = heaps.into_iter().unzip();
    let file = ReposeFile::new(&protocol, heaps);
    let text = json::pretty(&file)?;
    if let Some(save) = save {
        save.write(&text)?;
    }
    let layout = terminal.layout(&args.common.scene);
    if let Some(view) = views.iter().flatten().next() {
        pictures.write(view)?;
    }
    if let (Some(report), Some(view)) = (report, views.iter().flatten().next()) {
        let words = text::heaps(&file, report::EVERYTHING, report::layout(layout));
        report.write(&page::page(&words, view, page::heaps(&file).as_slice())?)?;
    }
    if args.common.json {
        terminal::print(&text)?;
    } else if !(report::is_printed(&args.common.report) || pictures.printed()) {
        let options = Options { verbose: args.common.verbose, brief: args.common.quiet };
        terminal.page(&text::heaps(&file, options, layout))?;
    }
    Ok(if file.at_rest == file.heaps.len() { Exit::Yes } else { Exit::Undecided })
}

/// A heap at rest, with the forces and the mechanism of its static margin where that was asked for.
fn picture(heap: &Heap, margin: Option<&Margin>) -> anyhow::Result<View> {
    let leaning = margin.map(|m| (m, Leaning { model: m.model.clone(), tilt: m.tilt.clone(), dry: None }));
    let proof = leaning.and_then(|(m, leaning)| Some((m, ResultFile::tilt(&m.scene, &[leaning])?)));
    let mut view = match proof {
        Some((margin, file)) => View::new(&prepare(&margin.scene)?, &file, Vec::new())?,
        None => View::bare(&prepare(&heap.scene)?),
    };
    let tipped = if view.caption.is_empty() { String::new() } else { format!(", {}", view.caption) };
    view.caption = format!("the heap of seed {}{tipped}", heap.seed);
    Ok(view)
}

/// The protocol by its name, with the values that were changed.
fn protocol(args: &Repose) -> anyhow::Result<Protocol> {
    let name = args.common.scene.to_string_lossy();
    let mut value = serde_json::to_value(Protocol::default())?;
    value["kind"] = Value::from(name.as_ref());
    for (key, text) in &args.set {
        let Some(place) = value.get_mut(key).filter(|_| key != "kind") else {
            bail!(
                "{key}: no value of a protocol; there are grain, elongation, corners, grains, diameter, sizes, friction, wall_friction, rolling_arm, density, size, rate"
            );
        };
        *place = serde_json::from_str(text).unwrap_or_else(|_| Value::from(text.as_str()));
    }
    serde_json::from_value(value).with_context(|| {
        format!("`{name}` with these values is no protocol: drain, funnel, cylinder or tilt, with grain=sphere, clump or hull")
    })
}
