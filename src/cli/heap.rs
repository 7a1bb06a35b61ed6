//! `voussoir repose --question repose`: heaps that flow and come to rest.

use super::{
    args::Repose, claim, exit::Exit, output::Sink, pictures::Pictures, report, terminal,
    terminal::Terminal,
};
use anyhow::{Context, bail};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::ops::ControlFlow;
use voussoir::{
    analysis::{
        Control, Law, Tilted,
        repose::{Growing, Heap, Margin, grown, judge, margin, profile},
    },
    deadline::Deadline,
    dynamics::granular::Flow,
    error::FindingCode,
    import::{ImportOptions, import_files},
    interface::prepare,
    keep::Kept,
    limits,
    number::count,
    parallel,
    proof::saved,
    report::{
        drawing,
        grains::{self, GrainFormat},
        heaps::{HeapResult, MarginResult, ReposeFile},
        json, page,
        record::Record,
        tell,
        text::{self, TextOptions},
        view::View,
    },
    scene::{self, BlockSpec, Protocol, Sizes},
};

/// What is written of one heap.
struct Outputs {
    scene: Option<Sink>,
    list: Option<Sink>,
}

/// What `--keep` keeps.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Piece {
    /// A heap at rest.
    Heap(Box<Heap>),
    /// The static margin of the heap of a seed, solved in full or not.
    Margin { seed: u64, keep_all: bool, margin: MarginResult },
}

pub fn run(args: &Repose, terminal: &Terminal) -> anyhow::Result<Exit> {
    let protocol = protocol(args)?;
    let own = args.start.as_deref().map(start).transpose()?;
    if let Some(why) = judge::foretold(&protocol) {
        terminal::say(&format!("note: {why}"));
    }
    args.keep.as_deref().map_or(Ok(()), claim::written)?;
    let save = args.common.save.as_deref().map(|p| Sink::open(Some(p))).transpose()?;
    if args.csv.is_some() {
        bail!(
            "--csv cannot be combined with --question repose: it writes the contact forces of a packing as it lies\nhint: write the heaps with --heaps, then ask `voussoir repose` about one of them"
        );
    }
    let format = GrainFormat::of(args.grains.as_deref());
    let pictures = Pictures::open(&args.pictures, None)?;
    pictures.are_drawn(args.common.report.is_some())?;
    let report = args.common.report.as_deref().map(|p| Sink::open(Some(p))).transpose()?;
    // The seed goes before the ending.
    let seeded = |p: &std::path::Path, k: u64, ending: &str| {
        Sink::open(Some(&p.with_extension(format!("{}.{ending}", args.seed + k))))
    };
    let outputs: Vec<Outputs> = (0..u64::from(args.seeds))
        .map(|k| {
            let scene = args.heaps.as_ref().map(|p| seeded(p, k, "json")).transpose()?;
            let list = args.grains.as_ref().map(|p| seeded(p, k, format.ending())).transpose()?;
            Ok(Outputs { scene, list })
        })
        .collect::<anyhow::Result<_>>()?;
    let made = json!({ "protocol": protocol, "start": own });
    let kept = args.keep.as_deref().map(|path| kept(path, made, args)).transpose()?;
    let there = || kept.iter().flat_map(|k| &k.there);
    let keep = |piece: &Piece| kept.as_ref().map_or(Ok(()), |k| k.append(piece));
    let target =
        if args.common.quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
    let bar = ProgressBar::with_draw_target(None, target);
    if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}") {
        bar.set_style(style);
    }
    let deadline = args.common.time_limit.map_or(Deadline::NEVER, Deadline::within);
    // Cut off by the time limit, a heap or a margin is an answer, but not the one that the next run
    // wants.
    let in_time = || !deadline.is_over();
    let threads = terminal::threads(args.threads);
    let inside = parallel::inside(threads, outputs.len());
    let one = |(k, outputs): &(usize, Outputs)| -> anyhow::Result<(HeapResult, Option<View>)> {
        let seed = args.seed + *k as u64;
        let control = Control {
            law: Law::Associative,
            keep_all: args.common.keep_all,
            deadline,
            ..Control::default()
        };
        let old = there().find_map(|p| match p {
            Piece::Heap(heap) if heap.seed == seed => Some(&**heap),
            _ => None,
        });
        let heap = if let Some(heap) = old {
            let mut heap = heap.clone();
            heap.measure(&protocol)?;
            heap
        } else {
            let mut watch = |flow: &Flow| {
                bar.set_message(format!(
                    "seed {seed}, stage {}: {:.0} √(d/g), {:.1e} m g d per grain",
                    flow.stage + 1,
                    flow.time,
                    flow.energy
                ));
                bar.tick();
                if in_time() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            };
            let statics = (!args.skip_margin).then_some(&control);
            let growing = Growing { own: own.as_deref(), statics, threads: inside };
            let heap = grown(&protocol, seed, &growing, &mut watch)?;
            if kept.is_some() && in_time() {
                keep(&Piece::Heap(Box::new(heap.clone())))?;
            }
            heap
        };
        // Written at once: what follows may take long.
        if let Some(output) = &outputs.scene {
            output.write(&json::text(&heap.scene.to_value()?))?;
        }
        if let Some(output) = &outputs.list {
            output.write(&grains::written(&heap.scene, format)?)?;
        }
        // Page and pictures show the first heap.
        let shown = *k == 0 && (report.is_some() || pictures.wanted());
        let wanted = heap.rested && !args.skip_margin && protocol.kind.leaves_a_slope();
        let known = there().find_map(|p| match p {
            Piece::Margin { seed: of, keep_all, margin }
                if (*of, *keep_all) == (seed, args.common.keep_all) =>
            {
                Some(margin)
            }
            _ => None,
        });
        let fresh =
            (wanted && (shown || known.is_none())).then(|| margin(&heap, &control)).transpose()?;
        let result =
            known.filter(|_| wanted).cloned().or_else(|| fresh.as_ref().map(MarginResult::from));
        if let (Some(margin), None, true) = (&result, known, in_time()) {
            keep(&Piece::Margin { seed, keep_all: args.common.keep_all, margin: margin.clone() })?;
        }
        let mut view = shown.then(|| picture(&heap, fresh.as_ref())).transpose()?;
        if let Some(view) = &mut view {
            let assembly = prepare(&heap.scene)?.assembly;
            view.slope = heap.slope.and_then(|_| profile(&protocol, &assembly)).map(Into::into);
            pictures.set(view);
        }
        Ok((HeapResult::new(&heap, result), view))
    };
    let outputs: Vec<(usize, Outputs)> = outputs.into_iter().enumerate().collect();
    let heaps =
        parallel::try_map(threads, &outputs, one).context("the threads cannot be started")??;
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
        let drawing = drawing::printed(view, pictures.aspect());
        let record = Record::of_heaps(&file, drawing, report::now());
        report.write(&page::filed(&words, view, tell::heaps(&file).as_slice(), &record)?)?;
    }
    if args.common.json {
        terminal::print(&text)?;
    } else if !(report::is_printed(&args.common.report) || pictures.printed()) {
        let options = TextOptions { verbose: args.common.verbose, brief: args.common.quiet };
        terminal.page(&text::heaps(&file, options, layout))?;
    }
    Ok(if file.is_answered() { Exit::Yes } else { Exit::Undecided })
}

/// The file of `--keep`, and a word about what is in it.
fn kept(path: &std::path::Path, made: Value, args: &Repose) -> anyhow::Result<Kept<Piece>> {
    let kept = Kept::open(path, "voussoir-heaps/1", made)?;
    let seeds = args.seed..args.seed + u64::from(args.seeds);
    let count = kept
        .there
        .iter()
        .filter(|p| matches!(p, Piece::Heap(h) if seeds.contains(&h.seed)))
        .count();
    if count > 0 && !args.common.quiet {
        terminal::say(&format!(
            "note: {} already holds {count} of {} heaps",
            path.display(),
            args.seeds
        ));
    }
    Ok(kept)
}

/// A heap at rest, with the forces and the mechanism of its static margin where that was asked for.
fn picture(heap: &Heap, margin: Option<&Margin>) -> anyhow::Result<View> {
    let tilted = margin.map(|m| (m, Tilted { directions: vec![m.tilt.clone()], level: None }));
    let proof = tilted
        .map(|(m, tilted)| saved::tilt(&m.scene, &m.tilt.model, &tilted).map(|file| (m, file)))
        .transpose()?;
    let mut view = match proof {
        Some((margin, file)) => View::new(&prepare(&margin.scene)?, &file, Vec::new())?,
        None => View::bare(&prepare(&heap.scene)?),
    };
    let tipped =
        if view.caption.is_empty() { String::new() } else { format!(", {}", view.caption) };
    view.caption = format!("the grains of seed {}{tipped}", heap.seed);
    Ok(view)
}

/// The protocol by its name, with the values that were changed.
fn protocol(args: &Repose) -> anyhow::Result<Protocol> {
    let name = args.common.scene.to_string_lossy();
    let mut value = serde_json::to_value(Protocol::default())?;
    value["kind"] = Value::from(name.as_ref());
    for (key, text) in &args.set {
        match key.as_str() {
            "rolling_friction" => {
                let share: f64 = text.parse().with_context(|| format!("{key}: not a number"))?;
                value["rolling_arm"] = Value::from(0.5 * share);
                continue;
            }
            // A grading curve from a file, whose median is the unit of length.
            "sizes" if text.parse::<f64>().is_err() && !text.starts_with('[') => {
                if args.set.iter().any(|(key, _)| key == "diameter") {
                    bail!("sizes: {text} gives diameters in m; remove diameter=…");
                }
                let path = std::path::Path::new(text);
                claim::read(path)?;
                let bytes = limits::read_file(path, limits::PER_BYTE)?;
                let sizes = Sizes::read(text, &String::from_utf8_lossy(&bytes))?;
                value["diameter"] = sizes.median().into();
                value["sizes"] = serde_json::to_value(sizes)?;
                continue;
            }
            _ => {}
        }
        let Some(place) = value.get_mut(key).filter(|_| key != "kind") else {
            bail!(
                "{key}: not a value of a protocol; the values are grain, elongation, corners, grains, diameter, sizes, friction, wall_friction, rolling_arm, rolling_friction, restitution, density, size, rate, pressure, stiffness, drop, floor"
            );
        };
        let number = place.is_number() && key != "rate";
        if number && text.parse::<f64>().is_ok_and(|v| !v.is_finite()) {
            bail!("{key}: {text} is not a finite number; friction of 1 is rough already");
        }
        *place = serde_json::from_str(text).unwrap_or_else(|_| Value::from(text.as_str()));
    }
    let protocol: Protocol = serde_json::from_value(value).with_context(|| {
        format!("`{name}` with these values is not a protocol; protocols are drain, funnel, cylinder, tilt, drum, hopper, shear and cell, with grain=sphere, clump or hull")
    })?;
    // What is kept and reported is the box that was used.
    Ok(protocol.sized())
}

/// The grains of --start: the free blocks of a scene, or what `voussoir import` reads.
fn start(path: &std::path::Path) -> anyhow::Result<Vec<BlockSpec>> {
    claim::read(path)?;
    let is_scene = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("json"));
    let scene = if is_scene {
        scene::read_file(path)?.0
    } else {
        let mut imported = import_files(&[path], &ImportOptions::default())?;
        // Supports and friction are the protocol's.
        imported.findings.retain(|f| f.code != FindingCode::Missing);
        terminal::notes(&imported.findings);
        imported.scene
    };
    let (held, free): (Vec<_>, Vec<_>) = scene.blocks.into_iter().partition(|b| b.support);
    if !held.is_empty() {
        let name = path.display();
        terminal::say(&format!(
            "note: {name}: {} not used; the protocol has its own supports",
            count(held.len(), "support")
        ));
    }
    Ok(free)
}
