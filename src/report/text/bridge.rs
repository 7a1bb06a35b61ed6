//! What a bridge was computed with.

use super::page::Page;
use crate::{generate, proof::result::ResultFile};

/// The parts of the model that can be switched, on or off, of every bridge of the scene; whether the
/// ring can crush.
pub(super) fn rows(page: &mut Page, file: &ResultFile) {
    let input = &file.scene.input;
    let mut lines: Vec<String> = input.templates.iter().flat_map(generate::said).collect();
    if lines.is_empty() {
        return;
    }
    let joints = &input.joints;
    let crushes = joints.default.compression.is_some()
        || joints.overrides.iter().any(|o| o.compression.is_some());
    lines.push(match crushes {
        true => "crushing: joints have a compressive strength".into(),
        false => "no crushing: no joint has a compressive strength".into(),
    });
    page.row("bridge", lines);
}
