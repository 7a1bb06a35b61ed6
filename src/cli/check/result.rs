//! Verifying a saved result.

use crate::cli::{exit::Exit, input, pictures::Pictures, terminal::Terminal};
use std::path::Path;
use voussoir::{
    analysis::prepare,
    report::{ResultFile, text, verify, view::View},
};

pub fn run(file: &ResultFile, scene: Option<&Path>, pictures: &Pictures, terminal: &Terminal, layout: text::Layout) -> anyhow::Result<Exit> {
    let (verification, model) = match scene {
        None => (verify(file, &file.scene.input)?, pictures.wanted().then(|| prepare(&file.scene.input)).transpose()?),
        Some(path) => {
            let (scene, source) = input::scene(path)?;
            let model = pictures.wanted().then(|| prepare(&scene)).transpose();
            (verify(file, &scene).map_err(|e| e.located(&source))?, model.map_err(|e| e.located(&source))?)
        }
    };
    // What is refuted is not drawn.
    if let (Some(model), false) = (&model, verification.refuted()) {
        pictures.write(&View::new(model, file, Vec::new())?)?;
    }
    if !pictures.printed() || verification.refuted() {
        terminal.page(&text::verification(file, &verification, layout))?;
    }
    Ok(match (verification.refuted(), verification.claimed) {
        (true, _) => Exit::No,
        (false, true) => Exit::Yes,
        (false, false) => Exit::Undecided,
    })
}
