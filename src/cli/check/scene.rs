//! Looking for slips in a scene.

use crate::cli::{
    args::Check,
    exit::Exit,
    pictures::Pictures,
    terminal::{self, Terminal},
};
use voussoir::{
    error::{Finding, FindingCode},
    interface::prepare,
    report::{self, Inspection, text, view::View},
    scene::{Scene, Source},
};

pub fn run(
    scene: &Scene,
    source: &Source,
    said: Vec<Finding>,
    args: &Check,
    pictures: &Pictures,
    terminal: &Terminal,
) -> anyhow::Result<Exit> {
    let mut model = prepare(scene).map_err(|e| e.located(source))?;
    model.assembly.findings.splice(0..0, said);
    let (slips, notes): (Vec<Finding>, Vec<Finding>) = model.findings().cloned().partition(is_slip);
    pictures.write(&View::bare(&model))?;
    if args.json {
        terminal::print(&report::json::pretty(&Inspection::new(&model))?)?;
    } else if !pictures.printed() {
        terminal.page(&text::inspection(&model, &slips, &notes, terminal.layout(&args.file)))?;
    }
    Ok(if slips.is_empty() { Exit::Yes } else { Exit::No })
}

/// Whether a finding is likely a mistake in the scene, and not only worth knowing.
fn is_slip(finding: &Finding) -> bool {
    use FindingCode as Code;
    match finding.code {
        Code::NearMiss | Code::Overlap | Code::Floating | Code::Orientation | Code::Units | Code::Missing | Code::WithoutEffect => true,
        Code::Assumed | Code::Mended | Code::Warped | Code::GapClosed | Code::ContactIgnored => false,
        Code::Numerics | Code::LeftOut | Code::Converted | Code::WorstCase => false,
    }
}
