//! Whether a line through a surface is an angle of repose, or an artefact of how it was made.
//!
//! A straight line goes through any few points. It is called a slope only where it was fitted to
//! enough cells, explains them, falls by more than a grain, does not end where box or floor do, and
//! is the same all around and all the way down. Whatever fails is named; all thresholds are here.

use super::surface::{CELL, Fit, Reading};
use scene::{GrainKind, Protocol, ProtocolKind};

/// Fewest cells of the mean surface. Fewer: a default heap of 500 grains has four or five, and its
/// seeds scatter by 3°. More: the heap of 2,000 grains that other codes are compared on has eight
/// to nine.
pub const FEWEST_CELLS: usize = 8;
/// Least share of the heights' variance that the line explains. Less: a surface of which a third
/// is level passes. More: rough sound heaps, whose lines explain 0.96 and more, are refused.
pub const LEAST_R_SQUARED: f64 = 0.95;
/// Least fall of the line between its ends, d. Less: a bed that never flowed has the slope of its
/// roughness. More: grains without friction, which lie at some 6°, have none.
pub const LEAST_FALL: f64 = 1.0;
/// Parts may differ from their mean by so many of their spreads: standard errors of their angle.
/// Fewer: sound heaps are refused; of nine of
/// 1,000 and 2,000 grains the parts differed by 0.8 to 3.5. More: a heap that is 6° steeper on
/// one side than on the other passes.
pub const MOST_SPREADS: f64 = 4.0;
/// The same for the upper and the lower half of the slope, which have half the cells and so twice
/// the spread and more. Fewer: sound heaps, whose halves differed by 0.9 of them, are refused.
/// More: a surface of which half is level passes. A level crest of a quarter is within what grains
/// do, and passes; it makes the slope flatter by some degrees at most.
pub const MOST_BENT: f64 = 2.0;
/// A height is known to no better than this, d: a cell's highest grain lies anywhere between the
/// grains below it. Less: a part of few cells that happen to lie on a line has no spread at all.
/// More: sides that differ by what grains do not explain pass.
pub const LEAST_SCATTER: f64 = 0.3;
/// Densest packing of poured spheres (random close packing; Scott 1960 measured 0.637). Less: the
/// bed counts as higher than it was, and a level crest passes. More: a slope that ends below the
/// crest is refused.
pub const DENSEST: f64 = 0.64;

/// The reasons why a surface has no angle of repose; none where it has one.
pub(super) fn refuse(protocol: &Protocol, reading: &Reading, gone: usize) -> Vec<String> {
    let d = protocol.diameter;
    let mut reasons = Vec::new();
    let cells = reading.mean.as_ref().map_or(0, |f| f.slope.cells);
    if cells < FEWEST_CELLS {
        let found = if cells == 0 { "fewer than 3".into() } else { format!("only {cells}") };
        reasons.push(format!(
            "{found} cells of the surface lie between wall and toe, {FEWEST_CELLS} are needed: use more grains"
        ));
    }
    let Some(fit) = &reading.mean else { return reasons };
    let r = fit.slope.r_squared;
    if r < LEAST_R_SQUARED {
        reasons.push(format!(
            "a straight line explains only {r:.3} of the surface (R²), {LEAST_R_SQUARED} is needed"
        ));
    }
    if fit.fall() < LEAST_FALL * d || fit.slope.angle_deg <= 0.0 {
        reasons.push(format!(
            "the surface falls by {:.2} d only: it is level apart from its grains",
            fit.fall() / d * fit.slope.angle_deg.signum()
        ));
    }
    reasons.extend(cut(protocol, fit, gone));
    let sides = match protocol.kind {
        ProtocolKind::Funnel | ProtocolKind::Cylinder => "sectors",
        _ => "strips",
    };
    reasons.extend(differ(sides, reading.parts.iter(), d, MOST_SPREADS));
    if cells >= FEWEST_CELLS {
        let (upper, lower) = fit.cells.split_at(cells / 2);
        let turned = turn(fit);
        let halves: Vec<Fit> =
            [upper, lower].iter().filter_map(|c| Fit::through(c, turned)).collect();
        reasons.extend(differ("the upper and the lower half", halves.iter(), d, MOST_BENT));
    }
    reasons
}

/// What box or floor did to the slope.
fn cut(protocol: &Protocol, fit: &Fit, gone: usize) -> Option<String> {
    let d = protocol.diameter;
    match protocol.kind {
        ProtocolKind::Drain => {
            let [(x0, z0), (x1, z1)] = fit.ends;
            let crest = z0 - (z1 - z0) / (x1 - x0) * x0;
            let filled = filled(protocol);
            (crest > filled * d).then(|| {
                format!(
                    "cut by the wall: the line reaches {:.1} d at the back wall, and the box was filled to {filled:.1} d only: use a shorter or narrower box",
                    crest / d
                )
            })
        }
        ProtocolKind::Funnel | ProtocolKind::Cylinder => (gone > 0)
            .then(|| format!("cut by the edge of the floor, over which {gone} grains fell")),
        // Closed: it begins and ends at a wall, whose cells are left out. Others leave no slope.
        _ => None,
    }
}

/// Why a box shows no angle of repose however its grains flow; nothing where it may. The cell at the wall is
/// left out, and the last one is the toe of any slope up to 45°.
pub fn foretold(protocol: &Protocol) -> Option<String> {
    let [length, _] = protocol.size();
    let most = ((length / CELL).ceil() as usize).saturating_sub(2);
    (protocol.kind == ProtocolKind::Drain && most < FEWEST_CELLS).then(|| {
        format!(
            "a box {length:.1} d long leaves at most {most} cells of its surface between wall and toe, and an angle of repose needs {FEWEST_CELLS}: take grains=2000 or more, or size=[LENGTH,WIDTH] with at least {} d and grains to fill it",
            CELL * (FEWEST_CELLS + 2) as f64
        )
    })
}

/// Least height of the bed before its wall is taken away, d.
fn filled(protocol: &Protocol) -> f64 {
    let [length, width] = protocol.size();
    // Grains of every kind have the volume of a sphere.
    let volume = std::f64::consts::PI / 6.0 * protocol.sizes.mean_volume(protocol.diameter);
    let densest = match protocol.grain {
        GrainKind::Sphere => DENSEST,
        // Grains that are longer than wide lie closer (Donev et al. 2004 have 0.735 at most).
        GrainKind::Clump | GrainKind::Hull => 0.735,
    };
    protocol.grains as f64 * volume / (densest * length * width)
}

/// Whether angles differ by more than their spread.
fn differ<'a>(
    name: &str,
    parts: impl Iterator<Item = &'a Fit>,
    d: f64,
    most: f64,
) -> Option<String> {
    // Through three cells a line has one degree of freedom left: no spread to speak of.
    let parts: Vec<&Fit> = parts.filter(|p| p.slope.cells > 3).collect();
    let n = parts.len() as f64;
    let mean = parts.iter().map(|p| p.slope.angle_deg).sum::<f64>() / n;
    let error = |p: &&Fit| {
        let slope = p.scatter.max(LEAST_SCATTER * d) / p.spread;
        (slope * p.slope.angle_deg.to_radians().cos().powi(2)).to_degrees()
    };
    let worst = parts
        .iter()
        .map(|p| ((p.slope.angle_deg - mean).abs() / error(p), p.slope.angle_deg, error(p)))
        .max_by(|a, b| a.0.total_cmp(&b.0))?;
    (worst.0 > most).then(|| {
        format!(
            "{name} differ by more than their spread: one is {:+.1}° from their mean, {:.1} times \
             its standard error of {:.1}°",
            worst.1 - mean,
            worst.0,
            worst.2
        )
    })
}

/// How far the bed of a fit was turned, radians.
fn turn(fit: &Fit) -> f64 {
    let [(x0, z0), (x1, z1)] = fit.ends;
    fit.slope.angle_deg.to_radians() + (z1 - z0).atan2(x1 - x0)
}
