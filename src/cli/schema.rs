//! `voussoir schema`

use super::{
    args::{Format, Schema},
    exit::Exit,
    terminal,
};
use voussoir::{report::json, scene, sweep};

pub fn run(args: &Schema) -> anyhow::Result<Exit> {
    let schema = match args.of {
        Format::Scene => scene::schema(),
        Format::Plan => sweep::schema(),
    };
    terminal::print(&json::pretty(&schema)?)?;
    Ok(Exit::Yes)
}
