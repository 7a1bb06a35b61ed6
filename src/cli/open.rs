//! `voussoir open`

use super::{args::Open, exit::Exit, terminal};
use anyhow::{Context, bail};
use voussoir::live::Live;

pub fn run(args: &Open) -> anyhow::Result<Exit> {
    let name = args.scene.display();
    if args.scene.as_os_str() == "-" {
        bail!("`open` needs a file to follow; standard input is not one");
    }
    // A name that is wrong is said here; what is wrong in the file is said in the page.
    if !args.scene.metadata().with_context(|| format!("{name}: cannot be read"))?.is_file() {
        bail!("{name}: not a file");
    }
    let live = Live::open(&args.scene, args.outside.reach(), args.port)
        .with_context(|| format!("the page cannot be served on port {}", args.port))?;
    terminal::print(&format!("{}\n", live.url()))?;
    terminal::say(&format!("following {name}; press Ctrl-C to stop"));
    live.serve();
    Ok(Exit::Yes)
}
