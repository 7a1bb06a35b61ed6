//! Scenes on ground that moves: texts, tables and charts of both ways to run them.

mod chart;
mod rocking;
mod shaken;

pub use rocking::Rocked;
pub use shaken::{ShakenReport, page_charts};

use base::number::{count, short};
use check::ground::{Given, Motion, Record, Recorded, STANDARD_GRAVITY};
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

/// What is known of a record: samples, seconds between them, components.
type Counted = (usize, f64, usize);

/// How the ground moves, in a line.
pub(crate) fn words(given: &Given) -> String {
    let motion = given.motion().unwrap_or_default();
    match (&given.pulse, &given.record) {
        (Some(pulse), _) => described(&pulse.to_string(), None, given.scale, &motion),
        (None, Some(Recorded::Read(s))) => {
            let samples = s.components.first().map_or(0, Vec::len);
            let counted = (samples, s.step, s.components.len());
            described(&s.name, Some(counted), given.scale, &motion)
        }
        (None, Some(Recorded::Named(name))) => name.clone(),
        (None, None) => described("", None, given.scale, &motion),
    }
}

fn described(source: &str, counted: Option<Counted>, scale: f64, motion: &Motion) -> String {
    if *motion == Motion::default() {
        return "at rest".into();
    }
    let peak = motion.peak();
    let mut text = source.to_string();
    if let Some((samples, step, components)) = counted {
        text += &format!(
            " ({}, {} s apart, {})",
            count(samples, "sample"),
            short(step),
            count(components, "component"),
        );
    }
    if scale != 1.0 {
        text += &format!(", × {}", short(scale));
    }
    if peak > 0.0 {
        text += &format!("; peak {} m/s² ({} g)", short(peak), short(peak / STANDARD_GRAVITY));
    }
    if motion.pieces.is_empty() {
        return text;
    }
    format!("{text}; {} s", short(motion.end()))
}

impl Shaking {
    fn words(&self) -> String {
        let counted = self.record.as_ref().map(|r| (r.samples.len(), r.step, r.components));
        described(&self.source, counted, self.scale, &self.motion)
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
