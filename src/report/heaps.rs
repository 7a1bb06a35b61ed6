//! The angle of repose of one protocol over several seeds as a result.

use analysis::{
    Outcome,
    repose::{Heap, Margin, Slope, confirm::Confirmed, seen::Seen},
};
use base::{error::Finding, number::short};
use check::proof::packing::Versions;
use scene::Protocol;
use serde::{Deserialize, Serialize};
use sweep::Mean;

/// The version of the format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum HeapsFormat {
    /// Version 1.
    #[default]
    #[serde(rename = "voussoir-repose/1")]
    V1,
}

/// The answer over all seeds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReposeFile {
    /// The format and its version.
    pub format: HeapsFormat,
    /// How the heaps were made.
    pub protocol: Protocol,
    /// The rolling arm over the mean radius, as the literature has it
    /// ([`Protocol::rolling_friction`]).
    #[serde(default)]
    pub rolling_friction: f64,
    /// Restitution of the contacts, and damping beside them: none is hidden.
    pub restitution: f64,
    /// See `restitution`.
    pub damping: f64,
    /// Mean angle of the heaps, degrees; `None` (null) where any of them has none: the mean of
    /// those that are left would be chosen by their angles.
    #[serde(default)]
    pub angle_deg: Option<f64>,
    /// Why there is no angle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub no_angle: Option<String>,
    /// Least and greatest angle over the seeds, degrees; with `angle_deg`.
    #[serde(default)]
    pub spread_deg: Option<[f64; 2]>,
    /// Standard error and 95 % interval of `angle_deg`, degrees: over the seeds; of one heap from the
    /// fit of its surface, which other seeds may leave.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub known_deg: Option<Mean>,
    /// What drum, hopper, shear box and cell show, over the seeds; none where any of them has a doubt.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub figures: Vec<Figure>,
    /// Heaps that came to rest.
    pub at_rest: usize,
    /// Heaps that have an angle of repose, or a figure without doubt.
    #[serde(default)]
    pub measured: usize,
    /// One heap a seed.
    pub heaps: Vec<HeapResult>,
    /// Versions.
    pub versions: Versions,
}

/// A figure over all seeds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Figure {
    /// Its name, with the unit where it has one.
    pub name: String,
    /// Mean over the seeds.
    pub mean: f64,
    /// Least and greatest.
    pub spread: [f64; 2],
    /// Standard error and 95 % interval of the mean over the seeds, where there are several.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub known: Option<Mean>,
}

impl Figure {
    /// In words; over several runs with its spread.
    pub fn says(&self, runs: usize) -> String {
        let (name, unit) = match self.name.as_str() {
            "dynamic_angle_deg" => ("dynamic angle", "°"),
            "by_centre_deg" => ("by the centre of mass", "°"),
            "dilatancy_deg" => ("dilatancy", "°"),
            "rate_kg_per_s" => ("discharge", " kg/s"),
            "bulk_density" => ("bulk density", " kg/m³"),
            "rate_over_beverloo" => ("over Beverloo's", ""),
            // The ends of the box carry part of the shear, however long it is.
            "residual_friction" => ("residual friction at most", ""),
            "peak_friction" => ("peak friction at most", ""),
            "internal_friction_over_published" => ("over the published", ""),
            other => (other, ""),
        };
        let spread = match self.known {
            Some(known) if runs > 1 => {
                let [low, high] = known.interval.map(short);
                format!(" ± {}{unit} (95 % interval {low} to {high}{unit})", short(known.error))
            }
            _ => String::new(),
        };
        format!("{} {}{unit}{spread}", name.replace('_', " "), short(self.mean))
    }
}

/// One heap.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeapResult {
    /// Its seed.
    pub seed: u64,
    /// Whether it came to rest.
    pub rested: bool,
    /// Mean kinetic energy of a grain at the end over m g d.
    pub energy: f64,
    /// Time simulated over √(d/g).
    pub time: f64,
    /// Free grains that stayed.
    pub grains: usize,
    /// Free grains that fell over the edge.
    pub discarded: usize,
    /// Angle of the fit through the mean surface, degrees; `None` (null) where that is no angle of
    /// repose.
    #[serde(default)]
    pub angle_deg: Option<f64>,
    /// Why it is none, one sentence each; empty where there is an angle.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub no_angle: Vec<String>,
    /// Coefficient of determination of the line through the cells.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub r_squared: Option<f64>,
    /// Standard error of the angle from the fit, degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error_deg: Option<f64>,
    /// Cells of the surface on it; 0 where they are fewer than three.
    pub cells: usize,
    /// Angles of strips or sectors, degrees; none where the heap has no angle.
    pub parts_deg: Vec<f64>,
    /// Tilt: the angle at which the bed began to flow, degrees.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub avalanche_deg: Option<f64>,
    /// What statics says of the heap at rest, where it was asked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub statics: Option<Confirmed>,
    /// What a drum, a hopper, a shear box or a cell shows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seen: Option<Seen>,
    /// The static margin, where it was asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub margin: Option<MarginResult>,
    /// Seconds of the simulation.
    pub seconds: f64,
    /// What the user should know.
    pub warnings: Vec<Finding>,
}

/// The tilt downhill that the heap at rest still bears.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MarginResult {
    /// What became of it.
    pub status: Outcome,
    /// Degrees, negative where the heap as it lies has no admissible forces.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub margin_deg: Option<f64>,
    /// Contacts of the heap.
    pub contacts: usize,
    /// Grains that nothing held, left out.
    pub loose: usize,
    /// Grains that no admissible forces balance as they lie, left out.
    pub unbalanced: usize,
    /// Seconds for the contacts and for the limit.
    pub seconds: [f64; 2],
}

impl From<&Margin> for MarginResult {
    fn from(m: &Margin) -> Self {
        Self {
            status: m.tilt.load_factor.outcome,
            margin_deg: m.degrees(),
            contacts: m.tilt.model.interfaces.list.len(),
            loose: m.loose,
            unbalanced: m.unbalanced,
            seconds: m.seconds,
        }
    }
}

impl HeapResult {
    /// Packs a heap.
    pub fn new(heap: &Heap, margin: Option<MarginResult>) -> Self {
        let (slope, refused) = (heap.slope.as_ref(), heap.refused.as_ref());
        Self {
            seed: heap.seed,
            rested: heap.rested,
            energy: heap.energy,
            time: heap.time,
            grains: heap.grains[0],
            discarded: heap.grains[1],
            angle_deg: slope.map(|s| s.angle_deg),
            no_angle: refused.map_or_else(Vec::new, |r| r.reasons.clone()),
            error_deg: slope.map(|s| s.error_deg),
            r_squared: slope.map(|s| s.r_squared).or(refused.and_then(|r| r.r_squared)),
            cells: slope.map(|s| s.cells).or(refused.map(|r| r.cells)).unwrap_or(0),
            parts_deg: heap.parts.iter().map(|s: &Slope| s.angle_deg).collect(),
            avalanche_deg: heap.avalanche_deg,
            seen: heap.seen.clone(),
            statics: heap.statics.clone(),
            margin,
            seconds: heap.seconds,
            warnings: heap.findings.clone(),
        }
    }
}

impl ReposeFile {
    /// The answer over all heaps: a mean only where every one of them has an angle.
    pub fn new(protocol: &Protocol, heaps: Vec<HeapResult>) -> Self {
        let angles: Vec<f64> = heaps.iter().filter_map(|h| h.angle_deg).collect();
        let slopes = protocol.kind.leaves_a_slope();
        let sure = heaps.iter().filter(|h| h.seen.is_some() && h.no_angle.is_empty()).count();
        let sound = if slopes { angles.len() } else { sure } == heaps.len() && !heaps.is_empty();
        let whole = !angles.is_empty() && angles.len() == heaps.len();
        let mean = angles.iter().sum::<f64>() / angles.len().max(1) as f64;
        let ends = [
            angles.iter().copied().fold(f64::INFINITY, f64::min),
            angles.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        ];
        Self {
            format: HeapsFormat::V1,
            protocol: protocol.sized(),
            rolling_friction: protocol.rolling_friction(),
            restitution: protocol.restitution,
            damping: 0.0,
            angle_deg: whole.then_some(mean),
            no_angle: (!sound).then(|| reason(&heaps)),
            spread_deg: whole.then_some(ends),
            known_deg: Mean::of(&angles).or_else(|| of_one(&heaps)).filter(|_| whole),
            at_rest: heaps.iter().filter(|h| h.rested).count(),
            figures: if sound && !slopes { figures(&heaps) } else { Vec::new() },
            measured: if slopes { angles.len() } else { sure },
            heaps,
            versions: Versions::default(),
        }
    }
}

/// How well the angle of a single heap is known, by the line through its cells.
fn of_one(heaps: &[HeapResult]) -> Option<Mean> {
    let [heap] = heaps else { return None };
    Mean::new(heap.angle_deg?, heap.error_deg?, heap.cells.saturating_sub(2))
}

/// What was seen, over all heaps.
fn figures(heaps: &[HeapResult]) -> Vec<Figure> {
    let seen: Vec<Vec<(&str, f64)>> =
        heaps.iter().filter_map(|h| h.seen.as_ref()).map(Seen::figures).collect();
    let names = seen.first().map(|f| f.iter().map(|(name, _)| *name)).into_iter().flatten();
    let figure = |(k, name): (usize, &str)| {
        let values: Vec<f64> = seen.iter().map(|f| f[k].1).collect();
        let end = |f: fn(f64, f64) -> f64, from: f64| values.iter().copied().fold(from, f);
        Figure {
            name: name.into(),
            mean: values.iter().sum::<f64>() / values.len() as f64,
            spread: [end(f64::min, f64::INFINITY), end(f64::max, f64::NEG_INFINITY)],
            known: Mean::of(&values),
        }
    };
    names.enumerate().map(figure).collect()
}

impl ReposeFile {
    /// Grains of one heap: those of one's own, or as many as the protocol has.
    pub fn grains(&self) -> usize {
        self.heaps.first().map_or(self.protocol.grains, |h| h.grains + h.discarded)
    }

    /// Whether what was asked has an answer.
    pub fn is_answered(&self) -> bool {
        self.no_angle.is_none()
    }
}

/// Why a row of heaps has no angle: the reason of the first that has none.
fn reason(heaps: &[HeapResult]) -> String {
    let open =
        |h: &&HeapResult| h.angle_deg.is_none() && (h.seen.is_none() || !h.no_angle.is_empty());
    let mut without = heaps.iter().filter(open);
    let Some(first) = without.next() else { return "there is no heap".into() };
    let more = match without.count() {
        0 => String::new(),
        1 => " (and one more heap has none)".into(),
        n => format!(" (and {n} more heaps have none)"),
    };
    let why = first.no_angle.first().map_or("not measured", String::as_str);
    format!("seed {}: {why}{more}", first.seed)
}
