//! `voussoir man`: manual pages, made of the same words as the help.

use super::{
    args::{Cli, Man},
    exit::Exit,
    output::Sink,
    terminal,
};
use anyhow::{Context, bail};
use clap::{Command, CommandFactory};

pub fn run(args: &Man) -> anyhow::Result<Exit> {
    let mut whole = Cli::command();
    whole.build();
    if let Some(folder) = &args.folder {
        if !folder.is_dir() {
            bail!("--folder {}: there is no such folder", folder.display());
        }
        for command in pages(&whole) {
            let path = folder.join(format!("{}.1", name(command)));
            Sink::open(Some(&path))?.write(&page(command)?)?;
        }
        return Ok(Exit::Yes);
    }
    let command = match &args.verb {
        None => &whole,
        Some(verb) => whole
            .find_subcommand(verb)
            .with_context(|| format!("there is no verb `{verb}`; `voussoir help` lists them"))?,
    };
    terminal::print(&page(command)?)?;
    Ok(Exit::Yes)
}

/// A command and all below it.
fn pages(command: &Command) -> Vec<&Command> {
    let below = command.get_subcommands().filter(|c| c.get_name() != "help").flat_map(pages);
    std::iter::once(command).chain(below).collect()
}

fn name(command: &Command) -> &str {
    command.get_display_name().unwrap_or(command.get_name())
}

fn page(command: &Command) -> anyhow::Result<String> {
    let mut text = Vec::new();
    clap_mangen::Man::new(command.clone()).render(&mut text)?;
    Ok(String::from_utf8(text)?)
}
