//! What all blocks of a scene do on ground that moves.

use super::{
    GroundError, Shaking,
    chart::{Panel, chart},
    refused, rocking,
};
use crate::{
    dynamics::{Shaken, ShakenFate, Stop},
    interface::Model,
    number::{fixed, seconds, short},
    report::{
        cells::{Cell, Table},
        text::{Layout, Page, Role, TextOptions},
    },
};
use serde_json::{Value, json};

/// So many blocks are listed.
const FEW: usize = 5;
/// So many lines are drawn.
const LINES: usize = 5;

/// An outcome with all that it is about.
pub struct ShakenReport<'a> {
    /// The scene's name.
    pub name: &'a str,
    /// The scene.
    pub model: &'a Model,
    /// The ground.
    pub shaking: &'a Shaking,
    /// What became of it.
    pub shaken: &'a Shaken,
}

impl ShakenReport<'_> {
    fn id(&self, block: usize) -> &str {
        &self.model.assembly.blocks[block].id
    }

    /// Free blocks, those that went farthest first.
    fn order(&self) -> Vec<usize> {
        let mut order: Vec<usize> = self.model.assembly.free().collect();
        let far = |i: usize| self.shaken.blocks[i].greatest;
        order.sort_by(|&a, &b| far(b).total_cmp(&far(a)));
        order
    }

    fn residual(&self) -> f64 {
        let own = self.model.assembly.free().map(|i| self.shaken.blocks[i].residual);
        own.fold(0.0, f64::max)
    }

    fn title(&self) -> (String, Role) {
        let greatest = self.order().first().map_or(0.0, |&i| self.shaken.blocks[i].greatest);
        match self.shaken.fate {
            ShakenFate::Overturned { block, time } => {
                (format!("{} overturns at {} s", self.id(block), fixed(time, 3)), Role::Bad)
            }
            ShakenFate::Rests => (
                format!(
                    "moves by up to {} of a thickness, {} is left at the end",
                    short(greatest),
                    short(self.residual())
                ),
                Role::Good,
            ),
            ShakenFate::Moves => (
                format!("still moves at the end, by up to {} of a thickness", short(greatest)),
                Role::Unsure,
            ),
        }
    }

    /// The answer for people.
    pub fn text(&self, layout: Layout, options: TextOptions) -> Page {
        let mut page = Page::new(layout);
        let (title, role) = self.title();
        page.title(self.name, title, role);
        if options.brief {
            return page;
        }
        let s = self.shaken;
        page.blank();
        page.paragraph(
            "One history, computed and not proved: in the frame of the ground every block gets minus the acceleration of the ground, its full dead load from the start, at rest. Single histories of rocking hardly repeat; a share over many records says more.",
        );
        page.blank();
        page.row("ground", [self.shaking.words()]);
        let all = self.order();
        let shown = if options.verbose { all.len() } else { FEW };
        page.row(
            "farthest",
            all.iter().take(shown).map(|&i| {
                let b = &s.blocks[i];
                format!(
                    "{}: {} of its thickness of {} m at {} s, {} left; turned by up to {}°",
                    self.id(i),
                    short(b.greatest),
                    short(b.thickness),
                    fixed(b.at, 3),
                    short(b.residual),
                    short(b.turn.to_degrees())
                )
            }),
        );
        let stop = match s.stop {
            Stop::Horizon => "to the end of its time",
            Stop::Rest => "until everything was at rest",
            Stop::Fallen => "until something overturned",
            Stop::Stopped => "until it was stopped",
            Stop::Broken => "until its numbers were no longer finite",
        };
        page.row(
            "steps",
            [format!(
                "{} {:?} steps of {}, {} substeps each, {stop} ({} s)",
                s.steps,
                s.fidelity,
                seconds(s.step),
                s.substeps,
                short(s.time)
            )
            .to_lowercase()],
        );
        page.row("note", s.findings.iter().map(|f| f.text.clone()));
        if let Some(record) = &self.shaking.record {
            page.row("record", record.findings.iter().map(|f| f.text.clone()));
        }
        page.row("time", [seconds(s.seconds)]);
        page
    }

    /// The answer for programs.
    pub fn json(&self) -> Value {
        let s = self.shaken;
        let (fate, block, time) = match s.fate {
            ShakenFate::Overturned { block, time } => {
                ("overturns", Some(self.id(block)), Some(time))
            }
            ShakenFate::Rests => ("rests", None, None),
            ShakenFate::Moves => ("moves", None, None),
        };
        let blocks: Vec<Value> = self
            .model
            .assembly
            .free()
            .map(|i| {
                let b = &s.blocks[i];
                json!({
                    "block": self.id(i), "greatest_over_thickness": b.greatest, "at": b.at,
                    "residual_over_thickness": b.residual, "greatest_turn_deg": b.turn.to_degrees(),
                    "thickness": b.thickness,
                })
            })
            .collect();
        json!({
            "format": "voussoir-shaken/1", "scene": self.name, "ground": self.shaking.json(),
            "proved": [], "fate": fate, "overturned": block, "overturned_at": time,
            "residual_over_thickness": self.residual(), "blocks": blocks,
            "step": s.step, "substeps": s.substeps, "steps": s.steps, "time": s.time,
            "findings": s.findings,
        })
    }

    fn over_thickness(&self, frame: &crate::dynamics::Frame, block: usize) -> f64 {
        let way = frame.blocks[block].center - self.model.assembly.blocks[block].centroid;
        way.norm() / self.shaken.blocks[block].thickness
    }

    /// A row a frame: time (s), the ground along its three axes (m/s²), and the way of every free
    /// block over its thickness.
    ///
    /// # Errors
    /// Only if memory runs out.
    pub fn csv(&self) -> Result<String, GroundError> {
        let free: Vec<usize> = self.model.assembly.free().collect();
        let mut table = Table::new();
        let head = ["time", "ground_toward", "ground_left", "ground_up"].map(String::from);
        let ids = free.iter().map(|&i| self.id(i).to_string());
        table.write_record(head.into_iter().chain(ids)).map_err(refused)?;
        for frame in &self.shaken.frames {
            let ground = self.shaking.motion.at(frame.time);
            let mut row = vec![frame.time, ground.x, ground.y, ground.z];
            row.extend(free.iter().map(|&i| self.over_thickness(frame, i)));
            table.write_record(row.into_iter().map(Cell::from)).map_err(refused)?;
        }
        table.end().map_err(refused)
    }

    /// Way over thickness of the blocks that went farthest, and the ground below, as SVG.
    ///
    /// # Errors
    /// No frames were kept.
    pub fn chart(&self) -> Result<String, GroundError> {
        let lines: Vec<Vec<(f64, f64)>> = self
            .order()
            .into_iter()
            .take(LINES)
            .map(|i| {
                self.shaken.frames.iter().map(|f| (f.time, self.over_thickness(f, i))).collect()
            })
            .collect();
        let end = self.shaken.frames.last().map_or(0.0, |f| f.time);
        let ground = rocking::ground(self.shaking, end);
        let upper = Panel { y: "displacement / thickness", lines: &lines };
        chart(self.name, upper, Panel { y: "ground, m/s²", lines: &[ground] })
    }
}
