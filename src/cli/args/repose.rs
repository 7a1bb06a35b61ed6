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
    /// Values of the protocol that differ from the defaults (--question repose).
    ///
    /// The defaults are: grain=sphere (or clump, hull), elongation=1.5 (of clumps and hulls),
    /// corners=16 (of hulls), grains=2000, diameter=0.01 (of spheres of the same volume), sizes=0.2
    /// (or a file: diameter in m and share finer), friction=0.5, wall_friction=0, rolling_arm=0 (in
    /// d; rolling_friction in R), restitution=0, density=2500, rate=0.1 (drum 1, shear 0.05; of
    /// cell the inertial number, 0.01), pressure=10 (of the lid of shear and in cell, ρ g d),
    /// stiffness=1000 (of cell), drop=3 (of the funnel, in d above the heap), floor=rough (or
    /// flat), size=[16,10] (in d; if not given, it follows the cube root of the number of grains).
    #[arg(value_name = "KEY=VALUE", value_parser = assignment)]
    pub set: Vec<(String, String)>,
    /// `stability`: the greatest tilt of a packing; `repose`: the slope after a flow.
    ///
    /// For `stability`, SCENE is the packing as it lies. For `repose`, the slope is the one that a
    /// heap leaves behind after it flowed, and SCENE is the protocol: drain, funnel, cylinder,
    /// tilt, drum, hopper, shear or cell.
    #[arg(long, value_enum, value_name = "QUESTION", default_value_t = Asked::Stability, hide_possible_values = true)]
    pub question: Asked,
    /// Number of heaps, each with its own seed (--question repose).
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub seeds: u16,
    /// The first seed (--question repose).
    #[arg(long, value_name = "SEED", default_value_t = 1, value_parser = clap::value_parser!(u64).range(..=u64::MAX / 2))]
    pub seed: u64,
    /// Threads; 0 for one per processor (--question repose).
    ///
    /// They are shared among the heaps and, if there are fewer heaps than threads, within each
    /// heap. The answer does not depend on them.
    #[arg(long, value_name = "N", default_value_t = 0, help_heading = "Solver and limits")]
    pub threads: u16,
    /// Skip the static margin of the heaps (--question repose).
    #[arg(long)]
    pub skip_margin: bool,
    /// Checkpoint to this file; run the same command again to resume (--question repose).
    ///
    /// Every heap with its margin is written as soon as it is computed, so the run may be
    /// interrupted at any moment. It may be resumed with more seeds.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Lines), help_heading = "Output")]
    pub keep: Option<PathBuf>,
    /// Write every heap at rest as a scene to this file (--question repose).
    ///
    /// The seed is inserted before the ending of FILE.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Json), help_heading = "Output")]
    pub heaps: Option<PathBuf>,
    /// Start with the grains of this file where they lie (--question repose).
    ///
    /// The file holds the free blocks of a scene (.json), or a table of grains (.csv, .dump). By
    /// default the grains start in loose layers.
    #[arg(long, value_name = "FILE")]
    pub start: Option<PathBuf>,
    /// Write the grains as they lie: .csv, .vtp (ParaView) or .dump (LIGGGHTS).
    ///
    /// For heaps, the seed is inserted before the ending of FILE.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Grains), help_heading = "Output")]
    pub grains: Option<PathBuf>,
    /// Tip towards this direction; may be given several times.
    ///
    /// Only its part across gravity counts.
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, value_parser = direction)]
    pub toward: Vec<[f64; 3]>,
    /// Tip towards this many directions, evenly spread, the first along x.
    #[arg(long, value_name = "N", default_value_t = DIRECTIONS, conflicts_with = "toward", value_parser = clap::value_parser!(u16).range(1..=3600))]
    pub all: u16,
    /// Share of the mass of the free grains that must move, such as 0.01.
    #[arg(long, value_name = "SHARE", default_value_t = 0.0, allow_negative_numbers = true, value_parser = share)]
    pub moving_mass: f64,
    /// Report also how the packing carries its load when level.
    ///
    /// The report covers coordination, fabric, forces, stress and mobilised friction.
    #[arg(long)]
    pub fabric: bool,
    /// Write the contact forces of the level packing (CSV; not with --question repose).
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv), help_heading = "Output")]
    pub csv: Option<PathBuf>,
}
