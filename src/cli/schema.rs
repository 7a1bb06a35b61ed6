//! `voussoir schema`

use super::{exit::Exit, terminal};
use voussoir::{report::json, scene};

pub fn run() -> anyhow::Result<Exit> {
    terminal::print(&json::pretty(&scene::schema())?)?;
    Ok(Exit::Yes)
}
