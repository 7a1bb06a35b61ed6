//! Where an isometry takes blocks, contact points and members: itself, or nothing.

use super::members;
use base::tolerance;
use model::{
    assembly::{Block, Wrench},
    interface::{Interface, Model},
};
use nalgebra::{Matrix3, Vector3};
use std::collections::HashMap;

/// Where the isometry `x ↦ turn (x − center) + center` takes the free blocks and contact points of
/// a scene.
#[derive(Clone, Debug)]
pub struct Images {
    /// Image of each block (supports are all one ground: their entries mean nothing).
    pub blocks: Vec<usize>,
    /// First point of each interface in `points`.
    first: Vec<usize>,
    /// Image of each contact point: interface, point, and whether the image of block `b` is block
    /// `a` there.
    points: Vec<(usize, usize, bool)>,
    /// Image of each member; those that can take no force are their own.
    pub members: Vec<usize>,
}

impl Images {
    /// Image of point `k` of interface `f`: interface, point, and whether blocks `a` and `b` change
    /// places.
    pub fn point(&self, f: usize, k: usize) -> (usize, usize, bool) {
        self.points[self.first[f] + k]
    }
}

/// A scene made ready to be compared with its images.
pub struct Matcher<'a> {
    model: &'a Model,
    loads: &'a [&'a [Wrench]],
    /// Free blocks by the cell their centre lies in.
    cells: HashMap<[i64; 3], Vec<usize>>,
    cell: f64,
    /// Interfaces by the pair of blocks.
    pairs: HashMap<[usize; 2], Vec<usize>>,
    center: Vector3<f64>,
}

/// All supports are one.
const GROUND: usize = usize::MAX;

impl<'a> Matcher<'a> {
    pub fn new(model: &'a Model, loads: &'a [&'a [Wrench]], center: Vector3<f64>) -> Self {
        let Model { assembly, interfaces, .. } = model;
        let cell = assembly
            .free()
            .map(|i| assembly.blocks[i].size)
            .fold(f64::INFINITY, f64::min)
            .max(f64::MIN_POSITIVE);
        let mut this =
            Self { model, loads, cells: HashMap::new(), cell, pairs: HashMap::new(), center };
        for i in assembly.free() {
            let key = (assembly.blocks[i].centroid - center).map(|v| (v / cell).floor() as i64);
            this.cells.entry(key.into()).or_default().push(i);
        }
        for (f, face) in interfaces.list.iter().enumerate() {
            this.pairs.entry(pair(this.node(face.a), this.node(face.b))).or_default().push(f);
        }
        this
    }

    fn node(&self, block: usize) -> usize {
        if self.model.assembly.blocks[block].support { GROUND } else { block }
    }

    /// The images under `turn`, if the scene with its loads is its own.
    pub fn images(&self, turn: &Matrix3<f64>) -> Option<Images> {
        let mut blocks = vec![GROUND; self.model.assembly.blocks.len()];
        let mut taken = vec![false; blocks.len()];
        for i in self.model.assembly.free() {
            let j = self.block(i, turn).filter(|&j| !taken[j])?;
            taken[j] = true;
            blocks[i] = j;
        }
        let list = &self.model.interfaces.list;
        let mut first = Vec::with_capacity(list.len());
        let mut points = Vec::with_capacity(list.iter().map(|f| f.points.len()).sum());
        for face in list {
            first.push(points.len());
            let ends = [face.a, face.b]
                .map(|i| if self.model.assembly.blocks[i].support { GROUND } else { blocks[i] });
            let candidates = self.pairs.get(&pair(ends[0], ends[1]))?;
            let found = candidates.iter().find_map(|&f| self.face(face, ends, f, turn));
            points.extend(found?);
        }
        let members = members::images(self.model, &blocks, |x| self.moved(x, turn), turn)?;
        Some(Images { blocks, first, points, members })
    }

    fn moved(&self, x: &Vector3<f64>, turn: &Matrix3<f64>) -> Vector3<f64> {
        turn * (x - self.center) + self.center
    }

    fn block(&self, i: usize, turn: &Matrix3<f64>) -> Option<usize> {
        let block = &self.model.assembly.blocks[i];
        let image = self.moved(&block.centroid, turn);
        let near = tolerance::SYMMETRY * block.size;
        let range = (image - self.center).map(|v| {
            [((v - near) / self.cell).floor() as i64, ((v + near) / self.cell).floor() as i64]
        });
        let span = |k: usize| range[k][0]..=range[k][1];
        for x in span(0) {
            for y in span(1) {
                for z in span(2) {
                    let Some(list) = self.cells.get(&[x, y, z]) else { continue };
                    let same = |&&j: &&usize| {
                        (self.model.assembly.blocks[j].centroid - image).norm() <= near
                            && self.alike(i, j, turn)
                    };
                    if let Some(&j) = list.iter().find(same) {
                        return Some(j);
                    }
                }
            }
        }
        None
    }

    /// Whether block `j` has the mass, its distribution and the loads of block `i`, turned.
    fn alike(&self, i: usize, j: usize, turn: &Matrix3<f64>) -> bool {
        let (a, b): (&Block, &Block) =
            (&self.model.assembly.blocks[i], &self.model.assembly.blocks[j]);
        let near = |x: f64, y: f64| (x - y).abs() <= tolerance::SYMMETRY * y.abs();
        let turned = |w: &Wrench| Wrench {
            force: turn * w.force,
            moment: turn * w.moment * turn.determinant(),
        };
        near(a.mass, b.mass)
            && Matrix3::<f64>::identity().column_iter().all(|e| {
                let (here, there) =
                    (turn * a.gyration.speed(&e.into()), b.gyration.speed(&(turn * e)));
                (here - there).norm() <= tolerance::SYMMETRY * a.size
            })
            && self.loads.iter().all(|loads| {
                let (here, there) = (turned(&loads[i]), &loads[j]);
                let size = there.force.norm() + there.moment.norm() / b.size;
                (here.force - there.force).norm() + (here.moment - there.moment).norm() / b.size
                    <= tolerance::SYMMETRY * size
            })
    }

    /// The images of the points of `face` among those of interface `f`, between the blocks `ends`.
    fn face(
        &self,
        face: &Interface,
        ends: [usize; 2],
        f: usize,
        turn: &Matrix3<f64>,
    ) -> Option<Vec<(usize, usize, bool)>> {
        let other = &self.model.interfaces.list[f];
        let swapped = ends != [self.node(other.a), self.node(other.b)];
        let n = turn * face.frame.n * if swapped { -1.0 } else { 1.0 };
        let same = |x: f64, y: f64| (x - y).abs() <= tolerance::SYMMETRY * y.abs().max(x.abs());
        if (n - other.frame.n).norm() > tolerance::SYMMETRY
            || face.points.len() != other.points.len()
            || face.law != other.law
            || face.kind != other.kind
            || !same(face.area, other.area)
        {
            return None;
        }
        let size =
            self.model.assembly.blocks[face.a].size.min(self.model.assembly.blocks[face.b].size);
        let mut taken = vec![false; other.points.len()];
        face.points
            .iter()
            .map(|p| {
                let image = self.moved(p, turn);
                let near = |k: &usize| {
                    !taken[*k] && (other.points[*k] - image).norm() <= tolerance::SYMMETRY * size
                };
                let k = (0..other.points.len()).find(near)?;
                taken[k] = true;
                Some((f, k, swapped))
            })
            .collect()
    }
}

fn pair(a: usize, b: usize) -> [usize; 2] {
    [a.min(b), a.max(b)]
}
