//! Verifying a saved result.

use crate::cli::{
    args::Check,
    exit::Exit,
    input,
    pictures::Pictures,
    progress::Stage,
    terminal::{self, Terminal},
};
use voussoir::{
    deadline::Deadline,
    proof::{Saved, Solvers, VerificationFile, verify::verify_model},
    report::{self, text, view::View},
};

pub fn run(
    saved: &Saved,
    args: &Check,
    deadline: Deadline,
    pictures: &Pictures,
    terminal: &Terminal,
) -> anyhow::Result<Exit> {
    let other =
        args.scene.as_deref().map(|path| input::scene(path, args.outside.reach())).transpose()?;
    terminal::notes(other.iter().flat_map(|(.., said)| said));
    let scene = other.as_ref().map_or(&saved.scene, |(scene, ..)| scene);
    let source = other.as_ref().map(|(_, source, _)| source);
    let model = input::prepared(scene, source, deadline)?;
    let stage = Stage::begin(true, "verifying");
    let verified = verify_model(saved, scene, &model, &Solvers { deadline });
    drop(stage);
    // What is refuted is not drawn.
    if let Some(file) = verified.file.as_ref().filter(|_| pictures.wanted() && !verified.refuted())
    {
        pictures.write(&View::new(&model, file, Vec::new())?)?;
    }
    if args.json {
        terminal::print(&report::json::pretty(&VerificationFile::new(&scene.name, &verified))?)?;
    } else if !pictures.printed() || verified.refuted() {
        let file = verified.file.as_ref();
        let layout = terminal.layout(&args.file);
        let page = text::verification(&scene.name, file, &verified, layout);
        terminal.page(&if args.quiet { page.first_line() } else { page })?;
    }
    Ok(match (verified.refuted(), verified.proved()) {
        (true, _) => Exit::No,
        (false, true) => Exit::Yes,
        (false, false) => Exit::Undecided,
    })
}
