//! `voussoir import`

use super::{args::Import, claim, deadline, exit::Exit, output::Sink, progress::Stage, terminal};
use anyhow::bail;
use std::{collections::BTreeMap, fmt::Write};
use voussoir::{
    error::{InputError, JsonPath},
    import::{FORMATS, ImportOptions, LayerRule, import_files},
    limits,
    report::{imported::examine, json},
};

/// The layers' rules of `--layers` and `--layer`; the latter count where both name a layer.
fn layers(args: &Import) -> anyhow::Result<BTreeMap<String, LayerRule>> {
    let mut rules = BTreeMap::new();
    if let Some(path) = &args.layers {
        let bytes = limits::read_file(path, limits::PER_BYTE)?;
        rules = serde_json::from_slice(&bytes).map_err(|e| InputError {
            file: Some(path.display().to_string()),
            position: Some((e.line(), e.column())),
            ..InputError::at(JsonPath::root(), e.to_string())
                .hint("an object like {\"ground\": \"support\", \"stone\": {\"density\": 2400}}")
        })?;
    }
    rules.extend(args.layer.iter().cloned());
    Ok(rules)
}

/// The formats with their endings and an example each.
fn formats() -> String {
    let mut text = "Formats that are read, and what becomes a block:\n\n".to_string();
    for known in FORMATS {
        let endings: Vec<String> = known.endings.iter().map(|e| format!(".{e}")).collect();
        let _ = writeln!(text, "  {:<13} {}", known.name, known.holds);
        let _ = writeln!(text, "  {:<13} {}", "", endings.join(", "));
        let _ = writeln!(text, "  {:<13} voussoir import {}\n", "", known.example);
    }
    text.push_str(
        "Rhino (.3dm) and IFC: voussoir.import_file in Python, with rhino3dm or ifcopenshell.\nSTEP: export OBJ or STL with one object a block.\n",
    );
    text
}

pub fn run(args: &Import) -> anyhow::Result<Exit> {
    if args.files.is_empty() {
        if args.output.is_some() || !args.supports_file.is_empty() {
            bail!("no file to import; `voussoir import` alone lists the formats with examples");
        }
        terminal::print(&formats())?;
        return Ok(Exit::Yes);
    }
    args.files
        .iter()
        .chain(&args.supports_file)
        .chain(&args.layers)
        .try_for_each(|file| claim::read(file))?;
    let sink = Sink::open(args.output.as_deref())?;
    let options = ImportOptions {
        supports: args.support.clone(),
        support_below: args.support_below,
        support_files: args.supports_file.clone(),
        friction: args.friction,
        density: args.density,
        depth: args.depth,
        layers: layers(args)?,
        scale: args.scale,
        up: args.up,
        gap: args.gap,
        angle_deg: args.angle,
        stored_interfaces: !args.no_stored_interfaces,
        ..ImportOptions::default()
    };
    let deadline = deadline::of(args.limit.time_limit);
    let stage = Stage::begin(true, "reading");
    let imported = import_files(&args.files, &options)?;
    stage.next("looking for contacts and mistakes");
    let examined = examine(&imported, &options, &|| deadline.is_over());
    drop(stage);
    terminal::say(&examined.summary);
    terminal::notes(&imported.findings);
    examined.findings.iter().for_each(|f| terminal::say(&format!("warning: {}", f.text)));
    examined.broken.iter().for_each(|text| terminal::say(&format!("warning: {text}")));
    if let Some(why) = &examined.unfinished {
        terminal::say(&format!("warning: the search for mistakes did not finish: {why}"));
    }
    imported.unread.iter().for_each(|e| terminal::error(&e.clone().into()));
    sink.write(&json::text(&imported.scene.to_value()?))?;
    // The scene is there to be looked at, but no question about it has an answer, or it lacks files.
    Ok(match examined.broken.is_empty() && imported.unread.is_empty() {
        false => Exit::No,
        true if examined.unfinished.is_some() => Exit::Undecided,
        true => Exit::Yes,
    })
}
