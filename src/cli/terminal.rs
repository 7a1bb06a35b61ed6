//! Standard output and standard error. A reader that went away is no error, on either.

use super::{args::Color, exit::Exit};
use anyhow::Context;
use std::{
    io::{self, ErrorKind, IsTerminal, Write},
    path::Path,
};
use voussoir::{
    error::{Finding, InputError},
    number::count,
    parallel,
    plain::{printable, readable},
    report::text::{Layout, Page, Role},
};

/// How pages look.
pub struct Terminal {
    color: bool,
    /// The options of the command that change its answer, as typed.
    pub again: String,
}

impl Terminal {
    /// Colour as asked for; by default on a terminal, unless `NO_COLOR` is set
    /// (<https://no-color.org>).
    pub fn new(color: Color, again: String) -> Self {
        let set = |name: &str| std::env::var_os(name).is_some_and(|v| !v.is_empty());
        let dumb = std::env::var_os("TERM").is_some_and(|t| t == "dumb");
        Self {
            again,
            color: match color {
                Color::Always => true,
                Color::Never => false,
                Color::Auto => io::stdout().is_terminal() && !set("NO_COLOR") && !dumb,
            },
        }
    }

    /// Fits pages to the terminal, where standard output is one, and says what stands for a scene
    /// without a name: its file's.
    pub fn layout<'a>(&self, file: &'a Path) -> Layout<'a> {
        let unnamed = if file.as_os_str() == "-" {
            "standard input"
        } else {
            file.file_name().and_then(|n| n.to_str()).unwrap_or("")
        };
        let usual = Layout::default().width;
        let width = terminal_size::terminal_size_of(io::stdout())
            .map_or(usual, |(columns, _)| usize::from(columns.0).min(usual));
        Layout { unnamed, width }
    }

    /// Prints a page on standard output.
    pub fn page(&self, page: &Page) -> anyhow::Result<()> {
        if !self.color {
            return print(&page.to_string());
        }
        let mut text = String::new();
        for line in &page.lines {
            for span in line {
                match style(span.role) {
                    Some(code) if !span.text.trim().is_empty() => {
                        text.push_str(&format!("\x1b[{code}m{}\x1b[0m", span.text))
                    }
                    _ => text.push_str(&span.text),
                }
            }
            text.push('\n');
        }
        print(&text)
    }
}

/// Select graphic rendition parameters (ECMA-48).
fn style(role: Role) -> Option<&'static str> {
    match role {
        Role::Plain => None,
        Role::Name | Role::Value => Some("1"),
        Role::Good => Some("1;32"),
        Role::Bad => Some("1;31"),
        Role::Unsure => Some("1;33"),
        Role::Label => Some("2"),
        Role::Command => Some("36"),
    }
}

/// Prints text on standard output.
pub fn print(text: &str) -> anyhow::Result<()> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(e) if e.kind() == ErrorKind::BrokenPipe => Ok(()),
        other => other.context("cannot write to standard output"),
    }
}

/// Prints a line on standard error.
pub fn say(text: &str) {
    // Where standard error is gone, nobody can be told.
    let lines: Vec<_> =
        text.split('\n').map(|line| readable(&printable(line)).into_owned()).collect();
    let _ = writeln!(io::stderr().lock(), "{}", lines.join("\n"));
}

/// Prints findings on standard error.
pub fn notes<'a>(findings: impl IntoIterator<Item = &'a Finding>) {
    findings.into_iter().for_each(|f| say(&format!("note: {}", f.text)));
}

/// Prints the findings that make it likely that another scene is meant, on standard error, however
/// little else is asked for.
pub fn warnings<'a>(findings: impl IntoIterator<Item = &'a Finding>) {
    findings
        .into_iter()
        .filter(|f| f.code.is_implausible())
        .for_each(|f| say(&format!("warning: {}", f.text)));
}

/// Prints an error: what is wrong and where, then what to do about it.
pub fn error(error: &anyhow::Error) {
    let hint = error.downcast_ref::<InputError>().and_then(|e| e.hint.clone());
    match error.downcast_ref::<InputError>() {
        Some(input) => say(&format!("error: {}", InputError { hint: None, ..input.clone() })),
        None => say(&format!("error: {}", words(error))),
    }
    if let Some(hint) = hint {
        say(&format!("hint: {hint}"));
    }
}

/// What an error and its causes say, each thing once: many an error repeats what it was caused by.
pub fn words(error: &anyhow::Error) -> String {
    let mut text = String::new();
    for cause in error.chain().map(ToString::to_string).filter(|c| !c.is_empty()) {
        if !text.contains(&cause) {
            text = if text.is_empty() { cause } else { format!("{text}: {cause}") };
        }
    }
    text
}

/// Prints what the argument parser answers: help and version on standard output, errors on standard
/// error.
pub fn usage(answer: &clap::Error) -> Exit {
    match answer.print() {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => Exit::Usage,
        _ if answer.use_stderr() => Exit::Usage,
        _ => Exit::Yes,
    }
}

/// Threads of the engine, 0 for as many as there are processors; not all that are asked for where
/// that is too many, with a word.
pub fn threads(asked: u16) -> usize {
    match asked {
        0 => parallel::processors(),
        n => within(n.into(), "--threads"),
    }
}

/// Keeps what the environment asks for within what the machine bears, with a word.
pub fn heed_environment() {
    if let Some(asked) = parallel::heed_environment() {
        within(asked, "RAYON_NUM_THREADS");
    }
}

fn within(asked: usize, option: &str) -> usize {
    let most = parallel::most(asked);
    if most < asked {
        let processors = count(parallel::processors(), "processor");
        say(&format!(
            "note: {option} {asked}: limited to {most} threads, four for each of {processors}"
        ));
    }
    most
}
