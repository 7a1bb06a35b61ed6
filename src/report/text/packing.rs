//! Packings for people: the least tilt, every direction, and how the packing carries its load.

use super::{Layout, Page, SHOWN, TextOptions, cut, page::Role};
use analysis::{
    Fabric, Outcome,
    coulomb::Found,
    fabric::{FORCE_BIN, FORCE_BINS},
};
use base::number::{count, point, rounded_down, seconds, short};
use check::proof::packing::{PackingDirection, PackingFile};

/// The answer about a packing as a page.
pub fn packing(file: &PackingFile, options: TextOptions, layout: Layout) -> Page {
    let mut page = Page::new(layout);
    let Some(least) = file.directions.get(file.least) else { return page };
    let role = if least.governing().is_finite() { Role::Value } else { Role::Unsure };
    let text = format!("{}, towards {}", angle(least), point(least.toward));
    let text = match file.left_out.iter().find(|l| l.contains("without a contact path")) {
        Some(loose) => format!("{text}; {loose} left out"),
        None => text,
    };
    let text = match &file.doubt {
        Some(doubt) => format!("{text}: {}; {}", doubt.evidence, doubt.next),
        None => text,
    };
    page.title(&file.name, text, role);
    if options.brief {
        return page;
    }
    page.blank();
    let what = if file.moving_mass > 0.0 {
        format!(
            "The least tilt of gravity at which at least {} % of the mass of the free grains loses balance.",
            short(100.0 * file.moving_mass)
        )
    } else {
        "The least tilt of gravity at which the first grain loses balance.".to_string()
    };
    page.paragraph(&format!("{what} The bound holds for joints that open as they slide, and for dry friction as an upper bound."));
    page.blank();
    page.row("moves", [moves(least)]);
    page.row("moves in", least.part.iter().map(ToString::to_string));
    page.row(
        "directions",
        cut(&file.directions.iter().map(row).collect::<Vec<_>>(), SHOWN + 2, options),
    );
    page.row("fabric", file.fabric.iter().flat_map(|f| self::fabric(f, options)));
    page.row("forces", file.fabric_forces.clone());
    page.row(
        "packing",
        [format!("{}, {}", count(file.grains, "free grain"), count(file.contacts, "contact"))],
    );
    page.row("doubt", file.doubt.iter().map(|d| format!("{}; {}", d.evidence, d.next)));
    page.row("left out", cut(&file.left_out, SHOWN, options));
    page.row(
        "note",
        cut(&file.warnings.iter().map(|f| f.text.clone()).collect::<Vec<_>>(), 3, options),
    );
    let t = &file.timings;
    page.row(
        "time",
        [format!(
            "contacts {}, solve {}, check {}",
            seconds(t.detect),
            seconds(t.solve),
            seconds(t.check)
        )],
    );
    page
}

fn angle(d: &PackingDirection) -> String {
    let bound = match (d.status, d.tilt_deg, d.bracket_deg) {
        (Outcome::Found, Some(tilt), Some(_)) => rounded_down(tilt),
        (Outcome::Unbounded, ..) => {
            return dry(d).map_or("wedged: stands at every tilt below 90°".into(), |v| {
                format!("{}° with dry friction, else wedged", rounded_down(v))
            });
        }
        (Outcome::Impossible, ..) => return "falls, however it is tilted".into(),
        _ => return "undecided".into(),
    };
    match (d.dry, dry(d)) {
        (Some(Found::NotAtRest), _) if d.bracket_deg.is_some_and(|[_, upper]| upper < 0.0) => {
            format!("falls even when level, at most {bound}°")
        }
        (Some(Found::NotAtRest), _) => {
            format!("moves even when level with dry friction, at most {bound}° with self-stress")
        }
        (Some(Found::NothingSlides), _) => format!("{bound}°, with dry friction as well"),
        (_, Some(v)) => format!("{}° with dry friction, at most {bound}°", rounded_down(v)),
        (Some(_), None) => format!("at most {bound}°; with dry friction undecided"),
        (None, None) => format!("{bound}° at most"),
    }
}

fn dry(d: &PackingDirection) -> Option<f64> {
    d.dry_deg
}

fn moves(d: &PackingDirection) -> String {
    let [hinge, slide, part] = d.joints;
    let before = match d.removed.len() {
        0 => String::new(),
        rounds => {
            let taken: usize = d.removed.iter().map(|r| r.grains.len()).sum();
            let first = d
                .removed
                .first()
                .and_then(|r| r.tilt_deg)
                .map(|t| format!(", the first at {}°", short(t)))
                .unwrap_or_default();
            format!("; {} in {} in all{first}", count(taken, "grain"), count(rounds, "round"))
        }
    };
    let short_of = if d.reached { "" } else { ", less than was asked for" };
    format!(
        "{} at once; {} % of the mass in all{short_of}; {hinge} contacts roll, {slide} slide, {part} part{before}",
        count(d.moving.len(), "grain"),
        short(100.0 * d.moved)
    )
}

fn row(d: &PackingDirection) -> String {
    format!(
        "towards {}: {}; {} % of the mass moves",
        point(d.toward),
        angle(d),
        short(100.0 * d.moved)
    )
}

fn fabric(f: &Fabric, options: TextOptions) -> Vec<String> {
    let [x, y, z] = [0, 1, 2].map(|k| short(f.tensor[k][k]));
    let [sx, sy, sz] = [0, 1, 2].map(|k| short(f.stress[k][k]));
    let mut rows = vec![
        format!(
            "{} contacts, {} a grain (geometric); {} carry: {} a grain, {} without {} on top",
            f.touching,
            short(f.geometric_coordination),
            f.contacts,
            short(f.coordination),
            short(f.coordination_without_rattlers),
            count(f.rattlers, "grain")
        ),
        format!("fabric tensor xx {x}, yy {y}, zz {z}; anisotropy {}", short(f.anisotropy)),
        format!(
            "normal force {} N in the mean, {} times that at most",
            short(f.mean_force),
            short(f.greatest_force)
        ),
        format!("mean stress in the grains xx {sx}, yy {sy}, zz {sz} Pa"),
    ];
    if let (Some(used), Some(sliding)) = (f.mobilised, f.sliding) {
        rows.push(format!(
            "{} % of the friction is used in the mean, {} % of the contacts are about to slide",
            short(100.0 * used),
            short(100.0 * sliding)
        ));
    }
    if options.verbose {
        let share = |bins: &[f64]| {
            bins.iter().map(|s| format!("{:.1}", 100.0 * s)).collect::<Vec<_>>().join(" ")
        };
        rows.push(format!(
            "contacts (%) by the angle of their normal to gravity, equal solid angles from 0° to 90°: {}",
            share(&f.normals)
        ));
        let last = FORCE_BIN * (FORCE_BINS - 1) as f64;
        rows.push(format!("contacts (%) by normal force over the mean, steps of {FORCE_BIN}, the last from {last}: {}", share(&f.forces)));
    }
    rows
}
