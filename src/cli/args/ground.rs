//! Arguments of ground that moves.

use super::parse::{finite, positive, pulse, restitution, scales};
use clap::Args;
use std::path::PathBuf;
use voussoir::ground::{Pulse, Unit};

/// How the ground moves.
#[derive(Debug, Args)]
pub struct Ground {
    /// Move the ground by this acceleration record (CSV, PEER AT2, ESM or ITACA ASCII).
    ///
    /// Its components, or up to three files, act towards --toward, to the left of it, and up.
    #[arg(long, value_name = "RECORD")]
    pub ground: Vec<PathBuf>,
    /// Move the ground by a pulse towards --toward, such as half-sine:A,T.
    ///
    /// Pulses are rectangle:A,T, half-sine:A,T, sine:A,T (m/s², s), jump:V and double-jump:V (m/s).
    #[arg(long, value_name = "PULSE", conflicts_with = "ground", value_parser = pulse)]
    pub pulse: Option<(String, Pulse)>,
    /// Unit of accelerations if the record states none: m/s2, cm/s2, mm/s2, g or %g.
    #[arg(long, value_name = "UNIT", requires = "ground")]
    pub units: Option<Unit>,
    /// Multiply the ground motion by this factor [default: 1].
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
    /// Share of the speed kept at every impact, between 0 and 1.
    ///
    /// By default it conserves momentum without bouncing.
    #[arg(long, value_name = "E", value_parser = restitution)]
    pub restitution: Option<f64>,
    /// Start at rest at this share of the unstable equilibrium.
    ///
    /// If the ground does not move, the mechanism rocks freely.
    #[arg(long, value_name = "PART", allow_negative_numbers = true, value_parser = finite)]
    pub from: Option<f64>,
    /// Duration to follow, in s; by default until it is at rest or has overturned.
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = positive)]
    pub seconds: Option<f64>,
    /// Find the scales of the motion in this range at which overturning begins or ceases.
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
