//! Charts as data, and the one way to draw them: in files, and in pages, which add values where one
//! points.

mod svg;
mod ticks;

pub use svg::{Drawn, drawn, svg};

use super::ReportError;

/// A chart.
#[derive(Clone, Debug, Default)]
pub struct Chart {
    /// Its title.
    pub title: String,
    /// Along.
    pub x: Axis,
    /// Up.
    pub y: Axis,
    /// What is drawn.
    pub series: Vec<Series>,
    /// Where something happens: upright lines.
    pub events: Vec<f64>,
    /// A sentence below it.
    pub note: String,
    /// Its x is what the film of the page goes along: a cursor shows where that is.
    pub film: bool,
    /// Values shown by colour, for charts of cells: a name for them.
    pub cells: Option<String>,
}

/// An axis.
#[derive(Clone, Debug, Default)]
pub struct Axis {
    /// What is measured, with its unit.
    pub label: String,
    /// Logarithmic.
    pub log: bool,
    /// Words that stand at 0, 1, 2, … in place of numbers.
    pub words: Vec<String>,
}

impl Axis {
    /// An axis.
    pub fn new(label: impl Into<String>, log: bool) -> Self {
        Self { label: label.into(), log, words: Vec::new() }
    }
}

/// Points of one kind.
#[derive(Clone, Debug, Default)]
pub struct Series {
    /// What they are.
    pub name: String,
    /// Joined by a line.
    pub line: bool,
    /// x, y; of cells their middle. A line has a gap where there is no y.
    pub points: Vec<[Option<f64>; 2]>,
    /// What is said where one points; one for each point.
    pub hints: Vec<String>,
    /// Lower and upper end of a band at each point, where there is one; of cells half their width
    /// and height.
    pub band: Vec<[f64; 2]>,
    /// Its colour (red, green, blue), where it is not one of the order; of cells that of all of them.
    pub colour: Option<[u8; 3]>,
    /// Of cells their value.
    pub values: Vec<f64>,
}

impl Series {
    /// Points of a line, each with what is said of it.
    pub fn line(
        name: impl Into<String>,
        points: &[(f64, f64)],
        hint: impl Fn(f64, f64) -> String,
    ) -> Self {
        Self {
            name: name.into(),
            line: true,
            points: points.iter().map(|&(x, y)| [Some(x), Some(y)]).collect(),
            hints: points.iter().map(|&(x, y)| hint(x, y)).collect(),
            ..Self::default()
        }
    }

    /// The same without the line.
    pub fn dots(
        name: impl Into<String>,
        points: &[(f64, f64)],
        hint: impl Fn(f64, f64) -> String,
    ) -> Self {
        Self { line: false, ..Self::line(name, points, hint) }
    }

    /// How many points are drawn.
    pub fn count(&self) -> usize {
        self.points.iter().filter(|p| p[1].is_some()).count()
    }
}

impl Chart {
    /// The chart, where there are two points to draw.
    pub fn of_two(self) -> Option<Self> {
        (self.series.iter().map(Series::count).sum::<usize>() > 1).then_some(self)
    }
}

/// Charts below each other as one SVG document.
///
/// # Errors
/// There is none to draw.
pub fn file(name: &str, charts: &[Chart]) -> Result<String, ReportError> {
    match charts {
        [] => Err(ReportError::new("no chart: there are not two points to draw a line through")),
        _ => Ok(svg(name, charts)),
    }
}
