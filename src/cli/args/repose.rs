//! Arguments about grains.

use super::{
    Common, DIRECTIONS, Pictures,
    parse::{Written, assignment, direction, output, share},
};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// The two questions about a packing, which must not be mixed up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Asked {
    Stability,
    Repose,
}

#[derive(Debug, Args)]
pub struct Repose {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub pictures: Pictures,
    /// Values of the protocol that differ from the defaults (--question repose): grain=sphere (or
    /// clump, hull) elongation=1.5 (of clumps and hulls) corners=16 (of hulls) grains=2000
    /// diameter=0.01 (of spheres of the same volume) sizes=0.2 (or a file: diameter in m and share
    /// finer) friction=0.5 wall_friction=0 rolling_arm=0 (in d; rolling_friction in R)
    /// restitution=0 density=2500 rate=0.1 (drum 1, shear 0.05) pressure=10 (of the lid of shear, ρ
    /// g d) drop=3 (of the funnel, in d above the heap) floor=rough (or flat) size=[16,10] (in d;
    /// where not given it follows the cube root of the number of grains).
    #[arg(value_name = "KEY=VALUE", value_parser = assignment)]
    pub set: Vec<(String, String)>,
    /// `stability`: the greatest tilt of the packing SCENE as it lies; `repose`: the slope that a
    /// heap leaves behind which flowed, SCENE then being the protocol: drain, funnel, cylinder,
    /// tilt, drum, hopper or shear.
    #[arg(long, value_enum, value_name = "QUESTION", default_value_t = Asked::Stability, hide_possible_values = true)]
    pub question: Asked,
    /// So many heaps, each from a seed of its own (--question repose).
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub seeds: u16,
    /// The first seed (--question repose).
    #[arg(long, value_name = "SEED", default_value_t = 1, value_parser = clap::value_parser!(u64).range(..=u64::MAX / 2))]
    pub seed: u64,
    /// Threads, shared out among the heaps and, where they are fewer, inside each; 0 for as many as
    /// there are processors. The answer does not depend on it (--question repose).
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub threads: u16,
    /// Do not ask for the static margin of the heaps (--question repose).
    #[arg(long)]
    pub skip_margin: bool,
    /// Keep every heap and its margin in this file as soon as it is there; the same command takes
    /// it up again after a kill at any point, with more seeds too (--question repose).
    #[arg(long, value_name = "FILE", value_parser = output(Written::Lines))]
    pub keep: Option<PathBuf>,
    /// Write every heap at rest as a scene, FILE with the seed before its ending (--question
    /// repose).
    #[arg(long, value_name = "FILE", value_parser = output(Written::Json))]
    pub heaps: Option<PathBuf>,
    /// Begin with the grains of this file where they lie, in place of loose layers: the free blocks
    /// of a scene (.json), or a table of grains (.csv, .dump) (--question repose).
    #[arg(long, value_name = "FILE")]
    pub start: Option<PathBuf>,
    /// Write the grains as they lie: a table (.csv), points for ParaView (.vtp), or a dump of
    /// LIGGGHTS (.dump); of heaps FILE with the seed before its ending.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Grains))]
    pub grains: Option<PathBuf>,
    /// Tip towards this direction (its part across gravity); may be given several times.
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, value_parser = direction)]
    pub toward: Vec<[f64; 3]>,
    /// Tip towards this many directions, evenly spread, the first along x.
    #[arg(long, value_name = "N", default_value_t = DIRECTIONS, conflicts_with = "toward", value_parser = clap::value_parser!(u16).range(1..=3600))]
    pub all: u16,
    /// Share of the mass of the free grains that has to move, such as 0.01.
    #[arg(long, value_name = "SHARE", default_value_t = 0.0, allow_negative_numbers = true, value_parser = share)]
    pub moving_mass: f64,
    /// Show as well how the packing carries its load when level: coordination, fabric, forces,
    /// stress, mobilised friction.
    #[arg(long)]
    pub fabric: bool,
    /// Write the contact forces of the packing when level to this file (not with --question
    /// repose).
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv))]
    pub csv: Option<PathBuf>,
}
