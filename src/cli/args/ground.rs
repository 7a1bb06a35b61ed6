//! Arguments of ground that moves.

use super::parse::{finite, positive, pulse, restitution, scales};
use clap::Args;
use std::path::PathBuf;
use voussoir::ground::{Pulse, Unit};

/// How the ground moves.
#[derive(Debug, Args)]
pub struct Ground {
    /// Move the ground by this record of acceleration (CSV, PEER AT2, ESM or ITACA ASCII). Its
    /// components, or up to three files, go towards --toward, to the left of it, and up.
    #[arg(long, value_name = "RECORD")]
    pub ground: Vec<PathBuf>,
    /// Move the ground by a pulse towards --toward: rectangle:A,T, half-sine:A,T, sine:A,T (m/s²,
    /// s), jump:V or double-jump:V (m/s).
    #[arg(long, value_name = "PULSE", conflicts_with = "ground", value_parser = pulse)]
    pub pulse: Option<(String, Pulse)>,
    /// The unit of the accelerations where the record does not say it: m/s2, cm/s2, mm/s2, g, %g.
    #[arg(long, value_name = "UNIT", requires = "ground")]
    pub units: Option<Unit>,
    /// Multiply the motion of the ground by this [default: 1].
    #[arg(long, value_name = "K", allow_negative_numbers = true, value_parser = finite)]
    pub scale: Option<f64>,
}

impl Ground {
    /// Whether the ground moves.
    pub fn moves(&self) -> bool {
        !self.ground.is_empty() || self.pulse.is_some()
    }
}

/// A mechanism on ground that moves.
#[derive(Debug, Args)]
pub struct Rocking {
    #[command(flatten)]
    pub ground: Ground,
    /// What is left of the speed at every impact, between 0 and 1; by default what conserves
    /// momentum without bouncing.
    #[arg(long, value_name = "E", value_parser = restitution)]
    pub restitution: Option<f64>,
    /// Begin at this part of the unstable equilibrium, at rest: rocks freely where the ground does
    /// not move.
    #[arg(long, value_name = "PART", allow_negative_numbers = true, value_parser = finite)]
    pub from: Option<f64>,
    /// Follow the mechanism for so many seconds; by default until it is at rest or has overturned.
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = positive)]
    pub seconds: Option<f64>,
    /// Find the scales of the motion between these two at which it begins or ceases to overturn.
    #[arg(long, value_name = "FROM,TO", value_parser = scales)]
    pub scan: Option<(f64, f64)>,
}

impl Rocking {
    /// Whether anything is asked in time.
    pub fn asked(&self) -> bool {
        self.ground.moves() || self.from.is_some()
    }

    /// An option that says nothing without the others.
    pub fn idle(&self) -> Option<&'static str> {
        let given = [
            (self.ground.scale.is_some() && !self.ground.moves(), "--scale"),
            (self.restitution.is_some() && !self.asked(), "--restitution"),
            (self.seconds.is_some() && !self.asked(), "--seconds"),
            (self.scan.is_some() && !self.ground.moves(), "--scan"),
        ];
        given.into_iter().find(|g| g.0).map(|g| g.1)
    }
}
