//! The symmetries of a scene: a turn about the vertical, a mirror that contains it, and what they
//! make together.

use super::matching::{Images, Matcher};
use crate::program::Plane;
use model::{assembly::Wrench, interface::Model};
use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use std::f64::consts::TAU;

/// The group of the isometries that carry a scene into itself, by its generators.
#[derive(Clone, Debug)]
pub struct Symmetry {
    /// Upward.
    up: Unit<Vector3<f64>>,
    /// The smallest turn: how many make a whole one, and the images under it.
    pub turn: Option<(usize, Images)>,
    /// A mirror.
    pub mirror: Option<(Matrix3<f64>, Images)>,
}

impl Symmetry {
    /// The elements of the group: `k` smallest turns after the mirror or not, ordered with `k`
    /// running fastest, the identity first.
    pub fn elements(&self) -> Vec<Matrix3<f64>> {
        let n = self.turn.as_ref().map_or(1, |t| t.0);
        let turns = || {
            (0..n)
                .map(|k| *Rotation3::from_axis_angle(&self.up, TAU * k as f64 / n as f64).matrix())
        };
        match &self.mirror {
            None => turns().collect(),
            Some((mirror, _)) => turns().chain(turns().map(|r| r * mirror)).collect(),
        }
    }

    /// What an element of the group does to each item, in the order of [`Self::elements`], from
    /// what the generators do to it.
    pub fn orbit<T: Copy>(&self, item: T, step: impl Fn(&Images, T) -> T) -> Vec<T> {
        let mut images = Vec::new();
        for mirrored in [false, true] {
            let mut x = item;
            if mirrored {
                let Some((_, mirror)) = &self.mirror else { break };
                x = step(mirror, x);
            }
            images.push(x);
            if let Some((n, turn)) = &self.turn {
                for _ in 1..*n {
                    x = step(turn, x);
                    images.push(x);
                }
            }
        }
        images
    }

    /// In words.
    pub fn name(&self) -> String {
        match (&self.turn, &self.mirror) {
            (Some((n, _)), None) => format!("{n} equal parts around the vertical"),
            (Some((n, _)), Some(_)) => {
                format!("{n} equal parts around the vertical, each its own mirror image")
            }
            (None, _) => "two halves, mirror images of each other".into(),
        }
    }
}

/// Images tried at most. More: time lost on lattices that are not symmetric. Fewer: turns by
/// smaller angles are not found.
const MOST_TRIED: usize = 720;

/// The symmetries of a scene with its loads; in a plane scene those within the plane.
pub fn find(model: &Model, loads: &[&[Wrench]], plane: Option<Plane>) -> Option<Symmetry> {
    let assembly = &model.assembly;
    let up = Unit::try_new(-assembly.gravity, 0.0)?;
    let mass: f64 = assembly.free().map(|i| assembly.blocks[i].mass).sum();
    let mean = |from: Vector3<f64>| {
        from + assembly
            .free()
            .map(|i| (assembly.blocks[i].centroid - from) * (assembly.blocks[i].mass / mass))
            .sum::<Vector3<f64>>()
    };
    // Sums over thousands of blocks err by as many roundings of what is summed: from the centre
    // itself that is nothing.
    let center = mean(mean(Vector3::zeros()));
    let matcher = Matcher::new(model, loads, center);
    let reflection = |n: Vector3<f64>| Matrix3::identity() - n * n.transpose() * 2.0;
    let mut symmetry = Symmetry { up, turn: None, mirror: None };
    if let Some(plane) = plane {
        let mirror = reflection(plane.e1);
        symmetry.mirror = Some((mirror, matcher.images(&mirror)?));
        return Some(symmetry);
    }
    let angles = angles_of_like(model, center, up)?;
    let mut orders: Vec<usize> = angles.iter().filter_map(|&a| order(a - angles[0])).collect();
    orders.sort_unstable_by(|a, b| b.cmp(a));
    orders.dedup();
    orders.truncate(MOST_TRIED);
    symmetry.turn = orders.into_iter().find_map(|n| {
        let turn = Rotation3::from_axis_angle(&up, TAU / n as f64);
        Some((n, matcher.images(turn.matrix())?))
    });
    let (east, north) = horizontal(up);
    symmetry.mirror = angles.iter().take(MOST_TRIED).find_map(|&a| {
        // The vertical plane half way between the first and its image.
        let half = 0.5 * (angles[0] + a);
        let mirror = reflection(north * half.cos() - east * half.sin());
        Some((mirror, matcher.images(&mirror)?))
    });
    (symmetry.turn.is_some() || symmetry.mirror.is_some()).then_some(symmetry)
}

/// How many turns by an angle make a whole one, if the number is whole and more than one.
fn order(angle: f64) -> Option<usize> {
    let n = TAU / angle.rem_euclid(TAU);
    (n.is_finite() && n > 1.5 && n < 1e6 && (n - n.round()).abs() <= 1e-6 * n)
        .then(|| n.round() as usize)
}

fn horizontal(up: Unit<Vector3<f64>>) -> (Vector3<f64>, Vector3<f64>) {
    let axis = up.iamin();
    let east = Vector3::ith(axis, 1.0);
    let east = (east - up.into_inner() * up.dot(&east)).normalize();
    (east, up.cross(&east))
}

/// Angles about the vertical through `center` of a set of blocks that every symmetry carries into
/// itself: those of one mass, height and distance from the axis, the fewest of all; or of contact
/// points where all blocks are on the axis.
fn angles_of_like(model: &Model, center: Vector3<f64>, up: Unit<Vector3<f64>>) -> Option<Vec<f64>> {
    let Model { assembly, interfaces, .. } = model;
    let (east, north) = horizontal(up);
    let extent = assembly
        .free()
        .map(|i| (assembly.blocks[i].centroid - center).norm() + assembly.blocks[i].size)
        .fold(0.0, f64::max);
    let grid = COARSE * extent;
    let angles = |items: &mut dyn Iterator<Item = (f64, Vector3<f64>)>| {
        let mut all = Vec::new();
        for (mass, x) in items {
            let d = x - center;
            let (u, v) = (east.dot(&d), north.dot(&d));
            let r = u.hypot(v);
            if r > grid {
                all.push(([mass.ln() * extent, up.dot(&d), r], all.len(), v.atan2(u)));
            }
        }
        let mut class = classes(all, grid).into_iter().min_by_key(Vec::len)?;
        class.sort_unstable_by_key(|item| item.1);
        Some(class.into_iter().map(|item| item.2).collect())
    };
    angles(&mut assembly.free().map(|i| (assembly.blocks[i].mass, assembly.blocks[i].centroid)))
        .or_else(|| {
            angles(&mut interfaces.list.iter().flat_map(|f| f.points.iter().map(|p| (1.0, *p))))
        })
}

/// In a class of blocks each is as near as this to the next, in logarithms of masses and in extents
/// of the scene. Larger: classes that are none, and images tried for nothing. Smaller: rounding
/// tears classes apart, and symmetries are not found.
const COARSE: f64 = 1e-6;

/// Mass, height and radius in one unit, the place in the list and the angle.
type Item = ([f64; 3], usize, f64);

/// Items whose neighbours by mass, then by height, then by radius are no farther than `near`. Not
/// those in one cell of a grid: of a pair at the boundary of two cells rounding would leave each by
/// itself, the smallest class of all.
fn classes(items: Vec<Item>, near: f64) -> Vec<Vec<Item>> {
    (0..3).fold(vec![items], |classes, k| {
        let split = |mut class: Vec<Item>| {
            class.sort_by(|a, b| a.0[k].total_cmp(&b.0[k]));
            class.chunk_by(|a, b| b.0[k] - a.0[k] <= near).map(<[Item]>::to_vec).collect::<Vec<_>>()
        };
        classes.into_iter().flat_map(split).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rounding_tears_no_class_apart() {
        // Half way between two cells of a grid of 1e-6, and one bit to either side; and one that is
        // elsewhere.
        let edge = 0.5e-6;
        let items = [edge, 3.0, edge * (1.0 - 1e-15), edge * (1.0 + 1e-15)];
        let items = items.iter().enumerate().map(|(k, r)| ([0.0, 1.0, *r], k, 0.0)).collect();
        let mut sizes: Vec<usize> = classes(items, 1e-6).iter().map(Vec::len).collect();
        sizes.sort_unstable();
        assert_eq!(sizes, [1, 3]);
    }
}
