//! What the fill does: its weight, its resistance, and how it spreads a load on the road.
//!
//! *Weight.* The strip of fill above a chord, a trapezoid, acts at its centroid. *Resistance.* A
//! horizontal force on every chord towards the span, between nothing and `k γ z Δy × width`, z the depth
//! of the chord's middle (a member `soil`). *Spread.* A load on a length w of the road spreads to either
//! side by `dispersal` (or the tangent of `dispersal_deg`) × depth, down to the extrados below its
//! middle, and presses evenly on the length it has there; on a chord that it covers in part it acts at
//! the middle of that part (Melbourne & Gilbert 1995 spread alike, 1 horizontally to 2 vertically); or
//! it presses as in an elastic half-space (`pressure`). *Backing.* As fill: below its height the strip
//! has the backing's weight, and chords whose middle lies there its resistance. As masonry it is blocks
//! (`backing`), on whose top and back the fill lies as on the extrados.

use super::{
    backing::{self, Haunching, Masonry},
    chord::Chord,
    course::chords,
    plan::Plan,
    pressure::Pressure,
};
use crate::{
    At, Load, Member, OnRoad,
    generate::{check::TemplatePath, midline::Xz},
    member::{Face, Near, Soil},
    template::{Bridge, Distribution, Fill},
};
use base::error::InputError;

/// The surface of the road: height at x = 0, rise per metre.
struct Road {
    level: f64,
    gradient: f64,
}

impl Road {
    fn of(bridge: &Bridge, fill: &Fill, plan: &Plan) -> Self {
        // The highest crown of the curve of an extrados.
        let crown = bridge
            .spans
            .iter()
            .zip(&plan.spans)
            .map(|(s, p)| (p.crown[1] + s.thickness, p.center + p.crown[0]))
            .fold((f64::NEG_INFINITY, 0.0), |a, b| if b.0 > a.0 { b } else { a });
        Self { level: crown.0 + fill.cover - fill.gradient * crown.1, gradient: fill.gradient }
    }

    fn height(&self, x: f64) -> f64 {
        self.level + self.gradient * x
    }
}

/// Checks the numbers of the fill, and that it lies on the arches.
pub(super) fn check(
    bridge: &Bridge,
    plan: &Plan,
    masonry: Option<&Masonry>,
) -> Result<(), InputError> {
    let Some(fill) = &bridge.fill else { return Ok(()) };
    let place = TemplatePath(TemplatePath::template("bridge").0.key("fill"));
    place.length("unit_weight", fill.unit_weight)?;
    place.finite("gradient", fill.gradient)?;
    let at_least = |field: &str, value: f64, hint: &str| {
        if value.is_finite() && value >= 0.0 {
            return Ok(());
        }
        Err(place.error(field, format!("must be at least 0, got {value}"), hint))
    };
    at_least("cover", fill.cover, "a length in m")?;
    let hint = "metres to either side per metre of depth, such as 0.5";
    at_least("dispersal", fill.dispersal.unwrap_or(0.0), hint)?;
    at_least("parapets", fill.parapets, "in N per metre of the bridge")?;
    at_least("passive", fill.passive.unwrap_or(0.0), "half of tan²(45° + φ/2): 1.5 for 30°")?;
    let angles = [
        ("friction_deg", fill.friction_deg, "passive", fill.passive),
        ("dispersal_deg", fill.dispersal_deg, "dispersal", fill.dispersal),
    ];
    for (field, angle, other, given) in angles {
        if given.is_some() && angle.is_some() {
            return Err(place.error(
                field,
                format!("cannot be combined with {other}"),
                "leave one of them out",
            ));
        }
        if let Some(angle) = angle.filter(|a| !(0.0..90.0).contains(a)) {
            return Err(place.error(
                field,
                format!("must lie between 0 and 90, got {angle}"),
                "in degrees",
            ));
        }
    }
    if let Some(backing) = &fill.backing {
        let place = backing::place();
        place.length("height", backing.height)?;
        match (&backing.masonry, backing.unit_weight) {
            (None, Some(weight)) => place.length("unit_weight", weight)?,
            (None, None) => {
                return Err(place.error(
                    "unit_weight",
                    "is missing",
                    "give its weight per volume in N/m³ as fill, or \"masonry\", the name of its material",
                ));
            }
            (Some(name), _) => {
                let given = [("unit_weight", backing.unit_weight), ("passive", backing.passive)];
                if let Some((key, _)) = given.into_iter().find(|(_, value)| value.is_some()) {
                    return Err(place.error(
                        key,
                        format!(
                            "applies to backing as fill, and this backing is masonry of {name:?}"
                        ),
                        format!("leave {key} out, or masonry"),
                    ));
                }
            }
        }
        if let Some(k) = backing.passive.filter(|k| !(k.is_finite() && *k >= 0.0)) {
            return Err(place.error(
                "passive",
                format!("must be at least 0, got {k}"),
                "leave it out to use that of the fill; give a greater one where the backing is stiff",
            ));
        }
    }
    let road = Road::of(bridge, fill, plan);
    let list = chords(bridge, plan, masonry);
    let low = list.iter().flat_map(|c| [c.from, c.to]).find(|p| {
        road.height(p[0]) < p[1] - base::tolerance::GRID_SNAP * bridge.spans[0].thickness
    });
    if let Some([x, z]) = low {
        return Err(place.error(
            "cover",
            format!(
                "the road is {} m high at x = {x}, below the structure under it ({z} m)",
                road.height(x)
            ),
            "use a thicker cover, a smaller gradient or lower backing",
        ));
    }
    Ok(())
}

/// A bridge without mistakes in its plane, and its backing as masonry.
fn plan(bridge: &Bridge) -> Option<(Plan, Option<Masonry>)> {
    let plan = Plan::of(bridge).ok()?;
    let masonry = Masonry::of(bridge, &plan).ok()?;
    Some((plan, masonry))
}

/// The dead loads of the fill and the parapets, names and places as in the template.
pub fn loads(bridge: &Bridge) -> Vec<Load> {
    let (Some(fill), Some((plan, masonry))) = (&bridge.fill, plan(bridge)) else {
        return Vec::new();
    };
    let road = Road::of(bridge, fill, &plan);
    let list = chords(bridge, &plan, masonry.as_ref());
    let strip = |chord: &Chord| {
        let depth = [chord.from, chord.to].map(|p| (road.height(p[0]) - p[1]).max(0.0));
        let sum = depth[0] + depth[1];
        let weight = fill.unit_weight * bridge.width * 0.5 * sum * chord.length();
        let share = if sum > 0.0 { (depth[0] + 2.0 * depth[1]) / (3.0 * sum) } else { 0.5 };
        let x = chord.from[0] + share * chord.length();
        down(chord, x, weight)
    };
    let backed = |chord: &Chord| {
        let backing = fill.backing.as_ref()?;
        let more = (backing.unit_weight? - fill.unit_weight) * bridge.width;
        let (x, area) = below(chord, &road, backing.height)?;
        down(chord, x, more * area)
    };
    let parapet = |chord: &Chord| {
        let x = 0.5 * (chord.from[0] + chord.to[0]);
        down(chord, x, fill.parapets * chord.length())
    };
    let each = list.iter();
    let strips = each.clone().filter_map(strip).chain(each.clone().filter_map(backed));
    let own = |load: Load| Load { action: fill.action.clone(), ..load };
    strips.chain(each.filter_map(parapet)).map(own).collect()
}

/// The area between a chord and a level above it (at most the road), and the x of its centroid.
fn below(chord: &Chord, road: &Road, level: f64) -> Option<(f64, f64)> {
    let [a, b] = [chord.from, chord.to];
    // Depths change linearly between the ends of the chord, the crossing of the level and that of
    // the road with it.
    let depth = |x: f64| (level.min(road.height(x)) - chord.height(x)).max(0.0);
    let crossing = |x: [f64; 2], of: &dyn Fn(f64) -> f64| {
        let (from, to) = (of(x[0]), of(x[1]));
        (from * to < 0.0).then(|| x[0] + (x[1] - x[0]) * from / (from - to))
    };
    let ends = [a[0], b[0]];
    let mut marks = vec![a[0], b[0]];
    marks.extend(crossing(ends, &|x| level - chord.height(x)));
    marks.extend(crossing(ends, &|x| level - road.height(x)));
    marks.sort_by(f64::total_cmp);
    let (mut area, mut moment) = (0.0, 0.0);
    for pair in marks.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let [d, e] = [depth(from), depth(to)];
        area += 0.5 * (d + e) * (to - from);
        // About x = 0: the trapezoid's own first moment.
        moment += (to - from) / 6.0 * (d * (2.0 * from + to) + e * (from + 2.0 * to));
    }
    (area > 0.0).then(|| (moment / area, area))
}

/// A weight on a chord; less than nothing where backing is lighter than the fill.
fn down(chord: &Chord, x: f64, weight: f64) -> Option<Load> {
    (weight != 0.0).then(|| Load {
        block: Some(chord.block.clone()),
        force: Some([0.0, 0.0, -weight]),
        at: Some(At::Point([x, 0.0, chord.height(x)])),
        ..Load::default()
    })
}

/// The coefficient of the passive pressure; 0 for none.
pub(super) fn resistance(fill: &Fill) -> f64 {
    match (fill.passive, fill.friction_deg) {
        (Some(k), _) => k,
        (None, Some(angle)) => 0.5 * (45.0 + 0.5 * angle).to_radians().tan().powi(2),
        (None, None) => 0.0,
    }
}

/// How far a load spreads to either side per metre of depth, m.
pub(super) fn dispersal(fill: &Fill) -> f64 {
    match (fill.dispersal, fill.dispersal_deg) {
        (Some(share), _) => share,
        (None, Some(angle)) => angle.to_radians().tan(),
        (None, None) => USUAL_DISPERSAL,
    }
}

/// 1 horizontally to 2 vertically.
const USUAL_DISPERSAL: f64 = 0.5;

/// The members that stand for the resistance of the fill, names and places as in the template.
pub fn soil(bridge: &Bridge) -> Vec<Member> {
    let (Some(fill), Some((plan, masonry))) = (&bridge.fill, plan(bridge)) else {
        return Vec::new();
    };
    let all = resistance(fill);
    let backing = fill.backing.as_ref();
    let road = Road::of(bridge, fill, &plan);
    let resists = |(block, middle, towards): (String, Xz, f64)| {
        let surface = road.height(middle[0]);
        let own = backing.filter(|b| b.masonry.is_none() && middle[1] < b.height);
        let k = own.and_then(|b| b.passive).unwrap_or(all);
        (towards != 0.0 && surface > middle[1] && k > 0.0).then(|| Member {
            id: format!("soil_{block}"),
            soil: Some(Soil {
                block,
                face: Face::Near(Near { near: [middle[0], 0.0, middle[1]] }),
                direction: [towards, 0.0, 0.0],
                surface,
                unit_weight: fill.unit_weight,
                k,
            }),
            ..Member::default()
        })
    };
    let chords = chords(bridge, &plan, masonry.as_ref()).into_iter().map(|c| {
        let middle = [0, 1].map(|i| 0.5 * (c.from[i] + c.to[i]));
        (c.block, middle, c.towards)
    });
    let ends = masonry.iter().flat_map(|m| &m.ends);
    let backs = ends.flat_map(|[left, right]| {
        let side = |of: &Haunching, k: usize, towards: f64| {
            of.back(k).into_iter().map(move |(block, middle)| (block, middle, towards))
        };
        side(left, 0, 1.0).chain(side(right, 1, -1.0))
    });
    chords.chain(backs).filter_map(resists).collect()
}

/// What a load on the road comes to on the bridge.
pub struct Spread {
    /// Its parts, names and places as in the template.
    pub loads: Vec<Load>,
    /// Which share of it presses on springers and beyond.
    pub beside: f64,
    /// The width of the bridge that carries it, m.
    pub width: f64,
}

/// The opening of a span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opening {
    /// Both springings of the intrados, x and z, m.
    pub springings: [Xz; 2],
    /// The crown of the intrados, m.
    pub crown: Xz,
    /// Thickness of all rings at the crown, m.
    pub thickness: f64,
}

/// The upper surface of a bridge and what lies on it, made ready for any number of loads.
pub struct Surface {
    chords: Vec<Chord>,
    /// The road, how far a load spreads per metre of depth, and how it is distributed there.
    fill: Option<(Road, f64, Distribution)>,
    width: f64,
    /// The spans from left to right.
    pub openings: Vec<Opening>,
}

impl Surface {
    /// Nothing where the bridge has a mistake.
    pub fn of(bridge: &Bridge) -> Option<Self> {
        let (plan, masonry) = plan(bridge)?;
        let road = |f: &Fill| (Road::of(bridge, f, &plan), dispersal(f), f.distribution);
        Some(Self {
            chords: chords(bridge, &plan, masonry.as_ref()),
            fill: bridge.fill.as_ref().map(road),
            width: bridge.width,
            openings: plan
                .spans
                .iter()
                .zip(&bridge.spans)
                .map(|(s, own)| Opening {
                    springings: [-0.5, 0.5].map(|k| [s.center + k * s.clear_span, 0.0]),
                    crown: [s.center + s.crown[0], s.crown[1]],
                    thickness: own.thickness,
                })
                .collect(),
        })
    }

    /// The upper surface of the structure from left to right, x and z, m.
    pub fn line(&self) -> impl Iterator<Item = Xz> + '_ {
        self.chords.iter().flat_map(|c| [c.from, c.to])
    }

    /// How high what drives over the bridge stands at a place along x, m; as at its ends beyond them.
    pub fn height(&self, x: f64) -> f64 {
        if let Some((road, ..)) = &self.fill {
            return road.height(x);
        }
        let at = |c: &&Chord| c.from[0] <= x && x <= c.to[0];
        let ends = [self.chords.first().map(|c| c.from), self.chords.last().map(|c| c.to)];
        match (self.chords.iter().find(at), ends) {
            (Some(chord), _) => chord.height(x),
            (None, [Some(first), Some(last)]) => {
                if x < first[0] {
                    first[1]
                } else {
                    last[1]
                }
            }
            (None, _) => 0.0,
        }
    }

    /// Whether there is fill.
    pub fn is_filled(&self) -> bool {
        self.fill.is_some()
    }

    /// What a `force` on a stretch of the road does to the bridge; `x` of the stretch is about the
    /// template's origin. The plane model is as wide as the bridge: where less of it carries, the
    /// load counts for more.
    pub fn spread(&self, on: OnRoad, force: [f64; 3]) -> Spread {
        // Over an abutment nothing says how deep it is.
        let below = self.chords.iter().find(|c| c.from[0] <= on.x && on.x <= c.to[0]);
        let (depth, dispersal, distribution) = match (&self.fill, below) {
            (Some((road, dispersal, distribution)), Some(chord)) => {
                let depth = (road.height(on.x) - chord.height(on.x)).max(0.0);
                (depth, *dispersal, *distribution)
            }
            _ => (0.0, 0.0, Distribution::Even),
        };
        let reach = depth * dispersal;
        let carries = on.across.map_or(self.width, |w| (w + 2.0 * reach).min(self.width));
        let length = on.patch + 2.0 * reach;
        let pressure = Pressure::new(distribution, on.patch, depth, length);
        let (from, to) = (on.x - 0.5 * length, on.x + 0.5 * length);
        let mut beside = 1.0;
        let mut loads = Vec::new();
        for chord in &self.chords {
            let (a, b) = (chord.from[0].max(from), chord.to[0].min(to));
            if b <= a {
                continue;
            }
            let (x, share) = pressure.between(on.x, a, b);
            beside -= share;
            loads.push(Load {
                block: Some(chord.block.clone()),
                force: Some(force.map(|f| f * share * self.width / carries)),
                at: Some(At::Point([x, 0.0, chord.height(x)])),
                ..Load::default()
            });
        }
        Spread { loads, beside: beside.max(0.0), width: carries }
    }
}
