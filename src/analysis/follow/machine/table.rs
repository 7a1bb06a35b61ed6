//! The law of a mechanism from numbers along its linkage.

use check::rocking::{Circular, Law, NODES, Table, law};
use nalgebra::Vector3;
use std::f64::consts::FRAC_PI_2;

/// What a place and its numbers are found by, from a place near by.
pub(super) type At<'a, P> = dyn Fn(&P, f64) -> Option<(P, [f64; 6])> + 'a;

/// Pieces of a quarter turn.
const PIECES: usize = 16;
/// Places at which a circular law is tried.
const TRIED: usize = 8;
/// Numbers that differ by less than this × their size are those of a circular law. Larger: linkages
/// that are nearly parallel pass. Smaller: rounding of the linkage hides a block that turns.
const CIRCULAR: f64 = 1e-11;

/// The law from the start to a quarter turn, or as far as the linkage goes, and where it ends.
pub(super) fn law<P: Clone>(start: &P, at: &At<P>) -> Option<(Law, f64)> {
    if let Some(circular) = circular(start, at) {
        return Some((Law::Circular(circular), FRAC_PI_2));
    }
    let width = FRAC_PI_2 / PIECES as f64;
    let mut pieces: Vec<[[f64; NODES]; 6]> = Vec::new();
    let mut width_used = width;
    // A linkage that ends within the first piece is followed in finer ones.
    for _ in 0..12 {
        pieces.clear();
        let mut near = start.clone();
        let most = (FRAC_PI_2 / width_used).round() as usize;
        'along: for piece in 0..most.min(64) {
            let mut values = [[0.0; NODES]; 6];
            for (k, x) in law::nodes().into_iter().enumerate() {
                let angle = width_used * (piece as f64 + 0.5 * (1.0 + x));
                let Some((place, numbers)) = at(&near, angle) else { break 'along };
                near = place;
                (0..6).for_each(|f| values[f][k] = numbers[f]);
            }
            pieces.push(values.map(|v| law::coefficients(&v)));
        }
        if pieces.len() >= 4 {
            break;
        }
        width_used *= 0.5;
    }
    let end = width_used * pieces.len() as f64;
    (!pieces.is_empty()).then_some((Law::Tabulated(Table { width: width_used, pieces }), end))
}

/// The circular law through two places, where it holds at all others.
fn circular<P: Clone>(start: &P, at: &At<P>) -> Option<Circular> {
    let mut near = start.clone();
    let mut seen = Vec::new();
    for k in 0..=TRIED {
        let angle = FRAC_PI_2 * k as f64 / TRIED as f64;
        let (place, numbers) = at(&near, angle)?;
        near = place;
        seen.push((angle, numbers));
    }
    let (first, last) = (seen[0].1, seen[TRIED].1);
    let pair = |f: usize| [first[f], last[f]];
    let axis = |k: usize| Vector3::new(pair(2)[k], pair(3)[k], pair(4)[k]);
    // Half-way: a (1 − √½) + b √½; at the end a + b.
    let (way, half) = (last[5], seen[TRIED / 2].1[5]);
    let root = std::f64::consts::FRAC_1_SQRT_2;
    let b = (half - way * (1.0 - root)) / (2.0 * root - 1.0);
    let c = Circular {
        inertia: first[0],
        resistance: pair(1),
        grip: [axis(0), axis(1)],
        way: [way - b, b],
    };
    let law = Law::Circular(c);
    let size = |f: std::ops::Range<usize>| {
        seen.iter().flat_map(|(_, n)| n[f.clone()].to_vec()).fold(0.0, |a: f64, v| a.max(v.abs()))
    };
    let sizes = [size(0..1), size(1..2), size(2..5), size(5..6)];
    let fits = seen.iter().all(|(angle, n)| {
        let v = law.at(*angle);
        let near = |a: f64, b: f64, size: f64| (a - b).abs() <= CIRCULAR * size;
        near(v.inertia, n[0], sizes[0])
            && near(v.resistance, n[1], sizes[1])
            && (0..3).all(|k| near(v.grip[k], n[2 + k], sizes[2]))
            && near(v.way, n[5], sizes[3].max(f64::MIN_POSITIVE))
    });
    fits.then_some(c)
}
