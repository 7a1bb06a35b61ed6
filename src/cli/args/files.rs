//! Arguments of the verbs about files: templates, imports, checks, schemas, completions, manuals.

use super::{
    Outside, Pictures, Tables, TimeLimit,
    parse::{Written, assignment, finite, friction, layer, not_negative, output, positive, up},
};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use voussoir::{
    import::{LayerRule, Up},
    scene::Friction,
};

#[derive(Debug, Args)]
pub struct Open {
    /// The scene (JSON).
    pub scene: PathBuf,
    /// Port of the page; by default any that is free.
    #[arg(long, value_name = "PORT", default_value_t = 0, hide_default_value = true)]
    pub port: u16,
    #[command(flatten)]
    pub outside: Outside,
}

#[derive(Debug, Args)]
pub struct Schema {
    /// `scene`, `plan`, `result` (of --json and --save) or `model` (of `check SCENE --json`).
    ///
    /// `presets` lists the partial factors of codes for "combinations", `vehicles` standard axles
    /// for a "train", both with their sources.
    #[arg(value_enum, default_value_t = FileFormat::Scene, hide_possible_values = true)]
    pub of: FileFormat,
    /// Print tables of the keys (Markdown) in place of the schema.
    #[arg(long)]
    pub markdown: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FileFormat {
    Scene,
    Plan,
    Result,
    Model,
    Presets,
    Vehicles,
}

#[derive(Debug, Args)]
pub struct Completions {
    /// bash, elvish, fish, powershell or zsh.
    #[arg(value_enum, hide_possible_values = true)]
    pub shell: clap_complete::Shell,
}

#[derive(Debug, Args)]
pub struct Man {
    /// Verb to describe; by default the program as a whole.
    #[arg(conflicts_with = "folder")]
    pub verb: Option<String>,
    /// Write the pages of the program and of all verbs into this folder.
    #[arg(long, value_name = "FOLDER")]
    pub folder: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct Generate {
    /// Name of the template; --list shows them.
    #[arg(required_unless_present_any = ["list", "help"])]
    pub template: Option<String>,
    /// Values that differ from the template's defaults.
    #[arg(value_name = "KEY=VALUE", value_parser = assignment)]
    pub set: Vec<(String, String)>,
    /// Print help; after a template, its parameters with their units.
    #[arg(short, long)]
    pub help: bool,
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
    #[arg(long, help_heading = "Output")]
    pub expand: bool,
    /// Write the scene to this file; by default to standard output.
    #[arg(short, long, value_name = "FILE", value_parser = output(Written::Json), help_heading = "Output")]
    pub output: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct Import {
    /// The files; PLY and STL hold one block each. Without files, the formats are listed.
    pub files: Vec<PathBuf>,
    /// Write the scene to this file; by default to standard output.
    #[arg(short, long, value_name = "FILE", value_parser = output(Written::Json), help_heading = "Output")]
    pub output: Option<PathBuf>,
    /// Block that is held in place; may be given several times.
    #[arg(long, value_name = "ID")]
    pub support: Vec<String>,
    /// Hold blocks whose lowest corner is below this height, in m of the scene.
    #[arg(long, value_name = "Z", allow_negative_numbers = true, value_parser = finite)]
    pub support_below: Option<f64>,
    /// File whose blocks are all held in place; may be given several times.
    #[arg(long, value_name = "FILE")]
    pub supports_file: Vec<PathBuf>,
    /// What a layer of a drawing stands for; may be given several times.
    ///
    /// `NAME=block,density=2400,depth=0.5`, `NAME=support`, `NAME=tie,strength=50000` (lines from
    /// block to block), `NAME=load,force=0:-1000` (points; along x and y of the drawing, N, live) or
    /// `NAME=ignore`. Layers that are not named hold blocks.
    #[arg(long, value_name = "NAME=ROLE", value_parser = layer)]
    pub layer: Vec<(String, LayerRule)>,
    /// JSON file with the same: an object of rules by layer.
    #[arg(long, value_name = "FILE")]
    pub layers: Option<PathBuf>,
    /// Thickness of the blocks of a plane drawing (DXF), in m.
    #[arg(long, value_name = "D", allow_negative_numbers = true, value_parser = positive)]
    pub depth: Option<f64>,
    /// Coefficient of friction of every joint, or `infinite`.
    #[arg(long, value_name = "MU", allow_negative_numbers = true, value_parser = friction)]
    pub friction: Option<Friction>,
    /// Density of every block, kg/m³, in place of the file's own.
    #[arg(long, value_name = "DENSITY", allow_negative_numbers = true, value_parser = positive)]
    pub density: Option<f64>,
    /// Multiply coordinates: 0.001 for a file in millimetres; by default the unit that the file names.
    #[arg(long, value_name = "S", allow_negative_numbers = true, value_parser = positive)]
    pub scale: Option<f64>,
    /// Axis of the file that points up: x, y, z, -x, -y or -z; by default y of glTF, z of others.
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true, value_parser = up)]
    pub up: Option<Up>,
    /// Greatest gap between touching faces, relative to the size of the smaller block.
    #[arg(long, value_name = "GAP", allow_negative_numbers = true, value_parser = not_negative)]
    pub gap: Option<f64>,
    /// Greatest angle between touching faces, in degrees (1 by default).
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, value_parser = finite)]
    pub angle: Option<f64>,
    /// Ignore the interfaces stored in the file and detect all contacts.
    #[arg(long)]
    pub no_stored_interfaces: bool,
    #[command(flatten)]
    pub limit: TimeLimit,
}

#[derive(Debug, Args)]
pub struct Check {
    /// A result or a scene (JSON), `-` for standard input.
    pub file: PathBuf,
    /// Verify the result against this scene in place of the one inside it.
    #[arg(long, value_name = "FILE")]
    pub scene: Option<PathBuf>,
    #[command(flatten)]
    pub outside: Outside,
    #[command(flatten)]
    pub pictures: Pictures,
    #[command(flatten)]
    pub tables: Tables,
    /// Print one JSON object and nothing else.
    ///
    /// For a result, what holds and what fails. For a scene, its blocks with their masses and
    /// loads, its interfaces with contact points and frames, and the findings.
    #[arg(long, help_heading = "Output")]
    pub json: bool,
    /// Print the first line only.
    #[arg(short, long, conflicts_with = "json", help_heading = "Output")]
    pub quiet: bool,
    #[command(flatten)]
    pub limit: TimeLimit,
}
