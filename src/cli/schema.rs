//! `voussoir schema`

use super::{
    args::{FileFormat, Schema},
    exit::Exit,
    terminal,
};
use anyhow::bail;
use voussoir::{
    proof::result,
    report::{inspection, json, keys},
    scene, sweep,
};

pub fn run(args: &Schema) -> anyhow::Result<Exit> {
    let is_data = matches!(args.of, FileFormat::Presets | FileFormat::Vehicles);
    if is_data && args.markdown {
        bail!("--markdown: presets and vehicles are data without keys");
    }
    let schema = match args.of {
        FileFormat::Scene => scene::schema(),
        FileFormat::Plan => sweep::schema(),
        FileFormat::Result => result::schema(),
        FileFormat::Model => inspection::schema(),
        FileFormat::Presets => scene::preset::presets(),
        FileFormat::Vehicles => scene::vehicle::vehicles()?,
    };
    let text = match args.markdown {
        true => keys::page(&schema),
        false => json::pretty(&schema)?,
    };
    terminal::print(&text)?;
    Ok(Exit::Yes)
}
