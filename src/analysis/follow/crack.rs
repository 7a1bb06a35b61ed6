//! Which movement of which support explains cracks that are seen: the mechanism of every unit
//! movement of every support is compared with them, by signs first and then by widths (least
//! squares). To first order, and computed: that nothing else explains them is not proved.
//!
//! The inverse of what `settle` asks: cracks of masonry read as hinges of the mechanism that a
//! support sets going (J. Heyman, *The Stone Skeleton*, 1995, chapter 2). The mechanism of a given
//! movement is that of the least reaction.

use super::program::least_reaction;
use base::error::{InputError, JsonPath};
use check::verdict::{Rate, at};
use model::interface::{Interface, Model};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_with::skip_serializing_none;
use solve::program::{Statics, StaticsOptions};

/// Cracks that are seen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cracks {
    /// One by one.
    pub cracks: Vec<Crack>,
}

/// A joint that has opened.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Crack {
    /// The blocks on both sides.
    pub between: [String; 2],
    /// The side on which it is open.
    pub side: CrackSide,
    /// How wide it is open there, m, where it was measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width: Option<f64>,
}

/// A side of a joint.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CrackSide {
    /// Where it is nearest to the middle of the supports.
    Intrados,
    /// Where it is farthest from the middle of the supports.
    Extrados,
    /// Where it is nearest to this point, m.
    #[serde(untagged)]
    Near([f64; 3]),
}

/// A movement of a support, and how well it explains the cracks.
#[skip_serializing_none]
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Explanation {
    /// The support.
    pub support: String,
    /// Unit direction in which it goes; zero where it turns.
    pub way: [f64; 3],
    /// Unit axis about its centre of mass that it turns about; zero where it goes straight.
    pub axis: [f64; 3],
    /// Cracks that open in the mechanism as they are seen, of all.
    pub explained: usize,
    /// Joints that open in the mechanism and are not among the cracks.
    pub unseen: usize,
    /// How far it has gone, m or rad, by least squares over the widths that were measured.
    pub size: Option<f64>,
    /// What is left of the widths then, over all of them: 0 where they are explained.
    pub left: Option<f64>,
}

/// Openings below this × the widest of a mechanism are none. Larger: cracks that hardly opened count
/// for closed. Smaller: what programs leave counts for open.
const OPEN: f64 = 1e-4;

/// Rests of the widths that differ by less are alike. Larger: widths tell movements apart no more.
/// Smaller: rounding orders those that make the same cracks.
const ALIKE: f64 = 1e-6;

/// Every unit movement of every support that touches free blocks, the best explanation first.
///
/// # Errors
/// A crack between blocks that do not touch; a width that is none; no cracks.
pub fn explain(model: &Model, cracks: &Cracks) -> Result<Vec<Explanation>, InputError> {
    let seen = located(model, cracks)?;
    let list = &model.interfaces.list;
    let blocks = &model.assembly.blocks;
    let plane = Statics::new(model, StaticsOptions::default()).plane.map(|p| p.axis);
    let touched = |i: usize| blocks[i].support && list.iter().any(|f| f.a == i || f.b == i);
    let mut all = Vec::new();
    for support in (0..blocks.len()).filter(|&i| touched(i)) {
        for k in 0..12 {
            let unit = Vector3::ith(k % 3, if k % 6 < 3 { 1.0 } else { -1.0 });
            let turns = k >= 6;
            // In a plane scene supports move in its plane and turn across it.
            if plane.is_some_and(|axis| (axis.dot(&unit).abs() > 0.5) != turns) {
                continue;
            }
            let mut rates = vec![Rate::zero(); blocks.len()];
            let (way, axis) =
                if turns { (Vector3::zeros(), unit) } else { (unit, Vector3::zeros()) };
            rates[support] = Rate { velocity: way, spin: axis };
            let Some((_, rates)) = least_reaction(model, &rates) else { continue };
            let compared = compare(model, &rates, &seen);
            let [way, axis]: [[f64; 3]; 2] = [way.into(), axis.into()];
            all.push(Explanation { support: blocks[support].id.clone(), way, axis, ..compared });
        }
    }
    let wrong = |e: &Explanation| seen.len() - e.explained + e.unseen;
    all.sort_by(|a, b| {
        // What differs by rounding alone stays in the order of the scene.
        let left = |e: &Explanation| (e.left.unwrap_or(0.0) / ALIKE).round();
        wrong(a).cmp(&wrong(b)).then(left(a).total_cmp(&left(b)))
    });
    Ok(all)
}

/// A crack at a corner of a joint.
struct LocatedCrack {
    joint: usize,
    point: usize,
    width: Option<f64>,
}

fn located(model: &Model, cracks: &Cracks) -> Result<Vec<LocatedCrack>, InputError> {
    let root = JsonPath::root().key("cracks");
    if cracks.cracks.is_empty() {
        return Err(InputError::at(root, "there are no cracks to explain"));
    }
    let blocks = &model.assembly.blocks;
    let supports: Vec<&Vector3<f64>> =
        blocks.iter().filter(|b| b.support).map(|b| &b.centroid).collect();
    let middle = supports.iter().copied().sum::<Vector3<f64>>() / supports.len().max(1) as f64;
    let one = |(k, crack): (usize, &Crack)| {
        let path = root.index(k);
        let [a, b] = &crack.between;
        let is = |f: &Interface| {
            let ids = [&blocks[f.a].id, &blocks[f.b].id];
            ids == [a, b] || ids == [b, a]
        };
        let joint = model.interfaces.list.iter().position(is).ok_or_else(|| {
            InputError::at(path.key("between"), format!("{a} and {b} do not touch"))
                .hint("name two blocks that share a joint")
        })?;
        if crack.width.is_some_and(|w| !(w > 0.0 && w.is_finite())) {
            return Err(InputError::at(path.key("width"), "must be > 0").hint("m"));
        }
        let (to, sign) = match crack.side {
            CrackSide::Intrados => (middle, 1.0),
            CrackSide::Extrados => (middle, -1.0),
            CrackSide::Near(p) => (Vector3::from(p), 1.0),
        };
        let points = model.interfaces.list[joint].points.iter().enumerate();
        let far = |p: &Vector3<f64>| sign * (p - to).norm();
        let nearest = points.min_by(|(_, p), (_, q)| far(p).total_cmp(&far(q)));
        Ok(LocatedCrack { joint, point: nearest.map_or(0, |(p, _)| p), width: crack.width })
    };
    cracks.cracks.iter().enumerate().map(one).collect()
}

/// What a mechanism makes of the cracks.
fn compare(model: &Model, rates: &[Rate], seen: &[LocatedCrack]) -> Explanation {
    let list = &model.interfaces.list;
    let opening = |f: &Interface, p: &Vector3<f64>| {
        let parts = at(&model.assembly, rates, f.b, p) - at(&model.assembly, rates, f.a, p);
        f.frame.n.dot(&parts)
    };
    let widest: Vec<f64> =
        list.iter().map(|f| f.points.iter().map(|p| opening(f, p)).fold(0.0, f64::max)).collect();
    let open = OPEN * widest.iter().copied().fold(0.0, f64::max);
    let at_crack = |s: &LocatedCrack| opening(&list[s.joint], &list[s.joint].points[s.point]);
    let explained = seen.iter().filter(|s| open > 0.0 && at_crack(s) > open).count();
    let unseen: Vec<f64> = (0..list.len())
        .filter(|k| widest[*k] > open && !seen.iter().any(|s| s.joint == *k))
        .map(|k| widest[k])
        .collect();
    let pairs: Vec<(f64, f64)> =
        seen.iter().filter_map(|s| Some((s.width?, at_crack(s)))).collect();
    let squares = |values: &mut dyn Iterator<Item = f64>| values.map(|v| v * v).sum::<f64>();
    let all = squares(&mut pairs.iter().map(|p| p.0));
    // A joint that is not seen to be open is measured to be closed.
    let power = squares(&mut pairs.iter().map(|p| p.1).chain(unseen.iter().copied()));
    let fitted = (all > 0.0 && power > 0.0).then(|| {
        let size = (pairs.iter().map(|(w, o)| w * o).sum::<f64>() / power).max(0.0);
        let left = squares(&mut pairs.iter().map(|(w, o)| w - size * o))
            + squares(&mut unseen.iter().map(|o| size * o));
        (size, (left / all).sqrt())
    });
    Explanation {
        support: String::new(),
        way: [0.0; 3],
        axis: [0.0; 3],
        explained,
        unseen: unseen.len(),
        size: fitted.map(|f| f.0),
        left: fitted.map(|f| f.1),
    }
}
