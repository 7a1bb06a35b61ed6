//! From space to the sheet: a parallel projection, and what part of it is shown.

use super::{
    aspect::Axes,
    body::{Form, Solid},
};
use crate::view::View;
use nalgebra::Vector3;

/// Around what is free, over its size: room for loads and the ends of supports.
const RIM: f64 = 0.03;
/// So much of the supports is shown at most, over the size of what is free: a ground slab as wide
/// as one likes would leave no room for what stands on it.
const GROUND: f64 = 0.12;
/// So far outside what is free, over its size, loads are shown.
const ARM: f64 = 0.3;
/// Room for overall dimensions, left and below.
const MEASURED: f64 = 0.07;
/// So far from where it was, over its size, what fell is followed.
const FALLEN: f64 = 0.6;

/// A parallel projection.
#[derive(Clone, Copy, Debug)]
pub struct Projection {
    /// What is seen where.
    pub axes: Axes,
    /// Whether the eye is level with the structure.
    pub elevation: bool,
    /// Units of the sheet per metre.
    pub scale: f64,
    /// Whether supports hide so much that they are drawn as glass.
    pub glass: bool,
    low: [f64; 2],
    high: [f64; 2],
}

/// Limits of a part of the projection plane, m.
#[derive(Clone, Copy)]
struct Frame {
    low: [f64; 2],
    high: [f64; 2],
}

impl Frame {
    const NONE: Self = Self { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };

    fn of<'a>(axes: &Axes, bodies: impl Iterator<Item = &'a Solid<'a>>) -> Self {
        let mut frame = Self::NONE;
        for body in bodies {
            match &body.form {
                Form::Surface { points, .. } => {
                    points.iter().for_each(|v| frame.add(axes, v, 0.0));
                }
                Form::Sphere(radius) => frame.add(axes, &body.middle, *radius),
            }
        }
        frame
    }

    /// Grown to hold a ball.
    fn add(&mut self, axes: &Axes, p: &Vector3<f64>, r: f64) {
        for (k, axis) in [axes.right, axes.up].iter().enumerate() {
            let at = axis.dot(p);
            (self.low[k], self.high[k]) = (self.low[k].min(at - r), self.high[k].max(at + r));
        }
    }

    /// Grown to hold another frame, but by no more than `most` on each side.
    fn grown(&self, other: &Self, most: f64) -> Self {
        let mut frame = *self;
        for k in 0..2 {
            frame.low[k] -= (self.low[k] - other.low[k]).clamp(0.0, most);
            frame.high[k] += (other.high[k] - self.high[k]).clamp(0.0, most);
        }
        frame
    }

    fn size(&self) -> f64 {
        (self.high[0] - self.low[0]).max(self.high[1] - self.low[1])
    }
}

impl Projection {
    /// The projection that shows the structure, where it is and where it goes.
    pub fn new(view: &View, axes: Axes, still: &[Solid], moved: Option<&[Solid]>) -> Self {
        let any_free = view.bodies.iter().any(|b| !b.support);
        let free = |b: &&Solid| !b.body.support || !any_free;
        let held = |b: &&Solid| b.body.support && !view.hides_supports;
        let mut frame = Frame::of(&axes, still.iter().filter(free));
        let size = frame.size();
        if let Some(moved) = moved {
            frame = frame.grown(&Frame::of(&axes, moved.iter().filter(free)), FALLEN * size);
        }
        frame = frame.grown(&Frame::of(&axes, still.iter().filter(held)), GROUND * size);
        let mut loads = Frame::NONE;
        view.loads.iter().for_each(|l| loads.add(&axes, &l.at, 0.0));
        frame = frame.grown(&loads, ARM * size);
        if axes.level {
            let roads = view.roads.iter().flat_map(|r| r.points(view.ground));
            roads.for_each(|p| frame.add(&axes, &p, 0.0));
        }
        for k in 0..2 {
            (frame.low[k], frame.high[k]) = (frame.low[k] - RIM * size, frame.high[k] + RIM * size);
        }
        if view.is_measured && axes.level {
            frame.low = frame.low.map(|low| low - MEASURED * size);
        }
        if !(frame.size().is_finite() && frame.size() > 0.0) {
            frame = Frame { low: [0.0; 2], high: [1.0; 2] };
        }
        let glass = view.walled(&axes.eye);
        Self { axes, elevation: axes.level, scale: 1.0, glass, low: frame.low, high: frame.high }
    }

    /// Height over width.
    pub fn aspect(&self) -> f64 {
        (self.high[1] - self.low[1]) / (self.high[0] - self.low[0])
    }

    /// Fits what is shown into a width and a height.
    pub fn fit(&mut self, width: f64, height: f64) {
        self.scale =
            (width / (self.high[0] - self.low[0])).min(height / (self.high[1] - self.low[1]));
    }

    /// Width and height on the sheet.
    pub fn size(&self) -> [f64; 2] {
        [0, 1].map(|k| (self.high[k] - self.low[k]) * self.scale)
    }

    /// Where a point is seen.
    pub fn at(&self, p: &Vector3<f64>) -> [f64; 2] {
        [
            (self.axes.right.dot(p) - self.low[0]) * self.scale,
            (self.high[1] - self.axes.up.dot(p)) * self.scale,
        ]
    }

    /// Both ends of an arrow whose head is at a point: as long as said, or as there is room for; from
    /// the point onwards where there is next to none.
    pub fn arrow(&self, at: &Vector3<f64>, along: &Vector3<f64>, length: f64) -> [[f64; 2]; 2] {
        /// Shorter is no arrow.
        const LEAST: f64 = 12.0;
        let (to, way, size) = (self.at(at), self.direction(along), self.size());
        let room = (0..2)
            .map(|k| if way[k] > 0.0 { to[k] / way[k] } else { (to[k] - size[k]) / way[k] })
            .filter(|room| room.is_finite())
            .fold(length, f64::min);
        let ahead = |by: f64| [0, 1].map(|k| to[k] + by * way[k]);
        if room < LEAST.min(length) { [to, ahead(length)] } else { [ahead(-room), to] }
    }

    /// Where a direction points on the sheet, its length kept.
    pub fn direction(&self, v: &Vector3<f64>) -> [f64; 2] {
        [self.axes.right.dot(v), -self.axes.up.dot(v)]
    }
}
