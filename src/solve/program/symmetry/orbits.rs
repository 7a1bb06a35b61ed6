//! One block for all its images, one contact point and one member for all its images.

use super::find::Symmetry;
use crate::program::{
    Bearing, Plane,
    bearing::{BearingImage, BearingOrbit},
};
use model::assembly::Wrench;
use nalgebra::{DMatrix, DVector, Matrix3};
use std::collections::{HashMap, hash_map::Entry};

/// A block that stands for its images.
#[derive(Clone, Debug, Default)]
pub struct BlockOrbit {
    /// Each image once, with an element of the group that takes the block there.
    pub images: Vec<(usize, usize)>,
    /// Orthonormal directions, as columns, of the row coordinates in which the block needs to be
    /// balanced; `None` for all.
    pub directions: Option<DMatrix<f64>>,
}

/// A scene reduced by its symmetry.
pub struct Part {
    /// The symmetries.
    pub orbits: Orbits,
    /// The blocks that are kept.
    pub blocks: HashMap<usize, BlockOrbit>,
    /// The bearings that are kept, their columns numbered anew.
    pub bearings: Vec<Bearing>,
    /// Per member its images, itself among them, each once; empty where another stands for it.
    pub members: Vec<MemberOrbit>,
}

/// The members that one stands for.
pub type MemberOrbit = Vec<usize>;

/// The symmetries of a scene, and the block that stands for each of its blocks.
#[derive(Clone, Debug)]
pub struct Orbits {
    /// In words.
    pub name: String,
    elements: Vec<Matrix3<f64>>,
    /// Per block of the scene: the block that stands for it and the element that takes it there.
    home: HashMap<usize, (usize, usize)>,
    plane: Option<Plane>,
}

impl Part {
    /// The reduction of the free blocks, bearings and members of a scene; `None` where a bearing has
    /// no image among the bearings.
    pub fn new(
        symmetry: &Symmetry,
        free: impl Iterator<Item = usize>,
        bearings: &[Bearing],
        members: usize,
        plane: Option<Plane>,
    ) -> Option<Self> {
        let mut orbits = Orbits {
            name: symmetry.name(),
            elements: symmetry.elements(),
            home: HashMap::new(),
            plane,
        };
        // A turn goes back by the rest of a whole one; whatever contains the mirror is its own
        // inverse.
        let turns = symmetry.turn.as_ref().map_or(1, |t| t.0);
        let inverse = |g: usize| if g < turns { (turns - g) % turns } else { g };
        let mut blocks = HashMap::new();
        for i in free {
            if orbits.home.contains_key(&i) {
                continue;
            }
            let all = symmetry.orbit(i, |images, i| images.blocks[i]);
            let mut images = Vec::new();
            for (g, &j) in all.iter().enumerate() {
                if let Entry::Vacant(home) = orbits.home.entry(j) {
                    home.insert((i, inverse(g)));
                    images.push((j, g));
                }
            }
            let still: Vec<usize> = (0..all.len()).filter(|&g| all[g] == i).collect();
            blocks.insert(i, BlockOrbit { images, directions: orbits.invariant(&still) });
        }
        let place: HashMap<(usize, usize), usize> = bearings
            .iter()
            .enumerate()
            .flat_map(|(k, b)| b.points.map(|p| ((b.interface, p), k)))
            .collect();
        let mut seen = vec![false; bearings.len()];
        let (mut list, mut column) = (Vec::new(), 0);
        for (k, bearing) in bearings.iter().enumerate() {
            if seen[k] {
                continue;
            }
            let orbit = bearing_orbit(symmetry, bearing, &place, &mut seen)?;
            list.push(Bearing { column, orbit: Some(orbit), ..bearing.clone() });
            column += bearing.basis.len();
        }
        let mut stood_for = vec![false; members];
        let members = (0..members)
            .map(|m| {
                let mut all = symmetry.orbit(m, |images, m| images.members[m]);
                all.retain(|&image| !std::mem::replace(&mut stood_for[image], true));
                all
            })
            .collect();
        Some(Self { orbits, blocks, bearings: list, members })
    }
}

/// The images of a bearing, marked as seen; `place` tells the bearing of a point.
fn bearing_orbit(
    symmetry: &Symmetry,
    bearing: &Bearing,
    place: &HashMap<(usize, usize), usize>,
    seen: &mut [bool],
) -> Option<BearingOrbit> {
    let [first, second] = bearing.points.map(|p| {
        symmetry.orbit((bearing.interface, p, false), |images, (f, p, swapped)| {
            let (f, p, again) = images.point(f, p);
            (f, p, swapped != again)
        })
    });
    let mut orbit = BearingOrbit { images: Vec::with_capacity(first.len()), distinct: 0 };
    for (g, (a, b)) in first.iter().zip(&second).enumerate() {
        let j = *place.get(&(a.0, a.1))?;
        if place.get(&(b.0, b.1)) != Some(&j) {
            return None;
        }
        if !std::mem::replace(&mut seen[j], true) {
            orbit.distinct += 1;
        }
        let sign = if a.2 { -1.0 } else { 1.0 };
        orbit.images.push(BearingImage { element: g, points: [(a.0, a.1), (b.0, b.1)], sign });
    }
    Some(orbit)
}

impl Orbits {
    /// The block that stands for block `j`, and the element that takes `j` there.
    pub fn home(&self, j: usize) -> Option<(usize, usize)> {
        self.home.get(&j).copied()
    }

    /// A wrench under an element of the group.
    pub fn wrench(&self, element: usize, w: &Wrench) -> Wrench {
        let turn = &self.elements[element];
        Wrench { force: turn * w.force, moment: turn * w.moment * turn.determinant() }
    }

    /// An element of the group on row coordinates: force and moment over the radius of gyration, in
    /// the plane or in space.
    pub fn rows(&self, element: usize) -> DMatrix<f64> {
        let turn = &self.elements[element];
        match self.plane {
            Some(p) => {
                let s = p.e1.dot(&(turn * p.e1)).round();
                DMatrix::from_diagonal(&DVector::from_vec(vec![s, 1.0, s]))
            }
            None => {
                let mut m = DMatrix::zeros(6, 6);
                m.view_mut((0, 0), (3, 3)).copy_from(turn);
                m.view_mut((3, 3), (3, 3)).copy_from(&(turn * turn.determinant()));
                m
            }
        }
    }

    /// An orthonormal basis of the row coordinates that none of these elements changes; `None`
    /// where that is all of them.
    fn invariant(&self, still: &[usize]) -> Option<DMatrix<f64>> {
        if still.len() < 2 {
            return None;
        }
        let d = if self.plane.is_some() { 3 } else { 6 };
        let mean = still.iter().map(|&g| self.rows(g)).fold(DMatrix::zeros(d, d), |a, b| a + b)
            / still.len() as f64;
        let mut basis: Vec<DVector<f64>> = Vec::new();
        for k in 0..d {
            let mut v: DVector<f64> = mean.column(k).into();
            for b in &basis {
                v -= b * b.dot(&v);
            }
            let norm = v.norm();
            if norm > 1e-3 {
                basis.push(v.map(|x| if x.abs() > 1e-12 * norm { x / norm } else { 0.0 }));
            }
        }
        Some(DMatrix::from_columns(&basis))
    }
}
