//! What plane drawings of all formats have in common: outlines on layers, and what becomes of them.
//!
//! A drawing's x stays x, its y becomes z, and the depth goes along y.

use super::{
    ImportOptions, LayerRule, Role,
    raw::{Raw, Solid, list, tally},
};
use crate::{
    At, Load, Material, Member,
    member::{End, Line, Strength},
};
use base::{
    error::{FindingCode, InputError, JsonPath},
    number::count,
    tolerance::{CONTACT_GAP, DEFAULT_DENSITY, LOWEST_BAND},
};
use std::collections::{BTreeMap, HashMap};

/// How far a chord may lie from its arc, relative to the size of its outline. Larger: two rings that meet
/// on an arc, in pieces of other lengths, part by more than the gap that contacts may have
/// ([`CONTACT_GAP`]); with a quarter of it their blocks may differ in size three times. Smaller: corners for
/// nothing.
pub(super) const CHORD: f64 = 0.25 * CONTACT_GAP;

/// A point of a drawing.
pub(super) type Point = [f64; 2];

/// Something drawn: where, on which layer, under which name.
#[derive(Debug, Default)]
pub(super) struct Drawn<T> {
    pub id: String,
    pub layer: String,
    /// Counted from 1.
    pub line: Option<usize>,
    pub what: T,
}

/// What a drawing holds.
#[derive(Debug, Default)]
pub(super) struct Drawing {
    /// Closed rings of corners.
    pub outlines: Vec<Drawn<Vec<Point>>>,
    /// Bodies in space.
    pub bodies: Vec<Drawn<Solid>>,
    pub lines: Vec<Drawn<[Point; 2]>>,
    pub points: Vec<Drawn<Point>>,
    /// Lines that do not close, and where they begin.
    pub open: Vec<Drawn<Point>>,
    /// What is no block, by kind.
    pub skipped: BTreeMap<String, usize>,
    /// Arcs that became chords.
    pub arcs: usize,
}

/// What stands on a layer, and how large it is.
#[derive(Default)]
struct Content {
    blocks: usize,
    lines: usize,
    points: usize,
    /// Of the largest block along x and y.
    size: Point,
    /// Lowest corner of all, and of the block that lies highest.
    low: [f64; 2],
}

impl Drawing {
    /// Blocks, ties and loads of what is drawn.
    pub fn into_raw(mut self, mut raw: Raw, options: &ImportOptions) -> Result<Raw, InputError> {
        let layers = self.layers();
        if let Some(name) = options.layers.keys().find(|l| !layers.contains_key(*l)) {
            let names: Vec<String> = layers.keys().map(|l| format!("{l:?}")).collect();
            let message = format!("layer {name:?}: nothing of it is read");
            return Err(InputError::at(JsonPath::root(), message)
                .hint(format!("the layers with outlines are {}", list(&names))));
        }
        self.say(&layers, options, &mut raw);
        let rule = |layer: &str| options.layers.get(layer).cloned().unwrap_or_default();
        self.outlines.retain(|o| rule(&o.layer).has_blocks());
        self.bodies.retain(|o| rule(&o.layer).has_blocks());
        let scale = raw.scale(options);
        let mut depths = Vec::new();
        for Drawn { id, layer, line, what: ring } in &self.outlines {
            let rule = rule(layer);
            let depth = rule.depth.or(options.depth).ok_or_else(|| InputError {
                position: line.map(|line| (line, 1)),
                ..InputError::at(JsonPath::root(), format!("the outline {id:?} has no depth"))
                    .hint("a plane drawing needs `--depth D`, the thickness in m")
            })? / scale;
            depths.push(depth);
            let solid = prism(ring, depth);
            raw.blocks.push(solid.on(id, layer, &rule, *line));
        }
        self.ties_and_loads(&mut raw, options, &depths);
        for Drawn { id, layer, line, what } in std::mem::take(&mut self.bodies) {
            raw.blocks.push(what.on(&id, &layer, &rule(&layer), line));
        }
        for layer in layers.into_keys() {
            let rule = rule(&layer);
            if let Some(density) = rule.density {
                raw.materials.insert(layer, Material::of_density(density));
            } else {
                raw.materials.entry(layer).or_insert(Material::of_density(DEFAULT_DENSITY));
            }
        }
        raw.materials.retain(|l, _| raw.blocks.iter().any(|b| b.material.as_ref() == Some(l)));
        raw.name_apart("outline");
        Ok(raw)
    }

    fn layers(&self) -> BTreeMap<String, Content> {
        let mut layers: BTreeMap<String, Content> = BTreeMap::new();
        let boxes = self.outlines.iter().map(|o| (&o.layer, bounds(o.what.iter().copied())));
        let flat = |v: &[f64; 3]| [v[0], v[2]];
        let solids =
            self.bodies.iter().map(|b| (&b.layer, bounds(b.what.vertices.iter().map(flat))));
        for (layer, [low, high]) in boxes.chain(solids) {
            let content = layers.entry(layer.clone()).or_default();
            content.low = match content.blocks {
                0 => [low[1]; 2],
                _ => [content.low[0].min(low[1]), content.low[1].max(low[1])],
            };
            content.blocks += 1;
            let size = [high[0] - low[0], high[1] - low[1]];
            if size[0] * size[1] > content.size[0] * content.size[1] {
                content.size = size;
            }
        }
        self.lines.iter().for_each(|l| layers.entry(l.layer.clone()).or_default().lines += 1);
        self.points.iter().for_each(|l| layers.entry(l.layer.clone()).or_default().points += 1);
        layers
    }

    /// What is worth knowing about the drawing.
    fn say(&self, layers: &BTreeMap<String, Content>, options: &ImportOptions, raw: &mut Raw) {
        let idle = |layer: &str, role| options.layers.get(layer).is_none_or(|r| r.role != role);
        let mut skipped = self.skipped.clone();
        for (kind, role, all) in [
            ("LINE", Role::Tie, self.lines.iter().map(|l| &l.layer).collect::<Vec<_>>()),
            ("POINT", Role::Load, self.points.iter().map(|l| &l.layer).collect()),
        ] {
            let count = all.iter().filter(|l| idle(l, role)).count();
            if count > 0 {
                skipped.insert(kind.into(), count);
            }
        }
        if !skipped.is_empty() {
            let names: Vec<String> = skipped.iter().map(|(k, n)| format!("{k} {n}")).collect();
            raw.say(
                FindingCode::LeftOut,
                format!("left out, no closed outline or body: {}", list(&names)),
            );
        }
        let place = |p: Point| format!("({}, {})", p[0], p[1]);
        if !self.open.is_empty() {
            let line = |l: Option<usize>| l.map_or(String::new(), |l| format!(", line {l}"));
            let told: Vec<String> = self
                .open
                .iter()
                .map(|o| format!("{:?} at {}{}", o.id, place(o.what), line(o.line)))
                .collect();
            let text =
                format!("open outlines, left out: {}; close them in the drawing", tally(&told));
            raw.say(FindingCode::LeftOut, text);
        }
        let mut known: HashMap<Vec<[u64; 2]>, &str> = HashMap::new();
        let mut doubled = Vec::new();
        for outline in &self.outlines {
            let bits = |p: &Point| p.map(|c| (c + 0.0).to_bits());
            let mut key: Vec<[u64; 2]> = outline.what.iter().map(bits).collect();
            key.sort_unstable();
            if let Some(first) = known.insert(key, &outline.id) {
                let at = outline.what.first().map_or(String::new(), |p| place(*p));
                doubled.push(format!("{:?} over {first:?} at {at}", outline.id));
            }
        }
        if !doubled.is_empty() {
            let text = format!("outlines drawn twice: {}; delete one of each", tally(&doubled));
            raw.say(FindingCode::Converted, text);
        }
        if self.arcs > 0 {
            let text = format!(
                "arcs replaced by chords within {CHORD:e} of the outline's size: {}",
                self.arcs
            );
            raw.say(FindingCode::Converted, text);
        }
        if !self.outlines.is_empty() && !self.bodies.is_empty() {
            raw.say(
                FindingCode::Converted,
                "plane outlines beside bodies in space: outlines stand upright on y = 0, bodies where they are drawn; `--layer NAME=ignore` leaves a layer out",
            );
        }
        if !layers.is_empty() {
            let text = told(layers, options, &raw.materials, !self.outlines.is_empty());
            raw.say(FindingCode::Converted, text);
        }
    }

    /// Ties between blocks and loads on them; `depths` are those of the outlines.
    fn ties_and_loads(&self, raw: &mut Raw, options: &ImportOptions, depths: &[f64]) {
        let mut missed = Vec::new();
        let mut on_block = |id: &str, p: Point| match self.at(p) {
            Ok(k) => Some((self.outlines[k].id.clone(), [p[0], depths[k] / 2.0, p[1]])),
            Err(why) => {
                missed.push(format!("{id:?}: ({}, {}) {why}", p[0], p[1]));
                None
            }
        };
        for Drawn { id, layer, what: ends, .. } in &self.lines {
            let Some(strength) = options.layers.get(layer).and_then(|r| r.strength) else {
                continue;
            };
            let [Some(a), Some(b)] = ends.map(|p| on_block(id, p)) else { continue };
            let end = |(block, at)| End { block: Some(block), at: Some(at), ..End::default() };
            let line = Line {
                between: [end(a), end(b)],
                strength: Strength::Finite(strength),
                prestress: 0.0,
                stiffness: None,
            };
            raw.members.push(Member { id: id.clone(), tie: Some(line), ..Member::default() });
        }
        for Drawn { id, layer, what, .. } in &self.points {
            let Some([x, y]) = options.layers.get(layer).and_then(|r| r.force) else { continue };
            let Some((block, at)) = on_block(id, *what) else { continue };
            raw.loads.push(Load {
                block: Some(block),
                force: Some([x, 0.0, y]),
                at: Some(At::Point(at)),
                ..Load::default()
            });
        }
        if !missed.is_empty() {
            let text = format!(
                "ends of ties and points of loads that are on no block, left out: {}",
                tally(&missed)
            );
            raw.say(FindingCode::LeftOut, text);
        }
    }

    /// The outline that a point lies in, or on the edge of.
    fn at(&self, p: Point) -> Result<usize, String> {
        let mut found: Vec<(f64, usize)> = Vec::new();
        for (k, outline) in self.outlines.iter().enumerate() {
            let [low, high] = bounds(outline.what.iter().copied());
            let slack = CONTACT_GAP * (high[0] - low[0]).hypot(high[1] - low[1]);
            let depth = depth_inside(&outline.what, p);
            if depth >= -slack {
                // On its edge, inside and outside are the same.
                found.push((if depth.abs() <= slack { 0.0 } else { depth }, k));
            }
        }
        found.sort_by(|a, b| b.0.total_cmp(&a.0));
        match found[..] {
            [] => Err("is in no outline".into()),
            [(a, k), (b, l), ..] if a == b => Err(format!(
                "is on the edge of both {:?} and {:?}: draw it inside one of them",
                self.outlines[k].id, self.outlines[l].id
            )),
            [(_, k), ..] => Ok(k),
        }
    }
}

impl Solid {
    /// The same as a block of a layer.
    fn on(self, id: &str, layer: &str, rule: &LayerRule, line: Option<usize>) -> Self {
        Solid {
            id: id.into(),
            support: self.support || rule.role == Role::Support,
            material: Some(layer.into()),
            line: line.or(self.line),
            ..self
        }
    }
}

/// The layers in words, and where nothing is said of them a proposal.
fn told(
    layers: &BTreeMap<String, Content>,
    options: &ImportOptions,
    known: &BTreeMap<String, Material>,
    plane: bool,
) -> String {
    let with_blocks: Vec<(&String, &Content)> = layers.iter().filter(|l| l.1.blocks > 0).collect();
    let words = |(name, c): (&String, &Content)| {
        let mut parts = Vec::new();
        if c.blocks > 0 {
            let what = count(c.blocks, if plane { "outline" } else { "block" });
            let [x, y] = c.size.map(|s| {
                format!("{:.4}", s).trim_end_matches('0').trim_end_matches('.').to_string()
            });
            parts.push(format!("{what}, the largest {x} × {y}"));
        }
        let more = [("line", c.lines), ("point", c.points)];
        parts.extend(more.iter().filter(|m| m.1 > 0).map(|&(what, n)| count(n, what)));
        format!("{name:?} {}", parts.join(", "))
    };
    let all: Vec<String> = layers.iter().map(words).collect();
    let mut text = format!("layers (in units of the drawing): {}", all.join("; "));
    if plane {
        text.push_str("; drawing x is x, y is z, the depth goes along y");
    }
    let assumed = with_blocks.iter().any(|(name, _)| {
        options.density.is_none()
            && !known.contains_key(*name)
            && options.layers.get(*name).is_none_or(|r| r.has_blocks() && r.density.is_none())
    });
    if assumed {
        text.push_str(&format!(
            "; each layer is a material of {DEFAULT_DENSITY} kg/m³ where nothing else is said"
        ));
    }
    if options.layers.is_empty() {
        let low = with_blocks.iter().map(|l| l.1.low[0]).fold(f64::INFINITY, f64::min);
        let high = with_blocks.iter().map(|l| l.1.low[1]).fold(f64::NEG_INFINITY, f64::max);
        let role = |c: &Content| match c.low[1] <= low + LOWEST_BAND * (high - low) && high > low {
            true => "support",
            false => "block,density=2400",
        };
        // Quoted: names of layers may hold what a shell reads.
        let rules: Vec<String> =
            with_blocks.iter().map(|(name, c)| format!("--layer '{name}={}'", role(c))).collect();
        if !rules.is_empty() {
            text.push_str(&format!("; say what they are, for instance `{}`", rules.join(" ")));
        }
    }
    text
}

/// Lowest and highest coordinates.
fn bounds(points: impl Iterator<Item = Point>) -> [Point; 2] {
    let none = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    points.fold(none, |[low, high], p| {
        let with = |k: usize| (low[k].min(p[k]), high[k].max(p[k]));
        let ((a, c), (b, d)) = (with(0), with(1));
        [[a, b], [c, d]]
    })
}

/// How far a point lies from the edge of a ring: inside > 0, outside < 0.
fn depth_inside(ring: &[Point], p: Point) -> f64 {
    let (mut inside, mut near) = (false, f64::INFINITY);
    for (i, a) in ring.iter().enumerate() {
        let b = ring[(i + 1) % ring.len()];
        let (d, e) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
        let along =
            (d[0] * e[0] + d[1] * e[1]) / (d[0] * d[0] + d[1] * d[1]).max(f64::MIN_POSITIVE);
        let t = along.clamp(0.0, 1.0);
        near = near.min((e[0] - t * d[0]).hypot(e[1] - t * d[1]));
        if (a[1] > p[1]) != (b[1] > p[1]) && e[0] < d[0] * (e[1] / d[1]) {
            inside = !inside;
        }
    }
    if inside { near } else { -near }
}

/// A corner of an outline.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub at: Point,
    /// Tangent of a quarter of the angle of the arc to the next corner; 0 for a line.
    pub bulge: f64,
}

/// The outline with arcs as chords.
pub(super) fn chords(corners: &[Corner]) -> Vec<Point> {
    let [low, high] = bounds(corners.iter().map(|c| c.at));
    let size = (high[0] - low[0]).hypot(high[1] - low[1]);
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
fn prism(ring: &[Point], depth: f64) -> Solid {
    let mut ring = ring.to_vec();
    let n = ring.len();
    let o = ring[0];
    let cross = |p: Point, q: Point| (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
    if ring.windows(2).map(|p| cross(p[0], p[1])).sum::<f64>() < 0.0 {
        ring.reverse();
    }
    let side = |y: f64| ring.iter().map(move |p| [p[0], y, p[1]]);
    let vertices = side(0.0).chain(side(depth)).collect();
    let mut faces = vec![(0..n).collect(), (n..2 * n).rev().collect()];
    faces.extend((0..n).map(|i| (i, (i + 1) % n)).map(|(i, j)| vec![j, i, i + n, j + n]));
    Solid { vertices, faces, ..Solid::default() }
}
