//! What the fill does: its weight, its resistance, and how it spreads a load on the road.
//!
//! *Weight.* The strip of fill above a chord, a trapezoid, acts at its centroid. *Resistance.* A
//! horizontal force on every chord towards the span, between nothing and `k γ z Δy × width`, z the depth
//! of the chord's middle (a member `soil`). *Spread.* A load on a length w of the road spreads to either
//! side by `dispersal` × depth, down to the extrados below its middle, and presses evenly on the length
//! it has there; on a chord that it covers in part it acts at the middle of that part (Melbourne &
//! Gilbert 1995 spread alike, 1 horizontally to 2 vertically).

use super::{
    Plan,
    course::{Chord, chords},
};
use crate::{
    error::InputError,
    generate::check::Place,
    scene::{
        At, Load, Member, OnRoad,
        member::{Face, Near, Soil},
        template::{Bridge, Fill},
    },
};

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
            .map(|(s, p)| (s.rise + s.thickness, p.center))
            .fold((f64::NEG_INFINITY, 0.0), |a, b| if b.0 > a.0 { b } else { a });
        Self { level: crown.0 + fill.cover - fill.gradient * crown.1, gradient: fill.gradient }
    }

    fn height(&self, x: f64) -> f64 {
        self.level + self.gradient * x
    }
}

/// Checks the numbers of the fill, and that it lies on the arches.
pub(super) fn check(bridge: &Bridge, plan: &Plan) -> Result<(), InputError> {
    let Some(fill) = &bridge.fill else { return Ok(()) };
    let place = Place(Place::template("bridge").0.key("fill"));
    place.length("unit_weight", fill.unit_weight)?;
    place.finite("gradient", fill.gradient)?;
    let at_least = |field: &str, value: f64, hint: &str| {
        if value.is_finite() && value >= 0.0 {
            return Ok(());
        }
        Err(place.error(field, format!("must be at least 0, got {value}"), hint))
    };
    at_least("cover", fill.cover, "a length in m")?;
    at_least("dispersal", fill.dispersal, "metres to either side per metre of depth: 0.5")?;
    at_least("parapets", fill.parapets, "in N per metre of the bridge")?;
    at_least("passive", fill.passive.unwrap_or(0.0), "half of tan²(45° + φ/2): 1.5 for 30°")?;
    if fill.passive.is_some() && fill.friction_deg.is_some() {
        return Err(place.error(
            "friction_deg",
            "excludes passive, which it would give",
            "leave one of them out",
        ));
    }
    if let Some(angle) = fill.friction_deg.filter(|a| !(0.0..90.0).contains(a)) {
        return Err(place.error(
            "friction_deg",
            format!("must lie between 0 and 90, got {angle}"),
            "in degrees",
        ));
    }
    let road = Road::of(bridge, fill, plan);
    let list = chords(bridge, plan);
    let low = list.iter().flat_map(|c| [c.from, c.to]).find(|p| {
        road.height(p[0]) < p[1] - crate::tolerance::GRID_SNAP * bridge.spans[0].thickness
    });
    if let Some([x, z]) = low {
        return Err(place.error(
            "cover",
            format!("the road is {} m high at x = {x}, the extrados {z} m", road.height(x)),
            "a thicker cover, or a smaller gradient",
        ));
    }
    Ok(())
}

/// The dead loads of the fill and the parapets, names and places as in the template.
pub fn loads(bridge: &Bridge) -> Vec<Load> {
    let (Some(fill), Ok(plan)) = (&bridge.fill, Plan::of(bridge)) else { return Vec::new() };
    let road = Road::of(bridge, fill, &plan);
    let list = chords(bridge, &plan);
    let strip = |chord: &Chord| {
        let depth = [chord.from, chord.to].map(|p| (road.height(p[0]) - p[1]).max(0.0));
        let sum = depth[0] + depth[1];
        let weight = fill.unit_weight * bridge.width * 0.5 * sum * chord.length();
        let share = if sum > 0.0 { (depth[0] + 2.0 * depth[1]) / (3.0 * sum) } else { 0.5 };
        let x = chord.from[0] + share * chord.length();
        down(chord, x, weight)
    };
    let parapet = |chord: &Chord| {
        let x = 0.5 * (chord.from[0] + chord.to[0]);
        down(chord, x, fill.parapets * chord.length())
    };
    list.iter().filter_map(strip).chain(list.iter().filter_map(parapet)).collect()
}

/// A weight on a chord.
fn down(chord: &Chord, x: f64, weight: f64) -> Option<Load> {
    (weight > 0.0).then(|| Load {
        block: Some(chord.block.clone()),
        force: Some([0.0, 0.0, -weight]),
        at: Some(At::Point([x, 0.0, chord.height(x)])),
        ..Load::default()
    })
}

/// The members that stand for the resistance of the fill, names and places as in the template.
pub fn soil(bridge: &Bridge) -> Vec<Member> {
    let (Some(fill), Ok(plan)) = (&bridge.fill, Plan::of(bridge)) else { return Vec::new() };
    let k = match (fill.passive, fill.friction_deg) {
        (Some(k), _) => k,
        (None, Some(angle)) => 0.5 * (45.0 + 0.5 * angle).to_radians().tan().powi(2),
        (None, None) => return Vec::new(),
    };
    let road = Road::of(bridge, fill, &plan);
    let resists = |chord: &Chord| {
        let middle = [0, 1].map(|i| 0.5 * (chord.from[i] + chord.to[i]));
        let surface = road.height(middle[0]);
        (chord.towards != 0.0 && surface > middle[1] && k > 0.0).then(|| Member {
            id: format!("soil_{}", chord.block),
            soil: Some(Soil {
                block: chord.block.clone(),
                face: Face::Near(Near { near: [middle[0], 0.0, middle[1]] }),
                direction: [chord.towards, 0.0, 0.0],
                surface,
                unit_weight: fill.unit_weight,
                k,
            }),
            ..Member::default()
        })
    };
    chords(bridge, &plan).iter().filter_map(resists).collect()
}

/// What a load on the road comes to on the bridge.
pub struct Spread {
    /// Its parts, names and places as in the template.
    pub loads: Vec<Load>,
    /// Which share of it presses on springers and beyond.
    pub beside: f64,
}

/// What a `force` on a stretch of the road does to the bridge; `x` of the stretch is about the
/// template's origin. The plane model is as wide as the bridge: where less of it carries, the load
/// counts for more.
pub fn spread(bridge: &Bridge, on: OnRoad, force: [f64; 3]) -> Spread {
    let Ok(plan) = Plan::of(bridge) else { return Spread { loads: Vec::new(), beside: 1.0 } };
    let list = chords(bridge, &plan);
    // Over an abutment nothing says how deep it is.
    let below = list.iter().find(|c| c.from[0] <= on.x && on.x <= c.to[0]);
    let reach = match (&bridge.fill, below) {
        (Some(fill), Some(chord)) => {
            let road = Road::of(bridge, fill, &plan);
            (road.height(on.x) - chord.height(on.x)).max(0.0) * fill.dispersal
        }
        _ => 0.0,
    };
    let carries = on.across.map_or(bridge.width, |w| (w + 2.0 * reach).min(bridge.width));
    let length = on.patch + 2.0 * reach;
    let (from, to) = (on.x - 0.5 * length, on.x + 0.5 * length);
    let mut beside = 1.0;
    let mut loads = Vec::new();
    for chord in &list {
        let (a, b) = (chord.from[0].max(from), chord.to[0].min(to));
        if b <= a {
            continue;
        }
        let (x, share) = (0.5 * (a + b), (b - a) / length);
        beside -= share;
        loads.push(Load {
            block: Some(chord.block.clone()),
            force: Some(force.map(|f| f * share * bridge.width / carries)),
            at: Some(At::Point([x, 0.0, chord.height(x)])),
            ..Load::default()
        });
    }
    Spread { loads, beside: beside.max(0.0) }
}
