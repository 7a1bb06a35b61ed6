//! Backing as masonry: level courses between the extrados of a haunch and the haunch beyond the
//! pier, or at an end of the bridge a vertical back. They are blocks: what they carry, and how they
//! slide, the joints say. Cut where the joints of the ring are, so that each lies against one
//! voussoir on either side.

use super::{
    chord::Chord,
    plan::{Plan, SpanPlan},
};
use crate::{
    BlockSpec, Shape,
    generate::{check::TemplatePath, midline::Xz, numbered, support},
    template::Bridge,
};
use base::{error::InputError, tolerance};

/// Courses are at least so much of the ring's thickness high. Lower: where two rings differ by
/// little, courses as thin as a joint. Higher: courses that lie against several voussoirs.
const LEAST_COURSE: f64 = 0.25;

/// The place of the backing in errors.
pub(super) fn place() -> TemplatePath {
    TemplatePath(TemplatePath::template("bridge").0.key("fill").key("backing"))
}

/// The backing of a bridge.
pub(super) struct Masonry {
    /// Height of its level top over the springings, m.
    height: f64,
    /// The name of its material.
    material: String,
    /// Over the piers, from left to right.
    pub piers: Vec<Haunching>,
    /// At the left and the right end, where it reaches behind the springings.
    pub ends: Option<[Haunching; 2]>,
}

/// The courses between two haunches, or a haunch and a back.
pub(super) struct Haunching {
    /// What its courses are called, followed by a number.
    name: String,
    /// From the lowest to the highest.
    courses: Vec<Vec<Xz>>,
    /// The support below, at an end of the bridge.
    abutment: Option<(String, Vec<Xz>)>,
    /// The level top, from left to right.
    pub top: [Xz; 2],
}

/// One side of a haunching from its foot up, each point higher than the one before; the last one counts
/// for all that is higher.
struct Side(Vec<Xz>);

impl Side {
    /// The extrados of a span from its springing on the left (0) or right (1) up, as far as it
    /// rises.
    fn haunch(span: &SpanPlan, side: usize) -> Self {
        let last = &span.rings[span.rings.len() - 1];
        let placed = last.voussoirs.iter().map(|v| span.placed(v));
        // The last two points of a voussoir are the right and the left end of its extrados.
        let ends = placed.filter_map(|v| Some([*v.get(v.len().checked_sub(1)?)?, v[v.len() - 2]]));
        let mut points: Vec<Xz> = Vec::new();
        for [left, right] in ends {
            if points.is_empty() {
                points.push(left);
            }
            points.push(right);
        }
        if side == 1 {
            points.reverse();
        }
        let rising = points.windows(2).take_while(|p| p[1][1] > p[0][1]).count();
        points.truncate(rising + 1);
        Self(points)
    }

    /// A vertical line upwards.
    fn vertical(foot: Xz) -> Self {
        Self(vec![foot])
    }

    fn foot(&self) -> Xz {
        self.0[0]
    }

    /// The place along x at a height.
    fn at(&self, z: f64) -> f64 {
        let above = self.0.partition_point(|p| p[1] < z);
        match (above.checked_sub(1), self.0.get(above)) {
            (_, Some(b)) if b[1] == z => b[0],
            (Some(k), Some(b)) => {
                let a = self.0[k];
                a[0] + (z - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
            }
            (Some(k), None) => self.0[k][0],
            (None, _) => self.0[0][0],
        }
    }

    /// Its points between two heights.
    fn between(&self, low: f64, high: f64) -> impl DoubleEndedIterator<Item = Xz> {
        self.0.iter().copied().filter(move |p| p[1] > low && p[1] < high)
    }
}

/// The courses between two sides up to a height.
fn courses(sides: &[Side; 2], height: f64, least: f64, snap: f64) -> Vec<Vec<Xz>> {
    let [left, right] = sides;
    let foot = left.foot()[1].max(right.foot()[1]);
    let mut cuts: Vec<f64> = sides.iter().flat_map(|s| &s.0).map(|p| p[1]).collect();
    cuts.sort_by(f64::total_cmp);
    cuts.retain(|z| *z > foot + least && *z < height - least);
    cuts.dedup_by(|z, before| *z - *before < least);
    cuts.push(height);
    let mut below = [left.foot(), right.foot()];
    let mut list = Vec::new();
    for z in cuts {
        let above = [[left.at(z), z], [right.at(z), z]];
        // Corners that differ from an end by rounding are that end.
        let inner = |k: usize| {
            let side = [left, right][k];
            side.between(below[k][1] + snap, z - snap).collect::<Vec<_>>()
        };
        let mut polygon = vec![below[0], below[1]];
        if below[1][0] - below[0][0] <= snap {
            polygon.pop();
        }
        polygon.extend(inner(1));
        polygon.extend([above[1], above[0]]);
        polygon.extend(inner(0).into_iter().rev());
        list.push(polygon);
        below = above;
    }
    list
}

impl Masonry {
    /// Nothing where there is no backing that carries.
    ///
    /// # Errors
    /// A number is out of its range, or the backing reaches to a crown.
    pub(super) fn of(bridge: &Bridge, plan: &Plan) -> Result<Option<Self>, InputError> {
        let Some(backing) = bridge.fill.as_ref().and_then(|f| f.backing.as_ref()) else {
            return Ok(None);
        };
        let place = place();
        let Some(material) = backing.masonry.clone() else {
            return match backing.behind {
                Some(_) => Err(place.error(
                    "behind",
                    "applies to backing as masonry, and this backing is fill",
                    "give \"masonry\" the name of its material, or leave \"behind\" out",
                )),
                None => Ok(None),
            };
        };
        if plan.piers.is_empty() && backing.behind.is_none() {
            return Err(place.error(
                "masonry",
                "there is no pier for the masonry to stand on",
                "give \"behind\": how far it extends behind the springings, in m",
            ));
        }
        let height = backing.height;
        let over = |(k, pair): (usize, &[SpanPlan])| {
            let sides = [Side::haunch(&pair[0], 1), Side::haunch(&pair[1], 0)];
            let thickness = bridge.spans[k].thickness.min(bridge.spans[k + 1].thickness);
            Haunching::new(format!("backing_{}_", k + 1), sides, [true, true], height, thickness)
        };
        let piers = plan.spans.windows(2).enumerate().map(over).collect::<Result<_, _>>()?;
        let end = |side: usize, behind: f64| {
            let k = [0, plan.spans.len() - 1][side];
            Haunching::end(&plan.spans[k], side, behind, height, bridge.spans[k].thickness)
        };
        let ends = match backing.behind {
            Some(behind) => Some([end(0, behind)?, end(1, behind)?]),
            None => None,
        };
        Ok(Some(Self { height, material, piers, ends }))
    }

    /// From left to right.
    fn all(&self) -> impl Iterator<Item = &Haunching> {
        let [left, right] = [0, 1].map(|k| self.ends.as_ref().map(|e| &e[k]));
        left.into_iter().chain(&self.piers).chain(right)
    }

    /// Its blocks.
    pub(super) fn blocks(&self, depth: f64) -> Vec<BlockSpec> {
        let prism = |polygon: &Vec<Xz>| Shape::Prism { polygon: polygon.clone(), depth };
        let mut list = Vec::new();
        for haunching in self.all() {
            let courses = haunching.names().zip(&haunching.courses);
            list.extend(courses.map(|(id, polygon)| BlockSpec {
                material: Some(self.material.clone()),
                ..BlockSpec::new(id, prism(polygon))
            }));
            let abutment = haunching.abutment.as_ref();
            list.extend(abutment.map(|(id, polygon)| support(id.clone(), prism(polygon))));
        }
        list
    }

    /// The part of a chord of the extrados that lies above it; `backed` says of which haunches of
    /// the span, left and right, there is backing.
    pub(super) fn above(&self, mut chord: Chord, backed: [bool; 2]) -> Option<Chord> {
        let h = self.height;
        let crossing = |c: &Chord| {
            let share = (h - c.from[1]) / (c.to[1] - c.from[1]);
            [c.from[0] + share * c.length(), h]
        };
        let rises = chord.to[1] > chord.from[1];
        if backed[usize::from(!rises)] {
            match (chord.from[1] < h, chord.to[1] < h) {
                (false, false) => {}
                (true, true) => return None,
                (true, false) => chord.from = crossing(&chord),
                (false, true) => chord.to = crossing(&chord),
            }
        }
        (chord.length() > 0.0).then_some(chord)
    }
}

impl Haunching {
    /// That at an end of the bridge.
    fn end(
        span: &SpanPlan,
        side: usize,
        behind: f64,
        height: f64,
        thickness: f64,
    ) -> Result<Self, InputError> {
        place().length("behind", behind)?;
        let haunch = Side::haunch(span, side);
        let foot = haunch.foot();
        let outwards = [-behind, behind][side];
        let back = Side::vertical([foot[0] + outwards, foot[1]]);
        let (word, sides, against) = match side {
            0 => ("left", [back, haunch], [false, true]),
            _ => ("right", [haunch, back], [true, false]),
        };
        let feet = [sides[0].foot(), sides[1].foot()];
        let mut end = Self::new(format!("backing_{word}_"), sides, against, height, thickness)?;
        let low = foot[1] - thickness;
        let below = vec![[feet[0][0], low], [feet[1][0], low], feet[1], feet[0]];
        end.abutment = Some((format!("abutment_{word}"), below));
        Ok(end)
    }

    /// That between two sides; `against` says which of them are haunches.
    fn new(
        name: String,
        sides: [Side; 2],
        against: [bool; 2],
        height: f64,
        thickness: f64,
    ) -> Result<Self, InputError> {
        let (least, snap) = (LEAST_COURSE * thickness, tolerance::GRID_SNAP * thickness);
        let foot = sides.iter().map(|s| s.foot()[1]).fold(f64::NEG_INFINITY, f64::max);
        let haunches = sides.iter().zip(against).filter(|(_, is_haunch)| *is_haunch);
        let crown =
            haunches.filter_map(|(s, _)| s.0.last()).fold(f64::INFINITY, |low, p| low.min(p[1]));
        if !(height > foot + snap && height < crown - snap) {
            return Err(place().error(
                "height",
                format!(
                    "must lie between {foot} and {crown} m for masonry (lowest and highest point of the extrados beside it), got {height}"
                ),
                "metres over the springings",
            ));
        }
        let top = [[sides[0].at(height), height], [sides[1].at(height), height]];
        let courses = courses(&sides, height, least, snap);
        Ok(Self { name, courses, abutment: None, top })
    }

    fn names(&self) -> impl Iterator<Item = String> {
        let n = self.courses.len();
        (0..n).map(move |k| format!("{}{}", self.name, numbered("c", k, n)))
    }

    /// Its top as a piece of the upper surface.
    pub(super) fn chord(&self) -> Option<Chord> {
        let block = self.names().last()?;
        Some(Chord { block, from: self.top[0], to: self.top[1], towards: 0.0 })
    }

    /// The pieces of the vertical back on the left (0) or right (1) end of a bridge: the course, and
    /// the middle of what is its back.
    pub(super) fn back(&self, side: usize) -> Vec<(String, Xz)> {
        let x = self.top[side][0];
        let middle = |polygon: &Vec<Xz>| {
            let at_back = polygon.iter().filter(|p| p[0] == x).map(|p| p[1]);
            let ends = at_back.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| {
                [low.min(z), high.max(z)]
            });
            [x, 0.5 * (ends[0] + ends[1])]
        };
        self.names().zip(&self.courses).map(|(id, p)| (id, middle(p))).collect()
    }
}
