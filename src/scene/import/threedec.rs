//! 3DEC: the commands that make blocks (`block create`, up to version 5 `polyhedron`), hold them (`block
//! fix`) and give them a density (`block property density`). Groups are layers.
//!
//! Itasca, 3DEC 7.0 documentation, "block create command": corners of a face are listed clockwise, seen
//! from outside.

use super::{
    ImportOptions,
    drawing::{Drawing, Drawn},
    raw::{Raw, Solid, list, tally},
    text::{self, shorten},
};
use crate::Material;
use base::error::{FindingCode, InputError};
use std::collections::{BTreeMap, HashMap};

/// The group of blocks without one.
const UNGROUPED: &str = "block";

/// A command in words, with the line where it begins.
struct Command {
    line: usize,
    words: Vec<String>,
}

/// Whether a text holds commands that make blocks.
pub(super) fn looks_like(bytes: &[u8]) -> bool {
    let words = |line: &[u8]| -> Vec<String> {
        String::from_utf8_lossy(line)
            .split_whitespace()
            .take(2)
            .map(str::to_ascii_lowercase)
            .collect()
    };
    let commands = text::split(bytes).filter(|l| !l.trim_ascii_start().starts_with(b";")).take(100);
    commands.map(words).any(|w| creates(&w).is_some())
}

/// How many words say that a block is made.
fn creates(words: &[String]) -> Option<usize> {
    match words {
        [a, b, ..] if is(a, "block", 2) && is(b, "create", 2) => Some(2),
        [a, b, ..]
            if is(a, "polyhedron", 4)
                && ["face", "brick", "prism", "tetrahedron"].iter().any(|k| is(b, k, 4)) =>
        {
            Some(1)
        }
        _ => None,
    }
}

/// Whether a word is a keyword, which may be cut after so many letters.
fn is(word: &str, keyword: &str, least: usize) -> bool {
    word.len() >= least.min(keyword.len()) && keyword.starts_with(&word.to_ascii_lowercase())
}

/// The blocks of a file of commands.
pub(super) fn read(bytes: &[u8], options: &ImportOptions) -> Result<Raw, InputError> {
    let mut raw = Raw::default();
    let mut drawing = Drawing::default();
    let (mut left_out, mut unread) = (BTreeMap::<String, usize>::new(), Vec::new());
    for command in commands(bytes) {
        let words = &command.words;
        let is_word =
            |k: usize, keyword, least| words.get(k).is_some_and(|w| is(w, keyword, least));
        if let Some(k) = creates(words) {
            let (group, what) = create(&command, &words[k..])?;
            drawing.bodies.push(Drawn {
                id: group.clone(),
                layer: group,
                line: Some(command.line),
                what,
            });
        } else if is_word(0, "block", 2) && is_word(1, "fix", 3) {
            match of_group(&words[2..]) {
                Some(group) => held(&mut drawing, group),
                None => {
                    unread.push(format!("line {}: {:?}", command.line, shorten(&words.join(" "))))
                }
            }
        } else if is_word(0, "block", 2) && is_word(1, "property", 4) && is_word(2, "density", 4) {
            let density = words
                .get(3)
                .and_then(|w| w.parse().ok())
                .filter(|d: &f64| d.is_finite() && *d > 0.0);
            match (density, of_group(words.get(4..).unwrap_or_default())) {
                (Some(density), Some(group)) => dense(&drawing, &mut raw, group, density),
                _ => unread.push(format!("line {}: {:?}", command.line, shorten(&words.join(" ")))),
            }
        } else {
            let name: Vec<String> = words.iter().take(2).map(|w| shorten(w)).collect();
            *left_out.entry(name.join(" ")).or_default() += 1;
        }
    }
    if !left_out.is_empty() {
        let names: Vec<String> = left_out.iter().map(|(k, n)| format!("{k:?} {n}")).collect();
        raw.say(
            FindingCode::LeftOut,
            format!(
                "commands left out, only blocks, what holds them and their density are read: {}",
                list(&names)
            ),
        );
    }
    if !unread.is_empty() {
        let text = format!(
            "commands left out, ranges are read by group only: {}; use `--support ID` or `--layer GROUP=support`",
            tally(&unread)
        );
        raw.say(FindingCode::LeftOut, text);
    }
    drawing.into_raw(raw, options)
}

/// The group of a range, empty for all blocks; none where it is another range.
fn of_group(words: &[String]) -> Option<&str> {
    match words {
        [] => Some(""),
        [range, group, name] if is(range, "range", 3) && is(group, "group", 3) => Some(name),
        _ => None,
    }
}

fn held(drawing: &mut Drawing, group: &str) {
    let of = drawing.bodies.iter_mut().filter(|b| group.is_empty() || b.layer == group);
    of.for_each(|b| b.what.support = true);
}

fn dense(drawing: &Drawing, raw: &mut Raw, group: &str, density: f64) {
    let of = drawing.bodies.iter().filter(|b| group.is_empty() || b.layer == group);
    of.for_each(|b| {
        raw.materials.insert(b.layer.clone(), Material::of_density(density));
    });
}

/// The commands: a line each, unless it goes on (`&`, `...`); comments begin with `;`.
fn commands(bytes: &[u8]) -> Vec<Command> {
    let mut commands: Vec<Command> = Vec::new();
    let mut goes_on = false;
    for (index, line) in text::split(text::unmarked(bytes)).enumerate() {
        let text = String::from_utf8_lossy(line);
        let text = text.split(';').next().unwrap_or_default().trim();
        let (text, more) = ["&", "...", "…"]
            .iter()
            .find_map(|mark| text.strip_suffix(mark))
            .map_or((text, false), |text| (text, true));
        let words = words(text);
        match commands.last_mut() {
            Some(last) if goes_on => last.words.extend(words),
            _ => commands.push(Command { line: index + 1, words }),
        }
        goes_on = more;
    }
    commands.retain(|c| !c.words.is_empty());
    commands
}

/// Words, with what is in quotes or parentheses as one.
fn words(text: &str) -> Vec<String> {
    let mut words = Vec::new();
    let (mut word, mut until) = (String::new(), None);
    for c in text.chars() {
        match (c, until) {
            (c, Some(end)) if c == end => until = None,
            ('"' | '\'', None) => until = Some(c),
            ('(', None) => until = Some(')'),
            (c, None) if c.is_whitespace() => words.push(std::mem::take(&mut word)),
            _ => word.push(c),
        }
    }
    words.push(word);
    words.retain(|w| !w.is_empty());
    words
}

/// The numbers of a word: `1,2,3`.
fn numbers(line: usize, word: &str) -> Result<Option<Vec<f64>>, InputError> {
    let parts = || word.split([',', ' ']).filter(|p| !p.is_empty());
    if !parts()
        .next()
        .is_some_and(|p| p.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)))
    {
        return Ok(None);
    }
    let number = |p: &str| {
        p.parse().ok().filter(|v: &f64| v.is_finite()).ok_or_else(|| {
            text::error(line, format!("expected a finite number, got {:?}", shorten(p)))
                .hint("coordinates are x,y,z without spaces, or (x, y, z)")
        })
    };
    parts().map(number).collect::<Result<_, _>>().map(Some)
}

/// A block and its group.
fn create(command: &Command, words: &[String]) -> Result<(String, Solid), InputError> {
    let line = command.line;
    let mut group = UNGROUPED.to_string();
    let (mut kind, mut loops, mut plain) = (None, Vec::<Vec<[f64; 3]>>::new(), Vec::new());
    let mut rest = words.iter();
    while let Some(word) = rest.next() {
        if let Some(values) = numbers(line, word)? {
            match (<[f64; 3]>::try_from(values.as_slice()), loops.last_mut()) {
                (Ok(point), Some(face)) => face.push(point),
                (Ok(point), None) if kind == Some("tetrahedron") => loops.push(vec![point]),
                _ => plain.extend(values),
            }
            continue;
        }
        let one = |keyword, least| is(word, keyword, least);
        // Versions up to 5 call the two ends of a prism a and b.
        if one("face", 4)
            || one("face-1", 6)
            || one("face-2", 6)
            || (kind == Some("prism") && ["a", "b"].contains(&word.as_str()))
        {
            kind.get_or_insert("polyhedron");
            loops.push(Vec::new());
        } else if one("group", 3) {
            group = rest.next().cloned().unwrap_or(group);
        } else if let Some(known) =
            ["polyhedron", "brick", "prism", "tetrahedron"].into_iter().find(|k| one(k, 4))
        {
            kind = Some(known);
        } else if one("drum", 4) || one("tunnel", 3) || one("wall", 4) {
            let message = format!("`block create {}`, which is not read", word);
            return Err(
                text::error(line, message).hint("export the blocks as polyhedra, or as OBJ")
            );
        } else if ["slot", "joint-set", "face-group", "material", "constitutive", "region"]
            .iter()
            .any(|k| one(k, 4))
        {
            rest.next();
        }
        // Others, like `r=0`, say nothing about the shape.
    }
    let refuse = |message: &str| {
        Err(text::error(line, message.to_string()).hint("see the 3DEC manual, `block create`"))
    };
    let faces: Vec<Vec<[f64; 3]>> = match (kind, plain.as_slice(), loops.as_slice()) {
        (Some("brick"), [a, b], []) => brick([*a, *a, *a], [*b, *b, *b]),
        (Some("brick"), [a, b, c, d], []) => brick([*a, *c, *c], [*b, *d, *d]),
        (Some("brick"), [a, b, c, d, e, f], []) => brick([*a, *c, *e], [*b, *d, *f]),
        (Some("brick"), ..) => return refuse("a brick needs two, four or six numbers"),
        (Some("prism"), _, [a, b]) if a.len() == b.len() && a.len() > 2 => prism(a, b),
        (Some("prism"), ..) => return refuse("a prism needs two faces of as many corners"),
        (Some("tetrahedron"), _, [c]) if c.len() == 4 => {
            [[0, 1, 2], [0, 3, 1], [1, 3, 2], [2, 3, 0]].map(|f| f.map(|k| c[k]).to_vec()).to_vec()
        }
        (Some("tetrahedron"), ..) => return refuse("a tetrahedron needs four corners"),
        _ if loops.len() < 4 => return refuse("a polyhedron needs four faces at least"),
        _ => loops,
    };
    if let Some(face) = faces.iter().find(|f| f.len() < 3) {
        return refuse(&format!("a face of {} corners", face.len()));
    }
    Ok((group, welded(line, &faces)))
}

/// Faces, clockwise seen from outside, of a box from `low` to `high`.
fn brick(low: [f64; 3], high: [f64; 3]) -> Vec<Vec<[f64; 3]>> {
    let [x, y, z] = low;
    let [u, v, w] = high;
    prism(
        &[[x, y, z], [u, y, z], [u, v, z], [x, v, z]],
        &[[x, y, w], [u, y, w], [u, v, w], [x, v, w]],
    )
}

/// Two ends with corners in the same order and the sides between them.
fn prism(a: &[[f64; 3]], b: &[[f64; 3]]) -> Vec<Vec<[f64; 3]>> {
    let n = a.len();
    let side = |k: usize| vec![a[k], b[k], b[(k + 1) % n], a[(k + 1) % n]];
    let mut faces: Vec<Vec<[f64; 3]>> = (0..n).map(side).collect();
    faces.extend([a.to_vec(), b.iter().rev().copied().collect()]);
    faces
}

/// One corner a place, faces counter-clockwise as everywhere here.
fn welded(line: usize, faces: &[Vec<[f64; 3]>]) -> Solid {
    let mut at: HashMap<[u64; 3], usize> = HashMap::new();
    let mut solid = Solid { line: Some(line), ..Solid::default() };
    for face in faces {
        let corner = |p: &[f64; 3]| {
            let next = solid.vertices.len();
            let k = *at.entry(p.map(|c| (c + 0.0).to_bits())).or_insert(next);
            if k == next {
                solid.vertices.push(*p);
            }
            k
        };
        let ring = face.iter().rev().map(corner).collect();
        solid.faces.push(ring);
    }
    solid
}
