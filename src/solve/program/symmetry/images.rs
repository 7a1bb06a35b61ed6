//! What is true of a scene in one direction is true of its image in another: forces and rates,
//! carried there.

use super::{find, find::Symmetry, matching::Images};
use check::verdict::{Forces, Rate, no_forces};
use model::{assembly::Wrench, interface::Model};
use nalgebra::{Matrix3, Vector3};

/// The isometries that carry a scene under its dead load into itself.
#[derive(Clone, Debug)]
pub struct Isometries(Symmetry);

/// One of them.
#[derive(Clone, Debug)]
pub struct Isometry<'a> {
    /// The mirror, where it comes first.
    mirror: Option<&'a Images>,
    /// The smallest turn, and how often.
    turns: Option<(&'a Images, usize)>,
    matrix: Matrix3<f64>,
}

impl Isometries {
    /// Of a scene; `None` where there is but the identity.
    pub fn of(model: &Model) -> Option<Self> {
        find::find(model, &[&model.assembly.dead], None).map(Self)
    }

    /// One that carries the unit vector `from` into `to`, within `near`.
    pub fn carrying(
        &self,
        from: Vector3<f64>,
        to: Vector3<f64>,
        near: f64,
    ) -> Option<Isometry<'_>> {
        let Self(symmetry) = self;
        let elements = symmetry.elements();
        let g = elements.iter().position(|matrix| (matrix * from - to).norm() <= near)?;
        let turns = symmetry.turn.as_ref().map_or(1, |t| t.0);
        Some(Isometry {
            mirror: symmetry.mirror.as_ref().filter(|_| g >= turns).map(|m| &m.1),
            turns: symmetry.turn.as_ref().map(|(_, images)| (images, g % turns)),
            matrix: elements[g],
        })
    }
}

impl Isometry<'_> {
    /// An item where the generators take it one after the other.
    fn carry<T>(&self, item: T, step: impl Fn(&Images, T) -> T) -> T {
        let item = match self.mirror {
            Some(mirror) => step(mirror, item),
            None => item,
        };
        let (turn, times) = match self.turns {
            Some(turns) => turns,
            None => return item,
        };
        (0..times).fold(item, |item, _| step(turn, item))
    }

    /// A vector that turns its sign under a mirror.
    fn axial(&self, v: Vector3<f64>) -> Vector3<f64> {
        self.matrix * v * self.matrix.determinant()
    }

    /// Forces at the images of the contacts and members of `model`, N.
    pub fn forces(&self, model: &Model, forces: &Forces) -> Forces {
        let joints = &model.interfaces.list;
        let mut images = no_forces(&model.interfaces);
        for (f, own) in forces.iter().take(joints.len()).enumerate() {
            for (k, w) in own.iter().enumerate() {
                let (f, k, swapped) = self.carry((f, k, false), |images, (f, k, swapped)| {
                    let (f, k, again) = images.point(f, k);
                    (f, k, swapped != again)
                });
                let sign = if swapped { -1.0 } else { 1.0 };
                images[f][k] =
                    Wrench { force: self.matrix * w.force, moment: self.axial(w.moment) } * sign;
            }
        }
        // Members that act by one amount: nothing of them turns.
        for (m, own) in forces.iter().skip(joints.len()).enumerate() {
            let image = self.carry(m, |images, m| images.members[m]);
            images[joints.len() + image].clone_from(own);
        }
        images
    }

    /// Rates of the images of the free blocks of `model`.
    pub fn rates(&self, model: &Model, rates: &[Rate]) -> Vec<Rate> {
        let mut images = vec![Rate::zero(); rates.len()];
        for i in model.assembly.free() {
            let Rate { velocity, spin } = rates[i];
            images[self.carry(i, |images, i| images.blocks[i])] =
                Rate { velocity: self.matrix * velocity, spin: self.axial(spin) };
        }
        images
    }
}
