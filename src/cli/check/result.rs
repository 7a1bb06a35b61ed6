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
    proof::{Saved, VerificationFile, verify},
    report::{self, text, view::View},
};

pub fn run(
    saved: &Saved,
    args: &Check,
    pictures: &Pictures,
    terminal: &Terminal,
) -> anyhow::Result<Exit> {
    let other =
        args.scene.as_deref().map(|path| input::scene(path, args.outside.reach())).transpose()?;
    terminal::notes(other.iter().flat_map(|(.., said)| said));
    let scene = other.as_ref().map_or(&saved.scene, |(scene, ..)| scene);
    let located = |e: voussoir::error::InputError| match &other {
        Some((_, source, _)) => source.located(e),
        None => e,
    };
    let verified = verify(saved, scene).map_err(located)?;
    // What is refuted is not drawn.
    if let Some(file) = verified.file.as_ref().filter(|_| pictures.wanted() && !verified.refuted())
    {
        pictures.write(&View::new(&prepare(scene).map_err(located)?, file, Vec::new())?)?;
    }
    if args.json {
        terminal::print(&report::json::pretty(&VerificationFile::new(&scene.name, &verified))?)?;
    } else if !pictures.printed() || verified.refuted() {
        let file = verified.file.as_ref();
        terminal.page(&text::verification(
            &scene.name,
            file,
            &verified,
            terminal.layout(&args.file),
        ))?;
    }
    Ok(match (verified.refuted(), verified.proved()) {
        (true, _) => Exit::No,
        (false, true) => Exit::Yes,
        (false, false) => Exit::Undecided,
    })
}
