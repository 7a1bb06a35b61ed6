//! What sweeps show: progress, and the files that are made of their rows.

use super::{
    args::Summary,
    exit::Exit,
    output::Sink,
    report as pages,
    terminal::{self, Terminal},
};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::{
    io::IsTerminal,
    path::{Path, PathBuf},
};
use voussoir::{
    number::count,
    report::{json, page, sweep as report},
    sweep::{self, Header, Row, RowStatus},
};

/// Progress on standard error, where that is a terminal.
pub(super) fn bar(quiet: bool) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
    if quiet || !std::io::stderr().is_terminal() {
        bar.set_draw_target(ProgressDrawTarget::hidden());
    }
    if let Ok(style) =
        ProgressStyle::with_template("{wide_bar} {pos} of {len} rows, {per_sec}, {eta} left{msg}")
    {
        bar.set_style(style);
    }
    bar
}

/// Files that are made of rows, opened before the work.
pub(super) struct Sinks {
    csv: Option<Sink>,
    svg: Option<Sink>,
    report: Option<Sink>,
}

impl Sinks {
    pub(super) fn open(args: &Summary) -> anyhow::Result<Self> {
        let open =
            |path: &Option<PathBuf>| path.as_deref().map(|p| Sink::open(Some(p))).transpose();
        Ok(Self { csv: open(&args.csv)?, svg: open(&args.svg)?, report: open(&args.report)? })
    }

    /// Writes them. The exit code is that of rows without an answer, which are said in any case.
    pub(super) fn write(
        &self,
        args: &Summary,
        header: &Header,
        rows: &[Row],
        terminal: &Terminal,
    ) -> anyhow::Result<Exit> {
        let summary = sweep::summarize(header, rows);
        if let Some(csv) = &self.csv {
            csv.write(&report::csv(header, rows)?)?;
        }
        let layout = terminal.layout(Path::new(&header.plan.scene));
        if let Some(sink) = &self.report {
            let words = report::summary(header, &summary, false, pages::layout(layout));
            sink.write(&page::sweep(&words, header, rows, &summary)?)?;
        }
        if args.json {
            terminal::print(&json::pretty(&report::Document::new(header, &summary))?)?;
        } else if !pages::is_printed(&args.report) {
            terminal.page(&report::summary(header, &summary, args.quiet, layout))?;
        }
        if let Some(svg) = &self.svg {
            let kind =
                args.chart.map_or_else(|| report::Kind::suited(header, &summary), Into::into);
            svg.write(&report::chart(header, rows, &summary, kind)?)?;
        }
        let open = |r: &&Row| matches!(r.answer.status, RowStatus::Error | RowStatus::Undecided);
        let Some(first) = rows.iter().find(open) else { return Ok(Exit::Yes) };
        let why = first.error.as_deref().unwrap_or("undecided");
        terminal::say(&format!(
            "note: {} of {} {} no answer, the first is row {}: {why}",
            summary.open,
            count(rows.len(), "row"),
            if summary.open == 1 { "has" } else { "have" },
            first.row
        ));
        Ok(Exit::Undecided)
    }
}
