//! The keys of a glTF file that say where blocks are, in double precision, and its container.

use crate::import::text;
use base::error::{InputError, JsonPath};
use serde::{Deserialize, de::IgnoredAny};
use serde_json::value::RawValue;

/// Magic number of the binary container, and its kinds of chunks.
const MAGIC: &[u8] = b"glTF";
const JSON: u32 = 0x4e4f_534a;
const BIN: u32 = 0x004e_4942;

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Document {
    pub asset: Asset,
    pub scene: Option<usize>,
    #[serde(default)]
    pub scenes: Vec<Scene>,
    #[serde(default)]
    pub nodes: Vec<Node>,
    #[serde(default)]
    pub meshes: Vec<Mesh>,
    #[serde(default)]
    pub materials: Vec<Named>,
    #[serde(default)]
    pub accessors: Vec<Accessor>,
    #[serde(default)]
    pub buffer_views: Vec<View>,
    #[serde(default)]
    pub buffers: Vec<Buffer>,
    #[serde(default)]
    pub animations: Vec<IgnoredAny>,
    #[serde(default)]
    pub skins: Vec<IgnoredAny>,
    #[serde(default)]
    pub extensions_required: Vec<String>,
}

#[derive(Deserialize)]
pub(super) struct Asset {
    pub version: String,
}

#[derive(Deserialize)]
pub(super) struct Scene {
    #[serde(default)]
    pub nodes: Vec<usize>,
}

#[derive(Deserialize)]
pub(super) struct Node {
    #[serde(default)]
    pub name: String,
    #[serde(default)]
    pub children: Vec<usize>,
    pub mesh: Option<usize>,
    pub translation: Option<[f64; 3]>,
    /// x, y, z, w.
    pub rotation: Option<[f64; 4]>,
    pub scale: Option<[f64; 3]>,
    /// Column by column.
    pub matrix: Option<[f64; 16]>,
    /// Anything that its program keeps.
    pub extras: Option<Box<RawValue>>,
}

#[derive(Deserialize)]
pub(super) struct Named {
    #[serde(default)]
    pub name: String,
}

#[derive(Deserialize)]
pub(super) struct Mesh {
    #[serde(default)]
    pub name: String,
    pub primitives: Vec<Primitive>,
}

#[derive(Deserialize)]
pub(super) struct Primitive {
    pub attributes: Attributes,
    pub indices: Option<usize>,
    pub material: Option<usize>,
    pub mode: Option<u32>,
}

#[derive(Deserialize)]
pub(super) struct Attributes {
    #[serde(rename = "POSITION")]
    pub position: Option<usize>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Accessor {
    pub buffer_view: Option<usize>,
    #[serde(default)]
    pub byte_offset: usize,
    pub component_type: u32,
    #[serde(default)]
    pub normalized: bool,
    pub count: usize,
    #[serde(rename = "type")]
    pub kind: String,
    pub sparse: Option<IgnoredAny>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct View {
    pub buffer: usize,
    #[serde(default)]
    pub byte_offset: usize,
    pub byte_length: usize,
    pub byte_stride: Option<usize>,
}

#[derive(Deserialize)]
pub(super) struct Buffer {
    pub uri: Option<String>,
}

/// The document of a file, and the buffer inside a binary one.
///
/// # Errors
/// It is no glTF 2.
pub(super) fn read(bytes: &[u8]) -> Result<(Document, Option<&[u8]>), InputError> {
    let (json, buffer) = match bytes.strip_prefix(MAGIC) {
        Some(rest) => unpack(rest)?,
        None => (text::unmarked(bytes), None),
    };
    let mut reader = serde_json::Deserializer::from_slice(json);
    let document: Document = serde_path_to_error::deserialize(&mut reader).map_err(|e| {
        let place = (e.inner().line(), e.inner().column());
        let path = e.path().to_string();
        let message = format!("{path}: {}", e.into_inner());
        InputError { position: Some(place), ..InputError::at(JsonPath::root(), message) }
            .hint("the file is damaged, or no glTF 2.0")
    })?;
    if !document.asset.version.starts_with("2.") {
        let version = text::shorten(&document.asset.version);
        return Err(InputError::at(JsonPath::root(), format!("glTF {version}, not 2"))
            .hint("export glTF 2.0"));
    }
    Ok((document, buffer))
}

/// The two chunks of the binary container.
fn unpack(rest: &[u8]) -> Result<(&[u8], Option<&[u8]>), InputError> {
    let fault = |what: &str| {
        InputError::at(JsonPath::root(), format!("a binary glTF file {what}"))
            .hint("the file may be cut off; export it again")
    };
    // Version and length, which the chunks say as well.
    let mut rest = rest.get(8..).ok_or_else(|| fault("without a header"))?;
    let (mut json, mut buffer) = (None, None);
    while !rest.is_empty() {
        let head = rest.first_chunk::<8>().ok_or_else(|| fault("that ends in a chunk's head"))?;
        let [length, kind] =
            [0, 4].map(|k| u32::from_le_bytes([head[k], head[k + 1], head[k + 2], head[k + 3]]));
        let end = (length as usize).saturating_add(8);
        let chunk = rest.get(8..end).ok_or_else(|| fault("that ends in a chunk"))?;
        match kind {
            JSON if json.is_none() => json = Some(chunk),
            BIN if buffer.is_none() => buffer = Some(chunk),
            _ => {}
        }
        rest = &rest[end..];
    }
    Ok((json.ok_or_else(|| fault("without JSON"))?, buffer))
}
