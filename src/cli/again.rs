//! The options of a command as they were typed, for the commands that may come next.

use super::question::quoted;
use clap::{Arg, ArgMatches, Command, parser::ValueSource};

/// Options that say where an answer goes and how it looks, not what it is.
const SHOWN: [&str; 22] = [
    "json",
    "save",
    "report",
    "csv",
    "svg",
    "chart",
    "vtk",
    "gltf",
    "obj",
    "model",
    "positions",
    "keep",
    "verbose",
    "quiet",
    "view",
    "hide",
    "dimensions",
    "color",
    "frames",
    "max_memory",
    "fabric",
    "grains",
];

/// The options of the verb that change the answer, one a piece.
pub fn typed(command: &Command, matches: &ArgMatches) -> Vec<String> {
    let Some((verb, own)) = matches.subcommand() else { return Vec::new() };
    let Some(command) = command.find_subcommand(verb) else { return Vec::new() };
    let is_told = |arg: &&Arg| {
        let id = arg.get_id().as_str();
        let is_typed = own.value_source(id) == Some(ValueSource::CommandLine);
        is_typed && !arg.is_positional() && !SHOWN.contains(&id)
    };
    command.get_arguments().filter(is_told).flat_map(|arg| option(arg, own)).collect()
}

/// An option, once for each time that it was typed.
fn option(arg: &Arg, own: &ArgMatches) -> Vec<String> {
    let name = arg.get_long().unwrap_or_default();
    let Some(typed) = own.get_raw_occurrences(arg.get_id().as_str()) else { return Vec::new() };
    if !arg.get_action().takes_values() {
        return vec![format!("--{name}")];
    }
    typed
        .map(|values| {
            let values = values.map(|v| v.to_string_lossy().into_owned());
            let said = match arg.get_value_delimiter() {
                Some(between) => quoted(&values.collect::<Vec<_>>().join(&between.to_string())),
                None => values.map(|v| quoted(&v)).collect::<Vec<_>>().join(" "),
            };
            format!("--{name} {said}")
        })
        .collect()
}
