//! `cargo run --release -p trials -- soak 1000`

use anyhow::bail;
use clap::{Args, Parser, Subcommand};
use report::{json, text::Layout};
use serde::Serialize;
use serde_json::Value;
use std::{io::Write, path::PathBuf, process::ExitCode};
use trials::{alike, cross, edges, forge, fuzz, slopes, soak};

/// Trials of the whole on random scenes; exit code 1 where anything is wrong.
#[derive(Parser)]
struct Cli {
    #[command(subcommand)]
    trial: Trial,
}

#[derive(Subcommand)]
enum Trial {
    /// Verdicts held against their certificates, against omissions and, of a sample, against
    /// simulations.
    Soak(Options),
    /// Every scene in several ways that must give one answer: with strangers beside it, at the
    /// coordinates of a survey, under loads up to its load factor and beyond.
    Cross(Options),
    /// Blocks that meet at edges and corners, each scene beside the same with flats there.
    Edges(Options),
    /// Every scene and its images: mirrored, larger, moved, renamed, with points on the way.
    Alike(Options),
    /// The results of every scene changed into false claims, some two hundred a scene.
    Forge(Options),
    /// Derivatives of the load factor of every scene, held against differences.
    Slopes(Options),
    /// Inputs of every reader changed at random: so many, not scenes.
    Fuzz(Options),
}

#[derive(Args)]
struct Options {
    /// So many scenes.
    count: usize,
    /// Which ones.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Keep every scene in this file as soon as it is asked; the same command takes it up again.
    #[arg(long)]
    keep: Option<PathBuf>,
    /// Write scenes of contradictions, or forged results that were called proved, into this folder.
    #[arg(long)]
    dump: Option<PathBuf>,
    /// Print this one of the scenes; nothing is asked.
    #[arg(long)]
    only: Option<usize>,
    /// Print every scene as JSON.
    #[arg(long)]
    json: bool,
    /// Lists in full.
    #[arg(short, long)]
    verbose: bool,
}

impl Options {
    /// Writes what is wrong, prints what was found.
    fn tell<T: Serialize>(
        &self,
        list: &[T],
        wrong: bool,
        files: impl IntoIterator<Item = (String, Value)>,
        text: impl std::fmt::Display,
    ) -> anyhow::Result<ExitCode> {
        if let Some(folder) = &self.dump {
            for (name, value) in files {
                std::fs::write(folder.join(name), json::pretty(&value)?)?;
            }
        }
        match self.json {
            true => println!("{}", json::pretty(&list)?),
            false => println!("{text}"),
        }
        Ok(if wrong { ExitCode::FAILURE } else { ExitCode::SUCCESS })
    }
}

fn main() -> anyhow::Result<ExitCode> {
    let Cli { trial } = Cli::parse();
    let (Trial::Soak(o)
    | Trial::Cross(o)
    | Trial::Edges(o)
    | Trial::Alike(o)
    | Trial::Forge(o)
    | Trial::Slopes(o)
    | Trial::Fuzz(o)) = &trial;
    if o.dump.as_ref().is_some_and(|folder| !folder.is_dir()) {
        bail!("--dump: there is no such folder");
    }
    let (seed, count, verbose, layout) = (o.seed, o.count, o.verbose, Layout::default());
    let keep = o.keep.as_deref();
    if let (Some(number), Trial::Fuzz(_)) = (o.only, &trial) {
        std::io::stdout().write_all(&fuzz::one(seed, number)?.1)?;
        return Ok(ExitCode::SUCCESS);
    }
    if let Some(index) = o.only {
        let scene = match trial {
            Trial::Soak(_) => soak::scene(seed, index)?.0,
            Trial::Edges(_) => edges::scene(seed, index)?.0,
            Trial::Alike(_) => alike::scene(seed, index)?.0,
            Trial::Slopes(_) => slopes::scene(seed, index)?.0,
            _ => cross::scene(seed, index)?.0,
        };
        println!("{}", json::text(&scene.to_value()?));
        return Ok(ExitCode::SUCCESS);
    }
    match trial {
        Trial::Soak(_) => {
            let kept = keep.map(|path| soak::keep(path, seed)).transpose()?;
            let list = soak::run(seed, count, kept.as_ref(), |_| {})?;
            let wrong = list.iter().any(soak::Soaked::is_wrong);
            o.tell(&list, wrong, [], soak::text(&list, seed, verbose, layout))
        }
        Trial::Cross(_) => {
            let kept = keep.map(|path| cross::keep(path, seed)).transpose()?;
            let list = cross::run(seed, count, kept.as_ref(), |_| {})?;
            let wrong = list.iter().any(cross::Crossed::is_wrong);
            let scenes = cross::scenes(seed, &list).into_iter();
            let files = scenes.filter_map(|(name, scene)| Some((name, scene.to_value().ok()?)));
            o.tell(&list, wrong, files, cross::text(&list, seed, verbose, layout))
        }
        Trial::Edges(_) => {
            let kept = keep.map(|path| edges::keep(path, seed)).transpose()?;
            let list = edges::run(seed, count, kept.as_ref(), |_| {})?;
            let wrong = list.iter().any(edges::Edged::is_wrong);
            o.tell(&list, wrong, [], edges::text(&list, seed, verbose, layout))
        }
        Trial::Alike(_) => {
            let kept = keep.map(|path| alike::keep(path, seed)).transpose()?;
            let list = alike::run(seed, count, kept.as_ref(), |_| {})?;
            let wrong = list.iter().any(alike::Alike::is_wrong);
            o.tell(&list, wrong, [], alike::text(&list, seed, verbose, layout))
        }
        Trial::Slopes(_) => {
            let kept = keep.map(|path| slopes::keep(path, seed)).transpose()?;
            let list = slopes::run(seed, count, kept.as_ref(), |_| {})?;
            let wrong = list.iter().any(slopes::Sloped::is_wrong);
            o.tell(&list, wrong, [], slopes::text(&list, seed, verbose, layout))
        }
        Trial::Fuzz(_) => {
            let list = fuzz::run(seed, count, |n| eprint!("\r{n}"))?;
            let wrong = list.iter().any(fuzz::Fuzzed::is_wrong);
            o.tell(&list, wrong, [], fuzz::text(&list, seed))
        }
        Trial::Forge(_) => {
            let kept = keep.map(|path| forge::keep(path, seed)).transpose()?;
            let list = forge::run(seed, count, kept.as_ref(), |_| {})?;
            let wrong = list.iter().any(forge::Forged::is_wrong);
            let files = forge::files(seed, &list);
            o.tell(&list, wrong, files, forge::text(&list, seed, verbose, layout))
        }
    }
}
