//! Every argument of every verb, and nothing else.

mod files;
mod ground;
mod kinematic;
mod parse;
mod path;
mod pictures;
mod repose;
mod simulate;
mod stages;
mod state;
mod study;
mod sweep;

pub use files::{Check, Completions, FileFormat, Generate, Import, Man, Open, Schema};
pub use ground::{Ground, Rocking};
pub use kinematic::Kinematic;
pub use path::{Curve, Push, Settle};
pub use pictures::{Pictures, Tables};
pub use repose::{Asked, Repose};
pub use simulate::Simulate;
pub use stages::Stages;
pub use state::State;
pub use study::Study;
pub use sweep::{Merge, Slurm, Summary, Sweep, SweepStatus, SweepVerb, Task};

use clap::{Args, Parser, Subcommand, ValueEnum};
use parse::{Written, bytes, direction, finite, output, positive};
use std::path::PathBuf;
use voussoir::{import::Reach, sweep::Between};

const EXIT_CODES: &str = "\
Exit codes:
  0    yes, or done
  1    a clean negative answer: it falls, a requirement is not met, a result is refuted, a scene has mistakes
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
    /// Take no more memory than this, such as 500M or 8G: what would is refused, mostly before it
    /// begins. By default estimates have to fit into the memory that is free, and nothing is
    /// counted.
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
    /// Exit code 0 if it stands, 1 if it falls or stands only with a pre-stress that nobody
    /// applied, 3 if that stays open.
    Assess(Assess),
    /// How large may the live load grow?
    ///
    /// The greatest load factor λ under which contact forces inside the friction cones balance the
    /// dead load and λ × the live load, between a lower and an upper bound, with the mechanism by
    /// which the structure fails. Sliding is associative. Exit code 0 if λ is found or has no
    /// limit, 1 if λ is below --require or no λ lets it stand, 3 if that stays open.
    Limit(Limit),
    /// At what tilt does it fall?
    ///
    /// The ground is tipped towards a direction until the structure fails; own weight and dead
    /// loads turn with gravity, live loads are left out. The least tilt of all directions is the
    /// answer. Exit codes as for `limit`.
    Tilt(Tilt),
    /// How steep may a packing of grains be?
    ///
    /// The angle of maximum stability: the largest tilt of gravity, per direction, at which the
    /// packing as it lies still has an admissible system of contact forces. It is reached when the
    /// first grain loses balance; with --moving-mass the grains that fell are taken away, and the
    /// tilt is asked for again, until a mechanism moves as much. Exit code 0 if it is found in
    /// every direction, 1 if the packing falls before it is tilted, 3 if any stays open.
    Repose(Repose),
    /// At what value of a number in the scene does the verdict flip?
    ///
    /// The number is named by its JSON pointer, such as /templates/0/arch/thickness or
    /// /joints/default/friction. The range is scanned first, since there may be several flips; each
    /// is narrowed to 1e-9 of its value by following the least equilibrium error to zero, and verdicts with
    /// proof stand on both sides of it. Exit code 0 if there is a flip, 1 if it stands or falls
    /// throughout, 3 if that stays open.
    Critical(Critical),
    /// How hard does it push a support, at least and at most?
    ///
    /// The thrust is the horizontal component of the force on a support. Forces inside the friction
    /// cones reach both ends of its range, and mechanisms in which the support yields or is pushed
    /// in prove that there are no others. With them come the line of thrust at every section and
    /// the geometric safety factor: how far all sections can be shrunk and still hold a line of
    /// thrust. Exit code 0 if both ends are found or have no limit, 1 if the scene falls, 3 if that
    /// stays open.
    Thrust(Thrust),
    /// How far may supports move until it falls?
    ///
    /// Supports move along given ways, slowly, and yield: at the start the blocks push them with
    /// the least force that there can be. The motion is followed with finite rotations from hinge to
    /// hinge; every point of the curve is a scene of its own with a proof that it stands, and where
    /// it falls one pose is proved to stand and the next to fall. Joints that slide go on under dry
    /// friction. Exit code 0 if it stands through the whole movement, 1 if it falls, 3 if that stays
    /// open.
    Settle(Settle),
    /// How does the load factor fall as it moves?
    ///
    /// The live load pushes the structure over, and the way of a point of it is the parameter: at
    /// each value the load factor is that of the displaced scene, in a bracket (the capacity curve),
    /// down to where it vanishes. Where the motion turns back it says so, and goes on at the same
    /// value. Joints that slide go on under dry friction. Exit code 0 if the load factor vanishes
    /// on the way, 1 if it falls before, 3 if that stays open.
    Push(Push),
    /// Under an earthquake: at what acceleration does it start to move, and what then?
    ///
    /// All weights push towards a direction: α0 is the share of them at which the worst mechanism starts,
    /// proved on both sides, and with the mass that takes part it gives the acceleration a0 of the
    /// kinematic analysis of NTC 2018 (Circolare 7/2019, C8.7.1.2.1). The motion is followed with finite
    /// rotations, every point of the capacity curve with a proof, down to where it vanishes; the limit
    /// states SLV and SLC lie at 0.4 and 0.6 of that. With a "site" in the scene, both are held
    /// against its spectra. Exit code 0 if α0 is found, 1 if it is below --require, the scene does not
    /// stand by itself or the site demands more, 3 if that stays open.
    Kinematic(Kinematic),
    /// Does every stage of its construction stand, and how safely?
    ///
    /// The scene is all that ever stands; its "stages" add, remove, hold and release blocks, members
    /// and loads, centring among them. Every stage is answered with its proof; where it stands, with
    /// the load factor of its live load, or else the least tilt, and with the least forces on what it
    /// holds. Exit code 0 if every stage stands, 1 if one does not, 3 if that stays open.
    Stages(Stages),
    /// Which single blocks may be taken out with everything left standing?
    ///
    /// Every free block is taken out by itself, and what is left has its own verdict and proof.
    /// Pictures show by colour what may go. Exit code 0 if some block can be taken out, 1 if none
    /// can, 3 if that stays open.
    Without(Without),
    /// What forces and displacements follow from the stiffness of its joints?
    ///
    /// Joints with a "normal_stiffness" yield as springs that cannot pull, spheres of materials with
    /// "young" and "poisson" by Hertz and Mindlin, friction by Coulomb's law, ties, struts, bars and
    /// tendons by their "stiffness". The state under the dead
    /// load is one step from nothing; along the live load steps end where a joint opens or slides, up to
    /// the load factor of that path. The forces prove that it stands, and balance and the conditions
    /// of Signorini and Coulomb are printed with what is left of each. Exit code 0 if a state is found
    /// and the path followed to its end, 1 if it falls or the load factor is below --require, 3 if that
    /// stays open.
    State(State),
    /// What happens in time, and does the verdict say the same?
    ///
    /// A rigid-body engine runs the scene under its dead loads, which grow from nothing without any
    /// pre-stress: a second opinion that shares nothing with the verdict but the blocks and where
    /// they touch. It proves nothing; near a limit (3 % with fast steps, 1 % with fine ones) it may
    /// err. Exit code 0 if it stands, 1 if it falls or is proved to, 3 if that stays open.
    Simulate(Simulate),
    /// Error against run time, per method, on scenes with known answers.
    ///
    /// Each method runs over its knob (the engine's tolerance, facets of friction pyramids, number
    /// of verdicts, time steps); medians of repeated runs. With --extreme, some two thousand stiff
    /// and extreme scenes with closed forms instead: exit code 1 if any answer is wrong.
    Study(Study),
    /// Make a scene from a template.
    ///
    /// Starts from sensible values; `key=value` changes them, with dots into nested values and JSON
    /// on the right: `voussoir generate arch voussoirs=31 thickness=0.6`. A key set to `null` is
    /// left out. `voussoir generate arch --help` lists the keys of an arch.
    #[command(disable_help_flag = true)]
    Generate(Generate),
    /// Make a scene from files of other programs: COMPAS JSON, OBJ, PLY, STL.
    ///
    /// What was assumed or left out is said on standard error. Exit code 0 if a question about the
    /// scene can be answered, 1 if not, 3 if mistakes were not looked for to the end.
    Import(Import),
    /// Verify a saved result from its scene (proofs without a solver), or look for mistakes in a
    /// scene.
    ///
    /// A result is verified from the scene inside it, or from --scene: forces are added up block by
    /// block, powers of the mechanism joint by joint, and every word of the answer is compared.
    /// Exit code 0 if it is proved, 1 if it is refuted, 3 if it claims nothing or
    /// what no theorem says could not be computed again. Of a scene, near
    /// misses, overlaps, loose blocks and mistakes of units are listed. Exit code 0 if there is
    /// none, 1 otherwise. Pictures show what is proved, or the scene.
    Check(Check),
    /// Ask a question of many scenes that differ in a few numbers or words.
    ///
    /// The plan names a scene, a question and the numbers or words that vary, by JSON pointer, on a
    /// grid or sampled. Every row is appended to a file as it ends; the same command takes it up again
    /// after a kill at any point. Rows are the same whatever the threads. Exit code 0 if
    /// every row has an answer, 3 if one is undecided, or its scene failed (it holds the error).
    Sweep(Sweep),
    /// Show the answer in a browser while the scene is worked on.
    ///
    /// Prints the address of a page that only this machine reaches, with a token in it, and answers
    /// there until it is interrupted (Ctrl-C). The page follows the file: on every save by any
    /// program it asks again. Numbers of the scene have sliders, loads can be dragged, and questions
    /// are tabs; what is changed there is written to a new file only when that is asked for.
    Open(Open),
    /// Print the JSON Schema of scenes, or of sweep plans.
    Schema(Schema),
    /// Print what a shell needs to complete verbs and options.
    ///
    /// bash: `voussoir completions bash > ~/.local/share/bash-completion/completions/voussoir`
    Completions(Completions),
    /// Print a manual page, or write all of them.
    ///
    /// `voussoir man limit | man -l -` shows one; `voussoir man --folder ~/.local/share/man/man1`
    /// keeps them all.
    Man(Man),
}

#[derive(Debug, Args)]
pub struct Assess {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub pictures: Pictures,
    #[command(flatten)]
    pub tables: Tables,
    /// Ask about the worst case within ranges: NAME=LOW..HIGH with commas between, where NAME is
    /// `friction` (of all joints without an exception), `density` (every material by itself),
    /// `density:MATERIAL`, `load` (factor on the dead loads) or a JSON pointer. Why that case is
    /// the worst is said.
    #[arg(long, value_name = "RANGES", value_delimiter = ',')]
    pub worst: Vec<Between>,
    /// Run the scene in time as well, and compare (see `voussoir simulate`).
    #[arg(long)]
    pub simulate: bool,
    /// Run the scene in time where the verdict is conditional or undecided.
    #[arg(long, conflicts_with = "simulate")]
    pub thorough: bool,
    /// Threads of the simulation; 0 for as many as there are processors. The answer does not depend
    /// on them.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(0..=256))]
    pub threads: u16,
}

#[derive(Debug, Args)]
pub struct Limit {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub pictures: Pictures,
    #[command(flatten)]
    pub tables: Tables,
    /// The load factor that is needed: exit code 1 if the greatest one, with dry friction too
    /// unless --law associative, is below, 3 if that stays open.
    #[arg(long, value_name = "LAMBDA", allow_negative_numbers = true, value_parser = finite)]
    pub require: Option<f64>,
    /// Drive the train of the scene over the bridge in place of its live load: a load factor for
    /// every position, both directions of travel, and more positions around the least, which is the
    /// answer.
    #[arg(long)]
    pub moving: bool,
    /// With --moving: draw the load factor against the place of the train to this file.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Svg))]
    pub chart: Option<PathBuf>,
    /// With --moving: write every position with its load factor to this file, comma-separated.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv))]
    pub positions: Option<PathBuf>,
    /// With --moving: with dry friction the value at every position, and not at all but the worst
    /// only that it is not less.
    #[arg(long)]
    pub every_value: bool,
    /// Do not ask as well whether it stands without its live load.
    #[arg(long)]
    pub skip_dead: bool,
    /// Ask about the worst case within ranges: NAME=LOW..HIGH with commas between, where NAME is
    /// `friction` (of all joints without an exception), `density` (every material by itself),
    /// `density:MATERIAL`, `load` (factor on the dead loads) or a JSON pointer. Why that case is
    /// the worst is said.
    #[arg(long, value_name = "RANGES", value_delimiter = ',')]
    pub worst: Vec<Between>,
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
    /// The tilt that is needed, in degrees: exit code 1 if the least one, with dry friction too
    /// unless --law associative, is below, 3 if that stays open.
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, value_parser = finite)]
    pub require: Option<f64>,
    /// Do not ask as well whether it stands when level.
    #[arg(long)]
    pub skip_dead: bool,
}

#[derive(Debug, Args)]
pub struct Without {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub pictures: Pictures,
    /// Write the blocks to this file, comma-separated, a row a block.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv))]
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
    /// The direction of the thrust (its part across gravity), outwards from the blocks' centre of
    /// mass where none is given; with `--member` that of a dowel's shear, in the plane of a plane
    /// scene where none is given.
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, value_parser = direction)]
    pub direction: Option<[f64; 3]>,
    /// The force in this member of the scene (a tie, strut, bar, tendon, dowel, `strip/1`, soil or
    /// grip), least and greatest, in place of a thrust.
    #[arg(long, value_name = "ID", conflicts_with = "support")]
    pub member: Option<String>,
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
    #[arg(long, value_name = "FILE", value_parser = output(Written::Json))]
    pub save: Option<PathBuf>,
    /// Write the answer as a page for a browser, with a picture, to this file (HTML, without any
    /// connection to a network).
    #[arg(long, value_name = "FILE", value_parser = output(Written::Html))]
    pub report: Option<PathBuf>,
    /// Solve the scene in full, without leaving out what symmetry or missing friction make
    /// needless.
    #[arg(long)]
    pub keep_all: bool,
    /// How joints slide: `coulomb` (dry friction) also asks whether the loads produce the forces
    /// that hold the scene, and for the load factor of joints that slide without opening (many
    /// convex programs: on large walls minutes); `associative` only whether such forces exist, and
    /// for the bound.
    #[arg(long, value_enum, value_name = "LAW", default_value_t = Law::Coulomb, hide_possible_values = true)]
    pub law: Law,
    /// Stop trying after this many seconds, counted from the start, and answer with the best
    /// bracket so far. Exit code 3 if that decides nothing.
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

/// When what has no answer but a yes or a no has to end.
#[derive(Debug, Args)]
pub struct TimeLimit {
    /// End after this many seconds, counted from the start, with exit code 3 and what is known by
    /// then.
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = positive)]
    pub time_limit: Option<f64>,
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
