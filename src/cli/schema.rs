//! `voussoir schema`

use super::{
    args::{FileFormat, Schema},
    exit::Exit,
    terminal,
};
use voussoir::{report::json, scene, sweep};

pub fn run(args: &Schema) -> anyhow::Result<Exit> {
    let schema = match args.of {
        FileFormat::Scene => scene::schema(),
        FileFormat::Plan => sweep::schema(),
    };
    terminal::print(&json::pretty(&schema)?)?;
    Ok(Exit::Yes)
}
