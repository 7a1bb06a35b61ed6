//! `voussoir import`

use super::{args::Import, claim, exit::Exit, output::Sink, terminal};
use voussoir::{
    import::{ImportOptions, import_files},
    report::json,
};

pub fn run(args: &Import) -> anyhow::Result<Exit> {
    args.files.iter().chain(&args.supports_file).try_for_each(|file| claim::read(file))?;
    let sink = Sink::open(args.output.as_deref())?;
    let options = ImportOptions {
        supports: args.support.clone(),
        support_below: args.support_below,
        support_files: args.supports_file.clone(),
        friction: args.friction,
        density: args.density,
        scale: args.scale,
        up: args.up,
        gap: args.gap,
        stored_interfaces: !args.no_stored_interfaces,
        ..ImportOptions::default()
    };
    let imported = import_files(&args.files, &options)?;
    terminal::notes(&imported.findings);
    sink.write(&json::pretty(&imported.scene)?)?;
    Ok(Exit::Yes)
}
