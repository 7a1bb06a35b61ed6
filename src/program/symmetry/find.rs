//! The symmetries of a scene: a turn about the vertical, a mirror that contains it, and what they make together.

use super::matching::{Images, Matcher};
use crate::{
    assembly::{Assembly, Wrench},
    interface::Interfaces,
    program::Plane,
};
use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use std::{collections::HashMap, f64::consts::TAU};

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
    /// The elements of the group: `k` smallest turns after the mirror or not, ordered with `k` running fastest, the identity first.
    pub fn elements(&self) -> Vec<Matrix3<f64>> {
        let n = self.turn.as_ref().map_or(1, |t| t.0);
        let turns = || (0..n).map(|k| *Rotation3::from_axis_angle(&self.up, TAU * k as f64 / n as f64).matrix());
        match &self.mirror {
            None => turns().collect(),
            Some((mirror, _)) => turns().chain(turns().map(|r| r * mirror)).collect(),
        }
    }

    /// What an element of the group does to each item, in the order of [`Self::elements`], from what the generators do to it.
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
            (Some((n, _)), Some(_)) => format!("{n} equal parts around the vertical, each its own mirror image"),
            (None, _) => "two halves, mirror images of each other".into(),
        }
    }
}

/// Images tried at most. More: time lost on lattices that are not symmetric. Fewer: turns by smaller angles are not found.
const MOST_TRIED: usize = 720;

/// The symmetries of a scene with its loads; in a plane scene those within the plane.
pub fn find(assembly: &Assembly, interfaces: &Interfaces, loads: &[&[Wrench]], plane: Option<Plane>) -> Option<Symmetry> {
    let up = Unit::try_new(-assembly.gravity, 0.0)?;
    let mass: f64 = assembly.free().map(|i| assembly.blocks[i].mass).sum();
    let center = assembly.free().map(|i| assembly.blocks[i].centroid * (assembly.blocks[i].mass / mass)).sum::<Vector3<f64>>();
    let matcher = Matcher::new(assembly, interfaces, loads, center);
    let reflection = |n: Vector3<f64>| Matrix3::identity() - n * n.transpose() * 2.0;
    let mut symmetry = Symmetry { up, turn: None, mirror: None };
    if let Some(plane) = plane {
        let mirror = reflection(plane.e1);
        symmetry.mirror = Some((mirror, matcher.images(&mirror)?));
        return Some(symmetry);
    }
    let angles = angles_of_like(assembly, interfaces, center, up)?;
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
    (n.is_finite() && n > 1.5 && n < 1e6 && (n - n.round()).abs() <= 1e-6 * n).then(|| n.round() as usize)
}

fn horizontal(up: Unit<Vector3<f64>>) -> (Vector3<f64>, Vector3<f64>) {
    let axis = up.iamin();
    let east = Vector3::ith(axis, 1.0);
    let east = (east - up.into_inner() * up.dot(&east)).normalize();
    (east, up.cross(&east))
}

/// Angles about the vertical through `center` of a set of blocks that every symmetry carries into itself: those of one mass, height
/// and distance from the axis, the fewest of all; or of contact points where all blocks are on the axis.
fn angles_of_like(assembly: &Assembly, interfaces: &Interfaces, center: Vector3<f64>, up: Unit<Vector3<f64>>) -> Option<Vec<f64>> {
    let (east, north) = horizontal(up);
    let extent = assembly.free().map(|i| (assembly.blocks[i].centroid - center).norm() + assembly.blocks[i].size).fold(0.0, f64::max);
    let grid = COARSE * extent;
    let angles = |items: &mut dyn Iterator<Item = (f64, Vector3<f64>)>| {
        let mut classes: HashMap<[i64; 3], Vec<f64>> = HashMap::new();
        for (mass, x) in items {
            let d = x - center;
            let (u, v) = (east.dot(&d), north.dot(&d));
            let r = u.hypot(v);
            if r > grid {
                let key = [(mass.ln() / COARSE).round() as i64, (up.dot(&d) / grid).round() as i64, (r / grid).round() as i64];
                classes.entry(key).or_default().push(v.atan2(u));
            }
        }
        classes.into_iter().min_by_key(|(key, list)| (list.len(), *key)).map(|(_, list)| list)
    };
    angles(&mut assembly.free().map(|i| (assembly.blocks[i].mass, assembly.blocks[i].centroid)))
        .or_else(|| angles(&mut interfaces.list.iter().flat_map(|f| f.points.iter().map(|p| (1.0, *p)))))
}

/// Blocks of the same class agree in this share of their mass and of the scene's extent. Classes that rounding tears apart cost a
/// symmetry, nothing else.
const COARSE: f64 = 1e-6;
