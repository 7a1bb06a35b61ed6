//! What a bridge was computed with.

use super::page::Page;
use base::number::short;
use check::proof::result::ResultFile;
use scene::{OnRoad, Template, generate};

/// The parts of the model that can be switched, on or off, of every bridge of the scene; how much of
/// its width carries what stands on it.
pub(crate) fn parts(file: &ResultFile) -> Vec<String> {
    let templates = &file.scene.input.templates;
    let mut lines: Vec<String> = templates.iter().flat_map(generate::said).collect();
    if !lines.is_empty() {
        lines.extend(effective_width(file));
    }
    lines
}

/// All that, and whether the ring can crush.
pub(super) fn rows(page: &mut Page, file: &ResultFile) {
    let mut lines = parts(file);
    if lines.is_empty() {
        return;
    }
    let joints = &file.scene.input.joints;
    let crushes = joints.default.compression.is_some()
        || joints.overrides.iter().any(|o| o.compression.is_some());
    lines.push(match crushes {
        true => "crushing: joints have a compressive strength".into(),
        false => "no crushing: no joint has a compressive strength".into(),
    });
    page.row("bridge", lines);
}

/// So many widths are named.
const SHOWN: usize = 6;

/// The width that carries each load on the road; nothing where none stands there.
fn effective_width(file: &ResultFile) -> Option<String> {
    let input = &file.scene.input;
    let patches: Vec<(String, OnRoad)> = match (file.answer.moving(), &input.train) {
        (Some(a), Some(train)) => a
            .axles
            .iter()
            .filter_map(|s| {
                let axle = train.axles.get(s.axle)?;
                let on = OnRoad { x: s.x, patch: axle.patch, across: axle.across };
                Some((format!("axle {}", s.axle + 1), on))
            })
            .collect(),
        _ => {
            let all = input.loads.live.iter().chain(&input.loads.dead);
            let on = all.filter_map(|l| l.road);
            on.map(|on| (format!("load at x = {}", short(on.x)), on)).collect()
        }
    };
    let spread = |t: &Template, on: OnRoad| generate::on_road(t, on, [0.0, 0.0, -1.0]);
    let width = |on: OnRoad| Some(input.templates.iter().find_map(|t| spread(t, on))?.width);
    if patches.is_empty() {
        return None;
    }
    if patches.iter().all(|(_, on)| on.across.is_none()) {
        return Some(
            "effective width: all of it, for no load says how far it reaches across".into(),
        );
    }
    let line =
        |(name, on): &(String, OnRoad)| Some(format!("{} m under {name}", short(width(*on)?)));
    let mut words: Vec<String> = patches.iter().take(SHOWN).filter_map(line).collect();
    if patches.len() > SHOWN {
        words.push("…".into());
    }
    Some(format!("effective width: {}", words.join(", ")))
}
