//! `voussoir study`

use super::{
    args::Study, claim, exit::Exit, output::Sink, report as pages, terminal, terminal::Terminal,
};
use anyhow::{Context, bail};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::{io::IsTerminal, path::Path};
use voussoir::{
    report::{json, page, study as report},
    study::{self, Known, cross, elastic, extreme, forge, rocking, soak},
};

pub fn run(args: &Study, terminal: &Terminal) -> anyhow::Result<Exit> {
    args.keep.as_deref().map_or(Ok(()), claim::written)?;
    let csv = args.csv.as_deref().map(|p| Sink::open(Some(p))).transpose()?;
    let sink = args.report.as_deref().map(|p| Sink::open(Some(p))).transpose()?;
    let printed = pages::is_printed(&args.report);
    if let Some(folder) = &args.svg
        && !folder.is_dir()
    {
        bail!("{}: there is no such folder", folder.display());
    }
    let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
    if args.quiet || !std::io::stderr().is_terminal() {
        bar.set_draw_target(ProgressDrawTarget::hidden());
    }
    if let Ok(style) = ProgressStyle::with_template("{wide_bar} {pos} of {len}, {eta} left") {
        bar.set_style(style);
    }
    let layout = terminal.layout(Path::new("study"));
    let wide = pages::layout(layout);
    if let Some(folder) = &args.dump
        && !folder.is_dir()
    {
        bail!("{}: there is no such folder", folder.display());
    }
    let random = args.soak.or(args.cross).or(args.forge);
    if args.keep.is_some() && random.is_none() && !args.extreme {
        bail!(
            "--keep goes with --soak, --cross, --forge and --extreme: the other studies compare times, which belong to one run"
        );
    }
    if args.extreme {
        let cells = extreme::grid();
        let kept = args.keep.as_deref().map(|path| extreme::keep(path, &cells)).transpose()?;
        let there = kept.as_ref().map_or(0, |k| k.there.len());
        taken_up(args, there, cells.len());
        bar.set_length((cells.len() - there.min(cells.len())) as u64);
        let found = extreme::run(&cells, kept.as_ref(), |_| bar.inc(1))?;
        bar.finish_and_clear();
        if let Some(csv) = csv {
            csv.write(&report::extreme_csv(&found)?)?;
        }
        if let Some(sink) = &sink {
            sink.write(&page::extreme(&report::extreme_text(&found, true, wide), &found)?)?;
        }
        if args.json {
            terminal::print(&json::pretty(&found)?)?;
        } else if !printed {
            terminal.page(&report::extreme_text(&found, args.verbose, layout))?;
        }
        return Ok(if extreme::count(&found, None).wrong == 0 { Exit::Yes } else { Exit::No });
    }
    if let Some(index) = args.only {
        let index = index as usize;
        let scene = if args.soak.is_some() {
            soak::scene(args.seed, index)?.0
        } else {
            cross::scene(args.seed, index)?.0
        };
        terminal::print(&json::text(&scene.to_value()?))?;
        return Ok(Exit::Yes);
    }
    if let Some(count) = args.cross {
        let kept = args.keep.as_deref().map(|path| cross::keep(path, args.seed)).transpose()?;
        let there = kept
            .as_ref()
            .map_or(0, |k| k.there.iter().filter(|s| s.index < count as usize).count());
        taken_up(args, there, count as usize);
        bar.set_length(u64::from(count) - there as u64);
        let list = cross::run(args.seed, count as usize, kept.as_ref(), |_| bar.inc(1))?;
        bar.finish_and_clear();
        if let Some(folder) = &args.dump {
            for (name, scene) in cross::scenes(args.seed, &list) {
                Sink::open(Some(&folder.join(name)))?.write(&json::text(&scene.to_value()?))?;
            }
        }
        if let Some(csv) = csv {
            csv.write(&report::cross_csv(&list)?)?;
        }
        if args.json {
            terminal::print(&json::pretty(&list)?)?;
        } else {
            terminal.page(&report::cross_text(&list, args.seed, args.verbose, layout))?;
        }
        return Ok(if list.iter().any(cross::Crossed::is_wrong) { Exit::No } else { Exit::Yes });
    }
    if let Some(count) = args.forge {
        let kept = args.keep.as_deref().map(|path| forge::keep(path, args.seed)).transpose()?;
        let there = kept
            .as_ref()
            .map_or(0, |k| k.there.iter().filter(|s| s.index < count as usize).count());
        taken_up(args, there, count as usize);
        bar.set_length(u64::from(count) - there as u64);
        let list = forge::run(args.seed, count as usize, kept.as_ref(), |_| bar.inc(1))?;
        bar.finish_and_clear();
        if let Some(folder) = &args.dump {
            for (name, file) in forge::files(args.seed, &list) {
                Sink::open(Some(&folder.join(name)))?.write(&json::pretty(&file)?)?;
            }
        }
        if let Some(csv) = csv {
            csv.write(&report::forge_csv(&list)?)?;
        }
        if args.json {
            terminal::print(&json::pretty(&list)?)?;
        } else {
            terminal.page(&report::forge_text(&list, args.seed, args.verbose, layout))?;
        }
        return Ok(if list.iter().any(forge::Forged::is_wrong) { Exit::No } else { Exit::Yes });
    }
    if let Some(count) = args.soak {
        let kept = args.keep.as_deref().map(|path| soak::keep(path, args.seed)).transpose()?;
        let there = kept
            .as_ref()
            .map_or(0, |k| k.there.iter().filter(|s| s.index < count as usize).count());
        taken_up(args, there, count as usize);
        bar.set_length(u64::from(count) - there as u64);
        let list = soak::run(args.seed, count as usize, kept.as_ref(), |_| bar.inc(1))?;
        bar.finish_and_clear();
        if let Some(csv) = csv {
            csv.write(&report::soak_csv(&list)?)?;
        }
        if args.json {
            terminal::print(&json::pretty(&list)?)?;
        } else {
            terminal.page(&report::soak_text(&list, args.seed, args.verbose, layout))?;
        }
        return Ok(if list.iter().any(soak::Soaked::is_wrong) { Exit::No } else { Exit::Yes });
    }
    if args.rocking {
        let cases = rocking::cases();
        bar.set_length(rocking::count(&cases) as u64);
        let points = rocking::rocking(&cases, |_| bar.inc(1))?;
        bar.finish_and_clear();
        if let Some(csv) = csv {
            csv.write(&report::rocking_csv(&points)?)?;
        }
        if let Some(folder) = &args.svg {
            Sink::open(Some(&folder.join("rocking.svg")))?
                .write(&report::rocking_chart(&points)?)?;
        }
        if args.json {
            terminal::print(&json::pretty(&points)?)?;
        } else {
            terminal.page(&report::rocking_text(&points, layout))?;
        }
        return Ok(Exit::Yes);
    }
    if args.yielding {
        let cases = elastic::elastic_cases()?;
        bar.set_length(elastic::elastic_count(&cases) as u64);
        let points = elastic::elastic(&cases, |_| bar.inc(1))?;
        bar.finish_and_clear();
        if let Some(csv) = csv {
            csv.write(&report::elastic_csv(&points)?)?;
        }
        if let Some(folder) = &args.svg {
            Sink::open(Some(&folder.join("yielding.svg")))?
                .write(&report::elastic_chart(&points)?)?;
        }
        if args.json {
            terminal::print(&json::pretty(&points)?)?;
        } else {
            terminal.page(&report::elastic_text(&points, layout))?;
        }
        return Ok(Exit::Yes);
    }
    let scenes = chosen(&args.scenes)?;
    if args.omissions {
        bar.set_length(2 * scenes.len() as u64);
        let list = study::omissions(&scenes, args.repeat.map_or(3, usize::from), || bar.inc(1))?;
        bar.finish_and_clear();
        if let Some(sink) = &sink {
            sink.write(&page::omissions(&report::omissions_text(&list, wide), &list)?)?;
        }
        if args.json {
            terminal::print(&json::pretty(&list)?)?;
        } else if !printed {
            terminal.page(&report::omissions_text(&list, layout))?;
        }
        return Ok(Exit::Yes);
    }
    bar.set_length(study::count(&scenes, args.quick)? as u64);
    let repeat = args.repeat.map_or(if args.quick { 1 } else { 3 }, usize::from);
    let points = study::run(&scenes, args.quick, repeat, |_| bar.inc(1))?;
    bar.finish_and_clear();
    if let Some(csv) = csv {
        csv.write(&report::csv(&points)?)?;
    }
    if let Some(folder) = &args.svg {
        for known in &scenes {
            Sink::open(Some(&folder.join(format!("{}.svg", known.name))))?
                .write(&report::errors(known.name, &points)?)?;
        }
        Sink::open(Some(&folder.join("profile.svg")))?
            .write(&report::profiles(&points, report::ANSWER)?)?;
    }
    if let Some(sink) = &sink {
        sink.write(&page::study(&report::text(&points, wide), &points)?)?;
    }
    if args.json {
        terminal::print(&json::pretty(&points)?)?;
    } else if !printed {
        terminal.page(&report::text(&points, layout))?;
    }
    Ok(Exit::Yes)
}

/// Says how much of the work the file of `--keep` holds already.
fn taken_up(args: &Study, there: usize, count: usize) {
    if let (Some(path), true) = (&args.keep, there > 0 && !args.quiet) {
        terminal::say(&format!("note: {} holds {there} of {count} scenes already", path.display()));
    }
}

/// The scenes by name; all of them where none is named.
fn chosen(names: &[String]) -> anyhow::Result<Vec<Known>> {
    let all = study::known();
    if names.is_empty() {
        return Ok(all);
    }
    let known = all.iter().map(|k| k.name).collect::<Vec<_>>().join(", ");
    names
        .iter()
        .map(|name| {
            all.iter()
                .find(|k| k.name == name)
                .cloned()
                .with_context(|| format!("there is no scene {name:?} to study; there are {known}"))
        })
        .collect()
}
