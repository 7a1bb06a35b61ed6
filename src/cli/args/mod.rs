//! Every argument of every verb, and nothing else.

mod files;
mod ground;
mod kinematic;
mod nested;
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
pub use nested::{Ask, By, Nested};
pub use parse::Requirement;
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
  1    no: the scene falls, a requirement is not met, a result is refuted, or a scene has mistakes
  2    the command line or an input file is wrong, or a file cannot be written
  3    undecided: the input is valid, but no answer was reached
  130  interrupted

Results go to standard output, everything else to standard error. `-` stands for standard input or output.";

/// Certified stability analysis of masonry and granular assemblies of rigid blocks.
#[derive(Debug, Parser)]
#[command(name = "voussoir", version, after_help = EXIT_CODES, arg_required_else_help = true, max_term_width = 110)]
pub struct Cli {
    #[command(subcommand)]
    pub verb: Verb,
    /// Colour of text: auto, always or never.
    ///
    /// `auto` means colour on a terminal, unless NO_COLOR is set.
    #[arg(long, global = true, value_enum, value_name = "WHEN", default_value_t = Color::Auto, hide_possible_values = true, help_heading = "Output")]
    pub color: Color,
    /// Memory limit, such as 500M or 8G: work that would exceed it is refused.
    ///
    /// Most of it is refused before it begins. By default estimates must fit into the free memory,
    /// and memory in use is not counted.
    #[arg(long, global = true, value_name = "SIZE", value_parser = bytes, help_heading = "Solver and limits")]
    pub max_memory: Option<u64>,
}

/// Number of directions of a tilt by default.
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
    /// Exit code 0 if it stands, 1 if it falls or stands only with a self-stress that no load
    /// produces, 3 if undecided.
    Assess(Assess),
    /// How large may the live load grow?
    ///
    /// The answer is the greatest load factor λ at which contact forces inside the friction cones
    /// balance the dead load and λ × the live load. It is enclosed by a lower and an upper bound,
    /// and comes with the governing mechanism. Sliding is associative. Exit code 0 if λ is found or
    /// has no limit, 1 if λ is below --require or no λ lets it stand, 3 if undecided.
    Limit(Limit),
    /// At what tilt does it fall?
    ///
    /// The ground is tipped towards a direction until the structure fails. Own weight and dead
    /// loads rotate with gravity; live loads do not act. The answer is the least tilt of all
    /// directions. Exit codes as for `limit`.
    Tilt(Tilt),
    /// How steep may a packing of grains be?
    ///
    /// The answer is the angle of maximum stability: the largest tilt of gravity, per direction, at
    /// which the packing as it lies still has admissible contact forces. It is reached when the
    /// first grain loses balance. With --moving-mass, grains that fell are removed and the tilt is
    /// computed again, until a mechanism moves that share of the mass. Exit code 0 if it is found
    /// in every direction, 1 if the packing falls before it is tilted, 3 if any direction is
    /// undecided.
    Repose(Repose),
    /// At what value of a number in the scene does the verdict change?
    ///
    /// The number is named by its JSON pointer, such as /templates/0/arch/thickness or
    /// /joints/default/friction. The range is scanned first, since the verdict may change several
    /// times. Each change is narrowed to 1e-9 of its value by following the least equilibrium error
    /// to zero, with a proved verdict on either side. Exit code 0 if the verdict changes, 1 if it
    /// is the same throughout, 3 if undecided.
    Critical(Critical),
    /// What are the least and the greatest thrust on a support?
    ///
    /// The thrust is the horizontal component of the force on a support. Forces inside the friction
    /// cones attain both ends of its range. Mechanisms in which the support yields or is pushed in
    /// prove that no others exist. The answer includes the line of thrust at every section and the
    /// geometric safety factor: how far all sections can be shrunk and still contain a line of
    /// thrust. Exit code 0 if both ends are found or have no limit, 1 if the scene falls, 3 if
    /// undecided.
    Thrust(Thrust),
    /// How far may supports move before it falls?
    ///
    /// Supports follow imposed movements slowly. At the start the blocks push them with the least
    /// possible force. The motion is followed with finite rotations from hinge to hinge, and every
    /// point of the curve is a scene with its own proof that it stands. Where it falls, one pose is
    /// proved to stand and the next to fall. Sliding joints follow dry friction. Exit code 0 if it
    /// stands through the whole movement, 1 if it falls, 3 if undecided.
    Settle(Settle),
    /// How does the load factor fall as the structure displaces?
    ///
    /// The live load pushes the structure over, and the displacement of one of its points is the
    /// parameter. At each value the bracket of the load factor of the displaced scene is computed
    /// (the capacity curve), until the load factor vanishes. If the motion reverses, the answer
    /// reports it and continues at the same value. Sliding joints follow dry friction. Exit code 0
    /// if the load factor vanishes along the curve, 1 if the structure falls before, 3 if
    /// undecided.
    Push(Push),
    /// At what earthquake acceleration does a mechanism start, and what follows?
    ///
    /// All weights push towards a direction. α0 is the share of them at which the governing
    /// mechanism starts, proved on both sides. With the participating mass it gives the
    /// acceleration a0 of the kinematic analysis of NTC 2018 (Circolare 7/2019, C8.7.1.2.1). The
    /// motion is followed with finite rotations until the capacity curve vanishes, every point with
    /// a proof. The limit states SLV and SLC lie at 0.4 and 0.6 of the displacement where it
    /// vanishes. If the scene has a "site", both are verified against its spectra. Exit code 0 if
    /// α0 is found, 3 if undecided. Exit code 1 if α0 is below --require, the scene does not stand
    /// by itself, or the site demands more.
    Kinematic(Kinematic),
    /// Does every stage of construction stand, and with what margin?
    ///
    /// The scene holds everything that ever stands. Its "stages" add, remove, hold and release
    /// blocks, members and loads, centring among them. Every stage is answered with its proof. A
    /// stage that stands also has the load factor of its live load, or else the least tilt, and the
    /// least forces on what it holds. Exit code 0 if every stage stands, 1 if one does not, 3 if
    /// undecided.
    Stages(Stages),
    /// Which single blocks may be removed without a collapse?
    ///
    /// Each free block is removed on its own, and the remaining blocks get their own verdict and
    /// proof. Pictures show removable blocks by colour. Exit code 0 if some block can be removed, 1
    /// if none can, 3 if undecided.
    Without(Without),
    /// What is the answer in every combination of actions?
    ///
    /// The scene lists "combinations" with partial factors on its actions (named by loads, fill,
    /// materials and train) and on strengths, written out or by a "preset" of a code. One question is
    /// asked in each, with its own proof, and the worst governs. Exit code 0 if what is required is
    /// met in all of them, 1 if not, 3 if undecided.
    Combinations(Combinations),
    /// What forces and displacements follow from the stiffness of the joints?
    ///
    /// Joints with a "normal_stiffness" are springs that cannot pull. Spheres of materials with
    /// "young" and "poisson" follow Hertz and Mindlin, friction follows Coulomb's law, and ties,
    /// struts, bars and tendons have their "stiffness". The state under the dead load is computed
    /// in one step from the unloaded state. Along the live load, steps end where a joint opens or
    /// slides, up to the load factor of that path. The forces prove that it stands. The equilibrium
    /// error and the errors of the conditions of Signorini and Coulomb are printed. Exit code 0 if
    /// a state is found and the path followed to its end, 1 if it falls or the load factor is below
    /// --require, 3 if undecided.
    State(State),
    /// What happens in time, and does it agree with the verdict?
    ///
    /// A rigid-body engine runs the scene under its dead loads, which grow from zero without any
    /// self-stress. It is a second opinion that shares only the blocks and their contacts with the
    /// verdict. The outcome is computed, not proved; near a limit (3 % with fast steps, 1 % with
    /// fine ones) it may be wrong. Exit code 0 if it stands, 1 if it falls or is proved to fall, 3
    /// if undecided.
    Simulate(Simulate),
    /// Error against run time, per method, on scenes with known answers.
    ///
    /// Each method runs over its setting (the engine's tolerance, facets of friction pyramids,
    /// number of verdicts, time steps); times are medians of repeated runs. With --extreme it runs
    /// some two thousand stiff and extreme scenes with closed forms instead: exit code 1 if any
    /// answer is wrong.
    Study(Study),
    /// Make a scene from a template.
    ///
    /// The template has default values; `key=value` changes them, with dots into nested values and
    /// JSON on the right: `voussoir generate arch voussoirs=31 thickness=0.6`. A key set to `null`
    /// is omitted. `voussoir generate arch --help` lists the keys of an arch.
    #[command(disable_help_flag = true)]
    Generate(Generate),
    /// Make a scene from files of other programs: drawings, meshes, robots, grains, packing lists.
    ///
    /// Assumptions and omissions are reported on standard error. Exit code 0 if questions about the
    /// scene can be answered, 1 if not, 3 if the search for mistakes did not finish.
    Import(Import),
    /// Verify a saved result from its scene, or look for mistakes in a scene.
    ///
    /// A result is verified from the scene inside it, or from --scene, and proofs need no solver.
    /// Forces are added up block by block, powers of the mechanism joint by joint, and every word
    /// of the answer is compared. Exit code 0 if it is proved, 1 if it is refuted, 3 if it claims
    /// nothing or if a computed, unproved part could not be computed again. For a scene, near
    /// misses, overlaps, loose blocks and mistakes of units are listed. Exit code 0 if there is
    /// none, 1 otherwise. Pictures show what is proved, or the scene.
    Check(Check),
    /// Ask one question of many scenes that differ in a few numbers or words.
    ///
    /// The plan names a scene, a question and the numbers or words that vary, by JSON pointer, on a
    /// grid or sampled. Every row is appended to a file when it is finished; after an interruption
    /// at any point, the same command resumes. Rows do not depend on the number of threads. Exit
    /// code 0 if every row has an answer, 3 if one is undecided or its scene failed (the row holds
    /// the error).
    Sweep(Sweep),
    /// Show the answer in a browser while the scene is edited.
    ///
    /// Prints the address of a page, with a token in it, that only this machine can reach. It
    /// serves the page until it is interrupted (Ctrl-C). The page follows the file and answers
    /// again whenever any program saves it. Numbers of the scene have sliders, loads can be
    /// dragged, and questions are tabs. Changes made on the page are written to a new file only on
    /// request.
    Open(Open),
    /// Print the JSON Schema of scenes, sweep plans, results or models.
    Schema(Schema),
    /// Print the completion script for a shell.
    ///
    /// bash: `voussoir completions bash > ~/.local/share/bash-completion/completions/voussoir`
    Completions(Completions),
    /// Print a manual page, or write all of them.
    ///
    /// `voussoir man limit | man -l -` shows one; `voussoir man --folder ~/.local/share/man/man1`
    /// stores them all.
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
    /// Find the worst case within ranges: NAME=LOW..HIGH, separated by commas.
    ///
    /// NAME is `friction` (all joints without an override), `density` (each material on its own),
    /// `density:MATERIAL`, `load` (factor on the dead loads) or a JSON pointer. The answer states
    /// why that case is the worst.
    #[arg(long, value_name = "RANGES", value_delimiter = ',')]
    pub worst: Vec<Between>,
    /// Simulate the scene in time as well, and compare (see `voussoir simulate`).
    #[arg(long)]
    pub simulate: bool,
    /// Simulate the scene in time if the verdict is conditional or undecided.
    #[arg(long, conflicts_with = "simulate")]
    pub thorough: bool,
    /// Threads of the simulation; 0 for one per processor.
    ///
    /// The answer does not depend on them.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u16).range(0..=256), help_heading = "Solver and limits")]
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
    /// Required load factor: exit code 1 if the greatest is lower, 3 if undecided.
    ///
    /// Unless `--law associative` is given, the load factor under dry friction must reach it too.
    #[arg(long, value_name = "LAMBDA", allow_negative_numbers = true, value_parser = finite)]
    pub require: Option<f64>,
    /// Drive the train of the scene over the bridge in place of its live load.
    ///
    /// Every position gets a load factor, in both directions of travel, with more positions around
    /// the least, which is the answer.
    #[arg(long)]
    pub moving: bool,
    /// With --moving: draw the load factor against the position of the train (SVG).
    #[arg(long, value_name = "FILE", value_parser = output(Written::Svg), help_heading = "Pictures")]
    pub chart: Option<PathBuf>,
    /// With --moving: write every position with its load factor (CSV).
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv), help_heading = "Output")]
    pub positions: Option<PathBuf>,
    /// With --moving: compute the load factor with dry friction at every position.
    ///
    /// By default it is computed at the worst position only; the others are shown to be no lower.
    #[arg(long)]
    pub every_value: bool,
    /// Skip the check that it stands without its live load.
    #[arg(long)]
    pub skip_dead: bool,
    /// Report how the load factor changes with every number that was assumed.
    ///
    /// These are friction, density, strengths and loads. The derivatives follow from the proof.
    /// Where it leaves them open, both sides are computed, not proved.
    #[arg(long)]
    pub sensitivity: bool,
    /// Find the worst case within ranges: NAME=LOW..HIGH, separated by commas.
    ///
    /// NAME is `friction` (all joints without an override), `density` (each material on its own),
    /// `density:MATERIAL`, `load` (factor on the dead loads) or a JSON pointer. The answer states
    /// why that case is the worst.
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
    /// Tip towards this direction; may be given several times.
    ///
    /// Only its part across gravity counts.
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, value_parser = direction)]
    pub toward: Vec<[f64; 3]>,
    /// Tip towards this many directions, evenly spread, the first along x.
    #[arg(long, value_name = "N", default_value_t = DIRECTIONS, conflicts_with = "toward", value_parser = clap::value_parser!(u16).range(1..=3600))]
    pub all: u16,
    /// Required tilt in degrees: exit code 1 if the least is lower, 3 if undecided.
    ///
    /// Unless `--law associative` is given, the tilt under dry friction must reach it too.
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, value_parser = finite)]
    pub require: Option<f64>,
    /// Skip the check that it stands when level.
    #[arg(long)]
    pub skip_dead: bool,
    /// Report how the tilt changes with every number that was assumed.
    ///
    /// These are friction, density, strengths and loads. The derivatives follow from the proof.
    /// Where it leaves them open, both sides are computed, not proved.
    #[arg(long)]
    pub sensitivity: bool,
}

#[derive(Debug, Args)]
pub struct Without {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub pictures: Pictures,
    /// Write the blocks to this file, one per row (CSV).
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv), help_heading = "Output")]
    pub csv: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct Combinations {
    #[command(flatten)]
    pub common: Common,
    #[command(flatten)]
    pub pictures: Pictures,
    /// Question to ask: `assess`, `limit`, `moving`, `tilt` or `kinematic`.
    ///
    /// By default `moving` if the scene has a train, else `limit` if it has live loads, else
    /// `assess`.
    #[arg(long, value_name = "QUESTION", value_enum, hide_possible_values = true)]
    pub ask: Option<Ask>,
    #[command(flatten)]
    pub nested: Nested,
    /// Ask in this combination only; may be given several times.
    #[arg(long, value_name = "NAME")]
    pub only: Vec<String>,
    /// Write the combinations to this file, one per row (CSV).
    #[arg(long, value_name = "FILE", value_parser = output(Written::Csv), help_heading = "Output")]
    pub csv: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct Critical {
    #[command(flatten)]
    pub common: Common,
    /// Find where this question meets what is required, not where the verdict flips.
    ///
    /// `limit`, `moving`, `tilt` or `kinematic`, with the options below: the least thickness for a
    /// load factor, the least strength of a tie for the earthquake of the site.
    #[arg(long, value_name = "QUESTION", value_enum, hide_possible_values = true)]
    pub ask: Option<Ask>,
    #[command(flatten)]
    pub nested: Nested,
    /// JSON pointer of the number to vary.
    #[arg(long, value_name = "POINTER")]
    pub vary: String,
    /// Range of values to search.
    #[arg(long, required = true, num_args = 2, value_names = ["A", "B"], allow_negative_numbers = true, value_parser = finite)]
    pub between: Vec<f64>,
    /// Number of values to scan, both ends included [default: 33; every value of a count].
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
    /// Support to ask about; by default the first that carries a free block.
    #[arg(long, value_name = "ID")]
    pub support: Option<String>,
    /// Direction of the thrust; by default outwards from the blocks' centre of mass.
    ///
    /// Only its part across gravity counts. With `--member` it is the direction of a dowel's shear,
    /// by default in the plane of a plane scene.
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, value_parser = direction)]
    pub direction: Option<[f64; 3]>,
    /// Ask for the least and the greatest force in this member in place of a thrust.
    ///
    /// The member is a tie, strut, bar, tendon, dowel, strip (`strip/1`), soil or grip.
    #[arg(long, value_name = "ID", conflicts_with = "support")]
    pub member: Option<String>,
    /// Required geometric safety factor: exit code 1 if it is lower, 3 if undecided.
    #[arg(long, value_name = "FACTOR", value_parser = finite)]
    pub require: Option<f64>,
}

/// What every question takes.
#[derive(Debug, Args)]
pub struct Common {
    /// The scene (JSON), `-` for standard input.
    pub scene: PathBuf,
    /// Print the result as one JSON object and nothing else.
    #[arg(long, help_heading = "Output")]
    pub json: bool,
    /// Write the result with its scene and proof to this file, for `voussoir check`.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Json), help_heading = "Output")]
    pub save: Option<PathBuf>,
    /// Write the answer with a picture to this file, as a page for a browser (HTML).
    ///
    /// The page needs no network connection.
    #[arg(long, value_name = "FILE", value_parser = output(Written::Html), help_heading = "Output")]
    pub report: Option<PathBuf>,
    /// Let the page of --report verify its own answer, by this checker for browsers.
    ///
    /// The file is `checker.wasm.gz`, which `web/build` makes in the repository of voussoir. The page
    /// then holds scene, evidence and checker, some 2 MB, and says when it is opened whether the
    /// answer in its heading is proved.
    #[arg(long, value_name = "FILE", requires = "report", help_heading = "Output")]
    pub self_checking: Option<PathBuf>,
    /// Solve the scene in full, without reductions.
    ///
    /// By default symmetry and missing friction reduce the work; nothing is neglected.
    #[arg(long, help_heading = "Solver and limits")]
    pub keep_all: bool,
    /// How joints slide: `coulomb` (dry friction) or `associative`.
    ///
    /// `coulomb` also determines whether the loads produce the forces that hold the scene, and the
    /// load factor of joints that slide without opening. It solves many convex programs, which
    /// takes minutes on large walls. `associative` determines only whether such forces exist, and
    /// the bound.
    #[arg(long, value_enum, value_name = "LAW", default_value_t = Law::Coulomb, hide_possible_values = true, help_heading = "Solver and limits")]
    pub law: Law,
    /// Stop after this many seconds from the start, with the best bracket so far.
    ///
    /// Exit code 3 if that bracket decides nothing.
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = positive, help_heading = "Solver and limits")]
    pub time_limit: Option<f64>,
    /// Put this combination of the scene into force: its factors on loads and strengths.
    #[arg(long, value_name = "NAME")]
    pub combination: Option<String>,
    #[command(flatten)]
    pub outside: Outside,
    /// Print lists in full, and every attempt of the solver.
    #[arg(short, long, help_heading = "Output")]
    pub verbose: bool,
    /// Print the first line only.
    #[arg(short, long, conflicts_with = "verbose", help_heading = "Output")]
    pub quiet: bool,
}

/// When what has no answer but a yes or a no has to end.
#[derive(Debug, Args)]
pub struct TimeLimit {
    /// Stop after this many seconds from the start, with exit code 3.
    ///
    /// What is known by then is printed.
    #[arg(long, value_name = "SECONDS", allow_negative_numbers = true, value_parser = positive, help_heading = "Solver and limits")]
    pub time_limit: Option<f64>,
}

/// What a scene may read beside itself.
#[derive(Debug, Args)]
pub struct Outside {
    /// Follow mesh paths in the scene that lead outside its folder.
    #[arg(long, help_heading = "Solver and limits")]
    pub allow_outside: bool,
}

impl Outside {
    pub fn reach(&self) -> Reach {
        if self.allow_outside { Reach::Anywhere } else { Reach::Folder }
    }
}
