//! Scenes on ground that moves: texts, tables and charts of both ways to run them.

mod chart;
mod rocking;
mod shaken;

pub use rocking::Rocked;
pub use shaken::ShakenReport;

use crate::{
    ground::{Motion, Record, STANDARD_GRAVITY},
    number::{count, short},
};
use serde_json::{Value, json};

/// A table or chart that cannot be made.
#[derive(Debug, thiserror::Error)]
#[error("no table or chart: {0}")]
pub struct GroundError(String);

fn refused(e: impl std::fmt::Display) -> GroundError {
    GroundError(e.to_string())
}

/// The motion of the ground with where it comes from.
#[derive(Clone, Debug)]
pub struct Shaking {
    /// The files, or the pulse as it was written; empty where the ground rests.
    pub source: String,
    /// The records, where there are any.
    pub record: Option<Record>,
    /// It was multiplied by this.
    pub scale: f64,
    /// The motion, multiplied.
    pub motion: Motion,
    /// The motion as it was given.
    pub given: Motion,
}

impl Shaking {
    fn words(&self) -> String {
        if self.motion == Motion::default() {
            return "at rest".into();
        }
        let peak = self.motion.peak();
        let mut text = self.source.clone();
        if let Some(r) = &self.record {
            text += &format!(
                " ({}, {} s apart, {})",
                count(r.samples.len(), "sample"),
                short(r.step),
                count(r.components, "component"),
            );
        }
        if self.scale != 1.0 {
            text += &format!(", × {}", short(self.scale));
        }
        if peak > 0.0 {
            text += &format!("; peak {} m/s² ({} g)", short(peak), short(peak / STANDARD_GRAVITY));
        }
        if self.motion.pieces.is_empty() {
            return text;
        }
        format!("{text}; {} s", short(self.motion.end()))
    }

    fn json(&self) -> Value {
        let record = self.record.as_ref().map(|r| {
            json!({
                "format": format!("{:?}", r.format).to_lowercase(), "step": r.step,
                "samples": r.samples.len(), "components": r.components,
                "findings": r.findings,
            })
        });
        json!({
            "source": self.source, "record": record, "scale": self.scale,
            "peak": self.motion.peak(), "duration": self.motion.end(),
        })
    }
}
