//! The table and the chart of an answer.

use super::output::Sink;
use std::path::PathBuf;
use voussoir::{
    proof::ResultFile,
    report::{chart, tell},
};

/// Where they go; opened before the work.
pub struct Told {
    csv: Option<Sink>,
    chart: Option<Sink>,
}

impl Told {
    /// Opens what is wanted.
    pub fn open(csv: &Option<PathBuf>, chart: &Option<PathBuf>) -> anyhow::Result<Self> {
        let open =
            |path: &Option<PathBuf>| path.as_deref().map(|p| Sink::open(Some(p))).transpose();
        Ok(Self { csv: open(csv)?, chart: open(chart)? })
    }

    /// Writes what is wanted of a result.
    pub fn write(self, file: &ResultFile) -> anyhow::Result<()> {
        if let Some(csv) = &self.csv {
            csv.write(&tell::csv(file)?)?;
        }
        self.draw(&file.scene.name, || tell::charts(file))
    }

    /// Writes a table and charts that are no result's.
    pub fn write_own(
        self,
        name: &str,
        csv: impl FnOnce() -> Result<String, voussoir::report::ReportError>,
        charts: impl FnOnce() -> Vec<chart::Chart>,
    ) -> anyhow::Result<()> {
        if let Some(sink) = &self.csv {
            sink.write(&csv()?)?;
        }
        self.draw(name, charts)
    }

    fn draw(self, name: &str, charts: impl FnOnce() -> Vec<chart::Chart>) -> anyhow::Result<()> {
        if let Some(sink) = self.chart {
            sink.write(&chart::file(name, &charts())?)?;
        }
        Ok(())
    }

    /// Whether anything is wanted.
    pub fn is_wanted(&self) -> bool {
        self.csv.is_some() || self.chart.is_some()
    }
}
