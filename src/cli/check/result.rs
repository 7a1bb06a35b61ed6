//! Verifying a saved result.

use crate::cli::{
    exit::Exit,
    input,
    terminal::{self, Terminal},
};
use std::path::Path;
use voussoir::report::{self, ResultFile, VerificationFile, text, verify};

pub fn run(file: &ResultFile, scene: Option<&Path>, json: bool, terminal: &Terminal, layout: text::Layout) -> anyhow::Result<Exit> {
    let verification = match scene {
        None => verify(file, &file.scene.input)?,
        Some(path) => {
            let (scene, source) = input::scene(path)?;
            verify(file, &scene).map_err(|e| e.located(&source))?
        }
    };
    if json {
        terminal::print(&report::json::pretty(&VerificationFile::new(&file.scene.name, &verification))?)?;
    } else {
        terminal.page(&text::verification(file, &verification, layout))?;
    }
    Ok(match (verification.refuted(), verification.claimed) {
        (true, _) => Exit::No,
        (false, true) => Exit::Yes,
        (false, false) => Exit::Undecided,
    })
}
