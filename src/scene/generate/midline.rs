//! Mid-lines of arches and vaults: which fields give them, their joints, their height over the
//! springing.
//!
//! A place on the mid-line is named by u from −1 (left springing) over 0 (crown) to 1 (right
//! springing). Only u ≥ 0 is computed.

use super::{
    angle::{cos_deg, sin_deg},
    check::TemplatePath,
};
use crate::template::Profile;
use base::error::InputError;

/// A point (x, z), m.
pub type Xz = [f64; 2];

/// A joint: its intrados and its extrados end.
pub type JointLine = [Xz; 2];

/// The fields that give a mid-line, as arch and barrel have them.
#[derive(Clone, Copy)]
pub struct Fields {
    pub profile: Profile,
    pub radius: Option<f64>,
    pub embrace_deg: Option<f64>,
    pub eccentricity: Option<f64>,
    pub span: Option<f64>,
    pub rise: Option<f64>,
    pub intrados_span: Option<f64>,
    pub intrados_rise: Option<f64>,
    /// Between intrados and extrados, m.
    pub thickness: f64,
    /// Whether intrados and extrados are the mid-line moved down and up; otherwise they run along
    /// its normals.
    pub sheared: bool,
}

/// A mid-line with its numbers checked.
#[derive(Clone, Copy)]
pub enum Midline {
    /// Circle about the origin, to `half_deg` on either side of the crown.
    Circular { radius: f64, half_deg: f64 },
    /// The right half is a circle about (−eccentricity, 0), from z = 0 to x = 0.
    Pointed { radius: f64, eccentricity: f64 },
    /// (half_span sin s, rise cos s).
    Elliptical { half_span: f64, rise: f64 },
    /// z = rise (1 − (x / half_span)²).
    Parabolic { half_span: f64, rise: f64 },
    /// The right half: a circle of radius `crown` about (0, rise − crown) to 30° from the axis, then
    /// one of radius `side` about (half span − side, 0).
    ThreeCentred { crown: f64, side: f64 },
}

impl Fields {
    /// Those of an arch by span and rise of its intrados, with radial joints.
    pub fn of_intrados_alone(profile: Profile, [span, rise]: [f64; 2], thickness: f64) -> Self {
        Self {
            profile,
            radius: None,
            embrace_deg: None,
            eccentricity: None,
            span: None,
            rise: None,
            intrados_span: Some(span),
            intrados_rise: Some(rise),
            thickness,
            sheared: false,
        }
    }

    /// Checks which fields are there and their ranges.
    pub fn resolve(&self, place: &TemplatePath) -> Result<Midline, InputError> {
        let lengths = [
            ("radius", self.radius),
            ("span", self.span),
            ("rise", self.rise),
            ("intrados_span", self.intrados_span),
            ("intrados_rise", self.intrados_rise),
        ];
        for (field, value) in lengths {
            if let Some(value) = value {
                place.length(field, value)?;
            }
        }
        if self.intrados_span.or(self.intrados_rise).is_some() {
            return self.of_intrados(place);
        }
        if self.profile != Profile::Circular {
            self.refuse(place, "embrace_deg", self.embrace_deg)?;
        }
        if self.profile != Profile::Pointed {
            self.refuse(place, "eccentricity", self.eccentricity)?;
        }
        match self.profile {
            Profile::Circular if self.by_radius(place)? => self.circle(place),
            Profile::Pointed if self.by_radius(place)? => self.two_circles(place),
            Profile::Circular => {
                let (half_span, rise) = self.half_span_and_rise(place)?;
                self.refuse_with_span(place, "embrace_deg", self.embrace_deg)?;
                // Inscribed angle: the springing sees the crown under half the half embrace angle.
                let half_deg = 2.0 * rise.atan2(half_span).to_degrees();
                Ok(Midline::Circular {
                    radius: (half_span * half_span / rise + rise) / 2.0,
                    half_deg,
                })
            }
            Profile::Pointed => {
                let (half_span, rise) = self.half_span_and_rise(place)?;
                self.refuse_with_span(place, "eccentricity", self.eccentricity)?;
                if rise < half_span {
                    return Err(place.error(
                        "rise",
                        format!(
                            "a pointed arch rises at least half its span ({half_span}), got {rise}"
                        ),
                        "use profile circular or elliptical for a lower arch",
                    ));
                }
                // R − e = half span, R² − e² = rise².
                let sum = rise / half_span * rise;
                Ok(Midline::Pointed {
                    radius: (sum + half_span) / 2.0,
                    eccentricity: (sum - half_span) / 2.0,
                })
            }
            Profile::Elliptical => {
                self.refuse(place, "radius", self.radius)?;
                let (half_span, rise) = self.half_span_and_rise(place)?;
                Ok(Midline::Elliptical { half_span, rise })
            }
            Profile::Parabolic => {
                self.refuse(place, "radius", self.radius)?;
                let (half_span, rise) = self.half_span_and_rise(place)?;
                Ok(Midline::Parabolic { half_span, rise })
            }
            Profile::ThreeCentred => {
                self.refuse(place, "radius", self.radius)?;
                let (half_span, rise) = self.half_span_and_rise(place)?;
                three_centred(place, half_span, rise)
            }
        }
    }

    /// The mid-line half the thickness outside a given intrados.
    fn of_intrados(&self, place: &TemplatePath) -> Result<Midline, InputError> {
        let (Some(span), Some(rise)) = (self.intrados_span, self.intrados_rise) else {
            let field =
                if self.intrados_span.is_none() { "intrados_span" } else { "intrados_rise" };
            return Err(place.error(
                field,
                "missing",
                format!("{} needs both span and rise of its intrados", self.called()),
            ));
        };
        for (field, value) in [("radius", self.radius), ("span", self.span), ("rise", self.rise)] {
            if value.is_some() {
                let text = "cannot be combined with intrados_span and intrados_rise, which already define the mid-line";
                return Err(place.error(
                    field,
                    text,
                    format!("leave {field} out, or both intrados_span and intrados_rise"),
                ));
            }
        }
        place.length("thickness", self.thickness)?;
        let own = Self {
            span: Some(span),
            rise: Some(rise),
            intrados_span: None,
            intrados_rise: None,
            ..*self
        };
        let intrados = own.resolve(place)?;
        let half = self.thickness / 2.0;
        Ok(match intrados {
            same if self.sheared => same,
            // Circles keep their centres.
            Midline::Circular { radius, half_deg } => {
                Midline::Circular { radius: radius + half, half_deg }
            }
            Midline::Pointed { radius, eccentricity } => {
                Midline::Pointed { radius: radius + half, eccentricity }
            }
            // The joints at the ends are level, the one at the crown is upright.
            Midline::Elliptical { half_span, rise } => {
                Midline::Elliptical { half_span: half_span + half, rise: rise + half }
            }
            Midline::Parabolic { half_span, rise } => parabola_over(half_span, rise, half),
            Midline::ThreeCentred { crown, side } => {
                Midline::ThreeCentred { crown: crown + half, side: side + half }
            }
        })
    }

    fn circle(&self, place: &TemplatePath) -> Result<Midline, InputError> {
        let radius = self.radius.unwrap_or_default();
        let embrace = self.embrace_deg.unwrap_or(180.0);
        if !(embrace > 0.0 && embrace < 360.0) {
            return Err(place.error(
                "embrace_deg",
                format!("must lie between 0 and 360, got {embrace}"),
                "180 is a semicircle",
            ));
        }
        Ok(Midline::Circular { radius, half_deg: embrace / 2.0 })
    }

    fn two_circles(&self, place: &TemplatePath) -> Result<Midline, InputError> {
        let radius = self.radius.unwrap_or_default();
        match self.eccentricity {
            Some(e) if e >= 0.0 && e < radius => Ok(Midline::Pointed { radius, eccentricity: e }),
            Some(e) => Err(place.error(
                "eccentricity",
                format!("must lie between 0 and the radius {radius}, got {e}"),
                "the right half is centred at x = −eccentricity; 0 is a semicircle",
            )),
            None => Err(place.error(
                "eccentricity",
                "missing",
                "a pointed arch needs it with radius, or span and rise in place of both",
            )),
        }
    }

    /// Whether a circular or pointed arch is given by its radius; otherwise it is by span and rise.
    fn by_radius(&self, place: &TemplatePath) -> Result<bool, InputError> {
        match (self.radius, self.span.or(self.rise)) {
            (Some(_), Some(_)) => Err(place.error(
                "radius",
                "cannot be combined with span and rise",
                "give the radius, or span and rise of the mid-line, not both",
            )),
            (None, None) => Err(place.error(
                "radius",
                "missing",
                "give radius, or span and rise of the mid-line, or intrados_span and intrados_rise",
            )),
            (radius, _) => Ok(radius.is_some()),
        }
    }

    fn half_span_and_rise(&self, place: &TemplatePath) -> Result<(f64, f64), InputError> {
        match (self.span, self.rise) {
            (Some(span), Some(rise)) => Ok((span / 2.0, rise)),
            (span, _) => Err(place.error(
                if span.is_none() { "span" } else { "rise" },
                "missing",
                format!(
                    "{} needs span and rise of the mid-line (or intrados_span and intrados_rise)",
                    self.called()
                ),
            )),
        }
    }

    fn called(&self) -> &'static str {
        match self.profile {
            Profile::Circular => "a circular arch",
            Profile::Pointed => "a pointed arch",
            Profile::Elliptical => "an elliptical arch",
            Profile::Parabolic => "a parabolic arch",
            Profile::ThreeCentred => "a three-centred arch",
        }
    }

    fn refuse(
        &self,
        place: &TemplatePath,
        field: &str,
        value: Option<f64>,
    ) -> Result<(), InputError> {
        if value.is_none() {
            return Ok(());
        }
        let uses = match self.profile {
            Profile::Circular => "radius and embrace_deg, or span and rise",
            Profile::Pointed => "radius and eccentricity, or span and rise",
            Profile::Elliptical | Profile::Parabolic | Profile::ThreeCentred => "span and rise",
        };
        Err(place.error(
            field,
            format!("{} has no {field}", self.called()),
            format!("it is defined by {uses}"),
        ))
    }

    fn refuse_with_span(
        &self,
        place: &TemplatePath,
        field: &str,
        value: Option<f64>,
    ) -> Result<(), InputError> {
        match value {
            None => Ok(()),
            Some(_) => Err(place.error(
                field,
                format!(
                    "span and rise already define the arch: {field} cannot be combined with them"
                ),
                format!("leave {field} out"),
            )),
        }
    }
}

impl Midline {
    /// The joint normal to the mid-line at u = (2j − n) / n, with half the thickness on either
    /// side.
    pub fn radial_joint(&self, j: usize, n: usize, thickness: f64) -> JointLine {
        self.joint_between(j, n, &|_| [-thickness / 2.0, thickness / 2.0])
    }

    /// The same between two distances from the mid-line, outwards, at |u|.
    pub fn joint_between(
        &self,
        j: usize,
        n: usize,
        between: &impl Fn(f64) -> [f64; 2],
    ) -> JointLine {
        mirrored(j, n, |u| between(u).map(|out| self.offset(u, out)))
    }

    /// The point of the mid-line at (2j − n) / n of the half span.
    pub fn point_over(&self, j: usize, n: usize) -> Xz {
        let [point, _] = mirrored(j, n, |u| {
            let x = self.half_span() * u;
            [[x, self.height(x)]; 2]
        });
        point
    }

    /// Half the distance between the ends of the mid-line, m.
    pub fn half_span(&self) -> f64 {
        match *self {
            Midline::Circular { radius, half_deg } => radius * sin_deg(half_deg),
            Midline::Pointed { radius, eccentricity } => radius - eccentricity,
            Midline::Elliptical { half_span, .. } | Midline::Parabolic { half_span, .. } => {
                half_span
            }
            // The centres are 2 × (half span − side) apart.
            Midline::ThreeCentred { crown, side } => 0.5 * (crown + side),
        }
    }

    /// z of the mid-line over x ≥ 0 (its upper branch).
    fn height(&self, x: f64) -> f64 {
        let circle = |radius: f64, x: f64| ((radius - x) * (radius + x)).max(0.0).sqrt();
        match *self {
            Midline::Circular { radius, .. } => circle(radius, x),
            Midline::Pointed { radius, eccentricity } => circle(radius, x + eccentricity),
            Midline::Elliptical { half_span, rise } => rise * circle(1.0, x / half_span),
            Midline::Parabolic { half_span, rise } => rise * (1.0 - (x / half_span).powi(2)),
            Midline::ThreeCentred { crown, side } => {
                if x <= crown * sin_deg(HALF_CROWN_DEG) {
                    circle(crown, x) - (crown - side) * cos_deg(HALF_CROWN_DEG)
                } else {
                    circle(side, x - 0.5 * (crown - side))
                }
            }
        }
    }

    /// The point at distance `out` from the mid-line, outwards along its normal at u in [0, 1].
    fn offset(&self, u: f64, out: f64) -> Xz {
        match *self {
            Midline::Circular { radius, half_deg } => {
                let (r, angle) = (radius + out, half_deg * u);
                [r * sin_deg(angle), r * cos_deg(angle)]
            }
            Midline::Pointed { radius, eccentricity } => {
                let r = radius + out;
                if u == 0.0 {
                    return [0.0, ((r - eccentricity) * (r + eccentricity)).max(0.0).sqrt()];
                }
                let (sin, cos) = ((eccentricity / radius).acos() * (1.0 - u)).sin_cos();
                [r * cos - eccentricity, r * sin]
            }
            Midline::Elliptical { half_span: a, rise: b } => {
                let (sin, cos) = (sin_deg(90.0 * u), cos_deg(90.0 * u));
                along([a * sin, b * cos], [b * sin, a * cos], out)
            }
            Midline::Parabolic { half_span: a, rise } => {
                along([a * u, rise * (1.0 - u * u)], [2.0 * rise * u, a], out)
            }
            Midline::ThreeCentred { crown, side } => {
                // By length: half of the crown's arc has 30°, a side's 60°.
                let arcs = [crown * HALF_CROWN_DEG, side * (90.0 - HALF_CROWN_DEG)];
                let place = u * (arcs[0] + arcs[1]);
                if place <= arcs[0] {
                    let (r, angle) = (crown + out, place / crown);
                    let low = (crown - side) * cos_deg(HALF_CROWN_DEG);
                    return [r * sin_deg(angle), r * cos_deg(angle) - low];
                }
                // The springing to the last bit.
                let left = if u == 1.0 { 0.0 } else { (1.0 - u) * (arcs[0] + arcs[1]) / side };
                let (r, angle) = (side + out, 90.0 - left);
                [r * sin_deg(angle) + 0.5 * (crown - side), r * cos_deg(angle)]
            }
        }
    }
}

/// Half of the angle of the crown's arc of a three-centred arch: all three arcs have 60°, as
/// C. Huygens drew it.
const HALF_CROWN_DEG: f64 = 30.0;

/// The radii for a span and a rise: side + (crown − side) sin 30° = half span and crown − (crown −
/// side) cos 30° = rise.
fn three_centred(place: &TemplatePath, half_span: f64, rise: f64) -> Result<Midline, InputError> {
    let (sin, cos) = (sin_deg(HALF_CROWN_DEG), cos_deg(HALF_CROWN_DEG));
    let least = half_span * (1.0 - cos) / sin;
    if !(rise > least && rise <= half_span) {
        return Err(place.error(
            "rise",
            format!("with three arcs of 60° it lies between {least} and half the span ({half_span}), got {rise}"),
            "use profile circular or elliptical for a lower arch, pointed for a higher one",
        ));
    }
    let apart = (half_span - rise) / (sin + cos - 1.0);
    let side = half_span - apart * sin;
    Ok(Midline::ThreeCentred { crown: side + apart, side })
}

/// The parabola whose points, moved inwards by `half` along its normals, have their ends
/// `half_span` from the axis and their crown `rise` above them: at the ends the normal leans by the
/// slope of the parabola that is sought, so that its numbers are found by turns.
fn parabola_over(half_span: f64, rise: f64, half: f64) -> Midline {
    /// Each turn gains some digits: the normal turns by less than the ends move.
    const TURNS: usize = 100;
    let (mut a, mut b) = (half_span, rise);
    for _ in 0..TURNS {
        let length = (2.0 * b).hypot(a);
        (a, b) = (half_span + half * 2.0 * b / length, rise + half * (1.0 - a / length));
    }
    Midline::Parabolic { half_span: a, rise: b }
}

/// `point` moved by `distance` in a direction of any length.
fn along(point: Xz, direction: Xz, distance: f64) -> Xz {
    let length = direction[0].hypot(direction[1]);
    [point[0] + distance * direction[0] / length, point[1] + distance * direction[1] / length]
}

/// Evaluates on the right half (u ≥ 0) and mirrors to the left.
pub fn mirrored(j: usize, n: usize, right: impl Fn(f64) -> JointLine) -> JointLine {
    if 2 * j >= n {
        return right((2 * j - n) as f64 / n as f64);
    }
    right((n - 2 * j) as f64 / n as f64).map(mirror)
}

/// The mirror image of a point in x = 0.
pub fn mirror([x, z]: Xz) -> Xz {
    // Subtracted, so that the crown does not become -0.
    [0.0 - x, z]
}
