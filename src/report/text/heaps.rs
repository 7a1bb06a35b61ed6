//! Angles of repose for people.

use super::{Layout, Page, TextOptions, page::Role};
use crate::heaps::{HeapResult, ReposeFile};
use analysis::repose::seen::{Compressed, Flown, Seen, Steady};
use base::number::{count, seconds, short};
use scene::{Protocol, ProtocolKind};
use sweep::Mean;

/// The answer about heaps as a page.
pub fn heaps(file: &ReposeFile, options: TextOptions, layout: Layout) -> Page {
    let mut page = Page::new(layout);
    let p = &file.protocol;
    let name = format!(
        "{:?} of {} {}, friction {}",
        p.kind,
        file.grains(),
        p.grain.plural(),
        short(p.friction)
    );
    match (file.angle_deg, file.spread_deg) {
        (Some(angle), Some(_)) => {
            page.title(&name, format!("angle of repose {angle:.1}°{}", known(file)), Role::Value);
        }
        _ if !file.figures.is_empty() => {
            let over = count(file.measured, "run");
            let figures = file.figures.iter().take(2);
            let list: Vec<String> = figures.map(|f| f.says(file.measured)).collect();
            page.title(&name, format!("{} over {over}", list.join(", ")), Role::Value);
        }
        _ => {
            let why = file.no_angle.as_deref().unwrap_or("not measured");
            let what = if p.kind.leaves_a_slope() { "no angle of repose" } else { "no figure" };
            page.title(&name, format!("{what}: {why}"), Role::Unsure);
        }
    }
    if options.brief {
        return page;
    }
    page.blank();
    let seen = match p.kind {
        ProtocolKind::Drum => "the slope of the middle half of its surface as it turns",
        ProtocolKind::Hopper => {
            "what ran out of the hole between 0.1 and 0.5 of what was filled in, beside Beverloo's 0.58 ρ √g (D − 1.4 d)^2.5"
        }
        ProtocolKind::Shear => {
            "shear over normal force on the plane between the halves, and how the lid rises"
        }
        ProtocolKind::Cell => {
            "shear over normal stress in a periodic cell at constant pressure, from a shear strain of 1 to one of 5"
        }
        _ => {
            "the slope that flowing grains left behind, a straight line through the highest grains"
        }
    };
    page.paragraph(&format!("Seen in time, not proved: {seen}."));
    page.blank();
    if p.kind.leaves_a_slope() {
        page.row("heaps", file.heaps.iter().map(row));
    } else {
        page.row("runs", file.heaps.iter().flat_map(run));
    }
    if p.kind == ProtocolKind::Shear {
        let ends = "the ends of the box carry part of the shear: ask with two lengths and extrapolate in 1 / length";
        page.row("ends", [ends.to_string()]);
    }
    if let (Some([low, high]), true) = (file.spread_deg, file.measured > 1) {
        page.row("spread", [format!("{low:.1}° to {high:.1}° over the seeds")]);
    }
    page.row("margin", file.heaps.iter().filter_map(margin));
    page.row("size", [size(p)]);
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
    page.row(
        "rolling",
        (p.rolling_arm > 0.0).then(|| {
            format!(
                "arm {} d: coefficient {} of the radius R, {} of the reduced radius of two equal grains",
                short(p.rolling_arm),
                short(file.rolling_friction),
                short(2.0 * file.rolling_friction)
            )
        }),
    );
    page
}

/// How large it is.
fn size(p: &Protocol) -> String {
    let d = format!("d = {} m", short(p.diameter));
    if p.kind == ProtocolKind::Cell {
        let pressure = short(p.pressure);
        return format!("{d}, pressure {pressure} ρ g d, stiffness κ = {}", short(p.stiffness));
    }
    let [length, width] = p.size().map(short);
    format!("{length} × {width} d, {d}")
}

/// How well the angle is known.
pub(crate) fn known(file: &ReposeFile) -> String {
    let Some(Mean { error, interval: [low, high] }) = file.known_deg else { return String::new() };
    let of = match file.measured {
        1 => "from the fit of one heap: other seeds may lie outside".into(),
        n => count(n, "heap"),
    };
    format!(" ± {error:.1}° (95 % interval {low:.1}° to {high:.1}°, {of})")
}

/// What one run showed.
fn run(h: &HeapResult) -> Vec<String> {
    let with = |s: &Steady| format!("{} ± {}", short(s.mean), short(s.error));
    let what = match &h.seen {
        None => vec!["nothing".into()],
        Some(Seen::Drum { angle_deg, by_centre_deg, wavers_deg, froude, .. }) => vec![
            format!("dynamic angle {}°, wavers by {}°", with(angle_deg), short(*wavers_deg)),
            format!(
                "by the centre of mass {}°; ω² R / g = {}",
                with(by_centre_deg),
                short(*froude)
            ),
        ],
        Some(Seen::Hopper { rate, bulk_density, beverloo, .. }) => vec![
            format!("{} kg/s, Beverloo {} kg/s", with(rate), short(*beverloo)),
            format!("bulk {} kg/m³", short(*bulk_density)),
        ],
        Some(Seen::Shear {
            peak, peak_at, residual, dilatancy_deg, rise, normal_stress, ..
        }) => vec![
            format!(
                "residual {}, peak {} after {} m",
                with(residual),
                short(*peak),
                short(*peak_at)
            ),
            format!(
                "dilatancy {}°, rise {} m, normal stress {} Pa",
                short(*dilatancy_deg),
                short(*rise),
                short(*normal_stress)
            ),
        ],
        Some(Seen::Cell(flown)) => flow(flown),
    };
    if matches!(h.seen, Some(Seen::Cell(_))) {
        let last = format!("{:.0} √(d/g), {}", h.time, seconds(h.seconds));
        return told(h.seed, what.into_iter().chain([last]));
    }
    let last = format!(
        "{:.0} √(d/g); {} grains stayed, {} fell out; {}",
        h.time,
        h.grains,
        h.discarded,
        seconds(h.seconds)
    );
    told(h.seed, what.into_iter().chain([last]))
}

/// The flow in a cell.
fn flow(f: &Flown) -> Vec<String> {
    let with = |s: &Steady| format!("{} ± {}", short(s.mean), short(s.error));
    let Compressed { solid_fraction, coordination, backbone } = f.compressed;
    vec![
        format!(
            "internal friction {} ({:.2}°), peak {}; inertial number {}",
            with(&f.friction),
            f.friction.mean.atan().to_degrees(),
            short(f.peak),
            short(f.inertial_number)
        ),
        format!("published {}: {}", short(f.published.friction), f.published.source),
        format!(
            "solid fraction {}, {} contacts a grain",
            with(&f.solid_fraction),
            with(&f.coordination)
        ),
        format!(
            "before, compressed: {}, {} contacts a grain, {} among those that bear",
            short(solid_fraction),
            short(coordination),
            short(backbone)
        ),
        format!(
            "restitution {}; overlaps of at most {} d, {:.1} steps in the shortest period of a contact",
            short(f.restitution),
            short(f.overlap),
            f.steps
        ),
    ]
}

fn told(seed: u64, lines: impl Iterator<Item = String>) -> Vec<String> {
    let line = |(k, t)| if k == 0 { format!("seed {seed}: {t}") } else { format!("  {t}") };
    lines.enumerate().map(line).collect()
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
        Some(deg) => format!("bears at most {deg:.2}° more (bound)"),
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
