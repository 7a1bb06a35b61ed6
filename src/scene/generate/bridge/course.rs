//! Piers, and the course of the upper surface of a bridge: the chords of the extrados and the tops of
//! the piers, from left to right.

use super::{
    backing::Masonry,
    chord::Chord,
    plan::{PierPlan, Plan, SpanPlan, voussoir},
};
use crate::{
    generate::check::TemplatePath,
    template::{Bridge, BridgePier},
};
use base::error::InputError;

/// The upper surface of a bridge: of the backing where it is masonry.
pub(super) fn chords(bridge: &Bridge, plan: &Plan, masonry: Option<&Masonry>) -> Vec<Chord> {
    let mut list = Vec::new();
    let ends = masonry.and_then(|m| m.ends.as_ref());
    list.extend(ends.and_then(|[left, _]| left.chord()));
    for (s, span) in plan.spans.iter().enumerate() {
        let backed = [s > 0 || ends.is_some(), s + 1 < plan.spans.len() || ends.is_some()];
        let last = span.rings.len() - 1;
        let n = span.rings[last].voussoirs.len();
        for (v, polygon) in span.rings[last].voussoirs.iter().enumerate() {
            let placed = span.placed(polygon);
            let [.., to, from] = placed[..] else { continue };
            let rise = to[1] - from[1];
            let is_level = rise.abs() <= base::tolerance::GRID_SNAP * (to[0] - from[0]).abs();
            let towards = if is_level { 0.0 } else { rise.signum() };
            let chord = Chord { block: voussoir(bridge, s, last, v, n), from, to, towards };
            match masonry {
                Some(masonry) => list.extend(masonry.above(chord, backed)),
                None => list.push(chord),
            }
        }
        if let Some(over) = masonry.and_then(|m| m.piers.get(s)) {
            list.extend(over.chord());
            continue;
        }
        let Some(pier) = plan.piers.get(s) else { continue };
        let [.., right, left, _] = pier.body[..] else { continue };
        if right[0] > left[0] {
            let block = format!("pier_{}", s + 1);
            list.push(Chord { block, from: left, to: right, towards: 0.0 });
        }
    }
    list.extend(ends.and_then(|[_, right]| right.chord()));
    list
}

/// A pier with its left springing at `edge`; its last points are the right and the left end of its top
/// and the left springing.
fn pier(
    place: &TemplatePath,
    pier: &BridgePier,
    spans: [&SpanPlan; 2],
    edge: f64,
) -> Result<PierPlan, InputError> {
    place.length("width", pier.width)?;
    place.length("height", pier.height)?;
    let foot = pier.foot.unwrap_or(pier.width);
    place.length("foot", foot)?;
    let reach = [spans[0].springing(1), spans[1].springing(0)];
    if reach[0][0] + reach[1][0] > pier.width {
        return Err(place.error(
            "width",
            format!(
                "the rings beside it cover {} m and {} m of its {} m",
                reach[0][0], reach[1][0], pier.width
            ),
            "make it wider, or the rings thinner",
        ));
    }
    if reach[0][1] != reach[1][1] && reach[0][0] + reach[1][0] == pier.width {
        return Err(place.error("width", "its top would have a step", "make it wider"));
    }
    let (middle, right) = (edge + 0.5 * pier.width, edge + pier.width);
    let (low, below) = (-pier.height, -pier.height - 0.5 * pier.width);
    let [at_left, at_right] = [middle - 0.5 * foot, middle + 0.5 * foot];
    let mut body = vec![[at_left, low], [at_right, low], [right, 0.0]];
    body.push([right - reach[1][0], reach[1][1]]);
    body.push([edge + reach[0][0], reach[0][1]]);
    body.push([edge, 0.0]);
    let [outer_left, outer_right] = [at_left - 0.5 * pier.width, at_right + 0.5 * pier.width];
    let footing =
        vec![[outer_left, below], [outer_right, below], [outer_right, low], [outer_left, low]];
    Ok(PierPlan { body, footing })
}

impl Plan {
    pub fn of(bridge: &Bridge) -> Result<Self, InputError> {
        let place = TemplatePath::template("bridge");
        place.length("width", bridge.width)?;
        place.count("spans", bridge.spans.len(), 1)?;
        if bridge.piers.len() + 1 != bridge.spans.len() {
            return Err(place.error(
                "piers",
                format!(
                    "must have one pier fewer than spans: {} spans need {}, got {}",
                    bridge.spans.len(),
                    bridge.spans.len() - 1,
                    bridge.piers.len()
                ),
                "give one pier between each two spans",
            ));
        }
        let counts: Option<usize> = bridge
            .spans
            .iter()
            .try_fold(0_usize, |n, s| n.checked_add(s.rings.checked_mul(s.voussoirs)?));
        place.total("spans", &[counts.unwrap_or(usize::MAX)])?;
        let mut spans = Vec::new();
        for (k, span) in bridge.spans.iter().enumerate() {
            spans.push(SpanPlan::of(&TemplatePath(place.0.key("spans").index(k)), span)?);
        }
        let clear: f64 = spans.iter().map(|s: &SpanPlan| s.clear_span).sum();
        let total = clear + bridge.piers.iter().map(|p| p.width).sum::<f64>();
        let mut edge = -0.5 * total;
        let mut piers = Vec::new();
        for k in 0..spans.len() {
            let half = 0.5 * spans[k].clear_span;
            spans[k].center = edge + half;
            edge += 2.0 * half;
            let Some(own) = bridge.piers.get(k) else { break };
            let place = TemplatePath(place.0.key("piers").index(k));
            piers.push(pier(&place, own, [&spans[k], &spans[k + 1]], edge)?);
            edge += own.width;
        }
        Ok(Self { spans, piers })
    }
}
