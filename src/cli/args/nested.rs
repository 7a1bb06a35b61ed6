//! A question that is asked of several scenes: its word, and the options that it takes there.

use super::parse::{Requirement, direction, requirement};
use clap::{Args, ValueEnum};

/// The questions that may be asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Ask {
    Assess,
    Limit,
    Moving,
    Tilt,
    Kinematic,
}

#[derive(Debug, Args)]
pub struct Nested {
    /// Required value, or `site` for the earthquake of the site, `site:0.8` for a share of it.
    ///
    /// A value is a load factor, of `tilt` degrees. By default what the scene requires, else 1 of a
    /// load factor and all of the site.
    #[arg(long, value_name = "VALUE|site", allow_negative_numbers = true, value_parser = requirement)]
    pub require: Option<Requirement>,
    /// Direction of the tilt or the earthquake; may be given several times.
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, value_parser = direction)]
    pub toward: Vec<[f64; 3]>,
    /// Verification that governs at the site: `linear` or `displacement`; by default both.
    #[arg(long, value_name = "BY", value_enum)]
    pub verify: Option<By>,
}

/// A verification.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum By {
    Linear,
    Displacement,
}
