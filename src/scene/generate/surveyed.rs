//! An intrados given by points of a survey.
//!
//! At each point the curve has the tangent of the circle through it and its neighbours, so that
//! points on a circle give that circle's normals exactly, however they are spaced; between two points
//! it is the cubic with their tangents (Hermite).

use super::{
    check::TemplatePath,
    midline::{JointLine, Xz},
};
use base::error::InputError;

/// The curve through points from the left springing to the right one, about the middle between the
/// springings and their height.
pub struct Surveyed {
    points: Vec<Xz>,
    /// Unit tangents, towards the right springing.
    tangents: Vec<Xz>,
    /// Along the chords from the left springing to each point, m.
    along: Vec<f64>,
}

impl Surveyed {
    /// Checks the points.
    pub fn new(place: &TemplatePath, points: &[Xz]) -> Result<Self, InputError> {
        let refuse = |k: usize, text: String, hint: &str| {
            Err(InputError::at(place.0.key("intrados").index(k), text).hint(hint))
        };
        if points.len() < 3 {
            return refuse(
                0,
                format!("{} points do not define a curve", points.len()),
                "give three or more, from the left springing to the right one",
            );
        }
        if let Some(k) = points.iter().position(|p| !p.iter().all(|c| c.is_finite())) {
            return refuse(k, "must be two finite numbers".into(), "x and z, in m");
        }
        if let Some(k) = points.windows(2).position(|p| p[0] == p[1]) {
            return refuse(k + 1, "repeats the point before".into(), "remove it");
        }
        let [first, last] = [points[0], points[points.len() - 1]];
        if last[0] <= first[0] {
            return refuse(0, "the points run from right to left".into(), "reverse their order");
        }
        let level = base::tolerance::GRID_SNAP * (last[0] - first[0]);
        if (first[1] - last[1]).abs() > level {
            let text = format!("one springing is {} m high, the other {} m", first[1], last[1]);
            return refuse(
                points.len() - 1,
                text,
                "springings at different heights are not supported: give both the same height",
            );
        }
        let middle = 0.5 * (first[0] + last[0]);
        let points: Vec<Xz> = points.iter().map(|p| [p[0] - middle, p[1] - first[1]]).collect();
        if let Some(k) = (1..points.len() - 1).find(|&k| points[k][1] <= 0.0) {
            return refuse(
                k,
                "does not lie above the springings".into(),
                "give the points of the intrados alone",
            );
        }
        let mut along = vec![0.0];
        for pair in points.windows(2) {
            along.push(along[along.len() - 1] + norm(minus(pair[1], pair[0])));
        }
        Ok(Self { tangents: tangents(&points), points, along })
    }

    /// Distance between the springings, m.
    pub fn clear_span(&self) -> f64 {
        2.0 * self.points[self.points.len() - 1][0]
    }

    /// The highest of the points: x from the middle between the springings, height over them, m.
    pub fn crown(&self) -> Xz {
        self.points[self.highest()]
    }

    fn highest(&self) -> usize {
        let heights = self.points.iter().map(|p| p[1]).enumerate();
        heights.fold((0, 0.0), |a, b| if b.1 > a.1 { b } else { a }).0
    }

    /// The joints of `n` voussoirs between two distances from the intrados, outwards, at u from 0
    /// (crown) to 1 (springings): at the points where there is one for each joint, else evenly along
    /// the curve.
    pub fn joints(&self, n: usize, between: impl Fn(f64) -> [f64; 2]) -> Vec<JointLine> {
        let whole = self.along[self.along.len() - 1];
        let crown = self.along[self.highest()];
        let at = |j: usize| match self.points.len() == n + 1 {
            true => self.along[j],
            false => whole * j as f64 / n as f64,
        };
        let joint = |s: f64| {
            let (point, [x, z]) = self.at(s);
            let u = if s < crown { (crown - s) / crown } else { (s - crown) / (whole - crown) };
            // Turned to the left the tangent points outwards.
            between(u).map(|out| [point[0] - out * z, point[1] + out * x])
        };
        (0..=n).map(|j| joint(at(j))).collect()
    }

    /// The point and the unit tangent so far along the chords.
    fn at(&self, s: f64) -> (Xz, Xz) {
        let last = self.points.len() - 1;
        let k = self.along.partition_point(|a| *a <= s).clamp(1, last) - 1;
        let length = self.along[k + 1] - self.along[k];
        let t = (s - self.along[k]) / length;
        if t <= 0.0 || t >= 1.0 {
            let k = if t <= 0.0 { k } else { k + 1 };
            return (self.points[k], self.tangents[k]);
        }
        let sum = |by: [f64; 4]| -> Xz {
            let of = [self.points[k], self.points[k + 1], self.tangents[k], self.tangents[k + 1]];
            [0, 1].map(|c| by.iter().zip(of).map(|(by, p)| by * p[c]).sum())
        };
        let (t2, t3) = (t * t, t * t * t);
        let point = sum([
            2.0 * t3 - 3.0 * t2 + 1.0,
            3.0 * t2 - 2.0 * t3,
            length * (t3 - 2.0 * t2 + t),
            length * (t3 - t2),
        ]);
        let slope = [6.0 * (t2 - t) / length, 3.0 * t2 - 4.0 * t + 1.0, 3.0 * t2 - 2.0 * t];
        let tangent = sum([slope[0], -slope[0], slope[1], slope[2]]);
        (point, scaled(tangent, 1.0 / norm(tangent)))
    }
}

/// Unit tangents of the circles through every three neighbours; at the ends that of the same circle
/// as beside them.
fn tangents(points: &[Xz]) -> Vec<Xz> {
    let inner = |p: &[Xz]| {
        // Of the circle's image in a circle about the point, which is a line.
        let [a, b] = [minus(p[1], p[0]), minus(p[2], p[1])];
        let sum = plus(scaled(a, 1.0 / dot(a, a)), scaled(b, 1.0 / dot(b, b)));
        scaled(sum, 1.0 / norm(sum).max(f64::MIN_POSITIVE))
    };
    // A chord leans as much from the tangent at one end as at the other.
    let other = |t: Xz, chord: Xz| minus(scaled(chord, 2.0 * dot(t, chord) / dot(chord, chord)), t);
    let mut list: Vec<Xz> = points.windows(3).map(inner).collect();
    let last = points.len() - 1;
    let first = other(list[0], minus(points[1], points[0]));
    list.push(other(list[last - 2], minus(points[last], points[last - 1])));
    list.insert(0, first);
    list
}

fn plus(a: Xz, b: Xz) -> Xz {
    [a[0] + b[0], a[1] + b[1]]
}

fn minus(a: Xz, b: Xz) -> Xz {
    [a[0] - b[0], a[1] - b[1]]
}

fn scaled(a: Xz, by: f64) -> Xz {
    a.map(|c| c * by)
}

fn dot(a: Xz, b: Xz) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn norm(a: Xz) -> f64 {
    a[0].hypot(a[1])
}
