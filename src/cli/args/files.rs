//! Arguments of the verbs about files: templates, imports, checks, schemas, completions, manuals.

use super::{
    Outside, Pictures, Tables, TimeLimit,
    parse::{Written, assignment, finite, friction, not_negative, output, positive, up},
};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use voussoir::{import::Up, scene::Friction};

#[derive(Debug, Args)]
pub struct Open {
    /// The scene (JSON).
    pub scene: PathBuf,
    /// Answer on this port; any that is free by default.
    #[arg(long, value_name = "PORT", default_value_t = 0, hide_default_value = true)]
    pub port: u16,
    #[command(flatten)]
    pub outside: Outside,
}

#[derive(Debug, Args)]
pub struct Schema {
    /// Of what: `scene`, `plan`, `result` (what --json and --save give) or `model` (what `check
    /// SCENE --json` gives).
    #[arg(value_enum, default_value_t = FileFormat::Scene, hide_possible_values = true)]
    pub of: FileFormat,
    /// Print tables of its keys for people (Markdown) instead.
    #[arg(long)]
    pub markdown: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FileFormat {
    Scene,
    Plan,
    Result,
    Model,
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
pub struct Generate {
    /// The template; --list shows them.
    #[arg(required_unless_present_any = ["list", "help"])]
    pub template: Option<String>,
    /// What differs from the template's own values.
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
    #[arg(long)]
    pub expand: bool,
    /// Write the scene to this file; standard output by default.
    #[arg(short, long, value_name = "FILE", value_parser = output(Written::Json))]
    pub output: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct Import {
    /// The files; PLY and STL hold one block each.
    #[arg(required = true)]
    pub files: Vec<PathBuf>,
    /// Write the scene to this file; standard output by default.
    #[arg(short, long, value_name = "FILE", value_parser = output(Written::Json))]
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
    /// How far from parallel faces may be and still touch, in degrees (1 where it is not said).
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, value_parser = finite)]
    pub angle: Option<f64>,
    /// Leave out the interfaces stored in the file: all contacts are detected.
    #[arg(long)]
    pub no_stored_interfaces: bool,
    #[command(flatten)]
    pub limit: TimeLimit,
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
    /// Print one JSON object and nothing else: of a result, what holds and what fails; of a scene,
    /// its blocks with their masses and loads, its interfaces with contact points and frames, and
    /// the findings.
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub limit: TimeLimit,
}
