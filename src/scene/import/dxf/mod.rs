//! DXF: closed outlines (LWPOLYLINE, POLYLINE), bodies of faces (3DFACE, polyface meshes), and both
//! within inserted blocks (INSERT).
//!
//! What entities hold is told in Autodesk's DXF reference ("ENTITIES Section").

mod body;
mod entity;
mod pairs;
mod place;

use super::{
    ImportOptions,
    drawing::{Corner, Drawing, Drawn, chords},
    raw::Raw,
    text::shorten,
};
use base::{
    error::{FindingCode, InputError},
    limits,
};
use body::Faces;
use entity::{Entity, entities};
use pairs::Pair;
use place::Place;
use std::collections::{BTreeMap, HashMap};

/// Flags of a polyline: its last corner joins its first; it is a line in space or a mesh of polygons; a
/// polyface mesh.
const CLOSED: i64 = 1;
const IN_SPACE: i64 = 8 | 16;
const POLYFACE: i64 = 64;

/// Inserted blocks within inserted blocks go no deeper. More: the stack of a thread ends. Fewer: drawings
/// of assemblies of assemblies are refused.
const NESTED: usize = 64;

/// The blocks of a DXF file.
pub(super) fn read(bytes: &[u8], options: &ImportOptions) -> Result<Raw, InputError> {
    let pairs = pairs::pairs(bytes)?;
    let mut raw = Raw::default();
    unit(&pairs, options, &mut raw)?;
    let mut reader = Reader { blocks: blocks(&pairs), ..Reader::default() };
    let top = Level { place: Place::default(), layer: None, handles: String::new() };
    reader.walk(&entities(section(&pairs, "ENTITIES")), &top)?;
    reader.drawing.into_raw(raw, options)
}

/// A block that may be inserted.
struct Block<'a> {
    base: [f64; 3],
    entities: Vec<Entity<'a>>,
}

#[derive(Default)]
struct Reader<'a> {
    blocks: HashMap<&'a str, Block<'a>>,
    /// The blocks that are being inserted.
    open: Vec<&'a str>,
    drawing: Drawing,
    /// Entities so far.
    count: usize,
}

/// Where entities stand.
struct Level<'a> {
    place: Place,
    /// What layer 0 stands for within an inserted block.
    layer: Option<&'a str>,
    /// Of the inserted blocks around it, each with a dash behind.
    handles: String,
}

impl<'a> Reader<'a> {
    fn walk(&mut self, entities: &[Entity<'a>], level: &Level<'a>) -> Result<(), InputError> {
        // Faces in their order, by layer.
        let mut faces: BTreeMap<&str, Faces> = BTreeMap::new();
        for entity in entities {
            self.one_more(entity)?;
            // What is on a sheet of paper is no part of the model.
            if entity.word(67) == Some("1") {
                self.skip(format!("{} on paper", shorten(&entity.kind.value)));
                continue;
            }
            let layer = match entity.word(8).unwrap_or("0") {
                "0" => level.layer.unwrap_or("0"),
                own => own,
            };
            match &*entity.kind.value {
                "INSERT" => self.insert(entity, level, layer)?,
                "3DFACE" => faces.entry(layer).or_default().add(entity, &level.place)?,
                "POLYLINE" if entity.flags() & POLYFACE != 0 => {
                    let what = body::polyface(entity, &level.place)?;
                    let drawn = self.drawn(entity, level, layer, what);
                    self.drawing.bodies.push(drawn);
                }
                "POLYLINE" if entity.flags() & IN_SPACE != 0 => {
                    self.skip("POLYLINE in space".into());
                }
                "POLYLINE" => {
                    let vertices = &entity.body[entity.head().len()..];
                    self.outline(entity, vertices, level, layer)?;
                }
                "LWPOLYLINE" => self.outline(entity, entity.body, level, layer)?,
                "LINE" => {
                    let ends = [entity.point(10)?, entity.point(11)?];
                    let what = ends.map(|p| flat(level.place.of(p)));
                    let drawn = self.drawn(entity, level, layer, what);
                    self.drawing.lines.push(drawn);
                }
                "POINT" => {
                    let what = flat(level.place.of(entity.point(10)?));
                    let drawn = self.drawn(entity, level, layer, what);
                    self.drawing.points.push(drawn);
                }
                // The end of a POLYLINE, or of the attributes of an INSERT.
                "SEQEND" => {}
                other => self.skip(shorten(other)),
            }
        }
        for (layer, faces) in faces {
            for (line, what) in faces.bodies() {
                let id = format!(
                    "{layer}-{}{}",
                    level.handles,
                    line.map_or("body".into(), |l| format!("line{l}"))
                );
                self.drawing.bodies.push(Drawn { id, layer: layer.into(), line, what });
            }
        }
        Ok(())
    }

    fn one_more(&mut self, entity: &Entity) -> Result<(), InputError> {
        self.count += 1;
        if self.count <= limits::BLOCKS {
            return Ok(());
        }
        let message = format!("more than {} entities once all blocks are inserted", limits::BLOCKS);
        Err(entity
            .kind
            .error(message)
            .hint("look at the INSERT entities and their rows and columns"))
    }

    fn skip(&mut self, kind: String) {
        *self.drawing.skipped.entry(kind).or_default() += 1;
    }

    fn drawn<T>(&self, entity: &Entity, level: &Level, layer: &str, what: T) -> Drawn<T> {
        let line = entity.kind.line;
        let own = entity.word(5).map(str::to_string);
        let handle =
            own.or(line.map(|l| format!("line{l}"))).unwrap_or_else(|| self.count.to_string());
        Drawn { id: format!("{layer}-{}{handle}", level.handles), layer: layer.into(), line, what }
    }

    fn outline(
        &mut self,
        entity: &Entity<'a>,
        vertices: &[Pair],
        level: &Level<'a>,
        layer: &str,
    ) -> Result<(), InputError> {
        let Some(facing) = entity.facing()? else {
            self.skip(format!("{} not facing ±z", entity.kind.value));
            return Ok(());
        };
        let (corners, joined) = corners(vertices)?;
        let place = level.place.then(&facing);
        if (entity.flags() & CLOSED == 0 && !joined) || corners.len() < 2 {
            let at = corners.first().map_or([0.0; 2], |c| flat(place.of([c.at[0], c.at[1], 0.0])));
            let drawn = self.drawn(entity, level, layer, at);
            self.drawing.open.push(drawn);
            return Ok(());
        }
        self.drawing.arcs += corners.iter().filter(|c| c.bulge != 0.0).count();
        let ring =
            chords(&corners).into_iter().map(|p| flat(place.of([p[0], p[1], 0.0]))).collect();
        let drawn = self.drawn(entity, level, layer, ring);
        self.drawing.outlines.push(drawn);
        Ok(())
    }

    fn insert(
        &mut self,
        entity: &Entity<'a>,
        level: &Level<'a>,
        layer: &'a str,
    ) -> Result<(), InputError> {
        let name = entity.word(2).unwrap_or_default();
        let Some(block) = self.blocks.get(name) else {
            self.skip(format!("INSERT of {:?}, which is not in the file", shorten(name)));
            return Ok(());
        };
        let Some(facing) = entity.facing()? else {
            self.skip("INSERT not facing ±z".into());
            return Ok(());
        };
        if self.open.contains(&name) || self.open.len() >= NESTED {
            let message = format!("block {:?} is inserted within itself", shorten(name));
            return Err(entity.kind.error(message).hint("the file is damaged; purge the drawing"));
        }
        let (base, entities) = (block.base, block.entities.clone());
        let factors = [entity.number(41, 1.0)?, entity.number(42, 1.0)?, entity.number(43, 1.0)?];
        let spun = Place::turned(entity.number(50, 0.0)?);
        let many = |code| entity.word(code).and_then(|w| w.parse().ok()).unwrap_or(1_usize).max(1);
        let (columns, rows) = (many(70), many(71));
        let step = [entity.number(44, 0.0)?, entity.number(45, 0.0)?];
        let at = entity.point(10)?;
        let handle = self.drawn(entity, level, "", ()).id.trim_start_matches('-').to_string();
        self.open.push(name);
        for row in 0..rows {
            for column in 0..columns {
                let off = [column as f64 * step[0], row as f64 * step[1], 0.0];
                let place = level
                    .place
                    .then(&facing)
                    .then(&Place::moved(at))
                    .then(&spun)
                    .then(&Place::moved(off))
                    .then(&Place::scaled(factors))
                    .then(&Place::moved(base.map(|b| -b)));
                let number = match rows * columns {
                    1 => String::new(),
                    _ => format!("-{}", row * columns + column + 1),
                };
                let inner =
                    Level { place, layer: Some(layer), handles: format!("{handle}{number}-") };
                self.one_more(entity)?;
                self.walk(&entities, &inner)?;
            }
        }
        self.open.pop();
        Ok(())
    }
}

fn flat(p: [f64; 3]) -> [f64; 2] {
    [p[0], p[1]]
}

/// The pairs of a section.
fn section<'a>(pairs: &'a [Pair<'a>], name: &str) -> &'a [Pair<'a>] {
    let begin = pairs.windows(2).position(|p| {
        p[0].code == 0 && p[0].value == "SECTION" && p[1].code == 2 && p[1].value == name
    });
    let rest = begin.map_or(&[][..], |b| &pairs[b + 2..]);
    let end = rest.iter().position(|p| p.code == 0 && p.value == "ENDSEC").unwrap_or(rest.len());
    &rest[..end]
}

/// The blocks of the section BLOCKS by name.
fn blocks<'a>(pairs: &'a [Pair<'a>]) -> HashMap<&'a str, Block<'a>> {
    let all = entities(section(pairs, "BLOCKS"));
    let begins = |next: &Entity| next.kind.value == "BLOCK";
    let block = |chunk: &[Entity<'a>]| {
        let (head, rest) = chunk.split_first()?;
        let entities = rest.iter().filter(|e| e.kind.value != "ENDBLK").copied().collect();
        // What is no number is refused where the block is inserted.
        Some((head.word(2)?, Block { base: head.point(10).unwrap_or_default(), entities }))
    };
    all.chunk_by(|_, next| !begins(next)).filter_map(block).collect()
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
        "14" => ("dm", Some(0.1)),
        other if options.scale.is_some() => (other, None),
        other => {
            let text = format!("unit {:?} of $INSUNITS is not known", shorten(other));
            return Err(named
                .map_or(&pairs[0], |p| &p[1])
                .error(text)
                .hint("give the metres in a unit with `--scale`"));
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
fn corners(body: &[Pair]) -> Result<(Vec<Corner>, bool), InputError> {
    let mut corners: Vec<Corner> = Vec::new();
    for pair in body.iter().filter(|p| matches!(p.code, 10 | 20 | 42)) {
        let number = pair.number()?;
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
