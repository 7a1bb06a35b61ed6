//! What a mechanism does on ground that moves, as tables and charts.

use crate::{
    ReportError,
    cells::{Cell, Table},
    chart::{Axis, Chart, Series},
};
use analysis::follow::machine::Built;
use base::number::short;
use check::{
    ground::Motion,
    rocking::{History, Sample},
};

/// A history with all that it is about.
pub struct Rocked<'a> {
    /// The scene's name.
    pub name: &'a str,
    /// The machine.
    pub built: &'a Built,
    /// The motion of the ground.
    pub motion: &'a Motion,
    /// What it did.
    pub history: &'a History,
}

impl Rocked<'_> {
    /// Way of the control point, m.
    fn way(&self, s: &Sample) -> f64 {
        let sense = self.built.machine.senses[usize::from(s.q < 0.0)].as_ref();
        let moved = sense.filter(|_| s.q != 0.0);
        moved.map_or(0.0, |sense| sense.law.at(s.q.abs()).way)
    }

    /// The history, a row a step: time (s), turn (rad), its rate (1/s), way of the control point (m)
    /// and over its thickness, acceleration of the ground along the direction (m/s²).
    ///
    /// # Errors
    /// Only if memory runs out.
    pub fn csv(&self) -> Result<String, ReportError> {
        let mut table = Table::new();
        table.write_record(
            ["time", "turn", "rate", "way", "over_thickness", "ground"].map(Cell::from),
        )?;
        for s in &self.history.samples {
            let way = self.way(s);
            let ground = self.motion.at(s.time).x;
            let row = [s.time, s.q, s.rate, way, way / self.built.thickness, ground];
            table.write_record(row.map(Cell::from))?;
        }
        Ok(table.end()?)
    }

    /// Way over thickness against time, and the ground below it.
    pub fn charts(&self) -> Vec<Chart> {
        let at = |s: &Sample| (s.time, self.way(s) / self.built.thickness);
        let own: Vec<(f64, f64)> = self.history.samples.iter().map(at).collect();
        let end = own.last().map_or(0.0, |p| p.0);
        let ways = Chart {
            title: "Displacement of the control point".into(),
            x: Axis::new("time, s", false),
            y: Axis::new("displacement / thickness", false),
            series: vec![Series::line("control point", &own, |x, y| {
                format!("{} at {} s", short(y), short(x))
            })],
            ..Chart::default()
        };
        let both = |ways| vec![ways, ground_chart(self.motion, end)];
        ways.of_two().filter(|_| end > 0.0).map_or_else(Vec::new, both)
    }
}

/// The ground up to this time; it goes with the film.
pub(super) fn ground_chart(motion: &Motion, end: f64) -> Chart {
    let hint = |x: f64, y: f64| format!("ground: {} m/s² at {} s", short(y), short(x));
    Chart {
        title: "Ground motion".into(),
        x: Axis::new("time, s", false),
        y: Axis::new("acceleration, m/s²", false),
        series: vec![Series::line("ground", &ground(motion, end), hint)],
        film: true,
        ..Chart::default()
    }
}

/// The acceleration of the ground along the direction, for a chart up to this time.
fn ground(motion: &Motion, end: f64) -> Vec<(f64, f64)> {
    const FINE: usize = 24;
    let mut line = vec![(0.0, 0.0)];
    for p in motion.pieces.iter().filter(|p| p.start < end) {
        let steps = if motion.pieces.len() > 100 { 1 } else { FINE };
        line.extend((0..=steps).map(|k| {
            let t = (p.end - p.start) * k as f64 / steps as f64;
            (p.start + t, p.at(t).x)
        }));
    }
    let last = line.last().map_or(0.0, |p| p.0);
    line.push((last, 0.0));
    line.push((end.max(last), 0.0));
    line
}
