//! Angles of repose for people.

use super::{Layout, Page, TextOptions, page::Role};
use crate::{
    number::{count, seconds, short},
    report::heaps::{HeapResult, ReposeFile},
};

/// The answer about heaps as a page.
pub fn heaps(file: &ReposeFile, options: TextOptions, layout: Layout) -> Page {
    let mut page = Page::new(layout);
    let p = &file.protocol;
    let name = format!(
        "{:?} of {} {}, friction {}",
        p.kind,
        p.grains,
        p.grain.plural(),
        short(p.friction)
    );
    match (file.angle_deg, file.spread_deg) {
        (Some(angle), Some([low, high])) => {
            let seeds = count(file.measured, "heap");
            page.title(
                &name,
                format!("angle of repose {angle:.1}° ({low:.1}° to {high:.1}° over {seeds})"),
                Role::Value,
            );
        }
        _ => {
            let why = file.no_angle.as_deref().unwrap_or("not measured");
            page.title(&name, format!("no angle of repose: {why}"), Role::Unsure);
        }
    }
    if options.brief {
        return page;
    }
    page.blank();
    page.paragraph("Seen in time, not proved: the slope that flowing grains left behind, a straight line through the highest grains.");
    page.blank();
    page.row("heaps", file.heaps.iter().map(row));
    page.row("margin", file.heaps.iter().filter_map(margin));
    let [length, width] = p.size().map(short);
    page.row("size", [format!("{length} × {width} d, d = {} m", short(p.diameter))]);
    page.row(
        "note",
        file.heaps
            .iter()
            .flat_map(|h| h.warnings.iter().map(move |w| format!("seed {}: {}", h.seed, w.text))),
    );
    page.row(
        "contacts",
        [format!("restitution {}, no damping beside the contacts'", short(file.restitution))],
    );
    page
}

fn row(h: &HeapResult) -> String {
    let slope = match (h.angle_deg, h.r_squared) {
        (Some(angle), Some(r)) => format!("{angle:.1}°, R² {r:.3}, {} cells", h.cells),
        (None, Some(r)) => format!("no angle (R² {r:.3}, {} cells)", h.cells),
        _ => "no angle".into(),
    };
    let ends = (
        h.parts_deg.iter().copied().fold(f64::INFINITY, f64::min),
        h.parts_deg.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    );
    let parts = if h.parts_deg.is_empty() {
        String::new()
    } else {
        format!(", parts {:.1}° to {:.1}°", ends.0, ends.1)
    };
    let flowed = h.avalanche_deg.map(|a| format!(", flowed at {a:.1}°")).unwrap_or_default();
    let rest = if h.rested { "at rest" } else { "STILL MOVING" };
    format!(
        "seed {}: {slope}{parts}{flowed}; {rest} after {:.0} √(d/g); {} grains stayed, {} fell over the edge; {}",
        h.seed,
        h.time,
        h.grains,
        h.discarded,
        seconds(h.seconds)
    )
}

fn margin(h: &HeapResult) -> Option<String> {
    let m = h.margin.as_ref()?;
    let value = match m.margin_deg {
        Some(deg) if deg < 0.0 => format!("none: short of standing by {:.2}°", -deg),
        Some(deg) => format!("bears {deg:.2}° more"),
        None => format!("{:?}", m.status).to_lowercase(),
    };
    Some(format!(
        "seed {}: {value} ({} contacts, {} loose grains and {} out of balance left out; {})",
        h.seed,
        m.contacts,
        m.loose,
        m.unbalanced,
        seconds(m.seconds[0] + m.seconds[1])
    ))
}
