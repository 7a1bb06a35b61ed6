//! Verifying a saved result.

use crate::cli::{
    args::Check,
    exit::Exit,
    input,
    pictures::Pictures,
    terminal::{self, Terminal},
};
use voussoir::{
    interface::prepare,
    proof::{ResultFile, VerificationFile, verify},
    report::{self, text, view::View},
};

pub fn run(
    file: &ResultFile,
    args: &Check,
    pictures: &Pictures,
    terminal: &Terminal,
) -> anyhow::Result<Exit> {
    let other =
        args.scene.as_deref().map(|path| input::scene(path, args.outside.reach())).transpose()?;
    terminal::notes(other.iter().flat_map(|(.., said)| said));
    let scene = other.as_ref().map_or(&file.scene.input, |(scene, ..)| scene);
    let located = |e: voussoir::error::InputError| match &other {
        Some((_, source, _)) => source.located(e),
        None => e,
    };
    let verification = verify(file, scene).map_err(located)?;
    // What is refuted is not drawn.
    if pictures.wanted() && !verification.refuted() {
        pictures.write(&View::new(&prepare(scene).map_err(located)?, file, Vec::new())?)?;
    }
    if args.json {
        terminal::print(&report::json::pretty(&VerificationFile::new(
            &file.scene.name,
            &verification,
        ))?)?;
    } else if !pictures.printed() || verification.refuted() {
        terminal.page(&text::verification(file, &verification, terminal.layout(&args.file)))?;
    }
    Ok(match (verification.refuted(), verification.claimed) {
        (true, _) => Exit::No,
        (false, true) => Exit::Yes,
        (false, false) => Exit::Undecided,
    })
}
