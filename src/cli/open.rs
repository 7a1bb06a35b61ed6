//! `voussoir open`

use super::{args::Open, exit::Exit, terminal};
use anyhow::{Context, bail};
use voussoir::live::Live;

pub fn run(args: &Open) -> anyhow::Result<Exit> {
    let name = args.scene.display();
    if args.scene.as_os_str() == "-" {
        bail!("`open` follows a file, standard input has none");
    }
    // A name that is wrong is said here; what is wrong in the file is said in the page.
    if !args.scene.metadata().with_context(|| format!("{name}: cannot be read"))?.is_file() {
        bail!("{name}: not a file");
    }
    let live = Live::open(&args.scene, args.outside.reach(), args.port)
        .with_context(|| format!("no page can be served on port {}", args.port))?;
    terminal::print(&format!("{}\n", live.url()))?;
    terminal::say(&format!("{name} is followed; Ctrl-C ends it"));
    live.serve();
    Ok(Exit::Yes)
}
