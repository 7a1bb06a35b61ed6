//! The bridge: rings between springers and piers, and what the fill does to every chord of their
//! extrados.

mod backing;
mod chord;
mod course;
mod fill;
mod pressure;
mod said;

pub use fill::{Spread, Surface, loads, soil};
pub use said::said;

use super::{
    arch::{Section, radial_rings, ring_between},
    check::TemplatePath,
    midline::{Fields, Xz, mirror},
    numbered, support,
    surveyed::Surveyed,
};
use crate::{
    BlockSpec, Shape,
    template::{Bridge, BridgeSpan, Profile},
};
use backing::Masonry;
use base::error::InputError;

/// A bridge in its plane, about the origin of the template.
struct Plan {
    spans: Vec<SpanPlan>,
    piers: Vec<PierPlan>,
}

struct SpanPlan {
    /// From inside out.
    rings: Vec<Section>,
    /// Where x = 0 of the sections lies.
    center: f64,
    /// How far the sections are moved up.
    up: f64,
    /// Distance between the springings of the intrados, m.
    clear_span: f64,
    /// The crown of the intrados: x from the middle between the springings, height over them, m.
    crown: Xz,
}

struct PierPlan {
    body: Vec<Xz>,
    footing: Vec<Xz>,
}

pub fn blocks(bridge: &Bridge) -> Result<Vec<BlockSpec>, InputError> {
    let plan = Plan::of(bridge)?;
    let masonry = Masonry::of(bridge, &plan)?;
    fill::check(bridge, &plan, masonry.as_ref())?;
    let prism = |polygon| Shape::Prism { polygon, depth: bridge.width };
    let mut blocks = Vec::new();
    for (s, span) in plan.spans.iter().enumerate() {
        for (r, ring) in span.rings.iter().enumerate() {
            let n = ring.voussoirs.len();
            let placed = ring.voussoirs.iter().enumerate();
            blocks.extend(placed.map(|(v, polygon)| {
                BlockSpec::new(voussoir(bridge, s, r, v, n), prism(span.placed(polygon)))
            }));
        }
    }
    for (k, pier) in plan.piers.iter().enumerate() {
        blocks.push(BlockSpec::new(format!("pier_{}", k + 1), prism(pier.body.clone())));
        blocks.push(support(format!("footing_{}", k + 1), prism(pier.footing.clone())));
    }
    let ends = [("left", plan.spans.first(), 0), ("right", plan.spans.last(), 1)];
    for (word, span, side) in ends {
        let Some(span) = span else { continue };
        let several = span.rings.len() > 1;
        for (r, ring) in span.rings.iter().enumerate() {
            let id = if several {
                format!("springer_{word}_{}", r + 1)
            } else {
                format!("springer_{word}")
            };
            blocks.push(support(id, prism(span.placed(&ring.springers[side]))));
        }
    }
    blocks.extend(masonry.iter().flat_map(|m| m.blocks(bridge.width)));
    Ok(blocks)
}

/// The name of a voussoir.
fn voussoir(bridge: &Bridge, span: usize, ring: usize, index: usize, count: usize) -> String {
    let own = numbered("v", index, count);
    let ring = if bridge.spans[span].rings > 1 { format!("r{}_", ring + 1) } else { String::new() };
    let span = if bridge.spans.len() > 1 { format!("s{}_", span + 1) } else { String::new() };
    format!("{span}{ring}{own}")
}

impl SpanPlan {
    fn of(place: &TemplatePath, span: &BridgeSpan) -> Result<Self, InputError> {
        place.length("thickness", span.thickness)?;
        place.count("rings", span.rings, 1)?;
        let springing = span.springing_thickness.unwrap_or(span.thickness);
        place.length("springing_thickness", springing)?;
        if !span.intrados.is_empty() {
            return Self::surveyed(place, span, springing);
        }
        place.length("clear_span", span.clear_span)?;
        place.length("rise", span.rise)?;
        let fields =
            Fields::of_intrados_alone(span.profile, [span.clear_span, span.rise], span.thickness);
        let rings = radial_rings(place, &fields, span.voussoirs, span.rings, springing)?;
        let up = -rings[0].springing[0][1];
        let crown = [0.0, span.rise];
        Ok(Self { rings, center: 0.0, up, clear_span: span.clear_span, crown })
    }

    /// With an intrados by points.
    fn surveyed(
        place: &TemplatePath,
        span: &BridgeSpan,
        springing: f64,
    ) -> Result<Self, InputError> {
        let given = [
            ("clear_span", span.clear_span != 0.0),
            ("rise", span.rise != 0.0),
            ("profile", span.profile != Profile::default()),
        ];
        if let Some((field, _)) = given.into_iter().find(|(_, given)| *given) {
            return Err(place.error(
                field,
                "is that of an intrados by dimensions, which its points already give",
                format!("leave {field} out, or intrados"),
            ));
        }
        place.count("voussoirs", span.voussoirs, 2)?;
        let curve = Surveyed::new(place, &span.intrados)?;
        let (crown, n) = (span.thickness, span.rings as f64);
        let ring = |r: usize| {
            let of = |u: f64| (crown + (springing - crown) * u) / n;
            let joints = curve.joints(span.voussoirs, |u| [r, r + 1].map(|k| of(u) * k as f64));
            ring_between(place, &joints)
        };
        let rings = (0..span.rings).map(ring).collect::<Result<_, _>>()?;
        let (clear_span, crown) = (curve.clear_span(), curve.crown());
        Ok(Self { rings, center: 0.0, up: 0.0, clear_span, crown })
    }

    fn placed(&self, polygon: &[Xz]) -> Vec<Xz> {
        polygon.iter().map(|p| [p[0] + self.center, p[1] + self.up]).collect()
    }

    /// How far the springing joint on the left (0) or the right (1) reaches out over what it stands
    /// on, and up, from the end of the intrados to that of the outermost extrados, m.
    fn springing(&self, side: usize) -> Xz {
        let [first, last] = [&self.rings[0], &self.rings[self.rings.len() - 1]];
        let joint = match side {
            0 => [first.voussoirs[0][0], last.voussoirs[0][3]].map(mirror),
            _ => [first.springing[0], last.springing[1]],
        };
        let [inner, outer] = joint.map(|p| [p[0], p[1] + self.up]);
        [outer[0] - inner[0], outer[1] - inner[1]]
    }
}

impl Plan {
    fn of(bridge: &Bridge) -> Result<Self, InputError> {
        let place = TemplatePath::template("bridge");
        place.length("width", bridge.width)?;
        place.count("spans", bridge.spans.len(), 1)?;
        if bridge.piers.len() + 1 != bridge.spans.len() {
            return Err(place.error(
                "piers",
                format!(
                    "{} spans have {} piers between them, got {}",
                    bridge.spans.len(),
                    bridge.spans.len() - 1,
                    bridge.piers.len()
                ),
                "one pier between each two spans",
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
            let Some(pier) = bridge.piers.get(k) else { break };
            let place = TemplatePath(place.0.key("piers").index(k));
            piers.push(course::pier(&place, pier, [&spans[k], &spans[k + 1]], edge)?);
            edge += pier.width;
        }
        Ok(Self { spans, piers })
    }
}
