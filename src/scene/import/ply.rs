//! PLY (Stanford polygon file format), ASCII and binary in both byte orders, by the crate
//! `ply-rs-bw`. One block per file.
//!
//! Needed are the element `vertex` with `x`, `y`, `z` and the element `face` with the list
//! `vertex_indices` (or `vertex_index`); everything else (colours, normals, other elements) is
//! skipped.

use super::{
    raw::{Raw, Solid},
    text::{self, shorten},
};
use base::error::{InputError, JsonPath};
use ply_rs_bw::{
    parser::{ParseError, Parser, Reader},
    ply::{ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult},
};
use std::borrow::Cow;

/// One vertex or one face: what is there of either.
#[derive(Default)]
struct Item {
    point: [Option<f64>; 3],
    corners: Option<Vec<i64>>,
}

impl PropertyAccess for Item {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let axis = match name {
            "x" => 0,
            "y" => 1,
            "z" => 2,
            "vertex_indices" | "vertex_index" => {
                self.corners = whole_numbers(property);
                return if self.corners.is_some() {
                    PropertyAccessResult::Set
                } else {
                    PropertyAccessResult::UnsupportedType
                };
            }
            _ => return PropertyAccessResult::Ignored,
        };
        self.point[axis] = number(&property);
        if self.point[axis].is_some() {
            PropertyAccessResult::Set
        } else {
            PropertyAccessResult::UnsupportedType
        }
    }
}

fn number(property: &Property) -> Option<f64> {
    match *property {
        Property::Char(v) => Some(v.into()),
        Property::UChar(v) => Some(v.into()),
        Property::Short(v) => Some(v.into()),
        Property::UShort(v) => Some(v.into()),
        Property::Int(v) => Some(v.into()),
        Property::UInt(v) => Some(v.into()),
        Property::Float(v) => Some(v.into()),
        Property::Double(v) => Some(v),
        _ => None,
    }
}

fn whole_numbers(property: Property) -> Option<Vec<i64>> {
    fn wide<T: Into<i64>>(list: Vec<T>) -> Option<Vec<i64>> {
        Some(list.into_iter().map(Into::into).collect())
    }
    match property {
        Property::ListChar(list) => wide(list),
        Property::ListUChar(list) => wide(list),
        Property::ListShort(list) => wide(list),
        Property::ListUShort(list) => wide(list),
        Property::ListInt(list) => wide(list),
        Property::ListUInt(list) => wide(list),
        _ => None,
    }
}

/// The block of a PLY file.
pub(super) fn read(bytes: &[u8], stem: &str) -> Result<Raw, InputError> {
    let parser = Parser::<Item>::new();
    let bytes = line_feeds(text::unmarked(bytes));
    let mut reader = Reader::new(bytes.as_ref());
    let header = parser.read_header(&mut reader).map_err(|e| place(&e, true))?;
    check(&header)?;
    let ascii = header.encoding == Encoding::Ascii;
    let first_line = reader.line();
    let mut payload = parser.read_payload(&mut reader, &header).map_err(|e| place(&e, ascii))?;
    // Where an element is: its line in an ASCII file, its number otherwise.
    let at = |element: &str, index: usize, message: String| {
        let before: usize =
            header.elements.values().take_while(|e| e.name != element).map(|e| e.count).sum();
        match ascii {
            true => text::error(first_line + before + index, message),
            false => InputError::at(JsonPath::root().key(element).index(index), message),
        }
    };
    let mut solid = Solid { id: stem.into(), ..Solid::default() };
    for (i, item) in payload.swap_remove("vertex").unwrap_or_default().into_iter().enumerate() {
        let mut point = [0.0; 3];
        for ((value, read), axis) in point.iter_mut().zip(item.point).zip(["x", "y", "z"]) {
            *value = read.filter(|v| v.is_finite()).ok_or_else(|| {
                let got = read.map_or("nothing".into(), |v| v.to_string());
                at("vertex", i, format!("coordinate {axis}: expected a finite number, got {got}"))
                    .hint("look for NaN and infinite values in the export")
            })?;
        }
        solid.vertices.push(point);
    }
    let count = solid.vertices.len();
    for (i, item) in payload.swap_remove("face").unwrap_or_default().into_iter().enumerate() {
        let corners = item.corners.unwrap_or_default();
        if corners.len() < 3 {
            return Err(at("face", i, format!("a face with {} corners", corners.len()))
                .hint("a face needs three corners or more"));
        }
        let face = corners
            .into_iter()
            .map(|c| usize::try_from(c).ok().filter(|&c| c < count).ok_or(c))
            .collect::<Result<Vec<_>, _>>();
        solid.faces.push(face.map_err(|c| {
            at("face", i, format!("corner {c} does not exist: the file has {count} corners"))
                .hint("indices count from 0")
        })?);
    }
    if ascii {
        let before: usize =
            header.elements.values().take_while(|e| e.name != "face").map(|e| e.count).sum();
        solid.lines = (0..solid.faces.len()).map(|i| first_line + before + i).collect();
    }
    let mut raw = Raw { blocks: vec![solid], ..Raw::default() };
    raw.say_parts();
    Ok(raw)
}

/// A file whose lines end with CR alone, with LF in their places: all of them in an ASCII file, those
/// of the header where numbers in binary follow.
fn line_feeds(bytes: &[u8]) -> Cow<'_, [u8]> {
    const END: &[u8] = b"end_header\r";
    let alone = |rest: &[u8]| !rest.starts_with(b"\n");
    let header = bytes.windows(END.len()).position(|w| w == END).map(|at| at + END.len());
    let Some(length) = header.filter(|&n| {
        bytes.strip_prefix(b"ply\r").is_some_and(alone) && alone(bytes.get(n..).unwrap_or(&[]))
    }) else {
        return Cow::Borrowed(bytes);
    };
    let mut fed = bytes.to_vec();
    let ascii = bytes[..length].windows(12).any(|w| w == b"format ascii");
    let end = if ascii { fed.len() } else { length };
    fed[..end].iter_mut().filter(|b| **b == b'\r').for_each(|b| *b = b'\n');
    Cow::Owned(fed)
}

/// Refuses headers without the needed elements, and those that promise elements of no size: nothing
/// in the file would end their list.
fn check(header: &Header) -> Result<(), InputError> {
    let lacks = |what: &str, hint: &str| {
        Err(InputError::at(JsonPath::root(), format!("PLY header: {what}")).hint(hint))
    };
    let has = |element: &ElementDef, names: &[&str]| {
        names.iter().any(|n| element.properties.contains_key(*n))
    };
    if let Some(empty) = header.elements.values().find(|e| e.properties.is_empty() && e.count > 0) {
        return lacks(
            &format!("element {:?} has no properties", shorten(&empty.name)),
            "the header is damaged; export the file again",
        );
    }
    match header.elements.get("vertex") {
        Some(vertex) if ["x", "y", "z"].iter().all(|axis| has(vertex, &[axis])) => {}
        _ => {
            return lacks(
                "no element \"vertex\" with x, y and z",
                "export the file again, as a mesh",
            );
        }
    }
    match header.elements.get("face") {
        Some(face) if has(face, &["vertex_indices", "vertex_index"]) && face.count > 0 => Ok(()),
        _ => lacks(
            "no faces (element \"face\" with a list \"vertex_indices\")",
            "point clouds and triangle strips are not solids; export polygons",
        ),
    }
}

/// The parser's error as ours. Its line numbers count elements in binary files, and are dropped
/// there.
fn place(error: &ParseError, text_line: bool) -> InputError {
    let message = error.to_string();
    let message = match error.line() {
        Some(line) => message.strip_prefix(&format!("Line {line}: ")).unwrap_or(&message),
        None => &message,
    };
    let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut short: String = message.chars().take(160).collect();
    if message.chars().nth(160).is_some() {
        short.push('…');
    }
    let hint = match error.kind() {
        std::io::ErrorKind::UnexpectedEof => {
            "the file is cut off, or its header announces more than there is; export it again"
        }
        _ => "the file is damaged or not a PLY file; export it again",
    };
    match error.line().filter(|_| text_line) {
        Some(line) => text::error(line, short),
        None => InputError::at(JsonPath::root(), short),
    }
    .hint(hint)
}
