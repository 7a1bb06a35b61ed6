//! DXF (ASCII): closed outlines of a plane drawing (LWPOLYLINE, POLYLINE), each a prism of
//! [`ImportOptions::depth`].
//!
//! A drawing's x stays x, its y becomes z, and the depth goes along y. A file is pairs of lines, a
//! group code and a value; codes are those of Autodesk's DXF reference.

use super::{
    ImportOptions,
    raw::{Raw, Solid, list, tally},
    text::{self, shorten},
};
use crate::Material;
use base::{
    error::{FindingCode, InputError, JsonPath},
    tolerance::{CONTACT_GAP, DEFAULT_DENSITY},
};
use std::{
    borrow::Cow,
    collections::{BTreeMap, HashMap},
};

/// How far a chord may lie from its arc, relative to the size of its outline. Larger: two rings that meet
/// on an arc, in pieces of other lengths, part by more than the gap that contacts may have
/// ([`CONTACT_GAP`]); with a quarter of it their blocks may differ in size three times. Smaller: corners for
/// nothing.
const CHORD: f64 = 0.25 * CONTACT_GAP;

/// Flags of a polyline: its last corner joins its first; it is a line in space, a mesh of polygons, a
/// polyface mesh.
const CLOSED: i64 = 1;
const IN_SPACE: i64 = 8 | 16 | 64;

/// One value with its group code and the line of the value.
struct Pair<'a> {
    code: i32,
    value: Cow<'a, str>,
    line: usize,
}

/// A corner of an outline.
struct Corner {
    at: [f64; 2],
    /// Tangent of a quarter of the angle of the arc to the next corner; 0 for a line.
    bulge: f64,
}

/// An entity: its type and what follows up to the next.
type Entity<'a> = (&'a Pair<'a>, &'a [Pair<'a>]);

/// The blocks of a DXF file.
pub(super) fn read(bytes: &[u8], options: &ImportOptions) -> Result<Raw, InputError> {
    let pairs = pairs(bytes)?;
    let mut raw = Raw::default();
    unit(&pairs, options, &mut raw)?;
    let scale = raw.scale(options);
    let (mut skipped, mut layers) = (BTreeMap::<String, usize>::new(), BTreeMap::new());
    let mut known: HashMap<Vec<[u64; 2]>, String> = HashMap::new();
    let (mut open, mut doubled) = (Vec::new(), Vec::new());
    let mut arcs = 0;
    for (kind, body) in entities(&pairs) {
        // The vertices of a POLYLINE follow as entities of their own.
        let head = &body[..body.iter().position(|p| p.code == 0).unwrap_or(body.len())];
        let word = |code| head.iter().find(|p| p.code == code).map(|p| &*p.value);
        let flags: i64 = word(70).and_then(|w| w.parse().ok()).unwrap_or(0);
        let vertices = match &*kind.value {
            "LWPOLYLINE" => body,
            "POLYLINE" if flags & IN_SPACE == 0 => &body[head.len()..],
            other => {
                *skipped.entry(shorten(other)).or_default() += 1;
                continue;
            }
        };
        let layer = word(8).unwrap_or("0").to_string();
        let handle = word(5).map_or_else(|| format!("line{}", kind.line), str::to_string);
        let id = format!("{layer}-{handle}");
        if head.iter().any(|p| p.code == 230 && p.value.parse() != Ok(1.0)) {
            *skipped.entry(format!("{} not facing +z", kind.value)).or_default() += 1;
            continue;
        }
        let (corners, joined) = outline(vertices)?;
        if (flags & CLOSED == 0 && !joined) || corners.len() < 2 {
            let at = corners.first().map_or([0.0; 2], |c| c.at);
            open.push(format!("{:?} at ({}, {}), line {}", id, at[0], at[1], kind.line));
            continue;
        }
        arcs += corners.iter().filter(|c| c.bulge != 0.0).count();
        let ring = chords(&corners);
        let mut key: Vec<[u64; 2]> = ring.iter().map(|p| p.map(|c| (c + 0.0).to_bits())).collect();
        key.sort_unstable();
        if let Some(first) = known.get(&key) {
            let at = corners[0].at;
            doubled.push(format!("{id:?} over {first:?} at ({}, {})", at[0], at[1]));
        }
        known.insert(key, id.clone());
        let depth = options.depth.ok_or_else(|| {
            text::error(kind.line, format!("the outline {id:?} has no depth"))
                .hint("a plane drawing needs `--depth D`, the thickness in m")
        })?;
        *layers.entry(layer.clone()).or_insert(0_usize) += 1;
        let support = options.support_layers.contains(&layer);
        let solid = prism(ring, depth / scale);
        raw.blocks.push(Solid {
            id,
            support,
            material: Some(layer),
            line: Some(kind.line),
            ..solid
        });
    }
    if let Some(name) = options.support_layers.iter().find(|l| !layers.contains_key(*l)) {
        let names: Vec<String> = layers.keys().map(|l| format!("{l:?}")).collect();
        let message = format!("support layer {name:?}: no outline is on it");
        return Err(InputError::at(JsonPath::root(), message)
            .hint(format!("the layers with outlines are {}", list(&names))));
    }
    let count = |map: &BTreeMap<String, usize>| {
        list(&map.iter().map(|(k, n)| format!("{k} {n}")).collect::<Vec<_>>())
    };
    if !skipped.is_empty() {
        raw.say(
            FindingCode::LeftOut,
            format!(
                "entities left out, only closed LWPOLYLINE and POLYLINE are read: {}",
                count(&skipped)
            ),
        );
    }
    if !open.is_empty() {
        raw.say(
            FindingCode::LeftOut,
            format!("open polylines, left out: {}; close them in the drawing", tally(&open)),
        );
    }
    if !doubled.is_empty() {
        raw.say(
            FindingCode::Converted,
            format!("outlines drawn twice: {}; delete one of each", tally(&doubled)),
        );
    }
    if arcs > 0 {
        raw.say(
            FindingCode::Converted,
            format!("arcs replaced by chords within {CHORD:e} of the outline's size: {arcs}"),
        );
    }
    if !layers.is_empty() {
        raw.say(FindingCode::Converted, format!("outlines by layer: {}; drawing x is x, y is z, the depth goes along y; `--support-layer NAME` makes a layer's blocks supports; each layer is a material of {DEFAULT_DENSITY} kg/m³, assumed", count(&layers)));
    }
    raw.materials =
        layers.into_keys().map(|l| (l, Material::of_density(DEFAULT_DENSITY))).collect();
    raw.name_apart("outline");
    Ok(raw)
}

fn pairs(bytes: &[u8]) -> Result<Vec<Pair<'_>>, InputError> {
    if bytes.starts_with(b"AutoCAD Binary DXF") {
        return Err(text::error(1, "a binary DXF file").hint("save as ASCII DXF"));
    }
    let mut lines = text::split(text::unmarked(bytes)).enumerate();
    let mut pairs = Vec::new();
    while let Some((index, code)) = lines.next() {
        let word = String::from_utf8_lossy(code);
        let Some((at, value)) = lines.next() else {
            if word.trim().is_empty() {
                break;
            }
            return Err(text::error(index + 1, "a group code without a value")
                .hint("the file may be cut off here"));
        };
        let code = word.trim().parse().map_err(|_| {
            text::error(index + 1, format!("expected a group code, got {:?}", shorten(&word)))
                .hint("the file is damaged, or no ASCII DXF")
        })?;
        let value = String::from_utf8_lossy(value.trim_ascii());
        // Codes that no reader here looks at are dropped at once.
        if matches!(code, 0 | 2 | 5 | 8 | 9 | 10 | 20 | 42 | 70 | 230) {
            pairs.push(Pair { code, value, line: at + 1 });
        }
    }
    Ok(pairs)
}

/// Those of the section ENTITIES.
fn entities<'a>(pairs: &'a [Pair<'a>]) -> Vec<Entity<'a>> {
    let begin = pairs
        .windows(2)
        .position(|p| p[0].code == 0 && p[0].value == "SECTION" && p[1].value == "ENTITIES");
    let rest = begin.map_or(&[][..], |b| &pairs[b + 2..]);
    let end = rest.iter().position(|p| p.code == 0 && p.value == "ENDSEC").unwrap_or(rest.len());
    let goes_on = |next: &Pair| next.code != 0 || matches!(&*next.value, "VERTEX" | "SEQEND");
    rest[..end].chunk_by(|_, next| goes_on(next)).filter_map(|chunk| chunk.split_first()).collect()
}

/// The unit that the drawing names, and what is said of it.
fn unit(pairs: &[Pair], options: &ImportOptions, raw: &mut Raw) -> Result<(), InputError> {
    let named = pairs.windows(2).find(|p| p[0].code == 9 && p[0].value == "$INSUNITS");
    let (name, size) = match named.map_or("0", |p| &*p[1].value) {
        "0" => ("none", None),
        "1" => ("inches", Some(0.0254)),
        "2" => ("feet", Some(0.3048)),
        "4" => ("mm", Some(0.001)),
        "5" => ("cm", Some(0.01)),
        "6" => ("m", Some(1.0)),
        other if options.scale.is_some() => (other, None),
        other => {
            let line = named.map_or(1, |p| p[1].line);
            let text = format!("unit {:?} of $INSUNITS is not known", shorten(other));
            return Err(text::error(line, text).hint("give the metres in a unit with `--scale`"));
        }
    };
    let (code, text) = match (options.scale, size) {
        (Some(_), _) => (
            FindingCode::Converted,
            format!("units of the drawing: {}; the scale given is used instead", shorten(name)),
        ),
        (None, Some(size)) => {
            (FindingCode::Converted, format!("units of the drawing: {name}, 1 = {size} m"))
        }
        (None, None) => (
            FindingCode::Missing,
            "the drawing names no unit ($INSUNITS), taken as metres: `--scale 0.001` if it is in mm"
                .into(),
        ),
    };
    raw.say(code, text);
    raw.unit = size;
    Ok(())
}

/// Corners of a polyline, and whether the last was the first again.
fn outline(body: &[Pair]) -> Result<(Vec<Corner>, bool), InputError> {
    let mut corners: Vec<Corner> = Vec::new();
    for pair in body.iter().filter(|p| matches!(p.code, 10 | 20 | 42)) {
        let number = pair.value.parse().ok().filter(|v: &f64| v.is_finite()).ok_or_else(|| {
            text::error(
                pair.line,
                format!("expected a finite number, got {:?}", shorten(&pair.value)),
            )
            .hint("the file may be damaged here")
        })?;
        match (pair.code, corners.last_mut()) {
            (10, _) => corners.push(Corner { at: [number, 0.0], bulge: 0.0 }),
            (20, Some(corner)) => corner.at[1] = number,
            (42, Some(corner)) => corner.bulge = number,
            _ => {}
        }
    }
    let joined = corners.len() > 1 && corners.first().map(|c| c.at) == corners.last().map(|c| c.at);
    if joined {
        corners.pop();
    }
    Ok((corners, joined))
}

/// The outline with arcs as chords.
fn chords(corners: &[Corner]) -> Vec<[f64; 2]> {
    let ends = |k: usize| {
        let along = corners.iter().map(|c| c.at[k]);
        along.clone().fold(f64::NEG_INFINITY, f64::max) - along.fold(f64::INFINITY, f64::min)
    };
    let size = ends(0).hypot(ends(1));
    let mut ring = Vec::new();
    for (i, &Corner { at: a, bulge: bend }) in corners.iter().enumerate() {
        ring.push(a);
        let b = corners[(i + 1) % corners.len()].at;
        let angle = 4.0 * bend.atan();
        let chord = (b[0] - a[0]).hypot(b[1] - a[1]);
        let radius = 0.25 * chord * (bend.abs() + 1.0 / bend.abs());
        // An arc of more than half a circle reaches beyond its corners.
        let size = if bend.abs() > 1.0 { size.max(radius) } else { size };
        // A chord of the angle φ lies r (1 − cos φ/2) = 2 r sin² φ/4 from its arc.
        let step = 4.0 * (0.5 * CHORD * size / radius).min(1.0).sqrt().asin();
        let count = (angle.abs() / step).ceil() as usize;
        if count < 2 {
            continue;
        }
        // The centre lies left of the chord for arcs that turn left by less than half a circle.
        let off = (1.0 / bend - bend) / 4.0;
        let c =
            [(a[0] + b[0]) / 2.0 - off * (b[1] - a[1]), (a[1] + b[1]) / 2.0 + off * (b[0] - a[0])];
        let arm = [a[0] - c[0], a[1] - c[1]];
        for k in 1..count {
            let (s, t) = (angle * k as f64 / count as f64).sin_cos();
            ring.push([c[0] + t * arm[0] - s * arm[1], c[1] + s * arm[0] + t * arm[1]]);
        }
    }
    ring
}

/// The prism of an outline, faces outward.
fn prism(mut ring: Vec<[f64; 2]>, depth: f64) -> Solid {
    let n = ring.len();
    let o = ring[0];
    let cross =
        |p: [f64; 2], q: [f64; 2]| (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
    if ring.windows(2).map(|p| cross(p[0], p[1])).sum::<f64>() < 0.0 {
        ring.reverse();
    }
    let side = |y: f64| ring.iter().map(move |p| [p[0], y, p[1]]);
    let vertices = side(0.0).chain(side(depth)).collect();
    let mut faces = vec![(0..n).collect(), (n..2 * n).rev().collect()];
    faces.extend((0..n).map(|i| (i, (i + 1) % n)).map(|(i, j)| vec![j, i, i + n, j + n]));
    Solid { vertices, faces, ..Solid::default() }
}
