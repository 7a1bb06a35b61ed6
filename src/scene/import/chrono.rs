//! Brick files of Chrono's masonry simulator: a block a row, numbers alone, y up.
//!
//! `ID, fixed, visible, yielding, density, Fx, Fy, Fz, Refx, Refy, Refz, x1, y1, z1, …`: corners whose convex
//! hull is the block; 9999 stands between the hulls of a block that is not convex. Older files have no density.
//!
//! Source: A. Tasora and others, *Masonry simulator*, readme of the project DigitalDynamicsLab/Masonry.

use super::{
    Up,
    raw::{Heft, Raw, Solid, tally},
    rigid::set_apart,
    text::{self, error, lines, shorten},
};
use crate::{Load, generate::hull};
use base::error::{FindingCode, InputError};

/// Stands between hulls.
const NEXT: f64 = 9999.0;

/// Numbers before the corners.
const HEAD: usize = 11;

/// Whether a text begins with a row of such a file.
pub(super) fn looks_like(bytes: &[u8]) -> bool {
    let Some(line) = text::split(bytes).find(|l| !l.trim_ascii().is_empty()) else { return false };
    let text = String::from_utf8_lossy(line);
    let words: Option<Vec<f64>> = text.split(',').map(|w| w.trim().parse().ok()).collect();
    words.is_some_and(|w| {
        w.len() >= HEAD - 1 + 12
            && w[0].fract() == 0.0
            && w[1..3].iter().all(|f| *f == 0.0 || *f == 1.0)
            && [0.0, 1.0, 2.0, 3.0].contains(&w[3])
    })
}

/// The blocks of a file.
pub(super) fn read(bytes: &[u8]) -> Result<Raw, InputError> {
    let mut raw = Raw { up: Some(Up::Y), ..Raw::default() };
    let (mut undense, mut joined) = (Vec::new(), Vec::new());
    for (line, text) in lines(text::unmarked(bytes))? {
        let fault = |what: String| {
            error(line, what).hint(
                "a row is ID, fixed, visible, yielding, density, force (3), reference (3), corners (3 each)",
            )
        };
        let number = |w: &str| {
            w.trim()
                .parse()
                .ok()
                .filter(|v: &f64| v.is_finite())
                .ok_or_else(|| fault(format!("expected a finite number, got {:?}", shorten(w))))
        };
        let row =
            text.trim_end_matches(',').split(',').map(number).collect::<Result<Vec<f64>, _>>()?;
        // Older files have no density: what is left are no triples otherwise.
        let marks = row.iter().filter(|x| **x == NEXT).count();
        let is_dense = row.len() >= HEAD && (row.len() - HEAD - marks).is_multiple_of(3);
        let head = if is_dense { HEAD } else { HEAD - 1 };
        if row.len() < head + 12 || !(row.len() - head - marks).is_multiple_of(3) {
            return Err(fault(format!(
                "{} numbers, which make no corners of three each",
                row.len()
            )));
        }
        let id = format!("b{}", row[0]);
        let density = is_dense.then_some(row[4]);
        if density.is_some_and(|d| d <= 0.0) {
            return Err(fault(format!("density {}: must be > 0", row[4])));
        }
        let mut block =
            Solid { id: id.clone(), support: row[1] != 0.0, line: Some(line), ..Solid::default() };
        block.heft = Heft { density, ..Heft::default() };
        let hulls: Vec<&[f64]> = row[head..].split(|x| *x == NEXT).collect();
        for corners in &hulls {
            let corners: Vec<[f64; 3]> =
                corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect();
            let Some((vertices, faces)) = hull::corners(&corners) else {
                return Err(fault(format!("the corners of block {id} lie in a plane")));
            };
            let first = block.vertices.len();
            block.vertices.extend(vertices);
            if hulls.len() > 1 {
                set_apart(&mut block.vertices[first..]);
            }
            block
                .faces
                .extend(faces.into_iter().map(|f| f.into_iter().map(|k| first + k).collect()));
        }
        if hulls.len() > 1 {
            joined.push(format!("{id:?} ({} hulls)", hulls.len()));
        }
        if density.is_none() && !block.support {
            undense.push(format!("{id:?}"));
        }
        let force = [row[head - 6], row[head - 5], row[head - 4]];
        if force != [0.0; 3] && !block.support {
            raw.dead.push(Load { block: Some(id), force: Some(force), ..Load::default() });
        }
        raw.blocks.push(block);
    }
    let said = [
        (
            FindingCode::Converted,
            joined,
            "blocks of several hulls, one rigid block each, the hulls smaller by a millionth so as not to touch each other",
        ),
        (
            FindingCode::Missing,
            undense,
            "blocks without a density, for which that of the scene's default is assumed (import with `--density`)",
        ),
    ];
    for (code, list, what) in said {
        if !list.is_empty() {
            raw.say(code, format!("{what}: {}", tally(&list)));
        }
    }
    Ok(raw)
}
