//! Wavefront OBJ: `v`, `f`, `o`, `g`; everything about looks is skipped.
//!
//! A compact reader of our own: of the crates for OBJ, `obj` keeps coordinates in single precision
//! and does not check indices, and `tobj` starts a new mesh at every change of colour and names no
//! line in its errors. The subset a solid needs is four statements.
//!
//! Where rules of layers are given, the groups of a file with objects are layers.
//!
//! Indices count from 1 over the whole file, negative ones from the last corner so far backwards; a
//! face may come before its corners where its indices are positive. Only the first index of `v/t/n`
//! matters.

use super::{
    ImportOptions,
    drawing::{Drawing, Drawn},
    raw::{LEAST_FACES, Raw, Solid, compact, parts, tally},
    text::{self, shorten},
};
use base::error::{FindingCode, InputError, JsonPath};
use std::collections::HashMap;

/// Statements that say nothing about the shape of polyhedra.
const SKIPPED: [&str; 15] = [
    "vt",
    "vn",
    "s",
    "mg",
    "mtllib",
    "usemtl",
    "usemap",
    "maplib",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "l",
];

/// The layer of what is in no group.
const NO_LAYER: &str = "default";

struct Face {
    line: usize,
    corners: Vec<usize>,
    object: usize,
    group: usize,
}

/// The blocks of an OBJ file.
pub(super) fn read(bytes: &[u8], stem: &str, options: &ImportOptions) -> Result<Raw, InputError> {
    let mut raw = Raw::default();
    let mut vertices = Vec::new();
    let mut faces: Vec<Face> = Vec::new();
    // Number 0 is what comes before the first `o` or `g`.
    let (mut objects, mut groups) = (vec![String::new()], vec![NO_LAYER.to_string()]);
    let mut group_numbers: HashMap<String, usize> = HashMap::new();
    let mut group = 0;
    let mut unknown = Vec::new();
    for (line, text) in text::lines(text::unmarked(bytes))? {
        let mut words = text.split_whitespace();
        let statement = words.next().unwrap_or_default();
        match statement {
            "v" => vertices.push(text::point(line, words)?),
            "f" => {
                let corners = words
                    .take_while(|word| !word.starts_with('#'))
                    .map(|word| corner(line, word, vertices.len()))
                    .collect::<Result<Vec<_>, _>>()?;
                if corners.len() < 3 {
                    return Err(text::error(
                        line,
                        format!("a face with {} corners", corners.len()),
                    )
                    .hint("a face needs three corners or more; the file may be cut off here"));
                }
                faces.push(Face { line, corners, object: objects.len() - 1, group });
            }
            "o" => objects.push(words.collect::<Vec<_>>().join(" ")),
            "g" => {
                let name = words.collect::<Vec<_>>().join(" ");
                group = *group_numbers.entry(name.clone()).or_insert(groups.len());
                if group == groups.len() {
                    groups.push(name);
                }
            }
            _ if SKIPPED.contains(&statement) => {}
            _ => unknown.push(format!("line {line}: {:?}", shorten(&text))),
        }
    }
    if let Some((face, index)) =
        faces.iter().find_map(|f| f.corners.iter().find(|&&i| i >= vertices.len()).map(|i| (f, i)))
    {
        return Err(text::error(face.line, format!("corner {} does not exist: the file has {} corners", index + 1, vertices.len()))
            .hint("indices count from 1 over the whole file; the file may be cut off or merged from several"));
    }
    if !unknown.is_empty() {
        let text = format!("lines that do not describe polyhedra, left out: {}", tally(&unknown));
        raw.say(FindingCode::LeftOut, text);
    }
    if faces.is_empty() {
        return Err(InputError::at(
            JsonPath::root(),
            format!("an OBJ file without faces ({} corners)", vertices.len()),
        )
        .hint("export meshes, not points, curves or surfaces"));
    }
    if !options.layers.is_empty() {
        if objects.len() < 2 || groups.len() < 2 {
            let text = "rules for layers, but no groups (`g`) with objects (`o`) in this OBJ file";
            return Err(InputError::at(JsonPath::root(), text).hint(
                "export objects with their layers as groups, or choose what is held with `--support ID`",
            ));
        }
        let mut layer_of = vec![0; objects.len()];
        faces.iter().rev().for_each(|f| layer_of[f.object] = f.group);
        let mut drawing = Drawing::default();
        for (object, what) in gather(&vertices, faces, &objects, |f| f.object) {
            let (id, layer) = (what.id.clone(), groups[layer_of[object]].clone());
            drawing.bodies.push(Drawn { id, layer, line: what.line, what });
        }
        return drawing.into_raw(raw, options);
    }
    let blocks = |all: Vec<(usize, Solid)>| all.into_iter().map(|(_, solid)| solid).collect();
    if objects.len() > 1 {
        raw.blocks = blocks(gather(&vertices, faces, &objects, |f| f.object));
    } else if groups.len() > 1 {
        raw.blocks = blocks(gather(&vertices, faces, &groups, |f| f.group));
        let count = raw.blocks.len();
        raw.say(
            FindingCode::Converted,
            format!(
                "no objects (`o`) in the file: its groups (`g`) are the blocks, {count} in all"
            ),
        );
    } else {
        split(&vertices, faces, stem, &mut raw)?;
        return Ok(raw);
    }
    raw.name_apart("object");
    raw.say_parts();
    Ok(raw)
}

/// The corner a word of a face means, counted from 0; positive indices are checked when all corners
/// are known.
fn corner(line: usize, word: &str, so_far: usize) -> Result<usize, InputError> {
    let index = word.split('/').next().unwrap_or_default();
    let wrong = |what: &str| text::error(line, format!("face corner {:?}: {what}", shorten(word)));
    let number: i64 = index.parse().map_err(|_| {
        wrong("expected an index")
            .hint("a corner is written i, i/t, i//n or i/t/n with whole numbers")
    })?;
    if number == 0 {
        return Err(
            wrong("there is no corner 0").hint("indices count from 1, or from -1 backwards")
        );
    }
    let from_zero = if number > 0 {
        number.checked_sub(1)
    } else {
        i64::try_from(so_far).ok().and_then(|n| n.checked_add(number))
    };
    from_zero.and_then(|i| usize::try_from(i).ok()).ok_or_else(|| {
        wrong(&format!("does not exist, {so_far} corners were given so far"))
            .hint("negative indices count back from the last corner so far")
    })
}

/// One block per object (or group) that has faces, with its number.
fn gather(
    vertices: &[[f64; 3]],
    faces: Vec<Face>,
    names: &[String],
    of: impl Fn(&Face) -> usize,
) -> Vec<(usize, Solid)> {
    let mut sorted: Vec<(Vec<usize>, Vec<Vec<usize>>)> =
        names.iter().map(|_| Default::default()).collect();
    for face in faces {
        let (lines, loops) = &mut sorted[of(&face)];
        lines.push(face.line);
        loops.push(face.corners);
    }
    let all = names.iter().zip(sorted).enumerate();
    let some = all.filter(|(_, (_, (_, faces)))| !faces.is_empty());
    some.map(|(k, (name, (lines, faces)))| (k, compact(name.clone(), lines, vertices, faces)))
        .collect()
}

/// A file without names: its connected parts are the blocks.
fn split(
    vertices: &[[f64; 3]],
    faces: Vec<Face>,
    stem: &str,
    raw: &mut Raw,
) -> Result<(), InputError> {
    let lines: Vec<usize> = faces.iter().map(|f| f.line).collect();
    let corners: Vec<Vec<usize>> = faces.into_iter().map(|f| f.corners).collect();
    let part = parts(vertices, &corners);
    let count = part.iter().copied().max().map_or(0, |m| m + 1);
    let mut sorted: Vec<Vec<Vec<usize>>> = vec![Vec::new(); count];
    let mut places: Vec<Vec<usize>> = vec![Vec::new(); count];
    for ((face, &p), &line) in corners.into_iter().zip(&part).zip(&lines) {
        places[p].push(line);
        sorted[p].push(face);
    }
    if let Some(p) = sorted.iter().position(|faces| faces.len() < LEAST_FACES) {
        let (n, message) = (
            sorted[p].len(),
            "the file names no objects, and its faces are not connected at their corners",
        );
        return Err(text::error(
            places[p][0],
            format!("{message}: the part here has {n} faces, a solid needs at least {LEAST_FACES}"),
        )
        .hint("export one object (`o NAME`) per block, or let faces share their corners (weld)"));
    }
    let digits = count.saturating_sub(1).to_string().len();
    raw.blocks = sorted
        .into_iter()
        .zip(places)
        .enumerate()
        .map(|(i, (faces, lines))| {
            compact(
                if count == 1 { stem.into() } else { format!("{stem}-{i:0digits$}") },
                lines,
                vertices,
                faces,
            )
        })
        .collect();
    raw.say(
        FindingCode::Converted,
        format!("no objects in the file: its connected parts are the blocks, {count} in all"),
    );
    Ok(())
}
