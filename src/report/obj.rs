//! Wavefront OBJ of the blocks where they go, one object a block: for programs that read meshes and
//! nothing else.

use super::{
    drawing::sized,
    view::{BlockView, View, ViewPart, ViewPose, ViewShape},
    vtk::ball,
};
use base::{number::short, plain::printable};
use nalgebra::{UnitQuaternion, Vector3};
use std::fmt::Write;

/// Halvings of the octahedron that a ball is written as.
const BALL: usize = 3;

/// The blocks at the end of the mechanism of the answer, at the size at which drawings show it; at
/// the last moment of a film; where they are, if nothing moves. Coordinates are those of the scene,
/// metres, to the digits that tell them apart.
pub fn obj(view: &View) -> String {
    let (words, pose) = moved(view);
    let mut out = String::new();
    let mut line = |text: std::fmt::Arguments| {
        // Writing to a string cannot fail.
        let _ = out.write_fmt(text);
        out.push('\n');
    };
    line(format_args!("# voussoir {}: {}", env!("CARGO_PKG_VERSION"), printable(&view.name)));
    line(format_args!("# metres, coordinates of the scene; {words}"));
    let mut first = 1;
    for (i, body) in view.bodies.iter().enumerate() {
        if body.support && view.hides_supports {
            continue;
        }
        let (points, faces) = mesh(body);
        let pose = pose(i);
        line(format_args!("o {}", name(&body.id)));
        line(format_args!("g {}", if body.support { "supports" } else { "blocks" }));
        for p in &points {
            let p = body.center + pose.shift + pose.turn * (p - body.center);
            line(format_args!("v {} {} {}", p.x, p.y, p.z));
        }
        for face in &faces {
            let corners: Vec<String> = face.iter().map(|k| (first + k).to_string()).collect();
            line(format_args!("f {}", corners.join(" ")));
        }
        first += points.len() as u32;
    }
    out
}

/// What moves the blocks, in words, and where each goes.
fn moved<'a>(view: &'a View) -> (String, Box<dyn Fn(usize) -> ViewPose + 'a>) {
    let of = |part: ViewPart| view.motions.iter().find(|m| m.part == part);
    let still = ViewPose { shift: Vector3::zeros(), turn: UnitQuaternion::identity() };
    if let Some(frame) = view.film.last() {
        let pose = |i: usize| ViewPose {
            shift: frame.blocks[i].center - view.bodies[i].center,
            turn: frame.blocks[i].turn,
        };
        let at = format!("{} {} {}", view.course.quantity, frame.time, view.course.unit);
        return (
            format!("{}, not magnified, at: {}", view.course.name, at.trim_end()),
            Box::new(pose),
        );
    }
    match of(ViewPart::Dry).or(of(ViewPart::Answer)).or(view.motions.first()) {
        Some(motion) => {
            let far = sized(view, motion);
            let words = if motion.is_displacement {
                format!("{}, magnified {} times", motion.name, short(far / motion.reach))
            } else {
                format!(
                    "{}: rates times {}, chosen so that the fastest corner goes {} m; a mechanism has no size of its own",
                    motion.name,
                    short(far / motion.reach),
                    short(far)
                )
            };
            (words, Box::new(move |i| motion.pose(i, far)))
        }
        None => ("where they are: nothing moves".into(), Box::new(move |_| still)),
    }
}

/// Corners and loops of corners.
fn mesh(body: &BlockView) -> (Vec<Vector3<f64>>, Vec<Vec<u32>>) {
    match &body.shape {
        ViewShape::Surface(s) => (s.corners.clone(), s.pieces.clone()),
        ViewShape::Sphere(radius) => {
            let (points, faces) = ball(BALL);
            let points = points.into_iter().map(|p| body.center + p * *radius).collect();
            (points, faces.into_iter().map(|f| f.to_vec()).collect())
        }
    }
}

/// A name is one word.
fn name(id: &str) -> String {
    printable(id).chars().map(|c| if c.is_whitespace() { '_' } else { c }).collect()
}
