//! `voussoir schema`

use super::{
    args::{FileFormat, Schema},
    exit::Exit,
    terminal,
};
use voussoir::{
    proof::result,
    report::{inspection, json, keys},
    scene, sweep,
};

pub fn run(args: &Schema) -> anyhow::Result<Exit> {
    let schema = match args.of {
        FileFormat::Scene => scene::schema(),
        FileFormat::Plan => sweep::schema(),
        FileFormat::Result => result::schema(),
        FileFormat::Model => inspection::schema(),
    };
    let text = match args.markdown {
        true => keys::page(&schema),
        false => json::pretty(&schema)?,
    };
    terminal::print(&text)?;
    Ok(Exit::Yes)
}
