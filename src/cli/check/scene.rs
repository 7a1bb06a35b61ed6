//! Looking for mistakes in a scene.

use crate::cli::{
    args::Check,
    exit::Exit,
    input,
    pictures::Pictures,
    terminal::{self, Terminal},
};
use voussoir::{
    deadline::Deadline,
    error::Finding,
    report::{
        self, Inspection, text,
        view::{View, roads},
    },
    scene::{Scene, Source},
};

pub fn run(
    (scene, source, said): (&Scene, &Source, Vec<Finding>),
    args: &Check,
    deadline: Deadline,
    pictures: &Pictures,
    terminal: &Terminal,
) -> anyhow::Result<Exit> {
    let mut model = input::prepared(scene, Some(source), deadline)?;
    model.assembly.said = said;
    let (mistakes, notes): (Vec<Finding>, Vec<Finding>) =
        model.findings().cloned().partition(|f| f.code.is_mistake());
    pictures.write(&View { roads: roads(scene, &model, None), ..View::bare(&model) })?;
    if args.json {
        terminal::print(&report::json::pretty(&Inspection::new(&model).with_train(scene))?)?;
    } else if !pictures.printed() {
        let layout = terminal.layout(&args.file);
        let page = text::inspection(&model, scene.train.as_ref(), [&mistakes, &notes], layout);
        terminal.page(&if args.quiet { page.first_line() } else { page })?;
    }
    Ok(if mistakes.is_empty() { Exit::Yes } else { Exit::No })
}
