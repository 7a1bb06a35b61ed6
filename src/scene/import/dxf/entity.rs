//! The entities of a drawing.

use super::{pairs::Pair, place::Place};
use base::error::InputError;

/// An entity: its type and what follows up to the next.
#[derive(Clone, Copy)]
pub(super) struct Entity<'a> {
    pub kind: &'a Pair<'a>,
    pub body: &'a [Pair<'a>],
}

impl<'a> Entity<'a> {
    /// What belongs to the entity itself: the vertices of a POLYLINE follow as entities of their own.
    pub fn head(&self) -> &'a [Pair<'a>] {
        &self.body[..self.body.iter().position(|p| p.code == 0).unwrap_or(self.body.len())]
    }

    pub fn pair(&self, code: i32) -> Option<&'a Pair<'a>> {
        self.head().iter().find(|p| p.code == code)
    }

    pub fn word(&self, code: i32) -> Option<&'a str> {
        self.pair(code).map(|p| &*p.value)
    }

    pub fn flags(&self) -> i64 {
        self.word(70).and_then(|w| w.parse().ok()).unwrap_or(0)
    }

    pub fn number(&self, code: i32, missing: f64) -> Result<f64, InputError> {
        self.pair(code).map_or(Ok(missing), Pair::number)
    }

    /// The point of the codes `code`, `code` + 10, `code` + 20.
    pub fn point(&self, code: i32) -> Result<[f64; 3], InputError> {
        Ok([self.number(code, 0.0)?, self.number(code + 10, 0.0)?, self.number(code + 20, 0.0)?])
    }

    /// Where its own coordinates lie: those of plane entities are seen along their normal.
    pub fn facing(&self) -> Result<Option<Place>, InputError> {
        let normal = [self.number(210, 0.0)?, self.number(220, 0.0)?, self.number(230, 1.0)?];
        Ok(match normal {
            [0.0, 0.0, z] if z > 0.0 => Some(Place::default()),
            // Seen from behind: x points to the other side.
            [0.0, 0.0, z] if z < 0.0 => Some(Place::scaled([-1.0, 1.0, -1.0])),
            _ => None,
        })
    }
}

/// The entities among pairs, in their order.
pub(super) fn entities<'a>(pairs: &'a [Pair<'a>]) -> Vec<Entity<'a>> {
    let begin = pairs.iter().position(|p| p.code == 0).unwrap_or(pairs.len());
    let goes_on = |next: &Pair| next.code != 0 || matches!(&*next.value, "VERTEX" | "SEQEND");
    pairs[begin..]
        .chunk_by(|_, next| goes_on(next))
        .filter_map(|chunk| chunk.split_first().map(|(kind, body)| Entity { kind, body }))
        .collect()
}
