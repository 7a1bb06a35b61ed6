//! A scene with one number changed, as the model that its value is about.

use super::numbers::{MOST, Number, numbers};
use crate::{kinematic::quake, verdict::tilted::tilted};
use base::error::{InputError, JsonPath};
use model::{
    assembly::{Blocks, resolve_with},
    interface::{Model, prepare},
};
use nalgebra::Vector3;
use scene::{Scene, Touches};
use serde_json::Value;

/// What makes the live load of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Under {
    /// Its own one.
    Load,
    /// A tilt towards this direction.
    Tilt(Vector3<f64>),
    /// An earthquake towards this direction.
    Quake(Vector3<f64>),
}

impl Under {
    /// A prepared scene under this load; at a tilt its joints are as they are there.
    ///
    /// # Errors
    /// The direction means nothing for the scene.
    pub fn of(&self, scene: &Scene, model: &Model, value: f64) -> Result<Model, InputError> {
        match *self {
            Self::Load => Ok(model.clone()),
            Self::Tilt(toward) => tilted(model, toward, Some(value)),
            Self::Quake(toward) => Ok(quake(scene, model, toward)?.model),
        }
    }
}

/// A scene whose numbers are changed one by one.
pub struct Varied<'a> {
    /// The scene as its keys have it.
    pub document: Value,
    scene: &'a Scene,
    /// Prepared.
    pub model: &'a Model,
    under: Under,
}

impl<'a> Varied<'a> {
    /// A scene, prepared as `model`, under a load.
    ///
    /// # Errors
    /// None that a prepared scene can bring about.
    pub fn new(scene: &'a Scene, model: &'a Model, under: Under) -> Result<Self, InputError> {
        let document = scene.to_value().map_err(unread)?;
        Ok(Self { document, scene, model, under })
    }

    /// The numbers of the scene that were assumed and act, at most `MOST` of them, and how many
    /// there are beyond.
    pub fn numbers(&self) -> (Vec<Number>, usize) {
        let acts = |n: &Number| match self.under {
            Under::Load => !n.pointer.starts_with("/loads/masses/"),
            Under::Tilt(_) => {
                !["/loads/masses/", "/loads/live/"].iter().any(|k| n.pointer.starts_with(k))
            }
            Under::Quake(_) => !n.pointer.starts_with("/loads/live/"),
        };
        let mut all = numbers(&self.document);
        all.retain(acts);
        let omitted = all.len().saturating_sub(MOST);
        all.truncate(MOST);
        (all, omitted)
    }

    /// What makes its live load.
    pub fn under(&self) -> Under {
        self.under
    }

    /// The model as it is, at a load factor.
    ///
    /// # Errors
    /// As [`Under::of`].
    pub fn own(&self, load_factor: f64) -> Result<Model, InputError> {
        self.under.of(self.scene, self.model, load_factor)
    }

    /// The scene with another value of a number.
    ///
    /// # Errors
    /// There is no such scene.
    pub fn scene_at(&self, number: &Number, value: f64) -> Result<Scene, InputError> {
        let mut document = self.document.clone();
        if let Some(place) = document.pointer_mut(&number.pointer) {
            *place = value.into();
        }
        Scene::from_value(document).map_err(unread)
    }

    /// The model with another value of a number, its contacts kept where they do not depend on it.
    ///
    /// # Errors
    /// There is no such scene.
    pub fn at(&self, number: &Number, value: f64, load_factor: f64) -> Result<Model, InputError> {
        let scene = self.scene_at(number, value)?;
        let model = match number.touches {
            Touches::Shapes => prepare(&scene)?,
            Touches::Loads | Touches::Masses => {
                let assembly = resolve_with(&scene, self.weighed(number, value))?;
                let interfaces = self.model.interfaces.with_joints_of(&assembly)?;
                Model::new(assembly, interfaces)
            }
        };
        self.under.of(&scene, &model, load_factor)
    }

    /// The blocks where a density or a mass is another one.
    fn weighed(&self, number: &Number, value: f64) -> Blocks {
        let keys: Vec<&str> = number.pointer.split('/').skip(1).collect();
        // Blocks of templates have no density but that of their material.
        let own = |i: usize| self.scene.blocks.get(i);
        let is_of = |i: usize, material: Option<&str>| match keys[..] {
            ["materials", name, "density"] => {
                let given = own(i).is_some_and(|b| b.density.is_some() || b.mass.is_some());
                !given && material.is_some_and(|m| m.replace('~', "~0").replace('/', "~1") == name)
            }
            ["blocks", place, "density" | "mass"] => place.parse() == Ok(i),
            _ => false,
        };
        let by = value / number.value;
        let times = |i: usize, material: Option<&str>| if is_of(i, material) { by } else { 1.0 };
        Blocks::of(&self.model.assembly, |i, block| times(i, block.material.as_deref()))
    }

    /// What a change of a number is measured by: itself; of a coordinate the size of its block, or
    /// of the greatest free one, m. What is zero is measured by one unit.
    pub fn scale(&self, number: &Number) -> f64 {
        let assembly = &self.model.assembly;
        let size = |i: usize| assembly.blocks[i].size;
        match (number.place, number.block.as_deref().and_then(|id| assembly.find(id))) {
            (true, Some(i)) => size(i),
            (true, None) => assembly.free().map(size).fold(0.0, f64::max),
            (false, _) => Some(number.value.abs()).filter(|v| *v > 0.0).unwrap_or(1.0),
        }
    }
}

fn unread(e: serde_json::Error) -> InputError {
    InputError::at(JsonPath::root(), e.to_string())
}
