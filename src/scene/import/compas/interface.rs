//! Interfaces stored on the edges of a COMPAS graph.
//!
//! `edge[u][v]` holds `interfaces` (a list; one value under `interface` in older files), `contacts`
//! (BlockModel) or, in the oldest files, `interface_points` and `interface_uvw`. The frame's third
//! axis, xaxis × yaxis, is the normal. The files of the COMPAS family turn it from `u` into `v`,
//! which is our convention, while the corners run clockwise around it; it is therefore kept as
//! stored rather than guessed from the corners, unless it is not the normal of the polygon at all.

use super::cursor::{Cursor, describe};
use crate::{
    InterfaceSpec,
    import::raw::{Raw, tally},
};
use base::{
    error::{FindingCode, InputError},
    tolerance,
};
use nalgebra::Vector3;
use std::collections::HashMap;

/// Node key → (place in the list of blocks, id).
pub(super) type Ids = HashMap<String, (usize, String)>;

/// What was odd, by kind.
#[derive(Default)]
struct Odd {
    degenerate: Vec<String>,
    twice: Vec<String>,
    skew: Vec<String>,
    backwards: Vec<String>,
}

/// Reads the interfaces of all edges into `raw`, sorted by the places of their blocks.
pub(super) fn read(edges: &Cursor, ids: &Ids, raw: &mut Raw) -> Result<(), InputError> {
    let centres: Vec<Vector3<f64>> = raw.blocks.iter().map(|b| mean(&b.vertices)).collect();
    let mut odd = Odd::default();
    let mut found: Vec<(usize, usize, InterfaceSpec)> = Vec::new();
    let mut seen: HashMap<(usize, usize), Vec<Vec<[f64; 3]>>> = HashMap::new();
    for (u, neighbours) in edges.members()? {
        for (v, attributes) in neighbours.members()? {
            let stored = stored(&attributes)?;
            if stored.is_empty() {
                continue;
            }
            let block = |key: &str| {
                ids.get(key).ok_or_else(|| {
                    attributes
                        .error(format!("an interface with node {key:?}, which has no block"))
                        .hint("export the assembly again")
                })
            };
            let ((i, a), (j, b)) = (block(u)?, block(v)?);
            if i == j {
                return Err(attributes
                    .error(format!("an interface of block {a:?} with itself"))
                    .hint("remove this edge from the graph"));
            }
            for (at, points, axes) in stored {
                let name = format!("{a:?}–{b:?}");
                let polygon = plane(&points);
                if (points.len() >= 3 && polygon.is_none())
                    || points.is_empty()
                    || (points.len() < 3 && axes.is_none())
                {
                    odd.degenerate.push(format!("{name} ({} corners)", points.len()));
                    continue;
                }
                // A graph with both directions of an edge would count the contact twice.
                let mut sorted = points.clone();
                sorted.sort_by(|p, q| p.partial_cmp(q).unwrap_or(std::cmp::Ordering::Equal));
                let pair = seen.entry((*i.min(j), *i.max(j))).or_default();
                if pair.contains(&sorted) {
                    odd.twice.push(name);
                    continue;
                }
                pair.push(sorted);
                let limit = tolerance::CONTACT_ANGLE_DEG.to_radians().cos();
                let normal = match (axes, polygon) {
                    (Some(n), Some(p)) if n.dot(&p).abs() < limit => {
                        odd.skew.push(format!(
                            "{name} ({:.1}°)",
                            n.dot(&p).abs().min(1.0).acos().to_degrees()
                        ));
                        None
                    }
                    (normal, _) => normal,
                };
                if normal.is_some_and(|n| n.dot(&(centres[*j] - centres[*i])) < 0.0) {
                    odd.backwards.push(name);
                }
                raw.with_forces += usize::from(
                    at.get("forces").and_then(|f| f.items()).is_some_and(|f| !f.is_empty()),
                );
                let between = [a.clone(), b.clone()];
                found.push((
                    *i,
                    *j,
                    InterfaceSpec {
                        between,
                        points,
                        normal: normal.map(Into::into),
                        friction: None,
                    },
                ));
            }
        }
    }
    found.sort_by_key(|(i, j, _)| (*i, *j));
    raw.interfaces = found.into_iter().map(|(_, _, interface)| interface).collect();
    say(&odd, raw);
    Ok(())
}

/// The interfaces on an edge: where each is, its corners, and its normal where it has a frame.
type Stored<'a> = Vec<(Cursor<'a>, Vec<[f64; 3]>, Option<Vector3<f64>>)>;

fn stored<'a>(edge: &Cursor<'a>) -> Result<Stored<'a>, InputError> {
    if edge.value().is_null() {
        return Ok(Vec::new());
    }
    if edge.has("interface_points") {
        let axes = edge.get("interface_uvw").and_then(|a| a.items()).filter(|a| a.len() == 3);
        let normal = axes
            .map(|a| Ok((a[0].point()?, a[1].point()?)))
            .transpose()?
            .and_then(|(u, v)| cross(u, v));
        return Ok(vec![(edge.clone(), points(&edge.need("interface_points")?)?, normal)]);
    }
    let Some(all) = ["interfaces", "interface", "contacts"].into_iter().find_map(|k| edge.get(k))
    else {
        return Ok(Vec::new());
    };
    let mut stored = Vec::new();
    for at in all.items().unwrap_or_else(|| vec![all.clone()]) {
        let at = at.open();
        let frame = at
            .get("frame")
            .map(|f| Ok::<_, InputError>((f.need("xaxis")?.point()?, f.need("yaxis")?.point()?)))
            .transpose()?;
        let corners = at.get("points").map_or(Ok(Vec::new()), |p| points(&p))?;
        stored.push((at, corners, frame.and_then(|(x, y)| cross(x, y))));
    }
    Ok(stored)
}

fn points(at: &Cursor) -> Result<Vec<[f64; 3]>, InputError> {
    let list = at.items().ok_or_else(|| {
        at.error(format!("expected a list of points, got {}", describe(at.value())))
            .hint("leave the stored interfaces out")
    })?;
    list.iter().map(Cursor::point).collect()
}

/// The unit vector along x × y; none where the axes do not span a plane.
fn cross(x: [f64; 3], y: [f64; 3]) -> Option<Vector3<f64>> {
    Vector3::from(x)
        .cross(&Vector3::from(y))
        .try_normalize(f64::MIN_POSITIVE)
        .filter(|n| n.iter().all(|c| c.is_finite()))
}

/// The unit normal of a polygon by its vector area (Newell); none for fewer than three corners or a
/// degenerate polygon.
fn plane(points: &[[f64; 3]]) -> Option<Vector3<f64>> {
    let first = Vector3::from(*points.first()?);
    let spokes: Vec<Vector3<f64>> = points.iter().map(|p| Vector3::from(*p) - first).collect();
    let area = spokes.windows(2).map(|pair| pair[0].cross(&pair[1])).sum::<Vector3<f64>>() / 2.0;
    let reach = spokes.iter().map(Vector3::norm).fold(0.0, f64::max);
    // The reach from one corner is at least half the diameter.
    let sliver = area.norm() <= tolerance::STORED_POLYGON_AREA * 4.0 * reach * reach;
    if sliver || !area.norm().is_finite() { None } else { area.try_normalize(0.0) }
}

fn mean(points: &[[f64; 3]]) -> Vector3<f64> {
    points.iter().map(|p| Vector3::from(*p)).sum::<Vector3<f64>>() / points.len().max(1) as f64
}

fn say(odd: &Odd, raw: &mut Raw) {
    let mut report = |code, names: &[String], what: &str| {
        if !names.is_empty() {
            raw.say(code, format!("stored interfaces {what}: {}", tally(names)));
        }
    };
    let least = tolerance::STORED_POLYGON_AREA;
    let angle = tolerance::CONTACT_ANGLE_DEG;
    report(
        FindingCode::LeftOut,
        &odd.degenerate,
        &format!(
            "without a definite plane (no frame, or an area below {least:e} × diameter²), left out"
        ),
    );
    report(FindingCode::LeftOut, &odd.twice, "that are in the file twice, used once");
    report(
        FindingCode::Mended,
        &odd.skew,
        &format!(
            "whose frame is not normal to the polygon (by more than {angle}°), given the polygon's normal"
        ),
    );
    report(
        FindingCode::Converted,
        &odd.backwards,
        "whose normal points from the second block's centre to the first's, kept as stored, which is right for interlocking blocks only",
    );
}
