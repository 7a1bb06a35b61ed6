//! Mechanisms and films as animations of the nodes of blocks.

use super::{buffer::Buffer, shapes::Shapes};
use crate::{drawing::sized, view::View};
use nalgebra::{UnitQuaternion, Vector3};
use serde_json::{Value, json};

/// Seconds that a mechanism takes, and a film that does not go along time.
const SECONDS: f64 = 3.0;
/// Moments of a mechanism: blocks turn along an arc, of which so many chords are not told apart.
const MOMENTS: usize = 17;

/// A block at a moment: where its centre of mass is, m, about the middle of the view, and how it is
/// turned.
type Pose = (Vector3<f64>, UnitQuaternion<f64>);

/// Every mechanism and the film, and what is told of each.
pub(super) fn animations(
    view: &View,
    shapes: &Shapes,
    buffer: &mut Buffer,
) -> (Vec<Value>, Vec<Value>) {
    let (mut list, mut told) = (Vec::new(), Vec::new());
    for motion in &view.motions {
        let far = sized(view, motion);
        let moments: Vec<f64> = (0..MOMENTS).map(|k| k as f64 / (MOMENTS - 1) as f64).collect();
        let pose = |i: usize, k: usize| {
            let pose = motion.pose(i, far * moments[k]);
            (view.bodies[i].center - view.middle() + pose.shift, pose.turn)
        };
        let moves =
            |i: usize| motion.rates[i].velocity.norm() > 0.0 || motion.rates[i].spin.norm() > 0.0;
        let times: Vec<f64> = moments.iter().map(|m| m * SECONDS).collect();
        list.push(Clip { name: &motion.name, times }.write(view, shapes, buffer, moves, pose));
        told.push(if motion.is_displacement {
            json!({
                "name": motion.name, "kind": "displacement", "magnified": far / motion.reach,
                "seconds": SECONDS,
            })
        } else {
            json!({
                "name": motion.name, "kind": "mechanism", "fastest_corner_m": far,
                "seconds": SECONDS, "note": "the size of the motion is chosen, not computed",
            })
        });
    }
    if view.film.len() > 1 {
        let first = view.film[0].time;
        let span = view.film.last().map_or(0.0, |f| f.time) - first;
        let in_time = view.course.unit == "s" && span > 0.0;
        let even = |k: usize| SECONDS * k as f64 / (view.film.len() - 1) as f64;
        let times = (0..view.film.len())
            .map(|k| if in_time { view.film[k].time - first } else { even(k) })
            .collect();
        let pose = |i: usize, k: usize| {
            let pose = &view.film[k].blocks[i];
            (pose.center - view.middle(), pose.turn)
        };
        let still = |i: usize| {
            let (at, turn) = pose(i, 0);
            (0..view.film.len()).all(|k| (pose(i, k).0 - at).norm() == 0.0 && pose(i, k).1 == turn)
                && (at - view.bodies[i].center + view.middle()).norm() == 0.0
        };
        let clip = Clip { name: &view.course.name, times };
        list.push(clip.write(view, shapes, buffer, |i| !still(i), pose));
        told.push(json!({
            "name": view.course.name, "kind": "film", "in_seconds": in_time,
            "along": view.course.quantity, "unit": view.course.unit,
            "values": view.film.iter().map(|f| f.time).collect::<Vec<_>>(),
        }));
    }
    // Blocks of which nothing moves have no channels; an animation without any is not allowed.
    let kept: Vec<bool> =
        list.iter().map(|a| a["channels"].as_array().is_some_and(|c| !c.is_empty())).collect();
    let keep =
        |list: Vec<Value>| list.into_iter().zip(&kept).filter(|k| *k.1).map(|k| k.0).collect();
    (keep(list), keep(told))
}

/// An animation with its moments, seconds.
struct Clip<'a> {
    name: &'a str,
    times: Vec<f64>,
}

impl Clip<'_> {
    /// Two channels for every block that moves, three where it is not always there.
    fn write(
        &self,
        view: &View,
        shapes: &Shapes,
        buffer: &mut Buffer,
        moves: impl Fn(usize) -> bool,
        pose: impl Fn(usize, usize) -> Pose,
    ) -> Value {
        let (mut channels, mut samplers) = (Vec::new(), Vec::new());
        let times: Vec<f32> = self.times.iter().map(|t| *t as f32).collect();
        let input = buffer.floats(&times, 1, "SCALAR", None);
        let mut channel = |node: usize, path: &str, output: usize, how: &str| {
            samplers.push(json!({ "input": input, "output": output, "interpolation": how }));
            channels.push(json!({
                "sampler": samplers.len() - 1, "target": { "node": node, "path": path },
            }));
        };
        let hidden = |i: usize, k: usize| {
            self.times.len() == view.course.hidden.len() && view.course.hidden[k][i]
        };
        for (i, node) in shapes.node_of.iter().enumerate() {
            let Some(node) = *node else { continue };
            if (0..self.times.len()).any(|k| hidden(i, k)) {
                let size = match view.bodies[i].shape {
                    crate::view::ViewShape::Sphere(radius) => radius,
                    crate::view::ViewShape::Surface(_) => 1.0,
                };
                let there = |k| Vector3::repeat(if hidden(i, k) { 0.0 } else { size });
                let sizes: Vec<Vector3<f64>> = (0..self.times.len()).map(there).collect();
                channel(node, "scale", buffer.vectors(&sizes, None), "STEP");
            }
            if !moves(i) {
                continue;
            }
            let poses: Vec<Pose> = (0..self.times.len()).map(|k| pose(i, k)).collect();
            let places: Vec<Vector3<f64>> = poses.iter().map(|p| p.0).collect();
            channel(node, "translation", buffer.vectors(&places, None), "LINEAR");
            // The nearer of the two quaternions of a rotation, or blocks spin the long way round.
            let mut turns: Vec<f32> = Vec::with_capacity(4 * poses.len());
            let mut last = poses[0].1.coords;
            for (_, turn) in &poses {
                let next = if turn.coords.dot(&last) < 0.0 { -turn.coords } else { turn.coords };
                turns.extend(next.iter().map(|v| *v as f32));
                last = next;
            }
            channel(node, "rotation", buffer.floats(&turns, 4, "VEC4", None), "LINEAR");
        }
        json!({ "name": self.name, "channels": channels, "samplers": samplers })
    }
}
