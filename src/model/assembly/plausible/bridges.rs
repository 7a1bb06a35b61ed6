//! The numbers of bridges: lengths in millimetres or centimetres, axles in kilonewtons.

use super::{is_on_earth, short};
use crate::{assembly::Assembly, train};
use scene::{Scene, Template};

/// Clear spans of masonry arches, m: the longest of all, at Danhe, has 146. Below, a drain.
const SPAN: std::ops::Range<f64> = 0.3..200.0;
/// Cover over the crown, m. Above, hills are meant, or another unit.
const COVER: f64 = 15.0;
/// Thickness of a ring over its span: the thinnest that stand have 1/40, drains 1/3.
const RING: f64 = 1.0;
/// Rings and cover are rarely thinner, m: what would be in millimetres is in centimetres.
const THINNEST: f64 = 0.05;
/// An axle on a road or a rail, N: a cart has 1,000, the heaviest wagon 400,000. Below, kN are meant.
const AXLE: f64 = 1000.0;

/// A train that leaves a span out.
pub(super) fn not_crossed(scene: &Scene) -> Option<String> {
    let missed = train::not_crossed(scene);
    let spans = missed
        .iter()
        .map(|(k, [left, right])| format!("span {k} (x = {} to {})", short(*left), short(*right)));
    let spans: Vec<String> = spans.collect();
    (!spans.is_empty()).then(|| {
        format!(
            "train.path: no axle is driven over {}, and a lower load factor may lie there. Extend the path",
            spans.join(", ")
        )
    })
}

/// What looks like a mistake in a bridge.
pub(super) fn mistakes(scene: &Scene, assembly: &Assembly) -> Vec<String> {
    let mut texts = Vec::new();
    if !is_on_earth(assembly) {
        return texts;
    }
    for (i, template) in scene.templates.iter().enumerate() {
        let Template::Bridge(bridge) = template else { continue };
        let mut long = |place: String, value: f64, (least, most): (f64, f64), why: &str| {
            if value > most {
                let unit = if value / 1000.0 >= least { "millimetres" } else { "centimetres" };
                texts.push(format!(
                    "templates[{i}].bridge.{place} is {} m: {why}. It looks like {unit}: lengths are in m",
                    short(value)
                ));
            }
        };
        for (k, span) in bridge.spans.iter().enumerate() {
            long(
                format!("spans[{k}].clear_span"),
                span.clear_span,
                (SPAN.start, SPAN.end),
                "the longest masonry arch spans 146 m",
            );
            let thick = RING * span.clear_span.clamp(SPAN.start, SPAN.end);
            let why = "no ring is thicker than its span";
            if span.clear_span > 0.0 {
                long(format!("spans[{k}].thickness"), span.thickness, (THINNEST, thick), why);
            }
        }
        if let Some(fill) = &bridge.fill {
            long(
                "fill.cover".into(),
                fill.cover,
                (THINNEST, COVER),
                "no arch carries so much cover",
            );
        }
    }
    let axles = scene.train.iter().flat_map(|t| &t.axles).map(|a| a.force.size()).enumerate();
    let light: Vec<(usize, f64)> = axles.filter(|(_, f)| (0.0..AXLE).contains(f)).collect();
    if let Some((k, force)) = light.first() {
        let more = match light.len() {
            1 => String::new(),
            n => format!(" (and of {} more)", n - 1),
        };
        texts.push(format!(
            "train.axles[{k}].force{more} is {} N, less than a cart. It looks like kN: forces are in N",
            short(*force)
        ));
    }
    texts
}
