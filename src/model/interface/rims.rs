//! Rims: edges and corners of one block that meet edges and corners of another.
//!
//! What keeps the two apart there is a set of directions: those inside the normals of the one and
//! against the normals of the other, `N = cone(a) ∩ −cone(b)`, where a facet counts up to its rim
//! unless a third block lies against it there. What a foot meets in the corner of slab and kerb is
//! the face of each; where four blocks of a bond meet along a line, diagonal neighbours meet nothing.
//! Where `N` is one direction, it is a contact like any other; where it is wider, the contact
//! carries the outermost directions ([`Interface::ways`](super::Interface::ways)) and lies across
//! the one in their middle, the centre of the smallest cap around them.

use super::{
    body::{Bounds, Edge, Solidity, unit},
    faces::Gap,
    features::{Touch, distance_to_segment, edge_pairs, nearest_on_segment},
    limits::Limits,
};
use base::tolerance::CONTACT_ROUNDING_ANGLE;
use nalgebra::{Matrix3, Vector3};

/// Directions this close are one.
const SAME: f64 = 10.0 * CONTACT_ROUNDING_ANGLE;

/// A block and what lies against it.
struct Side<'a> {
    solid: &'a Solidity<'a>,
    /// Whether a facet with this outward normal has a third block against it at a point.
    covered: &'a dyn Fn(&Vector3<f64>, Vector3<f64>) -> bool,
}

/// Whether a contact lies at a point already, with a normal among these directions.
pub(super) type Known<'a> = &'a dyn Fn(Vector3<f64>, &[Vector3<f64>]) -> bool;

/// What was found at the rims of two blocks.
#[derive(Default)]
pub(super) struct Rims {
    /// What carries.
    pub touches: Vec<Touch>,
    /// Whether the blocks meet where nothing carries.
    pub idle: bool,
}

/// The sheets of a block around a place: normals of facets that turn convex edges to each other.
type Sheets = Vec<Vec<Vector3<f64>>>;

/// All rims that meet. `covered` says of each block whether a facet with this outward normal has a
/// third one against it at a point, `known` whether one of these directions at a point is that of a
/// contact already.
pub(super) fn meet(
    [a, b]: [&Solidity; 2],
    window: &Bounds,
    limits: &Limits,
    covered: &[impl Fn(&Vector3<f64>, Vector3<f64>) -> bool; 2],
    known: Known,
) -> Rims {
    let [a, b] = [Side { solid: a, covered: &covered[0] }, Side { solid: b, covered: &covered[1] }];
    let mut rims = Rims::default();
    let mut add = |points: [Vector3<f64>; 2], gap: f64, [one, other]: [Sheets; 2]| {
        let middle = (points[0] + points[1]) / 2.0;
        let mut new = Vec::new();
        let mut idle = true;
        for (ga, gb) in one.iter().flat_map(|ga| other.iter().map(move |gb| (ga, gb))) {
            let ways = common(ga, gb);
            let Some(n) = center(&ways) else { continue };
            idle = false;
            let near = |t: &Touch| {
                let [p, q] = [t.points[0], t.points[t.points.len() - 1]];
                points.iter().all(|x| distance_to_segment(*x, p, q) <= 2.0 * limits.gap)
            };
            let twice = new.iter().any(|t: &Touch| t.n.dot(&n) > 0.9);
            if !twice && !rims.touches.iter().any(near) && !known(middle, &ways) {
                let is_edge = (points[1] - points[0]).norm() > limits.gap;
                new.push(Touch {
                    n,
                    ways: if ways.len() > 1 { ways } else { Vec::new() },
                    points: if is_edge { points.to_vec() } else { vec![middle] },
                    patches: 1,
                    gap: Gap { least: gap, mean: gap, greatest: gap },
                });
            }
        }
        rims.touches.extend(new);
        rims.idle |= idle;
    };

    let pairs = edge_pairs(a.solid, b.solid, window, limits.gap);
    for &(ea, eb) in &pairs {
        if let Some((points, gap)) = along_each_other(a.solid, ea, b.solid, eb, limits) {
            let middle = (points[0] + points[1]) / 2.0;
            add(points, gap, [a.along(ea, middle), b.along(eb, middle)]);
        }
    }
    for (v, w) in corners(a.solid, b.solid, window, limits) {
        let (p, q) = (v.at(a.solid), w.at(b.solid));
        let middle = (p + q) / 2.0;
        add([middle; 2], (q - p).norm(), [a.around(&v, middle), b.around(&w, middle)]);
    }
    rims
}

impl Side<'_> {
    fn open(&self, facet: usize, at: Vector3<f64>) -> Option<Vector3<f64>> {
        let n = self.solid.polyhedron.facets[facet].normal;
        (!(self.covered)(&n, at)).then_some(n)
    }

    fn along(&self, edge: &Edge, at: Vector3<f64>) -> Sheets {
        let open = edge.facets.map(|f| self.open(f, at));
        match edge.convex {
            true => vec![open.into_iter().flatten().collect()],
            false => open.into_iter().flatten().map(|n| vec![n]).collect(),
        }
    }

    fn around(&self, place: &Place, at: Vector3<f64>) -> Sheets {
        let vertex = match place {
            Place::Edge(edge, _) => return self.along(edge, at),
            Place::Corner(v) => *v,
        };
        let own = || self.solid.topology().edges.iter().filter(|e| e.ends.contains(&vertex));
        let mut sheets: Vec<Vec<usize>> = Vec::new();
        for edge in own() {
            let of = |sheets: &[Vec<usize>], f| sheets.iter().position(|s| s.contains(&f));
            let [i, j] = edge.facets.map(|f| {
                of(&sheets, f).unwrap_or_else(|| {
                    sheets.push(vec![f]);
                    sheets.len() - 1
                })
            });
            if edge.convex && i != j {
                let more = sheets.swap_remove(i.max(j));
                sheets[i.min(j)].extend(more);
            }
        }
        let open = |s: Vec<usize>| s.into_iter().filter_map(|f| self.open(f, at)).collect();
        sheets.into_iter().map(open).collect()
    }
}

/// Where on a block something meets it.
enum Place<'s> {
    Corner(u32),
    /// On an edge, at a point.
    Edge(&'s Edge, Vector3<f64>),
}

impl Place<'_> {
    fn at(&self, solid: &Solidity) -> Vector3<f64> {
        match self {
            Self::Corner(v) => solid.at(*v),
            Self::Edge(_, at) => *at,
        }
    }
}

/// The piece along which two edges lie along each other within the gap, half-way between them, and
/// their distance.
fn along_each_other(
    a: &Solidity,
    ea: &Edge,
    b: &Solidity,
    eb: &Edge,
    limits: &Limits,
) -> Option<([Vector3<f64>; 2], f64)> {
    let ([pa, qa], [pb, qb]) = (a.ends(ea.ends), b.ends(eb.ends));
    let along = unit(qa - pa);
    if along.cross(&unit(qb - pb)).norm() > limits.chord {
        return None;
    }
    let place = |p: Vector3<f64>| (p - pa).dot(&along);
    let (x, y) = (place(pb), place(qb));
    let (from, to) = (x.min(y).max(0.0), x.max(y).min(place(qa)));
    if to - from <= limits.min_area.sqrt().max(limits.gap) {
        return None;
    }
    let ends = [from, to].map(|t| {
        let p = pa + along * t;
        (p, nearest_on_segment(p, pb, qb))
    });
    let gaps = ends.map(|(p, q)| (q - p).norm());
    let near = gaps.iter().all(|g| *g <= limits.gap);
    near.then(|| (ends.map(|(p, q)| (p + q) / 2.0), gaps[0].max(gaps[1])))
}

/// Corners of each block within the gap of a corner or an edge of the other.
fn corners<'s>(
    a: &'s Solidity,
    b: &'s Solidity,
    window: &Bounds,
    limits: &Limits,
) -> Vec<(Place<'s>, Place<'s>)> {
    let within = |s: &'s Solidity| -> Vec<u32> {
        let all = 0..s.polyhedron.vertices.len() as u32;
        all.filter(|&v| {
            let here = Bounds { lo: s.at(v), hi: s.at(v) }.loosened(limits.gap);
            here.meets(window) && !s.topology().corners[v as usize].along.is_empty()
        })
        .collect()
    };
    let (of_a, of_b) = (within(a), within(b));
    let mut found = Vec::new();
    let nearest = |p: Vector3<f64>, o: &'s Solidity, corners: &[u32]| -> Option<Place<'s>> {
        let distance = |v: &u32| (o.at(*v) - p).norm();
        let corner = corners.iter().min_by(|v, w| distance(v).total_cmp(&distance(w)));
        if let Some(v) = corner.filter(|v| distance(v) <= limits.gap) {
            return Some(Place::Corner(*v));
        }
        let around = Bounds { lo: p, hi: p }.loosened(limits.gap);
        let on = |e: &'s Edge| {
            let [q, r] = o.ends(e.ends);
            (e, nearest_on_segment(p, q, r))
        };
        let near = o.edges_in(&around).map(on).filter(|(_, q)| (q - p).norm() <= limits.gap);
        let (edge, at) = near.min_by(|x, y| (x.1 - p).norm().total_cmp(&(y.1 - p).norm()))?;
        Some(Place::Edge(edge, at))
    };
    for &v in &of_a {
        if let Some(place) = nearest(a.at(v), b, &of_b) {
            found.push((Place::Corner(v), place));
        }
    }
    for &w in &of_b {
        if let Some(place @ Place::Edge(..)) = nearest(b.at(w), a, &of_a) {
            found.push((place, Place::Corner(w)));
        }
    }
    found
}

/// Whether `n` is a sum of some of these directions, none of them backwards.
pub(super) fn is_among(n: &Vector3<f64>, of: &[Vector3<f64>], tolerance: f64) -> bool {
    let m = of.len();
    let near = |sum: Vector3<f64>| (sum - n).norm() <= tolerance;
    (0..m).any(|i| {
        near(of[i])
            || (i + 1..m).any(|j| {
                let w = of[i].cross(&of[j]);
                let [x, y] =
                    [n.cross(&of[j]), of[i].cross(n)].map(|v| v.dot(&w) / w.norm_squared());
                x >= 0.0 && y >= 0.0 && near(of[i] * x + of[j] * y)
                    || (j + 1..m).any(|k| {
                        let basis = Matrix3::from_columns(&[of[i], of[j], of[k]]);
                        basis.determinant().abs() > SAME
                            && basis.lu().solve(n).is_some_and(|c| c.min() >= -tolerance)
                    })
            })
    })
}

/// The outermost directions of those that `a` turns outwards and `b` turns against them.
fn common(a: &[Vector3<f64>], b: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let b: Vec<Vector3<f64>> = b.iter().map(|n| -n).collect();
    let mut ways: Vec<Vector3<f64>> = Vec::new();
    let mut add = |n: Vector3<f64>, one: &[Vector3<f64>], other: &[Vector3<f64>]| {
        if is_among(&n, one, SAME)
            && is_among(&n, other, SAME)
            && !ways.iter().any(|w| (w - n).norm() <= 2.0 * SAME)
        {
            ways.push(n);
        }
    };
    a.iter().for_each(|n| add(*n, a, &b));
    b.iter().for_each(|n| add(*n, a, &b));
    for (i, j) in two(a) {
        for (k, l) in two(&b) {
            let n = unit(i.cross(j).cross(&k.cross(l)));
            if n != Vector3::zeros() {
                [n, -n].into_iter().for_each(|n| add(n, &[*i, *j], &[*k, *l]));
            }
        }
    }
    for k in (0..ways.len()).rev() {
        let others: Vec<_> = (0..ways.len()).filter(|&j| j != k).map(|j| ways[j]).collect();
        if is_among(&ways[k], &others, SAME) {
            ways.remove(k);
        }
    }
    ways
}

fn two(list: &[Vector3<f64>]) -> impl Iterator<Item = (&Vector3<f64>, &Vector3<f64>)> {
    list.iter().enumerate().flat_map(|(i, p)| list[i + 1..].iter().map(move |q| (p, q)))
}

/// The centre of the smallest cap around directions; `None` where there are none, or they go all
/// ways.
fn center(ways: &[Vector3<f64>]) -> Option<Vector3<f64>> {
    let least = |n: &Vector3<f64>| ways.iter().map(|w| w.dot(n)).fold(1.0, f64::min);
    let pairs = two(ways).map(|(p, q)| p + q);
    let threes = (0..ways.len()).flat_map(|i| {
        two(&ways[i + 1..]).flat_map(move |(q, r)| {
            let n = (q - ways[i]).cross(&(r - ways[i]));
            [n, -n]
        })
    });
    let all = ways.iter().copied().chain(pairs).chain(threes).map(unit);
    all.filter(|n| least(n) > 0.0).max_by(|m, n| least(m).total_cmp(&least(n)))
}
