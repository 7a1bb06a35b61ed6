//! Heaps that came to rest, one a seed.

use super::{Cover, Part, Record, Section};
use crate::heaps::{HeapResult, ReposeFile};
use crate::text::heaps::known;
use base::number::short;
use check::{proof::packing::Versions, terms::Outcome};
use scene::ProtocolKind;
use serde_json::Value;

/// Of the values of a protocol.
const UNITS: &str = "Diameter in m, density in kg/m³; size and rolling arm in mean diameters; rate in \
                     √(g d), for rotating parts in degrees per √(d/g), of a cell as inertial number; pressure in ρ g d.";

impl Record {
    /// The record of heaps: how they were made, what came of each, and the drawing of the first.
    pub fn of_heaps(file: &ReposeFile, drawing: String, made: String) -> Self {
        let asked = vec![
            ["question".into(), question(file.protocol.kind).into()],
            ["answer".into(), answer(file)],
            ["meaning".into(), meaning(file.protocol.kind).into()],
        ];
        let appendices = vec![
            Section::new(
                "How they were made",
                vec![Part::Facts(protocol(file)), Part::Text(UNITS.into())],
            ),
            Section::new("Versions", vec![Part::Facts(versions(&file.versions, made))]),
        ];
        Self {
            cover: Cover { asked, drawing, ..Cover::signed("", &scene::Record::default()) },
            results: vec![Section::new("The heaps", vec![table(&file.heaps)])],
            appendices,
        }
    }
}

fn meaning(kind: ProtocolKind) -> &'static str {
    if kind.leaves_a_slope() {
        "Slope of the straight line through the mean surface of a heap at rest: computed, not \
         proved. The margin beside it is proved for the heap as it lies."
    } else {
        "Computed, not proved; docs/grains.md explains how it is measured."
    }
}

fn question(kind: ProtocolKind) -> &'static str {
    match kind {
        ProtocolKind::Drum => "At what slope do grains flow in a rotating drum?",
        ProtocolKind::Hopper => "How fast do grains discharge through an opening?",
        ProtocolKind::Shear | ProtocolKind::Cell => "How much do grains resist shear?",
        _ => "At what slope do grains come to rest?",
    }
}

fn answer(file: &ReposeFile) -> String {
    match file.angle_deg {
        Some(angle) => format!("angle of repose {}°{}", short(angle), known(file)),
        _ if !file.figures.is_empty() => {
            let figures = file.figures.iter().map(|f| f.says(file.measured));
            figures.collect::<Vec<_>>().join("; ")
        }
        _ => format!("no value: {}", file.no_angle.as_deref().unwrap_or("not measured")),
    }
}

fn versions(v: &Versions, made: String) -> Vec<[String; 2]> {
    vec![
        ["voussoir".into(), v.voussoir.clone()],
        ["format of results".into(), "voussoir-repose/1".into()],
        ["made".into(), made],
    ]
}

/// The protocol, key by key as it is written.
fn protocol(file: &ReposeFile) -> Vec<[String; 2]> {
    let value = serde_json::to_value(&file.protocol).unwrap_or_default();
    let words = |v: &Value| match v {
        Value::String(text) => text.clone(),
        other => other.to_string(),
    };
    let own = value.as_object().into_iter().flatten();
    let own = own.filter(|(_, v)| !v.is_null()).map(|(k, v)| [k.replace('_', " "), words(v)]);
    let hidden = [("rolling friction (of R)", file.rolling_friction), ("damping", file.damping)];
    own.chain(hidden.map(|(k, v)| [k.into(), short(v)])).collect()
}

fn table(heaps: &[HeapResult]) -> Part {
    let number = |v: Option<f64>| v.map_or("–".into(), |v| format!("{v:.2}"));
    let row = |h: &HeapResult| {
        let margin = h.margin.as_ref().map_or("–".into(), |m| match m.status {
            Outcome::Found => number(m.margin_deg),
            Outcome::Unbounded => "wedged".into(),
            Outcome::Impossible | Outcome::Undecided => "none".into(),
        });
        vec![
            h.seed.to_string(),
            if h.rested { "at rest" } else { "moves" }.into(),
            h.grains.to_string(),
            h.discarded.to_string(),
            number(h.angle_deg),
            h.r_squared.map_or("–".into(), |r| format!("{r:.4}")),
            h.cells.to_string(),
            h.parts_deg.iter().map(|a| format!("{a:.1}")).collect::<Vec<_>>().join(", "),
            margin,
            h.no_angle.join("; "),
        ]
    };
    let columns = [
        "seed",
        "state",
        "#grains",
        "#fell off",
        "#angle, °",
        "#R²",
        "#cells",
        "parts, °",
        "#margin, °",
        "why no angle",
    ];
    Part::table(
        &columns,
        heaps.iter().map(row).collect(),
        "Angle and R² of the line through the cells of the mean surface; parts: strips or sectors of \
         the same heap. Margin: the further tilt downhill that the heap bears, with joints that \
         open as they slide: an upper bound.",
    )
}
