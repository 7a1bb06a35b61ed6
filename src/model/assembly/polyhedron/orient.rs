//! Closedness and orientation: every face counter-clockwise seen from outside.

use super::{
    Mend, ShapeError,
    surface::{Face, HalfEdge, Surface, edges},
};
use base::plane::Sets;
use nalgebra::Vector3;
use std::{collections::HashMap, f64::consts::PI};

/// Checks that the surface with the half-edges `list` is closed, winds its faces consistently and
/// outward, and returns the number of closed shells.
///
/// * Every edge must have an even number of faces.
/// * Across an edge with two faces these must run opposite ways; faces connected so are a patch,
///   wound as most of its faces are.
/// * A shell (a patch closed by itself, or several that close each other) winds outward, where its
///   signed volume is positive; one inside another winds the other way round, as a cavity.
pub(super) fn orient(
    surface: &mut Surface,
    list: &[HalfEdge],
    mends: &mut Vec<Mend>,
) -> Result<usize, ShapeError> {
    refuse_odd(surface, list)?;

    let count = surface.faces.len();
    let mut patches = Sets::new(count);
    for edge in edges(list) {
        if let [a, b] = edge
            && !patches.relate(a.face as usize, b.face as usize, a.forward == b.forward)
        {
            return Err(ShapeError::OneSided { face: surface.faces[a.face as usize].source });
        }
    }
    let patch: Vec<(usize, bool)> = (0..count).map(|f| patches.side(f)).collect();

    // Wind each patch as most of its faces are wound.
    let mut balance = vec![0i64; count];
    for &(root, against) in &patch {
        balance[root] += if against { -1 } else { 1 };
    }
    let mut turn: Vec<bool> =
        patch.iter().map(|&(root, against)| against != (balance[root] < 0)).collect();

    let mut shells = Sets::new(count);
    for (f, &(root, _)) in patch.iter().enumerate() {
        shells.join(f, root);
    }
    for edge in edges(list).filter(|e| e.len() > 2) {
        pair_up(surface, edge, &patch, &turn, &mut shells)?;
    }
    let (shell, shells) = numbered(&mut shells, count);
    turn_outward(surface, &shell, shells, &mut turn, mends)?;

    let turned = turn.iter().filter(|t| **t).count();
    if turned == count {
        mends.push(Mend::Inverted { faces: count });
    } else if let Some(first) = turn.iter().position(|t| *t) {
        mends.push(Mend::Turned { faces: turned, first: surface.faces[first].source, of: count });
    }
    for (face, _) in surface.faces.iter_mut().zip(&turn).filter(|(_, turn)| **turn) {
        face.corners.reverse();
    }
    Ok(shells)
}

/// Refuses edges with one face (open), or with three or more that cannot pair up.
fn refuse_odd(surface: &Surface, list: &[HalfEdge]) -> Result<(), ShapeError> {
    let source = |h: &HalfEdge| surface.faces[h.face as usize].source;
    let mut open = edges(list).filter(|e| e.len() == 1);
    let crowded = edges(list).any(|e| e.len() > 2);
    if crowded {
        refuse_duplicates(&surface.faces)?;
    }
    if let Some(first) = open.next() {
        let h = &first[0];
        let (from, to) = if h.forward { (h.low, h.high) } else { (h.high, h.low) };
        return Err(ShapeError::Open {
            edges: 1 + open.count(),
            face: source(h),
            from: surface.place(from),
            to: surface.place(to),
        });
    }
    match edges(list).find(|e| e.len() % 2 == 1) {
        Some(edge) => Err(branching(surface, edge)),
        None => Ok(()),
    }
}

fn branching(surface: &Surface, edge: &[HalfEdge]) -> ShapeError {
    let source = |h: &HalfEdge| surface.faces[h.face as usize].source;
    ShapeError::Branching {
        faces: edge.len(),
        first: source(&edge[0]),
        second: source(&edge[edge.len() - 1]),
        from: surface.place(edge[0].low),
        to: surface.place(edge[0].high),
    }
}

/// Refuses two faces over the same corners.
fn refuse_duplicates(faces: &[Face]) -> Result<(), ShapeError> {
    let mut seen: HashMap<Vec<u32>, usize> = HashMap::with_capacity(faces.len());
    for face in faces {
        let mut key = face.corners.clone();
        key.sort_unstable();
        if let Some(first) = seen.insert(key, face.source) {
            return Err(ShapeError::DuplicateFace { first, second: face.source });
        }
    }
    Ok(())
}

/// At an edge with four or more faces as many must run one way as the other; patches that close
/// only together become one shell.
fn pair_up(
    surface: &Surface,
    edge: &[HalfEdge],
    patch: &[(usize, bool)],
    turn: &[bool],
    shells: &mut Sets,
) -> Result<(), ShapeError> {
    let sign = |h: &HalfEdge| if h.forward != turn[h.face as usize] { 1i64 } else { -1 };
    let mut sums: Vec<(usize, i64)> = Vec::with_capacity(edge.len());
    for h in edge {
        let root = patch[h.face as usize].0;
        match sums.iter_mut().find(|(r, _)| *r == root) {
            Some((_, sum)) => *sum += sign(h),
            None => sums.push((root, sign(h))),
        }
    }
    sums.retain(|(_, sum)| *sum != 0);
    if sums.iter().map(|(_, sum)| sum).sum::<i64>() != 0 {
        return Err(branching(surface, edge));
    }
    for pair in sums.windows(2) {
        shells.join(pair[0].0, pair[1].0);
    }
    Ok(())
}

/// One closed shell.
struct Shell {
    /// Signed volume as wound before this step.
    volume: f64,
    low: Vector3<f64>,
    high: Vector3<f64>,
    /// Its faces.
    faces: Vec<u32>,
}

/// Turns whole shells: outer ones outward, inner ones against the shell around them.
fn turn_outward(
    surface: &Surface,
    shell: &[usize],
    count: usize,
    turn: &mut [bool],
    mends: &mut Vec<Mend>,
) -> Result<(), ShapeError> {
    let mut shells: Vec<Shell> = (0..count)
        .map(|_| Shell {
            volume: 0.0,
            low: Vector3::repeat(f64::INFINITY),
            high: Vector3::repeat(f64::NEG_INFINITY),
            faces: Vec::new(),
        })
        .collect();
    for (f, face) in surface.faces.iter().enumerate() {
        let shell = &mut shells[shell[f]];
        shell.faces.push(f as u32);
        let mut volume = 0.0;
        surface.fan(face, |a, b, c| volume += a.dot(&b.cross(&c)) / 6.0);
        shell.volume += if turn[f] { -volume } else { volume };
        for &c in &face.corners {
            shell.low = shell.low.inf(&surface.point(c));
            shell.high = shell.high.sup(&surface.point(c));
        }
    }

    // From the largest inwards, so that the shell around is settled first.
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|&a, &b| shells[b].volume.abs().total_cmp(&shells[a].volume.abs()));
    let mut outward = vec![true; count];
    let mut bodies = 0;
    for (rank, &inner) in order.iter().enumerate() {
        let around = order[..rank]
            .iter()
            .rev()
            .copied()
            .find(|&outer| inside(surface, &shells[inner], &shells[outer]));
        match around {
            None => outward[inner] = true,
            Some(outer) if (shells[inner].volume < 0.0) != (shells[outer].volume < 0.0) => {
                outward[inner] = !outward[outer]
            }
            Some(outer) => {
                let face = |s: usize| surface.faces[shells[s].faces[0] as usize].source;
                return Err(ShapeError::Nested { inner: face(inner), outer: face(outer) });
            }
        }
        bodies += usize::from(outward[inner]);
        if (shells[inner].volume > 0.0) != outward[inner] {
            for &f in &shells[inner].faces {
                turn[f as usize] = !turn[f as usize];
            }
        }
    }
    if bodies > 1 {
        mends.push(Mend::Bodies { bodies });
    }
    Ok(())
}

/// Whether one shell lies inside another. Shells that cut through each other are found later.
fn inside(surface: &Surface, inner: &Shell, outer: &Shell) -> bool {
    let slack = base::tolerance::WELD * surface.size;
    if (0..3).any(|k| inner.low[k] < outer.low[k] - slack || inner.high[k] > outer.high[k] + slack)
    {
        return false;
    }
    // The shells may touch, and a point on the outer one is neither in nor out: of a few points,
    // take the one that says it most clearly.
    let clearest = inner
        .faces
        .iter()
        .take(8)
        .map(|&f| {
            let corners = &surface.faces[f as usize].corners;
            let mean = corners.iter().map(|&c| surface.point(c)).sum::<Vector3<f64>>()
                / corners.len() as f64;
            winding(surface, outer, mean)
        })
        .max_by(|a, b| (a - 0.5).abs().total_cmp(&(b - 0.5).abs()));
    clearest.is_some_and(|w| w > 0.5)
}

/// How often a shell winds around a point, without sign: 1 inside, 0 outside. Solid angles after van Oosterom & Strackee,
/// *The solid angle of a plane triangle*, IEEE Trans. Biomed. Eng. 30(2), 1983.
fn winding(surface: &Surface, shell: &Shell, point: Vector3<f64>) -> f64 {
    let mut angle = 0.0;
    for &f in &shell.faces {
        surface.fan(&surface.faces[f as usize], |a, b, c| {
            let (a, b, c) = (a - point, b - point, c - point);
            let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
            let det = a.dot(&b.cross(&c));
            angle +=
                2.0 * det.atan2(la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb);
        });
    }
    (angle / (4.0 * PI)).abs()
}

/// The number of each face's shell, counted from 0 in order of first faces, and how many shells
/// there are.
fn numbered(shells: &mut Sets, count: usize) -> (Vec<usize>, usize) {
    let (mut numbers, mut next) = (vec![0; count], 0);
    for f in 0..count {
        let first = shells.find(f);
        numbers[f] = if first == f { next } else { numbers[first] };
        next += usize::from(first == f);
    }
    (numbers, next)
}
