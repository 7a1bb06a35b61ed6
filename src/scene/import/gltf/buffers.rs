//! Numbers in the buffers of a glTF file.

use super::document::{Accessor, Document};
use crate::import::{mesh, text::shorten};
use base::error::{InputError, JsonPath};
use data_encoding::BASE64;
use std::{borrow::Cow, path::Path};

/// The bytes of all buffers.
pub(super) struct Buffers<'a> {
    document: &'a Document,
    list: Vec<Cow<'a, [u8]>>,
}

fn fault(what: impl Into<String>) -> InputError {
    InputError::at(JsonPath::root(), what).hint("the file is damaged, or cut off; export it again")
}

impl<'a> Buffers<'a> {
    /// Buffers inside the file, in its text, or in files beside it.
    ///
    /// # Errors
    /// One cannot be read.
    pub fn read(
        document: &'a Document,
        inside: Option<&'a [u8]>,
        folder: Option<&Path>,
    ) -> Result<Self, InputError> {
        let one = |(k, buffer): (usize, &'a super::document::Buffer)| match &buffer.uri {
            None if k == 0 => {
                let bytes =
                    inside.ok_or_else(|| fault("buffers[0] has no uri, and none is inside"))?;
                Ok(Cow::Borrowed(bytes))
            }
            None => Err(fault(format!("buffers[{k}] has no uri"))),
            Some(uri) => match uri.strip_prefix("data:") {
                Some(data) => {
                    let (kind, text) = data.split_once(',').unwrap_or((data, ""));
                    if !kind.ends_with(";base64") {
                        return Err(fault(format!("buffers[{k}]: data other than base64")));
                    }
                    let bytes = BASE64.decode(text.as_bytes());
                    bytes.map(Cow::Owned).map_err(|e| fault(format!("buffers[{k}]: {e}")))
                }
                None => mesh::bytes_beside(folder, uri).map(Cow::Owned),
            },
        };
        let list = document.buffers.iter().enumerate().map(one).collect::<Result<_, _>>()?;
        Ok(Self { document, list })
    }

    fn accessor(&self, number: usize, kind: &str) -> Result<&'a Accessor, InputError> {
        let accessor = self.document.accessors.get(number);
        let accessor = accessor.ok_or_else(|| fault(format!("there is no accessors[{number}]")))?;
        if accessor.sparse.is_some() {
            return Err(InputError::at(JsonPath::root(), format!("accessors[{number}] is sparse"))
                .hint("export without sparse accessors"));
        }
        if accessor.kind != kind {
            let is = shorten(&accessor.kind);
            return Err(fault(format!("accessors[{number}] is {is}, not {kind}")));
        }
        Ok(accessor)
    }

    /// The elements of an accessor, `N` numbers each.
    fn elements<const N: usize>(
        &self,
        number: usize,
        kind: &str,
    ) -> Result<Vec<[f64; N]>, InputError> {
        let accessor = self.accessor(number, kind)?;
        let (size, read) = component(accessor).ok_or_else(|| {
            fault(format!("accessors[{number}]: component type {}", accessor.component_type))
        })?;
        let short = || fault(format!("accessors[{number}] reaches beyond its buffer"));
        let view = accessor.buffer_view.and_then(|k| self.document.buffer_views.get(k));
        let view = view.ok_or_else(|| fault(format!("accessors[{number}] has no buffer view")))?;
        let bytes = self.list.get(view.buffer).ok_or_else(short)?;
        let end = view.byte_offset.checked_add(view.byte_length).ok_or_else(short)?;
        let bytes = bytes.get(view.byte_offset..end).ok_or_else(short)?;
        let bytes = bytes.get(accessor.byte_offset..).ok_or_else(short)?;
        let stride = view.byte_stride.unwrap_or(N * size).max(1);
        let needed = match accessor.count.checked_sub(1) {
            None => Some(0),
            Some(steps) => steps.checked_mul(stride).and_then(|n| n.checked_add(N * size)),
        };
        if needed.is_none_or(|n| n > bytes.len()) {
            return Err(short());
        }
        let one = |i: usize| std::array::from_fn(|k| read(&bytes[i * stride + k * size..]));
        Ok((0..accessor.count).map(one).collect())
    }

    /// Points; all of them finite.
    ///
    /// # Errors
    /// The accessor is damaged.
    pub fn points(&self, number: usize) -> Result<Vec<[f64; 3]>, InputError> {
        let list = self.elements::<3>(number, "VEC3")?;
        match list.iter().position(|p| p.iter().any(|c| !c.is_finite())) {
            None => Ok(list),
            Some(k) => Err(fault(format!("accessors[{number}]: corner {k} is not finite"))),
        }
    }

    /// Indices of so many corners.
    ///
    /// # Errors
    /// The accessor is damaged, or names a corner that is not there.
    pub fn indices(&self, number: usize, corners: usize) -> Result<Vec<usize>, InputError> {
        let list = self.elements::<1>(number, "SCALAR")?;
        let index = |[value]: [f64; 1]| match value >= 0.0 && value < corners as f64 {
            true => Ok(value as usize),
            false => Err(fault(format!("accessors[{number}]: corner {value} of {corners}"))),
        };
        list.into_iter().map(index).collect()
    }
}

/// A component from its bytes.
type Decode = fn(&[u8]) -> f64;

/// Bytes of a component, and how they are read (Khronos Group 2021, table of section 3.6.2.2, and 3.11 for
/// normalized integers).
fn component(accessor: &Accessor) -> Option<(usize, Decode)> {
    fn word<const N: usize>(b: &[u8]) -> [u8; N] {
        std::array::from_fn(|k| b[k])
    }
    Some(match (accessor.component_type, accessor.normalized) {
        (5120, false) => (1, |b| f64::from(i8::from_le_bytes(word(b)))),
        (5120, true) => (1, |b| (f64::from(i8::from_le_bytes(word(b))) / 127.0).max(-1.0)),
        (5121, false) => (1, |b| f64::from(b[0])),
        (5121, true) => (1, |b| f64::from(b[0]) / 255.0),
        (5122, false) => (2, |b| f64::from(i16::from_le_bytes(word(b)))),
        (5122, true) => (2, |b| (f64::from(i16::from_le_bytes(word(b))) / 32767.0).max(-1.0)),
        (5123, false) => (2, |b| f64::from(u16::from_le_bytes(word(b)))),
        (5123, true) => (2, |b| f64::from(u16::from_le_bytes(word(b))) / 65535.0),
        (5125, _) => (4, |b| f64::from(u32::from_le_bytes(word(b)))),
        (5126, _) => (4, |b| f64::from(f32::from_le_bytes(word(b)))),
        _ => return None,
    })
}
