//! STL, ASCII (one block per `solid`) and binary (one block per file).
//!
//! A compact reader of our own: the crate `stl_io` takes every file that starts with `solid ` for
//! ASCII although many binary ones do, reads only the first solid, rounds ASCII numbers to single
//! precision and names no line in its errors.
//!
//! STL has no shared corners: corners with the same coordinates (to the bit) become one. Normals
//! are skipped: the order of the corners says the same, and where the two differ the normals are
//! wrong more often.

use super::{
    raw::{Raw, Solid},
    text::{self, shorten},
};
use base::error::{FindingCode, InputError, JsonPath};
use std::collections::HashMap;

/// 80 bytes of free text and the number of triangles.
const HEADER: usize = 84;
/// Normal and three corners in single precision, and two bytes of no meaning.
const TRIANGLE: usize = 50;

/// A solid under construction, with the corners found so far.
#[derive(Default)]
struct Builder {
    solid: Solid,
    index: HashMap<[u64; 3], usize>,
}

impl Builder {
    fn corner(&mut self, point: [f64; 3]) -> usize {
        let vertices = &mut self.solid.vertices;
        // +0 and -0 are the same place.
        *self.index.entry(point.map(|c| (c + 0.0).to_bits())).or_insert_with(|| {
            vertices.push(point);
            vertices.len() - 1
        })
    }
}

/// Whether the content can only be STL.
pub(super) fn looks_like(bytes: &[u8]) -> bool {
    binary_length(bytes) == Some(bytes.len()) || says_solid(bytes)
}

fn says_solid(bytes: &[u8]) -> bool {
    let text = bytes.trim_ascii_start();
    text.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"))
        && text.get(5).is_none_or(u8::is_ascii_whitespace)
}

/// The length a binary file has by its own count of triangles.
fn binary_length(bytes: &[u8]) -> Option<usize> {
    let count = u32::from_le_bytes(bytes.get(HEADER - 4..HEADER)?.try_into().ok()?);
    usize::try_from(count).ok().filter(|&n| n > 0)?.checked_mul(TRIANGLE)?.checked_add(HEADER)
}

/// The blocks of an STL file.
pub(super) fn read(bytes: &[u8], stem: &str) -> Result<Raw, InputError> {
    // Some binary files start with "solid": the length decides first.
    let text = text::unmarked(bytes);
    let mut raw = if binary_length(bytes) != Some(bytes.len()) && says_solid(text) {
        ascii(text)?
    } else {
        binary(bytes)?
    };
    for block in &mut raw.blocks {
        if block.id.is_empty() {
            block.id = stem.into();
        }
    }
    raw.name_apart(stem);
    raw.say_parts();
    Ok(raw)
}

fn binary(bytes: &[u8]) -> Result<Raw, InputError> {
    let damaged = |message: String| {
        InputError::at(JsonPath::root(), message)
            .hint("the file is cut off or not an STL file; export it again")
    };
    let Some(length) = binary_length(bytes) else {
        return Err(damaged(format!("no triangles in this STL file of {} bytes", bytes.len())));
    };
    let Some(body) = bytes.get(HEADER..length) else {
        let promised = (length - HEADER) / TRIANGLE;
        return Err(damaged(format!(
            "the header announces {promised} triangles ({length} bytes), the file has {} bytes",
            bytes.len()
        )));
    };
    let mut raw = Raw::default();
    if bytes.len() > length {
        raw.say(
            FindingCode::LeftOut,
            format!("bytes after the last triangle, left out: {}", bytes.len() - length),
        );
    }
    let mut builder = Builder::default();
    for (i, triangle) in body.chunks_exact(TRIANGLE).enumerate() {
        let mut face = Vec::with_capacity(3);
        for corner in triangle[12..48].chunks_exact(12) {
            let mut point = [0.0; 3];
            for (value, word) in point.iter_mut().zip(corner.chunks_exact(4)) {
                *value = f64::from(f32::from_le_bytes([word[0], word[1], word[2], word[3]]));
            }
            if let Some(value) = point.iter().find(|v| !v.is_finite()) {
                let offset = HEADER + i * TRIANGLE;
                return Err(damaged(format!(
                    "triangle {i} (byte {offset}): expected finite coordinates, got {value}"
                )));
            }
            face.push(builder.corner(point));
        }
        builder.solid.faces.push(face);
    }
    raw.blocks.push(builder.solid);
    Ok(raw)
}

fn ascii(bytes: &[u8]) -> Result<Raw, InputError> {
    let mut raw = Raw::default();
    let mut open: Option<Builder> = None;
    let mut face: Option<Vec<usize>> = None;
    let mut last = 1;
    for (line, text) in text::lines(bytes)? {
        last = line;
        let mut words = text.split_whitespace();
        let word = words.next().unwrap_or_default().to_ascii_lowercase();
        let misplaced = || {
            text::error(line, format!("unexpected here: {:?}", shorten(&text)))
                .hint("the file is damaged: STL is solid, facet normal, outer loop, three times vertex, endloop, endfacet, endsolid")
        };
        match (word.as_str(), &mut open, &mut face) {
            ("solid", None, _) => {
                let id = words.collect::<Vec<_>>().join(" ");
                open = Some(Builder {
                    solid: Solid { id, line: Some(line), ..Solid::default() },
                    ..Builder::default()
                });
            }
            ("facet" | "endloop", Some(_), _) => {}
            ("outer", Some(_), None) => face = Some(Vec::with_capacity(3)),
            ("vertex", Some(builder), Some(face)) => {
                face.push(builder.corner(text::point(line, words)?))
            }
            ("endfacet", Some(builder), Some(corners)) => {
                if corners.len() != 3 {
                    return Err(text::error(
                        line,
                        format!("a facet with {} corners", corners.len()),
                    )
                    .hint("STL facets are triangles"));
                }
                builder.solid.faces.push(std::mem::take(corners));
                builder.solid.lines.push(line);
                face = None;
            }
            ("endsolid", Some(_), None) => raw.blocks.extend(open.take().map(|b| b.solid)),
            _ => return Err(misplaced()),
        }
    }
    if open.is_some() {
        return Err(text::error(last, "the file ends inside a solid")
            .hint("the file is cut off; export it again"));
    }
    let before = raw.blocks.len();
    raw.blocks.retain(|b| !b.faces.is_empty());
    if raw.blocks.len() < before {
        raw.say(
            FindingCode::LeftOut,
            format!("solids without facets, left out: {}", before - raw.blocks.len()),
        );
    }
    Ok(raw)
}
