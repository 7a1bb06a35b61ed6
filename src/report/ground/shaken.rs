//! What all blocks of a scene do on ground that moves: tables and charts of their histories.

use super::rocking;
use crate::{
    ReportError,
    cells::{Cell, Table},
    chart::{Axis, Chart, Series},
};
use analysis::ShakenScene;
use base::number::short;
use check::ground::Motion;
use dynamics::Frame;
use model::interface::Model;

/// So many lines are drawn.
const LINES: usize = 5;

/// A history with all that it is about.
pub struct ShakenReport<'a> {
    /// The scene's name.
    pub name: &'a str,
    /// The scene.
    pub model: &'a Model,
    /// The ground.
    pub motion: &'a Motion,
    /// What the blocks did, with frames.
    pub shaken: &'a ShakenScene,
}

impl ShakenReport<'_> {
    fn id(&self, block: usize) -> &str {
        &self.model.assembly.blocks[block].id
    }

    fn frames(&self) -> &[Frame] {
        &self.shaken.shaken.frames
    }

    /// Free blocks, those that went farthest first.
    fn order(&self) -> Vec<usize> {
        let mut order: Vec<usize> = self.model.assembly.free().collect();
        let far = |i: usize| self.shaken.shaken.blocks[i].greatest;
        order.sort_by(|&a, &b| far(b).total_cmp(&far(a)));
        order
    }

    fn over_thickness(&self, frame: &Frame, block: usize) -> f64 {
        let way = frame.blocks[block].center - self.model.assembly.blocks[block].centroid;
        way.norm() / self.shaken.shaken.blocks[block].thickness
    }

    fn end(&self) -> f64 {
        self.frames().last().map_or(0.0, |f| f.time)
    }

    /// A row a frame: time (s), the ground along its three axes (m/s²), and the way of every free
    /// block over its thickness.
    ///
    /// # Errors
    /// Only if memory runs out.
    pub fn csv(&self) -> Result<String, ReportError> {
        let free: Vec<usize> = self.model.assembly.free().collect();
        let mut table = Table::new();
        let head = ["time", "ground_toward", "ground_left", "ground_up"].map(String::from);
        let ids = free.iter().map(|&i| self.id(i).to_string());
        table.write_record(head.into_iter().chain(ids))?;
        for frame in self.frames() {
            let ground = self.motion.at(frame.time);
            let mut row = vec![frame.time, ground.x, ground.y, ground.z];
            row.extend(free.iter().map(|&i| self.over_thickness(frame, i)));
            table.write_record(row.into_iter().map(Cell::from))?;
        }
        Ok(table.end()?)
    }

    /// Way over thickness against time of the blocks that went farthest.
    fn lines(&self) -> Vec<(&str, Vec<(f64, f64)>)> {
        let line = |i: usize| {
            let points = self.frames().iter().map(|f| (f.time, self.over_thickness(f, i)));
            (self.id(i), points.collect())
        };
        self.order().into_iter().take(LINES).map(line).collect()
    }

    /// Way over thickness of the blocks that went farthest, and the ground below; none where no frames
    /// were kept.
    pub fn charts(&self) -> Vec<Chart> {
        let lines = self.lines();
        if lines.iter().all(|l| l.1.len() < 2) {
            return Vec::new();
        }
        let line = |(id, points): &(&str, Vec<(f64, f64)>)| {
            Series::line(*id, points, |x, y| format!("{id}: {} at {} s", short(y), short(x)))
        };
        let ways = Chart {
            title: "Displacements of the blocks that moved farthest".into(),
            x: Axis::new("time, s", false),
            y: Axis::new("displacement / thickness", false),
            series: lines.iter().map(line).collect(),
            film: true,
            ..Chart::default()
        };
        vec![ways, rocking::ground_chart(self.motion, self.end())]
    }
}
