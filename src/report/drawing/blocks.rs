//! Blocks: faces that look at the eye in four shades, and their edges.

use super::{
    body::{Form, Solid},
    projection::Projection,
    sheet::Sheet,
};
use crate::view::{Surface, View};
use base::plain::markup;
use nalgebra::Vector3;
use std::{collections::HashMap, fmt::Write};

/// Faces seen under less than this (cosine to the eye) are edges.
const EDGE_ON: f64 = 1e-6;
/// Edges between two visible faces are drawn where the faces bend by more than this (cosine of
/// 20°): stones that were measured have thousands of facets, and would be black.
const CREASE: f64 = 0.94;
/// Balls smaller than this on the sheet are drawn without a name.
const SMALL: f64 = 0.5;

/// Draws bodies in an order, each of a class; supports have their own.
pub fn draw(
    sheet: &mut Sheet,
    view: &View,
    paper: &Projection,
    bodies: &[Solid],
    order: &[usize],
    class: &dyn Fn(usize) -> &'static str,
) {
    for &i in order {
        let body = &bodies[i];
        let class = match view.bodies[i].support {
            true if view.hides_supports => continue,
            true if paper.glass => "support glass",
            true => "support",
            false => class(i),
        };
        sheet.put(format_args!("<g class=\"{class}\"><title>{}</title>", markup(&body.body.id)));
        match &body.form {
            Form::Sphere(radius) => {
                let [x, y] = paper.at(&body.middle);
                let r = radius * paper.scale;
                if r > SMALL {
                    sheet.put(format_args!(
                        "<circle class=\"f1\" cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{r:.2}\"/>"
                    ));
                }
            }
            Form::Surface { surface, points, normals } => {
                faces(sheet, paper, surface, points, normals);
                let edges = edges(paper, surface, points, normals, true);
                sheet.put(format_args!("<path class=\"edge\" d=\"{edges}\"/>"));
            }
        }
        sheet.put(format_args!("</g>\n"));
    }
}

/// Outlines of bodies where they are no more.
pub fn ghosts<'a>(
    sheet: &mut Sheet,
    paper: &Projection,
    bodies: impl Iterator<Item = &'a Solid<'a>>,
) {
    let mut path = String::new();
    for body in bodies {
        match &body.form {
            Form::Sphere(radius) => {
                let ([x, y], r) = (paper.at(&body.middle), radius * paper.scale);
                // Writing to a string cannot fail.
                let _ = write!(
                    path,
                    "M{:.2} {y:.2}a{r:.2} {r:.2} 0 1 0 {:.2} 0a{r:.2} {r:.2} 0 1 0 {:.2} 0",
                    x - r,
                    2.0 * r,
                    -2.0 * r
                );
            }
            Form::Surface { surface, points, normals } => {
                path.push_str(&edges(paper, surface, points, normals, false))
            }
        }
    }
    if !path.is_empty() {
        sheet.put(format_args!("<path class=\"ghost\" d=\"{path}\"/>\n"));
    }
}

/// One path a shade.
fn faces(
    sheet: &mut Sheet,
    paper: &Projection,
    surface: &Surface,
    points: &[Vector3<f64>],
    normals: &[Vector3<f64>],
) {
    let axes = paper.axes;
    let light = (axes.up * 0.8 - axes.right * 0.45 + axes.eye * 0.6).normalize();
    let mut seen: Vec<(f64, usize, usize)> = Vec::new();
    for (k, (piece, normal)) in surface.pieces.iter().zip(normals).enumerate() {
        if normal.dot(&axes.eye) > EDGE_ON {
            let shade = [0.8, 0.45, 0.1].iter().filter(|&&b| normal.dot(&light) < b).count();
            let depth = piece.iter().map(|&v| axes.eye.dot(&points[v as usize])).sum::<f64>()
                / piece.len() as f64;
            seen.push((depth, shade, k));
        }
    }
    // Inside a body that is not convex, the far faces first.
    seen.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.2.cmp(&b.2)));
    for group in seen.chunk_by(|a, b| a.1 == b.1) {
        let mut path = String::new();
        for &(_, _, k) in group {
            for (n, &v) in surface.pieces[k].iter().enumerate() {
                let [x, y] = paper.at(&points[v as usize]);
                let _ = write!(path, "{}{x:.2} {y:.2}", if n == 0 { 'M' } else { 'L' });
            }
            path.push('Z');
        }
        sheet.put(format_args!("<path class=\"f{}\" d=\"{path}\"/>", group[0].1));
    }
}

/// Edges of faces that look at the eye: where they end, and (with `inner`) where they bend.
fn edges(
    paper: &Projection,
    surface: &Surface,
    points: &[Vector3<f64>],
    normals: &[Vector3<f64>],
    inner: bool,
) -> String {
    let mut beside: HashMap<(u32, u32), usize> = HashMap::new();
    for (k, piece) in surface.pieces.iter().enumerate() {
        for (n, &v) in piece.iter().enumerate() {
            beside.insert((v, piece[(n + 1) % piece.len()]), k);
        }
    }
    let mut path = String::new();
    for &[i, j] in &surface.edges {
        let sides = [(i, j), (j, i)].map(|e| beside.get(&e).map(|&k| normals[k]));
        let faces = |n: &Option<Vector3<f64>>| n.is_some_and(|n| n.dot(&paper.axes.eye) > EDGE_ON);
        let shown = match (faces(&sides[0]), faces(&sides[1]), sides) {
            (true, true, [Some(a), Some(b)]) => inner && a.dot(&b) < CREASE,
            (false, false, _) => false,
            _ => true,
        };
        if shown {
            let ([ax, ay], [bx, by]) =
                (paper.at(&points[i as usize]), paper.at(&points[j as usize]));
            let _ = write!(path, "M{ax:.2} {ay:.2}L{bx:.2} {by:.2}");
        }
    }
    path
}
