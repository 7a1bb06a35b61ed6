//! Tilts towards many directions: where a symmetry of the scene carries one direction into another,
//! the answer is carried there, and only proved anew; elsewhere the program of a direction begins near what
//! that of the direction before passed.

use super::{
    Control, Proved,
    coulomb::DryLoadFactor,
    limit::{self, LoadFactor},
    tilt::{DryTilt, Tilt, tilt_near},
    warm_start::Near,
    watch::Counted,
};
use base::{error::InputError, tolerance};
use check::verdict::{
    Verdict,
    tilted::{direction, tilted},
};
use model::interface::{Model, parts};
use nalgebra::Vector3;
use solve::program::{Isometries, Isometry};

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
        let counted = Counted::new(self.control.watcher, "direction", toward.len());
        for &toward in toward {
            counted.next();
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
        let counted = Counted::new(self.control.watcher, "dry friction, direction", tilts.len());
        for k in 0..tilts.len() {
            counted.next();
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
            "the programs of this direction: by symmetry of the scene the answer is that towards ({:.4}, {:.4}, {:.4})",
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tilt::tilt;
    use check::terms::{Bracket, Engine, Law, Outcome};
    use model::interface::prepare;
    use scene::read_str;

    /// Towards two directions that no symmetry carries into each other: the second after the first, and
    /// the second by itself. Engine and iterations of the first attempts, and the brackets.
    fn second(text: String) -> [(Engine, usize, Bracket); 2] {
        let model = prepare(&read_str("scene", text).unwrap().0).unwrap();
        let control = Control { law: Law::Associative, ..Control::default() };
        let toward = [Vector3::new(1.0, 0.3, 0.0), Vector3::new(1.0, 0.1, 0.0)];
        let after = Tilts::of(&model, &control).bounds(&toward).unwrap().remove(1);
        let alone = tilt(&model, toward[1], &control).unwrap();
        [after, alone].map(|Tilt { load_factor, .. }| {
            assert_eq!(load_factor.outcome, Outcome::Found);
            let first = &load_factor.attempts[0];
            (first.engine, first.iterations, load_factor.bracket)
        })
    }

    #[test]
    fn grains_begin_near_the_direction_before_and_are_answered_as_by_themselves() {
        // Layers of balls, each on three, apart from their neighbours at the same level; large enough for
        // the engine that can begin anywhere.
        let (radius, apart, layers) = (0.5, 1.04, 14);
        let rise = (4.0 * radius * radius - apart * apart / 3.0_f64).sqrt();
        let mut blocks = Vec::new();
        for level in 0..layers {
            for i in 0..layers - level {
                for j in 0..layers - level - i {
                    let [i, j, k] = [i, j, level].map(f64::from);
                    let x = apart * (i + 0.5 * j + 0.5 * k);
                    let y = apart * 0.75_f64.sqrt() * (j + k / 3.0);
                    blocks.push(format!(
                        r#"{{ "id": "b{}", "support": {}, "shape": {{ "sphere": {{ "radius": {radius} }} }}, "at": [{x}, {y}, {}] }}"#,
                        blocks.len(),
                        level == 0,
                        rise * k
                    ));
                }
            }
        }
        let [after, alone] = second(format!(
            r#"{{ "format": "voussoir-scene/1", "joints": {{ "default": {{ "friction": 0.9 }} }}, "blocks": [{}] }}"#,
            blocks.join(",")
        ));
        assert_eq!([after.0, alone.0], [Engine::Interior; 2]);
        assert!(after.1 < alone.1, "{} of {}", after.1, alone.1);
        let lower = after.2.lower.max(alone.2.lower);
        assert!(lower <= after.2.upper.min(alone.2.upper), "{after:?} {alone:?}");
    }

    #[test]
    fn walls_begin_where_they_would_by_themselves() {
        let [after, alone] = second(
            r#"{ "format": "voussoir-scene/1", "joints": { "default": { "friction": 0.6 } },
            "templates": [ { "wall": { "size": [1, 0.5, 0.4], "courses": 14, "blocks": 14, "first": "half", "base": "course" } } ] }"#
                .to_string(),
        );
        assert_eq!(after.0, Engine::Interior);
        assert_eq!(after, alone);
    }
}
