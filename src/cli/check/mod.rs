//! `voussoir check`

mod result;
mod scene;

use super::{
    args::Check, claim, deadline, exit::Exit, input, pictures::Pictures, terminal::Terminal,
};
use anyhow::bail;
use voussoir::{
    error::{InputError, JsonPath},
    proof::read,
};

pub fn run(args: &Check, terminal: &Terminal) -> anyhow::Result<Exit> {
    // Before the pictures, which are opened before anything is read.
    [Some(&args.file), args.scene.as_ref()]
        .into_iter()
        .flatten()
        .try_for_each(|file| claim::read(file))?;
    let pictures = Pictures::open(&args.pictures, args.tables.csv.as_deref())?;
    if pictures.printed() && args.json {
        bail!("only one of --svg, --vtk and --json can go to standard output");
    }
    let deadline = deadline::of(args.limit.time_limit);
    let (name, bytes) = input::bytes(&args.file)?;
    match std::str::from_utf8(&bytes).ok().filter(|text| read::is_result(text)) {
        Some(text) => {
            result::run(&read::read_str(name, text)?, args, deadline, &pictures, terminal)
        }
        None if args.scene.is_some() => {
            let error = InputError::at(
                JsonPath::root(),
                "not a result: only a result can be verified against a scene",
            );
            Err(InputError {
                file: Some(name),
                ..error.hint("save a result with --save, or omit --scene")
            }
            .into())
        }
        None => {
            let (scene, source, said) =
                input::scene_of(&args.file, name, bytes, args.outside.reach())?;
            scene::run((&scene, &source, said), args, deadline, &pictures, terminal)
        }
    }
}
