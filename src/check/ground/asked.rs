//! What is asked of all blocks on ground that moves.

use super::Given;
use base::{
    error::{InputError, JsonPath},
    tolerance,
};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Options of `shake`: all blocks of a scene on ground that moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ShakeOptions {
    /// The direction in which the ground moves, made horizontal; (1, 0, 0) where nothing is said.
    pub toward: [f64; 3],
    /// How the ground moves.
    pub ground: Given,
    /// Fast steps: an impact loses 0.7 % more of the speed than with fine ones.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub fast: bool,
    /// Time to simulate at most, s; that of the motion and as long as a fall takes after it where
    /// nothing is said.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f64>,
    /// Simulate until then although something overturned or everything is at rest.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub to_the_end: bool,
}

impl Default for ShakeOptions {
    fn default() -> Self {
        Self {
            toward: [1.0, 0.0, 0.0],
            ground: Given::default(),
            fast: false,
            seconds: None,
            to_the_end: false,
        }
    }
}

impl ShakeOptions {
    /// Refuses options that mean nothing, whatever the scene; a record that is only named is not
    /// looked into.
    ///
    /// # Errors
    /// The first option that means nothing, with its place.
    pub fn check(&self) -> Result<(), InputError> {
        let refuse = |key: &str, text: &str| Err(InputError::at(JsonPath::root().key(key), text));
        if !self.toward.iter().all(|v| v.is_finite()) || self.toward == [0.0; 3] {
            return refuse("toward", "the direction must not be zero");
        }
        if !self.ground.moves() {
            return refuse("ground", "nothing moves: give a pulse or a record");
        }
        self.ground.check().map_err(|e| e.under(&JsonPath::root().key("ground")))?;
        if self.seconds.is_some_and(|s| !(s > 0.0 && s.is_finite())) {
            return refuse("seconds", "must be > 0");
        }
        Ok(())
    }

    /// Unit axes of the motion under this gravity: the direction, the horizontal one to its left,
    /// and up.
    ///
    /// # Errors
    /// The direction is along gravity.
    pub fn axes(&self, gravity: Vector3<f64>) -> Result<[Vector3<f64>; 3], InputError> {
        let up = -gravity.try_normalize(0.0).unwrap_or(-Vector3::z());
        let toward = Vector3::from(self.toward).normalize();
        let across = toward - up * up.dot(&toward);
        if across.norm() <= tolerance::ALONG {
            return Err(InputError::at(
                JsonPath::root().key("toward"),
                "the direction of the ground motion is parallel to gravity",
            )
            .hint("give a direction across gravity, such as 1,0"));
        }
        let across = across.normalize();
        Ok([across, up.cross(&across), up])
    }
}
