//! Scenes on ground that moves: tables and charts of both ways to run them.

mod rocking;
mod shaken;

pub use rocking::Rocked;
pub use shaken::ShakenReport;

use base::number::{count, short};
use check::ground::{Given, Motion, Recorded, STANDARD_GRAVITY};

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
