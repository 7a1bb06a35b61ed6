//! Tilts towards many directions: where a symmetry of the scene carries one direction into another,
//! the answer is carried there, and only proved anew; elsewhere the program of a direction begins near what
//! that of the direction before passed.

use super::{
    Control, Proved,
    coulomb::DryLoadFactor,
    limit::{self, LoadFactor},
    near::Near,
    tilt::{DryTilt, Tilt, tilt_near},
};
use crate::{
    error::InputError,
    interface::{Model, parts},
    program::{Isometries, Isometry},
    tolerance,
    verdict::{
        Verdict,
        tilted::{direction, tilted},
    },
};
use nalgebra::Vector3;

/// A scene to be tilted, and what carries it into itself.
pub struct Tilts<'a> {
    model: &'a Model,
    control: &'a Control,
    isometries: Option<Isometries>,
}

impl<'a> Tilts<'a> {
    /// Of a scene. Symmetry is looked for where all of it is one part, and nothing has to be kept.
    pub fn of(model: &'a Model, control: &'a Control) -> Self {
        let is_one = !control.keep_all && parts(model).len() == 1;
        let isometries = is_one.then(|| Isometries::of(model)).flatten();
        Self { model, control, isometries }
    }

    /// The bounds towards these directions, in their order.
    ///
    /// # Errors
    /// As [`tilt`](tilt()).
    pub fn bounds(&self, toward: &[Vector3<f64>]) -> Result<Vec<Tilt>, InputError> {
        let mut done: Vec<Tilt> = Vec::with_capacity(toward.len());
        let near = Near::default();
        for &toward in toward {
            let image = match self.original(&done, toward) {
                Some((which, isometry)) => self.bound_from(&done[which], &isometry, toward)?,
                None => None,
            };
            done.push(match image {
                Some(image) => image,
                None => tilt_near(self.model, toward, self.control, &near)?,
            });
        }
        Ok(done)
    }

    /// Adds dry friction to all of them; `level` is the verdict at level, where it is known.
    ///
    /// # Errors
    /// As [`Tilt::add_dry`].
    pub fn add_dry(&self, tilts: &mut [Tilt], level: Option<Verdict>) -> Result<(), InputError> {
        for k in 0..tilts.len() {
            let (done, rest) = tilts.split_at_mut(k);
            let Some(own) = rest.first_mut() else { break };
            let image = match self.original(done, own.toward) {
                Some((which, isometry)) => self.dry_from(&done[which], &isometry, own.toward)?,
                None => None,
            };
            match image {
                Some(image) => own.dry = Some(image),
                None => own.add_dry(self.model, level, self.control)?,
            }
        }
        Ok(())
    }

    /// The unit vector across gravity towards `toward`.
    fn across(&self, toward: Vector3<f64>) -> Vector3<f64> {
        direction(self.model.assembly.gravity.normalize(), toward)
    }

    /// The first of the answers whose direction is carried into this one; none where time is over, for
    /// the image has to be proved.
    fn original(&self, done: &[Tilt], toward: Vector3<f64>) -> Option<(usize, Isometry<'_>)> {
        let isometries = self.isometries.as_ref().filter(|_| !self.control.deadline.is_over())?;
        let toward = self.across(toward);
        done.iter().enumerate().find_map(|(which, tilt)| {
            Some((which, isometries.carrying(tilt.toward, toward, tolerance::SYMMETRY)?))
        })
    }

    /// The image of an answer; `None` where it cannot be proved.
    fn bound_from(
        &self,
        of: &Tilt,
        by: &Isometry,
        toward: Vector3<f64>,
    ) -> Result<Option<Tilt>, InputError> {
        let (own, from) = (&*of.load_factor, of.toward);
        let forces = |forces| by.forces(self.model, forces);
        let mut left_out = own.left_out.clone();
        left_out.push(format!(
            "the programs of this direction: a symmetry of the scene carries the answer towards ({:.4}, {:.4}, {:.4}) here",
            from.x, from.y, from.z
        ));
        let answer = LoadFactor {
            forces: forces(&own.forces),
            base: own.base.as_ref().map(|(at, base)| (*at, forces(base))),
            rates: by.rates(self.model, &own.rates),
            attempts: Vec::new(),
            parts: Vec::new(),
            left_out,
            ..own.clone()
        };
        let model = tilted(self.model, toward, own.value)?;
        let Some(answer) = limit::carried(&model, answer, self.control) else { return Ok(None) };
        let load_factor = Proved::new(&model, answer);
        let refused = load_factor.refused().is_some();
        let toward = self.across(toward);
        Ok((!refused).then_some(Tilt { toward, model, load_factor, dry: None }))
    }

    /// The same with dry friction.
    fn dry_from(
        &self,
        of: &Tilt,
        by: &Isometry,
        toward: Vector3<f64>,
    ) -> Result<Option<DryTilt>, InputError> {
        let Some(own) = of.dry.as_ref().map(|dry| &*dry.load_factor) else { return Ok(None) };
        let answer = DryLoadFactor {
            forces: by.forces(self.model, &own.forces),
            rates: by.rates(self.model, &own.rates),
            ..own.clone()
        };
        let model = tilted(self.model, toward, own.value)?;
        let load_factor = Proved::new(&model, answer);
        let refused = load_factor.refused().is_some();
        Ok((!refused).then_some(DryTilt { model, load_factor }))
    }
}
