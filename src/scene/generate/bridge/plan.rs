//! A bridge in its plane.

use crate::{
    generate::{
        arch::{Section, radial_rings, ring_between},
        check::TemplatePath,
        midline::{Fields, Xz, mirror},
        numbered,
        surveyed::Surveyed,
    },
    template::{Bridge, BridgeSpan, Profile},
};
use base::error::InputError;

/// A bridge in its plane, about the origin of the template.
pub(super) struct Plan {
    pub spans: Vec<SpanPlan>,
    pub piers: Vec<PierPlan>,
}

pub(super) struct SpanPlan {
    /// From inside out.
    pub rings: Vec<Section>,
    /// Where x = 0 of the sections lies.
    pub center: f64,
    /// How far the sections are moved up.
    pub up: f64,
    /// Distance between the springings of the intrados, m.
    pub clear_span: f64,
    /// The crown of the intrados: x from the middle between the springings, height over them, m.
    pub crown: Xz,
}

pub(super) struct PierPlan {
    pub body: Vec<Xz>,
    pub footing: Vec<Xz>,
}

/// The name of a voussoir.
pub(super) fn voussoir(
    bridge: &Bridge,
    span: usize,
    ring: usize,
    index: usize,
    count: usize,
) -> String {
    let own = numbered("v", index, count);
    let ring = if bridge.spans[span].rings > 1 { format!("r{}_", ring + 1) } else { String::new() };
    let span = if bridge.spans.len() > 1 { format!("s{}_", span + 1) } else { String::new() };
    format!("{span}{ring}{own}")
}

impl SpanPlan {
    pub fn of(place: &TemplatePath, span: &BridgeSpan) -> Result<Self, InputError> {
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
                "cannot be combined with \"intrados\": its points already define the shape",
                format!("leave \"{field}\" or \"intrados\" out"),
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

    pub fn placed(&self, polygon: &[Xz]) -> Vec<Xz> {
        polygon.iter().map(|p| [p[0] + self.center, p[1] + self.up]).collect()
    }

    /// How far the springing joint on the left (0) or the right (1) reaches out over what it stands
    /// on, and up, from the end of the intrados to that of the outermost extrados, m.
    pub fn springing(&self, side: usize) -> Xz {
        let [first, last] = [&self.rings[0], &self.rings[self.rings.len() - 1]];
        let joint = match side {
            0 => [first.voussoirs[0][0], last.voussoirs[0][3]].map(mirror),
            _ => [first.springing[0], last.springing[1]],
        };
        let [inner, outer] = joint.map(|p| [p[0], p[1] + self.up]);
        [outer[0] - inner[0], outer[1] - inner[1]]
    }
}
