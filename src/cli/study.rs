//! `voussoir study`

use super::{
    args::Study, claim, exit::Exit, output::Sink, report as pages, terminal, terminal::Terminal,
};
use anyhow::{Context, bail};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde::Serialize;
use std::{io::IsTerminal, path::Path};
use voussoir::{
    report::{
        chart::{self, Chart},
        json, page, study as report,
        text::{Layout, Page},
    },
    study::{self, Known, elastic, experiments, extreme, rocking},
};

pub fn run(args: &Study, terminal: &Terminal) -> anyhow::Result<Exit> {
    args.keep.as_deref().map_or(Ok(()), claim::written)?;
    let out = Outputs::open(args, terminal)?;
    if args.keep.is_some() && !args.extreme {
        bail!(
            "--keep requires --extreme: the other studies compare times, which must come from one run"
        );
    }
    match args {
        Study { extreme: true, .. } => grid(&out),
        Study { rocking: true, .. } => {
            let cases = rocking::cases();
            out.bar.set_length(rocking::count(&cases) as u64);
            let points = rocking::rocking(&cases, |_| out.bar.inc(1))?;
            let chart = || vec![("rocking".to_string(), report::rocking_chart(&points))];
            out.tell(
                &points,
                || report::rocking_csv(&points),
                chart,
                || report::rocking_text(&points, out.layout),
            )
        }
        Study { yielding: true, .. } => {
            let cases = elastic::elastic_cases()?;
            out.bar.set_length(elastic::elastic_count(&cases) as u64);
            let points = elastic::elastic(&cases, |_| out.bar.inc(1))?;
            let chart = || vec![("yielding".to_string(), report::elastic_chart(&points))];
            out.tell(
                &points,
                || report::elastic_csv(&points),
                chart,
                || report::elastic_text(&points, out.layout),
            )
        }
        Study { experiments: Some(corpus), .. } => held_against(&out, corpus),
        Study { omissions: true, .. } => omissions(&out),
        _ => methods(&out),
    }
}

/// Where a study goes; opened before the work.
struct Outputs<'a> {
    args: &'a Study,
    terminal: &'a Terminal,
    csv: Option<Sink>,
    page: Option<Sink>,
    bar: ProgressBar,
    layout: Layout<'a>,
}

impl<'a> Outputs<'a> {
    fn open(args: &'a Study, terminal: &'a Terminal) -> anyhow::Result<Self> {
        let csv = args.csv.as_deref().map(|p| Sink::open(Some(p))).transpose()?;
        let page = args.report.as_deref().map(|p| Sink::open(Some(p))).transpose()?;
        if let Some(folder) = &args.svg {
            std::fs::create_dir_all(folder)
                .with_context(|| format!("{}: cannot be written", folder.display()))?;
        }
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
        if args.quiet || !std::io::stderr().is_terminal() {
            bar.set_draw_target(ProgressDrawTarget::hidden());
        }
        if let Ok(style) = ProgressStyle::with_template("{wide_bar} {pos} of {len}, {eta} left") {
            bar.set_style(style);
        }
        let layout = terminal.layout(Path::new("study"));
        Ok(Self { args, terminal, csv, page, bar, layout })
    }

    /// Writes what a page shows of it, where one is wanted.
    fn page(&self, page: impl FnOnce() -> Result<String, serde_json::Error>) -> anyhow::Result<()> {
        self.page.as_ref().map_or(Ok(()), |sink| sink.write(&page()?))
    }

    /// Writes its table and its charts, each under its name, and prints it.
    fn tell<T: Serialize, E: std::error::Error + Send + Sync + 'static>(
        &self,
        list: &T,
        csv: impl FnOnce() -> Result<String, E>,
        charts: impl FnOnce() -> Vec<(String, Chart)>,
        text: impl FnOnce() -> Page,
    ) -> anyhow::Result<Exit> {
        self.bar.finish_and_clear();
        if let Some(sink) = &self.csv {
            sink.write(&csv()?)?;
        }
        if let Some(folder) = &self.args.svg {
            for (name, own) in charts() {
                let sink = Sink::open(Some(&folder.join(format!("{name}.svg"))))?;
                sink.write(&chart::file("", &[own])?)?;
            }
        }
        if self.args.json {
            terminal::print(&json::pretty(list)?)?;
        } else if !pages::is_printed(&self.args.report) {
            self.terminal.page(&text())?;
        }
        Ok(Exit::Yes)
    }
}

/// Predictions against tests of laboratories.
fn held_against(out: &Outputs, corpus: &Path) -> anyhow::Result<Exit> {
    let groups = experiments::groups(corpus, &out.args.scenes)?;
    out.bar.set_length(experiments::count(&groups) as u64);
    let list = experiments::compare(&groups, || out.bar.inc(1))?;
    let text = |layout| report::experiments_text(&groups, &list, layout);
    let chart = || report::experiments_chart(&list);
    out.page(|| page::experiments(&text(pages::layout(out.layout)), chart(), &list))?;
    let charts = || vec![("experiments".to_string(), chart())];
    out.tell(&list, || report::experiments_csv(&list), charts, || text(out.layout))
}

/// The stiff and extreme grid.
fn grid(out: &Outputs) -> anyhow::Result<Exit> {
    let cells = extreme::grid();
    let kept = out.args.keep.as_deref().map(|path| extreme::keep(path, &cells)).transpose()?;
    let there = kept.as_ref().map_or(0, |k| k.there.len());
    taken_up(out.args, there, cells.len());
    out.bar.set_length((cells.len() - there.min(cells.len())) as u64);
    let found = extreme::run(&cells, kept.as_ref(), |_| out.bar.inc(1))?;
    let text = |verbose, layout| report::extreme_text(&found, verbose, layout);
    out.page(|| page::extreme(&text(true, pages::layout(out.layout)), &found))?;
    out.tell(
        &found,
        || report::extreme_csv(&found),
        Vec::new,
        || text(out.args.verbose, out.layout),
    )?;
    Ok(if extreme::count(&found, None).wrong == 0 { Exit::Yes } else { Exit::No })
}

/// What leaving things out saves.
fn omissions(out: &Outputs) -> anyhow::Result<Exit> {
    let scenes = chosen(&out.args.scenes)?;
    out.bar.set_length(2 * scenes.len() as u64);
    let repeat = out.args.repeat.map_or(3, usize::from);
    let list = study::omissions(&scenes, repeat, || out.bar.inc(1))?;
    let text = |layout| report::omissions_text(&list, layout);
    out.page(|| page::omissions(&text(pages::layout(out.layout)), &list))?;
    let no_table = || Ok::<_, std::convert::Infallible>(String::new());
    out.tell(&list, no_table, Vec::new, || text(out.layout))
}

/// Every method over its knob.
fn methods(out: &Outputs) -> anyhow::Result<Exit> {
    let args = out.args;
    let scenes = chosen(&args.scenes)?;
    out.bar.set_length(study::count(&scenes, args.quick)? as u64);
    let repeat = args.repeat.map_or(if args.quick { 1 } else { 3 }, usize::from);
    let points = study::run(&scenes, args.quick, repeat, |_| out.bar.inc(1))?;
    out.page(|| page::study(&report::text(&points, pages::layout(out.layout)), &points))?;
    let charts = || {
        let each = scenes.iter().map(|k| (k.name.to_string(), report::errors(k.name, &points)));
        each.chain([("profile".to_string(), report::profiles(&points))]).collect()
    };
    out.tell(&points, || report::csv(&points), charts, || report::text(&points, out.layout))
}

/// Says how much of the work the file of `--keep` holds already.
fn taken_up(args: &Study, there: usize, count: usize) {
    if let (Some(path), true) = (&args.keep, there > 0 && !args.quiet) {
        terminal::say(&format!("note: {} already holds {there} of {count} scenes", path.display()));
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
            all.iter().find(|k| k.name == name).cloned().with_context(|| {
                format!("there is no scene {name:?} to study; the scenes are {known}")
            })
        })
        .collect()
}
