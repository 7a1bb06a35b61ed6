//! Every argument of every verb, and nothing else.

use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;
use voussoir::{import::Up, scene::Friction};

const EXIT_CODES: &str = "\
Exit codes:
  0    yes, or done
  1    a clean negative answer: it falls, a requirement is not met, a result is refuted, a scene has slips
  2    the command line or an input file is wrong, or a file cannot be written
  3    undecided: the question was asked properly and stayed open
  130  interrupted

Results go to standard output, everything else to standard error. `-` stands for standard input or output.";

/// Tells whether things made of rigid pieces that only touch stand or fall, and proves it.
#[derive(Debug, Parser)]
#[command(name = "voussoir", version, after_help = EXIT_CODES, arg_required_else_help = true, max_term_width = 110)]
pub struct Cli {
    #[command(subcommand)]
    pub verb: Verb,
    /// Colour of text: auto (on a terminal, unless NO_COLOR is set), always or never.
    #[arg(long, global = true, value_enum, value_name = "WHEN", default_value_t = Color::Auto, hide_possible_values = true)]
    pub color: Color,
}

/// So many directions a tilt is asked for where nothing is said.
pub const DIRECTIONS: u16 = 8;

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Color {
    Auto,
    Always,
    Never,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Law {
    Associative,
    Coulomb,
}

impl From<Law> for voussoir::analysis::Law {
    fn from(law: Law) -> Self {
        match law {
            Law::Associative => Self::Associative,
            Law::Coulomb => Self::Coulomb,
        }
    }
}

#[derive(Debug, Subcommand)]
pub enum Verb {
    /// Does it stand under its dead load?
    ///
    /// Exit code 0 if it stands, 1 if it falls or stands only with a pre-stress that nobody applied, 3 if that stays open.
    Assess(Assess),
    /// How large may the live load grow?
    ///
    /// The greatest load factor λ under which contact forces inside the friction cones balance the dead load and λ × the live load,
    /// between a lower and an upper bound, with the mechanism by which the structure fails. Sliding is associative.
    /// Exit code 0 if λ is found or has no limit, 1 if λ is below --require or no λ lets it stand, 3 if that stays open.
    Limit(Limit),
    /// At what tilt does it fall?
    ///
    /// The ground is tipped towards a direction until the structure fails; own weight and dead loads turn with gravity, live loads are left
    /// out. The least tilt of all directions is the answer. Exit codes as for `limit`.
    Tilt(Tilt),
    /// How steep may a packing of grains be?
    ///
    /// The angle of maximum stability: the largest tilt of gravity, per direction, at which the packing as it lies still has an admissible
    /// system of contact forces. It is reached when the first grain loses balance; with --moving-mass the grains that fell are taken away,
    /// and the tilt is asked for again, until a mechanism moves as much. Exit code 0 if it is found in every direction, 3 if any stays open.
    Repose(Repose),
    /// What happens in time, and does the verdict say the same?
    ///
    /// A rigid-body engine runs the scene under its dead loads, which grow from nothing without any pre-stress: a second opinion that shares
    /// nothing with the verdict but the blocks and where they touch. It proves nothing; near a limit (3 % with fast steps, 1 % with fine
    /// ones) it may err. Exit code 0 if it stands, 1 if it falls, 3 if that stays open.
    Simulate(Simulate),
    /// Make a scene from a template.
    ///
    /// Starts from sensible values; `key=value` changes them, with dots into nested values and JSON on the right:
    /// `voussoir generate arch voussoirs=31 thickness=0.6`. A key set to `null` is left out.
    Generate(Generate),
    /// Make a scene from files of other programs: COMPAS JSON, OBJ, PLY, STL.
    ///
    /// What was assumed or left out is said on standard error.
    Import(Import),
    /// Verify a saved result without a solver, or look for slips in a scene.
    ///
    /// A result is verified from the scene inside it, or from --scene: forces are added up block by block, powers of the mechanism joint by
    /// joint, and every word of the answer is compared. Exit code 0 if it is proved, 1 if it is refuted, 3 if it claims nothing.
    /// Of a scene, near misses, overlaps, loose blocks and slips of units are listed. Exit code 0 if there is none, 1 otherwise.
    Check(Check),
    /// Print the JSON Schema of scenes.
    Schema,
}

#[derive(Debug, Args)]
pub struct Assess {
    #[command(flatten)]
    pub common: Common,
    /// Run the scene in time as well, and compare (see `voussoir simulate`).
    #[arg(long)]
    pub simulate: bool,
    /// Run the scene in time where the verdict is conditional or undecided.
    #[arg(long, conflicts_with = "simulate")]
    pub thorough: bool,
    /// Threads of the simulation; 0 for as many as there are processors. The answer does not depend on them.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub threads: u16,
}

#[derive(Debug, Args)]
pub struct Simulate {
    #[command(flatten)]
    pub common: Common,
    /// Fast steps only: to be trusted 3 % away from a limit.
    #[arg(long, conflicts_with = "fine")]
    pub fast: bool,
    /// Fine steps only: to be trusted 1 % away from a limit, at four times the cost. By default fine steps follow unless fast ones show that it stands.
    #[arg(long)]
    pub fine: bool,
    /// Time to simulate at most, in seconds of the scene; by default ten times √(height / gravity).
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = positive)]
    pub seconds: Option<f64>,
    /// Go on to the end although the outcome is clear.
    #[arg(long)]
    pub to_the_end: bool,
    /// Add this factor × the live loads.
    #[arg(long, value_name = "LAMBDA", default_value_t = 0.0, allow_negative_numbers = true, value_parser = finite)]
    pub load_factor: f64,
    /// Threads of the simulation; 0 for as many as there are processors. The answer does not depend on them.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub threads: u16,
    /// Write where every block is, time by time, to this file as it happens.
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// So many times are kept in --csv, and in the result of --json and --save if given.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub frames: Option<u32>,
    /// Do not ask for the verdict to compare with.
    #[arg(long)]
    pub skip_verdict: bool,
}

#[derive(Debug, Args)]
pub struct Limit {
    #[command(flatten)]
    pub common: Common,
    /// The load factor that is needed: exit code 1 if the greatest one, with dry friction too unless --law associative, is below, 3 if
    /// that stays open.
    #[arg(long, value_name = "LAMBDA", allow_negative_numbers = true, value_parser = finite)]
    pub require: Option<f64>,
    /// Do not ask as well whether it stands without its live load.
    #[arg(long)]
    pub skip_dead: bool,
}

#[derive(Debug, Args)]
pub struct Tilt {
    #[command(flatten)]
    pub common: Common,
    /// Tip towards this direction (its part across gravity); may be given several times.
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, value_parser = direction)]
    pub toward: Vec<[f64; 3]>,
    /// Tip towards this many directions, evenly spread, the first along x.
    #[arg(long, value_name = "N", default_value_t = DIRECTIONS, conflicts_with = "toward", value_parser = clap::value_parser!(u16).range(1..=3600))]
    pub all: u16,
    /// The tilt that is needed, in degrees: exit code 1 if the least one, with dry friction too unless --law associative, is below, 3 if
    /// that stays open.
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, value_parser = finite)]
    pub require: Option<f64>,
    /// Do not ask as well whether it stands when level.
    #[arg(long)]
    pub skip_dead: bool,
}

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
    /// Values of the protocol that differ from the defaults (--question repose): grains=2000 diameter=0.01 sizes=0.2 friction=0.5
    /// wall_friction=0 rolling_arm=0 (in d) density=2500 size=[16,10] (in d) rate=0.1.
    #[arg(value_name = "KEY=VALUE", value_parser = assignment)]
    pub set: Vec<(String, String)>,
    /// `stability`: the greatest tilt of the packing SCENE as it lies; `repose`: the slope that a heap leaves behind which flowed, SCENE then
    /// being the protocol: drain, funnel, cylinder or tilt.
    #[arg(long, value_enum, value_name = "QUESTION", default_value_t = Asked::Stability, hide_possible_values = true)]
    pub question: Asked,
    /// So many heaps, each from a seed of its own (--question repose).
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub seeds: u16,
    /// The first seed (--question repose).
    #[arg(long, value_name = "SEED", default_value_t = 1, value_parser = clap::value_parser!(u64).range(..=u64::MAX / 2))]
    pub seed: u64,
    /// Heaps made at the same time; 0 for as many as there are processors. The answer does not depend on it (--question repose).
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub threads: u16,
    /// Do not ask for the static margin of the heaps (--question repose).
    #[arg(long)]
    pub skip_margin: bool,
    /// Write every heap at rest as a scene, FILE with the seed before its ending (--question repose).
    #[arg(long, value_name = "FILE")]
    pub heaps: Option<PathBuf>,
    /// Tip towards this direction (its part across gravity); may be given several times.
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, value_parser = direction)]
    pub toward: Vec<[f64; 3]>,
    /// Tip towards this many directions, evenly spread, the first along x.
    #[arg(long, value_name = "N", default_value_t = DIRECTIONS, conflicts_with = "toward", value_parser = clap::value_parser!(u16).range(1..=3600))]
    pub all: u16,
    /// Share of the mass of the free grains that has to move, such as 0.01.
    #[arg(long, value_name = "SHARE", default_value_t = 0.0, allow_negative_numbers = true, value_parser = share)]
    pub moving_mass: f64,
    /// Show as well how the packing carries its load when level: coordination, fabric, forces, stress, mobilised friction.
    #[arg(long)]
    pub fabric: bool,
    /// Write the contact forces of the packing when level to this file.
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
}

/// What every question takes.
#[derive(Debug, Args)]
pub struct Common {
    /// The scene (JSON), `-` for standard input.
    pub scene: PathBuf,
    /// Print the result as one JSON object and nothing else.
    #[arg(long)]
    pub json: bool,
    /// Write the result, with the scene and its proof, to this file for `voussoir check`.
    #[arg(long, value_name = "FILE")]
    pub save: Option<PathBuf>,
    /// Solve the scene in full, without leaving out what symmetry or missing friction make needless.
    #[arg(long)]
    pub keep_all: bool,
    /// How joints slide: `coulomb` (dry friction) also asks whether the loads produce the forces that hold the scene, and for the load
    /// factor of joints that slide without opening (many convex programs: on large walls minutes); `associative` only whether such forces exist, and for
    /// the bound.
    #[arg(long, value_enum, value_name = "LAW", default_value_t = Law::Coulomb, hide_possible_values = true)]
    pub law: Law,
    /// Stop trying after this many seconds.
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = positive)]
    pub time_limit: Option<f64>,
    /// Lists in full, and every attempt at the program.
    #[arg(short, long)]
    pub verbose: bool,
    /// The first line only.
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,
}

#[derive(Debug, Args)]
pub struct Generate {
    /// The template; --list shows them.
    #[arg(required_unless_present = "list")]
    pub template: Option<String>,
    /// What differs from the template's own values.
    #[arg(value_name = "KEY=VALUE", value_parser = assignment)]
    pub set: Vec<(String, String)>,
    /// List the templates with their values.
    #[arg(long, conflicts_with_all = ["template", "set", "output"])]
    pub list: bool,
    /// Coefficient of friction of every joint, or `infinite`.
    #[arg(long, value_name = "MU", default_value = "0.7", allow_negative_numbers = true, value_parser = friction)]
    pub friction: Friction,
    /// Density of every block, kg/m³.
    #[arg(long, value_name = "DENSITY", allow_negative_numbers = true, value_parser = positive)]
    pub density: Option<f64>,
    /// Name of the scene.
    #[arg(long)]
    pub name: Option<String>,
    /// Write the blocks themselves in place of the template.
    #[arg(long)]
    pub expand: bool,
    /// Write the scene to this file; standard output by default.
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct Import {
    /// The files; PLY and STL hold one block each.
    #[arg(required = true)]
    pub files: Vec<PathBuf>,
    /// Write the scene to this file; standard output by default.
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// A block that is held in place; may be given several times.
    #[arg(long, value_name = "ID")]
    pub support: Vec<String>,
    /// Hold blocks whose lowest corner lies below this height, in m of the scene.
    #[arg(long, value_name = "Z", allow_negative_numbers = true, value_parser = finite)]
    pub support_below: Option<f64>,
    /// A file whose blocks are all held in place; may be given several times.
    #[arg(long, value_name = "FILE")]
    pub supports_file: Vec<PathBuf>,
    /// Coefficient of friction of every joint, or `infinite`.
    #[arg(long, value_name = "MU", allow_negative_numbers = true, value_parser = friction)]
    pub friction: Option<Friction>,
    /// Density of every block, kg/m³, in place of what the file says.
    #[arg(long, value_name = "DENSITY", allow_negative_numbers = true, value_parser = positive)]
    pub density: Option<f64>,
    /// Multiply coordinates: 0.001 for a file in millimetres.
    #[arg(long, value_name = "S", default_value_t = 1.0, allow_negative_numbers = true, value_parser = positive)]
    pub scale: f64,
    /// The axis of the file that points up: x, y, z, -x, -y or -z.
    #[arg(long, value_name = "AXIS", default_value = "z", allow_hyphen_values = true, value_parser = up)]
    pub up: Up,
    /// How far apart faces may be and still touch, relative to the smaller block's size.
    #[arg(long, value_name = "GAP", allow_negative_numbers = true, value_parser = not_negative)]
    pub gap: Option<f64>,
    /// Leave out the interfaces stored in the file: all contacts are detected.
    #[arg(long)]
    pub no_stored_interfaces: bool,
}

#[derive(Debug, Args)]
pub struct Check {
    /// A result or a scene (JSON), `-` for standard input.
    pub file: PathBuf,
    /// Verify the result against this scene, not the one inside it.
    #[arg(long, value_name = "FILE")]
    pub scene: Option<PathBuf>,
}

fn finite(text: &str) -> Result<f64, String> {
    text.trim().parse().ok().filter(|v: &f64| v.is_finite()).ok_or_else(|| "not a finite number".into())
}

fn positive(text: &str) -> Result<f64, String> {
    finite(text).ok().filter(|v| *v > 0.0).ok_or_else(|| "not a number > 0".into())
}

fn not_negative(text: &str) -> Result<f64, String> {
    finite(text).ok().filter(|v| *v >= 0.0).ok_or_else(|| "not a number >= 0".into())
}

fn share(text: &str) -> Result<f64, String> {
    not_negative(text).ok().filter(|v| *v <= 1.0).ok_or_else(|| "not a share from 0 to 1".into())
}

fn friction(text: &str) -> Result<Friction, String> {
    match text {
        "infinite" => Ok(Friction::Infinite),
        _ => not_negative(text).map(Friction::Coefficient).map_err(|_| "not a coefficient >= 0 or `infinite`".into()),
    }
}

fn direction(text: &str) -> Result<[f64; 3], String> {
    let parts: Result<Vec<f64>, String> = text.split(',').map(finite).collect();
    match parts.map_err(|_| "not two or three numbers with commas between, such as 1,0")?[..] {
        [x, y] => Ok([x, y, 0.0]),
        [x, y, z] => Ok([x, y, z]),
        _ => Err("not two or three numbers with commas between, such as 1,0".into()),
    }
}

fn assignment(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.is_empty() => Ok((key.into(), value.into())),
        _ => Err("not of the form key=value".into()),
    }
}

fn up(text: &str) -> Result<Up, String> {
    match text.to_ascii_lowercase().trim_start_matches('+') {
        "x" => Ok(Up::X),
        "y" => Ok(Up::Y),
        "z" => Ok(Up::Z),
        "-x" => Ok(Up::MinusX),
        "-y" => Ok(Up::MinusY),
        "-z" => Ok(Up::MinusZ),
        _ => Err("not one of x, y, z, -x, -y, -z".into()),
    }
}
