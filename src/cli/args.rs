//! Every argument of every verb, and nothing else.

mod parse;
mod pictures;
mod sweep;

pub use pictures::{Pictures, Tables};
pub use sweep::{Merge, Slurm, Summary, Sweep, SweepStatus, SweepVerb, Task};

use clap::{Args, Parser, Subcommand, ValueEnum};
use parse::{assignment, bytes, direction, finite, friction, not_negative, positive, share, up};
use std::path::PathBuf;
use voussoir::{
    import::{Reach, Up},
    scene::Friction,
    sweep::Range,
};

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
    /// Take no more memory than this, such as 500M or 8G: what would is refused, mostly before it begins. By default estimates have to fit
    /// into the memory that is free, and nothing is counted.
    #[arg(long, global = true, value_name = "SIZE", value_parser = bytes)]
    pub max_memory: Option<u64>,
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
    /// At what value of a number in the scene does the verdict flip?
    ///
    /// The number is named by its JSON pointer, such as /templates/0/arch/thickness or /joints/default/friction. The range is scanned first,
    /// since there may be several flips; each is narrowed to 1e-9 of its value by following the least unbalance to zero, and verdicts with
    /// proof stand on both sides of it. Exit code 0 if there is a flip, 1 if it stands or falls throughout, 3 if that stays open.
    Critical(Critical),
    /// How hard does it push a support, at least and at most?
    ///
    /// The thrust is the horizontal component of the force on a support. Forces inside the friction cones reach both ends of its range, and
    /// mechanisms in which the support yields or is pushed in prove that there are no others. With them come the line of thrust at every
    /// section and the geometric safety factor: how far all sections can be shrunk and still hold a line of thrust.
    /// Exit code 0 if both ends are found or have no limit, 1 if the scene falls, 3 if that stays open.
    Thrust(Thrust),
    /// What happens in time, and does the verdict say the same?
    ///
    /// A rigid-body engine runs the scene under its dead loads, which grow from nothing without any pre-stress: a second opinion that shares
    /// nothing with the verdict but the blocks and where they touch. It proves nothing; near a limit (3 % with fast steps, 1 % with fine
    /// ones) it may err. Exit code 0 if it stands, 1 if it falls, 3 if that stays open.
    Simulate(Simulate),
    /// Error against run time, per method, on scenes with known answers.
    ///
    /// Each method runs over its knob (the engine's tolerance, facets of friction pyramids, number of verdicts, time steps); medians of
    /// repeated runs. With --soak, random scenes whose proofs are held against each other; with --extreme, some two thousand stiff and extreme scenes with closed forms instead: exit code 1 if any
    /// answer is wrong.
    Study(Study),
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
    /// Pictures show what is proved, or the scene.
    Check(Check),
    /// Ask a question of many scenes that differ in a few numbers.
    ///
    /// The plan names a scene, a question and the numbers that vary, by JSON pointer, on a grid or sampled. Every row is appended to a file as
    /// it ends; the same command takes it up again after a kill at any point. Rows are the same whatever the threads.
    /// Exit code 0 if all rows are done (a row whose scene fails holds its error).
    Sweep(Sweep),
    /// Print the JSON Schema of scenes, or of sweep plans.
    Schema(Schema),
    /// Print what a shell needs to complete verbs and options.
    ///
    /// bash: `voussoir completions bash > ~/.local/share/bash-completion/completions/voussoir`
    Completions(Completions),
    /// Print a manual page, or write all of them.
    ///
    /// `voussoir man limit | man -l -` shows one; `voussoir man --folder ~/.local/share/man/man1` keeps them all.
    Man(Man),
}

#[derive(Debug, Args)]
pub struct Schema {
    /// Of what: `scene` or `plan`.
    #[arg(value_enum, default_value_t = Format::Scene, hide_possible_values = true)]
    pub of: Format,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    Scene,
    Plan,
}

#[derive(Debug, Args)]
pub struct Completions {
    /// bash, elvish, fish, powershell or zsh.
    #[arg(value_enum, hide_possible_values = true)]
    pub shell: clap_complete::Shell,
}

#[derive(Debug, Args)]
pub struct Man {
    /// The verb that the page is about; the program as a whole where none is named.
    #[arg(conflicts_with = "folder")]
    pub verb: Option<String>,
    /// Write the pages of the program and of all verbs into this folder.
    #[arg(long, value_name = "FOLDER")]
    pub folder: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct Assess {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub pictures: Pictures,
    #[command(flatten)]
    pub tables: Tables,
    /// Ask about the worst case within ranges: NAME=LOW..HIGH with commas between, where NAME is `friction` (of all joints without an exception),
    /// `density` (every material by itself), `density:MATERIAL`, `load` (factor on the dead loads) or a JSON pointer. Why that case is the worst is said.
    #[arg(long, value_name = "RANGES", value_delimiter = ',')]
    pub worst: Vec<Range>,
    /// Run the scene in time as well, and compare (see `voussoir simulate`).
    #[arg(long)]
    pub simulate: bool,
    /// Run the scene in time where the verdict is conditional or undecided.
    #[arg(long, conflicts_with = "simulate")]
    pub thorough: bool,
    /// Threads of the simulation; 0 for as many as there are processors. The answer does not depend on them.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(0..=256))]
    pub threads: u16,
}

#[derive(Debug, Args)]
pub struct Simulate {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub pictures: Pictures,
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
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(0..=256))]
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
pub struct Study {
    /// Scenes to study, by name: arch, wall, openings, corner, groove, column, courses, tiny. All of them by default.
    #[arg(long, value_name = "NAMES", value_delimiter = ',', conflicts_with = "extreme")]
    pub scenes: Vec<String>,
    /// Every other setting of each knob, no simulations, no repetition: under a minute.
    #[arg(long, conflicts_with = "extreme")]
    pub quick: bool,
    /// Runs per setting, of which the median counts; 3 by default, 1 with --quick.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1000), conflicts_with = "extreme")]
    pub repeat: Option<u16>,
    /// What leaving things out saves instead: load factors with and without omissions.
    #[arg(long, conflicts_with_all = ["extreme", "quick", "csv", "svg"])]
    pub omissions: bool,
    /// The stiff and extreme grid instead.
    #[arg(long)]
    pub extreme: bool,
    /// So many random scenes instead: verdicts held against their certificates, against omissions and, of a sample, against simulations.
    /// Exit code 1 if any two exclude each other.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=10_000_000), conflicts_with_all = ["extreme", "omissions", "quick", "svg", "scenes", "repeat"])]
    pub soak: Option<u32>,
    /// Which random scenes (--soak).
    #[arg(long, value_name = "SEED", default_value_t = 1, requires = "soak")]
    pub seed: u64,
    /// Keep every scene in this file as soon as it is asked; the same command takes it up again after a kill at any point (--soak, --extreme).
    #[arg(long, value_name = "FILE", conflicts_with_all = ["only", "omissions"])]
    pub keep: Option<PathBuf>,
    /// Print this one of the random scenes, to look at it with other commands; nothing is asked (--soak).
    #[arg(long, value_name = "NUMBER", requires = "soak", conflicts_with_all = ["csv", "json"])]
    pub only: Option<u32>,
    /// Write every run to this file, comma-separated.
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Draw the charts into this folder: one per scene, and profile.svg over all.
    #[arg(long, value_name = "FOLDER", conflicts_with = "extreme")]
    pub svg: Option<PathBuf>,
    /// Write charts with values where one points, and a table to sort, as a page for a browser to this file.
    #[arg(long, value_name = "FILE")]
    pub report: Option<PathBuf>,
    /// Print every run as JSON.
    #[arg(long)]
    pub json: bool,
    /// Lists in full.
    #[arg(short, long)]
    pub verbose: bool,
    /// No progress.
    #[arg(short, long)]
    pub quiet: bool,
}

#[derive(Debug, Args)]
pub struct Limit {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub pictures: Pictures,
    #[command(flatten)]
    pub tables: Tables,
    /// The load factor that is needed: exit code 1 if the greatest one, with dry friction too unless --law associative, is below, 3 if
    /// that stays open.
    #[arg(long, value_name = "LAMBDA", allow_negative_numbers = true, value_parser = finite)]
    pub require: Option<f64>,
    /// Do not ask as well whether it stands without its live load.
    #[arg(long)]
    pub skip_dead: bool,
    /// Ask about the worst case within ranges: NAME=LOW..HIGH with commas between, where NAME is `friction` (of all joints without an exception),
    /// `density` (every material by itself), `density:MATERIAL`, `load` (factor on the dead loads) or a JSON pointer. Why that case is the worst is said.
    #[arg(long, value_name = "RANGES", value_delimiter = ',')]
    pub worst: Vec<Range>,
}

#[derive(Debug, Args)]
pub struct Tilt {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub pictures: Pictures,
    #[command(flatten)]
    pub tables: Tables,
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
    #[command(flatten)]
    pub pictures: Pictures,
    /// Values of the protocol that differ from the defaults (--question repose): grain=sphere (or clump, hull) elongation=1.5 (of clumps and
    /// hulls) corners=16 (of hulls) grains=2000 diameter=0.01 (of spheres of the same volume) sizes=0.2 friction=0.5 wall_friction=0 rolling_arm=0 (in d) density=2500 size=[16,10] (in d) rate=0.1.
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
    /// Keep every heap and its margin in this file as soon as it is there; the same command takes it up again after a kill at any point,
    /// with more seeds too (--question repose).
    #[arg(long, value_name = "FILE")]
    pub keep: Option<PathBuf>,
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
    /// Write the contact forces of the packing when level to this file (not with --question repose).
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct Critical {
    #[command(flatten)]
    pub common: Common,
    /// JSON pointer of the number to vary.
    #[arg(long, value_name = "POINTER")]
    pub vary: String,
    /// The range.
    #[arg(long, required = true, num_args = 2, value_names = ["A", "B"], allow_negative_numbers = true, value_parser = finite)]
    pub between: Vec<f64>,
    /// Scan so many values, both ends among them [default: 33; of a count every one].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(2..=100_000))]
    pub scan: Option<u32>,
    /// Scan in steps of at most this size.
    #[arg(long, value_name = "SIZE", conflicts_with = "scan", allow_negative_numbers = true, value_parser = positive)]
    pub step: Option<f64>,
}

#[derive(Debug, Args)]
pub struct Thrust {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub pictures: Pictures,
    #[command(flatten)]
    pub tables: Tables,
    /// The support; the first one that carries a free block where none is named.
    #[arg(long, value_name = "ID")]
    pub support: Option<String>,
    /// The direction of the thrust (its part across gravity); outwards from the blocks' centre of mass where none is given.
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, value_parser = direction)]
    pub direction: Option<[f64; 3]>,
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
    /// Write the answer as a page for a browser, with a picture, to this file (HTML, without any connection to a network).
    #[arg(long, value_name = "FILE")]
    pub report: Option<PathBuf>,
    /// Solve the scene in full, without leaving out what symmetry or missing friction make needless.
    #[arg(long)]
    pub keep_all: bool,
    /// How joints slide: `coulomb` (dry friction) also asks whether the loads produce the forces that hold the scene, and for the load
    /// factor of joints that slide without opening (many convex programs: on large walls minutes); `associative` only whether such forces exist, and for
    /// the bound.
    #[arg(long, value_enum, value_name = "LAW", default_value_t = Law::Coulomb, hide_possible_values = true)]
    pub law: Law,
    /// Stop trying after this many seconds, counted from the start, and answer with the best bracket so far. Exit code 3 if that decides nothing.
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = positive)]
    pub time_limit: Option<f64>,
    #[command(flatten)]
    pub outside: Outside,
    /// Lists in full, and every attempt at the program.
    #[arg(short, long)]
    pub verbose: bool,
    /// The first line only.
    #[arg(short, long, conflicts_with = "verbose")]
    pub quiet: bool,
}

/// What a scene may read beside itself.
#[derive(Debug, Args)]
pub struct Outside {
    /// Follow paths of meshes in the scene that leave its folder.
    #[arg(long)]
    pub allow_outside: bool,
}

impl Outside {
    pub fn reach(&self) -> Reach {
        if self.allow_outside { Reach::Anywhere } else { Reach::Folder }
    }
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
    #[command(flatten)]
    pub outside: Outside,
    #[command(flatten)]
    pub pictures: Pictures,
    #[command(flatten)]
    pub tables: Tables,
    /// Print one JSON object and nothing else: of a result, what holds and what fails; of a scene, its blocks with their masses and loads, its
    /// interfaces with contact points and frames, and the findings.
    #[arg(long)]
    pub json: bool,
}
