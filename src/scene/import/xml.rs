//! XML of scenes of robots: elements with their lines, numbers in attributes and texts.

use super::text::{self, shorten};
use base::error::InputError;
use roxmltree::{Document, Node};

/// Deepest element. Deeper: readers that go down by calling themselves run out of stack. Less deep: models
/// of long chains of bodies, one in another, are refused.
const DEEPEST: usize = 200;

/// A document and where its lines begin.
pub(super) struct Xml<'a> {
    pub document: Document<'a>,
    lines: Vec<usize>,
}

impl<'a> Xml<'a> {
    /// The document of a file.
    ///
    /// # Errors
    /// It is no UTF-8, no XML, nested too deep, or declares a document type (and entities with it).
    pub fn read(bytes: &'a [u8]) -> Result<Self, InputError> {
        let bytes = text::unmarked(bytes);
        let text = std::str::from_utf8(bytes).map_err(|e| {
            let line = 1 + bytes[..e.valid_up_to()].iter().filter(|b| **b == b'\n').count();
            text::error(line, "this is not UTF-8").hint("save the file as UTF-8")
        })?;
        let starts = text.match_indices('\n').map(|(at, _)| at + 1);
        let lines: Vec<usize> = std::iter::once(0).chain(starts).collect();
        if let Some(at) = too_deep(bytes) {
            let line = lines.partition_point(|start| *start <= at);
            let message = format!("elements lie more than {DEEPEST} deep in each other");
            return Err(text::error(line, message).hint("flatten the tree of bodies"));
        }
        let document = Document::parse(text).map_err(|e| {
            text::error(e.pos().row as usize, format!("no well-formed XML: {e}"))
                .hint("the file may be cut off; document types (DOCTYPE) are not read")
        })?;
        Ok(Self { document, lines })
    }

    /// The line of an element, counted from 1.
    pub fn line(&self, node: Node) -> usize {
        self.lines.partition_point(|start| *start <= node.range().start)
    }

    /// An error at an element.
    pub fn error(&self, node: Node, message: impl Into<String>) -> InputError {
        text::error(self.line(node), message)
    }

    /// Finite numbers in a text: so many as `counts` allows.
    ///
    /// # Errors
    /// Other words, or another number of them.
    pub fn numbers(
        &self,
        node: Node,
        what: &str,
        text: &str,
        counts: std::ops::RangeInclusive<usize>,
    ) -> Result<Vec<f64>, InputError> {
        let number = |word: &str| {
            word.parse().ok().filter(|v: &f64| v.is_finite()).ok_or_else(|| {
                let message = format!("{what}: expected a finite number, got {:?}", shorten(word));
                self.error(node, message).hint("numbers are separated by spaces")
            })
        };
        let list = text.split_whitespace().map(number).collect::<Result<Vec<f64>, _>>()?;
        if !counts.contains(&list.len()) {
            let (least, most) = (counts.start(), counts.end());
            let rule =
                if least == most { format!("{least}") } else { format!("{least} to {most}") };
            let message = format!("{what}: {} numbers, {rule} expected", list.len());
            return Err(self.error(node, message).hint("the file may be damaged here"));
        }
        Ok(list)
    }

    /// Exactly `N` finite numbers in a text.
    ///
    /// # Errors
    /// As for [`Self::numbers`].
    pub fn exactly<const N: usize>(
        &self,
        node: Node,
        what: &str,
        text: &str,
    ) -> Result<[f64; N], InputError> {
        let list = self.numbers(node, what, text, N..=N)?;
        Ok(std::array::from_fn(|k| list[k]))
    }

    /// A number above zero.
    ///
    /// # Errors
    /// Another one.
    pub fn positive(&self, node: Node, what: &str, value: f64) -> Result<f64, InputError> {
        if value > 0.0 {
            return Ok(value);
        }
        Err(self.error(node, format!("{what}: must be > 0, got {value}")).hint("lengths are in m"))
    }
}

/// The children of an element that are elements.
pub(super) fn elements<'a, 'i>(node: Node<'a, 'i>) -> impl Iterator<Item = Node<'a, 'i>> {
    node.children().filter(Node::is_element)
}

/// The first child of that name.
pub(super) fn child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Option<Node<'a, 'i>> {
    elements(node).find(|n| n.has_tag_name(name))
}

/// `geom "leg"`, or `geom` where it has no name.
pub(super) fn called(node: Node) -> String {
    let tag = shorten(node.tag_name().name());
    node.attribute("name").map_or(tag.clone(), |name| format!("{tag} {:?}", shorten(name)))
}

/// The name of the root element, of a text that may be XML.
pub(super) fn root(bytes: &[u8]) -> Option<&str> {
    let mut rest = text::unmarked(bytes);
    loop {
        rest = rest.trim_ascii_start().strip_prefix(b"<")?;
        if rest.first().is_some_and(|b| *b == b'?' || *b == b'!') {
            let declares = rest.iter().find(|b| matches!(b, b'[' | b'>')) == Some(&b'[');
            let from = if declares { after(rest, 0, b"]")? } else { 0 };
            let end: &[u8] = if rest.starts_with(b"!--") { b"-->" } else { b">" };
            rest = &rest[after(rest, from, end)?..];
            continue;
        }
        let stop = |b: &u8| b.is_ascii_whitespace() || matches!(b, b'>' | b'/');
        return std::str::from_utf8(&rest[..rest.iter().position(stop)?]).ok();
    }
}

/// Where the first element begins that lies too deep. Comments and texts are jumped over; what is
/// no XML is left to the parser.
fn too_deep(bytes: &[u8]) -> Option<usize> {
    let (mut at, mut depth) = (0, 0_usize);
    while let Some(found) = bytes[at..].iter().position(|b| *b == b'<') {
        at += found;
        let here = &bytes[at..];
        let special: Option<&[u8]> = match here {
            [b'<', b'!', b'-', b'-', ..] => Some(b"-->"),
            [b'<', b'!', b'[', ..] => Some(b"]]>"),
            [b'<', b'!' | b'?', ..] => Some(b">"),
            _ => None,
        };
        if let Some(end) = special {
            at = after(bytes, at, end)?;
            continue;
        }
        let (mut quote, mut end) = (None, at + 1);
        while let Some(byte) = bytes.get(end) {
            match (quote, byte) {
                (None, b'>') => break,
                (None, b'"' | b'\'') => quote = Some(byte),
                (Some(open), close) if open == close => quote = None,
                _ => {}
            }
            end += 1;
        }
        let closes = bytes.get(end.wrapping_sub(1)) == Some(&b'/');
        match here.get(1) {
            Some(b'/') => depth = depth.saturating_sub(1),
            _ if closes => {}
            _ => depth += 1,
        }
        if depth > DEEPEST {
            return Some(at);
        }
        at = (end + 1).min(bytes.len());
    }
    None
}

/// The place after the next `end`.
fn after(bytes: &[u8], from: usize, end: &[u8]) -> Option<usize> {
    let found = bytes[from..].windows(end.len()).position(|w| w == end)?;
    Some(from + found + end.len())
}
