//! `voussoir generate`

use super::{
    args::{Cli, Generate},
    exit::Exit,
    output::Sink,
    terminal,
};
use anyhow::{Context, bail};
use clap::CommandFactory;
use serde_json::{Map, Value};
use voussoir::{
    error::InputError,
    generate::{default_template, expand, make_room, template_names},
    report::{json, text},
    scene::{self, Material, Scene},
};

/// Templates are at most this deep; more is taken for a mistake.
const DEPTH: usize = 8;
/// The name of the one material that --density makes.
const MATERIAL: &str = "stone";

pub fn run(args: &Generate) -> anyhow::Result<Exit> {
    if args.help && args.template.is_none() {
        let mut whole = Cli::command();
        let verb = whole.find_subcommand_mut("generate").context("the verb was lost")?;
        terminal::print(&verb.render_long_help().to_string())?;
        return Ok(Exit::Yes);
    }
    let Some(name) = &args.template else {
        terminal::print(&list())?;
        return Ok(Exit::Yes);
    };
    let Some(mut template) = default_template(name) else {
        bail!(
            InputError::at(Default::default(), format!("there is no template `{name}`"))
                .hint(format!("the templates are {}", template_names().join(", ")))
        );
    };
    if args.help {
        terminal::print(&text::template(name, &template))?;
        return Ok(Exit::Yes);
    }
    let sink = Sink::open(args.output.as_deref())?;
    let values = template.get_mut(name).context("the template has no values")?;
    if args.density.is_some() {
        set(values, "material", Value::from(MATERIAL))?;
    }
    if let Value::Object(values) = &mut *values {
        let chosen: Vec<_> =
            args.set.iter().map(|(key, text)| (key.as_str(), text.trim_matches('"'))).collect();
        make_room(values, &chosen);
    }
    for (key, text) in &args.set {
        // What is no JSON is text, so that words need no quotes.
        set(
            values,
            key,
            serde_json::from_str(text).unwrap_or_else(|_| Value::from(text.as_str())),
        )?;
    }
    let command: Vec<String> = args.set.iter().map(|(k, v)| format!(" {k}={v}")).collect();
    let mut head =
        Scene { name: args.name.clone().unwrap_or_else(|| title(name)), ..Scene::default() };
    head.source = format!("voussoir generate {name}{}", command.concat());
    head.joints.default.friction = Some(args.friction);
    head.materials
        .extend(args.density.map(|density| (MATERIAL.to_string(), Material::of_density(density))));
    let mut value = serde_json::to_value(&head)?;
    value["templates"] = Value::from(vec![template]);
    // Lines and columns of a text that nobody has seen help nobody: the path is enough.
    let (mut scene, _) = scene::read_str(name, value.to_string()).map_err(|e| InputError {
        file: None,
        position: None,
        ..e
    })?;
    let template = scene.templates.first().context("the template was lost")?;
    let blocks = expand(template)?;
    if args.expand {
        (scene.blocks, scene.templates) = (blocks, Vec::new());
    }
    sink.write(&json::text(&scene.to_value()?))?;
    Ok(Exit::Yes)
}

/// Sets the value that a dotted key leads to; numbers lead into lists.
fn set(value: &mut Value, key: &str, new: Value) -> anyhow::Result<()> {
    let mut place = value;
    for (depth, step) in key.split('.').enumerate() {
        if depth >= DEPTH || step.is_empty() {
            bail!("{key}: not a key of a template");
        }
        if let Value::Array(list) = place {
            let count = list.len();
            place = step.parse().ok().and_then(|i: usize| list.get_mut(i)).with_context(|| {
                format!("{key}: no such entry; the list has {count} entries, counted from 0")
            })?;
        } else {
            if !place.is_object() {
                *place = Value::Object(Map::new());
            }
            place =
                place.as_object_mut().context("not an object")?.entry(step).or_insert(Value::Null);
        }
    }
    *place = new;
    Ok(())
}

fn title(name: &str) -> String {
    let words = name.replace('_', " ");
    words[..1].to_uppercase() + &words[1..]
}

fn list() -> String {
    let width = template_names().iter().map(|n| n.len()).max().unwrap_or(0);
    let line = |name: &str| {
        let template = default_template(name).unwrap_or_default();
        let values = template[name].as_object().into_iter().flatten();
        let words: Vec<String> = values.map(|(key, value)| format!("{key}={value}")).collect();
        format!("{name:<width$}  {}\n", words.join(" "))
    };
    template_names().into_iter().map(line).collect()
}
